//! Oedometer: moduli and indices of a bed that a piston compresses, lets go and compresses again, beside closed estimates.

use super::gauge::{Finding, finding};
use super::series::Row;
use crate::material::{Material, PLASTIC_PRESSURE_RATIO};
use crate::unit::engineering;

/// Names of the stages of a compression in the rows.
const COMPRESS: &str = "compress";
const UNLOAD: &str = "unload";
/// Part of the largest stress from which on a branch is straight enough for one modulus.
const UPPER: f64 = 0.5;

/// Constrained modulus (Pa) that a random packing of elastic spheres has at the axial `stress` (Pa) if all of it strains alike.
///
/// $$ \sigma = \frac{\phi Z E^\ast}{3 \pi} \varepsilon^{3/2}, \qquad M = \frac{d\sigma}{d\varepsilon}
///    = \frac{3}{2} \left(\frac{\phi Z E^\ast}{3 \pi}\right)^{2/3} \sigma^{1/3} $$
///
/// | symbol | argument | unit | meaning |
/// |---|---|---|---|
/// | φ, Z | `solid_fraction`, `coordination` | | of the packing, contacts a grain |
/// | E* | `modulus` | Pa | effective modulus of a contact, E / (2 (1 - ν²)) for two alike |
/// | σ, ε | `stress` | Pa, 1 | axial stress and strain, no strain sideways |
///
/// A contact whose normal makes the cosine n with the axis flattens by 2 R ε n², its force of Hertz is
/// (4/3) E* √(R/2) (2 R ε n²)^1.5, and σ is the mean of Love and Weber over all directions, of which ⟨n⁵⟩ = 1/6.
///
/// Source: Walton 1987, J. Mech. Phys. Solids 35, 213 (smooth spheres, uniaxial compression). It bounds the modulus from
/// above: grains of a packing give way where they are held least.
#[must_use]
pub fn elastic_modulus(solid_fraction: f64, coordination: f64, modulus: f64, stress: f64) -> f64 {
    let stiffness = solid_fraction * coordination * modulus / (3.0 * std::f64::consts::PI);
    1.5 * stiffness.powf(2.0 / 3.0) * stress.cbrt()
}

/// Constrained modulus (Pa) of the same packing if every contact yields fully, its mean pressure 2.8 Y.
///
/// $$ M = \frac{3}{10} \phi Z p_0, \qquad p_0 = 2.8\ Y $$
///
/// A fully plastic contact carries 2 π p_0 (R/2) δ; with δ = 2 R ε n² and ⟨n⁴⟩ = 1/5 the stress is linear in ε.
///
/// Source: Arzt 1982, Acta Metall. 30, 1883, for the contact; the mean over directions as in [`elastic_modulus`].
#[must_use]
pub fn plastic_modulus(solid_fraction: f64, coordination: f64, yield_strength: f64) -> f64 {
    0.3 * solid_fraction * coordination * PLASTIC_PRESSURE_RATIO * yield_strength
}

/// Rows of one compression or one letting go.
struct Branch<'a> {
    rows: &'a [Row],
    loads: bool,
}

impl Branch<'_> {
    /// Largest stress, Pa.
    fn peak(&self) -> f64 {
        self.rows
            .iter()
            .fold(0.0, |peak, row| peak.max(row.stress_pa))
    }

    /// Stresses (Pa) between which it goes beyond the largest one before (`most`, Pa), in its upper part.
    fn virgin(&self, most: f64) -> [f64; 2] {
        let peak = self.peak();
        [most.max(UPPER * peak), peak]
    }

    /// Rows whose stress lies between two, Pa.
    fn between(&self, low: f64, high: f64) -> Vec<&Row> {
        let inside = |row: &&Row| row.stress_pa >= low && row.stress_pa <= high;
        self.rows.iter().filter(inside).collect()
    }
}

/// Branches in their order, each with at least two rows of strain.
fn branches(rows: &[Row]) -> Vec<Branch<'_>> {
    let alike = rows.chunk_by(|a, b| a.stage == b.stage);
    alike
        .filter(|part| part[0].stage == COMPRESS || part[0].stage == UNLOAD)
        .map(|part| Branch {
            rows: &part[part
                .iter()
                .position(|row| row.strain > 0.0)
                .unwrap_or(part.len())..],
            loads: part[0].stage == COMPRESS,
        })
        .filter(|branch| branch.rows.len() > 1)
        .collect()
}

/// Slope of the least-squares line through `y` over `x`; none for fewer than three points or no range of `x`.
fn slope(points: &[[f64; 2]]) -> Option<f64> {
    let count = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
    let (x, y) = (mean(0), mean(1));
    let (mut xx, mut xy) = (0.0, 0.0);
    for point in points {
        xx += (point[0] - x).powi(2);
        xy += (point[0] - x) * (point[1] - y);
    }
    (points.len() > 2 && xx > 0.0).then_some(xy / xx)
}

fn modulus(rows: &[&Row]) -> Option<f64> {
    slope(
        &rows
            .iter()
            .map(|row| [row.strain, row.stress_pa])
            .collect::<Vec<_>>(),
    )
}

/// Fall of the void ratio over a tenfold stress.
fn index(rows: &[&Row]) -> Option<f64> {
    let voids = |row: &Row| (1.0 - row.solid_fraction) / row.solid_fraction;
    let points: Vec<[f64; 2]> = rows
        .iter()
        .map(|row| [row.stress_pa.log10(), voids(row)])
        .collect();
    slope(&points).map(|slope| -slope)
}

/// Rows on each side that a tangent is laid through.
const TANGENT: usize = 4;

/// Axial stress (Pa) and tangent constrained modulus (Pa) along the first loading.
#[must_use]
pub fn tangents(rows: &[Row]) -> Vec<(f64, f64)> {
    let Some(loading) = branches(rows).into_iter().find(|branch| branch.loads) else {
        return Vec::new();
    };
    let windows = loading.rows.windows(2 * TANGENT + 1);
    windows
        .filter_map(|window| {
            let rows: Vec<&Row> = window.iter().collect();
            Some((window[TANGENT].stress_pa, modulus(&rows)?))
        })
        .collect()
}

/// The same of an elastic packing whose grains all strain alike, with the contacts and solid fraction the bed has.
#[must_use]
pub fn walton(rows: &[Row], material: &Material) -> Vec<(f64, f64)> {
    let Some(loading) = branches(rows).into_iter().find(|branch| branch.loads) else {
        return Vec::new();
    };
    let contact = 0.5 * material.contact_modulus();
    let each = loading.rows.iter().map(|row| {
        let modulus = elastic_modulus(row.solid_fraction, row.coordination, contact, row.stress_pa);
        (row.stress_pa, modulus)
    });
    each.collect()
}

/// What the rows of a run tell of a compression; nothing for a run without one.
#[must_use]
pub fn findings(rows: &[Row], material: &Material, yields: bool) -> Vec<Finding> {
    let branches = branches(rows);
    let Some(last) = branches.iter().rposition(|branch| branch.loads) else {
        return Vec::new();
    };
    let (before, last) = (&branches[..last], &branches[last]);
    let most = before.iter().map(Branch::peak).fold(0.0, f64::max);
    let mut found = stiffness(before, last, most);
    found.extend(at_the_top(last, most, material, yields));
    found.extend(quality(&branches, last));
    found
}

/// Two stresses in words.
fn range(low: f64, high: f64) -> String {
    let [low, high] = [low, high].map(|stress| engineering(stress, "Pa", 3));
    format!("{low} to {high}")
}

/// Moduli and indices: of the loading beyond the largest stress before (`most`, Pa), of letting go, of loading up to it again.
fn stiffness(before: &[Branch], last: &Branch, most: f64) -> Vec<Finding> {
    let mut found = Vec::new();
    let mut tell = |name, value: Option<f64>, unit, note: String| {
        found.extend(value.map(|value| finding(name, value, unit, note)));
    };
    let [low, peak] = last.virgin(most);
    let rows = last.between(low, peak);
    let note = format!("loading, {}", range(low, peak));
    tell("constrained modulus", modulus(&rows), "Pa", note);
    let note = "fall of the void ratio over a tenfold stress, same rows";
    tell("compression index", index(&rows), "", note.to_owned());
    if let Some(unload) = before.iter().find(|branch| !branch.loads) {
        let high = unload.peak();
        let rows = unload.between(UPPER * high, high);
        let note = range(UPPER * high, high);
        tell("unloading modulus", modulus(&rows), "Pa", note);
        tell(
            "swelling index",
            index(&rows),
            "",
            "of the same rows".to_owned(),
        );
    }
    if most > 0.0 {
        let rows = last.between(UPPER * most, most);
        let note = range(UPPER * most, most);
        tell("reloading modulus", modulus(&rows), "Pa", note);
    }
    found
}

/// What is true at the largest stress: the ratio of the stresses, and the moduli that theory bounds a packing like this by.
fn at_the_top(last: &Branch, most: f64, material: &Material, yields: bool) -> Vec<Finding> {
    let top = last.rows.iter();
    let top = top.max_by(|a, b| a.stress_pa.total_cmp(&b.stress_pa));
    let Some(top) = top.filter(|row| row.stress_pa > 0.0) else {
        return Vec::new();
    };
    let [low, peak] = last.virgin(most);
    let own = modulus(&last.between(low, peak)).unwrap_or(f64::NAN);
    let bound = |name: &str, what: &str, estimate: f64| {
        let share = own / estimate;
        let note = format!("{what}; this bed has {share:.2} of it");
        finding(name, estimate, "Pa", note)
    };
    let (phi, z) = (top.solid_fraction, top.coordination);
    let contact = 0.5 * material.contact_modulus();
    let elastic = elastic_modulus(phi, z, contact, 0.5 * (low + peak));
    let ratio = top.lateral_stress_pa / top.stress_pa;
    let mut found = vec![
        finding(
            "lateral stress ratio",
            ratio,
            "",
            "walls over piston at the largest stress",
        ),
        bound(
            "modulus of Walton",
            "elastic, all grains strained alike: an upper bound",
            elastic,
        ),
    ];
    if let Some(flow) = material.flow.filter(|_| yields) {
        let plastic = plastic_modulus(phi, z, flow.yield_strength());
        found.push(bound(
            "plastic modulus",
            "every contact fully plastic",
            plastic,
        ));
    }
    found
}

/// Whether the test was one: slow, and of a packing that comes to bear.
fn quality(branches: &[Branch], last: &Branch) -> Vec<Finding> {
    let loading = branches.iter().filter(|branch| branch.loads);
    // loading again begins without a stress: only what lies above the seat counts
    let seat = branches[0].rows[0].stress_pa;
    let inertial = loading
        .flat_map(|branch| branch.between(seat, f64::INFINITY))
        .map(|row| row.inertial_number)
        .fold(0.0, f64::max);
    let note = "loading above the stress from which strain counts; quasi-static up to 1e-3";
    let contacts = |row: Option<&Row>| row.map_or(0.0, |row| row.coordination);
    let (first, reached) = (
        contacts(branches[0].rows.first()),
        contacts(last.rows.last()),
    );
    let rise = format!("at the largest strain; {first:.2} as strain begins to count");
    vec![
        finding("largest inertial number", inertial, "", note),
        finding("contacts per grain", reached, "", rise),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of a law sigma = k (strain - left)^power, up to `strain` or down from it.
    fn rows(
        stage: &str,
        strains: impl Iterator<Item = f64>,
        stress: impl Fn(f64) -> f64,
    ) -> Vec<Row> {
        strains
            .map(|strain| Row {
                stage: stage.to_owned(),
                strain,
                stress_pa: stress(strain),
                lateral_stress_pa: 0.4 * stress(strain),
                solid_fraction: 0.6 / (1.0 - strain),
                coordination: 4.0 + 30.0 * strain,
                inertial_number: 1e-4 / strain,
                ..Row::default()
            })
            .collect()
    }

    fn found(found: &[Finding], name: &str) -> f64 {
        let one = found.iter().find(|one| one.name == name);
        one.unwrap_or_else(|| panic!("no {name}")).value
    }

    #[test]
    fn each_branch_gives_its_own_modulus() {
        let up = |from: i32, to: i32| (from..=to).map(|i| 1e-3 * f64::from(i));
        let mut all = rows("settle", up(0, 0), |_| 0.0);
        all.extend(rows("compress", up(1, 20), |e| 5e7 * e));
        all.extend(rows("unload", up(16, 20).rev(), |e| 1e6 - 1e8 * (0.02 - e)));
        all.extend(rows("compress", up(16, 40), |e| {
            (1e6 - 9e7 * (0.02 - e)).min(5e7 * e)
        }));
        let material = Material {
            density: 2500.0,
            young_modulus: 70e9,
            poisson_ratio: 0.2,
            flow: None,
        };
        let findings = findings(&all, &material, false);
        let near = |name: &str, value: f64| {
            let own = found(&findings, name);
            assert!(
                (own / value - 1.0).abs() < 1e-9,
                "{name}: {own} for {value}"
            );
        };
        near("constrained modulus", 5e7);
        near("unloading modulus", 1e8);
        near("reloading modulus", 9e7);
        near("lateral stress ratio", 0.4);
        near("largest inertial number", 0.1);
        near("contacts per grain", 5.2);
        // e = (1 - phi) / phi = (1 - strain) / 0.6 - 1 falls by (stress / 5e7) / 0.6
        let index = found(&findings, "compression index");
        let secant = (0.04 - 0.02) / 0.6 / 2f64.log10();
        assert!((index / secant - 1.0).abs() < 0.03, "{index} for {secant}");
        assert!(super::findings(&all[..1], &material, false).is_empty());
    }

    /// The sum over contacts of Love and Weber, all strains alike, over normals spread evenly: what the closed form integrates.
    #[test]
    fn closed_estimates_are_the_sums_they_stand_for() {
        let (phi, z, e_star, y, strain, radius) = (0.62, 5.5, 40e9, 100e6, 0.01f64, 1e-3f64);
        let contacts = phi / (4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)) * z / 2.0;
        let sum = |force: &dyn Fn(f64) -> f64| {
            let count = 20_000;
            let each = (0..count).map(|i| {
                let n = (f64::from(i) + 0.5) / f64::from(count);
                force(2.0 * radius * strain * n * n) * 2.0 * radius * n * n
            });
            contacts * each.sum::<f64>() / f64::from(count)
        };
        let hertz = sum(&|d| 4.0 / 3.0 * e_star * (radius / 2.0).sqrt() * d.powf(1.5));
        let elastic = elastic_modulus(phi, z, e_star, hertz);
        assert!(
            (elastic / (1.5 * hertz / strain) - 1.0).abs() < 1e-6,
            "{elastic}"
        );
        let full = sum(&|d| 2.0 * std::f64::consts::PI * 2.8 * y * radius / 2.0 * d);
        let plastic = plastic_modulus(phi, z, y);
        assert!((plastic / (full / strain) - 1.0).abs() < 1e-6, "{plastic}");
    }
}
