//! GraphML ("GraphML Primer", graphdrawing.org).
//!
//! Nodes are called by their `label` or `name` if these name them, and else by their ids. What else
//! is said of nodes and edges, ports, and directions are of no concern; graphs within nodes, edges of
//! more than two ends, and a second graph are refused. Entities other than XML's own five are not
//! expanded, so a small file stays small.

use std::collections::HashMap;

use quick_xml::XmlVersion;
use quick_xml::escape::resolve_xml_entity;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use crate::documents::collected::{Collected, NAMES};
use crate::documents::{line_of, malformed};
use crate::edge_list::columns::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;

/// The format in messages.
const GRAPHML: &str = "GraphML";

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
    /// A graph.
    Graph,
    /// A node or an edge.
    Member,
    /// What a node is called: by the attribute of this place in [`NAMES`].
    Name(usize),
    /// One whose content is of no concern.
    Other,
}

/// Reads a graph.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut reader = Reader::from_str(text);
    let mut tree = Tree {
        collected: Collected::new(options),
        ..Tree::default()
    };
    loop {
        let event = reader.read_event();
        let at = reader.buffer_position() as usize;
        let fault = |problem| Place::Line(line_of(text.as_bytes(), at)).fault(problem);
        match event {
            Err(error) => {
                let at = reader.error_position() as usize;
                let place = Place::Line(line_of(text.as_bytes(), at));
                return Err(place.fault(malformed(GRAPHML, error.to_string())));
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
            Ok(Event::End(_)) => tree.close(),
            Ok(Event::Text(part)) => tree.text(&part.xml_content(XmlVersion::Implicit1_0)),
            Ok(Event::CData(part)) => tree.text(&part.xml_content(XmlVersion::Implicit1_0)),
            Ok(Event::GeneralRef(entity)) if tree.is_within_name() => {
                let named = resolve_xml_entity(&entity).map(str::to_owned);
                let given = entity.resolve_char_ref().ok().flatten().map(String::from);
                let what = || malformed(GRAPHML, format!("the entity `{}` is not known", &*entity));
                let character = named.or(given).ok_or_else(what).map_err(fault)?;
                tree.text(&character);
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
        return Err(Place::Input.fault(malformed(GRAPHML, "there is no graph")));
    }
    tree.collected.finish()
}

/// What has been read, and where.
#[derive(Default)]
struct Tree {
    path: Vec<Element>,
    collected: Collected,
    /// Keys of data that name nodes, and the places of their attributes in [`NAMES`].
    keys: HashMap<String, usize>,
    /// The node that is open, and what has been read of its name.
    node: Option<u32>,
    name: String,
    has_root: bool,
    has_graph: bool,
    directed: bool,
}

impl Tree {
    /// Takes in an element that begins here.
    fn open(&mut self, start: &BytesStart) -> Result<Element, Problem> {
        let name = start.local_name();
        let malformed = |what: &str| malformed(GRAPHML, what);
        let element = match (self.path.last(), name.as_ref()) {
            (None, "graphml") if !self.has_root => {
                self.has_root = true;
                Element::Root
            }
            (None, _) => return Err(malformed("the root is not one `graphml`")),
            (Some(Element::Root), "key") => {
                self.key(start)?;
                Element::Other
            }
            (Some(Element::Root), "graph") if self.has_graph => {
                let what = "a second graph begins here: write each into a file of its own";
                return Err(malformed(what));
            }
            (Some(Element::Root), "graph") => {
                self.has_graph = true;
                self.directed = attribute(start, "edgedefault")?.as_deref() == Some("directed");
                Element::Graph
            }
            (Some(Element::Graph), "node") => {
                let id = required(start, "id")?;
                self.node = Some(self.collected.list(&id)?);
                Element::Member
            }
            (Some(Element::Graph), "edge") => {
                self.node = None;
                self.edge(start)?;
                Element::Member
            }
            (Some(Element::Graph), "hyperedge") => {
                return Err(malformed("edges of more than two ends are not read"));
            }
            (Some(Element::Member), "graph") => {
                return Err(malformed("graphs within nodes are not read"));
            }
            (Some(Element::Member), "data") => self.data(start)?,
            (Some(Element::Member), "port") => {
                self.collected.ignore(name.as_ref());
                Element::Other
            }
            _ => Element::Other,
        };
        Ok(element)
    }

    /// Takes in a declaration of data, if they name nodes.
    fn key(&mut self, start: &BytesStart) -> Result<(), Problem> {
        let of_nodes = matches!(
            attribute(start, "for")?.as_deref(),
            None | Some("node" | "all")
        );
        let name = attribute(start, "attr.name")?;
        let at = NAMES
            .iter()
            .position(|known| name.as_deref() == Some(known));
        if let (Some(id), Some(at), true) = (attribute(start, "id")?, at, of_nodes) {
            self.keys.insert(id, at);
        }
        Ok(())
    }

    /// Takes in data, of a node or an edge.
    fn data(&mut self, start: &BytesStart) -> Result<Element, Problem> {
        let key = attribute(start, "key")?.unwrap_or_else(|| "data".to_owned());
        match self.keys.get(&key) {
            Some(&at) if self.node.is_some() => {
                self.name.clear();
                Ok(Element::Name(at))
            }
            _ => {
                self.collected.ignore(&key);
                Ok(Element::Other)
            }
        }
    }

    fn is_within_name(&self) -> bool {
        matches!(self.path.last(), Some(Element::Name(_)))
    }

    /// A part of the text within an element.
    fn text(&mut self, part: &str) {
        if self.is_within_name() {
            self.name += part;
        }
    }

    /// The element that is open ends.
    fn close(&mut self) {
        if let (Some(Element::Name(at)), Some(node)) = (self.path.pop(), self.node) {
            let name = self.name.trim().to_owned();
            self.collected.name(NAMES[at], node, name);
        }
    }

    fn edge(&mut self, start: &BytesStart) -> Result<(), Problem> {
        let source = required(start, "source")?;
        let target = required(start, "target")?;
        let directed = match attribute(start, "directed")? {
            Some(word) => word == "true",
            None => self.directed,
        };
        if directed {
            self.collected.directed();
        }
        for ignored in ["sourceport", "targetport"] {
            if attribute(start, ignored)?.is_some() {
                self.collected.ignore(ignored);
            }
        }
        let (a, b) = (self.collected.node(&source)?, self.collected.node(&target)?);
        self.collected.pair(a, b)
    }
}

/// The value of an attribute, entities expanded.
fn attribute(start: &BytesStart, name: &str) -> Result<Option<String>, Problem> {
    let wrong = |error: &dyn std::fmt::Display| malformed("XML", error.to_string());
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
        malformed(GRAPHML, what)
    };
    attribute(start, name)?.ok_or_else(missing)
}
