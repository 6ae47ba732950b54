//! Tables of studies and files of equations.

use super::{Accepted, text};
use impactlaw::discover::bound::Bound;
use impactlaw::discover::file::EquationsFile;
use impactlaw::discover::infix::Infix;
use impactlaw::discover::problem::{Inputs, Runs};
use impactlaw::discover::table::Table;
use impactlaw::document::Document;
use impactlaw::inverse::measurement::{Measurements, Taken, Uncertainty};
use impactlaw::tester::fit::{by_steps, together};
use impactlaw::tester::table::parse;
use impactlaw::tester::{Air, Tester, WITH_SOLDER};
use impactlaw::thesis::{Data, Row, claims};
use impactlaw::validate::measured;
use std::path::Path;

/// Results of a study, as far as `discover` looks at them.
pub(super) const RESULTS: &str = "# made by a test\n\
density_kg_m3,young_modulus_Pa,yield_strength_Pa,poisson_ratio,radius_m,velocity_m_s,restitution,max_force_N,points,status\n\
1000,1e9,1e7,0.3,1e-4,10,0.5,0.01,1200,ok\n\
2000,1e9,1e7,0.3,1e-4,10,0.4,0.015,1200,ok\n\
2000,4e9,1e7,0.3,1e-4,20,0.2,0.03,1300,ok\n\
2000,4e9,2e7,0.3,1e-4,30,0.25,0.05,1300,failed: sheet\n";

/// The same with columns that are no inputs, and in other units.
pub(super) const WRITTEN: &str = "# made by a test\n\
name,density_g_cm3,young_modulus_MPa,yield_strength_Pa,poisson_ratio,radius_mm,velocity_mm_s,friction,tolerance,young_over_yield,\
V_over_Vy,restitution,max_force_N,predicted_s,status\n\
1,1,1e3,1e7,0.3,0.1,1e4,0.0,0.1,100,20,0.5,0.01,0.2,ok\n\
2,2,1e3,1e7,0.3,0.1,1e4,0.0,0.1,100,25,0.4,0.015,0.2,ok\n\
3,2,4e3,1e7,0.3,0.1,2e4,0.0,0.1,400,90,0.2,NaN,0.2,ok\n";

pub(super) fn results(bytes: &[u8], _: &Path) -> Accepted {
    let Ok(table) = Table::parse(&text(bytes), Path::new("results.csv")) else {
        return false;
    };
    let figures: Vec<_> = table.figure("restitution").into_iter().collect();
    if let Ok(inputs) = Inputs::of(&table, &figures) {
        let runs = Runs::of(&table, &inputs);
        assert_eq!(runs.counts.iter().sum::<usize>(), table.rows());
    }
    for bound in ["rho V^2/Y <= 3", &text(bytes)] {
        if let Ok(bound) = Bound::parse(bound, &table) {
            assert!(bound.rows(&table).len() <= table.rows());
        }
    }
    true
}

/// Results of a study that has enough cases for a report.
pub(super) fn reported() -> String {
    let text = include_str!("../../data/study-480.csv");
    text.lines()
        .step_by(14)
        .fold(String::new(), |mut all, line| {
            // the header is the second line
            if all.is_empty() {
                all = text.lines().nth(1).unwrap_or_default().to_owned() + "\n";
                return all;
            }
            all + line + "\n"
        })
}

pub(super) fn report(bytes: &[u8], _: &Path) -> Accepted {
    let Ok(data) = Data::parse(&text(bytes), Path::new("results.csv")) else {
        return false;
    };
    let inside = data.usable(Row::inside);
    assert!(inside.len() >= 12);
    assert!(
        inside
            .iter()
            .all(|row| row.severity() > 0.0 && row.work.is_finite())
    );
    let _ = claims(&data);
    true
}

/// Measured impacts.
pub(super) const MEASURED: &str = "# made by a test\nvelocity_m_s,restitution,restitution_sigma,velocity_sigma_m_s,who\n1,0.4,0.02,0.1,me\n\
    3,0.3,,0.1,me\n10,0.2,0.01,,you\n";

/// The same, of flats, in other units.
pub(super) const FLATS: &str = "Velocity (mm/s);flat_diameter [um];diameter_mm;diameter_sigma_um;compression_ratio\n\
    5000;80;0.2;2;0.05\n8000;120;;;\n";

pub(super) fn measured(bytes: &[u8], _: &Path) -> Accepted {
    let mut accepted = false;
    for cap in [false, true] {
        let taken = Taken {
            radius: 1e-4,
            uncertainty: Uncertainty::default(),
            cap,
        };
        let read = Measurements::parse(&text(bytes), Path::new("m.csv"), &taken);
        for row in read.iter().flat_map(|read| &read.all) {
            accepted = true;
            assert!(row.velocity > 0.0 && row.velocity.is_finite());
            assert!(row.value > 0.0 && row.value < 1.0, "{row:?}");
            assert!(
                row.sigma.is_none_or(|s| s > 0.0 && s.is_finite()),
                "{row:?}"
            );
            assert!(row.velocity_sigma >= 0.0 && row.velocity_sigma <= 0.5);
            assert!(
                row.radius_slope.is_finite() && row.radius_sigma <= 0.5,
                "{row:?}"
            );
        }
    }
    accepted
}

/// A file of equations.
pub(super) const EQUATIONS: &str = r#"schema = 1
[provenance]
program = "impactlaw 0.1.0"
results_sha256 = "00ff"
cases = 445
runs = 337
seed = 1
[[group]]
name = "E_Y"
text = "E/Y"
columns = ["young_modulus_Pa", "yield_strength_Pa"]
exponents = [1, -1]
min = 20.0
max = 2560.0
[[undetermined]]
column = "poisson_ratio"
value = 0.35
[[equation]]
figure = "restitution"
chosen = true
formula = "(1 + c1 * E_Y^(1/4) * (1 - V_Vy^(-1))^3 * exp(-c2))^(-1/2)"
scale_columns = []
scale_exponents = []
constants = [0.5, 2.0]
low = [0.4, 1.9]
high = [0.6, 2.1]
bits = 60.0
misfit_bits = 10.0
seen = { mae = 0.01, r2 = 0.99, median_rel = 0.01, p90_rel = 0.05 }
levels = { mae = 0.01, r2 = 0.99, median_rel = 0.01, p90_rel = 0.05 }
materials = { mae = 0.01, r2 = 0.99, median_rel = 0.01, p90_rel = 0.05 }
"#;

pub(super) fn equations(bytes: &[u8], _: &Path) -> Accepted {
    let document = Document::new(Path::new("equations.toml"), &text(bytes)[..]);
    let Ok(file) = EquationsFile::parse(&document) else {
        return false;
    };
    for equation in &file.equation {
        let formula = Infix::parse(&equation.formula).unwrap();
        let _ = formula.value(&|name| equation.constant(name).or(Some(2.0)));
    }
    true
}

/// Speeds of a tester.
pub(super) const THROWN: &str = "# made by a test\n\
material,density_kg_m3,diameter_um,gauge_pressure_kPa,velocity_m_s\n\
a,745,500,4,9.1\na,745,500,8,12.4\na,745,1000,4,7.8\nb,2545,1000,4,5.6\nb,2545,1000,16,10.7\nb,2545,500,8,9.2\n";

pub(super) fn thrown(bytes: &[u8], _: &Path) -> Accepted {
    let Ok(all) = parse(&text(bytes), Path::new("speeds.csv")) else {
        return false;
    };
    let tester = Tester {
        air: Air::USUAL,
        tube: Tester::TUBE,
        constants: WITH_SOLDER,
    };
    if let Ok(found) = together(&tester, &all) {
        assert!(found.scatter >= 0.0 || found.scatter.is_nan());
    }
    let _ = by_steps(&tester, &all);
    true
}

pub(super) fn experiment(bytes: &[u8], _: &Path) -> Accepted {
    let Ok(all) = measured::parse(&text(bytes), Path::new("measured.csv")) else {
        return false;
    };
    for (k, one) in all.iter().enumerate() {
        assert!(
            one.value.is_none_or(|x| x > 0.0 && x.is_finite()),
            "{one:?}"
        );
        assert!(one.uncertainty.is_none_or(|x| x > 0.0 && x.is_finite()));
        assert!(!one.case.is_empty() && !one.source.is_empty());
        let same = |other: &&measured::Entry| {
            (&other.case, other.kind, other.quantity) == (&one.case, one.kind, one.quantity)
        };
        assert!(!all[..k].iter().any(|other| same(&other)), "{one:?}");
    }
    true
}
