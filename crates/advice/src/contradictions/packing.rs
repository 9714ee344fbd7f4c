//! Weights on cycles such that no pair carries more than one: their sum bounds the pairs that are off from below.
//!
//! The simplex method finds them where few pairs hang together, in floats; integers that were rounded down and
//! counted again are the proof. Elsewhere cycles without common pairs are taken one after another.

use super::{Cycle, Step};
use rayon::prelude::*;
use std::collections::HashMap;
use viewcert::graph::UnionFind;

/// By how much pairs may be off and be right all the same, in degrees.
#[derive(Clone, Debug)]
pub struct Terms {
    /// Their rotations.
    pub theta: u32,
    /// Their directions.
    pub phi: u32,
    /// The pairs that are supposed to be right, increasing.
    pub assumed: Vec<u32>,
    /// The rotations of these, in thousandths of a degree.
    pub assumed_within: u32,
}

impl Terms {
    pub(super) fn new(theta: u32) -> Self {
        Self {
            theta,
            phi: (theta + 10).min(89),
            assumed: Vec::new(),
            assumed_within: 1000 * theta,
        }
    }

    pub(super) fn is_assumed(&self, pair: u32) -> bool {
        self.assumed.binary_search(&pair).is_ok()
    }

    /// By how much the rotation of a pair may be off, in thousandths of a degree.
    pub(super) fn within(&self, pair: u32) -> u32 {
        match self.is_assumed(pair) {
            true => self.assumed_within,
            false => 1000 * self.theta,
        }
    }

    /// By how many degrees that of a walk may be, rounded up.
    pub(super) fn sum(&self, walk: &[Step]) -> u32 {
        let sum: u32 = walk.iter().map(|step| self.within(step.0)).sum();
        sum.div_ceil(1000)
    }
}

/// Cycles with weights over one denominator: a proof of how many pairs are off.
#[derive(Clone, Debug)]
pub struct Packing {
    /// From when on they are, and what is supposed.
    pub terms: Terms,
    /// The cycles that have a weight, and their weights.
    pub cycles: Vec<(Cycle, u64)>,
    /// What the weights are over.
    pub denominator: u64,
}

/// Weights are multiples of one over this.
const DENOMINATOR: u64 = 1 << 24;

/// So many pairs and cycles at most go to the simplex method at once.
const MOST_ROWS: usize = 600;
const MOST_COLUMNS: usize = 400_000;

impl Packing {
    /// At least so many pairs are off.
    pub fn at_least(&self) -> usize {
        let sum: u64 = self.cycles.iter().map(|(_, weight)| weight).sum();
        sum.div_ceil(self.denominator) as usize
    }

    /// The pairs of its cycles, increasing.
    pub fn pairs(&self) -> Vec<u32> {
        let walks = self.cycles.iter().flat_map(|(cycle, _)| &cycle.walk);
        let mut pairs: Vec<u32> = walks.map(|step| step.0).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Packs cycles, whose order says which are taken first where there are many; pairs that are assumed carry
    /// any weight.
    pub(super) fn of(cycles: Vec<Cycle>, pairs: usize, terms: Terms) -> Self {
        let free = |cycle: &Cycle| {
            let all = cycle.walk.iter().map(|&(pair, _)| pair);
            all.filter(|&pair| !terms.is_assumed(pair)).collect()
        };
        let columns: Vec<Vec<u32>> = cycles.iter().map(free).collect();
        let mut sets = UnionFind::new(pairs);
        for two in columns.iter().flat_map(|column| column.windows(2)) {
            sets.union(two[0] as usize, two[1] as usize);
        }
        let mut groups: HashMap<usize, Vec<usize>> = HashMap::new();
        for (k, column) in columns.iter().enumerate() {
            if let Some(&first) = column.first() {
                groups.entry(sets.find(first as usize)).or_default().push(k);
            }
        }
        let mut weights = vec![0; cycles.len()];
        for group in groups.values() {
            let mut numbers: HashMap<u32, u32> = HashMap::new();
            let local = group.iter().map(|&k| {
                let column = columns[k].iter().map(|&pair| {
                    let next = numbers.len() as u32;
                    *numbers.entry(pair).or_insert(next)
                });
                column.collect()
            });
            let local: Vec<Vec<u32>> = local.collect();
            let is_small = numbers.len() <= MOST_ROWS && local.len() <= MOST_COLUMNS;
            let shares = match is_small {
                true => simplex(numbers.len(), &local),
                // The room below is for whoever comes first.
                false => vec![1.0; local.len()],
            };
            for (&k, share) in group.iter().zip(shares) {
                weights[k] = (share.clamp(0.0, 1.0) * DENOMINATOR as f64) as u64;
            }
        }
        let mut room = vec![DENOMINATOR; pairs];
        let kept = cycles.into_iter().zip(columns).zip(weights);
        let kept = kept.filter_map(|((cycle, column), weight)| {
            let least = column.iter().map(|&pair| room[pair as usize]).min();
            let weight = least.unwrap_or(0).min(weight);
            for &pair in &column {
                room[pair as usize] -= weight;
            }
            (weight > 0).then_some((cycle, weight))
        });
        let mut cycles: Vec<(Cycle, u64)> = kept.collect();
        let is_whole = cycles.iter().all(|(_, weight)| *weight == DENOMINATOR);
        if is_whole {
            cycles.iter_mut().for_each(|(_, weight)| *weight = 1);
        }
        Self {
            terms,
            cycles,
            denominator: if is_whole { 1 } else { DENOMINATOR },
        }
    }
}

/// Columns that are looked at again and again before all are.
const SOME: usize = 256;

/// Shares of columns, of which each row takes one in sum at most, with the largest sum: by the revised simplex
/// method, from nothing. Every step is feasible, so it may stop at any.
fn simplex(rows: usize, columns: &[Vec<u32>]) -> Vec<f64> {
    const EPS: f64 = 1e-9;
    let mut inverse = vec![vec![0.0; rows]; rows];
    (0..rows).for_each(|i| inverse[i][i] = 1.0);
    // Bounds that differ slightly keep steps from standing still.
    let bound = |i: usize| 1.0 - 1e-7 * ((i * 7919 % 1009) as f64 / 1009.0);
    let mut room: Vec<f64> = (0..rows).map(bound).collect();
    let mut basis: Vec<Option<usize>> = vec![None; rows];
    let mut price = vec![0.0; rows];
    let gain =
        |price: &[f64], k: usize| 1.0 - columns[k].iter().map(|&i| price[i as usize]).sum::<f64>();
    let mut some: Vec<usize> = Vec::new();
    for _ in 0..30 * rows {
        let best = |some: &[usize], price: &[f64]| {
            let gains = some.iter().map(|&k| (gain(price, k), Some(k), 0));
            let slack = price
                .iter()
                .enumerate()
                .map(|(i, &price)| (-price, None, i));
            let best = gains.chain(slack).max_by(|a, b| a.0.total_cmp(&b.0));
            best.filter(|(gain, ..)| *gain > EPS)
        };
        let mut found = best(&some, &price);
        if found.is_none() {
            let gains = (0..columns.len())
                .into_par_iter()
                .map(|k| (gain(&price, k), k));
            let mut gains: Vec<(f64, usize)> = gains.filter(|(gain, _)| *gain > EPS).collect();
            if gains.len() > SOME {
                gains.select_nth_unstable_by(SOME, |a, b| b.0.total_cmp(&a.0));
                gains.truncate(SOME);
            }
            some = gains.into_iter().map(|(_, k)| k).collect();
            found = best(&some, &price);
        }
        let Some((gain, entering, row)) = found else {
            break;
        };
        let slack = [row as u32];
        let entries = entering.map_or(&slack[..], |k| &columns[k]);
        let sum = |row: &Vec<f64>| entries.iter().map(|&i| row[i as usize]).sum();
        let change: Vec<f64> = inverse.iter().map(sum).collect();
        let ratios = (0..rows).filter(|&i| change[i] > EPS);
        let ratios = ratios.map(|i| (room[i].max(0.0) / change[i], i));
        let Some((step, leaving)) = ratios.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            break;
        };
        let pivot: Vec<f64> = inverse[leaving]
            .iter()
            .map(|x| x / change[leaving])
            .collect();
        for i in (0..rows).filter(|&i| i != leaving && change[i] != 0.0) {
            room[i] -= step * change[i];
            let row = inverse[i].iter_mut().zip(&pivot);
            row.for_each(|(x, p)| *x -= change[i] * p);
        }
        price
            .iter_mut()
            .zip(&pivot)
            .for_each(|(price, p)| *price += gain * p);
        (inverse[leaving], room[leaving], basis[leaving]) = (pivot, step, entering);
    }
    let mut shares = vec![0.0; columns.len()];
    for (column, room) in basis.into_iter().zip(room) {
        if let Some(k) = column {
            shares[k] = room;
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the four triangles of a tetrahedron's six pairs every two share one: halves prove two, whole ones one.
    #[test]
    fn halves_prove_more() {
        let walks = [[0, 1, 2], [0, 3, 4], [1, 3, 5], [2, 4, 5]];
        let cycle = |walk: &[u32; 3]| Cycle {
            walk: walk.iter().map(|&pair| (pair, true)).collect(),
            witness: None,
        };
        let packed = |assumed: &[u32]| {
            let assumed = assumed.to_vec();
            let terms = Terms {
                assumed,
                ..Terms::new(10)
            };
            Packing::of(walks.iter().map(cycle).collect(), 6, terms)
        };
        let packing = packed(&[]);
        assert_eq!(packing.at_least(), 2);
        let of = |pair: u32| {
            let through = packing.cycles.iter();
            let through = through.filter(|(cycle, _)| cycle.walk.iter().any(|step| step.0 == pair));
            through.map(|(_, weight)| weight).sum::<u64>()
        };
        assert!((0..6).all(|pair| of(pair) <= packing.denominator));
        // What is assumed carries any weight.
        assert_eq!(packed(&[0, 1, 2]).at_least(), 2);
    }
}
