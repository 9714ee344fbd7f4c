//! DOT, the language of Graphviz ("The DOT Language", graphviz.org).
//!
//! Every edge is a pair: `a -- b -- c` are two, and `{a b} -- c` joins c with every node of the
//! subgraph, as Graphviz does it. Nodes are called by their ids. Attributes, ports and directions
//! are of no concern, and said; two subgraphs of one name in one graph are one.
//!
//! A short text can mean many pairs (`{...} -- {...}`) and be nested deeply: both have limits.

mod tokens;

use std::borrow::Cow;
use std::collections::HashMap;

use crate::documents::collected::Collected;
use crate::documents::malformed;
use crate::edge_list::layout::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;
use tokens::{Token, Tokens};

const FORMAT: &str = "DOT";
/// How deep subgraphs stand within each other.
const DEPTH_LIMIT: usize = 100;
/// How many pairs, and nodes looked at for them, subgraphs may make.
const JOINED_LIMIT: usize = 1 << 26;

/// Whether a text begins like a graph in DOT: comments, a keyword, perhaps a name, a brace.
pub(super) fn is_dot(head: &str) -> bool {
    let mut tokens = Tokens::new(head);
    let mut next = || tokens.next().ok();
    let is = |token: &Option<Token>, keyword: &str| matches!(token, Some(Token::Word(word)) if word.eq_ignore_ascii_case(keyword));
    let mut token = next();
    if is(&token, "strict") {
        token = next();
    }
    if !is(&token, "graph") && !is(&token, "digraph") {
        return false;
    }
    match next() {
        Some(Token::Sign(b'{')) => true,
        Some(Token::Word(_) | Token::Quoted(_) | Token::Html) => next() == Some(Token::Sign(b'{')),
        _ => false,
    }
}

/// Reads a graph.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut parser = Parser {
        tokens: Tokens::new(text),
        ahead: None,
        line: 1,
        directed: false,
        collected: Collected::new(options),
        scopes: vec![Scope::default()],
        joined: 0,
    };
    match parser.graph() {
        Ok(()) => parser.collected.finish(),
        Err(problem) => Err(Place::Line(parser.line).fault(problem)),
    }
}

/// The graph, or a subgraph.
#[derive(Default)]
struct Scope {
    nodes: Vec<u32>,
    children: Vec<usize>,
    named: HashMap<Box<str>, usize>,
}

/// An end of edges.
enum End {
    Node(u32),
    /// All nodes of a scope.
    Scope(usize),
}

struct Parser<'t> {
    tokens: Tokens<'t>,
    /// A token that is looked at before it is taken, and its line.
    ahead: Option<(Token<'t>, u64)>,
    /// The line of the token that was taken last.
    line: u64,
    directed: bool,
    collected: Collected,
    /// All graphs there are, the whole one first.
    scopes: Vec<Scope>,
    joined: usize,
}

/// Whether a token is a keyword, which has no case and stands in no quotes.
fn keyword(token: &Token) -> Option<&'static str> {
    let Token::Word(word) = token else {
        return None;
    };
    ["strict", "graph", "digraph", "node", "edge", "subgraph"]
        .into_iter()
        .find(|known| known.eq_ignore_ascii_case(word))
}

impl<'t> Parser<'t> {
    fn next(&mut self) -> Result<Token<'t>, Problem> {
        let (token, line) = match self.ahead.take() {
            Some(ahead) => ahead,
            None => self.read()?,
        };
        self.line = line;
        Ok(token)
    }

    fn peek(&mut self) -> Result<&Token<'t>, Problem> {
        let ahead = match self.ahead.take() {
            Some(ahead) => ahead,
            None => self.read()?,
        };
        Ok(&self.ahead.insert(ahead).0)
    }

    fn read(&mut self) -> Result<(Token<'t>, u64), Problem> {
        match self.tokens.next() {
            Ok(token) => Ok((token, self.tokens.line)),
            Err(what) => {
                self.line = self.tokens.line;
                Err(malformed(FORMAT, what))
            }
        }
    }

    /// Whether a subgraph comes next.
    fn at_subgraph(&mut self) -> Result<bool, Problem> {
        let token = self.peek()?;
        Ok(*token == Token::Sign(b'{') || keyword(token) == Some("subgraph"))
    }

    /// Takes a sign if it comes next.
    fn take(&mut self, sign: u8) -> Result<bool, Problem> {
        let is = *self.peek()? == Token::Sign(sign);
        if is {
            self.ahead = None;
        }
        Ok(is)
    }

    fn expect(&mut self, sign: u8) -> Result<(), Problem> {
        if self.take(sign)? {
            return Ok(());
        }
        let found = self.next()?;
        Err(unexpected(&found, &format!("`{}`", char::from(sign))))
    }

    /// The whole text.
    fn graph(&mut self) -> Result<(), Problem> {
        let mut token = self.next()?;
        if keyword(&token) == Some("strict") {
            token = self.next()?;
        }
        self.directed = match keyword(&token) {
            Some("graph") => false,
            Some("digraph") => true,
            _ => return Err(unexpected(&token, "`graph` or `digraph`")),
        };
        if *self.peek()? != Token::Sign(b'{') {
            self.text("the graph's name or `{`")?;
        }
        self.expect(b'{')?;
        self.statements(0, 0)?;
        match self.next()? {
            Token::End => Ok(()),
            other => Err(unexpected(&other, "the end: one graph a file is read")),
        }
    }

    /// Statements up to and with the closing brace.
    fn statements(&mut self, scope: usize, depth: usize) -> Result<(), Problem> {
        loop {
            if self.take(b'}')? {
                return Ok(());
            }
            if self.take(b';')? {
                continue;
            }
            if let Some("graph" | "node" | "edge") = keyword(self.peek()?) {
                self.ahead = None;
                if *self.peek()? != Token::Sign(b'[') {
                    let found = self.next()?;
                    return Err(unexpected(&found, "attributes behind the keyword"));
                }
                self.attributes()?;
                continue;
            }
            self.statement(scope, depth)?;
        }
    }

    /// An attribute of the graph, a node, or edges.
    fn statement(&mut self, scope: usize, depth: usize) -> Result<(), Problem> {
        let mut end = if self.at_subgraph()? {
            self.subgraph(scope, depth)?
        } else {
            let name = self.id("a node, an edge or `}`")?;
            if self.take(b'=')? {
                self.text("a value")?;
                if let Name::Text(name) = name {
                    self.collected.ignore(&name);
                }
                return Ok(());
            }
            self.node(scope, name)?
        };
        loop {
            let arrow = match self.peek()? {
                Token::Line => false,
                Token::Arrow => true,
                _ => break,
            };
            self.next()?;
            match (arrow, self.directed) {
                (false, true) => return Err(malformed(FORMAT, "`--` in a digraph")),
                (true, false) => {
                    return Err(malformed(FORMAT, "`->` in a graph that is no digraph"));
                }
                _ => {}
            }
            if self.directed {
                self.collected.directed();
            }
            let next = if self.at_subgraph()? {
                self.subgraph(scope, depth)?
            } else {
                let name = self.id("a node or a subgraph")?;
                self.node(scope, name)?
            };
            self.join(&end, &next)?;
            end = next;
        }
        self.attributes()
    }

    /// Lists of attributes, if there are any.
    fn attributes(&mut self) -> Result<(), Problem> {
        while self.take(b'[')? {
            while !self.take(b']')? {
                let name = self.text("an attribute or `]`")?;
                self.collected.ignore(&name);
                if self.take(b'=')? {
                    self.text("a value")?;
                }
                let _ = self.take(b',')? || self.take(b';')?;
            }
        }
        Ok(())
    }

    /// The node of a name, with the port that may follow.
    fn node(&mut self, scope: usize, name: Name<'t>) -> Result<End, Problem> {
        let Name::Text(name) = name else {
            let what = "names of nodes in angle brackets are not read: put them in quotes";
            return Err(malformed(FORMAT, what));
        };
        let node = self.collected.node(&name)?;
        for _ in 0..2 {
            if self.take(b':')? {
                self.text("a port")?;
                self.collected.ignore("port");
            }
        }
        self.scopes[scope].nodes.push(node);
        Ok(End::Node(node))
    }

    /// `subgraph name {...}`, or only its braces.
    fn subgraph(&mut self, parent: usize, depth: usize) -> Result<End, Problem> {
        if depth == DEPTH_LIMIT {
            let what = format!("subgraphs stand more than {DEPTH_LIMIT} deep in each other");
            return Err(malformed(FORMAT, what));
        }
        let mut name = None;
        if keyword(self.peek()?) == Some("subgraph") {
            self.ahead = None;
            if *self.peek()? != Token::Sign(b'{') {
                name = Some(self.text("the subgraph's name or `{`")?);
            }
        }
        self.expect(b'{')?;
        let known = name
            .as_deref()
            .and_then(|name| self.scopes[parent].named.get(name).copied());
        let scope = known.unwrap_or_else(|| {
            let scope = self.scopes.len();
            self.scopes.push(Scope::default());
            self.scopes[parent].children.push(scope);
            scope
        });
        if let Some(name) = name {
            self.scopes[parent].named.insert(name.into(), scope);
        }
        self.statements(scope, depth + 1)?;
        Ok(End::Scope(scope))
    }

    /// A name of any kind, its text or that it is HTML.
    fn id(&mut self, expected: &str) -> Result<Name<'t>, Problem> {
        let token = self.next()?;
        if let Some(word) = keyword(&token) {
            let what = format!("the keyword `{word}` does not belong here: put names in quotes");
            return Err(malformed(FORMAT, what));
        }
        match token {
            Token::Word(word) => Ok(Name::Text(word.into())),
            Token::Quoted(text) => Ok(Name::Text(text)),
            Token::Html => Ok(Name::Html),
            other => Err(unexpected(&other, expected)),
        }
    }

    /// A name whose kind is of no concern.
    fn text(&mut self, expected: &str) -> Result<String, Problem> {
        Ok(match self.id(expected)? {
            Name::Text(text) => text.into_owned(),
            Name::Html => "<...>".to_owned(),
        })
    }

    /// Makes pairs of the nodes of one end with those of another.
    fn join(&mut self, a: &End, b: &End) -> Result<(), Problem> {
        let (a, b) = (self.nodes_of(a)?, self.nodes_of(b)?);
        if a.len().max(b.len()) > 1 {
            let pairs = a.len().saturating_mul(b.len());
            self.joined = self.joined.saturating_add(pairs);
            if self.joined > JOINED_LIMIT {
                return Err(too_many_joined());
            }
        }
        for &a in &a {
            for &b in &b {
                self.collected.pair(a, b)?;
            }
        }
        Ok(())
    }

    /// The nodes of an end, each once.
    fn nodes_of(&mut self, end: &End) -> Result<Vec<u32>, Problem> {
        let scope = match end {
            End::Node(node) => return Ok(vec![*node]),
            End::Scope(scope) => *scope,
        };
        let (mut nodes, mut open) = (Vec::new(), vec![scope]);
        while let Some(scope) = open.pop() {
            let scope = &self.scopes[scope];
            nodes.extend(&scope.nodes);
            open.extend(&scope.children);
            self.joined += 1 + scope.nodes.len();
            if self.joined > JOINED_LIMIT {
                return Err(too_many_joined());
            }
        }
        nodes.sort_unstable();
        nodes.dedup();
        Ok(nodes)
    }
}

/// A name in DOT.
enum Name<'t> {
    Text(Cow<'t, str>),
    Html,
}

fn too_many_joined() -> Problem {
    let limit = JOINED_LIMIT;
    Problem::TooManyJoined { limit }
}

fn unexpected(token: &Token, expected: &str) -> Problem {
    let found = match token {
        Token::Word(word) => format!("`{}`", word.chars().take(40).collect::<String>()),
        Token::Quoted(_) => "a text in quotes".to_owned(),
        Token::Html => "a text in angle brackets".to_owned(),
        Token::Sign(sign) => format!("`{}`", char::from(*sign)),
        Token::Line => "`--`".to_owned(),
        Token::Arrow => "`->`".to_owned(),
        Token::End => {
            let what = format!("the text ends, and {expected} is missing");
            return Problem::Truncated(what);
        }
    };
    malformed(FORMAT, format!("{found} stands here, and not {expected}"))
}
