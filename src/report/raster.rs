//! Raster: the values of a field map on pixels, bounded by the particle's outline, as a PNG.

use super::palette::{Rgb, viridis};

/// Value carried by one cell or material point, in the deformed body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldPoint {
    /// Distance from the axis, m.
    pub r: f64,
    /// Height above the wall, m.
    pub z: f64,
    /// Edge length of the patch it stands for, m.
    pub size: f64,
    /// Value, SI.
    pub value: f64,
}

/// Width and height of the raster, px; even, the right half is computed and mirrored.
pub(super) const SIZE: (usize, usize) = (440, 440);
/// Steps of the colour bar: enough to look even, few enough to read values off.
pub(super) const LEVELS: u8 = 32;

/// Right half of the picture: level of each pixel, none outside the body.
pub(super) struct Raster {
    /// Columns from the axis to the edge.
    pub columns: usize,
    /// Rows.
    pub height: usize,
    /// Edge of a pixel, m.
    pub pixel: f64,
    /// Step of each pixel, row by row from the top.
    pub levels: Vec<Option<u8>>,
}

impl Raster {
    /// Values of `points` inside `outline`, in steps from 0 to `top`, over the window of `half_width` (m) around the axis.
    pub fn new(points: &[FieldPoint], outline: &[(f64, f64)], half_width: f64, top: f64) -> Self {
        let (columns, height) = (SIZE.0 / 2, SIZE.1);
        let pixel = half_width / columns as f64;
        let inside = inside(&whole_outline(points, outline), columns, height, pixel);
        let mut nearest = vec![(f64::INFINITY, 0.0); columns * height];
        for point in points {
            splat(&mut nearest, columns, height, pixel, point);
        }
        let mut levels: Vec<Option<u8>> = nearest
            .iter()
            .zip(&inside)
            .map(|(&(distance, value), &inside)| {
                let level = (value / top).clamp(0.0, 1.0) * f64::from(LEVELS);
                (inside && distance.is_finite()).then_some((level as u8).min(LEVELS - 1))
            })
            .collect();
        fill_gaps(&mut levels, &inside, columns);
        Raster {
            columns,
            height,
            pixel,
            levels,
        }
    }

    /// Full cross-section as an indexed PNG, transparent outside the body.
    pub fn png(&self) -> std::result::Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder =
            png::Encoder::new(&mut bytes, 2 * self.columns as u32, self.height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        let colours = (0..LEVELS).flat_map(level_colour);
        encoder.set_palette([0xff; 3].into_iter().chain(colours).collect::<Vec<u8>>());
        encoder.set_trns([0u8].as_slice());
        encoder.set_compression(png::Compression::High);
        let index = |level: &Option<u8>| level.map_or(0, |level| level + 1);
        let pixels: Vec<u8> = self
            .levels
            .chunks_exact(self.columns)
            .flat_map(|row| row.iter().rev().chain(row).map(index))
            .collect();
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&pixels)?;
        writer.finish()?;
        Ok(bytes)
    }
}

/// Which pixels of the right half lie within the outline (even-odd rule on the centre of each pixel).
fn inside(outline: &[(f64, f64)], columns: usize, height: usize, pixel: f64) -> Vec<bool> {
    let mut inside = vec![false; columns * height];
    for row in 0..height {
        let z = (height as f64 - row as f64 - 0.5) * pixel;
        let (bottom, top) = (outline[0].1, outline[outline.len() - 1].1);
        inside[row * columns..(row + 1) * columns].fill(z > bottom && z <= top);
        for edge in outline.windows(2) {
            let ((r0, z0), (r1, z1)) = (edge[0], edge[1]);
            if (z0 <= z) == (z1 <= z) {
                continue;
            }
            let crossing = r0 + (z - z0) / (z1 - z0) * (r1 - r0);
            let from = ((crossing / pixel - 0.5).ceil().max(0.0) as usize).min(columns);
            for cell in &mut inside[row * columns + from..(row + 1) * columns] {
                *cell = !*cell;
            }
        }
    }
    inside
}

/// The outline, continued to the upper pole by the convex hull of the points above its end.
fn whole_outline(points: &[FieldPoint], outline: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let lowest = points.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    let start = outline.last().copied().unwrap_or((0.0, lowest));
    let mut above: Vec<(f64, f64)> = points
        .iter()
        .map(|p| (p.r, p.z))
        .filter(|p| p.1 > start.1)
        .collect();
    above.sort_by(|a, b| a.1.total_cmp(&b.1).then(b.0.total_cmp(&a.0)));
    above.extend(above.last().map(|top| (0.0, top.1)));
    let mut hull = vec![start];
    for point in above {
        while let [.., a, b] = hull[..] {
            let outside = (b.0 - a.0) * (point.1 - a.1) - (b.1 - a.1) * (point.0 - a.0);
            if outside > 0.0 {
                break;
            }
            hull.pop();
        }
        hull.push(point);
    }
    let mut whole = outline.to_vec();
    whole.extend(&hull[usize::from(!whole.is_empty())..]);
    whole
}

/// Offer a point to the pixels around it; the one nearest in units of its own size wins.
fn splat(
    nearest: &mut [(f64, f64)],
    columns: usize,
    height: usize,
    pixel: f64,
    point: &FieldPoint,
) {
    if !(point.r.is_finite() && point.z.is_finite() && point.size > 0.0 && point.value.is_finite())
    {
        return;
    }
    let reach = 1.2 * point.size + pixel;
    let index = |place: f64, end: usize| ((place / pixel).max(0.0) as usize).min(end);
    let (c0, c1) = (
        index(point.r - reach, columns),
        index(point.r + reach + pixel, columns),
    );
    let (k0, k1) = (
        index(point.z - reach, height),
        index(point.z + reach + pixel, height),
    );
    for k in k0..k1 {
        for c in c0..c1 {
            let (r, z) = ((c as f64 + 0.5) * pixel, (k as f64 + 0.5) * pixel);
            let distance = (r - point.r).hypot(z - point.z) / point.size.max(pixel);
            let cell = &mut nearest[(height - 1 - k) * columns + c];
            if distance < cell.0 {
                *cell = (distance, point.value);
            }
        }
    }
}

/// Give pixels inside the body that no point reached the level of a neighbour, ring by ring.
fn fill_gaps(levels: &mut [Option<u8>], inside: &[bool], columns: usize) {
    if inside
        .iter()
        .zip(&*levels)
        .all(|(_, level)| level.is_none())
    {
        return;
    }
    loop {
        let before = levels.to_vec();
        let mut changed = false;
        for i in 0..levels.len() {
            if before[i].is_some() || !inside[i] {
                continue;
            }
            let left = (i % columns > 0).then(|| i - 1);
            let right = (i % columns + 1 < columns).then_some(i + 1);
            let neighbours = [left, right, i.checked_sub(columns), Some(i + columns)];
            let found = neighbours
                .into_iter()
                .flatten()
                .find_map(|j| before.get(j).copied().flatten());
            changed |= found.is_some();
            levels[i] = found;
        }
        if !changed {
            return;
        }
    }
}

/// Colour of a step.
pub(super) fn level_colour(level: u8) -> Rgb {
    viridis(f64::from(level) / f64::from(LEVELS - 1))
}
