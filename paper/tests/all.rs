//! All tests of the workshop, as one program.

#[path = "../../tests/common/mod.rs"]
mod common;

mod census;
mod full_disk;
mod man;
mod mixtures;
mod outputs;
mod paper;
mod publish;
mod random;
mod solutions;
