//! Which question is asked of a viewing graph.

use crate::named::named;

/// What is known of the cameras besides the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Model {
    /// Nothing: edges carry fundamental matrices (the paper).
    #[default]
    Projective,
    /// The intrinsics: edges carry essential matrices, rotations follow, and what is
    /// left is parallel rigidity of the centres in space (docs/theory.md, section 5).
    Calibrated,
    /// The cameras are affine: edges carry affine fundamental matrices, and what is left is
    /// rigidity in the plane (docs/theory.md, section 13).
    Affine,
}

/// The rank of J_P for a finite solvable graph with n >= 2 nodes (Theorem 1.3 of docs/theory.md).
pub const fn full_rank(n: usize) -> usize {
    Model::Projective.required(n)
}

impl Model {
    /// Whether its equations are linear, so that finitely many solutions are one.
    pub const fn is_linear(self) -> bool {
        !matches!(self, Self::Projective)
    }

    /// Whether it is rigidity in space.
    pub const fn in_space(self) -> bool {
        matches!(self, Self::Calibrated)
    }

    /// Whether it is rigidity in the plane.
    pub const fn in_plane(self) -> bool {
        matches!(self, Self::Affine)
    }

    /// The rank of a finite solvable graph, or of a body, with n >= 2 nodes: 11 n - 15 of J_P
    /// (Theorem 1.3 of docs/theory.md; Theorem 1 of the paper), in the calibrated model
    /// 3 n - 4 of N (Lemma 4.8), in the affine model 8 n - 12, four times that of R (Theorem
    /// 13.2). One camera leaves nothing to determine: 0.
    pub const fn required(self, n: usize) -> usize {
        match self {
            Self::Projective => (11 * n).saturating_sub(15),
            Self::Calibrated => (3 * n).saturating_sub(4),
            Self::Affine => (8 * n).saturating_sub(12),
        }
    }
}

named! {
    Model {
        Projective = "projective",
        Calibrated = "calibrated",
        Affine = "affine",
    }
    UnknownModel = "the models are projective, calibrated and affine"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_as_they_are_written() {
        for model in Model::ALL {
            assert_eq!(model.to_string().parse(), Ok(model));
        }
        assert_eq!("Projective".parse::<Model>(), Err(UnknownModel));
    }

    /// A pair has a fundamental matrix with 7 and a bearing with 2 degrees of freedom; an affine
    /// fundamental matrix has 4.
    #[test]
    fn required_ranks_of_small_graphs() {
        let ranks = |n| Model::ALL.map(|model| model.required(n));
        assert_eq!([1, 2, 3].map(ranks), [[0, 0, 0], [7, 2, 4], [18, 5, 12]]);
    }
}
