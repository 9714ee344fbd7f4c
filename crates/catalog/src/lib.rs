//! Internal to viewcert, and may change at any time.
//!
//! The catalog of small viewing graphs.
//!
//! [`candidates`](mod@candidates) makes the biconnected graphs with some numbers of nodes and pairs, one of each
//! isomorphism class; [`mine`] decides them; [`invariants`] describes a graph, and a [`label`] names it.

pub mod candidates;
pub mod invariants;
pub mod label;
pub mod mine;

pub use candidates::{SizeError, candidates, least_edges};
