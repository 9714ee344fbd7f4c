//! Points at which the rank of N(u) is too large for a solution to be near (docs/theory.md, Theorem 10.21).
//!
//! In: a point that all polynomials of a span annihilate, and what is known of the other unknowns there.
//! Out: whether the rows without open unknowns have a larger rank than at any solution.

use super::evidence::Limit;
use super::exponents::Exponents;
use super::outside::factors;
use super::system::{System, Values};
use crate::linalg::span::Span;

/// Whether the rows without open unknowns have a rank above 3 n' - 4. Of a row with an infinite scale that
/// side alone is left; rows with two scales that are zero, or two that are infinite, are left out.
pub(super) fn is_spurious(system: &System<'_>, values: &[Option<Limit>]) -> bool {
    let field = &system.field;
    let mut span = Span::default();
    for row in &system.rows {
        let open = row.unknowns().any(|f| values[f].is_none());
        let limit = |f: usize| values[f].unwrap_or(Limit::Finite(1));
        let Some([plus, minus]) = factors(field, row, limit).filter(|_| !open) else {
            continue;
        };
        let mut vector = vec![0; system.columns];
        for (side, factor) in row.sides.iter().zip([plus, field.negate(minus)]) {
            field.axpy(&mut vector[3 * side.node..][..3], factor, &side.vector);
        }
        span.insert(field, vector);
    }
    span.dimension() > system.target
}

/// Values that are finite, as limits.
pub(super) fn finite(system: &System<'_>, values: &Values) -> Vec<Option<Limit>> {
    let limit = |&x: &u64| Limit::Finite(system.field.to_u64(x));
    values
        .iter()
        .map(|value| value.as_ref().map(limit))
        .collect()
}

/// Whether some quotient of two entries of the vector tells each value: a pair of exponents that differ by
/// one in this unknown, neither of them absent, and not zero at the smaller one, for an infinite value at
/// the larger one.
pub(super) fn tells_all(
    exponents: &Exponents,
    absent: &[bool],
    limits: &[Limit],
    vector: &[u64],
) -> bool {
    let all = exponents.all();
    limits.iter().enumerate().all(|(f, limit)| {
        let stride = exponents.stride(f);
        (0..all.len()).any(|k| {
            all[k][f] < exponents.bounds[f] && !absent[k] && !absent[k + stride] && {
                let at = match limit {
                    Limit::Finite(_) => k,
                    Limit::Infinite => k + stride,
                };
                vector[at] != 0
            }
        })
    })
}
