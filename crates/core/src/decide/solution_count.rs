//! The number of solutions, as part of a verdict (docs/theory.md, section 10).
//!
//! In: a graph that is finite solvable, and its contraction. Out: how many solutions there are at
//! least and at most, with the evidence. A body and the calibrated model have one (Corollary 4.2,
//! Theorem 4.8); what is left is counted by [`mod@crate::solutions`].

use crate::contract::Contraction;
use crate::decide::claim::Strength;
use crate::decide::question::CountSolutions;
use crate::graph::Graph;
use crate::solutions::{Effort, Solutions, count_in};
use crate::watch::{Stopped, Task};
use crate::wording::counted;
use std::fmt;
use std::sync::Arc;

/// The most nodes that the members of a core may share for a quick count, and the most unknown
/// scales. What a count costs grows with the fourth power of the unknowns and the third one of the
/// nodes; with so many of both it takes some milliseconds, and about a second where it fails.
const QUICK: [usize; 2] = [12, 6];

/// What is known of the number of solutions of a finite solvable graph: of the classes of cameras
/// with its fundamental matrices, at generic cameras and over the complex numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SolutionCount {
    /// There are as many at least; the cameras themselves are one.
    pub at_least: usize,
    /// There are no more than that, if such a bound is known.
    pub at_most: Option<usize>,
    /// What the bounds rest on, where contraction and the model alone do not show them.
    pub evidence: Option<Arc<Solutions>>,
}

impl SolutionCount {
    /// One solution, by contraction or by the model.
    pub(super) fn one() -> Self {
        Self {
            at_least: 1,
            at_most: Some(1),
            evidence: None,
        }
    }

    /// Counts the solutions of a finite solvable graph in the projective model, or says that one
    /// there is.
    ///
    /// # Errors
    /// If the work is stopped.
    pub(super) fn of(
        graph: &Graph,
        contraction: &Contraction,
        effort: CountSolutions,
        seed: u64,
        task: &Task<'_>,
    ) -> Result<Self, Stopped> {
        let [nodes, unknowns] = size(graph, contraction);
        let worth_it = match effort {
            CountSolutions::Off => false,
            CountSolutions::Quick => nodes <= QUICK[0] && unknowns <= QUICK[1],
            CountSolutions::Full => true,
        };
        let found = if worth_it {
            count_in(graph, contraction, Effort::default(), seed, task)?
        } else {
            None
        };
        Ok(Self {
            at_least: found.as_ref().map_or(1, |found| found.at_least),
            at_most: found.as_ref().and_then(|found| found.at_most),
            evidence: found.map(Arc::new),
        })
    }

    /// The number of solutions, if it is known.
    pub fn exactly(&self) -> Option<usize> {
        self.at_most.filter(|&most| most == self.at_least)
    }

    /// How strong both bounds are: they are proofs, whatever was drawn.
    pub fn strength(&self) -> Strength {
        Strength::Proof
    }
}

/// The nodes that members share, and the scales that are unknown in a chart of them
/// (sum of the shared nodes of all members, less nodes, less members, plus one).
fn size(graph: &Graph, contraction: &Contraction) -> [usize; 2] {
    let mut members = vec![0u32; graph.nodes()];
    let bodies = contraction.finals.iter();
    let in_bodies = bodies.flat_map(|&k| &contraction.bodies[k as usize].nodes);
    let in_edges = contraction.loose.iter().flat_map(|&(i, j)| [i, j]);
    for v in in_bodies.copied().chain(in_edges) {
        members[v as usize] += 1;
    }
    let shared = members.iter().filter(|&&count| count > 1);
    let (nodes, places) = shared.fold((0, 0), |(nodes, places), &count| {
        (nodes + 1, places + count as usize)
    });
    let all = contraction.finals.len() + contraction.loose.len();
    [nodes, (places + 1).saturating_sub(nodes + all)]
}

/// "exactly 2 solutions", "at least 2 and at most 4 solutions"; what is said of the number where
/// nothing but its finiteness is known is "finitely many solutions".
impl fmt::Display for SolutionCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.at_least, self.at_most) {
            (least, Some(most)) if least == most => {
                write!(f, "exactly {}", counted(least, "solution"))
            }
            (1, None) => f.write_str("finitely many solutions"),
            (least, None) => write!(f, "at least {}", counted(least, "solution")),
            (1, Some(most)) => write!(f, "at most {}", counted(most, "solution")),
            (least, Some(most)) => {
                write!(
                    f,
                    "at least {least} and at most {}",
                    counted(most, "solution")
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decide::{Options, Projective, Question, Value, decide};
    use crate::geometry::model::Model;
    use crate::graph::graph6;

    #[test]
    fn in_words() {
        let words = |at_least, at_most| {
            let evidence = None;
            let count = SolutionCount {
                at_least,
                at_most,
                evidence,
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

    /// A cycle of six has six nodes, and six edges with two of them each: one unknown scale.
    #[test]
    fn unknowns_of_a_cycle() {
        let pairs = (0..6).map(|i| (i, (i + 1) % 6)).collect();
        let (cycle, _) = Graph::from_pairs(6, pairs).unwrap();
        let contraction = Contraction::new(&cycle, Model::Projective);
        assert_eq!(size(&cycle, &contraction), [6, 1]);
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
        let projective =
            |graph6, effort| decided(graph6, Projective::with_solutions(effort).into());
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
