//! Known parts of a graph, and files of them (section 2 of the specification).

use super::Graph;
use super::file::{fields, lines_of_numbers};
use crate::rejection::{Unreadable, ensure};

impl Graph {
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

const PARTS: &str = "a line is two node numbers or more, with a single blank or tab between them \
                     (`verify convert --parts` writes such a file)";

#[cfg(test)]
mod tests;
