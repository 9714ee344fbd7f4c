//! The matrices of section 7: the paper's Jacobian J_P over any ring, the bearing matrix N, and the motions that a kernel
//! vector gives to the edges.

use crate::cameras::Camera;
use crate::modular::Field;
use crate::pieces::Core;
use crate::rejection::{Checked, ensure};

/// What the Jacobian needs of its entries.
pub(crate) trait Ring {
    type E: Copy;
    fn sum(&self, a: Self::E, b: Self::E) -> Self::E;
    fn difference(&self, a: Self::E, b: Self::E) -> Self::E;
    fn product(&self, a: Self::E, b: Self::E) -> Self::E;
}

impl Ring for Field {
    type E = u64;
    fn sum(&self, a: u64, b: u64) -> u64 {
        self.add(a, b)
    }
    fn difference(&self, a: u64, b: u64) -> u64 {
        self.sub(a, b)
    }
    fn product(&self, a: u64, b: u64) -> u64 {
        self.mul(a, b)
    }
}

/// Integers; `None` where 128 bits were not enough.
pub(crate) struct Integers;

impl Ring for Integers {
    type E = Option<i128>;
    fn sum(&self, a: Option<i128>, b: Option<i128>) -> Option<i128> {
        a?.checked_add(b?)
    }
    fn difference(&self, a: Option<i128>, b: Option<i128>) -> Option<i128> {
        a?.checked_sub(b?)
    }
    fn product(&self, a: Option<i128>, b: Option<i128>) -> Option<i128> {
        a?.checked_mul(b?)
    }
}

/// The fundamental matrix by the paper's eq. (2): entry (h, k) is (-1)^(h+k) det [P_i without row k; P_j without row h].
fn fundamental<R: Ring>(ring: &R, i: &Camera<R::E>, j: &Camera<R::E>) -> [[R::E; 3]; 3] {
    /// Pairs of columns with the sign by which their minors enter Laplace's expansion along two rows.
    const COLUMNS: [(usize, usize, usize, usize, bool); 6] = [
        (0, 1, 2, 3, true),
        (0, 2, 1, 3, false),
        (0, 3, 1, 2, true),
        (1, 2, 0, 3, true),
        (1, 3, 0, 2, false),
        (2, 3, 0, 1, true),
    ];
    const OTHERS: [(usize, usize); 3] = [(1, 2), (0, 2), (0, 1)];
    let minor = |camera: &Camera<R::E>, (a, b): (usize, usize), c: usize, d: usize| {
        ring.difference(ring.product(camera[a][c], camera[b][d]), ring.product(camera[a][d], camera[b][c]))
    };
    std::array::from_fn(|h| {
        std::array::from_fn(|k| {
            let terms = COLUMNS.map(|(a, b, c, d, plus)| {
                (ring.product(minor(i, OTHERS[k], a, b), minor(j, OTHERS[h], c, d)), plus == ((h + k) % 2 == 0))
            });
            let zero = ring.difference(terms[0].0, terms[0].0);
            terms.into_iter().fold(
                zero,
                |sum, (term, plus)| {
                    if plus { ring.sum(sum, term) } else { ring.difference(sum, term) }
                },
            )
        })
    })
}

/// Row t (0 to 9) of J_P for the edge (i, j) with cameras P, Q: entries with their columns.
///
/// With S = Q^T F P, the derivative of S + S^T in entry (r, c) of P has M = Q^T F in row and column c; that in entry (r, c) of Q
/// has K = F P there.
fn jacobian_row<R: Ring>(
    ring: &R,
    (i, j): (usize, usize),
    p: &Camera<R::E>,
    q: &Camera<R::E>,
    t: usize,
) -> Vec<(usize, R::E)> {
    const VECH: [(usize, usize); 10] = [(0, 0), (1, 0), (2, 0), (3, 0), (1, 1), (2, 1), (3, 1), (2, 2), (3, 2), (3, 3)];
    let f = fundamental(ring, p, q);
    let dot = |x: [R::E; 3], y: [R::E; 3]| {
        let [a, b, c] = std::array::from_fn(|k| ring.product(x[k], y[k]));
        ring.sum(ring.sum(a, b), c)
    };
    let column = |camera: &Camera<R::E>, c: usize| [camera[0][c], camera[1][c], camera[2][c]];
    let (row, col) = VECH[t];
    let mut entries = Vec::with_capacity(12);
    for r in 0..3 {
        let m = |a: usize| dot(column(q, a), column_of(&f, r));
        let k = |a: usize| dot(f[r], column(p, a));
        for (node, value) in [(i, [m(row), m(col)]), (j, [k(row), k(col)])] {
            let [of_row, of_col] = value;
            if row == col {
                entries.push((12 * node + 3 * row + r, ring.sum(of_row, of_row)));
            } else {
                entries.push((12 * node + 3 * col + r, of_row));
                entries.push((12 * node + 3 * row + r, of_col));
            }
        }
    }
    entries
}

fn column_of<E: Copy>(matrix: &[[E; 3]; 3], c: usize) -> [E; 3] {
    [matrix[0][c], matrix[1][c], matrix[2][c]]
}

/// Row `row` of J_P of a core.
pub(crate) fn jacobian<R: Ring>(ring: &R, core: &Core, cameras: &[Camera<R::E>], row: usize) -> Vec<(usize, R::E)> {
    let (i, j) = core.edges[row / 10];
    jacobian_row(ring, (i, j), &cameras[i], &cameras[j], row % 10)
}

/// The camera [ I | -c ].
pub(crate) fn camera_at(field: &Field, centre: &[u64; 3]) -> Camera<u64> {
    std::array::from_fn(|r| {
        std::array::from_fn(|c| match c {
            3 => field.neg(centre[r]),
            _ if c == r => field.one(),
            _ => 0,
        })
    })
}

/// The index q of the first coordinate in which two centres differ, the other two indices, and the difference d.
fn difference(field: &Field, i: &[u64; 3], j: &[u64; 3]) -> ([usize; 3], [u64; 3]) {
    let d = std::array::from_fn(|k| field.sub(i[k], j[k]));
    let indices = if d[0] != 0 {
        [0, 1, 2]
    } else if d[1] != 0 {
        [1, 0, 2]
    } else {
        [2, 0, 1]
    };
    (indices, d)
}

/// The direction a of row `row` of N.
pub(crate) fn direction(field: &Field, core: &Core, centres: &[[u64; 3]], row: usize) -> [u64; 3] {
    let (i, j) = core.edges[row / 2];
    let ([q, r, s], d) = difference(field, &centres[i], &centres[j]);
    let other = if row.is_multiple_of(2) { r } else { s };
    let mut a = [0; 3];
    a[other] = d[q];
    a[q] = field.neg(d[other]);
    a
}

/// Row `row` of N.
pub(crate) fn bearing(field: &Field, core: &Core, centres: &[[u64; 3]], row: usize) -> [(usize, u64); 6] {
    let (i, j) = core.edges[row / 2];
    let a = direction(field, core, centres, row);
    std::array::from_fn(|k| if k < 3 { (3 * i + k, a[k]) } else { (3 * j + k - 3, field.neg(a[k - 3])) })
}

/// The 4 x 4 matrix X of the edge (i, j) with dP_i = P_i X and dP_j = P_j X + lambda P_j, less the multiple of I that makes its
/// last entry zero; row by row.
///
/// With columns x_k = (u_k, w_k) of X and y_i, y_j of the motions: u_k - w_k c_i = y_i and u_k - w_k c_j + lambda P_j e_k = y_j, thus
/// y_i - y_j + lambda P_j e_k = -w_k d. On the direction a = d_q e_r - d_r e_q, a^T P_j e_r = d_q: this gives lambda.
pub(crate) fn projective_motion(
    field: &Field,
    core: &Core,
    centres: &[[u64; 3]],
    vector: &[u64],
    edge: usize,
) -> Checked<Vec<u64>> {
    let (i, j) = core.edges[edge];
    let ([q, r, _], d) = difference(field, &centres[i], &centres[j]);
    let inverse = field.inverse(d[q]);
    let change = |k: usize, row: usize| field.sub(vector[12 * i + 3 * k + row], vector[12 * j + 3 * k + row]);
    let lambda = field.sub(field.mul(field.mul(d[r], change(r, q)), inverse), change(r, r));
    let camera = camera_at(field, &centres[j]);
    let mut x = vec![0; 16];
    for k in 0..4 {
        let left = |row: usize| field.add(change(k, row), field.mul(lambda, camera[row][k]));
        let w = field.neg(field.mul(left(q), inverse));
        for row in 0..3 {
            let solved = field.add(left(row), field.mul(w, d[row])) == 0;
            ensure!(solved, "not a kernel vector at the core edge {edge}");
            x[4 * row + k] = field.add(vector[12 * i + 3 * k + row], field.mul(w, centres[i][row]));
        }
        x[12 + k] = w;
    }
    let last = x[15];
    (0..4).for_each(|k| x[5 * k] = field.sub(x[5 * k], last));
    Ok(x)
}

/// The motion y = s c + t of both ends of an edge: (s, t).
pub(crate) fn calibrated_motion(
    field: &Field,
    core: &Core,
    centres: &[[u64; 3]],
    vector: &[u64],
    edge: usize,
) -> Checked<Vec<u64>> {
    let (i, j) = core.edges[edge];
    let ([q, ..], d) = difference(field, &centres[i], &centres[j]);
    let change = |row: usize| field.sub(vector[3 * i + row], vector[3 * j + row]);
    let s = field.mul(change(q), field.inverse(d[q]));
    let solved = (0..3).all(|row| change(row) == field.mul(s, d[row]));
    ensure!(solved, "not a kernel vector at the core edge {edge}");
    let t = (0..3).map(|row| field.sub(vector[3 * i + row], field.mul(s, centres[i][row])));
    Ok(std::iter::once(s).chain(t).collect())
}
