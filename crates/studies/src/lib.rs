//! Studies beside the verifier: formulations of the literature side by side, the float audit,
//! necessary and sufficient conditions.

pub mod audit;
pub mod conditions;
pub mod enclosure;
pub mod formulation;
pub mod paper_components;
