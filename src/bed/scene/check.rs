//! Checks of a scene as a whole: its room, and what its stages tell bodies to do.

use crate::Result;
use crate::bed::scene::{Change, Container, Measure, Scene, Stage};
use crate::dem::bodies::{Mobility, Solid};
use crate::unit::engineering;

/// Shortest period over the largest radius: twice the distance up to which neighbours are listed.
const SHORTEST_PERIOD: f64 = 6.0;
/// Extent of a mesh over the longest edge of the box above which its `scale` is taken for a slip.
const LARGEST_EXTENT: f64 = 100.0;
/// What a region may reach beyond its limits, over its edge: rounding of decimal numbers.
const REGION_SLACK: f64 = 1e-9;

impl Scene {
    pub(super) fn check_room(&self) -> Result<()> {
        let document = &self.document;
        let [_, largest] = self.radii();
        let Some(container) = &self.container else {
            if let Some(group) = self
                .groups
                .iter()
                .find(|group| group.region.is_none() && group.given.is_none())
            {
                let key = format!("{}.region", group.key);
                return Err(document.reject(&key, "must be there where there is no `[box]`"));
            }
            let planes = self
                .bodies
                .iter()
                .any(|body| body.solid == Solid::HalfSpace);
            if planes && self.domain.is_none() {
                let allowed = "must say which space grains must not leave: a plane has no end";
                return Err(document.reject("domain", allowed));
            }
            return Ok(());
        };
        if self.domain.is_some() {
            let allowed = "must be left out where there is a `[box]`";
            return Err(document.reject("domain", allowed));
        }
        for (key, edge) in [
            ("box.width", container.width),
            ("box.depth", container.depth),
        ] {
            if edge < 4.0 * largest {
                let allowed = format!(
                    "must be at least two diameters of the largest grain, {}, or no grain fits without overlap",
                    engineering(4.0 * largest, "m", 3)
                );
                return Err(document.reject(key, allowed));
            }
        }
        let room = container.width.max(container.depth);
        let room = room.max(container.height.unwrap_or(room));
        for (index, body) in self.bodies.iter().enumerate() {
            let extent = body.solid.extent().max_element();
            if extent.is_finite() && extent > LARGEST_EXTENT * room {
                let allowed = format!(
                    "must not be so much larger than the box, whose grains would never meet it: {} across against {}; look at `scale`",
                    engineering(extent, "m", 2),
                    engineering(room, "m", 2)
                );
                return Err(document.reject(&format!("body[{index}].mesh"), allowed));
            }
        }
        if container.periodic[2] {
            self.check_no_bottom(container)?;
        }
        let edges = [
            container.width,
            container.depth,
            container.height.unwrap_or(f64::INFINITY),
        ];
        for ((edge, periodic), key) in
            edges
                .iter()
                .zip(container.periodic)
                .zip(["box.width", "box.depth", "box.height"])
        {
            if periodic && *edge < SHORTEST_PERIOD * largest {
                let allowed = format!(
                    "must be at least three grain diameters where it is a period, {} for the largest grain, or two grains meet through both sides",
                    engineering(SHORTEST_PERIOD * largest, "m", 3)
                );
                return Err(document.reject(key, allowed));
            }
        }
        Ok(())
    }

    /// That no group comes in beyond the walls of the box, or beyond the domain: its grains would be lost before the first step.
    pub(super) fn check_regions(&self) -> Result<()> {
        let (limits, place) = match (&self.container, self.domain) {
            (Some(container), _) => {
                let edge = |periodic: bool, edge: f64| match periodic {
                    true => [f64::NEG_INFINITY, f64::INFINITY],
                    false => [0.0, edge],
                };
                let x = edge(container.periodic[0], container.width);
                let y = edge(container.periodic[1], container.depth);
                // above its rim a box is open
                let z = edge(container.periodic[2], f64::INFINITY);
                ([x, y, z], "the walls of `[box]`")
            }
            (None, Some([low, high])) => (
                [0, 1, 2].map(|axis| [low[axis], high[axis]]),
                "the `[domain]`",
            ),
            (None, None) => return Ok(()),
        };
        for group in &self.groups {
            let Some(region) = group.region else { continue };
            let [low, high] = region.corners();
            for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                let [least, most] = limits[axis];
                let slack = REGION_SLACK * (high[axis] - low[axis]);
                if low[axis] < least - slack || high[axis] > most + slack {
                    let mm = |length: f64| format!("{:.3}", 1e3 * length);
                    let allowed = format!(
                        "must lie within {place}: it reaches from {} to {} mm along {name}, they from {} to {} mm",
                        mm(low[axis]),
                        mm(high[axis]),
                        mm(least),
                        mm(most)
                    );
                    let key = format!("{}.region", group.key);
                    return Err(self.document.reject(&key, allowed));
                }
            }
        }
        Ok(())
    }

    /// That nothing of a scene that is periodic along z needs a floor, a top or a weight.
    fn check_no_bottom(&self, container: &Container) -> Result<()> {
        let refuse = |key: &str, allowed: &str| Err(self.document.reject(key, allowed));
        if container.height.is_none() {
            return refuse(
                "box.height",
                "must be there where z is periodic: it is the period",
            );
        }
        if self.gravity.z != 0.0 {
            let allowed = "must have no part along z where z is periodic: grains would fall for ever; e.g. \"0 m/s2\"";
            return refuse("gravity", allowed);
        }
        for (index, stage) in self.stages.iter().enumerate() {
            let key = format!("stage[{index}]");
            match stage {
                Stage::Settle { .. } | Stage::Relax { .. } => {}
                Stage::Compress { .. } | Stage::Unload { .. } => {
                    let allowed =
                        "must not be of this kind where z is periodic: there is no piston";
                    return refuse(&format!("{key}.kind"), allowed);
                }
                Stage::Run(run) if run.until.stress.is_some() => {
                    let allowed = "must be left out where z is periodic: there is no piston";
                    return refuse(&format!("{key}.until.stress"), allowed);
                }
                Stage::Run(_) => {}
            }
        }
        for (index, measure) in self.measures.iter().enumerate() {
            let key = format!("measure[{index}].kind");
            match measure {
                Measure::Repose { .. } | Measure::Slope | Measure::Flow(_) => {
                    let allowed = "must not be of this kind where z is periodic: it asks what is above and below";
                    return refuse(&key, allowed);
                }
                Measure::Plunge { .. } => {}
            }
        }
        Ok(())
    }

    /// That bodies are told to move, or let go, only if they can.
    pub(super) fn check_moves(&self) -> Result<()> {
        for (index, stage) in self.stages.iter().enumerate() {
            let Stage::Run(run) = stage else { continue };
            for (at, order) in run.moves.iter().enumerate() {
                let key = format!("stage[{index}].move[{at}]");
                let body = self.bodies.iter().find(|body| body.name == order.body);
                let held = body.is_some_and(
                    |body| matches!(body.mobility, Mobility::Free(freedom) if freedom.held),
                );
                let free = body.is_some_and(|body| matches!(body.mobility, Mobility::Free(_)));
                let belt = body.is_some_and(|body| matches!(body.mobility, Mobility::Belt(_)));
                match order.change {
                    Change::Release if !held => {
                        let allowed = "must stand for a free body with `held = true`";
                        return Err(self.document.reject(&format!("{key}.release"), allowed));
                    }
                    Change::Belt(_) if !belt => {
                        let allowed =
                            "must stand for a body that is a belt (`belt = {}` waits for a stage)";
                        return Err(self.document.reject(&format!("{key}.belt"), allowed));
                    }
                    Change::Drive(_) if belt => {
                        let allowed = "must not be told to a belt, which stands: `belt = {...}` moves its surface, `belt = {}` stops it";
                        return Err(self.document.reject(&key, allowed));
                    }
                    Change::Drive(_) if free => {
                        let allowed =
                            "must not be told to a free body, which moves under its forces";
                        return Err(self.document.reject(&key, allowed));
                    }
                    _ => {}
                }
            }
        }
        Ok(())
    }
}
