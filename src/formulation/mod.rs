//! Matrices whose rank decides solvability, one file a formulation.

pub mod plane_flow;
