//! An upper bound on the rank of a piece with more pairs, which is one for the piece as well
//! (Corollary 5.13 of docs/theory.md).
//!
//! In: a piece whose bounds by counting and by overlaps are above its rank. Out: pairs of its nodes,
//! and such a bound for the piece with these; or nothing. The pairs are those that are implied:
//! others make the rank larger. With them parts can meet in what is rigid only together.

use crate::contract::piece::Members;
use crate::decide::drawn::Centres;
use crate::decide::error::VerdictError;
use crate::decide::evidence::{Bound, Upper};
use crate::decide::overlap;
use crate::decide::walk::Piece;
use crate::geometry::model::Model;
use crate::linalg::prime::PrimeField;
use crate::watch::Step;

/// Looks for implied pairs with which a bound is `target`, a lower bound on the rank of the piece.
///
/// # Errors
/// If cameras cannot be drawn, or the search was stopped.
pub(super) fn search(piece: &Piece, target: usize) -> Result<Option<Upper>, VerdictError> {
    let is_small = piece.core.graph.nodes() <= overlap::MAX_NODES;
    if piece.model() != Model::Projective || !is_small {
        return Ok(None);
    }
    let pairs = implied(piece)?;
    if pairs.is_empty() {
        return Ok(None);
    }
    let members = with_pairs(piece.members, &pairs);
    let core = piece.assembly.core(&members);
    let larger = piece.part(&members, &core);
    let counting = larger.counted()?.filter(|found| found.bound <= target);
    let bound = match counting {
        Some(counting) => Some(Bound::Counting(counting)),
        None => overlap::search(&larger, target)?.map(Bound::Overlap),
    };
    Ok(bound.map(|by| Upper { by, added: pairs }))
}

/// The pairs of nodes of the core, of no member both, that leave the rank as it is.
fn implied(piece: &Piece) -> Result<Vec<(u32, u32)>, VerdictError> {
    let task = piece.task(Step::Counting);
    let work = task.begin(0);
    // Where to look is not a claim: a large prime looks best.
    let field = PrimeField::mersenne61();
    let rank = |members: &Members| {
        let core = piece.assembly.core(members);
        let part = piece.part(members, &core);
        let at = Centres::draw(&field, &core, part.key(0))?;
        Ok::<_, VerdictError>(part.ranks(&at)?.rank)
    };
    let own = rank(piece.members)?;
    let singles = piece.members.singles();
    let nodes = &piece.core.nodes;
    let pairs = (0..nodes.len()).flat_map(|k| nodes[k + 1..].iter().map(move |&j| (nodes[k], j)));
    let mut found = Vec::new();
    for (i, j) in pairs {
        work.done(0)?;
        let has_both = |member| {
            [i, j]
                .iter()
                .all(|&v| piece.assembly.contains_node(member, v))
        };
        if !singles.iter().any(has_both) && rank(&with_pairs(piece.members, &[(i, j)]))? == own {
            found.push((i, j));
        }
    }
    Ok(found)
}

/// Members, and edges of these pairs.
fn with_pairs(members: &Members, pairs: &[(u32, u32)]) -> Members {
    let mut all = members.clone();
    all.extend(&Members {
        edges: pairs.to_vec(),
        bodies: Vec::new(),
    });
    all
}

#[cfg(test)]
mod tests;
