//! The smallest singular values of J by shift-and-invert: subspace iteration with a sparse
//! Cholesky factor of J^T J + shift, whose blocks are those of pairs of cameras.
//!
//! The shift is as small as the factor allows, so that a singular J^T J can be factored at
//! all. Values are not taken from J^T J, whose rounding hides everything below
//! eps |J|^2, but from J itself: the singular values of J on the subspace.

use super::AuditError;
use super::dense::{Columns, add, orthonormal, singular};
use super::jacobian::{GramBlock, Jacobian};
use rand::{Rng, SeedableRng};
use std::collections::{BTreeMap, BTreeSet};
use viewcert::graph::Graph;

/// Vectors more than are asked for, for convergence.
const GUARD: usize = 4;

/// Most iterations.
const ITERATIONS: usize = 100;

/// Relative change at which a value has converged.
const SETTLED: f64 = 1e-10;

/// The same where only the side of a tolerance matters.
const ROUGHLY: f64 = 1e-3;

/// The smallest singular values, rising, with their vectors as columns.
#[derive(Debug)]
pub struct Spectrum {
    /// The values.
    pub values: Vec<f64>,
    /// Orthonormal vectors.
    pub vectors: Columns,
}

/// The `count` smallest singular values of J.
///
/// # Errors
/// If J^T J cannot be factored at any shift, or values are not numbers.
pub fn smallest(j: &Jacobian, count: usize) -> Result<Spectrum, AuditError> {
    Inverse::new(j)?.iterate(count, SETTLED)
}

/// The nodes in an order in which the next one always has the fewest neighbours, if those of nodes before it
/// are joined.
fn order(graph: &Graph) -> Vec<usize> {
    let mut around = vec![BTreeSet::new(); graph.nodes()];
    for &(i, j) in graph.edges() {
        around[i as usize].insert(j as usize);
        around[j as usize].insert(i as usize);
    }
    let mut left: BTreeSet<(usize, usize)> = around.iter().map(BTreeSet::len).zip(0..).collect();
    let mut order = Vec::with_capacity(around.len());
    while let Some((_, v)) = left.pop_first() {
        order.push(v);
        let neighbours = std::mem::take(&mut around[v]);
        for &w in &neighbours {
            left.remove(&(around[w].len(), w));
            around[w].extend(neighbours.iter().filter(|&&u| u != w));
            around[w].remove(&v);
            left.insert((around[w].len(), w));
        }
    }
    order
}

/// A block less a product: target - a b^T.
fn subtract(target: &mut GramBlock, a: &GramBlock, b: &GramBlock) {
    let turned: GramBlock = std::array::from_fn(|k| std::array::from_fn(|c| b[c][k]));
    for (line, row) in target.iter_mut().zip(a) {
        for (k, turned) in turned.iter().enumerate() {
            add(line, -row[k], turned);
        }
    }
}

/// The Cholesky factor of a block; nothing if it is not positive definite.
fn root(block: &GramBlock) -> Option<GramBlock> {
    let mut root = [[0.0f64; 12]; 12];
    for r in 0..12 {
        for c in 0..=r {
            let known: f64 = (0..c).map(|k| root[r][k] * root[c][k]).sum();
            let left = block[r][c] - known;
            root[r][c] = match r == c {
                false => left / root[c][c],
                true if left > 0.0 => left.sqrt(),
                true => return None,
            };
        }
    }
    Some(root)
}

/// A factor L of a symmetric matrix, block by block, in the order of elimination: the node, its block on the diagonal,
/// and those below with their nodes.
struct Factor(Vec<Eliminated>);

type Eliminated = (usize, GramBlock, Vec<(usize, GramBlock)>);

impl Factor {
    /// Of J^T J + shift; nothing if rounding leaves it not positive definite.
    fn new(j: &Jacobian, order: &[usize], shift: f64) -> Option<Self> {
        let (mut diagonal, below) = j.gram();
        let mut place = vec![0; order.len()];
        order.iter().enumerate().for_each(|(k, &v)| place[v] = k);
        // Below each node's diagonal: rows of the later node, columns of the earlier one.
        let mut rest: Vec<BTreeMap<usize, GramBlock>> = vec![BTreeMap::new(); order.len()];
        for (&(u, v), block) in j.blocks.graph.edges().iter().zip(below) {
            let (u, v) = (u as usize, v as usize);
            match place[u] < place[v] {
                true => rest[u].insert(v, block),
                false => {
                    let turned = std::array::from_fn(|r| std::array::from_fn(|c| block[c][r]));
                    rest[v].insert(u, turned)
                }
            };
        }
        let mut factor = Vec::with_capacity(order.len());
        for &v in order {
            (0..12).for_each(|k| diagonal[v][k][k] += shift);
            let pivot = root(&diagonal[v])?;
            let mut later: Vec<(usize, GramBlock)> =
                std::mem::take(&mut rest[v]).into_iter().collect();
            later.sort_by_key(|&(w, _)| place[w]);
            for line in later.iter_mut().flat_map(|(_, block)| block) {
                forward(&pivot, line);
            }
            for (k, (w, of_w)) in later.iter().enumerate() {
                subtract(&mut diagonal[*w], of_w, of_w);
                for (u, of_u) in &later[..k] {
                    let block = rest[*u].entry(*w).or_insert([[0.0; 12]; 12]);
                    subtract(block, of_w, of_u);
                }
            }
            factor.push((v, pivot, later));
        }
        Some(Self(factor))
    }

    /// Solves for a right-hand side, in its place.
    fn solve(&self, x: &mut [f64]) {
        for (v, pivot, later) in &self.0 {
            let mut own: [f64; 12] = std::array::from_fn(|k| x[12 * v + k]);
            forward(pivot, &mut own);
            x[12 * v..12 * v + 12].copy_from_slice(&own);
            for (w, block) in later {
                for (r, line) in block.iter().enumerate() {
                    x[12 * w + r] -= line.iter().zip(&own).map(|(a, b)| a * b).sum::<f64>();
                }
            }
        }
        for (v, pivot, later) in self.0.iter().rev() {
            let mut own: [f64; 12] = std::array::from_fn(|k| x[12 * v + k]);
            for (w, block) in later {
                for (r, line) in block.iter().enumerate() {
                    add(&mut own, -x[12 * w + r], line);
                }
            }
            for k in (0..12).rev() {
                own[k] /= pivot[k][k];
                let (head, tail) = own.split_at_mut(k);
                add(head, -tail[0], &pivot[k]);
            }
            x[12 * v..12 * v + 12].copy_from_slice(&own);
        }
    }
}

/// Solves with a lower triangle.
fn forward(pivot: &GramBlock, x: &mut [f64; 12]) {
    for k in 0..12 {
        let known: f64 = (0..k).map(|l| pivot[k][l] * x[l]).sum();
        x[k] = (x[k] - known) / pivot[k][k];
    }
}

/// J with the factor of J^T J + shift.
struct Inverse<'a> {
    j: &'a Jacobian<'a>,
    factor: Factor,
    /// Singular values below are zero up to rounding.
    floor: f64,
}

impl<'a> Inverse<'a> {
    fn new(j: &'a Jacobian<'a>) -> Result<Self, AuditError> {
        let (diagonal, _) = j.gram();
        let entries = diagonal
            .iter()
            .flat_map(|block| (0..12).map(|k| block[k][k]));
        let sum: f64 = entries.clone().sum();
        if !sum.is_finite() {
            return Err(AuditError::NoConvergence);
        }
        let largest = entries.fold(0.0, f64::max);
        let order = order(j.blocks.graph);
        let shifts = std::iter::successors(Some(1e-15 * largest), |shift| Some(10.0 * shift));
        let mut shifts = shifts.take_while(|&shift| shift <= 1e-5 * largest);
        let factor = shifts.find_map(|shift| Factor::new(j, &order, shift));
        Ok(Self {
            j,
            factor: factor.ok_or(AuditError::NoFactor)?,
            floor: 1e-15 * largest.sqrt(),
        })
    }

    /// The `count` smallest singular values, to a relative change of `settled`.
    fn iterate(&self, count: usize, settled: f64) -> Result<Spectrum, AuditError> {
        let columns = self.j.size().1;
        let size = (count + GUARD).min(columns);
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let mut uniform = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
        let mut vectors: Columns = (0..size)
            .map(|_| (0..columns).map(|_| uniform()).collect())
            .collect();
        let mut values: Vec<f64> = vec![f64::INFINITY; size];
        for _ in 0..ITERATIONS {
            vectors.iter_mut().for_each(|x| self.factor.solve(x));
            orthonormal(&mut vectors);
            let (found, turns) = singular(self.j.times(&vectors), true)?;
            // Rising values: the last right singular vector first.
            let turned = turns.iter().rev().map(|turn| {
                let mut sum = vec![0.0; columns];
                turn.iter()
                    .zip(&vectors)
                    .for_each(|(&x, v)| add(&mut sum, x, v));
                sum
            });
            vectors = turned.collect();
            let found: Vec<f64> = found.into_iter().rev().collect();
            let done = found
                .iter()
                .zip(&values)
                .take(count)
                .all(|(new, old)| *new <= self.floor || (new - old).abs() <= settled * new);
            values = found;
            if done {
                break;
            }
        }
        values.truncate(count);
        Ok(Spectrum { values, vectors })
    }
}

/// Orthonormal vectors with |J v|^2 at most `tolerance`.
///
/// # Errors
/// As for [`smallest`].
pub fn null_space(j: &Jacobian, tolerance: f64) -> Result<Columns, AuditError> {
    let columns = j.size().1;
    let inverse = Inverse::new(j)?;
    let mut count = 8.min(columns);
    loop {
        let mut spectrum = inverse.iterate(count, ROUGHLY)?;
        let values = spectrum.values.iter();
        let small = values.take_while(|&&x| x * x <= tolerance).count();
        if small < count || count == columns {
            spectrum.vectors.truncate(small);
            return Ok(spectrum.vectors);
        }
        count = (2 * count).min(columns);
    }
}
