//! What the stresses of a rigid core say at its nodes (docs/theory.md, section 19).
//!
//! In: stresses at the point at which the core has full rank. Out: the nodes of which all members are
//! determined together (Theorem 19.11): the sums of the stresses over the members at the node, side by
//! side, have all the rank that they can have.

use crate::contract::piece::Core;
use crate::decide::evidence::Evidence;
use crate::linalg::Ring;
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::linalg::textbook;
use std::collections::BTreeMap;

/// Stresses, and what they show.
pub(super) struct Stressed {
    /// Why the core is rigid where the stresses are.
    pub(super) evidence: Evidence,
    /// The stresses, as docs/certificate.md lists them, by residues.
    pub(super) vectors: Vec<Vec<u64>>,
    /// Nodes, each followed by one more node of each member that holds it.
    pub(super) nodes: Vec<Vec<u32>>,
}

/// For each core node the members at it, each with its edges there and whether they begin there.
pub(super) type Stars = Vec<BTreeMap<u32, Vec<(usize, bool)>>>;

/// The stars of all core nodes.
pub(super) fn stars(core: &Core) -> Stars {
    let mut stars = vec![BTreeMap::new(); core.graph.nodes()];
    for ((e, &(i, j)), &owner) in (0..).zip(core.graph.edges()).zip(&core.owner) {
        for (v, begins) in [(i, true), (j, false)] {
            let edges: &mut Vec<_> = stars[v as usize].entry(owner).or_default();
            edges.push((e, begins));
        }
    }
    stars
}

/// As many stresses as the largest star needs, three rows each, and one more.
pub(super) fn enough(stars: &Stars) -> usize {
    let members = stars.iter().map(BTreeMap::len).max().unwrap_or(1);
    (4 * (members - 1)).div_ceil(3) + 1
}

/// The nodes of which all members are determined together.
pub(super) fn joined(
    field: &PrimeField,
    core: &Core,
    stars: Stars,
    stresses: &[Vec<u64>],
    on: impl Fn(&[u64], usize) -> [[u64; 4]; 3],
) -> Vec<Vec<u32>> {
    let mut joined = Vec::new();
    for (v, star) in stars.iter().enumerate() {
        let wanted = 4 * star.len().saturating_sub(1);
        if wanted == 0 || 3 * stresses.len() < wanted {
            continue;
        }
        let (rows, width) = (3 * stresses.len(), 4 * star.len());
        let mut sums = Matrix::new(rows, width, vec![0; rows * width]);
        for (s, stress) in stresses.iter().enumerate() {
            for (b, &(e, begins)) in (0..)
                .zip(star.values())
                .flat_map(|(b, edges)| edges.iter().map(move |edge| (b, edge)))
            {
                for (r, entries) in on(stress, e).iter().enumerate() {
                    for (k, entry) in entries.iter().enumerate() {
                        let sum = &mut sums.row_mut(3 * s + r)[4 * b + k];
                        let entry = if begins { *entry } else { field.neg(entry) };
                        *sum = field.add(sum, &entry);
                    }
                }
            }
        }
        if textbook::eliminate(field, &sums).rank() == wanted {
            let ends = star.values().map(|edges| {
                let (i, j) = core.graph.edges()[edges[0].0];
                if edges[0].1 { j } else { i }
            });
            let at = std::iter::once(v as u32).chain(ends);
            joined.push(at.map(|v| core.nodes[v as usize]).collect());
        }
    }
    joined
}
