//! All points that solutions can come near, at one assignment of centres (docs/theory.md,
//! Theorems 10.8, 10.13, 10.14 and 10.21): an upper bound for the number of solutions.

use super::evidence::{AtMost, Limit, Spurious};
use super::exponents::Exponents;
use super::linear::settle;
use super::outside::{limits, outside};
use super::roots::{NoVectors, left_eigenvectors, transport};
use super::spurious::{self, is_spurious, tells_all};
use super::support::MinorSpan;
use super::system::{System, Values, subsets};
use crate::linalg::prime::PrimeField;

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
        for infinite in 0..=2.min(span.unknowns.len()) {
            found = space.points(system, values, span, infinite, draw);
            if found != Err(NoBound::Short) {
                return found;
            }
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

/// A form, and the places of the exponents that are present with all their products with its
/// monomials.
struct Form {
    monomials: Vec<Vec<usize>>,
    weights: Vec<u64>,
    inner: Vec<usize>,
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

    /// 1 with the unknowns, or a drawn form if some points may have up to so many infinite values:
    /// products of up to so many unknowns.
    fn form(&self, field: &PrimeField, infinite: usize, draw: &mut impl FnMut() -> u64) -> Form {
        let unknowns = self.exponents.bounds.len();
        let mut monomials = vec![vec![0; unknowns]];
        for size in 1..=infinite.max(1) {
            let all: Vec<usize> = (0..unknowns).collect();
            subsets(&all, size, &mut |chosen| {
                monomials.push(
                    (0..unknowns)
                        .map(|f| usize::from(chosen.contains(&f)))
                        .collect(),
                );
                true
            });
        }
        let mut weights = vec![0; monomials.len()];
        weights[0] = field.from_u64(1);
        if infinite > 0 {
            weights.iter_mut().for_each(|weight| *weight = draw());
        }
        let shifts: Vec<usize> = monomials.iter().map(|m| self.exponents.index(m)).collect();
        let smaller: Vec<usize> = self
            .exponents
            .bounds
            .iter()
            .map(|bound| bound - 1)
            .collect();
        let present = |place: &usize| shifts.iter().all(|shift| !self.absent[place + shift]);
        let inner = self.exponents.places(&smaller).into_iter().filter(present);
        Form {
            inner: inner.collect(),
            monomials,
            weights,
        }
    }

    /// The points of the space by a form.
    fn points(
        &self,
        system: &System<'_>,
        values: &Values,
        span: &MinorSpan,
        infinite: usize,
        draw: &mut impl FnMut() -> u64,
    ) -> Result<AtMost, NoBound> {
        let field = &system.field;
        let form = self.form(field, infinite, draw);
        if self.kernel.len() > form.inner.len() {
            return Err(NoBound::Short);
        }
        let multiplications = self.multiplications(field, &form)?;
        let vectors = common_eigenvectors(field, &multiplications, draw)?;
        let mut bound = AtMost {
            unknowns: span.unknowns.clone(),
            absent: self.exponents.marked(&self.absent),
            bounds: self.exponents.bounds.clone(),
            minors: span
                .generators
                .iter()
                .map(|generator| generator.polynomial.minor.clone())
                .collect(),
            points: Vec::new(),
            settled: Vec::new(),
            form: form
                .monomials
                .into_iter()
                .zip(form.weights.iter().map(|&weight| field.to_u64(weight)))
                .collect(),
            outside: Vec::new(),
            spurious: Vec::new(),
        };
        for combination in vectors {
            let mut vector = vec![0; self.exponents.len()];
            for (&factor, row) in combination.iter().zip(&self.kernel) {
                field.axpy(&mut vector, factor, row);
            }
            let homogeneous: Option<Vec<u64>> = multiplications
                .iter()
                .map(|matrix| eigenvalue(field, matrix, &combination))
                .collect();
            let homogeneous = homogeneous.ok_or(NoBound::Short)?;
            if homogeneous[..=span.unknowns.len()].contains(&0) {
                let (exponents, absent) = (&self.exponents, &self.absent);
                let beyond = outside(system, values, &span.unknowns, exponents, absent, &vector);
                if let Some(beyond) = beyond {
                    bound.outside.push(beyond);
                    continue;
                }
                if homogeneous[0] == 0 {
                    let limits = self.spurious(system, values, &span.unknowns, &vector);
                    bound.spurious.push(Spurious {
                        values: limits.ok_or(NoBound::Short)?,
                        settled: Vec::new(),
                    });
                    continue;
                }
            }
            let point =
                finite(field, &homogeneous[..=span.unknowns.len()]).ok_or(NoBound::Short)?;
            if !self.evaluates(field, &vector, &point) {
                return Err(NoBound::Short);
            }
            let mut values = values.clone();
            for (&f, &x) in span.unknowns.iter().zip(&point) {
                values[f] = Some(x);
            }
            let steps = settle(system, &mut values);
            if is_spurious(system, &spurious::finite(system, &values)) {
                let value = |&x: &u64| Limit::Finite(field.to_u64(x));
                bound.spurious.push(Spurious {
                    values: point.iter().map(value).collect(),
                    settled: steps,
                });
                continue;
            }
            let all: Option<Vec<u64>> = values.iter().copied().collect();
            let all = all.ok_or(NoBound::Short)?;
            bound
                .points
                .push(all.into_iter().map(|x| field.to_u64(x)).collect());
            bound.settled.push(steps);
        }
        Ok(bound)
    }

    /// The point of a vector with infinite values, if the rank is too large there.
    fn spurious(
        &self,
        system: &System<'_>,
        values: &Values,
        unknowns: &[usize],
        vector: &[u64],
    ) -> Option<Vec<Limit>> {
        let (exponents, absent) = (&self.exponents, &self.absent);
        let limits = limits(&system.field, exponents, absent, vector)?;
        let mut known = spurious::finite(system, values);
        for (&f, &limit) in unknowns.iter().zip(&limits) {
            known[f] = Some(limit);
        }
        let tells = tells_all(exponents, absent, &limits, vector);
        (tells && is_spurious(system, &known)).then_some(limits)
    }

    /// The matrices of multiplication by the monomials of a form, divided by the form.
    fn multiplications(
        &self,
        field: &PrimeField,
        form: &Form,
    ) -> Result<Vec<Vec<Vec<u64>>>, NoBound> {
        let images: Vec<Vec<Vec<u64>>> = form
            .monomials
            .iter()
            .map(|monomial| {
                let shift = self.exponents.index(monomial);
                let at = |vector: &Vec<u64>| form.inner.iter().map(|k| vector[k + shift]).collect();
                self.kernel.iter().map(at).collect()
            })
            .collect();
        let mut value = vec![vec![0; form.inner.len()]; self.kernel.len()];
        for (image, &weight) in images.iter().zip(&form.weights) {
            for (sum, row) in value.iter_mut().zip(image) {
                field.axpy(sum, weight, row);
            }
        }
        // The form has to be injective, and the kernel is no space of points if
        // multiplication leads out of it.
        let all = images.iter().map(|image| transport(field, &value, image));
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

/// The points as they are, if they are finite.
fn finite(field: &PrimeField, homogeneous: &[u64]) -> Option<Vec<u64>> {
    let inverse = field.inverse(homogeneous[0])?;
    let rest = homogeneous[1..].iter();
    Some(rest.map(|&x| field.times(x, inverse)).collect())
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
