//! How many solutions a finite solvable graph has (docs/theory.md, section 10).
//!
//! In: a graph. It is contracted to members (`members`), whose shared nodes form a core with a
//! few unknown scales (`chart`). Out: bounds for the number of solutions and what they rest
//! on: scales that are one by linear algebra (`linear`, Theorem 10.6), points near which all others
//! are, by the span of minors (`points` and `span`, Theorem 10.8), and simple points of tight cores (`simple`, Theorem 10.10). Every bound is a proof; what it rests on
//! is in `evidence`. A second solution can be looked at (`witness`).

mod chart;
mod count;
mod evidence;
mod exponents;
mod linear;
mod members;
mod minors;
mod points;
mod roots;
mod simple;
mod span;
mod system;
#[cfg(test)]
mod tests;
mod witness;
mod zeros;

pub use count::count;
pub(crate) use count::count_in;
pub use evidence::{
    AtMost, Chart, Linear, Lower, Minor, Part, Place, Rule, Scale, Solutions, Upper,
};
pub use members::MOST_NODES;
pub(crate) use members::nodes_of;
pub use witness::Witness;
