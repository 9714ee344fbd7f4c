//! The formulation of the paper: J_P alone, without the gauge.

use super::Formulation;
use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian::{SparseRows, jacobian};
use viewcert::graph::Graph;
use viewcert::linalg::Field;

/// The paper's J_P: rank 11n - 15 exactly for finite solvable graphs (its Theorem 1).
#[derive(Clone, Copy, Debug)]
pub struct Skew;

impl<F: Field> Formulation<F> for Skew {
    fn name(&self) -> &'static str {
        "skew"
    }

    fn source(&self) -> &'static str {
        "Arrigoni, Kohn, Fusiello, Pajdla, Theorem 1"
    }

    fn size_formula(&self) -> [&'static str; 2] {
        ["10m", "12n"]
    }

    fn size(&self, graph: &Graph) -> (usize, usize) {
        (10 * graph.edges().len(), 12 * graph.nodes())
    }

    fn trivial_kernel(&self, graph: &Graph) -> usize {
        graph.nodes() + 15
    }

    fn matrix(&self, field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> SparseRows<F::Elem> {
        jacobian(field, graph, cameras)
    }
}
