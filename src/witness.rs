//! `verify witness GRAPH FILE`: two families of cameras with the same fundamental matrices, to look
//! at; with `--oriented` two real scenes with the same images.

use super::input::InputArguments;
use super::plan::{Form, Plan};
use anyhow::Result;
use clap::Args;
use std::path::{Path, PathBuf};
use viewcert::decide::{CountSolutions, Verdict};
use viewcert::geometry::model::Model;
use viewcert_formats::NamedGraph;
use viewcert_report::second_scene::picture;
use viewcert_report::witness_file::{second, second_scene, write_second_scene, write_witness};
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
    /// A real second solution that may be another scene in front of other cameras with the same images,
    /// exact at integer centres; a FILE that ends in `.svg` is a picture of both scenes.
    #[arg(long)]
    oriented: bool,
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
        if self.full || self.oriented {
            plan.draft.solutions = CountSolutions::Full;
        }
        if self.json {
            plan.form = Form::Json;
        }
        plan.products.witness = Some(self.file.clone());
        plan.products.oriented = self.oriented;
        plan.checked()
    }
}

/// Why a scene that was found is not drawn.
const TOO_FAR: &str =
    "the second scene is too far from the first one to be drawn; another --seed may do";

/// Writes a second solution, if one is known; otherwise why not.
///
/// # Errors
/// If the file cannot be written.
pub(super) fn write(
    outputs: &Outputs,
    path: &Path,
    input: &NamedGraph,
    verdict: &Verdict,
    (seed, is_oriented): (u64, bool),
) -> Result<Result<(), String>> {
    if is_oriented {
        return write_oriented(outputs, path, input, verdict);
    }
    let witness = match second(input, verdict, seed) {
        Ok(witness) => witness,
        Err(why) => return Ok(Err(why.to_string())),
    };
    outputs.write(path, |out| write_witness(out, input, &witness))?;
    Ok(Ok(()))
}

/// Writes a real second solution, as a picture if the file is to be one.
fn write_oriented(
    outputs: &Outputs,
    path: &Path,
    input: &NamedGraph,
    verdict: &Verdict,
) -> Result<Result<(), String>> {
    let second = match second_scene(verdict) {
        Ok(second) => second,
        Err(why) => return Ok(Err(why.to_string())),
    };
    if path.extension().is_some_and(|extension| extension == "svg") {
        let Some(picture) = picture(input, &second) else {
            return Ok(Err(TOO_FAR.to_owned()));
        };
        outputs.write(path, |out| out.write_all(picture.as_bytes()))?;
    } else {
        outputs.write(path, |out| write_second_scene(out, input, &second))?;
    }
    Ok(Ok(()))
}
