//! sparse6: a graph with few edges as one line of printable characters.
//!
//! Format by B. D. McKay, `formats.txt` of nauty: a colon, the number of nodes n as in graph6, then
//! a list of pairs (b, x) of one bit and as many bits as n - 1 has, six bits a character, to which
//! 63 is added. A node v starts at 0; b = 1 adds one to it; then x > v sets v to x, and any other x
//! is an edge between x and v. An incremental line begins with a semicolon in the place of the
//! colon and the number of nodes, and is refused.

use crate::error::{Kind, Problem};
use viewcert::graph::Graph;
use viewcert::graph::graph6;

/// The optional header; it stands on the same line as the first graph, or before it.
pub const HEADER: &str = ">>sparse6<<";

/// Nodes without pairs that a line may promise with each of its characters, so that what reading it
/// costs is paid for by its length: ten characters could promise 2^36.
const ISOLATED_PER_CHARACTER: u64 = 1 << 10;

/// Why a line is not sparse6.
fn wrong(what: &str) -> Problem {
    Problem::of(
        Kind::Line,
        format!("sparse6: {what}"),
        "write the line again",
    )
}

/// Whether a line has the characters of sparse6 or incremental sparse6.
pub fn looks_like_sparse6(line: &[u8]) -> bool {
    let alphabet = |body: &[u8]| body.iter().all(|b| (63..=126).contains(b));
    match line {
        [b':', body @ ..] => !body.is_empty() && alphabet(body),
        [b';', body @ ..] => alphabet(body),
        _ => false,
    }
}

/// The graph of a line, given without its line end and header, and how many repeated edges were
/// merged. O(length log length).
///
/// # Errors
/// The line is not exactly one simple graph.
pub fn decode(line: &[u8]) -> Result<(Graph, usize), Problem> {
    if let Some(at) = line.iter().skip(1).position(|b| !(63..=126).contains(b)) {
        let (column, byte) = (at + 2, line[at + 1]);
        return Err(wrong(&format!(
            "character {column} is byte {byte}, outside 63..126"
        )));
    }
    let body = match line {
        [b':', body @ ..] => body,
        [b';', ..] => {
            return Err(wrong(
                "the line begins with `;` and changes the graph before it, which is not read here: nauty's \
                 `copyg -s` writes whole graphs",
            ));
        }
        _ => return Err(wrong("the line does not begin with `:`")),
    };
    let size = graph6::size(body);
    let (nodes, body) =
        size.map_err(|_| wrong("the line ends before the number of nodes is complete"))?;
    let too_large = || {
        let what = "too many for a line of this length, which may have 1024 nodes without pairs for each character";
        let mut problem = wrong(&format!("{nodes} nodes are {what}"));
        problem.kind = Kind::LineSize;
        problem
    };
    let count = u32::try_from(nodes).map_err(|_| too_large())?;
    let pairs = pairs(count, body)?;
    let isolated = ISOLATED_PER_CHARACTER * line.len() as u64;
    if nodes > isolated + 2 * pairs.len() as u64 {
        return Err(too_large());
    }
    Graph::from_pairs(count, pairs).map_err(|error| wrong(&error.to_string()))
}

/// The edges that a list of pairs (b, x) stands for, as often as it has them.
fn pairs(nodes: u32, body: &[u8]) -> Result<Vec<(u32, u32)>, Problem> {
    let width = u32::BITS - nodes.saturating_sub(1).leading_zeros();
    let mut bits = body
        .iter()
        .flat_map(|byte| (0..6).rev().map(move |bit| (byte - 63) >> bit & 1));
    let mut pairs = Vec::new();
    let mut v = 0u64;
    // What is left at the end and too short for a pair (b, x) fills up the last character.
    while let Some(b) = bits.next() {
        v += u64::from(b);
        let mut x = 0u64;
        for _ in 0..width {
            let Some(bit) = bits.next() else {
                return Ok(pairs);
            };
            x = x << 1 | u64::from(bit);
        }
        if v >= u64::from(nodes) {
            break;
        }
        if x > v {
            v = x;
        } else {
            if x == v {
                return Err(wrong(&format!("node {v} is paired with itself")));
            }
            pairs.push((x as u32, v as u32));
        }
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edges(line: &str) -> Vec<(u32, u32)> {
        decode(line.as_bytes()).unwrap().0.edges().to_vec()
    }

    /// `:Fa@x^` is the example of nauty's `formats.txt`: 0-1, 0-2, 1-2, 5-6 on 7 nodes.
    #[test]
    fn known_graphs() {
        assert_eq!(edges(":Fa@x^"), [(0, 1), (0, 2), (1, 2), (5, 6)]);
        assert_eq!(decode(b":Fa@x^").unwrap().0.nodes(), 7);
        assert_eq!(edges(":An"), [(0, 1)]);
        assert_eq!(edges(":B"), []);
        assert_eq!(decode(b":@").unwrap().0.nodes(), 1);
        assert_eq!(decode(b":?").unwrap().0.nodes(), 0);
    }

    #[test]
    fn lines_that_look_like_sparse6() {
        for line in [":An", ";", ";a@x^", ":?"] {
            assert!(looks_like_sparse6(line.as_bytes()), "{line}");
        }
        for line in ["", ":", "An", ":a b", ";a,b"] {
            assert!(!looks_like_sparse6(line.as_bytes()), "{line}");
        }
    }

    #[test]
    fn malformed_lines_are_refused() {
        for (line, phrase) in [
            (&b""[..], "does not begin"),
            (b"Fa", "does not begin"),
            (b":", "ends before"),
            (b":~?", "ends before"),
            (b":F a", "character 3 is byte 32"),
            (b";a", "copyg -s"),
            (b":~~~~~~~~", "68719476735 nodes"),
            // Two nodes: (1, 1) is not there, (0, 0) is a loop.
            (b":A?", "node 0 is paired with itself"),
        ] {
            let why = decode(line).unwrap_err().to_string();
            assert!(why.contains(phrase), "{}: {why}", line.escape_ascii());
        }
        // 16,777,215 nodes in nine characters, and 5,120 and one more in five.
        let promised = |line: &[u8]| decode(line).map(|(graph, _)| graph.nodes()).ok();
        assert_eq!(promised(b":~~??~~~~"), None);
        assert_eq!(promised(b":~@O?"), Some(5120));
        assert_eq!(promised(b":~@O@"), None);
    }
}
