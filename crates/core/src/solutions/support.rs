//! The span of minors in a few unknowns (docs/theory.md, Theorems 10.5 and 10.7).
//!
//! In: a system and some of its unknowns. Out: minors with independent polynomials, the rank of
//! all their multiples within degree bounds, and the exponents that never occur.

use super::echelon::Echelon;
use super::exponents::Exponents;
use super::minors::{Minors, Polynomial};
use super::system::{System, Values, subsets};
use super::zeros::has_transversal;
use crate::linalg::prime::PrimeField;

/// A minor that is in the span, and where its coefficients are zero at all centres.
pub(super) struct Generator {
    pub(super) polynomial: Polynomial,
    /// Which coefficients are the zero polynomial in the centres by Theorem 10.7.
    pub(super) zero: Vec<bool>,
}

/// Most values on a grid.
const MOST_VALUES: usize = 1 << 10;

/// After so many minors in a row that add nothing no more are looked at.
const MOST_IDLE: usize = 120;

/// The span of the minors in some unknowns, shifts within the bounds included.
pub(super) struct Span {
    /// The unknowns.
    pub(super) unknowns: Vec<usize>,
    pub(super) exponents: Exponents,
    /// Minors none of which is a combination of shifts of those before it.
    pub(super) generators: Vec<Generator>,
    rank: usize,
    /// Exponents at which no shift of a generator has a coefficient, at any centres.
    pub(super) absent: Vec<bool>,
}

impl Span {
    /// The minors in some unknowns without value; other rows with unknowns are freed, three at
    /// most, or dropped. Stops early when only one point is left.
    pub(super) fn new(system: &System<'_>, values: &Values, unknowns: &[usize]) -> Option<Self> {
        let degrees = system.core.degrees(&system.rows);
        let exponents = Exponents {
            bounds: unknowns.iter().map(|&f| degrees[f]).collect(),
        };
        if exponents.len() > MOST_VALUES {
            return None;
        }
        let mut collected = Collected::new(&exponents);
        let minors = Minors::new(system, values, unknowns);
        let scaled = system.scaled(values);
        for size in (0..=3.min(scaled.len())).rev() {
            let unfinished = subsets(&scaled, size, &mut |freed| {
                minors.with_freed(freed, &mut |polynomial| {
                    collected.add(&system.field, &exponents, polynomial)
                })
            });
            if !unfinished {
                break;
            }
        }
        let rank = collected.echelon.rank();
        let generator = |polynomial: Polynomial| Generator {
            zero: zeros(system, unknowns, &polynomial),
            polynomial,
        };
        let mut span = Self {
            unknowns: unknowns.to_vec(),
            absent: Vec::new(),
            generators: collected.polynomials.into_iter().map(generator).collect(),
            rank,
            exponents,
        };
        span.absent = span.absent(&span.exponents);
        Some(span)
    }

    /// Whether only u = 1 is left (Theorem 10.5): the rank is one less than the number of exponents,
    /// and differences of exponents generate all of Z^unknowns.
    pub(super) fn is_unique(&self) -> bool {
        let present = self.absent.iter().filter(|&&absent| !absent).count();
        self.rank + 1 == present && steps_everywhere(&self.exponents, &self.absent)
    }

    /// The exponents at which no shift of a generator has a coefficient, at any centres.
    fn absent(&self, exponents: &Exponents) -> Vec<bool> {
        let mut absent = vec![true; exponents.len()];
        for generator in &self.generators {
            let own = exponents.places(&generator.polynomial.degrees);
            let present = own.iter().zip(&generator.zero).filter(|(_, zero)| !**zero);
            let present: Vec<usize> = present.map(|(&place, _)| place).collect();
            for shift in exponents.places(&generator.polynomial.room(exponents)) {
                for place in &present {
                    absent[place + shift] = false;
                }
            }
        }
        absent
    }

    /// All exponents up to `more` above the bounds, which of them are absent, and a basis of the
    /// vectors on the others that all shifts of the generators annihilate.
    pub(super) fn annihilated(
        &self,
        field: &PrimeField,
        more: usize,
    ) -> (Exponents, Vec<bool>, Vec<Vec<u64>>) {
        let bounds = self.exponents.bounds.iter().map(|bound| bound + more);
        let exponents = Exponents {
            bounds: bounds.collect(),
        };
        let mut echelon = Echelon::default();
        for generator in &self.generators {
            for shifted in generator.polynomial.shifts(&exponents) {
                echelon.insert(field, shifted);
            }
        }
        let absent = self.absent(&exponents);
        let mut kernel = echelon.kernel(field, exponents.len());
        // At an absent exponent all shifts vanish, so it has a vector of its own.
        kernel.retain(|vector| {
            vector
                .iter()
                .zip(&absent)
                .any(|(&x, absent)| x != 0 && !absent)
        });
        (exponents, absent, kernel)
    }
}

/// Polynomials with independent shifts.
struct Collected {
    echelon: Echelon,
    polynomials: Vec<Polynomial>,
    /// Where some shift has a coefficient at these centres.
    seen: Vec<bool>,
    idle: usize,
}

impl Collected {
    fn new(exponents: &Exponents) -> Self {
        Self {
            echelon: Echelon::default(),
            polynomials: Vec::new(),
            seen: vec![false; exponents.len()],
            idle: 0,
        }
    }

    /// Takes a polynomial in if it adds to the span; returns whether more are of use.
    fn add(&mut self, field: &PrimeField, exponents: &Exponents, polynomial: Polynomial) -> bool {
        let mut new = false;
        for shifted in polynomial.shifts(exponents) {
            for (seen, &coefficient) in self.seen.iter_mut().zip(&shifted) {
                *seen |= coefficient != 0;
            }
            new |= self.echelon.insert(field, shifted);
        }
        if new {
            self.polynomials.push(polynomial);
            self.idle = 0;
        } else {
            self.idle += 1;
        }
        // The vector of ones is always annihilated.
        let seen = self.seen.iter().filter(|&&seen| seen).count();
        self.echelon.rank() + 1 < seen && self.idle < MOST_IDLE
    }
}

impl Polynomial {
    /// All multiples by a monomial within the bounds.
    fn shifts(&self, exponents: &Exponents) -> Vec<Vec<u64>> {
        let own = exponents.places(&self.degrees);
        let shifts = exponents.places(&self.room(exponents)).into_iter();
        let shifted = shifts.map(|shift| {
            let mut vector = vec![0; exponents.len()];
            for (&place, &coefficient) in own.iter().zip(&self.coefficients) {
                vector[place + shift] = coefficient;
            }
            vector
        });
        shifted.collect()
    }

    /// How far shifts may go within the bounds.
    fn room(&self, exponents: &Exponents) -> Vec<usize> {
        let room = exponents.bounds.iter().zip(&self.degrees);
        room.map(|(bound, degree)| bound - degree).collect()
    }
}

/// Which coefficients are zero at all centres by Theorem 10.7.
fn zeros(system: &System<'_>, unknowns: &[usize], polynomial: &Polynomial) -> Vec<bool> {
    let own = Exponents {
        bounds: polynomial.degrees.clone(),
    };
    own.all()
        .iter()
        .zip(&polynomial.coefficients)
        .map(|(exponent, &coefficient)| {
            coefficient == 0 && !has_transversal(system, &polynomial.minor, unknowns, exponent)
        })
        .collect()
}

/// Whether for every unknown some exponent and the next one are both present.
fn steps_everywhere(exponents: &Exponents, absent: &[bool]) -> bool {
    let all = exponents.all();
    (0..exponents.bounds.len()).all(|f| {
        let stride = exponents.stride(f);
        all.iter().enumerate().any(|(place, exponent)| {
            exponent[f] < exponents.bounds[f] && !absent[place] && !absent[place + stride]
        })
    })
}
