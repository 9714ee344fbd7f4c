//! How the lines of a list are cut, where the pairs stand in them, and what the head says.
//!
//! In: the first lines of a text, and what the user has said about it. Out: a [`Layout`].

use super::Reading;
use super::columns::{Columns, ListOptions};
use super::fields::{Field, Separator, integer, is_number};
use super::names::{self, is_image};
use super::refusal::{self, shown};
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
    /// How many fields the first line has.
    pub(super) first: usize,
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
    /// As [`Separator::split`].
    pub(super) fn split(&self, line: &str, fields: &mut Vec<Field>) -> Result<(), Problem> {
        let line = match self.attributes {
            true => before_attributes(line).unwrap_or(line),
            false => line,
        };
        self.separator.split(line, fields)
    }

    /// Whether a field is a number; where semicolons separate, commas are points.
    pub(super) fn number(&self, field: &str) -> String {
        match self.separator {
            Separator::Byte(b';') => field.replace(',', "."),
            _ => field.to_owned(),
        }
    }

    /// The columns of the pairs, in words.
    pub(super) fn taken(&self, kind: &str) -> String {
        let [first, second] = self.ends.map(|column| column + 1);
        let names = self.names.as_ref();
        let names = names.map(|names| self.ends.map(|column| &*names[column]).join(", "));
        let named = names.map_or(String::new(), |names| format!(" ({names})"));
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
            let name = self.names.as_ref().map(|names| names[column].clone());
            let name = name.filter(|name| !name.is_empty());
            name.unwrap_or_else(|| (column + 1).to_string())
        };
        let mut shown: Vec<String> = others.iter().take(SHOWN).map(name).collect();
        if others.len() > SHOWN {
            shown.push(format!("and {} more", others.len() - SHOWN));
        }
        let plural = if others.len() == 1 { "" } else { "s" };
        (!others.is_empty()).then(|| format!("column{plural} {}", shown.join(", ")))
    }
}

/// A line before its `{...}`, which is its end.
fn before_attributes(line: &str) -> Option<&str> {
    let separates = [' ', '\t', ','];
    let text = line.trim_end_matches(separates).strip_suffix('}')?;
    let names = text[..text.find('{')?].strip_suffix(separates)?;
    Some(names.trim_end_matches(separates))
}

/// The first lines of a text with fields, and the comment right above them.
fn sample(text: &str, whole: bool) -> (Vec<&str>, Option<&str>) {
    let end = match text.rfind('\n') {
        _ if whole => text.len(),
        end => end.unwrap_or(0),
    };
    let (mut lines, mut comment) = (Vec::new(), None);
    for line in text[..end].lines() {
        let line = line.trim_matches([' ', '\t']);
        if line.starts_with(['#', '%']) {
            comment = Some(line).filter(|_| lines.is_empty()).or(comment);
        } else if !line.is_empty() {
            lines.push(line);
        }
        if lines.len() == LINES {
            break;
        }
    }
    (lines, comment)
}

/// Whether a first line has words alone, above a column of numbers or of images.
fn is_head(first: &[String], below: &[Vec<String>]) -> bool {
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

/// How lines are cut: by a semicolon, a tab or a comma that cuts all into as many fields, else
/// by the first of these that the first line has, else by blanks.
fn separator(lines: &[&str]) -> Separator {
    let mut found = Vec::new();
    let candidates = [b';', b'\t', b','];
    let even = candidates.into_iter().find(|&byte| {
        let mut widths = lines.iter().map(|line| {
            let is_cut = Separator::Byte(byte).split(line, &mut found).is_ok();
            // `1 2;` ends with a semicolon, and is not cut by it.
            let is_open = byte == b';' && line.ends_with(';');
            if is_cut && !is_open { found.len() } else { 0 }
        });
        let first = widths.next().unwrap_or(0);
        first > 1 && widths.all(|width| width == first)
    });
    let first = lines.first().copied().unwrap_or_default();
    let unquoted: Vec<&str> = first.split('"').step_by(2).collect();
    let is_there = |&byte: &u8| unquoted.iter().any(|part| part.contains(char::from(byte)));
    let found = even.or_else(|| candidates.into_iter().find(is_there));
    found.map_or(Separator::Any, Separator::Byte)
}

/// The fields of a line as text.
fn texts(line: &str, separator: Separator) -> Result<Vec<String>, Problem> {
    let mut found = Vec::new();
    separator.split(line, &mut found)?;
    let texts = found.iter().map(|field| field.text(line).into_owned());
    Ok(texts.collect())
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
    let (lines, comment) = sample(text, whole);
    let mut layout = Layout {
        separator: separator(&lines),
        first: 2,
        ends: [0, 1],
        ..Layout::default()
    };
    let Some(first) = lines.first() else {
        return match whole {
            true => Ok(layout),
            false => Err(super::too_long()),
        };
    };
    if is_own(text.as_bytes()) && reading == Reading::Strict && options.columns.is_none() {
        layout.separator = Separator::Any;
        layout.head = Head::Own;
        return Ok(layout);
    }
    if options.columns.is_none() && before_attributes(first).is_some() {
        layout.separator = Separator::Any;
        layout.attributes = true;
        layout.width = Some(2);
        return weighed(layout, options);
    }
    let names = texts(first, layout.separator)?;
    layout.first = names.len();
    layout.width = Some(names.len());
    if let Some(columns) = &options.columns {
        return weighed(asked(layout, columns, names)?, options);
    }
    let comment = comment.map(|line| line.trim_start_matches(['#', '%', ' ']));
    let comment = comment.and_then(|line| {
        let cut = [layout.separator, Separator::Any];
        let mut cut = cut.into_iter().filter_map(|by| texts(line, by).ok());
        cut.find(|words| words.len() == names.len())
    });
    let by_comment = comment.as_deref().map(names::pairs_among);
    match (&names::pairs_among(&names)[..], by_comment.as_deref()) {
        ([ends], _) => {
            layout.ends = *ends;
            layout.head = Head::Line;
            layout.names = Some(names);
            return weighed(layout, options);
        }
        ([], Some([ends])) => {
            layout.ends = *ends;
            layout.head = Head::Comment;
            layout.names = comment;
            return weighed(layout, options);
        }
        ([], _) => {}
        _ => {
            let head = refusal::head(&names);
            let what = format!("the head `{head}` names the columns of pairs twice");
            return Err(Problem::columns(what));
        }
    }
    let word = |word: &String| {
        word.starts_with(|c: char| c.is_ascii_alphabetic())
            && word.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
    };
    let words = comment.filter(|words| words.iter().all(word));
    layout.commented = words.map(|words| words.join(" "));
    let cells = lines.iter().map(|line| texts(line, layout.separator));
    let cells: Vec<Vec<String>> = cells.filter_map(Result::ok).collect();
    if reading == Reading::Lenient {
        // The first two fields, between whatever separates them: semicolons, and what stands between names of
        // images with blanks in them.
        let ends = || cells.iter().flat_map(|line| line.iter().take(2));
        let blank = |field: &String| field.contains(' ');
        let are_pairs = cells.len() == lines.len() && cells.iter().all(|line| line.len() > 1);
        let are_ends = ends().all(|field| !blank(field) || is_image(field));
        let is_needed = layout.separator == Separator::Byte(b';') || ends().any(blank);
        if !(are_pairs && are_ends && is_needed) {
            layout.separator = Separator::Any;
        }
        layout.width = layout.width.filter(|_| options.min_weight.is_some());
    } else if is_head(&names, cells.get(1..).unwrap_or_default()) {
        let head = refusal::head(&names);
        let what = format!("the head `{head}` names no two columns with images or nodes");
        return Err(Problem::unnamed(what));
    } else if !WIDTHS.contains(&names.len()) {
        let what = "a list without a head has 2, 3 with a number, or 9 or 14 with a relative pose";
        let found = counted(names.len(), "field");
        return Err(Problem::unnamed(format!(
            "the line has {found}, and {what}"
        )));
    }
    weighed(layout, options)
}

/// The layout that the user names.
fn asked(mut layout: Layout, columns: &Columns, names: Vec<String>) -> Result<Layout, Problem> {
    let number = |column: &str| usize::try_from(integer(column)?).ok();
    let by_name = columns.0.iter().any(|column| number(column).is_none());
    let line = by_name || !names::pairs_among(&names).is_empty();
    let place = |column: &str| {
        let place = match number(column) {
            Some(place) => place.checked_sub(1).filter(|&place| place < names.len()),
            None => names.iter().position(|other| other.trim() == column),
        };
        place.ok_or_else(|| {
            let there = match by_name {
                true => names.join(", "),
                false => format!("{} columns", names.len()),
            };
            let column = shown(column);
            Problem::columns(format!("there is no column `{column}`; there are {there}"))
        })
    };
    layout.ends = [place(&columns.0[0])?, place(&columns.0[1])?];
    layout.weight = columns.0.get(2).map(|it| place(it)).transpose()?;
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
        None => Err(Problem::columns(
            "--min-weight: there is no column of weights",
        )),
    }
}
