//! How the lines of a list are cut, where the pairs stand in them, and what the head says.
//!
//! In: the first lines of a text, and what the user has said about it. Out: a [`Layout`].

use super::columns::{Column, Columns, ListOptions};
use super::fields::{Field, Separator, is_number};
use super::names::{self, is_image};
use super::refusal::{self, Refusal, shown};
use super::{Reading, fields};
use crate::error::Problem;
use viewcert::wording::counted;

/// How many of the first lines say how all are cut.
const LINES: usize = 200;
/// How many fields a line without a head may have.
const WIDTHS: [usize; 4] = [2, 3, 9, 14];
/// The comment above pairs that this program has written: all lines are pairs or lone nodes.
pub(crate) const OWN: &str = "# viewcert pairs";

/// Whether a text is a list of pairs that this program has written.
pub(crate) fn is_own(head: &[u8]) -> bool {
    head.split(|&byte| byte == b'\n').next() == Some(OWN.as_bytes())
}

/// How the lines of a list are cut and used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) separator: Separator,
    /// How many fields each line has; any number, if the first two are the pair.
    pub(super) width: Option<usize>,
    /// Where the ends of a pair stand.
    pub(super) ends: [usize; 2],
    /// Where its weight stands.
    pub(super) weight: Option<usize>,
    /// What the columns are called.
    pub(super) names: Option<Vec<String>>,
    pub(super) head: Head,
    /// Whether attributes follow the names, as networkx writes them.
    pub(super) attributes: bool,
    /// A comment above the lines that names other columns.
    pub(super) commented: Option<String>,
}

/// What says that a text is a list of pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Head {
    /// Nothing.
    #[default]
    None,
    /// The first line, unless its names are labels.
    Line,
    /// A comment above the first line.
    Comment,
    /// The user, by columns of which the first line has the names, or not.
    Asked { line: bool },
    /// The comment of this program.
    Own,
}

impl Layout {
    /// Whether the first line names the columns.
    pub(super) fn has_line(&self) -> bool {
        matches!(self.head, Head::Line | Head::Asked { line: true })
    }

    /// Whether usual lines may have a parser of their own: the separator of these.
    pub(super) fn is_usual(&self) -> bool {
        self.ends == [0, 1]
            && self.weight.is_none()
            && !self.attributes
            && self.separator != Separator::Byte(b';')
    }

    /// Cuts a line.
    ///
    /// # Errors
    /// As [`Separator::split`]; attributes that are not where others are.
    pub(super) fn split(&self, line: &str, fields: &mut Vec<Field>) -> Result<(), Problem> {
        if !self.attributes {
            return self.separator.split(line, fields);
        }
        let (names, attributes) = names_and_attributes(line);
        fields::split(names, fields)?;
        match (fields.len(), attributes) {
            (0, false) | (2, true) => Ok(()),
            _ => {
                let remedy = "mend the line, or write the list with data=False";
                Err(Refusal::new("two names and `{...}` are expected", remedy).into())
            }
        }
    }

    /// The columns of the pairs, in words.
    pub(super) fn taken(&self, kind: &str) -> String {
        let [first, second] = self.ends.map(|column| column + 1);
        let named = match &self.names {
            Some(names) => {
                let [a, b] = self.ends.map(|column| &*names[column]);
                format!(" ({a}, {b})")
            }
            None => String::new(),
        };
        format!("{kind} in columns {first} and {second}{named}")
    }

    /// What is left out of every line, in words.
    pub(super) fn ignored(&self) -> Option<String> {
        const SHOWN: usize = 4;
        match (self.width, &self.names) {
            _ if self.attributes => return Some("attributes".to_owned()),
            (Some(3), None) if self.ends == [0, 1] => {
                return Some("column 3 (weights?)".to_owned()).filter(|_| self.weight.is_none());
            }
            (Some(width @ (9 | 14)), None) if !matches!(self.head, Head::Asked { .. }) => {
                return Some(format!("columns 3 to {width} (relative poses)"));
            }
            _ => {}
        }
        let used = |column: &usize| self.ends.contains(column) || self.weight == Some(*column);
        let others: Vec<usize> = (0..self.width?).filter(|column| !used(column)).collect();
        let name = |&column: &usize| {
            let name = self.names.as_ref().map(|names| &*names[column]);
            name.filter(|name| !name.is_empty())
                .map_or((column + 1).to_string(), str::to_owned)
        };
        let mut shown: Vec<String> = others.iter().take(SHOWN).map(name).collect();
        if others.len() > SHOWN {
            shown.push(format!("and {} more", others.len() - SHOWN));
        }
        let plural = if others.len() == 1 { "" } else { "s" };
        (!others.is_empty()).then(|| format!("column{plural} {}", shown.join(", ")))
    }
}

/// A line before its `{...}`, which is its end, and whether it has one.
fn names_and_attributes(line: &str) -> (&str, bool) {
    let separates = [' ', '\t', ','];
    let end = line.trim_end_matches(separates);
    let names = end.strip_suffix('}').and_then(|text| {
        let names = text[..text.find('{')?].strip_suffix(separates)?;
        Some(names.trim_end_matches(separates))
    });
    names.map_or((line, false), |names| (names, true))
}

/// The first lines of a text with fields, and the comment right above them.
struct Sample<'a> {
    lines: Vec<&'a str>,
    comment: Option<&'a str>,
    is_own: bool,
}

impl<'a> Sample<'a> {
    fn of(text: &'a str, whole: bool) -> Self {
        let end = match text.rfind('\n') {
            _ if whole => text.len(),
            end => end.unwrap_or(0),
        };
        let (mut lines, mut comment) = (Vec::new(), None);
        for line in text[..end]
            .lines()
            .map(|line| line.trim_matches([' ', '\t']))
        {
            if line.starts_with(['#', '%']) {
                comment = Some(line).filter(|_| lines.is_empty()).or(comment);
            } else if !line.is_empty() {
                lines.push(line);
            }
            if lines.len() == LINES {
                break;
            }
        }
        let is_own = text.lines().next().is_some_and(|line| line == OWN);
        Self {
            lines,
            comment,
            is_own,
        }
    }

    /// The fields of the first lines.
    fn cells(&self, separator: Separator) -> Vec<Vec<String>> {
        let lines = self.lines.iter();
        lines
            .filter_map(|line| texts(line, separator).ok())
            .collect()
    }

    /// Whether the first line has words alone, above a column of numbers or of images.
    fn has_head(&self, separator: Separator) -> bool {
        let cells = self.cells(separator);
        let Some((first, below)) = cells.split_first() else {
            return false;
        };
        let number = |cell: &str| is_number(cell.as_bytes());
        let above = |column: usize, is: fn(&str) -> bool| {
            let mut cells = below.iter().map(|line| line.get(column));
            cells.all(|cell| cell.is_some_and(|cell| is(cell)))
        };
        let images = !first.iter().any(|cell| is_image(cell));
        let headed = |column| above(column, number) || images && above(column, is_image);
        let has_words = first.len() > 1 && !first.iter().any(|cell| number(cell));
        !below.is_empty() && has_words && (0..first.len()).any(headed)
    }

    /// How the lines are cut: by a semicolon, a tab or a comma that cuts all into as many fields, else
    /// by the first of these that the first line has, else by blanks.
    fn separator(&self) -> Separator {
        let mut found = Vec::new();
        let candidates = [b';', b'\t', b','].map(Separator::Byte);
        let even = candidates.into_iter().find(|separator| {
            let mut widths = self.lines.iter().map(|line| {
                let cut = separator.split(line, &mut found);
                // `1 2;` ends with a semicolon, and is not cut by it.
                let is_cut = cut.is_ok() && !ends_open(line, &found);
                if is_cut { found.len() } else { 0 }
            });
            let first = widths.next().unwrap_or(0);
            first > 1 && widths.all(|width| width == first)
        });
        let first = self.lines.first().copied().unwrap_or_default();
        let cuts = |separator: &Separator| matches!(separator, Separator::Byte(byte) if outside_quotes(first, *byte));
        even.or_else(|| candidates.into_iter().find(cuts))
            .unwrap_or(Separator::Blank)
    }
}

/// Whether the last field of a line is empty.
fn ends_open(line: &str, fields: &[Field]) -> bool {
    let last = fields.last();
    line.ends_with(';') && last.is_some_and(|field| field.raw(line).is_empty())
}

/// Whether a byte stands in a line and in no quotes.
fn outside_quotes(line: &str, byte: u8) -> bool {
    line.split('"')
        .step_by(2)
        .any(|part| part.bytes().any(|b| b == byte))
}

/// The fields of a line as text.
fn texts(line: &str, separator: Separator) -> Result<Vec<String>, Problem> {
    let mut found = Vec::new();
    separator.split(line, &mut found)?;
    Ok(found
        .iter()
        .map(|field| field.text(line).into_owned())
        .collect())
}

/// How a text is cut that begins with `head`, which is all of it if `whole`.
///
/// # Errors
/// A first line that is none of a list of pairs; columns and weights that are asked for and not there.
pub(super) fn layout(
    head: &[u8],
    whole: bool,
    reading: Reading,
    options: &ListOptions,
) -> Result<Layout, Problem> {
    let head = String::from_utf8_lossy(head);
    let text = head.strip_prefix('\u{feff}').unwrap_or(&head);
    let sample = Sample::of(text, whole);
    let mut layout = Layout {
        separator: sample.separator(),
        ends: [0, 1],
        ..Layout::default()
    };
    let Some(first) = sample.lines.first() else {
        return match whole {
            true => Ok(layout),
            false => Err(super::too_long()),
        };
    };
    if sample.is_own && reading == Reading::Strict && options.columns.is_none() {
        layout.separator = Separator::Blank;
        layout.head = Head::Own;
        return Ok(layout);
    }
    if options.columns.is_none() && names_and_attributes(first).1 {
        layout.attributes = true;
        layout.width = Some(2);
        return weighed(layout, options);
    }
    let names = texts(first, layout.separator)?;
    layout.width = Some(names.len());
    let comment = sample
        .comment
        .map(|line| line.trim_start_matches(['#', '%', ' ']));
    let comment = comment.and_then(|line| {
        let cut = [layout.separator, Separator::Any];
        cut.into_iter()
            .filter_map(|separator| texts(line, separator).ok())
            .find(|words| words.len() == names.len())
    });
    if let Some(columns) = &options.columns {
        return weighed(asked(layout, columns, names)?, options);
    }
    let by_line = names::pairs_among(&names);
    let by_comment = comment.as_ref().map(|words| names::pairs_among(words));
    match (&by_line[..], by_comment.as_deref()) {
        ([ends], _) => {
            layout.ends = *ends;
            layout.head = Head::Line;
            layout.names = Some(names.clone());
        }
        ([], Some([ends])) => {
            layout.ends = *ends;
            layout.head = Head::Comment;
            layout.names = comment;
        }
        ([], _) => {
            let word = |word: &String| {
                word.starts_with(|c: char| c.is_ascii_alphabetic())
                    && word.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
            };
            let words = comment.filter(|words| words.iter().all(word));
            layout.commented = words.map(|words| words.join(" "));
        }
        _ => {
            let what = format!(
                "the head `{}` names the columns of pairs twice",
                refusal::head(&names)
            );
            return Err(Refusal::columns(what).into());
        }
    }
    if reading == Reading::Lenient && layout.head == Head::None {
        // The first two fields, between whatever separates them.
        if !is_cut(&sample, layout.separator) {
            layout.separator = Separator::Any;
        }
        layout.width = layout.width.filter(|_| options.min_weight.is_some());
    } else if layout.head == Head::None {
        if sample.has_head(layout.separator) {
            let what = "names no two columns with images or nodes";
            return Err(
                Refusal::unnamed(format!("the head `{}` {what}", refusal::head(&names))).into(),
            );
        }
        if !WIDTHS.contains(&names.len()) {
            let what =
                "a list without a head has 2, 3 with a number, or 9 or 14 with a relative pose";
            let found = counted(names.len(), "field");
            return Err(Refusal::unnamed(format!("the line has {found}, and {what}")).into());
        }
    }
    weighed(layout, options)
}

/// Whether it takes a separator to cut the first two fields of all first lines: semicolons do, and what
/// stands between names of images with blanks in them.
fn is_cut(sample: &Sample, separator: Separator) -> bool {
    let cells = sample.cells(separator);
    let ends = || cells.iter().flat_map(|line| line.iter().take(2));
    let blank = |field: &String| field.contains(' ');
    let pairs = cells.len() == sample.lines.len() && cells.iter().all(|line| line.len() > 1);
    let images = ends().all(|field| !blank(field) || is_image(field));
    pairs && images && (separator == Separator::Byte(b';') || ends().any(blank))
}

/// The layout that the user names.
fn asked(mut layout: Layout, columns: &Columns, names: Vec<String>) -> Result<Layout, Problem> {
    let wanted = || columns.ends.iter().chain(&columns.weight);
    let by_name = wanted().any(|column| matches!(column, Column::Name(_)));
    let line = by_name || !names::pairs_among(&names).is_empty();
    let place = |column: &Column| match column {
        Column::Place(place) => Some(*place).filter(|place| *place < names.len()),
        Column::Name(name) => names.iter().position(|other| other.trim() == &**name),
    };
    let place = |column: &Column| {
        place(column).ok_or_else(|| {
            let there = match by_name {
                true => names.join(", "),
                false => format!("{} columns", names.len()),
            };
            let column = shown(&column.to_string()).to_owned();
            Refusal::columns(format!("there is no column `{column}`; there are {there}"))
        })
    };
    layout.ends = [place(&columns.ends[0])?, place(&columns.ends[1])?];
    layout.weight = columns.weight.as_ref().map(place).transpose()?;
    layout.names = Some(names).filter(|_| line);
    layout.head = Head::Asked { line };
    Ok(layout)
}

/// The layout with a column of weights, if weights are asked for.
fn weighed(mut layout: Layout, options: &ListOptions) -> Result<Layout, Problem> {
    if options.min_weight.is_none() || layout.weight.is_some() {
        return Ok(layout);
    }
    let named = layout.names.as_ref().and_then(|names| {
        let weights = |at: &usize| names::is_weight(&names[*at]) && !layout.ends.contains(at);
        (0..names.len()).find(weights)
    });
    let third = (layout.width == Some(3)).then(|| 3 - layout.ends[0] - layout.ends[1]);
    layout.weight = named.or(third);
    match layout.weight {
        Some(_) => Ok(layout),
        None => Err(Refusal::columns("--min-weight: there is no column of weights").into()),
    }
}
