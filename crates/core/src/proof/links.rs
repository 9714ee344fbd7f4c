//! What a proof says of a set of nodes that is uniquely determined: links and their scales
//! (docs/theory.md, Theorem 10.6; docs/proof.md, `unique`).

use super::listed::{Join, Reason};
use std::collections::BTreeSet;

/// A set that is uniquely determined, node after node.
#[derive(Clone, Debug, Default)]
pub(super) struct Unique {
    /// The nodes it begins with, with centres modulo 65521.
    pub(super) core: Vec<(u32, [u32; 3])>,
    /// Centres of nodes between two of these.
    pub(super) middle: Vec<(u32, [u32; 3])>,
    /// For each core node but the first a link that ends there.
    pub(super) tree: Vec<Link>,
    /// How scales are settled, one after the other.
    pub(super) steps: Vec<Step>,
    /// The nodes behind the core.
    pub(super) joins: Vec<Join>,
}

/// Two nodes whose scales can be compared.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) ends: [u32; 2],
    pub(super) via: Via,
}

/// Why they can.
#[derive(Clone, Copy, Debug)]
pub(super) enum Via {
    /// Both are in one set; a coordinate of its planes.
    Pair { plane: usize, why: Reason },
    /// Each is in a set with this node.
    Middle { node: u32, whys: [Reason; 2] },
}

/// A link whose scale is one.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// The first of some links that are freed.
    Settle(Vec<Link>),
    /// Of the first and the last node, as both have it with the one between.
    Corner([u32; 3], Reason),
}

/// A set that is uniquely determined, and why pairs of its nodes may be used.
#[derive(Clone, Debug)]
pub(super) struct Member {
    pub(super) nodes: BTreeSet<u32>,
    pub(super) why: Reason,
}

/// All pairs of numbers below this one.
pub(super) fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |k| (k + 1..count).map(move |l| (k, l)))
}
