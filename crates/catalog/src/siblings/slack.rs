//! Refutations by counting, for all subdivisions of a kernel at once.
//!
//! A block of a partition that has n_B nodes and m_B edges lowers the bound of Theorem 5.1 (theory)
//! by its *slack* 7 m_B - (11 n_B - 15), if that is positive; a graph with 7 m - (11 n - 15) = e is
//! refuted as soon as blocks without common edges have a slack of more than e in all. A block
//! worth looking at is induced by some nodes of the kernel, together with the inner nodes of the
//! subdivided edges among them: an inner node adds 14 - 11 - 7 = -4 to the slack of the kernel's
//! edges.

use super::super::multigraph::Multigraph;
use super::flows::MAX_EDGES;

/// Edges of the kernel that one block may have.
#[derive(Clone, Copy)]
struct Block {
    /// The edges, as bits.
    edges: u32,
    /// The slack if none of them is subdivided.
    slack: i32,
}

/// The blocks of a kernel.
pub(super) struct Blocks {
    /// What the blocks must exceed.
    spare: i32,
    /// Those with a positive slack when nothing is subdivided that need not be. The ones that
    /// refuted last come first.
    blocks: Vec<Block>,
}

impl Blocks {
    /// The blocks of the subdivisions for which 7 m - (11 n - 15) is `spare`. O(2^n) for a kernel
    /// with n nodes.
    pub(super) fn new(kernel: &Multigraph, spare: i32) -> Self {
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
        Self { spare, blocks }
    }

    /// Whether one block refutes the subdivision.
    pub(super) fn one_refutes(&mut self, subdivided: u32) -> bool {
        let spare = self.spare;
        let found = self
            .blocks
            .iter()
            .position(|block| block.with(subdivided) > spare);
        if let Some(found) = found.filter(|&found| found > 0) {
            self.blocks.swap(found, found / 2);
        }
        found.is_some()
    }

    /// Whether several blocks without common edges do. False says nothing: the search is bounded.
    pub(super) fn several_refute(&self, subdivided: u32) -> bool {
        let mut positive: Vec<Block> = self
            .blocks
            .iter()
            .map(|block| Block {
                edges: block.edges,
                slack: block.with(subdivided),
            })
            .filter(|block| block.slack > 0)
            .collect();
        positive.sort_by_key(|block| -block.slack);
        let left = positive.iter().fold(0, |all, block| all | block.edges);
        exceed(&positive, left, self.spare, &mut { STEPS })
    }
}

impl Block {
    /// The slack with these edges subdivided.
    fn with(&self, subdivided: u32) -> i32 {
        self.slack - 4 * (self.edges & subdivided).count_ones() as i32
    }
}

fn slack(edges: u32, nodes: u32) -> i32 {
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
