//! What a graph can notice: pairs that the rest checks, and pairs that are determined though never matched (docs/theory.md, section 15; docs/reconstruction.md).

mod losses;
mod named;
mod surplus;
#[cfg(test)]
mod tests;

pub use named::{Group, GroupsOf, Implied, ImpliedSet, SurplusItem, Surpluses};
pub use surplus::{Surplus, surplus};
