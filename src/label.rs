//! `verify label GRAPH...`: the names of small graphs, and the graphs of such names.

use super::input::{InputArguments, for_each_read};
use anyhow::{Context, Result};
use clap::Args;
use std::path::{Path, PathBuf};
use viewcert::graph::Labels;
use viewcert_catalog::label::{Label, MAX_NODES};
use viewcert_formats::{NamedGraph, ReadAs, read_graphs};
use viewcert_report::label::LabelReport;
use viewcert_session::exit::{GOOD, TooLarge};
use viewcert_session::{Session, outputs};

/// What to name.
#[derive(Args)]
pub(super) struct LabelArguments {
    /// Graphs with up to 16 nodes, in whatever `verify` reads; or labels, as vg.5.6.55, of which the
    /// graphs are shown.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
}

/// Names every graph; a bad one is reported and does not stop the others.
pub(super) fn run(session: &Session, arguments: &LabelArguments) -> Result<u8> {
    let mut out = outputs::text(&[]);
    let paths = &arguments.graphs;
    let options = arguments.input.of_pairs()?;
    for text in paths.iter().filter_map(|path| label(path)) {
        text.parse::<Label>().with_context(|| text.to_owned())?;
    }
    let read = |path: &Path| -> viewcert_ask::Inputs {
        match label(path).and_then(|text| Some((text, text.parse::<Label>().ok()?))) {
            Some((text, label)) => {
                let mut named = NamedGraph::new(text, label.graph(), Labels::Numbers { first: 0 });
                named.read = ReadAs::new("label");
                Box::new(std::iter::once(Ok((named, None))))
            }
            None => Box::new(read_graphs(path, &options).map(|graph| Ok((graph?, None)))),
        }
    };
    let each = |out: &mut _, _: &Path, input: Result<viewcert_ask::Input, _>, _| {
        let (input, _) = input?;
        let report = LabelReport::new(&input).ok_or_else(|| {
            TooLarge(format!(
                "{}: {} nodes, and graphs with up to {MAX_NODES} have labels; its graph6 line names it \
                 (`verify convert --to graph6`)",
                input.name,
                input.graph.nodes()
            ))
        })?;
        if arguments.json {
            report.json(out)?;
        } else {
            report.write(out)?;
        }
        Ok(GOOD)
    };
    let code = for_each_read(
        session,
        &read,
        (paths, arguments.json),
        &|_| None,
        &mut out,
        each,
    )?;
    Ok(code)
}

/// A label in the place of a path.
fn label(path: &Path) -> Option<&str> {
    let text = path.to_str()?;
    (text.starts_with("vg.") && !path.exists()).then_some(text)
}
