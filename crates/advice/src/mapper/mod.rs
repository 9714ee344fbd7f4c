//! What COLMAP's mappers will probably do with a database: a simulation, and no proof.
//!
//! In: for each mapper the pairs that COLMAP 4.2 takes, the matches, the camera-point graph of the tracks,
//! and what is known of the geometry of pairs. Out: the models of incremental mapping, with what each
//! starts from and where it stops, and the models of global mapping ([`Foreseen`]).
//!
//! COLMAP registers frames, not images: an image that sees enough brings all of its frame along.
//!
//! COLMAP estimates poses and triangulates; here only its thresholds are applied to numbers of
//! points ([`Thresholds`]), and points are taken to be right. No verdict and no certificate depends
//! on this module, and it is the only one of the library that says what is likely. How often it was
//! right is in docs/reconstruction.md.

mod features;
mod geometry;
mod global;
mod growth;
mod incremental;
mod named;
mod starts;
mod thresholds;

pub use features::Features;
pub use geometry::Geometry;
pub use incremental::{Incremental, SimulatedModel, Stop, incremental};
pub use named::{Beginning, Foreseen, Global, GlobalModel, Model, Models, Sees, Taken, foresee};
pub use starts::{Start, Unfit};
pub use thresholds::Thresholds;

/// What incremental mapping has to begin with.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The features of the images, and their matches.
    pub features: &'a Features,
    /// How many images there are.
    pub images: usize,
    /// The pairs with enough verified matches, and how many they have; the smaller image first.
    pub pairs: &'a [((u32, u32), u32)],
    /// The images of every frame that has several: they are placed together, as the rig says how they lie
    /// to each other.
    pub frames: &'a [Vec<u32>],
}

#[cfg(test)]
mod tests;
