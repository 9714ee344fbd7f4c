//! What to do about a verdict: options of `verify GRAPH`.

use clap::{Args, ValueEnum};
use std::path::PathBuf;
use viewcert_advice::{Request, Weak};

/// Options about what to do.
#[derive(Args)]
#[command(next_help_heading = "What to do about a verdict")]
pub(super) struct AdviceArguments {
    /// Find the pairs (`--weak=images`: the images) without which a component falls apart.
    #[arg(long, value_name = "WHAT", num_args = 0..=1, require_equals = true)]
    #[arg(value_enum, default_missing_value = "pairs")]
    weak: Option<WeakName>,
    /// Suggest images to match that would join components, at most N [default: 10]; with --tracks
    /// also how much has to come of it.
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "10", value_parser = clap::value_parser!(u32).range(1..))]
    suggest: Option<u32>,
    /// Explain an image: its components, its pairs, what it would need.
    #[arg(long, value_name = "IMAGE")]
    explain: Option<String>,
    /// Decide again with at least so many inliers per pair, for each number (of a database).
    #[arg(long, value_name = "N,N,...", value_delimiter = ',')]
    sweep: Vec<u32>,
    /// Leave out pairs (or tracks) at random, N times for each of several shares, and say how often
    /// the components stay whole [default: 10].
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "10", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    margin: Option<u32>,
    /// Write the components to this folder, as COLMAP takes them.
    #[arg(long, value_name = "DIR")]
    export: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum WeakName {
    /// Pairs.
    Pairs,
    /// Images.
    Images,
}

impl AdviceArguments {
    /// What is asked.
    pub(super) fn request(&self) -> Request {
        Request {
            weak: self.weak.map(|what| match what {
                WeakName::Pairs => Weak::Pairs,
                WeakName::Images => Weak::Images,
            }),
            suggest: self.suggest,
            explain: self.explain.clone(),
            sweep: self.sweep.clone(),
            margin: self.margin,
            export: self.export.clone(),
        }
    }
}
