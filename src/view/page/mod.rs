//! Page: one HTML file that shows a run in three dimensions, with a time slider, and needs nothing else.

use super::colours::{COLOURS, DECADES, level};
use super::film::{Film, Frame};
use super::kinds::{KINDS, Names};
use super::outline::Outline;
use crate::dem::dynamics::any::AnyBed;
use crate::files::write_atomic;
use crate::{Error, Result};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Largest size of the frames in a page, bytes before encoding: longer films are thinned.
const BUDGET: usize = 24_000_000;
/// Bytes of a grain in a frame: three places of two bytes, one byte for each quantity.
const GRAIN: usize = 9;
/// Most frames in a page: more are not seen.
const MOST: usize = 240;
/// Part of the grains, at each end of an axis, that the view need not hold: a stray grain does not shrink the bed.
const STRAY: f64 = 0.002;

const HTML: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// What grains can be coloured by.
#[derive(Debug, Serialize)]
struct Quantity {
    key: &'static str,
    name: &'static str,
    label: &'static str,
    unit: &'static str,
    /// Largest value in the film.
    most: f64,
}

#[derive(Debug, Serialize)]
struct ShownFrame {
    time: f64,
    stage: String,
    count: usize,
    /// Which of all grains are there; the first ones if none.
    who: Option<String>,
    centres: String,
    levels: BTreeMap<&'static str, String>,
    poses: Vec<f32>,
    /// Bodies taken out.
    gone: Vec<usize>,
}

#[derive(Debug, Serialize)]
struct ShownBody<'a> {
    name: &'a str,
    free: bool,
    vertices: String,
    triangles: String,
    edges: String,
}

#[derive(Debug, Serialize)]
struct Data<'a> {
    radii: String,
    /// Lowest corner and size of the block that places are counted in.
    low: [f32; 3],
    size: [f32; 3],
    /// Lowest and highest corner of what the camera looks at.
    view: [[f32; 3]; 2],
    quantities: Vec<Quantity>,
    sorts: Vec<Sort<'a>>,
    kinds: [[f64; 3]; 8],
    decades: f64,
    colours: [[f64; 3]; 7],
    /// Frame the page opens on.
    opens: usize,
    frames: Vec<ShownFrame>,
    bodies: Vec<ShownBody<'a>>,
}

/// Something that grains are told apart by, each of one kind for good.
#[derive(Debug, Serialize)]
struct Sort<'a> {
    key: &'static str,
    label: &'static str,
    names: &'a [String],
    /// Kind of each of all grains.
    of: String,
}

/// Words of a page.
#[derive(Debug, Clone, Copy)]
pub struct Words<'a> {
    /// Title.
    pub title: &'a str,
    /// A line below it.
    pub summary: &'a str,
    /// What must be known before the figures are used.
    pub warnings: &'a [String],
}

/// What of a grain never changes.
#[derive(Clone, Copy)]
struct Nature {
    radius: f32,
    material: u8,
    group: u32,
}

/// Grains seen in any frame, in the order of their names.
struct Seen {
    ids: Vec<u32>,
    radii: Vec<f32>,
    natures: Vec<Nature>,
}

impl Seen {
    fn in_any(frames: &[Frame]) -> Self {
        let nature = |frame: &Frame, at: usize| Nature {
            radius: frame.radii[at],
            material: frame.materials[at],
            group: frame.groups[at],
        };
        let seen: BTreeMap<u32, Nature> = frames
            .iter()
            .flat_map(|frame| {
                let ids = frame.ids.iter().enumerate();
                ids.map(move |(at, &id)| (id, nature(frame, at)))
            })
            .collect();
        Self {
            ids: seen.keys().copied().collect(),
            radii: seen.values().map(|nature| nature.radius).collect(),
            natures: seen.into_values().collect(),
        }
    }

    /// What there are several kinds of.
    fn sorts<'a>(&self, names: &'a Names) -> Vec<Sort<'a>> {
        let kinds = |kind: fn(&Nature) -> u8| encode(self.natures.iter().map(|n| [kind(n)]));
        let sorts = [
            Sort {
                key: "material",
                label: "material of a grain",
                names: &names.materials,
                of: kinds(|nature| nature.material),
            },
            Sort {
                key: "group",
                label: "group of a grain",
                names: &names.groups,
                of: kinds(|nature| nature.group.min(255) as u8),
            },
        ];
        sorts
            .into_iter()
            .filter(|sort| sort.names.len() > 1)
            .collect()
    }

    /// Places of the grains of a frame among all; none where they are the first ones.
    fn who(&self, frame: &Frame) -> Option<String> {
        if self.ids.starts_with(&frame.ids) {
            return None;
        }
        let place = |id: &u32| self.ids.partition_point(|other| other < id) as u32;
        Some(encode(frame.ids.iter().map(|id| place(id).to_le_bytes())))
    }
}

/// Writes the page of a run from its film, grains told apart by `names`; `words` stand in its corner.
///
/// # Errors
/// [`Error::File`] when a frame cannot be read or the page not written.
pub fn write_page(
    path: &Path,
    words: Words,
    (film, names): (&Film, &Names),
    bed: &dyn AnyBed,
) -> Result<()> {
    let fitting = BUDGET / (GRAIN * film.most_grains().max(1));
    let frames = film.spread(fitting.min(MOST))?;
    let grains = Seen::in_any(&frames);
    let radii = &grains.radii;
    let bounds = bounds(&frames, 0.0);
    let size = [0, 1, 2].map(|axis| bounds[1][axis] - bounds[0][axis]);
    let quantities = quantities(&frames);
    let data = Data {
        view: looked_at(&frames, radii),
        opens: shows_most(&frames),
        radii: encode(radii.iter().map(|r| r.to_le_bytes())),
        low: bounds[0],
        size,
        frames: frames
            .iter()
            .map(|frame| shown(frame, bounds[0], size, &quantities, &grains))
            .collect(),
        quantities,
        sorts: grains.sorts(names),
        kinds: KINDS,
        decades: DECADES,
        colours: COLOURS,
        bodies: bodies(bed),
    };
    let json = serde_json::to_string(&data).map_err(|e| Error::file("write", path)(e.into()))?;
    write_atomic(path, filled(HTML, SCRIPT, words, &json).as_bytes())
}

/// A page: its frame with style, `script`, words and data in their places.
pub(super) fn filled(frame: &str, script: &str, words: Words, json: &str) -> String {
    // "</script" would end the script that holds the data, and "<!--<script" would keep it open for ever
    let json = json.replace('<', "\\u003c");
    let mut html = String::with_capacity(frame.len() + STYLE.len() + script.len() + json.len());
    let mut rest = frame;
    while let Some((before, after)) = rest.split_once("{{") {
        html.push_str(before);
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        match name {
            "title" => html.push_str(&escape(words.title)),
            "summary" => html.push_str(&escape(words.summary)),
            "warnings" => html.push_str(&listed(words.warnings)),
            "style" => html.push_str(STYLE),
            "script" => html.push_str(script),
            _ => html.push_str(&json),
        }
        rest = after;
    }
    html.push_str(rest);
    html
}

/// Warnings as a list that opens, or nothing.
fn listed(warnings: &[String]) -> String {
    if warnings.is_empty() {
        return String::new();
    }
    let items = warnings
        .iter()
        .map(|warning| format!("<li>{}</li>", escape(warning)));
    let count = match warnings.len() {
        1 => "1 warning".to_owned(),
        count => format!("{count} warnings"),
    };
    format!(
        "<details open><summary>{count}</summary><ul>{}</ul></details>",
        items.collect::<String>()
    )
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('"', "&quot;")
}

pub(super) fn encode<const N: usize>(numbers: impl Iterator<Item = [u8; N]>) -> String {
    STANDARD.encode(numbers.flatten().collect::<Vec<u8>>())
}

/// Lowest and highest centre along each axis, a part of the grains at each end left out.
fn bounds(frames: &[Frame], stray: f64) -> [[f32; 3]; 2] {
    let mut bounds = [[0.0; 3]; 2];
    for axis in 0..3 {
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for frame in frames {
            let mut places: Vec<f32> = frame
                .centres
                .iter()
                .map(|c| c[axis])
                .filter(|x| x.is_finite())
                .collect();
            if places.is_empty() {
                continue;
            }
            places.sort_unstable_by(f32::total_cmp);
            let skip = (stray * places.len() as f64) as usize;
            low = low.min(places[skip]);
            high = high.max(places[places.len() - 1 - skip]);
        }
        if low <= high {
            (bounds[0][axis], bounds[1][axis]) = (low, high);
        }
    }
    bounds
}

/// Block the camera looks at: nearly all grains of all frames.
fn looked_at(frames: &[Frame], radii: &[f32]) -> [[f32; 3]; 2] {
    let largest = radii.iter().copied().fold(0.0, f32::max);
    let [low, high] = bounds(frames, STRAY);
    [low.map(|x| x - largest), high.map(|x| x + largest)]
}

fn quantities(frames: &[Frame]) -> Vec<Quantity> {
    let most = |values: fn(&Frame) -> &[f32]| {
        let all = frames.iter().flat_map(values).copied();
        f64::from(all.fold(f32::MIN_POSITIVE, f32::max))
    };
    let quantity = |key, name, label, unit, values: fn(&Frame) -> &[f32]| Quantity {
        key,
        name,
        label,
        unit,
        most: most(values),
    };
    vec![
        quantity(
            "squeeze",
            "force",
            "sum of contact forces on a grain",
            "N",
            |f| &f.squeeze,
        ),
        quantity("speed", "speed", "speed of a grain", "m/s", |f| &f.speed),
        quantity(
            "plastic",
            "plastic work",
            "energy lost to plastic flow",
            "J",
            |f| &f.plastic,
        ),
    ]
}

/// The frame that shows most: of those in which most of the film's grains touch something, the one whose touching grains have
/// the brightest colours, all quantities together. A bed at the height of its compression, a silo that flows, a drum that
/// turns, a body as it plunges in: not a bed that is still filled, nor one at rest. The first of several stages makes the bed
/// that the others are about, and is shown only where nothing touches in them.
#[must_use]
pub fn shows_most(frames: &[Frame]) -> usize {
    let quantities = quantities(frames);
    let all = frames.iter().map(|frame| frame.centres.len()).max();
    let all = all.unwrap_or(0);
    let brightness = |frame: &Frame| -> f64 {
        let touching: Vec<usize> = (0..frame.squeeze.len())
            .filter(|&grain| frame.squeeze[grain] > 0.0)
            .collect();
        if 2 * touching.len() <= all {
            return 0.0;
        }
        let values = [&frame.squeeze, &frame.speed, &frame.plastic];
        let sum = |(quantity, values): (&Quantity, &Vec<f32>)| -> f64 {
            let levels = touching
                .iter()
                .map(|&grain| level(f64::from(values[grain]), quantity.most));
            levels.sum()
        };
        quantities.iter().zip(values).map(sum).sum()
    };
    let first = frames.first().map(|frame| &frame.stage);
    let mut best = (0, (false, 0.0));
    for (number, frame) in frames.iter().enumerate() {
        let bright = brightness(frame);
        let now = (bright > 0.0 && Some(&frame.stage) != first, bright);
        // of two alike the later one
        if now >= best.1 {
            best = (number, now);
        }
    }
    best.0
}

fn shown(
    frame: &Frame,
    low: [f32; 3],
    size: [f32; 3],
    quantities: &[Quantity],
    grains: &Seen,
) -> ShownFrame {
    let place = |centre: &[f32; 3], axis: usize| {
        let part = (centre[axis] - low[axis]) / size[axis].max(f32::MIN_POSITIVE);
        (part.clamp(0.0, 1.0) * f32::from(u16::MAX)).round() as u16
    };
    let centres = frame
        .centres
        .iter()
        .flat_map(|centre| [0, 1, 2].map(|axis| place(centre, axis).to_le_bytes()));
    let levels = quantities
        .iter()
        .zip([&frame.squeeze, &frame.speed, &frame.plastic]);
    let levels = levels.map(|(quantity, values)| {
        let byte = |&v: &f32| [(level(f64::from(v), quantity.most) * 255.0).round() as u8];
        (quantity.key, encode(values.iter().map(byte)))
    });
    ShownFrame {
        time: frame.time,
        stage: frame.stage.clone(),
        count: frame.centres.len(),
        who: grains.who(frame),
        centres: encode(centres),
        levels: levels.collect(),
        poses: frame.poses.iter().flatten().copied().collect(),
        gone: frame.gone.clone(),
    }
}

fn bodies(bed: &dyn AnyBed) -> Vec<ShownBody<'_>> {
    let machine = bed.machine();
    let each = machine.bodies().iter().zip(&machine.surfaces);
    each.map(|(body, surface)| {
        let outline = Outline::of(&*surface.shape, machine.unit);
        let corners = outline.vertices.iter().flat_map(|v| v.to_array());
        ShownBody {
            name: &body.name,
            free: matches!(body.mobility, crate::dem::bodies::Mobility::Free { .. }),
            vertices: encode(corners.map(|x| (x as f32).to_le_bytes())),
            triangles: encode(outline.triangles.iter().flatten().map(|i| i.to_le_bytes())),
            edges: encode(outline.edges.iter().flatten().map(|i| i.to_le_bytes())),
        }
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_asks_nothing_of_the_network_and_escapes_what_it_is_told() {
        let words = Words {
            title: "a < b",
            summary: "\"c\" & d",
            warnings: &["e < f".to_owned()],
        };
        let quiet = Words {
            warnings: &[],
            ..words
        };
        let html = |words| filled(HTML, SCRIPT, words, "{}");
        assert!(!html(quiet).contains("<details"));
        let html = html(words);
        assert!(html.contains("<summary>1 warning</summary><ul><li>e &lt; f</li></ul>"));
        assert!(html.contains("<h1>a &lt; b</h1>") && html.contains("&quot;c&quot; &amp; d"));
        assert!(!html.contains("{{") && html.contains(">{}</script>"));
        for outside in ["http:", "https:", "src=", "@import", "fetch("] {
            assert!(!html.contains(outside), "{outside}");
        }
    }

    #[test]
    fn a_page_opens_on_the_bed_under_load_and_not_on_grains_that_fall() {
        let frame = |squeeze: f32, speed: f32| Frame {
            centres: vec![[0.0; 3]; 4],
            squeeze: vec![squeeze; 4],
            speed: vec![speed; 4],
            plastic: vec![0.0; 4],
            ..Frame::default()
        };
        // falling, at rest, pressed, let go
        let frames = [
            frame(0.0, 1.0),
            frame(1e-3, 1e-4),
            frame(1.0, 1e-4),
            frame(1e-3, 1e-4),
        ];
        assert_eq!(shows_most(&frames), 2);
        // full, flowing, empty
        let frames = [frame(0.3, 0.0), frame(0.2, 1.0), frame(0.01, 0.0)];
        assert_eq!(shows_most(&frames), 1);
        // a first group that moves, all of them at rest, all of them moving a little
        let few = Frame {
            centres: vec![[0.0; 3]; 1],
            squeeze: vec![1.0],
            speed: vec![1.0],
            plastic: vec![0.0],
            ..Frame::default()
        };
        let frames = [few, frame(0.3, 0.0), frame(0.2, 0.1)];
        assert_eq!(shows_most(&frames), 2);
        // filled in a rush, then flowing out slowly until nothing touches; nothing but filled
        let staged = |stage: &str, squeeze: f32, speed: f32| Frame {
            stage: stage.to_owned(),
            ..frame(squeeze, speed)
        };
        let frames = [
            staged("fill", 1.0, 1.0),
            staged("discharge", 0.1, 0.1),
            staged("discharge", 0.1, 0.2),
            staged("discharge", 0.0, 1.0),
        ];
        assert_eq!(shows_most(&frames), 2);
        assert_eq!(shows_most(&[frames[0].clone(), frames[3].clone()]), 0);
        assert_eq!(shows_most(&[]), 0);
    }

    #[test]
    fn a_stray_grain_does_not_move_the_camera() {
        let mut centres: Vec<[f32; 3]> = (0..1000).map(|i| [i as f32 * 1e-3; 3]).collect();
        centres.push([100.0; 3]);
        let frame = Frame {
            centres,
            ..Frame::default()
        };
        assert!(looked_at(std::slice::from_ref(&frame), &[0.01])[1][0] < 1.1);
        assert_eq!(bounds(&[frame], 0.0)[1][0], 100.0);
    }
}
