//! Oblique impacts of a grain in the bed: gross sliding and swinging springs in closed form, everything between against
//! equations of motion of its own.

use crate::collisions::{Bare, MATERIAL, RADIUS, Straight, thrown};
use impactlaw::contact::rebound::rebound;
use impactlaw::dem::force::effects::Law;
use impactlaw::dem::force::friction::Mindlin;
use impactlaw::material::Material;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::Vector;
use std::f64::consts::PI;

/// Grain under Hertz's and Mindlin's laws thrown obliquely on the floor; returns velocity and spin afterwards.
fn oblique(material: &Material, friction: f64, velocity: Vector) -> [Vector; 2] {
    let effects = Law::smooth().with(Mindlin::new(material, friction));
    thrown(effects, Hertz::of(material), material, velocity, 4000.0)
}

#[test]
fn a_grain_that_slides_through_the_impact_leaves_as_coulomb_says() {
    // sliding throughout needs tan(angle) > mu (1 + e) 7/2: dv_t = -mu (1 + e) v_n, R dw = 5/2 dv_t
    // (slow, because the lever arm R - delta is then R to 5 digits)
    let (mu, v_n, v_t) = (0.1, 1e-4, 2e-4);
    let [velocity, spin] = oblique(&MATERIAL, mu, Vector::new(v_t, 0.0, -v_n));
    let change = mu * 2.0 * v_n;
    assert!(
        (velocity.x - (v_t - change)).abs() < 1e-5 * v_t,
        "{velocity}"
    );
    assert!(
        (spin.y * RADIUS - 2.5 * change).abs() < 1e-5 * v_t,
        "{spin}"
    );
    assert!(velocity.y == 0.0 && spin.x == 0.0);
}

#[test]
fn a_yielding_grain_that_slides_through_leaves_as_a_rigid_body_with_coulomb_friction() {
    // Walton 1993, sliding: dv_t = -mu (1 + e) v_n, R dw = dv_t/K, K = I/(m R^2) = 2/5, and so for the point of contact
    // dv_s = -(1 + 1/K) mu (1 + e) v_n, whatever takes the normal energy: here yielding, e = 1/2
    let law = Bare {
        law: Straight {
            loading: 1e9,
            unloading: 4e9,
        },
        contact_radius: Some(0.002),
    };
    let (mu, v_n, v_t, e) = (0.2, 1e-4, 3e-4, 0.5);
    let effects = Law::smooth().with(Mindlin::new(&MATERIAL, mu));
    let velocity = Vector::new(v_t, 0.0, -v_n);
    let [velocity, spin] = thrown(effects, law, &MATERIAL, velocity, 20_000.0);
    let change = mu * (1.0 + e) * v_n;
    let found = [
        velocity.z - e * v_n,
        velocity.x - (v_t - change),
        RADIUS * spin.y - 2.5 * change,
    ];
    assert!(found.iter().all(|off| off.abs() < 1e-5 * v_n), "{found:?}");
}

#[test]
fn oblique_rebounds_keep_spin_about_the_contact_lose_energy_and_recoil_at_medium_angles() {
    let v_n = 1e-4;
    let mut recoiled = false;
    for tangent in [0.05, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0] {
        let v_t = tangent * v_n;
        let [velocity, spin] = oblique(&MATERIAL, 0.3, Vector::new(v_t, 0.0, -v_n));
        let about_contact = velocity.x + 0.4 * RADIUS * spin.y;
        assert!(
            (about_contact / v_t - 1.0).abs() < 1e-5,
            "{about_contact} {v_t}"
        );
        let energy = velocity.length_squared() + 0.4 * (RADIUS * spin.y).powi(2);
        assert!(
            energy < (v_n * v_n + v_t * v_t) * (1.0 + 1e-6),
            "tan {tangent}: {energy}"
        );
        recoiled |= velocity.x - RADIUS * spin.y < 0.0;
    }
    assert!(
        recoiled,
        "Maw, Barber and Fawcett: the contact point must swing back at some angle"
    );
}

/// A ball thrown obliquely on a rigid wall under Hertz's law and Mindlin's no-slip stiffness with Coulomb's limit, by
/// equations of motion of its own: velocity of the centre along the wall and of the ball's surface there, after the impact.
///
/// $$ m \ddot z = F, \quad m \dot v = T, \quad \dot u = T \left(\frac{1}{m} + \frac{r^2}{I}\right), \quad
/// \dot T = -k_t u + T \min(0, \dot k_t / k_t), \quad |T| \le \mu F $$
///
/// with $k_t = 8 G a/(2 - \nu)$ and $r = R - \delta$.
fn mindlin_impact(friction: f64, v_t: f64, v_n: f64) -> [f64; 2] {
    let mass = MATERIAL.sphere_mass(RADIUS);
    let inertia = 0.4 * mass * RADIUS * RADIUS;
    let hertz = 4.0 / 3.0 * MATERIAL.contact_modulus() * RADIUS.sqrt();
    let shear = MATERIAL.young_modulus / (2.0 * (1.0 + MATERIAL.poisson_ratio));
    let spring =
        |overlap: f64| 8.0 * shear / (2.0 - MATERIAL.poisson_ratio) * (RADIUS * overlap).sqrt();
    let time = rebound(&Hertz::of(&MATERIAL), RADIUS, mass, v_n).contact_time;
    let dt = time / 400_000.0;
    let (mut overlap, mut rate) = (0.0, v_n);
    let (mut centre, mut surface, mut pull, mut stiffness) = (v_t, v_t, 0.0f64, 0.0);
    loop {
        rate -= dt * hertz * f64::powf(overlap, 1.5) / mass;
        overlap += dt * rate;
        if overlap <= 0.0 {
            return [centre, surface];
        }
        let now = spring(overlap);
        if now < stiffness {
            pull *= now / stiffness;
        }
        stiffness = now;
        let limit = friction * hertz * f64::powf(overlap, 1.5);
        pull = (pull - now * surface * dt).clamp(-limit, limit);
        let arm = RADIUS - overlap;
        centre += dt * pull / mass;
        surface += dt * pull * (1.0 / mass + arm * arm / inertia);
    }
}

#[test]
fn oblique_rebounds_follow_mindlin_and_coulomb_from_sticking_to_sliding() {
    let (friction, v_n) = (0.3, 1e-4);
    let mut worst = 0.0f64;
    for tangent in [0.05, 0.2, 0.5, 0.8, 1.2, 1.6, 2.0, 3.0] {
        let v_t = tangent * v_n;
        let [velocity, spin] = oblique(&MATERIAL, friction, Vector::new(v_t, 0.0, -v_n));
        let [centre, surface] = mindlin_impact(friction, v_t, v_n);
        let ours = [velocity.x, velocity.x - RADIUS * spin.y];
        println!(
            "tan {tangent}: centre {:.6} {:.6}, surface {:.6} {:.6}",
            ours[0] / v_n,
            centre / v_n,
            ours[1] / v_n,
            surface / v_n
        );
        worst = worst.max((ours[0] - centre).abs() / v_n);
        worst = worst.max((ours[1] - surface).abs() / v_n);
    }
    assert!(worst < 2e-4, "off by {worst} of the speed of approach");
}

#[test]
fn a_grain_that_sticks_to_linear_springs_turns_back_as_their_periods_say() {
    // both springs linear: the slip swings as cos(w t), w^2 = 7 k_t / 2 m, while the contact lasts half a period of
    // sqrt(k_n / m), so that e_t = -cos(pi sqrt(7 k_t / 2 k_n)) (Schaefer, Dippel and Wolf 1996, without friction's limit)
    let law = Straight {
        loading: 1e9,
        unloading: 1e9,
    };
    let normal = 1e9 * RADIUS;
    let shear = MATERIAL.young_modulus / (2.0 * (1.0 + MATERIAL.poisson_ratio));
    // contact radius over R
    let constant = 0.002;
    let tangential = 8.0 * shear / (2.0 - MATERIAL.poisson_ratio) * constant * RADIUS;
    let law = Bare {
        law,
        contact_radius: Some(constant),
    };
    let effects = Law::smooth().with(Mindlin::new(&MATERIAL, 1e9));
    let (v_t, v_n) = (1e-5, 1e-5);
    let velocity = Vector::new(v_t, 0.0, -v_n);
    let [velocity, spin] = thrown(effects, law, &MATERIAL, velocity, 20_000.0);
    let slip = velocity.x - RADIUS * spin.y;
    let closed_form = (PI * (3.5 * tangential / normal).sqrt()).cos();
    assert!(
        (slip / v_t - closed_form).abs() < 1e-3,
        "{} against {closed_form}",
        slip / v_t
    );
}
