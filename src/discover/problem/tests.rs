//! Groups of small tables, and what of a table is refused.

use super::*;
use std::path::Path;

const HEAD: &str = "density_kg_m3,young_modulus_Pa,yield_strength_Pa,poisson_ratio,radius_m,velocity_m_s,restitution,max_force_N,status";

/// Impacts with made up figures: each density with each modulus, strength and speed.
fn table(head: &str, densities: &[f64], moduli: &[f64]) -> Table {
    let mut text = format!("{head}\n");
    for density in densities {
        for modulus in moduli {
            for (k, strength) in [50e6, 80e6, 120e6, 200e6].into_iter().enumerate() {
                for speed in [1.0, 2.0, 5.0] {
                    let e = 0.3 + 0.05 * k as f64 / speed;
                    let row = match head.starts_with("density") {
                        true => format!(
                            "{density},{modulus},{strength},0.3,1e-3,{speed},{e},{speed},ok\n"
                        ),
                        false => format!("{strength},1e-3,{speed},{e},{speed},ok\n"),
                    };
                    text.push_str(&row);
                }
            }
        }
    }
    Table::parse(&text, Path::new("results.csv")).unwrap()
}

fn groups_of(table: &Table) -> Result<Vec<String>> {
    let figures: Vec<&Column> = table.figures.iter().collect();
    let inputs = Inputs::of(table, &figures)?;
    Ok(inputs.groups.iter().map(Product::text).collect())
}

#[test]
fn what_never_changes_takes_part_in_groups_by_its_unit() {
    let wanted = ["E/Y", "rho V^2/Y"];
    for (densities, moduli) in [
        (&[8e3][..], &[60e9, 120e9][..]),
        (&[4e3, 8e3], &[60e9]),
        (&[8e3], &[60e9]),
        (&[4e3, 8e3], &[60e9, 120e9]),
    ] {
        let mut found = groups_of(&table(HEAD, densities, moduli)).unwrap();
        found.sort();
        assert_eq!(found, wanted, "{densities:?} {moduli:?}");
    }
}

#[test]
fn a_column_that_varies_and_stands_in_no_group_is_refused() {
    let head = "yield_strength_Pa,radius_m,velocity_m_s,restitution,max_force_N,status";
    let error = groups_of(&table(head, &[8e3], &[60e9]))
        .unwrap_err()
        .to_string();
    assert!(error.contains("velocity_m_s"), "{error}");
    assert!(error.contains("density"), "{error}");
}

#[test]
fn figures_that_no_impact_has_are_refused_by_line() {
    for (row, place) in [
        ("8e3,60e9,50e6,0.3,1e-3,1,1.21,5,ok", "restitution"),
        ("8e3,60e9,50e6,0.3,1e-3,1,0.5,-5,ok", "max_force_N"),
    ] {
        let good = "8e3,60e9,50e6,0.3,1e-3,2,0.5,5,ok";
        let text = format!("{HEAD}\n{good}\n{row}\n");
        let error = Table::parse(&text, Path::new("results.csv")).unwrap_err();
        let error = error.to_string();
        assert!(error.contains(place) && error.contains("line 3"), "{error}");
    }
}
