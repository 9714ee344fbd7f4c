//! What is asked of a graph: options of all commands that decide.

use super::input::InputArguments;
use super::plan::{Form, Plan};
use anyhow::Result;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use viewcert::geometry::model::Model;
use viewcert_formats::ReadOptions;

/// The graphs.
pub(super) const GRAPHS: &str = "Graphs, in about any file that holds one: edge lists, graph6, matrices, \
                                 GraphML, COLMAP databases and many more (`verify help input`); `-` is \
                                 standard input";

/// What edges carry, and how graphs are read.
#[derive(Args)]
pub(super) struct QuestionArguments {
    /// What is known of the cameras [default: projective; with --tracks calibrated].
    #[arg(long, value_enum)]
    model: Option<ModelName>,
    /// Decide the graph of cameras and points, of a COLMAP database or model, Bundler, BAL, NVM or
    /// OpenMVG: do the tracks determine all positions, rotations being known? Implies --model
    /// calibrated.
    #[arg(long)]
    tracks: bool,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// List the members of every component.
    #[arg(long)]
    components: bool,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    input: InputArguments,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ModelName {
    /// Edges carry fundamental matrices.
    Projective,
    /// Edges carry essential matrices: known intrinsics.
    Calibrated,
    /// Edges carry affine fundamental matrices: affine cameras.
    Affine,
    /// Unknown focal lengths, everything else known: each pair fixes both, and then as calibrated.
    Focal,
}

impl QuestionArguments {
    /// The plan for these graphs.
    ///
    /// # Errors
    /// An option that says how tracks are read, without tracks.
    pub(super) fn plan(&self, graphs: &[PathBuf]) -> Result<Plan> {
        let model = match self.model {
            Some(ModelName::Calibrated | ModelName::Focal) => Model::Calibrated,
            Some(ModelName::Affine) => Model::Affine,
            None if self.tracks => Model::Calibrated,
            Some(ModelName::Projective) | None => Model::Projective,
        };
        let mut plan = Plan::new(graphs, self.read_options()?, model, self.seed);
        plan.asked.focal = self.model == Some(ModelName::Focal);
        plan.list_components = self.components;
        if self.json {
            plan.form = Form::Json;
        }
        Ok(plan)
    }

    fn read_options(&self) -> Result<ReadOptions> {
        if self.tracks {
            Ok(self.input.of_tracks())
        } else {
            self.input.of_pairs()
        }
    }
}
