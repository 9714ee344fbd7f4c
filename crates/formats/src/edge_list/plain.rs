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

/// Plain lines at the start of a text: their pairs in order, and how many bytes the lines have.
pub(super) type Plain = (Vec<(u32, u32)>, usize);

/// Reads plain lines of so many fields. Memory that `plain` has is used again.
#[inline]
fn read(text: &[u8], (pairs, length): &mut Plain, width: usize) {
    pairs.clear();
    // Few lines are shorter than eight bytes.
    pairs.reserve(text.len().min(2 * PIECE) / 8);
    let mut left = text;
    // A pair of a label with itself is for the general way.
    while let Some((a, b, further)) = pair(left).filter(|(a, b, _)| a != b) {
        match end(further, width) {
            Some(rest) if left.len() - rest.len() <= LINE_LIMIT => {
                pairs.push((a, b));
                left = rest;
            }
            _ => break,
        }
    }
    *length = text.len() - left.len();
}

/// The same on all cores; each batch of parts of the text is
/// given to `take`, in order. `trusted` is how much has been plain before it.
pub(super) fn read_parts(
    mut text: &[u8],
    trusted: usize,
    parts: &mut Vec<Plain>,
    width: usize,
    mut take: impl FnMut(&Plain),
) {
    let mut size = FIRST.max(trusted);
    while !text.is_empty() {
        let batch = first_lines(text, size);
        let pieces = split(batch, (batch.len() / PIECE).clamp(1, MOST_PIECES));
        if parts.len() < pieces.len() {
            parts.resize_with(pieces.len(), Plain::default);
        }
        let all = pieces.par_iter().zip(&mut *parts);
        all.for_each(|(piece, plain)| read(piece, plain, width));
        for (plain, piece) in parts.iter().zip(pieces) {
            take(plain);
            if plain.1 < piece.len() {
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

/// What follows the line behind the first two of so many fields, if the others are numbers after one
/// separator each.
#[inline]
fn end(mut text: &[u8], width: usize) -> Option<&[u8]> {
    for _ in 2..width {
        let [b' ' | b'\t' | b',', rest @ ..] = text else {
            return None;
        };
        let mut end = rest.iter().position(|b| !b.is_ascii_digit())?;
        if end == 0 || !matches!(rest[end], b' ' | b'\t' | b',' | b'\n' | b'\r') {
            let ends = |b: &u8| matches!(b, b' ' | b'\t' | b',' | b'\n' | b'\r');
            end = rest.iter().position(ends)?;
            if !fields::is_number(&rest[..end]) {
                return None;
            }
        }
        text = &rest[end..];
    }
    while let [b' ' | b'\t', rest @ ..] = text {
        text = rest;
    }
    match text {
        [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => Some(rest),
        _ => None,
    }
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
            let (mut pairs, mut length) = (Vec::new(), 0);
            let take = |plain: &Plain| {
                pairs.extend_from_slice(&plain.0);
                length += plain.1;
            };
            // What a buffer holds from before does not matter.
            let mut parts = vec![(vec![(7, 8)], 10)];
            read_parts(text.as_bytes(), trusted, &mut parts, 3, take);
            let expected: Vec<_> = (0..stop.min(200_000) as u32).map(|k| (k, k + 1)).collect();
            assert_eq!(pairs, expected);
            assert_eq!(text[length..].is_empty(), stop == 200_000);
            assert!(stop == 200_000 || text[length..].starts_with("a b\n"));
        }
    }
}
