//! Exact, certified solvability of viewing graphs.
//!
//! Data flows one way: a [`graph`] is contracted to bodies and cut into pieces ([`contract`]);
//! each piece is decided with exact arithmetic ([`linalg`]) at drawn cameras ([`geometry`]), its
//! components are found and upper bounds are counted ([`decide`]); the verdict leaves with its
//! evidence as a [`certificate`].

pub mod certificate;
pub mod contract;
pub mod decide;
pub mod geometry;
pub mod graph;
pub mod linalg;
pub mod watch;
pub mod wording;
