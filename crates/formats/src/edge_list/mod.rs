//! Edge lists: text with one pair a line.
//!
//! The grammar is that of docs/input.md: fields separated by blanks, tabs or a comma,
//! as many on each line, 2, 3, 9 or 14 of them, of which the first two are labels and the others
//! numbers that are of no concern here; quotes, comments, a head. Tables whose pairs stand elsewhere
//! are cut as their first lines show (`layout`). A text that could be something
//! else is refused. Whoever knows better asks for [`Reading::Lenient`].
//!
//! Nodes are numbered by their sorted labels, so that the numbering does not
//! depend on the order of the lines: numerically if every label is a decimal
//! integer below 2^64 without leading zeros, else bytewise.
//!
//! A list of 10^7 pairs must be read in the time of reading the file. So the
//! usual line, two integers below 2^32, has a parser of its own (`plain`), which runs on all
//! cores, and integers become nodes by a bitmap of those that occur; everything else takes the
//! general way, through an index of labels.

use std::collections::HashSet;
use std::io::{self, Read};

use crate::error::{Fault, Place, Problem};
use crate::read_as::{Parsed, ReadAs};
use viewcert::graph::{Graph, GraphError, Labels};
use viewcert::wording::counted;

mod counts;
pub(super) mod decimal;
mod doubts;
pub(super) mod fields;
mod heads;
pub(super) mod layout;
mod marks;
pub(super) mod nodes;
mod plain;
mod plausible;
mod poses;
mod triangles;

use decimal::Decimal;
use doubts::Doubts;
use fields::{Field, integer, is_number};
use layout::{Layout, ListOptions};
use nodes::{Index, number_integers};
use plain::{Plain, further_numbers, ignored, line_end};

/// The longest line that is read, with its end.
const LINE_LIMIT: usize = 1 << 20;
/// How much is read at once: enough for all cores.
const READ: usize = 8 << 20;
/// More pairs than that have no numbers in the program.
pub(super) const PAIR_LIMIT: usize = i32::MAX as usize;
/// A text that begins like this says that it is UTF-8.
pub(super) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
/// How many fields a line may have.
const COLUMNS: [usize; 4] = [2, 3, 9, 14];
/// The first lines take the general way, so that only that one watches for what is short.
const FIRST_LINES: usize = 16;

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
pub fn read(input: impl Read, reading: Reading) -> Result<Parsed, Fault> {
    read_with(input, reading, None, &ListOptions::default())
}

/// The same, cut by a layout if it is a table, with the options of whoever asks.
pub(super) fn read_with(
    input: impl Read,
    reading: Reading,
    layout: Option<Layout>,
    options: &ListOptions,
) -> Result<Parsed, Fault> {
    let mut collector = Collector {
        reading,
        layout,
        min_weight: options.min_weight.clone(),
        skip_loops: options.skip_loops,
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
    names: Vec<Box<str>>,
    /// It weighs less than is asked for, if it is a pair.
    light: bool,
    head: Head,
}

/// What the first line is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Head {
    /// A pair.
    No,
    /// A head if it looks like one besides all other lines, and a pair if not.
    Perhaps,
    /// A head, as a further field is no number.
    ByColumn,
    /// A head, as the user or its names say.
    Sure,
}

/// The pairs read so far.
struct Collector {
    reading: Reading,
    /// How lines are cut, if the text is a table.
    layout: Option<Layout>,
    min_weight: Option<Decimal>,
    skip_loops: bool,
    /// Lines whose pair weighs less.
    light: u64,
    /// Pairs of a label with itself that were left out.
    loops: u64,
    /// Lines that are nothing but a comment.
    comments: u64,
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
    /// How many bytes the last plain lines have, if nothing else followed them.
    trusted: usize,
    /// Memory for the lines of a part of the text.
    buffers: Vec<Plain>,
}

impl Default for Collector {
    fn default() -> Self {
        Self {
            reading: Reading::Strict,
            layout: None,
            min_weight: None,
            skip_loops: false,
            light: 0,
            loops: 0,
            comments: 0,
            pairs: Vec::new(),
            singles: Vec::new(),
            names: None,
            line: 0,
            fields: Vec::new(),
            first: None,
            doubts: Doubts::default(),
            lines_with_more: 0,
            trusted: 0,
            buffers: Vec::new(),
        }
    }
}

impl Collector {
    /// Reads a text; the next part of it comes in while the lines of the last one are read.
    fn read(&mut self, mut input: impl Read) -> Result<(), Fault> {
        let failed = |error: io::Error| Place::Input.fault(error.into());
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
                return Err(Place::Input.fault(Problem::TooManyPairs));
            }
            is_full = filled.map_err(failed)?;
            std::mem::swap(&mut text, &mut next);
        }
        self.lines(&text)
    }

    /// What is wrong with the line after those that were read, which is too long: what it is
    /// says more than how long it is.
    fn long_line(&self, line: &[u8]) -> Fault {
        let too_long = Place::Line(self.line + 1).fault(Problem::LineTooLong { limit: LINE_LIMIT });
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

    /// Reads plain lines as long as there are any, and returns what follows them. What is wrong
    /// with a line is left to the general way.
    fn plain_lines<'a>(&mut self, text: &'a [u8]) -> &'a [u8] {
        if self.names.is_some() || self.layout.is_some() {
            return text;
        }
        let columns = match (&self.first, self.reading) {
            (_, Reading::Lenient) => return self.parts::<true>(text, ignored),
            (_, Reading::Columns(columns)) => columns,
            (Some(first), Reading::Strict) if self.pairs.len() >= FIRST_LINES => first.columns,
            _ => return text,
        };
        let without_more = |rest| (false, rest);
        if columns == 2 {
            return self.parts::<true>(text, |further| line_end(further).map(without_more));
        }
        if self.reading != Reading::Strict || !self.doubts.watch_thirds() {
            return self.parts::<false>(text, |further| {
                further_numbers(further, columns).map(|(_, rest)| (false, rest))
            });
        }
        // Line by line as long as third fields matter, which is short for most texts.
        let doubts = &mut self.doubts;
        let mut watched = Plain::default();
        plain::read::<false>(text, &mut watched, |further, a, b| {
            let (third, rest) = further_numbers(further, columns)?;
            if !doubts.watch_thirds() {
                return None;
            }
            let third = std::str::from_utf8(third).ok().and_then(integer);
            doubts.third(Some([a.into(), b.into()]), third);
            Some((false, rest))
        });
        self.take(&watched);
        let rest = &text[watched.length..];
        if self.doubts.watch_thirds() {
            rest
        } else {
            self.plain_lines(rest)
        }
    }

    /// Takes in plain lines at the start of a text, read on all cores, and returns what follows them.
    fn parts<'a, const BARE: bool>(
        &mut self,
        text: &'a [u8],
        end: impl Fn(&'a [u8]) -> plain::End<'a> + Sync,
    ) -> &'a [u8] {
        let mut buffers = std::mem::take(&mut self.buffers);
        let mut length = 0;
        plain::read_parts::<BARE>(text, self.trusted, &mut buffers, end, |plain| {
            self.take(plain);
            length += plain.length;
        });
        self.buffers = buffers;
        self.trusted = if length == text.len() { length } else { 0 };
        &text[length..]
    }

    fn take(&mut self, plain: &Plain) {
        self.line += plain.pairs.len() as u64;
        self.lines_with_more += plain.with_more;
        self.pairs.extend_from_slice(&plain.pairs);
    }

    /// A line as text, without its end.
    fn text_of<'a>(&self, line: u64, bytes: &'a [u8]) -> Result<&'a str, Fault> {
        let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
        text(bytes).map_err(|problem| Place::Line(line).fault(problem))
    }

    fn any_line(&mut self, line: &[u8]) -> Result<(), Fault> {
        let text = self.text_of(self.line, line)?;
        let mut fields = std::mem::take(&mut self.fields);
        let split = match &self.layout {
            Some(layout) => layout.split(text, &mut fields),
            None => fields::split(text, &mut fields),
        };
        let done = split
            .map_err(|problem| Place::Line(self.line).fault(problem))
            .and_then(|()| match (&self.layout, self.reading) {
                _ if fields.is_empty() => {
                    self.no_fields(text);
                    Ok(())
                }
                (Some(_), _) => self.table_line(text, &fields),
                (None, Reading::Strict) => self.strict_line(text, &fields),
                (None, Reading::Lenient) => self.lenient_line(text, &fields),
                (None, Reading::Columns(columns)) => self.line_of(columns, text, &fields),
            });
        self.fields = fields;
        done
    }

    /// A line that is blank or a comment.
    fn no_fields(&mut self, text: &str) {
        let text = text.trim_matches([' ', '\t']);
        self.comments += u64::from(!text.is_empty());
        if text == "#" {
            self.doubts.lone_hash(self.pairs.len());
        }
    }

    /// A line of a table: only the columns of the pair and of its weight matter.
    fn table_line(&mut self, text: &str, fields: &[Field]) -> Result<(), Fault> {
        let place = Place::Line(self.line);
        let fault = |problem| Err(place.clone().fault(problem));
        let Some(layout) = &self.layout else {
            return Ok(());
        };
        let (ends, weight) = (layout.ends, layout.weight);
        let found = fields.len();
        // Fields between blanks may go on; those of a table may not.
        let needed = ends.into_iter().chain(weight).max().unwrap_or(0) + 1;
        let even = found == layout.columns || layout.separator.is_none() && found >= needed;
        if !even {
            let (expected, line) = (layout.columns, self.first.as_ref().map_or(1, |f| f.line));
            return fault(Problem::ColumnsDiffer {
                found,
                expected,
                line,
            });
        }
        let labels = ends.map(|end| fields[end]);
        let texts = labels.map(|field| field.text(text));
        let names = [&*texts[0], &*texts[1]];
        if self.first.is_none() {
            let numbered = labels.iter().any(|field| field.is_number(text));
            let head = match &layout.head {
                Some(_) => Head::Sure,
                None if numbered => Head::No,
                None => Head::Perhaps,
            };
            self.begin(text, fields, ends, head);
            if head == Head::Sure {
                return Ok(());
            }
            if head == Head::Perhaps {
                let light = self.is_light(text, fields);
                if let Some(first) = &mut self.first {
                    match light {
                        Ok(light) => first.light = light,
                        Err(_) => first.head = Head::ByColumn,
                    }
                }
                return Ok(());
            }
        }
        for (field, column) in labels.iter().zip(ends) {
            if field.raw(text).is_empty() {
                return fault(Problem::NoName { column: column + 1 });
            }
            if !field.quoted
                && let Some(problem) = unlike_a_label(field.raw(text))
            {
                return fault(problem);
            }
        }
        if self.is_light(text, fields)? {
            self.light += 1;
            return Ok(());
        }
        self.doubts.quotes(labels.iter().any(|field| field.quoted));
        self.named(names)
    }

    /// Whether the pair of a line weighs less than is asked for.
    fn is_light(&self, text: &str, fields: &[Field]) -> Result<bool, Fault> {
        let layout = self.layout.as_ref();
        let column = layout.and_then(|layout| Some((layout.weight?, layout.separator)));
        let (Some((column, separator)), Some(least)) = (column, &self.min_weight) else {
            return Ok(false);
        };
        let given = fields[column].text(text);
        // Where semicolons separate, commas are points.
        let given = match separator {
            Some(b';') => given.replace(',', "."),
            _ => given.into_owned(),
        };
        match given.parse::<Decimal>() {
            Ok(weight) => Ok(weight < *least),
            Err(_) => Err(Place::Line(self.line).fault(Problem::NoWeight {
                field: given,
                column: column + 1,
            })),
        }
    }

    /// Keeps the first line.
    fn begin(&mut self, text: &str, fields: &[Field], ends: [usize; 2], head: Head) {
        let names = fields.iter().map(|field| field.text(text).into());
        self.first = Some(First {
            line: self.line,
            columns: fields.len(),
            labels: ends.map(|end| fields[end].text(text).into()),
            names: names.collect(),
            light: false,
            head,
        });
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
                let numbered = first.is_number(text) || second.is_number(text);
                if self.line_is_first() && !numbered {
                    self.begin(text, fields, [0, 1], Head::Perhaps);
                    return Ok(());
                }
                self.lines_with_more += u64::from(!further.is_empty());
                self.named([&*first.text(text), &*second.text(text)])
            }
        }
    }

    fn line_is_first(&self) -> bool {
        self.first.is_none() && self.pairs.is_empty() && self.singles.is_empty()
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
                self.named([&*first.text(text), &*second.text(text)])
            }
            _ => fault(Problem::OtherColumns {
                found,
                expected: columns,
            }),
        }
    }

    fn strict_line(&mut self, text: &str, fields: &[Field]) -> Result<(), Fault> {
        let place = Place::Line(self.line);
        let fault = |problem| Err(place.clone().fault(problem));
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
            let numbered = labels.iter().any(|field| field.is_number(text));
            let head = match no_number {
                _ if numbered => Head::No,
                Some(_) => Head::ByColumn,
                None => Head::Perhaps,
            };
            self.begin(text, fields, [0, 1], head);
            let mut plain = labels.iter().filter(|field| !field.quoted);
            let problem = plain.find_map(|field| unlike_a_label(field.raw(text)));
            let problem = problem.or_else(|| poses::problem(text, further));
            match problem.filter(|_| head == Head::Perhaps) {
                Some(problem) => return fault(problem),
                None if head != Head::No => return Ok(()),
                None => {}
            }
        }
        if let Some(at) = no_number {
            return fault(Problem::NoNumber {
                field: further[at].text(text).into_owned(),
                column: at + 3,
            });
        }
        if self.pairs.len() < FIRST_LINES {
            if let Some(problem) = poses::problem(text, further) {
                return fault(problem);
            }
            let bit = |field: &Field| !field.quoted && matches!(field.raw(text), "0" | "1");
            self.doubts.short_line(fields.iter().all(bit));
        }
        self.doubts.quotes(labels.iter().any(|field| field.quoted));
        if self.doubts.watch_thirds() {
            let ends = labels[0].integer(text).zip(labels[1].integer(text));
            let third = further.first().and_then(|field| field.integer(text));
            self.doubts.third(ends.map(|(a, b)| [a, b]), third);
        }
        let known = self.names.as_ref().map(|names| names.nodes.len());
        self.named([&*texts[0], &*texts[1]])?;
        // Labels that were there before have been looked at.
        if self.names.as_ref().map(|names| names.nodes.len()) != known {
            let mut plain = labels.iter().filter(|field| !field.quoted);
            if let Some(problem) = plain.find_map(|field| unlike_a_label(field.raw(text))) {
                return fault(problem);
            }
        }
        Ok(())
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

    /// A pair of labels. One with itself that is left out is no camera by that.
    fn named(&mut self, labels: [&str; 2]) -> Result<(), Fault> {
        if self.skip_loops && labels[0] == labels[1] {
            self.loops += 1;
            return Ok(());
        }
        let [a, b] = self.nodes(labels)?;
        self.pair(a, b)
    }

    #[inline]
    fn pair(&mut self, a: u32, b: u32) -> Result<(), Fault> {
        // A first line like `5 5` may be counts, which only the end of the text tells.
        let is_first = || {
            self.first
                .as_ref()
                .is_none_or(|first| first.line == self.line)
        };
        if a == b && !(self.reading == Reading::Strict && self.pairs.is_empty() && is_first()) {
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

    fn finish(mut self) -> Result<Parsed, Fault> {
        let fault = |problem| Place::Input.fault(problem);
        if self.pairs.len() > PAIR_LIMIT {
            return Err(fault(Problem::TooManyPairs));
        }
        let mut notes = Vec::new();
        let mut read = ReadAs::new("edge list");
        if let Some(first) = self.first.take() {
            let known = self.knows_first(&first);
            let head = self.head(&first)?;
            let is_head = head.is_some();
            // The first line is a pair of cameras that are in no other.
            let lone = !is_head
                && first.head == Head::Perhaps
                && !known
                && !first.light
                && first.labels[0] != first.labels[1]
                && self.pairs.len() > 1;
            let asked = self.layout.as_ref().is_some_and(|layout| layout.asked);
            if let Some(head) = head {
                read.guessed.push(head.clone());
                notes.push(head);
            }
            let (pairs, names) = (&self.pairs, self.names.as_ref());
            let strict = self.reading == Reading::Strict;
            let doubt = self.doubts.settle(pairs, names, &first);
            let doubt = doubt.filter(|_| strict && self.layout.is_none());
            let lines = counts::Lines {
                pairs,
                names,
                first: &first,
                head: is_head.then(|| heads::may_be_pair(&first.labels[0], &first.labels[1])),
                left_out: self.light + self.loops,
            };
            let doubt = doubt.or_else(|| lines.problem().filter(|_| !self.doubts.has_quotes()));
            let doubt = doubt.or_else(|| plausible::problem(pairs, names));
            let below = || {
                let is_odd = lone && !self.doubts.has_quotes();
                is_odd
                    .then(|| plausible::problem(&pairs[1..], names))
                    .flatten()
            };
            let doubt = doubt.or_else(below);
            match doubt {
                Some(problem) if strict => return Err(fault(problem)),
                Some(problem) => notes.push(problem.to_string()),
                None if strict && first.columns == 9 && plausible::is_one_star(pairs) => {
                    notes.push(format!(
                        "the first column is {} on all lines: is this a list of pairs?",
                        first.labels[0]
                    ));
                }
                None if lone && self.is_odd(asked) => notes.push(format!(
                    "the cameras of the first line, {}, are in no other pair: delete it if it is a head",
                    first.labels.join(" and ")
                )),
                None => {}
            }
            if let Some(&(a, b)) = self.pairs.first()
                && a == b
            {
                return Err(self.self_loop(first.line, a));
            }
            if self.layout.is_none() && strict {
                match first.columns {
                    3 => read.ignored.push("column 3 (weights?)".to_owned()),
                    columns @ 4.. => read.ignored.push(ignored_columns(columns)),
                    _ => {}
                }
            }
        }
        if self.pairs.is_empty() && self.singles.is_empty() {
            return Err(fault(Problem::NoNodes));
        }
        self.say(&mut read);
        let odd = plausible::odd_columns(&self.pairs, self.names.as_ref());
        let Self {
            reading,
            mut pairs,
            singles,
            names,
            ..
        } = self;
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
        read.merged = merged;
        notes.extend(crate::merged(merged));
        if reading == Reading::Strict {
            let has_names = matches!(labels, Labels::Names(_));
            notes.extend(plausible::note(&graph, has_names).or(odd));
        }
        Ok(Parsed {
            graph,
            labels,
            read,
            notes,
        })
    }

    /// Says what was taken and what was left out.
    fn say(&self, read: &mut ReadAs) {
        let kind = if self.names.is_some() {
            "names"
        } else {
            "numbers"
        };
        read.taken = Some(match &self.layout {
            Some(layout) => layout.taken(kind),
            None => format!("{kind} in columns 1 and 2"),
        });
        let mut ignore = |phrase: String| read.ignored.push(phrase);
        if let Some(columns) = self.layout.as_ref().and_then(Layout::ignored) {
            ignore(columns);
        }
        if let Reading::Columns(columns @ 3..) = self.reading {
            ignore(ignored_columns(columns));
        }
        let lines = |count: u64| counted(count as usize, "line");
        if self.lines_with_more > 0 {
            ignore(format!(
                "fields behind the second on {}",
                lines(self.lines_with_more)
            ));
        }
        if self.comments > 0 {
            ignore(format!("{} of comments", lines(self.comments)));
        }
        if let Some(least) = self.min_weight.as_ref().filter(|_| self.light > 0) {
            ignore(format!("{} with a weight below {least}", lines(self.light)));
        }
        if self.loops > 0 {
            let pair = if self.loops == 1 { "pairs" } else { "pair" };
            let lines = lines(self.loops);
            ignore(format!("{lines} that {pair} a camera with itself"));
        }
    }

    /// Whether a label of the first line, which has not been taken in, is known from another.
    fn knows_first(&self, first: &First) -> bool {
        let mut labels = first.labels.iter();
        let names = self.names.as_ref();
        names.is_some_and(|names| labels.any(|label| names.nodes.contains_key(label)))
    }

    /// Whether the first pair, which is alone, could be a head after all: the user has named columns of
    /// several lines, or those below hang together.
    fn is_odd(&self, asked: bool) -> bool {
        let nodes = self.names.as_ref().map_or(0, |names| names.nodes.len());
        let below = &self.pairs[1..];
        asked && below.len() > 1 || plausible::hang_together(below, nodes)
    }

    /// Settles whether the first line is a head: then a note about it, else the pair is taken in.
    fn head(&mut self, first: &First) -> Result<Option<String>, Fault> {
        if first.head == Head::No {
            return Ok(None);
        }
        let labels = [&*first.labels[0], &*first.labels[1]];
        let known = self.knows_first(first);
        let unlike = match &self.names {
            Some(names) => {
                let mut texts = vec![""; names.nodes.len()];
                for (label, &node) in &names.nodes {
                    texts[node as usize] = label;
                }
                let texts = &texts;
                let column = |second| {
                    let end = move |pair: &(u32, u32)| if second { pair.1 } else { pair.0 };
                    // Lines one after another mostly have their first ends in common.
                    let runs = self.pairs.chunk_by(move |one, next| end(one) == end(next));
                    runs.map(move |run| texts[end(&run[0]) as usize])
                };
                let below = || plausible::hang_together(&self.pairs, texts.len());
                heads::look_unlike(labels, [false, true].map(column))
                    || !known && heads::stand_apart(labels, texts.iter().copied(), below)
            }
            None if self.pairs.is_empty() => {
                heads::look_unlike(labels, [(); 2].map(|()| std::iter::empty()))
            }
            None => true,
        };
        let asked = self.layout.as_ref().is_some_and(|layout| layout.asked);
        // A weight stands in a line with a pair.
        let weighed = first.names[2..]
            .iter()
            .any(|name| is_number(name.as_bytes()));
        let unlike = unlike && (!weighed || heads::is_pair(labels[0], labels[1]));
        let is_head = match first.head {
            Head::No => false,
            Head::Perhaps => {
                unlike && !known && !(self.pairs.is_empty() && self.reading == Reading::Lenient)
            }
            Head::ByColumn | Head::Sure if known && !asked => {
                return Err(Place::Line(first.line).fault(Problem::HeadOrPair));
            }
            Head::ByColumn | Head::Sure => true,
        };
        if is_head {
            self.doubts.head();
            return self.is_head(first).map(Some);
        }
        self.line = first.line;
        if first.light {
            self.light += 1;
            return Ok(None);
        }
        if self.skip_loops && labels[0] == labels[1] {
            self.loops += 1;
            return Ok(None);
        }
        let [a, b] = self.nodes(labels)?;
        if a == b {
            return Err(self.self_loop(first.line, a));
        }
        self.pairs.insert(0, (a, b));
        self.doubts.one_more();
        self.lines_with_more += u64::from(self.reading == Reading::Lenient && first.columns > 2);
        Ok(None)
    }

    /// A note about a head, which names cameras or leaves open what it names.
    fn is_head(&self, first: &First) -> Result<String, Fault> {
        if self.pairs.is_empty() && self.light == 0 && self.loops == 0 {
            return Err(Place::Input.fault(Problem::OnlyHead));
        }
        let asked = self.layout.as_ref().is_some_and(|layout| layout.asked);
        let other = first.labels.iter().find(|name| heads::is_no_camera(name));
        if let Some(name) = other.filter(|_| !asked) {
            let name = name.to_string();
            return Err(Place::Line(first.line).fault(Problem::NoCameras { name }));
        }
        let shown = first.shown();
        if first.has_three_alike() && !asked {
            return Err(Place::Line(first.line).fault(Problem::NoPairOfNames { head: shown }));
        }
        let told = asked || first.head == Head::Sure || self.reading == Reading::Lenient;
        if !told && !self.heads_pairs(first) {
            return Err(Place::Line(first.line).fault(Problem::NoPairOfNames { head: shown }));
        }
        Ok(format!("the first line is a head: {shown}"))
    }

    /// Whether a head names a pair, or what stands below its first two names looks like one; with more
    /// than two columns, the third one has to be one of weights then.
    fn heads_pairs(&self, first: &First) -> bool {
        const MOST: usize = 1 << 16;
        let [a, b] = &first.labels;
        let weights = first.names.get(2).is_none_or(|name| heads::is_weight(name));
        let below = || {
            let pairs = || self.pairs.iter().take(MOST);
            let starts: HashSet<u32> = pairs().map(|pair| pair.0).collect();
            let images = |names: &Index| names.nodes.keys().all(|label| is_image(label));
            pairs().any(|pair| starts.contains(&pair.1)) || self.names.as_ref().is_some_and(images)
        };
        heads::is_pair(a, b) || weights && (heads::could_be_pair(a, b) || below())
    }
}

impl First {
    /// Whether these are three names that are the same but for numbers.
    fn has_three_alike(&self) -> bool {
        let shapes: Vec<String> = self.names.iter().map(|name| heads::shape(name)).collect();
        matches!(&shapes[..], [first, second, third] if first == second && second == third)
    }

    /// Its first fields.
    fn shown(&self) -> String {
        const SHOWN: usize = 4;
        let mut names: Vec<&str> = self.names.iter().take(SHOWN).map(|name| &**name).collect();
        if self.names.len() > SHOWN {
            names.push("...");
        }
        names.join(",")
    }
}

fn ignored_columns(columns: usize) -> String {
    format!("columns 3 to {columns} (relative poses)")
}

/// Reads on until a text is as long as what is read at once, and whether it is.
fn fill(input: &mut impl Read, text: &mut Vec<u8>) -> io::Result<bool> {
    let room = READ - text.len();
    let got = input.by_ref().take(room as u64).read_to_end(text)?;
    Ok(got == room)
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

/// Whether a label ends like the name of an image.
pub(super) fn is_image(name: &str) -> bool {
    IMAGES.iter().any(|end| {
        let start = name.len().checked_sub(end.len());
        let tail = start.and_then(|start| name.get(start..));
        tail.is_some_and(|tail| tail.eq_ignore_ascii_case(end))
    })
}

/// Whether a line of more than two fields ends like the name of an image, as just one field
/// before does: two names with blanks in them.
fn names_with_blanks(line: &str, fields: &[Field]) -> bool {
    let is_image = |field: &Field| !field.quoted && is_image(field.raw(line));
    // Times of images are no parts of their names.
    let timed = fields.len() == 4 && fields[0].is_number(line) && fields[2].is_number(line);
    fields.len() > 2
        && !timed
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
    if !field.bytes().any(|b| b"()[]{}".contains(&b)) {
        return true;
    }
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
