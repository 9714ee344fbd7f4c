//! All points that solutions can come near, at one assignment of centres (docs/theory.md,
//! Theorem 10.8): an upper bound for the number of solutions.

use super::echelon::Echelon;
use super::linear::{Linear, settle};
use super::roots::{left_eigenvectors, transport};
use super::support::{Exponents, Minor, Span};
use super::system::{System, Values};
use crate::linalg::prime::PrimeField;

/// The points of the theorem, with the other unknowns settled at each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AtMost {
    /// The unknowns that are not settled by linear algebra.
    pub unknowns: Vec<usize>,
    /// The largest exponent of each, shifts included.
    pub bounds: Vec<usize>,
    /// Exponents within the bounds at which all coefficients are zero by Theorem 10.7.
    pub absent: Vec<Vec<usize>>,
    /// Minors that vanish at all solutions.
    pub minors: Vec<Minor>,
    /// The values of all unknowns at each point, as least residues.
    pub points: Vec<Vec<u64>>,
    /// How the other unknowns are settled at each point.
    pub settled: Vec<Vec<Linear>>,
}

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
    span: &Span,
    draw: &mut impl FnMut() -> u64,
) -> Result<AtMost, NoBound> {
    let field = &system.field;
    let (exponents, absent, kernel) = span.annihilated(field, 1);
    if kernel.is_empty() || kernel.len() > MOST_POINTS {
        return Err(NoBound::Short);
    }
    let inner_places = inner_places(&exponents, &absent);
    let inner = restriction(&exponents, &inner_places, &kernel, None);
    let mut echelon = Echelon::default();
    if !inner.iter().all(|row| echelon.insert(field, row.clone())) {
        return Err(NoBound::Short);
    }
    let mut matrix = vec![vec![0; kernel.len()]; kernel.len()];
    let mut multiplications = Vec::new();
    for f in 0..span.unknowns.len() {
        let images = restriction(&exponents, &inner_places, &kernel, Some(f));
        // The kernel is no space of points if multiplication leads out of it.
        let by_unknown = transport(field, &inner, &images).ok_or(NoBound::Short)?;
        let weight = draw();
        for (sum, row) in matrix.iter_mut().zip(&by_unknown) {
            field.axpy(sum, weight, row);
        }
        multiplications.push(by_unknown);
    }
    let vectors = left_eigenvectors(field, &matrix, draw).ok_or(NoBound::Irrational)?;
    let mut points = Vec::new();
    let mut settled = Vec::new();
    for vector in vectors {
        let point: Option<Vec<u64>> = multiplications
            .iter()
            .map(|matrix| eigenvalue(field, matrix, &vector))
            .collect();
        let point = point.ok_or(NoBound::Short)?;
        if !evaluates(field, &exponents, &absent, &kernel, &vector, &point) {
            return Err(NoBound::Short);
        }
        let mut values = values.clone();
        for (&f, &x) in span.unknowns.iter().zip(&point) {
            values[f] = Some(x);
        }
        let steps = settle(system, &mut values);
        let all: Option<Vec<u64>> = values.iter().copied().collect();
        let all = all.ok_or(NoBound::Short)?;
        points.push(all.into_iter().map(|x| field.to_u64(x)).collect());
        settled.push(steps);
    }
    Ok(AtMost {
        unknowns: span.unknowns.clone(),
        absent: exponents.marked(&absent),
        bounds: exponents.bounds,
        minors: span
            .generators
            .iter()
            .map(|generator| generator.minor.clone())
            .collect(),
        points,
        settled,
    })
}

/// The exponents a that are present with every a + e_f.
fn inner_places(exponents: &Exponents, absent: &[bool]) -> Vec<Vec<usize>> {
    let present = |exponent: &[usize]| {
        exponent
            .iter()
            .zip(&exponents.bounds)
            .all(|(e, bound)| e <= bound)
            && !absent[exponents.index(exponent)]
    };
    let inner = |exponent: &Vec<usize>| {
        present(exponent)
            && (0..exponent.len()).all(|f| {
                let mut next = exponent.clone();
                next[f] += 1;
                present(&next)
            })
    };
    exponents.all().into_iter().filter(inner).collect()
}

/// The entries of vectors at some exponents, or at these plus e_f for one f.
fn restriction(
    exponents: &Exponents,
    inner: &[Vec<usize>],
    kernel: &[Vec<u64>],
    shift: Option<usize>,
) -> Vec<Vec<u64>> {
    let places: Vec<usize> = inner
        .iter()
        .map(|exponent| {
            let mut exponent = exponent.clone();
            if let Some(f) = shift {
                exponent[f] += 1;
            }
            exponents.index(&exponent)
        })
        .collect();
    kernel
        .iter()
        .map(|vector| places.iter().map(|&k| vector[k]).collect())
        .collect()
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

/// Whether a combination of the vectors is a multiple of the values of all monomials at a point.
fn evaluates(
    field: &PrimeField,
    exponents: &Exponents,
    absent: &[bool],
    kernel: &[Vec<u64>],
    combination: &[u64],
    point: &[u64],
) -> bool {
    let mut vector = vec![0; exponents.len()];
    for (&factor, row) in combination.iter().zip(kernel) {
        field.axpy(&mut vector, factor, row);
    }
    let monomials = exponents
        .all()
        .into_iter()
        .zip(absent)
        .map(|(exponent, &absent)| {
            let powers = exponent
                .iter()
                .zip(point)
                .map(|(&e, &x)| field.pow(x, e as u64));
            let product = powers.fold(field.from_u64(1), |product, power| {
                field.times(product, power)
            });
            if absent { 0 } else { product }
        });
    let monomials: Vec<u64> = monomials.collect();
    let Some(at) = monomials.iter().position(|&x| x != 0) else {
        return false;
    };
    let Some(inverse) = field.inverse(monomials[at]) else {
        return false;
    };
    let scale = field.times(vector[at], inverse);
    scale != 0
        && vector
            .iter()
            .zip(&monomials)
            .all(|(&x, &y)| x == field.times(scale, y))
}
