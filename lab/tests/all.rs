//! All tests of the laboratory, as one program.

#[path = "../../tests/common/mod.rs"]
mod common;

mod affine;
mod catalog;
mod census;
mod compare;
mod conditions;
mod full_disk;
mod man;
mod mixtures;
mod motion;
mod outputs;
mod paper;
mod paper_components;
mod publish;
mod random;
mod running;
mod solutions;
mod tolerances;
