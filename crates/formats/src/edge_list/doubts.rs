//! Texts that have the form of an edge list and could be something else.
//!
//! What is watched line by line is little, and only while it can still matter; the rest is
//! settled when all pairs are there.

use std::collections::HashSet;

use crate::edge_list::First;
use crate::edge_list::fields::is_number;
use crate::edge_list::heads;
use crate::edge_list::nodes::Index;
use crate::edge_list::triangles::Triangles;
use crate::error::Problem;

const MATRIX: &str = "it could be an adjacency matrix";
const MATRIX_ADVICE: &str = "write one pair a line, or a MatrixMarket or MATLAB file; if it is an edge list, say `--format edges`";
const STARS: &str =
    "it could be an adjacency list or a list of stars as well as pairs with weights";
const STARS_ADVICE: &str =
    "write one pair a line; if the third column is of no concern, say `--format edges`";
const TRIANGLES: &str = "every third field is a label as well: three cameras a line, as in triangles or lists of neighbours, \
     or pairs with weights";
const TRIVIAL_GRAPH: &str =
    "it could be in the Trivial Graph Format: nodes, a line `#`, and pairs of these nodes";
const TRIVIAL_GRAPH_ADVICE: &str =
    "keep the lines behind the `#`; if all lines are pairs, say `--format edges`";
const POINTS: &str =
    "all labels are numbers, and not all of them integers: these could be coordinates";
const POINTS_ADVICE: &str =
    "write one pair a line; if the numbers are labels, say `--format edges`";

/// What has been seen so far.
#[derive(Default)]
pub(super) struct Doubts {
    has_head: bool,
    has_quotes: bool,
    /// Some field of the first lines is neither 0 nor 1.
    no_bits: bool,
    /// Some line has no third integer above the first two.
    no_stars: bool,
    /// Some line is not one of an adjacency list.
    no_neighbours: bool,
    triangles: Triangles,
    largest_second: u64,
    largest_third: u64,
    /// First and third labels of the lines while they could be an adjacency list.
    ends: Vec<[u64; 3]>,
    /// How many pairs stand before the line `#`; none if there are several such lines.
    hash: Option<Option<usize>>,
}

impl Doubts {
    /// The first line is a head.
    pub(super) fn head(&mut self) {
        self.has_head = true;
    }

    /// What could have been a head is the first pair.
    pub(super) fn one_more(&mut self) {
        // Its labels are no numbers.
        self.no_bits = true;
        self.third(None, None);
        if let Some(Some(pairs)) = &mut self.hash {
            *pairs += 1;
        }
    }

    /// Whether a line has labels in quotes.
    pub(super) fn quotes(&mut self, quotes: bool) {
        self.has_quotes |= quotes;
    }

    /// Whether some line had labels in quotes.
    pub(super) fn has_quotes(&self) -> bool {
        self.has_quotes
    }

    /// A line that is nothing but `#`, after so many pairs.
    pub(super) fn lone_hash(&mut self, pairs: usize) {
        self.hash = Some(match self.hash {
            None => Some(pairs),
            Some(_) => None,
        });
    }

    /// One of the first lines, and whether all its fields are 0 or 1.
    pub(super) fn short_line(&mut self, bits: bool) {
        self.no_bits |= !bits;
    }

    /// Whether third fields still matter.
    #[inline]
    pub(super) fn watch_thirds(&self) -> bool {
        !(self.no_stars && self.no_neighbours) || self.triangles.watch()
    }

    /// The labels and the third field of a line, as far as they are integers.
    pub(super) fn third(&mut self, ends: Option<[u64; 2]>, third: Option<u64>) {
        let (Some([a, b]), Some(c)) = (ends, third) else {
            self.no_stars = true;
            self.drop_neighbours();
            self.triangles.line(None);
            return;
        };
        self.triangles.line(Some([a, b, c]));
        self.no_stars |= a >= b || b >= c;
        self.largest_second = self.largest_second.max(a).max(b);
        self.largest_third = self.largest_third.max(c);
        if !self.no_neighbours {
            if c == a || c == b || self.ends.last().is_some_and(|last| last[0] >= a) {
                self.drop_neighbours();
            } else {
                self.ends.push([a, b, c]);
            }
        }
    }

    fn drop_neighbours(&mut self) {
        self.no_neighbours = true;
        self.ends = Vec::new();
    }

    /// What else the text could be, if anything. The pairs are in the order of the lines.
    pub(super) fn settle(
        &self,
        pairs: &[(u32, u32)],
        names: Option<&Index>,
        first: &First,
    ) -> Option<Problem> {
        let doubt = |what, advice| Some(Problem::Doubtful { what, advice });
        if pairs.is_empty() {
            return None;
        }
        let plain = !self.has_head && !self.has_quotes;
        if plain && !self.no_bits && pairs.len() == first.columns {
            return doubt(MATRIX, MATRIX_ADVICE);
        }
        // Names of columns may say what the third one holds.
        let weighs = self.has_head && heads::name_weights(&first.names);
        if !self.has_quotes && !weighs && first.names.len() == 3 {
            let near = self.largest_third <= self.largest_second.saturating_add(1);
            if !self.no_stars && near || !self.no_neighbours && self.lists_neighbours() {
                return doubt(STARS, STARS_ADVICE);
            }
            if self
                .triangles
                .are_there(|labels| are_labels(labels, pairs, names))
            {
                return doubt(TRIANGLES, STARS_ADVICE);
            }
        }
        if let Some(Some(before)) = self.hash
            && trivial_graph(pairs, before)
        {
            return doubt(TRIVIAL_GRAPH, TRIVIAL_GRAPH_ADVICE);
        }
        let names = names?;
        if !self.has_quotes && coordinates(names) {
            return doubt(POINTS, POINTS_ADVICE);
        }
        None
    }

    /// Whether each line lists both neighbours of its first node: then every neighbour has a
    /// line that lists the node in turn.
    fn lists_neighbours(&self) -> bool {
        let lines = &self.ends;
        let lists = |node: u64, neighbour: u64| {
            lines
                .binary_search_by_key(&node, |line| line[0])
                .is_ok_and(|at| lines[at][1..].contains(&neighbour))
        };
        lines.iter().all(|&[a, b, c]| lists(b, a) && lists(c, a))
    }
}

/// Whether different nodes stand first in the pairs `before` a line `#`, and all later pairs are
/// of these.
fn trivial_graph(pairs: &[(u32, u32)], before: usize) -> bool {
    let (nodes, pairs) = pairs.split_at(before);
    let mut nodes: Vec<u32> = nodes.iter().map(|pair| pair.0).collect();
    let given = nodes.len();
    nodes.sort_unstable();
    nodes.dedup();
    let listed = |node: u32| nodes.binary_search(&node).is_ok();
    !pairs.is_empty()
        && given > 0
        && nodes.len() == given
        && pairs.iter().all(|&(a, b)| listed(a) && listed(b))
}

/// Whether all of some integers stand in the pairs.
fn are_labels(integers: &[u64], pairs: &[(u32, u32)], names: Option<&Index>) -> bool {
    if let Some(names) = names {
        let is_label = |value: &u64| names.nodes.contains_key(&*value.to_string());
        return integers.iter().all(is_label);
    }
    let mut wanted: HashSet<u64> = integers.iter().copied().collect();
    for &(a, b) in pairs {
        wanted.remove(&a.into());
        wanted.remove(&b.into());
        if wanted.is_empty() {
            return true;
        }
    }
    wanted.is_empty()
}

/// Whether all labels are numbers, some of them with a fraction or an exponent.
fn coordinates(names: &Index) -> bool {
    let fraction = |label: &str| label.contains(['.', 'e', 'E']);
    names.nodes.keys().all(|label| is_number(label.as_bytes()))
        && names.nodes.keys().any(|label| fraction(label))
}
