//! Integer quaternions and vectors, and bounds for cosines (docs/contradictions.md, sections 1 and 3).

use num_bigint::BigInt;
use std::array::from_fn;

pub(super) type Quaternion = [BigInt; 4];
pub(super) type Vector = [BigInt; 3];

/// The whole turn of the cosines' integers: c(0).
pub(super) const ONE: i128 = 1 << 62;

/// c(k), which is 2^62 cos(k degrees) closely, for k from 0 to 180.
pub(super) fn cosines() -> Vec<i128> {
    let mut list = vec![ONE, 4_610_983_636_309_578_612];
    for k in 1..180 {
        // An arithmetic shift rounds down.
        list.push(((list[1] * list[k]) >> 61) - list[k - 1]);
    }
    list
}

pub(super) fn big<const N: usize>(numbers: [i64; N]) -> [BigInt; N] {
    numbers.map(BigInt::from)
}

pub(super) fn dot(a: &[BigInt], b: &[BigInt]) -> BigInt {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn square(a: &[BigInt]) -> BigInt {
    dot(a, a)
}

pub(super) fn cross([a, b, c]: &Vector, [x, y, z]: &Vector) -> Vector {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

pub(super) fn negative<const N: usize>(numbers: [BigInt; N]) -> [BigInt; N] {
    numbers.map(|number| -number)
}

/// The quaternion of R(p) R(q).
pub(super) fn product([a, b, c, d]: &Quaternion, [w, x, y, z]: &Quaternion) -> Quaternion {
    [
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y - b * z + c * w + d * x,
        a * z + b * y - c * x + d * w,
    ]
}

pub(super) fn conjugate([w, x, y, z]: Quaternion) -> Quaternion {
    [w, -x, -y, -z]
}

/// |q|^2 R(q), row by row.
pub(super) fn matrix([w, x, y, z]: &Quaternion) -> [Vector; 3] {
    let [ww, xx, yy, zz] = [w, x, y, z].map(|a| a * a);
    let twice = |a: &BigInt, b: &BigInt| (a * b) << 1_u32;
    let [xy, wz, xz] = [twice(x, y), twice(w, z), twice(x, z)];
    let [wy, yz, wx] = [twice(w, y), twice(y, z), twice(w, x)];
    [
        [&ww + &xx - &yy - &zz, &xy - &wz, &xz + &wy],
        [xy + wz, &ww - &xx + &yy - &zz, &yz - &wx],
        [xz - wy, yz + wx, ww - xx - yy + zz],
    ]
}

/// A vector that is turned by a quaternion, and longer by its square.
pub(super) fn turned(q: &Quaternion, vector: &Vector) -> Vector {
    matrix(q).map(|row| dot(&row, vector))
}

/// The entries of [t]_x M, row by row.
pub(super) fn essential(t: &Vector, rotation: &[Vector; 3]) -> Vec<BigInt> {
    let columns: [Vector; 3] = from_fn(|j| from_fn(|i| rotation[i][j].clone()));
    let columns = columns.map(|column| cross(t, &column));
    let entries = (0..9).map(|k| columns[k % 3][k / 3].clone());
    entries.collect()
}

/// Finite numbers, exactly, all times one power of two.
pub(super) fn exact<const N: usize>(numbers: [f64; N]) -> Option<[BigInt; N]> {
    if !numbers.iter().all(|number| number.is_finite()) {
        return None;
    }
    // mantissa * 2^(exponent - 1075); below the least normal one the exponent stays 1.
    let parts = numbers.map(|number| {
        let (bits, raised) = (number.to_bits(), (number.to_bits() >> 52) & 0x7ff);
        let hidden = u64::from(raised > 0) << 52;
        let mantissa = (bits & ((1 << 52) - 1)) | hidden;
        let zeros = mantissa.trailing_zeros() % 64;
        let mantissa = BigInt::from(mantissa >> zeros);
        let signed = if bits >> 63 == 1 { -mantissa } else { mantissa };
        (signed, raised.max(1) as u32 + zeros)
    });
    let of_some = parts
        .iter()
        .filter(|(mantissa, _)| *mantissa != BigInt::ZERO);
    let least = of_some.map(|&(_, exponent)| exponent).min().unwrap_or(0);
    Some(parts.map(|(mantissa, exponent)| mantissa << exponent.saturating_sub(least)))
}

/// Whether two vectors point the same way, or opposite ones, with 1 - 2^-bits of the square of the cosine.
pub(super) fn along(a: &[BigInt], b: &[BigInt], bits: u32) -> bool {
    let (cosine, whole) = (dot(a, b), square(a) * square(b));
    (&cosine * &cosine) << bits >= (&whole << bits) - whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosines_are_as_close_as_the_margins_suppose() {
        for (k, &cosine) in cosines().iter().enumerate() {
            let off = cosine as f64 / ONE as f64 - (k as f64).to_radians().cos();
            assert!(off.abs() < 1e-12, "{k}");
        }
        assert_eq!(cosines()[180] + ONE, -3458, "exactly as on the page");
    }

    #[test]
    fn numbers_are_exact_at_any_size() {
        let least = f64::from_bits(1);
        let found = exact([least, -1.0, f64::MIN_POSITIVE, 0.0, 0.75]).unwrap();
        let one = BigInt::from(1);
        let shifted = [1022, 1074, 52].map(|by: u32| &one << by);
        assert_eq!(found[0], one);
        assert_eq!((&found[1], &found[2]), (&-&shifted[1], &shifted[2]));
        assert_eq!(found[3], BigInt::ZERO);
        assert_eq!(found[4], (&shifted[0] << 50_u32) * 3);
        assert_eq!(exact([f64::INFINITY]), None);
    }
}
