//! From labels to nodes: every label gets the place that it has among all of them.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::edge_list::fields::integer;
use crate::error::Problem;
use viewcert::graph::{Graph, GraphError, Labels};

/// How many pairs a core takes at least: fewer are not worth waking another one.
const SHARE: usize = 1 << 14;

/// Replaces both ends of all pairs.
fn replace(pairs: &mut [(u32, u32)], by: impl Fn(u32) -> u32 + Sync) {
    let pairs = pairs.par_iter_mut().with_min_len(SHARE);
    pairs.for_each(|(a, b)| (*a, *b) = (by(*a), by(*b)));
}

/// Replaces integers by their places among those that occur. Returns the
/// labels and their number.
pub(crate) fn number_integers(pairs: &mut [(u32, u32)], singles: &[u32]) -> (Labels, usize) {
    let largest = pairs.par_iter().with_min_len(SHARE).map(|&(a, b)| a.max(b));
    let largest = largest.max().into_iter().chain(singles.iter().copied());
    let largest = largest.max().unwrap_or(0);
    let ends = pairs.iter().flat_map(|&(a, b)| [a, b]);
    let ends = ends.chain(singles.iter().copied());
    // The bitmap takes 3/16 of a byte for every possible value: for values much
    // larger than their number it would outgrow the pairs.
    if largest as usize / 32 > 2 * pairs.len() + singles.len() + 1024 {
        let mut values: Vec<u32> = ends.collect();
        values.par_sort_unstable();
        values.dedup();
        replace(pairs, |value| {
            values.partition_point(|&other| other < value) as u32
        });
        return integers(values.into_iter().map(u64::from).collect());
    }
    let mut words = vec![0u64; largest as usize / 64 + 1];
    for value in ends {
        words[value as usize / 64] |= 1 << (value % 64);
    }
    let mut values = Vec::new();
    let mut before = Vec::with_capacity(words.len());
    for (&word, at) in words.iter().zip(0u64..) {
        before.push(values.len() as u32);
        let bits = (0..64).filter(|bit| word >> bit & 1 == 1);
        values.extend(bits.map(|bit| 64 * at + bit));
    }
    let (labels, nodes) = integers(values);
    match labels {
        Labels::Numbers { first: 0 } => {}
        Labels::Numbers { first } => replace(pairs, |value| value - first as u32),
        _ => replace(pairs, |value| {
            let at = value as usize / 64;
            before[at] + (words[at] & ((1 << (value % 64)) - 1)).count_ones()
        }),
    }
    (labels, nodes)
}

/// The graph of pairs of so many nodes with these labels, and how many pairs were there before.
///
/// # Errors
/// More nodes than can be numbered, a node paired with itself or out of range.
pub(crate) fn graph(
    pairs: Vec<(u32, u32)>,
    (labels, nodes): (&Labels, usize),
) -> Result<(Graph, usize), Problem> {
    let nodes = u32::try_from(nodes).map_err(|_| Problem::too_many_nodes())?;
    Graph::from_pairs(nodes, pairs).map_err(|error| match error {
        GraphError::SelfLoop(node) => Problem::self_loop(&labels.label(node)),
        GraphError::OutOfRange { .. } => Problem::corrupt(error),
    })
}

/// Labels of any kind, numbered in the order in which they came.
#[derive(Default)]
pub(crate) struct Index {
    pub(crate) nodes: HashMap<Box<str>, u32>,
}

impl Index {
    /// The node of a label, a new one if need be.
    ///
    /// # Errors
    /// Too many nodes.
    pub(crate) fn node(&mut self, label: &str) -> Result<u32, Problem> {
        if let Some(&node) = self.nodes.get(label) {
            return Ok(node);
        }
        let node = u32::try_from(self.nodes.len()).map_err(|_| Problem::too_many_nodes())?;
        self.nodes.insert(label.into(), node);
        Ok(node)
    }

    /// The labels in the order of their nodes.
    pub(crate) fn labels(&self) -> Vec<&str> {
        let mut labels = vec![""; self.nodes.len()];
        for (label, &node) in &self.nodes {
            labels[node as usize] = label;
        }
        labels
    }

    /// Renumbers the nodes by sorted labels. Returns the labels and their number.
    pub(crate) fn sort(self, pairs: &mut [(u32, u32)]) -> (Labels, usize) {
        let mut labels: Vec<(Box<str>, u32)> = self.nodes.into_iter().collect();
        let values: Option<Vec<u64>> = labels.iter().map(|(label, _)| integer(label)).collect();
        if values.is_some() {
            // Without leading zeros, the shorter integer is the smaller one.
            labels.sort_unstable_by(|(a, _), (b, _)| (a.len(), a).cmp(&(b.len(), b)));
        } else {
            labels.sort_unstable();
        }
        let mut place = vec![0; labels.len()];
        for (&(_, node), new) in labels.iter().zip(0..) {
            place[node as usize] = new;
        }
        replace(pairs, |node| place[node as usize]);
        let Some(mut values) = values else {
            let nodes = labels.len();
            let labels = labels.into_iter().map(|(label, _)| label);
            return (Labels::Names(labels.collect()), nodes);
        };
        values.sort_unstable();
        integers(values)
    }
}

/// The labels that are the given increasing integers, and their number.
fn integers(values: Vec<u64>) -> (Labels, usize) {
    let nodes = values.len();
    let labels = match (values.first(), values.last()) {
        (Some(&first), Some(&last)) if last - first == nodes as u64 - 1 => {
            Labels::Numbers { first }
        }
        _ => Labels::Integers(values),
    };
    (labels, nodes)
}
