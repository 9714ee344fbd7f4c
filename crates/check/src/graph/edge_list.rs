//! Edge lists (section 2 of the specification): what is certainly one, and, for whoever knows that
//! it is one, the first two fields of each line.

use super::Graph;
use crate::rejection::{Unreadable, ensure};
use std::borrow::Cow;
use std::collections::HashMap;

/// How many fields a line may have: a pair; with a weight; with a 3 x 3 matrix; with a rotation and
/// a translation.
const WIDTHS: [usize; 4] = [2, 3, 9, 14];

/// The first two fields of a head, in lower case.
const HEADS: [[&[u8]; 2]; 11] = [
    [b"source", b"target"],
    [b"from", b"to"],
    [b"src", b"dst"],
    [b"node1", b"node2"],
    [b"node_1", b"node_2"],
    [b"image1", b"image2"],
    [b"image_1", b"image_2"],
    [b"image_id1", b"image_id2"],
    [b"name1", b"name2"],
    [b"name_1", b"name_2"],
    [b"id1", b"id2"],
];

const SAY_SO: &str = "if it is an edge list all the same, say so by --format edges";

/// An integer as it is written, with its value before it.
type Digits<'t> = (u64, &'t [u8]);

/// Nodes by their labels.
type Names = HashMap<Vec<u8>, u32>;

/// A label as it is written, with its value if that is an integer.
type Label<'t> = (Option<u64>, Cow<'t, [u8]>);

/// Reads what can be nothing else.
pub(super) fn strict(text: &[u8]) -> Result<Graph, Unreadable> {
    strict_list(text)?.into_graph(None)
}

/// The same, with the nodes by their labels.
pub(super) fn strict_with_labels(text: &[u8]) -> Result<(Graph, Names), Unreadable> {
    strict_list(text)?.into_graph_and_names()
}

fn strict_list(text: &[u8]) -> Result<List<'_>, Unreadable> {
    let mut table = Table {
        list: List::new(text),
        shape: Shape::default(),
        names: None,
    };
    let (mut rest, mut number, mut fields) = (text, 0, Vec::new());
    while !rest.is_empty() {
        number += 1;
        if let Some((pair, after)) = two_integers(rest)
            && matches!(table.shape.width, 0 | 2)
        {
            table.add_integers(number, pair)?;
            rest = after;
            continue;
        }
        split(next_line(&mut rest), false, &mut fields)
            .map_err(|reason| format!("line {number}: {reason}"))?;
        if !fields.is_empty() {
            table.add(number, &fields)?;
        }
    }
    table.into_list()
}

/// What the lines so far hold.
struct Table<'t> {
    list: List<'t>,
    shape: Shape,
    /// Two names that may be a head, if they are nowhere else.
    names: Option<[Cow<'t, [u8]>; 2]>,
}

impl<'t> Table<'t> {
    /// A line of two integers.
    #[inline(always)]
    fn add_integers(
        &mut self,
        number: usize,
        [(a, first), (b, second)]: [Digits<'t>; 2],
    ) -> Result<(), Unreadable> {
        self.shape.add_integers(a, b);
        let label = |value, digits| (Some(value), Cow::Borrowed(digits));
        self.list.pair(number, label(a, first), label(b, second))
    }

    /// A line with fields.
    fn add(&mut self, number: usize, fields: &[Field<'t>]) -> Result<(), Unreadable> {
        let [first, second, values @ ..] = fields else {
            return Err(format!("line {number}: one field is no pair; {SAY_SO}").into());
        };
        self.check_width(number, fields.len())?;
        let is_first = self.shape.width == 0;
        self.shape.add(fields);
        let wrong = values.iter().find(|field| !is_number(field));
        if is_first && wrong.is_some() {
            return Ok(());
        }
        ensure!(
            wrong.is_none(),
            "line {number}: `{}` is no number; {SAY_SO}",
            String::from_utf8_lossy(wrong.map_or(b"", |field| &field.text))
        );
        if is_first && is_head(first, second) {
            self.names = Some([first, second].map(|field| field.text.clone()));
            return Ok(());
        }
        let [first, second] = [first, second].map(|field| label(field.text.clone()));
        self.list.pair(number, first, second)
    }

    /// Each line has as many fields as the first one.
    fn check_width(&self, number: usize, width: usize) -> Result<(), Unreadable> {
        ensure!(
            WIDTHS.contains(&width),
            "line {number}: {width} fields, which are neither 2, 3, 9 nor 14; {SAY_SO}"
        );
        ensure!(
            self.shape.width == 0 || self.shape.width == width,
            "line {number}: {width} fields, but {} in the first line; {SAY_SO}",
            self.shape.width
        );
        Ok(())
    }

    /// The pairs, if the file can be nothing else.
    fn into_list(mut self) -> Result<List<'t>, Unreadable> {
        if let Some([first, second]) = self.names.take()
            && (self.list.has(&first) || self.list.has(&second))
        {
            self.list.pair(1, label(first), label(second))?;
        }
        ensure!(!self.list.pairs.is_empty(), "the file holds no pair");
        self.shape.check(&self.list)?;
        Ok(self.list)
    }
}

/// Whether two fields are one of the pairs of names that heads have.
fn is_head(first: &Field, second: &Field) -> bool {
    let lower = [first, second].map(|field| field.text.to_ascii_lowercase());
    let lower = [&lower[0][..], &lower[1][..]];
    HEADS.contains(&lower)
}

/// Reads the first two fields of each line.
pub(super) fn lenient(text: &[u8]) -> Result<Graph, Unreadable> {
    lenient_list(text)?.into_graph(None)
}

/// The same, with the nodes by their labels.
pub(super) fn lenient_with_labels(text: &[u8]) -> Result<(Graph, Names), Unreadable> {
    lenient_list(text)?.into_graph_and_names()
}

fn lenient_list(text: &[u8]) -> Result<List<'_>, Unreadable> {
    let (mut list, mut rest, mut number, mut fields) = (List::new(text), text, 0, Vec::new());
    while !rest.is_empty() {
        number += 1;
        split(next_line(&mut rest), true, &mut fields)
            .map_err(|reason| format!("line {number}: {reason}"))?;
        match &fields[..] {
            [] => {}
            [only] => drop(list.node(label(only.text.clone()))),
            [first, second, ..] => {
                list.pair(
                    number,
                    label(first.text.clone()),
                    label(second.text.clone()),
                )?;
            }
        }
    }
    ensure!(!list.labels.is_empty(), "the file holds no graph");
    Ok(list)
}

/// Takes a line without its end.
pub(super) fn next_line<'t>(rest: &mut &'t [u8]) -> &'t [u8] {
    let end = rest.iter().position(|&byte| byte == b'\n');
    let (line, after) = match end {
        Some(end) => (&rest[..end], &rest[end + 1..]),
        None => (*rest, &[][..]),
    };
    *rest = after;
    line.strip_suffix(b"\r").unwrap_or(line)
}

/// A label of a node: an integer if it is one.
fn label(text: Cow<'_, [u8]>) -> Label<'_> {
    (integer(&text), text)
}

/// The value of a decimal integer without leading zeros below 2^64.
pub(super) fn integer(text: &[u8]) -> Option<u64> {
    if !text.iter().all(u8::is_ascii_digit) || text.len() > 1 && text[0] == b'0' {
        return None;
    }
    std::str::from_utf8(text).ok()?.parse().ok()
}

/// The most common line: two integers of at most 19 digits between blanks, tabs and one comma.
/// Returns what is behind the line too; `None` if the line has to be looked at more closely.
#[inline(always)]
fn two_integers(text: &[u8]) -> Option<([Digits<'_>; 2], &[u8])> {
    let (first, rest) = digits(text)?;
    let blanks = blanks(rest);
    let (comma, blanks) = match rest.get(blanks) {
        Some(b',') => (1, blanks + 1 + self::blanks(&rest[blanks + 1..])),
        _ => (0, blanks),
    };
    let (second, rest) = digits(&rest[blanks..])?;
    if blanks + comma == 0 {
        return None;
    }
    let rest = &rest[self::blanks(rest)..];
    match rest {
        [b'\n', after @ ..] | [b'\r', b'\n', after @ ..] => Some(([first, second], after)),
        [] => Some(([first, second], rest)),
        _ => None,
    }
}

#[inline(always)]
fn blanks(text: &[u8]) -> usize {
    let is_blank = |byte: &&u8| matches!(byte, b' ' | b'\t');
    text.iter().take_while(is_blank).count()
}

/// From 1 to 19 digits (which are below 2^64), no zero before others.
#[inline(always)]
fn digits(text: &[u8]) -> Option<(Digits<'_>, &[u8])> {
    let (mut value, mut length) = (0u64, 0);
    while let Some(byte @ b'0'..=b'9') = text.get(length) {
        value = value.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
        length += 1;
    }
    let single = length == 1 || length > 1 && text[0] != b'0';
    let (number, rest) = text.split_at(length);
    (single && length < 20).then_some(((value, number), rest))
}

/// What is between separators: a label, or a number.
pub(super) struct Field<'t> {
    pub(super) text: Cow<'t, [u8]>,
    quoted: bool,
}

/// Takes field after field from a line.
struct Fields<'t> {
    line: &'t [u8],
    at: usize,
    read: usize,
    /// Whether anything may be a label.
    any: bool,
}

impl<'t> Fields<'t> {
    fn next(&mut self) -> Result<Option<Field<'t>>, &'static str> {
        let mut commas = 0;
        while let Some(byte @ (b' ' | b'\t' | b',')) = self.line.get(self.at) {
            commas += usize::from(*byte == b',');
            self.at += 1;
        }
        let rest = &self.line[self.at..];
        let end = matches!(rest, [] | [b'#' | b'%', ..]);
        // One comma between two fields, and none before the first or behind the last.
        if commas > usize::from(self.read > 0 && !end) {
            return Err("an empty field, before, behind or between commas");
        }
        if end {
            return Ok(None);
        }
        self.read += 1;
        let quoted = rest[0] == b'"';
        let (text, length) = if quoted {
            in_quotes(rest)?
        } else {
            self.plain(rest)?
        };
        self.at += length;
        Ok(Some(Field { text, quoted }))
    }

    /// A field that is not quoted, with its length.
    fn plain(&self, rest: &'t [u8]) -> Result<(Cow<'t, [u8]>, usize), &'static str> {
        let length = rest.iter().position(is_separator).unwrap_or(rest.len());
        let text = &rest[..length];
        if text.contains(&b'"') {
            return Err("a quotation mark within a field");
        }
        let named = |byte: &u8| byte.is_ascii_alphanumeric() || !byte.is_ascii();
        if !self.any && (!text.iter().any(named) || text.starts_with(b"//")) {
            return Err("a field without letters and digits, or that begins with `//`");
        }
        Ok((Cow::Borrowed(text), length))
    }
}

fn is_separator(byte: &u8) -> bool {
    matches!(byte, b' ' | b'\t' | b',')
}

/// A quoted field: its text, and its length with the quotes.
fn in_quotes(rest: &[u8]) -> Result<(Cow<'static, [u8]>, usize), &'static str> {
    let (mut text, mut at) = (Vec::new(), 1);
    loop {
        let inner = &rest[at..];
        let quote = inner.iter().position(|&byte| byte == b'"');
        let quote = quote.ok_or("a quotation mark that is not closed")?;
        text.extend_from_slice(&inner[..quote]);
        at += quote + 1;
        match rest.get(at) {
            Some(b'"') => text.push(b'"'),
            Some(byte) if !is_separator(byte) => return Err("text right behind a quoted field"),
            _ if text.is_empty() => return Err("an empty quoted field"),
            _ => return Ok((Cow::Owned(text), at)),
        }
        at += 1;
    }
}

/// All fields of a line, with or without labels of which anything may be one.
pub(super) fn split<'t>(
    line: &'t [u8],
    any: bool,
    fields: &mut Vec<Field<'t>>,
) -> Result<(), &'static str> {
    fields.clear();
    let mut line = Fields {
        line,
        at: 0,
        read: 0,
        any,
    };
    while let Some(field) = line.next()? {
        fields.push(field);
    }
    Ok(())
}

/// Whether a field has the form `[+-]?(d+(.d*)?|.d+)([eE][+-]?d+)?` and is not quoted.
fn is_number(field: &Field) -> bool {
    fn after_digits(text: &[u8]) -> (usize, &[u8]) {
        let count = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
        (count, &text[count..])
    }
    fn after_sign(text: &[u8]) -> &[u8] {
        match text {
            [b'+' | b'-', rest @ ..] => rest,
            _ => text,
        }
    }
    let (whole, rest) = after_digits(after_sign(&field.text));
    let (part, rest) = match rest {
        [b'.', rest @ ..] => after_digits(rest),
        _ => (0, rest),
    };
    let exponent = match rest {
        [] => true,
        [b'e' | b'E', rest @ ..] => matches!(after_digits(after_sign(rest)), (1.., [])),
        _ => false,
    };
    !field.quoted && whole + part > 0 && exponent
}

/// What the lines look like together, to tell an edge list from other tables of numbers.
struct Shape {
    /// The number of fields of every line; 0 before the first one.
    width: usize,
    lines: u64,
    /// The first line's integers, if all fields so far are integers in two columns.
    counts: Option<[u64; 2]>,
    /// Whether all fields so far are 0 or 1.
    bits: bool,
    /// Whether all lines so far are integers a < b < c; with the largest c, and the largest b.
    stars: bool,
    largest: [u64; 2],
}

impl Default for Shape {
    fn default() -> Shape {
        Shape {
            width: 0,
            lines: 0,
            counts: None,
            bits: true,
            stars: true,
            largest: [0; 2],
        }
    }
}

impl Shape {
    #[inline(always)]
    fn add_integers(&mut self, a: u64, b: u64) {
        self.bits &= a | b <= 1;
        if self.lines == 0 {
            self.counts = Some([a, b]);
        }
        (self.width, self.lines) = (2, self.lines + 1);
    }

    fn add(&mut self, fields: &[Field]) {
        let value = |field: &Field| integer(&field.text).filter(|_| !field.quoted);
        let values: Option<Vec<u64>> = fields.iter().map(value).collect();
        match values.as_deref() {
            Some(&[a, b]) => return self.add_integers(a, b),
            Some(&[a, b, c]) if self.stars && a < b && b < c => {
                self.largest = [self.largest[0].max(c), self.largest[1].max(b)];
            }
            _ => self.stars = false,
        }
        self.bits &= values.is_some_and(|values| values.iter().all(|&value| value <= 1));
        self.counts = None;
        (self.width, self.lines) = (fields.len(), self.lines + 1);
    }

    fn check(&self, list: &List) -> Result<(), Unreadable> {
        if let Some([x, y]) = self.counts
            && Some(y) == self.lines.checked_sub(1)
        {
            // The labels of the first line count only if they are in another one.
            let in_first = |label: &u32| {
                !list.pairs[1..]
                    .iter()
                    .any(|&(a, b)| a == *label || b == *label)
            };
            let (first, second) = list.pairs[0];
            let only_there = [first, second]
                .iter()
                .filter(|label| in_first(label))
                .count();
            ensure!(
                x < (list.labels.len() - only_there) as u64,
                "the first line may be a pair, or the numbers of nodes and of lines; take it away \
                 if they are numbers; {SAY_SO}"
            );
        }
        ensure!(
            !(self.bits && self.lines == self.width as u64),
            "the file may be an adjacency matrix; {SAY_SO}"
        );
        let [c, b] = self.largest;
        ensure!(
            !(self.stars && self.width == 3 && c <= b.saturating_add(1)),
            "the file may be a list of triples of nodes; {SAY_SO}"
        );
        Ok(())
    }
}

/// Pairs of labels, numbered as they come.
struct List<'t> {
    /// The numbers of labels that are small integers, which are most, ...
    table: Vec<u32>,
    table_limit: u64,
    /// ... and of all others.
    map: HashMap<Cow<'t, [u8]>, u32>,
    labels: Vec<Label<'t>>,
    pairs: Vec<(u32, u32)>,
}

impl<'t> List<'t> {
    fn new(text: &[u8]) -> List<'t> {
        List {
            table: Vec::new(),
            // So that the table is not larger than the file.
            table_limit: text.len() as u64,
            map: HashMap::new(),
            labels: Vec::new(),
            pairs: Vec::new(),
        }
    }

    #[inline(always)]
    fn node(&mut self, label: Label<'t>) -> u32 {
        let number = match label.0 {
            Some(small) if small < self.table_limit => {
                let least = small as usize + 1;
                if self.table.len() < least {
                    self.table.resize(least, u32::MAX);
                }
                &mut self.table[small as usize]
            }
            _ => self.map.entry(label.1.clone()).or_insert(u32::MAX),
        };
        if *number == u32::MAX {
            *number = self.labels.len() as u32;
            self.labels.push(label);
        }
        *number
    }

    fn has(&self, text: &[u8]) -> bool {
        self.map.contains_key(text)
    }

    #[inline(always)]
    fn pair(&mut self, line: usize, first: Label<'t>, second: Label<'t>) -> Result<(), Unreadable> {
        let pair = (self.node(first), self.node(second));
        ensure!(pair.0 != pair.1, "line {line}: a node paired with itself");
        ensure!(
            self.pairs.len() < 1 << 31,
            "2^31 pairs and more are too many"
        );
        self.pairs.push(pair);
        Ok(())
    }

    /// The graph, and its nodes by their labels.
    fn into_graph_and_names(self) -> Result<(Graph, Names), Unreadable> {
        let mut names = Names::new();
        let graph = self.into_graph(Some(&mut names))?;
        Ok((graph, names))
    }

    /// Numbers the nodes in the order of their labels, which are written down if that is wanted.
    fn into_graph(self, names: Option<&mut Names>) -> Result<Graph, Unreadable> {
        let labels = &self.labels;
        let all_integers = labels.iter().all(|(value, _)| value.is_some());
        let mut order: Vec<usize> = (0..labels.len()).collect();
        if all_integers {
            order.sort_unstable_by_key(|&k| labels[k].0);
        } else {
            order.sort_unstable_by_key(|&k| &labels[k].1);
        }
        let mut node = vec![0; labels.len()];
        order
            .into_iter()
            .zip(0..)
            .for_each(|(k, place)| node[k] = place);
        if let Some(names) = names {
            let numbered = labels.iter().zip(&node);
            names.extend(numbered.map(|((_, text), &node)| (text.to_vec(), node)));
        }
        // Consumed, so that the graph's edges take their place in memory.
        let pairs = self.pairs.into_iter();
        Graph::new(
            labels.len(),
            pairs.map(|(a, b)| (node[a as usize], node[b as usize])),
        )
    }
}

#[cfg(test)]
mod tests;
