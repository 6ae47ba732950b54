//! Mesh of half the section of a layer below a contact: quadrilaterals of eight nodes in rows and columns, fine at the contact and growing
//! towards the rim and the back that is held. Lengths in radii of the particle; the surface lies at height 0.

use super::mesh::Point;
use crate::plan::graded;
use std::collections::HashMap;

/// Depth to which elements stay fine over the width to which they do.
const DEPTH: f64 = 0.65;
/// Growth from element to element beyond.
const GROWTH: f64 = 1.2;

/// A mesh; nodes are counted from 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Nodes.
    pub nodes: Vec<Point>,
    /// Corners, then the nodes amid the sides between them, both counter-clockwise from the lower corner next to the axis.
    pub elements: Vec<[usize; 8]>,
    /// Elements whose third side is the surface, from the axis on.
    pub top: Vec<usize>,
}

impl Layer {
    /// Mesh of a layer of a `width` and a `depth`, with elements of at most the size `size` up to `fine` from the axis. It begins at the distance
    /// `inner` from it.
    #[must_use]
    pub fn new(inner: f64, [width, depth]: [f64; 2], size: f64, fine: f64) -> Self {
        // all elements are made smaller so that they end at the width, by less than the growth: what is fine would end too soon
        let fine = GROWTH * fine;
        let across = graded(width - inner, size, fine, GROWTH, width);
        let down = graded(depth, size, DEPTH * fine, GROWTH, depth);
        let columns = across.len();
        let mut nodes: Vec<Point> = Vec::new();
        for z in &down {
            nodes.extend(across.iter().map(|r| [inner + r, -z]));
        }
        let mut mesh = Layer {
            nodes,
            elements: Vec::new(),
            top: Vec::new(),
        };
        let mut middles: HashMap<[usize; 2], usize> = HashMap::new();
        for k in 0..down.len() - 1 {
            for i in 0..columns - 1 {
                let corners = [(0, 1), (1, 1), (1, 0), (0, 0)]
                    .map(|(right, below)| (k + below) * columns + i + right);
                let amid = std::array::from_fn::<usize, 4, _>(|s| {
                    let [a, b] = [corners[s], corners[(s + 1) % 4]];
                    *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                        let [p, q] = [mesh.nodes[a], mesh.nodes[b]];
                        mesh.nodes.push([0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]);
                        mesh.nodes.len() - 1
                    })
                });
                if k == 0 {
                    mesh.top.push(mesh.elements.len());
                }
                let ([a, b, c, d], [e, f, g, h]) = (corners, amid);
                mesh.elements.push([a, b, c, d, e, f, g, h]);
            }
        }
        mesh
    }

    /// Nodes of the back.
    pub fn back(&self) -> impl Iterator<Item = usize> {
        let lowest = self.nodes.iter().fold(0.0f64, |least, p| least.min(p[1]));
        let all = self.nodes.iter().enumerate();
        all.filter(move |(_, p)| p[1] == lowest).map(|(n, _)| n)
    }

    /// Nodes next to the axis.
    pub fn inmost(&self) -> impl Iterator<Item = usize> {
        let inner = self
            .nodes
            .iter()
            .fold(f64::INFINITY, |least, p| least.min(p[0]));
        let all = self.nodes.iter().enumerate();
        all.filter(move |(_, p)| p[0] == inner).map(|(n, _)| n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn elements_fill_the_layer_once_and_share_their_sides() {
        let (inner, width, depth) = (1e-5, 20.0, 12.0);
        let mesh = Layer::new(inner, [width, depth], 0.02, 0.2);
        let volume: f64 = (mesh.elements.iter())
            .map(|nodes| {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| mesh.nodes[nodes[k]]);
                assert!(a[0] < b[0] && a[1] < d[1] && a[1] == b[1] && c[1] == d[1]);
                PI * (b[0] * b[0] - a[0] * a[0]) * (d[1] - a[1])
            })
            .sum();
        let whole = PI * (width * width - inner * inner) * depth;
        assert!((volume / whole - 1.0).abs() < 1e-12);
        let mut sides: HashMap<[usize; 3], usize> = HashMap::new();
        for nodes in &mesh.elements {
            for s in 0..4 {
                let [a, b] = [nodes[s], nodes[(s + 1) % 4]];
                let middle = mesh.nodes[nodes[4 + s]];
                assert_eq!(middle[0], 0.5 * (mesh.nodes[a][0] + mesh.nodes[b][0]));
                *sides.entry([a.min(b), a.max(b), nodes[4 + s]]).or_default() += 1;
            }
        }
        assert!(sides.values().all(|count| *count <= 2));
        // the surface is one line of third sides at height 0, fine up to the given distance
        let mut end = inner;
        for element in &mesh.top {
            let [.., c, d] = [0, 1, 2, 3].map(|k| mesh.nodes[mesh.elements[*element][k]]);
            assert!(c[1] == 0.0 && d[1] == 0.0 && d[0] == end);
            // all are made smaller by what lets them end at the width
            let share = (c[0] - d[0]) / 0.02;
            assert!(d[0] > 0.19 || (0.8..1.001).contains(&share), "{share}");
            end = c[0];
        }
        assert_eq!(end, width);
        assert_eq!(mesh.back().count(), 2 * mesh.top.len() + 1);
        assert!(mesh.inmost().all(|n| mesh.nodes[n][0] == inner));
    }
}
