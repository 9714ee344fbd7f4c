//! What may be lost: whether every component stays one whichever pair, or image, of it is missing.
//!
//! In: a graph and its components. Out: for each component that breaks a pair or an image without which it does,
//! which is what `weak` looks for.

use crate::parts::Parts;
use crate::weak::{weak_images, weak_pairs};
use std::fmt;
use std::str::FromStr;
use viewcert::decide::{Options, VerdictError};
use viewcert::{Graph, Strength};

/// What is lost, written as `1` or `images:1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lost {
    /// A pair.
    Pair,
    /// An image.
    Image,
}

impl FromStr for Lost {
    type Err = UnknownLoss;

    fn from_str(text: &str) -> Result<Self, UnknownLoss> {
        match text {
            "1" => Ok(Self::Pair),
            "images:1" => Ok(Self::Image),
            _ => Err(UnknownLoss),
        }
    }
}

/// A text that does not say what is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownLoss;

impl fmt::Display for UnknownLoss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "what is lost is 1 pair, or images:1; of two, leave out each pair in turn and ask about the rest \
             (docs/reconstruction.md, What can be noticed)",
        )
    }
}

impl std::error::Error for UnknownLoss {}

/// A component that breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Break {
    /// Its place in the verdict.
    pub component: usize,
    /// Without this it falls apart: the two images of a pair, or one image.
    pub without: Vec<u32>,
    /// How strong that is.
    pub strength: Strength,
}

/// The components of three images and more that do not stay finite solvable whatever is lost, each
/// with the first that is weak in it, by component. That the others stay is proved. Of images, what counts is the
/// rest of the component. As [`weak_pairs`] and [`weak_images`].
///
/// # Errors
/// Those of a decision.
pub fn redundant(
    graph: &Graph,
    parts: &Parts,
    lost: Lost,
    options: &Options,
) -> Result<Vec<Break>, VerdictError> {
    let mut found: Vec<Break> = match lost {
        Lost::Pair => weak_pairs(graph, parts, options)?
            .into_iter()
            .map(|weak| Break {
                component: weak.component,
                without: vec![weak.pair.0, weak.pair.1],
                strength: weak.strength,
            })
            .collect(),
        Lost::Image => weak_images(graph, parts, options)?
            .into_iter()
            .map(|weak| Break {
                component: weak.component,
                without: vec![weak.image],
                strength: weak.strength,
            })
            .collect(),
    };
    found.sort_by_key(|one| one.component);
    found.dedup_by_key(|one| one.component);
    Ok(found)
}
