//! The kinds of evidence that a verdict rests on: the data of docs/certificate.md,
//! section 7, as the pipeline finds them.

use crate::contract::piece::Members;
use crate::decide::claim::Strength;
use crate::geometry::model::full_rank;
use crate::geometry::plane_flow::PlaneFlowRank;
use crate::linalg::integer::Integer;
use crate::linalg::textbook::Pivots;

/// Where the cameras of a piece of evidence come from: a prime and a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModularDraw {
    /// The prime.
    pub prime: u64,
    /// The seed.
    pub seed: u64,
    /// The draw number.
    pub draw: u64,
}

/// One piece of evidence about a piece, or a part of one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// A minor of J_P modulo p at general cameras that is not zero.
    Minor {
        /// The cameras.
        draw: ModularDraw,
        /// Rows and columns.
        pivots: Pivots,
    },
    /// A minor of J_P over the integers, with its determinant.
    IntegerMinor(IntegerMinor),
    /// Pivots of N and of Lambda modulo p.
    PlaneFlow {
        /// The centres.
        draw: ModularDraw,
        /// The pivots.
        rank: PlaneFlowRank,
    },
    /// Pivots of R modulo p (affine model).
    PlaneMinor {
        /// The points.
        draw: ModularDraw,
        /// Rows and columns.
        pivots: Pivots,
    },
    /// The graph has one solution, which its number of solutions shows (docs/certificate.md, section 7).
    OneSolution,
    /// An upper bound.
    Counting(Counting),
    /// The rank at draws that nobody can choose.
    Draws(Draws),
    /// The motion classes, which the components refine.
    Classes(Vec<Class>),
    /// A kernel vector that tells the classes apart.
    Kernel {
        /// The centres.
        draw: ModularDraw,
        /// Entry `12 v + 3 c + r` (calibrated: `3 v + r`, affine: `2 v + r`), residues.
        vector: Vec<u64>,
    },
}

impl Evidence {
    /// Whether it bounds a rank from below, at one point.
    pub(crate) fn is_lower_bound(&self) -> bool {
        match self {
            Self::Minor { .. }
            | Self::IntegerMinor(_)
            | Self::PlaneFlow { .. }
            | Self::PlaneMinor { .. } => true,
            Self::OneSolution
            | Self::Counting(_)
            | Self::Draws(_)
            | Self::Classes(_)
            | Self::Kernel { .. } => false,
        }
    }

    /// The prime of its residues, of several the smallest.
    fn prime(&self) -> Option<u64> {
        match self {
            Self::Minor { draw, .. }
            | Self::PlaneFlow { draw, .. }
            | Self::PlaneMinor { draw, .. }
            | Self::Kernel { draw, .. } => Some(draw.prime),
            Self::IntegerMinor(minor) => match minor.witness {
                Witness::Prime(prime) => Some(prime),
                Witness::Determinant(_) => None,
            },
            Self::Classes(classes) => {
                let of_class = |class: &Class| match &class.kind {
                    ClassKind::Rigid(evidence) => smallest_prime(evidence),
                    _ => class.pieces().iter().filter_map(PieceVerdict::prime).min(),
                };
                classes.iter().filter_map(of_class).min()
            }
            Self::OneSolution | Self::Counting(_) | Self::Draws(_) => None,
        }
    }
}

/// The smallest prime of residues in some evidence.
pub(super) fn smallest_prime(evidence: &[Evidence]) -> Option<u64> {
    evidence.iter().filter_map(Evidence::prime).min()
}

/// A partition of a piece's members and the bound on its rank that counting gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counting {
    /// The blocks, in the order of their first members.
    pub blocks: Vec<Block>,
    /// The bound: the sum of what the blocks contribute.
    pub bound: usize,
}

/// A block of a partition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// What is in the block.
    pub members: Members,
    /// The hub at which it loses rank (Theorem 5.2).
    pub hub: Option<Hub>,
}

/// A node at which a block loses rank. With every part of `split` given its own copy of
/// the node, kappa the number of connected components of what results, and s the sum
/// over the groups of 3 n_g - 4 less 3 n_B - 4, it loses at least
/// |split| - (kappa - 1) - 3 s.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hub {
    /// The node.
    pub node: u32,
    /// A partition of the block's members.
    pub parts: Vec<Members>,
    /// The parts, increasing, that get their own copy of the node.
    pub split: Vec<u32>,
    /// A partition of the parts, for the bound on the rank of N of the split graph.
    pub groups: Vec<Vec<u32>>,
    /// kappa; the node counts as a component if no part outside `split` contains it.
    pub components: usize,
    /// What the block loses, at least 1.
    pub less: usize,
}

/// A motion class of a piece: members that no motion of the piece tells apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Class {
    /// What is in the class.
    pub members: Members,
    /// How its components are known.
    pub kind: ClassKind,
}

impl Class {
    /// The components in it.
    pub fn components(&self) -> Vec<Members> {
        match &self.kind {
            ClassKind::Single | ClassKind::Rigid(_) => vec![self.members.clone()],
            ClassKind::Loose { rigid, pieces } => {
                let inner = pieces.iter().flat_map(|piece| piece.components.clone());
                rigid.singles().into_iter().chain(inner).collect()
            }
        }
    }

    /// The pieces it is cut into, if it is not a component itself.
    pub fn pieces(&self) -> &[PieceVerdict] {
        self.split().map_or(&[], |(_, pieces)| pieces)
    }

    /// What it is cut into, if it is not a component itself.
    pub(crate) fn split(&self) -> Option<(&Members, &[PieceVerdict])> {
        match &self.kind {
            ClassKind::Loose { rigid, pieces } => Some((rigid, pieces)),
            _ => None,
        }
    }

    /// Why it is rigid by itself, if it is, and no single member.
    pub(crate) fn evidence(&self) -> &[Evidence] {
        match &self.kind {
            ClassKind::Rigid(evidence) => evidence,
            _ => &[],
        }
    }
}

/// How the components of a motion class are known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ClassKind {
    /// It is a single member, and a component.
    Single,
    /// It reaches full rank by itself, by this evidence, and is a component.
    Rigid(Vec<Evidence>),
    /// It is held together by the rest of the piece only: taken by itself it is cut
    /// into pieces, and these have the components.
    Loose {
        /// Members that are pieces, and components, by themselves.
        rigid: Members,
        /// The other pieces.
        pieces: Vec<PieceVerdict>,
    },
}

/// A piece and what was found out about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PieceVerdict {
    /// The piece.
    pub members: Members,
    /// Its components, one or more.
    pub components: Vec<Members>,
    /// What the claims rest on.
    pub evidence: Vec<Evidence>,
    /// Lower bound on the rank of the piece.
    pub lower: usize,
    /// Upper bound by counting.
    pub upper: usize,
    /// Strength of `lower` being the rank.
    pub rank_strength: Strength,
    /// Strength of the components being maximal.
    pub components_strength: Strength,
}

impl PieceVerdict {
    /// A piece with all nodes of a graph that has one solution.
    pub(super) fn of_one_solution(members: Members, rank: usize) -> Self {
        Self {
            components: vec![members.clone()],
            members,
            evidence: vec![Evidence::OneSolution],
            lower: rank,
            upper: rank,
            rank_strength: Strength::Proof,
            components_strength: Strength::Proof,
        }
    }

    /// The smallest prime of residues that it rests on.
    pub(super) fn prime(&self) -> Option<u64> {
        smallest_prime(&self.evidence)
    }
}

/// A non-zero minor of the integer J_P, whose rows are divided by their content.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IntegerMinor {
    /// Numerators of the cameras' entries lie in -numerator..=numerator.
    pub numerator: u64,
    /// Denominators lie in 1..=denominator.
    pub denominator: u64,
    /// The seed.
    pub seed: u64,
    /// The draw number.
    pub draw: u64,
    /// Rows and columns.
    pub pivots: Pivots,
    /// Why the minor is not zero.
    pub witness: Witness,
    /// Kernel vectors that are independent modulo the trivial ones, as many as there are.
    pub kernel: Vec<Vec<Integer>>,
}

/// Why an integer minor is not zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Witness {
    /// Its determinant, rows and columns in the order of the pivots.
    Determinant(Integer),
    /// A prime modulo which it is not zero.
    Prime(u64),
}

/// The rank at random cameras modulo random primes, with the error bound of
/// docs/theory.md, section 7.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draws {
    /// The seed.
    pub seed: u64,
    /// How many draws.
    pub count: u64,
    /// The largest rank of the core that occurred.
    pub rank: usize,
}

impl Draws {
    /// How many draws make the error at most 2^-120 for a core with `nodes` nodes, and the
    /// exponent of the error bound they reach; `None` for a core too large for the bound
    /// (2^32 nodes and more).
    pub(crate) fn plan(nodes: usize) -> Option<(u64, i64)> {
        let size = full_rank(nodes).checked_ilog2()? + 1;
        let each = 56u64.checked_sub(size.into()).filter(|&each| each >= 20)?;
        let count = 120u64.div_ceil(each);
        Some((count, -((count * each) as i64)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 11 * 9 - 15 = 84 has 7 bits, so that a draw gives 2^-(56 - 7), and three give 2^-147. A
    /// core with 2^33 nodes has a rank of 37 bits, which leaves 19 a draw: too few.
    #[test]
    fn draws_are_planned_by_the_size_of_the_core() {
        assert_eq!(Draws::plan(9), Some((3, -147)));
        // 11 * 1000 - 15 = 10985 has 14 bits.
        assert_eq!(Draws::plan(1000), Some((3, -126)));
        // 11 * 10^6 - 15 has 24 bits: 32 a draw.
        assert_eq!(Draws::plan(1_000_000), Some((4, -128)));
        assert_eq!(Draws::plan(1 << 33), None);
    }
}
