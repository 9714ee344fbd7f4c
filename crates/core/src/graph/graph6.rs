//! graph6: a graph as one line of printable characters.
//!
//! Format by B. D. McKay, `formats.txt` of nauty: the number of nodes in one,
//! four or eight characters, then the upper triangle of the adjacency matrix
//! column by column, (0,1), (0,2), (1,2), (0,3), ..., six bits a character,
//! padded with zeros; to every six bits 63 is added.

use super::error::GraphError;
use super::viewing_graph::Graph;
use std::fmt;

/// The optional header; it stands on the same line as the first graph.
pub const HEADER: &str = ">>graph6<<";

const OFFSET: u8 = 63;
const LONG: u8 = 126;
/// The largest number of nodes that one and four characters hold.
const SHORT_LIMIT: u64 = 62;
const MEDIUM_LIMIT: u64 = 258_047;

/// Why a line is not graph6.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Graph6Error {
    /// A character outside the alphabet `?`..`~`.
    Character {
        /// Position in the line, from 1.
        column: usize,
        /// The byte found there.
        byte: u8,
    },
    /// The line ends within the number of nodes.
    NoSize,
    /// The number of nodes takes more characters than it needs.
    LongSize {
        /// Number of nodes.
        nodes: u64,
    },
    /// Fewer or more characters than the number of nodes asks for.
    Length {
        /// Number of nodes promised.
        nodes: u64,
        /// Characters that they need.
        expected: u128,
        /// Characters that follow.
        found: usize,
    },
    /// The bits after the last pair are not zero.
    Padding,
}

impl fmt::Display for Graph6Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Character { column, byte } => write!(
                f,
                "graph6: character {column} is byte {byte}, outside 63..126"
            ),
            Self::NoSize => write!(
                f,
                "graph6: the line ends before the number of nodes is complete"
            ),
            Self::LongSize { nodes } => write!(
                f,
                "graph6: {nodes} nodes are written with more characters than that takes"
            ),
            Self::Length {
                nodes,
                expected,
                found,
            } => write!(
                f,
                "graph6: {nodes} nodes need {expected} characters of adjacency, the line has {found}"
            ),
            Self::Padding => write!(f, "graph6: the padding after the last pair is not zero"),
        }
    }
}

impl std::error::Error for Graph6Error {}

/// The number of nodes at the start of characters of the alphabet, and what follows it.
pub fn size(line: &[u8]) -> Result<(u64, &[u8]), Graph6Error> {
    let (skip, digits) = match line {
        [LONG, LONG, ..] => (2, 6),
        [LONG, ..] => (1, 3),
        _ => (0, 1),
    };
    let size = line.get(skip..skip + digits).ok_or(Graph6Error::NoSize)?;
    let nodes = size
        .iter()
        .fold(0, |n, &b| n << 6 | u64::from(b.wrapping_sub(OFFSET) & 63));
    Ok((nodes, &line[skip + digits..]))
}

/// How many characters of adjacency so many nodes need.
fn body_length(nodes: u64) -> u128 {
    (u128::from(nodes) * u128::from(nodes.saturating_sub(1)) / 2).div_ceil(6)
}

/// How long a line is that begins like this; `None` if it says too little, or is not graph6.
pub fn line_length(start: &[u8]) -> Option<u128> {
    if start.iter().any(|b| !(OFFSET..=LONG).contains(b)) {
        return None;
    }
    let (nodes, body) = size(start).ok()?;
    Some((start.len() - body.len()) as u128 + body_length(nodes))
}

/// The number of nodes and the adjacency characters of a line, which has been
/// checked to hold exactly as many as the number of nodes asks for.
fn split(line: &[u8]) -> Result<(u32, &[u8]), Graph6Error> {
    if let Some(at) = line.iter().position(|b| !(OFFSET..=LONG).contains(b)) {
        return Err(Graph6Error::Character {
            column: at + 1,
            byte: line[at],
        });
    }
    let (nodes, body) = size(line)?;
    let digits = line.len() - body.len();
    if digits > 1 && nodes <= SHORT_LIMIT || digits > 4 && nodes <= MEDIUM_LIMIT {
        return Err(Graph6Error::LongSize { nodes });
    }
    let wrong_length = |expected| Graph6Error::Length {
        nodes,
        expected,
        found: body.len(),
    };
    let expected = body_length(nodes);
    if expected != body.len() as u128 {
        return Err(wrong_length(expected));
    }
    let pairs = u128::from(nodes) * u128::from(nodes.saturating_sub(1)) / 2;
    let padding = (6 * expected - pairs) as u32;
    if body
        .last()
        .is_some_and(|b| (b - OFFSET).trailing_zeros() < padding)
    {
        return Err(Graph6Error::Padding);
    }
    // A body of 2^60 characters does not exist, so this never fails in fact.
    let nodes = u32::try_from(nodes).map_err(|_| wrong_length(expected))?;
    Ok((nodes, body))
}

/// Whether a line, without header and line end, is graph6. O(length).
pub fn is_graph6(line: &[u8]) -> bool {
    split(line).is_ok()
}

/// The graph of a line, given without its line end; a header is skipped. Nodes
/// are numbered as in the adjacency matrix. Allocates no more than a constant
/// times the length of the line, whatever number of nodes it promises.
/// O(n^2 / 6 + m).
///
/// # Errors
/// The line is not exactly one graph.
pub fn decode(line: &[u8]) -> Result<Graph, Graph6Error> {
    let line = line.strip_prefix(HEADER.as_bytes()).unwrap_or(line);
    let (nodes, body) = split(line)?;
    let ones = body
        .iter()
        .map(|b| (b - OFFSET).count_ones() as usize)
        .sum();
    let mut pairs = Vec::with_capacity(ones);
    // (i, j) is the pair of the next bit.
    let (mut i, mut j) = (0, 1);
    for byte in body {
        let bits = byte - OFFSET;
        if bits == 0 {
            i += 6;
            while i >= j {
                i -= j;
                j += 1;
            }
            continue;
        }
        for bit in (0..6).rev() {
            if bits >> bit & 1 == 1 {
                pairs.push((i, j));
            }
            i += 1;
            if i == j {
                i = 0;
                j += 1;
            }
        }
    }
    match Graph::from_pairs(nodes, pairs) {
        Ok((graph, _)) => Ok(graph),
        // Bits after the last pair are zero, so every pair is in range.
        Err(GraphError::SelfLoop(_) | GraphError::OutOfRange { .. }) => Err(Graph6Error::Padding),
    }
}

/// The graph as graph6, without header or line end: about n^2 / 12 characters.
///
/// # Example
/// ```
/// use viewcert::graph::{Graph, graph6};
/// let (triangle, _) = Graph::from_pairs(3, vec![(0, 1), (0, 2), (1, 2)])?;
/// assert_eq!(graph6::encode(&triangle), "Bw");
/// # Ok::<(), viewcert::graph::GraphError>(())
/// ```
pub fn encode(graph: &Graph) -> String {
    let n = graph.nodes() as u64;
    let digits: &[u32] = match n {
        _ if n <= SHORT_LIMIT => &[0],
        _ if n <= MEDIUM_LIMIT => &[12, 6, 0],
        _ => &[30, 24, 18, 12, 6, 0],
    };
    let mut text = match digits.len() {
        1 => Vec::new(),
        3 => vec![LONG],
        _ => vec![LONG, LONG],
    };
    text.extend(digits.iter().map(|shift| (n >> shift & 63) as u8 + OFFSET));
    let start = text.len();
    let bits = graph.nodes() * graph.nodes().saturating_sub(1) / 2;
    text.resize(start + bits.div_ceil(6), OFFSET);
    for &(i, j) in graph.edges() {
        let (i, j) = (i as usize, j as usize);
        let bit = j * (j - 1) / 2 + i;
        text[start + bit / 6] += 32 >> (bit % 6);
    }
    text.into_iter().map(char::from).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
        Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
    }

    /// Strings by hand; `DQc` is the example of nauty's `formats.txt`.
    #[test]
    fn known_graphs_are_read_and_written() {
        let known = [
            ("?", graph(0, &[])),
            ("@", graph(1, &[])),
            ("A?", graph(2, &[])),
            ("A_", graph(2, &[(0, 1)])),
            ("Bw", graph(3, &[(0, 1), (0, 2), (1, 2)])),
            ("DQc", graph(5, &[(0, 2), (0, 4), (1, 3), (3, 4)])),
        ];
        for (text, graph) in known {
            assert_eq!(decode(text.as_bytes()).as_ref(), Ok(&graph));
            assert_eq!(
                decode(format!("{HEADER}{text}").as_bytes()).as_ref(),
                Ok(&graph)
            );
            assert_eq!(encode(&graph), text);
        }
    }

    /// The sizes that `formats.txt` gives as examples: 30, 12345, 460175067.
    #[test]
    fn sizes_are_written_as_the_format_says() {
        assert_eq!(&encode(&graph(30, &[]))[..1], "]");
        assert_eq!(&encode(&graph(62, &[]))[..1], "}");
        assert_eq!(&encode(&graph(63, &[]))[..4], "~??~");
        assert_eq!(&encode(&graph(12345, &[]))[..4], "~B?x");
        let large = decode(b"~~?ZZZZZ");
        let promised = matches!(
            large,
            Err(Graph6Error::Length {
                nodes: 460_175_067,
                found: 0,
                ..
            })
        );
        assert!(promised, "{large:?}");
    }

    /// Against a string made by an independent encoder: 63 nodes, (0,1), (61,62).
    #[test]
    fn more_than_62_nodes() {
        let graph = graph(63, &[(0, 1), (61, 62)]);
        let text = encode(&graph);
        assert_eq!(text.len(), 330);
        assert!(
            text.starts_with("~??~_???") && text.ends_with("???G"),
            "{text}"
        );
        assert_eq!(decode(text.as_bytes()), Ok(graph));
    }

    #[test]
    fn malformed_lines_are_refused() {
        let length = |nodes, expected, found| Graph6Error::Length {
            nodes,
            expected,
            found,
        };
        let character = |column, byte| Graph6Error::Character { column, byte };
        let bad: [(&[u8], Graph6Error); 14] = [
            (b"", Graph6Error::NoSize),
            (b">>graph6<<", Graph6Error::NoSize),
            (b"~", Graph6Error::NoSize),
            (b"~??", Graph6Error::NoSize),
            (b"~~?????", Graph6Error::NoSize),
            (b"DQ", length(5, 2, 1)),
            (b"DQcc", length(5, 2, 3)),
            (b"DQc ", character(4, b' ')),
            (b":DQc", character(1, b':')),
            (b"D\xffc", character(2, 0xff)),
            (b"DQd", Graph6Error::Padding),
            (b"~??BW", Graph6Error::LongSize { nodes: 3 }),
            (b"~~????~~", Graph6Error::LongSize { nodes: 4095 }),
            // The largest number of nodes: 2^36 - 1.
            (
                b"~~~~~~~~",
                length((1 << 36) - 1, 393_530_540_221_957_231_958, 0),
            ),
        ];
        for (line, error) in bad {
            assert_eq!(decode(line), Err(error), "{}", line.escape_ascii());
        }
    }

    proptest! {
        #[test]
        fn what_is_written_is_read(
            nodes in 2u32..150,
            ends in prop::collection::vec((0u32..150, 0u32..150), 0..400),
        ) {
            let pairs = ends.into_iter().map(|(a, b)| (a % nodes, b % nodes));
            let graph = graph(nodes, &pairs.filter(|(a, b)| a != b).collect::<Vec<_>>());
            prop_assert_eq!(decode(encode(&graph).as_bytes()), Ok(graph));
        }

        /// A line is the only one of its graph.
        #[test]
        fn what_is_read_is_written_back(line in "[?-}]{1,12}") {
            if let Ok(graph) = decode(line.as_bytes()) {
                prop_assert_eq!(encode(&graph), line);
            }
        }
    }
}
