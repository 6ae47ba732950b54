//! Hold of a body that is flattened slowly: as its own inertia holds it in an impact, by a force in proportion to its mass.
//!
//! One linear equation does it: the mean of the axial displacement over the volume is prescribed, and the force that this takes is
//! spread as the mean is. A mean over all nodes would couple all of them; one over some hundred is as good and costs nothing.

use super::mesh::{Mesh, Point};
use nalgebra::{Matrix6, Vector6};

/// Least distance of two nodes of the mean, in radii.
const APART: f64 = 0.1;

/// Nodes with their shares of the mean, which add up to 1.
///
/// Each node of the mean stands for the volume that is nearest to it; the shares are then changed by as little as makes the mean of every
/// polynomial of the third degree in r and z that is even in r exact for the sphere.
#[must_use]
pub fn mean(mesh: &Mesh) -> Vec<(usize, f64)> {
    let mut volumes = vec![0.0; mesh.nodes.len()];
    for (element, nodes) in mesh.elements.iter().enumerate() {
        for sample in mesh.samples(element) {
            for (share, node) in sample.corners.iter().zip(nodes) {
                volumes[*node] += share * sample.volume;
            }
        }
    }
    let apart = |a: Point, b: Point| (a[0] - b[0]).hypot(a[1] - b[1]);
    let mut chosen: Vec<usize> = Vec::new();
    let corners = || (0..volumes.len()).filter(|node| volumes[*node] != 0.0);
    for node in corners() {
        let at = mesh.nodes[node];
        // a ring of no radius would take a force at a point
        if at[0] > 0.0 && chosen.iter().all(|n| apart(mesh.nodes[*n], at) >= APART) {
            chosen.push(node);
        }
    }
    let mut shares = vec![0.0; chosen.len()];
    let total: f64 = volumes.iter().sum();
    for node in corners() {
        let distance = |k: &usize| apart(mesh.nodes[chosen[*k]], mesh.nodes[node]);
        let nearest = (0..chosen.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        shares[nearest.unwrap_or(0)] += volumes[node] / total;
    }
    let places: Vec<Vector6<f64>> = chosen.iter().map(|n| terms(mesh.nodes[*n])).collect();
    let mut matrix = Matrix6::zeros();
    let mut misfit = EXACT;
    for (share, place) in shares.iter().zip(&places) {
        matrix += place * place.transpose() * *share;
        misfit -= place * *share;
    }
    let change = matrix.lu().solve(&misfit).unwrap_or_default();
    let shares = shares.iter().zip(&places);
    let shares = shares.map(|(share, place)| share * (1.0 + change.dot(place)));
    chosen.iter().copied().zip(shares).collect()
}

/// 1, z, z², r², z³ and r² z from the centre.
fn terms([r, z]: Point) -> Vector6<f64> {
    let z = z - 1.0;
    Vector6::new(1.0, z, z * z, r * r, z.powi(3), r * r * z)
}

/// Their means over a sphere.
const EXACT: Vector6<f64> = Vector6::new(1.0, 0.0, 0.2, 0.4, 0.0, 0.0);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_is_exact_for_uniform_strain_and_bending_and_no_node_pulls() {
        for (fine, cells) in [(1e-3, 10), (0.05, 12), (0.2, 4), (0.55, 20), (0.8, 24)] {
            let mesh = Mesh::new(fine, cells);
            let mean = mean(&mesh);
            let mut sum = Vector6::zeros();
            for (node, share) in &mean {
                assert!(*share > 0.0, "{fine} {cells}: {share}");
                // a ring that takes a tenth of the force far away is felt by a tenth of what Hertz's force moves the far body
                assert!(*share < 0.1, "{fine} {cells}: {share}");
                sum += terms(mesh.nodes[*node]) * *share;
            }
            assert!((sum - EXACT).norm() < 1e-12, "{fine} {cells}: {sum}");
            assert!((40..400).contains(&mean.len()), "{}", mean.len());
        }
    }
}
