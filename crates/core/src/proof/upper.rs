//! Upper bounds by blocks, with hubs (docs/proof.md).
//!
//! In: the pieces of a verdict. Out: a list of blocks, and the sum.

use super::Unproved;
use crate::contract::Body;
use crate::contract::piece::Members;
use crate::decide::Verdict;
use crate::decide::evidence::{Block as Counted, Evidence, Hub, PieceVerdict};
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

/// Whether a cell of a block holds all these nodes.
pub(super) fn hold(blocks: &[Block], nodes: &[u32]) -> bool {
    blocks.iter().any(|block| block.holds(nodes))
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
        let split = counted.hub.as_ref().map(|hub| {
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
            crate::graph::sort_once(&mut cell);
            cell
        };
        Self {
            copies: hub.split.len(),
            cells: hub.groups.iter().map(cell).collect(),
        }
    }
}

/// The bound of a verdict.
pub(super) fn of(verdict: &Verdict) -> Result<(usize, Vec<Block>), Unproved> {
    let bodies = &verdict.contraction.bodies;
    let mut sum = 0;
    let mut found = Vec::new();
    for part in verdict.rigid.singles() {
        let nodes = part.nodes(bodies);
        sum += verdict.model.full(nodes.len());
        found.push(Block { nodes, split: None });
    }
    for piece in &verdict.pieces {
        found.extend(of_piece(verdict.model, piece, bodies)?);
        let full = verdict.model.full(piece.members.nodes(bodies).len());
        sum += full.min(piece.upper / verdict.model.times());
    }
    Ok((sum, found.into_iter().filter(counts).collect()))
}

/// The bound of a piece alone.
pub(super) fn of_piece(
    model: Model,
    piece: &PieceVerdict,
    bodies: &[Body],
) -> Result<Vec<Block>, Unproved> {
    let nodes = piece.members.nodes(bodies);
    if piece.upper / model.times() >= model.full(nodes.len()) {
        return Ok([Block { nodes, split: None }]
            .into_iter()
            .filter(counts)
            .collect());
    }
    let counting = piece.evidence.iter().find_map(|evidence| match evidence {
        Evidence::Counting(counting) if counting.bound == piece.upper => Some(counting),
        _ => None,
    });
    let blocks = counting.ok_or(Unproved::UpperBound)?.blocks.iter();
    let blocks = blocks.map(|block| Block::of(block, bodies));
    Ok(blocks.filter(counts).collect())
}

/// A pair needs no block of its own.
fn counts(block: &Block) -> bool {
    block.nodes.len() > 2
}

impl Members {
    /// Its nodes, increasing.
    fn nodes(&self, bodies: &[Body]) -> Vec<u32> {
        let of_bodies = self.bodies.iter().flat_map(|&k| &bodies[k as usize].nodes);
        let of_edges = self.edges.iter().flat_map(|&(i, j)| [i, j]);
        let mut nodes: Vec<u32> = of_bodies.copied().chain(of_edges).collect();
        crate::graph::sort_once(&mut nodes);
        nodes
    }
}
