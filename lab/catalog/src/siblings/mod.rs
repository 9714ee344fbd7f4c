//! Verdicts of all subdivisions of one kernel, and of nothing else: no ranks, no components.
//!
//! Edges are chosen one after the other. As soon as one block refutes those that are chosen, it refutes
//! whatever has more (`slack`). Of the others either N and Lambda have full rank modulo a prime, and the graph
//! is finite solvable (`conditions`), or a partition bounds its rank below what is required, and it is not
//! (`slack`): both are proofs. The few that remain, which take a hub, say, are for
//! [`decide`](viewcert::decide::decide); what refutes one of them is tried on the others (`hubs`).

mod conditions;
mod hubs;
mod slack;

use super::multigraph::Multigraph;
use super::subdivide::{Once, Subdivision, Subdivisions};
use conditions::Conditions;
use hubs::{Halves, Refutation};
use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;
use sha2::{Digest, Sha256};
use slack::{Blocks, Completing};
use viewcert::decide::Verdict;

/// What is proved about subdivisions.
pub enum Proved<'a> {
    /// It is finite solvable: full rank at one point.
    FiniteSolvable(&'a Subdivision<'a>),
    /// So many are not, by a partition with one block of several edges, or because two nodes of degree 2
    /// are adjacent.
    RefutedByOneBlock(u64),
    /// One is not, by a partition with several such blocks.
    RefutedByBlocks,
    /// One is not, for the same reason as one before, of which nothing was proved at first.
    RefutedAlike,
    /// Nothing yet. A verdict that is returned may help with others.
    Nothing(&'a Subdivision<'a>),
}

/// Decides the subdivisions of `kernel`, in the order of [`Subdivisions::for_each`]; refuted ones may come earlier,
/// many at a time. Centres depend on the kernel and the seed.
///
/// O(c) words of work for each subdivision that one block does not refute, c the number of independent cycles,
/// besides what they share.
///
/// # Errors
/// Those of `each`, which ends it.
pub fn decide_all<E>(
    kernel: &Multigraph,
    subdivisions: &Subdivisions,
    seed: u64,
    each: &mut impl FnMut(Proved) -> Result<Option<Verdict>, E>,
) -> Result<(), E> {
    let mut adjacent = 0;
    subdivisions.for_each_other(&mut || adjacent += 1);
    if adjacent > 0 {
        each(Proved::RefutedByOneBlock(adjacent))?;
    }
    match subdivisions.once() {
        Some(once) => Siblings::new(kernel, &once, seed, each).decide(),
        None => Ok(()),
    }
}

/// The subdivisions of a kernel, and what they have in common.
struct Siblings<'a, F> {
    once: &'a Once<'a>,
    ends: Vec<(usize, usize)>,
    nodes: usize,
    spare: i32,
    blocks: Blocks,
    conditions: Conditions,
    /// The pairs that are chosen, all but the last one.
    path: Vec<usize>,
    taken: Taken,
    refutations: Vec<Refutation>,
    each: &'a mut F,
}

/// Of how many chosen pairs the conditions have been taken: not before a subdivision is looked at that no
/// block refutes.
#[derive(Clone, Copy, Default)]
struct Taken {
    pairs: usize,
    /// Whether those of the next one depend on them.
    dependent: bool,
}

/// Edges that are chosen.
#[derive(Clone, Copy)]
struct Chosen {
    /// How many pairs.
    pairs: usize,
    /// The pairs, as bits.
    set: u32,
    /// All edges that are subdivided, as bits.
    edges: u32,
    /// Whether one block refutes them.
    refuted: bool,
}

impl<'a, E, F: FnMut(Proved) -> Result<Option<Verdict>, E>> Siblings<'a, F> {
    fn new(kernel: &Multigraph, once: &'a Once<'a>, seed: u64, each: &'a mut F) -> Self {
        let order: Vec<u8> = (0..kernel.nodes() as u8).collect();
        let mut hash = Sha256::new();
        hash.update(seed.to_le_bytes());
        for word in kernel.key(&order) {
            hash.update(word.to_le_bytes());
        }
        let mut random = ChaCha12Rng::from_seed(hash.finalize().into());
        let ends = kernel.edge_list();
        let subdivided = once.forced.count_ones() as usize + once.chosen;
        let (nodes, edges) = (kernel.nodes() + subdivided, ends.len() + subdivided);
        let spare = 7 * edges as i32 - (11 * nodes as i32 - 15);
        let forced: Vec<usize> = (0..ends.len())
            .filter(|edge| once.forced >> edge & 1 == 1)
            .collect();
        Self {
            once,
            nodes: kernel.nodes(),
            spare,
            blocks: Blocks::new(kernel, subdivided, spare),
            conditions: Conditions::new(kernel, &forced, &once.last, &mut random),
            path: Vec::new(),
            taken: Taken::default(),
            refutations: Vec::new(),
            ends,
            each,
        }
    }

    fn decide(&mut self) -> Result<(), E> {
        let none = Chosen {
            pairs: 0,
            set: 0,
            edges: self.once.forced,
            refuted: false,
        };
        if self.once.chosen > 0 {
            return self.below(none, 0);
        }
        let refuted = self.blocks.one_refutes(none.edges);
        self.one(Chosen { refuted, ..none }, self.conditions.hold())
    }

    /// Decides the subdivisions of these edges and of pairs from `first` on.
    fn below(&mut self, chosen: Chosen, first: usize) -> Result<(), E> {
        let all = self.once.last.len();
        let left = self.once.chosen - chosen.pairs;
        if left == 1 {
            return self.last(chosen, first);
        }
        let refuted = chosen.refuted || self.blocks.one_refutes(chosen.edges);
        if refuted && self.once.no_symmetry() {
            let count = binomial(all - first, left);
            (self.each)(Proved::RefutedByOneBlock(count))?;
            return Ok(());
        }
        // Without the first pairs first, as they are made.
        for pair in (first..=all - left).rev() {
            self.path.truncate(chosen.pairs);
            self.path.push(pair);
            if self.taken.pairs >= chosen.pairs {
                self.taken = Taken {
                    pairs: chosen.pairs,
                    dependent: false,
                };
            }
            let more = Chosen {
                pairs: chosen.pairs + 1,
                set: chosen.set | 1 << pair,
                edges: chosen.edges | 1 << self.once.last[pair],
                refuted,
            };
            self.below(more, pair + 1)?;
        }
        Ok(())
    }

    /// Decides the subdivisions of these edges and of one pair from `first` on.
    fn last(&mut self, chosen: Chosen, first: usize) -> Result<(), E> {
        let completing = match chosen.refuted {
            true => Completing::Any,
            false => self.blocks.completing(chosen.edges),
        };
        let mut count = 0;
        let mut full_rank = None;
        for pair in (first..self.once.last.len()).rev() {
            let (set, edge) = (chosen.set | 1 << pair, self.once.last[pair]);
            if !self.once.no_symmetry() && !self.once.counts(set) {
                continue;
            }
            let refuted = match completing {
                Completing::Any => true,
                Completing::Edges(edges) => edges >> edge & 1 == 1,
            };
            if refuted {
                count += 1;
                continue;
            }
            let before = *full_rank.get_or_insert_with(|| self.take());
            let full_rank = before && self.conditions.independent(chosen.pairs, pair);
            let more = Chosen {
                pairs: chosen.pairs + 1,
                set,
                edges: chosen.edges | 1 << edge,
                refuted,
            };
            self.one(more, full_rank)?;
        }
        if count > 0 {
            (self.each)(Proved::RefutedByOneBlock(count))?;
        }
        Ok(())
    }

    /// Takes the conditions of all pairs that are chosen but the last one: whether they are independent.
    fn take(&mut self) -> bool {
        let Some((&last, before)) = self.path.split_last() else {
            return self.conditions.hold();
        };
        let taken = &mut self.taken;
        taken.dependent |= !self.conditions.hold();
        while !taken.dependent && taken.pairs < before.len() {
            match self.conditions.take(taken.pairs, before[taken.pairs]) {
                true => taken.pairs += 1,
                false => taken.dependent = true,
            }
        }
        !taken.dependent && self.conditions.take_last_but_one(before.len(), last)
    }

    /// Decides one subdivision, whose N and Lambda may be known to have full rank.
    fn one(&mut self, chosen: Chosen, full_rank: bool) -> Result<(), E> {
        let (edges, spare) = (chosen.edges, self.spare);
        if chosen.refuted {
            (self.each)(Proved::RefutedByOneBlock(1))?;
        } else if full_rank {
            let each = |subdivision: Subdivision| (self.each)(Proved::FiniteSolvable(&subdivision));
            self.once.with(chosen.set, each)?;
        } else if self.blocks.several_refute(edges) {
            (self.each)(Proved::RefutedByBlocks)?;
        } else if self.refutations.iter().any(|one| one.refutes(edges, spare)) {
            (self.each)(Proved::RefutedAlike)?;
        } else {
            let found = self.once.with(chosen.set, |subdivision| {
                let verdict = (self.each)(Proved::Nothing(&subdivision))?;
                let lying = subdivision.lying();
                let halves = Halves {
                    ends: &self.ends,
                    edges: &lying,
                    nodes: self.nodes,
                };
                Ok(verdict.and_then(|verdict| Refutation::of(&verdict, &halves)))
            })?;
            self.refutations
                .extend(found.filter(|one| one.refutes(edges, spare)));
        }
        Ok(())
    }
}

/// In how many ways k of n can be chosen.
fn binomial(n: usize, k: usize) -> u64 {
    (0..k as u64).fold(1, |product, j| product * (n as u64 - j) / (j + 1))
}
