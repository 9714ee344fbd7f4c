//! `verify advise GRAPH...`: what follows from a verdict, and what to do about it
//! (docs/reconstruction.md).

use super::intrinsics::IntrinsicsArguments;
use super::plan::Plan;
use super::question::{GRAPHS, QuestionArguments};
use anyhow::Result;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use viewcert_advice::{Request, Weak};

/// What to do about which graphs. Joints between components are listed in any case.
#[derive(Args)]
pub(super) struct AdviseArguments {
    #[arg(required = true, value_name = "GRAPH", help = GRAPHS)]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    advice: AdviceArguments,
    /// Write the suggested pairs that are left to match to FILE, the most promising first, and print the
    /// COLMAP command that matches them.
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    #[command(flatten)]
    question: QuestionArguments,
    #[command(flatten)]
    intrinsics: IntrinsicsArguments,
}

/// What is asked about an answer.
#[derive(Args)]
pub(super) struct AdviceArguments {
    /// Find the pairs (`--weak=images`: the images) without which a component is not finite solvable.
    #[arg(long, value_name = "WHAT", num_args = 0..=1, require_equals = true)]
    #[arg(value_enum, default_missing_value = "pairs")]
    weak: Option<WeakName>,
    /// Say of every pair in how many of its equations the rest checks it, and which pairs check each
    /// other: an error in what nothing checks cannot be seen by anyone. Calibrated: of its direction alone.
    #[arg(long)]
    surplus: bool,
    /// Count the pairs that are determined though they are not in the graph, up to finitely many values if it
    /// is not unique, and list N of them at most [default: 1000].
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "1000")]
    implied: Option<u32>,
    /// Suggest images to match that would join components, at most N [default: 10]; with --tracks
    /// also how much has to come of it; with --intrinsics cameras to calibrate. `advise` does this if
    /// nothing else is asked.
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "10", value_parser = clap::value_parser!(u32).range(1..))]
    suggest: Option<u32>,
    /// Explain an image: its components, its pairs, what it would need.
    #[arg(long, value_name = "IMAGE")]
    explain: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum WeakName {
    /// Pairs.
    Pairs,
    /// Images.
    Images,
}

/// Most suggestions where no number is given.
const SUGGESTED: u32 = 10;

impl AdviseArguments {
    /// The plan.
    ///
    /// # Errors
    /// By name, what does not go together.
    pub(super) fn plan(&self) -> Result<Plan> {
        let mut plan = self.question.plan(&self.graphs)?;
        plan.intrinsics = self.intrinsics.from();
        plan.request = self.advice.request();
        plan.request.write = self.write.clone();
        let request = &plan.request;
        if !request.asks() || request.write.is_some() && request.suggest.is_none() {
            plan.request.suggest = Some(SUGGESTED);
        }
        plan.checked()
    }
}

impl AdviceArguments {
    /// What is asked.
    pub(super) fn request(&self) -> Request {
        Request {
            weak: self.weak.map(|what| match what {
                WeakName::Pairs => Weak::Pairs,
                WeakName::Images => Weak::Images,
            }),
            surplus: self.surplus,
            implied: self.implied,
            suggest: self.suggest,
            explain: self.explain.clone(),
            ..Request::default()
        }
    }
}
