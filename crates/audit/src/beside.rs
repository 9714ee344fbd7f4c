//! Floating point beside an exact verdict.
//!
//! In: a graph and its verdict. Out: what floating point says at so many draws of cameras, and how often that is
//! wrong.

use super::{AuditError, FloatVerdict, Options, Outcome, components, decide};
use rayon::prelude::*;
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
        let more = (1..draws).into_par_iter();
        let more = more.map(|draw| Ok(decide(graph, options, draw)?.verdict));
        let mut verdicts = more.collect::<Result<Vec<_>, AuditError>>()?;
        verdicts.push(outcome.verdict);
        let right = match exact.value {
            Value::NotFiniteSolvable => FloatVerdict::NotSolvable,
            _ => FloatVerdict::Solvable,
        };
        let misjudged = verdicts.iter().filter(|&&verdict| verdict != right).count();
        let is = exact.components.len();
        Ok(Self {
            outcome,
            components,
            time,
            draws: verdicts.len(),
            misjudged,
            agrees: misjudged == 0 && components == Some(is),
        })
    }
}
