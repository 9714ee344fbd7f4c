//! `verify witness GRAPH FILE`: two families of cameras with the same fundamental matrices, to look
//! at.

use super::input::InputArguments;
use super::plan::{Form, Plan};
use anyhow::Result;
use clap::Args;
use std::path::{Path, PathBuf};
use viewcert::decide::{CountSolutions, Verdict};
use viewcert::geometry::model::Model;
use viewcert_formats::NamedGraph;
use viewcert_report::witness_file::{second, write_witness};
use viewcert_session::Outputs;

/// Of what, and where to.
#[derive(Args)]
pub(super) struct WitnessArguments {
    /// The graph, in whatever `verify` reads.
    graph: PathBuf,
    /// The file for both sets, modulo a prime.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Count solutions whatever it takes.
    #[arg(long)]
    full: bool,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    input: InputArguments,
}

impl WitnessArguments {
    /// The plan.
    ///
    /// # Errors
    /// By name, what does not go together.
    pub(super) fn plan(&self) -> Result<Plan> {
        let graphs = std::slice::from_ref(&self.graph);
        let mut plan = Plan::new(graphs, self.input.of_pairs()?, Model::default(), self.seed);
        if self.full {
            plan.question.solutions = CountSolutions::Full;
        }
        if self.json {
            plan.form = Form::Json;
        }
        plan.products.witness = Some(self.file.clone());
        plan.checked()
    }
}

/// Writes a second solution, if one is known; otherwise why not.
///
/// # Errors
/// If the file cannot be written.
pub(super) fn write(
    outputs: &Outputs,
    path: &Path,
    input: &NamedGraph,
    verdict: &Verdict,
    seed: u64,
) -> Result<Result<(), String>> {
    let witness = match second(input, verdict, seed) {
        Ok(witness) => witness,
        Err(why) => return Ok(Err(why.to_string())),
    };
    outputs.write(path, |out| write_witness(out, input, &witness))?;
    Ok(Ok(()))
}
