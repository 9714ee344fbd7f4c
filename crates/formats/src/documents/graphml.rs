//! GraphML: a graph in XML ("GraphML Primer", graphdrawing.org).
//!
//! Nodes are called by their ids. What data say of nodes and edges, ports, and directions are of no
//! concern; graphs within nodes, edges of more than two ends, and a second graph are refused.
//! Entities other than XML's own five are not expanded, so a small file stays small.

use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use crate::documents::collected::Collected;
use crate::documents::{line_of, malformed};
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;

const FORMAT: &str = "GraphML";

/// Whether a text begins like GraphML.
pub(super) fn is_graphml(head: &str) -> bool {
    head.trim_start().starts_with('<')
        && head.match_indices("graphml").any(|(at, word)| {
            // Behind `<`, or behind a prefix like `g:`.
            let before = head[..at].rfind(['<', ' ', '\n', '>']);
            before.is_some_and(|start| head[start..].starts_with('<'))
                && head[at + word.len()..].starts_with(|c: char| c.is_whitespace() || c == '>')
        })
}

/// An element that is open.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Element {
    Root,
    Graph,
    /// A node or an edge.
    Member,
    /// One whose content is of no concern.
    Other,
}

/// Reads a graph.
pub(super) fn read(text: &str) -> Result<Parsed, Fault> {
    let mut reader = Reader::from_str(text);
    let mut tree = Tree::default();
    loop {
        let event = reader.read_event();
        let at = reader.buffer_position() as usize;
        let fault = |problem| Place::Line(line_of(text.as_bytes(), at)).fault(problem);
        match event {
            Err(error) => {
                let at = reader.error_position() as usize;
                let place = Place::Line(line_of(text.as_bytes(), at));
                return Err(place.fault(malformed(FORMAT, error.to_string())));
            }
            Ok(Event::Decl(declaration)) => {
                let encoding = declaration.encoding().and_then(Result::ok);
                let ascii = ["utf-8", "utf8", "us-ascii", "ascii"];
                let known = encoding
                    .as_deref()
                    .is_none_or(|name| ascii.iter().any(|known| known.eq_ignore_ascii_case(name)));
                if !known && !text.is_ascii() {
                    return Err(fault(Problem::NotUtf8));
                }
            }
            Ok(Event::Start(start)) => {
                let element = tree.open(&start).map_err(fault)?;
                tree.path.push(element);
            }
            Ok(Event::Empty(start)) => {
                tree.open(&start).map_err(fault)?;
            }
            Ok(Event::End(_)) => {
                tree.path.pop();
            }
            Ok(Event::Eof) => break,
            Ok(_) => {}
        }
    }
    if !tree.path.is_empty() {
        let what = "an element is not closed".to_owned();
        return Err(Place::Input.fault(Problem::Truncated(what)));
    }
    if !tree.has_graph {
        return Err(Place::Input.fault(malformed(FORMAT, "there is no graph")));
    }
    tree.collected.finish()
}

/// What has been read, and where.
#[derive(Default)]
struct Tree {
    path: Vec<Element>,
    collected: Collected,
    has_root: bool,
    has_graph: bool,
    directed: bool,
}

impl Tree {
    /// Takes in an element that begins here.
    fn open(&mut self, start: &BytesStart) -> Result<Element, Problem> {
        let name = start.local_name();
        let element = match (self.path.last(), name.as_ref()) {
            (None, "graphml") if !self.has_root => {
                self.has_root = true;
                Element::Root
            }
            (None, _) => return Err(malformed(FORMAT, "the root is not one `graphml`")),
            (Some(Element::Root), "graph") if self.has_graph => {
                let what = "a second graph begins here: write each into a file of its own";
                return Err(malformed(FORMAT, what));
            }
            (Some(Element::Root), "graph") => {
                self.has_graph = true;
                self.directed = attribute(start, "edgedefault")?.as_deref() == Some("directed");
                Element::Graph
            }
            (Some(Element::Graph), "node") => {
                let id = required(start, "id")?;
                self.collected.list(&id)?;
                Element::Member
            }
            (Some(Element::Graph), "edge") => {
                self.edge(start)?;
                Element::Member
            }
            (Some(Element::Graph), "hyperedge") => {
                return Err(malformed(
                    FORMAT,
                    "edges of more than two ends are not read",
                ));
            }
            (Some(Element::Member), "graph") => {
                return Err(malformed(FORMAT, "graphs within nodes are not read"));
            }
            (Some(Element::Member), "data") => {
                let key = attribute(start, "key")?;
                self.collected.ignore(key.as_deref().unwrap_or("data"));
                Element::Other
            }
            (Some(Element::Member), "port") => {
                self.collected.ignore("port");
                Element::Other
            }
            _ => Element::Other,
        };
        Ok(element)
    }

    fn edge(&mut self, start: &BytesStart) -> Result<(), Problem> {
        let (source, target) = (required(start, "source")?, required(start, "target")?);
        let directed = match attribute(start, "directed")? {
            Some(word) => word == "true",
            None => self.directed,
        };
        if directed {
            self.collected.directed();
        }
        for port in ["sourceport", "targetport"] {
            if attribute(start, port)?.is_some() {
                self.collected.ignore(port);
            }
        }
        let (a, b) = (self.collected.node(&source)?, self.collected.node(&target)?);
        self.collected.pair(a, b)
    }
}

/// The value of an attribute, entities expanded.
fn attribute(start: &BytesStart, name: &str) -> Result<Option<String>, Problem> {
    let wrong = |error: &dyn std::fmt::Display| malformed(FORMAT, error.to_string());
    for attribute in start.attributes() {
        let attribute = attribute.map_err(|error| wrong(&error))?;
        if attribute.key.as_ref() == name {
            let value = attribute
                .normalized_value(XmlVersion::Implicit1_0)
                .map_err(|error| wrong(&error))?;
            return Ok(Some(value.into_owned()));
        }
    }
    Ok(None)
}

fn required(start: &BytesStart, name: &str) -> Result<String, Problem> {
    let missing = || {
        let element = start.local_name();
        let what = format!("this `{}` has no `{name}`", element.as_ref());
        malformed(FORMAT, what)
    };
    attribute(start, name)?.ok_or_else(missing)
}
