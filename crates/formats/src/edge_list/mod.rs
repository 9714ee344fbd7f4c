//! Edge lists: text with one pair a line.
//!
//! The grammar is section 2 of docs/certificate.md: fields separated by blanks, tabs or a comma,
//! as many on each line, 2, 3, 9 or 14 of them, of which the first two are labels and the others
//! numbers that are of no concern here; quotes, comments, a head. A text that could be something
//! else is refused. Whoever knows better asks for [`Reading::Lenient`].
//!
//! Nodes are numbered by their sorted labels, so that the numbering does not
//! depend on the order of the lines: numerically if every label is a decimal
//! integer below 2^64 without leading zeros, else bytewise.
//!
//! A list of 10^7 pairs must be read in the time of reading the file. So the
//! usual line, two integers below 2^32, has a parser of its own, and integers
//! become nodes by a bitmap of those that occur; everything else takes the
//! general way, through an index of labels.

use std::io::Read;

use crate::error::{Fault, Place, Problem};
use viewcert::graph::{Graph, GraphError, Labels};
use viewcert::wording::counted;

mod doubts;
pub(super) mod fields;
pub(super) mod nodes;

use doubts::Doubts;
use fields::{Field, integer};
use nodes::{Index, number_integers};

/// The longest line that is read, and the size of a read.
const LINE_LIMIT: usize = 1 << 20;
/// More pairs than that have no numbers in the program.
pub(super) const PAIR_LIMIT: usize = i32::MAX as usize;
/// A text that begins like this says that it is UTF-8.
pub(super) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// How many fields a line may have.
const COLUMNS: [usize; 4] = [2, 3, 9, 14];
/// The first lines take the general way, so that only that one watches for what is short.
const FIRST_LINES: usize = 16;

/// Names that columns of labels have in the heads of tables.
pub(super) const HEADS: [[&str; 2]; 11] = [
    ["source", "target"],
    ["from", "to"],
    ["src", "dst"],
    ["node1", "node2"],
    ["node_1", "node_2"],
    ["image1", "image2"],
    ["image_1", "image_2"],
    ["image_id1", "image_id2"],
    ["name1", "name2"],
    ["name_1", "name_2"],
    ["id1", "id2"],
];

/// How a text is understood.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// As an edge list only if it can be nothing else.
    Strict,
    /// As an edge list: the first two fields of a line are a pair, a single one is a node.
    Lenient,
    /// As lines of so many fields, a pair and numbers, without a head: the file is known to be
    /// written so.
    Columns(usize),
}

/// Reads an edge list: the graph, its labels, and notes about what was merged,
/// ignored or guessed. O(bytes + n log n + m log m); takes
/// at most 16 bytes a pair (24 if a third column holds integers), and for labels that are not
/// small integers an index of them.
///
/// # Errors
/// With the number of the line: whatever the grammar excludes, a pair of a label with itself, a
/// line longer than a mebibyte. Without: an input that cannot be read, or could be something
/// else; no pairs (read leniently: no nodes); more pairs than can be numbered.
pub fn read(input: impl Read, reading: Reading) -> Result<(Graph, Labels, Vec<String>), Fault> {
    let mut collector = Collector {
        reading,
        ..Collector::default()
    };
    collector.read(input)?;
    collector.finish()
}

/// The first line with fields.
struct First {
    line: u64,
    columns: usize,
    labels: [Box<str>; 2],
    head: Head,
}

/// What the first line is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Head {
    /// A pair.
    No,
    /// A head if none of its labels occurs in another line, else a pair.
    ByName,
    /// A head, as a further field is no number.
    ByColumn,
}

/// The pairs read so far.
struct Collector {
    reading: Reading,
    /// Ends are integers as written, or node numbers of `names` once that exists.
    pairs: Vec<(u32, u32)>,
    singles: Vec<u32>,
    names: Option<Index>,
    line: u64,
    fields: Vec<Field>,
    first: Option<First>,
    doubts: Doubts,
    /// Lines read leniently whose further fields were ignored.
    lines_with_more: u64,
}

impl Default for Collector {
    fn default() -> Self {
        Self {
            reading: Reading::Strict,
            pairs: Vec::new(),
            singles: Vec::new(),
            names: None,
            line: 0,
            fields: Vec::new(),
            first: None,
            doubts: Doubts::default(),
            lines_with_more: 0,
        }
    }
}

impl Collector {
    fn read(&mut self, mut input: impl Read) -> Result<(), Fault> {
        let mut buffer = vec![0; LINE_LIMIT];
        let mut filled = 0;
        loop {
            let got = match input.read(&mut buffer[filled..]) {
                Ok(got) => got,
                Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
                Err(error) => return Err(Place::Input.fault(error.into())),
            };
            let end = filled + got;
            if got == 0 {
                return self.lines(&buffer[..end]);
            }
            let Some(last) = buffer[filled..end].iter().rposition(|&b| b == b'\n') else {
                if end == buffer.len() {
                    // What the line is says more than how long it is.
                    self.text_of(self.line + 1, &buffer[..end])?;
                    let problem = Problem::LineTooLong { limit: LINE_LIMIT };
                    return Err(Place::Line(self.line + 1).fault(problem));
                }
                filled = end;
                continue;
            };
            let complete = filled + last + 1;
            self.lines(&buffer[..complete])?;
            if self.pairs.len() > PAIR_LIMIT {
                return Err(Place::Input.fault(Problem::TooManyPairs));
            }
            buffer.copy_within(complete..end, 0);
            filled = end - complete;
        }
    }

    /// Reads whole lines; the last one may lack its line feed.
    fn lines(&mut self, mut text: &[u8]) -> Result<(), Fault> {
        if self.line == 0 {
            text = text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text);
        }
        loop {
            text = self.plain_lines(text);
            if text.is_empty() {
                return Ok(());
            }
            self.line += 1;
            let end = text.iter().position(|&b| b == b'\n');
            self.any_line(&text[..end.unwrap_or(text.len())])?;
            text = end.map_or(&[], |end| &text[end + 1..]);
        }
    }

    /// Reads lines of two small integers and plain numbers as long as there are any, and returns
    /// what follows them. What is wrong with a line is left to the general way.
    fn plain_lines<'a>(&mut self, text: &'a [u8]) -> &'a [u8] {
        if self.names.is_some() {
            return text;
        }
        let columns = match (&self.first, self.reading) {
            (_, Reading::Lenient) => {
                return self.plain_pairs(text, |further, _, _| {
                    let (more, rest) = ignored(further)?;
                    Some((u64::from(more), rest))
                });
            }
            (_, Reading::Columns(columns)) => columns,
            (Some(first), Reading::Strict) if self.pairs.len() >= FIRST_LINES => first.columns,
            _ => return text,
        };
        if columns == 2 {
            return self.plain_pairs(text, |further, _, _| Some((0, line_end(further)?)));
        }
        let mut doubts = std::mem::take(&mut self.doubts);
        let rest = self.plain_pairs(text, |further, a, b| {
            let (third, rest) = further_numbers(further, columns)?;
            if doubts.watch_thirds() {
                let third = std::str::from_utf8(third).ok().and_then(integer);
                doubts.third(Some([a.into(), b.into()]), third);
            }
            Some((0, rest))
        });
        self.doubts = doubts;
        rest
    }

    /// Reads lines of two small integers while `end` accepts what follows these on a line: then
    /// it says what to add to the lines with more fields, and what follows the line.
    #[inline]
    fn plain_pairs<'a>(
        &mut self,
        mut text: &'a [u8],
        mut end: impl FnMut(&'a [u8], u32, u32) -> Option<(u64, &'a [u8])>,
    ) -> &'a [u8] {
        let mut pairs = std::mem::take(&mut self.pairs);
        let (before, mut with_more) = (pairs.len(), 0);
        while let Some((a, b, further)) = small_pair(text)
            && a != b
            && let Some((more, rest)) = end(further, a, b)
        {
            pairs.push((a, b));
            with_more += more;
            text = rest;
        }
        self.line += (pairs.len() - before) as u64;
        self.lines_with_more += with_more;
        self.pairs = pairs;
        text
    }

    /// A line as text, without its end.
    fn text_of<'a>(&self, line: u64, bytes: &'a [u8]) -> Result<&'a str, Fault> {
        let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
        text(bytes).map_err(|problem| Place::Line(line).fault(problem))
    }

    fn any_line(&mut self, line: &[u8]) -> Result<(), Fault> {
        let text = self.text_of(self.line, line)?;
        let mut fields = std::mem::take(&mut self.fields);
        let done = fields::split(text, &mut fields)
            .map_err(|problem| Place::Line(self.line).fault(problem))
            .and_then(|()| match self.reading {
                Reading::Strict => self.strict_line(text, &fields),
                Reading::Lenient => self.lenient_line(text, &fields),
                Reading::Columns(columns) => self.line_of(columns, text, &fields),
            });
        self.fields = fields;
        done
    }

    fn lenient_line(&mut self, text: &str, fields: &[Field]) -> Result<(), Fault> {
        match fields {
            [] => Ok(()),
            [only] => {
                let label = &*only.text(text);
                let [node, _] = self.nodes([label, label])?;
                self.singles.push(node);
                Ok(())
            }
            [first, second, further @ ..] => {
                self.lines_with_more += u64::from(!further.is_empty());
                let [a, b] = self.nodes([&*first.text(text), &*second.text(text)])?;
                self.pair(a, b)
            }
        }
    }

    fn line_of(&mut self, columns: usize, text: &str, fields: &[Field]) -> Result<(), Fault> {
        let fault = |problem| Err(Place::Line(self.line).fault(problem));
        let found = fields.len();
        match fields {
            [] => Ok(()),
            _ if names_with_blanks(text, fields) => fault(Problem::Blanks { found }),
            [first, second, further @ ..] if found == columns => {
                if let Some(at) = further.iter().position(|field| !field.is_number(text)) {
                    return fault(Problem::NoNumber {
                        field: further[at].text(text).into_owned(),
                        column: at + 3,
                    });
                }
                let [a, b] = self.nodes([&*first.text(text), &*second.text(text)])?;
                self.pair(a, b)
            }
            _ => fault(Problem::OtherColumns {
                found,
                expected: columns,
            }),
        }
    }

    fn strict_line(&mut self, text: &str, fields: &[Field]) -> Result<(), Fault> {
        let fault = |problem| Err(Place::Line(self.line).fault(problem));
        if fields.is_empty() {
            if text.trim_matches([' ', '\t']) == "#" {
                self.doubts.lone_hash(self.pairs.len());
            }
            return Ok(());
        }
        if names_with_blanks(text, fields) {
            let found = fields.len();
            return fault(Problem::Blanks { found });
        }
        for field in fields.iter().filter(|field| !field.quoted) {
            if let Some(problem) = unlike_a_field(field.raw(text)) {
                return fault(problem);
            }
        }
        let found = fields.len();
        match &self.first {
            None if !COLUMNS.contains(&found) => return fault(Problem::Columns { found }),
            Some(first) if first.columns != found => {
                return fault(Problem::ColumnsDiffer {
                    found,
                    expected: first.columns,
                    line: first.line,
                });
            }
            _ => {}
        }
        let (labels, further) = fields.split_at(2);
        let no_number = further.iter().position(|field| !field.is_number(text));
        let texts = [labels[0].text(text), labels[1].text(text)];
        if self.first.is_none() {
            let names = [&*texts[0], &*texts[1]];
            let is_pair = |[a, b]: [&str; 2]| {
                HEADS.iter().any(|[first, second]| {
                    first.eq_ignore_ascii_case(a) && second.eq_ignore_ascii_case(b)
                })
            };
            let numbered = labels.iter().any(|field| field.is_number(text));
            let head = match no_number {
                Some(_) if !numbered => {
                    let all: Vec<_> = fields.iter().map(|field| field.text(text)).collect();
                    let mut pairs = all.windows(2).skip(1);
                    if pairs.any(|pair| is_pair([&*pair[0], &*pair[1]])) {
                        return fault(Problem::HeadBehind);
                    }
                    Head::ByColumn
                }
                None if is_pair(names) => Head::ByName,
                _ => Head::No,
            };
            self.first = Some(First {
                line: self.line,
                columns: found,
                labels: names.map(Box::from),
                head,
            });
            if head != Head::No {
                self.doubts.head();
                return Ok(());
            }
        }
        if let Some(at) = no_number {
            return fault(Problem::NoNumber {
                field: further[at].text(text).into_owned(),
                column: at + 3,
            });
        }
        for field in labels.iter().filter(|field| !field.quoted) {
            if let Some(problem) = unlike_a_label(field.raw(text)) {
                return fault(problem);
            }
        }
        if self.pairs.len() < FIRST_LINES {
            let bit = |field: &Field| !field.quoted && matches!(field.raw(text), "0" | "1");
            self.doubts.short_line(fields.iter().all(bit));
        }
        self.doubts.quotes(labels.iter().any(|field| field.quoted));
        if self.doubts.watch_thirds() {
            let ends = labels[0].integer(text).zip(labels[1].integer(text));
            let third = further.first().and_then(|field| field.integer(text));
            self.doubts.third(ends.map(|(a, b)| [a, b]), third);
        }
        let [a, b] = self.nodes([&*texts[0], &*texts[1]])?;
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

    #[inline]
    fn pair(&mut self, a: u32, b: u32) -> Result<(), Fault> {
        // A first line like `5 5` may be counts, which only the end of the text tells.
        if a == b && !(self.pairs.is_empty() && self.reading == Reading::Strict) {
            return Err(self.self_loop(self.line, a));
        }
        self.pairs.push((a, b));
        Ok(())
    }

    fn self_loop(&self, line: u64, node: u32) -> Fault {
        let label = match &self.names {
            Some(names) => names.labels().swap_remove(node as usize).into(),
            None => node.to_string(),
        };
        Place::Line(line).fault(Problem::SelfLoop(label))
    }

    fn finish(mut self) -> Result<(Graph, Labels, Vec<String>), Fault> {
        let fault = |problem| Place::Input.fault(problem);
        if self.pairs.len() > PAIR_LIMIT {
            return Err(fault(Problem::TooManyPairs));
        }
        let mut notes = Vec::new();
        if let Some(first) = self.first.take() {
            if let Some(head) = self.head(&first)? {
                notes.push(head);
            }
            let (pairs, names) = (&self.pairs, self.names.as_ref());
            if let Some(problem) = self.doubts.settle(pairs, names, &first) {
                return Err(fault(problem));
            }
            if let Some(&(a, b)) = self.pairs.first()
                && a == b
            {
                return Err(self.self_loop(first.line, a));
            }
            match first.columns {
                3 => notes.push("the third column is ignored (weights)".to_owned()),
                columns @ 4.. => notes.push(ignored_columns(columns)),
                _ => {}
            }
        }
        let Self {
            reading,
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
        // Both refusals are impossible here: loops were refused line by line,
        // and every end was numbered.
        let (graph, merged) = Graph::from_pairs(nodes, pairs).map_err(|error| match error {
            GraphError::SelfLoop(node) => fault(Problem::SelfLoop(labels.label(node).into())),
            GraphError::OutOfRange { .. } => fault(Problem::TooManyNodes),
        })?;
        notes.extend(crate::merged(merged));
        if let Reading::Columns(columns @ 3..) = reading {
            notes.push(ignored_columns(columns));
        }
        if lines_with_more > 0 {
            let lines = counted(lines_with_more as usize, "line");
            notes.push(format!("fields behind the second are ignored on {lines}"));
        }
        Ok((graph, labels, notes))
    }

    /// Settles whether the first line is a head: then a note about it, else the pair is taken in.
    fn head(&mut self, first: &First) -> Result<Option<String>, Fault> {
        if first.head == Head::No {
            return Ok(None);
        }
        let known = |label: &str| {
            self.names
                .as_ref()
                .is_some_and(|names| names.nodes.contains_key(label))
        };
        if !first.labels.iter().any(|label| known(label)) {
            if self.pairs.is_empty() {
                return Err(Place::Input.fault(Problem::OnlyHead));
            }
            let [a, b] = &first.labels;
            let more = if first.columns > 2 { ",..." } else { "" };
            return Ok(Some(format!("the first line is a head: {a},{b}{more}")));
        }
        self.line = first.line;
        if first.head == Head::ByColumn {
            return Err(Place::Line(self.line).fault(Problem::HeadOrPair));
        }
        let [a, b] = self.nodes([&first.labels[0], &first.labels[1]])?;
        self.pairs.insert(0, (a, b));
        self.doubts.no_head();
        Ok(None)
    }
}

fn ignored_columns(columns: usize) -> String {
    format!("columns 3 to {columns} are ignored (relative poses)")
}

/// Whether a reader of edge lists may take a text for one. It does not if a line is such that the
/// grammar excludes it, whatever else `verify` refuses on top of that.
pub(super) fn may_be(text: &str) -> bool {
    let mut fields = Vec::new();
    let mut columns = None;
    for line in text.lines() {
        if fields::split(line, &mut fields).is_err() {
            return false;
        }
        let [a, b, further @ ..] = &fields[..] else {
            if fields.is_empty() {
                continue;
            }
            return false;
        };
        let found = fields.len();
        let mut plain = fields.iter().filter(|field| !field.quoted);
        if !COLUMNS.contains(&found) || plain.any(|f| unlike_a_field(f.raw(line)).is_some()) {
            return false;
        }
        // The first line may be a head.
        let pair = a.text(line) != b.text(line) && further.iter().all(|f| f.is_number(line));
        if columns
            .replace(found)
            .is_some_and(|columns| columns != found || !pair)
        {
            return false;
        }
    }
    columns.is_some()
}

/// Endings of the names of images.
const IMAGES: [&str; 12] = [
    ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".bmp", ".ppm", ".pgm", ".webp", ".heic", ".dng",
    ".exr",
];

/// Whether a line of more than two fields ends like the name of an image, as just one field
/// before does: two names with blanks in them.
fn names_with_blanks(line: &str, fields: &[Field]) -> bool {
    let is_image = |field: &Field| {
        let name = field.raw(line);
        !field.quoted
            && IMAGES.iter().any(|end| {
                let start = name.len().checked_sub(end.len());
                start.is_some_and(|start| {
                    name.get(start..)
                        .is_some_and(|tail| tail.eq_ignore_ascii_case(end))
                })
            })
    };
    fields.len() > 2
        && fields.last().is_some_and(is_image)
        && fields.iter().filter(|field| is_image(field)).count() == 2
}

/// Bytes as text without control characters but tabs.
///
/// # Errors
/// What makes them no text.
pub(super) fn text(bytes: &[u8]) -> Result<&str, Problem> {
    if let Some(&byte) = bytes.iter().find(|b| b.is_ascii_control() && **b != b'\t') {
        return Err(match byte {
            _ if bytes.contains(&0) => Problem::Nul,
            b'\r' => Problem::CarriageReturn,
            _ => Problem::Control(byte),
        });
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if text.contains('\u{feff}') => Err(Problem::InnerMark),
        Ok(text) => Ok(text),
        Err(_) => Err(Problem::NotUtf8),
    }
}

/// Why an unquoted field is neither a label nor a number.
fn unlike_a_field(field: &str) -> Option<Problem> {
    let word = field.bytes().any(|b| b.is_ascii_alphanumeric() || b > 0x7f);
    (!word || field.starts_with("//")).then(|| Problem::NoLabel(field.to_owned()))
}

/// Why an unquoted field, which is no number, is punctuated like no label but like a part of
/// another notation: `(1` of `(1, 2)`, `2;` of `1 2;`, `key:` of `key: value`.
fn unlike_a_label(field: &str) -> Option<Problem> {
    let punctuated = field.ends_with([';', ':']) || !brackets_close(field);
    punctuated.then(|| Problem::Punctuated(field.to_owned()))
}

/// Whether every bracket in a field has its partner there.
fn brackets_close(field: &str) -> bool {
    let mut open = Vec::new();
    for byte in field.bytes() {
        match byte {
            b'(' => open.push(b')'),
            b'[' => open.push(b']'),
            b'{' => open.push(b'}'),
            b')' | b']' | b'}' if open.pop() != Some(byte) => return false,
            _ => {}
        }
    }
    open.is_empty()
}

/// Two small integers at the start of a line with one separator between them, and what follows.
#[inline]
fn small_pair(text: &[u8]) -> Option<(u32, u32, &[u8])> {
    let (a, rest) = small_integer(text)?;
    let rest = match rest {
        [b' ' | b'\t' | b',', rest @ ..] => rest,
        _ => return None,
    };
    let (b, rest) = small_integer(rest)?;
    Some((a, b, rest))
}

/// What follows a line that has nothing more but blanks.
#[inline]
fn line_end(mut text: &[u8]) -> Option<&[u8]> {
    if let [b'\n', rest @ ..] = text {
        return Some(rest);
    }
    while let [b' ' | b'\t', rest @ ..] = text {
        text = rest;
    }
    match text {
        [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => Some(rest),
        _ => None,
    }
}

/// The third of `columns` fields, if it and all further ones are numbers after one separator each,
/// and what follows the line.
#[inline]
fn further_numbers(text: &[u8], columns: usize) -> Option<(&[u8], &[u8])> {
    let mut third = None;
    let mut text = text;
    for _ in 2..columns {
        let [b' ' | b'\t' | b',', rest @ ..] = text else {
            return None;
        };
        let end = rest.iter().position(|b| !b.is_ascii_digit())?;
        let end = match rest[end] {
            b' ' | b'\t' | b',' | b'\n' | b'\r' if end > 0 => end,
            _ => {
                let plain = |b: &u8| matches!(b, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E');
                let end = rest.iter().position(|b| !plain(b))?;
                if !fields::is_number(&rest[..end]) {
                    return None;
                }
                end
            }
        };
        third.get_or_insert(&rest[..end]);
        text = &rest[end..];
    }
    Some((third?, line_end(text)?))
}

/// Whether a line goes on with further fields, and what follows it; `None` if it has
/// anything but plain characters, or a comma that no such character follows.
#[inline]
fn ignored(text: &[u8]) -> Option<(bool, &[u8])> {
    match text {
        [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => return Some((false, rest)),
        [b' ' | b'\t' | b',', ..] => {}
        _ => return None,
    }
    let mut more = false;
    let mut comma = false;
    let stop = text.iter().position(|byte| match byte {
        b' ' | b'\t' => comma,
        b',' => std::mem::replace(&mut comma, true),
        b'$' | b'&'..=b'~' => {
            comma = false;
            more = true;
            false
        }
        _ => true,
    })?;
    let rest = line_end(&text[stop..])?;
    (!comma).then_some((more, rest))
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

#[cfg(test)]
mod tests;
