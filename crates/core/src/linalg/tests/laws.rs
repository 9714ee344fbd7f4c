//! The axioms as assertions, for the tests of every ring.

use crate::linalg::{Field, Ring};

/// The axioms of a commutative ring with one, at three elements.
pub(in crate::linalg) fn ring<R: Ring>(r: &R, a: &R::Elem, b: &R::Elem, c: &R::Elem) {
    let (zero, one) = (r.zero(), r.one());
    assert!(r.is_zero(&zero) && !r.is_zero(&one));
    assert_eq!(r.add(a, b), r.add(b, a));
    assert_eq!(r.mul(a, b), r.mul(b, a));
    assert_eq!(r.add(&r.add(a, b), c), r.add(a, &r.add(b, c)));
    assert_eq!(r.mul(&r.mul(a, b), c), r.mul(a, &r.mul(b, c)));
    assert_eq!(r.mul(a, &r.add(b, c)), r.add(&r.mul(a, b), &r.mul(a, c)));
    assert_eq!(&r.add(a, &zero), a);
    assert_eq!(&r.mul(a, &one), a);
    assert!(r.is_zero(&r.add(a, &r.neg(a))));
    assert_eq!(r.sub(a, b), r.add(a, &r.neg(b)));
    assert_eq!(r.is_zero(a), *a == zero);
}

/// `from_i64` is a homomorphism at `k` and `l` (small enough not to overflow).
pub(in crate::linalg) fn integers<R: Ring>(r: &R, k: i64, l: i64) {
    let (x, y) = (r.from_i64(k), r.from_i64(l));
    assert_eq!(r.from_i64(k + l), r.add(&x, &y));
    assert_eq!(r.from_i64(k * l), r.mul(&x, &y));
    assert_eq!(r.from_i64(-k), r.neg(&x));
    assert_eq!(r.from_i64(1), r.one());
    assert_eq!(r.from_i64(0), r.zero());
}

/// Inverses exist exactly for what is not zero.
pub(in crate::linalg) fn field<F: Field>(f: &F, a: &F::Elem) {
    match f.inv(a) {
        Some(inverse) => assert_eq!(f.mul(a, &inverse), f.one()),
        None => assert!(f.is_zero(a)),
    }
    assert_eq!(f.inv(&f.zero()), None);
}
