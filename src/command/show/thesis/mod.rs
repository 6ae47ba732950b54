//! The page of `study report`: success map, figures, equations, tables and readings of the thesis beside a study.

mod figures;
mod tables;

pub use tables::{EquationRow, metal};

use crate::Result;
use crate::curve::{Impact, Summary};
use crate::report::page::{Block, Page, Section};
use crate::report::table::Table;
use crate::thesis::tables::METALS;
use crate::thesis::{Claim, Data, EQUATIONS, Equation, Refit, Row, Score, claims, refit};
use figures::Figures;
use tables::Scored;

/// All that the page shows.
pub struct Report {
    /// Cases.
    pub data: Data,
    scored: Vec<Scored>,
    claims: Vec<Claim>,
}

impl Report {
    /// Scores, fits and readings of the cases of a study.
    #[must_use]
    pub fn of(data: Data) -> Self {
        let inside = data.usable(Row::inside);
        let outside = data.usable(|row| row.plastic() && !row.inside());
        let one = |equation: &'static Equation| {
            let rows: Vec<&Row> = inside
                .iter()
                .copied()
                .filter(|row| (equation.valid)(row))
                .collect();
            let fitted: Refit = refit(equation, &rows);
            let beyond: Vec<&Row> = outside
                .iter()
                .copied()
                .filter(|row| (equation.valid)(row))
                .collect();
            let score = |constants: &[f64], rows: &[&Row]| Score::of(equation, constants, rows);
            Scored {
                equation,
                printed: [
                    score(equation.constants, &rows),
                    score(equation.constants, &beyond),
                ],
                beyond: score(&fitted.constants, &beyond),
                fitted,
            }
        };
        let scored = EQUATIONS.iter().map(one).collect();
        let claims = claims(&data);
        Report {
            data,
            scored,
            claims,
        }
    }

    /// Rows of `equations.csv`.
    #[must_use]
    pub fn rows(&self) -> Vec<EquationRow> {
        self.scored.iter().flat_map(Scored::rows).collect()
    }

    /// What it comes to, in a sentence.
    #[must_use]
    pub fn summary(&self) -> String {
        let shown = self.claims.iter().filter(|claim| claim.shown).count();
        let inside = self.data.usable(Row::inside).len();
        format!(
            "{} cases, {inside} of them where the thesis has results; {} of its equations scored and refitted, {shown} of {} readings of the physics corrected by the data.",
            self.data.rows.len(),
            self.scored.len(),
            self.claims.len()
        )
    }

    /// The page. `metals` are impacts of lead and nickel; `impact` finds the curve of a case, in units of R = rho = E = 1.
    ///
    /// # Errors
    /// [`crate::Error::Figure`] when a figure cannot be drawn.
    pub fn page(
        &self,
        metals: &[Summary],
        impact: &dyn Fn(&Row) -> Option<Impact>,
        provenance: &str,
    ) -> Result<Page> {
        let data = &self.data;
        let fitted = |number: &str| {
            let of = self.scored.iter().find(|one| one.equation.number == number);
            of.map_or_else(Vec::new, |one| one.fitted.constants.clone())
        };
        let figures = Figures {
            data,
            fitted: &fitted,
        };
        let page = Page {
            title: "A study beside the thesis".to_owned(),
            summary: self.summary(),
            sections: Vec::new(),
            colophon: provenance.to_owned(),
        };
        let map = tables::success(data).into_iter();
        let section = Section::new("Success map").with(Block::Text(
            "Tables B-1 to B-5: density in kg/m³ and Young's modulus in GPa across, E/Y down. A tick is a run that ended well; a number beside it is ρV²/Y above 3.2, \
             where the thesis has no result (its largest plastic strain, 1.53, is that of 3.2). Its colours are lost; it names the elastic cases and “extensive” failures."
                .to_owned(),
        ));
        let map = map.fold(section, |section, table| section.with(Block::Table(table)));
        let force = figures.force(impact)?.into_iter();
        let force = force.fold(
            Section::new("Force and displacement"),
            |section, together| section.with(Block::Figures(together)),
        );
        let line = |claim: &Claim| {
            let state = if claim.shown {
                ""
            } else {
                " (This study does not show it clearly.)"
            };
            format!(
                "{} — the thesis: {}. {}{state}",
                claim.place, claim.reading, claim.finding
            )
        };
        let page = page
            .with(Section::new("Cases").with(Block::Facts(tables::facts(data))))
            .with(map)
            .with(Section::new("Plastic strain").with(Block::Figures(figures.strain()?)))
            .with(Section::new("Compression").with(Block::Figures(figures.compression()?)))
            .with(Section::new("Energy and restitution").with(Block::Figures(figures.restitution()?)))
            .with(force)
            .with(self.equations())
            .with(
                Section::new("Tables 4-4 and 4-5")
                    .with(Block::Table(tables::forces(data)))
                    .with(Block::Table(tables::sizes(data))),
            )
            .with(
                Section::new("Order of the inputs")
                    .with(Block::Text(
                        "Figures 5-2 and 5-4: recursive elimination with a random forest, and Spearman's rank correlation.".to_owned(),
                    ))
                    .with(Block::Table(tables::ranked(data, false)))
                    .with(Block::Table(tables::ranked(data, true))),
            )
            .with(Section::new("Readings of the physics").with(Block::List(self.claims.iter().map(line).collect())))
            .with(self.metals(metals))
            .with(Section::new("What is not here").with(Block::Text(
                "Figures 4-1 and 5-1 are drawings, 4-2 and 4-5 fields of single impacts: `impactlaw impact` draws strain and stress of any case."
                    .to_owned(),
            )));
        Ok(page)
    }

    fn equations(&self) -> Section {
        let [constants, inside, outside] = tables::equations(&self.scored);
        Section::new("Equations")
            .with(Block::Text(
                "Inside: cases that yield with ρV²/Y up to 3.2. Fitted: least squares there; intervals of 95 % from drawing whole levels of E/Y with replacement. \
                 R² is that of statistics; the thesis' 5-3 has the predictions in its denominator."
                    .to_owned(),
            ))
            .with(Block::Table(constants))
            .with(Block::Table(inside))
            .with(Block::Table(outside))
    }

    fn metals(&self, runs: &[Summary]) -> Section {
        let scored = |number: &str| {
            let one = self.scored.iter().find(|one| one.equation.number == number);
            one.map(|one| (one.equation, &one.fitted.constants[..]))
        };
        let table: Table = tables::metals(runs, scored);
        Section::new("Lead and nickel")
            .with(Block::Text(format!(
                "Tables 5-3 to 5-5: spheres of 500 µm, {}. Runs of this program beside the thesis' own, and beside the equations fitted above, which have not seen them.",
                METALS.map(|m| format!("{} at {} m/s", m.name, m.velocity)).join(", ")
            )))
            .with(Block::Table(table))
    }
}
