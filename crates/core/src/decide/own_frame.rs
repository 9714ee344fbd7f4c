//! Displacements and positions in a frame of their own (docs/theory.md, Theorems 13.29 to 13.31).
//!
//! In: a graph, decided without them, and what is given. Out: whether pairs, rigs and these determine
//! all, with the rotation of every part against the frame of what is given unknown: a rank between a
//! lower bound at drawn centres and an upper one by counting, and whether the rotations are fixed, so
//! that finite means unique. The evidence is that of docs/certificate.md, section 16.

mod equations;
mod parts;

use crate::contract::Contraction;
use crate::contract::piece::Members as Block;
use crate::decide::claim::Value;
use crate::decide::evidence::ModularDraw;
use crate::geometry::draw::DrawKey;
use crate::graph::{Displacements, Graph};
use crate::linalg::textbook::Pivots;
use crate::watch::{Stopped, Watch};
use equations::Equations;
use parts::{Parts, Span};
use std::collections::BTreeSet;

/// How many draws of centres are tried while the bounds do not meet.
const DRAWS: u64 = 3;

/// A part of the graph that holds nodes of which something is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TurningPart {
    /// Its nodes, increasing.
    pub nodes: Vec<u32>,
    /// Those in groups.
    pub given: Vec<u32>,
    /// Whether all that is given of it is one position or lies on one line, and ties it to nothing else:
    /// then it turns.
    pub turns: bool,
    /// Whether a body that pairs and rigs make rigid shows how it is turned.
    pub is_fixed: bool,
}

/// What a graph determines beside displacements in a frame of their own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnFrame {
    /// What is given.
    pub given: Displacements,
    /// The rank at drawn centres, which the generic rank is not below.
    pub rank: usize,
    /// What the generic rank is not above.
    pub at_most: usize,
    /// The rank of a graph that determines all.
    pub required: usize,
    /// The parts that hold nodes of groups, by their first nodes.
    pub parts: Vec<TurningPart>,
    /// Nodes that no pair and no rig holds, increasing.
    pub alone: Vec<u32>,
    /// Nodes that stay where they are in a motion drawn at random, their parts not turning, increasing.
    pub placed: Vec<u32>,
    pub(crate) evidence: OwnFrameEvidence,
}

/// What a certificate shows of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct OwnFrameEvidence {
    pub(crate) lower: (ModularDraw, Pivots),
    /// Members that are rigid together, and turn nothing.
    pub(crate) rigid: Vec<(Block, (ModularDraw, Pivots))>,
    /// The blocks whose bound is below what is required.
    pub(crate) upper: Option<Vec<Block>>,
}

impl OwnFrame {
    /// Asks what pairs, rigs and `given` determine, for a contraction by pairs and rigs that
    /// holds where the given vectors are ([`Known::OwnFrame`](super::Known::OwnFrame)). The cost is that
    /// of an elimination with three columns for each node that two members share, and one for each member.
    ///
    /// # Errors
    /// If the work was stopped.
    ///
    /// # Panics
    /// If what is given is of another graph.
    pub(super) fn new(
        (graph, graph_sha256): (&Graph, [u8; 32]),
        contraction: &Contraction,
        given: &Displacements,
        seed: u64,
        watch: &Watch,
    ) -> Result<Self, Stopped> {
        let parts = Parts::new(graph, contraction, given);
        let given_sha256 = given.sha256();
        let key = |draw| DrawKey {
            graph_sha256,
            core_sha256: Some(given_sha256),
            seed,
            draw,
        };
        let all: Vec<usize> = (0..parts.members.len()).collect();
        let required = parts.unknowns() - 3;
        let mut best: Option<Self> = None;
        for draw in 0..DRAWS {
            let equations = Equations::new(&parts, &all, true, &key(draw));
            let motion = equations.motion(watch)?;
            let loose = motion.dimension + 3 * parts.alone.len();
            let rank = parts.unknowns() - loose;
            if best.as_ref().is_some_and(|best| best.rank >= rank) {
                continue;
            }
            let (blocks, bound) = parts.blocks(&motion.classes);
            let at_most = bound.min(required);
            let upper = (bound < required).then_some(blocks);
            best = Some(Self {
                given: given.clone(),
                rank,
                at_most,
                required,
                parts: parts.turning(),
                alone: parts.alone.clone(),
                placed: motion.placed(&parts),
                evidence: OwnFrameEvidence {
                    lower: (equations.name(), motion.pivots),
                    rigid: Vec::new(),
                    upper,
                },
            });
            if rank == at_most {
                break;
            }
        }
        let mut best = best.expect("a first draw");
        if best.rank == best.required {
            best.fix(&parts, &all, &key(DRAWS), watch)?;
        }
        Ok(best)
    }

    /// Looks for what shows how parts are turned: bodies, and else members that are rigid together.
    fn fix(
        &mut self,
        parts: &Parts,
        all: &[usize],
        key: &DrawKey,
        watch: &Watch,
    ) -> Result<(), Stopped> {
        let mut spans = parts.spans();
        if spans.iter().any(|span| !span.is_wide()) {
            let measured = Equations::new(parts, all, false, key).motion(watch)?;
            for class in measured.by_class().filter(|class| class.len() > 1) {
                let part = parts.members[class[0]].part;
                let Some(turn) = parts.turns[part].filter(|&turn| !spans[turn].is_wide()) else {
                    continue;
                };
                let mut wider = spans[turn].clone();
                parts.widen(&mut wider, &parts.nodes_of(&class));
                if wider.len() == spans[turn].len() {
                    continue;
                }
                let own = Equations::new(parts, &class, false, key);
                let motion = own.motion(watch)?;
                if motion.dimension == 4 - usize::from(parts.is_scaled(&class)) {
                    spans[turn] = wider;
                    let shown = (own.name(), motion.pivots);
                    self.evidence.rigid.push((parts.block(&class), shown));
                }
            }
        }
        for (part, span) in self.parts.iter_mut().zip(&spans) {
            part.is_fixed = Span::is_wide(span);
        }
        Ok(())
    }

    /// Nodes of which something is given, and that no pair and no rig holds, increasing.
    pub fn only_given(&self) -> Vec<u32> {
        let groups = self.given.groups().iter().flatten();
        let given: BTreeSet<u32> = groups.copied().collect();
        let alone = self.alone.iter().copied();
        alone.filter(|v| given.contains(v)).collect()
    }

    /// The answer: `None` if it is open. Everything else is proved.
    pub fn value(&self) -> Option<Value> {
        if self.rank < self.required {
            return (self.at_most < self.required).then_some(Value::NotFiniteSolvable);
        }
        let is_fixed = self.parts.iter().all(|part| part.is_fixed);
        Some(match is_fixed {
            true => Value::Solvable,
            false => Value::FiniteSolvable,
        })
    }

    /// The same, as certificates have it.
    pub fn name(&self) -> &'static str {
        self.value().map_or("open", Value::name)
    }

    /// Whether all is unique, with a proof.
    pub fn is_determined(&self) -> bool {
        self.value() == Some(Value::Solvable)
    }
}

#[cfg(test)]
mod tests;
