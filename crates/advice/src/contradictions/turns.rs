//! Quaternions: floats that propose, and integers that decide (docs/contradictions.md, sections 3 and 4).

use super::{Cycle, Step};
use num_bigint::BigInt;
use std::ops::{Add, Mul, Neg, Sub};
use viewcert_formats::Motion;

/// A quaternion (w, x, y, z).
pub(super) type Turn = [f64; 4];

/// p q: first q, then p.
pub(super) fn times<T>(p: &[T; 4], q: &[T; 4]) -> [T; 4]
where
    for<'a> &'a T: Mul<&'a T, Output = T>,
    T: Add<Output = T> + Sub<Output = T>,
{
    let [a, b, c, d] = p;
    let [w, x, y, z] = q;
    [
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y - b * z + c * w + d * x,
        a * z + b * y - c * x + d * w,
    ]
}

/// The inverse, up to a positive factor.
pub(super) fn conj<T: Neg<Output = T>>([w, x, y, z]: [T; 4]) -> [T; 4] {
    [w, -x, -y, -z]
}

/// Of length 1.
pub(super) fn unit<const N: usize>(q: [f64; N]) -> [f64; N] {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / length)
}

/// The angle of a quaternion of length 1, in degrees.
pub(super) fn angle(q: &Turn) -> f64 {
    2.0 * q[0].abs().min(1.0).acos().to_degrees()
}

/// A vector turned by a quaternion of length 1.
pub(super) fn turned(q: &Turn, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [_, x, y, z] = times(&times(q, &[0.0, x, y, z]), &conj(*q));
    [x, y, z]
}

/// About 2^62 times the cosine of so many degrees, as the specification has it.
pub(super) fn cosine(degrees: u32) -> i128 {
    const FIRST: i128 = 4_610_983_636_309_578_612;
    let (mut before, mut now) = (FIRST, 1 << 62);
    for _ in 0..degrees {
        (before, now) = (now, ((FIRST * now) >> 61) - before);
    }
    now
}

/// The quaternion of a step.
fn step(motions: &[Motion], &(pair, forth): &Step) -> [i64; 4] {
    let q = motions[pair as usize].rotation;
    if forth { q } else { conj(q) }
}

fn big<const N: usize>(numbers: [i64; N]) -> [BigInt; N] {
    numbers.map(BigInt::from)
}

fn square<const N: usize>(numbers: &[BigInt; N]) -> BigInt {
    numbers.iter().map(|x| x * x).sum()
}

/// Condition (C6): the composed rotation turns by more than so many degrees.
pub(super) fn is_open(motions: &[Motion], walk: &[Step], sum: u32) -> bool {
    let steps = || walk.iter().map(|one| step(motions, one));
    // Four factors of 25 bits fit.
    let first: BigInt = if walk.len() <= 4 {
        let all = steps().map(|q| q.map(i128::from));
        all.reduce(|p, q| times(&q, &p)).map_or(0, |q| q[0]).into()
    } else {
        let all = steps().map(big).reduce(|p, q| times(&q, &p));
        all.map_or(BigInt::ZERO, |[w, ..]| w)
    };
    let squares: BigInt = steps().map(|q| square(&big(q))).product();
    let bound = (1 << 62) + cosine(sum) - ((walk.len() as i128) << 47);
    (&first * &first) << 63 < squares * bound
}

/// Condition (C9): a pair agrees with the rotations of its two images.
pub(super) fn agrees(motion: &Motion, [of_i, of_j]: [[i64; 4]; 2], theta: u32) -> bool {
    let [p, q, r] = [conj(of_j), motion.rotation, of_i].map(|q| q.map(i128::from));
    let first = BigInt::from(times(&times(&p, &q), &r)[0]);
    let squares = [p, q, r].map(|q| BigInt::from(q.iter().map(|x| x * x).sum::<i128>()));
    let bound = (1 << 62) + cosine(theta) + (1 << 47);
    (&first * &first) << 63 >= squares.iter().product::<BigInt>() * bound
}

/// Condition (C7): all steps of a closed walk lead along one vector.
pub(super) fn is_one_way(motions: &[Motion], cycle: &Cycle, [theta, phi]: [u32; 2]) -> bool {
    let (Some(witness), length) = (cycle.witness, cycle.walk.len()) else {
        return false;
    };
    let witness = big(witness);
    let steps: Vec<[BigInt; 4]> = cycle
        .walk
        .iter()
        .map(|one| big(step(motions, one)))
        .collect();
    (0..length).all(|m| {
        let (pair, forth) = cycle.walk[m];
        let motion = &motions[pair as usize];
        let Some(vector) = motion.vector else {
            return false;
        };
        let away = m.min(length - 1 - m) as u32;
        let begins = m <= length - 1 - m;
        let one = BigInt::from(1);
        let none = || [one.clone(), BigInt::ZERO, BigInt::ZERO, BigInt::ZERO];
        let by = match begins {
            true => conj(steps[..m].iter().fold(none(), |p, q| times(q, &p))),
            false => steps[m + 1..].iter().fold(none(), |p, q| times(q, &p)),
        };
        // -R^T t in the frame of the pair's first image, -t in that of its second.
        let [x, y, z] = big(vector.map(|x| if forth { -x } else { x }));
        let at_first = begins == forth;
        let own = if at_first {
            conj(big(motion.rotation))
        } else {
            none()
        };
        let by = times(&by, &own);
        let [_, v @ ..] = times(&times(&by, &[BigInt::ZERO, x, y, z]), &conj(by));
        let along: BigInt = witness.iter().zip(&v).map(|(a, b)| a * b).sum();
        let bound = (1 << 62) - cosine(2 * (phi + away * theta)) + (i128::from(away + 1) << 48);
        along > BigInt::ZERO && (&along * &along) << 63 > square(&witness) * square(&v) * bound
    })
}
