//! Whether the optical axes of all images are parallel, by the relative rotations of pairs: then focal length
//! and heights scale together, whatever the guess of the focal length is that rotations were found with
//! (docs/theory.md, Proposition 17.17). Measured in floating point, and no part of a verdict.

use super::pairs::Pair;
use super::{DatabaseFacts, Estimate};
use crate::error::Problem;
use crate::vectors::Vector;
use std::cmp::Reverse;
use std::collections::VecDeque;
use viewcert::graph::{Lists, UnionFind};

/// From one degree of tilt on mappers find focal lengths.
const PARALLEL: f64 = 0.5;

/// With one image so many degrees off nothing more is looked at.
const OFF: f64 = 5.0;

/// Whether the axes deviate by so little, in the median, from the axis of the first image, along the pairs with
/// most inliers; not if these leave images apart. O(pairs log pairs), and what `geometry` takes for one pair
/// an image, of few images unless axes are parallel.
pub(super) fn are_parallel(
    pairs: &[Pair],
    facts: &DatabaseFacts,
    mut geometry: impl FnMut((u32, u32)) -> Result<Option<Estimate>, Problem>,
) -> Result<bool, Problem> {
    let mut tree: Vec<&Pair> = pairs.iter().filter(|pair| pair.used).collect();
    tree.sort_by_key(|pair| Reverse(pair.inliers));
    let mut sets = UnionFind::new(facts.images);
    tree.retain(|pair| sets.union(pair.nodes.0 as usize, pair.nodes.1 as usize));
    let paired = facts.images - facts.images_without_pair;
    let Some(first) = tree.first().filter(|_| tree.len() + 1 == paired) else {
        return Ok(false);
    };
    let ends = tree.iter().map(|pair| pair.nodes);
    let near = Lists::group(facts.images, ends.flat_map(|(a, b)| [(a, b), (b, a)]));
    // The axis of the first image as each image sees it.
    let axis: Vector = [0.0, 0.0, 1.0];
    let (mut open, mut off) = (
        VecDeque::from([(first.nodes.0, u32::MAX, axis)]),
        Vec::new(),
    );
    while let Some((image, from, axis)) = open.pop_front() {
        off.push(axis[2].clamp(-1.0, 1.0).acos().to_degrees());
        if off.last().is_some_and(|&off| off > OFF) {
            return Ok(false);
        }
        for &other in near
            .of(image as usize)
            .iter()
            .filter(|&&other| other != from)
        {
            let known = geometry((image, other))?;
            let Some((turn, [one, _])) = known.and_then(|it| Some((it.rotation?, it.images)))
            else {
                return Ok(false);
            };
            open.push_back((other, image, turned(&turn, axis, one == image)));
        }
    }
    off.sort_by(f64::total_cmp);
    Ok(off[off.len() / 2] < PARALLEL)
}

/// R v, or R^T v.
fn turned(r: &[Vector; 3], v: Vector, forth: bool) -> Vector {
    [0, 1, 2].map(|i| {
        (0..3)
            .map(|k| v[k] * if forth { r[i][k] } else { r[k][i] })
            .sum()
    })
}
