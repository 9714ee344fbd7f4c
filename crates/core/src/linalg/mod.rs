//! Exact arithmetic: rings and fields as values, so that a modulus chosen at run
//! time is just another field.

pub mod bareiss;
pub mod dense_lu;
pub mod dixon;
pub mod integer;
pub mod matrix;
pub mod prime;
mod product;
pub mod rational;
pub mod span;
pub mod sparse_lu;
#[cfg(test)]
mod tests;
pub mod textbook;

use std::fmt::Debug;

/// A commutative ring with one. The ring is a value (it may carry a modulus);
/// its elements are plain data.
pub trait Ring {
    /// An element of the ring, in the ring's own representation.
    type Elem: Clone + PartialEq + Debug + Send + Sync;

    /// The neutral element of addition.
    fn zero(&self) -> Self::Elem;
    /// The neutral element of multiplication.
    fn one(&self) -> Self::Elem;
    /// The image of an integer.
    #[expect(
        clippy::wrong_self_convention,
        reason = "the ring is the receiver, not the source"
    )]
    fn from_i64(&self, value: i64) -> Self::Elem;
    /// `a + b`
    fn add(&self, a: &Self::Elem, b: &Self::Elem) -> Self::Elem;
    /// `a - b`
    fn sub(&self, a: &Self::Elem, b: &Self::Elem) -> Self::Elem;
    /// `a * b`
    fn mul(&self, a: &Self::Elem, b: &Self::Elem) -> Self::Elem;
    /// `-a`
    fn neg(&self, a: &Self::Elem) -> Self::Elem;
    /// Whether `a` is zero.
    fn is_zero(&self, a: &Self::Elem) -> bool;
}

/// A commutative field.
pub trait Field: Ring {
    /// The inverse of `a`; `None` exactly for zero.
    fn inv(&self, a: &Self::Elem) -> Option<Self::Elem>;
}
