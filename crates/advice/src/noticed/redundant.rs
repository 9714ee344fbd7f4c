//! What may be lost: whether every component stays one whichever pair, or image, of it is missing.
//!
//! In: a graph and its components. Out: for each component that breaks a pair or an image without which it does,
//! which is what `weak` looks for.

use crate::condensation::without;
use crate::parts::{Alone, Parts};
use crate::weak::{images_of, pairs_of, without_nodes};
use rayon::prelude::*;
use std::fmt;
use std::str::FromStr;
use viewcert::decide::{Options, Value, VerdictError, decide};
use viewcert::graph::Adjacency;
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
/// with what breaks it, by component. That the others stay is proved. Of images, what counts is the rest of the
/// component. As [`weak_pairs`](crate::weak_pairs) and [`weak_images`](crate::weak_images).
///
/// # Errors
/// Those of [`decide`].
pub fn redundant(
    graph: &Graph,
    parts: &Parts,
    lost: Lost,
    options: &Options,
) -> Result<Vec<Break>, VerdictError> {
    let edges = parts.edges(graph);
    let of_part = parts.parts.par_iter().zip(&edges).map(|(part, edges)| {
        let alone = Alone::new(&part.nodes, edges);
        let Some(found) = breaking(&alone.graph, lost, options)? else {
            return Ok(None);
        };
        let left = match found[..] {
            [a, b] => without(&alone.graph, &[(a, b)]),
            _ => without_nodes(&alone.graph, &found),
        };
        let verdict = decide(&left, options)?;
        assert_eq!(
            verdict.value,
            Value::NotFiniteSolvable,
            "what was found breaks"
        );
        let global = |v: u32| alone.nodes[v as usize];
        Ok(Some(Break {
            component: part.component,
            without: found.into_iter().map(global).collect(),
            strength: verdict.value_claim().strength,
        }))
    });
    let found: Result<Vec<Option<Break>>, VerdictError> = of_part.collect();
    let mut found: Vec<Break> = found?.into_iter().flatten().collect();
    found.sort_unstable_by_key(|one| one.component);
    Ok(found)
}

/// What breaks a component.
fn breaking(
    graph: &Graph,
    lost: Lost,
    options: &Options,
) -> Result<Option<Vec<u32>>, VerdictError> {
    let least = match lost {
        Lost::Pair => 3,
        Lost::Image => 4,
    };
    if graph.nodes() >= least
        && let Some((v, w)) = hanging(graph)
    {
        return Ok(Some(match lost {
            Lost::Pair => vec![v.min(w), v.max(w)],
            Lost::Image => vec![w],
        }));
    }
    Ok(match lost {
        Lost::Pair => pairs_of(graph, options)?
            .first()
            .map(|&((a, b), ..)| vec![a, b]),
        Lost::Image => images_of(graph, options)?.first().map(|&(v, ..)| vec![v]),
    })
}

/// An image with two pairs, and the other image of its first: with one pair it hangs, as 7 (2, 4) is less than the 11
/// (3, 8) that it takes, if three images are left.
fn hanging(graph: &Graph) -> Option<(u32, u32)> {
    let neighbours = Adjacency::new(graph);
    let v = (0..graph.nodes() as u32).find(|&v| neighbours.degree(v) == 2)?;
    Some((v, neighbours.neighbours(v)[0]))
}
