//! The span of minors in a few unknowns (docs/theory.md, Theorems 10.5, 10.7 and 10.23).
//!
//! In: a system and some of its unknowns. Out: minors with independent polynomials, the rank of
//! all their multiples within degree bounds, and the exponents that never occur.

use super::balanced::Balanced;
use super::exponents::Exponents;
use super::minors::{FEW, Minors, Next, Polynomial};
use super::system::{System, Values, subsets};
use super::zeros::{has_choice, has_transversal};
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

    /// Whether a coefficient is the zero polynomial in the centres by Theorem 10.7 or, if the minor is
    /// balanced, 10.23, which says more and costs more.
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
            let is_out_of_reach = match minor.shifts {
                None => !has_transversal(system, minor, unknowns, exponent),
                Some(_) => !has_choice(system, minor, unknowns, exponent),
            };
            let zero = coefficients[place] == 0 && is_out_of_reach;
            self.zero.borrow_mut()[place] = Some(zero);
            zero
        })
    }
}

/// Most values on a grid.
const MOST_VALUES: usize = 1 << 10;

/// After so many minors in a row that add nothing no more are looked at.
const MOST_IDLE: usize = 120;

/// The same in all unknowns at once, for those of other rows; their columns come in an order that is far
/// from any.
const MOST_IDLE_OF_ROWS: usize = 12;

/// The same of balanced minors, which are drawn.
const MOST_IDLE_OF_BALANCED: usize = 100;

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
    /// most, or dropped. Stops early when only one point is left. With more than [`FEW`] unknowns no row
    /// is freed: what freeing forgets is what is left over there.
    pub(super) fn new(system: &System<'_>, values: &Values, unknowns: &[usize]) -> Option<Self> {
        let degrees = system.core.degrees(&system.rows);
        let exponents = Exponents {
            bounds: unknowns.iter().map(|&f| degrees[f]).collect(),
        };
        if exponents.len() > MOST_VALUES {
            return None;
        }
        let (most_freed, patience, after) = match unknowns.len() {
            0..=FEW => (3, MOST_IDLE, Next::Nothing),
            _ => (0, MOST_IDLE_OF_ROWS, Next::Rows),
        };
        let mut collected = Collected::new(&exponents, patience, after);
        let minors = Minors::new(system, values, unknowns);
        let scaled = system.scaled(values);
        for size in (0..=scaled.len().min(most_freed)).rev() {
            let unfinished = subsets(&scaled, size, &mut |freed| {
                minors.with_freed(freed, &mut |polynomial| match system.is_stopped() {
                    true => Next::Nothing,
                    false => collected.add(&system.field, &exponents, polynomial),
                })
            });
            if !unfinished {
                break;
            }
        }
        Some(collected.into_span(unknowns, exponents))
    }

    /// The balanced minors in all unknowns without value, with one shift each (Lemma 10.24): in each term
    /// every node is taken as often. `which` says how often.
    pub(super) fn balanced(
        system: &System<'_>,
        values: &Values,
        unknowns: &[usize],
        which: usize,
    ) -> Option<Self> {
        let degrees = system.core.degrees(&system.rows);
        let exponents = Exponents {
            bounds: unknowns.iter().map(|&f| degrees[f]).collect(),
        };
        if exponents.len() > MOST_VALUES {
            return None;
        }
        let minors = Minors::new(system, values, unknowns);
        let mut balanced = Balanced::new(system, which)?;
        let mut collected = Collected::new(&exponents, MOST_IDLE_OF_BALANCED, Next::Rows);
        let mut next = Next::Minor;
        while next == Next::Minor && !system.is_stopped() {
            let drawn = balanced.draw(&minors, values, unknowns);
            next = match drawn.filter(|polynomial| polynomial.stays_within(&exponents)) {
                Some(polynomial) => collected.add(&system.field, &exponents, polynomial),
                None => collected.idle(),
            };
        }
        Some(collected.into_span(unknowns, exponents))
    }

    /// If only u = 1 is left (Theorem 10.5), the exponents that are absent: the rank is one less than
    /// the number of the others, and their differences generate all of Z^unknowns.
    pub(super) fn unique(&self, system: &System<'_>) -> Option<Vec<bool>> {
        let seen = self.seen(&self.exponents);
        let rank = self.shifts.dimension();
        // What is seen is present; what is not is asked for only if that can matter.
        if rank + 1 < seen.iter().filter(|seen| **seen).count() {
            return None;
        }
        let absent = self.absent(system, &self.exponents, &seen);
        let present = absent.iter().filter(|&&absent| !absent).count();
        (rank + 1 == present && steps_everywhere(&self.exponents, &absent)).then_some(absent)
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
    idle: usize,
    /// After so many in a row that add nothing.
    patience: usize,
    /// What is wanted then.
    after: Next,
}

impl Collected {
    fn new(exponents: &Exponents, patience: usize, after: Next) -> Self {
        Self {
            patience,
            after,
            span: Span::default(),
            polynomials: Vec::new(),
            seen: vec![false; exponents.len()],
            idle: 0,
        }
    }

    /// Takes a polynomial in if it adds to the span; returns which others are of use.
    fn add(&mut self, field: &PrimeField, exponents: &Exponents, polynomial: Polynomial) -> Next {
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
        if self.span.dimension() + 1 == seen && self.after == Next::Nothing {
            return Next::Nothing;
        }
        self.go_on()
    }

    /// One was looked at that adds nothing.
    fn idle(&mut self) -> Next {
        self.idle += 1;
        self.go_on()
    }

    fn go_on(&mut self) -> Next {
        if self.idle < self.patience {
            return Next::Minor;
        }
        self.idle = 0;
        self.after
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

    /// Whether listed shifts do not lead beyond the bounds.
    fn stays_within(&self, exponents: &Exponents) -> bool {
        let shifts = self.minor.shifts.iter().flatten();
        let within = |shift: &Vec<usize>| {
            let sums = shift
                .iter()
                .zip(&self.degrees)
                .map(|(b, degree)| b + degree);
            sums.zip(&exponents.bounds)
                .all(|(sum, &bound)| sum <= bound)
        };
        shifts.into_iter().all(within)
    }

    /// The places of the monomials by which it is multiplied within the bounds.
    fn shifts(&self, exponents: &Exponents) -> Vec<usize> {
        if let Some(shifts) = &self.minor.shifts {
            return shifts.iter().map(|shift| exponents.index(shift)).collect();
        }
        let room = exponents.bounds.iter().zip(&self.degrees);
        let room: Vec<usize> = room.map(|(bound, degree)| bound - degree).collect();
        exponents.places(&room)
    }
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
