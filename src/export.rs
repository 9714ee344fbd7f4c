//! `verify export GRAPH DIR`: the components, as COLMAP takes them.

use super::given::GivenArguments;
use super::plan::Plan;
use super::question::QuestionArguments;
use anyhow::Result;
use clap::Args;
use std::path::PathBuf;
use viewcert_advice::Request;

/// What to export, and where to.
#[derive(Args)]
pub(super) struct ExportArguments {
    /// The graph; a COLMAP database goes by its tracks, unless --model is said.
    graph: PathBuf,
    /// The folder for lists of images and pairs, and tables.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    #[command(flatten)]
    question: QuestionArguments,
    #[command(flatten)]
    given: GivenArguments,
}

impl ExportArguments {
    /// The plan.
    ///
    /// # Errors
    /// By name, what does not go together.
    pub(super) fn plan(&self) -> Result<Plan> {
        let mut plan = self.question.plan_for_mappers(&self.graph)?;
        plan.given = self.given.path().map(Into::into);
        plan.one_frame = self.given.is_one_frame();
        plan.request = Request {
            export: Some(self.folder.clone()),
            ..Request::default()
        };
        plan.checked()
    }
}
