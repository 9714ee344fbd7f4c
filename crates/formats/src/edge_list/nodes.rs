//! From labels to nodes: every label gets the place that it has among all of them.

use std::collections::HashMap;
use std::fmt::Write;

use rayon::prelude::*;

use crate::edge_list::fields::integer;
use viewcert::graph::Labels;

/// How many pairs a core takes at least: fewer are not worth waking another one.
const SHARE: usize = 1 << 14;

/// Replaces integers by their places among those that occur. Returns the
/// labels and their number.
pub(crate) fn number_integers(pairs: &mut [(u32, u32)], singles: &[u32]) -> (Labels, usize) {
    let shares = pairs.par_chunks(SHARE);
    let largest = shares.filter_map(|share| share.iter().map(|&(a, b)| a.max(b)).max());
    let largest = largest.max();
    let largest = largest.into_iter().chain(singles.iter().copied()).max();
    let largest = largest.unwrap_or(0);
    let given = 2 * pairs.len() + singles.len();
    // The bitmap takes 3/16 of a byte for every possible value: for values much
    // larger than their number it would outgrow the pairs.
    if largest as usize / 32 > given + 1024 {
        return number_far_apart(pairs, singles);
    }
    let words = occurring(pairs, singles, largest);
    let mut count = 0;
    let before: Vec<u32> = words
        .iter()
        .map(|word| {
            let before = count;
            count += word.count_ones();
            before
        })
        .collect();
    let nodes = count as usize;
    let values = || {
        words.iter().zip(0u64..).flat_map(|(&word, at)| {
            (0..64)
                .filter(move |bit| word >> bit & 1 == 1)
                .map(move |bit| 64 * at + bit)
        })
    };
    let first = values().next().unwrap_or(0);
    if u64::from(largest) - first + 1 == nodes as u64 {
        let first_value = first as u32;
        if first_value > 0 {
            pairs.par_chunks_mut(SHARE).for_each(|share| {
                for (a, b) in share {
                    *a -= first_value;
                    *b -= first_value;
                }
            });
        }
        return (Labels::Numbers { first }, nodes);
    }
    let rank = |value: u32| {
        let at = value as usize / 64;
        before[at] + (words[at] & ((1 << (value % 64)) - 1)).count_ones()
    };
    pairs.par_chunks_mut(SHARE).for_each(|share| {
        for (a, b) in share {
            *a = rank(*a);
            *b = rank(*b);
        }
    });
    let mut integers = Vec::with_capacity(nodes);
    integers.extend(values());
    (Labels::Integers(integers), nodes)
}

/// Which of the integers up to the largest occur, a bit for each.
fn occurring(pairs: &[(u32, u32)], singles: &[u32], largest: u32) -> Vec<u64> {
    let mut words = vec![0u64; largest as usize / 64 + 1];
    let ends = pairs.iter().flat_map(|&(a, b)| [a, b]);
    for value in ends.chain(singles.iter().copied()) {
        words[value as usize / 64] |= 1 << (value % 64);
    }
    words
}

/// As [`number_integers`], for integers that lie far apart: sorts them and looks each up.
fn number_far_apart(pairs: &mut [(u32, u32)], singles: &[u32]) -> (Labels, usize) {
    let ends = pairs.iter().flat_map(|&(a, b)| [a, b]);
    let mut values: Vec<u32> = ends.chain(singles.iter().copied()).collect();
    values.par_sort_unstable();
    values.dedup();
    pairs.par_chunks_mut(SHARE).for_each(|share| {
        for (a, b) in share {
            let rank = |value: u32| values.partition_point(|&other| other < value) as u32;
            (*a, *b) = (rank(*a), rank(*b));
        }
    });
    let nodes = values.len();
    let values = values.into_iter().map(u64::from).collect();
    (integers(values), nodes)
}

/// Replaces integers by numbers in the order in which they are met. Returns
/// the number of every integer.
fn number_as_met(pairs: &mut [(u32, u32)], singles: &mut [u32]) -> HashMap<u32, u32> {
    let mut nodes = HashMap::new();
    let mut number = |value: &mut u32| {
        let next = nodes.len() as u32;
        *value = *nodes.entry(*value).or_insert(next);
    };
    for (a, b) in pairs {
        number(a);
        number(b);
    }
    singles.iter_mut().for_each(number);
    nodes
}

/// Gives the nodes listed the numbers 0, 1, ... in the order of the list.
fn renumber(pairs: &mut [(u32, u32)], nodes: impl ExactSizeIterator<Item = u32>) {
    let mut place = vec![0; nodes.len()];
    for (node, new) in nodes.zip(0..) {
        place[node as usize] = new;
    }
    for (a, b) in pairs {
        *a = place[*a as usize];
        *b = place[*b as usize];
    }
}

/// Labels of any kind, numbered in the order in which they came.
#[derive(Default)]
pub(crate) struct Index {
    pub(crate) nodes: HashMap<Box<str>, u32>,
}

impl Index {
    /// The index of pairs of integers, which become node numbers.
    pub(crate) fn of_integers(pairs: &mut [(u32, u32)], singles: &mut [u32]) -> Self {
        let nodes = number_as_met(pairs, singles);
        let mut text = String::new();
        let name = |(value, node): (u32, u32)| {
            text.clear();
            // Writing to a string does not fail.
            let _ = write!(text, "{value}");
            (Box::from(text.as_str()), node)
        };
        Self {
            nodes: nodes.into_iter().map(name).collect(),
        }
    }

    /// The node of a label, a new one if need be; `None` if there are too many.
    pub(crate) fn node(&mut self, label: &str) -> Option<u32> {
        if let Some(&node) = self.nodes.get(label) {
            return Some(node);
        }
        let node = u32::try_from(self.nodes.len()).ok()?;
        self.nodes.insert(label.into(), node);
        Some(node)
    }

    /// The labels in the order of their nodes.
    pub(crate) fn labels(&self) -> Vec<Box<str>> {
        let mut labels: Vec<_> = self.nodes.iter().collect();
        labels.sort_unstable_by_key(|&(_, node)| node);
        labels.into_iter().map(|(label, _)| label.clone()).collect()
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
        let nodes = labels.len();
        renumber(pairs, labels.iter().map(|&(_, node)| node));
        let labels = match values {
            Some(mut values) => {
                values.sort_unstable();
                integers(values)
            }
            None => Labels::Names(labels.into_iter().map(|(label, _)| label).collect()),
        };
        (labels, nodes)
    }
}

/// The labels that are the given increasing integers.
fn integers(values: Vec<u64>) -> Labels {
    match (values.first(), values.last()) {
        (Some(&first), Some(&last)) if last - first == values.len() as u64 - 1 => {
            Labels::Numbers { first }
        }
        _ => Labels::Integers(values),
    }
}
