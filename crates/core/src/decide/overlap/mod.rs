//! An upper bound from two parts that overlap (Theorem 5.9 and Corollary 5.11 of docs/theory.md).
//!
//! In: a piece whose bound by counting is above its rank. Out: two sets of its members that cover
//! it, each with a bound by counting, and a lower bound for what is in both; or nothing. Where to
//! look: `separations` has the ways to cut a small core at a few nodes, [stresses](super::stresses) say which of
//! them cut its rank as well, so that the bounds of both sides can meet it.

mod separations;

use crate::contract::piece::{Members, Split};
use crate::decide::error::VerdictError;
use crate::decide::evidence::{Counting, Overlap, Shared, SharedPiece};
use crate::decide::stresses::Stresses;
use crate::decide::walk::Piece;
use crate::geometry::model::Model;
use crate::linalg::prime::PrimeField;
use crate::watch::Step;
use separations::{Cut, Separation};
use std::collections::HashMap;

/// Larger cores are not cut: with 20 nodes there are 137,979 sets of up to seven.
pub(super) const MAX_NODES: usize = 20;

/// Members are counted by the bits of a word.
const MAX_MEMBERS: usize = 64;

/// Nor are cores with more stresses, which a graph with few pairs has not.
const MAX_STRESSES: usize = 16;

/// For so many parts at most a bound by counting is looked for.
const MAX_PARTS: usize = 512;

/// Looks for an overlap whose bound is `target`, a lower bound on the rank of the piece.
///
/// # Errors
/// If cameras cannot be drawn, or the search was stopped.
pub(super) fn search(piece: &Piece, target: usize) -> Result<Option<Overlap>, VerdictError> {
    let (nodes, members) = (piece.core.graph.nodes(), piece.members.len());
    if piece.model() != Model::Projective || nodes > MAX_NODES || members > MAX_MEMBERS {
        return Ok(None);
    }
    let task = piece.task(Step::Counting);
    let work = task.begin(0);
    // Where to look is not a claim: a large prime looks best.
    let field = PrimeField::mersenne61();
    let random = &mut piece.key(0).residues(&field);
    let stresses = Stresses::new(&field, piece.core, members, random, &task)?;
    if stresses.dimension() > MAX_STRESSES {
        return Ok(None);
    }
    let cut = Cut::new(piece.core, members);
    let separations = cut.separations(|one, other| stresses.independent(one, other), &work)?;
    Search::new(piece, target).first(&separations)
}

/// Bounds of parts of a piece, found so far.
struct Search<'a> {
    piece: &'a Piece<'a>,
    target: usize,
    /// The bound by counting that is the rank, of each part that was looked at.
    bounds: HashMap<u64, Option<Counting>>,
}

impl<'a> Search<'a> {
    fn new(piece: &'a Piece<'a>, target: usize) -> Self {
        Self {
            piece,
            target,
            bounds: HashMap::new(),
        }
    }

    /// The first of these that gives the target.
    fn first(mut self, separations: &[Separation]) -> Result<Option<Overlap>, VerdictError> {
        for separation in separations {
            if self.bounds.len() >= MAX_PARTS {
                break;
            }
            let found = self.overlap(separation)?;
            if let Some(overlap) = found.filter(|overlap| overlap.bound <= self.target) {
                return Ok(Some(overlap));
            }
        }
        Ok(None)
    }

    /// The bound of Corollary 5.11, if counting gives the ranks of both sides.
    fn overlap(&mut self, separation: &Separation) -> Result<Option<Overlap>, VerdictError> {
        let Some(first) = self.counted(separation.first)? else {
            return Ok(None);
        };
        let Some(second) = self.counted(separation.second)? else {
            return Ok(None);
        };
        let (shared, lower) = self.shared(&self.members(separation.shared()))?;
        Ok(Some(Overlap {
            bound: first.bound + second.bound - lower,
            first,
            second,
            shared,
        }))
    }

    /// The members at these positions.
    fn members(&self, set: u64) -> Members {
        let mut members = Members::default();
        for (position, member) in self.piece.members.singles().iter().enumerate() {
            if set >> position & 1 == 1 {
                members.extend(member);
            }
        }
        members
    }

    /// The bound of a part by counting, if that is its rank.
    fn counted(&mut self, set: u64) -> Result<Option<Counting>, VerdictError> {
        if let Some(known) = self.bounds.get(&set) {
            return Ok(known.clone());
        }
        let bound = self.count(&self.members(set))?;
        self.bounds.insert(set, bound.clone());
        Ok(bound)
    }

    fn count(&self, part: &Members) -> Result<Option<Counting>, VerdictError> {
        let assembly = self.piece.assembly;
        let Split { rigid, pieces } = assembly.split(part);
        let single = Counting::partition(Model::Projective, assembly, &rigid.singles());
        let mut all = vec![single];
        for members in &pieces {
            let core = assembly.core(members);
            match self.piece.part(members, &core).counted()? {
                Some(bound) => all.push(bound),
                None => return Ok(None),
            }
        }
        Ok(Some(Counting::join(all)))
    }

    /// What is in both sides, and a lower bound on its rank.
    fn shared(&self, part: &Members) -> Result<(Shared, usize), VerdictError> {
        let assembly = self.piece.assembly;
        let Split { rigid, pieces } = assembly.split(part);
        let singles = rigid.singles();
        let mut lower = Counting::partition(Model::Projective, assembly, &singles).bound;
        let mut bounded = Vec::with_capacity(pieces.len());
        for members in pieces {
            let core = assembly.core(&members);
            let piece = self.piece.part(&members, &core);
            let (evidence, rank) = piece.best_draw(0)?;
            lower += piece.rank_of_piece(rank);
            bounded.push(SharedPiece {
                members,
                evidence: vec![evidence],
            });
        }
        let pieces = bounded;
        Ok((Shared { rigid, pieces }, lower))
    }
}

#[cfg(test)]
mod tests;
