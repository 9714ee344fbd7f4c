//! Why a text is no list of pairs, and what to do about it.

use std::fmt::Display;

/// What was seen, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What was seen.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

/// How a list is written that nobody can take for something else.
pub(super) const WRITE: &str =
    "write one pair a line, two names separated by a blank, below a line `source target`";
/// The remedy for a list that looks like a table.
const PAIRS: &str =
    "if these are pairs, write the line `source target` above them, with the separator of the list";
const COLUMNS: &str = "name the two columns of the pairs by their names or their numbers from 1 (--columns img1,img2)";

impl Refusal {
    pub(crate) fn new(what: impl Display, remedy: impl Into<String>) -> Self {
        Self {
            what: what.to_string(),
            remedy: remedy.into(),
        }
    }

    /// A list that may be a table of something else.
    pub(super) fn table(what: impl Display) -> Self {
        Self::new(what, PAIRS)
    }

    pub(super) fn width(found: usize, columns: Option<String>) -> Self {
        let what = format!(
            "the line has {}, and a list without a head has 2, 3 with a number, or 9 or 14 with a relative pose",
            fields(found)
        );
        match columns {
            Some(columns) => Self::new(
                what,
                format!(
                    "if the two columns with names of images are the pairs, say --columns {columns}"
                ),
            ),
            None => Self::new(what, WRITE),
        }
    }

    pub(super) fn uneven(found: usize, expected: usize, line: u64) -> Self {
        let what = format!(
            "the line has {}, and line {line} has {expected}",
            fields(found)
        );
        let remedy = if found == expected + 1 {
            "if the first field of each line is its number, write the list without it (R: row.names = FALSE, \
             pandas: index=False)"
        } else {
            WRITE
        };
        Self::new(what, remedy)
    }

    pub(super) fn format(found: usize, expected: usize) -> Self {
        let what = format!(
            "the line has {}, and lines of this format have {expected}",
            fields(found)
        );
        Self::new(what, "quote names with blanks, or name another format")
    }

    pub(super) fn mixed(label: &str, integers: bool) -> Self {
        let (kind, others) = if integers {
            ("no integer", "integers")
        } else {
            ("a number", "names")
        };
        let what = format!(
            "`{}` is {kind}, and the labels before it are {others}",
            shown(label)
        );
        Self::new(what, WRITE)
    }

    pub(super) fn no_integer(label: &str) -> Self {
        let what = format!(
            "`{}` is a number and no integer: coordinates, perhaps",
            shown(label)
        );
        Self::new(what, WRITE)
    }

    pub(super) fn padded() -> Self {
        let what = "some numbers begin with zeros, and not all have as many digits";
        Self::new(
            what,
            "write all of them with as many digits, or none with zeros before them",
        )
    }

    pub(super) fn no_number(field: &str, column: usize) -> Self {
        let what = match field {
            "" => format!("field {column} is empty"),
            _ => format!("field {column}, `{}`, is no number", shown(field)),
        };
        Self::new(what, WRITE)
    }

    pub(super) fn no_pose(width: usize) -> Self {
        let place = if width == 9 {
            "unit quaternion in fields 3 to 6"
        } else {
            "rotation in fields 3 to 11"
        };
        let what = format!(
            "lines of {width} fields are pairs with relative poses, and there is no {place}"
        );
        Self::new(what, WRITE)
    }

    pub(super) fn blank(label: &str) -> Self {
        let what = format!("the field `{}` has blanks or commas", shown(label));
        Self::new(
            what,
            "separate all fields by the same character, and put names with blanks in quotes",
        )
    }

    pub(super) fn empty(column: usize) -> Self {
        let what = format!("field {column}, where the name of a camera belongs, is empty");
        Self::new(what, "give the camera a name, or remove the line")
    }

    pub(super) fn no_label(field: &str) -> Self {
        let what = format!(
            "`{}` is neither the name of a camera nor a number",
            shown(field)
        );
        Self::new(what, WRITE)
    }

    pub(super) fn punctuated(field: &str) -> Self {
        let what = format!("`{}` is punctuated like another format", shown(field));
        Self::new(
            what,
            "remove the punctuation; if it belongs to the name, quote the name",
        )
    }

    pub(super) fn attributes() -> Self {
        Self::new(
            "two names and `{...}` are expected",
            "mend the line, or write the list with data=False",
        )
    }

    pub(super) fn head_or_pair(names: &str) -> Self {
        let what =
            format!("the first line, {names}, may be a head, and it looks like the labels below");
        Self::new(
            what,
            "delete it if it is a head; if it is a pair, write the line `source target` above it",
        )
    }

    pub(super) fn only_head() -> Self {
        Self::new(
            "the first line is a head, and there are no pairs",
            "give at least one pair of cameras",
        )
    }

    pub(super) fn heads(names: &[String]) -> Self {
        let what = format!(
            "the head `{}` names the columns of pairs twice",
            head(names)
        );
        Self::new(what, COLUMNS)
    }

    pub(super) fn commented(names: &str) -> Self {
        let what = format!(
            "the comment above the lines names their columns, `{}`, and no pair",
            shown(names)
        );
        Self::new(
            what,
            "if these are pairs, write the line `source target` below the comment",
        )
    }

    pub(super) fn no_column(column: impl Display, columns: &str) -> Self {
        let what = format!(
            "there is no column `{}`; there are {columns}",
            shown(&column.to_string())
        );
        Self::new(what, COLUMNS)
    }

    pub(super) fn apart(place: &str, labels: &str) -> Self {
        let what = format!(
            "the {place} line, {labels}, may be a head or counts: its labels are in no other line"
        );
        Self::new(
            what,
            "delete it if it is no pair; if it is one, write the line `source target` above all",
        )
    }

    pub(super) fn unknown_head(names: &[String], columns: Option<String>) -> Self {
        let what = format!(
            "the head `{}` names no two columns with images or nodes",
            head(names)
        );
        match columns {
            Some(columns) => Self::new(
                what,
                format!("if {columns} hold the pairs, say --columns {columns}"),
            ),
            None => Self::new(
                what,
                "if two columns hold pairs of images, call them `source` and `target`",
            ),
        }
    }

    pub(super) fn no_weights() -> Self {
        let what = "--min-weight: there is no column of weights";
        Self::new(what, "name it third: --columns img1,img2,score")
    }

    pub(super) fn no_weight(field: &str, column: usize) -> Self {
        let what = format!(
            "--min-weight: field {column}, `{}`, is no number",
            shown(field)
        );
        Self::new(
            what,
            "mend the field, or name the column of the weights third: --columns img1,img2,score",
        )
    }

    pub(super) fn long(limit: usize) -> Self {
        let what = format!("the line is longer than {limit} bytes");
        Self::new(
            what,
            "put one pair on a line, or name the format with --format",
        )
    }
}

fn fields(count: usize) -> String {
    viewcert::wording::counted(count, "field")
}

/// The first names of a head.
pub(super) fn head(names: &[String]) -> String {
    const SHOWN: usize = 4;
    let first = names[..names.len().min(SHOWN)].join(",");
    if names.len() > SHOWN {
        first + ",..."
    } else {
        first
    }
}

/// A field in a message: its beginning, if it is long.
pub(crate) fn shown(field: &str) -> String {
    const MOST: usize = 40;
    match field.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &field[..end]),
        None => field.to_owned(),
    }
}
