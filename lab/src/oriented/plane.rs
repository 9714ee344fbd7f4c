//! Is there a plane at infinity? (lab/docs/oriented.md, Theorem 10.19.)
//!
//! In: vectors of four numbers. Out: one with which all their products are positive, or five of them
//! a positive combination of which is zero. Numbers are rounded before either is looked for; whether
//! what is found is right is for others to see.

use viewcert::linalg::integer::{Euclid, Integer, One, Signed, ToPrimitive};

/// One of the two, by Gordan's theorem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Found {
    Plane([i64; 4]),
    Five([usize; 5]),
}

/// Bits that are left of a number: determinants of four such vectors fit into 127.
const BITS: u64 = 27;

/// The leading bits of vectors, each divided by a power of two.
fn rounded(vector: &[Integer; 4]) -> [i128; 4] {
    let bits = vector.iter().map(Integer::bits).max().unwrap_or(0);
    let drop = bits.saturating_sub(BITS);
    let power = Integer::one() << drop;
    vector.each_ref().map(|x| {
        let (quotient, _) = x.div_rem_euclid(&power);
        quotient
            .to_i128()
            .unwrap_or_else(|| unreachable!("of so few bits"))
    })
}

fn dot(a: &[i128; 4], b: &[i128; 4]) -> i128 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// What is orthogonal to three vectors.
fn across(a: &[i128; 4], b: &[i128; 4], c: &[i128; 4]) -> [i128; 4] {
    std::array::from_fn(|omitted| {
        let [x, y, z] = match omitted {
            0 => [1, 2, 3],
            1 => [0, 2, 3],
            2 => [0, 1, 3],
            _ => [0, 1, 2],
        };
        let determinant = a[x] * (b[y] * c[z] - b[z] * c[y]) - a[y] * (b[x] * c[z] - b[z] * c[x])
            + a[z] * (b[x] * c[y] - b[y] * c[x]);
        if omitted % 2 == 0 {
            determinant
        } else {
            -determinant
        }
    })
}

/// A plane, or five vectors; `None` if rounding leaves neither. O(n^4) for a plane, O(n^5) for five.
pub(super) fn find(vectors: &[[Integer; 4]]) -> Option<Found> {
    let vectors: Vec<[i128; 4]> = vectors.iter().map(rounded).collect();
    let n = vectors.len();
    // The sum of the rays of the cone, each of which is orthogonal to three of the vectors.
    let mut sum = [0i128; 4];
    let mut rays = 0;
    for k in 0..n {
        for l in 0..k {
            for m in 0..l {
                let ray = across(&vectors[k], &vectors[l], &vectors[m]);
                let mut signs = vectors.iter().enumerate();
                let others = signs
                    .by_ref()
                    .filter(|(other, _)| ![k, l, m].contains(other));
                let products: Vec<i128> = others.map(|(_, v)| dot(&ray, v).signum()).collect();
                let sign = match products.first() {
                    Some(&sign) if sign != 0 && products.iter().all(|&x| x == sign) => sign,
                    _ => continue,
                };
                // All rays count alike, whatever their lengths are.
                let length = ray.iter().map(|x| x.abs()).max()?.max(1);
                for (total, x) in sum.iter_mut().zip(ray) {
                    *total += sign * (x << 30) / length;
                }
                rays += 1;
            }
        }
    }
    if rays > 0 {
        return plane(&vectors, sum).map(Found::Plane);
    }
    five(&vectors).map(Found::Five)
}

/// As few digits as do.
fn plane(vectors: &[[i128; 4]], sum: [i128; 4]) -> Option<[i64; 4]> {
    let largest = sum.iter().map(|x| x.abs()).max()?.max(1);
    (3..=60).find_map(|bits| {
        let short: Option<Vec<i64>> = sum
            .iter()
            .map(|x| i64::try_from((x << bits) / largest).ok())
            .collect();
        let short: [i64; 4] = short?.try_into().ok()?;
        let wide = short.map(i128::from);
        vectors.iter().all(|v| dot(&wide, v) > 0).then_some(short)
    })
}

fn five(vectors: &[[i128; 4]]) -> Option<[usize; 5]> {
    let n = vectors.len();
    for a in 0..n {
        for b in 0..a {
            for c in 0..b {
                for d in 0..c {
                    for e in 0..d {
                        let places = [e, d, c, b, a];
                        if is_zero_inside(&places.map(|k| vectors[k])) {
                            return Some(places);
                        }
                    }
                }
            }
        }
    }
    None
}

/// Whether a combination of five vectors with positive factors is zero: the factors are the
/// determinants of the others, with alternating signs.
fn is_zero_inside(vectors: &[[i128; 4]; 5]) -> bool {
    let mut signs = (0..5).map(|omitted| {
        let others: Vec<&[i128; 4]> = (0..5)
            .filter(|&k| k != omitted)
            .map(|k| &vectors[k])
            .collect();
        let determinant = dot(others[0], &across(others[1], others[2], others[3]));
        determinant.signum() * if omitted % 2 == 0 { 1 } else { -1 }
    });
    let first = signs.next().unwrap_or(0);
    first != 0 && signs.all(|sign| sign == first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::linalg::integer::{Zero, decimal};

    fn vectors(all: &[[i64; 4]]) -> Vec<[Integer; 4]> {
        all.iter().map(|v| v.map(Integer::from)).collect()
    }

    #[test]
    fn by_hand() {
        let mut all = vec![
            [1, 0, 0, 1],
            [0, 1, 0, 1],
            [0, 0, 1, 1],
            [0, 0, 0, 1],
            [-2, -2, 1, 1],
        ];
        let Some(Found::Plane(plane)) = find(&vectors(&all)) else {
            panic!("(0, 0, 0, 1) is one");
        };
        for v in &all {
            let product: i64 = v.iter().zip(plane).map(|(a, b)| a * b).sum();
            assert!(product > 0, "{plane:?}");
        }
        // The five points of which (0, 0, 0, 0) is the sum.
        all.push([-1, -1, -1, -4]);
        let Some(Found::Five(five)) = find(&vectors(&all)) else {
            panic!("the last and the first four add up to zero");
        };
        assert!(five.contains(&5));
    }

    /// Large numbers are rounded, negative ones too.
    #[test]
    fn leading_bits() {
        let large = decimal("-1000000000000000000000000").unwrap();
        let vector = [large.clone(), -large, Integer::zero(), Integer::one()];
        let [a, b, c, d] = rounded(&vector);
        assert!(a < 0 && b > 0 && (a + b).abs() <= 1, "{a} {b}");
        assert_eq!((c, d), (0, 0));
    }
}
