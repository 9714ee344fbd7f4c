//! What all shards of a run make.

use crate::set_digest::SetDigest;
use crate::verdicts::Tally;
use viewcert_catalog::mine::Summary;

/// The whole of a run.
#[derive(Clone, Debug)]
pub struct Merged {
    /// What was decided.
    pub source: String,
    /// What was counted.
    pub counts: Counts,
    /// What was decided again, if that was asked for.
    pub rechecked: Option<Rechecked>,
}

impl Merged {
    /// Whether nothing that was decided again contradicts.
    pub fn agrees(&self) -> bool {
        let mut rechecked = self.rechecked.iter();
        rechecked.all(|found| found.contradictions.is_empty())
    }
}

/// What a run has counted.
#[derive(Clone, Debug)]
pub enum Counts {
    /// Entries, with the digest of their lines, those that are not kept included.
    Entries(Summary, SetDigest),
    /// Verdicts alone.
    Verdicts(Tally),
}

/// What was decided again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rechecked {
    /// How many graphs were.
    pub graphs: u64,
    /// Of how many.
    pub of: u64,
    /// Where the files say something else.
    pub contradictions: Vec<String>,
}
