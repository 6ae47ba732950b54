//! Kinds: what grains are told apart by, their names and colours.

use super::portrait::Portrait;
use std::collections::BTreeSet;

/// Names that grains are told apart by, in the order of their indices.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Names {
    /// Materials.
    pub materials: Vec<String>,
    /// Groups.
    pub groups: Vec<String>,
}

/// Colours of kinds, sRGB: told apart by most eyes (Okabe and Ito 2008), used again from the first on.
pub const KINDS: [[f64; 3]; 8] = [
    [0.90, 0.62, 0.00],
    [0.34, 0.71, 0.91],
    [0.00, 0.62, 0.45],
    [0.94, 0.89, 0.26],
    [0.00, 0.45, 0.70],
    [0.84, 0.37, 0.00],
    [0.80, 0.47, 0.65],
    [0.60, 0.60, 0.60],
];

/// Colour of a kind.
#[must_use]
pub fn colour_of(kind: usize) -> [f64; 3] {
    KINDS[kind % KINDS.len()]
}

/// What a picture tells grains apart by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Apart {
    /// Their material.
    Material,
    /// Their group.
    Group,
}

impl Names {
    /// What the grains of `portraits` are told apart by: materials if there are several among them, else groups, with the kinds there
    /// are; nothing where all are of one kind.
    #[must_use]
    pub fn apart(&self, portraits: &[&Portrait]) -> Option<(Apart, Vec<(usize, &str)>)> {
        let present = |kind: fn(&Portrait) -> Vec<usize>| -> BTreeSet<usize> {
            portraits
                .iter()
                .flat_map(|&portrait| kind(portrait))
                .collect()
        };
        let materials = present(|p| p.materials.iter().map(|&m| usize::from(m)).collect());
        let groups = present(|p| p.groups.iter().map(|&g| g as usize).collect());
        let sorts = [
            (Apart::Material, &self.materials, materials),
            (Apart::Group, &self.groups, groups),
        ];
        let (apart, names, present) = sorts.into_iter().find(|(_, _, kinds)| kinds.len() > 1)?;
        let named = present
            .into_iter()
            .map(|kind| (kind, names.get(kind).map_or("", String::as_str)));
        Some((apart, named.collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_kinds_that_grains_are_of_tell_them_apart_and_materials_before_groups() {
        let names = Names {
            materials: ["glass", "wall", "steel"].map(str::to_owned).to_vec(),
            groups: ["bed", "shot"].map(str::to_owned).to_vec(),
        };
        let portrait = |materials: [u8; 2], groups: [u32; 2]| Portrait {
            centres: Vec::new(),
            radii: Vec::new(),
            squeeze: Vec::new(),
            plastic: Vec::new(),
            materials: materials.to_vec(),
            groups: groups.to_vec(),
            bodies: Vec::new(),
            unit: 1.0,
            time: 0.0,
            stage: String::new(),
        };
        let apart = |materials, groups| names.apart(&[&portrait(materials, groups)]);
        let found = apart([2, 0], [0, 1]).unwrap();
        assert_eq!(found, (Apart::Material, vec![(0, "glass"), (2, "steel")]));
        let found = apart([0, 0], [0, 1]).unwrap();
        assert_eq!(found, (Apart::Group, vec![(0, "bed"), (1, "shot")]));
        assert_eq!(apart([0, 0], [1, 1]), None);
    }
}
