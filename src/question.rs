//! What is asked of a graph: options of all commands that decide.

use super::input::InputArguments;
use super::plan::{Form, Plan};
use anyhow::Result;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use viewcert::geometry::model::Model;
use viewcert_formats::colmap::is_database;

/// The graphs.
pub(super) const GRAPHS: &str = "Lists of pairs, COLMAP databases and many more (`verify help input`); `-` is \
                                 standard input";

/// The title of options that change how something is computed, and not what is asked.
pub(super) const ARITHMETIC: &str = "Arithmetic";

/// What edges carry, and how graphs are read.
#[derive(Args)]
pub(super) struct QuestionArguments {
    /// projective (default), calibrated, affine, or focal: unknown focal lengths.
    #[arg(long, value_enum, hide_possible_values = true)]
    model: Option<ModelName>,
    /// Decide the graph of cameras and points; rotations are known.
    #[arg(long)]
    tracks: bool,
    /// Seed of all random cameras [default: 1].
    #[arg(long, default_value_t = 1, hide_default_value = true, help_heading = ARITHMETIC, hide_short_help = true)]
    seed: u64,
    /// List the members of every component.
    #[arg(long, hide_short_help = true)]
    components: bool,
    /// Print one JSON object a graph.
    #[arg(long)]
    pub(super) json: bool,
    #[command(flatten)]
    input: InputArguments,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ModelName {
    Projective,
    Calibrated,
    Affine,
    Focal,
}

impl ModelName {
    /// The model in which graphs are decided.
    pub(super) fn model(self) -> Model {
        match self {
            Self::Projective => Model::Projective,
            Self::Calibrated | Self::Focal => Model::Calibrated,
            Self::Affine => Model::Affine,
        }
    }
}

impl QuestionArguments {
    /// The plan for these graphs.
    ///
    /// # Errors
    /// An option that says how tracks are read, without tracks.
    pub(super) fn plan(&self, graphs: &[PathBuf]) -> Result<Plan> {
        self.plan_by(graphs, self.tracks)
    }

    /// The plan for a command that leads on to mappers, which go by tracks: so does this with a database,
    /// unless a model of pairs is named.
    ///
    /// # Errors
    /// As of [`plan`](Self::plan).
    pub(super) fn plan_for_mappers(&self, graph: &Path) -> Result<Plan> {
        let by_tracks = self.tracks || self.model.is_none() && is_database(graph);
        self.plan_by(&[graph.to_owned()], by_tracks)
    }

    fn plan_by(&self, graphs: &[PathBuf], tracks: bool) -> Result<Plan> {
        let model = match self.model {
            Some(name) => name.model(),
            None if tracks => Model::Calibrated,
            None => Model::Projective,
        };
        let read = match tracks {
            true => self.input.reading().tracks,
            false => self.input.of_pairs()?,
        };
        let mut plan = Plan::new(graphs, read, model, self.seed);
        plan.asked.focal = self.model == Some(ModelName::Focal);
        plan.list_components = self.components;
        if self.json {
            plan.form = Form::Json;
        }
        Ok(plan)
    }
}
