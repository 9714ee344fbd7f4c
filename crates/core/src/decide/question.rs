//! What is asked of a graph, what is known besides it, and by which method it is decided.
//!
//! In: fields side by side, as a command line or keywords say them. Out: by name what does not go
//! together. Only the projective model knows integers and counts solutions, and these only between
//! bodies; displacements belong to calibrated cameras, and the affine model is decided by counting.

use crate::geometry::model::Model;
use crate::graph::{Displacements, KnownParts};
use std::error::Error;
use std::fmt;

/// What is asked of a graph.
///
/// ```
/// use viewcert::{Graph, Model, Options, Question, decide};
///
/// let cycle = Graph::new(4, [(0, 1), (1, 2), (2, 3), (3, 0)])?;
/// let rank = |question: Question| {
///     let verdict = decide(&cycle, &Options::default().question(question))?;
///     Ok::<_, viewcert::VerdictError>(verdict.rank)
/// };
/// assert_eq!(rank(Question::default())?, 28);
/// // The paper's way, and no proof that the rank is not larger.
/// let paper = Question { whole_graph: true, counting: false, ..Question::default() };
/// assert_eq!(rank(paper)?, 28);
/// assert_eq!(rank(Model::Calibrated.into())?, 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    /// What edges carry.
    pub model: Model,
    /// Whether it is decided over the whole graph at once, as the paper does, instead of over rigid
    /// bodies, piece by piece.
    pub whole_graph: bool,
    /// Integers or residues.
    pub arithmetic: Arithmetic,
    /// Whether to look for proofs by counting. In the linear models they are always looked for.
    pub counting: bool,
    /// How much to spend on the number of solutions. Where there is at most one solution, or none is
    /// counted, all but [`CountSolutions::Full`] mean the same.
    pub solutions: CountSolutions,
    /// What is known beside the pairs.
    pub known: Known,
}

/// What is known of cameras beside the pairs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Known {
    /// Sets of nodes whose cameras are known relative to each other (Theorem 4.14); or nothing.
    Parts(KnownParts),
    /// Displacements between cameras (Theorems 13.16 to 13.20).
    Displacements(Displacements),
    /// Displacements in a frame of their own, as of GPS: the rotation of each part against it is unknown
    /// (Theorems 13.29 to 13.31).
    OwnFrame {
        /// These, or positions, which are one group.
        given: Displacements,
        /// Base lines of rigs, which are in the frame of the directions.
        rigs: Displacements,
    },
}

/// The arithmetic of the rank computation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// Residues modulo a prime.
    #[default]
    Prime,
    /// Integers, at cameras with small rational entries. Components and their evidence are found
    /// modulo a prime.
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

/// Why a [`Question`] has no answer: fields that do not go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaningless {
    /// Rational cameras in a model that is decided modulo primes, or by counting.
    Rational(Model),
    /// The affine model without counting, by which alone it is decided.
    AffineWithoutCounting,
    /// Known displacements in a model that has no distances.
    Displacements(Model),
    /// Known parts or displacements, and the matrix of the whole graph, which is that of pairs.
    KnownOverWholeGraph,
    /// Solutions to be counted at any price in a model where there is at most one.
    Solutions(Model),
    /// Solutions to be counted over the whole graph; they are counted between bodies.
    SolutionsOverWholeGraph,
}

impl fmt::Display for Meaningless {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rational(Model::Affine) => {
                f.write_str("rational cameras: the affine model is decided by counting alone")
            }
            Self::Rational(model) => {
                write!(f, "rational cameras: the {model} model is decided modulo primes alone")
            }
            Self::AffineWithoutCounting => {
                f.write_str("without counting: the affine model is decided by counting alone")
            }
            Self::Displacements(model) => write!(
                f,
                "known displacements: the {model} model has no distances; the calibrated one has"
            ),
            Self::KnownOverWholeGraph => f.write_str(
                "what is given is known between bodies, and the matrix of the whole graph has none",
            ),
            Self::Solutions(model) => write!(
                f,
                "full count of solutions: the {model} model has one or infinitely many"
            ),
            Self::SolutionsOverWholeGraph => f.write_str(
                "full count of solutions: they are counted between bodies, and the matrix of the whole \
                 graph has none",
            ),
        }?;
        f.write_str("; leave out one of the two")
    }
}

impl Error for Meaningless {}

impl Question {
    /// In a model, without counting solutions: which graphs are finite solvable.
    pub fn without_solutions(model: Model) -> Self {
        Self {
            solutions: CountSolutions::Off,
            ..model.into()
        }
    }

    /// In the projective model, with so much spent on the number of solutions.
    pub fn with_solutions(solutions: CountSolutions) -> Self {
        Self {
            solutions,
            ..Self::default()
        }
    }

    /// In a model, where sets of nodes are known relative to each other (Theorem 4.14).
    pub fn with_parts(model: Model, known_parts: KnownParts) -> Self {
        Self {
            known: Known::Parts(known_parts),
            ..model.into()
        }
    }

    /// Of calibrated cameras, with what is known.
    pub fn calibrated(known: Known) -> Self {
        Self {
            known,
            ..Model::Calibrated.into()
        }
    }

    /// The question, if its fields go together.
    ///
    /// # Errors
    /// What does not.
    pub fn checked(self) -> Result<Self, Meaningless> {
        self.check().map(|()| self)
    }

    pub(super) fn check(&self) -> Result<(), Meaningless> {
        let model = self.model;
        let is_projective = !model.is_linear();
        let rational = self.arithmetic != Arithmetic::Prime;
        let displacements = !matches!(self.known, Known::Parts(_));
        let full = matches!(self.solutions, CountSolutions::Full);
        let wrong = [
            (rational && !is_projective, Meaningless::Rational(model)),
            (
                !self.counting && model.in_plane(),
                Meaningless::AffineWithoutCounting,
            ),
            (
                displacements && !model.in_space(),
                Meaningless::Displacements(model),
            ),
            (
                self.whole_graph && self.known != Known::default(),
                Meaningless::KnownOverWholeGraph,
            ),
            (full && !is_projective, Meaningless::Solutions(model)),
            (
                full && self.whole_graph,
                Meaningless::SolutionsOverWholeGraph,
            ),
        ];
        match wrong.into_iter().find(|(is_wrong, _)| *is_wrong) {
            Some((_, why)) => Err(why),
            None => Ok(()),
        }
    }
}

/// Nothing is known.
impl Default for Known {
    fn default() -> Self {
        Self::Parts(KnownParts::default())
    }
}

impl Known {
    /// Parts and displacements; one of both is empty.
    pub(super) fn split(self) -> (KnownParts, Displacements) {
        match self {
            Self::Parts(parts) => (parts, Displacements::default()),
            Self::Displacements(known) | Self::OwnFrame { rigs: known, .. } => {
                (KnownParts::default(), known)
            }
        }
    }
}

/// The paper's.
impl Default for Question {
    fn default() -> Self {
        Model::Projective.into()
    }
}

/// The usual question of a model.
impl From<Model> for Question {
    fn from(model: Model) -> Self {
        Self {
            model,
            whole_graph: false,
            arithmetic: Arithmetic::default(),
            counting: true,
            solutions: CountSolutions::default(),
            known: Known::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Displacements, KnownParts};

    fn draft(model: Model, change: impl FnOnce(&mut Question)) -> Result<Question, Meaningless> {
        let mut asked = Question::from(model);
        change(&mut asked);
        asked.checked()
    }

    #[test]
    fn what_does_not_go_together_is_refused_by_name() {
        use Model::{Affine, Calibrated, Projective};
        let rational = |draft: &mut Question| {
            draft.arithmetic = Arithmetic::Rational {
                numerator: 9,
                denominator: 4,
            }
        };
        let parts = Known::Parts(KnownParts::new(4, [vec![0, 1, 2]]).unwrap());
        let displaced = Known::Displacements(Displacements::new(4, [(0, 1)]).unwrap());
        let full = |draft: &mut Question| draft.solutions = CountSolutions::Full;
        let refused = [
            (
                draft(Calibrated, rational),
                Meaningless::Rational(Calibrated),
            ),
            (draft(Affine, rational), Meaningless::Rational(Affine)),
            (
                draft(Affine, |draft| draft.counting = false),
                Meaningless::AffineWithoutCounting,
            ),
            (
                draft(Projective, |draft| draft.known = displaced.clone()),
                Meaningless::Displacements(Projective),
            ),
            (
                draft(Calibrated, |draft| {
                    draft.known = displaced.clone();
                    draft.whole_graph = true;
                }),
                Meaningless::KnownOverWholeGraph,
            ),
            (
                draft(Affine, |draft| {
                    draft.known = parts.clone();
                    draft.whole_graph = true;
                }),
                Meaningless::KnownOverWholeGraph,
            ),
            (draft(Calibrated, full), Meaningless::Solutions(Calibrated)),
            (
                draft(Projective, |draft| {
                    full(draft);
                    draft.whole_graph = true;
                }),
                Meaningless::SolutionsOverWholeGraph,
            ),
        ];
        for (found, expected) in refused {
            assert_eq!(found, Err(expected));
            assert!(expected.to_string().contains("leave out"));
        }
    }

    #[test]
    fn what_goes_together_is_asked() {
        for model in [Model::Projective, Model::Calibrated, Model::Affine] {
            assert_eq!(Question::from(model).checked(), Ok(model.into()));
        }
        let displaced = Known::Displacements(Displacements::new(4, [(0, 1)]).unwrap());
        let asked = draft(Model::Calibrated, |draft| draft.known = displaced.clone());
        assert_eq!(asked, Ok(Question::calibrated(displaced)));
    }
}
