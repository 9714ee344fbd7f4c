//! Lists of pairs: text with one pair a line.
//!
//! The grammar is that of docs/input.md: one separator, as many fields on each line, and either a head that
//! names two columns with images or nodes (`table`, `names`), or two labels, and perhaps a number or a pose,
//! that nothing speaks against being a pair (`likely`). Everything else is refused (`refusal`). Whoever knows
//! better asks for [`Reading::Lenient`].
//!
//! Nodes are numbered by their sorted labels, so that the numbering does not
//! depend on the order of the lines: numerically if every label is a decimal
//! integer below 2^64 without leading zeros, else bytewise.
//!
//! A list of 10^7 pairs must be read in the time of reading the file. So the
//! usual line, two integers below 2^32, has a parser of its own (`plain`), which runs on all
//! cores, and integers become nodes by a bitmap of those that occur; everything else takes the
//! general way, through an index of labels.

use std::io::{self, Read};

use crate::error::{Fault, Kind, Place, Problem};
use crate::read_as::{Parsed, ReadAs};
use viewcert::wording::counted;

pub(super) mod columns;
pub(super) mod decimal;
pub(super) mod fields;
mod likely;
pub(super) mod names;
pub(super) mod nodes;
mod plain;
mod poses;
pub mod refusal;
pub(super) mod table;

use columns::ListOptions;
use decimal::Decimal;
use fields::{Field, Separator, integer, is_number};
use likely::List;
use names::is_image;
use nodes::{Index, number_integers};
use refusal::{head, shown};
use table::{Head, Layout, layout};

/// The longest line that is read, with its end.
const LINE_LIMIT: usize = 1 << 20;
/// How much is read at once: enough for all cores.
const READ: usize = 8 << 20;
/// More pairs than that have no numbers in the program.
pub(super) const PAIR_LIMIT: usize = i32::MAX as usize;
/// A text that begins like this says that it is UTF-8.
pub(super) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// The first lines take the general way, so that only that one watches for what is seldom.
const FIRST_LINES: usize = 64;

/// How a text is understood.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reading {
    /// As an edge list only if it can be nothing else.
    #[default]
    Strict,
    /// As an edge list: the first two fields of a line are a pair, a single one is a node.
    Lenient,
}

/// Reads a list that begins with `head`, which is all of it if `whole`: the graph, its labels, and notes
/// about what was merged, ignored or guessed. O(bytes + n log n + m log m); takes at most 16 bytes a pair,
/// and for labels that are not small integers an index of them.
///
/// # Errors
/// With the number of the line: whatever the grammar excludes, a pair of a label with itself, a line
/// longer than a mebibyte. Without: an input that cannot be read, or could be something else; no pairs
/// (read leniently: no nodes); more pairs than can be numbered.
pub(super) fn read_with(
    input: impl Read,
    (head, whole): (&[u8], bool),
    reading: Reading,
    options: &ListOptions,
) -> Result<Parsed, Fault> {
    let layout = layout(head, whole, reading, options);
    let mut collector = Collector {
        reading,
        layout: layout?,
        min_weight: options.min_weight.clone(),
        skip_loops: options.skip_loops,
        ..Collector::default()
    };
    collector.read(input)?;
    collector.finish()
}

/// Reads a whole list.
///
/// # Errors
/// As for files.
pub fn read(text: &[u8], reading: Reading) -> Result<Parsed, Fault> {
    read_with(text, (text, true), reading, &ListOptions::default())
}

/// The pairs read so far.
#[derive(Default)]
struct Collector {
    reading: Reading,
    layout: Layout,
    min_weight: Option<Decimal>,
    skip_loops: bool,
    /// The first line, while it is a head, and its labels.
    head: Option<(u64, [Box<str>; 2])>,
    /// Lines whose pair weighs less.
    light: u64,
    /// Lines that pair a label with itself.
    loops: Vec<(u64, Box<str>)>,
    /// Lines that are nothing but a comment.
    comments: u64,
    /// Ends are integers as written, or node numbers of `names` once that exists.
    pairs: Vec<(u32, u32)>,
    singles: Vec<u32>,
    names: Option<Index>,
    /// The third fields of the first pairs, where they are integers.
    thirds: Vec<Option<u32>>,
    /// Whether the first label of a list without a head is an integer.
    integers: Option<bool>,
    /// The length of the first integer, whether others have another one, and whether zeros begin any.
    lengths: (usize, bool, bool),
    line: u64,
    /// The first line with fields.
    first: Option<u64>,
    fields: Vec<Field>,
    /// Lines read leniently whose further fields were ignored.
    lines_with_more: u64,
    /// How many bytes the last plain lines have, if nothing else followed them.
    trusted: usize,
    /// Memory for the lines of a part of the text.
    buffers: Vec<plain::Plain>,
}

impl Collector {
    /// Reads a text; the next part of it comes in while the lines of the last one are read.
    fn read(&mut self, mut input: impl Read) -> Result<(), Fault> {
        let failed = |error: io::Error| Fault::from(Problem::from(error));
        let (mut text, mut next) = (Vec::new(), Vec::new());
        let mut is_full = fill(&mut input, &mut text).map_err(failed)?;
        while is_full {
            let last = text.iter().rposition(|&b| b == b'\n');
            let complete = last.map_or(0, |last| last + 1);
            let (lines, rest) = text.split_at(complete);
            if rest.len() > LINE_LIMIT {
                self.lines(lines)?;
                return Err(self.long_line(rest));
            }
            next.clear();
            next.extend_from_slice(rest);
            let mut read = Ok(());
            // The input need not be of a kind that another thread may read.
            let filled = rayon::in_place_scope(|scope| {
                scope.spawn(|_| read = self.lines(lines));
                fill(&mut input, &mut next)
            });
            read?;
            if self.pairs.len() > PAIR_LIMIT {
                return Err(Problem::too_many_pairs().into());
            }
            is_full = filled.map_err(failed)?;
            std::mem::swap(&mut text, &mut next);
        }
        self.lines(&text)
    }

    /// What is wrong with the line after those that were read, which is too long: what it is
    /// says more than how long it is.
    fn long_line(&self, line: &[u8]) -> Fault {
        let too_long = Place::Line(self.line + 1).fault(too_long());
        self.text_of(self.line + 1, line).err().unwrap_or(too_long)
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
            let end = text.iter().position(|&b| b == b'\n');
            let line = &text[..end.unwrap_or(text.len())];
            if line.len() >= LINE_LIMIT {
                return Err(self.long_line(line));
            }
            self.line += 1;
            self.any_line(line)?;
            text = end.map_or(&[], |end| &text[end + 1..]);
        }
    }

    /// Reads plain lines as long as there are any, on all cores, and returns what follows them. What is
    /// wrong with a line is left to the general way.
    fn plain_lines<'a>(&mut self, text: &'a [u8]) -> &'a [u8] {
        let is_usual = self.layout.is_usual() && self.names.is_none();
        if !is_usual || self.pairs.len() < FIRST_LINES {
            return text;
        }
        self.lengths.1 = true;
        let width = self.layout.first.max(2);
        let has_more = self.layout.width.is_none() && width > 2;
        let mut buffers = std::mem::take(&mut self.buffers);
        let mut length = 0;
        plain::read_parts(text, self.trusted, &mut buffers, width, |(pairs, bytes)| {
            self.line += pairs.len() as u64;
            self.lines_with_more += pairs.len() as u64 * u64::from(has_more);
            self.pairs.extend_from_slice(pairs);
            length += bytes;
        });
        self.buffers = buffers;
        self.trusted = if length == text.len() { length } else { 0 };
        &text[length..]
    }

    /// A line as text, without its end.
    fn text_of<'a>(&self, line: u64, bytes: &'a [u8]) -> Result<&'a str, Fault> {
        let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
        text(bytes).map_err(|problem| Place::Line(line).fault(problem))
    }

    fn any_line(&mut self, line: &[u8]) -> Result<(), Fault> {
        let text = self.text_of(self.line, line)?;
        let mut fields = std::mem::take(&mut self.fields);
        let split = self.layout.split(text, &mut fields);
        let done = split.and_then(|()| {
            if fields.is_empty() {
                self.comments += u64::from(!text.trim_matches([' ', '\t']).is_empty());
                return Ok(());
            }
            let is_first = self.first.is_none();
            self.first.get_or_insert(self.line);
            self.line_of(text, &fields, is_first)
        });
        self.fields = fields;
        done.map_err(|problem| Place::Line(self.line).fault(problem))
    }

    /// Takes in a line with fields.
    fn line_of(&mut self, line: &str, fields: &[Field], is_first: bool) -> Result<(), Problem> {
        let (found, is_own) = (fields.len(), self.layout.head == Head::Own);
        if let ([only], None) = (fields, self.layout.width) {
            let [node, _] = self.nodes([&only.text(line); 2])?;
            self.singles.push(node);
            return Ok(());
        }
        let expected = self.layout.width.or(is_own.then_some(2));
        if let Some(expected) = expected.filter(|&expected| expected != found) {
            let first = self.first.filter(|_| !is_first);
            return Err(Problem::uneven(found, expected, first));
        }
        let ends = self.layout.ends.map(|end| fields[end]);
        let labels = ends.map(|field| field.text(line));
        let labels = [&*labels[0], &*labels[1]];
        if is_first && self.layout.has_line() {
            self.head = Some((self.line, labels.map(Into::into)));
            return Ok(());
        }
        self.check(line, fields, ends)?;
        self.lines_with_more += u64::from(self.layout.width.is_none() && found > 2);
        if self.is_light(line, fields)? {
            self.light += 1;
            return Ok(());
        }
        if labels[0] == labels[1] {
            self.loops.push((self.line, labels[0].into()));
            return Ok(());
        }
        if self.layout.width == Some(3) && self.pairs.len() < FIRST_LINES {
            let third = fields[3 - self.layout.ends[0] - self.layout.ends[1]].text(line);
            self.thirds.push(third.parse().ok());
        }
        let [a, b] = self.nodes(labels)?;
        self.pairs.push((a, b));
        Ok(())
    }

    /// Refuses what is no pair of labels with numbers behind.
    fn check(&mut self, line: &str, fields: &[Field], ends: [Field; 2]) -> Result<(), Problem> {
        let is_strict = self.reading == Reading::Strict;
        let bare = matches!(self.layout.head, Head::None | Head::Comment);
        for field in ends {
            let label = field.raw(line);
            if label.is_empty() {
                return Err(Problem::empty_field());
            }
            if field.quoted || self.is_known(label) {
                continue;
            }
            if let Some(refusal) = unlike_a_label(label).filter(|_| is_strict) {
                return Err(refusal);
            }
            let blanks = label.contains([' ', '\t']) && !is_image(label);
            let commas = label.contains(',') && self.layout.separator != Separator::Byte(b';');
            if (blanks || commas) && bare {
                return Err(Problem::quotes(label, BLANKS));
            }
        }
        if !is_strict || !matches!(self.layout.head, Head::None | Head::Line) {
            return Ok(());
        }
        for field in ends {
            self.kind(&field.text(line))?;
        }
        if self.layout.head == Head::Line {
            return Ok(());
        }
        for (field, at) in fields[2..].iter().zip(3..) {
            let text = self.layout.number(field.raw(line));
            if text.is_empty() {
                return Err(Problem::empty_field());
            }
            if field.quoted || !is_number(text.as_bytes()) {
                let what = format!("field {at}, `{}`, is no number", shown(&text));
                return Err(Problem::lines(what));
            }
        }
        match self.pairs.len() < FIRST_LINES && !poses::are(line, &fields[2..]) {
            true => Err(Problem::lines(poses::MISSING)),
            false => Ok(()),
        }
    }

    /// Whether a label has been met.
    fn is_known(&self, label: &str) -> bool {
        let names = self.names.as_ref();
        names.is_some_and(|names| names.nodes.contains_key(label))
    }

    /// Takes note of what kind a label is; without a head all are integers, or none is a number.
    fn kind(&mut self, label: &str) -> Result<(), Problem> {
        let digits = label.bytes().all(|b| b.is_ascii_digit());
        if !digits && is_number(label.as_bytes()) {
            let what = "is a number and no integer: coordinates, perhaps";
            return Err(Problem::lines(format!("`{}` {what}", shown(label))));
        }
        if self.layout.head != Head::None {
            return Ok(());
        }
        let integers = *self.integers.get_or_insert(digits);
        if digits != integers {
            let (kind, others) = match integers {
                true => ("no integer", "integers"),
                false => ("a number", "names"),
            };
            let label = shown(label);
            let what = format!("`{label}` is {kind}, and the labels before it are {others}");
            return Err(Problem::lines(what));
        }
        let (first, differ, padded) = &mut self.lengths;
        *first = if *first == 0 { label.len() } else { *first };
        *differ |= *first != label.len();
        *padded |= digits && label.len() > 1 && label.starts_with('0');
        Ok(())
    }

    /// Whether the pair of a line weighs less than is asked for.
    fn is_light(&self, line: &str, fields: &[Field]) -> Result<bool, Problem> {
        let (Some(column), Some(least)) = (self.layout.weight, &self.min_weight) else {
            return Ok(false);
        };
        let given = self.layout.number(&fields[column].text(line));
        least.is_above(&given).map_err(|_| {
            let (column, given) = (column + 1, shown(&given));
            let what = format!("--min-weight: field {column}, `{given}`, is no number");
            Problem::columns(what)
        })
    }

    /// The two labels as ends of a pair, in the meaning that `pairs` has then.
    fn nodes(&mut self, labels: [&str; 2]) -> Result<[u32; 2], Problem> {
        let names = match &mut self.names {
            Some(names) => names,
            names => {
                let small = |label| integer(label).and_then(|value| u32::try_from(value).ok());
                if let (Some(a), Some(b)) = (small(labels[0]), small(labels[1])) {
                    return Ok([a, b]);
                }
                // The first label that is not a small integer: from here on labels are text.
                let mut index = Index::default();
                let ends = self.pairs.iter_mut().flat_map(|(a, b)| [a, b]);
                for end in ends.chain(&mut self.singles) {
                    *end = index.node(&end.to_string())?;
                }
                names.insert(index)
            }
        };
        Ok([names.node(labels[0])?, names.node(labels[1])?])
    }

    /// What speaks against the pairs being pairs of cameras.
    fn doubt(&self) -> Option<Problem> {
        let labels = self.names.as_ref().map(Index::labels);
        let values: Option<Vec<u64>> = labels.as_ref().and_then(|labels| {
            let value = |label: &&str| label.parse().ok().filter(|_| !label.starts_with('+'));
            labels.iter().map(value).collect()
        });
        let list = List {
            pairs: &self.pairs,
            labels: labels.as_deref().filter(|_| values.is_none()),
            values,
            loops: &self.loops,
            left_out: self.light + self.loops.len() as u64,
            thirds: &self.thirds,
            width: self.layout.width.unwrap_or(2),
        };
        match self.layout.head {
            Head::None => {
                let commented = self.layout.commented.as_ref().map(|names| {
                    let what = "the comment above the lines names their columns, and no pair";
                    Problem::table(format!("{what}: `{}`", shown(names)))
                });
                commented.or_else(|| list.doubt())
            }
            Head::Asked { line: false } => list.stands_apart(),
            Head::Line | Head::Comment => {
                let names = self.layout.names.as_ref();
                let name = names.map_or("", |names| &*names[self.layout.ends[0]]);
                names::is_general(name).then(|| list.are_copies()).flatten()
            }
            Head::Asked { line: true } | Head::Own => None,
        }
    }

    /// Settles whether the first line is a head: then a note about it, else the pair is taken in.
    fn head(&mut self) -> Result<Option<String>, Fault> {
        let Some((line, labels)) = self.head.take() else {
            return Ok(None);
        };
        let shown = self.layout.names.as_deref().map(head).unwrap_or_default();
        let shapes = labels.each_ref().map(|label| names::shape(label));
        let is_like = |name: &&str| shapes.contains(&names::shape(name));
        let is_label = labels.iter().any(|label| self.is_known(label));
        let is_like = || {
            let names = self.names.as_ref().map(Index::labels);
            names.is_some_and(|names| names.iter().any(is_like))
        };
        if self.layout.head == Head::Line && (is_label || is_like()) {
            let what = "may be a head, and it looks like the labels below";
            let refusal = Problem::odd("first", &shown, what);
            return Err(Place::Line(line).fault(refusal));
        }
        Ok(Some(format!("the first line is a head: {shown}")))
    }

    fn finish(mut self) -> Result<Parsed, Fault> {
        if self.pairs.len() > PAIR_LIMIT {
            return Err(Problem::too_many_pairs().into());
        }
        let mut notes = Vec::new();
        let mut read = ReadAs::new("edge list");
        if let Some(head) = self.head()? {
            read.guessed.push(head.clone());
            notes.push(head);
        }
        if let (_, true, true) = self.lengths {
            let what = "some numbers begin with zeros, and not all have as many digits";
            return Err(Problem::lines(what).into());
        }
        match self.doubt() {
            Some(doubt) if self.reading == Reading::Strict => return Err(doubt.into()),
            Some(doubt) => notes.push(doubt.what),
            None => {}
        }
        if let (Some((line, label)), false) = (self.loops.first(), self.skip_loops) {
            let problem = Problem::self_loop(label);
            return Err(Place::Line(*line).fault(problem));
        }
        if self.pairs.is_empty() && self.singles.is_empty() {
            return Err(Problem::no_nodes().into());
        }
        self.say(&mut read);
        let Self {
            mut pairs,
            singles,
            names,
            ..
        } = self;
        let (labels, nodes) = match names {
            Some(names) => names.sort(&mut pairs),
            None => number_integers(&mut pairs, &singles),
        };
        let (graph, merged) = nodes::graph(pairs, (&labels, nodes))?;
        read.merged = merged;
        notes.extend(crate::merged(merged));
        Ok(Parsed {
            graph,
            labels,
            read,
            notes,
        })
    }

    /// Says what was taken and what was left out.
    fn say(&self, read: &mut ReadAs) {
        let kind = match self.names {
            Some(_) => "names",
            None => "numbers",
        };
        read.taken = Some(self.layout.taken(kind));
        let mut ignore = |phrase: String| read.ignored.push(phrase);
        self.layout.ignored().into_iter().for_each(&mut ignore);
        let lines = |count: u64| counted(count as usize, "line");
        if self.lines_with_more > 0 {
            let lines = lines(self.lines_with_more);
            ignore(format!("fields behind the second on {lines}"));
        }
        if self.comments > 0 {
            ignore(format!("{} of comments", lines(self.comments)));
        }
        if let Some(least) = self.min_weight.as_ref().filter(|_| self.light > 0) {
            ignore(format!("{} with a weight below {least}", lines(self.light)));
        }
        if !self.loops.is_empty() {
            let lines = lines(self.loops.len() as u64);
            ignore(format!("{lines} with a pair of a camera with itself"));
        }
    }
}

/// Reads on until a text is as long as what is read at once, and whether it is.
fn fill(input: &mut impl Read, text: &mut Vec<u8>) -> io::Result<bool> {
    let room = READ - text.len();
    let got = input.by_ref().take(room as u64).read_to_end(text)?;
    Ok(got == room)
}

/// Bytes as text without control characters but tabs.
///
/// # Errors
/// What makes them no text.
pub(super) fn text(bytes: &[u8]) -> Result<&str, Problem> {
    if let Some(&byte) = bytes.iter().find(|b| b.is_ascii_control() && **b != b'\t') {
        return Err(Problem::control(bytes, byte));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if text.contains('\u{feff}') => {
            let remedy = "remove it; files with such marks cannot be joined byte by byte";
            let what = "there is a byte order mark (U+FEFF) within the text";
            Err(Problem::of(Kind::Other, what, remedy))
        }
        Ok(text) => Ok(text),
        Err(_) => Err(Problem::not_utf8()),
    }
}

/// What is wrong with a field that another separator would cut.
const BLANKS: &str = "has blanks or commas";

/// More than a line.
fn too_long() -> Problem {
    Problem::lines(format!("the line is longer than {LINE_LIMIT} bytes"))
}

/// Why an unquoted field is no label: it has neither letters nor digits, or is punctuated like a part of
/// another notation: `(1` of `(1, 2)`, `2;` of `1 2;`, `key:` of `key: value`.
fn unlike_a_label(field: &str) -> Option<Problem> {
    let word = field.bytes().any(|b| b.is_ascii_alphanumeric() || b > 0x7f);
    if !word || field.starts_with("//") {
        let what = format!(
            "`{}` is neither the name of a camera nor a number",
            shown(field)
        );
        return Some(Problem::lines(what));
    }
    let punctuated = field.ends_with([';', ':']) || !brackets_close(field);
    punctuated.then(|| Problem::quotes(field, "is punctuated like another format"))
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

#[cfg(test)]
mod tests;
