//! Upper bounds by blocks (docs/proof.md): hubs, parts that overlap.
//!
//! In: the pieces of a verdict. Out: one or two lists of blocks, what both have in common, and the sum.
//!
//! Without hubs, parts that overlap and added pairs never give less than a partition does: the
//! smallest sum over partitions is submodular in the pairs, and grows with them.

use super::Unproved;
use super::bodies::{Set, of_sets};
use super::listed::Listed;
use crate::contract::Body;
use crate::contract::piece::Members;
use crate::decide::evidence::{Block as Counted, Bound, Evidence, Hub, PieceVerdict, Upper};
use crate::decide::{Counting, Overlap, Verdict};
use crate::geometry::model::Model;

/// Nodes, or cells of a split graph of them.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// A hub stands first.
    pub(super) nodes: Vec<u32>,
    pub(super) split: Option<Split>,
}

/// Cells of a split graph: numbers below that of the block's nodes are places among these, the
/// others are copies of the hub.
#[derive(Clone, Debug)]
pub(super) struct Split {
    pub(super) copies: usize,
    pub(super) cells: Vec<Vec<u32>>,
}

/// Blocks, other blocks, and a body for what both have in common.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    pub(super) first: Vec<Block>,
    pub(super) second: Vec<Block>,
    pub(super) shared: Option<Listed>,
}

impl Blocks {
    /// Whether a cell of a block holds all these nodes.
    pub(super) fn hold(&self, nodes: &[u32]) -> bool {
        let mut blocks = self.first.iter().chain(&self.second);
        blocks.any(|block| block.holds(nodes))
    }
}

impl Block {
    fn holds(&self, nodes: &[u32]) -> bool {
        let all_in = |cell: &[u32]| nodes.iter().all(|v| cell.contains(v));
        let Some(split) = &self.split else {
            return all_in(&self.nodes);
        };
        let node = |&x: &u32| *self.nodes.get(x as usize).unwrap_or(&self.nodes[0]);
        let mut cells = split.cells.iter();
        cells.any(|cell| all_in(&cell.iter().map(node).collect::<Vec<_>>()))
    }

    fn of(counted: &Counted, bodies: &[Body]) -> Self {
        let mut nodes = counted.members.nodes(bodies);
        let split = counted.hub().map(|hub| {
            nodes.retain(|&v| v != hub.node);
            nodes.insert(0, hub.node);
            Split::of(hub, &nodes, bodies)
        });
        Self { nodes, split }
    }
}

impl Split {
    fn of(hub: &Hub, nodes: &[u32], bodies: &[Body]) -> Self {
        // The first node is the hub, the others increase.
        let place = |v: u32| match nodes[1..].binary_search(&v) {
            Ok(k) => k as u32 + 1,
            Err(_) => 0,
        };
        let of_part = |part: u32| {
            let copy = hub.split.binary_search(&part);
            let copy = copy.map_or(0, |k| (nodes.len() + k) as u32);
            let places = hub.parts[part as usize]
                .nodes(bodies)
                .into_iter()
                .map(place);
            places.map(move |x| if x == 0 { copy } else { x })
        };
        let cell = |group: &Vec<u32>| {
            let mut cell: Vec<u32> = group.iter().flat_map(|&part| of_part(part)).collect();
            cell.sort_unstable();
            cell.dedup();
            cell
        };
        Self {
            copies: hub.split.len(),
            cells: hub.groups.iter().map(cell).collect(),
        }
    }
}

/// The bound of a verdict.
pub(super) fn of(verdict: &Verdict) -> Result<(usize, Blocks), Unproved> {
    let bodies = &verdict.contraction.bodies;
    let mut sum = 0;
    let mut found = Found::new(verdict.model);
    for part in verdict.rigid.singles() {
        let nodes = part.nodes(bodies);
        sum += verdict.model.full(nodes.len());
        found.first.push(Block { nodes, split: None });
    }
    for piece in &verdict.pieces {
        sum += found.piece(piece, bodies)?;
    }
    Ok((sum, found.blocks()?))
}

/// The bound of a piece alone.
pub(super) fn of_piece(
    model: Model,
    piece: &PieceVerdict,
    bodies: &[Body],
) -> Result<Blocks, Unproved> {
    let mut found = Found::new(model);
    found.piece(piece, bodies)?;
    found.blocks()
}

/// Both lists, and the sets and the rank of what they have in common.
struct Found {
    model: Model,
    first: Vec<Block>,
    second: Vec<Block>,
    shared: Vec<Set>,
    rank: usize,
}

impl Found {
    fn new(model: Model) -> Self {
        Self {
            model,
            first: Vec::new(),
            second: Vec::new(),
            shared: Vec::new(),
            rank: 0,
        }
    }

    /// What a piece counts.
    fn piece(&mut self, piece: &PieceVerdict, bodies: &[Body]) -> Result<usize, Unproved> {
        let nodes = piece.members.nodes(bodies);
        let full = self.model.full(nodes.len());
        let upper = piece.upper / self.model.times();
        if upper >= full {
            self.first.push(Block { nodes, split: None });
            return Ok(full);
        }
        let bounds = piece.evidence.iter().filter_map(|evidence| match evidence {
            // Points are a step that proofs do not know.
            Evidence::Upper(by) if bound_of(by) == piece.upper && !by.has_points() => Some(by),
            _ => None,
        });
        match &bounds
            .min_by_key(|upper| complexity(upper))
            .ok_or(Unproved::UpperBound)?
            .by
        {
            Bound::Counting(counting) => self.first.extend(blocks_of(counting, bodies)),
            Bound::Overlap(overlap) => self.overlap(overlap, bodies),
        }
        Ok(upper)
    }

    fn overlap(&mut self, overlap: &Overlap, bodies: &[Body]) {
        self.first.extend(blocks_of(&overlap.first, bodies));
        self.second.extend(blocks_of(&overlap.second, bodies));
        self.rank += overlap.first.bound + overlap.second.bound - overlap.bound;
        let mut shared = overlap.shared.rigid.clone();
        for piece in &overlap.shared.pieces {
            shared.extend(&piece.members);
        }
        let sets = shared
            .singles()
            .into_iter()
            .map(|one| (one.nodes(bodies), 0));
        self.shared.extend(sets);
    }

    /// Without other blocks a pair needs no block of its own.
    fn blocks(mut self) -> Result<Blocks, Unproved> {
        if self.second.is_empty() {
            self.first.retain(|block| block.nodes.len() > 2);
            return Ok(Blocks {
                first: self.first,
                ..Blocks::default()
            });
        }
        let shared = Some(of_sets(self.model, &self.shared, self.rank)?);
        Ok(Blocks {
            first: self.first,
            second: self.second,
            shared,
        })
    }
}

fn bound_of(upper: &Upper) -> usize {
    match &upper.by {
        Bound::Counting(counting) => counting.bound,
        Bound::Overlap(overlap) => overlap.bound,
    }
}

/// Blocks alone before hubs, and these before parts that overlap.
fn complexity(upper: &Upper) -> usize {
    match &upper.by {
        Bound::Counting(counting) if counting.blocks.iter().all(|block| block.loss.is_none()) => 0,
        Bound::Counting(_) => 1,
        Bound::Overlap(_) => 2,
    }
}

fn blocks_of(counting: &Counting, bodies: &[Body]) -> Vec<Block> {
    counting
        .blocks
        .iter()
        .map(|block| Block::of(block, bodies))
        .collect()
}

impl Members {
    /// Its nodes, increasing.
    fn nodes(&self, bodies: &[Body]) -> Vec<u32> {
        let of_bodies = self.bodies.iter().flat_map(|&k| &bodies[k as usize].nodes);
        let of_edges = self.edges.iter().flat_map(|&(i, j)| [i, j]);
        let mut nodes: Vec<u32> = of_bodies.copied().chain(of_edges).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }
}
