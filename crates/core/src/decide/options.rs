//! What is asked of a graph, and how the answer is looked for.

use crate::geometry::model::Model;
use crate::graph::{Displacements, KnownParts};
use crate::linalg::prime::{PrimeField, SMALL_PRIME};
use crate::watch::Watch;

/// From so many nodes on elimination is most of the work on a core.
const LARGE_CORE: usize = 256;

/// The primes of the residues.
#[derive(Clone, Copy, Debug, Default)]
pub enum Prime {
    /// 2^61 - 1, and for large cores 2^29 - 3, where elimination is several times as fast. What
    /// it proves is as strong; a draw falls short of the generic rank with probability below
    /// 22 nodes / 2^29 (Schwartz and Zippel), and costs another one then.
    #[default]
    Auto,
    /// This one, whatever the size.
    Fixed(PrimeField),
}

impl Prime {
    /// The field in which a core with so many nodes is decided.
    pub(super) fn for_core(self, nodes: usize) -> PrimeField {
        match self {
            Self::Auto if nodes >= LARGE_CORE => PrimeField::new(SMALL_PRIME).expect("a prime"),
            _ => self.for_whole_matrix(),
        }
    }

    /// The field of the paper's own matrix, whose elimination stays sparse for longer.
    pub(super) fn for_whole_matrix(self) -> PrimeField {
        match self {
            Self::Auto => PrimeField::mersenne61(),
            Self::Fixed(field) => field,
        }
    }
}

/// The arithmetic of the rank computation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// Residues modulo a prime.
    #[default]
    Prime,
    /// Integers, at cameras with small rational entries.
    Rational {
        /// Largest absolute value of a numerator.
        numerator: u64,
        /// Largest denominator.
        denominator: u64,
    },
}

/// How much is spent on the number of solutions of a graph that is finite solvable in the projective
/// model and no single body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CountSolutions {
    /// Nothing: for many graphs of which only 'finite or not' is asked.
    Off,
    /// Solutions are counted where it takes some milliseconds, and about a second at most: where the
    /// members of the graph share few nodes. The others stay finite solvable.
    #[default]
    Quick,
    /// Solutions are counted whatever it takes: minutes, where many nodes are shared. They are
    /// counted between unique members, so large cores are decided without bodies by rank.
    Full,
}

/// How the question is decided. Start from the default, and say what is to be different:
///
/// ```
/// use viewcert::{Model, Options};
///
/// let options = Options::default().model(Model::Calibrated).seed(7);
/// assert_eq!((options.model, options.seed), (Model::Calibrated, 7));
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options {
    /// Which question.
    pub model: Model,
    /// Integers or residues.
    pub arithmetic: Arithmetic,
    /// The primes of the residues (in rational mode, of components and their evidence).
    pub prime: Prime,
    /// Whether to contract to bodies first, and to decide piece by piece.
    pub contraction: bool,
    /// Whether to look for proofs by counting.
    pub counting: bool,
    /// How much to spend on the number of solutions. Without contraction they are not counted.
    pub solutions: CountSolutions,
    /// Sets of nodes whose cameras are known relative to each other.
    pub known_parts: KnownParts,
    /// Cameras whose displacements are known, calibrated ones.
    pub displacements: Displacements,
    /// The seed of all draws.
    pub seed: u64,
    /// Who is told what is being done, and may stop it.
    pub watch: Watch,
}

impl Options {
    /// Asks another question.
    #[must_use]
    pub fn model(mut self, model: Model) -> Self {
        self.model = model;
        self
    }

    /// Takes other arithmetic.
    #[must_use]
    pub fn arithmetic(mut self, arithmetic: Arithmetic) -> Self {
        self.arithmetic = arithmetic;
        self
    }

    /// Takes other primes.
    #[must_use]
    pub fn prime(mut self, prime: Prime) -> Self {
        self.prime = prime;
        self
    }

    /// Contracts to bodies first, or not.
    #[must_use]
    pub fn contraction(mut self, contraction: bool) -> Self {
        self.contraction = contraction;
        self
    }

    /// Looks for proofs by counting, or not.
    #[must_use]
    pub fn counting(mut self, counting: bool) -> Self {
        self.counting = counting;
        self
    }

    /// Spends more or less on the number of solutions.
    #[must_use]
    pub fn solutions(mut self, solutions: CountSolutions) -> Self {
        self.solutions = solutions;
        self
    }

    /// Takes sets of nodes for known relative to each other, in any model (Theorem 4.14).
    #[must_use]
    pub fn known_parts(mut self, parts: KnownParts) -> Self {
        self.known_parts = parts;
        self
    }

    /// Takes displacements for known, in the calibrated model (Theorems 13.16 to 13.20).
    ///
    /// ```
    /// use viewcert::graph::Displacements;
    /// use viewcert::{Graph, Model, Options, Value, decide};
    ///
    /// // Two stereo rigs, and three pairs from one to the other.
    /// let graph = Graph::new(4, [(0, 2), (0, 3), (1, 2)])?;
    /// let rigs = Displacements::new(4, [(0, 1), (2, 3)])?;
    /// let options = Options::default().model(Model::Calibrated);
    /// assert_eq!(decide(&graph, &options)?.value, Value::NotFiniteSolvable);
    /// let verdict = decide(&graph, &options.displacements(rigs))?;
    /// assert_eq!((verdict.value, verdict.required), (Value::Solvable, 9));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn displacements(mut self, known: Displacements) -> Self {
        self.displacements = known;
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
}

impl Default for Options {
    fn default() -> Self {
        Self {
            model: Model::default(),
            arithmetic: Arithmetic::default(),
            prime: Prime::default(),
            contraction: true,
            counting: true,
            solutions: CountSolutions::default(),
            known_parts: KnownParts::default(),
            displacements: Displacements::default(),
            seed: 1,
            watch: Watch::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_cores_take_the_small_prime_unless_told_otherwise() {
        let modulus = |prime: Prime, nodes| prime.for_core(nodes).modulus();
        assert_eq!(modulus(Prime::Auto, 255), (1 << 61) - 1);
        assert_eq!(modulus(Prime::Auto, 256), (1 << 29) - 3);
        let fixed = Prime::Fixed(PrimeField::new(101).unwrap());
        assert_eq!([255, 256].map(|nodes| modulus(fixed, nodes)), [101, 101]);
        assert_eq!(Prime::Auto.for_whole_matrix().modulus(), (1 << 61) - 1);
    }
}
