//! The explicit map: fundamental matrices as functions of the cameras, in affine charts
//! (Proposition 1 of the paper).
//!
//! # Charts
//!
//! A camera is scaled so that its last entry that is not zero, counted column by column,
//! is 1; the other eleven are its coordinates. The same is done with the nine entries of a
//! fundamental matrix. The matrix is the Jacobian of that map, 8m x 11n, with blocks of
//! 8 x 22; its rank is 11n - 15 exactly for finite solvable graphs, at generic cameras.

use crate::formulation::Formulation;
use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian::{SparseRows, fundamental};
use viewcert::graph::Graph;
use viewcert::linalg::Field;

/// A camera in its chart.
#[derive(Clone, Debug, PartialEq)]
pub struct Charted<E> {
    /// The camera, with 1 at the place that the chart fixes.
    pub camera: Camera<E>,
    /// That place: `3 c + r` for row r, column c.
    pub fixed: usize,
}

/// The block of one edge.
#[derive(Clone, Debug, PartialEq)]
pub struct Block<E> {
    /// The fundamental matrix in its chart, column by column: entry `3 k + h` is (h, k).
    pub fundamental: [E; 9],
    /// The place whose value is fixed to 1.
    pub fixed: usize,
    /// `derivative[t][u]`: the t-th free entry of the fundamental matrix by the u-th free
    /// entry of the first camera, then of the second. 8 rows, 22 columns.
    pub derivative: Vec<Vec<E>>,
}

/// Scales a camera into its chart.
///
/// # Panics
/// For the zero matrix.
pub fn chart<F: Field>(field: &F, camera: &Camera<F::Elem>) -> Charted<F::Elem> {
    let (fixed, inverse) = (0..12)
        .rev()
        .find_map(|at| field.inv(&camera[at % 3][at / 3]).map(|inv| (at, inv)))
        .expect("a camera is not zero");
    let camera = camera
        .clone()
        .map(|row| row.map(|x| field.mul(&x, &inverse)));
    Charted { camera, fixed }
}

/// The places of the free entries.
fn free(count: usize, fixed: usize) -> impl Iterator<Item = usize> {
    (0..count).filter(move |&at| at != fixed)
}

/// The fundamental matrix of two charted cameras with its derivative. An entry of a camera
/// occurs at most once in every term of a 4 x 4 determinant, so that the difference for a
/// step of 1 is the derivative, exactly.
///
/// # Panics
/// If the centres coincide.
pub fn block<F: Field>(
    field: &F,
    p_i: &Charted<F::Elem>,
    p_j: &Charted<F::Elem>,
) -> Block<F::Elem> {
    let flat = |a: &Camera<F::Elem>, b: &Camera<F::Elem>| -> [F::Elem; 9] {
        let f = fundamental(field, a, b);
        std::array::from_fn(|at| f[at % 3][at / 3].clone())
    };
    let f = flat(&p_i.camera, &p_j.camera);
    let (fixed, inverse) = (0..9)
        .rev()
        .find_map(|at| field.inv(&f[at]).map(|inv| (at, inv)))
        .expect("centres are distinct");
    let affine = f.clone().map(|x| field.mul(&x, &inverse));
    let mut derivative = vec![Vec::new(); 8];
    for (second, from) in [(false, p_i), (true, p_j)] {
        for at in free(12, from.fixed) {
            let mut stepped = from.camera.clone();
            let entry = &mut stepped[at % 3][at / 3];
            *entry = field.add(entry, &field.one());
            let after = if second {
                flat(&p_i.camera, &stepped)
            } else {
                flat(&stepped, &p_j.camera)
            };
            let step: [F::Elem; 9] = std::array::from_fn(|q| field.sub(&after[q], &f[q]));
            // d (f_q / f_0) = (df_q - (f_q / f_0) df_0) / f_0
            for (row, q) in derivative.iter_mut().zip(free(9, fixed)) {
                let change = field.sub(&step[q], &field.mul(&affine[q], &step[fixed]));
                row.push(field.mul(&change, &inverse));
            }
        }
    }
    Block {
        fundamental: affine,
        fixed,
        derivative,
    }
}

/// The Jacobian of the affine map from cameras to fundamental matrices.
#[derive(Clone, Copy, Debug)]
pub struct ExplicitMap;

impl<F: Field> Formulation<F> for ExplicitMap {
    fn name(&self) -> &'static str {
        "explicit map"
    }

    fn source(&self) -> &'static str {
        "Arrigoni, Kohn, Fusiello, Pajdla, Proposition 1"
    }

    fn size_formula(&self) -> [&'static str; 2] {
        ["8m", "11n"]
    }

    fn size(&self, graph: &Graph) -> (usize, usize) {
        (8 * graph.edges().len(), 11 * graph.nodes())
    }

    fn trivial_kernel(&self, _graph: &Graph) -> usize {
        15
    }

    fn matrix(&self, field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> SparseRows<F::Elem> {
        assert_eq!(cameras.len(), graph.nodes(), "one camera a node");
        let charted: Vec<_> = cameras.iter().map(|camera| chart(field, camera)).collect();
        let mut rows = Vec::with_capacity(8 * graph.edges().len());
        for &(i, j) in graph.edges() {
            let (i, j) = (i as usize, j as usize);
            let columns = || (11 * i..11 * (i + 1)).chain(11 * j..11 * (j + 1));
            for row in block(field, &charted[i], &charted[j]).derivative {
                rows.push(
                    columns()
                        .zip(row)
                        .filter(|(_, x)| !field.is_zero(x))
                        .collect(),
                );
            }
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::linalg::Ring;
    use viewcert::linalg::rational::Rationals;

    /// P = [I | 0] and Q = [I | (1, 2, 1)]: F = -[c_P - c_Q]_x = -[(1, 2, 1)]_x =
    /// (0 1 -2; -1 0 1; 2 -1 0), and the last entry that is not zero, column by column, is
    /// F_12 = 1. Moving the last entry of P's fourth column by t turns the difference of
    /// centres into (1, 2, 1 - t), which changes F_01 = 1 to 1 - t and F_10 to t - 1.
    #[test]
    fn by_hand() {
        let camera = |t: [i64; 3]| -> Camera<_> {
            std::array::from_fn(|r| {
                std::array::from_fn(|c| {
                    Rationals.from_i64(if c == 3 { t[r] } else { i64::from(r == c) })
                })
            })
        };
        let p = chart(&Rationals, &camera([0, 0, 0]));
        let q = chart(&Rationals, &camera([1, 2, 1]));
        assert_eq!((p.fixed, q.fixed), (8, 11));
        let block = block(&Rationals, &p, &q);
        let expected = [0, -1, 2, 1, 0, -1, -2, 1, 0].map(|x| Rationals.from_i64(x));
        assert_eq!(block.fundamental, expected);
        assert_eq!(block.fixed, 7);
        // Place 11 is the last of P's eleven free entries.
        let column: Vec<_> = block.derivative.iter().map(|row| row[10].clone()).collect();
        let expected = [0, 1, 0, -1, 0, 0, 0, 0].map(|x| Rationals.from_i64(x));
        assert_eq!(column, expected);
    }
}
