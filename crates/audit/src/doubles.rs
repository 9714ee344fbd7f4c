//! Double precision in the place of a ring, so that the audit rounds the very formulas that
//! the exact side computes.

use viewcert::linalg::Ring;

/// The operations of IEEE 754 doubles. They obey the axioms of a ring up to rounding only:
/// nothing exact may be concluded from them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Doubles;

impl Ring for Doubles {
    type Elem = f64;

    fn zero(&self) -> f64 {
        0.0
    }
    fn one(&self) -> f64 {
        1.0
    }
    /// Rounded to 53 bits.
    fn from_i64(&self, value: i64) -> f64 {
        value as f64
    }
    fn add(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }
    fn sub(&self, a: &f64, b: &f64) -> f64 {
        a - b
    }
    fn mul(&self, a: &f64, b: &f64) -> f64 {
        a * b
    }
    fn neg(&self, a: &f64) -> f64 {
        -a
    }
    fn is_zero(&self, a: &f64) -> bool {
        *a == 0.0
    }
}
