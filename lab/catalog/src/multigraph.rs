//! Multigraphs on at most 16 nodes: adjacency as multiplicities, node sets as bits.

use viewcert::graph::Graph;

/// The largest number of nodes.
pub const MAX_NODES: usize = 16;

/// Bits of a multiplicity in a [`Key`]; multiplicities are at most 15.
const BITS: usize = 4;
const PER_WORD: usize = 64 / BITS;

/// Number of nodes and multiplicities of all pairs, packed: equal keys mean equal
/// labelled multigraphs.
pub type Key = [u64; 9];

/// The most edges of a multigraph that is [`Packed`].
pub const MOST_PACKED: usize = 24;

/// Bytes of a [`Packed`] multigraph.
pub const PACKED_BYTES: usize = 1 + MOST_PACKED;

/// A labelled multigraph with at most [`MOST_PACKED`] edges in 25 bytes, where a [`Multigraph`] has 296.
/// Of multigraphs with equally many nodes the order is that of their keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Packed {
    nodes: u8,
    /// For every edge, in the order of the key, 255 less the place of its pair; then zeros. So where two
    /// keys differ first, the larger one has the larger byte.
    edges: [u8; MOST_PACKED],
}

impl Packed {
    /// Packs the multigraph of a key; `None` if it has more than [`MOST_PACKED`] edges.
    pub fn of(key: &Key) -> Option<Self> {
        let nodes = key[0] as u8;
        let mut edges = [0; MOST_PACKED];
        let mut free = edges.iter_mut();
        for (word, packed) in key[1..].iter().enumerate() {
            let mut packed = *packed;
            while packed != 0 {
                let place = packed.leading_zeros() as usize / BITS;
                let shift = BITS * (PER_WORD - 1 - place);
                for _ in 0..packed >> shift & 15 {
                    *free.next()? = 255 - (word * PER_WORD + place) as u8;
                }
                packed &= !(15 << shift);
            }
        }
        Some(Self { nodes, edges })
    }

    /// The multigraph.
    pub fn multigraph(&self) -> Multigraph {
        let mut result = Multigraph::new(self.nodes.into());
        for &edge in self.edges.iter().take_while(|&&edge| edge != 0) {
            let mut place = usize::from(255 - edge);
            let mut v = 1;
            while place >= v {
                place -= v;
                v += 1;
            }
            result.add(place, v, 1);
        }
        result
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes.into()
    }

    /// As bytes, for files and digests.
    pub fn bytes(&self) -> [u8; PACKED_BYTES] {
        let mut bytes = [0; PACKED_BYTES];
        bytes[0] = self.nodes;
        bytes[1..].copy_from_slice(&self.edges);
        bytes
    }

    /// What has these bytes; `None` if nothing has them.
    pub fn from_bytes(&[nodes, ref edges @ ..]: &[u8; PACKED_BYTES]) -> Option<Self> {
        let count = edges.iter().take_while(|&&edge| edge != 0).count();
        let pairs = usize::from(nodes) * usize::from(nodes).saturating_sub(1) / 2;
        let there = |&edge: &u8| usize::from(255 - edge) < pairs;
        let parallel = edges[..count].chunk_by(|one, two| one == two);
        let good = usize::from(nodes) <= MAX_NODES
            && edges[count..].iter().all(|&edge| edge == 0)
            && edges[..count].iter().all(there)
            && edges[..count].is_sorted_by(|one, two| one >= two)
            && parallel
                .map(<[u8]>::len)
                .all(|multiplicity| multiplicity < 16);
        good.then_some(Self {
            nodes,
            edges: *edges,
        })
    }
}

/// A multigraph without loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Multigraph {
    nodes: usize,
    multiplicity: [[u8; MAX_NODES]; MAX_NODES],
    neighbours: [u16; MAX_NODES],
}

#[cfg(test)]
impl Multigraph {
    /// A graph with the given edges, for tests.
    pub fn with_pairs(nodes: usize, pairs: &[(usize, usize)]) -> Self {
        let mut graph = Self::new(nodes);
        for &(u, v) in pairs {
            graph.add(u, v, 1);
        }
        graph
    }
}

impl Multigraph {
    /// `nodes` nodes, no edges.
    ///
    /// # Panics
    /// With more than [`MAX_NODES`] nodes.
    pub fn new(nodes: usize) -> Self {
        assert!(
            nodes <= MAX_NODES,
            "{nodes} nodes are more than {MAX_NODES}"
        );
        Self {
            nodes,
            multiplicity: [[0; MAX_NODES]; MAX_NODES],
            neighbours: [0; MAX_NODES],
        }
    }

    /// The same graph as a multigraph; `None` if it has more than [`MAX_NODES`] nodes.
    pub fn from_graph(graph: &Graph) -> Option<Self> {
        (graph.nodes() <= MAX_NODES).then(|| {
            let mut result = Self::new(graph.nodes());
            for &(i, j) in graph.edges() {
                result.add(i as usize, j as usize, 1);
            }
            result
        })
    }

    /// The multigraph of a key.
    pub fn from_key(key: &Key) -> Self {
        let mut result = Self::new(key[0] as usize);
        let mut at = 0;
        for v in 1..result.nodes {
            for u in 0..v {
                let packed = key[1 + at / PER_WORD] >> (BITS * (PER_WORD - 1 - at % PER_WORD));
                let multiplicity = (packed & 15) as u8;
                if multiplicity > 0 {
                    result.add(u, v, multiplicity);
                }
                at += 1;
            }
        }
        result
    }

    /// The key of the multigraph relabelled so that position k holds node `order[k]`.
    pub fn key(&self, order: &[u8]) -> Key {
        let mut key = [0; 9];
        key[0] = self.nodes as u64;
        let mut at = 0;
        for v in 1..self.nodes {
            let row = &self.multiplicity[order[v] as usize];
            for &u in &order[..v] {
                key[1 + at / PER_WORD] |=
                    u64::from(row[u as usize]) << (BITS * (PER_WORD - 1 - at % PER_WORD));
                at += 1;
            }
        }
        key
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// How many edges join two nodes.
    pub fn multiplicity(&self, u: usize, v: usize) -> u8 {
        self.multiplicity[u][v]
    }

    /// The neighbours of a node, as bits.
    pub fn neighbours(&self, v: usize) -> u16 {
        self.neighbours[v]
    }

    /// Number of edges at a node.
    pub fn degree(&self, v: usize) -> usize {
        bits(self.neighbours[v])
            .map(|u| usize::from(self.multiplicity[v][u]))
            .sum()
    }

    /// Number of edges.
    pub fn edges(&self) -> usize {
        (0..self.nodes).map(|v| self.degree(v)).sum::<usize>() / 2
    }

    /// Pairs of adjacent nodes `(u, v)`, `u < v`, and their multiplicities.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize, u8)> + '_ {
        (0..self.nodes).flat_map(move |u| {
            bits(self.neighbours[u] & (!1 << u)).map(move |v| (u, v, self.multiplicity[u][v]))
        })
    }

    /// The edges in the order of [`pairs`](Self::pairs), parallel ones one after the other.
    pub fn edge_list(&self) -> Vec<(usize, usize)> {
        self.pairs()
            .flat_map(|(u, v, multiplicity)| (0..multiplicity).map(move |_| (u, v)))
            .collect()
    }

    /// Adds `count` edges between two different nodes.
    ///
    /// # Panics
    /// If `u == v`, or more than 15 edges would join them.
    pub fn add(&mut self, u: usize, v: usize, count: u8) {
        assert!(u != v, "a loop at node {u}");
        let sum = self.multiplicity[u][v] + count;
        assert!(sum < 16, "{sum} parallel edges");
        self.multiplicity[u][v] = sum;
        self.multiplicity[v][u] = sum;
        self.neighbours[u] |= 1 << v;
        self.neighbours[v] |= 1 << u;
    }

    /// Removes one edge between two adjacent nodes.
    pub fn remove(&mut self, u: usize, v: usize) {
        self.multiplicity[u][v] -= 1;
        self.multiplicity[v][u] -= 1;
        if self.multiplicity[u][v] == 0 {
            self.neighbours[u] &= !(1 << v);
            self.neighbours[v] &= !(1 << u);
        }
    }

    /// Adds a node with the given neighbours (as bits), and returns it.
    ///
    /// # Panics
    /// If there are [`MAX_NODES`] nodes already.
    pub fn add_node(&mut self, neighbours: u16) -> usize {
        assert!(self.nodes < MAX_NODES, "no room for a node");
        let v = self.nodes;
        self.nodes += 1;
        for u in bits(neighbours) {
            self.add(u, v, 1);
        }
        v
    }

    /// The multigraph in which `v` has become `u` and one edge between them is gone;
    /// `None` if there are several, which would leave a loop.
    pub fn contract(&self, u: usize, v: usize) -> Option<Self> {
        if self.multiplicity[u][v] != 1 {
            return None;
        }
        let mut result = Self::new(self.nodes - 1);
        let renamed = |w: usize| match w {
            _ if w == v => u - usize::from(u > v),
            _ => w - usize::from(w > v),
        };
        for (a, b, multiplicity) in self.pairs() {
            let (a, b) = (renamed(a), renamed(b));
            if a != b {
                result.add(a, b, multiplicity);
            }
        }
        Some(result)
    }

    /// Whether the nodes in `among` are connected by edges among themselves; an empty
    /// set is.
    pub fn is_connected(&self, among: u16) -> bool {
        let mut reached = among & among.wrapping_neg();
        let mut new = reached;
        while new != 0 {
            let next = bits(new).fold(0, |all, v| all | self.neighbours[v]);
            new = next & among & !reached;
            reached |= new;
        }
        reached == among
    }

    /// All nodes, as bits.
    pub fn all(&self) -> u16 {
        ((1u32 << self.nodes) - 1) as u16
    }

    /// Whether the multigraph is connected and stays so without any one node.
    /// O(n^2 + n m / w).
    pub fn is_biconnected(&self) -> bool {
        let all = self.all();
        self.is_connected(all) && (0..self.nodes).all(|v| self.is_connected(all & !(1 << v)))
    }
}

/// The elements of a set of bits, increasing.
pub fn bits(mut set: u16) -> impl Iterator<Item = usize> + Clone {
    std::iter::from_fn(move || {
        let lowest = set.trailing_zeros() as usize;
        set &= set.wrapping_sub(1);
        (lowest < 16).then_some(lowest)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle with one side doubled.
    fn triangle() -> Multigraph {
        let mut graph = Multigraph::new(3);
        graph.add(0, 1, 2);
        graph.add(1, 2, 1);
        graph.add(0, 2, 1);
        graph
    }

    #[test]
    fn degrees_and_pairs() {
        let graph = triangle();
        assert_eq!(graph.edges(), 4);
        assert_eq!([0, 1, 2].map(|v| graph.degree(v)), [3, 3, 2]);
        assert_eq!(
            graph.pairs().collect::<Vec<_>>(),
            [(0, 1, 2), (0, 2, 1), (1, 2, 1)]
        );
    }

    #[test]
    fn contraction_adds_multiplicities() {
        let contracted = triangle().contract(1, 2).unwrap();
        assert_eq!(contracted.pairs().collect::<Vec<_>>(), [(0, 1, 3)]);
        assert_eq!(triangle().contract(0, 1), None);
    }

    #[test]
    fn a_path_is_not_biconnected() {
        let mut path = Multigraph::new(3);
        path.add(0, 1, 2);
        path.add(1, 2, 2);
        assert!(path.is_connected(path.all()) && !path.is_biconnected());
        assert!(triangle().is_biconnected());
        assert!(!Multigraph::new(2).is_biconnected());
    }

    /// Packed multigraphs are what they were, in the order of their keys.
    #[test]
    fn packed() {
        let graphs: Vec<Multigraph> = (0..81)
            .map(|code: usize| {
                let mut graph = Multigraph::new(4);
                let pairs = [(0, 1), (0, 2), (1, 3), (2, 3)];
                for (k, (u, v)) in (0..).zip(pairs) {
                    graph.add(u, v, (code / 3usize.pow(k) % 3) as u8);
                }
                graph
            })
            .collect();
        let key = |graph: &Multigraph| graph.key(&[0, 1, 2, 3]);
        let packed = |graph: &Multigraph| Packed::of(&key(graph)).unwrap();
        for one in &graphs {
            let back = packed(one).multigraph();
            assert_eq!(key(&back), key(one));
            let bytes = packed(one).bytes();
            assert_eq!(Packed::from_bytes(&bytes), Some(packed(one)));
            assert_eq!((packed(one).nodes(), back.edges()), (4, one.edges()));
            for two in &graphs {
                assert_eq!(packed(one).cmp(&packed(two)), key(one).cmp(&key(two)));
            }
        }
        // Too many nodes, a pair that is not there, a gap, a wrong order, and 16 parallel edges.
        let bytes = |nodes: u8, edges: &[u8]| {
            let mut bytes = [0; PACKED_BYTES];
            bytes[0] = nodes;
            bytes[1..=edges.len()].copy_from_slice(edges);
            bytes
        };
        assert!(Packed::from_bytes(&bytes(3, &[255, 254, 253])).is_some());
        for (nodes, edges) in [
            (17, &[255][..]),
            (3, &[255, 252]),
            (1, &[255]),
            (3, &[255, 0, 254]),
            (3, &[254, 255]),
            (3, &[255; 16]),
        ] {
            assert_eq!(Packed::from_bytes(&bytes(nodes, edges)), None, "{edges:?}");
        }
        let mut many = Multigraph::new(3);
        many.add(0, 1, 15);
        many.add(0, 2, 9);
        assert!(Packed::of(&many.key(&[0, 1, 2])).is_some());
        many.add(1, 2, 1);
        assert_eq!(Packed::of(&many.key(&[0, 1, 2])), None);
    }

    #[test]
    fn a_key_is_the_labelled_multigraph() {
        let graph = triangle();
        assert_eq!(Multigraph::from_key(&graph.key(&[0, 1, 2])), graph);
        assert_eq!(graph.key(&[0, 1, 2]), graph.key(&[1, 0, 2]));
        assert_ne!(graph.key(&[0, 1, 2]), graph.key(&[2, 1, 0]));
    }
}
