//! The two kinds of files that hold a graph, and files of known parts (section 2 of the
//! specification): node numbers, and nothing else.

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

    /// The same graph with known parts, in the place of those it has. What comes again counts once;
    /// parts of fewer than two nodes are left out.
    ///
    /// # Errors
    /// A node that the graph does not have.
    pub fn with_parts(
        mut self,
        parts: impl IntoIterator<Item = Vec<u32>>,
    ) -> Result<Graph, Unreadable> {
        let nodes = self.nodes();
        self.parts.clear();
        for mut part in parts {
            part.sort_unstable();
            part.dedup();
            let wrong = part.last().filter(|&&node| node as usize >= nodes);
            ensure!(
                wrong.is_none(),
                "a known part has a node that is not below {nodes}"
            );
            self.parts.extend((part.len() > 1).then_some(part));
        }
        self.parts.sort_unstable();
        self.parts.dedup();
        Ok(self)
    }

    /// The same graph with the known parts of a file.
    ///
    /// # Errors
    /// What is wrong with the file, with the line.
    pub fn with_parts_of(self, file: &[u8]) -> Result<Graph, Unreadable> {
        let mut parts = Vec::new();
        for (number, line) in lines_of_numbers(file) {
            let part: Option<Vec<u32>> = fields(line).collect();
            let part = part.filter(|part| part.len() > 1);
            let wrong = || Unreadable::from(format!("line {number}: {PARTS}"));
            let mut part = part.ok_or_else(wrong)?;
            part.sort_unstable();
            let largest = part.last().copied().unwrap_or_default();
            ensure!(
                (largest as usize) < self.nodes(),
                "line {number}: the graph has no node {largest}"
            );
            let twice = part.windows(2).any(|two| two[0] == two[1]);
            ensure!(!twice, "line {number}: a node is named twice");
            parts.push(part);
        }
        ensure!(!parts.is_empty(), "the file holds no known part");
        let listed = parts.len();
        let graph = self.with_parts(parts)?;
        ensure!(graph.parts.len() == listed, "a known part occurs twice");
        Ok(graph)
    }
}

const PAIRS: &str = "a line is a pair of node numbers, with a single blank or tab between them, or \
                     one number (`verify convert` writes such a file)";

const PARTS: &str = "a line is two node numbers or more, with a single blank or tab between them \
                     (`verify convert --parts` writes such a file)";

/// The lines without their ends, with their numbers.
fn lines(file: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let lines = file.split_inclusive(|&byte| byte == b'\n');
    (1..).zip(lines.map(|line| match line.strip_suffix(b"\n") {
        Some(line) => line.strip_suffix(b"\r").unwrap_or(line),
        None => line,
    }))
}

/// The lines that are no comments.
fn lines_of_numbers(file: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    lines(file).filter(|(_, line)| !line.starts_with(b"#"))
}

/// The numbers of a line, `None` for what is none.
fn fields(line: &[u8]) -> impl Iterator<Item = Option<u32>> {
    line.split(|byte| matches!(byte, b' ' | b'\t')).map(number)
}

/// A node: decimal digits without leading zeros, below 2^32 - 1.
fn number(field: &[u8]) -> Option<u32> {
    let is_short = matches!(field, [b'0'] | [b'1'..=b'9', ..]) && field.len() <= 10;
    if !is_short || !field.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let digits = field.iter().map(|digit| u64::from(digit - b'0'));
    let value = digits.fold(0, |value, digit| 10 * value + digit);
    u32::try_from(value).ok().filter(|&value| value < u32::MAX)
}

fn of_pairs(file: &[u8]) -> Result<Graph, Unreadable> {
    let (mut pairs, mut alone) = (Vec::new(), Vec::new());
    for (number, line) in lines_of_numbers(file) {
        let mut fields = fields(line);
        match [fields.next(), fields.next(), fields.next()] {
            [Some(Some(i)), Some(Some(j)), None] if i != j => pairs.push((i, j)),
            [Some(Some(i)), None, None] => alone.push(i),
            [Some(Some(i)), Some(Some(_)), None] => {
                return Err(format!("line {number}: node {i} is paired with itself").into());
            }
            _ => return Err(format!("line {number}: {PAIRS}").into()),
        }
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
    let paired = || pairs.iter().flat_map(|&(i, j)| [i, j]);
    let largest = paired().chain(alone.iter().copied()).max();
    let largest = largest.ok_or_else(|| Unreadable::from("the file holds no node".to_string()))?;
    let missing = |node: usize| {
        format!(
            "there is a node {largest}, but no node {node}: nodes are numbered from 0, without gaps"
        )
    };
    let nodes = largest as usize + 1;
    // As many are named at least, so that what is reserved is paid for by the file.
    let named = 2 * pairs.len() + alone.len();
    let mut is_there = vec![false; nodes.min(named)];
    for node in paired() {
        if let Some(there) = is_there.get_mut(node as usize) {
            *there = true;
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
