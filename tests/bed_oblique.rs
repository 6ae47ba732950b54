//! Oblique impacts of a grain in the bed: gross sliding and swinging springs in closed form, everything between against
//! equations of motion of its own.

mod two_bodies;

use impactlaw::bed::bodies::Mobility;
use impactlaw::bed::friction::Mindlin;
use impactlaw::bed::grains::Grains;
use impactlaw::bed::law::Law;
use impactlaw::contact::NormalLaw;
use impactlaw::contact::pair::{Flat, Twins};
use impactlaw::contact::rebound::rebound;
use impactlaw::theory::hertz::Hertz;
use parry3d::math::Vector;
use std::f64::consts::PI;
use two_bodies::{MATERIAL, RADIUS, Straight, bed, collide, floor};

/// Contact radius over R of a [`Constant`] law.
const CONSTANT_RADIUS: f64 = 0.002;

/// A law whose contacts have one radius.
#[derive(Debug, Clone)]
struct Constant<L>(L);

impl<L: NormalLaw> NormalLaw for Constant<L> {
    type History = L::History;

    fn force(&self, x: f64, history: &mut L::History) -> f64 {
        self.0.force(x, history)
    }

    fn stiffness(&self, x: f64, history: &L::History) -> f64 {
        self.0.stiffness(x, history)
    }

    fn elastic_energy(&self, x: f64, history: &L::History) -> f64 {
        self.0.elastic_energy(x, history)
    }

    fn contact_radius(&self, _: f64, _: &L::History) -> Option<f64> {
        Some(CONSTANT_RADIUS)
    }

    fn valid_to(&self) -> f64 {
        f64::INFINITY
    }
}

/// Grain with a Mindlin law thrown obliquely on the floor; returns velocity and spin afterwards.
fn oblique(friction: f64, velocity: Vector) -> (Vector, Vector) {
    let effects = Law::new((), Mindlin::new(&MATERIAL, friction), ());
    let law = Hertz::of(&MATERIAL);
    let mut grains = Grains::default();
    grains.add(
        Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-9)),
        RADIUS,
        MATERIAL.density,
    );
    grains.motions[0].velocity = velocity;
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), velocity.z.abs()).contact_time;
    let mut bed = bed(
        effects,
        Twins(law),
        Flat(law),
        grains,
        floor(Mobility::Fixed),
        time / 4000.0,
    );
    collide(&mut bed);
    (bed.grains.motions[0].velocity, bed.grains.spins[0].rate)
}

#[test]
fn a_grain_that_slides_through_the_impact_leaves_as_coulomb_says() {
    // sliding throughout needs tan(angle) > mu (1 + e) 7/2: dv_t = -mu (1 + e) v_n, R dw = 5/2 dv_t
    // (slow, because the lever arm R - delta is then R to 5 digits)
    let (mu, v_n, v_t) = (0.1, 1e-4, 2e-4);
    let (velocity, spin) = oblique(mu, Vector::new(v_t, 0.0, -v_n));
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
fn oblique_rebounds_keep_spin_about_the_contact_lose_energy_and_recoil_at_medium_angles() {
    let v_n = 1e-4;
    let mut recoiled = false;
    for tangent in [0.05, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0] {
        let v_t = tangent * v_n;
        let (velocity, spin) = oblique(0.3, Vector::new(v_t, 0.0, -v_n));
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
        let (velocity, spin) = oblique(friction, Vector::new(v_t, 0.0, -v_n));
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
    let constant = Constant(law);
    let tangential = 8.0 * shear / (2.0 - MATERIAL.poisson_ratio) * CONSTANT_RADIUS * RADIUS;
    let effects = Law::new((), Mindlin::new(&MATERIAL, 1e9), ());
    let mut grains = Grains::default();
    let place = Vector::new(0.0, 0.0, RADIUS * (1.0 + 1e-12));
    grains.add(place, RADIUS, MATERIAL.density);
    let (v_t, v_n) = (1e-5, 1e-5);
    grains.motions[0].velocity = Vector::new(v_t, 0.0, -v_n);
    let time = rebound(&law, RADIUS, MATERIAL.sphere_mass(RADIUS), v_n).contact_time;
    let dt = time / 20_000.0;
    let floor = floor(Mobility::Fixed);
    let mut bed = bed(effects, Twins(law), Flat(constant), grains, floor, dt);
    collide(&mut bed);
    let slip = bed.grains.motions[0].velocity.x - RADIUS * bed.grains.spins[0].rate.y;
    let closed_form = (PI * (3.5 * tangential / normal).sqrt()).cos();
    assert!(
        (slip / v_t - closed_form).abs() < 1e-3,
        "{} against {closed_form}",
        slip / v_t
    );
}
