//! Polynomials with integer coefficients, their real roots, and signs at these, exactly.

use super::Interval;
use std::cmp::Ordering;
use viewcert::linalg::Ring;
use viewcert::linalg::integer::{Euclid, Integer, One, Signed, Zero, content};

/// A polynomial, coefficients from the constant term up; the last one is not zero.
pub(super) type Polynomial = Vec<Integer>;

/// The ring of polynomials.
pub(super) struct Polynomials;

fn trimmed(mut f: Polynomial) -> Polynomial {
    while f.last().is_some_and(Zero::is_zero) {
        f.pop();
    }
    f
}

impl Ring for Polynomials {
    type Elem = Polynomial;

    fn zero(&self) -> Polynomial {
        Vec::new()
    }

    fn one(&self) -> Polynomial {
        vec![Integer::one()]
    }

    fn from_i64(&self, value: i64) -> Polynomial {
        trimmed(vec![value.into()])
    }

    fn add(&self, f: &Polynomial, g: &Polynomial) -> Polynomial {
        let (long, short) = if f.len() < g.len() { (g, f) } else { (f, g) };
        let mut sum = long.clone();
        for (a, b) in sum.iter_mut().zip(short) {
            *a += b;
        }
        trimmed(sum)
    }

    fn sub(&self, f: &Polynomial, g: &Polynomial) -> Polynomial {
        self.add(f, &self.neg(g))
    }

    fn mul(&self, f: &Polynomial, g: &Polynomial) -> Polynomial {
        if f.is_empty() || g.is_empty() {
            return Vec::new();
        }
        let mut product = vec![Integer::zero(); f.len() + g.len() - 1];
        for (k, a) in f.iter().enumerate() {
            for (l, b) in g.iter().enumerate() {
                product[k + l] += a * b;
            }
        }
        product
    }

    fn neg(&self, f: &Polynomial) -> Polynomial {
        f.iter().map(|a| -a).collect()
    }

    fn is_zero(&self, f: &Polynomial) -> bool {
        f.is_empty()
    }
}

/// The remainder of a positive multiple of `f` by `divisor`, which is not zero.
pub(super) fn remainder(f: &[Integer], divisor: &[Integer]) -> Polynomial {
    let degree = divisor.len() - 1;
    let size = divisor[degree].abs();
    let mut rest = f.to_vec();
    while rest.len() > degree {
        let top = rest.len() - 1;
        let lead = &rest[top];
        let factor = if divisor[degree].is_negative() {
            -lead
        } else {
            lead.clone()
        };
        rest.iter_mut().for_each(|a| *a *= &size);
        for (k, b) in divisor.iter().enumerate() {
            rest[top - degree + k] -= &factor * b;
        }
        rest = trimmed(rest);
    }
    primitive(rest)
}

/// Divided by the greatest common divisor of its coefficients.
pub(super) fn primitive(f: Polynomial) -> Polynomial {
    let content = content(&f);
    if content.is_zero() {
        return f;
    }
    f.iter().map(|a| a / &content).collect()
}

impl Interval {
    /// The sign that a polynomial has in the whole interval, by Horner's rule with intervals; `None`
    /// if that does not show it.
    pub(super) fn sign(&self, f: &[Integer]) -> Option<Ordering> {
        let [mut least, mut most] = [Integer::zero(), Integer::zero()];
        let mut scale = Integer::one();
        for a in f.iter().rev() {
            let ends = [&least, &most].map(|x| [x * &self.from, x * &self.to]);
            let mut ends = ends.concat();
            ends.sort_unstable();
            let add = a * &scale;
            (least, most) = (&ends[0] + &add, &ends[3] + &add);
            scale *= &self.denominator;
        }
        match () {
            () if least.is_positive() => Some(Ordering::Greater),
            () if most.is_negative() => Some(Ordering::Less),
            () => None,
        }
    }

    /// The part with the root of `f`, half of it or less.
    pub(super) fn halved(&self, f: &[Integer]) -> Self {
        let middle = &self.from + &self.to;
        let denominator = &self.denominator * 2;
        let [from, to] = [&self.from, &self.to].map(|end| end * 2);
        let at_middle = sign_at(f, &middle, &denominator);
        if at_middle == Ordering::Equal {
            // The root itself: a quarter on both sides.
            let quarter = &self.to - &self.from;
            let middle = middle * 2;
            return Self {
                from: &middle - &quarter,
                to: middle + quarter,
                denominator: &self.denominator * 4,
            };
        }
        let (from, to) = if at_middle == sign_at(f, &from, &denominator) {
            (middle, to)
        } else {
            (from, middle)
        };
        Self {
            from,
            to,
            denominator,
        }
    }
}

/// The sign of a polynomial at a fraction with positive denominator.
pub(super) fn sign_at(f: &[Integer], numerator: &Integer, denominator: &Integer) -> Ordering {
    value_at(f, numerator, denominator, f.len()).cmp(&Integer::ZERO)
}

/// The value of a polynomial at a fraction, times the denominator to the power `length - 1`; `length`
/// is above its degree.
pub(super) fn value_at(
    f: &[Integer],
    numerator: &Integer,
    denominator: &Integer,
    length: usize,
) -> Integer {
    let mut scale = Integer::one();
    let mut value = Integer::zero();
    for k in (0..length).rev() {
        value *= numerator;
        if let Some(a) = f.get(k) {
            value += a * &scale;
        }
        scale *= denominator;
    }
    value
}

/// Sturm's sequence of a polynomial without repeated factors.
fn sequence(f: &[Integer]) -> Vec<Polynomial> {
    let terms = (0i64..).zip(f).skip(1);
    let derivative = terms.map(|(k, a)| a * k).collect();
    let mut sequence = vec![f.to_vec(), primitive(derivative)];
    while let [.., before, last] = &sequence[..] {
        let next = Polynomials.neg(&remainder(before, last));
        if next.is_empty() {
            break;
        }
        sequence.push(next);
    }
    sequence
}

fn variations(signs: impl Iterator<Item = Ordering>) -> usize {
    let signs: Vec<Ordering> = signs.filter(|&sign| sign != Ordering::Equal).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Intervals that hold one real root each, increasing, of a polynomial without repeated factors of
/// degree one at least.
pub(super) fn real_roots(f: &[Integer]) -> Vec<Interval> {
    let sequence = sequence(f);
    let count = |x: &Integer, denominator: &Integer| {
        variations(sequence.iter().map(|g| sign_at(g, x, denominator)))
    };
    // Cauchy's bound: roots are below 1 + max |a_k / a_n|.
    let Some((lead, others)) = f.split_last() else {
        return Vec::new();
    };
    let largest = others.iter().map(Signed::abs).max();
    let quotient = largest.map(|size| size.div_rem_euclid(&lead.abs()).0);
    let bound = quotient.unwrap_or_else(Integer::zero) + 2;
    let mut open = vec![Interval {
        from: -&bound,
        to: bound,
        denominator: Integer::one(),
    }];
    let mut roots = Vec::new();
    while let Some(interval) = open.pop() {
        let Interval {
            from,
            to,
            denominator,
        } = &interval;
        match count(from, denominator) - count(to, denominator) {
            0 => {}
            1 => roots.push(interval),
            _ => {
                // Of as many places as there are roots and one more, one is no root.
                let parts = f.len() as i64 + 1;
                let denominator = denominator * parts;
                let part = to - from;
                let [from, to] = [from, to].map(|end| end * parts);
                let places = (0..parts - 1).map(|k| (parts / 2 + k) % (parts - 1) + 1);
                let mut places = places.map(|k| &from + &part * k);
                let is_root = |x: &Integer| sign_at(f, x, &denominator) == Ordering::Equal;
                let Some(cut) = places.find(|x| !is_root(x)) else {
                    continue;
                };
                for (from, to) in [(cut.clone(), to), (from, cut)] {
                    open.push(Interval {
                        from,
                        to,
                        denominator: denominator.clone(),
                    });
                }
            }
        }
    }
    roots
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(coefficients: &[i64]) -> Polynomial {
        coefficients.iter().copied().map(Integer::from).collect()
    }

    #[test]
    fn roots_by_hand() {
        // (x - 1)(x - 2)(x + 3), x^2 - 2, x^2 + 1, 3 x - 1, x^4 - 5 x^2 + 4, 1 - x^3.
        for (f, roots) in [
            (vec![6, -7, 0, 1], 3),
            (vec![-2, 0, 1], 2),
            (vec![1, 0, 1], 0),
            (vec![-1, 3], 1),
            (vec![4, 0, -5, 0, 1], 4),
            (vec![1, 0, 0, -1], 1),
        ] {
            let f = polynomial(&f);
            let found = real_roots(&f);
            assert_eq!(found.len(), roots, "{f:?}");
            for interval in &found {
                let Interval {
                    from,
                    to,
                    denominator,
                } = interval;
                let ends = [from, to].map(|x| sign_at(&f, x, denominator));
                assert_eq!(ends[0], ends[1].reverse());
                assert_ne!(ends[0], Ordering::Equal);
            }
            let ordered = |pair: &[Interval]| {
                let [to, from] = [
                    &pair[0].to * &pair[1].denominator,
                    &pair[1].from * &pair[0].denominator,
                ];
                to <= from
            };
            assert!(found.windows(2).all(ordered));
        }
    }

    /// The positive root of x^2 - 2 is above 7/5 and below 17/12.
    #[test]
    fn signs_at_a_root() {
        let f = polynomial(&[-2, 0, 1]);
        let mut interval = real_roots(&f).pop().unwrap();
        for _ in 0..12 {
            interval = interval.halved(&f);
        }
        let sign = |g: &[i64]| interval.sign(&polynomial(g));
        assert_eq!(sign(&[-7, 5]), Some(Ordering::Greater));
        assert_eq!(sign(&[-17, 12]), Some(Ordering::Less));
        // At the root itself no interval shows a sign.
        assert_eq!(sign(&[-2, 0, 1]), None);
        assert_eq!(sign(&[]), None);
        // A root in the middle.
        let half = polynomial(&[-1, 2]);
        let unit = Interval {
            from: Integer::zero(),
            to: Integer::one(),
            denominator: Integer::one(),
        };
        let halved = unit.halved(&half);
        assert_eq!(halved.sign(&polynomial(&[-1, 5])), Some(Ordering::Greater));
    }

    #[test]
    fn remainders_keep_the_sign() {
        // 4 x^2 = (1 - 2 x)(-2 x - 1) + 1.
        let rest = remainder(&polynomial(&[0, 0, 1]), &polynomial(&[1, -2]));
        assert_eq!(rest, polynomial(&[1]));
        // -x^3 = -x (x^2 - 2) - 2 x.
        let rest = remainder(&polynomial(&[0, 0, 0, -1]), &polynomial(&[-2, 0, 1]));
        assert_eq!(rest, polynomial(&[0, -1]));
    }
}
