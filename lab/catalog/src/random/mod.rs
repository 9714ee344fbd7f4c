//! Connected random graphs, sampled exactly.
//!
//! The law: every pair of n labelled nodes is an edge with probability p, independently,
//! *conditioned on the graph being connected*. Given its number of edges m a graph
//! has probability proportional to p^m (1 - p)^(n (n - 1) / 2 - m), whichever it is; so under
//! the condition m has a probability proportional to C(n, m) p^m (1 - p)^(n (n - 1) / 2 - m),
//! where C(n, m) is the number of connected labelled graphs, and given m every
//! connected graph with m edges is equally likely. [`Sampler`] draws m by these weights,
//! which are integers if p is a decimal fraction, then a graph by [`Counts`].

mod counts;
mod fisher;

pub use counts::Counts;
pub use fisher::fisher;

use num_bigint::BigUint;
use num_traits::{One, Zero};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha20Rng;
use std::str::FromStr;
use viewcert::graph::Graph;

/// A probability that is a decimal fraction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Density {
    numerator: u64,
    denominator: u64,
}

/// A word that is not a density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a density is a decimal fraction above 0 and at most 1, with at most 15 decimals, or a \
     percentage: 0.05 or 5%"
)]
pub struct BadDensity;

impl FromStr for Density {
    type Err = BadDensity;

    fn from_str(text: &str) -> Result<Self, BadDensity> {
        let (number, percent) = match text.strip_suffix('%') {
            Some(number) => (number, true),
            None => (text, false),
        };
        let (whole, decimals) = number.split_once('.').unwrap_or((number, ""));
        let digits = |text: &str| text.len() <= 15 && text.bytes().all(|b| b.is_ascii_digit());
        if whole.is_empty() && decimals.is_empty() || !digits(whole) || !digits(decimals) {
            return Err(BadDensity);
        }
        let mut denominator = 10u64.pow(decimals.len() as u32);
        if percent {
            denominator *= 100;
        }
        let numerator: u64 = format!("{whole}{decimals}")
            .parse()
            .map_err(|_| BadDensity)?;
        if numerator == 0 || numerator > denominator {
            return Err(BadDensity);
        }
        let common = num_integer::gcd(numerator, denominator);
        Ok(Self {
            numerator: numerator / common,
            denominator: denominator / common,
        })
    }
}

impl Density {
    /// The nearest double.
    pub fn value(&self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

/// Draws connected graphs of one size and density.
pub struct Sampler {
    counts: Counts,
    nodes: usize,
    /// Sums of the weights of 0, 1, ..., m edges.
    cumulative: Vec<BigUint>,
}

impl Sampler {
    /// Prepares the sampling of connected graphs with `nodes` >= 1 nodes. O(n^5)
    /// operations on integers of n^2 / 2 bits and more.
    pub fn new(nodes: usize, density: &Density) -> Self {
        let counts = Counts::new(nodes);
        let pairs = nodes * (nodes - 1) / 2;
        let present = BigUint::from(density.numerator);
        let absent = BigUint::from(density.denominator - density.numerator);
        let powers = |base: &BigUint| {
            let mut power = BigUint::one();
            let mut all = vec![power.clone()];
            for _ in 0..pairs {
                power *= base;
                all.push(power.clone());
            }
            all
        };
        let (present, absent) = (powers(&present), powers(&absent));
        let mut sum = BigUint::zero();
        let cumulative = (0..=pairs)
            .map(|m| {
                sum += counts.connected(nodes, m) * &present[m] * &absent[pairs - m];
                sum.clone()
            })
            .collect();
        Self {
            counts,
            nodes,
            cumulative,
        }
    }

    /// The probability of each number of edges, as doubles.
    pub fn edge_law(&self) -> Vec<f64> {
        let total = &self.cumulative[self.cumulative.len() - 1];
        let mut before = BigUint::zero();
        self.cumulative
            .iter()
            .map(|sum| {
                let weight = sum - std::mem::replace(&mut before, sum.clone());
                ratio(&weight, total)
            })
            .collect()
    }

    /// Draws a graph. The same state of the generator gives the same graph.
    pub fn draw(&self, generator: &mut impl Rng) -> Graph {
        let total = &self.cumulative[self.cumulative.len() - 1];
        let drawn = below(generator, total);
        let edges = self.cumulative.partition_point(|sum| *sum <= drawn);
        self.counts.draw(self.nodes, edges, generator)
    }
}

/// The generator of sample `sample` of an experiment: samples do not depend on one
/// another, nor on how many there are.
pub fn generator(seed: u64, sample: u64) -> ChaCha20Rng {
    let mut generator = ChaCha20Rng::seed_from_u64(seed);
    generator.set_stream(sample);
    generator
}

/// A uniform integer in `0..bound`, by rejection of strings of random bits.
pub(crate) fn below(generator: &mut impl Rng, bound: &BigUint) -> BigUint {
    let bits = bound.bits();
    let words = bits.div_ceil(32) as usize;
    let spare = 32 * words as u64 - bits;
    loop {
        let mut digits: Vec<u32> = (0..words).map(|_| generator.next_u32()).collect();
        if let Some(top) = digits.last_mut() {
            *top >>= spare;
        }
        let drawn = BigUint::new(digits);
        if drawn < *bound {
            return drawn;
        }
    }
}

/// A quotient as a double, for integers of any size.
pub(crate) fn ratio(numerator: &BigUint, denominator: &BigUint) -> f64 {
    // Enough bits that a quotient of more than 2^-1000 keeps 64 of them.
    let shift = 1100;
    let quotient: BigUint = (numerator << shift) / denominator;
    let cut = quotient.bits().saturating_sub(64);
    let head = (&quotient >> cut).iter_u64_digits().next().unwrap_or(0) as f64;
    // In two steps: neither power may underflow.
    let exponent = cut as i32 - shift;
    let half = exponent.div_euclid(2);
    head * 2f64.powi(half) * 2f64.powi(exponent - half)
}

#[cfg(test)]
mod tests;
