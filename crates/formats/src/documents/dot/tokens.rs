//! The words and signs of DOT ("The DOT Language", graphviz.org).

use std::borrow::Cow;

/// A word or a sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token<'t> {
    /// An identifier or number as it stands there.
    Word(&'t str),
    /// A text in quotes, without them.
    Quoted(Cow<'t, str>),
    /// A text in angle brackets.
    Html,
    /// One of `{}[]:;,=`.
    Sign(u8),
    /// `--`.
    Line,
    /// `->`.
    Arrow,
    /// The end of the text.
    End,
}

/// A text from which tokens are taken.
pub(super) struct Tokens<'t> {
    text: &'t str,
    at: usize,
    /// The line that has been reached, from 1.
    pub(super) line: u64,
}

impl<'t> Tokens<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self {
            text,
            at: 0,
            line: 1,
        }
    }

    fn rest(&self) -> &'t [u8] {
        &self.text.as_bytes()[self.at..]
    }

    /// Goes on by so many bytes, over the ends of lines among them.
    fn skip(&mut self, count: usize) {
        let passed = &self.rest()[..count];
        self.line += passed.iter().filter(|&&b| b == b'\n').count() as u64;
        self.at += count;
    }

    /// Passes blanks and comments.
    fn pass(&mut self) -> Result<(), String> {
        loop {
            let rest = self.rest();
            let line_start = self.at == 0 || self.text.as_bytes()[self.at - 1] == b'\n';
            let end_of = |mark: &[u8]| rest.windows(mark.len()).position(|part| part == mark);
            let count = match rest {
                [b' ' | b'\t' | b'\r' | b'\n', ..] => 1,
                [b'/', b'/', ..] => end_of(b"\n").unwrap_or(rest.len()),
                // Lines of a preprocessor.
                [b'#', ..] if line_start => end_of(b"\n").unwrap_or(rest.len()),
                [b'/', b'*', inner @ ..] => {
                    let end = inner.windows(2).position(|part| part == b"*/");
                    4 + end.ok_or("a comment is not closed")?
                }
                _ => return Ok(()),
            };
            self.skip(count);
        }
    }

    /// The next token.
    pub(super) fn next(&mut self) -> Result<Token<'t>, String> {
        self.pass()?;
        let rest = self.rest();
        let (token, count) = match rest {
            [] => return Ok(Token::End),
            [
                sign @ (b'{' | b'}' | b'[' | b']' | b':' | b';' | b',' | b'='),
                ..,
            ] => (Token::Sign(*sign), 1),
            [b'-', b'-', ..] => (Token::Line, 2),
            [b'-', b'>', ..] => (Token::Arrow, 2),
            [b'"', ..] => return self.quoted(),
            [b'<', ..] => return self.html(),
            [b'-' | b'.' | b'0'..=b'9', ..] => {
                let before = self.at.checked_sub(1).map(|at| self.text.as_bytes()[at]);
                if before.is_some_and(|b| in_word(b) || b == b'.') {
                    return Err("two words stand here without a blank: put names in quotes".into());
                }
                let count = number(rest);
                if count == 0 || rest.get(count).is_some_and(|&b| in_word(b)) {
                    return Err("a number goes on with letters: put the name in quotes".into());
                }
                (self.word(count), count)
            }
            [first, ..] if in_word(*first) => {
                let count = rest.iter().position(|&b| !in_word(b)).unwrap_or(rest.len());
                (self.word(count), count)
            }
            _ => {
                let sign = self.text[self.at..].chars().next().unwrap_or_default();
                return Err(format!(
                    "`{sign}` does not belong here: put names in quotes"
                ));
            }
        };
        self.skip(count);
        Ok(token)
    }

    fn word(&self, count: usize) -> Token<'t> {
        Token::Word(&self.text[self.at..self.at + count])
    }

    /// One or more texts in quotes, joined by `+`.
    fn quoted(&mut self) -> Result<Token<'t>, String> {
        let mut all = self.one_quoted()?;
        loop {
            self.pass()?;
            if self.rest().first() != Some(&b'+') {
                return Ok(Token::Quoted(all));
            }
            self.skip(1);
            self.pass()?;
            if self.rest().first() != Some(&b'"') {
                return Err("a `+` joins texts in quotes".into());
            }
            let more = self.one_quoted()?;
            all.to_mut().push_str(&more);
        }
    }

    fn one_quoted(&mut self) -> Result<Cow<'t, str>, String> {
        let inner = &self.rest()[1..];
        let (mut end, mut escaped) = (0, false);
        loop {
            match inner.get(end) {
                None => return Err("a quote is not closed".into()),
                Some(b'"') => break,
                Some(b'\\') => {
                    escaped = true;
                    end += 2;
                }
                Some(_) => end += 1,
            }
        }
        let start = self.at + 1;
        let raw = &self.text[start..start + end];
        self.skip(end + 2);
        Ok(if escaped {
            Cow::Owned(unescaped(raw))
        } else {
            Cow::Borrowed(raw)
        })
    }

    fn html(&mut self) -> Result<Token<'t>, String> {
        let mut depth = 0usize;
        for (at, byte) in self.rest().iter().enumerate() {
            match byte {
                b'<' => depth += 1,
                b'>' if depth == 1 => {
                    self.skip(at + 1);
                    return Ok(Token::Html);
                }
                b'>' => depth -= 1,
                _ => {}
            }
        }
        Err("a `<` is not closed".into())
    }
}

fn in_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte >= 0x80
}

/// The length of the number at the start: `-?(.d+|d+(.d*)?)`; 0 if there is none.
fn number(text: &[u8]) -> usize {
    let digits = |from: usize| {
        text[from..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let sign = usize::from(text[0] == b'-');
    let whole = digits(sign);
    let mut end = sign + whole;
    let mut fraction = 0;
    if text.get(end) == Some(&b'.') {
        fraction = digits(end + 1);
        end += 1 + fraction;
    }
    if whole + fraction == 0 { 0 } else { end }
}

/// A text in quotes as it is meant: only quotes and the ends of lines are escaped in DOT.
fn unescaped(raw: &str) -> String {
    let mut text = String::with_capacity(raw.len());
    let mut characters = raw.chars();
    while let Some(c) = characters.next() {
        if c != '\\' {
            text.push(c);
            continue;
        }
        match characters.next() {
            Some('"') => text.push('"'),
            Some('\n') => {}
            Some('\r') => {
                // A line feed follows, as no carriage return stands alone.
                characters.next();
            }
            Some(other) => text.extend(['\\', other]),
            None => text.push('\\'),
        }
    }
    text
}
