//! The backend in Rust alone: num-bigint.

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{Euclid, ToPrimitive};
use std::cmp::Ordering;

pub(super) type Inner = BigInt;

pub(super) fn sign(a: &Inner) -> Ordering {
    match a.sign() {
        Sign::Minus => Ordering::Less,
        Sign::NoSign => Ordering::Equal,
        Sign::Plus => Ordering::Greater,
    }
}

pub(super) fn cmp_abs(a: &Inner, b: &Inner) -> Ordering {
    a.magnitude().cmp(b.magnitude())
}

pub(super) fn add(a: &Inner, b: &Inner) -> Inner {
    a + b
}

pub(super) fn sub(a: &Inner, b: &Inner) -> Inner {
    a - b
}

pub(super) fn mul(a: &Inner, b: &Inner) -> Inner {
    a * b
}

pub(super) fn neg(a: &Inner) -> Inner {
    -a
}

pub(super) fn mul_assign(a: &mut Inner, b: &Inner) {
    *a *= b;
}

pub(super) fn add_assign(a: &mut Inner, b: &Inner) {
    *a += b;
}

pub(super) fn sub_assign(a: &mut Inner, b: &Inner) {
    *a -= b;
}

pub(super) fn div_exact(a: &Inner, b: &Inner) -> Inner {
    a / b
}

pub(super) fn div_rem_euclid(a: &Inner, b: &Inner) -> (Inner, Inner) {
    a.div_rem_euclid(b)
}

pub(super) fn gcd(a: &Inner, b: &Inner) -> Inner {
    a.gcd(b)
}

pub(super) fn bits(a: &Inner) -> u64 {
    a.bits()
}

pub(super) fn rem_u64(a: &Inner, modulus: u64) -> u64 {
    let rest = a.magnitude() % modulus;
    let rest = rest
        .to_u64()
        .unwrap_or_else(|| unreachable!("a residue is below its modulus"));
    if rest > 0 && a.sign() == Sign::Minus {
        modulus - rest
    } else {
        rest
    }
}
