//! Fall of a sphere from rest through still air: what the tester does without a vacuum.

use super::{Air, GRAVITY, Particle};
use std::f64::consts::PI;

/// Share of a relaxation time, and of the time of the whole fall in a vacuum, that a step takes.
const STEP: f64 = 0.005;
/// Share of gravity below which what is left of the acceleration changes nothing any more.
const STEADY: f64 = 1e-9;

/// Speed, m/s, after a fall over `height`, m, with buoyancy and the drag of Schiller and Naumann (1933),
/// $C_D = 24/Re\ (1 + 0.15 Re^{0.687})$ to Re = 1000 and 0.44 beyond.
#[must_use]
pub fn fall(particle: &Particle, height: f64, air: &Air) -> f64 {
    let mass = particle.density * PI / 6.0 * particle.diameter.powi(3);
    let pull = GRAVITY * (1.0 - air.density / particle.density);
    let whole = (2.0 * height / pull).sqrt();
    let (mut speed, mut way) = (0.0f64, 0.0);
    loop {
        // drag over speed and mass, held over a step: each is then solved exactly
        let rate = drag(speed, particle.diameter, air) / mass;
        if (pull - rate * speed).abs() < STEADY * pull {
            return speed;
        }
        let step = STEP * whole.min(rate.recip());
        let steady = pull / rate;
        let left = (-rate * step).exp();
        let ended = steady + (speed - steady) * left;
        let gone = 0.5 * (speed + ended) * step;
        if way + gone >= height {
            return speed + (ended - speed) * (height - way) / gone;
        }
        (speed, way) = (ended, way + gone);
    }
}

/// Drag over speed, N s/m; at rest that of Stokes.
fn drag(speed: f64, diameter: f64, air: &Air) -> f64 {
    let reynolds = speed * diameter / air.kinematic();
    let over_stokes = match reynolds < 1000.0 {
        true => 1.0 + 0.15 * reynolds.powf(0.687),
        false => 0.44 / 24.0 * reynolds,
    };
    3.0 * PI * air.viscosity * diameter * over_stokes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heavy_ball_falls_as_in_a_vacuum_and_dust_at_the_speed_of_stokes() {
        let ball = Particle {
            diameter: 20e-3,
            density: 7800.0,
        };
        let free = (2.0 * GRAVITY * 0.401f64).sqrt();
        let speed = fall(&ball, 0.401, &Air::USUAL);
        assert!((speed / free - 1.0).abs() < 2e-3, "{speed} {free}");
        let dust = Particle {
            diameter: 1e-6,
            density: 2700.0,
        };
        let stokes = (2700.0 - 1.204) * GRAVITY * 1e-12 / (18.0 * Air::USUAL.viscosity);
        let speed = fall(&dust, 0.401, &Air::USUAL);
        assert!((speed / stokes - 1.0).abs() < 1e-3, "{speed} {stokes}");
    }

    #[test]
    fn drag_that_grows_with_the_square_gives_the_closed_form() {
        // above Re = 1000 drag is quadratic: v^2 = v_t^2 (1 - exp(-2 g z / v_t^2))
        let ball = Particle {
            diameter: 40e-3,
            density: 100.0,
        };
        let air = Air::USUAL;
        let pull = GRAVITY * (1.0 - air.density / ball.density);
        let terminal2 = 4.0 * ball.density * ball.diameter * pull / (3.0 * 0.44 * air.density);
        let closed = (terminal2 * (1.0 - (-2.0 * pull * 2.0 / terminal2).exp())).sqrt();
        let speed = fall(&ball, 2.0, &air);
        assert!((speed / closed - 1.0).abs() < 5e-3, "{speed} {closed}");
    }

    #[test]
    fn a_solder_ball_falls_at_nearly_the_speed_the_thesis_names() {
        let ball = Particle {
            diameter: 760e-6,
            density: 7274.0,
        };
        let speed = fall(&ball, 0.401, &Air::USUAL);
        assert!((2.7..2.81).contains(&speed), "{speed}");
    }
}
