//! The matrices of section 7: the paper's Jacobian J_P over any ring, the bearing matrix N, the
//! plane direction matrix R, and the motions that change no fundamental matrix.

use crate::algebra::{Field, Ring};
use crate::cameras::{Camera, centre};
use crate::core::Core;

/// The sum of the products of entries.
pub(crate) fn dot<R: Ring, const N: usize>(ring: &R, x: [R::E; N], y: [R::E; N]) -> R::E {
    let first = ring.mul(x[0], y[0]);
    (1..N).fold(first, |sum, k| ring.add(sum, ring.mul(x[k], y[k])))
}

/// The fundamental matrix by the paper's eq. (2): entry (h, k) is (-1)^(h+k) det [P_i without row
/// k; P_j without row h].
fn fundamental<R: Ring>(ring: &R, i: &Camera<R::E>, j: &Camera<R::E>) -> [[R::E; 3]; 3] {
    // The cyclic order of the two other rows makes for the sign.
    let others = |camera: &Camera<R::E>, row: usize| [camera[(row + 1) % 3], camera[(row + 2) % 3]];
    let entry = |h: usize, k: usize| {
        let ([first, second], [third, fourth]) = (others(i, k), others(j, h));
        // Expansion along the first row: the signed minors of the other three are their centre.
        dot(ring, first, centre(ring, &[second, third, fourth]))
    };
    std::array::from_fn(|h| std::array::from_fn(|k| entry(h, k)))
}

/// Row `row` of J_P of the edges of a core: entries with their columns, each column once.
///
/// With S = Q^T F P for the edge's cameras P and Q, the derivative of S + S^T in entry (r, c) of P
/// has M = Q^T F in row and column c; that in entry (r, c) of Q has K = F P there.
pub(crate) fn jacobian<R: Ring>(
    ring: &R,
    edges: &[(usize, usize)],
    cameras: &[Camera<R::E>],
    row: usize,
) -> Vec<(usize, R::E)> {
    // The entries of a symmetric matrix, column after column.
    const ROWS: [usize; 10] = [0, 1, 2, 3, 1, 2, 3, 2, 3, 3];
    const COLUMNS: [usize; 10] = [0, 0, 0, 0, 1, 1, 1, 2, 2, 3];
    let (i, j) = edges[row / 10];
    let (p, q) = (&cameras[i], &cameras[j]);
    let f = fundamental(ring, p, q);
    let (a, b) = (ROWS[row % 10], COLUMNS[row % 10]);
    let mut entries = Vec::with_capacity(12);
    for r in 0..3 {
        let m = |column: usize| dot(ring, q.map(|row| row[column]), f.map(|row| row[r]));
        let k = |column: usize| dot(ring, f[r], p.map(|row| row[column]));
        for (node, of_a, of_b) in [(i, m(a), m(b)), (j, k(a), k(b))] {
            entries.push((
                12 * node + 3 * b + r,
                if a == b { ring.add(of_a, of_b) } else { of_a },
            ));
            entries.extend((a != b).then_some((12 * node + 3 * a + r, of_b)));
        }
    }
    entries
}

/// The camera [ I | -c ].
pub(crate) fn camera_at(field: &Field, c: &[u64; 3]) -> Camera<u64> {
    let [x, y, z] = c.map(|entry| field.neg(entry));
    [
        [field.one, 0, 0, x],
        [0, field.one, 0, y],
        [0, 0, field.one, z],
    ]
}

/// A row of N: six entries with their columns, first the direction a.
pub(crate) type Bearing = [(usize, u64); 6];

/// The rows of N.
pub(crate) fn bearings(field: &Field, core: &Core, centres: &[[u64; 3]]) -> Vec<Bearing> {
    let mut rows = Vec::new();
    for &(i, j) in &core.edges {
        let d = [0, 1, 2].map(|k| field.sub(centres[i][k], centres[j][k]));
        let q = d.iter().position(|&entry| entry != 0).unwrap_or(0);
        for other in (0..3).filter(|&k| k != q) {
            let mut a = [0; 3];
            (a[other], a[q]) = (d[q], field.neg(d[other]));
            let entry = |k: usize| {
                if k < 3 {
                    (3 * i + k, a[k])
                } else {
                    (3 * j + k - 3, field.neg(a[k - 3]))
                }
            };
            rows.push(std::array::from_fn(entry));
        }
    }
    rows
}

/// The rows of N for edges whose length is known, behind those of the directions: two entries
/// (theory, Theorem 13.18).
pub(crate) fn lengths(field: &Field, core: &Core, centres: &[[u64; 3]]) -> Vec<[(usize, u64); 2]> {
    let row = |&(i, j): &(usize, usize)| {
        let q = (0..3).find(|&k| centres[i][k] != centres[j][k]);
        let q = q.unwrap_or(0);
        [(3 * i + q, field.one), (3 * j + q, field.neg(field.one))]
    };
    core.scales.iter().map(row).collect()
}

/// Row `row` of the plane direction matrix R: entries with their columns.
pub(crate) fn plane_direction(
    field: &Field,
    core: &Core,
    points: &[[u64; 2]],
    row: usize,
) -> [(usize, u64); 4] {
    let (i, j) = core.edges[row];
    let [x, y] = [0, 1].map(|k| field.sub(points[i][k], points[j][k]));
    [
        (2 * i, y),
        (2 * i + 1, field.neg(x)),
        (2 * j, field.neg(y)),
        (2 * j + 1, x),
    ]
}

/// The motion P_v X of some cameras, or as many columns of it, where X has a one in entry (a, b) =
/// (ab / columns, ab % columns).
pub(crate) fn map_motion(cameras: &[Camera<u64>], columns: usize, ab: usize) -> Vec<(usize, u64)> {
    let (a, b) = (ab / columns, ab % columns);
    let motion = cameras
        .iter()
        .enumerate()
        .flat_map(|(v, p)| [0, 1, 2].map(|r| (3 * (columns * v + b) + r, p[r][a])));
    motion.collect()
}

/// The motion that scales camera v.
pub(crate) fn scale_motion(cameras: &[Camera<u64>], v: usize) -> Vec<(usize, u64)> {
    (0..12)
        .map(|at| (12 * v + at, cameras[v][at % 3][at / 3]))
        .collect()
}
