//! What an array is: the dictionary at the start of an `.npy` file.

use std::io::Read;

use super::{damaged, malformed};
use crate::error::Problem;

/// What every file begins with.
pub(in super::super) const MAGIC: &[u8] = b"\x93NUMPY";

/// The longest header that is read; those of arrays of numbers have 118 bytes.
const HEADER_LIMIT: usize = 1 << 16;
/// The most dimensions that NumPy knows.
const DIMENSIONS_LIMIT: usize = 64;

/// In which order the bytes of a number are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    Little,
    Big,
}

/// What the entries of an array are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Element {
    /// A real number: `b`, `i`, `u` or `f`, its size in bytes, and their order.
    Number(u8, usize, Order),
    /// Text of so many bytes.
    Bytes(usize),
    /// Text of so many characters of four bytes.
    Characters(usize, Order),
    Complex,
    Objects,
    /// Something else, by its name in NumPy.
    Other(String),
}

/// What an array is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) element: Element,
    /// Columns come first, and not rows.
    pub(super) fortran: bool,
    pub(super) shape: Vec<u64>,
}

impl Header {
    /// Reads a header, and nothing behind it.
    pub(super) fn read(mut input: impl Read) -> Result<Self, Problem> {
        let mut start = [0; 8];
        input.read_exact(&mut start).map_err(damaged)?;
        let length = match start {
            [magic @ .., 1, _] if magic == MAGIC => {
                let mut length = [0; 2];
                input.read_exact(&mut length).map_err(damaged)?;
                usize::from(u16::from_le_bytes(length))
            }
            [magic @ .., 2 | 3, _] if magic == MAGIC => {
                let mut length = [0; 4];
                input.read_exact(&mut length).map_err(damaged)?;
                u32::from_le_bytes(length) as usize
            }
            _ => return Err(malformed("no header of NumPy, of version 1, 2 or 3")),
        };
        if length > HEADER_LIMIT {
            return Err(malformed("a header longer than any of an array of numbers"));
        }
        let mut text = vec![0; length];
        input.read_exact(&mut text).map_err(damaged)?;
        let text = String::from_utf8_lossy(&text);
        Literal::new(&text)
            .header()
            .ok_or_else(|| malformed("the header is no description of an array"))
    }

    /// How many entries there are.
    pub(super) fn count(&self) -> Result<u64, Problem> {
        let count = self
            .shape
            .iter()
            .try_fold(1u64, |all, &one| all.checked_mul(one));
        count.ok_or_else(|| malformed("more entries than any file has"))
    }

    /// As `3x4`.
    pub(super) fn shape_text(&self) -> String {
        let sizes: Vec<String> = self.shape.iter().map(u64::to_string).collect();
        sizes.join("x")
    }

    /// What the entries are, in words.
    pub(super) fn class(&self) -> String {
        match &self.element {
            Element::Number(b'b', ..) => "bool".to_owned(),
            Element::Number(kind, size, _) => {
                let name = match kind {
                    b'i' => "int",
                    b'u' => "uint",
                    _ => "float",
                };
                format!("{name}{}", 8 * size)
            }
            Element::Bytes(_) | Element::Characters(..) => "text".to_owned(),
            Element::Complex => "complex".to_owned(),
            Element::Objects => "Python objects".to_owned(),
            Element::Other(name) => name.clone(),
        }
    }
}

/// The part of a literal of Python that has not been read.
struct Literal<'t> {
    rest: &'t str,
}

impl<'t> Literal<'t> {
    fn new(text: &'t str) -> Self {
        Self { rest: text.trim() }
    }

    fn eat(&mut self, word: &str) -> bool {
        self.rest = self.rest.trim_start();
        let eaten = self.rest.strip_prefix(word);
        self.rest = eaten.unwrap_or(self.rest);
        eaten.is_some()
    }

    /// A text in quotes without escapes.
    fn text(&mut self) -> Option<&'t str> {
        let quote = if self.eat("'") { '\'' } else { '"' };
        if quote == '"' && !self.eat("\"") {
            return None;
        }
        let (text, rest) = self.rest.split_once(quote)?;
        self.rest = rest;
        (!text.contains('\\')).then_some(text)
    }

    fn truth(&mut self) -> Option<bool> {
        match (self.eat("True"), self.eat("False")) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    fn shape(&mut self) -> Option<Vec<u64>> {
        let mut shape = Vec::new();
        if !self.eat("(") {
            return None;
        }
        while !self.eat(")") {
            self.rest = self.rest.trim_start();
            let digits = self.rest.bytes().take_while(u8::is_ascii_digit).count();
            shape.push(self.rest[..digits].parse().ok()?);
            self.rest = &self.rest[digits..];
            // Python 2 marks long integers.
            self.eat("L");
            if !self.eat(",") && !self.rest.trim_start().starts_with(')')
                || shape.len() > DIMENSIONS_LIMIT
            {
                return None;
            }
        }
        Some(shape)
    }

    fn header(mut self) -> Option<Header> {
        let (mut element, mut fortran, mut shape) = (None, None, None);
        if !self.eat("{") {
            return None;
        }
        while !self.eat("}") {
            let key = self.text()?;
            if !self.eat(":") {
                return None;
            }
            let twice = match key {
                "descr" if self.rest.trim_start().starts_with('[') => {
                    self.skip_list()?;
                    element
                        .replace(Element::Other("records".to_owned()))
                        .is_some()
                }
                "descr" => element.replace(element_of(self.text()?)).is_some(),
                "fortran_order" => fortran.replace(self.truth()?).is_some(),
                "shape" => shape.replace(self.shape()?).is_some(),
                _ => true,
            };
            if twice || !self.eat(",") && !self.rest.trim_start().starts_with('}') {
                return None;
            }
        }
        Some(Header {
            element: element?,
            fortran: fortran?,
            shape: shape?,
        })
    }

    /// Goes behind a list, whatever is in it.
    fn skip_list(&mut self) -> Option<()> {
        let mut depth = 0usize;
        for (at, c) in self.rest.char_indices() {
            match c {
                '[' | '(' => depth += 1,
                ']' | ')' => depth = depth.checked_sub(1)?,
                _ => {}
            }
            if depth == 0 && c == ']' {
                self.rest = &self.rest[at + 1..];
                return Some(());
            }
        }
        None
    }
}

/// What NumPy calls entries, for example `<f8`.
fn element_of(name: &str) -> Element {
    let order = if name.starts_with('>') {
        Order::Big
    } else {
        Order::Little
    };
    let kind = name.trim_start_matches(['<', '>', '=', '|']);
    let other = || Element::Other(format!("{:.20}", name.escape_debug()));
    let Some((letter, Ok(size))) = kind
        .is_char_boundary(1)
        .then(|| kind.split_at(1))
        .map(|(letter, size)| (letter.as_bytes()[0], size.parse::<usize>()))
    else {
        return match kind {
            "O" => Element::Objects,
            "?" => Element::Number(b'b', 1, order),
            _ => other(),
        };
    };
    match (letter, size) {
        (b'b', 1) | (b'i' | b'u', 1 | 2 | 4 | 8) | (b'f', 2 | 4 | 8) => {
            Element::Number(letter, size, order)
        }
        (b'c', _) => Element::Complex,
        (b'O', _) => Element::Objects,
        (b'S' | b'a', 1..=4096) => Element::Bytes(size),
        (b'U', 1..=4096) => Element::Characters(size, order),
        _ => other(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(text: &str) -> Option<Header> {
        Literal::new(text).header()
    }

    #[test]
    fn headers_of_numpy() {
        for (text, element, fortran, shape) in [
            (
                "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 4), }          \n",
                Element::Number(b'f', 8, Order::Little),
                false,
                &[3, 4][..],
            ),
            (
                "{\"shape\": (3L,), 'fortran_order':True,'descr':'>i2'}",
                Element::Number(b'i', 2, Order::Big),
                true,
                &[3],
            ),
            (
                "{'descr': '|b1', 'fortran_order': False, 'shape': (), }",
                Element::Number(b'b', 1, Order::Little),
                false,
                &[],
            ),
            (
                "{'descr': '<U7', 'fortran_order': False, 'shape': (2, 2)}",
                Element::Characters(7, Order::Little),
                false,
                &[2, 2],
            ),
            (
                "{'descr': [('a', '<i4', (2,)), ('b', '<f8')], 'fortran_order': False, 'shape': (2,)}",
                Element::Other("records".into()),
                false,
                &[2],
            ),
        ] {
            let shape = shape.to_vec();
            let expected = Header {
                element,
                fortran,
                shape,
            };
            assert_eq!(header(text), Some(expected), "{text}");
        }
    }

    #[test]
    fn other_dictionaries_are_refused() {
        for text in [
            "",
            "{}",
            "{'descr': '<f8', 'fortran_order': False}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3 4)}",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (-3,)}",
            "{'descr': '<f8', 'fortran_order': 0, 'shape': (3,)}",
            "{'descr': '<f8', 'descr': '<f8', 'fortran_order': True, 'shape': (3,)}",
            "{'descr': '<f8', 'fortran_order': True, 'shape': (99999999999999999999,)}",
            "{'descr': [(, 'fortran_order': True, 'shape': (3,)}",
            "{'descr: 3}",
        ] {
            assert_eq!(header(text), None, "{text}");
        }
        assert_eq!(element_of("f16"), Element::Other("f16".into()));
        assert_eq!(element_of("<M8[ns]"), Element::Other("<M8[ns]".into()));
        assert_eq!(element_of("|O"), Element::Objects);
        assert_eq!(element_of("\u{e9}4"), Element::Other("\u{e9}4".into()));
        assert_eq!(element_of(""), Element::Other(String::new()));
    }
}
