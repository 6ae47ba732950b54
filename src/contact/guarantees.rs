//! Guarantees of a fitted law, looked at where a law is read: they follow from its constants in exact numbers, and this holds
//! them in those of the machine.

use super::NormalLaw;
use super::admissible::Inadmissible;
use super::elastoplastic::{DEEPEST, Elastoplastic};
use super::loading::Loading;

/// Largest flattenings looked at, between the departure and the end of a body.
const BRANCHES: i32 = 40;
/// Places on a branch that are looked at, over its largest flattening.
const PARTS: [f64; 8] = [0.999_999, 0.999, 0.99, 0.9, 0.7, 0.5, 0.2, 0.01];
/// Relative rounding that a force may have.
const ROUNDING: f64 = 1e-9;

/// That forces are finite and never tensile, loading rises, unloading lies below it, and a later branch below every earlier one,
/// so that no cycle yields energy.
///
/// # Errors
/// [`Inadmissible`] with the first flattening $\delta/R$ where one does not hold.
pub fn check<L: Loading>(law: &Elastoplastic<L>) -> Result<(), Inadmissible> {
    let departure = law.loading().departure() * law.units().flattening;
    let growth = (DEEPEST / departure)
        .max(1.0)
        .powf(1.0 / f64::from(BRANCHES));
    let mut early = departure;
    for _ in 0..BRANCHES {
        let late = early * growth;
        let place = |holds, x: f64, allowed| {
            Inadmissible::unless(holds, format!("force at delta/R = {x:e}"), x, allowed)
        };
        let highest = law.memory(late);
        let rises = loaded(law, late) >= loaded(law, early) && loaded(law, late).is_finite();
        place(rises, late, "must be finite and rise with flattening")?;
        for x in PARTS.map(|part| part * early) {
            let mut branches = [law.memory(early), highest];
            let [upper, lower] = branches.each_mut().map(|branch| law.force(x, branch));
            let [_, branch] = branches;
            place(lower >= 0.0, x, "must not be tensile in unloading")?;
            let below = upper <= loaded(law, x) * (1.0 + ROUNDING);
            place(below, x, "must not lie above loading in unloading")?;
            let apart = lower <= upper * (1.0 + ROUNDING);
            place(apart, x, "must not grow with the largest flattening before")?;
            let finite = law.stiffness(x, &branch).is_finite();
            place(finite, x, "must have a finite slope")?;
        }
        early = late;
    }
    Ok(())
}

/// Force of first loading.
fn loaded<L: Loading>(law: &Elastoplastic<L>, x: f64) -> f64 {
    law.force(x, &mut Default::default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::elastoplastic::YieldUnits;
    use crate::contact::loading::SoftenedHertz;
    use crate::contact::unloading::Unloading;

    const UNITS: YieldUnits = YieldUnits {
        flattening: 1e-3,
        force: 1e6,
    };

    fn law(unloading: Unloading) -> Elastoplastic<SoftenedHertz> {
        let loading = SoftenedHertz::new(1.0, 10.0, 1.0).unwrap();
        Elastoplastic::new(loading, unloading, UNITS, 0.1).unwrap()
    }

    #[test]
    fn the_guarantees_hold_to_the_ends_of_what_constants_may_be() {
        for c in [1e-4, 1.0, 1e6, 1e12] {
            for k in [1e-3, 0.6] {
                for (n_1, n_2) in [(-0.5, 0.0), (0.0, 0.0), (2.0, 30.0)] {
                    if let Ok(unloading) = Unloading::new(c, k, n_1, n_2) {
                        check(&law(unloading)).unwrap();
                    }
                }
            }
        }
    }

    #[test]
    fn a_residual_below_rounding_leaves_unloading_below_loading() {
        // so large a scale that no branch near the departure has a residual: Hertz's curve is not taken for it
        let law = law(Unloading::new(1e14, 1.0, 0.0, 0.0).unwrap());
        let mut branch = law.memory(5e-3);
        let unloading = law.force(4e-3, &mut branch);
        assert!(law.residual(&branch) < 1e-15);
        assert!(unloading <= law.force(4e-3, &mut law.memory(0.0)) * (1.0 + 1e-12));
        check(&law).unwrap();
    }
}
