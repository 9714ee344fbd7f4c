//! Files beside a graph, which name its cameras: what is common to them.
//!
//! In: a text, and the graph. Out: its lines, and the nodes by what the user calls them. Fields,
//! quotes and comments are those of edge lists (docs/input.md).

use std::collections::HashMap;
use std::io::Read;

use crate::NamedGraph;
use crate::colmap;
use crate::edge_list::fields::{Field, integer};
use crate::edge_list::refusal::shown;
use crate::edge_list::{BYTE_ORDER_MARK, text};
use crate::error::{Fault, Place, Problem};
use crate::own_files;
use crate::recognise::SAMPLE;
use viewcert::graph::Labels;

/// The nodes of a graph by their labels.
pub(crate) struct Cameras<'a> {
    labels: &'a Labels,
    nodes: usize,
    named: HashMap<&'a str, u32>,
}

impl<'a> Cameras<'a> {
    /// O(n).
    pub(crate) fn new(graph: &'a NamedGraph) -> Self {
        let named = match &graph.labels {
            Labels::Names(names) | Labels::CamerasAndPoints(names) => {
                names.iter().map(|name| &**name).zip(0..).collect()
            }
            Labels::Numbers { .. } | Labels::Integers(_) => HashMap::new(),
        };
        Self {
            labels: &graph.labels,
            nodes: graph.graph.nodes(),
            named,
        }
    }

    /// The node that is called so.
    pub(crate) fn node(&self, label: &str) -> Option<u32> {
        let place = match self.labels {
            Labels::Numbers { first } => integer(label)?.checked_sub(*first)?,
            Labels::Integers(values) => values.binary_search(&integer(label)?).ok()? as u64,
            Labels::Names(_) | Labels::CamerasAndPoints(_) => {
                return self.named.get(label).copied();
            }
        };
        let node = u32::try_from(place).ok()?;
        ((node as usize) < self.nodes).then_some(node)
    }

    /// The node that a field of a line names.
    pub(crate) fn named(&self, field: Field, line: &str) -> Result<u32, Problem> {
        let label = field.text(line);
        let node = self.node(&label);
        node.ok_or_else(|| {
            Problem::new(
                format!("`{}` is no camera of the graph", shown(&label)),
                "call cameras what the graph calls them; one without pairs stands alone on a line of an edge list \
                 (--format edges)",
            )
        })
    }
}

/// Goes through the lines of a text, from line 1 on, with the cameras of a graph.
pub(crate) fn for_each_line(
    mut input: impl Read,
    graph: &NamedGraph,
    mut each: impl FnMut(u64, &str, &Cameras) -> Result<(), Problem>,
) -> Result<(), Fault> {
    let mut bytes = Vec::new();
    let read = input.read_to_end(&mut bytes);
    read.map_err(Problem::from)?;
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(&bytes);
    if let Some(problem) = own_files::known(&bytes[..bytes.len().min(SAMPLE)]) {
        return Err(problem.into());
    }
    if bytes.starts_with(colmap::MAGIC) {
        return Err(colmap::error::no_file().into());
    }
    let cameras = Cameras::new(graph);
    for (number, line) in (1..).zip(bytes.split(|&byte| byte == b'\n')) {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let taken = text(line).and_then(|line| each(number, line, &cameras));
        taken.map_err(|problem| Place::Line(number).fault(problem))?;
    }
    Ok(())
}
