//! A strict reader of the JSON that certificates use: integers below 2^53 only, no `true` and `false`, no repeated
//! members, bounded depth, nothing after the text. Lists of integers, which make up nearly all of a large certificate,
//! are stored compactly; nothing is allocated by a length that the text merely claims.

use crate::rejection::{Checked, Rejection, Within, ensure};
use std::borrow::Cow;

const MAX_DEPTH: usize = 64;
/// No object of the format has more members; also keeps the search for repeated ones short.
const MAX_MEMBERS: usize = 16;
const INT_LIMIT: i64 = 1 << 53;

/// A JSON value.
#[derive(Debug)]
pub(crate) enum Value<'a> {
    Null,
    Int(i64),
    Text(Cow<'a, str>),
    /// A list of at most three integers; every empty list.
    Few(usize, [i64; 3]),
    /// A longer list of integers.
    Ints(Vec<i64>),
    /// A list that holds something else than integers.
    List(Vec<Value<'a>>),
    Object(Vec<(Cow<'a, str>, Value<'a>)>),
}

/// The members of an object, taken by name in any order.
pub(crate) struct Members<'v> {
    list: &'v [(Cow<'v, str>, Value<'v>)],
    taken: u32,
}

impl<'v> Members<'v> {
    pub fn take(&mut self, name: &str) -> Checked<&'v Value<'v>> {
        let found = self.list.iter().position(|(other, _)| other == name);
        let position = found.ok_or_else(|| Rejection::new(format!("member `{name}` is missing")))?;
        self.taken |= 1 << position;
        Ok(&self.list[position].1)
    }

    /// Takes a member and reads it; a failure names the member.
    pub fn read<T>(&mut self, name: &str, reader: impl FnOnce(&'v Value<'v>) -> Checked<T>) -> Checked<T> {
        self.take(name).and_then(|value| reader(value).within(|| name.to_string()))
    }

    /// Rejects members that nobody took.
    pub fn end(self) -> Checked<()> {
        for (position, (name, _)) in self.list.iter().enumerate() {
            ensure!(self.taken >> position & 1 == 1, "unknown member `{name}`");
        }
        Ok(())
    }
}

impl<'a> Value<'a> {
    fn mismatch<T>(&self, wanted: &str) -> Checked<T> {
        let found = match self {
            Value::Null => "null",
            Value::Int(_) => "an integer",
            Value::Text(_) => "a string",
            Value::Few(..) | Value::Ints(_) | Value::List(_) => "a list",
            Value::Object(_) => "an object",
        };
        Err(Rejection::new(format!("expected {wanted}, found {found}")))
    }

    pub fn members(&'a self) -> Checked<Members<'a>> {
        match self {
            Value::Object(list) => Ok(Members { list, taken: 0 }),
            _ => self.mismatch("an object"),
        }
    }

    pub fn is_null(&self) -> bool {
        matches!(self, Value::Null)
    }

    pub fn int(&self) -> Checked<i64> {
        match self {
            Value::Int(value) => Ok(*value),
            _ => self.mismatch("an integer"),
        }
    }

    /// An integer that is not negative.
    pub fn count(&self) -> Checked<u64> {
        let value = self.int()?;
        u64::try_from(value).map_err(|_| Rejection::new(format!("{value} is negative")))
    }

    pub fn text(&self) -> Checked<&str> {
        match self {
            Value::Text(text) => Ok(text),
            _ => self.mismatch("a string"),
        }
    }

    pub fn ints(&self) -> Checked<&[i64]> {
        match self {
            Value::Few(length, entries) => Ok(&entries[..*length]),
            Value::Ints(entries) => Ok(entries),
            _ => self.mismatch("a list of integers"),
        }
    }

    /// A list of anything but integers.
    pub fn list(&'a self) -> Checked<&'a [Value<'a>]> {
        match self {
            Value::List(entries) => Ok(entries),
            Value::Few(0, _) => Ok(&[]),
            Value::Few(..) | Value::Ints(_) => Err(Rejection::new("expected a list without integers")),
            _ => self.mismatch("a list"),
        }
    }

    /// A list of different integers from 0 to `limit` - 1.
    pub fn indices(&self, limit: usize) -> Checked<Vec<usize>> {
        let mut indices = Vec::new();
        for &entry in self.ints()? {
            match usize::try_from(entry) {
                Ok(index) if index < limit => indices.push(index),
                _ => {
                    return Err(Rejection::new(format!("{entry} is out of range (0 to {limit}, exclusive)")));
                }
            }
        }
        let mut sorted = indices.clone();
        sorted.sort_unstable();
        let repeated = sorted.windows(2).find(|pair| pair[0] == pair[1]);
        ensure!(repeated.is_none(), "{} stands twice", repeated.map_or(0, |pair| pair[0]));
        Ok(indices)
    }

    /// The same, and strictly increasing.
    pub fn increasing(&self, limit: usize) -> Checked<Vec<usize>> {
        let indices = self.indices(limit)?;
        ensure!(indices.is_sorted(), "the list is not increasing");
        Ok(indices)
    }

    /// A string with a decimal integer: whether it is negative, and its digits.
    pub fn decimal(&self) -> Checked<(bool, &str)> {
        let text = self.text()?;
        let (negative, digits) = text.strip_prefix('-').map_or((false, text), |digits| (true, digits));
        let plain = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        ensure!(plain && (digits == "0" || !digits.starts_with('0')) && text != "-0", "not a decimal integer");
        Ok((negative, digits))
    }

    /// A string with a decimal integer from 0 to 2^64 - 1.
    pub fn big(&self) -> Checked<u64> {
        match self.decimal()? {
            (false, digits) => digits.parse().map_err(|_| Rejection::new("2^64 or more")),
            _ => Err(Rejection::new("negative")),
        }
    }
}

/// Parses one JSON text.
pub(crate) fn parse(bytes: &[u8]) -> Checked<Value<'_>> {
    let text = std::str::from_utf8(bytes).map_err(|error| Rejection::new(format!("not UTF-8: {error}")));
    let mut parser = Parser { text: text.within(|| "JSON".into())?, at: 0 };
    let value = parser.value(0).and_then(|value| {
        parser.blanks();
        ensure!(parser.at == bytes.len(), "something follows the text");
        Ok(value)
    });
    value.within(|| format!("JSON, byte {}", parser.at))
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Parser<'a> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn blanks(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    fn expect(&mut self, byte: u8) -> Checked<()> {
        self.blanks();
        ensure!(self.peek() == Some(byte), "expected `{}`", char::from(byte));
        self.at += 1;
        Ok(())
    }

    /// Skips blanks and, if it comes next, the byte.
    fn skip(&mut self, byte: u8) -> bool {
        self.blanks();
        let found = self.peek() == Some(byte);
        self.at += usize::from(found);
        found
    }

    fn value(&mut self, depth: usize) -> Checked<Value<'a>> {
        ensure!(depth < MAX_DEPTH, "nested too deeply");
        self.blanks();
        match self.peek() {
            Some(b'{') => self.object(depth),
            Some(b'[') => self.list(depth),
            Some(b'"') => Ok(Value::Text(self.string()?)),
            Some(b'-' | b'0'..=b'9') => Ok(Value::Int(self.int()?)),
            Some(b'n') if self.text[self.at..].starts_with("null") => {
                self.at += 4;
                Ok(Value::Null)
            }
            Some(_) => Err(Rejection::new("expected an object, a list, a string, an integer or null")),
            None => Err(Rejection::new("the text ends early")),
        }
    }

    fn object(&mut self, depth: usize) -> Checked<Value<'a>> {
        let mut members: Vec<(Cow<'a, str>, Value<'a>)> = Vec::new();
        self.expect(b'{')?;
        if self.skip(b'}') {
            return Ok(Value::Object(members));
        }
        loop {
            self.blanks();
            let name = self.string()?;
            ensure!(members.iter().all(|(other, _)| *other != name), "member `{name}` stands twice");
            ensure!(members.len() < MAX_MEMBERS, "an object with too many members");
            self.expect(b':')?;
            members.push((name, self.value(depth + 1)?));
            if !self.skip(b',') {
                self.expect(b'}')?;
                return Ok(Value::Object(members));
            }
        }
    }

    fn list(&mut self, depth: usize) -> Checked<Value<'a>> {
        let (mut few, mut length) = ([0; 3], 0);
        let (mut ints, mut list) = (Vec::new(), Vec::new());
        self.expect(b'[')?;
        if self.skip(b']') {
            return Ok(Value::Few(0, few));
        }
        loop {
            match self.value(depth + 1)? {
                Value::Int(entry) if list.is_empty() && length < 3 => {
                    few[length] = entry;
                    length += 1;
                }
                Value::Int(entry) if list.is_empty() => {
                    if ints.is_empty() {
                        ints.extend(few);
                    }
                    ints.push(entry);
                }
                other => {
                    if list.is_empty() {
                        let before = if ints.is_empty() { &few[..length] } else { &ints[..] };
                        list.extend(before.iter().map(|&entry| Value::Int(entry)));
                    }
                    list.push(other);
                }
            }
            if !self.skip(b',') {
                self.expect(b']')?;
                return Ok(match (list.is_empty(), ints.is_empty()) {
                    (true, true) => Value::Few(length, few),
                    (true, false) => Value::Ints(ints),
                    (false, _) => Value::List(list),
                });
            }
        }
    }

    fn int(&mut self) -> Checked<i64> {
        let negative = self.peek() == Some(b'-');
        self.at += usize::from(negative);
        let start = self.at;
        let mut value = 0i64;
        while let Some(digit @ b'0'..=b'9') = self.peek() {
            value = value * 10 + i64::from(digit - b'0');
            ensure!(value < INT_LIMIT, "an integer of 2^53 or more");
            self.at += 1;
        }
        let zero_first = self.text.as_bytes().get(start) == Some(&b'0');
        ensure!(self.at > start, "a minus sign without digits");
        ensure!(!zero_first || self.at == start + 1, "an integer with leading zeros");
        ensure!(!(negative && value == 0), "minus zero");
        ensure!(!matches!(self.peek(), Some(b'.' | b'e' | b'E')), "a number that is not written as an integer");
        Ok(if negative { -value } else { value })
    }

    fn string(&mut self) -> Checked<Cow<'a, str>> {
        ensure!(self.peek() == Some(b'"'), "expected a string");
        self.at += 1;
        let mut text = Cow::Borrowed("");
        loop {
            let start = self.at;
            while !matches!(self.peek(), None | Some(b'"' | b'\\' | 0..0x20)) {
                self.at += 1;
            }
            let plain = &self.text[start..self.at];
            if text.is_empty() {
                text = Cow::Borrowed(plain);
            } else {
                text.to_mut().push_str(plain);
            }
            let ending = self.peek();
            self.at += 1;
            match ending {
                Some(b'"') => return Ok(text),
                Some(b'\\') => text.to_mut().push(self.escape()?),
                Some(_) => return Err(Rejection::new("a control character in a string")),
                None => return Err(Rejection::new("the text ends early")),
            }
        }
    }

    fn escape(&mut self) -> Checked<char> {
        let letter = self.peek();
        self.at += 1;
        Ok(match letter {
            Some(byte @ (b'"' | b'\\' | b'/')) => char::from(byte),
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => {
                let mut code = self.hex()?;
                if (0xD800..0xDC00).contains(&code) && self.text.as_bytes()[self.at..].starts_with(b"\\u") {
                    self.at += 2;
                    let low = self.hex()?;
                    ensure!((0xDC00..0xE000).contains(&low), "half of a surrogate pair");
                    code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
                }
                char::from_u32(code).ok_or_else(|| Rejection::new("half of a surrogate pair"))?
            }
            _ => return Err(Rejection::new("an unknown escape in a string")),
        })
    }

    fn hex(&mut self) -> Checked<u32> {
        let digits = self.text.as_bytes().get(self.at..self.at + 4).unwrap_or(b"");
        ensure!(digits.len() == 4 && digits.iter().all(u8::is_ascii_hexdigit), "expected four hexadecimal digits");
        self.at += 4;
        Ok(digits.iter().fold(0, |code, &digit| code * 16 + char::from(digit).to_digit(16).unwrap_or(0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reason(text: &str) -> String {
        parse(text.as_bytes()).map(|value| format!("{value:?}")).unwrap_err().reason().to_string()
    }

    #[test]
    fn reads_what_the_format_uses() {
        let value =
            parse(br#" {"a": [1, -2], "b": null, "c": "x\n\u00e9\ud83d\ude00y", "d": [1,2,3,4], "e": [0,[5]]} "#)
                .unwrap();
        let mut members = value.members().unwrap();
        assert_eq!(members.take("c").unwrap().text().unwrap(), "x\n\u{e9}\u{1f600}y");
        assert_eq!(members.take("a").unwrap().ints().unwrap(), [1, -2]);
        assert_eq!(members.take("d").unwrap().ints().unwrap(), [1, 2, 3, 4]);
        assert_eq!(members.take("e").unwrap().list().unwrap()[1].ints().unwrap(), [5]);
        assert!(members.take("f").is_err());
        assert_eq!(members.end().unwrap_err().reason(), "unknown member `b`");
    }

    #[test]
    fn refuses_everything_else() {
        for (text, wanted) in [
            ("", "the text ends early"),
            ("[1,2", "expected `]`"),
            ("1.5", "a number that is not written as an integer"),
            ("1e3", "a number that is not written as an integer"),
            ("01", "an integer with leading zeros"),
            ("-0", "minus zero"),
            ("-", "a minus sign without digits"),
            ("9007199254740992", "an integer of 2^53 or more"),
            ("true", "expected an object, a list, a string, an integer or null"),
            ("[1,]", "expected an object, a list, a string, an integer or null"),
            ("{\"a\":1,\"\\u0061\":2}", "member `a` stands twice"),
            ("{\"a\" 1}", "expected `:`"),
            ("[] []", "something follows the text"),
            ("\"\\ud800\"", "half of a surrogate pair"),
            ("\"\\ud800\\u0041\"", "half of a surrogate pair"),
            ("\"\\x\"", "an unknown escape in a string"),
            ("\"\\u00g0\"", "expected four hexadecimal digits"),
            ("\"a", "the text ends early"),
            ("\"\u{1}\"", "a control character in a string"),
        ] {
            assert_eq!(reason(text), wanted, "{text}");
        }
        assert_eq!(reason(&"[".repeat(100_000)), "nested too deeply");
        assert!(parse(b"\"\xff\"").is_err());
        assert_eq!(parse(b"9007199254740991").unwrap().int().unwrap(), 9_007_199_254_740_991);
    }

    #[test]
    fn decimals_have_one_spelling() {
        for text in ["", "-", "-0", "00", "+1", "1 ", "0x1"] {
            assert!(Value::Text(text.into()).decimal().is_err(), "{text}");
        }
        assert_eq!(Value::Text("-17".into()).decimal().unwrap(), (true, "17"));
        assert_eq!(Value::Text("18446744073709551615".into()).big().unwrap(), u64::MAX);
        assert!(Value::Text("18446744073709551616".into()).big().is_err());
    }
}
