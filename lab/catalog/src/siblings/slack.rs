//! Refutations by counting, for all subdivisions of a kernel at once.
//!
//! A block of a partition that has n_B nodes and m_B edges lowers the bound of Theorem 5.1 (theory)
//! by its *slack* 7 m_B - (11 n_B - 15), if that is positive; a graph with 7 m - (11 n - 15) = e is
//! refuted as soon as blocks without common edges have a slack of more than e in all. A block
//! worth looking at is induced by some nodes of the kernel, together with the inner nodes of the
//! subdivided edges among them: an inner node adds 14 - 11 - 7 = -4 to the slack of the kernel's
//! edges. So a block refutes a subdivision iff at least so many subdivided edges are outside of it: with
//! a graph it refutes all that subdivide more edges of it.

use super::super::multigraph::Multigraph;
use super::conditions::MAX_EDGES;

/// Edges of the kernel that one block may have.
#[derive(Clone, Copy)]
pub(super) struct Block {
    /// The edges, as bits.
    pub(super) edges: u32,
    /// The slack if none of them is subdivided.
    pub(super) slack: i32,
}

/// What one block refutes: whatever has `least` subdivided edges or more among those `outside` of it.
#[derive(Clone, Copy)]
struct Outside {
    outside: u32,
    least: u32,
}

/// The blocks of a kernel.
pub(super) struct Blocks {
    /// What the blocks must exceed.
    spare: i32,
    /// Those with a positive slack when nothing is subdivided that need not be.
    blocks: Vec<Block>,
    outside: Vec<Outside>,
    /// Those with a positive slack, of the last subdivision that was looked at.
    positive: Vec<Block>,
}

/// Which edges complete a set to one that a block refutes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Completing {
    /// The set is refuted by itself.
    Any,
    /// These, as bits.
    Edges(u32),
}

impl Blocks {
    /// The blocks of the subdivisions of so many edges, for which 7 m - (11 n - 15) is `spare`. O(2^n) for
    /// a kernel with n nodes.
    pub(super) fn new(kernel: &Multigraph, subdivided: usize, spare: i32) -> Self {
        let ends = kernel.edge_list();
        debug_assert!(ends.len() <= MAX_EDGES);
        let nodes = kernel.nodes();
        let mut at = vec![0u32; nodes];
        for (edge, &(u, v)) in ends.iter().enumerate() {
            at[u] |= 1 << edge;
            at[v] |= 1 << edge;
        }
        // Of parallel edges all but one are subdivided.
        let forced = (1..ends.len()).filter(|&edge| ends[edge] == ends[edge - 1]);
        let forced: u32 = forced.fold(0, |set, edge| set | 1 << (edge - 1));
        // The edges with an end in each set of nodes.
        let mut touched = vec![0u32; 1 << nodes];
        for set in 1..1usize << nodes {
            let lowest = set.trailing_zeros() as usize;
            touched[set] = touched[set & (set - 1)] | at[lowest];
        }
        let all = touched[(1 << nodes) - 1];
        let mut blocks = Vec::new();
        for inside in 3..(1usize << nodes) - 1 {
            let edges = all & !touched[(1 << nodes) - 1 - inside];
            let block = Block {
                edges,
                slack: slack(edges, inside.count_ones()),
            };
            let dense = || {
                let mut nodes = at.iter().enumerate().filter(|(v, _)| inside >> v & 1 == 1);
                // Without a node of degree 1 or 0 the slack is larger.
                nodes.all(|(_, at)| (at & edges).count_ones() >= 2)
            };
            if block.with(forced) > 0 && dense() {
                blocks.push(block);
            }
        }
        blocks.sort_by_key(|block| -block.with(forced));
        let outside = |block: &Block| {
            let outside = all & !block.edges;
            let missing = spare + 4 * subdivided as i32 - block.slack;
            let least = (missing.div_euclid(4) + 1).max(0) as u32;
            (least <= outside.count_ones().min(subdivided as u32))
                .then_some(Outside { outside, least })
        };
        let mut outside: Vec<Outside> = blocks.iter().filter_map(outside).collect();
        outside.sort_by_key(|one| (one.least, one.outside.count_ones()));
        let mut needed: Vec<Outside> = Vec::new();
        for one in outside {
            // Whatever this one refutes, another one does.
            let spared = |other: &Outside| {
                let more = (one.outside & !other.outside).count_ones();
                one.least >= other.least + more
            };
            if !needed.iter().any(spared) {
                needed.push(one);
            }
        }
        Self {
            spare,
            blocks,
            outside: needed,
            positive: Vec::new(),
        }
    }

    /// Whether one block refutes all subdivisions of these edges and others.
    pub(super) fn one_refutes(&self, subdivided: u32) -> bool {
        let mut blocks = self.outside.iter();
        blocks.any(|block| (block.outside & subdivided).count_ones() >= block.least)
    }

    /// The edges of which one more is enough for one block to refute the subdivision.
    pub(super) fn completing(&self, subdivided: u32) -> Completing {
        let mut edges = 0;
        for block in &self.outside {
            let count = (block.outside & subdivided).count_ones();
            if count >= block.least {
                return Completing::Any;
            }
            if count + 1 == block.least {
                edges |= block.outside;
            }
        }
        Completing::Edges(edges)
    }

    /// Whether several blocks without common edges do. False says nothing: the search is bounded.
    pub(super) fn several_refute(&mut self, subdivided: u32) -> bool {
        self.positive.clear();
        let slacks = self.blocks.iter().map(|block| Block {
            edges: block.edges,
            slack: block.with(subdivided),
        });
        self.positive.extend(slacks.filter(|block| block.slack > 0));
        self.positive.sort_by_key(|block| -block.slack);
        let left = self.positive.iter().fold(0, |all, block| all | block.edges);
        exceed(&self.positive, left, self.spare, &mut { STEPS })
    }
}

impl Block {
    /// The slack with these edges subdivided.
    pub(super) fn with(&self, subdivided: u32) -> i32 {
        self.slack - 4 * (self.edges & subdivided).count_ones() as i32
    }
}

/// The slack of edges that have so many nodes.
pub(super) fn slack(edges: u32, nodes: u32) -> i32 {
    7 * edges.count_ones() as i32 - 11 * nodes as i32 + 15
}

/// After so many blocks the search for several is given up.
const STEPS: u32 = 1000;

/// Whether some of the blocks, given by falling slack, without common edges and within those that
/// are `left`, have more than `spare` in all. `steps` is how many more blocks may be looked at.
fn exceed(blocks: &[Block], left: u32, spare: i32, steps: &mut u32) -> bool {
    // A block has three edges of the kernel at least, unless it is two or more parallel ones.
    let most = left.count_ones() as i32 / 2;
    for (k, block) in blocks.iter().enumerate() {
        if *steps == 0 || most * block.slack <= spare {
            return false;
        }
        *steps -= 1;
        if block.edges & !left != 0 {
            continue;
        }
        let rest = left & !block.edges;
        if block.slack > spare || exceed(&blocks[k + 1..], rest, spare - block.slack, steps) {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All sets of blocks.
    fn by_brute_force(blocks: &[Block], spare: i32) -> bool {
        (0u32..1 << blocks.len()).any(|set| {
            let chosen = blocks.iter().enumerate();
            let chosen = chosen
                .filter(|(k, _)| set >> k & 1 == 1)
                .map(|(_, block)| block);
            let disjoint = chosen.clone().try_fold(0, |all: u32, block| {
                (all & block.edges == 0).then_some(all | block.edges)
            });
            let sum: i32 = chosen.map(|block| block.slack).sum();
            disjoint.is_some() && sum > spare
        })
    }

    #[test]
    fn several_blocks_against_all_sets() {
        let mut state = 1u64;
        let mut next = |below: u64| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) % below
        };
        let mut seen = [0, 0];
        for _ in 0..3000 {
            let mut blocks: Vec<Block> = (0..next(9))
                .map(|_| Block {
                    edges: (0..2 + next(4)).fold(0, |set, k| set | 0b11 << (2 * k) << next(8)),
                    slack: 1 + next(6) as i32,
                })
                .collect();
            blocks.sort_by_key(|block| -block.slack);
            let spare = next(14) as i32;
            let left = blocks.iter().fold(0, |all, block| all | block.edges);
            let expected = by_brute_force(&blocks, spare);
            assert_eq!(exceed(&blocks, left, spare, &mut { STEPS }), expected);
            seen[usize::from(expected)] += 1;
        }
        assert!(seen[0] > 500 && seen[1] > 500, "{seen:?}");
    }

    /// Many small blocks: the search ends.
    #[test]
    fn the_search_is_bounded() {
        let blocks: Vec<Block> = (0..1 << 12)
            .map(|k: u32| Block {
                edges: k | 0b11 << 12,
                slack: 1,
            })
            .collect();
        let mut steps = STEPS;
        assert!(!exceed(&blocks, (1 << 14) - 1, 6, &mut steps));
        assert_eq!(steps, 0);
    }
}
