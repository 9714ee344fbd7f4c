//! Graphs: their canonical form and hash, and the graph6 format (section 2 of the specification).
//! `file` reads the files that hold one, `parts` those of known parts.

mod file;
mod given;

use crate::document::{GraphName, Pair};
use crate::rejection::{Checked, Failure, Unreadable, ensure};
use sha2::{Digest, Sha256};
use std::borrow::Cow;

/// A simple graph, with what is known besides its edges.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    /// [i, j], i < j, in lexicographic order.
    pub(crate) pairs: Vec<Pair>,
    /// Where the edges of node i begin, and in the end where those of the last node end.
    start: Vec<usize>,
    /// Sets of nodes whose cameras are known relative to each other, in canonical form.
    pub(crate) parts: Vec<Vec<u32>>,
    /// The hash of the displacements that are known, if there are any.
    pub(crate) displacements: Option<String>,
    /// The hash of those in a frame of their own.
    pub(crate) own_frame: Option<String>,
    /// The hash of the frames of unknown base lines, if there are any.
    pub(crate) frames: Option<String>,
    /// Whether a certificate may suppose besides what it states.
    pub(crate) as_stated: bool,
}

impl Graph {
    /// A graph from its edges, in any order; pairs that occur again, also reversed, are merged.
    ///
    /// # Errors
    /// A self-loop, an end point that is not a node, or 2^32 or more nodes.
    pub fn new(
        nodes: usize,
        edges: impl IntoIterator<Item = (u32, u32)>,
    ) -> Result<Graph, Unreadable> {
        ensure!(
            u32::try_from(nodes).is_ok(),
            "{nodes} nodes are too many: at most 2^32 - 1"
        );
        let edges = edges.into_iter().map(|(i, j)| [i.min(j), i.max(j)]);
        let mut edges: Vec<Pair> = edges.collect();
        let wrong = edges.iter().find(|[i, j]| i == j || *j as usize >= nodes);
        ensure!(
            wrong.is_none(),
            "{wrong:?} is not a pair of different nodes below {nodes}"
        );
        let starts = |edges: &[Pair]| {
            let mut start = vec![0; nodes + 1];
            edges.iter().for_each(|[i, _]| start[*i as usize + 1] += 1);
            (0..nodes).for_each(|i| start[i + 1] += start[i]);
            start
        };
        let falls = edges.windows(2).filter(|two| two[0] > two[1]).count();
        if falls > edges.len() / 8 {
            // Those of each first node, in the order of the file: in tracks that sorts them.
            let (mut next, mut by_first) = (starts(&edges), vec![[0, 0]; edges.len()]);
            for edge in edges {
                let place = &mut next[edge[0] as usize];
                by_first[*place] = edge;
                *place += 1;
            }
            edges = by_first;
        }
        // Runs that are sorted already are merged.
        edges.sort();
        edges.dedup();
        let start = starts(&edges);
        Ok(Graph {
            pairs: edges,
            start,
            parts: Vec::new(),
            displacements: None,
            own_frame: None,
            frames: None,
            as_stated: false,
        })
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.start.len() - 1
    }

    /// The number of an edge, which must be there.
    pub(crate) fn edge(&self, [i, j]: Pair) -> Checked<usize> {
        let ends = self.start.get(i as usize..i as usize + 2);
        let (from, to) = ends.map_or((0, 0), |ends| (ends[0], ends[1]));
        let offset = self.pairs[from..to].binary_search_by_key(&j, |pair| pair[1]);
        let missing =
            |_| Failure::rejected(format!("[{i}, {j}] is not an edge (i < j) of the graph"));
        Ok(from + offset.map_err(missing)?)
    }

    fn has_edges_of(&self, other: &Graph) -> bool {
        (self.nodes(), &self.pairs) == (other.nodes(), &other.pairs)
    }

    /// SHA-256 of the canonical form, which known parts do not enter.
    pub fn sha256(&self) -> [u8; 32] {
        let (mut hash, mut bytes) = (Sha256::new(), Vec::new());
        hash.update(b"viewcert graph 1\n");
        hash.update((self.nodes() as u64).to_le_bytes());
        hash.update((self.pairs.len() as u64).to_le_bytes());
        for edges in self.pairs.chunks(1 << 13) {
            bytes.clear();
            let nodes = edges.iter().flatten();
            nodes.for_each(|node| bytes.extend_from_slice(&node.to_le_bytes()));
            hash.update(&bytes);
        }
        hash.finalize().into()
    }

    /// Reads one graph6 line, without header.
    ///
    /// # Errors
    /// Anything that is not exactly one graph.
    pub fn from_graph6(line: &[u8]) -> Result<Graph, Unreadable> {
        let Graph6 { nodes, bits, .. } = Graph6::parse(line)?;
        // Column j of the upper triangle begins at bit j (j - 1) / 2. Rows, so that nothing is left
        // to be sorted. The bits are as many as pairs of nodes, so that there are enough of them to
        // pay for the rows.
        let (mut rows, mut column, mut end) = (vec![Vec::new(); nodes as usize], 0, 0);
        for (k, byte) in bits.iter().enumerate().filter(|(_, byte)| **byte != 63) {
            let ones = (0..6).filter(|bit| (byte - 63) << bit & 32 != 0);
            for index in ones.map(|bit| 6 * k as u64 + bit) {
                while end <= index {
                    column += 1;
                    end += column;
                }
                rows[(index + column - end) as usize].push(column as u32);
            }
        }
        let edges = rows.iter().zip(0..);
        Graph::new(
            rows.len(),
            edges.flat_map(|(row, i)| row.iter().map(move |&j| (i, j))),
        )
    }
}

/// A line that is a graph6 graph.
struct Graph6<'t> {
    nodes: u64,
    /// Six bits each, plus 63.
    bits: &'t [u8],
}

impl<'t> Graph6<'t> {
    fn parse(line: &'t [u8]) -> Result<Graph6<'t>, Unreadable> {
        ensure!(
            line.iter().all(|byte| (63..127).contains(byte)),
            "graph6: a byte that is not from 63 to 126"
        );
        let (size, rest) = match line {
            [126, 126, rest @ ..] => (6, rest),
            [126, rest @ ..] => (3, rest),
            _ => (1, line),
        };
        let short =
            || Unreadable::from("graph6: the line ends within the number of nodes".to_string());
        let (size, bits) = rest.split_at_checked(size).ok_or_else(short)?;
        let nodes = size
            .iter()
            .fold(0, |n, &byte| n << 6 | u64::from(byte - 63));
        let longer_than_needed = match size.len() {
            6 => nodes <= 258_047,
            3 => nodes <= 62,
            _ => false,
        };
        ensure!(
            !longer_than_needed,
            "graph6: the number of nodes is not in its shortest form"
        );
        let pairs = u128::from(nodes) * u128::from(nodes.saturating_sub(1)) / 2;
        ensure!(
            bits.len() as u128 == pairs.div_ceil(6),
            "graph6: {} bytes of edges do not fit {nodes} nodes",
            bits.len()
        );
        let padding = (6 - pairs % 6) % 6;
        let last = bits.last().map_or(0, |byte| byte - 63);
        ensure!(
            last & ((1 << padding) - 1) == 0,
            "graph6: padding that is not zero"
        );
        Ok(Graph6 { nodes, bits })
    }
}

impl GraphName {
    /// The graph that the certificate holds.
    pub(crate) fn held(&self) -> Result<Option<Graph>, Unreadable> {
        let held = self.graph6.as_ref();
        held.map(|line| Graph::from_graph6(line.as_bytes()))
            .transpose()
    }

    /// The graph that the certificate is about, with its hash: the given one, or else the one that
    /// it holds (section 3).
    pub(crate) fn find<'g>(&self, given: Option<&'g Graph>) -> Checked<(Cow<'g, Graph>, [u8; 32])> {
        let held = self.held()?;
        ensure!(
            match (given, &held) {
                (Some(given), Some(held)) => given.has_edges_of(held),
                _ => true,
            },
            "the graph given is not the one in `graph6`"
        );
        let missing =
            || Failure::rejected("the certificate does not hold the graph, and none is given");
        let graph = given.map(Cow::Borrowed).or(held.map(Cow::Owned));
        let graph = graph.ok_or_else(missing)?;
        let (hash, nodes, edges) = (graph.sha256(), graph.nodes(), graph.pairs.len());
        ensure!(
            hex(&hash) == self.sha256,
            "the graph has another hash than `sha256`"
        );
        ensure!(
            (nodes, edges) == (self.nodes, self.edges),
            "the graph has {nodes} nodes and {edges} edges, not {} and {}",
            self.nodes,
            self.edges
        );
        ensure!(nodes >= 1, "the graph has no nodes");
        Ok((graph, hash))
    }
}

/// A hash in lower-case hexadecimal digits.
pub(crate) fn hex(bytes: &[u8; 32]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests;
