//! Edge lists: text with one pair a line.
//!
//! A line holds two labels, separated by blanks, tabs or commas; further
//! columns are weights of no concern here. A single label is a node without
//! pairs so far. A token that starts with `#` or `%` starts a comment.
//!
//! Nodes are numbered by their sorted labels, so that the numbering does not
//! depend on the order of the lines: numerically if every label is a decimal
//! integer below 2^64 without leading zeros, else bytewise.
//!
//! A list of 10^7 pairs must be read in the time of reading the file. So the
//! usual line, two integers below 2^32, has a parser of its own, and integers
//! become nodes by a bitmap of those that occur; everything else takes the
//! general way, through an index of labels.

use std::collections::HashMap;
use std::fmt::Write;
use std::io::Read;

use super::error::{Fault, Place, Problem};
use super::{Graph, GraphError, Labels};

/// The longest line that is read, and the size of a read.
const LINE_LIMIT: usize = 1 << 20;
/// What separates labels; the last one is the byte order mark of UTF-8.
const SEPARATORS: [char; 4] = [' ', '\t', ',', '\u{feff}'];

/// Reads an edge list: the graph, its labels, and notes about what was merged
/// or ignored. O(bytes + n log n + m log m); takes
/// at most 16 bytes a pair, and for labels that are not small integers an index
/// of them.
///
/// # Errors
/// With the number of the line: a self-loop, bytes that are not UTF-8 text, a line
/// longer than a mebibyte. Without: an input that cannot be read, no pairs.
pub fn read(input: impl Read) -> Result<(Graph, Labels, Vec<String>), Fault> {
    let mut collector = Collector::default();
    collector.read(input)?;
    collector.finish()
}

/// The pairs read so far.
#[derive(Default)]
struct Collector {
    /// Ends are integers as written, or node numbers of `names` once that exists.
    pairs: Vec<(u32, u32)>,
    singles: Vec<u32>,
    names: Option<Index>,
    line: u64,
    lines_with_more: u64,
}

impl Collector {
    fn read(&mut self, mut input: impl Read) -> Result<(), Fault> {
        let mut buffer = vec![0; LINE_LIMIT];
        let mut filled = 0;
        loop {
            let got = match input.read(&mut buffer[filled..]) {
                Ok(got) => got,
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(Place::Input.fault(Problem::Unreadable(error))),
            };
            let end = filled + got;
            if got == 0 {
                return self.lines(&buffer[..end]);
            }
            let Some(last) = buffer[filled..end].iter().rposition(|&b| b == b'\n') else {
                if end == buffer.len() {
                    let problem = Problem::LineTooLong { limit: LINE_LIMIT };
                    return Err(Place::Line(self.line + 1).fault(problem));
                }
                filled = end;
                continue;
            };
            let complete = filled + last + 1;
            self.lines(&buffer[..complete])?;
            buffer.copy_within(complete..end, 0);
            filled = end - complete;
        }
    }

    /// Reads whole lines; the last one may lack its line feed.
    fn lines(&mut self, mut text: &[u8]) -> Result<(), Fault> {
        while !text.is_empty() {
            self.line += 1;
            if self.names.is_none()
                && let Some((a, b, more, rest)) = plain_pair(text)
            {
                self.pair(a, b)?;
                self.lines_with_more += u64::from(more);
                text = rest;
                continue;
            }
            let end = text.iter().position(|&b| b == b'\n');
            self.any_line(&text[..end.unwrap_or(text.len())])?;
            text = end.map_or(&[], |end| &text[end + 1..]);
        }
        Ok(())
    }

    fn any_line(&mut self, line: &[u8]) -> Result<(), Fault> {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let text = match std::str::from_utf8(line) {
            Ok(text) if !text.contains(is_control) => text,
            _ => return Err(Place::Line(self.line).fault(Problem::NotText)),
        };
        let mut tokens = tokens(text);
        let Some(first) = tokens.next() else {
            return Ok(());
        };
        let Some(second) = tokens.next() else {
            let [node, _] = self.nodes([first, first])?;
            self.singles.push(node);
            return Ok(());
        };
        self.lines_with_more += u64::from(tokens.next().is_some());
        let [a, b] = self.nodes([first, second])?;
        self.pair(a, b)
    }

    /// The two labels as ends of a pair, in the meaning that `pairs` has then.
    fn nodes(&mut self, labels: [&str; 2]) -> Result<[u32; 2], Fault> {
        let names = match &mut self.names {
            Some(names) => names,
            names => {
                let small = |label| integer(label).and_then(|value| u32::try_from(value).ok());
                if let (Some(a), Some(b)) = (small(labels[0]), small(labels[1])) {
                    return Ok([a, b]);
                }
                // The first label that is not a small integer: from here on labels are text.
                names.insert(Index::of_integers(&mut self.pairs, &mut self.singles))
            }
        };
        let place = Place::Line(self.line);
        match (names.node(labels[0]), names.node(labels[1])) {
            (Some(a), Some(b)) => Ok([a, b]),
            _ => Err(place.fault(Problem::TooManyNodes)),
        }
    }

    fn pair(&mut self, a: u32, b: u32) -> Result<(), Fault> {
        if a == b {
            let label = match &self.names {
                Some(names) => names.labels().swap_remove(a as usize).into(),
                None => a.to_string(),
            };
            return Err(Place::Line(self.line).fault(Problem::SelfLoop(label)));
        }
        self.pairs.push((a, b));
        Ok(())
    }

    fn finish(self) -> Result<(Graph, Labels, Vec<String>), Fault> {
        let fault = |problem| Place::Input.fault(problem);
        let Self {
            mut pairs,
            singles,
            names,
            lines_with_more,
            ..
        } = self;
        if pairs.is_empty() && singles.is_empty() {
            return Err(fault(Problem::NoNodes));
        }
        let (labels, nodes) = match names {
            Some(names) => names.sort(&mut pairs),
            None => number_integers(&mut pairs, &singles),
        };
        let nodes = u32::try_from(nodes).map_err(|_| fault(Problem::TooManyNodes))?;
        if pairs.is_empty() {
            let nodes = nodes as usize;
            return Err(fault(Problem::NoPairs { nodes }));
        }
        // Both refusals are impossible here: loops were refused line by line,
        // and every end was numbered.
        let (graph, merged) = Graph::from_pairs(nodes, pairs).map_err(|error| match error {
            GraphError::SelfLoop(node) => fault(Problem::SelfLoop(labels.label(node).into())),
            GraphError::OutOfRange { .. } => fault(Problem::TooManyNodes),
        })?;
        let mut notes = Vec::new();
        if merged > 0 {
            notes.push(format!("{merged} duplicate or reversed pairs merged"));
        }
        if lines_with_more > 0 {
            notes.push(format!(
                "{lines_with_more} lines have more than two columns; the further ones are ignored"
            ));
        }
        Ok((graph, labels, notes))
    }
}

/// Control characters but the tabulator: among them the carriage return of
/// files without line feeds, which would otherwise be one long line.
fn is_control(character: char) -> bool {
    character.is_ascii_control() && character != '\t'
}

/// The tokens of a line up to a comment.
pub(super) fn tokens(line: &str) -> impl Iterator<Item = &str> {
    line.split(SEPARATORS)
        .filter(|token| !token.is_empty())
        .take_while(|token| !token.starts_with(['#', '%']))
}

/// The value of a decimal integer without sign and leading zeros.
fn integer(label: &str) -> Option<u64> {
    let plain = label.bytes().all(|b| b.is_ascii_digit());
    if plain && (label == "0" || !label.starts_with('0')) {
        label.parse().ok()
    } else {
        None
    }
}

/// The usual line: two small integers, one separator, perhaps columns of plain
/// characters. Returns the integers, whether more columns follow, and what
/// follows the line; `None` for every other line.
#[inline]
fn plain_pair(text: &[u8]) -> Option<(u32, u32, bool, &[u8])> {
    let (a, rest) = small_integer(text)?;
    let rest = match rest {
        [b' ' | b'\t' | b',', rest @ ..] => rest,
        _ => return None,
    };
    let (b, rest) = small_integer(rest)?;
    match rest {
        [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => Some((a, b, false, rest)),
        [b' ' | b'\t' | b',', rest @ ..] => {
            let mut more = false;
            let stop = rest.iter().position(|byte| match byte {
                b' ' | b'\t' | b',' => false,
                b'$' | b'&'..=b'~' => {
                    more = true;
                    false
                }
                _ => true,
            })?;
            match &rest[stop..] {
                [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => Some((a, b, more, rest)),
                _ => None,
            }
        }
        _ => None,
    }
}

/// An integer below 2^32 without leading zeros at the start of `text`.
#[inline]
fn small_integer(text: &[u8]) -> Option<(u32, &[u8])> {
    let mut value = 0u64;
    let mut digits = 0;
    while let Some(digit) = text.get(digits).map(|b| b.wrapping_sub(b'0'))
        && digit < 10
    {
        value = 10 * value + u64::from(digit);
        digits += 1;
        if digits > 10 {
            return None;
        }
    }
    if digits == 0 || (text[0] == b'0' && digits > 1) {
        return None;
    }
    let value = u32::try_from(value).ok()?;
    Some((value, &text[digits..]))
}

/// Replaces integers by their places among those that occur. Returns the
/// labels and their number.
fn number_integers(pairs: &mut [(u32, u32)], singles: &[u32]) -> (Labels, usize) {
    let ends = pairs.iter().flat_map(|&(a, b)| [a, b]);
    let largest = ends.chain(singles.iter().copied()).max().unwrap_or(0);
    let given = 2 * pairs.len() + singles.len();
    // The bitmap takes 3/16 of a byte for every possible value: for values much
    // larger than their number it would outgrow the pairs.
    if largest as usize / 32 > given + 1024 {
        return number_far_apart(pairs, singles, largest);
    }
    let mut words = vec![0u64; largest as usize / 64 + 1];
    let ends = pairs.iter().flat_map(|&(a, b)| [a, b]);
    for value in ends.chain(singles.iter().copied()) {
        words[value as usize / 64] |= 1 << (value % 64);
    }
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
    let occurring = || {
        words.iter().zip(0u64..).flat_map(|(&word, at)| {
            (0..64)
                .filter(move |bit| word >> bit & 1 == 1)
                .map(move |bit| 64 * at + bit)
        })
    };
    let first = occurring().next().unwrap_or(0);
    if u64::from(largest) - first + 1 == nodes as u64 {
        let first_value = first as u32;
        for (a, b) in pairs {
            *a -= first_value;
            *b -= first_value;
        }
        return (Labels::Numbers { first }, nodes);
    }
    let rank = |value: u32| {
        let at = value as usize / 64;
        before[at] + (words[at] & ((1 << (value % 64)) - 1)).count_ones()
    };
    for (a, b) in pairs {
        *a = rank(*a);
        *b = rank(*b);
    }
    let mut values = Vec::with_capacity(nodes);
    values.extend(occurring());
    (Labels::Integers(values), nodes)
}

/// As [`number_integers`], for integers that lie far apart, `largest` being the
/// largest: sorts them and looks each up where its leading bits begin, which
/// stays in the processor's caches where a hash table would not.
fn number_far_apart(pairs: &mut [(u32, u32)], singles: &[u32], largest: u32) -> (Labels, usize) {
    let ends = pairs.iter().flat_map(|&(a, b)| [a, b]);
    let mut values: Vec<u32> = ends.chain(singles.iter().copied()).collect();
    values.sort_unstable();
    values.dedup();
    values.shrink_to_fit();
    let mut shift = 0;
    while (largest >> shift) as usize > 2 * values.len() {
        shift += 1;
    }
    // starts[k] is how many values have leading bits below k.
    let mut starts = vec![0u32; (largest >> shift) as usize + 2];
    for value in &values {
        starts[(value >> shift) as usize + 1] += 1;
    }
    let mut sum = 0;
    for start in &mut starts {
        sum += *start;
        *start = sum;
    }
    let rank = |value: u32| {
        let at = (value >> shift) as usize;
        let alike = &values[starts[at] as usize..starts[at + 1] as usize];
        starts[at] + alike.partition_point(|&other| other < value) as u32
    };
    for (a, b) in pairs {
        *a = rank(*a);
        *b = rank(*b);
    }
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
struct Index {
    nodes: HashMap<Box<str>, u32>,
}

impl Index {
    /// The index of pairs of integers, which become node numbers.
    fn of_integers(pairs: &mut [(u32, u32)], singles: &mut [u32]) -> Self {
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
    fn node(&mut self, label: &str) -> Option<u32> {
        if let Some(&node) = self.nodes.get(label) {
            return Some(node);
        }
        let node = u32::try_from(self.nodes.len()).ok()?;
        self.nodes.insert(label.into(), node);
        Some(node)
    }

    /// The labels in the order of their nodes.
    fn labels(&self) -> Vec<Box<str>> {
        let mut labels: Vec<_> = self.nodes.iter().collect();
        labels.sort_unstable_by_key(|&(_, node)| node);
        labels.into_iter().map(|(label, _)| label.clone()).collect()
    }

    /// Renumbers the nodes by sorted labels. Returns the labels and their number.
    fn sort(self, pairs: &mut [(u32, u32)]) -> (Labels, usize) {
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

#[cfg(test)]
mod tests;
