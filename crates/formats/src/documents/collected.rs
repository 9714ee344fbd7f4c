//! Nodes and pairs as they are met, and the graph that they make.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::edge_list::PAIR_LIMIT;
use crate::edge_list::columns::ListOptions;
use crate::edge_list::nodes::Index;
use crate::edge_list::refusal::shown;
use crate::error::{Fault, Place, Problem};
use crate::read_as::{Parsed, ReadAs};
use viewcert::graph::{Graph, GraphError};
use viewcert::wording::counted;

/// How many names of what is ignored a note holds.
const MOST_NAMES: usize = 6;

/// The part of a graph that has been read.
#[derive(Default)]
pub(crate) struct Collected {
    index: Index,
    pairs: Vec<(u32, u32)>,
    /// Of every node, whether it is listed as such and not only the end of a pair.
    listed: Vec<bool>,
    listed_again: usize,
    directed: bool,
    /// Whether pairs of a node with itself are left out, and how many were.
    skip_loops: bool,
    loops: usize,
    ignored: BTreeSet<String>,
    /// What nodes are called by an attribute, for each of [`NAMES`].
    names: [BTreeMap<u32, String>; 2],
    pub(crate) notes: Vec<String>,
}

/// Attributes that name nodes, the better one first.
pub(super) const NAMES: [&str; 2] = ["label", "name"];

impl Collected {
    /// Nothing so far.
    pub(crate) fn new(options: &ListOptions) -> Self {
        Self {
            skip_loops: options.skip_loops,
            ..Self::default()
        }
    }

    /// The node of a label, a new one if need be.
    ///
    /// # Errors
    /// A label that is empty or has control characters; too many nodes.
    pub(crate) fn node(&mut self, label: &str) -> Result<u32, Problem> {
        if label.is_empty() {
            return Err(Problem::new(
                "a camera has an empty name",
                "give it another name",
            ));
        }
        if label.chars().any(char::is_control) {
            return Err(Problem::new(
                format!(
                    "the name \"{}\" has a control character",
                    shown(&label.escape_debug().to_string())
                ),
                "give it another name",
            ));
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
    pub(crate) fn list(&mut self, label: &str) -> Result<u32, Problem> {
        let node = self.node(label)?;
        let listed = &mut self.listed[node as usize];
        self.listed_again += usize::from(*listed);
        *listed = true;
        Ok(node)
    }

    /// The node of a label, if it has been met.
    pub(crate) fn find(&self, label: &str) -> Option<u32> {
        self.index.nodes.get(label).copied()
    }

    /// Takes in a pair. One with itself may be left out; the node stays.
    ///
    /// # Errors
    /// A node with itself; too many pairs.
    pub(crate) fn pair(&mut self, a: u32, b: u32) -> Result<(), Problem> {
        if a == b && self.skip_loops {
            self.loops += 1;
            return Ok(());
        }
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
    pub(crate) fn directed(&mut self) {
        self.directed = true;
    }

    /// An attribute, or the like, that is of no concern.
    pub(crate) fn ignore(&mut self, name: &str) {
        if !self.ignored.contains(name) {
            self.ignored.insert(name.to_owned());
        }
    }

    /// What an attribute, one of [`NAMES`], calls a node.
    pub(super) fn name(&mut self, attribute: &str, node: u32, name: String) {
        if let Some(at) = NAMES.iter().position(|known| *known == attribute) {
            self.names[at].insert(node, name);
        }
    }

    /// Calls nodes by the first attribute that names them all, and each differently.
    fn rename(&mut self) {
        let mut renamed = false;
        for (attribute, names) in NAMES.into_iter().zip(std::mem::take(&mut self.names)) {
            if names.is_empty() {
                continue;
            }
            if renamed {
                self.ignore(attribute);
                continue;
            }
            match self.index_of(&names) {
                Ok(nodes) if nodes == self.index.nodes => renamed = true,
                Ok(nodes) => {
                    let note =
                        format!("nodes are called by their `{attribute}`, and not by their ids");
                    self.notes.push(note);
                    self.index.nodes = nodes;
                    renamed = true;
                }
                Err(why) => self.notes.push(format!(
                    "nodes are called by their ids, and not by their `{attribute}`: {why}"
                )),
            }
        }
    }

    /// The nodes by these names, or why they are none.
    fn index_of(&self, names: &BTreeMap<u32, String>) -> Result<HashMap<Box<str>, u32>, String> {
        if names.len() < self.listed.len() {
            let without = counted(self.listed.len() - names.len(), "node");
            return Err(format!("{without} without any"));
        }
        let mut nodes = HashMap::new();
        for (&node, name) in names {
            if name.is_empty() || name.chars().any(char::is_control) {
                return Err("some are empty, or have control characters".to_owned());
            }
            if nodes.insert(name.as_str().into(), node).is_some() {
                return Err(format!("several are called {}", short(name)));
            }
        }
        Ok(nodes)
    }

    /// The graph, its labels, and notes.
    ///
    /// # Errors
    /// If there are no nodes.
    pub(crate) fn finish(mut self) -> Result<Parsed, Fault> {
        self.rename();
        let fault = |problem| Place::Input.fault(problem);
        let Self {
            index,
            mut pairs,
            listed,
            listed_again,
            directed,
            skip_loops: _,
            loops,
            ignored,
            mut notes,
            names: _,
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
        if loops > 0 {
            let pairs = counted(loops, "pair");
            read.ignored
                .push(format!("{pairs} of a camera with itself"));
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
