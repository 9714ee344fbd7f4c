//! Graphs: their canonical form and hash, and the two kinds of files that hold them (section 2 of the specification).

use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::fmt;

/// A simple graph with nodes `0 .. nodes`; its edges are in lexicographic order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    /// The edges (i, j), i < j, of node i are `ends[start[i]..start[i + 1]]`.
    start: Vec<usize>,
    ends: Vec<u32>,
}

/// Why a graph cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GraphError(String);

impl fmt::Display for GraphError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for GraphError {}

fn error<T>(reason: impl Into<String>) -> Result<T, GraphError> {
    Err(GraphError(reason.into()))
}

impl Graph {
    /// A graph from its edges, in any order; pairs that occur again, also reversed, are merged.
    ///
    /// # Errors
    /// A self-loop, an end point that is not a node, or 2^32 or more nodes.
    pub fn new(nodes: usize, mut edges: Vec<(u32, u32)>) -> Result<Graph, GraphError> {
        if u32::try_from(nodes).is_err() {
            return error(format!("{nodes} nodes are too many"));
        }
        let mut start = vec![0; nodes + 1];
        for (i, j) in &mut edges {
            (*i, *j) = (*i.min(j), *i.max(j));
            if i == j || *j as usize >= nodes {
                return error(format!("({i}, {j}) is not a pair of different nodes below {nodes}"));
            }
            start[*i as usize + 1] += 1;
        }
        for i in 0..nodes {
            start[i + 1] += start[i];
        }
        let (mut next, mut ends) = (start.clone(), vec![0; edges.len()]);
        for (i, j) in edges {
            ends[next[i as usize]] = j;
            next[i as usize] += 1;
        }
        let mut kept = 0;
        for i in 0..nodes {
            let (from, to, first) = (start[i], start[i + 1], kept);
            start[i] = first;
            ends[from..to].sort_unstable();
            for at in from..to {
                if kept == first || ends[kept - 1] != ends[at] {
                    ends[kept] = ends[at];
                    kept += 1;
                }
            }
        }
        start[nodes] = kept;
        ends.truncate(kept);
        Ok(Graph { start, ends })
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.start.len() - 1
    }

    /// The number of edges.
    pub fn edges(&self) -> usize {
        self.ends.len()
    }

    /// The position of the edge (i, j), i < j, in lexicographic order, if there is such an edge.
    pub(crate) fn edge_number(&self, i: u32, j: u32) -> Option<usize> {
        let from = *self.start.get(i as usize)?;
        let ends = &self.ends[from..*self.start.get(i as usize + 1)?];
        ends.binary_search(&j).ok().map(|offset| from + offset)
    }

    /// The edges in order.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (u32, u32)> {
        let of = |i: usize| self.ends[self.start[i]..self.start[i + 1]].iter().map(move |&j| (i as u32, j));
        (0..self.nodes()).flat_map(of)
    }

    /// SHA-256 of the canonical form.
    pub fn sha256(&self) -> [u8; 32] {
        let mut hash = Sha256::new();
        hash.update(b"viewcert graph 1\n");
        hash.update((self.nodes() as u64).to_le_bytes());
        hash.update((self.edges() as u64).to_le_bytes());
        let mut buffer = Vec::with_capacity(1 << 16);
        for (i, j) in self.pairs() {
            buffer.extend(i.to_le_bytes());
            buffer.extend(j.to_le_bytes());
            if buffer.len() == 1 << 16 {
                hash.update(&buffer);
                buffer.clear();
            }
        }
        hash.update(&buffer);
        hash.finalize().into()
    }

    /// Reads one graph6 line, without header.
    ///
    /// # Errors
    /// Anything that is not exactly one graph.
    pub fn from_graph6(line: &[u8]) -> Result<Graph, GraphError> {
        if line.iter().any(|byte| !(63..127).contains(byte)) {
            return error("graph6: a byte that is not from 63 to 126");
        }
        let (size, rest) = match line {
            [126, 126, rest @ ..] => (6, rest),
            [126, rest @ ..] => (3, rest),
            _ => (1, line),
        };
        let Some((size, bits)) = rest.split_at_checked(size) else {
            return error("graph6: the line ends within the number of nodes");
        };
        let nodes = size.iter().fold(0u64, |n, &byte| n << 6 | u64::from(byte - 63));
        let pairs = u128::from(nodes) * u128::from(nodes.saturating_sub(1)) / 2;
        if bits.len() as u128 != pairs.div_ceil(6) {
            return error(format!("graph6: {} bytes of edges do not fit {nodes} nodes", bits.len()));
        }
        let mut edges = Vec::new();
        let (mut i, mut j) = (0u32, 1u32);
        for byte in bits {
            for bit in (0..6).rev() {
                let is_edge = (byte - 63) >> bit & 1 == 1;
                if is_edge && u64::from(j) >= nodes {
                    return error("graph6: padding that is not zero");
                }
                if is_edge {
                    edges.push((i, j));
                }
                i += 1;
                if i == j {
                    (i, j) = (0, j + 1);
                }
            }
        }
        Graph::new(usize::try_from(nodes).unwrap_or(usize::MAX), edges)
    }

    /// Reads a file: graph6, if every line that is not blank is a graph6 graph (the first line may have the header
    /// `>>graph6<<`), or else an edge list. Of several graphs the one with the wanted hash is taken, or else the first.
    ///
    /// # Errors
    /// What is wrong with the file, with the line.
    pub fn read(file: &[u8], wanted: Option<[u8; 32]>) -> Result<Graph, GraphError> {
        const HEADER: &[u8] = b">>graph6<<";
        let body = file.strip_prefix(HEADER).unwrap_or(file);
        let mut first = None;
        for (number, line) in body.split(|&byte| byte == b'\n').enumerate() {
            let line = line.trim_ascii();
            if line.is_empty() {
                continue;
            }
            match Graph::from_graph6(line) {
                Ok(graph) if wanted == Some(graph.sha256()) => return Ok(graph),
                Ok(graph) => first = first.or(Some(graph)),
                Err(GraphError(reason)) if file.starts_with(HEADER) => {
                    return error(format!("line {}: {reason}", number + 1));
                }
                Err(_) => return Graph::from_edge_list(file),
            }
        }
        first.map_or_else(|| error("the file holds no graph"), Ok)
    }

    /// Reads an edge list: see section 2 of the specification for the grammar.
    ///
    /// # Errors
    /// A self-loop, with its line, or a file without any label.
    pub fn from_edge_list(file: &[u8]) -> Result<Graph, GraphError> {
        let text = file.strip_prefix(b"\xef\xbb\xbf").unwrap_or(file);
        if let Some(pairs) = label_pairs(text, number)? {
            let mut labels: Vec<u64> = pairs.iter().flat_map(|&(a, b)| [a, b]).collect();
            let top = labels.iter().max().map_or(0, |&label| label as usize);
            if top / 8 < labels.len() {
                // Few gaps: a table is faster than sorting.
                let mut rank = vec![0u32; top.saturating_add(1)];
                labels.iter().for_each(|&label| rank[label as usize] = 1);
                let mut nodes = 0;
                for entry in &mut rank {
                    nodes += *entry;
                    *entry = nodes.wrapping_sub(1);
                }
                return from_labels(nodes as usize, pairs, |label| rank[label as usize]);
            }
            labels.sort_unstable();
            labels.dedup();
            return from_labels(labels.len(), pairs, |label| labels.partition_point(|&other| other < label) as u32);
        }
        let mut known: HashMap<&[u8], u64> = HashMap::new();
        let pairs = label_pairs(text, |label| {
            let next = known.len() as u64;
            Some(*known.entry(label).or_insert(next))
        })?;
        let mut sorted: Vec<_> = known.into_iter().collect();
        sorted.sort_unstable();
        let mut rank = vec![0; sorted.len()];
        sorted.iter().zip(0..).for_each(|(&(_, label), position)| rank[label as usize] = position);
        from_labels(rank.len(), pairs.unwrap_or_default(), |label| rank[label as usize])
    }
}

/// The graph of labels that have ranks; a pair of equal labels is an isolated node.
fn from_labels(nodes: usize, pairs: Vec<(u64, u64)>, rank: impl Fn(u64) -> u32) -> Result<Graph, GraphError> {
    if nodes == 0 {
        return error("the file holds no graph");
    }
    let edges = pairs.into_iter().filter(|(a, b)| a != b);
    Graph::new(nodes, edges.map(|(a, b)| (rank(a), rank(b))).collect())
}

/// A label that is a decimal integer without leading zeros below 2^64.
fn number(label: &[u8]) -> Option<u64> {
    if label.first() == Some(&b'0') && label.len() > 1 {
        return None;
    }
    label.iter().try_fold(0u64, |value, byte| {
        let digit = byte.is_ascii_digit().then(|| u64::from(byte - b'0'))?;
        value.checked_mul(10)?.checked_add(digit)
    })
}

/// The first two labels of every line, one label standing for an isolated node; `None` if `read` fails on any.
fn label_pairs<'a>(
    text: &'a [u8],
    mut read: impl FnMut(&'a [u8]) -> Option<u64>,
) -> Result<Option<Vec<(u64, u64)>>, GraphError> {
    let mut pairs = Vec::new();
    for (number, line) in text.split(|&byte| byte == b'\n').enumerate() {
        let mut rest = line.strip_suffix(b"\r").unwrap_or(line);
        let mut label = || -> Option<&'a [u8]> {
            let begin = rest.iter().position(|byte| !is_separator(*byte))?;
            rest = &rest[begin..];
            if matches!(rest[0], b'#' | b'%') {
                rest = &[];
                return None;
            }
            let end = rest.iter().position(|byte| is_separator(*byte)).unwrap_or(rest.len());
            let (label, after) = rest.split_at(end);
            rest = after;
            Some(label)
        };
        let Some(first) = label() else { continue };
        let second = label();
        if second == Some(first) {
            return error(format!("line {}: a node paired with itself", number + 1));
        }
        let (Some(a), Some(b)) = (read(first), read(second.unwrap_or(first))) else {
            return Ok(None);
        };
        pairs.push((a, b));
    }
    if pairs.len() >= 1 << 31 {
        return error("2^31 lines and more are too many");
    }
    Ok(Some(pairs))
}

fn is_separator(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b',')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(text: &str) -> (usize, Vec<(u32, u32)>) {
        let graph = Graph::read(text.as_bytes(), None).unwrap();
        (graph.nodes(), graph.pairs().collect())
    }

    #[test]
    fn edge_lists() {
        assert_eq!(list("10 2\n2 10 0.5\n9,2\n"), (3, vec![(0, 1), (0, 2)]));
        assert_eq!(list("\u{feff}# c\r\nb a # x\r\n% d\r\n c %x y\r\na\tb\r\n"), (3, vec![(0, 1)]));
        // One label that is not a number: all are sorted bytewise.
        assert_eq!(list("10 9\n9 x"), (3, vec![(0, 1), (1, 2)]));
        assert_eq!(list("01 1\n"), (2, vec![(0, 1)]));
        assert_eq!(list("18446744073709551615 7\n7 18446744073709551614"), (3, vec![(0, 1), (0, 2)]));
        assert_eq!(list("18446744073709551616 7"), (2, vec![(0, 1)]));
        for (text, wanted) in [
            ("", "the file holds no graph"),
            ("# only\n", "the file holds no graph"),
            ("1 2\n3 3\n", "line 2: a node paired with itself"),
        ] {
            assert_eq!(Graph::read(text.as_bytes(), None).unwrap_err().to_string(), wanted);
        }
    }

    #[test]
    fn graph6_lines() {
        // The example of the format's own description: n = 5, edges 0-2, 0-4, 1-3, 3-4.
        let example = (5, vec![(0, 2), (0, 4), (1, 3), (3, 4)]);
        assert_eq!(list("DQc\n"), example);
        assert_eq!(list(">>graph6<<DQc"), example);
        let wanted = Graph::from_graph6(b"Bw").unwrap().sha256();
        assert_eq!(Graph::read(b"DQc\nBw\n", Some(wanted)).unwrap().edges(), 3);
        for (line, wanted) in [
            (&b"~~~~~~~~"[..], "graph6: 0 bytes of edges do not fit 68719476735 nodes"),
            (b"~A", "graph6: the line ends within the number of nodes"),
            (b"DQ", "graph6: 1 bytes of edges do not fit 5 nodes"),
            (b"A`", "graph6: padding that is not zero"),
            (b"D Q", "graph6: a byte that is not from 63 to 126"),
        ] {
            assert_eq!(Graph::from_graph6(line).unwrap_err().to_string(), wanted);
        }
        assert_eq!(
            Graph::read(b">>graph6<<DQ", None).unwrap_err().to_string(),
            "line 1: graph6: 1 bytes of edges do not fit 5 nodes"
        );
    }

    #[test]
    fn pairs_are_merged_and_found() {
        let graph = Graph::new(4, vec![(3, 1), (1, 3), (0, 2), (0, 1)]).unwrap();
        assert_eq!(graph.pairs().collect::<Vec<_>>(), [(0, 1), (0, 2), (1, 3)]);
        assert_eq!((graph.edge_number(1, 3), graph.edge_number(3, 1), graph.edge_number(9, 1)), (Some(2), None, None));
        assert!(Graph::new(2, vec![(0, 2)]).is_err());
        assert!(Graph::new(2, vec![(1, 1)]).is_err());
    }

    /// The canonical form of a triangle, hashed by another program (sha256sum).
    #[test]
    fn hash_of_a_triangle() {
        let hash = Graph::from_graph6(b"Bw").unwrap().sha256();
        let hex: String = hash.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(hex, "82d818980c5af485573c22633d3fdb4f55fbe291add6c4aafef03e4ad4d4f81a");
    }
}
