//! The ways to cut a core at a few nodes: two sets of members that share those between these nodes.

use crate::contract::piece::Core;
use crate::watch::{Stopped, Work};

/// The core is cut at so many nodes at most.
const MAX_CUT: u32 = 7;

/// Up to so many components of what a cut leaves are distributed in all ways; of more, each one
/// is cut off from all others.
const MAX_COMPONENTS: usize = 6;

/// Two sets of members, by the bits of their positions, that cover a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Separation {
    pub first: u64,
    pub second: u64,
}

impl Separation {
    /// The members in both sets.
    pub fn shared(&self) -> u64 {
        self.first & self.second
    }

    /// Small sides first: those are what the search has most to say about.
    fn size(&self) -> (u32, u32, u64, u64) {
        let (first, second) = (self.first.count_ones(), self.second.count_ones());
        let larger = first.max(second);
        (larger, first + second, self.first, self.second)
    }
}

/// A core, by the bits of its nodes.
pub(super) struct Cut {
    /// The nodes of each member.
    nodes_of: Vec<u32>,
    /// The nodes that lie in a member with this one.
    neighbours: Vec<u32>,
}

impl Cut {
    /// # Panics
    /// If the core has no nodes or more than 32, or there are more than 64 members.
    pub fn new(core: &Core, members: usize) -> Self {
        let nodes = core.graph.nodes();
        assert!((1..=32).contains(&nodes) && members <= 64, "a bit for each");
        let mut nodes_of = vec![0; members];
        for (&(i, j), &owner) in core.graph.edges().iter().zip(&core.owner) {
            nodes_of[owner as usize] |= 1u32 << i | 1 << j;
        }
        // A chain can be cut in two, the body that it stands for cannot.
        let of_node = |v: usize| {
            let at_node = nodes_of.iter().filter(|&nodes| nodes >> v & 1 == 1);
            at_node.fold(0, |all, nodes| all | nodes)
        };
        let neighbours = (0..nodes).map(of_node).collect();
        Self {
            nodes_of,
            neighbours,
        }
    }

    /// All separations whose sides without what they share are `independent`, by their sizes. Each
    /// shares one member at least.
    pub fn separations(
        &self,
        independent: impl Fn(u64, u64) -> bool,
        work: &Work,
    ) -> Result<Vec<Separation>, Stopped> {
        let nodes = self.neighbours.len() as u32;
        let mut found = Vec::new();
        for size in 2..=MAX_CUT.min(nodes.saturating_sub(2)) {
            for cut in subsets(nodes, size) {
                let shared = self.members(|nodes| nodes & !cut == 0);
                if shared == 0 {
                    continue;
                }
                let sides = self.sides(cut);
                if sides.len() < 2 {
                    continue;
                }
                work.done(0)?;
                for (one, other) in distributions(&sides) {
                    if independent(one, other) {
                        found.push(Separation {
                            first: one | shared,
                            second: other | shared,
                        });
                    }
                }
            }
        }
        found.sort_unstable_by_key(Separation::size);
        found.dedup();
        Ok(found)
    }

    /// The members whose nodes are such.
    fn members(&self, are: impl Fn(u32) -> bool) -> u64 {
        let chosen = (0..).zip(&self.nodes_of).filter(|&(_, &nodes)| are(nodes));
        chosen.fold(0, |all, (position, _)| all | 1 << position)
    }

    /// The members with a node in each of the components that a cut leaves.
    fn sides(&self, cut: u32) -> Vec<u64> {
        let mut rest = (u32::MAX >> (32 - self.neighbours.len())) & !cut;
        let mut sides = Vec::new();
        while rest != 0 {
            let mut component = 1 << rest.trailing_zeros();
            let mut new: u32 = component;
            while new != 0 {
                let v = new.trailing_zeros() as usize;
                new &= new - 1;
                let more = self.neighbours[v] & rest & !component;
                component |= more;
                new |= more;
            }
            rest &= !component;
            sides.push(self.members(|nodes| nodes & component != 0));
        }
        sides
    }
}

/// The sets of so many of the first bits, 1 <= size < bits <= 32, in increasing order.
fn subsets(bits: u32, size: u32) -> impl Iterator<Item = u32> {
    let first = (1u64 << size) - 1;
    // The next larger number with as many ones.
    let next = |&set: &u64| {
        let lowest = set & set.wrapping_neg();
        let carried = set + lowest;
        Some(carried | (((set ^ carried) >> 2) / lowest))
    };
    std::iter::successors(Some(first), next)
        .take_while(move |set| set >> bits == 0)
        .map(|set| set as u32)
}

/// The ways to distribute these sets, two or more, over two sides, neither empty, up to exchange.
fn distributions(sides: &[u64]) -> Vec<(u64, u64)> {
    let all = sides.iter().fold(0, |all, side| all | side);
    if sides.len() > MAX_COMPONENTS {
        return sides.iter().map(|side| (all & !side, *side)).collect();
    }
    // The first of them is always on the first side.
    let choices = 0..(1u32 << (sides.len() - 1)) - 1;
    choices
        .map(|choice| {
            let chosen = |k: &usize| *k == 0 || choice >> (k - 1) & 1 == 1;
            let one = (0..sides.len()).filter(chosen);
            let one = one.fold(0, |one, k| one | sides[k]);
            (one, all & !one)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Contraction;
    use crate::contract::piece::Assembly;
    use crate::geometry::model::Model;
    use crate::graph::Graph;
    use crate::watch::unwatched;

    fn separations(nodes: u32, pairs: &[(u32, u32)], contract: bool) -> Vec<(u64, u64)> {
        let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
        let contraction = if contract {
            Contraction::new(&graph, Model::Projective)
        } else {
            Contraction::none(&graph)
        };
        let assembly = Assembly::new(&graph, &contraction);
        let all = assembly.all();
        let cut = Cut::new(&assembly.core(&all), all.len());
        let found = unwatched(|task| cut.separations(|_, _| true, &task.begin(0)));
        found.iter().map(|one| (one.first, one.second)).collect()
    }

    #[test]
    fn subsets_by_hand() {
        let found: Vec<u32> = subsets(4, 2).collect();
        assert_eq!(found, [0b0011, 0b0101, 0b0110, 0b1001, 0b1010, 0b1100]);
        assert_eq!(subsets(20, 7).count(), 77_520);
    }

    #[test]
    fn three_sets_are_distributed_in_three_ways() {
        assert_eq!(distributions(&[1, 2, 4]), [(1, 6), (3, 4), (5, 2)]);
        let many: Vec<u64> = (0..7).map(|k| 1 << k).collect();
        assert_eq!(distributions(&many).len(), 7);
    }

    /// Edges 01, 02, 12, 13, 23: only between 1 and 2 is there an edge to share.
    #[test]
    fn two_triangles_share_an_edge() {
        let pairs = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)];
        assert_eq!(separations(4, &pairs, false), [(0b00111, 0b11100)]);
        // A cycle has no edge between two nodes that cut it.
        let cycle = [(0, 1), (1, 2), (2, 3), (0, 3)];
        assert_eq!(separations(4, &cycle, false), []);
    }

    /// A strip of triangles 0, .., 4, which is a body (position 0), with the paths 0-5-6-1 and
    /// 3-7-8-4. Its chain 01, 03, 13, 14, 34 falls apart without 1 and 3; the body does not.
    const STRIP_AND_PATHS: [(u32, u32); 13] = [
        (0, 1),
        (0, 2),
        (1, 2),
        (1, 3),
        (2, 3),
        (2, 4),
        (3, 4),
        (0, 5),
        (5, 6),
        (1, 6),
        (3, 7),
        (7, 8),
        (4, 8),
    ];

    /// All ways to put each member on the first side, the second or both, so that exactly the
    /// members between the nodes of both sides are on both.
    #[test]
    fn a_body_is_not_cut() {
        // The nodes 0, 1, 3 and 4: only the body has 2.
        let (body, edges) = (0b1_1011u32, &STRIP_AND_PATHS[7..]);
        let mut edges: Vec<u32> = edges.iter().map(|&(i, j)| 1 << i | 1 << j).collect();
        // Loose edges in their order: 05, 16, 37, 48, 56, 78.
        edges.sort_by_key(|nodes| (nodes.trailing_zeros(), *nodes));
        let members = [&[body], &edges[..]].concat();
        let nodes = |set: u64| {
            let inside = (0..).zip(&members).filter(|&(k, _)| set >> k & 1u64 == 1);
            inside.fold(0, |all, (_, nodes)| all | nodes)
        };
        let mut wanted = Vec::new();
        for first in 1..128u64 {
            for second in 1..128u64 {
                let cut = nodes(first) & nodes(second);
                let is_shared = |k: usize| members[k] & !cut == 0;
                let shared = (0..7)
                    .filter(|&k| is_shared(k))
                    .fold(0, |all, k| all | 1 << k);
                let proper = nodes(first) != cut && nodes(second) != cut;
                let whole = first | second == 127 && first & second == shared;
                if proper && whole && shared != 0 {
                    wanted.push((first.min(second), first.max(second)));
                }
            }
        }
        wanted.sort_unstable();
        wanted.dedup();
        let found = separations(9, &STRIP_AND_PATHS, true);
        let mut found: Vec<_> = found.iter().map(|&(a, b)| (a.min(b), a.max(b))).collect();
        found.sort_unstable();
        assert_eq!(found, wanted);
        assert!(!wanted.is_empty());
    }
}
