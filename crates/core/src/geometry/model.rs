//! Which question is asked of a viewing graph.

/// What is known of the cameras besides the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Model {
    /// Nothing: edges carry fundamental matrices (the paper).
    #[default]
    Projective,
    /// The intrinsics: edges carry essential matrices, rotations follow, and what is
    /// left is parallel rigidity of the centres in space (docs/theory.md, section 5).
    Calibrated,
}

impl Model {
    /// The rank of a solvable graph (or body) with n >= 2 nodes: 11 n - 15 of J_P, in
    /// the calibrated model 3 n - 4 of N. A single node is solvable without any.
    pub fn required(self, n: usize) -> usize {
        match self {
            _ if n < 2 => 0,
            Self::Projective => 11 * n - 15,
            Self::Calibrated => 3 * n - 4,
        }
    }

    /// The name in certificates and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Projective => "projective",
            Self::Calibrated => "calibrated",
        }
    }
}
