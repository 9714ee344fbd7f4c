//! Relative poses: what follows a pair on lines of 9 and 14 fields.
//!
//! Nine or fourteen fields are much that is no pose: intrinsics, boxes, homographies, neighbours. So
//! a rotation has to stand there. How exactly is no matter here: what it says about the pair is not
//! read.

use crate::edge_list::fields::Field;

/// How far a written rotation may be from one.
const TOLERANCE: f64 = 0.01;

/// What is wrong with lines of so many fields that are none.
pub(super) const MISSING: &str = "lines of 9 or 14 fields are pairs with relative poses, and there is no unit quaternion \
                                  in fields 3 to 6 of 9, no rotation in fields 3 to 11 of 14";

/// Whether the fields behind a pair are a pose, if there are 7 or 12 of them.
pub(super) fn are(line: &str, further: &[Field]) -> bool {
    let values: Vec<f64> = further
        .iter()
        .filter_map(|field| field.raw(line).parse().ok())
        .collect();
    match values.len() {
        7 => is_quaternion(&values[..4]),
        12 => is_rotation(&values[..9]),
        _ => true,
    }
}

fn is_quaternion(values: &[f64]) -> bool {
    is_near(dot(values, values), 1.0)
}

/// Nine numbers, by rows: orthonormal, and right-handed.
fn is_rotation(values: &[f64]) -> bool {
    let [a, b, c] = [0, 3, 6].map(|at| &values[at..at + 3]);
    let cross = [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ];
    let units = [a, b, c].iter().all(|row| is_near(dot(row, row), 1.0));
    units
        && [dot(a, b), dot(a, c), dot(b, c)]
            .iter()
            .all(|&product| is_near(product, 0.0))
        && is_near(dot(&cross, c), 1.0)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn is_near(value: f64, expected: f64) -> bool {
    (value - expected).abs() < TOLERANCE
}
