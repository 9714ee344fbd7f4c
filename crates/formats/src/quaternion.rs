//! Rotations as COLMAP writes them.

/// The matrix, by rows, of a quaternion (w, x, y, z) of any length but zero.
pub fn rotation(q: [f64; 4]) -> [[f64; 3]; 3] {
    let square: f64 = q.iter().map(|x| x * x).sum();
    let [w, x, y, z] = q.map(|k| k / square.sqrt());
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}
