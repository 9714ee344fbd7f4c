//! Eleven equations for each link of a spanning tree of the pairs at a camera (Arrigoni,
//! Pajdla, Fusiello, ICCV 2023).

use crate::formulation::Formulation;
use crate::formulation::edge_based::{eleven, matrix, stars, unseen};
use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::Graph;
use viewcert::linalg::Field;

/// 11 equations for each two consecutive edges at a node (a path is a spanning tree, and
/// links are transitive): full column rank 16m exactly for finite solvable graphs.
#[derive(Clone, Copy, Debug)]
pub struct EdgeReduced;

impl<F: Field> Formulation<F> for EdgeReduced {
    fn name(&self) -> &'static str {
        "edge-based, reduced"
    }

    fn source(&self) -> &'static str {
        "Arrigoni, Pajdla, Fusiello, ICCV 2023"
    }

    fn size_formula(&self) -> [&'static str; 2] {
        ["23m - 11n + 15", "16m"]
    }

    /// The published formula takes every camera to have a pair; one without has no links,
    /// not -1.
    fn size(&self, graph: &Graph) -> (usize, usize) {
        let edges = graph.edges().len();
        let links: usize = stars(graph)
            .iter()
            .map(|star| star.len().saturating_sub(1))
            .sum();
        (11 * links + 15 + edges, 16 * edges)
    }

    fn trivial_kernel(&self, _graph: &Graph) -> usize {
        0
    }

    fn unseen(&self, graph: &Graph) -> usize {
        unseen(graph)
    }

    fn matrix(&self, field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> SparseRows<F::Elem> {
        let path = |star: &[usize]| star.windows(2).map(|two| (two[0], two[1])).collect();
        matrix(field, graph, cameras, eleven, path)
    }
}
