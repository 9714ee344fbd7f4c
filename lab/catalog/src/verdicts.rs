//! How many candidates of a size are finite solvable, and nothing else about them.
//!
//! Kernel by kernel: what its subdivisions have in common is computed once ([`siblings`]), and
//! [`decide`] has a look at the few that this does not decide, and at those that may be unique. Counts and a digest of the
//! finite-solvable graphs are all that is kept.
//!
//! [`siblings`]: super::siblings

use super::candidates::Candidates;
use super::multigraph::Multigraph;
use super::set_digest::SetDigest;
use super::siblings::{self, Proved};
use anyhow::Result;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use viewcert::decide::{Options, Strength, Value, Verdict, VerdictError, decide};
use viewcert::graph::{Graph, graph6};
use viewcert::watch::{Stage, Step, Stopped};

/// Counts of verdicts.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tally {
    /// How many graphs were decided.
    pub candidates: u64,
    /// Solvable: proved unique by contraction.
    pub unique: u64,
    /// Finite solvable, and not proved unique by contraction.
    pub finite: u64,
    /// Refuted by a partition with one block of several edges, or by adjacent nodes of degree 2.
    pub by_one_block: u64,
    /// Refuted by a partition with several such blocks.
    pub by_blocks: u64,
    /// Refuted by other proofs: hubs, overlaps.
    pub otherwise: u64,
    /// The graphs whose verdict is not proved, as graph6.
    pub unproved: Vec<String>,
    /// The finite-solvable graphs, as graph6 with the labels of the generator.
    pub finite_solvable: SetDigest,
}

impl Tally {
    /// Finite-solvable graphs, the uniquely solvable ones included.
    pub fn count_finite_solvable(&self) -> u64 {
        self.unique + self.finite
    }

    /// Proved not to be finite solvable.
    pub fn refuted(&self) -> u64 {
        self.by_one_block + self.by_blocks + self.otherwise
    }

    /// Whether every candidate has one answer.
    pub fn adds_up(&self) -> bool {
        let answers = self.count_finite_solvable().checked_add(self.refuted());
        answers.and_then(|sum| sum.checked_add(self.unproved.len() as u64)) == Some(self.candidates)
    }

    /// Adds the counts of other graphs.
    pub fn add(&mut self, other: Self) {
        self.candidates += other.candidates;
        self.unique += other.unique;
        self.finite += other.finite;
        self.by_one_block += other.by_one_block;
        self.by_blocks += other.by_blocks;
        self.otherwise += other.otherwise;
        self.unproved.extend(other.unproved);
        self.finite_solvable.add(&other.finite_solvable);
    }
}

/// Decides the candidates of some of the [`kernels`](Candidates::kernels), in parallel; `done` is
/// told of every kernel. `--seed` draws the centres. If there are no kernels for this size, which
/// goes with an empty range, all candidates are decided one by one.
///
/// The digest is of graph6 lines; with `list` they are returned too, in the order of
/// [`Candidates::for_each`]. Memory: that of the list, and of the graphs that are left to
/// [`decide`].
///
/// # Errors
/// If a graph is not decided, kernels cannot be read, or the work is stopped.
///
/// # Panics
/// If the range goes beyond the kernels.
pub fn tally(
    candidates: &Candidates,
    kernels: Range<usize>,
    options: &Options,
    list: bool,
    done: impl Fn(u64) + Sync,
) -> Result<(Tally, Vec<String>)> {
    let (mut tally, left) = match candidates.kernels() {
        Some(_) => {
            let kernels = candidates.some_kernels(kernels)?;
            let found: Vec<(Tally, Vec<Left>)> = kernels
                .par_iter()
                .map(|kernel| {
                    let found = of_kernel(candidates, &kernel.multigraph(), options, list)?;
                    done(1);
                    Ok(found)
                })
                .collect::<Result<_, VerdictError>>()?;
            let mut tally = Tally::default();
            let mut left = Vec::new();
            for (of_kernel, more) in found {
                tally.add(of_kernel);
                left.extend(more);
            }
            (tally, left)
        }
        None => {
            let mut left = Vec::new();
            candidates.for_each(&mut |graph| {
                left.push(Left::Undecided(graph));
                true
            });
            let tally = Tally {
                candidates: left.len() as u64,
                ..Tally::default()
            };
            (tally, left)
        }
    };
    // Few kernels have most of these, so they are decided across kernels.
    let decided: Vec<(Tally, Option<String>)> = left
        .into_par_iter()
        .map(|graph| match graph {
            Left::Listed(line) => Ok((Tally::default(), Some(line))),
            Left::Undecided(graph) => by_decide(&graph, options),
        })
        .collect::<Result<_, VerdictError>>()?;
    let mut lines = Vec::new();
    for (of_graph, line) in decided {
        tally.add(of_graph);
        lines.extend(line);
    }
    if !list {
        lines.clear();
    }
    Ok((tally, lines))
}

/// What a kernel leaves.
enum Left {
    /// A finite-solvable graph, if these are listed.
    Listed(String),
    /// A graph for [`decide`].
    Undecided(Graph),
}

/// The verdict of one graph, counted, and its line if it is finite solvable.
fn by_decide(graph: &Graph, options: &Options) -> Result<(Tally, Option<String>), VerdictError> {
    Ok(of_verdict(graph, &decide(graph, options)?))
}

fn of_verdict(graph: &Graph, verdict: &Verdict) -> (Tally, Option<String>) {
    let mut tally = Tally::default();
    let line = graph6::encode(graph);
    match (verdict.value_by_rank(), verdict.value_claim().strength) {
        (Value::Solvable, _) => tally.unique += 1,
        (Value::FiniteSolvable, _) => tally.finite += 1,
        (Value::NotFiniteSolvable, Strength::Proof) => {
            tally.otherwise += 1;
            return (tally, None);
        }
        (Value::NotFiniteSolvable, Strength::ErrorBound(_)) => {
            tally.unproved.push(line);
            return (tally, None);
        }
    }
    tally.finite_solvable.insert(line.as_bytes());
    (tally, Some(line))
}

/// The subdivisions of one kernel.
fn of_kernel(
    candidates: &Candidates,
    kernel: &Multigraph,
    options: &Options,
    list: bool,
) -> Result<(Tally, Vec<Left>), VerdictError> {
    let (nodes, edges) = candidates.size();
    if let Some(reason) = options.watch.stopped() {
        let stage = Stage {
            step: Step::Lambda,
            cameras: nodes,
        };
        return Err(VerdictError::Stopped(Stopped {
            reason,
            stage,
            percent: None,
            so_far: None,
        }));
    }
    let may_contract = may_contract(nodes, edges);
    let mut tally = Tally::default();
    let mut left = Vec::new();
    let subdivisions = candidates.subdivisions(kernel);
    let mut take = |proved: Proved| -> Result<_, VerdictError> {
        let mut candidates = 1;
        match proved {
            Proved::RefutedByOneBlock(count) => {
                candidates = count;
                tally.by_one_block += count;
            }
            Proved::RefutedByBlocks => tally.by_blocks += 1,
            Proved::RefutedAlike => tally.otherwise += 1,
            Proved::FiniteSolvable(subdivision) if may_contract => {
                left.push(Left::Undecided(subdivision.graph()));
            }
            Proved::FiniteSolvable(subdivision) => {
                tally.finite += 1;
                let line = subdivision.graph6();
                tally.finite_solvable.insert(&line);
                if list {
                    left.push(Left::Listed(String::from_utf8_lossy(&line).into_owned()));
                }
            }
            Proved::Nothing(subdivision) => {
                let verdict = decide(&subdivision.graph(), options)?;
                let (of_graph, line) = of_verdict(&subdivision.graph(), &verdict);
                tally.add(of_graph);
                left.extend(line.map(Left::Listed));
                tally.candidates += 1;
                return Ok(Some(verdict));
            }
        }
        tally.candidates += candidates;
        Ok(None)
    };
    siblings::decide_all(kernel, &subdivisions, options.seed, &mut take)?;
    Ok((tally, left))
}

/// Whether a graph of this size can contract to one body: false is a proof that none does.
///
/// Put s(B) = 7 m_B - (11 n_B - 15) for a body with n_B nodes and m_B edges; an edge has s = 0.
/// Bodies that a rule merges (docs/theory.md, Theorems 4.1 and 10.3) have no edge in common, so that s
/// of the union is the sum of theirs and 11 k - 15 (b - 1) for b bodies and k nodes that are counted
/// more than once: for two bodies k >= 2, for the triangle rule b = 3 and k >= 3, for K_{2,3}
/// b = 6 and k >= 7. That is 7, 3 or 2, and a multiple of 11. From m edges to one body m - 1 bodies
/// must go.
fn may_contract(nodes: usize, edges: usize) -> bool {
    let Some(s) = (7 * edges + 15).checked_sub(11 * nodes) else {
        return false;
    };
    (0..=s / 7).any(|pairs| {
        (0..=(s - 7 * pairs) / 3).any(|triangles| {
            let left = s - 7 * pairs - 3 * triangles;
            (0..=left / 2).any(|bipartite| {
                (left - 2 * bipartite).is_multiple_of(11)
                    && pairs + 2 * triangles + 5 * bipartite == edges - 1
            })
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::least_edges;
    use viewcert_catalog::mine::{Summary, decide_all};

    /// The candidates of a size, one by one by `decide` and kernel by kernel.
    fn both(nodes: usize, edges: usize, necessary: bool) -> (Summary, Vec<String>, Tally) {
        let candidates = Candidates::new(nodes, edges, necessary).unwrap();
        let mut graphs = Vec::new();
        candidates.for_each(&mut |graph| {
            graphs.push(graph);
            true
        });
        let options = Options::default();
        let (mut summary, mut list) = (Summary::default(), Vec::new());
        for entry in decide_all(&graphs, &options).unwrap() {
            summary.count(&entry);
            if entry.value != Value::NotFiniteSolvable {
                list.push(entry.graph6);
            }
        }
        let kernels = 0..candidates.kernels().unwrap_or(0);
        let (tally, lines) = tally(&candidates, kernels, &options, true, |_| ()).unwrap();
        assert_eq!(lines, list, "{nodes} nodes, {edges} edges");
        (summary, list, tally)
    }

    #[test]
    fn the_verdicts_are_those_of_decide() {
        for nodes in 3..=10 {
            for (edges, necessary) in [(0, true), (0, false), (1, true), (2, true)] {
                let edges = least_edges(nodes) + edges;
                if edges > nodes * (nodes - 1) / 2 || (nodes, edges) > (9, 14) {
                    continue;
                }
                let (summary, list, tally) = both(nodes, edges, necessary);
                let (n, m) = (nodes, edges);
                assert_eq!(tally.candidates, summary.candidates, "{n} nodes, {m} edges");
                assert_eq!(tally.unique, summary.unique, "{n} nodes, {m} edges");
                assert_eq!(tally.finite, summary.finite, "{n} nodes, {m} edges");
                assert_eq!(tally.refuted(), summary.refuted, "{n} nodes, {m} edges");
                assert_eq!(tally.unproved, Vec::<String>::new(), "{n} nodes, {m} edges");
                let mut digest = SetDigest::default();
                list.iter().for_each(|line| digest.insert(line.as_bytes()));
                assert_eq!(tally.finite_solvable, digest, "{n} nodes, {m} edges");
            }
        }
    }

    /// Few are left for the slow way: with the fewest edges those that take a hub.
    #[test]
    fn what_counting_and_rank_leave_takes_a_hub() {
        for (nodes, hub) in [(9, 1), (10, 9)] {
            let (summary, _, tally) = both(nodes, least_edges(nodes), true);
            assert_eq!((summary.hub, tally.otherwise), (hub, hub), "{nodes} nodes");
        }
    }

    /// Contraction needs a sum of its rules' slacks; where it has one, `decide` looks.
    #[test]
    fn sizes_at_which_graphs_contract() {
        let sizes = (4..=16).filter(|&nodes| may_contract(nodes, least_edges(nodes)));
        assert_eq!(sizes.collect::<Vec<_>>(), [4, 5, 6, 8, 11]);
        // Two nodes more bring four edges more: triangles alone.
        assert!(may_contract(16, 29) && !may_contract(16, 23));
    }
}
