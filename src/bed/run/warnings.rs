//! Warnings: what a user must know before the figures of a run are used.

use crate::bed::measures::series::{self, CLOSURE, HOPELESS};
use crate::bed::stages::Done;
use crate::law::AnyLaw;
use crate::unit::{engineering, significant};

/// Overlap over diameter above which a warning is given. At 0.05 the contact of two equal grains has a radius of 0.32 R by
/// Hertz, who takes it as small against R; contacts of one grain are then no longer apart.
const DEEP: f64 = 0.05;
/// Share of the work in contacts that let go below the range of the law, above which a warning is given: a restitution that is wrong
/// by a fifth there changes what the bed dissipates by less than half of the share, less than the account's own bound.
const BELOW: f64 = 0.01;

/// What must be known of a run; `laws` are those of its materials.
pub(super) fn warnings(run: &Done, laws: &[AnyLaw]) -> Vec<String> {
    let tally = &run.tally;
    let mut warnings = Vec::new();
    if tally.lost > 0 {
        warnings.push(format!(
            "{} grains were outside the room; they are still listed in the files",
            tally.lost
        ));
    }
    if tally.lost_bodies > 0 {
        warnings.push(format!(
            "{} free bodies were outside the room",
            tally.lost_bodies
        ));
    }
    if tally.beyond_validity > 0 {
        warnings.push(format!(
            "{} contacts at once were flattened beyond the range of the law: it was extrapolated",
            tally.beyond_validity
        ));
    }
    if tally.below_share() > BELOW {
        warnings.push(format!(
            "{} % of the work in yielded contacts that let go was in ones pressed less than in the slowest impact of the law ({}), up to {} at \
             once: how they rebound is extrapolated, and restitution may be far off; a law fitted to slower impacts, too, would know",
            significant(100.0 * tally.below_share(), 2),
            slowest(laws),
            tally.below_validity
        ));
    }
    if tally.max_overlap_ratio > DEEP {
        warnings.push(format!(
            "grains overlapped by up to {:.1} % of a diameter, past the {:.0} % up to which contacts are small: they influence each other there",
            100.0 * tally.max_overlap_ratio,
            100.0 * DEEP
        ));
    }
    warnings.extend(account(run));
    warnings.extend(run.feed.missing(run.bed.machine()));
    warnings
}

/// Slowest impacts of laws that have one, in words.
fn slowest(laws: &[AnyLaw]) -> String {
    let mut speeds: Vec<f64> = laws
        .iter()
        .filter_map(|law| Some(law.slowest()?.velocity))
        .collect();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let speeds: Vec<String> = speeds
        .into_iter()
        .map(|speed| engineering(speed, "m/s", 3))
        .collect();
    speeds.join(", ")
}

/// What is wrong with the account of energies.
fn account(run: &Done) -> Option<String> {
    let closure = series::closure(&run.rows);
    if closure < CLOSURE {
        return None;
    }
    let stopped = series::first_beyond(&run.rows, HOPELESS);
    let first = stopped.or_else(|| series::first_beyond(&run.rows, CLOSURE));
    let place = first.map_or(String::new(), |row| {
        let time = engineering(row.time_s, "s", 3);
        let what = match stopped {
            Some(_) => "the run was stopped",
            None => "that much first",
        };
        format!(" ({what} at {time}, in \"{}\")", row.stage)
    });
    Some(format!(
        "the energy account is off by {:.1} % of the turnover{place}, {:.0} % at most: the run has failed; take more steps a contact \
         (`time.steps_per_contact`, `time.rayleigh_fraction`)",
        100.0 * closure,
        100.0 * CLOSURE
    ))
}
