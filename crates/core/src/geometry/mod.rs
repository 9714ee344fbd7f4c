//! Cameras and what pairs of them say (docs/theory.md, sections 1 to 3).
//!
//! In: a graph, a field or ring, a key of random draws. Out: cameras and centres ([`camera`],
//! [`draw`]),
//! the paper's Jacobian J_P ([`jacobian`]), the bearing matrix N with plane flows and Lambda
//! ([`plane_flow`]), its counterpart for points in the plane ([`plane_direction`]); and the questions that are asked of them ([`model`]).

pub mod camera;
pub mod draw;
pub mod jacobian;
pub mod model;
pub mod plane_direction;
pub mod plane_flow;

pub(crate) mod placed;
