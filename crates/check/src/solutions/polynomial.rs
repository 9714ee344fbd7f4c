//! Polynomials with integer coefficients, and what their signs are: conditions (S30), (S32) and (S33) of
//! section 12.

use crate::rejection::{Checked, ensure};
use num_bigint::{BigInt, Sign};

/// Coefficients from the constant one up, of which the last one is not zero.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Polynomial(pub Vec<BigInt>);

impl Polynomial {
    pub fn constant(value: BigInt) -> Self {
        Self(vec![value]).trimmed()
    }

    fn trimmed(mut self) -> Self {
        while self
            .0
            .last()
            .is_some_and(|last| last.sign() == Sign::NoSign)
        {
            self.0.pop();
        }
        self
    }

    pub fn plus(&self, other: &Self) -> Self {
        let length = self.0.len().max(other.0.len());
        let mut sum = self.0.clone();
        sum.resize(length, BigInt::default());
        for (a, b) in sum.iter_mut().zip(&other.0) {
            *a += b;
        }
        Self(sum).trimmed()
    }

    pub fn negative(&self) -> Self {
        Self(self.0.iter().map(|a| -a).collect())
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negative())
    }

    pub fn times(&self, other: &Self) -> Self {
        let mut product = vec![BigInt::default(); self.0.len() + other.0.len()];
        for (k, a) in self.0.iter().enumerate() {
            for (l, b) in other.0.iter().enumerate() {
                product[k + l] += a * b;
            }
        }
        Self(product).trimmed()
    }

    /// The sum of the products of entries.
    pub fn dot<'a>(
        first: impl IntoIterator<Item = &'a Self>,
        second: impl IntoIterator<Item = &'a Self>,
    ) -> Self {
        let terms = first.into_iter().zip(second);
        terms.fold(Self::default(), |sum, (f, g)| sum.plus(&f.times(g)))
    }

    /// The remainder of a positive multiple by a polynomial that is not zero.
    pub fn rest(&self, divisor: &Self) -> Self {
        let Some(lead) = divisor.0.last() else {
            return self.clone();
        };
        let mut rest = self.clone();
        while rest.0.len() >= divisor.0.len() {
            let shift = rest.0.len() - divisor.0.len();
            let factor = rest.0.last().map_or_else(BigInt::default, |top| top * lead);
            let square = lead * lead;
            rest.0.iter_mut().for_each(|a| *a *= &square);
            for (a, b) in rest.0[shift..].iter_mut().zip(&divisor.0) {
                *a -= &factor * b;
            }
            rest = rest.trimmed();
        }
        rest
    }

    /// The same without a common factor of the coefficients.
    fn primitive(mut self) -> Self {
        let common = self.0.iter().fold(BigInt::ZERO, |gcd, a| {
            let (mut a, mut b): (BigInt, BigInt) = (gcd, a.magnitude().clone().into());
            while b != BigInt::ZERO {
                (a, b) = (b.clone(), a % b);
            }
            a
        });
        self.0.iter_mut().for_each(|a| *a /= &common);
        self
    }

    /// The sign at the fraction `numerator / denominator`, of which the denominator is positive.
    pub fn sign_at(&self, numerator: &BigInt, denominator: &BigInt) -> Sign {
        let mut value = BigInt::default();
        let mut power = BigInt::from(1);
        for a in self.0.iter().rev() {
            value = value * numerator + a * &power;
            power *= denominator;
        }
        value.sign()
    }

    /// (S33): the sign in the interval from `a / d` to `b / d`.
    pub fn sign_between(&self, [a, b, d]: [&BigInt; 3]) -> Checked<Sign> {
        // Multiplied by powers of d.
        let (mut low, mut high) = (BigInt::default(), BigInt::default());
        let mut power = BigInt::from(1);
        for coefficient in self.0.iter().rev() {
            let mut products = [&low * a, &low * b, &high * a, &high * b];
            products.sort_unstable();
            let [least, _, _, most] = products;
            low = least + coefficient * &power;
            high = most + coefficient * &power;
            power *= d;
        }
        ensure!(
            low.sign() == high.sign() && low.sign() != Sign::NoSign,
            "a sign is not the same in the whole interval"
        );
        Ok(low.sign())
    }

    /// How many real roots there are, by Sturm's sequence; without repeated factors.
    pub fn real_roots(&self) -> usize {
        let derivative = self.0.iter().enumerate().skip(1);
        let derivative = Self(derivative.map(|(k, a)| a * k).collect());
        let mut sequence = vec![self.clone(), derivative];
        while let [.., before, last] = &sequence[..]
            && last.0.len() > 1
        {
            // Without their common factors the coefficients would grow exponentially.
            let next = before.rest(last).negative().primitive();
            sequence.push(next);
        }
        let ends = sequence
            .iter()
            .filter_map(|f| Some((f.0.last()?.sign(), f.0.len())));
        let above: Vec<Sign> = ends.clone().map(|(sign, _)| sign).collect();
        let flipped = |(sign, length): (Sign, usize)| {
            if length.is_multiple_of(2) {
                -sign
            } else {
                sign
            }
        };
        let below: Vec<Sign> = ends.map(flipped).collect();
        let changes = |signs: &[Sign]| signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        changes(&below).saturating_sub(changes(&above))
    }
}

/// (-1)^k times the determinant of three rows without column k.
pub(super) fn minors(rows: [&[Polynomial; 4]; 3]) -> [Polynomial; 4] {
    let [x, y, z] = rows;
    // Columns in an order that makes for the sign.
    [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]].map(|[a, b, c]| {
        let term =
            |a: usize, b: usize, c: usize| x[a].times(&y[b].times(&z[c]).minus(&y[c].times(&z[b])));
        term(a, b, c).plus(&term(b, c, a)).plus(&term(c, a, b))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(coefficients: &[i64]) -> Polynomial {
        Polynomial(coefficients.iter().copied().map(BigInt::from).collect())
    }

    #[test]
    fn roots_by_hand() {
        // (x - 1)(x - 2)(x + 3), x^2 - 2, x^2 + 1, 1 - 3 x, x^4 - 5 x^2 + 4, 1 - x^3.
        for (f, roots) in [
            (&[6, -7, 0, 1][..], 3),
            (&[-2, 0, 1], 2),
            (&[1, 0, 1], 0),
            (&[1, -3], 1),
            (&[4, 0, -5, 0, 1], 4),
            (&[1, 0, 0, -1], 1),
        ] {
            assert_eq!(polynomial(f).real_roots(), roots, "{f:?}");
        }
    }

    #[test]
    fn remainders_and_signs_by_hand() {
        // 4 x^2 = (1 - 2 x)(-2 x - 1) + 1.
        let rest = polynomial(&[0, 0, 1]).rest(&polynomial(&[1, -2]));
        assert_eq!(rest, polynomial(&[4]));
        assert_eq!(
            polynomial(&[-2, 0, 1]).rest(&polynomial(&[-2, 0, 1])),
            polynomial(&[])
        );
        // x^2 - 2 between 3/2 and 2, and between 1 and 2.
        let number = |x: i64| BigInt::from(x);
        let f = polynomial(&[-2, 0, 1]);
        let sign = |ends: [i64; 3]| {
            let ends = ends.map(number);
            f.sign_between(ends.each_ref())
        };
        assert_eq!(sign([3, 4, 2]).unwrap(), Sign::Plus);
        assert!(sign([1, 2, 1]).is_err());
        assert_eq!(f.sign_at(&number(7), &number(5)), Sign::Minus);
        assert!(
            polynomial(&[])
                .sign_between([&number(0), &number(1), &number(1)])
                .is_err()
        );
    }

    #[test]
    fn minors_by_hand() {
        let row = |entries: [i64; 4]| entries.map(|x| polynomial(&[x]).trimmed());
        let rows = [row([1, 0, 0, -2]), row([0, 1, 0, 3]), row([0, 0, 1, -5])];
        // The centre of [ I | -c ] is a multiple of (c; 1).
        let found = minors(rows.each_ref());
        assert_eq!(found, row([-2, 3, -5, -1]));
    }
}
