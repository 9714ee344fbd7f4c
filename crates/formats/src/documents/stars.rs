//! Stars: lines `i j k ...` that join i with each of j, k, ...: lists of pairs as OpenMVG reads
//! them ("openMVG_main_ListMatchingPairs", `loadPairs`), and adjacency lists of networkx, also those
//! of several lines a node.
//!
//! A line with one field is a node without neighbours behind it. Lines of names and integers are
//! much that is no graph, so what is not asked for is read only if it is sure: it has the comment of
//! networkx's writer; or every node begins one line, and lines have different lengths; or lines
//! of different integers have different lengths, one of them too long for a pair with a weight, and
//! first ones that increase from line to line.

use std::collections::HashSet;

use crate::documents::collected::Collected;
use crate::edge_list::fields::{self, Field, integer};
use crate::edge_list::is_image;
use crate::edge_list::layout::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;

const DOUBT: &str = "these could be lists of neighbours, and are no edge list";
const DOUBT_ADVICE: &str = "write one pair a line; if every line joins its first field with each of the others, say --format openmvg-pairs";

const COUNT: &str = "the first line has one field, which is in no other: a count, perhaps, or a camera without neighbours";
const COUNT_ADVICE: &str =
    "delete the line of the count; if it is a camera, say --format openmvg-pairs";
const LOOPS: &str = "some lines begin with a field that they have twice: a table, perhaps, and no lists of neighbours";
const SETS: &str = "lines of different lengths are taken for lists of neighbours: if they are sets, as communities are, \
     this is another graph";

/// What networkx writes above adjacency lists, in the second of three comments.
const NETWORKX: &str = "# GMT ";

/// What is known of the lines so far.
#[derive(Default)]
struct Shape<'a> {
    lines: u64,
    /// The fields of the first line.
    first: Vec<&'a str>,
    last_start: Option<u64>,
    uneven: bool,
    /// Some line has more fields than a pair with a weight.
    long: bool,
    /// Some line is none of different integers, the first one larger than that of the line before.
    no_integers: bool,
    /// The nodes that begin a line.
    starts: HashSet<&'a str>,
    /// Some node begins two lines.
    twice: bool,
    /// The other nodes.
    others: HashSet<&'a str>,
    /// Some line has its first node twice.
    loops: bool,
}

impl<'a> Shape<'a> {
    /// Takes in a line.
    fn line(&mut self, words: &[&'a str]) {
        self.lines += 1;
        if self.lines == 1 {
            self.first = words.to_vec();
        }
        self.uneven |= words.len() != self.first.len();
        self.long |= words.len() > 3;
        self.twice |= !self.starts.insert(words[0]);
        self.others.extend(&words[1..]);
        self.loops |= words[1..].contains(&words[0]);
        let numbers: Option<Vec<u64>> = words.iter().map(|word| integer(word)).collect();
        let Some(mut numbers) = numbers else {
            self.no_integers = true;
            return;
        };
        let start = numbers[0];
        let behind = self.last_start.is_none_or(|last| last < start);
        self.last_start = Some(start);
        numbers.sort_unstable();
        let different = numbers.is_sorted_by(|a, b| a < b);
        // Matches of OpenMVG and Bundler have a count below their first pair of images.
        let count = self.lines == 2 && words.len() == 1 && self.first.len() == 2;
        self.no_integers |= !different || !behind || count;
    }

    /// Whether lines of integers, if these are all, are stars and not a count of lines with what
    /// follows.
    fn are_stars(&self, whole: bool) -> bool {
        let count = self.first.first().and_then(|first| integer(first));
        let counts = (2..=4).contains(&self.first.len()) && count == Some(self.lines - 1);
        !self.no_integers && self.uneven && self.long && !(whole && counts)
    }

    /// Whether the first line is a single field that counts the lines below or their labels, or is like
    /// none of these.
    fn has_count(&self) -> bool {
        let [count] = self.first[..] else {
            return false;
        };
        if self.others.contains(count) || self.others.is_empty() {
            return false;
        }
        let mut labels = self
            .others
            .union(&self.starts)
            .filter(|label| **label != count);
        match integer(count) {
            Some(value) => {
                let all = labels.clone().count() as u64;
                [self.lines - 1, all].contains(&value)
                    || labels.all(|label| integer(label).is_none())
            }
            None => {
                labels.clone().all(|label| integer(label).is_some())
                    || !is_image(count) && labels.all(|label| is_image(label))
            }
        }
    }

    /// Whether every node begins one line.
    fn is_closed(&self) -> bool {
        self.uneven && !self.twice && self.others.is_subset(&self.starts)
    }
}

fn words<'a>(line: &'a str, fields: &mut Vec<Field>) -> Option<Vec<&'a str>> {
    fields::split(line, fields).ok()?;
    Some(fields.iter().map(|field| field.raw(line)).collect())
}

/// The shape of complete lines.
fn shape(text: &str) -> Option<Shape<'_>> {
    let mut shape = Shape::default();
    let mut fields = Vec::new();
    for line in text.lines() {
        let words = words(line, &mut fields)?;
        if !words.is_empty() {
            shape.line(&words);
        }
    }
    (shape.lines > 0).then_some(shape)
}

fn is_of_networkx(text: &str) -> bool {
    let comments = text.lines().take_while(|line| line.starts_with('#'));
    comments.take(3).any(|line| line.starts_with(NETWORKX))
}

/// Whether some lines have another number of fields than the first. (Most lists of pairs end here.)
fn is_uneven(text: &str) -> bool {
    let counts = text.lines().map(|line| {
        let blank = [' ', '\t', ','];
        line.split(blank)
            .filter(|field| !field.is_empty())
            .take_while(|field| !field.starts_with(['#', '%']))
            .count()
    });
    let mut counts = counts.filter(|&count| count > 0);
    let first = counts.next();
    counts.any(|count| Some(count) != first)
}

/// Whether a text that begins like this may be read as stars unasked.
pub(super) fn is_stars(head: &str, whole: bool) -> bool {
    let end = if whole {
        Some(head.len())
    } else {
        head.rfind('\n')
    };
    let text = &head[..end.unwrap_or(0)];
    is_of_networkx(text)
        || is_uneven(text)
            && shape(text).is_some_and(|shape| shape.are_stars(whole) || whole && shape.is_closed())
}

/// Reads stars.
pub(super) fn read(text: &str, asked: bool, options: &ListOptions) -> Result<Parsed, Fault> {
    let of_networkx = is_of_networkx(text);
    if of_networkx && text.lines().any(|line| line.contains('{')) {
        return of_several_lines(text, options);
    }
    let shape = shape(text);
    let is_closed = shape.as_ref().is_some_and(Shape::is_closed);
    let sure = is_closed || shape.as_ref().is_some_and(|shape| shape.are_stars(true));
    let count = shape.as_ref().is_some_and(Shape::has_count);
    let loops = shape.as_ref().is_some_and(|shape| shape.loops);
    let doubt = match () {
        () if of_networkx || asked => None,
        () if count => Some((COUNT, COUNT_ADVICE)),
        () if loops => Some((LOOPS, DOUBT_ADVICE)),
        () if !sure => Some((DOUBT, DOUBT_ADVICE)),
        () => None,
    };
    if let Some((what, advice)) = doubt {
        return Err(Place::Input.fault(Problem::Doubtful { what, advice }));
    }
    let mut collected = Collected::new(options);
    let mut fields = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let fault = |problem| Place::Line(number).fault(problem);
        fields::split(line, &mut fields).map_err(fault)?;
        let [first, others @ ..] = &fields[..] else {
            continue;
        };
        let centre = collected.node(&first.text(line)).map_err(fault)?;
        for other in others {
            let other = collected.node(&other.text(line)).map_err(fault)?;
            collected.pair(centre, other).map_err(fault)?;
        }
    }
    let mut parsed = collected.finish()?;
    parsed.read.taken = Some("each line joins its first field with all others".to_owned());
    if count && !of_networkx {
        let count = shape.as_ref().map_or("", |shape| shape.first[0]);
        let note = format!("the first line, {count}, is taken for a camera without pairs");
        parsed.notes.push(note);
    }
    if !asked && !of_networkx && !is_closed {
        parsed.notes.push(SETS.to_owned());
    }
    Ok(parsed)
}

/// Reads what networkx calls a multi-line adjacency list: a node and how many neighbours follow,
/// these on a line each, with attributes behind them.
fn of_several_lines(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut collected = Collected::new(options);
    let mut left: Option<(u32, u64)> = None;
    let lines = text.lines().zip(1..).filter(|(line, _)| {
        let line = line.trim();
        !line.is_empty() && !line.starts_with('#')
    });
    for (line, number) in lines {
        let fault = |problem| Place::Line(number).fault(problem);
        let wrong = |what| fault(super::malformed("multi-line adjacency list", what));
        let mut words = line.split_whitespace();
        let name = words.next().unwrap_or_default();
        match &mut left {
            Some((centre, count)) if *count > 0 => {
                let node = collected.node(name).map_err(fault)?;
                collected.pair(*centre, node).map_err(fault)?;
                *count -= 1;
            }
            _ => {
                let count = words
                    .next()
                    .and_then(integer)
                    .filter(|_| words.next().is_none());
                let count = count.ok_or_else(|| wrong("a node and how many follow is expected"))?;
                left = Some((collected.node(name).map_err(fault)?, count));
            }
        }
    }
    if left.is_some_and(|(_, count)| count > 0) {
        return Err(Place::Input.fault(super::malformed(
            "multi-line adjacency list",
            "the text ends within the neighbours of a node",
        )));
    }
    let mut parsed = collected.finish()?;
    parsed.read.taken = Some("each node and the lines of its neighbours".to_owned());
    parsed.read.ignored.push("attributes".to_owned());
    Ok(parsed)
}
