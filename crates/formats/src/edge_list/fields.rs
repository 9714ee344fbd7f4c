//! From a line to its fields.

use std::borrow::Cow;

use crate::error::Problem;

/// A field of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    /// Where its text begins, behind a quote.
    start: usize,
    /// Where its text ends, before a quote.
    end: usize,
    /// Whether it stands in quotes.
    pub(crate) quoted: bool,
    /// Whether quotes within it are doubled.
    doubled: bool,
}

impl Field {
    /// What stands between two places of a line, without quotes.
    pub(crate) fn plain(start: usize, end: usize) -> Self {
        Self {
            start,
            end,
            quoted: false,
            doubled: false,
        }
    }

    /// What stands there, without the quotes around it.
    pub(crate) fn raw(self, line: &str) -> &str {
        &line[self.start..self.end]
    }

    /// What is meant: quotes within it are single again.
    pub(crate) fn text(self, line: &str) -> Cow<'_, str> {
        let raw = self.raw(line);
        if self.doubled {
            Cow::Owned(raw.replace("\"\"", "\""))
        } else {
            Cow::Borrowed(raw)
        }
    }

    /// Whether it is a number (which is never quoted).
    pub(crate) fn is_number(self, line: &str) -> bool {
        !self.quoted && is_number(self.raw(line).as_bytes())
    }
}

/// Splits a line without control characters into its fields.
///
/// # Errors
/// A comma without a field on either side, a quote where none belongs.
pub(crate) fn split(line: &str, fields: &mut Vec<Field>) -> Result<(), Problem> {
    split_at(line, fields, b" \t,")
}

/// What stands between the fields of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Separator {
    /// Blanks, tabs and commas.
    #[default]
    Any,
    /// Blanks and tabs.
    Blank,
    /// This alone.
    Byte(u8),
}

impl Separator {
    /// Splits a line.
    ///
    /// # Errors
    /// As [`split`] and [`split_by`].
    pub(super) fn split(self, line: &str, fields: &mut Vec<Field>) -> Result<(), Problem> {
        match self {
            Self::Any => split(line, fields),
            Self::Blank => split_at(line, fields, b" \t"),
            Self::Byte(separator) => split_by(line, separator, fields),
        }
    }
}

/// Splits a line at runs of blanks and tabs, and commas if these are among the `separators`.
fn split_at(line: &str, fields: &mut Vec<Field>, separators: &[u8]) -> Result<(), Problem> {
    let bytes = line.as_bytes();
    fields.clear();
    let mut at = 0;
    loop {
        let mut commas = 0;
        while bytes.get(at).is_some_and(|byte| separators.contains(byte)) {
            commas += usize::from(bytes[at] == b',');
            at += 1;
        }
        let ends = matches!(bytes.get(at), None | Some(b'#' | b'%'));
        if commas > 1 || commas == 1 && (ends || fields.is_empty()) {
            return Err(Problem::EmptyField);
        }
        if ends {
            return Ok(());
        }
        let field = if bytes[at] == b'"' {
            quoted(bytes, at, None)?
        } else {
            let length = bytes[at..]
                .iter()
                .position(|b| *b == b'"' || separators.contains(b));
            let end = length.map_or(bytes.len(), |length| at + length);
            if bytes.get(end) == Some(&b'"') {
                return Err(Problem::Quote("stands within a field"));
            }
            Field::plain(at, end)
        };
        at = field.end + usize::from(field.quoted);
        fields.push(field);
    }
}

/// Splits a line of a table into its fields, which one separator each stands between: they may hold
/// blanks, and be empty.
///
/// # Errors
/// A quote where none belongs.
pub(crate) fn split_by(line: &str, separator: u8, fields: &mut Vec<Field>) -> Result<(), Problem> {
    let bytes = line.as_bytes();
    fields.clear();
    let blanks = |from: usize| {
        let blank = |b: &&u8| **b == b' ' || **b == b'\t' && separator != b'\t';
        from + bytes[from..].iter().take_while(blank).count()
    };
    let mut at = blanks(0);
    if matches!(bytes.get(at), None | Some(b'#' | b'%')) {
        return Ok(());
    }
    loop {
        at = blanks(at);
        let field = if bytes.get(at) == Some(&b'"') {
            quoted(bytes, at, Some(separator))?
        } else {
            let length = bytes[at..].iter().position(|&b| b == separator);
            let end = length.map_or(bytes.len(), |length| at + length);
            let text = line[at..end].trim_end_matches([' ', '\t']);
            if text.contains('"') {
                return Err(Problem::Quote("stands within a field"));
            }
            Field {
                start: at,
                end: at + text.len(),
                quoted: false,
                doubled: false,
            }
        };
        fields.push(field);
        let behind = blanks(field.end + usize::from(field.quoted));
        match bytes.get(behind) {
            None => return Ok(()),
            Some(&b) if b == separator => at = behind + 1,
            Some(_) => return Err(Problem::Quote("is not followed by a separator")),
        }
    }
}

/// The quoted field that begins at a quote; in tables of one `separator` it may be empty.
fn quoted(bytes: &[u8], at: usize, separator: Option<u8>) -> Result<Field, Problem> {
    let mut end = at + 1;
    let mut doubled = false;
    loop {
        let behind = bytes.get(end + 1).copied();
        let closes = matches!(behind, None | Some(b' ' | b'\t' | b',')) || behind == separator;
        match (bytes.get(end), behind) {
            (None, _) => return Err(Problem::Quote("is not closed on its line")),
            (Some(b'"'), Some(b'"')) => {
                doubled = true;
                end += 2;
            }
            (Some(b'"'), _) if closes && end == at + 1 && separator.is_none() => {
                return Err(Problem::Quote("encloses nothing"));
            }
            (Some(b'"'), _) if closes => {
                return Ok(Field {
                    start: at + 1,
                    end,
                    quoted: true,
                    doubled,
                });
            }
            (Some(b'"'), _) => return Err(Problem::Quote("is not followed by a separator")),
            _ => end += 1,
        }
    }
}

/// Whether this is a decimal number: `[+-]?(d+(.d*)?|.d+)([eE][+-]?d+)?`.
#[inline]
pub(crate) fn is_number(field: &[u8]) -> bool {
    // What most names begin with is seen without a call.
    matches!(field.first(), Some(b'0'..=b'9' | b'+' | b'-' | b'.')) && is_decimal(field)
}

/// The same, of what begins like a number.
fn is_decimal(field: &[u8]) -> bool {
    let digits = |text: &[u8]| text.iter().take_while(|b| b.is_ascii_digit()).count();
    let unsigned = |text: &[u8]| usize::from(matches!(text.first(), Some(b'+' | b'-')));
    let rest = &field[unsigned(field)..];
    let whole = digits(rest);
    let mut rest = &rest[whole..];
    let mut fraction = 0;
    if let [b'.', behind @ ..] = rest {
        fraction = digits(behind);
        rest = &behind[fraction..];
    }
    if whole + fraction == 0 {
        return false;
    }
    if let [b'e' | b'E', behind @ ..] = rest {
        let behind = &behind[unsigned(behind)..];
        return !behind.is_empty() && digits(behind) == behind.len();
    }
    rest.is_empty()
}

/// The value of a decimal integer without sign and leading zeros, below 2^64.
pub(crate) fn integer(label: &str) -> Option<u64> {
    let plain = label.bytes().all(|b| b.is_ascii_digit());
    if plain && (label == "0" || !label.starts_with('0')) {
        label.parse().ok()
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fields(line: &str) -> Result<Vec<String>, String> {
        let mut fields = Vec::new();
        split(line, &mut fields).map_err(|problem| problem.to_string())?;
        Ok(fields.iter().map(|f| f.text(line).into_owned()).collect())
    }

    #[test]
    fn separators_quotes_and_comments() {
        for (line, expected) in [
            ("", &[][..]),
            (" \t", &[]),
            ("# a, b", &[]),
            (" %a b", &[]),
            ("a b", &["a", "b"]),
            (" a ,\tb  ", &["a", "b"]),
            ("a,b #c", &["a", "b"]),
            ("a#1 b%", &["a#1", "b%"]),
            ("\"a b\",\"c\"\"d, #\"", &["a b", "c\"d, #"]),
            ("\"\"\"\" x", &["\"", "x"]),
            ("\"#\" x", &["#", "x"]),
        ] {
            assert_eq!(fields(line).unwrap(), expected, "{line}");
        }
        for line in [
            ",",
            ",a b",
            "a b,",
            "a,,b",
            "a, ,b",
            "a b, # c",
            ", # c",
            "a \"\"",
            "a\"b\" c",
            "\"a b",
            "\"a\"b c",
            "\"a\"# c",
            "\"a\"\" b",
        ] {
            assert!(fields(line).is_err(), "{line}");
        }
    }

    #[test]
    fn numbers() {
        for number in ["0", "007", "-1", "+1.", ".5", "1.5e3", "-.5E-07", "1e+0"] {
            assert!(is_number(number.as_bytes()), "{number}");
        }
        for other in [
            "", ".", "-", "1e", "e5", "1e+", "0x1", "nan", "inf", "1.2.3", "1-", "--1", "1,",
        ] {
            assert!(!is_number(other.as_bytes()), "{other}");
        }
    }
}
