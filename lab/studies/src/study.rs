//! Many draws: how often a tolerance misjudges.

use crate::dense::{Columns, least_eigenvalue, singular};
use crate::formulation::augmented::augmented_size;
use rayon::prelude::*;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;
use viewcert::graph::Graph;
use viewcert_audit::{AuditError, augmented, smallest};

/// Largest J of the dense methods, in entries of 8 bytes: 1 GiB.
const MAX_DENSE: usize = 1 << 27;

/// How the smallest eigenvalue of J^T J is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// All singular values of J as a dense matrix.
    Dense,
    /// All eigenvalues of J^T J, formed as a dense matrix: what the published code hands to its eigenvalue solver.
    /// Rounding in J^T J hides eigenvalues below eps |J|^2.
    Gram,
    /// The smallest singular value, by inverse iteration, as `verify audit` does.
    Sparse,
}

impl Method {
    const ALL: [Self; 3] = [Self::Dense, Self::Gram, Self::Sparse];
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Dense => "dense",
            Self::Gram => "gram",
            Self::Sparse => "sparse",
        })
    }
}

/// A word that is not the name of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the methods are dense, gram and sparse")]
pub struct UnknownMethod;

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        let named = |method: &Self| method.to_string() == name;
        Self::ALL.into_iter().find(named).ok_or(UnknownMethod)
    }
}

/// Why there are no eigenvalues.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StudyError {
    /// J is too large for the dense methods.
    #[error("the dense methods would need {0} x {1} doubles for J alone; use --method sparse")]
    TooLarge(usize, usize),
    /// Floating point has no answer.
    #[error(transparent)]
    Audit(#[from] AuditError),
}

/// The smallest eigenvalues of J^T J at the given draws.
///
/// # Errors
/// See [`StudyError`].
pub fn eigenvalues(
    graph: &Graph,
    seed: u64,
    method: Method,
    draws: Range<u64>,
) -> Result<Vec<f64>, StudyError> {
    let (rows, columns) = augmented_size(graph);
    if method != Method::Sparse && rows.saturating_mul(columns) > MAX_DENSE {
        return Err(StudyError::TooLarge(rows, columns));
    }
    if graph.edges().is_empty() {
        return Err(AuditError::NoPairs.into());
    }
    let one = |draw| {
        let dense = || {
            let mut dense: Columns = vec![vec![0.0; rows]; columns];
            for (r, row) in augmented(graph, seed, draw).iter().enumerate() {
                row.iter().for_each(|&(column, x)| dense[column][r] = x);
            }
            dense
        };
        Ok(match method {
            Method::Sparse => smallest(graph, seed, draw)?.powi(2),
            Method::Dense => singular(dense(), false)?.0[columns - 1].powi(2),
            Method::Gram => {
                let dense = dense();
                let times = |a: &Vec<f64>, b: &Vec<f64>| a.iter().zip(b).map(|(x, y)| x * y).sum();
                let gram = dense
                    .iter()
                    .map(|a| dense.iter().map(|b| times(a, b)).collect());
                least_eigenvalue(gram.collect())?
            }
        })
    };
    draws.into_par_iter().map(one).collect()
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
