//! A question, and what it is decided with: primes, draws, and who may stop it.

use crate::decide::question::{Known, Question};
use crate::geometry::model::Model;
use crate::graph::Displacements;
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

/// What is asked of a graph, and how its cameras are drawn. Start from the default, and say what is to
/// be different:
///
/// ```
/// use viewcert::{Model, Options};
///
/// let options = Options::default().model(Model::Calibrated).seed(7);
/// assert_eq!((options.question.model, options.seed), (Model::Calibrated, 7));
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options {
    /// What is asked.
    pub question: Question,
    /// The primes of the residues.
    pub prime: Prime,
    /// The seed of all draws.
    pub seed: u64,
    /// Who is told what is being done, and may stop it.
    pub watch: Watch,
}

impl Options {
    /// Asks another question: one in full, or the usual one of a model.
    #[must_use]
    pub fn question(mut self, question: impl Into<Question>) -> Self {
        self.question = question.into();
        self
    }

    /// Asks the usual question of another model.
    #[must_use]
    pub fn model(self, model: Model) -> Self {
        self.question(model)
    }

    /// Asks of calibrated cameras some of whose displacements are known (Theorems 13.16 to 13.20).
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
    pub fn displacements(self, known: Displacements) -> Self {
        self.question(Question::calibrated(Known::Displacements(known)))
    }

    /// Takes other primes.
    #[must_use]
    pub fn prime(mut self, prime: Prime) -> Self {
        self.prime = prime;
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
            question: Question::default(),
            prime: Prime::default(),
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
