//! Components: which bodies they are, and the steps that tell them apart (docs/proof.md).
//!
//! In: the pieces and motion classes of a verdict. Out: components in an order in which those that are
//! told apart last stand together, so that each step cuts an interval of them.
//!
//! Bounds need no blocks here. A bound by counting that is the rank, hubs aside, has blocks that are
//! rigid; so components count as much.

use super::bodies::{Record, Set, of_sets_told_apart};
use super::text::{Components, Reason, Step};
use super::{Unproved, required};
use crate::contract::piece::Members;
use crate::decide::Verdict;
use crate::decide::evidence::{Class, ClassKind, Evidence, PieceVerdict};
use std::collections::{BTreeMap, VecDeque};

/// The components of a verdict that proves them, with their bodies in the record.
pub(super) fn of(verdict: &Verdict, record: &mut Record) -> Result<Components, Unproved> {
    let root = Tree::cut(&verdict.rigid, &verdict.pieces);
    let mut made = Made {
        record,
        components: Components::default(),
        sets: Vec::new(),
    };
    let span = made.number(root)?;
    made.steps(&span)?;
    Ok(made.components)
}

/// How components are told apart.
enum Tree {
    One(Members),
    /// Pieces: each shares a node at most with those before.
    Cut(Vec<Tree>),
    /// Motion classes.
    Apart(Vec<Tree>),
}

impl Tree {
    fn cut(rigid: &Members, pieces: &[PieceVerdict]) -> Self {
        let rigid = rigid.singles().into_iter().map(Self::One);
        Self::Cut(rigid.chain(pieces.iter().map(Self::piece)).collect())
    }

    fn piece(piece: &PieceVerdict) -> Self {
        let classes = piece.evidence.iter().find_map(|evidence| match evidence {
            Evidence::Classes(classes) => Some(classes),
            _ => None,
        });
        match classes {
            Some(classes) if piece.components.len() > 1 => {
                Self::Apart(classes.iter().map(Self::class).collect())
            }
            _ => Self::One(piece.members.clone()),
        }
    }

    fn class(class: &Class) -> Self {
        match &class.kind {
            ClassKind::Single | ClassKind::Rigid(_) => Self::One(class.members.clone()),
            ClassKind::Loose { rigid, pieces } => Self::cut(rigid, pieces),
        }
    }
}

/// An interval of components, and the smaller ones that a step cuts it into.
struct Span {
    end: usize,
    begin: usize,
    is_cut: bool,
    parts: Vec<Span>,
}

/// What is made so far.
struct Made<'a> {
    record: &'a mut Record,
    components: Components,
    /// The nodes of every component, and the reason by which it is used in a step.
    sets: Vec<Set>,
}

impl Made<'_> {
    /// Numbers the components of a tree in its order.
    fn number(&mut self, tree: Tree) -> Result<Span, Unproved> {
        let begin = self.sets.len();
        let (is_cut, parts) = match tree {
            Tree::One(members) => {
                let (nodes, body) = self.record.rigid(&members)?;
                self.components.bodies.push(body - 1);
                self.sets.push((nodes, (begin + 1) as Reason));
                (false, Vec::new())
            }
            Tree::Apart(parts) => (false, parts),
            Tree::Cut(parts) => (true, self.in_order(parts)),
        };
        let parts = parts.into_iter().map(|part| self.number(part));
        Ok(Span {
            parts: parts.collect::<Result<_, _>>()?,
            is_cut,
            begin,
            end: self.sets.len(),
        })
    }

    /// Pieces, each next to an earlier one as long as there is such a piece: then it shares one
    /// node with all before it.
    fn in_order(&self, parts: Vec<Tree>) -> Vec<Tree> {
        let nodes: Vec<Vec<u32>> = parts.iter().map(|part| self.nodes(part)).collect();
        let mut of_node: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (k, nodes) in nodes.iter().enumerate() {
            nodes
                .iter()
                .for_each(|&v| of_node.entry(v).or_default().push(k));
        }
        let mut parts: Vec<Option<Tree>> = parts.into_iter().map(Some).collect();
        let mut ordered = Vec::with_capacity(parts.len());
        let mut waiting = VecDeque::new();
        for first in 0..parts.len() {
            waiting.push_back(first);
            while let Some(k) = waiting.pop_front() {
                if let Some(part) = parts[k].take() {
                    ordered.push(part);
                    let near = nodes[k].iter().filter_map(|v| of_node.remove(v));
                    waiting.extend(near.flatten());
                }
            }
        }
        ordered
    }

    fn nodes(&self, tree: &Tree) -> Vec<u32> {
        match tree {
            Tree::One(members) => self.record.nodes(members),
            Tree::Cut(parts) | Tree::Apart(parts) => {
                parts.iter().flat_map(|part| self.nodes(part)).collect()
            }
        }
    }

    /// The steps for an interval: its own, then those of its parts, the last one first.
    fn steps(&mut self, span: &Span) -> Result<(), Unproved> {
        if let [part] = &span.parts[..] {
            return self.steps(part);
        }
        if span.parts.is_empty() {
            return Ok(());
        }
        let ends: Vec<usize> = span.parts.iter().map(|part| part.end).collect();
        let step = if span.is_cut {
            Step::Cut(ends)
        } else {
            let sets = &self.sets[span.begin..span.end];
            let interval = |k: usize| ends.partition_point(|&end| end <= k + span.begin);
            let rank = sets.iter().map(|(nodes, _)| required(nodes)).sum();
            let (frame, motion) = of_sets_told_apart(sets, rank, interval)?;
            Step::Apart {
                ends,
                frame,
                motion,
            }
        };
        self.components.steps.push(step);
        span.parts
            .iter()
            .rev()
            .try_for_each(|part| self.steps(part))
    }
}
