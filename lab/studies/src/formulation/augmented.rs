//! The paper's augmented Jacobian J (its section 4.1): J_P above the rows that fix the
//! projective frame on one pair and the scale of every camera.

use crate::formulation::Formulation;
use viewcert::geometry::camera::{Camera, centre};
use viewcert::geometry::jacobian;
use viewcert::geometry::jacobian::{SparseRows, reference};
use viewcert::graph::Graph;
use viewcert::linalg::Field;

/// Rows and columns of the augmented Jacobian.
pub(crate) fn augmented_size(graph: &Graph) -> (usize, usize) {
    let nodes = graph.nodes();
    (10 * graph.edges().len() + nodes + 15, 12 * nodes)
}

/// The augmented Jacobian with [`reference()`] as the pair that carries the frame: full
/// column rank 12n exactly for finite solvable graphs.
#[derive(Clone, Copy, Debug)]
pub struct Augmented;

impl<F: Field> Formulation<F> for Augmented {
    fn name(&self) -> &'static str {
        "augmented"
    }

    fn source(&self) -> &'static str {
        "Arrigoni, Kohn, Fusiello, Pajdla, section 4.1"
    }

    fn size_formula(&self) -> [&'static str; 2] {
        ["10m + n + 15", "12n"]
    }

    fn size(&self, graph: &Graph) -> (usize, usize) {
        augmented_size(graph)
    }

    fn trivial_kernel(&self, _graph: &Graph) -> usize {
        0
    }

    /// A trivial motion P_v X + mu_v P_v that the gauge does not exclude has, up to a
    /// multiple of I in X, X = c w^T with c the centre of the first camera; the row p of
    /// the second gives (p . c) w = -mu p, and what is left are the sums of the entries.
    fn admits(&self, field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> bool {
        let sum = |row: &[F::Elem]| row.iter().fold(field.zero(), |sum, x| field.add(&sum, x));
        let total = |camera: &Camera<F::Elem>| {
            camera
                .iter()
                .fold(field.zero(), |all, row| field.add(&all, &sum(row)))
        };
        let (first, second) = graph.edges()[reference(graph)];
        let (first, second) = (first as usize, second as usize);
        let c = centre(field, &cameras[first]);
        let image = cameras[second].clone().map(|row| {
            row.iter().zip(&c).fold(field.zero(), |all, (x, y)| {
                field.add(&all, &field.mul(x, y))
            })
        });
        let scale = field.sub(
            &field.mul(&total(&cameras[second]), &image[0]),
            &field.mul(&sum(&image), &sum(&cameras[second][0])),
        );
        let others = (0..graph.nodes()).filter(|&v| v != first && v != second);
        !field.is_zero(&image[0])
            && !field.is_zero(&scale)
            && others
                .into_iter()
                .all(|v| !field.is_zero(&total(&cameras[v])))
    }

    fn matrix(&self, field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> SparseRows<F::Elem> {
        jacobian::augmented(field, graph, cameras, reference(graph))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formulation::rank::RankField;
    use viewcert::linalg::Ring;
    use viewcert::linalg::rational::{Rational, Rationals};

    /// One pair of cameras whose gauge is complete, and the ways to break it.
    #[test]
    fn gauges_that_fail_are_not_admitted() {
        let (graph, _) = Graph::from_pairs(3, vec![(0, 1), (0, 2), (1, 2)]).unwrap();
        let camera = |rows: [[i64; 4]; 3]| -> Camera<Rational> {
            rows.map(|row| row.map(|x| Rationals.from_i64(x)))
        };
        let first = camera([[1, 2, 0, 1], [0, 1, 3, 1], [2, 0, 1, 1]]);
        let second = camera([[1, 0, 2, 1], [3, 1, 0, 0], [0, 1, 1, 2]]);
        let third = camera([[2, 1, 1, 0], [1, 0, 0, 1], [0, 3, 1, 1]]);
        // The entries of this one sum to zero.
        let flat = camera([[2, 1, 1, 0], [1, 0, 0, 1], [0, -3, -1, -2]]);
        for (third, admitted) in [(third, true), (flat, false)] {
            let cameras = [first.clone(), second.clone(), third];
            assert_eq!(Augmented.admits(&Rationals, &graph, &cameras), admitted);
            let rank = Rationals.rank(Augmented.matrix(&Rationals, &graph, &cameras), 36);
            assert_eq!(rank == 36, admitted);
        }
    }
}
