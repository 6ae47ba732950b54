//! Method: the plan of an impact by a preset.

use super::{Effect, Geometry, Plan, Remedies, estimate, severity};
use crate::case::Case;
use crate::scheme::preset::{Filling, Method, Preset};
use crate::scheme::{Layout, Reference, Scheme, TimeStep, Transfer};
use crate::unit::{engineering, significant};

/// The thesis' wall lies three distances of its points below the sphere, and ten output files are written on the way (section 3.5.1):
/// distances that the particle flies from file to file.
const DISTANCES_A_FILE: f64 = 0.3;

/// What a preset has of output files.
impl Plan {
    /// Time from one output file of the thesis to the next, R/c0; none of a plan that has none. `speed`: impact speed over c0.
    #[must_use]
    pub fn file_interval(&self, speed: f64) -> Option<f64> {
        let method = self.method.filter(Method::reads_files)?;
        let filling = method.filling?;
        Some(DISTANCES_A_FILE * 2.0 / f64::from(filling.points) / speed)
    }

    /// What a preset's lattice cannot see of the impact: a flattening expected to be less than a distance of its points is that
    /// of the few points at the pole. None where it is more, or where there is no lattice.
    #[must_use]
    pub fn unseen(&self) -> Option<String> {
        let filling = self.method?.filling?;
        let distance = 2.0 / f64::from(filling.points);
        let share = self.estimate.displacement / distance;
        (share < 1.0).then(|| {
            format!(
                "delta* is expected to be {} of the distance of the points: F*, delta* and e are those of the few points at the pole, \
                 not of the particle; take more `points` or faster impacts",
                significant(share, 2)
            )
        })
    }
}

/// `plan`, which is that of the crate's own scheme, by a method.
pub(super) fn by(method: Method, plan: Plan, case: &Case) -> Plan {
    let mut plan = Plan {
        method: Some(method),
        ..plan
    };
    plan.scheme = Scheme {
        transfer: match method.preset {
            Preset::Thesis | Preset::Tlmpm | Preset::Ulmpm | Preset::Flip => Transfer::Blend(1.0),
            Preset::Pic => Transfer::Blend(0.0),
            Preset::Apic => Transfer::Apic,
        },
        reference: match method.preset {
            Preset::Ulmpm => Reference::Present,
            _ => Reference::Initial,
        },
        ..plan.scheme
    };
    match method.filling {
        Some(filling) => fill(&mut plan, method, filling, case),
        None => plan.grid.dt_share *= method.step.share(),
    }
    plan.effects
        .retain(|effect| !matches!(effect.name, "mass scaling" | "similar impact"));
    for effect in &mut plan.effects {
        if effect.name == "large deformation" && effect.on && method.filling.is_some() {
            effect.on = false;
            effect.reason += "; the preset has none";
        }
        if effect.name == "three dimensions" && plan.geometry != Geometry::Axisymmetric {
            effect.on = true;
            effect.reason = "the preset's; a normal impact needs none".to_owned();
        }
    }
    plan.effects.push(effect(&method, &plan, case));
    plan
}

/// Equal cells, a lattice of points, steps of one length.
fn fill(plan: &mut Plan, method: Method, filling: Filling, case: &Case) {
    let count = f64::from(filling.points);
    plan.grid.degree = method.degree as usize;
    plan.grid.fine = filling.cell();
    plan.grid.fine_width = 1.0;
    plan.grid.fine_depth = 2.0;
    plan.grid.scaled = 0.0;
    plan.grid.dt_share = 1.0;
    // each point its own volume: these methods have no mean over a cell
    plan.grid.remedies = Remedies {
        own_volume: 1.0,
        ..Remedies::NONE
    };
    plan.geometry = match method.dimensions {
        3 => Geometry::Quarter,
        _ => Geometry::Axisymmetric,
    };
    plan.scheme.layout = match method.preset {
        Preset::Thesis => Layout::Centred(count),
        _ => Layout::Lattice(count),
    };
    let crossing = case.crossing(plan.velocity, plan.grid.fine);
    let unit = case.unit_of_time();
    if let Some(dt) = method.step.fixed(crossing, unit) {
        plan.scheme.time_step = TimeStep::Fixed(dt);
    }
}

/// The preset as a line of the plan.
fn effect(method: &Method, plan: &Plan, case: &Case) -> Effect {
    let unit = case.unit_of_time();
    let step = match plan.scheme.time_step {
        TimeStep::Fixed(dt) => format!(" ({})", engineering(dt * unit, "s", 3)),
        TimeStep::Stable => String::new(),
    };
    let accuracy = match method.filling {
        Some(_) => "; the tolerance chooses nothing",
        None => "",
    };
    let unseen = plan
        .unseen()
        .map_or_else(String::new, |why| format!("; {why}"));
    Effect {
        name: "preset",
        on: true,
        reason: format!("{method}{step}{accuracy}{unseen}"),
    }
}

/// What is said of an impact that a preset cannot be asked for: what was found and what is allowed.
pub(super) fn refusal(case: &Case, velocity: f64) -> Option<[String; 2]> {
    let method = case.method?;
    if let Some(filling) = method.filling {
        let distance = 2.0 / f64::from(filling.points);
        let contact = estimate(&case.material, velocity).contact_radius;
        if contact < distance {
            let found = format!("{velocity} m/s");
            let allowed = format!(
                "preset \"{}\" takes {} points a diameter, whose distance is {} contact radii: the contact would be one point; take faster \
                 impacts or more `points`",
                method.preset.name(),
                filling.points,
                significant(distance / contact, 2)
            );
            return Some([found, allowed]);
        }
    }
    let severity = severity(&case.material, velocity);
    // on the planner's grid its remedies against large deformation would act, and none was shown with transfers of velocity
    (method.filling.is_none() && severity > super::LARGE_FROM).then(|| {
        let found = format!("rho V^2/Y = {} at {velocity} m/s", significant(severity, 3));
        let allowed = format!(
            "preset \"{}\" runs impacts up to rho V^2/Y = {}; presets \"thesis\" and \"tlmpm\" have no such bound",
            method.preset.name(),
            super::LARGE_FROM
        );
        [found, allowed]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::plan;
    use std::f64::consts::PI;
    use std::path::Path;

    const TEXT: &str = "[particle]\nradius = \"12.5 mm\"\n[material]\ndensity = \"1404 kg/m3\"\nyoung_modulus = \"4.9 MPa\"\n\
        poisson_ratio = 0.25\n[impact]\nvelocities = [\"1 m/s\"]\n[accuracy]\ntolerance = 0.02\n[scheme]\npreset = \"thesis\"\n";

    fn case(more: &str) -> Case {
        Case::parse(&format!("{TEXT}{more}"), Path::new("c.toml")).unwrap()
    }

    #[test]
    fn a_flattening_below_a_distance_of_the_points_is_warned_of_and_a_larger_one_is_not() {
        let plan_at = |points: u32| {
            let text = format!("{TEXT}points = {points}\n");
            let case = Case::parse(&text, Path::new("c.toml")).unwrap();
            plan(&case, case.velocities[0])
        };
        // Hertz: delta = (5 pi/4 (1 - nu^2) rho V^2/E)^(2/5) R = 0.065 R at 1 m/s, 1.6 distances of 50 points a diameter, 0.39 of 12
        let [fine, coarse] = [plan_at(50), plan_at(12)];
        let hertz = (1.25 * PI * (1.0 - 0.0625) * 1404.0 / 4.9e6f64).powf(0.4);
        assert!((coarse.estimate.displacement / hertz - 1.0).abs() < 0.01);
        assert_eq!(fine.unseen(), None);
        let said = coarse.unseen().unwrap();
        assert!(
            said.contains("0.39 of the distance of the points"),
            "{said}"
        );
        assert!(
            coarse
                .effects
                .iter()
                .any(|effect| effect.reason.ends_with(&said))
        );
    }

    #[test]
    fn the_thesis_settings_are_those_of_its_tables_3_1_and_3_2() {
        for (share, nanoseconds) in [("0.1", 100.0), ("0.01", 10.0), ("0.001", 1.0)] {
            for (points, ratio, cell) in [
                (50, "1.05", 0.525e-3),
                (62, "1.3", 0.525e-3),
                (80, "1.68", 0.525e-3),
                (25, "1.05", 1.05e-3),
                (13, "1.05", 2.019e-3),
            ] {
                let case = case(&format!(
                    "points = {points}\nratio = {ratio}\ntime_step = {share}\n"
                ));
                let plan = plan(&case, 1.0);
                let unit = case.radius / (4.9e6f64 / 1404.0).sqrt();
                let TimeStep::Fixed(dt) = plan.scheme.time_step else {
                    panic!("{plan:?}");
                };
                // 8, 8, 8, 16 and 32 us: the last two are of the order of 10 us, and the thesis takes the smallest for all
                let coarse = if points < 50 { 10.0 } else { 1.0 };
                assert!((dt * unit * 1e9 / (coarse * nanoseconds) - 1.0).abs() < 1e-9);
                assert!((plan.grid.fine * case.radius / cell - 1.0).abs() < 2e-3);
                assert_eq!(plan.geometry, Geometry::Quarter);
            }
        }
    }

    #[test]
    fn files_of_the_sensitivity_analysis_are_150_us_apart() {
        let case = case("");
        let c0 = (4.9e6f64 / 1404.0).sqrt();
        let interval = plan(&case, 1.0).file_interval(1.0 / c0).unwrap();
        assert!((interval * case.radius / c0 / 150e-6 - 1.0).abs() < 1e-9);
    }
}
