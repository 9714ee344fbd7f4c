//! Lines of counts among pairs: how many cameras and pairs there are, with or without words for it.
//!
//! In: the pairs in the order of the lines, what the labels are, and the first line. Out: why one of
//! the lines is no pair. Few lists get beyond a look at their first, middle and last line.

use crate::edge_list::First;
use crate::edge_list::fields::is_number;
use crate::edge_list::heads::has_ending;
use crate::edge_list::nodes::Index;
use crate::error::Problem;

const FIRST: &str = "the first line counts nodes and lines, or is a pair like the others";
const FIRST_ADVICE: &str = "delete the line of counts; if it is a pair, say `--format edges`; if each line lists the neighbours of a node, as in METIS, convert it";
const LAST: &str = "the last line counts nodes and lines, or is a pair like the others";
const BESIDE_NAMES: &str = "one line has two numbers, and all others have names: counts, perhaps";
const WORDS: &str = "a line of words or of a word and a number stands beside lines of another kind: counts, perhaps, or \
     a title";
const ADVICE: &str = "delete that line; if it is a pair, say `--format edges`";

/// Fewer lines may well be such that their number is one of the labels.
const FEW: usize = 3;
/// More lines of words than that are no lines of counts.
const MOST_WORDS: usize = 4;

/// The pairs, and what is known about the lines that they come from.
pub(super) struct Lines<'a> {
    pub(super) pairs: &'a [(u32, u32)],
    pub(super) names: Option<&'a Index>,
    pub(super) first: &'a First,
    /// The first line is a head, whose names are known as those of pairs or not.
    pub(super) head: Option<bool>,
    /// Lines of pairs that were left out.
    pub(super) left_out: u64,
}

impl Lines<'_> {
    /// What is no pair, if there is such a line.
    pub(super) fn problem(&self) -> Option<Problem> {
        let (what, advice) = match () {
            () if self.first_counts() => (FIRST, FIRST_ADVICE),
            () if self.last_counts() => (LAST, ADVICE),
            () if self.is_beside_names() => (BESIDE_NAMES, ADVICE),
            () if self.has_words() => (WORDS, ADVICE),
            () => return None,
        };
        Some(Problem::Doubtful { what, advice })
    }

    /// The first pair as two numbers. Below a head that names pairs it is one.
    fn counts(&self) -> Option<[u64; 2]> {
        match (self.head, self.names) {
            (Some(true), _) | (Some(false), Some(_)) => None,
            (Some(false), None) => {
                let (a, b) = *self.pairs.first()?;
                Some([a.into(), b.into()])
            }
            (None, _) => {
                // Fields behind the counts say whether there are weights.
                let flags = |field: &str| {
                    (1..=3).contains(&field.len()) && field.bytes().all(|b| b == b'0' || b == b'1')
                };
                let further = self.first.names.get(2..).unwrap_or_default();
                let few = self.pairs.len() <= FEW;
                let alone = match further {
                    [] => true,
                    [flag] => flags(flag) && !few,
                    _ => false,
                };
                let labels = &self.first.labels;
                alone.then_some([digits(&labels[0])?, digits(&labels[1])?])
            }
        }
    }

    /// Whether the first of two numbers a line count nodes and other lines.
    fn first_counts(&self) -> bool {
        let (Some([x, y]), Some((_, others))) = (self.counts(), self.pairs.split_first()) else {
            return false;
        };
        let lines = others.len() as u64 + self.left_out;
        let few = others.len() < FEW;
        let (usual, reversed) = (y == lines, x == lines && x >= y && !few);
        let twice = lines.is_multiple_of(2) && lines / 2 == y && self.left_out == 0 && !few;
        if !(usual || reversed || twice) || !self.are_numbers() {
            return false;
        }
        let nodes = distinct(others.iter().flat_map(|&(a, b)| [a, b])) as u64;
        let unordered = |&(a, b): &(u32, u32)| (a.min(b), a.max(b));
        usual && x >= nodes
            || reversed && y == nodes && self.largest(others).is_none_or(|label| label <= y)
            || twice && x >= nodes && distinct(others.iter().map(unordered)) as u64 == y
    }

    /// Whether the last of two integers a line, which occur nowhere else, are the numbers of nodes and
    /// other lines.
    fn last_counts(&self) -> bool {
        let Some((&(x, y), others)) = self.pairs.split_last() else {
            return false;
        };
        if self.names.is_some() || others.len() < FEW || y as usize != others.len() {
            return false;
        }
        let ends = || others.iter().flat_map(|&(a, b)| [a, b]);
        ends().all(|end| end != x && end != y) && x as usize == distinct(ends())
    }

    /// Whether the first or the last line has two numbers, and all others have two other labels, two
    /// lines at least.
    fn is_beside_names(&self) -> bool {
        let (Some(names), [first, .., last]) = (self.names, self.pairs) else {
            return false;
        };
        let number = |label: &str| digits(label).is_some();
        let is_first = self.head.is_none() && self.first.labels.iter().all(|label| number(label));
        let all = names.nodes.len();
        // Labels that are met last are numbered last.
        let is_last = all >= 2 && (last.0 as usize, last.1 as usize) == (all - 2, all - 1);
        if self.pairs.len() < FEW || !(is_first || is_last) {
            return false;
        }
        let line = if is_first { first } else { last };
        let numbers = |node: &u32| *node == line.0 || *node == line.1;
        names.nodes.iter().all(|(label, node)| {
            number(label) == numbers(node) && !(is_named_number(label, number))
        }) && self
            .pairs
            .iter()
            .filter(|pair| numbers(&pair.0) || numbers(&pair.1))
            .count()
            == 1
    }

    /// Whether the first or the last lines have words that occur nowhere else, with another such or a
    /// number, and all other lines two numbers, or two names of files.
    fn has_words(&self) -> bool {
        let (Some(names), [first, .., last]) = (self.names, self.pairs) else {
            return false;
        };
        let middle = self.pairs[self.pairs.len() / 2];
        let kinds = kinds_of(
            names,
            [first.0, first.1, middle.0, middle.1, last.0, last.1],
        );
        let usual = kinds[2];
        let is_usual = |at: usize| kinds[at] == usual && kinds[at + 1] == usual;
        if usual == Kind::Word || !is_usual(2) || is_usual(0) && is_usual(4) {
            return false;
        }
        let mut kinds = vec![Kind::Word; names.nodes.len()];
        let mut letters = vec![false; kinds.len()];
        for (label, &node) in &names.nodes {
            kinds[node as usize] = Kind::of(label);
            letters[node as usize] = !label.bytes().any(|b| b.is_ascii_digit());
        }
        let kind = |node: u32| kinds[node as usize];
        let mut times = vec![0u32; kinds.len()];
        for &(a, b) in self.pairs {
            times[a as usize] += 1;
            times[b as usize] += 1;
        }
        let other = |node: u32| kind(node) == Kind::Word && times[node as usize] == 1;
        // `12b` is a camera beside `12`.
        let word = |node: u32| other(node) && letters[node as usize];
        let beside = |node: u32| other(node) || kind(node) == Kind::Number;
        let is_of_words = |&&(a, b): &&(u32, u32)| word(a) && beside(b) || word(b) && beside(a);
        let is_usual = |&&(a, b): &&(u32, u32)| kind(a) == usual && kind(b) == usual;
        let words = self.pairs.iter().filter(is_of_words).count();
        let usual = self.pairs.iter().filter(is_usual).count();
        (1..=MOST_WORDS).contains(&words) && usual >= 2 && words + usual == self.pairs.len()
    }

    /// Whether all labels are integers, but that those of the first line may have zeros before them.
    fn are_numbers(&self) -> bool {
        let first = &self.first.labels;
        self.names.is_none_or(|names| {
            let plain =
                |label: &str| digits(label).is_some() && (label == "0" || !label.starts_with('0'));
            let enough = self.pairs.len() > FEW;
            let padded = |label: &str| {
                enough && digits(label).is_some() && first.iter().any(|one| **one == *label)
            };
            names
                .nodes
                .keys()
                .all(|label| plain(label) || padded(label))
        })
    }

    /// The largest label of some pairs, if all are small integers.
    fn largest(&self, pairs: &[(u32, u32)]) -> Option<u64> {
        let ends = pairs.iter().flat_map(|&(a, b)| [a, b]).max();
        ends.filter(|_| self.names.is_none()).map(u64::from)
    }
}

/// A number that is a name as well: `3.5`, `-1`, `1e3`.
fn is_named_number(label: &str, number: impl Fn(&str) -> bool) -> bool {
    is_number(label.as_bytes()) && !number(label)
}

/// What a label looks like.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Number,
    File,
    Word,
}

impl Kind {
    fn of(label: &str) -> Self {
        match () {
            () if is_number(label.as_bytes()) => Self::Number,
            () if has_ending(label) => Self::File,
            () => Self::Word,
        }
    }
}

/// What the labels of some nodes look like.
fn kinds_of<const N: usize>(names: &Index, nodes: [u32; N]) -> [Kind; N] {
    let mut kinds = [Kind::Word; N];
    for (label, node) in &names.nodes {
        for (at, _) in nodes.iter().enumerate().filter(|(_, one)| *one == node) {
            kinds[at] = Kind::of(label);
        }
    }
    kinds
}

/// A natural number, also with zeros before it.
fn digits(label: &str) -> Option<u64> {
    let plain = label.bytes().all(|b| b.is_ascii_digit());
    label.parse().ok().filter(|_| plain)
}

/// How many different ones there are. O(k log k).
fn distinct<T: Ord>(values: impl Iterator<Item = T>) -> usize {
    let mut values: Vec<T> = values.collect();
    values.sort_unstable();
    values.dedup();
    values.len()
}
