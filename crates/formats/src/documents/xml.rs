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

/// Reads a graph.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut reader = Reader::from_str(text);
    reader.config_mut().expand_empty_elements = true;
    let mut tree = Tree {
        collected: Collected::new(options),
        ..Tree::default()
    };
    loop {
        let event = reader.read_event();
        let at = match &event {
            Ok(_) => reader.buffer_position(),
            Err(_) => reader.error_position(),
        };
        let place = || Place::Line(line_of(text.as_bytes(), at as usize));
        let wrong = |error: quick_xml::Error| malformed(GRAPHML, error.to_string());
        match event.map_err(|error| place().fault(wrong(error)))? {
            Event::Eof => break,
            event => tree.take(event, text).map_err(|why| place().fault(why))?,
        }
    }
    if !tree.path.is_empty() {
        return Err(Problem::truncated("an element is not closed").into());
    }
    if !tree.has_graph {
        return Err(malformed(GRAPHML, "there is no graph").into());
    }
    tree.collected.finish()
}

/// What has been read, and where.
#[derive(Default)]
struct Tree {
    /// The names of the elements that are open.
    path: Vec<String>,
    collected: Collected,
    /// Keys of data that name nodes, and the places of their attributes in [`NAMES`].
    keys: HashMap<String, usize>,
    /// The node that is open.
    node: Option<u32>,
    /// Within an element that names it, by which attribute, and what has been read of the name.
    name: Option<(usize, String)>,
    has_graph: bool,
    directed: bool,
}

impl Tree {
    fn take(&mut self, event: Event, text: &str) -> Result<(), Problem> {
        match (event, &mut self.name) {
            (Event::Decl(declaration), _) => {
                let encoding = declaration.encoding().and_then(Result::ok);
                let ascii = ["utf-8", "utf8", "us-ascii", "ascii"];
                let is_known = |name: &str| ascii.iter().any(|it| it.eq_ignore_ascii_case(name));
                if !encoding.as_deref().is_none_or(is_known) && !text.is_ascii() {
                    return Err(Problem::not_utf8());
                }
            }
            (Event::Start(start), _) => {
                self.open(&start)?;
                self.path.push(start.local_name().as_ref().to_owned());
            }
            (Event::End(_), name) => {
                if let (Some((at, name)), Some(node)) = (name.take(), self.node) {
                    self.collected.name(at, node, name.trim());
                }
                self.path.pop();
            }
            (Event::Text(part), Some((_, name))) => {
                *name += &part.xml_content(XmlVersion::Implicit1_0);
            }
            (Event::CData(part), Some((_, name))) => {
                *name += &part.xml_content(XmlVersion::Implicit1_0);
            }
            (Event::GeneralRef(entity), Some((_, name))) => {
                let given = || entity.resolve_char_ref().ok().flatten().map(String::from);
                let known = resolve_xml_entity(&entity).map(str::to_owned);
                let unknown =
                    || malformed(GRAPHML, format!("the entity `{}` is not known", &*entity));
                *name += &known.or_else(given).ok_or_else(unknown)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Takes in an element that begins here.
    fn open(&mut self, start: &BytesStart) -> Result<(), Problem> {
        let refused = |what| Err(malformed(GRAPHML, what));
        let path: Vec<&str> = self.path.iter().map(String::as_str).collect();
        match (&path[..], start.local_name().as_ref()) {
            ([], "graphml") if !self.has_graph => {}
            ([], _) => return refused("the root is not one `graphml`"),
            ([_], "key") => self.key(start)?,
            ([_], "graph") if self.has_graph => {
                return refused("a second graph begins here: write each into a file of its own");
            }
            ([_], "graph") => {
                self.has_graph = true;
                self.directed = attribute(start, "edgedefault")?.as_deref() == Some("directed");
            }
            ([_, "graph"], "node") => {
                self.node = Some(self.collected.list(&required(start, "id")?)?);
            }
            ([_, "graph"], "edge") => {
                self.node = None;
                let ends = [required(start, "source")?, required(start, "target")?];
                if attribute(start, "directed")?.map_or(self.directed, |word| word == "true") {
                    self.collected.directed();
                }
                let (a, b) = (
                    self.collected.node(&ends[0])?,
                    self.collected.node(&ends[1])?,
                );
                self.collected.pair(a, b)?;
            }
            ([_, "graph"], "hyperedge") => {
                return refused("edges of more than two ends are not read");
            }
            ([_, "graph", _], "graph") => return refused("graphs within nodes are not read"),
            ([_, "graph", _], "data") => {
                let key = attribute(start, "key")?.unwrap_or_else(|| "data".to_owned());
                match self.keys.get(&key).filter(|_| self.node.is_some()) {
                    Some(&at) => self.name = Some((at, String::new())),
                    None => self.collected.ignore(&key),
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Takes in a declaration of data, if they name nodes.
    fn key(&mut self, start: &BytesStart) -> Result<(), Problem> {
        let of = attribute(start, "for")?;
        let name = attribute(start, "attr.name")?;
        let at = NAMES
            .iter()
            .position(|known| name.as_deref() == Some(known));
        let of_nodes = matches!(of.as_deref(), None | Some("node" | "all"));
        if let (Some(id), Some(at), true) = (attribute(start, "id")?, at, of_nodes) {
            self.keys.insert(id, at);
        }
        Ok(())
    }
}

/// The value of an attribute, entities expanded.
fn attribute(start: &BytesStart, name: &str) -> Result<Option<String>, Problem> {
    let wrong = |error: &dyn std::fmt::Display| malformed("XML", error.to_string());
    for attribute in start.attributes() {
        let attribute = attribute.map_err(|error| wrong(&error))?;
        if attribute.key.as_ref() == name {
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            return Ok(Some(value.map_err(|error| wrong(&error))?.into_owned()));
        }
    }
    Ok(None)
}

fn required(start: &BytesStart, name: &str) -> Result<String, Problem> {
    let missing = || {
        let element = start.local_name();
        malformed(
            GRAPHML,
            format!("this `{}` has no `{name}`", element.as_ref()),
        )
    };
    attribute(start, name)?.ok_or_else(missing)
}
