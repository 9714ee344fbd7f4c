//! The moves of Trager, Osserman and Ponce (their Theorem 3).
//!
//! A *solid* edge is a fundamental matrix that is determined; a *dashed* arrow from a to b
//! says that less is: an epipole. Solid edges count as arrows in both directions. Until
//! nothing changes:
//!
//! 1. nodes a, b that both have solid edges to i and j, which have one themselves, get a
//!    solid edge (two triangles on one edge);
//! 2. where arrows run from a to k and to l, and k and l have solid edges to b, an arrow runs
//!    from a to b;
//! 3. nodes a, b with arrows in both directions, and arrows to both of them from three
//!    other nodes, get a solid edge.
//!
//! No move takes anything away, so the result does not depend on their order. If it is the
//! complete graph, the graph is solvable.

use super::{Answer, Decided, Grounds};
use viewcert::graph::Graph;

/// Most cameras for which moves are tried: each round takes O(n^3).
pub const MAX_NODES: usize = 300;

/// A move, with the nodes that allow it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// A solid edge between the two: both have solid edges to the ends of an edge.
    Solid([u32; 2], [u32; 2]),
    /// An arrow from the first to the second, by way of two nodes.
    Dashed([u32; 2], [u32; 2]),
    /// The arrows between the two become a solid edge, by three nodes.
    Upgrade([u32; 2], [u32; 3]),
}

/// Square tables of flags.
struct Flags {
    nodes: usize,
    set: Vec<bool>,
}

impl Flags {
    fn new(nodes: usize) -> Self {
        Self {
            nodes,
            set: vec![false; nodes * nodes],
        }
    }

    fn get(&self, a: usize, b: usize) -> bool {
        self.set[a * self.nodes + b]
    }

    fn set(&mut self, a: usize, b: usize) {
        self.set[a * self.nodes + b] = true;
    }
}

/// The two or three first nodes with a property.
fn first<const COUNT: usize>(nodes: usize, holds: impl Fn(usize) -> bool) -> Option<[u32; COUNT]> {
    let mut found = (0..nodes).filter(|&k| holds(k)).map(|k| k as u32);
    let mut result = [0; COUNT];
    for place in &mut result {
        *place = found.next()?;
    }
    Some(result)
}

/// Two nodes joined by a solid edge with solid edges to both a and b.
fn diagonal(solid: &Flags, a: usize, b: usize) -> Option<[u32; 2]> {
    let both = |k: usize| solid.get(a, k) && solid.get(b, k);
    (0..solid.nodes).filter(|&i| both(i)).find_map(|i| {
        let j = (i + 1..solid.nodes).find(|&j| both(j) && solid.get(i, j))?;
        Some([i as u32, j as u32])
    })
}

/// All moves in the order in which they are made, and the number of pairs of nodes that
/// end without a solid edge.
pub fn complete(graph: &Graph) -> (Vec<Move>, usize) {
    let mut board = Board::new(graph);
    loop {
        let before = board.moves.len();
        board.solid_moves();
        board.dashed_moves();
        board.upgrades();
        if board.moves.len() == before {
            break;
        }
    }
    let missing = board.without_solid().len();
    (board.moves, missing)
}

/// The edges that there are, and the moves that have made them.
struct Board {
    nodes: usize,
    solid: Flags,
    /// Dashed edges have a direction; a solid edge counts as one in both.
    arrow: Flags,
    moves: Vec<Move>,
}

impl Board {
    fn new(graph: &Graph) -> Self {
        let nodes = graph.nodes();
        let (mut solid, mut arrow) = (Flags::new(nodes), Flags::new(nodes));
        for &(i, j) in graph.edges() {
            for (a, b) in [(i as usize, j as usize), (j as usize, i as usize)] {
                solid.set(a, b);
                arrow.set(a, b);
            }
        }
        Self {
            nodes,
            solid,
            arrow,
            moves: Vec::new(),
        }
    }

    /// The pairs (a, b) with a < b and no solid edge, by a.
    fn without_solid(&self) -> Vec<(usize, usize)> {
        let pairs = (0..self.nodes).flat_map(|a| (a + 1..self.nodes).map(move |b| (a, b)));
        pairs.filter(|&(a, b)| !self.solid.get(a, b)).collect()
    }

    fn solid_moves(&mut self) {
        for (a, b) in self.without_solid() {
            if let Some(via) = diagonal(&self.solid, a, b) {
                for (x, y) in [(a, b), (b, a)] {
                    self.solid.set(x, y);
                    self.arrow.set(x, y);
                }
                self.moves.push(Move::Solid(pair(a, b), via));
            }
        }
    }

    fn dashed_moves(&mut self) {
        for a in 0..self.nodes {
            for b in (0..self.nodes).filter(|&b| b != a) {
                if self.arrow.get(a, b) {
                    continue;
                }
                let by = |k| self.arrow.get(a, k) && self.solid.get(k, b);
                if let Some(via) = first(self.nodes, by) {
                    self.arrow.set(a, b);
                    self.moves.push(Move::Dashed(pair(a, b), via));
                }
            }
        }
    }

    fn upgrades(&mut self) {
        for (a, b) in self.without_solid() {
            if !self.arrow.get(a, b) || !self.arrow.get(b, a) {
                continue;
            }
            let by = |k| self.arrow.get(k, a) && self.arrow.get(k, b);
            if let Some(via) = first(self.nodes, by) {
                self.solid.set(a, b);
                self.solid.set(b, a);
                self.moves.push(Move::Upgrade(pair(a, b), via));
            }
        }
    }
}

fn pair(a: usize, b: usize) -> [u32; 2] {
    [a as u32, b as u32]
}

pub(super) fn decide(graph: &Graph) -> Decided {
    let nodes = graph.nodes();
    if nodes > MAX_NODES {
        return Err(format!(
            "{nodes} cameras are too many for the moves (at most {MAX_NODES})"
        ));
    }
    let (moves, missing) = complete(graph);
    Ok(if missing == 0 {
        (Answer::Yes, Some(Grounds::Moves(moves)))
    } else {
        (Answer::No, Some(Grounds::Missing(missing)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_hand() {
        // Two triangles on the edge 1-2: 0 and 3 are joined.
        let strip = vec![(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)];
        let (graph, _) = Graph::from_pairs(4, strip).unwrap();
        assert_eq!(complete(&graph), (vec![Move::Solid([0, 3], [1, 2])], 0));
        // The 4-cycle gets arrows along both diagonals, and no third way.
        let (square, _) = Graph::from_pairs(4, vec![(0, 1), (1, 2), (2, 3), (0, 3)]).unwrap();
        let (moves, missing) = complete(&square);
        assert_eq!(missing, 2);
        assert_eq!(
            moves,
            [
                Move::Dashed([0, 2], [1, 3]),
                Move::Dashed([1, 3], [0, 2]),
                Move::Dashed([2, 0], [1, 3]),
                Move::Dashed([3, 1], [0, 2]),
            ]
        );
    }
}
