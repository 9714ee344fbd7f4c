//! Floating point beside an exact verdict.
//!
//! In: a graph and its verdict. Out: what floating point says at so many draws of cameras, how often that is
//! wrong, and where only the components differ, whether the published method is the reason and not rounding.

use super::published::{self, Study};
use super::{AuditError, FloatVerdict, Options, Outcome, components, decide, study};
use std::time::{Duration, Instant};
use viewcert::decide::{Value, Verdict};
use viewcert::graph::Graph;

/// What floating point found of a graph, held against its verdict.
#[derive(Clone, Debug)]
pub struct Beside {
    /// The float side at the first draw.
    pub outcome: Outcome,
    /// Components of the float side; `None` if it is undecided.
    pub components: Option<usize>,
    /// Its time, components included.
    pub time: Duration,
    /// How many draws there were.
    pub draws: usize,
    /// At how many of them the float verdict was not the exact one.
    pub misjudged: usize,
    /// Whether both sides agree at every draw, and on the number of components at the first.
    pub agrees: bool,
    /// The published method of components without rounding, where it may be what makes the
    /// difference and does not take too long.
    pub method: Option<Study>,
}

impl Beside {
    /// Computes it at so many draws of cameras, one at least.
    ///
    /// # Errors
    /// See [`AuditError`].
    pub fn new(
        graph: &Graph,
        exact: &Verdict,
        options: &Options,
        draws: u64,
    ) -> Result<Self, AuditError> {
        let start = Instant::now();
        let outcome = decide(graph, options, 0)?;
        let components = match outcome.verdict {
            FloatVerdict::Solvable => Some(1),
            FloatVerdict::NotSolvable => {
                let found = components::components(graph, options, 0)?;
                Some(components::count(&found))
            }
            FloatVerdict::Undecided => None,
        };
        let time = start.elapsed();
        let first = vec![outcome.eigenvalue];
        let all = [first, study::eigenvalues(graph, options, 1..draws)?].concat();
        let solvable = exact.value != Value::NotFiniteSolvable;
        let right = match solvable {
            true => FloatVerdict::Solvable,
            false => FloatVerdict::NotSolvable,
        };
        let verdicts = all
            .iter()
            .map(|&value| FloatVerdict::by_tolerance(value, options.tolerance));
        let misjudged = verdicts.filter(|&verdict| verdict != right).count();
        let is = exact.components.len();
        // Where only the numbers of components differ, the method may be the reason, not rounding.
        let counts_differ = components.is_some_and(|count| count != is);
        let method = if misjudged == 0 && counts_differ && !solvable {
            published::study(graph, is, options.seed)?
        } else {
            None
        };
        Ok(Self {
            outcome,
            components,
            time,
            draws: all.len(),
            misjudged,
            agrees: misjudged == 0 && components == Some(is),
            method,
        })
    }
}
