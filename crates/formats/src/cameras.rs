//! The nodes of a graph by what the user calls them.

use std::collections::HashMap;

use crate::NamedGraph;
use crate::edge_list::fields::integer;
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
}
