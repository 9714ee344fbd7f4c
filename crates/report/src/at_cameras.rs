//! What is determined at cameras that are given, in words and in JSON (docs/theory.md, section 16).

use super::{counted, text};
use crate::shown::{row, some};
use serde_json::{Value, json};
use std::io::{self, Write};
use viewcert::at_cameras::{Centres, Here, Special};
use viewcert::certificate::hex;
use viewcert::decide::Verdict;
use viewcert::geometry::model::Model;
use viewcert::graph::{Graph, UnionFind};
use viewcert_formats::NamedGraph;

/// How many special sets, and cameras of one, the text names.
const SHOWN: usize = 5;
/// How many special sets JSON holds.
const LISTED: usize = 100;

/// What a graph determines at given cameras, beside the verdict on generic ones.
#[derive(Clone, Copy, Debug)]
pub struct HereReport<'a> {
    /// The graph.
    pub input: &'a NamedGraph,
    /// The verdict on generic cameras.
    pub verdict: &'a Verdict,
    /// The answer here.
    pub here: &'a Here,
    /// The centres that it is about.
    pub centres: &'a Centres,
    /// Where focal lengths are unknown, the nodes whose one no pair fixes.
    pub open: &'a [u32],
}

/// What the rank means (Theorem 16.1), given that of generic cameras, if it is known.
fn means(here: &Here, graph: &Graph, generic: Option<usize>) -> &'static str {
    let mut sets = UnionFind::new(graph.nodes());
    let edges = graph.edges().iter();
    let joined = edges.filter(|&&(i, j)| sets.union(i as usize, j as usize));
    let is_connected = joined.count() + 1 >= graph.nodes();
    let is_linear = here.model.is_linear() || here.is_planar && is_connected;
    let is_degenerate = generic.is_none_or(|generic| here.rank.value < generic);
    match (here.is_determined(), is_linear) {
        (true, true) => "these cameras are the only ones",
        (true, false) => "these cameras are an isolated solution of multiplicity one",
        (false, false) if is_degenerate && is_connected => {
            "these cameras have a motion of first order"
        }
        (false, _) => "infinitely many sets of cameras",
    }
}

/// Whether the cameras are determined, and what that means.
pub(super) fn answer(here: &Here, graph: &Graph, generic: Option<usize>) -> String {
    let is = if here.is_determined() {
        "determined"
    } else {
        "not determined"
    };
    format!("{is}: {}", means(here, graph, generic))
}

impl HereReport<'_> {
    /// Whether the cameras are determined, with their focal lengths.
    pub fn is_determined(&self) -> bool {
        self.here.is_determined() && self.open.is_empty()
    }

    /// What the rank means.
    fn means(&self) -> &'static str {
        if self.is_determined() || !self.here.is_determined() {
            return means(self.here, &self.input.graph, Some(self.verdict.rank));
        }
        "these cameras are the only ones if focal lengths are known, and no pair fixes some of them"
    }

    /// Whether the cameras have a smaller rank than generic ones.
    pub fn is_degenerate(&self) -> bool {
        self.here.rank.value < self.verdict.rank
    }

    /// Writes lines behind those of the verdict.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_text(&self, out: &mut impl Write, list_components: bool) -> io::Result<()> {
        let here = self.here;
        let strength = text::strength(here.rank.strength);
        let is = if self.is_determined() { "" } else { "not " };
        let answer = format!("{is}determined: {} ({strength})", self.means());
        row(out, "at cameras", answer)?;
        if !self.open.is_empty() {
            let names = self.names(self.open, SHOWN);
            writeln!(
                out,
                "  focal       no pair fixes the focal length of {names}: with each neighbour the optical axes lie \
                 in one plane, or in planes through the base line at right angles; give focal lengths \
                 (--model calibrated), or turn cameras"
            )?;
        }
        if self.is_degenerate() {
            let words = format!(
                "the rank is {} at cameras in general position",
                self.verdict.rank
            );
            row(out, "degenerate", words)?;
        }
        let motions = match here.motions() {
            0 => String::new(),
            some => format!("; motions of dimension {some}"),
        };
        let (rank, required) = (here.rank.value, here.required);
        row(
            out,
            "rank here",
            format_args!("{rank} of {required} ({strength}){motions}"),
        )?;
        let components = &here.components;
        let strength = text::strength(components.strength);
        let sizes = components.value.iter().map(|component| {
            let pairs = counted(component.edge_count(), "pair");
            format!("{} / {pairs}", counted(component.node_count(), "camera"))
        });
        let (count, sizes) = (components.value.len(), some(&Vec::from_iter(sizes), ", "));
        row(
            out,
            "parts here",
            format_args!("{count} ({strength}): {sizes}"),
        )?;
        if list_components {
            for (k, component) in (1..).zip(&components.value) {
                let names = self.names(&component.nodes(), usize::MAX);
                writeln!(out, "  part {k} here: {names}")?;
            }
        }
        for special in here.special.iter().take(SHOWN) {
            let (what, nodes) = (place(special, here.model), special.nodes());
            let (count, names) = (counted(nodes.len(), "camera"), self.names(nodes, SHOWN));
            row(out, "special", format_args!("{count} {what}: {names}"))?;
        }
        if here.special.len() > SHOWN {
            let more = here.special.len() - SHOWN;
            row(
                out,
                "special",
                format_args!("{more} more such sets (--json lists them)"),
            )?;
        }
        row(
            out,
            "centres",
            format_args!("SHA-256 {}", hex(&here.sha256)),
        )
    }

    fn names(&self, nodes: &[u32], most: usize) -> String {
        let names = nodes.iter().take(most);
        let names = names.map(|&v| self.input.labels.display(v).to_string());
        let more = (nodes.len() > most).then(|| "...".to_owned());
        names.chain(more).collect::<Vec<_>>().join(" ")
    }

    /// The member of JSON; of special sets the first hundred.
    pub(super) fn line(&self, list_components: bool) -> Value {
        let here = self.here;
        let labels = |nodes: &[u32]| -> Vec<String> {
            let label = |&v: &u32| self.input.labels.label(v).into_owned();
            nodes.iter().map(label).collect()
        };
        let components = here.components.value.iter().map(|part| {
            let mut line = json!({ "nodes": part.node_count(), "edges": part.edge_count() });
            if list_components {
                line["labels"] = labels(&part.nodes()).into();
            }
            line
        });
        let special = here.special.iter().take(LISTED);
        let special =
            special.map(|set| json!({ "kind": set.name(), "labels": labels(set.nodes()) }));
        let mut line = json!({
            "determined": self.is_determined(),
            "means": self.means(),
            "degenerate": self.is_degenerate(),
            "strength": here.rank.strength.name(),
            "error_log2": here.rank.strength.error_log2(),
            "rank": here.rank.value,
            "rank_required": here.required,
            "motions": here.motions(),
            "components": Vec::from_iter(components),
            "components_strength": here.components.strength.name(),
            "special": Vec::from_iter(special),
            "special_sets": here.special.len(),
            "centres_sha256": hex(&here.sha256),
        });
        if !self.open.is_empty() {
            line["focal_open"] = labels(self.open).into();
        }
        line
    }
}

/// Where a special set is.
fn place(special: &Special, model: Model) -> &'static str {
    match (special, model) {
        (Special::Coincident(_), Model::Affine) => "with one viewing direction",
        (Special::Coincident(_), _) => "at one place",
        (Special::Collinear(_), Model::Affine) => "with viewing directions along one plane",
        (Special::Collinear(_), _) => "on one line",
        (Special::Coplanar(_), _) => "in one plane",
    }
}
