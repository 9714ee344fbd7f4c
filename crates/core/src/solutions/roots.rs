//! Roots of polynomials modulo a prime, and eigenvectors of small matrices.

use crate::linalg::prime::PrimeField;
use crate::linalg::span::{Span, left_kernel};

/// A polynomial, coefficients from the constant term up, the last one not zero.
type Polynomial = Vec<u64>;

fn trimmed(mut f: Polynomial) -> Polynomial {
    while f.last() == Some(&0) {
        f.pop();
    }
    f
}

/// The quotient and the rest; `divisor` is not zero.
fn divide(field: &PrimeField, mut f: Polynomial, divisor: &[u64]) -> (Polynomial, Polynomial) {
    let degree = divisor.len() - 1;
    let lead = field.inverse(divisor[degree]).unwrap_or_default();
    let mut quotient = vec![0; f.len().saturating_sub(degree)];
    for k in (0..quotient.len()).rev() {
        let factor = field.times(f[k + degree], lead);
        quotient[k] = factor;
        field.axpy(&mut f[k..], field.negate(factor), divisor);
    }
    f.truncate(degree);
    (trimmed(quotient), trimmed(f))
}

fn gcd(field: &PrimeField, mut f: Polynomial, mut g: Polynomial) -> Polynomial {
    while !g.is_empty() {
        let rest = divide(field, f, &g).1;
        (f, g) = (g, rest);
    }
    f
}

fn times_modulo(field: &PrimeField, f: &[u64], g: &[u64], modulus: &[u64]) -> Polynomial {
    if f.is_empty() || g.is_empty() {
        return Vec::new();
    }
    let mut product = vec![0; f.len() + g.len() - 1];
    for (k, &factor) in f.iter().enumerate() {
        field.axpy(&mut product[k..], factor, g);
    }
    divide(field, trimmed(product), modulus).1
}

fn power_modulo(field: &PrimeField, base: &[u64], mut e: u64, modulus: &[u64]) -> Polynomial {
    let mut power = vec![field.from_u64(1)];
    let mut square = divide(field, base.to_vec(), modulus).1;
    while e > 0 {
        if e & 1 == 1 {
            power = times_modulo(field, &power, &square, modulus);
        }
        square = times_modulo(field, &square, &square, modulus);
        e >>= 1;
    }
    power
}

/// Why a matrix has not as many different eigenvalues in the field as rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoVectors {
    /// They are different, and not all in the field.
    Irrational,
    /// They are not different.
    Repeated,
}

/// The root of a polynomial of degree 1.
fn root(field: &PrimeField, f: &[u64]) -> u64 {
    let inverse = field.inverse(f[1]).unwrap_or_default();
    field.negate(field.times(f[0], inverse))
}

/// The roots of a polynomial of degree 1 or more with as many different ones as its degree.
/// Cantor and Zassenhaus, with offsets from `draw`.
fn all_roots(
    field: &PrimeField,
    f: Polynomial,
    draw: &mut impl FnMut() -> u64,
) -> Result<Vec<u64>, NoVectors> {
    let one = field.from_u64(1);
    if f.len() == 2 {
        return Ok(vec![root(field, &f)]);
    }
    let derivative = (1..)
        .zip(&f[1..])
        .map(|(k, &x)| field.times(field.from_u64(k), x))
        .collect();
    if gcd(field, f.clone(), trimmed(derivative)).len() > 1 {
        return Err(NoVectors::Repeated);
    }
    let frobenius = power_modulo(field, &[0, one], field.modulus(), &f);
    if frobenius != [0, one] {
        return Err(NoVectors::Irrational);
    }
    let mut roots = Vec::new();
    let mut open = vec![f];
    while let Some(f) = open.pop() {
        if f.len() == 2 {
            roots.push(root(field, &f));
            continue;
        }
        loop {
            let half = (field.modulus() - 1) / 2;
            let mut power = power_modulo(field, &[draw(), one], half, &f);
            match power.first_mut() {
                Some(constant) => *constant = field.minus(*constant, one),
                None => continue,
            }
            let factor = gcd(field, f.clone(), trimmed(power));
            if (2..f.len()).contains(&factor.len()) {
                let cofactor = divide(field, f, &factor).0;
                open.extend([factor, cofactor]);
                break;
            }
        }
    }
    Ok(roots)
}

/// Left eigenvectors of a square matrix with as many different eigenvalues, all of them in the
/// field.
pub(super) fn left_eigenvectors(
    field: &PrimeField,
    matrix: &[Vec<u64>],
    draw: &mut impl FnMut() -> u64,
) -> Result<Vec<Vec<u64>>, NoVectors> {
    let n = matrix.len();
    if n == 1 {
        return Ok(vec![vec![field.from_u64(1)]]);
    }
    // v, vX, .. as rows; the first combination that is zero is the minimal polynomial, if v is
    // drawn, with all eigenvalues.
    let mut iterates = vec![(0..n).map(|_| draw()).collect::<Vec<u64>>()];
    for k in 0..n {
        let next = (0..n)
            .map(|column| {
                (0..n).fold(0, |sum, row| {
                    field.plus(sum, field.times(iterates[k][row], matrix[row][column]))
                })
            })
            .collect();
        iterates.push(next);
    }
    let [polynomial] = &left_kernel(field, &iterates, n)[..] else {
        return Err(NoVectors::Repeated);
    };
    let roots = all_roots(field, trimmed(polynomial.clone()), draw)?;
    let vectors = roots.into_iter().map(|root| {
        let mut shifted: Vec<Vec<u64>> = matrix.to_vec();
        for (k, row) in shifted.iter_mut().enumerate() {
            row[k] = field.minus(row[k], root);
        }
        left_kernel(field, &shifted, n).pop()
    });
    vectors
        .collect::<Option<_>>()
        .filter(|vectors: &Vec<_>| vectors.len() == n)
        .ok_or(NoVectors::Repeated)
}

/// The matrix X with `X rows = images`, for independent rows; `None` if there is none.
pub(super) fn transport(
    field: &PrimeField,
    rows: &[Vec<u64>],
    images: &[Vec<u64>],
) -> Option<Vec<Vec<u64>>> {
    let (n, length) = (rows.len(), rows.first()?.len());
    let mut span = Span::default();
    for (k, row) in rows.iter().enumerate() {
        // Behind each row what it is a combination of.
        let unit = (0..n).map(|l| field.from_u64(u64::from(k == l)));
        span.insert(field, row.iter().copied().chain(unit).collect());
    }
    if span.pivots().iter().any(|&pivot| pivot >= length) {
        return None;
    }
    images
        .iter()
        .map(|image| {
            let mut rest: Vec<u64> = image.iter().copied().chain((0..n).map(|_| 0)).collect();
            span.reduce(field, &mut rest);
            let inside = rest[..length].iter().all(|&x| x == 0);
            inside.then(|| rest[length..].iter().map(|&x| field.negate(x)).collect())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn() -> impl FnMut() -> u64 {
        let mut state = 1u64;
        move || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            state >> 8
        }
    }

    #[test]
    fn roots_by_hand() {
        let f = PrimeField::mersenne61();
        let e = |x: i64| {
            if x < 0 {
                f.negate(f.from_u64(x.unsigned_abs()))
            } else {
                f.from_u64(x as u64)
            }
        };
        // (x - 1)(x - 2)(x + 3) = x^3 - 7 x + 6.
        let mut roots = all_roots(&f, [6, -7, 0, 1].map(e).to_vec(), &mut drawn()).unwrap();
        roots.sort_unstable();
        let mut expected = [1, 2, -3].map(e);
        expected.sort_unstable();
        assert_eq!(roots, expected);
        // 2^61 - 1 is 3 modulo 4: -1 is not a square. A double root is refused as well.
        assert_eq!(
            all_roots(&f, [1, 0, 1].map(e).to_vec(), &mut drawn()),
            Err(NoVectors::Irrational)
        );
        assert_eq!(
            all_roots(&f, [1, -2, 1].map(e).to_vec(), &mut drawn()),
            Err(NoVectors::Repeated)
        );
    }

    #[test]
    fn eigenvectors_by_hand() {
        let f = PrimeField::mersenne61();
        let e = |x: u64| f.from_u64(x);
        // (1, 1) and (1, 0) from the left, with eigenvalues 3 and 2.
        let matrix = [vec![e(2), e(0)], vec![e(1), e(3)]];
        let vectors = left_eigenvectors(&f, &matrix, &mut drawn()).unwrap();
        for vector in &vectors {
            let image: Vec<u64> = (0..2)
                .map(|c| {
                    f.plus(
                        f.times(vector[0], matrix[0][c]),
                        f.times(vector[1], matrix[1][c]),
                    )
                })
                .collect();
            let cross = f.minus(f.times(image[0], vector[1]), f.times(image[1], vector[0]));
            assert_eq!(cross, 0);
        }
        assert_ne!(vectors[0], vectors[1]);
        assert_eq!(vectors.len(), 2);
    }

    #[test]
    fn a_matrix_from_its_images() {
        let f = PrimeField::mersenne61();
        let v = |values: [u64; 3]| values.map(|x| f.from_u64(x)).to_vec();
        let rows = [v([1, 0, 2]), v([0, 1, 1])];
        // 2 first + 3 second, and the first.
        let images = [v([2, 3, 7]), v([1, 0, 2])];
        let expected = [[2, 3], [1, 0]].map(|row| row.map(|x| f.from_u64(x)).to_vec());
        assert_eq!(transport(&f, &rows, &images).unwrap(), expected);
        assert!(transport(&f, &rows, &[v([1, 1, 4])]).is_none());
    }
}
