//! Labels: names of small graphs that stay (docs/catalog.md, *Labels*).
//!
//! `vg.<nodes>.<pairs>.<k>` is said by the graph alone, without a list: of all relabellings the one whose
//! graph6 line is the greatest is taken, and k is its place among the lines of all graphs on these nodes with
//! so many pairs, the greatest first. So a label gives the graph back.
//!
//! A canonical form as that of nauty would do as well, but what it is depends on the constants of a program; the
//! greatest line is the greatest whoever looks for it.

use std::fmt;
use std::str::FromStr;
use viewcert::Graph;

/// The most nodes of a graph with a label.
pub const MAX_NODES: usize = 16;

/// The label of a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label {
    nodes: usize,
    pairs: usize,
    /// From 1 on. The numbers of graphs with 16 nodes, 2^120 in all, fit.
    k: u128,
}

/// Why a text is no label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LabelError {
    /// Not `vg.` and three numbers without leading zeros.
    Form,
    /// More than [`MAX_NODES`] nodes.
    Nodes {
        /// How many.
        nodes: usize,
    },
    /// Not so many graphs have these numbers of nodes and pairs, or k is 0.
    Range {
        /// How many there are, labelled.
        graphs: u128,
    },
    /// The line is not the greatest of its graph, which has another label.
    NotGreatest {
        /// The label of the graph.
        label: Label,
    },
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "vg.{}.{}.{}", self.nodes, self.pairs, self.k)
    }
}

impl fmt::Display for LabelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form => write!(
                f,
                "a label is vg., the number of nodes, of pairs, and k, as in vg.5.6.55"
            ),
            Self::Nodes { nodes } => write!(
                f,
                "{nodes} nodes, and graphs with up to {MAX_NODES} have labels"
            ),
            Self::Range { graphs } => {
                write!(
                    f,
                    "k is from 1 to {graphs} with these numbers of nodes and pairs"
                )
            }
            Self::NotGreatest { label } => {
                write!(
                    f,
                    "no graph has this label: k is the place of a line that is not the greatest of its graph, {label}"
                )
            }
        }
    }
}

impl std::error::Error for LabelError {}

impl Label {
    /// The label of a graph, the same for all its relabellings; `None` if it has more than [`MAX_NODES`]
    /// nodes. Microseconds for sparse graphs; exponential at worst ([`greatest`]).
    ///
    /// ```
    /// use viewcert_catalog::label::Label;
    /// let graph = viewcert::Graph::new(4, [(0, 1), (1, 2), (2, 3), (3, 0)])?;
    /// assert_eq!(Label::of(&graph).unwrap().to_string(), "vg.4.4.6");
    /// # Ok::<(), viewcert::GraphError>(())
    /// ```
    pub fn of(graph: &Graph) -> Option<Self> {
        let greatest = greatest(graph)?;
        let mut left = greatest.edges().len();
        let mut k = 1;
        for (free, is_pair) in places(&greatest) {
            if is_pair {
                left -= 1;
            } else if left > 0 {
                // Lines that agree so far and have a pair here are greater.
                k += binomial(free, left - 1);
            }
        }
        Some(Self {
            nodes: greatest.nodes(),
            pairs: greatest.edges().len(),
            k,
        })
    }

    /// The graph, with the greatest line of its relabellings. O(n^4).
    pub fn graph(&self) -> Graph {
        let (mut left, mut k) = (self.pairs, self.k - 1);
        let mut pairs = Vec::with_capacity(self.pairs);
        let mut free = self.nodes * self.nodes.saturating_sub(1) / 2;
        for (i, j) in columns(self.nodes) {
            free -= 1;
            let greater = if left > 0 {
                binomial(free, left - 1)
            } else {
                0
            };
            if k < greater {
                pairs.push((i as u32, j as u32));
                left -= 1;
            } else {
                k -= greater;
            }
        }
        let graph = Graph::new(self.nodes as u32, pairs);
        graph.expect("pairs of different nodes below their number")
    }
}

impl FromStr for Label {
    type Err = LabelError;

    fn from_str(text: &str) -> Result<Self, LabelError> {
        let (nodes, pairs, k) = parts(text).ok_or(LabelError::Form)?;
        if nodes > MAX_NODES {
            return Err(LabelError::Nodes { nodes });
        }
        let graphs = binomial(nodes * nodes.saturating_sub(1) / 2, pairs);
        if !(1..=graphs).contains(&k) {
            return Err(LabelError::Range { graphs });
        }
        let read = Self { nodes, pairs, k };
        match Self::of(&read.graph()) {
            Some(label) if label != read => Err(LabelError::NotGreatest { label }),
            _ => Ok(read),
        }
    }
}

/// The three numbers of a label.
fn parts(text: &str) -> Option<(usize, usize, u128)> {
    let mut numbers = text.strip_prefix("vg.")?.split('.');
    let mut next = || {
        let word = numbers.next()?;
        let plain = word.bytes().all(|byte| byte.is_ascii_digit());
        (plain && (word == "0" || !word.starts_with('0'))).then_some(word)
    };
    let found = (
        next()?.parse().ok()?,
        next()?.parse().ok()?,
        next()?.parse().ok()?,
    );
    numbers.next().is_none().then_some(found)
}

/// The pairs in the order of graph6: (0,1), (0,2), (1,2), (0,3), ...
fn columns(nodes: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..nodes).flat_map(|j| (0..j).map(move |i| (i, j)))
}

/// The places of the graph's line: how many come after, and whether a pair is there.
fn places(graph: &Graph) -> impl Iterator<Item = (usize, bool)> {
    let neighbours = neighbours(graph);
    let nodes = graph.nodes();
    let all = nodes * nodes.saturating_sub(1) / 2;
    let at = columns(nodes).map(move |(i, j)| neighbours[j] >> i & 1 == 1);
    (0..all).rev().zip(at)
}

/// The number of subsets of `size` of `all` elements; `all` is at most 120.
fn binomial(all: usize, size: usize) -> u128 {
    if size > all {
        return 0;
    }
    // Each product is a binomial coefficient times k, below 2^120 * 2^6.
    (1..=size.min(all - size) as u128).fold(1, |found, k| found * (all as u128 + 1 - k) / k)
}

/// The neighbours of each node, as bits.
pub(crate) fn neighbours(graph: &Graph) -> [u16; MAX_NODES] {
    let mut neighbours = [0u16; MAX_NODES];
    for &(i, j) in graph.edges() {
        neighbours[i as usize] |= 1 << j;
        neighbours[j as usize] |= 1 << i;
    }
    neighbours
}

/// The relabelling whose graph6 line is the greatest in the order of its characters; `None` with more than
/// [`MAX_NODES`] nodes.
///
/// Breadth first: all orders of k nodes whose line is the greatest go on to k + 1. Of nodes that have the same
/// neighbours besides each other, and can thus be exchanged, only the first is tried. Memory is that of the
/// orders that agree, exponential at worst: 180 at most for the graphs of the catalog with 10 nodes.
pub fn greatest(graph: &Graph) -> Option<Graph> {
    let (pairs, _) = search(graph)?;
    let greatest = Graph::new(graph.nodes() as u32, pairs);
    Some(greatest.expect("pairs of different nodes below their number"))
}

/// The number of automorphisms of a graph: two orders that give the same line differ by one. `None` with more than
/// [`MAX_NODES`] nodes.
pub fn automorphisms(graph: &Graph) -> Option<u64> {
    let (_, orders) = search(graph)?;
    // In all orders of nodes that can be exchanged with each other.
    let exchanged = twins(&neighbours(graph), graph.nodes()).into_iter();
    Some(exchanged.fold(orders as u64, |all, twins| {
        all * u64::from(twins.count_ones() + 1)
    }))
}

/// For each node the smaller ones that can be exchanged with it.
fn twins(neighbours: &[u16], nodes: usize) -> Vec<u16> {
    let of = |v: usize| {
        let same = |u: &usize| neighbours[v] & !(1 << u) == neighbours[*u] & !(1 << v);
        (0..v).filter(same).fold(0, |all, u| all | 1 << u)
    };
    (0..nodes).map(of).collect()
}

/// The pairs of the greatest relabelling, and how many orders give it that keep nodes that can be exchanged in order.
fn search(graph: &Graph) -> Option<(Vec<(u32, u32)>, usize)> {
    let nodes = graph.nodes();
    if nodes > MAX_NODES {
        return None;
    }
    let neighbours = neighbours(graph);
    let twins = twins(&neighbours, nodes);
    let mut orders = vec![(0u16, [0u8; MAX_NODES])];
    let mut pairs = Vec::with_capacity(graph.edges().len());
    for column in 0..nodes {
        let (mut best, mut next) = (0u16, Vec::new());
        for (placed, order) in &orders {
            for v in 0..nodes {
                if placed >> v & 1 == 1 || twins[v] & !placed != 0 {
                    continue;
                }
                let seen = order[..column]
                    .iter()
                    .fold(0, |seen, u| seen << 1 | (neighbours[v] >> u & 1));
                if seen > best {
                    best = seen;
                    next.clear();
                }
                if seen == best {
                    let mut order = *order;
                    order[column] = v as u8;
                    next.push((placed | 1 << v, order));
                }
            }
        }
        let ends = (0..column).filter(|i| best >> (column - 1 - i) & 1 == 1);
        pairs.extend(ends.map(|i| (i as u32, column as u32)));
        orders = next;
    }
    Some((pairs, orders.len()))
}

#[cfg(test)]
mod tests;
