//! A question as people put it: fields side by side, which may not go together.
//!
//! In: what a command line or keywords say. Out: a [`Question`], or by name what has no meaning. The
//! rules stand here once, for every front end.

use super::question::{
    Arithmetic, Calibrated, CountSolutions, Known, Method, Projective, ProjectiveBodies, Question,
};
use crate::geometry::model::Model;
use std::error::Error;
use std::fmt;

/// A question whose fields have not been held against each other yet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draft {
    /// What edges carry.
    pub model: Model,
    /// Whether it is decided over the whole graph at once, as the paper does.
    pub whole_graph: bool,
    /// Integers or residues.
    pub arithmetic: Arithmetic,
    /// Whether to look for proofs by counting.
    pub counting: bool,
    /// How much to spend on the number of solutions. Where there is at most one solution, or none is
    /// counted, all but [`CountSolutions::Full`] mean the same.
    pub solutions: CountSolutions,
    /// What is known beside the pairs.
    pub known: Known,
}

/// Why a [`Draft`] is no question.
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

impl Draft {
    /// The usual question of a model.
    pub fn new(model: Model) -> Self {
        Self {
            model,
            whole_graph: false,
            arithmetic: Arithmetic::default(),
            counting: true,
            solutions: CountSolutions::default(),
            known: Known::default(),
        }
    }

    /// The question.
    ///
    /// # Errors
    /// What does not go together.
    pub fn question(self) -> Result<Question, Meaningless> {
        self.check()?;
        Ok(match self.model {
            Model::Projective => Question::Projective(Projective {
                arithmetic: self.arithmetic,
                counting: self.counting,
                method: self.method(|draft| ProjectiveBodies {
                    solutions: draft.solutions,
                    known_parts: draft.known.into_parts(),
                }),
            }),
            Model::Calibrated => Question::Calibrated(Calibrated {
                method: self.method(|draft| draft.known),
            }),
            Model::Affine => Question::Affine(self.method(|draft| draft.known.into_parts())),
        })
    }

    fn check(&self) -> Result<(), Meaningless> {
        let model = self.model;
        let is_projective = model == Model::Projective;
        let rational = self.arithmetic != Arithmetic::Prime;
        let displacements = matches!(self.known, Known::Displacements(_));
        let full = matches!(self.solutions, CountSolutions::Full);
        let wrong = [
            (rational && !is_projective, Meaningless::Rational(model)),
            (
                !self.counting && model == Model::Affine,
                Meaningless::AffineWithoutCounting,
            ),
            (
                displacements && model != Model::Calibrated,
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

    fn method<B>(self, bodies: impl FnOnce(Self) -> B) -> Method<B> {
        if self.whole_graph {
            Method::WholeGraph
        } else {
            Method::Bodies(bodies(self))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Displacements, KnownParts};

    fn draft(model: Model, change: impl FnOnce(&mut Draft)) -> Result<Question, Meaningless> {
        let mut draft = Draft::new(model);
        change(&mut draft);
        draft.question()
    }

    #[test]
    fn what_does_not_go_together_is_refused_by_name() {
        use Model::{Affine, Calibrated, Projective};
        let rational = |draft: &mut Draft| {
            draft.arithmetic = Arithmetic::Rational {
                numerator: 9,
                denominator: 4,
            }
        };
        let parts = Known::Parts(KnownParts::new(4, [vec![0, 1, 2]]).unwrap());
        let displaced = Known::Displacements(Displacements::new(4, [(0, 1)]).unwrap());
        let full = |draft: &mut Draft| draft.solutions = CountSolutions::Full;
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
            assert_eq!(Draft::new(model).question(), Ok(model.into()));
        }
        let displaced = Known::Displacements(Displacements::new(4, [(0, 1)]).unwrap());
        let asked = draft(Model::Calibrated, |draft| draft.known = displaced.clone());
        assert_eq!(asked, Ok(Calibrated::with(displaced).into()));
    }
}
