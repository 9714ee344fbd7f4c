//! All 20 equations for every two pairs that meet (Trager, Osserman, Ponce, ECCV 2018).

use crate::formulation::Formulation;
use crate::formulation::edge_based::{matrix, stars, twenty, unseen};
use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::Graph;
use viewcert::linalg::Field;

/// 20 equations for every two edges at a node: full column rank 16m exactly for finite
/// solvable graphs.
#[derive(Clone, Copy, Debug)]
pub struct EdgeFull;

impl<F: Field> Formulation<F> for EdgeFull {
    fn name(&self) -> &'static str {
        "edge-based, full"
    }

    fn source(&self) -> &'static str {
        "Trager, Osserman, Ponce, ECCV 2018"
    }

    fn size_formula(&self) -> [&'static str; 2] {
        ["10 sum d_v^2 - 19m + 15", "16m"]
    }

    fn size(&self, graph: &Graph) -> (usize, usize) {
        let edges = graph.edges().len();
        let squares: usize = stars(graph).iter().map(|star| star.len().pow(2)).sum();
        (10 * squares + 15 - 19 * edges, 16 * edges)
    }

    fn trivial_kernel(&self, _graph: &Graph) -> usize {
        0
    }

    fn unseen(&self, graph: &Graph) -> usize {
        unseen(graph)
    }

    fn matrix(&self, field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> SparseRows<F::Elem> {
        let pairs = |star: &[usize]| {
            let later = |(k, &e): (usize, &usize)| {
                let rest = star[k + 1..].to_vec();
                rest.into_iter().map(move |other| (e, other))
            };
            star.iter().enumerate().flat_map(later).collect()
        };
        matrix(field, graph, cameras, twenty, pairs)
    }
}
