//! Memory: what the grains of a bed will take, refused before the first step where it cannot be had.

use crate::Result;
use crate::bed::scene::{Amount, Group, Scene};

/// Bytes for a grain: 550 measured without contacts, and five or six listed neighbours of some 200 bytes each in a packing,
/// held twice while they are listed anew.
const BYTES_PER_GRAIN: f64 = 2500.0;
/// Most grains: contacts, up to eight for a grain in a half list, are numbered with 32 bits.
const MOST_GRAINS: f64 = (u32::MAX / 8) as f64;

/// That grains can be numbered, and that this machine has the memory for them.
///
/// # Errors
/// [`crate::Error::Value`] naming the largest group, with the memory it needs.
pub fn check(scene: &Scene) -> Result<()> {
    let most = |a: &&Group, b: &&Group| grains_of(scene, a).total_cmp(&grains_of(scene, b));
    let Some(largest) = scene.groups.iter().max_by(most) else {
        return Ok(());
    };
    let grains = grains(scene);
    let needed = grains * BYTES_PER_GRAIN;
    let free = free().filter(|free| needed > *free);
    let why = match (grains > MOST_GRAINS, free) {
        (false, None) => return Ok(()),
        (true, _) => format!("at most {MOST_GRAINS:.1e} grains have numbers for their contacts"),
        (false, Some(free)) => format!("{:.1} GB are free here", free * 1e-9),
    };
    let key = match largest.amount {
        Amount::Count(_) => format!("{}.count", largest.key),
        Amount::Mass(_) => format!("{}.mass", largest.key),
    };
    let allowed = format!(
        "must be less: {grains:.1e} grains need about {:.1} GB of memory, and {why}",
        needed * 1e-9
    );
    Err(scene.document.reject(&key, allowed))
}

/// Grains of a scene, about.
pub fn grains(scene: &Scene) -> f64 {
    let groups = scene.groups.iter();
    groups.map(|group| grains_of(scene, group)).sum()
}

/// Grains of a group; of a mass, the fewest that have it.
fn grains_of(scene: &Scene, group: &Group) -> f64 {
    match group.amount {
        Amount::Count(count) => count as f64,
        Amount::Mass(mass) => {
            let material = &scene.materials[group.material].material;
            mass / material.sphere_mass(group.sizes.limits()[1])
        }
    }
}

/// Bytes of memory that are free, where the system says so.
fn free() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024.0 * kilobytes)
}
