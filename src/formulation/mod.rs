//! Formulations of the question: which matrix has the rank that decides.

pub mod plane_flow;
pub mod skew;
