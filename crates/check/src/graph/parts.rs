//! Files of known parts, and their canonical form (section 2 of the specification).

use super::edge_list::{integer, next_line, split};
use super::{Graph, file};
use crate::rejection::{Unreadable, ensure};
use std::collections::HashMap;

/// What the nodes of a graph are called in the file it was read from.
#[derive(Clone, Debug)]
pub enum Labels {
    /// The numbers of the nodes: in graph6, or where there is no file.
    Numbers,
    /// The labels of an edge list.
    Names(HashMap<Vec<u8>, u32>),
}

impl Labels {
    fn node(&self, label: &[u8], nodes: usize) -> Option<u32> {
        match self {
            Labels::Numbers => {
                let node = u32::try_from(integer(label)?).ok()?;
                ((node as usize) < nodes).then_some(node)
            }
            Labels::Names(names) => names.get(label).copied(),
        }
    }
}

const READABLE: &str = "known parts are lines of labels";

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

    /// The same graph with the known parts of a file, whose labels are those of the graph's own.
    ///
    /// # Errors
    /// What is wrong with the file, with the line.
    pub fn with_parts_of(self, file: &[u8], labels: &Labels) -> Result<Graph, Unreadable> {
        let mut rest = file::text(file, READABLE)?;
        let (mut parts, mut number, mut fields) = (Vec::new(), 0, Vec::new());
        while !rest.is_empty() {
            number += 1;
            split(next_line(&mut rest), true, &mut fields)
                .map_err(|reason| format!("line {number}: {reason}"))?;
            let mut part = Vec::new();
            for field in &fields {
                let node = labels.node(&field.text, self.nodes());
                part.push(node.ok_or_else(|| {
                    let label = String::from_utf8_lossy(&field.text);
                    Unreadable::from(format!("line {number}: `{label}` is no node of the graph"))
                })?);
            }
            parts.extend((!part.is_empty()).then_some(part));
        }
        ensure!(!parts.is_empty(), "the file holds no known part");
        self.with_parts(parts)
    }
}

#[cfg(test)]
mod tests;
