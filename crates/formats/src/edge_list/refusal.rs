//! Why a text is no list of pairs, and what to do about it.

use crate::error::Problem;
use viewcert::wording::counted;

/// How a list is written that nobody can take for something else.
pub(super) const WRITE: &str =
    "write one pair a line, two names separated by a blank, below a line `source target`";
/// The remedy for a list that looks like a table.
const PAIRS: &str =
    "if these are pairs, write the line `source target` above them, with the separator of the list";
/// The remedy for a first or a last line that may be a head or counts.
const ODD: &str =
    "delete it if it is no pair; if it is one, write the line `source target` above all";
const QUOTES: &str =
    "separate all fields by the same character, and put names with blanks or punctuation in quotes";
const COLUMNS: &str = "name the two columns of the pairs by their names or their numbers from 1, and perhaps \
                       that of the weights (--columns img1,img2,score)";
/// The remedy for a table that does not say which columns are the pairs.
const WHICH: &str = "if two of the columns are the ends of pairs, say which by their names or their numbers from 1 \
                     (--columns img1,img2); if every line joins its first field with each of the others, \
                     --format openmvg-pairs";
const EVEN: &str = "write as many on every line, without numbers of lines (R: row.names = FALSE, pandas: index=False), \
                    and names with blanks in quotes; lists of neighbours are read by --format openmvg-pairs";

impl Problem {
    /// Lines that are none of a list.
    pub(super) fn lines(what: impl Into<String>) -> Self {
        Self::new(what, WRITE)
    }

    /// A list that may be a table of something else.
    pub(super) fn table(what: impl Into<String>) -> Self {
        Self::new(what, PAIRS)
    }

    /// A line of a list that may be none of its pairs.
    pub(super) fn odd(place: &str, line: &str, what: &str) -> Self {
        Self::new(format!("the {place} line, {line}, {what}"), ODD)
    }

    /// A field that its neighbours or another notation run into.
    pub(super) fn quotes(field: &str, is: &str) -> Self {
        Self::new(format!("the field `{}` {is}", shown(field)), QUOTES)
    }

    /// Columns of which it is not clear which are meant.
    pub(super) fn columns(what: impl Into<String>) -> Self {
        Self::new(what, COLUMNS)
    }

    /// Columns of which none are known as those of pairs.
    pub(super) fn unnamed(what: impl Into<String>) -> Self {
        Self::new(what, WHICH)
    }

    /// A number of fields that others do not have, of which one is in a line.
    pub(super) fn uneven(found: usize, expected: usize, line: Option<u64>) -> Self {
        let others = match line {
            Some(line) => format!("line {line} has {expected}"),
            None => format!("{expected} are expected"),
        };
        Self::new(
            format!("the line has {}, and {others}", counted(found, "field")),
            EVEN,
        )
    }
}

/// The first names of a head.
pub(super) fn head(names: &[String]) -> String {
    const SHOWN: usize = 4;
    let first = names[..names.len().min(SHOWN)].join(",");
    first + if names.len() > SHOWN { ",..." } else { "" }
}

/// A field in a message: its beginning, if it is long.
pub(crate) fn shown(field: &str) -> String {
    const MOST: usize = 40;
    match field.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &field[..end]),
        None => field.to_owned(),
    }
}
