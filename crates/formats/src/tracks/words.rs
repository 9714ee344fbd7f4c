//! Text as words and whole numbers, with the number of the line for errors.

use std::io::{BufRead, BufReader, Read};

use crate::edge_list::BYTE_ORDER_MARK;
use crate::edge_list::fields;
use crate::error::{Fault, Place, Problem};

/// The longest line that is read: a point that ten million images see.
const LINE_LIMIT: u64 = 1 << 28;

/// A text that is read word by word, over the ends of lines, or line by line.
pub(crate) struct Words<R> {
    input: BufReader<R>,
    line: Vec<u8>,
    /// What has been read of the line.
    at: usize,
    number: u64,
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n')
}

impl<R: Read> Words<R> {
    pub(crate) fn new(input: R) -> Self {
        Self {
            input: BufReader::with_capacity(1 << 16, input),
            line: Vec::new(),
            at: 0,
            number: 0,
        }
    }

    /// A refusal at this line.
    pub(crate) fn corrupt(&self, why: impl Into<String>) -> Fault {
        Place::Line(self.number).fault(Problem::corrupt(why.into()))
    }

    /// A refusal since the text ends here.
    pub(crate) fn truncated(&self, missing: &str) -> Fault {
        Place::Line(self.number).fault(Problem::truncated(format!("{missing} is missing")))
    }

    /// Goes to the next line; whether there is one.
    pub(crate) fn next_line(&mut self) -> Result<bool, Fault> {
        self.line.clear();
        self.at = 0;
        let got = self
            .input
            .by_ref()
            .take(LINE_LIMIT + 1)
            .read_until(b'\n', &mut self.line)
            .map_err(Problem::from)?;
        if got == 0 {
            return Ok(false);
        }
        self.number += 1;
        if got as u64 > LINE_LIMIT {
            return Err(Place::Line(self.number).fault(Problem::long_line(LINE_LIMIT)));
        }
        if self.number == 1 && self.line.starts_with(BYTE_ORDER_MARK) {
            self.at = BYTE_ORDER_MARK.len();
        }
        Ok(true)
    }

    /// Goes to the next line that is neither blank nor a comment; whether there is one.
    pub(crate) fn next_full_line(&mut self) -> Result<bool, Fault> {
        while self.next_line()? {
            let rest = self.rest();
            if !rest.is_empty() && !rest.starts_with(b"#") {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// What is left of the line, without blanks around it.
    pub(crate) fn rest(&self) -> &[u8] {
        self.line[self.at..].trim_ascii()
    }

    /// The next word of this line, as a range of it.
    fn word_here(&mut self) -> Option<(usize, usize)> {
        let line = &self.line[self.at..];
        let start = self.at + line.iter().position(|&byte| !is_blank(byte))?;
        let length = self.line[start..].iter().position(|&byte| is_blank(byte));
        let end = length.map_or(self.line.len(), |length| start + length);
        self.at = end;
        Some((start, end))
    }

    /// The next word of this line.
    pub(crate) fn word_of_line(&mut self) -> Option<&[u8]> {
        self.word_here().map(|(start, end)| &self.line[start..end])
    }

    /// The next word, on this line or a later one.
    pub(crate) fn word(&mut self) -> Result<Option<&[u8]>, Fault> {
        let (start, end) = loop {
            if let Some(range) = self.word_here() {
                break range;
            }
            if !self.next_line()? {
                return Ok(None);
            }
        };
        Ok(Some(&self.line[start..end]))
    }

    /// Passes over words, which have to be there.
    pub(crate) fn skip(&mut self, count: u64, what: &str) -> Result<(), Fault> {
        for _ in 0..count {
            if self.word()?.is_none() {
                return Err(self.truncated(what));
            }
        }
        Ok(())
    }

    /// The next word as a whole number.
    pub(crate) fn number(&mut self, what: &str) -> Result<u64, Fault> {
        let Some(word) = self.word()? else {
            return Err(self.truncated(what));
        };
        match integer(word) {
            Some(value) => Ok(value),
            None => {
                let word = shown(word);
                Err(self.corrupt(format!("`{word}` stands where {what} is expected")))
            }
        }
    }

    /// The next word as a number below a limit.
    pub(crate) fn number_below(&mut self, limit: u64, what: &str) -> Result<u32, Fault> {
        let value = self.number(what)?;
        match u32::try_from(value) {
            Ok(small) if value < limit => Ok(small),
            _ => Err(self.corrupt(format!("{what} is {value}, and there are {limit}"))),
        }
    }
}

/// A word in a message: its beginning, if it is long.
pub(crate) fn shown(word: &[u8]) -> String {
    let word = String::from_utf8_lossy(word);
    word.chars().filter(|c| !c.is_control()).take(40).collect()
}

/// A word of decimal digits.
pub(crate) fn integer(word: &[u8]) -> Option<u64> {
    if word.is_empty() {
        return None;
    }
    word.iter().try_fold(0u64, |value, byte| {
        let digit = byte.wrapping_sub(b'0');
        (digit < 10).then_some(())?;
        value.checked_mul(10)?.checked_add(digit.into())
    })
}

/// A word that is a decimal number, with a fraction or exponent perhaps.
pub(crate) fn is_number(word: &[u8]) -> bool {
    fields::is_number(word)
}

/// The words of the first three lines of a text that are neither blank nor comments.
pub(crate) fn first_lines(text: &[u8], whole: bool) -> Vec<Vec<&[u8]>> {
    let end = match text.iter().rposition(|&byte| byte == b'\n') {
        Some(end) if !whole => end,
        _ => text.len(),
    };
    text[..end]
        .split(|&byte| byte == b'\n')
        .map(|line| {
            let words = line.split(|&byte| is_blank(byte));
            words.filter(|word| !word.is_empty()).collect::<Vec<_>>()
        })
        .filter(|words| words.first().is_some_and(|word| !word.starts_with(b"#")))
        .take(3)
        .collect()
}
