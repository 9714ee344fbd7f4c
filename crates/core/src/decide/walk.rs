//! The walk over a piece: rank, motion classes, what these are by themselves, and again
//! (docs/theory.md, sections 3 to 6).
//!
//! In: the members of a piece, or of a part of one. Out: its rank at drawn centres, its classes, and
//! of each class whether it is rigid by itself or into which pieces it is cut.

use crate::contract::piece::{Assembly, Core, Members, Split};
use crate::decide::counting;
use crate::decide::drawn::{Centres, Ranks};
use crate::decide::error::VerdictError;
use crate::decide::evidence::{Counting, Evidence};
use crate::decide::options::Options;
use crate::geometry::draw::DrawKey;
use crate::geometry::model::Model;
use crate::graph::core_sha256;
use crate::linalg::prime::PrimeField;
use crate::watch::{Step, Stopped, Task};

/// How many draws are tried modulo the given prime before the question is left open.
/// Modulo a prime near 2^61 the first one does.
pub(super) const ATTEMPTS: u64 = 64;

/// A piece, or a part of one that is a piece by itself.
pub(super) struct Piece<'a> {
    pub(super) assembly: &'a Assembly,
    pub(super) members: &'a Members,
    pub(super) core: &'a Core,
    pub(super) sha256: &'a [u8; 32],
    core_sha256: [u8; 32],
    pub(super) options: &'a Options,
}

/// What a motion class is by itself (Theorem 6.3 and Proposition 6.5).
pub(super) enum Alone {
    /// A single member.
    Single,
    /// Of full rank, by this evidence.
    Rigid(Evidence),
    /// Cut into these pieces.
    Loose(Split),
}

impl<'a> Piece<'a> {
    pub(super) fn new(
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

    pub(super) fn model(&self) -> Model {
        self.options.question.model
    }

    pub(super) fn nodes(&self) -> usize {
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
    pub(super) fn required(&self) -> usize {
        self.core.required(self.model())
    }

    /// The rank of the piece from that of its core (Theorem 4.4; calibrated: Theorems 4.11
    /// and 13.18).
    pub(super) fn rank_of_piece(&self, core_rank: usize) -> usize {
        let scale = usize::from(!self.core.scales.is_empty());
        self.model().required(self.core.total_nodes) + scale + core_rank - self.required()
    }

    pub(super) fn ranks<'c>(&'c self, at: &'c Centres) -> Result<Ranks<'c>, Stopped> {
        Ranks::new(self.model(), &self.options.watch, at, self.core)
    }

    /// The motion classes, two or more, with the kernel vector that separates them; `None` if
    /// these centres (or so small a prime) show no such thing.
    pub(super) fn separate(&self, ranks: &Ranks) -> Option<(Vec<Members>, Evidence)> {
        let _work = self.task(Step::Components).begin(0);
        ranks.separate(self.members)
    }

    /// What a class is by itself, by draws from `from` on.
    pub(super) fn alone(&self, class: &Members, from: u64) -> Result<Alone, VerdictError> {
        if class.len() == 1 {
            return Ok(Alone::Single);
        }
        let split = self.assembly.split(class);
        if split.rigid.is_empty() && split.pieces.len() == 1 {
            let core = self.assembly.core(class);
            let part = self.part(class, &core);
            let (evidence, rank) = part.best_draw(from)?;
            if rank == part.required() {
                return Ok(Alone::Rigid(evidence));
            }
        }
        Ok(Alone::Loose(split))
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

    /// The upper bound by counting (Theorem 5.5).
    pub(super) fn count(
        &self,
        at: &Centres,
        components: &[Members],
        lower: usize,
    ) -> Result<Counting, Stopped> {
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
            self.model(),
            self.assembly,
            self.members,
            components,
            lower,
            &mut search,
        )
    }
}
