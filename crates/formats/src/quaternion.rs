//! Rotations as COLMAP writes them.

/// The matrix, by rows, of a quaternion (w, x, y, z) of any length but zero.
pub fn rotation(q: [f64; 4]) -> [[f64; 3]; 3] {
    let square: f64 = q.iter().map(|x| x * x).sum();
    scaled(q.map(|k| k / square.sqrt()))
}

/// The same times the square of the quaternion: exact for integers of 24 bits.
pub(crate) fn scaled([w, x, y, z]: [f64; 4]) -> [[f64; 3]; 3] {
    [
        [
            w * w + x * x - y * y - z * z,
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            w * w - x * x + y * y - z * z,
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            w * w - x * x - y * y + z * z,
        ],
    ]
}

/// A quaternion (w, x, y, z) of a rotation by rows.
pub fn quaternion(r: &[[f64; 3]; 3]) -> [f64; 4] {
    let trace = r[0][0] + r[1][1] + r[2][2];
    // The largest of the four has no cancellation: 4 w^2 - 1 is the trace, 4 x^2 - 1 = 2 r00 - trace, and so on.
    let of = |k: usize| 1.0 + 2.0 * r[k][k] - trace;
    let skew = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    let sum = |i: usize, j: usize| r[i][j] + r[j][i];
    let q = match (0..3).max_by(|&i, &j| of(i).total_cmp(&of(j))) {
        Some(0) if of(0) > 1.0 + trace => [skew[0], of(0), sum(0, 1), sum(0, 2)],
        Some(1) if of(1) > 1.0 + trace => [skew[1], sum(0, 1), of(1), sum(1, 2)],
        Some(2) if of(2) > 1.0 + trace => [skew[2], sum(0, 2), sum(1, 2), of(2)],
        _ => [1.0 + trace, skew[0], skew[1], skew[2]],
    };
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::{quaternion, rotation};

    #[test]
    fn there_and_back() {
        for q in [
            [1.0, 0.0, 0.0, 0.0],
            [0.1, -0.9, 0.2, 0.3],
            [0.1, 0.2, 0.9, 0.3],
            [0.0, 0.2, 0.3, -0.9],
            [0.5, 0.1, 0.4, 0.2],
        ] {
            let (r, again) = (rotation(q), rotation(quaternion(&rotation(q))));
            let pairs = r.as_flattened().iter().zip(again.as_flattened());
            assert!(
                pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-12),
                "{q:?}"
            );
        }
    }
}
