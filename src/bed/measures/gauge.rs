//! Gauges: the measures of a scene as they follow a run, and what they find.

use super::flow::{below, beverloo, bulk_density, steady_rate};
use super::repose::{Slope, drum, heap};
use crate::bed::scene::{Measure, Orifice, Plane};
use crate::dem::dynamics::any::AnyBed;
use crate::dem::grains::Sphere;
use crate::tape::{Keep, Tape, keep_fields};
use serde::Serialize;

/// A figure found by a measure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// What it is.
    pub name: String,
    /// Value, SI or as the unit says.
    pub value: f64,
    /// Unit.
    pub unit: &'static str,
    /// How it was found.
    pub note: String,
}

/// A measure on its way through a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Gauge {
    /// Heap, looked at when the run is over.
    Repose([f64; 2], f64),
    /// Slopes (rad) seen in the present stage.
    Slope(Vec<f64>),
    /// Mass that has gone through a plane.
    Flow(Flow),
    /// Body that falls.
    Plunge(Plunge),
}

/// Mass below a plane as time goes on.
#[derive(Debug, Clone, PartialEq)]
pub struct Flow {
    plane: Plane,
    /// Times (s) and masses (kg), from just before the first grain.
    series: Vec<[f64; 2]>,
    /// Grains and mass (kg) below the plane before.
    first: Option<(usize, f64)>,
    /// Time (s) of the last grain that went through.
    last: f64,
    /// Grains that have gone through.
    grains: usize,
    /// Grains and mass (kg) taken out below the plane.
    gone: (usize, f64),
    /// Bulk density of the filling before the first grain left, kg/m3.
    bulk: f64,
}

/// A body that falls into the bed.
#[derive(Debug, Clone, PartialEq)]
pub struct Plunge {
    body: String,
    /// Height (m) of its lowest point, and time (s), at the first touch.
    touched: Option<[f64; 2]>,
    /// Speed then, m/s.
    speed: f64,
    /// Deepest way since, m.
    depth: f64,
    /// Largest force of the grains along z, N, and its time after the first touch, s.
    peak: [f64; 2],
}

keep_fields!(Flow: series, first, last, grains, gone, bulk; rebuilt plane);
keep_fields!(Plunge: touched, speed, depth, peak; rebuilt body);

/// What a gauge has read; what it is follows from the scene.
impl Keep for Gauge {
    fn save(&self, tape: &mut Tape) {
        match self {
            Gauge::Repose(..) => {}
            Gauge::Slope(slopes) => slopes.save(tape),
            Gauge::Flow(flow) => flow.save(tape),
            Gauge::Plunge(plunge) => plunge.save(tape),
        }
    }

    fn load(&mut self, tape: &mut Tape) -> Option<()> {
        match self {
            Gauge::Repose(..) => Some(()),
            Gauge::Slope(slopes) => slopes.load(tape),
            Gauge::Flow(flow) => flow.load(tape),
            Gauge::Plunge(plunge) => plunge.load(tape),
        }
    }
}

impl Gauge {
    /// Gauge of a measure.
    #[must_use]
    pub fn new(measure: &Measure) -> Self {
        match measure {
            Measure::Repose { axis, floor } => Gauge::Repose(*axis, *floor),
            Measure::Slope => Gauge::Slope(Vec::new()),
            Measure::Flow(plane) => Gauge::Flow(Flow {
                plane: *plane,
                series: Vec::new(),
                first: None,
                last: 0.0,
                grains: 0,
                gone: (0, 0.0),
                bulk: 0.0,
            }),
            Measure::Plunge { body } => Gauge::Plunge(Plunge {
                body: body.clone(),
                touched: None,
                speed: 0.0,
                depth: 0.0,
                peak: [0.0; 2],
            }),
        }
    }

    /// A stage begins.
    pub fn begin(&mut self) {
        if let Gauge::Slope(slopes) = self {
            slopes.clear();
        }
    }

    /// Reads the bed after a step; `surveyed` every few steps.
    pub fn read(&mut self, bed: &dyn AnyBed, surveyed: bool) {
        match self {
            Gauge::Plunge(plunge) => plunge.read(bed),
            Gauge::Flow(flow) if surveyed => flow.read(bed),
            Gauge::Slope(slopes) if surveyed => {
                slopes.extend(drum(bed.grains()).map(|slope| slope.angle));
            }
            _ => {}
        }
    }

    /// A grain of a mass (kg) has left through an outlet.
    pub fn left(&mut self, sphere: &Sphere, mass: f64) {
        if let Gauge::Flow(flow) = self
            && sphere.centre.z < flow.plane.height
        {
            flow.gone.0 += 1;
            flow.gone.1 += mass;
        }
    }

    /// Whether a flow has begun and nothing has gone through for `time` (s).
    #[must_use]
    pub fn flow_ended(&self, now: f64, time: f64) -> bool {
        match self {
            Gauge::Flow(flow) => flow.grains > 0 && now - flow.last >= time,
            _ => false,
        }
    }

    /// What the gauge has found when the run is over, in `gravity` (m/s2) among grains of a mean `diameter` (m).
    #[must_use]
    pub fn findings(&self, bed: &dyn AnyBed, gravity: f64, diameter: f64) -> Vec<Finding> {
        match self {
            Gauge::Repose(axis, floor) => repose(heap(bed.grains(), *axis, *floor)),
            Gauge::Slope(slopes) => slope(slopes),
            Gauge::Flow(flow) => flow.findings(gravity, diameter),
            Gauge::Plunge(plunge) => plunge.findings(bed),
        }
    }
}

/// A figure with how it was found.
pub(in crate::bed) fn finding(
    name: impl Into<String>,
    value: f64,
    unit: &'static str,
    note: impl Into<String>,
) -> Finding {
    Finding {
        name: name.into(),
        value,
        unit,
        note: note.into(),
    }
}

fn repose(heap: Option<Slope>) -> Vec<Finding> {
    let Some(heap) = heap else {
        return vec![finding(
            "angle of repose",
            f64::NAN,
            "deg",
            "the heap is too flat to have a flank",
        )];
    };
    let note = "line through the flank between 20 % and 80 % of the height";
    vec![
        finding("angle of repose", heap.angle.to_degrees(), "deg", note),
        finding(
            "scatter of the flank",
            heap.scatter,
            "m",
            "root mean square about the line",
        ),
        finding("height of the heap", heap.height, "m", ""),
    ]
}

/// Mean of the second half of a stage, when the filling turns steadily.
fn slope(slopes: &[f64]) -> Vec<Finding> {
    let late = &slopes[slopes.len() / 2..];
    let count = late.len() as f64;
    let mean = late.iter().sum::<f64>() / count;
    let square = late.iter().map(|slope| (slope - mean).powi(2)).sum::<f64>() / count;
    let note = "free surface, mean over the second half of the last stage";
    vec![
        finding("dynamic angle of repose", mean.to_degrees(), "deg", note),
        finding(
            "its fluctuation",
            square.sqrt().to_degrees(),
            "deg",
            "standard deviation in time",
        ),
    ]
}

impl Flow {
    fn read(&mut self, bed: &dyn AnyBed) {
        let (grains, now) = (bed.grains(), bed.clock().1);
        let (count, mass) = below(grains, self.plane.height);
        let (count, mass) = (count + self.gone.0, mass + self.gone.1);
        let (before, first) = *self.first.get_or_insert((count, mass));
        let passed = count.saturating_sub(before);
        if passed > self.grains {
            self.last = now;
            self.grains = passed;
        }
        if mass > first {
            self.series.push([now, mass - first]);
        } else {
            self.series = vec![[now, 0.0]];
            if let Some(orifice) = &self.plane.orifice {
                self.bulk = bulk_density(grains, &orifice.filling);
            }
        }
    }

    fn findings(&self, gravity: f64, diameter: f64) -> Vec<Finding> {
        let passed = self.series.last().map_or(0.0, |point| point[1]);
        let mut found = vec![finding("mass discharged", passed, "kg", "")];
        let Some(rate) = steady_rate(&self.series) else {
            return found;
        };
        let note = "steady, between 20 % and 80 % of the mass discharged";
        found.push(finding("mass flow", rate, "kg/s", note));
        if let Some(orifice) = &self.plane.orifice {
            found.extend(self.against_beverloo(rate, orifice, gravity, diameter));
        }
        found
    }

    fn against_beverloo(
        &self,
        rate: f64,
        orifice: &Orifice,
        gravity: f64,
        diameter: f64,
    ) -> Vec<Finding> {
        let expected = beverloo(
            orifice.constants,
            self.bulk,
            gravity,
            orifice.diameter,
            diameter,
        );
        let [c, k] = orifice.constants;
        let own = rate / (expected / c);
        vec![
            finding(
                "bulk density",
                self.bulk,
                "kg/m3",
                "of the filling before the first grain left",
            ),
            finding(
                "Beverloo's mass flow",
                expected,
                "kg/s",
                format!("C = {c}, k = {k}, D = {} d", orifice.diameter / diameter),
            ),
            finding("C of this flow", own, "", format!("with k = {k}")),
        ]
    }
}

impl Plunge {
    fn read(&mut self, bed: &dyn AnyBed) {
        let Some(index) = bed.machine().find(&self.body) else {
            return;
        };
        let (force, now) = (bed.force_on(index).z, bed.clock().1);
        let station = &bed.machine().stations[index];
        if self.touched.is_none() && force > 0.0 {
            self.touched = Some([station.centre.z, now]);
            self.speed = station.velocity.length();
        }
        let Some([height, time]) = self.touched else {
            return;
        };
        self.depth = self.depth.max(height - station.centre.z);
        if force > self.peak[0] {
            self.peak = [force, now - time];
        }
    }

    fn findings(&self, bed: &dyn AnyBed) -> Vec<Finding> {
        let machine = bed.machine();
        let mass = machine
            .find(&self.body)
            .map(|index| 1.0 / machine.stations[index].inverse_mass);
        let Some(mass) = mass.filter(|_| self.touched.is_some()) else {
            return vec![finding(
                "depth",
                f64::NAN,
                "m",
                "the body has not touched a grain",
            )];
        };
        let [force, time] = self.peak;
        vec![
            finding("speed at first touch", self.speed, "m/s", ""),
            finding(
                "depth",
                self.depth,
                "m",
                "largest way of the body after the first touch",
            ),
            finding(
                "peak deceleration",
                force / mass,
                "m/s2",
                format!(
                    "force of the grains over the mass, {:.2} ms after the first touch",
                    1e3 * time
                ),
            ),
        ]
    }
}
