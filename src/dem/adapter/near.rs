//! Near subjects: which bodies under a law touch each other, where, and how they move there.

use crate::contact::NormalLaw;
use crate::dem::adapter::{Key, Ruled, Subject, key};
use crate::dem::bodies::touching::closest;
use crate::dem::force::effects::ContactLaw;
use crate::dem::force::meeting::{Course, Meeting, over_surface};
use parry3d::math::Vector;
use parry3d::query;
use rapier3d::dynamics::RigidBody;
use rapier3d::pipeline::PhysicsWorld;

/// Two subjects near each other; the first is a ball if either is.
#[derive(Clone, Copy)]
pub(super) struct Near {
    pub first: Subject,
    pub second: Subject,
    /// From the second to the first.
    pub normal: Vector,
    /// The same a step before; the present one where they were apart.
    pub before: Vector,
    pub overlap: f64,
    pub point: Vector,
}

impl<L: NormalLaw, C: ContactLaw> Ruled<L, C> {
    /// Pairs that touch, or did a step ago, in the order of their names.
    pub(super) fn near(&self, world: &PhysicsWorld) -> Vec<Near> {
        let mut pairs: Vec<[Key; 2]> = world
            .narrow_phase
            .contact_pairs()
            .map(|pair| [key(pair.collider1), key(pair.collider2)])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .filter(|pair| pair.iter().all(|name| self.subjects.contains_key(name)))
            .chain(self.touching.keys().copied())
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
            .into_iter()
            .filter_map(|names| self.place(world, names))
            .collect()
    }

    /// How two subjects stand to each other; `None` when they are apart and were so before.
    fn place(&self, world: &PhysicsWorld, names: [Key; 2]) -> Option<Near> {
        let [mut first, mut second] =
            [self.subjects.get(&names[0])?, self.subjects.get(&names[1])?];
        if second.ball && !first.ball || first.radius.is_infinite() {
            (first, second) = (second, first);
        }
        let [a, b] = [first, second].map(|subject| world.colliders.get(subject.collider));
        let (a, b) = (a?, b?);
        let held = self.touching.get(&names);
        let near = |normal: Vector, overlap: f64, point: Vector| Near {
            first: *first,
            second: *second,
            normal,
            before: held.map_or(normal, |held| held.normal),
            overlap,
            point,
        };
        let found = if first.ball && second.ball {
            let line = a.translation() - b.translation();
            let distance = line.length();
            let normal = line / distance;
            let overlap = first.radius + second.radius - distance;
            Some(near(
                normal,
                overlap,
                a.translation() - normal * first.radius,
            ))
        } else if first.ball {
            let centre = b.position().inverse_transform_point(a.translation());
            closest(b.shape(), centre, first.radius).map(|touch| {
                let normal = b.position().transform_vector(touch.normal);
                let point = a.translation() - normal * touch.distance;
                near(normal, first.radius - touch.distance, point)
            })
        } else {
            let contact = query::contact(a.position(), a.shape(), b.position(), b.shape(), 0.0);
            contact.ok().flatten().map(|contact| {
                let point = 0.5 * (contact.point1 + contact.point2);
                near(contact.normal2, -contact.dist, point)
            })
        };
        match (found, held) {
            (Some(found), _) if found.overlap > 0.0 => Some(found),
            (_, Some(held)) => Some(near(
                held.normal,
                0.0,
                a.translation() - held.normal * first.radius.min(f64::MAX),
            )),
            _ => None,
        }
    }
}

/// Kinematics of two subjects: of the centres for balls, of the points that touch for everything else.
pub(super) fn meeting(world: &PhysicsWorld, near: &Near, dt: f64) -> Meeting {
    let [a, b] = [near.first.body, near.second.body].map(|body| world.bodies.get(body));
    let inverse = |body: Option<&RigidBody>| match body {
        Some(body) if body.is_dynamic() => 1.0 / body.mass(),
        _ => 0.0,
    };
    let course = |body: Option<&RigidBody>| Course {
        centre: body.map_or(Vector::ZERO, RigidBody::center_of_mass),
        velocity: body.map_or(Vector::ZERO, RigidBody::linvel),
        spin: body.map_or(Vector::ZERO, RigidBody::angvel),
    };
    let centre = |body: Option<&RigidBody>, subject: &Subject| {
        let ball = world.colliders.get(subject.collider);
        let (place, at) = body
            .zip(ball)
            .map_or_else(Default::default, |(body, ball)| {
                let place = ball.translation();
                (place, body.velocity_at_point(place))
            });
        Course {
            centre: place,
            velocity: at,
            spin: body.map_or(Vector::ZERO, RigidBody::angvel),
        }
    };
    let (first, second) = (&near.first, &near.second);
    let radii = [near.first.radius, near.second.radius];
    let normals = [near.normal, near.before];
    let under = course(b);
    let then = under.halfway(dt);
    let at = |point: Vector, _: Vector| under.velocity + under.spin.cross(point - then);
    let over = |grain: &Course, distance: f64| over_surface(grain, at, normals, distance, dt);
    let ([middle, velocity], spins) = match (first.ball, second.ball) {
        (true, true) => {
            let (a, b) = (centre(a, first), centre(b, second));
            let velocity = a.velocity - b.velocity;
            let turn = velocity * (0.5 * dt / (radii[0] + radii[1] - near.overlap));
            ([near.normal - turn, velocity], [a.spin, b.spin])
        }
        (true, false) => {
            let a = centre(a, first);
            // the turning of a surface is in the velocity of its point
            let spin = match radii[1].is_finite() {
                true => Vector::ZERO,
                false => under.spin,
            };
            (over(&a, radii[0] - near.overlap), [a.spin, spin])
        }
        _ => {
            let at_point = |body: Option<&RigidBody>| {
                body.map_or(Vector::ZERO, |body| body.velocity_at_point(near.point))
            };
            let middle = (near.normal + near.before).normalize_or(near.normal);
            ([middle, at_point(a) - at_point(b)], [Vector::ZERO; 2])
        }
    };
    Meeting {
        overlap: near.overlap,
        normal: near.normal,
        middle,
        velocity,
        spins,
        radii,
        materials: [0; 2],
        inverse_mass: inverse(a) + inverse(b),
        dt,
    }
}
