//! GML: lists of keys and values ("GML: A portable graph file format", M. Himsolt), as networkx,
//! igraph and Gephi write them.
//!
//! Nodes have an `id`, edges a `source` and a `target`, which are ids. They are called by their
//! `label` or `name` if these name them, as networkx reads them too. All else is of no concern.

use crate::documents::collected::Collected;
use crate::documents::{Parsed, line_of, malformed};
use crate::edge_list::layout::ListOptions;
use crate::error::{Fault, Place, Problem};

const FORMAT: &str = "GML";

/// How deep lists may stand in lists.
const DEPTH: usize = 100;

/// Whether a text begins like GML: a list `graph`, with texts and numbers before it.
pub(super) fn is_gml(head: &str) -> bool {
    let mut tokens = Tokens::new(head);
    loop {
        let (Ok(Some(Token::Word(key))), Ok(value)) = (tokens.next(), tokens.next()) else {
            return false;
        };
        match value {
            Some(Token::Open) => return key.eq_ignore_ascii_case("graph"),
            Some(Token::Text(_) | Token::Number(_)) => {}
            // Gephi writes `Creator Gephi` without quotes.
            Some(Token::Word(_)) if key.eq_ignore_ascii_case("creator") => {}
            _ => return false,
        }
    }
}

/// A part of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Token<'t> {
    Word(&'t str),
    Number(&'t str),
    /// What stands in quotes.
    Text(&'t str),
    Open,
    Close,
}

/// The parts of a text, one after another.
struct Tokens<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Tokens<'t> {
    fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    /// Takes the characters for which this holds.
    fn take(&mut self, holds: impl Fn(char) -> bool) -> &'t str {
        let rest = self.rest();
        let taken = &rest[..rest.find(|c| !holds(c)).unwrap_or(rest.len())];
        self.at += taken.len();
        taken
    }

    /// The next part; none at the end.
    fn next(&mut self) -> Result<Option<Token<'t>>, Problem> {
        loop {
            self.take(char::is_whitespace);
            if !self.rest().starts_with('#') {
                break;
            }
            self.take(|c| c != '\n');
        }
        let Some(first) = self.rest().chars().next() else {
            return Ok(None);
        };
        Ok(Some(match first {
            '[' | ']' => {
                self.at += 1;
                if first == '[' {
                    Token::Open
                } else {
                    Token::Close
                }
            }
            '"' => {
                self.at += 1;
                let text = self.take(|c| c != '"');
                if self.rest().is_empty() {
                    return Err(malformed(FORMAT, "a quote (\") is not closed"));
                }
                self.at += 1;
                Token::Text(text)
            }
            '+' | '-' | '.' | '0'..='9' => {
                Token::Number(self.take(|c| c.is_ascii_alphanumeric() || "+-.".contains(c)))
            }
            'a'..='z' | 'A'..='Z' | '_' => {
                Token::Word(self.take(|c| c.is_ascii_alphanumeric() || "_.-".contains(c)))
            }
            _ => {
                return Err(malformed(
                    FORMAT,
                    format!("`{first}` belongs to no key or value"),
                ));
            }
        }))
    }
}

/// Reads a graph.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut tokens = Tokens::new(text);
    let mut collected = Collected::new(options);
    let found = graph(&mut tokens, &mut collected);
    let at = tokens.at;
    match found {
        Ok(true) => collected.finish(),
        Ok(false) => Err(Place::Input.fault(malformed(FORMAT, "there is no graph"))),
        Err(problem) => Err(Place::Line(line_of(text.as_bytes(), at)).fault(problem)),
    }
}

/// The key of an entry of a list; none where the list ends.
fn key<'t>(tokens: &mut Tokens<'t>, within: bool) -> Result<Option<&'t str>, Problem> {
    match tokens.next()? {
        Some(Token::Word(key)) => Ok(Some(key)),
        Some(Token::Close) if within => Ok(None),
        None if !within => Ok(None),
        None => Err(Problem::Truncated("a list `[` is not closed".to_owned())),
        Some(_) => Err(malformed(FORMAT, "here should be a key")),
    }
}

/// The value of an entry; none where a list begins.
fn value<'t>(tokens: &mut Tokens<'t>, key: &str) -> Result<Option<Token<'t>>, Problem> {
    match tokens.next()? {
        Some(Token::Open) => Ok(None),
        Some(Token::Close) | None => Err(malformed(FORMAT, format!("`{key}` has no value"))),
        value => Ok(value),
    }
}

/// Goes behind a list that has begun.
fn skip(tokens: &mut Tokens) -> Result<(), Problem> {
    let mut depth = 1;
    while depth > 0 {
        match tokens.next()? {
            Some(Token::Open) if depth == DEPTH => {
                let what = format!("lists in lists are more than {DEPTH} deep");
                return Err(malformed(FORMAT, what));
            }
            Some(Token::Open) => depth += 1,
            Some(Token::Close) => depth -= 1,
            Some(_) => {}
            None => return Err(Problem::Truncated("a list `[` is not closed".to_owned())),
        }
    }
    Ok(())
}

/// Takes in all that is there; whether there was a graph.
fn graph(tokens: &mut Tokens, collected: &mut Collected) -> Result<bool, Problem> {
    let mut seen = false;
    while let Some(key) = key(tokens, false)? {
        let is_list = value(tokens, key)?.is_none();
        match (is_list, key.eq_ignore_ascii_case("graph")) {
            (true, true) if seen => {
                let what = "a second graph begins here: write each into a file of its own";
                return Err(malformed(FORMAT, what));
            }
            (true, true) => {
                members(tokens, collected)?;
                seen = true;
            }
            (true, false) => skip(tokens)?,
            (false, _) => {}
        }
    }
    Ok(seen)
}

/// Takes in the list of a graph.
fn members(tokens: &mut Tokens, collected: &mut Collected) -> Result<(), Problem> {
    while let Some(key) = key(tokens, true)? {
        match (value(tokens, key)?, key) {
            (None, "node") => node(tokens, collected)?,
            (None, "edge") => edge(tokens, collected)?,
            (None, _) => skip(tokens)?,
            (Some(Token::Number("1")), "directed") => collected.directed(),
            (Some(_), _) => {}
        }
    }
    Ok(())
}

/// An id or a name.
fn text(token: &Token) -> String {
    match token {
        Token::Text(text) => unescaped(text),
        Token::Word(text) | Token::Number(text) => (*text).to_owned(),
        Token::Open | Token::Close => String::new(),
    }
}

fn node(tokens: &mut Tokens, collected: &mut Collected) -> Result<(), Problem> {
    let mut id = None;
    let mut names = Vec::new();
    while let Some(key) = key(tokens, true)? {
        match (value(tokens, key)?, key) {
            (Some(value), "id") => once(&mut id, key, text(&value))?,
            (Some(value), "label" | "name") => names.push((key, text(&value))),
            (Some(_), _) => collected.ignore(key),
            (None, _) => {
                collected.ignore(key);
                skip(tokens)?;
            }
        }
    }
    let id = id.ok_or_else(|| malformed(FORMAT, "this node has no `id`"))?;
    let node = collected.list(&id)?;
    for (attribute, name) in names {
        collected.name(attribute, node, name);
    }
    Ok(())
}

fn edge(tokens: &mut Tokens, collected: &mut Collected) -> Result<(), Problem> {
    let (mut source, mut target) = (None, None);
    while let Some(key) = key(tokens, true)? {
        match (value(tokens, key)?, key) {
            (Some(value), "source") => once(&mut source, key, text(&value))?,
            (Some(value), "target") => once(&mut target, key, text(&value))?,
            // Gephi numbers its edges.
            (Some(_), "id") => {}
            (Some(_), _) => collected.ignore(key),
            (None, _) => {
                collected.ignore(key);
                skip(tokens)?;
            }
        }
    }
    let missing = |end: &str| malformed(FORMAT, format!("this edge has no `{end}`"));
    let source = source.ok_or_else(|| missing("source"))?;
    let target = target.ok_or_else(|| missing("target"))?;
    let (a, b) = (collected.node(&source)?, collected.node(&target)?);
    collected.pair(a, b)
}

fn once(place: &mut Option<String>, key: &str, value: String) -> Result<(), Problem> {
    match place.replace(value) {
        None => Ok(()),
        Some(_) => Err(malformed(FORMAT, format!("`{key}` is there twice"))),
    }
}

/// A text with its entities expanded: five names, and numbers of characters.
fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once('&') {
        plain += before;
        let entity = behind.split_once(';');
        match entity.and_then(|(name, rest)| Some((character(name)?, rest))) {
            Some((c, behind)) => {
                plain.push(c);
                rest = behind;
            }
            None => {
                plain.push('&');
                rest = behind;
            }
        }
    }
    plain + rest
}

fn character(entity: &str) -> Option<char> {
    let code = match entity {
        "amp" => return Some('&'),
        "lt" => return Some('<'),
        "gt" => return Some('>'),
        "quot" => return Some('"'),
        "apos" => return Some('\''),
        _ => entity.strip_prefix('#')?,
    };
    let code = match code.strip_prefix(['x', 'X']) {
        Some(digits) => u32::from_str_radix(digits, 16).ok()?,
        None => code.parse().ok()?,
    };
    char::from_u32(code)
}
