//! Stars: lines `i j k ...` that join i with each of j, k, ...: lists of pairs as OpenMVG reads
//! them ("openMVG_main_ListMatchingPairs", `loadPairs`), and adjacency lists of networkx.
//!
//! A line with one field is a node without neighbours behind it. Lines of integers are much that
//! is no graph, so what is not asked for is read only if it looks like one line a node: lines of
//! different lengths, one of them too long for a pair with a weight, different integers on each,
//! and first ones that increase from line to line.

use crate::documents::collected::Collected;
use crate::edge_list::fields::{self, integer};
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;

const DOUBT: &str = "these could be lists of neighbours, and are no edge list";
const DOUBT_ADVICE: &str = "write one pair a line; if every line joins its first field with each of the others, say --format openmvg-pairs";

/// What is known of the lines so far.
#[derive(Default)]
struct Shape {
    lines: u64,
    /// The fields of the first line.
    first: Vec<u64>,
    last_start: Option<u64>,
    uneven: bool,
    /// Some line has more fields than a pair with a weight.
    long: bool,
}

impl Shape {
    /// Takes in a line; whether it still is one line a node.
    fn line(&mut self, numbers: &[u64]) -> bool {
        self.lines += 1;
        let mut sorted = numbers.to_vec();
        sorted.sort_unstable();
        let different = sorted.is_sorted_by(|a, b| a < b);
        let behind = self.last_start.is_none_or(|last| last < numbers[0]);
        // Matches of OpenMVG and Bundler have a count below their first pair of images.
        let count = self.lines == 2 && numbers.len() == 1 && self.first.len() == 2;
        if self.lines == 1 {
            self.first = numbers.to_vec();
        }
        self.uneven |= numbers.len() != self.first.len();
        self.long |= numbers.len() > 3;
        self.last_start = Some(numbers[0]);
        different && behind && !count
    }

    /// Whether the lines, if these are all, are stars and not a count of lines with what follows.
    fn is_whole(&self) -> bool {
        let counts = (2..=4).contains(&self.first.len()) && self.first[0] == self.lines - 1;
        self.uneven && self.long && !counts
    }
}

/// Whether a text that begins like this may be read as stars unasked.
pub(super) fn is_stars(head: &str, whole: bool) -> bool {
    let end = if whole {
        Some(head.len())
    } else {
        head.rfind('\n')
    };
    let mut shape = Shape::default();
    let mut fields = Vec::new();
    for line in head[..end.unwrap_or(0)].lines() {
        if fields::split(line, &mut fields).is_err() {
            return false;
        }
        let numbers: Option<Vec<u64>> = fields.iter().map(|field| field.integer(line)).collect();
        match numbers {
            Some(numbers) if numbers.is_empty() => {}
            Some(numbers) if shape.line(&numbers) => {}
            _ => return false,
        }
    }
    shape.uneven && shape.long && (!whole || shape.is_whole())
}

/// Reads stars.
pub(super) fn read(text: &str, asked: bool) -> Result<Parsed, Fault> {
    let mut collected = Collected::default();
    let mut shape = Shape::default();
    let mut fields = Vec::new();
    let doubtful = || Problem::Doubtful {
        what: DOUBT,
        advice: DOUBT_ADVICE,
    };
    for (line, number) in text.lines().zip(1..) {
        let fault = |problem| Place::Line(number).fault(problem);
        fields::split(line, &mut fields).map_err(fault)?;
        let [first, others @ ..] = &fields[..] else {
            continue;
        };
        if !asked {
            let numbers: Option<Vec<u64>> = fields
                .iter()
                .map(|field| integer(field.raw(line)))
                .collect();
            if !numbers.is_some_and(|numbers| shape.line(&numbers)) {
                return Err(fault(doubtful()));
            }
        }
        let centre = collected.node(&first.text(line)).map_err(fault)?;
        for other in others {
            let other = collected.node(&other.text(line)).map_err(fault)?;
            collected.pair(centre, other).map_err(fault)?;
        }
    }
    if !asked && !shape.is_whole() {
        return Err(Place::Input.fault(doubtful()));
    }
    collected
        .notes
        .push("each line joins its first field with all others".to_owned());
    collected.finish()
}
