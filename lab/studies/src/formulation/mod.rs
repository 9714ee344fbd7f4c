//! Formulations of the question: which matrix has the rank that decides.
//!
//! Every formulation of the literature is a matrix whose kernel, beyond a trivial part
//! known in advance, is the space of motions that keep the fundamental matrices. At the
//! same cameras all of them have the same *excess*: the dimension of that space modulo
//! trivial motions, zero exactly for finite solvable graphs at generic cameras.

pub mod affine;
pub mod augmented;
pub mod compare;
pub mod edge_based;
pub mod explicit;
pub mod implicit;

pub mod plane_ranks;
pub mod rank;
pub mod skew;

use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::Graph;
use viewcert::linalg::Field;

/// A matrix whose rank decides finite solvability.
pub trait Formulation<F: Field> {
    /// A short name.
    fn name(&self) -> &'static str;

    /// Where it was published.
    fn source(&self) -> &'static str;

    /// Rows and columns in words: a formula in n, m, the degrees d_v.
    fn size_formula(&self) -> [&'static str; 2];

    /// Rows and columns by that formula.
    fn size(&self, graph: &Graph) -> (usize, usize);

    /// The dimension of the kernel of a finite solvable graph at generic cameras.
    fn trivial_kernel(&self, graph: &Graph) -> usize;

    /// The rank of a finite solvable graph at generic cameras.
    fn full_rank(&self, graph: &Graph) -> usize {
        self.size(graph).1 - self.trivial_kernel(graph)
    }

    /// Dimensions of motions for which the matrix has no columns: cameras without pairs,
    /// where the unknowns belong to pairs.
    fn unseen(&self, _graph: &Graph) -> usize {
        0
    }

    /// Whether the charts and the rows that fix the trivial motions are defined at these
    /// cameras. Generic cameras are always admitted.
    fn admits(&self, _field: &F, _graph: &Graph, _cameras: &[Camera<F::Elem>]) -> bool {
        true
    }

    /// The matrix at cameras of rank 3, with distinct centres on edges, that it admits.
    ///
    /// # Panics
    /// If there is not one camera a node, or cameras are not admitted.
    fn matrix(&self, field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> SparseRows<F::Elem>;
}

/// All formulations in one matrix, in the order of their publication. Plane flows take two
/// matrices, of which the second follows from the first ([`plane_ranks`]).
pub fn all<F: Field + 'static>() -> [&'static dyn Formulation<F>; 5] {
    [
        &edge_based::full::EdgeFull,
        &edge_based::reduced::EdgeReduced,
        &explicit::ExplicitMap,
        &skew::Skew,
        &augmented::Augmented,
    ]
}
