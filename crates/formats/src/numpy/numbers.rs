//! The entries of an array, as they are stored.

use std::io::Read;

use super::header::{Element, Header, Order};
use super::{damaged, malformed};
use crate::error::Problem;

/// How many bytes are decoded at once; a multiple of the size of every number.
const BLOCK: usize = 1 << 16;

/// Calls `each` with all numbers of an array, in the order in which they are stored.
///
/// # Errors
/// Those of `each`; no numbers; an array that ends early.
pub(super) fn each(
    header: &Header,
    input: &mut dyn Read,
    mut each: impl FnMut(f64) -> Result<(), Problem>,
) -> Result<(), Problem> {
    let Element::Number(kind, size, order) = header.element else {
        return Err(malformed("an array that is not of real numbers"));
    };
    let decode = decoder(kind, size);
    let mut block = vec![0; BLOCK];
    let mut left = header.count()?;
    while left > 0 {
        let count = left.min((BLOCK / size) as u64) as usize;
        let bytes = &mut block[..count * size];
        input.read_exact(bytes).map_err(damaged)?;
        for number in bytes.chunks_exact_mut(size) {
            if order == Order::Big {
                number.reverse();
            }
            each(decode(number))?;
        }
        left -= count as u64;
    }
    Ok(())
}

/// Decodes numbers of one type whose least byte comes first.
fn decoder(kind: u8, size: usize) -> fn(&[u8]) -> f64 {
    macro_rules! number {
        ($number:ty) => {
            |bytes| <$number>::from_le_bytes(bytes.try_into().unwrap_or_default()) as f64
        };
    }
    match (kind, size) {
        (b'b', _) => |bytes| f64::from(u8::from(bytes[0] != 0)),
        (b'i', 1) => number!(i8),
        (b'i', 2) => number!(i16),
        (b'i', 4) => number!(i32),
        (b'i', _) => number!(i64),
        (b'u', 1) => number!(u8),
        (b'u', 2) => number!(u16),
        (b'u', 4) => number!(u32),
        (b'u', _) => number!(u64),
        (_, 2) => |bytes| half(u16::from_le_bytes(bytes.try_into().unwrap_or_default())),
        (_, 4) => number!(f32),
        _ => number!(f64),
    }
}

/// The value of a number of IEEE 754's 16 bits.
fn half(bits: u16) -> f64 {
    let fraction = f64::from(bits & 0x3ff);
    let exponent = i32::from(bits >> 10 & 0x1f);
    let value = match exponent {
        0 => fraction * 2f64.powi(-24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction / 1024.0) * 2f64.powi(exponent - 15),
    };
    if bits >> 15 == 1 { -value } else { value }
}

/// Calls `each` with all texts of an array.
///
/// # Errors
/// What is no text; an array that ends early.
pub(super) fn each_text(
    header: &Header,
    input: &mut dyn Read,
    mut each: impl FnMut(String),
) -> Result<(), Problem> {
    let size = match header.element {
        Element::Bytes(size) => size,
        Element::Characters(size, _) => 4 * size,
        _ => return Err(malformed("an array that is not of text")),
    };
    let mut bytes = vec![0; size];
    for _ in 0..header.count()? {
        input.read_exact(&mut bytes).map_err(damaged)?;
        let text = match header.element {
            Element::Characters(_, order) => characters(&bytes, order),
            _ => String::from_utf8(bytes.clone()).ok(),
        };
        let text = text.ok_or(Problem::NotUtf8)?;
        // Texts are filled up with zeros.
        each(text.trim_end_matches('\0').to_owned());
    }
    Ok(())
}

fn characters(bytes: &[u8], order: Order) -> Option<String> {
    let (words, _) = bytes.as_chunks::<4>();
    let code = |&word: &[u8; 4]| match order {
        Order::Little => u32::from_le_bytes(word),
        Order::Big => u32::from_be_bytes(word),
    };
    words
        .iter()
        .map(|word| char::from_u32(code(word)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the table in IEEE 754-2008 on binary16, and of numpy.float16.
    #[test]
    fn halves() {
        for (bits, value) in [
            (0x0000, 0.0),
            (0x0001, 5.960_464_477_539_063e-8),
            (0x03ff, 6.097_555_160_522_461e-5),
            (0x0400, 6.103_515_625e-5),
            (0x3555, 0.333_251_953_125),
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x7bff, 65504.0),
            (0x7c00, f64::INFINITY),
        ] {
            assert_eq!(half(bits), value, "{bits:#x}");
        }
        assert!(half(0x7e00).is_nan());
    }
}
