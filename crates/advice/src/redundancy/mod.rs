//! What a graph can notice: pairs that the rest checks, what may be lost, and pairs that are
//! determined though never matched (docs/theory.md, section 15; docs/reconstruction.md).

mod losses;
mod named;
mod redundant;
mod surplus;
#[cfg(test)]
mod tests;

pub use named::{Broken, Group, GroupsOf, Implied, ImpliedSet, Redundant, SurplusItem, Surpluses};
pub use redundant::{Break, Lost, UnknownLoss, redundant};
pub use surplus::{Surplus, surplus};
