//! The backend in C: GMP through rug.

use rug::Integer;
use std::cmp::Ordering;

pub type Inner = Integer;

pub fn sign(a: &Inner) -> Ordering {
    a.cmp0()
}

pub fn cmp_abs(a: &Inner, b: &Inner) -> Ordering {
    a.cmp_abs(b)
}

pub fn add(a: &Inner, b: &Inner) -> Inner {
    Inner::from(a + b)
}

pub fn sub(a: &Inner, b: &Inner) -> Inner {
    Inner::from(a - b)
}

pub fn mul(a: &Inner, b: &Inner) -> Inner {
    Inner::from(a * b)
}

pub fn neg(a: &Inner) -> Inner {
    Inner::from(-a)
}

pub fn mul_assign(a: &mut Inner, b: &Inner) {
    *a *= b;
}

pub fn add_assign(a: &mut Inner, b: &Inner) {
    *a += b;
}

pub fn sub_assign(a: &mut Inner, b: &Inner) {
    *a -= b;
}

pub fn div_exact(a: &Inner, b: &Inner) -> Inner {
    Inner::from(a.div_exact_ref(b))
}

pub fn div_rem_euclid(a: &Inner, b: &Inner) -> (Inner, Inner) {
    a.div_rem_euc_ref(b).into()
}

pub fn gcd(a: &Inner, b: &Inner) -> Inner {
    Inner::from(a.gcd_ref(b))
}

pub fn bits(a: &Inner) -> u64 {
    u64::from(a.significant_bits())
}

pub fn rem_u64(a: &Inner, modulus: u64) -> u64 {
    let (_, rest) = div_rem_euclid(a, &Inner::from(modulus));
    rest.to_u64()
        .unwrap_or_else(|| unreachable!("a residue is below its modulus"))
}
