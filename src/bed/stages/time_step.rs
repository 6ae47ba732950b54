//! Time step: the largest that follows the stiffest contact, the waves through a grain, the fastest grain and the fastest
//! body.

use crate::Result;
use crate::bed::filling::memory::grains;
use crate::bed::scene::{Change, Duration, GrainMaterial, Group, Scene, Stage, TimeStep, Until};
use crate::contact::{LawVisitor, NormalLaw};
use crate::dem::bodies::belt::Belt;
use crate::dem::bodies::motion::Motion;
use crate::dem::bodies::{Body, Mobility};
use crate::dem::dynamics::state::Packing;
use crate::dem::force::damping::{USUAL_STEPS, steps_for};
use crate::law::AnyLaw;
use crate::material::Material;
use crate::unit::{engineering, significant};
use std::f64::consts::PI;

/// Largest way by which a grain and another or a body may close in one step, over the radius.
const LONGEST_WAY: f64 = 0.1;

/// Duration (s) of the elastic impact of two equal grains of `radius` (m) at the relative `speed` (m/s).
///
/// $$ t_c = 2.868 \left( \frac{m^{\ast 2}}{R^\ast E^{\ast 2} v} \right)^{1/5}, \quad m^\ast = \tfrac{m}{2},\quad R^\ast = \tfrac{R}{2},\quad
/// E^\ast = \frac{E}{2 (1 - \nu^2)} $$
///
/// Source: Johnson 1985, section 11.4. A contact that yields is softer while it loads, and lasts longer.
///
/// ```
/// use impactlaw::{bed::stages::time_step::impact_time, material::Material};
/// let glass = Material { density: 2500.0, young_modulus: 5e7, poisson_ratio: 0.3, flow: None };
/// // 2.868 * ((5.236e-6)^2 / (5e-4 * (2.747e7)^2 * 1))^0.2 = 1.071e-4 s
/// assert!((impact_time(&glass, 1e-3, 1.0) - 1.071e-4).abs() < 1e-7);
/// ```
#[must_use]
pub fn impact_time(material: &Material, radius: f64, speed: f64) -> f64 {
    let (mass, modulus) = (
        0.5 * material.sphere_mass(radius),
        0.5 * material.contact_modulus(),
    );
    2.868 * (mass * mass / (0.5 * radius * modulus * modulus * speed)).powf(0.2)
}

/// Depth over radius to which a grain of `material` flattens elastically where it meets a rigid body at `speed` (m/s),
/// contacts `softening` times as stiff as the material's; twice as fast, it is the overlap of two grains over their
/// diameter.
///
/// $$ \frac{\delta^\ast}{R} = \left( \frac{5 \pi}{4} \frac{\rho v^2}{E^\ast} \right)^{2/5} $$
///
/// Source: Johnson 1985, section 11.4: $\tfrac12 m v^2 = \tfrac{8}{15} E^\ast \sqrt{R}\ \delta^{5/2}$. A grain that yields goes
/// deeper.
///
/// ```
/// use impactlaw::{bed::stages::time_step::flattening, material::Material};
/// let glass = Material { density: 2500.0, young_modulus: 7e6, poisson_ratio: 0.25, flow: None };
/// // (3.927 * 2500 * 80^2 / 7.467e6)^0.4 = 2.34: no contact law holds there
/// assert!((flattening(&glass, 80.0, 1.0) - 2.34).abs() < 5e-3);
/// ```
#[must_use]
pub fn flattening(material: &Material, speed: f64, softening: f64) -> f64 {
    let ratio = material.density * speed * speed / (softening * material.contact_modulus());
    (1.25 * PI * ratio).powf(0.4)
}

/// Visits a law for the power of its first loading.
struct FirstPower;

/// Flattening over R so small that a law is what it is from the first touch on.
const FIRST: f64 = 1e-6;

impl LawVisitor for FirstPower {
    type Output = f64;

    fn visit<L: NormalLaw>(self, law: &L) -> f64 {
        let state = law.state(FIRST, &mut L::History::default());
        state.stiffness * state.depth / state.force
    }
}

/// Least steps a contact that the restitutions of a scene ask for under `laws`.
///
/// # Errors
/// Those of the laws.
pub fn steps_under(scene: &Scene, laws: &[AnyLaw]) -> Result<f64> {
    let pairs = scene.pairs.iter().map(|pair| &pair.contact);
    let asked = pairs
        .chain([&scene.contact])
        .filter_map(|contact| contact.restitution);
    let least = asked.fold(1.0, f64::min);
    let mut steps = USUAL_STEPS;
    for law in laws {
        steps = steps.max(steps_for(least, law.visit(FirstPower)?));
    }
    Ok(steps)
}

/// What bounds the time step of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    settings: TimeStep,
    /// Least steps a contact.
    steps: f64,
    /// Shortest impact of two grains at 1 m/s and full stiffness, s.
    impact: f64,
    /// Shortest Rayleigh time of a grain at full stiffness, s.
    rayleigh: f64,
    /// Smallest radius, m.
    smallest: f64,
    /// Deepest flattening of a grain that meets a rigid body at 1 m/s and full stiffness, over its radius.
    flattening: f64,
}

impl Limits {
    /// Limits for groups of grains, their materials among `materials`, with at least `steps` a contact where the scene does not
    /// say.
    #[must_use]
    pub fn of(
        settings: TimeStep,
        groups: &[Group],
        materials: &[GrainMaterial],
        steps: f64,
    ) -> Self {
        let smallest = |group: &Group| group.sizes.limits()[0];
        let least = |value: &dyn Fn(&Group) -> f64| {
            let values = groups.iter().map(value);
            values.fold(f64::INFINITY, f64::min)
        };
        let material = |group: &Group| &materials[group.material].material;
        Self {
            settings,
            steps: settings.steps_per_contact.unwrap_or(steps),
            impact: least(&|group| impact_time(material(group), smallest(group), 1.0)),
            rayleigh: least(&|group| material(group).rayleigh_time(smallest(group))),
            smallest: least(&smallest),
            flattening: -least(&|group| -flattening(material(group), 1.0, 1.0)),
        }
    }

    /// Largest time step (s) by the Rayleigh time, for contacts `softening` times as stiff as the material's; the
    /// scene's own step where it is smaller.
    #[must_use]
    pub fn rayleigh(&self, softening: f64) -> f64 {
        let limit = self.settings.rayleigh_fraction * self.rayleigh / softening.sqrt();
        self.settings.step.map_or(limit, |step| limit.min(step))
    }

    /// Depth over radius to which a grain may flatten at this speed (m/s) against a body.
    #[must_use]
    pub fn flattening(&self, softening: f64, speed: f64) -> f64 {
        self.flattening * (speed * speed / softening).powf(0.4)
    }

    /// Time step (s) for the present state, the fastest point of a body at `body_speed` (m/s).
    ///
    /// # Errors
    /// The reason why the scene's own step is too large for it, with the largest that would do.
    pub fn step(
        &self,
        softening: f64,
        packing: &Packing,
        body_speed: f64,
    ) -> std::result::Result<f64, String> {
        // contacts that are there, and those the fastest may begin before the next look: two grains head on, or a grain
        // on a body; a body's impact at a speed lasts as long as that of two grains at twice the speed
        let speed = packing.max_speed + body_speed;
        let coming = self.impact / (softening * softening * 2.0 * speed).powf(0.2);
        let contact = packing.contact_time.min(coming) / self.steps;
        let way = LONGEST_WAY * self.smallest / speed;
        let rayleigh = self.settings.rayleigh_fraction * self.rayleigh / softening.sqrt();
        let limit = rayleigh.min(contact).min(way);
        let Some(step) = self.settings.step else {
            return Ok(limit);
        };
        if step <= limit {
            return Ok(step);
        }
        let why = if limit == contact {
            "the stiffest contact"
        } else if limit == way {
            "the fastest grain or body"
        } else {
            "the Rayleigh time"
        };
        Err(format!(
            "`time.step` is too large: {why} allows at most {}; reduce it, or leave it out to have it follow the bed",
            engineering(limit, "s", 3)
        ))
    }
}

/// That no body and no grain is told, or sent off, so fast that every grain it hits would be flattened by its whole radius: far beyond
/// all contact laws, whatever the damping; and that the scene's own time step is within the Rayleigh limit.
///
/// # Errors
/// [`crate::Error::Value`] with the largest speed or step allowed.
pub fn check(scene: &Scene) -> Result<()> {
    check_speeds(scene)?;
    check_lengths(scene)?;
    let Some(step) = scene.time.step else {
        return Ok(());
    };
    let following = TimeStep {
        step: None,
        ..scene.time
    };
    let limit = Limits::of(following, &scene.groups, &scene.materials, USUAL_STEPS)
        .rayleigh(scene.contact.softening());
    if step <= limit {
        return Ok(());
    }
    let allowed = format!(
        "must be at most {} ({} of the Rayleigh time of the smallest grain); reduce it, or leave it out to have it follow the bed",
        engineering(limit, "s", 3),
        scene.time.rayleigh_fraction
    );
    Err(scene.document.reject("time.step", allowed))
}

/// Time of a step for one grain on one core, s: 0.3 to 0.5 us are measured (`benches/step`).
const STEP: f64 = 0.4e-6;
/// Longest stage that is begun, s of one core: a month.
const LONGEST: f64 = 2.6e6;

/// How long a stage is, before its first step.
#[derive(Debug, Clone, PartialEq)]
pub struct Length {
    /// Name of the stage.
    pub stage: String,
    /// Key of the file that says it.
    key: String,
    /// Steps, each as long as Rayleigh waves allow: contacts and fast grains may ask for shorter ones. `None` for a piston, whose
    /// way is not known before.
    pub steps: Option<f64>,
    /// Whether a condition may end it earlier.
    pub may_end: bool,
    /// Time of one core, s.
    pub seconds: f64,
}

/// Lengths of the stages of a scene, and the number of its grains.
#[must_use]
pub fn lengths(scene: &Scene) -> (Vec<Length>, f64) {
    let grains = grains(scene);
    let limits = Limits::of(scene.time, &scene.groups, &scene.materials, USUAL_STEPS);
    let full = scene.contact.softening();
    let length = |(index, stage): (usize, &Stage)| {
        let (key, steps, may_end) = match stage {
            Stage::Settle {
                stiffness, longest, ..
            } => ("longest", Some(longest / limits.rayleigh(*stiffness)), true),
            Stage::Relax { steps } => ("steps", Some(*steps as f64), false),
            Stage::Compress { .. } | Stage::Unload { .. } => ("speed", None, false),
            Stage::Run(run) => {
                let may_end = run.until != Until::default();
                match run.longest {
                    Duration::Time(time) => {
                        ("duration", Some(time / limits.rayleigh(full)), may_end)
                    }
                    Duration::Steps(steps) => ("steps", Some(steps as f64), may_end),
                }
            }
        };
        Length {
            stage: stage.name().to_owned(),
            key: format!("stage[{index}].{key}"),
            steps,
            may_end,
            seconds: steps.unwrap_or(0.0) * grains * STEP,
        }
    };
    let stages = scene.stages.iter().enumerate();
    (stages.map(length).collect(), grains)
}

/// That no stage lasts longer than a month on one core, as one of a slip of a unit does; stages that a condition ends are
/// taken at their word.
///
/// # Errors
/// [`crate::Error::Value`] naming the stage, its steps and how long they take.
fn check_lengths(scene: &Scene) -> Result<()> {
    let (lengths, grains) = lengths(scene);
    let endless = |length: &&Length| !length.may_end && !(length.seconds <= LONGEST);
    match lengths.iter().find(endless) {
        None => Ok(()),
        Some(length) => {
            let allowed = format!(
                "must be shorter: {} steps of {} grains take some {} days of one core, and at most 30 are begun; check the units of the stage and the grains",
                significant(length.steps.unwrap_or(0.0), 2),
                significant(grains, 2),
                significant(length.seconds / 86400.0, 2)
            );
            Err(scene.document.reject(&length.key, allowed))
        }
    }
}

fn check_speeds(scene: &Scene) -> Result<()> {
    let softening = scene.contact.softening();
    let materials = scene
        .groups
        .iter()
        .map(|group| &scene.materials[group.material].material);
    let least = materials
        .map(|material| flattening(material, 1.0, softening))
        .fold(f64::INFINITY, f64::min);
    let fastest = least.powf(-1.25);
    for (key, speed) in told_speeds(scene) {
        if speed > fastest {
            let allowed = format!(
                "must be slower: at {} every grain that is hit would be flattened by more than its radius, where no contact law holds; at most {}, or stiffer grains",
                engineering(speed, "m/s", 3),
                engineering(fastest, "m/s", 3)
            );
            return Err(scene.document.reject(&key, allowed));
        }
    }
    Ok(())
}

/// Speed (m/s) that grains may get from a belt.
fn belt_speed(body: &Body, belt: &Belt) -> f64 {
    belt.fastest(body.solid.reach() + (body.centre - belt.about).length())
}

/// Largest speed (m/s) of each group of grains, of each body of a scene that has one, and of each that a stage gives one, with
/// its key.
fn told_speeds(scene: &Scene) -> Vec<(String, f64)> {
    let arm = |body: &Body, motion: &Motion| {
        // a plane has no end: without a turn its arm does not matter
        let off = motion
            .about
            .map_or(0.0, |about| (body.centre - about).length());
        let turns = motion.spin.length_squared() > 0.0;
        if turns { body.solid.reach() + off } else { 0.0 }
    };
    let mut speeds = Vec::new();
    for group in &scene.groups {
        let speed = group.velocity.length();
        speeds.push((format!("{}.velocity", group.key), speed));
    }
    for (index, body) in scene.bodies.iter().enumerate() {
        match &body.mobility {
            Mobility::Fixed => {}
            Mobility::Driven(motion) => {
                let speed = motion.fastest(arm(body, motion));
                speeds.push((format!("body[{index}].driven"), speed));
            }
            Mobility::Belt(belt) => {
                speeds.push((format!("body[{index}].belt"), belt_speed(body, belt)));
            }
            Mobility::Free(freedom) => {
                let speed = freedom.velocity.length();
                speeds.push((format!("body[{index}].free.velocity"), speed));
            }
        }
    }
    for (index, stage) in scene.stages.iter().enumerate() {
        match stage {
            Stage::Compress { speed, .. } | Stage::Unload { speed } => {
                speeds.push((format!("stage[{index}].speed"), *speed));
            }
            Stage::Run(run) => {
                for (at, order) in run.moves.iter().enumerate() {
                    let body = scene.bodies.iter().find(|body| body.name == order.body);
                    let key = |name| format!("stage[{index}].move[{at}].{name}");
                    match &order.change {
                        Change::Drive(motion) => {
                            let arm = body.map_or(0.0, |body| arm(body, motion));
                            speeds.push((key("driven"), motion.fastest(arm)));
                        }
                        Change::Belt(belt) => {
                            let speed = body.map_or(0.0, |body| belt_speed(body, belt));
                            speeds.push((key("belt"), speed));
                        }
                        Change::Remove | Change::Release => {}
                    }
                }
            }
            Stage::Settle { .. } | Stage::Relax { .. } => {}
        }
    }
    speeds
}
