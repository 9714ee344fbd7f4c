//! `viewcert-lab published GRAPH...`: why the published method counts other components than there are.

use anyhow::{Context, Result};
use clap::Args;
use std::io::{BufWriter, Write};
use std::path::PathBuf;
use viewcert::decide;
use viewcert_cli::InputArguments;
use viewcert_formats::NamedGraph;
use viewcert_lab_studies::published::study;
use viewcert_report::counted;
use viewcert_session::Session;
use viewcert_session::exit::{GOOD, NOT, TooLarge};

/// Of which graphs.
#[derive(Args)]
pub struct Arguments {
    /// Graphs, in whatever `verify` reads.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Repeats the method on every graph in turn, and says whether it finds the components.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let mut out = BufWriter::new(std::io::stdout().lock());
    let each = |out: &mut _, input: &NamedGraph, _| one(session, arguments, input, out);
    let (input, graphs) = (&arguments.input, &arguments.graphs);
    input.for_each(session, (graphs, false), &|_| None, &mut out, each)
}

fn one(
    session: &Session,
    arguments: &Arguments,
    input: &NamedGraph,
    out: &mut impl Write,
) -> Result<u8> {
    let name = || input.name.clone();
    let options = decide::Options::default()
        .seed(arguments.seed)
        .watch(session.watch());
    let verdict = decide::decide(&input.graph, &options).with_context(name)?;
    let is = verdict.components.len();
    let found = study(&input.graph, is, arguments.seed).with_context(name)?;
    let Some(found) = found else {
        let size = counted(input.graph.nodes(), "camera");
        return Err(TooLarge(format!("{}: {size} take too long", input.name)).into());
    };
    let (least, most) = (found.by_start.start(), found.by_start.end());
    writeln!(out, "{}", input.name)?;
    writeln!(out, "  components  {is} (exact)")?;
    writeln!(
        out,
        "  published   {} with all pairs at every step",
        found.components
    )?;
    writeln!(
        out,
        "              {least} to {most} without the pairs of earlier components, begun at {}",
        counted(found.starts, "pair")
    )?;
    Ok(if found.components == is && least == most {
        GOOD
    } else {
        NOT
    })
}
