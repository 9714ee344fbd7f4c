//! All points that solutions can come near, at one assignment of centres (docs/theory.md,
//! Theorem 10.8): an upper bound for the number of solutions.

use super::evidence::AtMost;
use super::exponents::Exponents;
use super::linear::settle;
use super::roots::{NoVectors, left_eigenvectors, transport};
use super::span::MinorSpan;
use super::system::{System, Values};
use crate::linalg::prime::PrimeField;
use std::iter;

/// Why there is no upper bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoBound {
    /// The points are not all rational at these centres; others may do.
    Irrational,
    /// The span is too small, or other unknowns are not settled.
    Short,
}

/// The most points that are looked for.
const MOST_POINTS: usize = 12;

/// The upper bound from the minors of a span.
pub(super) fn at_most(
    system: &System<'_>,
    values: &Values,
    span: &MinorSpan,
    draw: &mut impl FnMut() -> u64,
) -> Result<AtMost, NoBound> {
    // Degrees as they are may do; one more for each unknown is more work and has less kernel.
    let mut found = Err(NoBound::Short);
    for more in 0..=1 {
        let Some(space) = Space::new(system, span, more) else {
            continue;
        };
        found = space.points(system, values, span, draw);
        if found != Err(NoBound::Short) {
            return found;
        }
    }
    found
}

/// The vectors that all polynomials of a span annihilate.
struct Space {
    exponents: Exponents,
    absent: Vec<bool>,
    kernel: Vec<Vec<u64>>,
}

impl Space {
    /// `None` if there are too many vectors, or none.
    fn new(system: &System<'_>, span: &MinorSpan, more: usize) -> Option<Self> {
        let (exponents, absent, kernel) = span.annihilated(system, more, MOST_POINTS)?;
        (!kernel.is_empty()).then_some(Self {
            exponents,
            absent,
            kernel,
        })
    }

    /// The places of the exponents that are present with all their products with an unknown.
    fn inner(&self) -> Vec<usize> {
        let bounds = &self.exponents.bounds;
        let smaller: Vec<usize> = bounds.iter().map(|bound| bound - 1).collect();
        let present = |place: &usize| {
            let mut next = (0..bounds.len()).map(|f| place + self.exponents.stride(f));
            !self.absent[*place] && next.all(|next| !self.absent[next])
        };
        let inner = self.exponents.places(&smaller).into_iter().filter(present);
        inner.collect()
    }

    /// The points of the space, if all are finite.
    fn points(
        &self,
        system: &System<'_>,
        values: &Values,
        span: &MinorSpan,
        draw: &mut impl FnMut() -> u64,
    ) -> Result<AtMost, NoBound> {
        let field = &system.field;
        let inner = self.inner();
        if self.kernel.len() > inner.len() {
            return Err(NoBound::Short);
        }
        let multiplications = self.multiplications(field, &inner)?;
        let vectors = common_eigenvectors(field, &multiplications, draw)?;
        let mut bound = AtMost {
            unknowns: span.unknowns.clone(),
            absent: self.exponents.marked(&self.absent),
            bounds: self.exponents.bounds.clone(),
            minors: span.minors(),
            points: Vec::new(),
            settled: Vec::new(),
        };
        for combination in vectors {
            let mut vector = vec![0; self.exponents.len()];
            for (&factor, row) in combination.iter().zip(&self.kernel) {
                field.axpy(&mut vector, factor, row);
            }
            let point: Option<Vec<u64>> = multiplications
                .iter()
                .map(|matrix| eigenvalue(field, matrix, &combination))
                .collect();
            let point = point.ok_or(NoBound::Short)?.split_off(1);
            if !self.evaluates(field, &vector, &point) {
                return Err(NoBound::Short);
            }
            let mut values = values.clone();
            for (&f, &x) in span.unknowns.iter().zip(&point) {
                values[f] = Some(x);
            }
            let steps = settle(system, &mut values);
            let all: Option<Vec<u64>> = values.iter().copied().collect();
            let all = all.ok_or(NoBound::Short)?;
            bound
                .points
                .push(all.into_iter().map(|x| field.to_u64(x)).collect());
            bound.settled.push(steps);
        }
        Ok(bound)
    }

    /// The matrices of multiplication by 1 and by the unknowns.
    fn multiplications(
        &self,
        field: &PrimeField,
        inner: &[usize],
    ) -> Result<Vec<Vec<Vec<u64>>>, NoBound> {
        let image = |shift: usize| -> Vec<Vec<u64>> {
            let at = |vector: &Vec<u64>| inner.iter().map(|k| vector[k + shift]).collect();
            self.kernel.iter().map(at).collect()
        };
        let value = image(0);
        // The values have to tell vectors apart, and the kernel is no space of points if
        // multiplication leads out of it.
        let shifts = (0..self.exponents.bounds.len()).map(|f| self.exponents.stride(f));
        let all = iter::once(0).chain(shifts);
        let all = all.map(|shift| transport(field, &value, &image(shift)));
        all.collect::<Option<_>>().ok_or(NoBound::Short)
    }

    /// Whether a vector is a multiple of the values of all monomials at a point.
    fn evaluates(&self, field: &PrimeField, vector: &[u64], point: &[u64]) -> bool {
        let one = field.from_u64(1);
        let mut monomials = vec![one];
        for (&x, &bound) in point.iter().zip(&self.exponents.bounds) {
            let mut powers = vec![one];
            for k in 0..bound {
                powers.push(field.times(powers[k], x));
            }
            let longer = monomials
                .iter()
                .flat_map(|&m| powers.iter().map(move |&power| field.times(m, power)));
            monomials = longer.collect();
        }
        for (monomial, _) in monomials.iter_mut().zip(&self.absent).filter(|(_, a)| **a) {
            *monomial = 0;
        }
        let Some(at) = monomials.iter().position(|&x| x != 0) else {
            return false;
        };
        vector[at] != 0
            && vector
                .iter()
                .zip(&monomials)
                .all(|(&x, &y)| field.times(x, monomials[at]) == field.times(vector[at], y))
    }
}

/// Left eigenvectors of all matrices, which commute.
fn common_eigenvectors(
    field: &PrimeField,
    matrices: &[Vec<Vec<u64>>],
    draw: &mut impl FnMut() -> u64,
) -> Result<Vec<Vec<u64>>, NoBound> {
    let n = matrices[0].len();
    let mut sum = vec![vec![0; n]; n];
    for matrix in matrices {
        let weight = draw();
        for (sum, row) in sum.iter_mut().zip(matrix) {
            field.axpy(sum, weight, row);
        }
    }
    left_eigenvectors(field, &sum, draw).map_err(|why| match why {
        NoVectors::Irrational => NoBound::Irrational,
        NoVectors::Repeated => NoBound::Short,
    })
}

/// The eigenvalue of a left eigenvector, `None` if it is none.
fn eigenvalue(field: &PrimeField, matrix: &[Vec<u64>], vector: &[u64]) -> Option<u64> {
    let mut image = vec![0; vector.len()];
    for (&x, row) in vector.iter().zip(matrix) {
        field.axpy(&mut image, x, row);
    }
    let at = vector.iter().position(|&x| x != 0)?;
    let value = field.times(image[at], field.inverse(vector[at])?);
    let holds = vector
        .iter()
        .zip(&image)
        .all(|(&x, &y)| field.times(value, x) == y);
    holds.then_some(value)
}
