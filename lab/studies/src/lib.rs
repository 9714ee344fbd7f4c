//! Studies beside the verifier: formulations of the literature side by side, necessary and sufficient conditions.

pub mod conditions;
pub mod dense;
pub mod formulation;
pub mod paper_components;
pub mod published;
pub mod study;
