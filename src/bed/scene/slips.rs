//! Slips of units in a scene: values that no bed has, unless the file names them in `unusual`.

use super::Scene;
use crate::Result;
use crate::case::slips::{meant, of_grains, of_gravity};

/// That no value of the scene looks like a slip of its unit, but for those named in `unusual`.
///
/// # Errors
/// [`crate::Error::Value`] naming the first one and how to keep it, or a name in `unusual` that is none.
pub(super) fn check(scene: &Scene, unusual: &[String]) -> Result<()> {
    let mut found = vec![("gravity".to_owned(), of_gravity(scene.gravity.length()))];
    for group in &scene.groups {
        let material = &scene.materials[group.material];
        for (name, slip) in of_grains(group.sizes.limits(), &material.material) {
            let table = match name {
                "radius" => &group.key,
                _ => &material.key,
            };
            found.push((format!("{table}.{name}"), slip));
        }
    }
    for material in &scene.materials {
        for (name, slip) in of_grains([1.0; 2], &material.material) {
            found.push((format!("{}.{name}", material.key), slip));
        }
    }
    let known = |key: &String| found.iter().any(|(known, _)| known == key);
    if let Some(i) = unusual.iter().position(|key| !known(key)) {
        let mut names: Vec<&str> = found.iter().map(|(key, _)| &key[..]).collect();
        names.sort_unstable();
        names.dedup();
        let allowed = format!("must be one of {}", names.join(", "));
        return Err(scene.document.reject(&format!("unusual[{i}]"), allowed));
    }
    for (key, slip) in found {
        if let Some(why) = slip.filter(|_| !unusual.contains(&key)) {
            return Err(scene.document.reject(&key, meant(&key, &why)));
        }
    }
    Ok(())
}
