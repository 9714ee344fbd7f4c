//! Nodes and pairs as they are met, and the graph that they make.

use std::collections::BTreeSet;

use crate::edge_list::PAIR_LIMIT;
use crate::edge_list::nodes::Index;
use crate::error::{Fault, Place, Problem};
use crate::read_as::{Parsed, ReadAs};
use viewcert::graph::{Graph, GraphError};
use viewcert::wording::counted;

/// How many names of what is ignored a note holds.
const MOST_NAMES: usize = 6;

/// The part of a graph that has been read.
#[derive(Default)]
pub(super) struct Collected {
    index: Index,
    pairs: Vec<(u32, u32)>,
    /// Of every node, whether it is listed as such and not only the end of a pair.
    listed: Vec<bool>,
    listed_again: usize,
    directed: bool,
    ignored: BTreeSet<String>,
    pub(super) notes: Vec<String>,
}

impl Collected {
    /// The node of a label, a new one if need be.
    ///
    /// # Errors
    /// A label that is empty or has control characters; too many nodes.
    pub(super) fn node(&mut self, label: &str) -> Result<u32, Problem> {
        if label.is_empty() {
            return Err(Problem::EmptyLabel);
        }
        if label.chars().any(char::is_control) {
            return Err(Problem::ControlInLabel(label.escape_debug().to_string()));
        }
        let node = self.index.node(label).ok_or(Problem::TooManyNodes)?;
        if node as usize == self.listed.len() {
            self.listed.push(false);
        }
        Ok(node)
    }

    /// The node of a label that stands in a list of nodes.
    ///
    /// # Errors
    /// Those of [`Collected::node`].
    pub(super) fn list(&mut self, label: &str) -> Result<u32, Problem> {
        let node = self.node(label)?;
        let listed = &mut self.listed[node as usize];
        self.listed_again += usize::from(*listed);
        *listed = true;
        Ok(node)
    }

    /// The node of a label, if it has been met.
    pub(super) fn find(&self, label: &str) -> Option<u32> {
        self.index.nodes.get(label).copied()
    }

    /// Takes in a pair.
    ///
    /// # Errors
    /// A node with itself; too many pairs.
    pub(super) fn pair(&mut self, a: u32, b: u32) -> Result<(), Problem> {
        if a == b {
            let label = self.index.labels().swap_remove(a as usize);
            return Err(Problem::SelfLoop(label.into()));
        }
        if self.pairs.len() >= PAIR_LIMIT {
            return Err(Problem::TooManyPairs);
        }
        self.pairs.push((a, b));
        Ok(())
    }

    /// The graph is, or has edges that are, directed.
    pub(super) fn directed(&mut self) {
        self.directed = true;
    }

    /// An attribute, or the like, that is of no concern.
    pub(super) fn ignore(&mut self, name: &str) {
        if !self.ignored.contains(name) {
            self.ignored.insert(name.to_owned());
        }
    }

    /// The graph, its labels, and notes.
    ///
    /// # Errors
    /// If there are no nodes.
    pub(super) fn finish(self) -> Result<Parsed, Fault> {
        let fault = |problem| Place::Input.fault(problem);
        let Self {
            index,
            mut pairs,
            listed,
            listed_again,
            directed,
            ignored,
            mut notes,
        } = self;
        if listed.is_empty() {
            return Err(fault(Problem::NoNodes));
        }
        let (labels, nodes) = index.sort(&mut pairs);
        let nodes = u32::try_from(nodes).map_err(|_| fault(Problem::TooManyNodes))?;
        // Neither refusal happens: pairs were refused one by one, and all ends were numbered.
        let (graph, merged) = Graph::from_pairs(nodes, pairs).map_err(|error| match error {
            GraphError::SelfLoop(node) => fault(Problem::SelfLoop(labels.label(node).into())),
            GraphError::OutOfRange { .. } => fault(Problem::TooManyNodes),
        })?;
        let mut read = ReadAs {
            merged,
            ..ReadAs::default()
        };
        if directed {
            read.ignored.push("directions".to_owned());
            notes.push("the graph is directed, and directions are ignored".to_owned());
        }
        if !ignored.is_empty() {
            let names = names(&ignored);
            read.ignored.push(format!("attributes ({names})"));
            notes.push(format!("attributes are ignored: {names}"));
        }
        let only_in_pairs = listed.iter().filter(|listed| !**listed).count();
        if only_in_pairs > 0 && only_in_pairs < listed.len() {
            let (nodes, are) = (counted(only_in_pairs, "node"), are(only_in_pairs));
            notes.push(format!(
                "{nodes} {are} in pairs and not in the list of nodes"
            ));
        }
        if listed_again > 0 {
            let (nodes, are) = (counted(listed_again, "node"), are(listed_again));
            notes.push(format!("{nodes} {are} listed again, and merged"));
        }
        notes.extend(crate::merged(merged));
        Ok(Parsed {
            graph,
            labels,
            read,
            notes,
        })
    }
}

fn are(count: usize) -> &'static str {
    if count == 1 { "is" } else { "are" }
}

/// The first names of a set.
fn names(set: &BTreeSet<String>) -> String {
    let shown: Vec<String> = set
        .iter()
        .take(MOST_NAMES)
        .map(|name| short(name))
        .collect();
    let shown = shown.join(", ");
    match set.len().checked_sub(MOST_NAMES) {
        None | Some(0) => shown,
        Some(more) => format!("{shown} and {more} more"),
    }
}

/// A name in a note: without control characters, and not long.
fn short(name: &str) -> String {
    const MOST: usize = 40;
    let mut shown: String = name.escape_debug().take(MOST).collect();
    if name.chars().count() > MOST {
        shown.push_str("...");
    }
    shown
}
