//! Metals of the impact tester: solder, copper and an aluminium alloy, thrown by air against a rigid wall. What was measured is lost.

use super::measured::{Figure, Input};
use super::row::equation;
use super::{Bound, Derived, Experiment, File, Found, strength};
use crate::tester::{Air, Constants, POLYMERS_AND_GLASS, Particle, Tester, WITH_SOLDER};
use crate::theory::wu_li_thornton;
use crate::unit::significant;

/// Solder, copper and an aluminium alloy of a single-particle impact tester.
pub struct ImpactTester;

/// The cases of a list of strengths.
const STRENGTHS: &str = "SAC305 500 um, other strengths";
/// Measured restitution over that of Wu and others at speeds above 1e4 V_y, as the thesis tells it in words.
const OVER_WU: f64 = 2.0;
/// How far a speed of the case file, which has two decimals, may be from that of the tester, m/s.
const SPEED: f64 = 0.005_1;
/// Speed of solder of 500 um at 10 kPa by both correlations, and to what it is known, m/s.
const KNOWN: [(&str, Constants, f64); 2] = [
    ("equation 6-6", POLYMERS_AND_GLASS, 16.9),
    ("equation 6-7", WITH_SOLDER, 18.8),
];

impl Experiment for ImpactTester {
    const NAME: &'static str = "impact-tester";
    const TITLE: &'static str = "Metals of the impact tester";
    const SOURCE: &'static str = "Saifoori 2025, section 6.3.2, tables 6-10 and 6-11";
    const FILE: File = File::Study;
    const CASES: &'static str = include_str!("../../cases/experiments/impact-tester.toml");
    const MEASURED: &'static str = include_str!("../../cases/experiments/impact-tester.csv");
    const FIGURES: &'static [Figure] = &[Figure::Restitution, Figure::Compression];
    const REMARKS: &'static [&'static str] = &[
        "Lost: every measured speed, restitution and compression ratio of these particles stands in figures that are not to be had. What the thesis says \
         of them in words: compression ratios of SAC305 and AA6061 are close to equation 5-5, those of copper only with 162 MPa; restitution lies above all \
         formulas, about twice that of Wu and others above 1e4 V_y.",
        "Speeds are those of equation 6-7 in air of 1.204 kg/m³ and 18.1 µPa s, which the thesis does not print. AA6061 gets 43 to 59 m/s by it, where the \
         text says that no speed exceeds 40 m/s; 63 µm lies far outside the sizes the correlation was made from.",
        "By the cap: the compression ratio that a flat of our largest contact would be given by H_d = D/2 + (D² − d_d²)^½/2, as the thesis evaluates \
         flats under the microscope. The displaced material piles up beside the flat and widens it, so the cap says more than the height has lost. It says nothing where the flat is wider than the \
         particle was.",
        "Table 6-11: the columns johnson, thornton-hardness and wu-li-thornton of the restitution are its formulas; equation 4-9 is the thesis’ own.",
    ];

    fn bounds(found: &Found) -> Vec<Bound> {
        let mut bounds = Vec::new();
        for (name, constants, known) in KNOWN {
            let solder = Particle {
                diameter: 500e-6,
                density: 7274.0,
            };
            let speed = tester(constants).speed(&solder, 10e3);
            let of = format!("speed of SAC305 of 500 µm at 10 kPa by {name}, m/s");
            bounds.push(Bound::within(of, Some(speed), known, 0.05));
        }
        let off = found.of(Figure::Restitution).filter_map(|row| {
            let case = found.called(&row.case).next()?;
            let particle = Particle {
                diameter: 2.0 * case.case.radius,
                density: case.case.material.density,
            };
            let pressure = found.input(&row.case, Input::GaugePressure)?;
            Some((tester(WITH_SOLDER).speed(&particle, pressure) - row.velocity).abs())
        });
        let of = "largest difference of the case file’s speeds to equation 6-7, m/s".to_owned();
        let largest = off.reduce(f64::max);
        bounds.push(Bound::within(of, largest, 0.0, SPEED));
        bounds
    }

    fn tables(found: &Found) -> Vec<Derived> {
        vec![cap(found), one_strength(found)]
    }
}

fn tester(constants: Constants) -> Tester {
    Tester {
        air: Air::USUAL,
        tube: Tester::TUBE,
        constants,
    }
}

/// What the cap says over what the height has lost.
fn cap(found: &Found) -> Derived {
    let rows = found.of(Figure::Compression).filter_map(|row| {
        let (ours, cap, (_, printed)) = (row.ours?, row.by_cap?, row.equation?);
        let over = |x: f64| format!("{:+.0} %", 100.0 * (x / ours - 1.0));
        let cells = [
            significant(ours, 3),
            significant(cap, 3),
            over(cap),
            significant(printed, 3),
            over(printed),
        ];
        Some([vec![row.case.clone()], cells.to_vec()].concat())
    });
    Derived {
        title:
            "Compression by the cap on a flat, and by equation 5-5, over what the height has lost"
                .to_owned(),
        text: String::new(),
        head: vec![
            "case",
            "1 − H_d/D, ours",
            "by the cap",
            "",
            "equation 5-5",
            "",
        ],
        rows: rows.collect(),
    }
}

/// The strength that explains restitution and compression of the solder.
fn one_strength(found: &Found) -> Derived {
    let mut speeds: Vec<f64> = found
        .called(STRENGTHS)
        .map(|one| one.case.velocities[0])
        .collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let (mut rows, mut all) = (Vec::new(), Vec::new());
    for speed in speeds {
        let at = || {
            found
                .called(STRENGTHS)
                .filter(move |one| one.case.velocities[0] == speed)
        };
        let Some(indented) = at().next() else {
            continue;
        };
        let (material, radius) = (indented.case.material, indented.case.radius);
        let wanted = [
            wu_li_thornton::restitution(&material, speed).map(|e| OVER_WU * e),
            equation(&material, radius, speed, Figure::Compression).map(|(_, ratio)| ratio),
        ];
        let of = |figure: fn(&super::Outcome) -> Option<f64>, wanted: Option<f64>| {
            let points = at().filter_map(|one| {
                let strength = one.case.material.flow?.yield_strength();
                Some([strength, figure(one)?])
            });
            strength(&points.collect::<Vec<_>>(), wanted?)
        };
        let found = [
            of(|one| one.figure(Figure::Restitution), wanted[0]),
            of(|one| one.by_cap(), wanted[1]),
        ];
        all.push(found);
        let mega = |y: Option<f64>| y.map_or("outside".to_owned(), |y| significant(y / 1e6, 3));
        let plain = |x: Option<f64>| x.map_or("-".to_owned(), |x| significant(x, 3));
        rows.push(vec![
            significant(speed, 3),
            plain(wanted[0]),
            plain(indented.figure(Figure::Restitution)),
            mega(found[0]),
            plain(wanted[1]),
            plain(indented.by_cap()),
            mega(found[1]),
        ]);
    }
    let mean = |k: usize| {
        let logs: Vec<f64> = all.iter().filter_map(|both| both[k]).map(f64::ln).collect();
        (!logs.is_empty()).then(|| (logs.iter().sum::<f64>() / logs.len() as f64).exp())
    };
    let said = match (mean(0), mean(1)) {
        (Some(e), Some(ratio)) => format!(
            " Found: {} MPa from the restitution and {} MPa from the compression (geometric means), {} and {} times the indented 97.59 MPa.",
            significant(e / 1e6, 3),
            significant(ratio / 1e6, 3),
            significant(e / 97.59e6, 2),
            significant(ratio / 97.59e6, 2)
        ),
        _ => String::new(),
    };
    Derived {
        title: "Inference: one dynamic strength of the solder".to_owned(),
        text: format!(
            "Not measured: the points are lost, and what is used is what the thesis says of them in words. Restitution is taken for twice that of Wu and \
             others, compression by the cap for equation 5-5, both with the indented strength of 97.59 MPa. Impacts with other strengths say which one \
             would give each of them.{said} Both call for a solder that is about as much stronger in an impact than under the indenter. The thesis explains by what its scheme loses that \
             equation 4-9 lies below the measured restitution; but 4-9 lies above our impacts already, so what is missing is no loss. The strength for the compression falls with the speed, because equation 5-5 rises with the speed to the power of \
             1.32 and the caps of one strength to that of 1.16."
        ),
        head: vec![
            "V (m/s)",
            "e, told",
            "e at 97.59 MPa, ours",
            "strength for e (MPa)",
            "1 − H_d/D, told",
            "by the cap at 97.59 MPa, ours",
            "strength for it (MPa)",
        ],
        rows,
    }
}
