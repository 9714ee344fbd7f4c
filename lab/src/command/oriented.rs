//! `viewcert-lab oriented`: in how many scenes the scene is unique although its graph has several
//! solutions.

use super::sizes;
use crate::oriented::tally::{Tally, tally};
use crate::solutions::Source;
use anyhow::{Context, Result};
use clap::Args;
use std::io::Write;
use std::ops::RangeInclusive;
use viewcert::decide::Options;
use viewcert_lab_catalog::progress::Progress;
use viewcert_session::Session;
use viewcert_session::exit::GOOD;
use viewcert_session::outputs;

/// Options of the experiment on oriented solutions.
#[derive(Args)]
pub struct Arguments {
    /// Numbers of nodes, as in 9 or 9-10.
    #[arg(long, value_name = "N", default_value = "9-10", value_parser = sizes)]
    nodes: RangeInclusive<usize>,
    /// At how many integer centres each graph is looked at.
    #[arg(long, value_name = "K", default_value_t = 100)]
    places: usize,
    /// Seed of the centres.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// Looks at the graphs with the fewest pairs that have several solutions.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let options = Options::default().watch(session.watch());
    let mut out = outputs::text(&[]);
    writeln!(
        out,
        "nodes  solutions  graphs  unique at  ambiguous at  places  unique  against  no plane  oriented  shares"
    )?;
    for nodes in arguments.nodes.clone() {
        let graphs = Source::FewestEdges.graphs(nodes)?;
        let progress = Progress::new("graphs", Some(graphs.len() as u64));
        let wish = (arguments.places, arguments.seed);
        let found = tally(&graphs, &options, wish, |more| progress.done(more))?;
        progress.finish();
        for (&solutions, tally) in &found {
            write_row(&mut out, nodes, solutions, tally)?;
        }
        out.flush().context("standard output")?;
    }
    Ok(GOOD)
}

/// Graphs with a place of each kind, places, and what the other real solutions are.
fn write_row(
    out: &mut impl Write,
    nodes: usize,
    solutions: usize,
    tally: &Tally,
) -> std::io::Result<()> {
    let solutions = solutions.to_string();
    let shares = tally
        .shares
        .as_ref()
        .map_or(String::new(), |[least, most]| {
            format!("{} % ({}) to {} % ({})", least.0, least.1, most.0, most.1)
        });
    writeln!(
        out,
        "{nodes:>5}  {solutions:>9}  {:>6}  {:>9}  {:>12}  {:>6}  {:>6}  {:>7}  {:>8}  {:>8}  {shares}",
        tally.graphs,
        tally.unique_somewhere,
        tally.ambiguous_somewhere,
        tally.places,
        tally.unique(),
        tally.against,
        tally.no_plane,
        tally.oriented,
    )?;
    for ([real, oriented], places) in &tally.numbers {
        writeln!(
            out,
            "       {oriented} of {real} real solutions oriented: {places} places"
        )?;
    }
    Ok(())
}
