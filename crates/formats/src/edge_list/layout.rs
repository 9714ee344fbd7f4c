//! Tables: how their lines are cut, which two columns hold the pairs, and which one the weights.
//!
//! In: the first lines of a text, and what the user has said about it. Out: a [`Layout`] if the text
//! is to be read as a table, which plain lists of pairs need not be.

use std::fmt;
use std::str::FromStr;

use crate::edge_list::decimal::Decimal;
use crate::edge_list::fields::{self, Field, integer, is_number};
use crate::edge_list::heads;
use crate::edge_list::is_image;
use crate::error::Problem;

/// Which lines of a list count, and where in them the pairs stand; for everything else a list says so
/// itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ListOptions {
    /// The columns of the pairs.
    pub columns: Option<Columns>,
    /// The least weight of a pair.
    pub min_weight: Option<Decimal>,
    /// Whether pairs of a camera with itself are left out instead of refused.
    pub skip_loops: bool,
}

impl ListOptions {
    /// Whether a pair with so many matches does not count.
    pub(crate) fn weighs_less(&self, matches: u64) -> bool {
        let weight = matches.to_string().parse::<Decimal>();
        let least = self.min_weight.as_ref();
        least.is_some_and(|least| weight.is_ok_and(|weight| weight < *least))
    }
}

/// The two columns of pairs, and the one of weights if that is not found by its name or place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    ends: [Column; 2],
    weight: Option<Column>,
}

/// A column, as it is called or counted.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Column {
    /// By its place from 0.
    Place(usize),
    /// By its name in the head.
    Name(Box<str>),
}

/// No two or three columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "expected the two columns of the pairs and perhaps that of the weights, by their names or their \
     numbers from 1, like img1,img2 or 2,3,5"
)]
pub struct NoColumns;

/// `img1,img2` or `2,3` or `img1,img2,score`.
impl FromStr for Columns {
    type Err = NoColumns;

    fn from_str(text: &str) -> Result<Self, NoColumns> {
        let column = |name: &str| match (name.trim(), integer(name.trim())) {
            ("", _) | (_, Some(0)) => Err(NoColumns),
            (_, Some(number)) => usize::try_from(number - 1)
                .map(Column::Place)
                .map_err(|_| NoColumns),
            (name, None) => Ok(Column::Name(name.into())),
        };
        let columns: Vec<Column> = text.split(',').map(column).collect::<Result<_, _>>()?;
        let (ends, weight) = match &columns[..] {
            [first, second] => ([first, second], None),
            [first, second, weight] => ([first, second], Some(weight)),
            _ => return Err(NoColumns),
        };
        if ends[0] == ends[1] {
            return Err(NoColumns);
        }
        Ok(Self {
            ends: ends.map(Column::clone),
            weight: weight.cloned(),
        })
    }
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Place(place) => write!(f, "{}", place + 1),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// As [`FromStr`] reads it.
impl fmt::Display for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = &self.ends;
        write!(f, "{first},{second}")?;
        self.weight
            .iter()
            .try_for_each(|weight| write!(f, ",{weight}"))
    }
}

/// How the lines of a table are cut and used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// What stands between fields; none: blanks, tabs and commas, as in any list.
    pub(super) separator: Option<u8>,
    /// How many fields a line has.
    pub(super) columns: usize,
    /// Where the ends of a pair stand.
    pub(super) ends: [usize; 2],
    /// Where its weight stands.
    pub(super) weight: Option<usize>,
    /// The names of the columns, if the first line has them for sure.
    pub(super) head: Option<Vec<String>>,
    /// Whether the user has said which columns are meant.
    pub(super) asked: bool,
    /// Whether attributes follow the names, as networkx writes them.
    pub(super) attributes: Option<Attributes>,
}

/// What stands in the `{...}` behind the two names of every line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Attributes {
    /// Nothing.
    None,
    /// One, `weight`.
    Weight,
    /// Others.
    Other,
}

impl Layout {
    /// The columns of the pairs, in words.
    pub(super) fn taken(&self, kind: &str) -> String {
        let [first, second] = self.ends.map(|column| column + 1);
        let named = match &self.head {
            Some(head) => {
                let [a, b] = self.ends.map(|column| &*head[column]);
                format!(" ({a}, {b})")
            }
            None => String::new(),
        };
        format!("{kind} in columns {first} and {second}{named}")
    }

    /// The columns that are of no concern, in words.
    pub(super) fn ignored(&self) -> Option<String> {
        const SHOWN: usize = 4;
        match self.attributes {
            Some(Attributes::Weight) if self.weight.is_none() => {
                return Some("attributes (weight)".to_owned());
            }
            Some(Attributes::Other) => return Some("attributes".to_owned()),
            _ => {}
        }
        let used = |column: &usize| self.ends.contains(column) || self.weight == Some(*column);
        let others: Vec<usize> = (0..self.columns).filter(|column| !used(column)).collect();
        let mut names: Vec<String> = others
            .iter()
            .take(SHOWN)
            .map(|&column| {
                let name = self.head.as_ref().map(|head| &*head[column]);
                match name.filter(|name| !name.is_empty()) {
                    Some(name) => name.to_owned(),
                    None => (column + 1).to_string(),
                }
            })
            .collect();
        if others.len() > SHOWN {
            names.push(format!("and {} more", others.len() - SHOWN));
        }
        let word = if others.len() == 1 {
            "column"
        } else {
            "columns"
        };
        (!others.is_empty()).then(|| format!("{word} {}", names.join(", ")))
    }

    /// Cuts a line.
    ///
    /// # Errors
    /// As [`fields::split`] and [`fields::split_by`]; attributes that are not where others are.
    pub(super) fn split(&self, line: &str, fields: &mut Vec<Field>) -> Result<(), Problem> {
        if self.attributes.is_none() {
            return cut(self.separator, line, fields);
        }
        let wrong = |what: String| Problem::Malformed {
            format: "edge list with attributes",
            what,
        };
        let (names, attributes) = names_and_attributes(line);
        fields::split(names, fields)?;
        match (fields.len(), attributes) {
            (0, None) => return Ok(()),
            (2, Some(_)) => {}
            _ => return Err(wrong("two names and `{...}` are expected".to_owned())),
        }
        if self.weight.is_some() {
            let weight = attributes.and_then(weight);
            let weight = weight.ok_or_else(|| wrong("`{'weight': N}` is expected".to_owned()))?;
            // Nothing but brackets and separators follows it.
            let start = line.rfind(weight).unwrap_or(0);
            fields.push(Field::plain(start, start + weight.len()));
        }
        Ok(())
    }
}

/// A line before and in its `{...}`, which is its end.
fn names_and_attributes(line: &str) -> (&str, Option<&str>) {
    let separates = [' ', '\t', ','];
    let end = line.trim_end_matches(separates);
    let inner = end.strip_suffix('}').and_then(|text| {
        let at = text.find('{')?;
        let names = text[..at].strip_suffix(separates)?;
        Some((names.trim_end_matches(separates), Some(&text[at + 1..])))
    });
    inner.unwrap_or((line, None))
}

/// The number in `'weight': N`, if attributes are that alone.
fn weight(attributes: &str) -> Option<&str> {
    let value = attributes.trim().strip_prefix("'weight':")?.trim();
    is_number(value.as_bytes()).then_some(value)
}

/// What attributes all first lines have, if all have them.
fn attributes(text: &str, whole: bool) -> Option<Attributes> {
    let end = if whole {
        Some(text.len())
    } else {
        text.rfind('\n')
    };
    let mut found = None;
    let mut fields = Vec::new();
    for line in text[..end?].lines() {
        let (names, inner) = names_and_attributes(line);
        fields::split(names, &mut fields).ok()?;
        let Some(inner) = inner else {
            // Blank, or a comment.
            if fields.is_empty() {
                continue;
            }
            return None;
        };
        // A comment may end so, too.
        if fields.is_empty() {
            continue;
        }
        let this = match inner {
            "" => Attributes::None,
            _ if weight(inner).is_some() => Attributes::Weight,
            _ if inner.contains(':') => Attributes::Other,
            _ => return None,
        };
        if fields.len() != 2 {
            return None;
        }
        found = Some(match found {
            Some(before) if before != this => Attributes::Other,
            _ => this,
        });
    }
    found
}

fn cut(separator: Option<u8>, line: &str, fields: &mut Vec<Field>) -> Result<(), Problem> {
    match separator {
        Some(separator) => fields::split_by(line, separator, fields),
        None => fields::split(line, fields),
    }
}

/// The first lines of a text, cut in one way.
struct Sample {
    separator: Option<u8>,
    lines: Vec<Vec<Cell>>,
}

struct Cell {
    text: String,
    quoted: bool,
}

impl Cell {
    fn is_number(&self) -> bool {
        !self.quoted && is_number(self.text.as_bytes())
    }
}

/// How many lines of a sample are looked at.
const LINES: usize = 200;

impl Sample {
    /// The complete lines at the start of a text, if all can be cut so.
    fn of(head: &str, whole: bool, separator: Option<u8>) -> Option<Self> {
        let end = if whole {
            Some(head.len())
        } else {
            head.rfind('\n')
        };
        let mut lines = Vec::new();
        let mut found = Vec::new();
        for line in head[..end?].lines() {
            cut(separator, line, &mut found).ok()?;
            if !found.is_empty() {
                lines.push(
                    found
                        .iter()
                        .map(|field| Cell {
                            text: field.text(line).into_owned(),
                            quoted: field.quoted,
                        })
                        .collect::<Vec<_>>(),
                );
            }
            if lines.len() == LINES {
                break;
            }
        }
        Some(Self { separator, lines })
    }

    /// The one separator of all lines, which have as many fields each, if there is one.
    fn of_table(head: &str, whole: bool) -> Option<Self> {
        b";,\t".iter().find_map(|&separator| {
            let sample = Self::of(head, whole, Some(separator))?;
            let columns = sample.lines.first()?.len();
            let even = sample.lines.iter().all(|line| line.len() == columns);
            // `1 2;` ends with a semicolon, and is not cut by it.
            let ends = |line: &Vec<Cell>| {
                line.last()
                    .is_some_and(|cell| cell.text.is_empty() && !cell.quoted)
            };
            let is_cut = separator != b';' || !sample.lines.iter().all(ends);
            (even && columns > 1 && is_cut).then_some(sample)
        })
    }

    fn columns(&self) -> usize {
        self.lines.first().map_or(0, Vec::len)
    }

    /// The first line, if none of its fields is a number and some other line has one, or if it names
    /// the columns of pairs; and these columns.
    fn head(&self) -> Option<(Vec<&str>, Option<[usize; 2]>)> {
        let (first, others) = self.lines.split_first()?;
        let names: Vec<&str> = first.iter().map(|cell| &*cell.text).collect();
        if first.iter().any(Cell::is_number) || others.is_empty() {
            return None;
        }
        let numbers = others.iter().flatten().any(Cell::is_number);
        let pair = heads::pair_among(&names, numbers);
        (numbers || pair.is_some()).then_some((names, pair))
    }

    /// The columns behind a first one that counts the lines, if these have names of one kind.
    fn indexed(&self) -> bool {
        let lines = match self.lines.split_first() {
            Some((first, others)) if !first[0].is_number() => others,
            _ => &self.lines[..],
        };
        let Some(start) = lines.first().and_then(|line| integer(&line[0].text)) else {
            return false;
        };
        let counts = |(line, at): (&Vec<Cell>, u64)| integer(&line[0].text) == Some(at);
        let is_name = |cell: &Cell| !cell.text.is_empty() && !cell.is_number();
        let images = |column: usize| lines.iter().all(|line| is_image(&line[column].text));
        start <= 1
            && lines.len() > 1
            && lines.iter().zip(start..).all(counts)
            && lines
                .iter()
                .all(|line| is_name(&line[1]) && is_name(&line[2]))
            && images(1) == images(2)
    }

    /// Whether some field has a blank in it that no quotes protect.
    fn has_inner_blanks(&self) -> bool {
        let mut cells = self.lines.iter().flat_map(|line| line.iter().take(2));
        cells.any(|cell| !cell.quoted && cell.text.contains(' '))
    }

    /// Whether names have blanks in them: two columns end like images, one name each.
    fn has_blanks(&self) -> bool {
        self.columns() >= 2
            && self
                .lines
                .iter()
                .all(|line| is_image(&line[0].text) && is_image(&line[1].text))
            && self.has_inner_blanks()
            && self
                .lines
                .iter()
                .all(|line| line[2..].iter().all(Cell::is_number))
    }

    /// Whether lines are two names, or these and a number, without anything that separates otherwise.
    fn is_list(&self) -> bool {
        let name = |cell: &Cell| {
            let separates = |text: &str| text.contains([' ', '\t', ',']);
            !cell.text.is_empty() && (cell.quoted || !separates(&cell.text))
        };
        self.columns() <= 3 && self.lines.iter().all(|line| line[..2].iter().all(name))
    }

    fn has_empty(&self) -> bool {
        let cells = self.lines.iter().flatten();
        cells.into_iter().any(|cell| cell.text.is_empty())
    }
}

/// The layout of a text that begins with `head`, which is all of it if `whole`; none if it is a plain
/// list, whose first two fields are the pair.
///
/// # Errors
/// Columns that are not there; weights that are asked for and not there.
pub(crate) fn layout(
    head: &[u8],
    whole: bool,
    options: &ListOptions,
) -> Result<Option<Layout>, Problem> {
    let head = String::from_utf8_lossy(head);
    let text = head.strip_prefix('\u{feff}').unwrap_or(&head);
    if options.columns.is_none()
        && let Some(attributes) = attributes(text, whole)
    {
        let weighs = attributes == Attributes::Weight && options.min_weight.is_some();
        let layout = Layout {
            separator: None,
            columns: if weighs { 3 } else { 2 },
            ends: [0, 1],
            weight: weighs.then_some(2),
            head: None,
            asked: false,
            attributes: Some(attributes),
        };
        return weighed(layout, options).map(Some);
    }
    let table = Sample::of_table(text, whole);
    if let Some(columns) = &options.columns {
        let sample = table.or_else(|| Sample::of(text, whole, None));
        let sample = sample.filter(|sample| !sample.lines.is_empty());
        return match sample {
            Some(sample) => asked(&sample, columns, text, options).map(Some),
            None => Ok(None),
        };
    }
    let found = table.as_ref().and_then(unasked);
    match (found, &options.min_weight) {
        (Some(layout), _) => weighed(layout, options).map(Some),
        (None, None) => Ok(None),
        (None, Some(_)) => {
            let Some(sample) = Sample::of(text, whole, None) else {
                return Ok(None);
            };
            let names = sample.head().map(|(names, _)| owned(names));
            let layout = Layout {
                separator: None,
                columns: sample.columns(),
                ends: [0, 1],
                weight: None,
                head: names.filter(|_| sample.columns() > 2),
                asked: false,
                attributes: None,
            };
            weighed(layout, options).map(Some)
        }
    }
}

fn owned(names: Vec<&str>) -> Vec<String> {
    names.into_iter().map(str::to_owned).collect()
}

/// The layout that the lines themselves show.
fn unasked(sample: &Sample) -> Option<Layout> {
    let columns = sample.columns();
    let (head, pair) = sample.head().unzip();
    let pair = pair.flatten();
    let mut below = sample.lines.iter().skip(1);
    let weighed = columns == 3 && below.all(|line| line[2].is_number());
    let usual = (columns == 2 || weighed) && sample.separator != Some(b';') && !sample.has_empty();
    let ends = match pair {
        Some([0, 1]) if usual && !sample.has_inner_blanks() => return None,
        Some(ends) => ends,
        None if columns > 2 && sample.indexed() => [1, 2],
        None if sample.has_blanks() => [0, 1],
        None if sample.separator == Some(b';') && sample.is_list() => [0, 1],
        None => return None,
    };
    // Above an index stands a head, whatever it is.
    let first: Vec<&str> = sample.lines[0].iter().map(|cell| &*cell.text).collect();
    let above = ends == [1, 2] && integer(first[0]).is_none();
    let head = head.or_else(|| above.then_some(first));
    Some(Layout {
        separator: sample.separator,
        columns,
        ends,
        weight: None,
        head: head.filter(|_| pair.is_some() || columns > 2).map(owned),
        asked: false,
        attributes: None,
    })
}

/// The layout that the user names.
fn asked(
    sample: &Sample,
    columns: &Columns,
    text: &str,
    options: &ListOptions,
) -> Result<Layout, Problem> {
    let first = &sample.lines[0];
    let first: Vec<String> = first.iter().map(|cell| cell.text.clone()).collect();
    let width = first.len();
    let names_line = [&columns.ends[0], &columns.ends[1]]
        .into_iter()
        .chain(&columns.weight)
        .any(|column| matches!(column, Column::Name(_)));
    // The names may stand in a comment above the lines.
    let comment = commented(text, sample.separator).filter(|names| names.len() == width);
    let has = |names: &[String], column: &Column| match column {
        Column::Name(name) => names.iter().any(|other| other.trim() == &**name),
        Column::Place(_) => true,
    };
    let by_comment = names_line
        && comment
            .as_ref()
            .is_some_and(|names| columns.ends.iter().all(|end| has(names, end)));
    let names = if by_comment {
        comment.unwrap_or_default()
    } else {
        first
    };
    let place = |column: &Column| {
        let found = match column {
            Column::Place(place) => Some(*place).filter(|place| *place < width),
            Column::Name(name) => names.iter().position(|other| other.trim() == &**name),
        };
        found.ok_or_else(|| Problem::NoColumn {
            column: column.to_string(),
            columns: if names_line {
                names.join(", ")
            } else {
                format!("{width} columns")
            },
        })
    };
    let ends = [place(&columns.ends[0])?, place(&columns.ends[1])?];
    let weight = columns.weight.as_ref().map(place).transpose()?;
    let numbered = ends.iter().any(|&end| sample.lines[0][end].is_number());
    let is_head = !by_comment && (names_line || !numbered && sample.head().is_some());
    let layout = Layout {
        separator: sample.separator,
        columns: width,
        ends,
        weight,
        head: is_head.then_some(names),
        asked: true,
        attributes: None,
    };
    weighed(layout, options)
}

/// The fields of the last comment before the first line.
fn commented(text: &str, separator: Option<u8>) -> Option<Vec<String>> {
    let comments = text
        .lines()
        .map(str::trim)
        .take_while(|line| line.starts_with(['#', '%']));
    let last = comments.last()?.trim_start_matches(['#', '%', ' ']);
    let mut fields = Vec::new();
    cut(separator, last, &mut fields).ok()?;
    Some(
        fields
            .iter()
            .map(|field| field.text(last).into_owned())
            .collect(),
    )
}

/// The layout with a column of weights, if weights are asked for.
fn weighed(layout: Layout, options: &ListOptions) -> Result<Layout, Problem> {
    if options.min_weight.is_none() || layout.weight.is_some() {
        return Ok(layout);
    }
    let named = layout.head.as_ref().and_then(|names| {
        let weights = |at: &usize| heads::is_weight(&names[*at]) && !layout.ends.contains(at);
        (0..names.len()).find(weights)
    });
    let third = (layout.columns == 3).then(|| 3 - layout.ends[0] - layout.ends[1]);
    match named.or(third) {
        Some(weight) => Ok(Layout {
            weight: Some(weight),
            ..layout
        }),
        None => Err(Problem::NoWeights),
    }
}

/// Whether the first two fields of the lines look like pairs: names of images both, or names of which
/// some stand in both columns.
pub(crate) fn first_two_are_pairs(head: &[u8], whole: bool) -> bool {
    let head = String::from_utf8_lossy(head);
    let Some(sample) = Sample::of_table(&head, whole).or_else(|| Sample::of(&head, whole, None))
    else {
        return false;
    };
    let lines: Vec<_> = sample.lines.iter().filter(|line| line.len() > 1).collect();
    let all = |is: &dyn Fn(&Cell) -> bool| lines.iter().all(|line| line[..2].iter().all(is));
    let images = all(&|cell| is_image(&cell.text));
    // Names of images among numbers of features.
    let features = !images
        && lines
            .iter()
            .any(|line| is_image(&line[0].text) && is_image(&line[1].text));
    let first: std::collections::HashSet<&str> = lines.iter().map(|line| &*line[0].text).collect();
    let shared = lines.iter().any(|line| first.contains(&*line[1].text));
    let fraction = lines.iter().any(|line| {
        let both = line[..2].iter();
        both.into_iter()
            .any(|cell| cell.is_number() && integer(&cell.text).is_none())
    });
    let words = all(&|cell| {
        cell.quoted
            || cell
                .text
                .bytes()
                .all(|b| b.is_ascii_alphanumeric() || b"_-./".contains(&b) || b > 0x7f)
    });
    let loops = lines.iter().any(|line| line[0].text == line[1].text);
    lines.len() == sample.lines.len()
        && words
        && !features
        && !loops
        && !fraction
        && (images || shared)
}
