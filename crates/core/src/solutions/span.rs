//! The span of minors in a few unknowns (docs/theory.md, Theorems 10.7 and 10.8).
//!
//! In: a system and some of its unknowns. Out: minors with independent polynomials, the rank of
//! all their multiples within degree bounds, and the exponents that never occur.

use super::evidence::Minor;
use super::exponents::Exponents;
use super::minors::{Minors, Polynomial};
use super::system::{System, Values, subsets};
use super::zeros::has_transversal;
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;
use std::borrow::Cow;
use std::cell::RefCell;

/// A minor that is in the span.
pub(super) struct Generator {
    pub(super) polynomial: Polynomial,
    /// Which coefficients are the zero polynomial in the centres, as far as that was asked.
    zero: RefCell<Vec<Option<bool>>>,
}

impl Generator {
    fn new(polynomial: Polynomial) -> Self {
        Self {
            zero: RefCell::new(vec![None; polynomial.coefficients.len()]),
            polynomial,
        }
    }

    /// Whether a coefficient is the zero polynomial in the centres by Theorem 10.7.
    pub(super) fn is_zero(&self, system: &System<'_>, unknowns: &[usize], place: usize) -> bool {
        let known = self.zero.borrow()[place];
        known.unwrap_or_else(|| {
            let Polynomial {
                minor,
                degrees,
                coefficients,
            } = &self.polynomial;
            let bounds = degrees.clone();
            let exponent = &Exponents { bounds }.all()[place];
            let zero =
                coefficients[place] == 0 && !has_transversal(system, minor, unknowns, exponent);
            self.zero.borrow_mut()[place] = Some(zero);
            zero
        })
    }
}

/// Most values on a grid.
const MOST_VALUES: usize = 1 << 10;

/// After so many minors in a row that add nothing no more are looked at.
const MOST_IDLE: usize = 120;

/// The span of the minors in some unknowns, shifts within the bounds included.
pub(super) struct MinorSpan {
    /// The unknowns.
    pub(super) unknowns: Vec<usize>,
    pub(super) exponents: Exponents,
    /// Minors none of which is a combination of shifts of those before it.
    pub(super) generators: Vec<Generator>,
    /// All their shifts within the bounds.
    shifts: Span,
}

impl MinorSpan {
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
        for size in (0..=scaled.len().min(3)).rev() {
            let unfinished = subsets(&scaled, size, &mut |freed| {
                minors.with_freed(freed, &mut |polynomial| {
                    !system.is_stopped() && collected.add(&system.field, &exponents, polynomial)
                })
            });
            if !unfinished {
                break;
            }
        }
        Some(collected.into_span(unknowns, exponents))
    }

    /// The minors in the span.
    pub(super) fn minors(&self) -> Vec<Minor> {
        let minors = self.generators.iter();
        minors
            .map(|generator| generator.polynomial.minor.clone())
            .collect()
    }

    /// The exponents at which some shift of a generator has a coefficient at these centres.
    fn seen(&self, exponents: &Exponents) -> Vec<bool> {
        let mut seen = vec![false; exponents.len()];
        for generator in &self.generators {
            let polynomial = &generator.polynomial;
            let own = exponents.places(&polynomial.degrees);
            let present = own.iter().zip(&polynomial.coefficients);
            let present: Vec<usize> = present
                .filter(|&(_, &coefficient)| coefficient != 0)
                .map(|(&place, _)| place)
                .collect();
            for shift in polynomial.shifts(exponents) {
                present.iter().for_each(|place| seen[place + shift] = true);
            }
        }
        seen
    }

    /// The exponents at which no shift of a generator has a coefficient, at any centres.
    fn absent(&self, system: &System<'_>, exponents: &Exponents, seen: &[bool]) -> Vec<bool> {
        let mut absent: Vec<bool> = seen.iter().map(|seen| !seen).collect();
        for generator in &self.generators {
            let own = exponents.places(&generator.polynomial.degrees);
            for shift in generator.polynomial.shifts(exponents) {
                for (k, place) in own.iter().enumerate() {
                    let absent = &mut absent[place + shift];
                    *absent = *absent && generator.is_zero(system, &self.unknowns, k);
                }
            }
        }
        absent
    }

    /// All exponents up to `more` above the bounds, which of them are absent, and a basis of the
    /// vectors on the others that all shifts of the generators annihilate; `None` if there are
    /// more than `most` of these, or too many exponents.
    pub(super) fn annihilated(
        &self,
        system: &System<'_>,
        more: usize,
        most: usize,
    ) -> Option<(Exponents, Vec<bool>, Vec<Vec<u64>>)> {
        let field = &system.field;
        let bounds = self.exponents.bounds.iter().map(|bound| bound + more);
        let exponents = Exponents {
            bounds: bounds.collect(),
        };
        if exponents.len() > MOST_VALUES {
            return None;
        }
        let shifts = match more {
            0 => Cow::Borrowed(&self.shifts),
            _ => Cow::Owned(self.shifts_within(field, &exponents)),
        };
        let seen = self.seen(&exponents);
        // An exponent that is absent is not seen.
        if seen.iter().filter(|seen| **seen).count() > shifts.dimension() + most {
            return None;
        }
        let absent = self.absent(system, &exponents, &seen);
        let mut kernel = shifts.kernel(field, exponents.len());
        // At an absent exponent all shifts vanish, so it has a vector of its own.
        kernel.retain(|vector| {
            vector
                .iter()
                .zip(&absent)
                .any(|(&x, absent)| x != 0 && !absent)
        });
        (kernel.len() <= most).then_some((exponents, absent, kernel))
    }

    /// All shifts of the generators within some bounds.
    fn shifts_within(&self, field: &PrimeField, exponents: &Exponents) -> Span {
        let mut span = Span::default();
        for generator in &self.generators {
            generator.polynomial.each_shift(exponents, &mut |shifted| {
                span.take(field, shifted);
            });
        }
        span
    }
}

/// Polynomials with independent shifts.
struct Collected {
    span: Span,
    polynomials: Vec<Polynomial>,
    /// Where some shift has a coefficient at these centres.
    seen: Vec<bool>,
    /// So many in a row added nothing.
    idle: usize,
}

impl Collected {
    fn new(exponents: &Exponents) -> Self {
        Self {
            span: Span::default(),
            polynomials: Vec::new(),
            seen: vec![false; exponents.len()],
            idle: 0,
        }
    }

    /// Takes a polynomial in if it adds to the span; returns whether others are of use.
    fn add(&mut self, field: &PrimeField, exponents: &Exponents, polynomial: Polynomial) -> bool {
        let mut new = false;
        polynomial.each_shift(exponents, &mut |shifted| {
            for (seen, &coefficient) in self.seen.iter_mut().zip(shifted.iter()) {
                *seen |= coefficient != 0;
            }
            new |= self.span.take(field, shifted);
        });
        if new {
            self.polynomials.push(polynomial);
            self.idle = 0;
        } else {
            self.idle += 1;
        }
        // The vector of ones is always annihilated.
        let seen = self.seen.iter().filter(|&&seen| seen).count();
        self.span.dimension() + 1 != seen && self.idle < MOST_IDLE
    }

    fn into_span(self, unknowns: &[usize], exponents: Exponents) -> MinorSpan {
        let generators = self.polynomials.into_iter().map(Generator::new);
        MinorSpan {
            unknowns: unknowns.to_vec(),
            generators: generators.collect(),
            shifts: self.span,
            exponents,
        }
    }
}

impl Polynomial {
    /// Calls `each` with all multiples by a monomial within the bounds.
    fn each_shift(&self, exponents: &Exponents, each: &mut impl FnMut(&mut Vec<u64>)) {
        let own = exponents.places(&self.degrees);
        let mut vector = Vec::new();
        for shift in self.shifts(exponents) {
            vector.clear();
            vector.resize(exponents.len(), 0);
            for (&place, &coefficient) in own.iter().zip(&self.coefficients) {
                vector[place + shift] = coefficient;
            }
            each(&mut vector);
        }
    }

    /// The places of the monomials by which it is multiplied within the bounds.
    fn shifts(&self, exponents: &Exponents) -> Vec<usize> {
        let room = exponents.bounds.iter().zip(&self.degrees);
        let room: Vec<usize> = room.map(|(bound, degree)| bound - degree).collect();
        exponents.places(&room)
    }
}
