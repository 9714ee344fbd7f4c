//! Subdivisions of a kernel, one of each isomorphism class.
//!
//! Graphs with isomorphic kernels are isomorphic iff an automorphism of the kernel carries
//! one's numbers of subdividing nodes into the other's. The edges between two nodes of the
//! kernel are interchangeable, so a subdivision is a falling list of numbers for every
//! pair of adjacent nodes, at most one of them zero (the graph is simple); of the lists
//! that the automorphisms of the kernel's nodes carry into each other, the largest counts.

use super::canonical::{canonical, group};
use super::kernel::MAX_CYCLES;
use super::multigraph::{MAX_NODES, Multigraph};
use viewcert::graph::Graph;

/// The most nodes of a subdivision. A kernel has [`MAX_NODES`] at most, and nodes of degree 2 are
/// never put into sets.
pub const MOST_NODES: usize = 17;

/// Which subdivisions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edges {
    /// Any.
    Any,
    /// No two adjacent nodes of degree 2: every edge is subdivided at most once.
    Once,
}

/// The subdivisions of one kernel with some number of nodes.
pub struct Subdivisions {
    kernel: Multigraph,
    /// Adjacent nodes and how many edges join them.
    pairs: Vec<(usize, usize, usize)>,
    /// The automorphisms of the kernel's nodes except the identity: pair k goes to `[k]`.
    symmetries: Vec<Vec<u8>>,
    nodes: usize,
    edges: Edges,
}

/// Numbers of subdividing nodes for the edges of a pair: four bits each, the largest in the
/// highest bits, each increased by one so that the number of edges shows.
type Code = u64;

impl Subdivisions {
    /// Prepares the subdivisions of `kernel` with `nodes` nodes in all.
    ///
    /// # Panics
    /// With more than [`MOST_NODES`] nodes.
    pub fn new(kernel: &Multigraph, nodes: usize, edges: Edges) -> Self {
        assert!(
            nodes <= MOST_NODES,
            "{nodes} nodes are more than {MOST_NODES}"
        );
        let pairs: Vec<_> = kernel
            .pairs()
            .map(|(u, v, multiplicity)| (u, v, usize::from(multiplicity)))
            .collect();
        let mut number = [[0u8; MAX_NODES]; MAX_NODES];
        for (k, &(u, v, _)) in (0..).zip(&pairs) {
            number[u][v] = k;
            number[v][u] = k;
        }
        let symmetries = group(&canonical(kernel).generators)[1..]
            .iter()
            .map(|g| {
                let image = |v: usize| usize::from(g[v]);
                pairs
                    .iter()
                    .map(|&(u, v, _)| number[image(u)][image(v)])
                    .collect()
            })
            .collect();
        Self {
            kernel: *kernel,
            pairs,
            symmetries,
            nodes,
            edges,
        }
    }

    /// Calls `each` for every subdivision, in a fixed order, until it returns false; returns
    /// whether it never did.
    pub fn for_each(&self, each: &mut impl FnMut(Subdivision) -> bool) -> bool {
        let Some(left) = self.nodes.checked_sub(self.kernel.nodes()) else {
            return true;
        };
        let least = |&(_, _, multiplicity): &(usize, usize, usize)| multiplicity - 1;
        let spare = left.checked_sub(self.pairs.iter().map(least).sum());
        let Some(spare) = spare else {
            return true;
        };
        let room = match self.edges {
            Edges::Any => usize::MAX,
            Edges::Once => self.pairs.len(),
        };
        spare > room || self.fill(&mut Vec::with_capacity(self.pairs.len()), spare, each)
    }

    /// Distributes `spare` nodes, beyond the least numbers, over the pairs from
    /// `codes.len()` on.
    fn fill(
        &self,
        codes: &mut Vec<Code>,
        spare: usize,
        each: &mut impl FnMut(Subdivision) -> bool,
    ) -> bool {
        let Some(&(_, _, multiplicity)) = self.pairs.get(codes.len()) else {
            return spare > 0 || self.finish(codes, each);
        };
        let later = self.pairs.len() - codes.len() - 1;
        match self.edges {
            Edges::Once => {
                let ones = (2..=multiplicity).fold(0, |code, _| code << 4 | 2);
                for extra in spare.saturating_sub(later)..=spare.min(1) {
                    codes.push(ones << 4 | (extra + 1) as Code);
                    let go_on = self.fill(codes, spare - extra, each);
                    codes.pop();
                    if !go_on {
                        return false;
                    }
                }
                true
            }
            Edges::Any => {
                let least = if later == 0 { spare } else { 0 };
                for extra in least..=spare {
                    let total = extra + multiplicity - 1;
                    let mut go_on = true;
                    falling(total, multiplicity, total, 0, &mut |code| {
                        codes.push(code);
                        go_on = go_on && self.fill(codes, spare - extra, each);
                        codes.pop();
                    });
                    if !go_on {
                        return false;
                    }
                }
                true
            }
        }
    }

    /// Calls `each` for every subdivision with adjacent nodes of degree 2 in one edge.
    pub(crate) fn for_each_other(&self, each: &mut impl FnMut()) {
        if self.edges == Edges::Any {
            self.for_each(&mut |subdivision| {
                if subdivision.subdivided().is_none() {
                    each();
                }
                true
            });
        }
    }

    /// Passes the subdivision on if it is the largest of its orbit.
    fn finish(&self, codes: &[Code], each: &mut impl FnMut(Subdivision) -> bool) -> bool {
        let mut stabiliser = 1;
        for symmetry in &self.symmetries {
            let image = symmetry.iter().map(|&k| &codes[usize::from(k)]);
            match image.cmp(codes) {
                std::cmp::Ordering::Greater => return true,
                std::cmp::Ordering::Equal => stabiliser += 1,
                std::cmp::Ordering::Less => (),
            }
        }
        each(Subdivision {
            of: self,
            codes,
            stabiliser,
        })
    }
}

/// The subdivisions in which every edge has one node at most, as sets of pairs: of the edges between two
/// nodes all but the last are subdivided anyway, and the last one is if its pair is chosen.
pub(crate) struct Once<'a> {
    of: &'a Subdivisions,
    /// The edges that are subdivided anyway, as bits in the order of [`Multigraph::edge_list`].
    pub(crate) forced: u32,
    /// The last edge of each pair, in the same order.
    pub(crate) last: Vec<usize>,
    /// How many pairs are chosen.
    pub(crate) chosen: usize,
    /// Each symmetry: where a pair goes.
    images: Vec<Vec<u8>>,
}

impl Subdivisions {
    /// Those in which every edge has one node at most; `None` if there are none.
    pub(crate) fn once(&self) -> Option<Once<'_>> {
        let (mut forced, mut edge, mut last) = (0u32, 0, Vec::new());
        for &(_, _, multiplicity) in &self.pairs {
            for _ in 1..multiplicity {
                forced |= 1 << edge;
                edge += 1;
            }
            last.push(edge);
            edge += 1;
        }
        let inner = self.nodes.checked_sub(self.kernel.nodes())?;
        let chosen = inner.checked_sub(forced.count_ones() as usize)?;
        let inverse = |symmetry: &Vec<u8>| {
            let mut image = vec![0; symmetry.len()];
            (0..)
                .zip(symmetry)
                .for_each(|(k, &at)| image[usize::from(at)] = k);
            image
        };
        (chosen <= last.len()).then(|| Once {
            of: self,
            forced,
            last,
            chosen,
            images: self.symmetries.iter().map(inverse).collect(),
        })
    }
}

impl Once<'_> {
    /// Whether all choices give different graphs.
    pub(crate) fn no_symmetry(&self) -> bool {
        self.images.is_empty()
    }

    /// Whether a choice of pairs, as bits, gives a subdivision that counts: the largest of its orbit.
    pub(crate) fn counts(&self, pairs: u32) -> bool {
        // The first pair decides, so it has the highest bit.
        let value = |pairs: u32, image: &dyn Fn(u32) -> u32| {
            let (mut left, mut value) = (pairs, 0u32);
            while left != 0 {
                value |= 1 << (31 - image(left.trailing_zeros()));
                left &= left - 1;
            }
            value
        };
        let own = value(pairs, &|pair| pair);
        let images = self.images.iter();
        let mut images = images.map(|image| value(pairs, &|pair| u32::from(image[pair as usize])));
        images.all(|image| image <= own)
    }

    /// Calls `each` with the subdivision of a choice of pairs, as bits.
    pub(crate) fn with<T>(&self, pairs: u32, each: impl FnOnce(Subdivision) -> T) -> T {
        let mut codes = [0; 3 * (MAX_CYCLES - 1)];
        for ((k, code), &(_, _, multiplicity)) in (0..).zip(&mut codes).zip(&self.of.pairs) {
            let anyway = (2..=multiplicity).fold(0, |code, _| code << 4 | 2);
            *code = anyway << 4 | Code::from(1 + (pairs >> k & 1));
        }
        let same = self.images.iter().filter(|image| {
            let moved = (0..).zip(*image).filter(|(k, _)| pairs >> k & 1 == 1);
            moved.fold(0, |set, (_, &at)| set | 1u32 << at) == pairs
        });
        each(Subdivision {
            of: self.of,
            codes: &codes[..self.of.pairs.len()],
            stabiliser: 1 + same.count() as u64,
        })
    }
}

/// Calls `each` with the codes of the falling lists of `length` numbers with the given sum,
/// none above `largest`, at most the last one zero, appended to `code`.
fn falling(sum: usize, length: usize, largest: usize, code: Code, each: &mut impl FnMut(Code)) {
    if length == 1 {
        if sum <= largest {
            each(code << 4 | (sum + 1) as Code);
        }
        return;
    }
    for first in (1..=largest.min(sum)).rev() {
        falling(
            sum - first,
            length - 1,
            first,
            code << 4 | (first + 1) as Code,
            each,
        );
    }
}

/// Length of the graph6 of a graph with [`MOST_NODES`] nodes.
const LINE: usize = 1 + (MOST_NODES * (MOST_NODES - 1) / 2).div_ceil(6);

/// A graph as graph6.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    bytes: [u8; LINE],
    length: usize,
}

impl std::ops::Deref for Line {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.bytes[..self.length]
    }
}

/// A subdivision of a kernel.
#[derive(Clone, Copy)]
pub struct Subdivision<'a> {
    of: &'a Subdivisions,
    codes: &'a [Code],
    stabiliser: u64,
}

impl Subdivision<'_> {
    /// How many automorphisms the graph has: those of the kernel's nodes that respect the
    /// numbers, times the exchanges of parallel edges with equal numbers. (Equal numbers
    /// are positive, so such an exchange moves nodes.)
    pub fn group_order(&self) -> u64 {
        let mut order = self.stabiliser;
        for &code in self.codes {
            let (mut code, mut run, mut last) = (code, 0, 0);
            while code > 0 {
                run = if code & 15 == last { run + 1 } else { 1 };
                order *= run;
                last = code & 15;
                code >>= 4;
            }
        }
        order
    }

    /// The edges of the kernel that are subdivided, as bits in the order of [`Multigraph::edge_list`];
    /// `None` if one has several nodes.
    pub fn subdivided(&self) -> Option<u32> {
        let (mut set, mut edge) = (0, 0);
        for (&(_, _, multiplicity), &code) in self.of.pairs.iter().zip(self.codes) {
            for k in (0..multiplicity).rev() {
                match code >> (4 * k) & 15 {
                    1 => (),
                    2 => set |= 1 << edge,
                    _ => return None,
                }
                edge += 1;
            }
        }
        Some(set)
    }

    /// The edges, and on which edge of the kernel each lies, in the order of [`Multigraph::edge_list`].
    pub(crate) fn lying(&self) -> Vec<((usize, usize), usize)> {
        let mut on = Vec::with_capacity(2 * self.of.nodes);
        let mut first = 0;
        for (&(_, _, multiplicity), &code) in self.of.pairs.iter().zip(self.codes) {
            // As they are passed: the lowest digit, which is that of the last edge, first.
            for k in 0..multiplicity {
                let halves = (code >> (4 * k) & 15) as usize;
                on.extend(std::iter::repeat_n(first + multiplicity - 1 - k, halves));
            }
            first += multiplicity;
        }
        let mut on = on.into_iter();
        let mut lying = Vec::with_capacity(on.len());
        self.for_each_edge(|i, j| lying.extend(on.next().map(|edge| ((i, j), edge))));
        lying
    }

    /// The graph: the kernel's nodes first.
    pub fn graph(&self) -> Graph {
        let mut pairs = Vec::with_capacity(2 * self.of.nodes);
        self.for_each_edge(|i, j| pairs.push((i as u32, j as u32)));
        match Graph::from_pairs(self.of.nodes as u32, pairs) {
            Ok((graph, _)) => graph,
            Err(error) => unreachable!("a subdivision is a graph: {error}"),
        }
    }

    /// The same graph as graph6, without a line end: what
    /// [`encode`](viewcert::graph::graph6::encode) makes of it, and no allocation.
    pub fn graph6(&self) -> Line {
        let nodes = self.of.nodes;
        let mut line = Line {
            bytes: [63; LINE],
            length: 1 + (nodes * (nodes - 1) / 2).div_ceil(6),
        };
        line.bytes[0] += nodes as u8;
        self.for_each_edge(|i, j| {
            let (i, j) = (i.min(j), i.max(j));
            // Bit j (j - 1) / 2 + i, six a byte from the left, is that of the pair i < j.
            let bit = j * (j - 1) / 2 + i;
            line.bytes[1 + bit / 6] += 32 >> (bit % 6);
        });
        line
    }

    fn for_each_edge(&self, mut each: impl FnMut(usize, usize)) {
        let mut next = self.of.kernel.nodes();
        for (&(u, v, _), &code) in self.of.pairs.iter().zip(self.codes) {
            let mut code = code;
            while code > 0 {
                let mut last = u;
                for _ in 1..code & 15 {
                    each(last, next);
                    last = next;
                    next += 1;
                }
                each(last, v);
                code >>= 4;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::kernels;
    use std::collections::BTreeSet;

    fn theta(parallel: u8) -> Multigraph {
        let mut theta = Multigraph::new(2);
        theta.add(0, 1, parallel);
        theta
    }

    fn graphs(kernel: &Multigraph, nodes: usize, edges: Edges) -> Vec<(Graph, u64)> {
        let mut all = Vec::new();
        Subdivisions::new(kernel, nodes, edges).for_each(&mut |subdivision| {
            all.push((subdivision.graph(), subdivision.group_order()));
            true
        });
        all
    }

    /// Theta graphs with 5 nodes: paths with 0, 1, 2 or 1, 1, 1 inner nodes (three numbers
    /// with sum 3, at most one zero).
    #[test]
    fn theta_graphs_with_five_nodes() {
        let all = graphs(&theta(3), 5, Edges::Any);
        let orders: Vec<u64> = all.iter().map(|(_, order)| *order).collect();
        // The house turns over; K_{2,3} has 2! 3! automorphisms.
        assert_eq!(orders, [2, 12]);
        assert_eq!(graphs(&theta(3), 5, Edges::Once).len(), 1);
        assert_eq!(graphs(&theta(3), 6, Edges::Once).len(), 0);
        assert_eq!(graphs(&theta(3), 3, Edges::Any).len(), 0);
    }

    /// K4 with two edges subdivided: adjacent or opposite ones.
    #[test]
    fn two_edges_of_k4() {
        let mut k4 = Multigraph::new(4);
        for (u, v) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
            k4.add(u, v, 1);
        }
        assert_eq!(graphs(&k4, 6, Edges::Once).len(), 2);
        assert_eq!(graphs(&k4, 6, Edges::Any).len(), 3);
    }

    /// All different, and the order of the group as the canonical form has it.
    #[test]
    fn no_graph_comes_twice_and_groups_are_counted() {
        for (cycles, nodes) in [(3, 7), (4, 8), (5, 8)] {
            let mut keys = BTreeSet::new();
            for kernel in kernels(cycles, nodes) {
                let kernel = kernel.multigraph();
                for (graph, order) in graphs(&kernel, nodes, Edges::Any) {
                    assert_eq!(graph.edges().len(), nodes + cycles - 1);
                    let found = canonical(&Multigraph::from_graph(&graph).unwrap());
                    assert_eq!(found.group_order, order);
                    assert!(keys.insert(found.key));
                }
            }
        }
    }

    /// graph6 by the library, and the subdivided edges from the graph.
    #[test]
    fn graph6_and_subdivided_edges() {
        for (cycles, nodes) in [(3, 7), (4, 8), (5, 8)] {
            for kernel in kernels(cycles, nodes) {
                let kernel = kernel.multigraph();
                for edges in [Edges::Once, Edges::Any] {
                    Subdivisions::new(&kernel, nodes, edges).for_each(&mut |subdivision| {
                        let graph = subdivision.graph();
                        let line = viewcert::graph::graph6::encode(&graph);
                        assert_eq!(*subdivision.graph6(), *line.as_bytes());
                        let single = |node: u32| {
                            let ends = graph.edges().iter();
                            let ends = ends.filter(|&&(i, j)| i == node || j == node);
                            let others = ends.map(|&(i, j)| i + j - node);
                            others.clone().count() == 2
                                && others.max() < Some(kernel.nodes() as u32)
                        };
                        let inner = kernel.nodes() as u32..nodes as u32;
                        assert_eq!(
                            subdivision.subdivided().is_some(),
                            inner.clone().all(single)
                        );
                        if let Some(set) = subdivision.subdivided() {
                            assert_eq!(set.count_ones() as usize, inner.len());
                            let ends: Vec<_> = (0..)
                                .zip(kernel.edge_list())
                                .filter(|(edge, _)| set >> edge & 1 == 1)
                                .map(|(_, ends)| ends)
                                .collect();
                            let mut expected = Vec::new();
                            for node in inner {
                                let ends = graph.edges().iter();
                                let ends = ends.filter(|&&(_, j)| j == node);
                                let ends: Vec<_> = ends.map(|&(i, _)| i as usize).collect();
                                expected.push((ends[0], ends[1]));
                            }
                            expected.sort_unstable();
                            assert_eq!(ends, expected);
                        }
                        true
                    });
                }
            }
        }
    }

    /// The longest paths that there are: 15 inner nodes on three paths, at most one of them without. That
    /// is 19 partitions of 15 into three parts, and 7 into two.
    #[test]
    fn theta_graphs_with_the_most_nodes() {
        let all = graphs(&theta(3), MOST_NODES, Edges::Any);
        assert_eq!(all.len(), 19 + 7);
        for (graph, _) in all {
            assert_eq!((graph.nodes(), graph.edges().len()), (17, 18));
        }
    }

    #[test]
    fn the_enumeration_can_be_stopped() {
        let mut count = 0;
        let all = Subdivisions::new(&theta(4), 12, Edges::Any).for_each(&mut |_| {
            count += 1;
            count < 3
        });
        assert!(!all);
        assert_eq!(count, 3);
    }
}
