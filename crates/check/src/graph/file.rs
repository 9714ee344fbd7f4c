//! The two kinds of files that hold a graph (section 2 of the specification): node numbers, and
//! nothing else.

use super::{Graph, Graph6, hex};
use crate::rejection::{Unreadable, ensure};

impl Graph {
    /// Reads a file: graph6, or else pairs of node numbers. Of several graph6 graphs the one with
    /// the wanted hash (as in a certificate, asked for only if it matters) is taken, or else the
    /// first.
    ///
    /// # Errors
    /// What is wrong with the file, with the line.
    pub fn read<'w>(
        file: &[u8],
        wanted: impl Fn() -> Option<&'w str>,
    ) -> Result<Graph, Unreadable> {
        match file.first() {
            Some(b'>' | b'?'..=b'~') => of_graph6(file, wanted),
            _ => of_pairs(file),
        }
    }
}

const PAIRS: &str = "a line is a pair of node numbers, with a single blank or tab between them, or \
                     one number (`verify convert` writes such a file)";

/// The lines without their ends, with their numbers.
pub(super) fn lines(file: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let lines = file.split_inclusive(|&byte| byte == b'\n');
    (1..).zip(lines.map(|line| match line.strip_suffix(b"\n") {
        Some(line) => line.strip_suffix(b"\r").unwrap_or(line),
        None => line,
    }))
}

/// A node at the start of a text, and what follows: decimal digits without leading zeros, below 2^32 - 1.
pub(super) fn number(text: &[u8]) -> Option<(u32, &[u8])> {
    let (mut value, mut length) = (0, 0);
    while let Some(digit @ b'0'..=b'9') = text.get(length).filter(|_| length <= 10) {
        value = 10 * value + u64::from(digit - b'0');
        length += 1;
    }
    let is_number = length == 1 || length > 1 && text[0] != b'0';
    let value = u32::try_from(value)
        .ok()
        .filter(|&value| is_number && value < u32::MAX)?;
    Some((value, &text[length..]))
}

fn of_pairs(file: &[u8]) -> Result<Graph, Unreadable> {
    let (mut pairs, mut alone) = (Vec::new(), Vec::new());
    let (mut text, mut line) = (file, 0);
    while !text.is_empty() {
        line += 1;
        if text[0] == b'#' {
            let end = text.iter().position(|&byte| byte == b'\n');
            text = &text[end.map_or(text.len(), |end| end + 1)..];
            continue;
        }
        let wrong = || format!("line {line}: {PAIRS}");
        let (i, mut rest) = number(text).ok_or_else(wrong)?;
        if let [b' ' | b'\t', second @ ..] = rest {
            let (j, end) = number(second).ok_or_else(wrong)?;
            ensure!(i != j, "line {line}: node {i} is paired with itself");
            pairs.push((i, j));
            rest = end;
        } else {
            alone.push(i);
        }
        text = match rest {
            [] => rest,
            [b'\n', text @ ..] | [b'\r', b'\n', text @ ..] => text,
            _ => return Err(wrong().into()),
        };
    }
    let nodes = count_nodes(&pairs, &alone)?;
    let listed = pairs.len();
    let graph = Graph::new(nodes, pairs)?;
    ensure!(
        graph.pairs.len() == listed,
        "a pair occurs twice, in the same order or the other"
    );
    Ok(graph)
}

/// How many nodes there are: every number up to the largest occurs, those that stand alone once.
fn count_nodes(pairs: &[(u32, u32)], alone: &[u32]) -> Result<usize, Unreadable> {
    let largest = pairs.iter().map(|&(i, j)| i.max(j)).max();
    let largest = largest.max(alone.iter().copied().max());
    let largest = largest.ok_or_else(|| Unreadable::from("the file holds no node".to_string()))?;
    let missing = |node: usize| {
        format!(
            "there is a node {largest}, but no node {node}: nodes are numbered from 0, without gaps; `verify convert \
             GRAPH -o FILE` numbers them so, as for the certificate"
        )
    };
    let nodes = largest as usize + 1;
    // As many are named at least, so that what is reserved is paid for by the file.
    let named = 2 * pairs.len() + alone.len();
    let mut is_there = vec![false; nodes.min(named)];
    for &(i, j) in pairs {
        for node in [i, j] {
            if let Some(there) = is_there.get_mut(node as usize) {
                *there = true;
            }
        }
    }
    for &node in alone {
        let there = is_there.get_mut(node as usize);
        let before = there.is_some_and(|there| std::mem::replace(there, true));
        ensure!(
            !before,
            "node {node} stands alone, and in another line as well"
        );
    }
    let gap = is_there.iter().position(|there| !there);
    let gap = gap.or((named < nodes).then_some(named));
    ensure!(gap.is_none(), "{}", missing(gap.unwrap_or_default()));
    Ok(nodes)
}

fn of_graph6<'w>(file: &[u8], wanted: impl Fn() -> Option<&'w str>) -> Result<Graph, Unreadable> {
    let body = file.strip_prefix(b">>graph6<<").unwrap_or(file);
    // All lines are read, also behind the graph that is wanted: a file is a graph6 file or not.
    for (number, line) in lines(body) {
        let in_line = |error: Unreadable| {
            let other = "`verify convert` writes files that checkers read";
            Unreadable::from(format!("line {number}: {error} ({other})"))
        };
        Graph6::parse(line).map_err(in_line)?;
    }
    let mut first = None;
    for (_, line) in lines(body) {
        let graph = Graph::from_graph6(line)?;
        if wanted().is_none_or(|wanted| wanted == hex(&graph.sha256())) {
            return Ok(graph);
        }
        first = first.or(Some(graph));
    }
    first.ok_or_else(|| Unreadable::from("the file holds no graph".to_string()))
}

#[cfg(test)]
mod tests;
