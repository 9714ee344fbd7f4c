//! The usual line: two integers below 2^32 and perhaps plain numbers, one separator between
//! neighbours. A list of 10^7 pairs is read at the speed of this module.
//!
//! In: text that begins at a line. Out: the pairs of as many lines as are of that kind; the first
//! that is not ends it, and whether anything is wrong with it is for the general way to say. A
//! long text is split at line ends and its pieces are read on all cores.

use rayon::prelude::*;

use super::{LINE_LIMIT, fields};

/// How much of a text is tried at first, on one core. As long as all lines are plain, twice as much
/// is tried next, so that what is read in vain is never much more than what is read.
const FIRST: usize = 1 << 14;
/// The least length of a piece for a core.
const PIECE: usize = 1 << 18;
/// More pieces than that are of no use to the cores of any machine.
const MOST_PIECES: usize = 256;

/// Plain lines at the start of a text.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Plain {
    /// One pair a line, in order.
    pub(super) pairs: Vec<(u32, u32)>,
    /// How many lines have fields that are ignored.
    pub(super) with_more: u64,
    /// How many bytes the lines have.
    pub(super) length: usize,
}

/// What follows the first two fields on a line, if it is plain: whether there are fields to be
/// ignored, and the text behind the line.
pub(super) type End<'a> = Option<(bool, &'a [u8])>;

/// Reads plain lines while `end` accepts what follows the pair on each. Memory that `plain` has is used again.
#[inline]
pub(super) fn read<'a>(text: &'a [u8], plain: &mut Plain, end: impl Fn(&'a [u8]) -> End<'a>) {
    let Plain {
        pairs,
        with_more,
        length,
    } = plain;
    pairs.clear();
    // Few lines are shorter than eight bytes.
    pairs.reserve(text.len().min(2 * PIECE) / 8);
    *with_more = 0;
    let mut left = text;
    // A pair of a label with itself is for the general way, before `end` takes note of it.
    while let Some((a, b, further)) = pair(left).filter(|(a, b, _)| a != b) {
        match end(further) {
            Some((more, rest)) if left.len() - rest.len() <= LINE_LIMIT => {
                pairs.push((a, b));
                *with_more += u64::from(more);
                left = rest;
            }
            _ => break,
        }
    }
    *length = text.len() - left.len();
}

/// The same on all cores, where `end` looks at one line alone; each batch of parts of the text is
/// given to `take`, in order. `trusted` is how much has been plain before it.
pub(super) fn read_parts<'a>(
    mut text: &'a [u8],
    trusted: usize,
    parts: &mut Vec<Plain>,
    end: impl Fn(&'a [u8]) -> End<'a> + Sync,
    mut take: impl FnMut(&Plain),
) {
    let mut size = FIRST.max(trusted);
    while !text.is_empty() {
        let batch = first_lines(text, size);
        let pieces = split(batch, (batch.len() / PIECE).clamp(1, MOST_PIECES));
        if parts.len() < pieces.len() {
            parts.resize_with(pieces.len(), Plain::default);
        }
        pieces
            .par_iter()
            .zip(&mut *parts)
            .for_each(|(piece, plain)| read(piece, plain, &end));
        for (plain, piece) in parts.iter().zip(pieces) {
            take(plain);
            if plain.length < piece.len() {
                return;
            }
        }
        text = &text[batch.len()..];
        size *= 2;
    }
}

/// The lines of a text that begin within so many bytes.
fn first_lines(text: &[u8], size: usize) -> &[u8] {
    let behind = text.get(size..).unwrap_or(&[]);
    match behind.iter().position(|&b| b == b'\n') {
        Some(end) => &text[..=size + end],
        None => text,
    }
}

/// A text in about so many pieces, each of which but the last ends with a line.
fn split(text: &[u8], count: usize) -> Vec<&[u8]> {
    let size = text.len().div_ceil(count).max(1);
    let mut pieces = Vec::with_capacity(count);
    let mut left = text;
    while !left.is_empty() {
        let piece = first_lines(left, size);
        pieces.push(piece);
        left = &left[piece.len()..];
    }
    pieces
}

/// Two integers at the start of a line with one separator between them, and what follows.
#[inline]
fn pair(text: &[u8]) -> Option<(u32, u32, &[u8])> {
    let (a, rest) = small_integer(text)?;
    let rest = match rest {
        [b' ' | b'\t' | b',', rest @ ..] => rest,
        _ => return None,
    };
    let (b, rest) = small_integer(rest)?;
    Some((a, b, rest))
}

/// An integer below 2^32 without leading zeros at the start of `text`.
#[inline]
fn small_integer(text: &[u8]) -> Option<(u32, &[u8])> {
    let (mut value, mut digits) = (0u64, 0);
    for byte in text.iter().take(11) {
        match byte.wrapping_sub(b'0') {
            digit @ 0..10 => value = 10 * value + u64::from(digit),
            _ => break,
        }
        digits += 1;
    }
    if digits == 0 || (text[0] == b'0' && digits > 1) {
        return None;
    }
    let value = u32::try_from(value).ok()?;
    Some((value, &text[digits..]))
}

/// What follows a line that has nothing more but blanks.
#[inline]
pub(super) fn line_end(mut text: &[u8]) -> Option<&[u8]> {
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
pub(super) fn further_numbers(text: &[u8], columns: usize) -> Option<(&[u8], &[u8])> {
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
pub(super) fn ignored(text: &[u8]) -> End<'_> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn integers() {
        for (text, expected) in [
            ("0 ", Some((0, 1))),
            ("7", Some((7, 1))),
            ("12\n........", Some((12, 2))),
            ("1234567,........", Some((1_234_567, 7))),
            ("12345678 .......", Some((12_345_678, 8))),
            ("123456789 .......", Some((123_456_789, 9))),
            ("4294967295 ......", Some((u32::MAX, 10))),
            ("4294967296 ......", None),
            ("12345678901 .....", None),
            ("01 ..............", None),
            ("00000000 ........", None),
            ("-1 ..............", None),
            (" 1 ..............", None),
            ("\u{e9}1 ............", None),
            ("", None),
        ] {
            let expected = expected.map(|(value, length)| (value, &text.as_bytes()[length..]));
            assert_eq!(small_integer(text.as_bytes()), expected, "{text:?}");
        }
    }

    proptest! {
        /// Pieces together are the text, and all but the last end with a line.
        #[test]
        fn pieces(text in "[ab\n]{0,200}", count in 1..20usize) {
            let pieces = split(text.as_bytes(), count);
            prop_assert_eq!(pieces.concat(), text.as_bytes());
            prop_assert!(pieces.iter().rev().skip(1).all(|piece| piece.ends_with(b"\n")));
        }
    }

    /// Many parts give the same lines as one, up to the first line that is not plain.
    #[test]
    fn all_cores() {
        let lines = |stop: usize| -> String {
            (0..200_000)
                .map(|k| match k {
                    _ if k == stop => "a b\n".to_owned(),
                    _ => format!("{k} {} 1\n", k + 1),
                })
                .collect()
        };
        for (stop, trusted) in [
            (0, 0),
            (1, 0),
            (77_777, 1 << 20),
            (199_999, 0),
            (200_000, 1 << 19),
        ] {
            let text = lines(stop);
            let (mut pairs, mut length, mut with_more) = (Vec::new(), 0, 0);
            let take = |plain: &Plain| {
                pairs.extend_from_slice(&plain.pairs);
                length += plain.length;
                with_more += plain.with_more;
            };
            // What a buffer holds from before does not matter.
            let mut parts = vec![Plain {
                pairs: vec![(7, 8)],
                with_more: 9,
                length: 10,
            }];
            read_parts(text.as_bytes(), trusted, &mut parts, ignored, take);
            let expected: Vec<_> = (0..stop.min(200_000) as u32).map(|k| (k, k + 1)).collect();
            assert_eq!(pairs, expected);
            assert_eq!(text[length..].is_empty(), stop == 200_000);
            assert!(stop == 200_000 || text[length..].starts_with("a b\n"));
            assert_eq!(with_more, stop as u64);
        }
    }
}
