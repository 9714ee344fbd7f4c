//! Graphs: their canonical form and hash, and the two kinds of files that hold them (section 2 of the specification).

use crate::document::{GraphName, Pair};
use crate::rejection::{Checked, Rejection, ensure};
use sha2::{Digest, Sha256};
use std::borrow::Cow;
use std::collections::HashMap;

/// A simple graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    /// [i, j], i < j, in lexicographic order.
    pub(crate) pairs: Vec<Pair>,
    /// Where the edges of node i begin, and in the end where those of the last node end.
    start: Vec<usize>,
}

impl Graph {
    /// A graph from its edges, in any order; pairs that occur again, also reversed, are merged.
    ///
    /// # Errors
    /// A self-loop, an end point that is not a node, or 2^32 or more nodes.
    pub fn new(nodes: usize, edges: impl IntoIterator<Item = (u32, u32)>) -> Result<Graph, Rejection> {
        ensure!(u32::try_from(nodes).is_ok(), "{nodes} nodes are too many");
        let mut edges: Vec<Pair> = edges.into_iter().map(|(i, j)| [i.min(j), i.max(j)]).collect();
        let wrong = edges.iter().find(|[i, j]| i == j || *j as usize >= nodes);
        ensure!(wrong.is_none(), "{wrong:?} is not a pair of different nodes below {nodes}");
        // Graphs come in long runs that are sorted already, which this sort makes use of.
        edges.sort_by_key(|&[i, j]| u64::from(i) << 32 | u64::from(j));
        edges.dedup();
        let mut start = vec![0; nodes + 1];
        edges.iter().for_each(|[i, _]| start[*i as usize + 1] += 1);
        (0..nodes).for_each(|i| start[i + 1] += start[i]);
        Ok(Graph { pairs: edges, start })
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.start.len() - 1
    }

    /// The number of an edge, which must be there.
    pub(crate) fn edge(&self, [i, j]: Pair) -> Checked<usize> {
        let (from, to) = self.start.get(i as usize..i as usize + 2).map_or((0, 0), |ends| (ends[0], ends[1]));
        let offset = self.pairs[from..to].binary_search(&[i, j]);
        let missing = |_| Rejection::new(format!("[{i}, {j}] is not an edge (i < j) of the graph"));
        Ok(from + offset.map_err(missing)?)
    }

    /// SHA-256 of the canonical form.
    pub fn sha256(&self) -> [u8; 32] {
        let (mut hash, mut bytes) = (Sha256::new(), Vec::new());
        hash.update(b"viewcert graph 1\n");
        hash.update((self.nodes() as u64).to_le_bytes());
        hash.update((self.pairs.len() as u64).to_le_bytes());
        for edges in self.pairs.chunks(1 << 13) {
            bytes.clear();
            edges.iter().flatten().for_each(|node| bytes.extend_from_slice(&node.to_le_bytes()));
            hash.update(&bytes);
        }
        hash.finalize().into()
    }

    /// Reads one graph6 line, without header.
    ///
    /// # Errors
    /// Anything that is not exactly one graph.
    pub fn from_graph6(line: &[u8]) -> Result<Graph, Rejection> {
        ensure!(line.iter().all(|byte| (63..127).contains(byte)), "graph6: a byte that is not from 63 to 126");
        let (size, rest) = match line {
            [126, 126, rest @ ..] => (6, rest),
            [126, rest @ ..] => (3, rest),
            _ => (1, line),
        };
        let short = || Rejection::new("graph6: the line ends within the number of nodes");
        let (size, bits) = rest.split_at_checked(size).ok_or_else(short)?;
        let nodes = size.iter().fold(0, |n, &byte| n << 6 | u64::from(byte - 63));
        let pairs = u128::from(nodes) * u128::from(nodes.saturating_sub(1)) / 2;
        let fits = bits.len() as u128 == pairs.div_ceil(6);
        ensure!(fits, "graph6: {} bytes of edges do not fit {nodes} nodes", bits.len());
        // Column j of the upper triangle begins at bit j (j - 1) / 2. Rows, so that nothing is left to be sorted.
        let (mut rows, mut column, mut end) = (vec![Vec::new(); nodes as usize], 0, 0);
        for (k, byte) in bits.iter().enumerate().filter(|(_, byte)| **byte != 63) {
            for index in (0..6).filter(|bit| (byte - 63) << bit & 32 != 0).map(|bit| 6 * k as u64 + bit) {
                ensure!(u128::from(index) < pairs, "graph6: padding that is not zero");
                while end <= index {
                    column += 1;
                    end += column;
                }
                rows[(index + column - end) as usize].push(column as u32);
            }
        }
        Graph::new(rows.len(), rows.iter().zip(0..).flat_map(|(row, i)| row.iter().map(move |&j| (i, j))))
    }

    /// Reads a file: graph6, if every line that is not blank is a graph6 graph (the first line may have the header
    /// `>>graph6<<`), or else an edge list. Of several graphs the one with the
    /// wanted hash (as in a certificate), which is asked for once graph6 was read, is taken, or else the first.
    ///
    /// # Errors
    /// What is wrong with the file, with the line.
    pub fn read<'w>(file: &[u8], wanted: impl Fn() -> Option<&'w str>) -> Result<Graph, Rejection> {
        let body = file.strip_prefix(b">>graph6<<");
        let mut first = None;
        for (number, line) in body.unwrap_or(file).split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).enumerate() {
            match Graph::from_graph6(line) {
                _ if line.is_empty() => {}
                Ok(graph) if wanted() == Some(&hex(&graph.sha256())) => return Ok(graph),
                Ok(graph) => first = first.or(Some(graph)),
                Err(_) if body.is_none() => return Graph::from_edge_list(file),
                Err(error) => return Err(Rejection::new(format!("line {}: {error}", number + 1))),
            }
        }
        first.ok_or_else(|| Rejection::new("the file holds no graph"))
    }

    fn from_edge_list(file: &[u8]) -> Checked<Graph> {
        let mut rest = file.strip_prefix(b"\xef\xbb\xbf").unwrap_or(file);
        // Labels are numbered as they come: small numbers by a table, which is fast, and all others by a map.
        let (mut table, mut map, mut labels) = (Vec::new(), HashMap::new(), Vec::new());
        let mut provisional = |label: (Option<u64>, _)| {
            let number = match label.0 {
                Some(small) if small < file.len() as u64 => {
                    table.resize(table.len().max(small as usize + 1), u32::MAX);
                    &mut table[small as usize]
                }
                _ => map.entry(label.1).or_insert(u32::MAX),
            };
            if *number == u32::MAX {
                *number = labels.len() as u32;
                labels.push(label);
            }
            *number
        };
        let (mut pairs, mut line) = (Vec::new(), 0);
        while !rest.is_empty() {
            line += 1;
            let first = next_label(&mut rest).map(&mut provisional);
            let second = next_label(&mut rest).map(&mut provisional);
            rest = rest.iter().position(|&byte| byte == b'\n').map_or(&[], |end| &rest[end + 1..]);
            let Some(first) = first else { continue };
            ensure!(pairs.len() < 1 << 31, "2^31 lines and more are too many");
            ensure!(second != Some(first), "line {line}: a node paired with itself");
            // One label is an isolated node: a pair of equal ones until the end.
            pairs.push((first, second.unwrap_or(first)));
        }
        ensure!(!labels.is_empty(), "the file holds no graph");
        let all_numbers = labels.iter().all(|(number, _)| number.is_some());
        let mut order: Vec<usize> = (0..labels.len()).collect();
        order.sort_unstable_by_key(|&k| (labels[k].0.filter(|_| all_numbers), labels[k].1));
        let mut node = vec![0; labels.len()];
        order.into_iter().zip(0..).for_each(|(k, position)| node[k] = position);
        let pairs = pairs.into_iter().filter(|(a, b)| a != b);
        Graph::new(labels.len(), pairs.map(|(a, b)| (node[a as usize], node[b as usize])))
    }
}

/// Takes the next label of a line, with its value if it is a decimal integer without leading zeros below 2^64.
#[inline(always)]
fn next_label<'t>(rest: &mut &'t [u8]) -> Option<(Option<u64>, &'t [u8])> {
    let blanks = rest.iter().take_while(|byte| matches!(byte, b' ' | b'\t' | b',' | b'\r')).count();
    let text = &rest[blanks..];
    let (mut value, mut digits) = (0u64, 0);
    while let Some(byte @ b'0'..=b'9') = text.get(digits) {
        value = value.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
        digits += 1;
    }
    let is_inside = |byte: &&u8| !matches!(byte, b' ' | b'\t' | b',' | b'\r' | b'\n');
    let (label, after) = text.split_at(digits + text[digits..].iter().take_while(is_inside).count());
    let first = label.first().filter(|first| !matches!(first, b'#' | b'%'))?;
    *rest = after;
    // Nineteen digits are below 2^64; a longer number is right if it is written like this again.
    let is_number = digits == label.len() && (digits < 20 || value.to_string().as_bytes() == label);
    Some(((is_number && (*first != b'0' || digits == 1)).then_some(value), label))
}

impl GraphName {
    /// The graph that the certificate is about, with its hash: the given one, or else the one that it holds (section 3).
    pub fn find<'g>(&self, given: Option<&'g Graph>) -> Checked<(Cow<'g, Graph>, [u8; 32])> {
        let held = self.graph6.as_ref().map(|line| Graph::from_graph6(line.as_bytes())).transpose()?;
        ensure!(
            held.is_none() || given.is_none() || given == held.as_ref(),
            "the graph given is not the one in `graph6`"
        );
        let missing = || Rejection::new("the certificate does not hold the graph, and none is given");
        let graph = given.map(Cow::Borrowed).or(held.map(Cow::Owned)).ok_or_else(missing)?;
        let (hash, nodes, edges) = (graph.sha256(), graph.nodes(), graph.pairs.len());
        ensure!(hex(&hash) == self.sha256, "the graph has another hash than `sha256`");
        let same = (nodes, edges) == (self.nodes, self.edges) && edges >= 1;
        ensure!(same, "the graph has {nodes} nodes and {edges} edges, not {} and {}", self.nodes, self.edges);
        Ok((graph, hash))
    }
}

fn hex(bytes: &[u8; 32]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests;
