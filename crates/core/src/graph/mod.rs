//! The viewing graph: cameras as nodes, pairs with a fundamental matrix as edges.
//!
//! In: pairs of numbers, or of labels. Out: a
//! [`Graph`], its hash ([`identity`]) and graph6 text ([`graph6`]), [`Labels`], and what the
//! contraction of docs/theory.md, section 4, needs: neighbours, biconnected components, sets; and
//! what is known beside the pairs ([`KnownParts`]).

mod adjacency;
mod biconnected;
mod displacements;
mod error;
pub mod graph6;
pub mod identity;
mod known_parts;
mod labelled;
pub mod labels;
mod leaves;
mod lists;
mod sort;
mod union_find;
mod vectors;
mod viewing_graph;

pub use adjacency::Adjacency;
pub use biconnected::biconnected_components;
pub use displacements::{Displacements, VectorError};
pub use error::GraphError;
pub use identity::{core_sha256, sha256};
pub use known_parts::KnownParts;
pub use labelled::{LabelledGraph, PairedWithItself};
pub use labels::Labels;
pub use leaves::prune_leaves;
pub use lists::Lists;
pub(crate) use sort::sort_once;
pub use union_find::UnionFind;
pub use vectors::{CoordinateError, coordinate};
pub(crate) use vectors::{Hanging, gcd};
pub use viewing_graph::Graph;

#[cfg(test)]
mod tests;
