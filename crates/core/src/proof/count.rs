//! What a proof counts in each model: the rank of a body, what joined nodes add, the rows of a pair.

use crate::geometry::jacobian::VECH;
use crate::geometry::model::Model;

impl Model {
    /// How often the rank of a proof goes into that of a verdict, which is four times that of N in
    /// the affine model.
    pub(super) const fn times(self) -> usize {
        match self {
            Self::Projective | Self::Calibrated => 1,
            Self::Affine => 4,
        }
    }

    /// The rank of a body of so many nodes: of J_P, or of N.
    pub(super) const fn full(self, nodes: usize) -> usize {
        self.required(nodes) / self.times()
    }

    /// What a node adds that is joined to none, one or two of those before it.
    pub(super) const fn joined(self) -> [usize; 3] {
        match self {
            Self::Projective => [0, 7, 11],
            Self::Calibrated => [0, 2, 3],
            Self::Affine => [0, 1, 2],
        }
    }

    /// Columns of a node.
    pub(super) const fn width(self) -> usize {
        match self {
            Self::Projective => 12,
            Self::Calibrated => 3,
            Self::Affine => 2,
        }
    }

    /// The rows of a pair, in the order of the bits of a mask: entries of the symmetric 4 x 4 matrix of
    /// an equation of J_P, minors of two displacements in N.
    pub(super) const fn entries(self) -> &'static [(usize, usize)] {
        match self {
            Self::Projective => &VECH,
            Self::Calibrated => &[(0, 1), (0, 2), (1, 2)],
            Self::Affine => &[(0, 1)],
        }
    }
}
