//! Cameras in double precision.

use super::doubles::Doubles;
use viewcert::geometry::camera;
use viewcert::geometry::draw::DrawKey;
use viewcert::geometry::jacobian;
use viewcert::graph::{Graph, sha256};
use viewcert::linalg::prime::PrimeField;

/// The Frobenius norm of cameras and of fundamental matrices.
pub const NORM: f64 = 10.0;

/// A camera, row by row.
pub type Camera = camera::Camera<f64>;

/// Scales a matrix to Frobenius norm [`NORM`].
pub fn normalise<const R: usize, const C: usize>(matrix: &mut [[f64; C]; R]) {
    let squares: f64 = matrix.iter().flatten().map(|x| x * x).sum();
    let scale = NORM / squares.sqrt();
    for x in matrix.iter_mut().flatten() {
        *x *= scale;
    }
}

/// Numbers uniform in [0, 1), with 53 random bits each.
pub fn uniform(graph: &Graph, seed: u64, draw: u64, count: usize) -> Vec<f64> {
    let field = PrimeField::mersenne61();
    let key = DrawKey {
        graph_sha256: sha256(graph),
        core_sha256: None,
        seed,
        draw,
    };
    let mut residue = key.residues(&field);
    let mut entry = || (field.to_u64(residue()) >> 8) as f64 / (1u64 << 53) as f64;
    (0..count).map(|_| entry()).collect()
}

/// Cameras with entries uniform in [0, 1), scaled to norm 10, one a node. The entries have
/// 53 random bits, so that a camera of rank below 3 or coincident centres do not occur in
/// practice; they would show as a singular J.
pub fn draw(graph: &Graph, seed: u64, draw: u64) -> Vec<Camera> {
    let entries = uniform(graph, seed, draw, 12 * graph.nodes());
    let camera = |entries: &[f64]| {
        let mut camera = std::array::from_fn(|r| std::array::from_fn(|c| entries[4 * r + c]));
        normalise(&mut camera);
        camera
    };
    entries.chunks_exact(12).map(camera).collect()
}

/// The fundamental matrix of
/// [`jacobian::fundamental`], scaled to norm 10.
pub fn fundamental(p_i: &Camera, p_j: &Camera) -> [[f64; 3]; 3] {
    let mut f = jacobian::fundamental(&Doubles, p_i, p_j);
    normalise(&mut f);
    f
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_and_repeatability() {
        let (graph, _) = Graph::from_pairs(3, vec![(0, 1), (1, 2)]).unwrap();
        let cameras = draw(&graph, 7, 0);
        assert_eq!(cameras, draw(&graph, 7, 0));
        assert_ne!(cameras, draw(&graph, 7, 1));
        let norm = |x: f64| (x.sqrt() - NORM).abs() < 1e-12;
        for camera in &cameras {
            assert!(norm(camera.iter().flatten().map(|x| x * x).sum()));
            assert!(camera.iter().flatten().all(|&x| x >= 0.0));
        }
        let f = fundamental(&cameras[0], &cameras[1]);
        assert!(norm(f.iter().flatten().map(|x| x * x).sum()));
    }
}
