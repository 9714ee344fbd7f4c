//! Nodes and pairs as they are met, and the graph that they make.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::edge_list::PAIR_LIMIT;
use crate::edge_list::columns::ListOptions;
use crate::edge_list::nodes::{self, Index};
use crate::edge_list::refusal::shown;
use crate::error::{Fault, Problem};
use crate::read_as::{Parsed, ReadAs};
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
        if label.is_empty() || label.chars().any(char::is_control) {
            let shown = shown(&label.escape_debug().to_string());
            let what = format!("the name \"{shown}\" is empty, or has a control character");
            return Err(Problem::new(what, "give it another name"));
        }
        let node = self.index.node(label)?;
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
        self.listed[node as usize] = true;
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
            let label = self.index.labels()[a as usize];
            return Err(Problem::self_loop(label));
        }
        if self.pairs.len() >= PAIR_LIMIT {
            return Err(Problem::too_many_pairs());
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
        self.ignored.insert(name.to_owned());
    }

    /// What the attribute at a place of [`NAMES`] calls a node.
    pub(super) fn name(&mut self, at: usize, node: u32, name: &str) {
        self.names[at].insert(node, name.to_owned());
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
            let note = match self.index_of(&names) {
                Ok(nodes) => {
                    renamed = true;
                    let is_same = nodes == self.index.nodes;
                    self.index.nodes = nodes;
                    if is_same {
                        continue;
                    }
                    format!("nodes are called by their `{attribute}`, and not by their ids")
                }
                Err(why) => {
                    format!("nodes are called by their ids, and not by their `{attribute}`: {why}")
                }
            };
            self.notes.push(note);
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
                return Err(format!("several are called {}", shown(name)));
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
        if self.listed.is_empty() {
            return Err(Problem::no_nodes().into());
        }
        let (mut pairs, mut notes) = (self.pairs, self.notes);
        let (labels, nodes) = self.index.sort(&mut pairs);
        let (graph, merged) = nodes::graph(pairs, (&labels, nodes))?;
        let mut read = ReadAs {
            merged,
            ..ReadAs::default()
        };
        if self.directed {
            read.ignored.push("directions".to_owned());
            notes.push("the graph is directed, and directions are ignored".to_owned());
        }
        if !self.ignored.is_empty() {
            let short = self.ignored.iter().take(MOST_NAMES);
            let short = short.map(|name| shown(&name.escape_debug().to_string()));
            let mut names = short.collect::<Vec<_>>().join(", ");
            if let more @ 1.. = self.ignored.len().saturating_sub(MOST_NAMES) {
                names += &format!(" and {more} more");
            }
            read.ignored.push(format!("attributes ({names})"));
            notes.push(format!("attributes are ignored: {names}"));
        }
        if self.loops > 0 {
            let pairs = counted(self.loops, "pair");
            read.ignored
                .push(format!("{pairs} of a camera with itself"));
        }
        let listed = self.listed.iter().filter(|listed| **listed).count();
        let others = self.listed.len() - listed;
        if others > 0 && listed > 0 {
            let are = if others == 1 { "is" } else { "are" };
            let nodes = counted(others, "node");
            notes.push(format!(
                "{nodes} {are} in pairs and not in the list of nodes"
            ));
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
