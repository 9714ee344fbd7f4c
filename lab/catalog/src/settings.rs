//! How candidates are decided, and where entries are written.

use anyhow::{Context, Result};
use std::path::PathBuf;
use viewcert::decide::{CountSolutions, Options, Prime, Question};
use viewcert::linalg::prime::{DEFAULT_PRIME, PrimeField};
use viewcert::watch::Watch;

/// How candidates are decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Whether the solutions of finite-solvable graphs are counted.
    pub solutions: bool,
    /// A prime, 5 <= p < 2^62.
    pub prime: u64,
    /// The seed of all draws.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            solutions: false,
            prime: DEFAULT_PRIME,
            seed: 1,
        }
    }
}

impl Settings {
    /// As the library takes them.
    ///
    /// # Errors
    /// A number that is no prime, or too large.
    pub fn options(&self, watch: Watch) -> Result<Options> {
        let prime = self.prime;
        let field = PrimeField::new(prime).with_context(|| format!("prime {prime}"))?;
        let solutions = if self.solutions {
            CountSolutions::Quick
        } else {
            CountSolutions::Off
        };
        let options = Options::default().question(Question::with_solutions(solutions));
        let options = options.prime(Prime::Fixed(field)).seed(self.seed);
        Ok(options.watch(watch))
    }
}

/// Where entries are written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Files {
    /// The folder for all shards.
    pub folder: PathBuf,
    /// How many candidates a part file has, 1 to [`MOST_CANDIDATES`](crate::shard_files::MOST_CANDIDATES).
    pub part: u32,
    /// Whether only the lines of finite-solvable graphs and of unproved verdicts are kept.
    pub solvable_only: bool,
    /// Whether the certificates of these lines are written too.
    pub certificates: bool,
}
