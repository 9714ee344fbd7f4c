//! Bounds on the entries of rational cameras: options of the commands that have `--rational`.

use clap::Args;
use viewcert::geometry::draw::{MAX_DENOMINATOR, MAX_NUMERATOR};

/// Numerators and denominators of rational cameras.
#[derive(Args)]
pub(super) struct BoundArguments {
    /// Bound on the numerators of rational cameras, at most 100.
    #[arg(long, value_name = "A", default_value_t = 9, requires = "rational")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=MAX_NUMERATOR))]
    pub(super) numerator: u64,
    /// Bound on the denominators of rational cameras, at most 12.
    #[arg(long, value_name = "B", default_value_t = 4, requires = "rational")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=MAX_DENOMINATOR))]
    pub(super) denominator: u64,
}
