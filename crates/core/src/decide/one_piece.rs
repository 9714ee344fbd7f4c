//! Deciding one piece on its core (docs/theory.md, sections 3 to 7).
//!
//! In: the members of a piece. Out: its rank between two bounds, its components, and the
//! evidence for both. A piece of full rank is done (Theorem 1.3 on the core, Theorem 4.4); what
//! falls short is cut into motion classes (Theorem 6.4), whose own pieces are decided as this
//! one is (Theorem 6.3).

use crate::contract::piece::{Assembly, Members};
use crate::decide::claim::Strength;
use crate::decide::drawn::{Centres, Ranks};
use crate::decide::error::VerdictError;
use crate::decide::evidence::{Class, ClassKind, Counting, Draws, Evidence, PieceVerdict};
use crate::decide::options::Options;
use crate::decide::question::Arithmetic;
use crate::decide::vectors;
use crate::decide::walk::{ATTEMPTS, Alone, Piece};
use crate::decide::whole_matrix;
use crate::watch::Step;
use rayon::prelude::*;

/// Decides pieces of two members or more, in parallel.
pub(super) fn decide_all(
    assembly: &Assembly,
    pieces: &[Members],
    sha256: &[u8; 32],
    options: &Options,
) -> Result<Vec<PieceVerdict>, VerdictError> {
    let decided = pieces.par_iter().map(|members| {
        let core = assembly.core(members);
        Piece::new(assembly, members, &core, sha256, options).decide()
    });
    decided.collect()
}

/// Why the rank of a piece is no larger, and its motion classes no coarser.
struct Settled {
    strength: Strength,
    /// What an error bound rests on.
    draws: Option<Draws>,
    /// A kernel vector for the classes, at every draw.
    kernels: Vec<Evidence>,
}

impl Piece<'_> {
    /// The verdict on a piece of full rank.
    fn full(&self, evidence: Vec<Evidence>) -> PieceVerdict {
        let rank = self.rank_of_piece(self.required());
        PieceVerdict {
            members: self.members.clone(),
            components: vec![self.members.clone()],
            evidence,
            lower: rank,
            upper: rank,
            rank_strength: Strength::Proof,
            components_strength: Strength::Proof,
        }
    }

    /// Decides at one draw of centres after another, until one will do.
    fn decide(&self) -> Result<PieceVerdict, VerdictError> {
        let mut before = Vec::new();
        if let Some((evidence, rank)) = self.whole_matrix()? {
            before.push(evidence);
            if rank == self.required() {
                return Ok(self.full(before));
            }
        }
        let field = self.options.prime.for_core(self.nodes());
        let mut next = 0;
        for _ in 0..ATTEMPTS {
            let at = Centres::draw(&field, self.core, self.key(next))?;
            next = at.draw.draw + 1;
            if let Some(verdict) = self.decide_at(&at, &before)? {
                return Ok(verdict);
            }
        }
        Err(VerdictError::Undecided {
            prime: field.modulus(),
            draws: ATTEMPTS,
        })
    }

    /// The rank of the paper's own matrix on the core, if it was asked for.
    fn whole_matrix(&self) -> Result<Option<(Evidence, usize)>, VerdictError> {
        let asked = &self.options.question;
        if asked.model.is_linear() {
            return Ok(None);
        }
        let (graph, key, task) = (&self.core.graph, self.key(0), self.task(Step::WholeMatrix));
        match (asked.arithmetic, asked.whole_graph) {
            (
                Arithmetic::Rational {
                    numerator,
                    denominator,
                },
                _,
            ) => whole_matrix::rational(graph, numerator, denominator, &key, &task).map(Some),
            (Arithmetic::Prime, true) => {
                let field = self.options.prime.for_whole_matrix();
                whole_matrix::modular(graph, &field, &key, &task).map(Some)
            }
            (Arithmetic::Prime, false) => Ok(None),
        }
    }

    /// Decides at the given centres, or says that they (or so small a prime) do not do.
    fn decide_at(
        &self,
        at: &Centres,
        before: &[Evidence],
    ) -> Result<Option<PieceVerdict>, VerdictError> {
        let ranks = self.ranks(at)?;
        let mut evidence = before.to_vec();
        evidence.push(ranks.evidence());
        if ranks.rank == self.required() {
            return Ok(Some(self.full(evidence)));
        }
        let Some((found, kernel)) = self.separate(&ranks) else {
            return Ok(None);
        };
        let classes = self.decide_classes(&found, at.draw.draw)?;
        let components: Vec<Members> = classes.iter().flat_map(Class::components).collect();
        let lower = self.rank_of_piece(ranks.rank);
        let counting = self.bound(&ranks, at, &components, lower)?;
        let full = self.rank_of_piece(self.required());
        let upper = counting.as_ref().map_or(full, |found| found.bound);
        evidence.extend(counting.map(Evidence::Counting));
        let settled = if lower == upper {
            Settled {
                strength: Strength::Proof,
                draws: None,
                kernels: vec![kernel],
            }
        } else {
            match self.error_bound(ranks.rank, &found)? {
                Some(settled) => settled,
                None => return Ok(None),
            }
        };
        let inner = classes.iter().flat_map(Class::pieces);
        let inner = inner.map(|piece| piece.components_strength);
        let components_strength = Strength::all(inner.chain([settled.strength]));
        evidence.extend(settled.draws.map(Evidence::Draws));
        evidence.push(Evidence::Classes(classes));
        evidence.extend(settled.kernels);
        Ok(Some(PieceVerdict {
            members: self.members.clone(),
            components,
            evidence,
            lower,
            upper,
            rank_strength: settled.strength,
            components_strength,
        }))
    }

    /// The upper bound by counting, if it is below full rank; none if nobody wants to count.
    fn bound(
        &self,
        ranks: &Ranks,
        at: &Centres,
        components: &[Members],
        lower: usize,
    ) -> Result<Option<Counting>, VerdictError> {
        let asked = &self.options.question;
        if !asked.counting && !asked.model.is_linear() {
            return Ok(None);
        }
        let counting = match self.assembly.placed() {
            Some(placed) => {
                let part = (self.members, self.core);
                vectors::count(self.assembly, placed, part, &ranks.edge_scales())
            }
            None => self.count(at, components, lower)?,
        };
        let full = self.rank_of_piece(self.required());
        Ok(Some(counting).filter(|counting| counting.bound < full))
    }

    /// Looks for the components of every motion class.
    fn decide_classes(&self, found: &[Members], draw: u64) -> Result<Vec<Class>, VerdictError> {
        let work = self.task(Step::Components).begin(found.len() as u64);
        let mut classes = Vec::with_capacity(found.len());
        for members in found {
            classes.push(self.class(members, draw)?);
            work.done(1)?;
        }
        Ok(classes)
    }

    /// Looks for the components of a motion class (Theorem 6.3 and Proposition 6.5).
    fn class(&self, members: &Members, draw: u64) -> Result<Class, VerdictError> {
        Ok(Class {
            kind: self.class_kind(members, draw)?,
            members: members.clone(),
        })
    }

    fn class_kind(&self, members: &Members, draw: u64) -> Result<ClassKind, VerdictError> {
        Ok(match self.alone(members, draw)? {
            Alone::Single => ClassKind::Single,
            Alone::Rigid(evidence) => ClassKind::Rigid(vec![evidence]),
            Alone::Loose(split) => ClassKind::Loose {
                pieces: decide_all(self.assembly, &split.pieces, self.sha256, self.options)?,
                rigid: split.rigid,
            },
        })
    }

    /// The draws that bound the error of `rank` and `classes` (Theorem 7.2 and Proposition 7.4);
    /// `None` if one of them contradicts.
    fn error_bound(
        &self,
        rank: usize,
        classes: &[Members],
    ) -> Result<Option<Settled>, VerdictError> {
        let nodes = self.nodes();
        let (count, error_log2) = Draws::plan(nodes).ok_or(VerdictError::TooLarge {
            what: "an error bound",
            nodes,
            edges: self.core.graph.edges().len(),
            needs: "a prime beyond 2^62".into(),
            advice: "keep contraction and counting on",
        })?;
        let mut kernels = Vec::new();
        let mut largest = 0;
        let mut next = 0;
        let work = self.task(Step::Draws).begin(count);
        for _ in 0..count {
            work.done(1)?;
            let at = Centres::draw_with_prime(nodes, self.key(next))?;
            next = at.draw.draw + 1;
            let ranks = self.ranks(&at)?;
            largest = largest.max(ranks.rank);
            let Some((found, kernel)) = ranks.separate(self.members) else {
                return Ok(None);
            };
            if ranks.rank > rank || found != classes {
                return Ok(None);
            }
            kernels.push(kernel);
        }
        Ok((largest == rank).then_some(Settled {
            strength: Strength::ErrorBound(error_log2),
            draws: Some(Draws {
                seed: self.options.seed,
                count,
                rank,
            }),
            kernels,
        }))
    }
}
