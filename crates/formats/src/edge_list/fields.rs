//! From a line to its fields.

use std::borrow::Cow;

use crate::error::Problem;

/// A field of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    /// Where its text begins and ends, within quotes.
    start: usize,
    end: usize,
    pub(crate) quoted: bool,
}

impl Field {
    /// What stands there, without the quotes around it.
    pub(crate) fn raw(self, line: &str) -> &str {
        &line[self.start..self.end]
    }

    /// What is meant: quotes within quotes are single again.
    pub(crate) fn text(self, line: &str) -> Cow<'_, str> {
        match self.raw(line) {
            raw if self.quoted && raw.contains('"') => raw.replace("\"\"", "\"").into(),
            raw => raw.into(),
        }
    }
}

/// Splits a line without control characters into its fields, at blanks, tabs and commas.
///
/// # Errors
/// A comma without a field on either side, a quote where none belongs.
pub(crate) fn split(line: &str, fields: &mut Vec<Field>) -> Result<(), Problem> {
    Separator::Any.split(line, fields)
}

/// What stands between the fields of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Separator {
    /// Blanks and tabs, and between them perhaps a comma.
    #[default]
    Any,
    /// This alone: fields may hold blanks, and be empty.
    Byte(u8),
}

impl Separator {
    /// Splits a line.
    ///
    /// # Errors
    /// As [`split`].
    pub(super) fn split(self, line: &str, fields: &mut Vec<Field>) -> Result<(), Problem> {
        let bytes = line.as_bytes();
        let by_blanks = self == Self::Any;
        let is_blank = |b: u8| b == b' ' || b == b'\t' && self != Self::Byte(b'\t');
        let cuts = |b: u8| b == b',' && self == Self::Any || self == Self::Byte(b);
        let behind = |at: usize| {
            let blanks = bytes[at..].iter().take_while(|b| is_blank(**b)).count();
            (at + blanks, bytes.get(at + blanks).copied())
        };
        fields.clear();
        let (mut at, mut next) = behind(0);
        if matches!(next, None | Some(b'#' | b'%')) {
            return Ok(());
        }
        loop {
            let field = if next == Some(b'"') {
                quoted(bytes, at, |b| is_blank(b) || cuts(b))?
            } else {
                let ends = |b: &u8| cuts(*b) || by_blanks && is_blank(*b);
                let end = bytes[at..].iter().position(ends);
                let text = &line[at..end.map_or(bytes.len(), |end| at + end)];
                let end = at + text.trim_end_matches([' ', '\t']).len();
                if text.contains('"') {
                    return Err(Problem::quote("stands within a field"));
                }
                let quoted = false;
                Field {
                    start: at,
                    end,
                    quoted,
                }
            };
            if by_blanks && (field.start == field.end || matches!(next, Some(b'#' | b'%'))) {
                return Err(Problem::empty_field());
            }
            fields.push(field);
            let end = field.end + usize::from(field.quoted);
            (at, next) = behind(end);
            match next {
                None => return Ok(()),
                Some(b) if cuts(b) => (at, next) = behind(at + 1),
                Some(b'#' | b'%') if by_blanks => return Ok(()),
                Some(_) if by_blanks => {}
                Some(_) => return Err(Problem::quote("is not followed by a separator")),
            }
        }
    }
}

/// The quoted field that begins at a quote.
fn quoted(bytes: &[u8], at: usize, ends: impl Fn(u8) -> bool) -> Result<Field, Problem> {
    let mut end = at + 1;
    loop {
        match (bytes.get(end), bytes.get(end + 1)) {
            (None, _) => return Err(Problem::quote("is not closed on its line")),
            (Some(b'"'), Some(b'"')) => end += 2,
            (Some(b'"'), Some(&b)) if !ends(b) => {
                return Err(Problem::quote("is not followed by a separator"));
            }
            (Some(b'"'), _) => {
                let (start, quoted) = (at + 1, true);
                return Ok(Field { start, end, quoted });
            }
            _ => end += 1,
        }
    }
}

/// Whether this is a decimal number: `[+-]?(d+(.d*)?|.d+)([eE][+-]?d+)?`.
pub(crate) fn is_number(field: &[u8]) -> bool {
    let plain = |b: &u8| b"0123456789+-.eE".contains(b);
    field.iter().all(plain) && str::from_utf8(field).is_ok_and(|text| text.parse::<f64>().is_ok())
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
