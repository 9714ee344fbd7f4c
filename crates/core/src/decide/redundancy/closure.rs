//! Pairs that are determined though they are not there (docs/theory.md, Theorem 15.4).

use super::ensure_pairs_alone;
use crate::contract::piece::{Assembly, Core, Members};
use crate::decide::claim::Strength;
use crate::decide::drawn::{Centres, Moved};
use crate::decide::error::VerdictError;
use crate::decide::options::Options;
use crate::decide::verdict::Verdict;
use crate::decide::walk::{ATTEMPTS, Piece};
use crate::decide::{decide, evidence::PieceVerdict};
use crate::graph::Graph;
use std::collections::BTreeMap;

/// What a graph with all pairs that it implies falls into.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Closure {
    /// Sets of three nodes or more, each increasing, all pairs of which are in the graph or implied;
    /// maximal, so that two of them share one node at most. Every component with three nodes or more
    /// lies in one.
    pub sets: Vec<Vec<u32>>,
    /// Implied pairs that are in none of these sets, increasing.
    pub pairs: Vec<(u32, u32)>,
    /// How strong it is that pairs are implied whose ends no component holds; a proof if there are
    /// none.
    pub implied: Strength,
    /// How strong it is that no other pair is.
    pub complete: Strength,
}

impl Closure {
    /// How many pairs are implied that are not in the graph.
    pub fn count(&self, graph: &Graph) -> u64 {
        let all: u64 = self
            .sets
            .iter()
            .map(|set| set.len() as u64 * (set.len() as u64 - 1) / 2)
            .sum();
        all - self.inside(graph) + self.pairs.len() as u64
    }

    /// How many pairs of the graph lie in one of the sets.
    fn inside(&self, graph: &Graph) -> u64 {
        let of_set = |set: &Vec<u32>| {
            let inside = |&&(_, j): &&(u32, u32)| set.binary_search(&j).is_ok();
            let from = |&v: &u32| graph.edges_from(v).iter().filter(inside).count() as u64;
            set.iter().map(from).sum::<u64>()
        };
        self.sets.iter().map(of_set).sum()
    }

    /// The implied pairs that are not in the graph, set by set.
    pub fn implied<'a>(&'a self, graph: &'a Graph) -> impl Iterator<Item = (u32, u32)> + 'a {
        let of_set = |set: &'a Vec<u32>| {
            let from = move |k: usize| set[k + 1..].iter().map(move |&j| (set[k], j));
            (0..set.len()).flat_map(from)
        };
        let inside = self.sets.iter().flat_map(of_set);
        let new = inside.filter(|&(i, j)| graph.edge_number(i, j).is_none());
        new.chain(self.pairs.iter().copied())
    }
}

/// The pairs that a graph implies. In the calibrated and the affine model, and wherever the rank is
/// full, these are the pairs within components; in the projective model one motion of each core
/// shows the others, O(k^2) tests for k nodes of the core besides its elimination.
///
/// ```
/// use viewcert::decide::{closure, Options, decide};
/// use viewcert::Graph;
///
/// // Two triangles with a common side determine the pair of the other corners.
/// let graph = Graph::new(5, [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (3, 4)])?;
/// let options = Options::default();
/// let found = closure(&graph, &decide(&graph, &options)?, &options)?;
/// assert_eq!(found.implied(&graph).collect::<Vec<_>>(), [(0, 3)]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`decide`]; a verdict that rests on more than pairs.
pub fn closure(
    graph: &Graph,
    verdict: &Verdict,
    options: &Options,
) -> Result<Closure, VerdictError> {
    ensure_pairs_alone(verdict)?;
    let larger = |nodes: &Vec<u32>| nodes.len() > 2;
    let components = verdict.components.iter().map(|one| one.nodes());
    let complete = verdict.rank_claim().strength;
    if verdict.model.is_linear() {
        return Ok(Closure {
            sets: components.filter(larger).collect(),
            pairs: Vec::new(),
            implied: Strength::Proof,
            complete,
        });
    }
    let assembly = Assembly::new(graph, &verdict.contraction);
    let mut found = Found::default();
    found.sets.extend(
        verdict
            .rigid
            .singles()
            .iter()
            .map(|one| nodes_of(verdict, one)),
    );
    for piece in &verdict.pieces {
        if piece.components.len() == 1 {
            found.sets.push(nodes_of(verdict, &piece.members));
        } else {
            found.add(&assembly, piece, verdict, options)?;
        }
    }
    let mut sets: Vec<Vec<u32>> = found.sets.into_iter().filter(larger).collect();
    sets.sort_unstable();
    sets.dedup();
    let inside = |&(a, b): &(u32, u32)| {
        let has = |set: &Vec<u32>, v| set.binary_search(&v).is_ok();
        sets.iter().any(|set| has(set, a) && has(set, b))
    };
    let mut pairs = found.pairs;
    pairs.retain(|pair| !inside(pair) && graph.edge_number(pair.0, pair.1).is_none());
    pairs.sort_unstable();
    let mut old: Vec<Vec<u32>> = components.filter(larger).collect();
    old.sort_unstable();
    let implied = if sets == old && pairs.is_empty() {
        Strength::Proof
    } else {
        confirmed(graph, &sets, &pairs, verdict, options)?
    };
    Ok(Closure {
        sets,
        pairs,
        implied,
        complete,
    })
}

#[derive(Default)]
struct Found {
    sets: Vec<Vec<u32>>,
    pairs: Vec<(u32, u32)>,
}

impl Found {
    /// What one motion of a piece that is not rigid leaves together.
    fn add(
        &mut self,
        assembly: &Assembly,
        piece: &PieceVerdict,
        verdict: &Verdict,
        options: &Options,
    ) -> Result<(), VerdictError> {
        let core = assembly.core(&piece.members);
        let at_work = Piece::new(assembly, &piece.members, &core, &verdict.sha256, options);
        let field = options.prime.for_core(core.graph.nodes());
        let mut next = 0;
        for _ in 0..ATTEMPTS {
            let at = Centres::draw(&field, &core, at_work.key(next))?;
            next = at.draw.draw + 1;
            let ranks = at_work.ranks(&at)?;
            if at_work.rank_of_piece(ranks.rank) != piece.lower {
                continue;
            }
            if let Some(moved) = ranks.motion() {
                self.read(&core, &piece.members, verdict, &moved);
                return Ok(());
            }
        }
        Err(VerdictError::Undecided {
            prime: field.modulus(),
            draws: ATTEMPTS,
        })
    }

    fn read(&mut self, core: &Core, members: &Members, verdict: &Verdict, moved: &Moved) {
        let mut class: BTreeMap<&[u64; 16], Members> = BTreeMap::new();
        let singles = members.singles();
        for (transform, &owner) in moved.transforms.iter().zip(&core.owner) {
            let one = &singles[owner as usize];
            let all = class.entry(transform).or_default();
            if !all.contains(one) {
                all.extend(one);
            }
        }
        let k = core.nodes.len();
        let mut together = vec![false; k * k];
        for (transform, members) in class {
            let follow = (0..k).filter(|&v| moved.follows(v, transform));
            let follow: Vec<usize> = follow.collect();
            for &a in &follow {
                follow.iter().for_each(|&b| together[a * k + b] = true);
            }
            let mut nodes = nodes_of(verdict, &members);
            nodes.extend(follow.iter().map(|&v| core.nodes[v]));
            nodes.sort_unstable();
            nodes.dedup();
            self.sets.push(nodes);
        }
        for a in 0..k {
            for b in a + 1..k {
                if !together[a * k + b] && moved.keeps(a, b) {
                    self.pairs.push((core.nodes[a], core.nodes[b]));
                }
            }
        }
    }
}

/// The nodes of some members, increasing.
fn nodes_of(verdict: &Verdict, members: &Members) -> Vec<u32> {
    let bodies = members.bodies.iter();
    let of_bodies = bodies.flat_map(|&body| &verdict.contraction.bodies[body as usize].nodes);
    let ends = members.edges.iter().flat_map(|&(i, j)| [i, j]);
    let mut nodes: Vec<u32> = of_bodies.copied().chain(ends).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// How strong it is that pairs do not raise the rank: all of them together, a chain for each set.
fn confirmed(
    graph: &Graph,
    sets: &[Vec<u32>],
    pairs: &[(u32, u32)],
    verdict: &Verdict,
    options: &Options,
) -> Result<Strength, VerdictError> {
    let chain = |set: &Vec<u32>, step: usize| {
        let ahead = set.iter().skip(step).copied();
        set.iter().copied().zip(ahead).collect::<Vec<_>>()
    };
    let chains = sets.iter().flat_map(|set| [chain(set, 1), chain(set, 2)]);
    let more = chains.flatten().chain(pairs.iter().copied());
    let all = graph.edges().iter().copied().chain(more);
    let larger = Graph::new(graph.nodes() as u32, all).expect("pairs of its nodes");
    let found = decide(&larger, options)?;
    if found.rank != verdict.rank {
        return Err(VerdictError::Undecided {
            prime: options.prime.for_core(graph.nodes()).modulus(),
            draws: 1,
        });
    }
    Ok(found.rank_claim().strength)
}
