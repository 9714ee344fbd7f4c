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
    let (exponents, kernel) = span.annihilated(field, 1);
    if kernel.is_empty() || kernel.len() > MOST_POINTS {
        return Err(NoBound::Short);
    }
    let inner = restriction(&exponents, &kernel, None);
    let mut echelon = Echelon::default();
    if !inner.iter().all(|row| echelon.insert(field, row.clone())) {
        return Err(NoBound::Short);
    }
    let mut matrix = vec![vec![0; kernel.len()]; kernel.len()];
    for f in 0..span.unknowns.len() {
        let images = restriction(&exponents, &kernel, Some(f));
        // The kernel is no space of points if multiplication leads out of it.
        let by_unknown = transport(field, &inner, &images).ok_or(NoBound::Short)?;
        let weight = draw();
        for (sum, row) in matrix.iter_mut().zip(&by_unknown) {
            field.axpy(sum, weight, row);
        }
    }
    let vectors = left_eigenvectors(field, &matrix, draw).ok_or(NoBound::Irrational)?;
    let mut points = Vec::new();
    let mut settled = Vec::new();
    for vector in vectors {
        let point = evaluation(field, &exponents, &kernel, &vector).ok_or(NoBound::Short)?;
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
        bounds: exponents.bounds,
        minors: span.generators.iter().map(|generator| generator.minor.clone()).collect(),
        points,
        settled,
    })
}

/// The entries of vectors at the exponents a with every a + e_f within the bounds, or at a + e_f
/// for one f.
fn restriction(exponents: &Exponents, kernel: &[Vec<u64>], shift: Option<usize>) -> Vec<Vec<u64>> {
    let inner = Exponents { bounds: exponents.bounds.iter().map(|bound| bound - 1).collect() };
    let places: Vec<usize> = inner
        .all()
        .into_iter()
        .map(|mut exponent| {
            if let Some(f) = shift {
                exponent[f] += 1;
            }
            exponents.index(&exponent)
        })
        .collect();
    kernel.iter().map(|vector| places.iter().map(|&k| vector[k]).collect()).collect()
}

/// The point at which a combination of the vectors evaluates all monomials; `None` if there is
/// none.
fn evaluation(
    field: &PrimeField,
    exponents: &Exponents,
    kernel: &[Vec<u64>],
    combination: &[u64],
) -> Option<Vec<u64>> {
    let mut vector = vec![0; exponents.len()];
    for (&factor, row) in combination.iter().zip(kernel) {
        field.axpy(&mut vector, factor, row);
    }
    let scale = field.inverse(vector[0])?;
    for x in &mut vector {
        *x = field.times(*x, scale);
    }
    let unknowns = exponents.bounds.len();
    let point: Vec<u64> = (0..unknowns)
        .map(|f| {
            let exponent: Vec<usize> = (0..unknowns).map(|g| usize::from(f == g)).collect();
            vector[exponents.index(&exponent)]
        })
        .collect();
    let monomial = |exponent: &Vec<usize>| {
        let powers = exponent.iter().zip(&point).map(|(&e, &x)| field.pow(x, e as u64));
        powers.fold(field.from_u64(1), |product, power| field.times(product, power))
    };
    let holds = exponents.all().iter().zip(&vector).all(|(e, &x)| monomial(e) == x);
    holds.then_some(point)
}
