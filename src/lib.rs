//! Exact, certified solvability of viewing graphs.
//!
//! Data flows one way: a [`graph`] is read, its question is reduced and decided
//! with [`exact`] arithmetic, and the answer leaves with its evidence. A module
//! never imports one that stands below it in this list.

pub mod body;
pub mod bound;
pub mod component;
pub mod exact;
pub mod formulation;
pub mod graph;
pub mod model;
pub mod piece;
pub mod union_find;
