//! Refutations by counting, for all subdivisions of a kernel at once.
//!
//! A block of a partition that has n_B nodes and m_B edges lowers the bound of Theorem 5.1 (theory)
//! by its *surplus* 7 m_B - (11 n_B - 15), if that is positive; a graph with 7 m - (11 n - 15) = e is
//! refuted as soon as blocks without common edges have a surplus of more than e in all. A block
//! worth looking at is induced by some nodes of the kernel, together with the inner nodes of the
//! subdivided edges among them: an inner node adds 14 - 11 - 7 = -4 to the surplus of the kernel's
//! edges.

use super::super::multigraph::Multigraph;
use super::flows::MAX_EDGES;

/// Edges of the kernel that one block may have.
#[derive(Clone, Copy)]
struct Block {
    /// The edges, as bits.
    edges: u32,
    /// The surplus if none of them is subdivided.
    surplus: i32,
}

/// The blocks of a kernel.
pub(super) struct Blocks {
    /// What the blocks must exceed.
    spare: i32,
    /// Those with a positive surplus when nothing is subdivided that need not be. The ones that
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
                surplus: surplus(edges, inside.count_ones()),
            };
            let dense = || {
                let mut nodes = at.iter().enumerate().filter(|(v, _)| inside >> v & 1 == 1);
                // Without a node of degree 1 or 0 the surplus is larger.
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

    /// Whether several blocks without common edges do.
    pub(super) fn several_refute(&self, subdivided: u32) -> bool {
        let mut positive: Vec<Block> = self
            .blocks
            .iter()
            .map(|block| Block {
                edges: block.edges,
                surplus: block.with(subdivided),
            })
            .filter(|block| block.surplus > 0)
            .collect();
        positive.sort_by_key(|block| -block.surplus);
        exceed(&positive, 0, self.spare)
    }
}

impl Block {
    /// The surplus with these edges subdivided.
    fn with(&self, subdivided: u32) -> i32 {
        self.surplus - 4 * (self.edges & subdivided).count_ones() as i32
    }
}

fn surplus(edges: u32, nodes: u32) -> i32 {
    7 * edges.count_ones() as i32 - 11 * nodes as i32 + 15
}

/// Whether some of the blocks, which have no edge in common with `taken` or each other, have more
/// than `spare` in all.
fn exceed(blocks: &[Block], taken: u32, spare: i32) -> bool {
    blocks.iter().enumerate().any(|(k, block)| {
        block.edges & taken == 0
            && (block.surplus > spare
                || exceed(&blocks[k + 1..], taken | block.edges, spare - block.surplus))
    })
}
