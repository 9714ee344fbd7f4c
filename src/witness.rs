//! `verify witness GRAPH FILE`: two families of cameras with the same fundamental matrices, to look
//! at.

use super::input::InputArguments;
use super::plan::{Form, Plan};
use anyhow::Result;
use clap::Args;
use serde_json::to_string;
use std::io::Write;
use std::path::{Path, PathBuf};
use viewcert::decide::{CountSolutions, Verdict};
use viewcert::geometry::model::Model;
use viewcert::solutions::Witness;
use viewcert_formats::NamedGraph;
use viewcert_session::Outputs;

/// Of what, and where to.
#[derive(Args)]
pub(super) struct WitnessArguments {
    /// The graph, in whatever `verify` reads.
    graph: PathBuf,
    /// The file for two sets of cameras modulo a prime that have the same fundamental matrices, if a
    /// second solution is known (`-`: standard output, and the report to standard error).
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
        let mut plan = Plan::new(graphs, self.input.of_pairs()?, Model::Projective, self.seed);
        if self.full {
            plan.draft.solutions = CountSolutions::Full;
        }
        if self.json {
            plan.form = Form::Json;
        }
        plan.products.witness = Some(self.file.clone());
        plan.checked()
    }
}

/// What came of it.
pub(super) enum Found {
    /// The file is there.
    Written,
    /// There is nothing to write, for a reason.
    Nothing(&'static str),
}

/// Writes a second solution, if one is known.
///
/// # Errors
/// If the file cannot be written.
pub(super) fn write(
    outputs: &Outputs,
    path: &Path,
    input: &NamedGraph,
    verdict: &Verdict,
    seed: u64,
) -> Result<Found> {
    let Some(count) = &verdict.solutions else {
        return Ok(Found::Nothing("there are infinitely many solutions"));
    };
    if count.is_one() {
        return Ok(Found::Nothing("there is one solution only"));
    }
    let witness = count
        .evidence
        .as_ref()
        .and_then(|found| found.witness(&input.graph, seed));
    let Some(witness) = witness else {
        return Ok(Found::Nothing("no second solution is known"));
    };
    outputs.write(path, |out| write_witness(out, input, &witness))?;
    Ok(Found::Written)
}

/// A JSON object with a camera a line; residues are strings, so that no reader rounds them.
fn write_witness(
    out: &mut dyn Write,
    input: &NamedGraph,
    witness: &Witness,
) -> std::io::Result<()> {
    let nodes = 0..input.graph.nodes() as u32;
    let labels: Vec<String> = nodes.map(|v| input.labels.label(v).into_owned()).collect();
    writeln!(out, "{{\"format\": \"viewcert witness\", \"version\": 1,")?;
    writeln!(out, " \"graph\": {},", to_string(&input.name)?)?;
    writeln!(out, " \"prime\": \"{}\",", witness.prime)?;
    writeln!(out, " \"nodes\": {},", to_string(&labels)?)?;
    writeln!(out, " \"edges\": {},", to_string(&input.graph.edges())?)?;
    for (k, family) in witness.families.iter().enumerate() {
        writeln!(out, " \"{}\": [", ["first", "second"][k])?;
        for (v, camera) in (1..).zip(family) {
            let entries = camera.map(|row| row.map(|x| x.to_string()));
            let comma = if v < family.len() { "," } else { "" };
            writeln!(out, "  {}{comma}", to_string(&entries)?)?;
        }
        writeln!(out, " ]{}", if k == 0 { "," } else { "}" })?;
    }
    Ok(())
}
