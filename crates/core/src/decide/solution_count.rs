//! The number of solutions, as part of a verdict (docs/theory.md, section 10).
//!
//! In: a graph or component that is finite solvable, as bodies and edges. Out: how many solutions there are at
//! least and at most, with the evidence. A body and the calibrated model have one (Corollary 4.2,
//! Theorem 4.8); what is left is counted by [`mod@crate::solutions`].

use crate::decide::claim::Strength;
use crate::decide::question::CountSolutions;
use crate::decide::rounds::Rounds;
use crate::graph::Graph;
use crate::solutions::{Solutions, count_in};
use crate::watch::{Stopped, Task};
use crate::wording::counted;
use std::fmt;
use std::sync::Arc;

/// What is known of the number of solutions of a finite solvable graph: of the classes of cameras
/// with its fundamental matrices, at generic cameras and over the complex numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SolutionCount {
    /// There are as many at least; the cameras themselves are one.
    pub at_least: usize,
    /// There are no more than that, if such a bound is known.
    pub at_most: Option<usize>,
    /// Whether a quick count left the number open, and a full one looks at more.
    pub full_may_tell_more: bool,
    /// Rounds of removing nodes, where they show that there is one solution, or what is counted goes
    /// on from them.
    pub rounds: Option<Arc<Rounds>>,
    /// What the bounds rest on, where contraction, rounds and the model alone do not show them.
    pub evidence: Option<Arc<Solutions>>,
}

impl SolutionCount {
    /// One solution, by contraction or by the model.
    pub(super) fn one() -> Self {
        Self {
            at_least: 1,
            at_most: Some(1),
            full_may_tell_more: false,
            rounds: None,
            evidence: None,
        }
    }

    /// One solution, as rounds leave one member.
    pub(super) fn by_rounds(rounds: Rounds) -> Self {
        Self {
            rounds: Some(Arc::new(rounds)),
            ..Self::one()
        }
    }

    /// Goes on from rounds: one solution, or a number that stays open.
    ///
    /// # Errors
    /// If the work is stopped.
    pub(super) fn after(
        rounds: Rounds,
        graph: &Graph,
        effort: CountSolutions,
        seed: u64,
        task: &Task<'_>,
    ) -> Result<Option<Self>, Stopped> {
        let left = rounds.left.iter().cloned();
        let found = Self::of(graph, left.collect(), effort, seed, task)?;
        let is_open = found.at_most.is_none() && found.at_least == 1;
        Ok(if found.is_one() {
            Some(Self {
                rounds: Some(Arc::new(rounds)),
                ..found
            })
        } else {
            // Of what is left less is unknown than at first.
            is_open.then_some(Self {
                evidence: None,
                ..found
            })
        })
    }

    /// Counts the solutions of a part of a graph that is finite solvable, in the projective model, or
    /// says that one there is.
    ///
    /// # Errors
    /// If the work is stopped.
    pub(super) fn of(
        graph: &Graph,
        members: Vec<Vec<u32>>,
        effort: CountSolutions,
        seed: u64,
        task: &Task<'_>,
    ) -> Result<Self, Stopped> {
        let (found, left_out) = match effort {
            CountSolutions::Off => (None, false),
            CountSolutions::Quick => count_in(graph, members, true, seed, task)?,
            CountSolutions::Full => count_in(graph, members, false, seed, task)?,
        };
        Ok(Self {
            at_least: found.as_ref().map_or(1, |found| found.at_least),
            at_most: found.as_ref().and_then(|found| found.at_most),
            full_may_tell_more: left_out,
            rounds: None,
            evidence: found.map(Arc::new),
        })
    }

    /// The number of solutions, if it is known.
    pub fn exactly(&self) -> Option<usize> {
        self.at_most.filter(|&most| most == self.at_least)
    }

    /// Whether there is just one solution.
    pub fn is_one(&self) -> bool {
        self.at_most == Some(1)
    }

    /// Why there is one solution, in words, where rounds show it.
    pub fn because(&self) -> Option<String> {
        let rounds = self.rounds.as_ref()?;
        let (mut removed, mut of) = (0, 0);
        for [some, all] in &rounds.removed {
            removed += some;
            of += all;
        }
        let percent = (100 * removed).div_ceil(of.max(1));
        let times = |times: usize, of: String| match times {
            0 => None,
            1 => Some(format!("1 round of {of}")),
            _ => Some(format!("{times} rounds of {of}")),
        };
        let why = [
            times(rounds.removed.len(), format!("removing {percent} %")),
            times(rounds.stressed, "stresses".into()),
            self.evidence
                .as_ref()
                .map(|_| "the scales of what is left have one solution".into()),
        ];
        let why: Vec<String> = why.into_iter().flatten().collect();
        Some(format!("unique: {}", why.join("; ")))
    }

    /// How strong both bounds are: they are proofs, whatever was drawn.
    pub fn strength(&self) -> Strength {
        Strength::Proof
    }
}

/// "exactly 2 solutions", "at least 2 and at most 4 solutions"; what is said of the number where
/// nothing but its finiteness is known is "finitely many solutions".
impl fmt::Display for SolutionCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let solutions = |number| counted(number, "solution");
        match (self.at_least, self.at_most) {
            (least, Some(most)) if least == most => write!(f, "exactly {}", solutions(least)),
            (1, None) => f.write_str("finitely many solutions"),
            (least, None) => write!(f, "at least {}", solutions(least)),
            (1, Some(most)) => write!(f, "at most {}", solutions(most)),
            (least, Some(most)) => write!(f, "at least {least} and at most {}", solutions(most)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::{Options, Question, Value, decide};
    use crate::geometry::model::Model;
    use crate::graph::graph6;

    #[test]
    fn in_words() {
        let words = |at_least: usize, at_most: Option<usize>| {
            let count = SolutionCount {
                at_least,
                at_most,
                full_may_tell_more: false,
                rounds: None,
                evidence: None,
            };
            (count.to_string(), count.exactly())
        };
        assert_eq!(words(1, Some(1)), ("exactly 1 solution".into(), Some(1)));
        assert_eq!(words(2, Some(2)), ("exactly 2 solutions".into(), Some(2)));
        assert_eq!(words(1, None), ("finitely many solutions".into(), None));
        assert_eq!(words(2, None), ("at least 2 solutions".into(), None));
        assert_eq!(words(1, Some(3)), ("at most 3 solutions".into(), None));
        let between = "at least 2 and at most 3 solutions";
        assert_eq!(words(2, Some(3)), (between.into(), None));
    }

    /// Of the 27 graphs with nine nodes and twelve edges ten have two solutions, of those with
    /// eight nodes all have one (Arrigoni, Kohn, Fusiello, Pajdla).
    #[test]
    fn what_the_verdict_says() {
        let decided = |graph6: &[u8], question: Question| {
            let graph = graph6::decode(graph6).unwrap();
            let options = Options::default().question(question);
            let verdict = decide(&graph, &options).unwrap();
            let solutions = verdict.solutions.clone();
            let bounds = solutions.map(|count| (count.at_least, count.at_most));
            (verdict.value, bounds, verdict.value_by_rank())
        };
        use CountSolutions::{Full, Off, Quick};
        use Value::{FiniteSolvable, NotFiniteSolvable, Solvable};
        let projective = |graph6, effort| decided(graph6, Question::with_solutions(effort));
        // A triangle, a cycle of four, a K_{2,3}.
        for effort in [Off, Quick, Full] {
            let one = (Solvable, Some((1, Some(1))), Solvable);
            assert_eq!(projective(b"Bw", effort), one);
            assert_eq!(projective(b"D]o", effort), one);
            let none = (NotFiniteSolvable, None, NotFiniteSolvable);
            assert_eq!(projective(b"Cl", effort), none);
            assert_eq!(decided(b"Cl", Model::Calibrated.into()), one);
        }
        let unknown = (FiniteSolvable, Some((1, None)), FiniteSolvable);
        let two = (FiniteSolvable, Some((2, Some(2))), FiniteSolvable);
        assert_eq!(projective(b"HBQkcP_", Off), unknown);
        assert_eq!(projective(b"HBQkcP_", Quick), two);
        assert_eq!(projective(b"HBQkcP_", Full), two);
        // Eight nodes with one solution (same paper), which no merge shows.
        let counted = (Solvable, Some((1, Some(1))), FiniteSolvable);
        assert_eq!(projective(b"G@TclO", Off), unknown);
        assert_eq!(projective(b"G@TclO", Quick), counted);
    }
}
