//! Deciding one piece on its core (docs/theory.md, sections 3 to 7).
//!
//! In: the members of a piece. Out: its rank between two bounds, its components, and the
//! evidence for both. A piece of full rank is done (Theorem 1.3 on the core, Theorem 4.4); what
//! falls short is cut into motion classes (Theorem 6.4), whose own pieces are decided as this
//! one is (Theorem 6.3).

use crate::contract::piece::{Assembly, Core, Members, Split};
use crate::decide::added;
use crate::decide::claim::Strength;
use crate::decide::counting;
use crate::decide::counting::Counting;
use crate::decide::drawn::{Centres, Ranks};
use crate::decide::error::VerdictError;
use crate::decide::evidence::{Class, ClassKind, Draws, Evidence, PieceVerdict};
use crate::decide::options::{Arithmetic, Options};
use crate::decide::overlap;
use crate::decide::vectors;
use crate::decide::whole_matrix;
use crate::geometry::draw::DrawKey;
use crate::geometry::model::Model;
use crate::graph::core_sha256;
use crate::linalg::prime::PrimeField;
use crate::watch::{Step, Stopped, Task};
use rayon::prelude::*;

/// How many draws are tried modulo the given prime before the question is left open.
/// Modulo a prime near 2^61 the first one does.
const ATTEMPTS: u64 = 64;

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

/// A piece, or a part of one that is a piece by itself.
pub(super) struct Piece<'a> {
    pub(super) assembly: &'a Assembly,
    pub(super) members: &'a Members,
    pub(super) core: &'a Core,
    sha256: &'a [u8; 32],
    core_sha256: [u8; 32],
    pub(super) options: &'a Options,
}

/// Why the rank of a piece is no larger, and its motion classes no coarser.
struct Settled {
    strength: Strength,
    /// What an error bound rests on.
    draws: Option<Draws>,
    /// A kernel vector for the classes, at every draw.
    kernels: Vec<Evidence>,
}

impl<'a> Piece<'a> {
    fn new(
        assembly: &'a Assembly,
        members: &'a Members,
        core: &'a Core,
        sha256: &'a [u8; 32],
        options: &'a Options,
    ) -> Self {
        Self {
            assembly,
            members,
            core,
            sha256,
            core_sha256: core_sha256(&core.nodes, &core.graph),
            options,
        }
    }

    /// A part of it that is a piece by itself, with its core.
    pub(super) fn part<'b>(&'b self, members: &'b Members, core: &'b Core) -> Piece<'b> {
        Piece::new(self.assembly, members, core, self.sha256, self.options)
    }

    fn nodes(&self) -> usize {
        self.core.graph.nodes()
    }

    pub(super) fn key(&self, draw: u64) -> DrawKey {
        DrawKey {
            graph_sha256: *self.sha256,
            core_sha256: Some(self.core_sha256),
            seed: self.options.seed,
            draw,
        }
    }

    pub(super) fn task(&self, step: Step) -> Task<'_> {
        self.options.watch.task(step, self.nodes())
    }

    /// The rank of the core of a finite solvable piece.
    fn required(&self) -> usize {
        self.core.required(self.options.model)
    }

    /// The rank of the piece from that of its core (Theorem 4.4; calibrated: Theorems 4.11
    /// and 13.18).
    pub(super) fn rank_of_piece(&self, core_rank: usize) -> usize {
        let scale = usize::from(!self.core.scales.is_empty());
        self.options.model.required(self.core.total_nodes) + scale + core_rank - self.required()
    }

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

    pub(super) fn ranks<'c>(&'c self, at: &'c Centres) -> Result<Ranks<'c>, Stopped> {
        Ranks::new(self.options.model, &self.options.watch, at, self.core)
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
        if self.options.model != Model::Projective {
            return Ok(None);
        }
        let (graph, key, task) = (&self.core.graph, self.key(0), self.task(Step::WholeMatrix));
        match self.options.arithmetic {
            Arithmetic::Rational {
                numerator,
                denominator,
            } => whole_matrix::rational(graph, numerator, denominator, &key, &task).map(Some),
            Arithmetic::Prime if !self.options.contraction => {
                let field = self.options.prime.for_whole_matrix();
                whole_matrix::modular(graph, &field, &key, &task).map(Some)
            }
            Arithmetic::Prime => Ok(None),
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
        let mut upper = self.rank_of_piece(self.required());
        let counted = match self.assembly.placed() {
            Some(placed) if self.options.counting => {
                let part = (self.members, self.core);
                let scales = ranks.edge_scales();
                Some(vectors::count(self.assembly, placed, part, &scales))
            }
            _ => self.count(at, &components, lower)?,
        };
        if let Some(counting) = counted
            && counting.bound < upper
        {
            upper = counting.bound;
            evidence.push(Evidence::Counting(counting));
        }
        if lower < upper
            && self.options.counting
            && let Some(overlap) = overlap::search(self, lower)?
        {
            upper = overlap.bound;
            evidence.push(Evidence::Overlap(overlap));
        }
        if lower < upper
            && self.options.counting
            && let Some(added) = added::search(self, lower)?
        {
            upper = added.bound.value();
            evidence.push(Evidence::Added(added));
        }
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

    /// The motion classes, two or more, with the kernel vector that separates them; `None` if
    /// these centres (or so small a prime) show no such thing.
    fn separate(&self, ranks: &Ranks) -> Option<(Vec<Members>, Evidence)> {
        let _work = self.task(Step::Components).begin(0);
        let found = ranks.classes(self.members);
        found.filter(|(classes, _)| classes.len() >= 2)
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
        if members.len() == 1 {
            return Ok(ClassKind::Single);
        }
        let split = self.assembly.split(members);
        if let Some(evidence) = self.full_rank(members, &split, draw)? {
            return Ok(ClassKind::Rigid(vec![evidence]));
        }
        Ok(ClassKind::Loose {
            pieces: decide_all(self.assembly, &split.pieces, self.sha256, self.options)?,
            rigid: split.rigid,
        })
    }

    /// A proof that a part, cut into these pieces, has full rank, from draw `from` on; `None` if it
    /// seems not to.
    fn full_rank(
        &self,
        part: &Members,
        split: &Split,
        from: u64,
    ) -> Result<Option<Evidence>, VerdictError> {
        if !split.rigid.is_empty() || split.pieces.len() != 1 {
            return Ok(None);
        }
        let core = self.assembly.core(part);
        let part = self.part(part, &core);
        let (evidence, rank) = part.best_draw(from)?;
        Ok((rank == part.required()).then_some(evidence))
    }

    /// The best lower bound for the core that draws from `from` on give, with the rank.
    pub(super) fn best_draw(&self, from: u64) -> Result<(Evidence, usize), VerdictError> {
        let field = self.options.prime.for_core(self.nodes());
        // Where bad luck is rare one draw tells: what it misses is looked at in another way.
        let attempts = if field.modulus() >> 10 > 22 * self.nodes() as u64 {
            1
        } else {
            ATTEMPTS
        };
        let mut best = None;
        let mut next = from;
        for _ in 0..attempts {
            let at = Centres::draw(&field, self.core, self.key(next))?;
            next = at.draw.draw + 1;
            let ranks = self.ranks(&at)?;
            if best.as_ref().is_none_or(|&(_, rank)| ranks.rank > rank) {
                best = Some((ranks.evidence(), ranks.rank));
            }
            if ranks.rank == self.required() {
                break;
            }
        }
        Ok(best.expect("one draw at least"))
    }

    /// The bound by counting, if it is the rank.
    pub(super) fn counted(&self) -> Result<Option<Counting>, VerdictError> {
        // Where to look is not a claim: a large prime looks best.
        let field = PrimeField::mersenne61();
        let at = Centres::draw(&field, self.core, self.key(0))?;
        let ranks = self.ranks(&at)?;
        let whole = std::slice::from_ref(self.members);
        let block = Counting::partition(self.options.model, self.assembly, whole);
        if ranks.rank == self.required() {
            return Ok(Some(block));
        }
        let Some((classes, _)) = self.separate(&ranks) else {
            return Ok(None);
        };
        let mut components = Vec::new();
        for class in classes {
            let split = self.assembly.split(&class);
            if class.len() == 1 || self.full_rank(&class, &split, 0)?.is_some() {
                components.push(class);
            } else {
                // Any partition will do to count by.
                components.extend(class.singles());
            }
        }
        let rank = self.rank_of_piece(ranks.rank);
        let bound = self.count(&at, &components, rank)?;
        Ok(bound.filter(|bound| bound.bound <= rank))
    }

    /// The upper bound by counting (Theorem 5.5), unless it is not wanted.
    fn count(
        &self,
        at: &Centres,
        components: &[Members],
        lower: usize,
    ) -> Result<Option<Counting>, Stopped> {
        if !self.options.counting {
            return Ok(None);
        }
        // Where to look is not a claim: a large prime looks best.
        let field = PrimeField::mersenne61();
        let work = self.task(Step::Counting).begin(0);
        work.done(0)?;
        let mut search = counting::Search {
            field: &field,
            random: &mut at.key.residues(&field),
            task: work.task(),
        };
        counting::count(
            self.options.model,
            self.assembly,
            self.members,
            components,
            lower,
            &mut search,
        )
        .map(Some)
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
            let Some((found, kernel)) = ranks.classes(self.members) else {
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
