//! Bounds on the entries of rational cameras: options of the commands that have `--rational`.

use clap::Args;

/// Numerators and denominators of rational cameras.
#[derive(Args)]
pub(super) struct BoundArguments {
    /// Bound on the numerators of rational cameras, at most 100.
    #[arg(long, value_name = "A", default_value_t = 9, requires = "rational")]
    pub(super) numerator: u64,
    /// Bound on the denominators of rational cameras, at most 12.
    #[arg(long, value_name = "B", default_value_t = 4, requires = "rational")]
    pub(super) denominator: u64,
}
