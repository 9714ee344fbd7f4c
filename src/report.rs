//! Reports: text for people, JSON for programs, tables and pictures.

pub mod bars;
pub mod catalog_page;
pub mod comparison;
pub mod conditions;
pub mod curves;
pub mod json;
pub mod layout;
pub mod plot;
pub mod svg;
pub mod table;
pub mod text;

use crate::graph::NamedGraph;
use crate::verdict::Verdict;
use std::time::Duration;

/// Everything a report says about one graph.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// The graph as it was read.
    pub input: &'a NamedGraph,
    /// What was decided.
    pub verdict: &'a Verdict,
    /// Whether the arithmetic was rational.
    pub rational: bool,
    /// Whether to list the members of the components.
    pub list_components: bool,
    /// How long reading, deciding and certifying took.
    pub time: Duration,
}
