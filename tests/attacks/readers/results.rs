//! Tables of studies and files of equations.

use super::{Accepted, text};
use impactlaw::discover::bound::Bound;
use impactlaw::discover::file::EquationsFile;
use impactlaw::discover::infix::Infix;
use impactlaw::discover::problem::{Inputs, Runs};
use impactlaw::discover::table::Table;
use impactlaw::document::Document;
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
