//! Crowd: grains with several surfaces near them; what such surfaces share is touched once, under one history.

use super::family::{Family, SAME_CONTACT, Situation};
use super::member::{ALONE, Member, Turnover};
use crate::dem::bodies::machine::Surface;
use crate::dem::bodies::touching::{FLUSH, Scratch, Touch, Touches};
use crate::dem::force::effects::ContactLaw;
use parry3d::math::Vector;
use parry3d::query::Ray;
use rayon::prelude::*;

/// Members up to which one thread does it all.
const SMALL: usize = 64;
/// All members, those of one grain side by side.
#[derive(Debug, Default)]
pub(in crate::dem) struct Crowd {
    pub(in crate::dem) members: Vec<Member>,
}

/// A touched point of a grain.
#[derive(Clone, Copy)]
struct Point {
    member: usize,
    at: usize,
    /// As seen from the world.
    touch: Touch,
    /// It belongs to the contact of a nearer point.
    is_part: bool,
}

/// A contact that goes on at another surface: family (whether of meshes) and patch, from and to.
type Move = [(bool, usize); 2];

impl Crowd {
    /// Finds the grains with several candidates, and gives each of those its seat.
    pub(super) fn seat<C: ContactLaw, const K: usize>(
        solids: &mut Family<C, 1>,
        meshes: &mut Family<C, K>,
    ) -> Self {
        let mut members = Vec::new();
        solids.seats = vec![ALONE; solids.candidates.len()];
        meshes.seats = vec![ALONE; meshes.candidates.len()];
        for grain in 1..solids.start.len() {
            let row = |start: &[u32]| start[grain - 1] as usize..start[grain] as usize;
            let (of_solids, of_meshes) = (row(&solids.start), row(&meshes.start));
            if of_solids.len() + of_meshes.len() < 2 {
                continue;
            }
            let mut take = |is_mesh: bool, candidate: usize, pair: [u32; 2]| {
                members.push(Member {
                    grain: pair[0],
                    surface: pair[1],
                    candidate: candidate as u32,
                    is_mesh,
                    shares: false,
                    touches: Touches::default(),
                });
                members.len() as u32 - 1
            };
            for at in of_solids {
                solids.seats[at] = take(false, at, solids.candidates[at]);
            }
            for at in of_meshes {
                meshes.seats[at] = take(true, at, meshes.candidates[at]);
            }
        }
        Self { members }
    }

    /// Finds the touched points of every member, one for each surface of a grain.
    pub(super) fn find<C: ContactLaw>(&mut self, situation: &Situation<C>) {
        let same = |a: &Member, b: &Member| a.grain == b.grain;
        if self.members.len() <= SMALL {
            let mut space = Default::default();
            self.members
                .chunk_by_mut(same)
                .for_each(|row| meet(situation, row, &mut space));
        } else {
            self.members
                .par_chunk_by_mut(same)
                .for_each_init(Default::default, |space, row| meet(situation, row, space));
        }
    }

    /// Contacts that go on at another surface than before.
    pub(super) fn moves<C: ContactLaw, const K: usize>(
        &self,
        situation: &Situation<C>,
        solids: &Family<C, 1>,
        meshes: &Family<C, K>,
    ) -> Vec<Move> {
        let mut moves = Vec::new();
        for row in self.members.chunk_by(|a, b| a.grain == b.grain) {
            if !row.iter().any(|member| member.shares) {
                continue;
            }
            let turnover = |member: &Member| {
                let body = &situation.machine.surfaces[member.surface as usize];
                let (at, touches) = (member.candidate as usize, &member.touches);
                match member.is_mesh {
                    true => meshes.turnover(at, touches, body),
                    false => solids.turnover(at, touches, body),
                }
            };
            let mut turnovers: Vec<Turnover> = row.iter().map(turnover).collect();
            for to in 0..row.len() {
                for begun in std::mem::take(&mut turnovers[to].beginning) {
                    let ended = |from: usize| turnovers[from].ending.iter().map(move |p| (from, p));
                    let best = (0..row.len())
                        .filter(|&from| from != to && row[from].shares)
                        .flat_map(ended)
                        .map(|(from, place)| (place.normal.dot(begun.normal), from, place.patch))
                        .filter(|(likeness, ..)| *likeness > SAME_CONTACT)
                        .max_by(|a, b| a.0.total_cmp(&b.0));
                    if let Some((_, from, patch)) = best {
                        turnovers[from].ending.retain(|place| place.patch != patch);
                        let ends = [(row[from].is_mesh, patch), (row[to].is_mesh, begun.patch)];
                        moves.push(ends);
                    }
                }
            }
        }
        moves
    }
}

/// Finds the touched points of one grain.
fn meet<C: ContactLaw>(
    situation: &Situation<C>,
    row: &mut [Member],
    (scratch, points): &mut (Scratch, Vec<Point>),
) {
    let mut touched = 0;
    for member in &mut *row {
        let pair = [member.grain, member.surface].map(|index| index as usize);
        member.shares = false;
        member.touches = situation.touches(pair, member.is_mesh, scratch);
        touched += usize::from(!member.touches.as_slice().is_empty());
    }
    if touched < 2 {
        return;
    }
    points.clear();
    for (index, member) in row.iter().enumerate() {
        let body = &situation.machine.surfaces[member.surface as usize];
        let seen = |touch: &Touch| Touch {
            normal: body.pose.transform_vector(touch.normal),
            ..*touch
        };
        let of_member = member.touches.as_slice().iter().enumerate();
        points.extend(of_member.map(|(at, touch)| Point {
            member: index,
            at,
            touch: seen(touch),
            is_part: false,
        }));
    }
    points.sort_by(|a, b| a.touch.distance.total_cmp(&b.touch.distance));
    let sphere = &situation.grains.spheres[row[0].grain as usize];
    let unit = situation.machine.unit;
    let (centre, radius) = (sphere.centre / unit, sphere.radius / unit);
    for index in 0..points.len() {
        let point = points[index];
        let part_of = |other: &Point| {
            let body = &situation.machine.surfaces[row[other.member].surface as usize];
            other.member != point.member
                && !other.is_part
                && (other.touch.holds(&point.touch, radius)
                    || other.touch.before(&point.touch, radius)
                        && hides(body, centre, &point.touch, radius))
        };
        let is_part = points[..index].iter().any(part_of);
        points[index].is_part = is_part;
        row[point.member].shares |= is_part;
    }
    for (index, member) in row.iter_mut().enumerate() {
        if member.shares {
            let gone = |at: usize| {
                let here = |point: &&Point| point.member == index && point.at == at;
                points.iter().find(here).is_some_and(|point| point.is_part)
            };
            member.touches.retain(|at| !gone(at));
        }
    }
}

/// Whether a body stands between a centre and a touched point behind its surface.
fn hides(body: &Surface, centre: Vector, touch: &Touch, radius: f64) -> bool {
    let ray = Ray::new(centre, -touch.normal);
    let reach = touch.distance - FLUSH * radius;
    reach > 0.0 && body.shape.intersects_ray(&body.pose, &ray, reach)
}
