//! `verify witness GRAPH FILE`: two families of cameras with the same fundamental matrices, to look
//! at; with `--oriented` two real scenes with the same images.

use super::input::InputArguments;
use super::plan::{Form, Plan};
use anyhow::Result;
use clap::Args;
use std::path::{Path, PathBuf};
use viewcert::decide::{CountSolutions, Verdict};
use viewcert::geometry::model::Model;
use viewcert::solutions::Solutions;
use viewcert_formats::NamedGraph;
use viewcert_report::second_scene::{self, SecondScene};
use viewcert_report::witness_file::{write_second_scene, write_witness};
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
    (seed, is_oriented): (u64, bool),
) -> Result<Found> {
    let Some(count) = &verdict.solutions else {
        return Ok(Found::Nothing("there are infinitely many solutions"));
    };
    if count.is_one() {
        return Ok(Found::Nothing("there is one solution only"));
    }
    if is_oriented {
        return write_oriented(outputs, path, input, count.evidence.as_deref());
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

/// Writes a real second solution, as a picture if the file is to be one.
fn write_oriented(
    outputs: &Outputs,
    path: &Path,
    input: &NamedGraph,
    evidence: Option<&Solutions>,
) -> Result<Found> {
    let Some(oriented) = evidence.and_then(|found| found.oriented.as_ref()) else {
        return Ok(Found::Nothing(
            "real solutions are looked for where there are two to eight, known exactly, of one core",
        ));
    };
    let Some(second) = SecondScene::of(oriented) else {
        return Ok(Found::Nothing(
            "no second scene in front of its cameras was found; another --seed may find one",
        ));
    };
    if path.extension().is_some_and(|extension| extension == "svg") {
        let Some(picture) = second_scene::picture(input, &second) else {
            return Ok(Found::Nothing(
                "the second scene is too far from the first one to be drawn; another --seed may do",
            ));
        };
        outputs.write(path, |out| out.write_all(picture.as_bytes()))?;
    } else {
        outputs.write(path, |out| write_second_scene(out, input, &second))?;
    }
    Ok(Found::Written)
}
