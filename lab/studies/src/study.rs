//! Many draws: how often a tolerance misjudges.

use rayon::prelude::*;
use std::ops::Range;
use viewcert::graph::Graph;
use viewcert_audit::{AuditError, Options, decide};

/// The smallest eigenvalues of J^T J at the given draws.
///
/// # Errors
/// See [`AuditError`].
pub fn eigenvalues(
    graph: &Graph,
    options: &Options,
    draws: Range<u64>,
) -> Result<Vec<f64>, AuditError> {
    draws
        .into_par_iter()
        .map(|draw| Ok(decide(graph, options, draw)?.eigenvalue))
        .collect()
}

/// Eigenvalues of graphs whose exact verdict is known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Populations {
    /// Of graphs that are finite solvable.
    pub solvable: Vec<f64>,
    /// Of graphs that are not.
    pub not_solvable: Vec<f64>,
    /// How many values were not numbers, or infinite.
    pub undecided: usize,
}

/// The errors at one tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// The tolerance.
    pub tolerance: f64,
    /// Draws of graphs that are not finite solvable, called solvable.
    pub false_solvable: usize,
    /// Draws of finite solvable graphs, called not solvable.
    pub false_not_solvable: usize,
}

impl Populations {
    /// Adds the eigenvalues of a graph.
    pub fn add(&mut self, solvable: bool, values: &[f64]) {
        let (numbers, others): (Vec<f64>, Vec<f64>) =
            values.iter().partition(|value| value.is_finite());
        self.undecided += others.len();
        if solvable {
            self.solvable.extend(numbers);
        } else {
            self.not_solvable.extend(numbers);
        }
    }

    /// The errors at one tolerance.
    pub fn errors(&self, tolerance: f64) -> Errors {
        let above = |values: &[f64]| values.iter().filter(|&&x| x > tolerance).count();
        Errors {
            tolerance,
            false_solvable: above(&self.not_solvable),
            false_not_solvable: self.solvable.len() - above(&self.solvable),
        }
    }

    /// The errors at tolerances from 1e-36 to 1e4, four a decade.
    pub fn sweep(&self) -> Vec<Errors> {
        (-144..=16)
            .map(|quarter| self.errors(10f64.powf(f64::from(quarter) / 4.0)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_by_hand() {
        let mut populations = Populations::default();
        populations.add(true, &[1.0, 1e-12, f64::NAN]);
        populations.add(false, &[1e-20, 1e-9, f64::INFINITY]);
        assert_eq!(populations.undecided, 2);
        let expected = Errors {
            tolerance: 1e-10,
            false_solvable: 1,
            false_not_solvable: 1,
        };
        assert_eq!(populations.errors(1e-10), expected);
        let sweep = populations.sweep();
        assert_eq!(sweep.len(), 161);
        assert_eq!(
            (sweep[0].false_solvable, sweep[0].false_not_solvable),
            (2, 0)
        );
        assert_eq!(
            (sweep[160].false_solvable, sweep[160].false_not_solvable),
            (0, 2)
        );
    }
}
