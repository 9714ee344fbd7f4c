//! Refutations by counting with hubs, carried from one subdivision of a kernel to the others.
//!
//! A partition into blocks, and for a block a hub v, edges at v that get copies of it, and a partition of the
//! edges of the split graph (docs/theory.md, Theorems 5.2 and 5.5), are edges of the kernel in a subdivision that the
//! prover has refuted, where no set cuts an edge of the kernel into halves; but single halves may be sets of
//! their own, as an edge that is a set of its own may. So the same sets bound the ranks of all other subdivisions. One more
//! subdivided edge adds -4 to the slack of its block, as in [`slack`](super::slack). It changes s, the sum of
//! 3 n' - 4 over the sets less 3 n - 4, only where an edge is a set of its own: 2 becomes 2 + 2, and 3 n - 4
//! grows by 3, so that s falls by 1.

use super::slack::{Block, slack};
use viewcert::contract::Members;
use viewcert::decide::evidence::Evidence;
use viewcert::decide::{Counting, Hub, Verdict};
use viewcert::graph::UnionFind;

/// Blocks of a kernel, some with a hub.
pub(super) struct Refutation {
    blocks: Vec<(Block, Option<Deduction>)>,
}

/// What a hub takes off the rank of its block.
struct Deduction {
    /// |F| - (kappa - 1) - 3 s, if nothing is subdivided.
    least: i32,
    /// The edges that are sets of their own: each one that is subdivided adds 3.
    single: u32,
}

/// A subdivision, and where its edges lie on the kernel.
pub(super) struct Halves<'a> {
    /// The ends of the kernel's edges.
    pub(super) ends: &'a [(usize, usize)],
    /// For each edge of the subdivision its ends and the edge of the kernel. Nodes of the kernel come
    /// first.
    pub(super) edges: &'a [((usize, usize), usize)],
    /// How many nodes the kernel has.
    pub(super) nodes: usize,
}

impl Refutation {
    /// The refutation of a verdict, if it is one that others can share.
    pub(super) fn of(verdict: &Verdict, halves: &Halves) -> Option<Self> {
        let [piece] = verdict.pieces.as_slice() else {
            return None;
        };
        let counting = piece
            .evidence
            .iter()
            .rev()
            .find_map(|evidence| match evidence {
                Evidence::Counting(counting) => Some(counting),
                _ => None,
            })?;
        Self::of_counting(counting, verdict, halves)
    }

    fn of_counting(counting: &Counting, verdict: &Verdict, halves: &Halves) -> Option<Self> {
        let mut blocks = Vec::new();
        for block in &counting.blocks {
            let edges = halves.of(&block.members, verdict);
            if edges.len() > 1 {
                let whole = halves.whole(&edges)?;
                let deduction = match &block.hub {
                    Some(hub) => Some(halves.deduction(whole, hub, verdict)?),
                    None => None,
                };
                let nodes = halves.nodes_of(whole);
                let block = Block {
                    edges: whole,
                    slack: slack(whole, nodes.count_ones()),
                };
                blocks.push((block, deduction));
            }
        }
        Some(Self { blocks })
    }

    /// Whether it refutes a subdivision for which 7 m - (11 n - 15) is `spare`.
    pub(super) fn refutes(&self, subdivided: u32, spare: i32) -> bool {
        let gains = self.blocks.iter().map(|(block, deduction)| {
            let hub = deduction.as_ref().map_or(0, |hub| {
                hub.least + 3 * (hub.single & subdivided).count_ones() as i32
            });
            // A block that gains nothing is left to its edges, which are blocks with slack 0.
            (block.with(subdivided) + hub.max(0)).max(0)
        });
        gains.sum::<i32>() > spare
    }
}

impl Halves<'_> {
    /// The edges of a set of members.
    fn of(&self, members: &Members, verdict: &Verdict) -> Vec<usize> {
        let bodies = members.bodies.iter();
        let bodies = bodies.map(|&body| &verdict.contraction.bodies[body as usize].nodes);
        let bodies: Vec<&Vec<u32>> = bodies.collect();
        let is_in = |&edge: &usize| {
            let (u, v) = self.edges[edge].0;
            let (u, v) = (u as u32, v as u32);
            let pair = (u.min(v), u.max(v));
            let holds =
                |nodes: &&Vec<u32>| [u, v].iter().all(|node| nodes.binary_search(node).is_ok());
            members.edges.contains(&pair) || bodies.iter().any(holds)
        };
        (0..self.edges.len()).filter(is_in).collect()
    }

    /// The edges of the kernel that these are; `None` if half of one is missing.
    fn whole(&self, edges: &[usize]) -> Option<u32> {
        let set = edges
            .iter()
            .fold(0u32, |set, &edge| set | 1 << self.edges[edge].1);
        let all = self.edges.iter().filter(|(_, edge)| set >> edge & 1 == 1);
        (all.count() == edges.len()).then_some(set)
    }

    /// The nodes of the kernel at some of its edges, as bits.
    fn nodes_of(&self, edges: u32) -> u32 {
        let ends = self.ends.iter().enumerate();
        let ends = ends.filter(|(edge, _)| edges >> edge & 1 == 1);
        ends.fold(0, |set, (_, &(u, v))| set | 1 << u | 1 << v)
    }

    /// What a hub takes off a block, if its sets are of edges of the kernel.
    fn deduction(&self, block: u32, hub: &Hub, verdict: &Verdict) -> Option<Deduction> {
        let node = hub.node as usize;
        if node >= self.nodes {
            return None;
        }
        let parts: Vec<Vec<usize>> =
            (hub.parts.iter().map(|part| self.of(part, verdict))).collect();
        // Which copy of the hub an edge at it has: 0 is the hub itself.
        let mut copy = vec![0; self.ends.len()];
        for (number, &part) in (1..).zip(&hub.split) {
            for &edge in &parts[part as usize] {
                let ((u, v), edge) = self.edges[edge];
                if u == node || v == node {
                    copy[edge] = number;
                }
            }
        }
        let copies = hub.split.len();
        let (mut single, mut sum) = (0u32, 0);
        for group in &hub.groups {
            let edges: Vec<usize> = (group.iter().flat_map(|&part| &parts[part as usize]))
                .copied()
                .collect();
            let kernel = |&edge: &usize| self.edges[edge].1;
            match edges.as_slice() {
                [edge] => single |= 1 << kernel(edge),
                [one, two] if kernel(one) == kernel(two) => single |= 1 << kernel(one),
                _ => {
                    let set = self.whole(&edges)?;
                    let others = self.nodes_of(set) & !(1 << node);
                    let here = (0..self.ends.len()).filter(|&edge| {
                        let (u, v) = self.ends[edge];
                        set >> edge & 1 == 1 && (u == node || v == node)
                    });
                    let here = here.fold(0u32, |set, edge| set | 1 << copy[edge]);
                    sum += 3 * (others.count_ones() + here.count_ones()) as i32 - 4;
                }
            }
        }
        sum += 2 * single.count_ones() as i32;
        let s = sum - (3 * self.nodes_of(block).count_ones() as i32 - 4);
        let components = self.components(block, node, &copy, copies);
        Some(Deduction {
            least: copies as i32 - (components as i32 - 1) - 3 * s,
            single,
        })
    }

    /// The connected components of a block where the hub has copies.
    fn components(&self, block: u32, node: usize, copy: &[usize], copies: usize) -> usize {
        let place = |v: usize, edge: usize| match copy[edge] {
            number if v == node && number > 0 => self.nodes + number - 1,
            _ => v,
        };
        let mut sets = UnionFind::new(self.nodes + copies);
        let mut components = self.nodes_of(block).count_ones() as usize + copies;
        for (edge, &(u, v)) in self.ends.iter().enumerate() {
            if block >> edge & 1 == 1 {
                components -= usize::from(sets.union(place(u, edge), place(v, edge)));
            }
        }
        components
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::candidates::{Candidates, least_edges};
    use super::*;
    use viewcert::decide::{Options, Question, Value, decide};
    use viewcert::geometry::model::Model;

    /// Whatever refutes one subdivision refutes none that is finite solvable, and refutes that one; and it
    /// refutes others that would have to be decided.
    #[test]
    fn what_refutes_one_refutes_no_good_one() {
        let options = Options::default().question(Question::without_solutions(Model::Projective));
        let mut counts = [0; 3];
        for nodes in [10, 11] {
            let candidates = Candidates::new(nodes, least_edges(nodes), true).unwrap();
            let spare = 7 * least_edges(nodes) as i32 - (11 * nodes as i32 - 15);
            let kernels = 0..candidates.kernels().unwrap();
            for kernel in candidates.some_kernels(kernels).unwrap().iter() {
                let kernel = kernel.multigraph();
                let ends = kernel.edge_list();
                let (mut refutations, mut others) = (Vec::new(), Vec::new());
                let subdivisions = candidates.subdivisions(&kernel);
                subdivisions.for_each(&mut |subdivision| {
                    let edges = subdivision.subdivided().unwrap();
                    let lying = subdivision.lying();
                    let pairs = lying.iter().map(|&((i, j), _)| (i.min(j), i.max(j)));
                    let mut pairs: Vec<_> = pairs.map(|(i, j)| (i as u32, j as u32)).collect();
                    pairs.sort_unstable();
                    assert_eq!(pairs, subdivision.graph().edges());
                    let verdict = decide(&subdivision.graph(), &options).unwrap();
                    others.push((edges, verdict.value, subdivision.graph()));
                    let halves = Halves {
                        ends: &ends,
                        edges: &lying,
                        nodes: kernel.nodes(),
                    };
                    let has_hub = verdict.pieces.iter().flat_map(|piece| &piece.evidence);
                    let has_hub = has_hub.filter_map(|evidence| match evidence {
                        Evidence::Counting(counting) => Some(counting),
                        _ => None,
                    });
                    let mut has_hub = has_hub.flat_map(|counting| &counting.blocks);
                    if has_hub.any(|block| block.hub.is_some())
                        && let Some(refutation) = Refutation::of(&verdict, &halves)
                    {
                        assert!(
                            refutation.refutes(edges, spare),
                            "{:?}",
                            subdivision.graph()
                        );
                        refutations.push((edges, refutation));
                        counts[0] += 1;
                    }
                    true
                });
                for (from, refutation) in &refutations {
                    for (edges, value, graph) in others.iter().filter(|(edges, ..)| edges != from) {
                        if refutation.refutes(*edges, spare) {
                            assert_eq!(*value, Value::NotFiniteSolvable, "{graph:?}");
                            counts[1] += 1;
                        } else {
                            counts[2] += 1;
                        }
                    }
                }
            }
        }
        assert!(counts.iter().all(|&count| count > 50), "{counts:?}");
    }
}
