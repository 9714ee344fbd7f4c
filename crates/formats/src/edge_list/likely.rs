//! Whether a list that nothing names as one of pairs is likely to be one.
//!
//! Two columns of numbers, or of words, are much that is no graph: what things are called, how often they
//! occur, where features lie. So what a list of pairs of cameras hardly ever is gets refused.

use std::collections::{HashMap, HashSet};

use super::names::{are_alike, is_copy, is_image, shape};
use super::refusal::Refusal;

/// So many of the first pairs are looked at, in lists of any length.
const MOST: usize = 1 << 16;

/// A list of pairs, as far as it has been understood.
pub(super) struct List<'a> {
    /// Two integers each, or numbers of `labels` or `values`.
    pub(super) pairs: &'a [(u32, u32)],
    /// Names; none if all labels are integers.
    pub(super) labels: Option<&'a [&'a str]>,
    /// Integers, if some are long or begin with zeros.
    pub(super) values: Option<Vec<u64>>,
    /// Labels that are paired with themselves.
    pub(super) loops: &'a [Box<str>],
    /// How many lines have been left out.
    pub(super) left_out: u64,
    /// The third fields of the first lines, if they are integers.
    pub(super) thirds: &'a [u32],
    pub(super) width: usize,
}

impl List<'_> {
    /// What speaks against pairs of cameras.
    pub(super) fn doubt(&self) -> Option<Refusal> {
        let &first = self.pairs.first()?;
        let pairs = &self.pairs[..self.pairs.len().min(MOST)];
        let is_first = |&(a, b): &(u32, u32)| (a, b) == first || (b, a) == first;
        if pairs.len() + self.loops.len() > 1 && pairs.iter().all(is_first) {
            return Some(Refusal::table(
                "all lines hold the same two labels: a table, perhaps",
            ));
        }
        match self.labels {
            Some(labels) => self.stands_apart().or_else(|| self.of_names(pairs, labels)),
            None => self
                .of_pandas(pairs)
                .or_else(|| self.counts())
                .or_else(|| self.stands_apart())
                .or_else(|| self.of_integers(pairs)),
        }
    }

    fn lines(&self) -> u64 {
        self.pairs.len() as u64 + self.left_out
    }

    fn integer(&self, end: u32) -> u64 {
        match &self.values {
            Some(values) => values[end as usize],
            None => end.into(),
        }
    }

    fn label(&self, end: u32) -> String {
        match self.labels {
            Some(labels) => labels[end as usize].to_owned(),
            None => self.integer(end).to_string(),
        }
    }

    fn shown(&self, (a, b): (u32, u32)) -> String {
        format!("{} {}", self.label(a), self.label(b))
    }

    /// A first line whose labels are in no other line, or a last one below names.
    pub(super) fn stands_apart(&self) -> Option<Refusal> {
        let lines = self.pairs;
        let is_apart = |(a, b): (u32, u32), others: &[(u32, u32)]| {
            let images = |labels: &[&str]| [a, b].iter().all(|&end| is_image(labels[end as usize]));
            let known = |&(c, d): &(u32, u32)| [a, b].contains(&c) || [a, b].contains(&d);
            others.len() > 1 && !self.labels.is_some_and(images) && !others.iter().any(known)
        };
        let (&first, below) = lines.split_first()?;
        if is_apart(first, below) {
            return Some(Refusal::apart("first", &self.shown(first)));
        }
        let (&last, above) = lines.split_last()?;
        let is_odd = self.labels.is_some() && is_apart(last, above) && self.left_out == 0;
        is_odd.then(|| Refusal::apart("last", &self.shown(last)))
    }

    /// The numbers of columns as pandas writes them above tables without names, where nothing but this line
    /// has the 0.
    fn of_pandas(&self, pairs: &[(u32, u32)]) -> Option<Refusal> {
        let &(a, b) = pairs.first()?;
        let numbered = (self.integer(a), self.integer(b)) == (0, 1)
            && (self.width == 2 || self.width == 3 && self.thirds.first() == Some(&2));
        let others = &pairs[1..];
        let is_alone = others.iter().all(|&(c, d)| c != a && d != a);
        (numbered && !others.is_empty() && is_alone && !is_chain(pairs)).then(|| {
            let what = "the first line, 0 and 1, may be a pair, or the numbers of the columns as pandas writes them";
            let remedy = "delete it if it is no pair; if it is one, write the line `source,target` above it";
            Refusal::new(what, remedy)
        })
    }

    /// The numbers of nodes and pairs, above or below these.
    fn counts(&self) -> Option<Refusal> {
        let lines = self.lines() - 1;
        if lines < 3 {
            return None;
        }
        let last = self.pairs.len() - 1;
        let is_count = |at: usize| {
            let (x, y) = self.pairs[at];
            let (x, y) = (self.integer(x), self.integer(y));
            // Most lines are none, and nothing has to be counted.
            let twice = |m: u64| m == lines || m.checked_mul(2) == Some(lines);
            if !twice(x) && !twice(y) {
                return false;
            }
            let others = self.pairs.iter().enumerate().filter(|&(k, _)| k != at);
            let nodes: HashSet<u32> = others.flat_map(|(_, &(a, b))| [a, b]).collect();
            let (a, b) = self.pairs[at];
            // Below a list that goes on, the counts have to be right.
            let goes_on = at > 0 && nodes.contains(&a) && nodes.contains(&b);
            if at > 0 && is_chain(self.pairs) {
                return false;
            }
            let nodes = nodes.len() as u64;
            let counts = |n: u64, m: u64| match goes_on {
                true => (n, m) == (nodes, lines),
                false => n >= nodes && twice(m),
            };
            counts(x, y) || counts(y, x)
        };
        let at = [0, last].into_iter().find(|&at| is_count(at))?;
        let place = if at == 0 { "first" } else { "last" };
        let what = format!(
            "the {place} line, {}, may count nodes and lines",
            self.shown(self.pairs[at])
        );
        Some(Refusal::new(
            what,
            "delete it if it is no pair; if it is one, write the line `source target` above all",
        ))
    }

    fn of_integers(&self, pairs: &[(u32, u32)]) -> Option<Refusal> {
        let value = |&(a, b): &(u32, u32)| (self.integer(a), self.integer(b));
        if let [pair] = pairs {
            let (a, b) = value(pair);
            return (b.checked_sub(1) != Some(a))
                .then(|| Refusal::table("one line of two numbers may be a size, or two counts"));
        }
        let loops = self.loops.iter().filter_map(|label| label.parse().ok());
        let firsts = || loops.clone().chain(pairs.iter().map(value).map(|(a, _)| a));
        let is_chain = is_chain(pairs);
        if !is_chain && are_different(firsts()) {
            return Some(Refusal::table(
                "the first column has each number once, as a table with a line for each thing has",
            ));
        }
        let seconds = pairs.iter().map(value).map(|(_, b)| b);
        let is_falling = |(a, b)| a > b;
        if !is_chain && pairs.iter().map(value).any(is_falling) && are_different(seconds) {
            return Some(Refusal::table(
                "the second column has each number once, as a table with a line for each thing has",
            ));
        }
        self.columns_apart(pairs).or_else(|| self.triples(pairs))
    }

    /// Columns with hardly a number in common, as of cameras and points, or pairs with hardly a number in
    /// common; lists of graphs that are in order, and have no gaps, are such, too.
    fn columns_apart(&self, pairs: &[(u32, u32)]) -> Option<Refusal> {
        let column = |end: fn(&(u32, u32)) -> u32| -> HashSet<u64> {
            pairs.iter().map(|pair| self.integer(end(pair))).collect()
        };
        let (firsts, seconds) = (column(|pair| pair.0), column(|pair| pair.1));
        let all = firsts.union(&seconds).count();
        let shared = firsts.intersection(&seconds).count();
        let ends = |of: &HashSet<u64>| Some((*of.iter().min()?, *of.iter().max()?));
        let ((low, first), (second, high)) = (ends(&firsts)?, ends(&seconds)?);
        let without_gaps =
            low.min(second) <= 1 && first.max(high) - low.min(second) == all as u64 - 1;
        let is_rising = |&(a, b): &(u32, u32)| self.integer(a) < self.integer(b);
        let in_order = without_gaps && self.width < 9 && pairs.iter().all(is_rising);
        if 4 * shared < all && !in_order {
            return Some(Refusal::table(
                "the two columns have hardly a number in common",
            ));
        }
        (pairs.len() > 3 && self.left_out == 0 && 4 * pairs.len() < 3 * all)
            .then(|| Refusal::table("most pairs have no number in common with others"))
    }

    /// Three labels a line, as of triangles; a matrix of three rows.
    fn triples(&self, pairs: &[(u32, u32)]) -> Option<Refusal> {
        /// In longer lists weights are numbers of other cameras by chance.
        const FEW: usize = 64;
        let lines: Vec<[u32; 3]> = pairs
            .iter()
            .zip(self.thirds)
            .map(|(&(a, b), &c)| [a, b, c])
            .collect();
        if self.width != 3 || self.values.is_some() || lines.len() < pairs.len().min(FEW) {
            return None;
        }
        let is_symmetric =
            |rows: &[[u32; 3]; 3]| (0..3).all(|i| (0..3).all(|j| rows[i][j] == rows[j][i]));
        if lines.len() == pairs.len()
            && lines.first_chunk().is_some_and(is_symmetric)
            && lines.len() == 3
        {
            return Some(Refusal::table(
                "three lines of three numbers that are a symmetric matrix",
            ));
        }
        let ends: HashSet<u32> = pairs.iter().flat_map(|&(a, b)| [a, b]).collect();
        let here: HashSet<u32> = lines.iter().flat_map(|&[a, b, _]| [a, b]).collect();
        let thirds: HashSet<u32> = lines.iter().map(|line| line[2]).collect();
        let mut lines_of: HashMap<[u32; 2], usize> = HashMap::new();
        for &(a, b) in pairs {
            *lines_of.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
        let is_pair = |a: u32, b: u32| lines_of.contains_key(&[a.min(b), a.max(b)]);
        let closed = lines
            .iter()
            .filter(|[a, b, c]| is_pair(*a, *c) || is_pair(*b, *c));
        let next = ends.iter().max().map_or(0, |&end| end.saturating_add(1));
        let known = lines
            .iter()
            .filter(|line| ends.contains(&line[2]) || line[2] == next);
        let many = lines.len() > 2 && 2 * thirds.len() >= here.len();
        let all = lines.iter().all(|[a, b, c]| a != c && b != c);
        let closes = pairs.len() <= FEW || 4 * closed.count() >= lines.len();
        (many && all && closes && 4 * known.count() >= 3 * lines.len())
            .then(|| Refusal::table("the third numbers are labels, too: triangles, perhaps"))
    }

    fn of_names(&self, pairs: &[(u32, u32)], labels: &[&str]) -> Option<Refusal> {
        let firsts: HashSet<u32> = pairs.iter().map(|pair| pair.0).collect();
        let seconds: HashSet<u32> = pairs.iter().map(|pair| pair.1).collect();
        let all = firsts.union(&seconds).count();
        let shared = firsts.intersection(&seconds).count();
        if 8 * shared >= all {
            return None;
        }
        let name = |end: u32| labels[end as usize];
        let ends = || firsts.union(&seconds).map(|&end| name(end));
        let images = ends().all(is_image);
        let single = firsts.len() == pairs.len() && seconds.len() == pairs.len();
        if images && shared == 0 && pairs.iter().all(|&(a, b)| is_copy(name(a), name(b))) {
            return Some(Refusal::table(
                "each name is that of the other and an addition: copies or masks",
            ));
        }
        if let (true, &[(a, b)], true) = (images, pairs, self.width < 9) {
            return (!are_alike(name(a), name(b)))
                .then(|| Refusal::table("one line of two images in two folders, or of two kinds"));
        }
        let what = match () {
            () if single && shared == 0 && pairs.len() > 1 => {
                "no label is in two lines: a table of things and their names, perhaps"
            }
            () if images && self.width < 9 => return None,
            () => "hardly any label is in both columns: a table, perhaps",
        };
        let mut shapes = ends().map(shape);
        let first = shapes.next();
        let alike = shapes.all(|other| Some(other) == first) && self.width < 9;
        (!alike || single && pairs.len() > 1).then(|| Refusal::table(what))
    }

    /// Pairs below a head that names any source and target, no two of which have a label in common.
    pub(super) fn are_copies(&self) -> Option<Refusal> {
        let mut met = HashSet::new();
        let pairs = &self.pairs[..self.pairs.len().min(MOST)];
        let apart = pairs.len() > 1 && pairs.iter().all(|&(a, b)| met.insert(a) && met.insert(b));
        apart.then(|| {
            Refusal::new(
                "no label is in two lines: copies, perhaps, or renamed files",
                "if these are pairs of images, write `image1` and `image2` above the columns",
            )
        })
    }
}

/// Whether nothing occurs twice.
fn are_different(mut numbers: impl Iterator<Item = u64>) -> bool {
    let mut met = HashSet::new();
    numbers.all(|number| met.insert(number))
}

/// Whether each pair goes on where the one before has ended.
fn is_chain(pairs: &[(u32, u32)]) -> bool {
    pairs.windows(2).all(|two| two[0].1 == two[1].0)
        || pairs.windows(2).all(|two| two[0].0 == two[1].1)
}
