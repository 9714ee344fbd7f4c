//! Internal to viewcert, and may change at any time.
//!
//! The verdict in floating point, as the paper computes it, to be held against the exact
//! one.
//!
//! Cameras have entries uniform in [0, 1) and Frobenius norm 10, fundamental matrices
//! Frobenius norm 10, as in the authors' published code; the matrix is the augmented
//! Jacobian J of the paper's section 4.1, 10m + n + 15 rows and 12n columns, the frame on
//! a camera of highest degree and its neighbour of highest degree. (The published code
//! adds n - 1 auxiliary unknowns for the rank of the cameras, and halves the rows of the
//! diagonal of S + S^T; the paper's J has neither.) G is called finite solvable if the
//! smallest eigenvalue of J^T J is above a tolerance.
//!
//! [`claims`] of others are decided again, and results [`at_cameras`] that somebody brings, with an [`enclosure`] of
//! the singular value. No float is in any verdict or certificate.

pub mod at_cameras;
pub mod beside;
pub mod cameras;
pub mod claims;
pub mod components;
pub mod dense;
pub mod doubles;
pub mod enclosure;
pub mod jacobian;
pub mod sparse;

use jacobian::{Blocks, Jacobian};
use std::fmt;
use std::str::FromStr;
use viewcert::geometry::draw::DrawError;
use viewcert::geometry::jacobian::{augmented_size, reference};
use viewcert::graph::Graph;

/// The tolerance of the published code, on the smallest eigenvalue of J^T J.
pub const TOLERANCE: f64 = 1e-10;

/// How singular values are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Dense up to [`DENSE_BY_DEFAULT`] entries, sparse above.
    Auto,
    /// All singular values of J as a dense matrix.
    Dense,
    /// All eigenvalues of J^T J, formed as a dense matrix: what the published code hands to
    /// its eigenvalue solver. Rounding in J^T J hides eigenvalues below eps |J|^2.
    Gram,
    /// The smallest ones, by inverse iteration with a sparse Cholesky factor of J^T J.
    Sparse,
}

/// Entries of J up to which the dense method is the default: a second.
pub const DENSE_BY_DEFAULT: usize = 1 << 20;

/// Largest J of the dense method, in entries of 8 bytes: 1 GiB.
pub const MAX_DENSE: usize = 1 << 27;

/// What to compute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Bound on the smallest eigenvalue of J^T J above which G counts as finite solvable.
    pub tolerance: f64,
    /// How.
    pub method: Method,
    /// The seed of the cameras.
    pub seed: u64,
}

/// What floating point says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FloatVerdict {
    /// Finite solvable.
    Solvable,
    /// Not finite solvable.
    NotSolvable,
    /// A value is not a number, or infinite.
    Undecided,
}

impl FloatVerdict {
    /// The verdict by the smallest eigenvalue.
    pub fn by_tolerance(eigenvalue: f64, tolerance: f64) -> Self {
        if !eigenvalue.is_finite() {
            Self::Undecided
        } else if eigenvalue > tolerance {
            Self::Solvable
        } else {
            Self::NotSolvable
        }
    }

    /// The name in JSON output.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solvable => "finite-solvable",
            Self::NotSolvable => "not-finite-solvable",
            Self::Undecided => "undecided",
        }
    }
}

impl fmt::Display for FloatVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Solvable => "finite solvable",
            Self::NotSolvable => "not finite solvable",
            Self::Undecided => "undecided",
        })
    }
}

/// The outcome at one draw of cameras.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// By the tolerance on the smallest eigenvalue.
    pub verdict: FloatVerdict,
    /// The smallest eigenvalue of J^T J: the square of a singular value of J, or computed
    /// from J^T J itself, and then possibly negative by rounding.
    pub eigenvalue: f64,
    /// The rank as MATLAB's `rank` takes it: singular values above
    /// max(rows, columns) eps(sigma_1). Dense method only.
    pub matlab_rank: Option<usize>,
    /// 12n.
    pub columns: usize,
    /// The method that was used, which is not `Auto`.
    pub method: Method,
}

impl Outcome {
    /// The smallest singular value of J, zero for a negative eigenvalue.
    pub fn smallest(&self) -> f64 {
        if self.eigenvalue < 0.0 {
            0.0
        } else {
            self.eigenvalue.sqrt()
        }
    }

    /// By how many decades the eigenvalue lies above (below: negative) the tolerance; minus
    /// infinity for zero and below.
    pub fn margin(&self, tolerance: f64) -> f64 {
        if self.eigenvalue <= 0.0 {
            f64::NEG_INFINITY
        } else {
            (self.eigenvalue / tolerance).log10()
        }
    }

    /// The verdict by MATLAB's rank; `None` where it was not computed.
    pub fn by_rank(&self) -> Option<FloatVerdict> {
        let rank = self.matlab_rank?;
        Some(if !self.eigenvalue.is_finite() {
            FloatVerdict::Undecided
        } else if rank == self.columns {
            FloatVerdict::Solvable
        } else {
            FloatVerdict::NotSolvable
        })
    }
}

/// Why floating point has no answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AuditError {
    /// The graph has no pairs, and so no frame.
    #[error("the graph has no pairs, and J no frame to fix")]
    NoPairs,
    /// J is too large for the dense method.
    #[error(
        "the dense method would need {rows} x {columns} doubles for J alone, {gib} GiB; use --method sparse"
    )]
    TooLarge {
        /// Rows of J.
        rows: usize,
        /// Columns of J.
        columns: usize,
        /// Memory.
        gib: usize,
    },
    /// The dense singular values did not converge.
    #[error("the singular values did not converge, or are not numbers")]
    NoConvergence,
    /// No shift made J^T J positive definite.
    #[error("the sparse Cholesky factor of J^T J failed at every shift")]
    NoFactor,
    /// No cameras can be drawn for the published method without rounding.
    #[error(transparent)]
    Draw(#[from] DrawError),
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A word that is not the name of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the methods are auto, dense, gram and sparse")]
pub struct UnknownMethod;

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        let named = |method: &Self| method.name() == name;
        Self::ALL.into_iter().find(named).ok_or(UnknownMethod)
    }
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 4] = [Self::Auto, Self::Dense, Self::Gram, Self::Sparse];

    /// The name in reports and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Dense => "dense",
            Self::Gram => "gram",
            Self::Sparse => "sparse",
        }
    }

    /// The method to use for a matrix of this size, which is not `Auto`.
    ///
    /// # Errors
    /// The matrix is too large for a dense method, which was asked for.
    fn choose(self, (rows, columns): (usize, usize)) -> Result<Self, AuditError> {
        let entries = rows.saturating_mul(columns);
        match self {
            Self::Auto if entries <= DENSE_BY_DEFAULT => Ok(Self::Dense),
            Self::Auto | Self::Sparse => Ok(Self::Sparse),
            Self::Dense | Self::Gram if entries <= MAX_DENSE => Ok(self),
            Self::Dense | Self::Gram => Err(AuditError::TooLarge {
                rows,
                columns,
                gib: entries.div_ceil(1 << 27),
            }),
        }
    }
}

/// The verdict at one draw.
///
/// # Errors
/// See [`AuditError`].
pub fn decide(graph: &Graph, options: &Options, draw: u64) -> Result<Outcome, AuditError> {
    if graph.edges().is_empty() {
        return Err(AuditError::NoPairs);
    }
    let method = options.method.choose(augmented_size(graph))?;
    let cameras = cameras::draw(graph, options.seed, draw);
    let blocks = Blocks::new(graph, &cameras);
    let j = Jacobian::new(&blocks, reference(graph));
    let columns = 12 * graph.nodes();
    let (eigenvalue, matlab_rank) = match method {
        Method::Gram => (dense::least_eigenvalue(j.dense_gram())?, None),
        Method::Sparse => (sparse::smallest(&j, 1)?.values[0].powi(2), None),
        Method::Auto | Method::Dense => {
            let (values, _) = dense::singular(j.dense(), false)?;
            let rank = dense::matlab_rank(&values, j.size());
            let smallest = values.last().copied().unwrap_or(f64::NAN);
            (smallest * smallest, Some(rank))
        }
    };
    Ok(Outcome {
        verdict: FloatVerdict::by_tolerance(eigenvalue, options.tolerance),
        eigenvalue,
        matlab_rank,
        columns,
        method,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for method in Method::ALL {
            assert_eq!(method.to_string().parse(), Ok(method));
        }
        assert_eq!("Dense".parse::<Method>(), Err(UnknownMethod));
    }

    #[test]
    fn what_is_not_a_number_is_no_verdict() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let verdict = FloatVerdict::by_tolerance(value, TOLERANCE);
            assert_eq!(verdict, FloatVerdict::Undecided);
            let outcome = Outcome {
                verdict,
                eigenvalue: value,
                matlab_rank: Some(12),
                columns: 12,
                method: Method::Dense,
            };
            assert_eq!(outcome.by_rank(), Some(FloatVerdict::Undecided));
        }
        let verdict = |x| FloatVerdict::by_tolerance(x, 1e-10);
        assert_eq!(verdict(2e-10), FloatVerdict::Solvable);
        assert_eq!(verdict(1e-10), FloatVerdict::NotSolvable);
        assert_eq!(verdict(0.0), FloatVerdict::NotSolvable);
    }

    fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
        Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
    }

    /// K4 and the 4-cycle, by both methods: the same smallest singular value up to
    /// rounding, and the right verdicts.
    #[test]
    fn dense_and_sparse_agree() {
        let complete = graph(4, &[(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]);
        let square = graph(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]);
        for seed in 0..5 {
            let outcome = |graph, method| {
                let options = Options {
                    tolerance: TOLERANCE,
                    method,
                    seed,
                };
                decide(graph, &options, 0).unwrap()
            };
            let (dense, sparse) = (
                outcome(&complete, Method::Dense),
                outcome(&complete, Method::Sparse),
            );
            assert_eq!(dense.verdict, FloatVerdict::Solvable);
            assert_eq!(dense.by_rank(), Some(FloatVerdict::Solvable));
            assert!((dense.eigenvalue / sparse.eigenvalue - 1.0).abs() < 1e-6);
            // J^T J loses what is below eps |J|^2, some 1e-11.
            let gram = outcome(&complete, Method::Gram);
            assert_eq!(gram.verdict, FloatVerdict::Solvable);
            assert!((gram.eigenvalue - dense.eigenvalue).abs() < 1e-9);
            let (dense, sparse) = (
                outcome(&square, Method::Dense),
                outcome(&square, Method::Sparse),
            );
            assert_eq!(dense.verdict, FloatVerdict::NotSolvable);
            assert_eq!(dense.matlab_rank, Some(47));
            assert_eq!(sparse.verdict, FloatVerdict::NotSolvable);
            assert!(dense.smallest() < 1e-11 && sparse.smallest() < 1e-11);
            assert!(outcome(&square, Method::Gram).eigenvalue.abs() < 1e-9);
        }
    }

    #[test]
    fn too_large_says_what_it_would_need() {
        let path: Vec<(u32, u32)> = (0..2000).map(|k| (k, k + 1)).collect();
        let options = Options {
            tolerance: TOLERANCE,
            method: Method::Dense,
            seed: 1,
        };
        let error = decide(&graph(2001, &path), &options, 0).unwrap_err();
        // 10 * 2000 + 2001 + 15 rows, 12 * 2001 columns, 8 bytes each: 3.94 GiB.
        let expected = AuditError::TooLarge {
            rows: 22_016,
            columns: 24_012,
            gib: 4,
        };
        assert_eq!(error, expected);
        assert_eq!(
            decide(&graph(2, &[]), &options, 0),
            Err(AuditError::NoPairs)
        );
    }
}
