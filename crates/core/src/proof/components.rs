//! Components: which bodies they are, and the steps that tell them apart (docs/proof.md).
//!
//! In: the pieces and motion classes of a verdict. Out: components in an order in which those that are
//! told apart last stand together, so that each step cuts an interval of them.
//!
//! Where no block has a hub, bounds need no blocks: those of a bound that is the rank are rigid, so
//! components count as much.

use super::Unproved;
use super::bodies::{Record, Set, of_sets_told_apart};
use super::listed::Reason;
use super::text::{Components, Step};
use super::upper::{self, Block};
use crate::contract::Body;
use crate::contract::piece::Members;
use crate::decide::Verdict;
use crate::decide::evidence::{Class, ClassKind, Evidence, PieceVerdict};
use crate::geometry::model::Model;
use std::collections::{BTreeMap, VecDeque};

/// The components of a verdict that proves them, with their bodies in the record.
pub(super) fn of(verdict: &Verdict, record: &mut Record) -> Result<Components, Unproved> {
    let root = Tree::cut(&verdict.rigid, &verdict.pieces);
    let mut made = Made {
        model: verdict.model,
        record,
        bodies: &verdict.contraction.bodies,
        components: Components::default(),
        sets: Vec::new(),
    };
    let span = made.number(root)?;
    made.steps(&span)?;
    Ok(made.components)
}

/// How components are told apart.
enum Tree<'a> {
    One(Members),
    /// Pieces: each shares a node at most with those before.
    Cut(Vec<Tree<'a>>),
    /// Motion classes of a piece.
    Apart(&'a PieceVerdict, Vec<Tree<'a>>),
}

impl<'a> Tree<'a> {
    fn cut(rigid: &Members, pieces: &'a [PieceVerdict]) -> Self {
        let rigid = rigid.singles().into_iter().map(Self::One);
        Self::Cut(rigid.chain(pieces.iter().map(Self::piece)).collect())
    }

    fn piece(piece: &'a PieceVerdict) -> Self {
        let classes = piece.evidence.iter().find_map(|evidence| match evidence {
            Evidence::Classes(classes) => Some(classes),
            _ => None,
        });
        match classes {
            Some(classes) if piece.components.len() > 1 => {
                Self::Apart(piece, classes.iter().map(Self::class).collect())
            }
            _ => Self::One(piece.members.clone()),
        }
    }

    fn class(class: &'a Class) -> Self {
        match &class.kind {
            ClassKind::Single | ClassKind::Rigid(_) => Self::One(class.members.clone()),
            ClassKind::Loose { rigid, pieces } => Self::cut(rigid, pieces),
        }
    }
}

/// An interval of components, and the smaller ones that a step cuts it into.
struct Span<'a> {
    end: usize,
    begin: usize,
    /// The piece whose motion tells them apart; else they share a node at most.
    piece: Option<&'a PieceVerdict>,
    parts: Vec<Span<'a>>,
}

/// What is made so far.
struct Made<'a> {
    model: Model,
    record: &'a mut Record,
    bodies: &'a [Body],
    components: Components,
    /// The nodes of every component, and the reason by which it is used in a step.
    sets: Vec<Set>,
}

impl Made<'_> {
    /// Numbers the components of a tree in its order.
    fn number<'t>(&mut self, tree: Tree<'t>) -> Result<Span<'t>, Unproved> {
        let begin = self.sets.len();
        let (piece, parts) = match tree {
            Tree::One(members) => {
                let (nodes, body) = self.record.rigid(&members)?;
                self.components.bodies.push(body - 1);
                self.sets.push((nodes, (begin + 1) as Reason));
                (None, Vec::new())
            }
            Tree::Apart(piece, parts) => (Some(piece), parts),
            Tree::Cut(parts) => (None, self.in_order(parts)),
        };
        let parts = parts.into_iter().map(|part| self.number(part));
        Ok(Span {
            parts: parts.collect::<Result<_, _>>()?,
            piece,
            begin,
            end: self.sets.len(),
        })
    }

    /// Pieces, each next to an earlier one as long as there is such a piece: then it shares one
    /// node with all before it.
    fn in_order<'t>(&self, parts: Vec<Tree<'t>>) -> Vec<Tree<'t>> {
        let nodes: Vec<Vec<u32>> = parts.iter().map(|part| self.nodes(part)).collect();
        let mut of_node: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (k, nodes) in nodes.iter().enumerate() {
            nodes
                .iter()
                .for_each(|&v| of_node.entry(v).or_default().push(k));
        }
        let mut parts: Vec<Option<Tree<'t>>> = parts.into_iter().map(Some).collect();
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
            Tree::Cut(parts) | Tree::Apart(_, parts) => {
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
        let step = if let Some(piece) = span.piece {
            let sets = &self.sets[span.begin..span.end];
            let interval = |k: usize| ends.partition_point(|&end| end <= k + span.begin);
            let (rank, blocks) = bound(self.model, piece, self.bodies, sets)?;
            let (frame, motion) = of_sets_told_apart(self.model, sets, rank, interval)?;
            Step::Apart {
                ends,
                frame,
                motion,
                blocks,
            }
        } else {
            Step::Cut(ends)
        };
        self.components.steps.push(step);
        span.parts
            .iter()
            .rev()
            .try_for_each(|part| self.steps(part))
    }
}

/// What components of a piece count, and the blocks that they are in.
fn bound(
    model: Model,
    piece: &PieceVerdict,
    bodies: &[Body],
    sets: &[Set],
) -> Result<(usize, Vec<Block>), Unproved> {
    let alone = sets.iter().map(|(nodes, _)| model.full(nodes.len())).sum();
    let upper = piece.upper / model.times();
    if upper >= alone {
        return Ok((alone, Vec::new()));
    }
    let blocks = upper::of_piece(model, piece, bodies)?;
    let held = sets.iter().all(|(nodes, _)| upper::hold(&blocks, nodes));
    held.then_some((upper, blocks)).ok_or(Unproved::UpperBound)
}
