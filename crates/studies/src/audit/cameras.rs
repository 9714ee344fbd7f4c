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

/// Cameras with entries uniform in [0, 1), scaled to norm 10, one a node. The entries have
/// 53 random bits, so that a camera of rank below 3 or coincident centres do not occur in
/// practice; they would show as a singular J.
pub fn draw(graph: &Graph, seed: u64, draw: u64) -> Vec<Camera> {
    let field = PrimeField::mersenne61();
    let key = DrawKey {
        graph_sha256: sha256(graph),
        core_sha256: None,
        seed,
        draw,
    };
    let mut residue = key.residues(&field);
    let mut entry = || (field.to_u64(residue()) >> 8) as f64 / (1u64 << 53) as f64;
    (0..graph.nodes())
        .map(|_| {
            let mut camera = std::array::from_fn(|_| std::array::from_fn(|_| entry()));
            normalise(&mut camera);
            camera
        })
        .collect()
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
