//! `verify advise GRAPH...`: what follows from a verdict, and what to do about it
//! (docs/reconstruction.md).

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
    /// The pairs, or images, without which a component falls apart.
    #[arg(long, value_name = "WHAT", num_args = 0..=1, require_equals = true)]
    #[arg(value_enum, default_missing_value = "pairs")]
    weak: Option<WeakName>,
    /// Pairs to match that would join components, N at most [default: 10].
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "10", value_parser = clap::value_parser!(u32).range(1..))]
    suggest: Option<u32>,
    /// An image: its components, its pairs, what it would need.
    #[arg(long, value_name = "IMAGE")]
    explain: Option<String>,
    /// Write the pairs that are left to match to FILE, and print COLMAP's command.
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,
    #[command(flatten)]
    question: QuestionArguments,
}

#[derive(Clone, Copy, ValueEnum)]
enum WeakName {
    Pairs,
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
        plan.request = Request {
            weak: self.weak.map(|what| match what {
                WeakName::Pairs => Weak::Pairs,
                WeakName::Images => Weak::Images,
            }),
            suggest: self.suggest,
            explain: self.explain.clone(),
            write: self.write.clone(),
            ..Request::default()
        };
        let request = &plan.request;
        if !request.asks() || request.write.is_some() && request.suggest.is_none() {
            plan.request.suggest = Some(SUGGESTED);
        }
        plan.checked()
    }
}
