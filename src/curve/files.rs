//! Files: figures of an impact as the thesis reads them, from the few output files of its runs.

use super::{Curve, Sample, Summary};
use serde::{Deserialize, Serialize};

/// Figures read from output files (table `files` of `summary.json`; the thesis, section 3.5.1).
///
/// A file holds the mean of the contact force over the steps in contact since the file before; the first with a force is the instant of
/// contact. Positions are means of those in a file and in the one before, displacements are counted from the one at the instant of
/// contact. So the force of a short contact is smeared out, and of the displacement lacks what the body has done by the first file.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FromFiles {
    /// Time from file to file, s.
    pub interval_s: f64,
    /// Files with a force.
    pub count: usize,
    /// Largest force, N.
    #[serde(rename = "max_force_N")]
    pub max_force_n: f64,
    /// Largest displacement, m.
    pub max_displacement_m: f64,
    /// First to last file with a force, s.
    pub contact_time_s: f64,
}

/// What stands in one file, or is taken from it: time since the first with a force (s), force (N), displacement (m).
pub type Row = [f64; 3];

/// Rows of the output files of an impact that are `interval` (s) apart, those with a force. At first contact the share `phase` of an
/// interval has passed since the last file: 0 with the wall as many intervals away as the thesis puts it.
#[must_use]
pub fn rows(curve: &Curve, summary: &Summary, interval: f64, phase: f64) -> Vec<Row> {
    let course = Course::of(curve, summary);
    let end = summary.contact_time_s;
    let first = interval * (1.0 - phase);
    let mut all: Vec<Row> = Vec::new();
    // a curve without a contact, or a time that is no number, has no files
    for k in 0.. {
        let to = first + f64::from(k) * interval;
        let from = to - interval;
        let (begin, until) = (from.max(0.0), to.min(end));
        if !(begin < end) || !(interval > 0.0) {
            break;
        }
        let force = (course.impulse(until) - course.impulse(begin)) / (until - begin);
        let position = 0.5 * (course.displacement(from) + course.displacement(to));
        all.push([to - first, force, position]);
    }
    let start = all.first().map_or(0.0, |row| row[2]);
    for row in &mut all {
        row[2] -= start;
    }
    all
}

impl FromFiles {
    /// What the files of an impact say.
    #[must_use]
    pub fn of(curve: &Curve, summary: &Summary, interval: f64, phase: f64) -> Self {
        let rows = rows(curve, summary, interval, phase);
        let largest = |k: usize| rows.iter().map(|row| row[k]).fold(f64::NAN, f64::max);
        FromFiles {
            interval_s: interval,
            count: rows.len(),
            max_force_n: largest(1),
            max_displacement_m: largest(2),
            contact_time_s: largest(0),
        }
    }
}

/// Impulse and displacement between the samples of a curve.
struct Course<'a> {
    samples: &'a [Sample],
    /// Ends of the intervals whose middles the samples are, and the impulse by then.
    ends: Vec<(f64, f64)>,
    velocity: f64,
    restitution: f64,
}

impl<'a> Course<'a> {
    fn of(curve: &'a Curve, summary: &Summary) -> Self {
        let mut ends = vec![(0.0, 0.0)];
        for s in &curve.samples {
            let (before, impulse) = ends[ends.len() - 1];
            let end = 2.0 * s.time_s - before;
            ends.push((end, impulse + s.force_n * (end - before)));
        }
        Course {
            samples: &curve.samples,
            ends,
            velocity: summary.velocity_m_s,
            restitution: summary.restitution,
        }
    }

    fn impulse(&self, time: f64) -> f64 {
        let k = self.ends.partition_point(|end| end.0 <= time);
        let before = self.ends[k.max(1) - 1];
        let next = self.ends.get(k).copied().unwrap_or(before);
        let share = if next.0 > before.0 {
            ((time - before.0) / (next.0 - before.0)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        before.1 + share * (next.1 - before.1)
    }

    /// Free flight before and after the contact.
    fn displacement(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return self.velocity * time;
        }
        let k = self.samples.partition_point(|s| s.time_s < time);
        let at = |k: usize| (self.samples[k].time_s, self.samples[k].displacement_m);
        let (before, next) = match (k, self.samples.len()) {
            (_, 0) => return self.velocity * time,
            (0, _) => ((0.0, 0.0), at(0)),
            (k, n) if k == n => {
                let (last, there) = at(n - 1);
                return there - self.restitution * self.velocity * (time - last);
            }
            (k, _) => (at(k - 1), at(k)),
        };
        before.1 + (next.1 - before.1) * (time - before.0) / (next.0 - before.0)
    }
}
