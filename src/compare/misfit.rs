//! Misfit: root-mean-square distance of a law's force from a simulated force-displacement curve.

use crate::contact::NormalLaw;
use crate::curve::{Impact, Sample};

/// Root-mean-square force error over F*, a mean over the displacement (not over samples, whose spacing is the
/// output's affair):
///
/// $$ \frac{1}{F^\ast} \sqrt{\frac{\int (F_{law}(\delta) - F)^2\ |d\delta|}{\int |d\delta|}} $$
///
/// Loading: first contact to the largest displacement, the law on its loading curve with its inertia, if it has any, at
/// the simulated rate. Unloading: from there to loss
/// of contact, the law on the branch it leaves the same largest displacement by. Trapezoidal rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// Over loading.
    pub loading: f64,
    /// Over unloading.
    pub unloading: f64,
    /// Over both.
    pub all: f64,
}

impl Misfit {
    /// Misfit of `law` for a sphere of `radius` (m) and `mass` (kg); `None` if the curve has fewer than two samples on a branch.
    #[must_use]
    pub fn of<L: NormalLaw>(law: &L, radius: f64, mass: f64, impact: &Impact) -> Option<Self> {
        let in_contact = |s: &&Sample| s.time_s <= impact.summary.contact_time_s;
        let turn = impact.curve.turning_point();
        let samples = &impact.curve.samples;
        let (rising, falling) = (samples.get(..=turn)?, samples.get(turn..)?);
        let inertia = law.inertia();
        let squared_rates = impact
            .curve
            .squared_speeds(impact.summary.velocity_m_s, mass);
        let mut history = L::History::default();
        let mut error = |sample: &Sample, squared_rate: f64| {
            let x = sample.displacement_m / radius;
            let force = law.force(x, &mut history) + inertia.force(x, squared_rate);
            let gap = (force * radius * radius - sample.force_n) / impact.summary.max_force_n;
            (sample.displacement_m, gap * gap)
        };
        let rising = rising.iter().zip(&squared_rates);
        let rising: Vec<_> = rising.map(|(s, rate)| error(s, *rate)).collect();
        let falling = falling.iter().take_while(in_contact);
        let falling: Vec<_> = falling.map(|s| error(s, 0.0)).collect();
        if rising.len() < 2 || falling.len() < 2 {
            return None;
        }
        let (loading, unloading) = (integral(&rising), integral(&falling));
        let both = (loading.0 + unloading.0, loading.1 + unloading.1);
        let root = |(square, path): (f64, f64)| (square / path).sqrt();
        Some(Self {
            loading: root(loading),
            unloading: root(unloading),
            all: root(both),
        })
    }
}

/// Integral of the second member over the first, and the length of the path.
fn integral(points: &[(f64, f64)]) -> (f64, f64) {
    points.windows(2).fold((0.0, 0.0), |(square, path), pair| {
        let step = (pair[1].0 - pair[0].0).abs();
        (square + 0.5 * (pair[0].1 + pair[1].1) * step, path + step)
    })
}
