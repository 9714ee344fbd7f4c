//! What is asked of a graph, and how the answer is looked for.

use crate::geometry::model::Model;
use crate::linalg::prime::{PrimeField, SMALL_PRIME};
use crate::watch::Watch;

/// How the question is decided.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which question.
    pub model: Model,
    /// Integers or residues.
    pub arithmetic: Arithmetic,
    /// The prime of the residues (in rational mode, of components and their evidence).
    pub field: PrimeField,
    /// Cores with so many nodes or more are decided modulo [`SMALL_PRIME`] instead, where
    /// elimination is several times as fast. What it proves is as strong; a draw falls
    /// short of the generic rank with probability below 22 nodes / 2^29 (Schwartz and Zippel), and
    /// costs another one then.
    pub small_prime_from: usize,
    /// Whether to contract to bodies first, and to decide piece by piece.
    pub contraction: bool,
    /// Whether to look for proofs by counting.
    pub counting: bool,
    /// The seed of all draws.
    pub seed: u64,
    /// Who is told what is being done, and may stop it.
    pub watch: Watch,
}

/// From so many nodes on elimination is most of the work on a core.
const LARGE_CORE: usize = 256;

impl Options {
    /// Asks another question.
    #[must_use]
    pub fn model(mut self, model: Model) -> Self {
        self.model = model;
        self
    }

    /// Draws other cameras.
    #[must_use]
    pub fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Tells somebody what is being done, who may stop it.
    #[must_use]
    pub fn watch(mut self, watch: Watch) -> Self {
        self.watch = watch;
        self
    }

    /// The field in which a core with so many nodes is decided.
    pub(super) fn field_for(&self, nodes: usize) -> PrimeField {
        if nodes < self.small_prime_from {
            self.field
        } else {
            PrimeField::new(SMALL_PRIME).expect("a prime")
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            model: Model::Projective,
            arithmetic: Arithmetic::Prime,
            field: PrimeField::mersenne61(),
            small_prime_from: LARGE_CORE,
            contraction: true,
            counting: true,
            seed: 1,
            watch: Watch::default(),
        }
    }
}

/// The arithmetic of the rank computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// Residues modulo a prime.
    Prime,
    /// Integers, at cameras with small rational entries.
    Rational {
        /// Largest absolute value of a numerator.
        numerator: u64,
        /// Largest denominator.
        denominator: u64,
    },
}
