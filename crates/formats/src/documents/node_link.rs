//! Node-link JSON: an object with a list `nodes` and a list `edges` (before networkx 3.4: `links`),
//! as `networkx.node_link_data` and d3 write it.
//!
//! A node has an `id`, an edge a `source` and a `target`, which are ids: integers or strings. All
//! else is of no concern. Old files (networkx 1) have the positions of nodes in place of their ids;
//! that is understood where it cannot be misunderstood: ids are strings, and ends integers.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashSet};
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use crate::documents::collected::Collected;
use crate::documents::malformed;
use crate::edge_list::layout::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;

const FORMAT: &str = "node-link JSON";

/// Whether a text begins like an object in JSON.
pub(super) fn is_object(head: &str) -> bool {
    head.trim_start()
        .strip_prefix('{')
        .is_some_and(|rest| rest.trim_start().starts_with(['"', '}']))
}

/// The name of a node.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Id {
    Integer(i128),
    Text(Box<str>),
}

impl Id {
    fn label(&self) -> String {
        match self {
            Self::Integer(value) => value.to_string(),
            Self::Text(text) => text.to_string(),
        }
    }
}

/// What a file says.
#[derive(Default)]
struct Document {
    nodes: Option<Vec<[Id; 1]>>,
    edges: Option<Vec<[Id; 2]>>,
    links: Option<Vec<[Id; 2]>>,
    directed: bool,
    /// Names of other members of the object.
    others: Vec<String>,
}

/// JSON of something else.
const NO_GRAPH: Problem = Problem::Foreign {
    what: "JSON without a graph (there is no list `nodes`)",
    advice: "write one pair a line: the names of two cameras and nothing else",
};

/// Reads a graph.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let ignored = RefCell::new(BTreeSet::new());
    let mut json = serde_json::Deserializer::from_str(text);
    let document = json
        .deserialize_map(Members { ignored: &ignored })
        .and_then(|document| json.end().map(|()| document))
        .map_err(of_json)?;
    let mut collected = Collected::new(options);
    for name in ignored.into_inner() {
        collected.ignore(&name);
    }
    document.into_graph(collected)
}

/// An error of the parser, with its line.
fn of_json(error: serde_json::Error) -> Fault {
    let text = error.to_string();
    let what = text
        .rsplit_once(" at line ")
        .map_or(&*text, |(what, _)| what);
    Place::Line(error.line().max(1) as u64).fault(malformed(FORMAT, what))
}

impl Document {
    fn into_graph(self, mut collected: Collected) -> Result<Parsed, Fault> {
        let fault = |what: String| Place::Input.fault(malformed(FORMAT, what));
        let has = |name: &str| self.others.iter().any(|other| other == name);
        let Some(nodes) = &self.nodes else {
            return Err(fault(
                match () {
                    () if has("elements") => "this is Cytoscape's, with `elements`",
                    () if has("graph") => "no list `nodes` (a JSON graph with all in `graph`?)",
                    () => return Err(Place::Input.fault(NO_GRAPH)),
                }
                .to_owned(),
            ));
        };
        let edges = match (&self.edges, &self.links) {
            (Some(edges), None) | (None, Some(edges)) => edges,
            (Some(_), Some(_)) => return Err(fault("both `edges` and `links` are there".into())),
            (None, None) if has("adjacency") => {
                let what = "this is adjacency data, with `adjacency` (networkx.node_link_data writes what is \
                            read)";
                return Err(fault(what.into()));
            }
            (None, None) => return Err(fault("there is no list `edges` or `links`".into())),
        };
        check_kinds(nodes).map_err(fault)?;
        if self.directed {
            collected.directed();
        }
        let mut places = Vec::with_capacity(nodes.len());
        for ([id], number) in nodes.iter().zip(1..) {
            let node = collected.list(&id.label());
            places.push(node.map_err(|problem| Place::Node(number).fault(problem))?);
        }
        let is_integer = |id: &Id| matches!(id, Id::Integer(_));
        let positions = !edges.is_empty()
            && nodes.iter().all(|[id]| !is_integer(id))
            && edges.iter().flatten().all(is_integer);
        if positions {
            let note = "ends of edges are positions in the list of nodes (as networkx 1 writes)";
            collected.notes.push(note.to_owned());
        }
        let known: HashSet<&Id> = nodes.iter().map(|[id]| id).collect();
        for (ends, number) in edges.iter().zip(1..) {
            let fault = |problem| Place::Edge(number).fault(problem);
            let mut pair = [0; 2];
            for (end, id) in pair.iter_mut().zip(ends) {
                let found = match id {
                    Id::Integer(at) if positions => usize::try_from(*at)
                        .ok()
                        .and_then(|at| places.get(at).copied()),
                    id if known.contains(id) => collected.find(&id.label()),
                    _ => None,
                };
                *end = found.ok_or_else(|| {
                    let what = match id {
                        Id::Integer(value) => format!("{value} is the id of no node"),
                        Id::Text(text) => format!("{text:?} is the id of no node"),
                    };
                    fault(malformed(FORMAT, what))
                })?;
            }
            collected.pair(pair[0], pair[1]).map_err(fault)?;
        }
        collected.finish()
    }
}

/// That no integer and no string are written alike: they are different nodes.
fn check_kinds(nodes: &[[Id; 1]]) -> Result<(), String> {
    let integers: HashSet<String> = nodes
        .iter()
        .filter(|[id]| matches!(id, Id::Integer(_)))
        .map(|[id]| id.label())
        .collect();
    for [id] in nodes {
        if let Id::Text(text) = id
            && integers.contains(&**text)
        {
            return Err(format!("{text} and {text:?} are ids of different nodes"));
        }
    }
    Ok(())
}

/// Names of ignored attributes, kept while lists are read.
type Ignored = RefCell<BTreeSet<String>>;

/// Reads the object.
struct Members<'i> {
    ignored: &'i Ignored,
}

impl<'de> Visitor<'de> for Members<'_> {
    type Value = Document;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object with lists of nodes and edges")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Document, A::Error> {
        let mut document = Document::default();
        let mut seen = HashSet::new();
        while let Some(name) = map.next_key::<String>()? {
            if !seen.insert(name.clone()) {
                return Err(A::Error::custom(format!("`{name}` is there twice")));
            }
            let ends = List {
                members: ["source", "target"],
                ignored: self.ignored,
            };
            match &*name {
                "nodes" => {
                    let members = ["id"];
                    let ignored = self.ignored;
                    document.nodes = Some(map.next_value_seed(List { members, ignored })?);
                }
                "edges" => document.edges = Some(map.next_value_seed(ends)?),
                "links" => document.links = Some(map.next_value_seed(ends)?),
                "directed" => document.directed = map.next_value()?,
                _ => {
                    map.next_value::<IgnoredAny>()?;
                    document.others.push(name);
                }
            }
        }
        Ok(document)
    }
}

/// Reads a list of objects, each with these members.
struct List<'i, const N: usize> {
    members: [&'static str; N],
    ignored: &'i Ignored,
}

impl<'de, const N: usize> DeserializeSeed<'de> for List<'_, N> {
    type Value = Vec<[Id; N]>;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Self::Value, D::Error> {
        json.deserialize_seq(self)
    }
}

impl<'de, const N: usize> Visitor<'de> for List<'_, N> {
    type Value = Vec<[Id; N]>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of objects")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut all = Vec::new();
        while let Some(one) = list.next_element_seed(Object { list: &self })? {
            all.push(one);
        }
        Ok(all)
    }
}

/// Reads one object of a list.
struct Object<'l, 'i, const N: usize> {
    list: &'l List<'i, N>,
}

impl<'de, const N: usize> DeserializeSeed<'de> for Object<'_, '_, N> {
    type Value = [Id; N];

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Self::Value, D::Error> {
        json.deserialize_map(self)
    }
}

impl<'de, const N: usize> Visitor<'de> for Object<'_, '_, N> {
    type Value = [Id; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an object with {}", self.list.members.join(" and "))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut found = [const { None }; N];
        while let Some(name) = map.next_key::<String>()? {
            let Some(at) = self.list.members.iter().position(|member| *member == name) else {
                map.next_value::<IgnoredAny>()?;
                let mut ignored = self.list.ignored.borrow_mut();
                if !ignored.contains(&name) {
                    ignored.insert(name);
                }
                continue;
            };
            if found[at].replace(map.next_value_seed(IdSeed)?).is_some() {
                return Err(A::Error::custom(format!("`{name}` is there twice")));
            }
        }
        let missing = found.iter().position(Option::is_none);
        if let Some(at) = missing {
            let member = self.list.members[at];
            return Err(A::Error::custom(format!("there is no `{member}`")));
        }
        // All of them are there.
        Ok(found.map(|id| id.unwrap_or(Id::Integer(0))))
    }
}

/// Reads an id.
struct IdSeed;

impl<'de> DeserializeSeed<'de> for IdSeed {
    type Value = Id;

    fn deserialize<D: Deserializer<'de>>(self, json: D) -> Result<Id, D::Error> {
        json.deserialize_any(self)
    }
}

impl Visitor<'_> for IdSeed {
    type Value = Id;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an id, which is a string or an integer")
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Id, E> {
        Ok(Id::Integer(value.into()))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Id, E> {
        Ok(Id::Integer(value.into()))
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Id, E> {
        Ok(Id::Text(value.into()))
    }
}
