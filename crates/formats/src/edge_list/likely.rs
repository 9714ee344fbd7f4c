//! Whether a list that nothing names as one of pairs is likely to be one.
//!
//! Two columns of numbers, or of words, are much that is no graph: what things are called, how often they
//! occur, where features lie. So what a list of pairs of cameras hardly ever is gets refused.

use std::collections::HashSet;

use rayon::prelude::*;

use super::names::{are_alike, is_image, shape};
use crate::error::Problem;

/// So many of the first pairs are looked at; where they leave a doubt, all.
const MOST: usize = 1 << 16;

const ONCE: &str = "as a table with a line for each thing has";

/// A list of pairs, as far as it has been understood.
pub(super) struct List<'a> {
    /// Two integers each, or numbers of `labels` or `values`.
    pub(super) pairs: &'a [(u32, u32)],
    /// Names; none if all labels are integers.
    pub(super) labels: Option<&'a [&'a str]>,
    /// Integers, if some are long or begin with zeros.
    pub(super) values: Option<Vec<u64>>,
    /// Lines that pair a label with itself.
    pub(super) loops: &'a [(u64, Box<str>)],
    /// How many lines have been left out.
    pub(super) left_out: u64,
    /// The third fields of the first pairs, where they are integers.
    pub(super) thirds: &'a [Option<u32>],
    pub(super) width: usize,
}

impl List<'_> {
    /// What speaks against pairs of cameras.
    pub(super) fn doubt(&self) -> Option<Problem> {
        // The first pairs of a long list may have few cameras in common, as those of a random graph have.
        let first = &self.pairs[..self.pairs.len().min(MOST)];
        self.doubt_of(first)
            .and_then(|doubt| match first.len() < self.pairs.len() {
                true => self.doubt_of(self.pairs),
                false => Some(doubt),
            })
    }

    fn doubt_of(&self, pairs: &[(u32, u32)]) -> Option<Problem> {
        let Some(&(a, b)) = pairs.first() else {
            let only = Problem::table("all lines pair a label with itself: a table, perhaps");
            return Some(only).filter(|_| !self.loops.is_empty());
        };
        let is_first = |pair: &(u32, u32)| [(a, b), (b, a)].contains(pair);
        if pairs.len() + self.loops.len() > 1 && pairs.iter().all(is_first) {
            return Some(Problem::table(
                "all pairs are of the same two labels: a table, perhaps",
            ));
        }
        let counted = match self.labels {
            Some(_) => None,
            None => self.of_pandas(pairs).or_else(|| self.counts()),
        };
        counted.or_else(|| self.stands_apart()).or_else(|| {
            let what = match self.labels {
                Some(labels) => self.of_names(pairs, labels),
                None => self.of_integers(pairs),
            };
            what.map(Problem::table)
        })
    }

    fn integer(&self, end: u32) -> u64 {
        let values = self.values.as_ref();
        values.map_or(end.into(), |values| values[end as usize])
    }

    /// A line in a refusal, which is no pair.
    fn odd(&self, place: &str, (a, b): (u32, u32), what: &str) -> Problem {
        let label = |end: u32| match self.labels {
            Some(labels) => labels[end as usize].to_owned(),
            None => self.integer(end).to_string(),
        };
        Problem::odd(place, &format!("{} {}", label(a), label(b)), what)
    }

    /// A first line whose labels are in no other line, or a last one below names.
    pub(super) fn stands_apart(&self) -> Option<Problem> {
        let what = "may be a head or counts: its labels are in no other line";
        let is_apart = |(a, b): (u32, u32), others: &[(u32, u32)]| {
            let images = |labels: &[&str]| [a, b].iter().all(|&end| is_image(labels[end as usize]));
            let known = |&(c, d): &(u32, u32)| [a, b].contains(&c) || [a, b].contains(&d);
            others.len() > 1 && !self.labels.is_some_and(images) && !others.iter().any(known)
        };
        let (&first, below) = self.pairs.split_first()?;
        if is_apart(first, below) {
            return Some(self.odd("first", first, what));
        }
        let (&last, above) = self.pairs.split_last()?;
        let is_odd = self.labels.is_some() && self.left_out == 0 && is_apart(last, above);
        is_odd.then(|| self.odd("last", last, what))
    }

    /// The numbers of columns as pandas writes them above tables without names: of two only where nothing but
    /// this line has the 0.
    fn of_pandas(&self, pairs: &[(u32, u32)]) -> Option<Problem> {
        let (&(a, b), below) = pairs.split_first()?;
        // A third column makes it sure enough.
        let three = self.width == 3 && self.thirds.first() == Some(&Some(2));
        let numbered = (self.integer(a), self.integer(b)) == (0, 1) && (three || self.width == 2);
        let is_alone = three || below.iter().all(|&(c, d)| c != a && d != a);
        let what = "may be the numbers of the columns as pandas writes them";
        (numbered && is_alone && !below.is_empty() && !is_chain(pairs))
            .then(|| self.odd("first", (a, b), what))
    }

    /// The numbers of nodes and pairs, above or below these.
    fn counts(&self) -> Option<Problem> {
        let lines = self.pairs.len() as u64 + self.left_out - 1;
        let is_count = |at: usize| {
            let (a, b) = self.pairs[at];
            let (x, y) = (self.integer(a), self.integer(b));
            // Most lines are none, and nothing has to be counted.
            let twice = |m: u64| m == lines || m.checked_mul(2) == Some(lines);
            if !twice(x) && !twice(y) || at > 0 && is_chain(self.pairs) {
                return false;
            }
            let others = self.pairs.iter().enumerate().filter(|&(k, _)| k != at);
            let nodes: HashSet<u32> = others.flat_map(|(_, &(a, b))| [a, b]).collect();
            // Below a list that goes on, the counts have to be right.
            let goes_on = at > 0 && nodes.contains(&a) && nodes.contains(&b);
            let nodes = nodes.len() as u64;
            let counts = |n: u64, m: u64| match goes_on {
                true => (n, m) == (nodes, lines),
                false => n >= nodes && twice(m),
            };
            counts(x, y) || counts(y, x)
        };
        let mut ends = [("first", 0), ("last", self.pairs.len() - 1)].into_iter();
        let (place, at) = ends.find(|&(_, at)| lines > 2 && is_count(at))?;
        Some(self.odd(place, self.pairs[at], "may count nodes and lines"))
    }

    fn of_integers(&self, pairs: &[(u32, u32)]) -> Option<String> {
        let values = pairs.iter();
        let values = values.map(|&(a, b)| (self.integer(a), self.integer(b)));
        let is_chain = is_chain(pairs);
        let loops = self
            .loops
            .iter()
            .filter_map(|(_, label)| label.parse().ok());
        let firsts = loops.chain(values.clone().map(|(a, _)| a));
        let falls = values.clone().any(|(a, b)| a > b);
        let (all, shared) = ends(pairs);
        let labels = all.iter().map(|&end| self.integer(end));
        let (low, high) = (labels.clone().min()?, labels.max()?);
        // Graphs that are in order, and have no gaps.
        let in_order = low <= 1 && high - low == all.len() as u64 - 1 && self.width < 9;
        let in_order = in_order && values.clone().all(|(a, b)| a < b);
        let what = match pairs {
            [(a, b)] if self.integer(*b).checked_sub(1) == Some(self.integer(*a)) => return None,
            [_] => "one line of two numbers may be a size, or two counts",
            _ if (!is_chain || !self.loops.is_empty()) && are_different(firsts) => {
                return Some(format!("the first column has each number once, {ONCE}"));
            }
            _ if !is_chain && falls && are_different(values.map(|(_, b)| b)) => {
                return Some(format!("the second column has each number once, {ONCE}"));
            }
            _ if 4 * shared < all.len() && !in_order => {
                "the two columns have hardly a number in common"
            }
            [_, _, _, _, ..] if self.left_out == 0 && 4 * pairs.len() < 3 * all.len() => {
                "most pairs have no number in common with others"
            }
            _ => return self.triples(pairs).map(str::to_owned),
        };
        Some(what.to_owned())
    }

    /// Three labels a line, as of triangles; a matrix of three rows.
    fn triples(&self, pairs: &[(u32, u32)]) -> Option<&'static str> {
        /// In longer lists weights are numbers of other cameras by chance.
        const FEW: usize = 64;
        let lines = pairs.iter().zip(self.thirds);
        let lines = lines.map(|(&(a, b), &c)| c.map(|c| [a, b, c]));
        let lines: Vec<[u32; 3]> = lines.collect::<Option<_>>()?;
        if self.width != 3 || self.values.is_some() || lines.len() < 3 {
            return None;
        }
        let is_symmetric = |i: usize| (0..3).all(|j| lines[i][j] == lines[j][i]);
        if pairs.len() == 3 && (0..3).all(is_symmetric) {
            return Some("three lines of three numbers that are a symmetric matrix");
        }
        let ends: HashSet<u32> = pairs.iter().flat_map(|&(a, b)| [a, b]).collect();
        let next = ends.iter().max().map_or(0, |&end| end.saturating_add(1));
        let labels = lines
            .iter()
            .filter(|[.., c]| ends.contains(c) || *c == next);
        let thirds: HashSet<u32> = lines.iter().map(|line| line[2]).collect();
        let both: HashSet<(u32, u32)> = pairs.iter().flat_map(|&(a, b)| [(a, b), (b, a)]).collect();
        let is_closed = |&&[a, b, c]: &&[u32; 3]| both.contains(&(a, c)) || both.contains(&(b, c));
        let closed = lines.iter().filter(is_closed).count();
        (lines.iter().all(|&[a, b, c]| a != c && b != c)
            && (pairs.len() <= FEW || 4 * closed >= lines.len())
            && 2 * thirds.len() >= ends.len().min(lines.len())
            && 4 * labels.count() >= 3 * lines.len())
        .then_some("the third numbers are labels, too: triangles, perhaps")
    }

    fn of_names(&self, pairs: &[(u32, u32)], labels: &[&str]) -> Option<String> {
        let (all, shared) = ends(pairs);
        if 8 * shared >= all.len() {
            return None;
        }
        let names = all.iter().map(|&end| labels[end as usize]);
        let images = self.width < 9 && names.clone().all(is_image);
        let single = are_different(pairs.iter().map(|pair| pair.0))
            && are_different(pairs.iter().map(|pair| pair.1));
        let what = match pairs {
            &[(a, b)] if images && are_alike(labels[a as usize], labels[b as usize]) => {
                return None;
            }
            [_] if images => "one line of two images in two folders, or of two kinds",
            [_, _, ..] if single && shared == 0 => {
                "no label is in two lines: a table of things and their names, perhaps"
            }
            _ => {
                let shapes: HashSet<String> = names.map(shape).collect();
                let alike = shapes.len() < 2 && self.width < 9 && (!single || pairs.len() < 2);
                return (!alike && !images)
                    .then(|| "hardly any label is in both columns: a table, perhaps".to_owned());
            }
        };
        Some(what.to_owned())
    }

    /// Pairs below a head that names any source and target, no two of which have a label in common.
    pub(super) fn are_copies(&self) -> Option<Problem> {
        let pairs = &self.pairs[..self.pairs.len().min(MOST)];
        let apart = pairs.len() > 1 && are_different(pairs.iter().flat_map(|&(a, b)| [a, b]));
        apart.then(|| {
            Problem::new(
                "no label is in two lines: copies, perhaps, or renamed files",
                "if these are pairs of images, write `image1` and `image2` above the columns",
            )
        })
    }
}

/// What stands in any column, ascending, and how much of it in both. O(m log m).
fn ends(pairs: &[(u32, u32)]) -> (Vec<u32>, usize) {
    let once = |mut ends: Vec<u32>| {
        // Lists of tracks repeat one end in neighbouring lines.
        ends.dedup();
        ends.par_sort_unstable();
        ends.dedup();
        ends
    };
    let first = once(pairs.iter().map(|pair| pair.0).collect());
    let second = once(pairs.iter().map(|pair| pair.1).collect());
    let both = first.len() + second.len();
    let all = once([first, second].concat());
    let shared = both - all.len();
    (all, shared)
}

/// Whether nothing occurs twice.
fn are_different<T: Eq + std::hash::Hash>(mut all: impl Iterator<Item = T>) -> bool {
    let mut met = HashSet::new();
    all.all(|one| met.insert(one))
}

/// Whether each pair goes on where the one before has ended.
fn is_chain(pairs: &[(u32, u32)]) -> bool {
    pairs.windows(2).all(|two| two[0].1 == two[1].0)
        || pairs.windows(2).all(|two| two[0].0 == two[1].1)
}
