//! `verify draw GRAPH FILE...`: one graph as a page and as a picture.

use super::given::GivenArguments;
use super::intrinsics::IntrinsicsArguments;
use super::plan::Plan;
use super::question::QuestionArguments;
use anyhow::{Result, bail};
use clap::Args;
use std::path::{Path, PathBuf};

/// What to draw, and where to.
#[derive(Args)]
pub(super) struct DrawArguments {
    /// The graph, in whatever `verify` reads.
    graph: PathBuf,
    /// A page (.html), a picture (.svg), or both; `-` is the picture.
    #[arg(required = true, value_name = "FILE", num_args = 1..=2)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    question: QuestionArguments,
    #[command(flatten)]
    given: GivenArguments,
    #[command(flatten)]
    intrinsics: IntrinsicsArguments,
}

impl DrawArguments {
    /// The plan.
    ///
    /// # Errors
    /// By name, what does not go together; a file whose name does not say what it is.
    pub(super) fn plan(&self) -> Result<Plan> {
        let mut plan = self.question.plan(std::slice::from_ref(&self.graph))?;
        plan.given = self.given.path().map(Into::into);
        plan.one_frame = self.given.is_one_frame();
        plan.intrinsics = self.intrinsics.from();
        for file in &self.files {
            let is_standard = file == Path::new("-");
            let place = match extension(file).as_deref() {
                Some("html" | "htm") => &mut plan.products.page,
                Some("svg") => &mut plan.products.picture,
                _ if is_standard => &mut plan.products.picture,
                _ => bail!(
                    "{}: the name of a file says what is drawn: .html a page, .svg a picture",
                    file.display()
                ),
            };
            if let Some(other) = place.replace(file.clone()) {
                bail!(
                    "{} and {} are files of one kind; name one page and one picture at most",
                    other.display(),
                    file.display()
                );
            }
        }
        plan.checked()
    }
}

fn extension(file: &Path) -> Option<String> {
    Some(file.extension()?.to_str()?.to_ascii_lowercase())
}
