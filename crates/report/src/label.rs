//! The name of a small graph and what is counted of it, for people and for programs.

use super::head;
use super::json::{GraphLine, write_line};
use crate::shown::row;
use serde_json::json;
use std::io::{self, Write};
use viewcert::graph::graph6;
use viewcert_catalog::invariants::Invariants;
use viewcert_catalog::label::{Label, greatest};
use viewcert_formats::NamedGraph;

/// A graph with its label.
pub struct LabelReport<'a> {
    input: &'a NamedGraph,
    label: Label,
    graph6: String,
    invariants: Invariants,
}

impl<'a> LabelReport<'a> {
    /// The report; `None` if the graph has too many nodes for a label.
    pub fn new(input: &'a NamedGraph) -> Option<Self> {
        Some(Self {
            input,
            label: Label::of(&input.graph)?,
            graph6: graph6::encode(&greatest(&input.graph)?),
            invariants: Invariants::new(&input.graph)?,
        })
    }

    /// Writes some lines for people.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let (input, found) = (self.input, &self.invariants);
        head(out, input)?;
        let degrees: Vec<String> = found.degrees.iter().map(usize::to_string).collect();
        let girth = found.girth.map(|girth| girth.to_string());
        let girth = girth.unwrap_or_else(|| "no cycle".to_owned());
        row(out, "label", self.label)?;
        row(out, "graph6", &self.graph6)?;
        row(out, "degrees", degrees.join(","))?;
        row(out, "girth", girth)?;
        writeln!(out, "  symmetry    automorphisms: {}", found.group_order)?;
        row(out, "triangles", found.triangles)
    }

    /// Writes one JSON object.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn json(&self, out: &mut impl Write) -> io::Result<()> {
        let (input, found) = (self.input, &self.invariants);
        let line = json!({
            "graph": GraphLine::of(input),
            "read": input.read,
            "notes": input.notes,
            "label": self.label.to_string(),
            "graph6": self.graph6,
            "degrees": found.degrees,
            "girth": found.girth,
            "automorphisms": found.group_order,
            "triangles": found.triangles,
        });
        write_line(out, "label", None, &line)
    }
}
