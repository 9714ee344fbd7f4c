//! The name of a small graph and what is counted of it, for people and for programs.

use super::json::{GraphLine, write_line};
use super::read::ReadLine;
use super::size_of;
use serde::Serialize;
use std::io::{self, Write};
use viewcert::graph::graph6;
use viewcert::wording::printable;
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

#[derive(Serialize)]
struct Line<'a> {
    graph: GraphLine<'a>,
    read: ReadLine<'a>,
    notes: &'a [String],
    label: String,
    graph6: &'a str,
    degrees: &'a [usize],
    girth: Option<usize>,
    automorphisms: u64,
    triangles: usize,
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
        writeln!(out, "{}", printable(&input.name))?;
        writeln!(out, "  read as     {}", input.read)?;
        writeln!(out, "  graph       {}", size_of(input))?;
        for note in &input.notes {
            writeln!(out, "  note        {note}")?;
        }
        let degrees: Vec<String> = found.degrees.iter().map(usize::to_string).collect();
        let girth = found
            .girth
            .map_or("no cycle".to_owned(), |girth| girth.to_string());
        writeln!(out, "  label       {}", self.label)?;
        writeln!(out, "  graph6      {}", self.graph6)?;
        writeln!(out, "  degrees     {}", degrees.join(","))?;
        writeln!(out, "  girth       {girth}")?;
        writeln!(out, "  symmetry    automorphisms: {}", found.group_order)?;
        writeln!(out, "  triangles   {}", found.triangles)
    }

    /// Writes one JSON object.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn json(&self, out: &mut impl Write) -> io::Result<()> {
        let line = Line {
            graph: GraphLine::of(self.input),
            read: ReadLine::from(&self.input.read),
            notes: &self.input.notes,
            label: self.label.to_string(),
            graph6: &self.graph6,
            degrees: &self.invariants.degrees,
            girth: self.invariants.girth,
            automorphisms: self.invariants.group_order,
            triangles: self.invariants.triangles,
        };
        write_line(out, "label", None, &line)
    }
}
