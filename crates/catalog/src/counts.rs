//! What all shards of a run make.

use crate::mine::Summary;
use crate::verdicts::Tally;

/// The whole of a run.
#[derive(Clone, Debug)]
pub struct Merged {
    /// What was decided.
    pub source: String,
    /// What was counted.
    pub counts: Counts,
}

/// What a run has counted.
#[derive(Clone, Debug)]
pub enum Counts {
    /// Entries.
    Entries(Summary),
    /// Verdicts alone.
    Verdicts(Tally),
}
