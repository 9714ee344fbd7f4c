//! Canonical forms and automorphisms of small multigraphs.
//!
//! The method is that of B. D. McKay, *Practical graph isomorphism* (1981): the nodes
//! are partitioned by degrees and adjacency until nothing changes; where cells of several
//! nodes remain, one node after the other is given a cell of its own. The canonical form
//! is the largest key among the leaves of this search. Leaves with equal keys differ by an
//! automorphism, and of nodes that known automorphisms (fixing what was chosen above)
//! carry into each other only one is tried.

use super::multigraph::{Key, MAX_NODES, Multigraph, bits};

/// Node `v` goes to `[v]`.
pub type Permutation = [u8; MAX_NODES];

const IDENTITY: Permutation = {
    let mut identity = [0; MAX_NODES];
    let mut k = 0;
    while k < MAX_NODES {
        identity[k] = k as u8;
        k += 1;
    }
    identity
};

/// What the search finds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canonical {
    /// Equal for two multigraphs iff they are isomorphic.
    pub key: Key,
    /// Position k of the canonical form is node `order[k]`.
    pub order: Permutation,
    /// Automorphisms that generate all.
    pub generators: Vec<Permutation>,
    /// How many automorphisms there are.
    pub group_order: u64,
}

/// Ordered cells of nodes: `order` lists the nodes, a bit of `starts` is set where a
/// cell begins.
#[derive(Clone, Copy)]
struct Partition {
    order: Permutation,
    starts: u32,
}

impl Partition {
    /// The end of the cell that starts at `start`.
    fn end(&self, start: usize, nodes: usize) -> usize {
        let later = self.starts >> (start + 1);
        match later {
            0 => nodes,
            _ => (start + 1 + later.trailing_zeros() as usize).min(nodes),
        }
    }

    /// The first cell with several nodes.
    fn first_open(&self, nodes: usize) -> Option<(usize, usize)> {
        let mut start = 0;
        while start < nodes {
            let end = self.end(start, nodes);
            if end > start + 1 {
                return Some((start, end));
            }
            start = end;
        }
        None
    }
}

struct Search<'a> {
    graph: &'a Multigraph,
    best: Option<(Key, Permutation)>,
    /// The leaf found first: most automorphisms show up against it.
    first: Option<(Key, Permutation)>,
    generators: Vec<Permutation>,
    group_order: u64,
}

/// The canonical form of a multigraph. Exponential at worst, which takes far more regular
/// multigraphs than those with 16 nodes.
pub fn canonical(graph: &Multigraph) -> Canonical {
    let mut search = Search {
        graph,
        best: None,
        first: None,
        generators: Vec::new(),
        group_order: 1,
    };
    let mut root = Partition {
        order: IDENTITY,
        starts: 1,
    };
    refine(graph, &mut root);
    search.descend(&root, &mut Vec::new(), true);
    let (key, order) = search.best.expect("a search has leaves");
    Canonical {
        key,
        order,
        generators: search.generators,
        group_order: search.group_order,
    }
}

/// Splits cells by what their nodes see until no node tells two of a cell apart.
fn refine(graph: &Multigraph, partition: &mut Partition) {
    let nodes = graph.nodes();
    loop {
        let mut colour = [0u64; MAX_NODES];
        let mut current = 0;
        for (k, &v) in partition.order[..nodes].iter().enumerate() {
            if partition.starts >> k & 1 == 1 {
                current = k as u64;
            }
            colour[usize::from(v)] = current;
        }
        // A sum over the neighbours: which order they come in must not matter. Nodes that
        // differ may agree in it by chance; that costs time, not correctness, since it
        // depends on nothing but the isomorphism class.
        let mut seen = [0u64; MAX_NODES];
        let before = partition.starts;
        let mut start = 0;
        while start < nodes {
            let end = partition.end(start, nodes);
            if end > start + 1 {
                let cell = &mut partition.order[start..end];
                for &v in &*cell {
                    let v = usize::from(v);
                    seen[v] = bits(graph.neighbours(v))
                        .map(|u| mix(colour[u] << 8 | u64::from(graph.multiplicity(u, v))))
                        .fold(0, u64::wrapping_add);
                }
                cell.sort_unstable_by_key(|&v| seen[usize::from(v)]);
                for k in 1..cell.len() {
                    if seen[usize::from(cell[k])] != seen[usize::from(cell[k - 1])] {
                        partition.starts |= 1 << (start + k);
                    }
                }
            }
            start = end;
        }
        if partition.starts == before {
            return;
        }
    }
}

/// The finaliser of SplitMix64.
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

impl Search<'_> {
    /// Searches below a partition reached by giving `chosen` cells of their own.
    /// `first_path`: whether the first leaf lies below.
    fn descend(&mut self, partition: &Partition, chosen: &mut Vec<u8>, first_path: bool) {
        let nodes = self.graph.nodes();
        let Some((start, end)) = partition.first_open(nodes) else {
            self.leaf(&partition.order);
            return;
        };
        let mut cell = partition.order;
        let cell = &mut cell[start..end];
        cell.sort_unstable();
        let mut tried = 0u16;
        for (k, &v) in cell.iter().enumerate() {
            if tried & self.orbit(v, chosen) != 0 {
                continue;
            }
            tried |= 1 << v;
            let mut below = *partition;
            let at = start
                + below.order[start..end]
                    .iter()
                    .position(|&u| u == v)
                    .unwrap_or(0);
            below.order[start..=at].rotate_right(1);
            below.starts |= 1 << (start + 1);
            refine(self.graph, &mut below);
            chosen.push(v);
            self.descend(&below, chosen, first_path && k == 0);
            chosen.pop();
        }
        if first_path {
            // All automorphisms that fix `chosen` are generated by now, so the orbit of
            // the first choice is complete.
            self.group_order *= u64::from(self.orbit(cell[0], chosen).count_ones());
        }
    }

    /// The orbit of `v` under the known automorphisms that fix `fixed`.
    fn orbit(&self, v: u8, fixed: &[u8]) -> u16 {
        let mut orbit = 1u16 << v;
        let usable = |g: &&Permutation| fixed.iter().all(|&u| g[usize::from(u)] == u);
        let mut new = orbit;
        while new != 0 {
            let mut next = 0;
            for g in self.generators.iter().filter(usable) {
                next |= bits(new).fold(0, |image, u| image | 1 << g[u]);
            }
            new = next & !orbit;
            orbit |= new;
        }
        orbit
    }

    fn leaf(&mut self, order: &Permutation) {
        let key = self.graph.key(&order[..self.graph.nodes()]);
        let known = [&self.first, &self.best];
        let same = known.into_iter().flatten().find(|(other, _)| *other == key);
        if let Some((_, other)) = same {
            let mut automorphism = IDENTITY;
            for (&from, &to) in other.iter().zip(order) {
                automorphism[usize::from(from)] = to;
            }
            self.generators.push(automorphism);
        } else if self.best.as_ref().is_none_or(|(best, _)| key > *best) {
            self.best = Some((key, *order));
        }
        self.first.get_or_insert((key, *order));
    }
}

/// All products of the generators, the identity first, in an order that depends on the
/// generators only. O(order of the group times number of generators).
pub fn group(generators: &[Permutation]) -> Vec<Permutation> {
    let mut elements = vec![IDENTITY];
    let mut known = std::collections::HashSet::from([IDENTITY]);
    let mut at = 0;
    while at < elements.len() {
        let element = elements[at];
        for g in generators {
            let product: Permutation = std::array::from_fn(|v| g[usize::from(element[v])]);
            if known.insert(product) {
                elements.push(product);
            }
        }
        at += 1;
    }
    elements
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn cycle(nodes: usize) -> Vec<(usize, usize)> {
        (0..nodes).map(|v| (v, (v + 1) % nodes)).collect()
    }

    /// Orders of well-known groups.
    #[test]
    fn group_orders() {
        let star: Vec<_> = (1..16).map(|v| (0, v)).collect();
        let bipartite: Vec<_> = (0..3).flat_map(|u| (3..8).map(move |v| (u, v))).collect();
        let cube: Vec<_> = (0..8)
            .flat_map(|u| [1, 2, 4].map(|bit| (u, u ^ bit)))
            .filter(|(u, v)| u < v)
            .collect();
        let mut petersen: Vec<_> = (0..5)
            .flat_map(|v| [(v, v + 5), (v, (v + 1) % 5)])
            .collect();
        petersen.extend((0..5).map(|v| (v + 5, (v + 2) % 5 + 5)));
        let known = [
            (16, star, 1_307_674_368_000),
            (8, bipartite, 6 * 120),
            (8, cube, 48),
            (10, petersen, 120),
            (13, cycle(13), 26),
            (4, vec![(0, 1), (1, 2), (2, 3)], 2),
            (6, vec![(0, 1), (1, 2), (2, 3), (3, 4), (2, 5)], 2),
            (
                7,
                vec![(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (1, 6), (6, 2)],
                1,
            ),
        ];
        for (nodes, pairs, order) in known {
            let found = canonical(&Multigraph::with_pairs(nodes, &pairs));
            assert_eq!(found.group_order, order, "{pairs:?}");
            if order < 1000 {
                assert_eq!(group(&found.generators).len() as u64, order);
            }
        }
    }

    #[test]
    fn multiplicities_count() {
        let mut one = Multigraph::with_pairs(4, &cycle(4));
        let mut two = one;
        one.add(0, 1, 1);
        one.add(2, 3, 1);
        two.add(0, 1, 1);
        two.add(1, 2, 1);
        assert_ne!(canonical(&one).key, canonical(&two).key);
        assert_eq!(canonical(&one).group_order, 4);
        assert_eq!(canonical(&two).group_order, 2);
    }

    proptest! {
        /// The key forgets the labels and nothing else, and every generator is an
        /// automorphism.
        #[test]
        fn relabelled_graphs_have_one_key(
            nodes in 2usize..=12,
            ends in prop::collection::vec((0usize..12, 0usize..12), 0..30),
            keys in prop::collection::vec(any::<u32>(), 12),
        ) {
            let mut order: Vec<u8> = (0..nodes as u8).collect();
            order.sort_by_key(|&v| keys[usize::from(v)]);
            let mut graph = Multigraph::new(nodes);
            for (u, v) in ends {
                let (u, v) = (u % nodes, v % nodes);
                if u != v && graph.multiplicity(u, v) < 3 {
                    graph.add(u, v, 1);
                }
            }
            let other = Multigraph::from_key(&graph.key(&order));
            let (one, two) = (canonical(&graph), canonical(&other));
            prop_assert_eq!(one.key, two.key);
            prop_assert_eq!(one.group_order, two.group_order);
            prop_assert_eq!(one.key, graph.key(&one.order[..nodes]));
            for g in &one.generators {
                prop_assert_eq!(graph.key(&g[..nodes]), graph.key(&IDENTITY[..nodes]));
            }
        }
    }
}
