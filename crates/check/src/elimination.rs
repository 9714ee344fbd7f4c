//! Elimination modulo a prime: sparse, with prescribed or found pivots; dense along the diagonal;
//! and the one after the other. Every loop that may take long counts its operations before the
//! limits, row by row.

mod dense;
mod factors;
mod sparse;
mod threads;

pub(crate) use dense::Dense;
pub(crate) use factors::{Factors, TOGETHER};
pub(crate) use sparse::Echelon;
pub(crate) use threads::for_all;

use crate::algebra::{Field, Ring, SMALL};

/// What one entry of a row that is subtracted counts as: in a sparse row; in a dense one modulo a
/// prime of up to 62 bits; and, by definition, in a dense one modulo a prime below 2^29.
pub(crate) const SPARSE: u64 = 8;
const DENSE: u64 = 4;
const DENSE_SMALL: u64 = 1;

/// Adds the products of a value with elements to sums of products. A sum is an element once it is
/// `settled`.
fn add_products<const N: usize>(
    field: &Field,
    sums: &mut [u64; N],
    factors: &[u64; N],
    value: u64,
) {
    if field.p >= SMALL {
        for (sum, &factor) in sums.iter_mut().zip(factors) {
            *sum = field.add(*sum, field.mul(factor, value));
        }
        return;
    }
    // A product is below 2^58, and the sum before it below 2^63.
    for (sum, &factor) in sums.iter_mut().zip(factors) {
        *sum += (factor & 0xffff_ffff) * (value & 0xffff_ffff);
    }
    if sums.iter().fold(0, |bits, sum| bits | sum) >> 63 != 0 {
        sums.iter_mut().for_each(|sum| *sum %= field.p);
    }
}

/// Elements as sums of products.
fn to_sums<const N: usize>(field: &Field, row: &mut [u64; N]) {
    let elements = std::mem::replace(row, [0; N]);
    add_products(field, row, &elements, field.one);
}

/// The element that a sum of products stands for.
fn settled(field: &Field, sum: u64) -> u64 {
    if field.p < SMALL {
        field.add_products(0, u128::from(sum))
    } else {
        sum
    }
}

#[cfg(test)]
mod tests;
