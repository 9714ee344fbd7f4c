//! Phi with respect to the fundamental matrix, and the implicit function that the cameras
//! define by it (Proposition 2 of the paper).

use crate::formulation::explicit::{Block, Charted};
use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian::{VECH, jacobian};
use viewcert::graph::Graph;
use viewcert::linalg::matrix::Matrix;
use viewcert::linalg::{Field, Ring, textbook};

/// The 10 x 9 Jacobian of Phi with respect to the entries of F, taken column by column:
/// L_4 (K_44 + I) (P_i^T (x) P_j^T).
pub fn by_fundamental<R: Ring>(
    ring: &R,
    p_i: &Camera<R::Elem>,
    p_j: &Camera<R::Elem>,
) -> Matrix<R::Elem> {
    Matrix::from_fn(10, 9, |t, at| {
        let ((r, c), (h, k)) = (VECH[t], (at % 3, at / 3));
        ring.add(
            &ring.mul(&p_j[h][r], &p_i[k][c]),
            &ring.mul(&p_j[h][c], &p_i[k][r]),
        )
    })
}

/// Whether the kernel of [`by_fundamental`] is spanned by the given fundamental matrix:
/// then its rank is 8.
pub fn kernel_is<F: Field>(
    field: &F,
    p_i: &Camera<F::Elem>,
    p_j: &Camera<F::Elem>,
    fundamental: &[F::Elem; 9],
) -> bool {
    let basis = textbook::kernel(field, &by_fundamental(field, p_i, p_j));
    let [vector] = &basis[..] else { return false };
    let minors = (0..9).flat_map(|a| (0..a).map(move |b| (a, b)));
    fundamental.iter().any(|x| !field.is_zero(x))
        && minors.into_iter().all(|(a, b)| {
            field.mul(&vector[a], &fundamental[b]) == field.mul(&vector[b], &fundamental[a])
        })
}

/// The two Jacobians of Phi in the charts of a [`Block`]: by the 8 free entries of F, and
/// by the 22 free entries of the cameras.
pub fn affine_jacobians<F: Field>(
    field: &F,
    p_i: &Charted<F::Elem>,
    p_j: &Charted<F::Elem>,
    block: &Block<F::Elem>,
) -> (Matrix<F::Elem>, Matrix<F::Elem>) {
    let all: Vec<usize> = (0..10).collect();
    let entries: Vec<usize> = (0..9).filter(|&at| at != block.fixed).collect();
    let by_f = by_fundamental(field, &p_i.camera, &p_j.camera).submatrix(&all, &entries);
    let (pair, _) = Graph::from_pairs(2, vec![(0, 1)]).expect("one pair of two nodes");
    let rows = jacobian(field, &pair, &[p_i.camera.clone(), p_j.camera.clone()]);
    // J_P is taken at the fundamental matrix of the two cameras as it comes; that of the
    // chart is a multiple of it, and Phi is linear in it.
    let f = viewcert::geometry::jacobian::fundamental(field, &p_i.camera, &p_j.camera);
    let scale = field
        .inv(&f[block.fixed % 3][block.fixed / 3])
        .expect("the chart's entry is not zero");
    let cameras: Vec<usize> = (0..24)
        .filter(|&at| at != p_i.fixed && at != 12 + p_j.fixed)
        .collect();
    let by_cameras = viewcert::geometry::jacobian::dense(field, &rows, 24)
        .submatrix(&all, &cameras)
        .map(|x| field.mul(x, &scale));
    (by_f, by_cameras)
}

/// Whether dPhi/dF dF/dP = -dPhi/dP in the charts: the identity of Proposition 2 before
/// its choice of eight combinations A of the ten equations, and so for all of them.
pub fn identity_holds<F: Field>(
    field: &F,
    p_i: &Charted<F::Elem>,
    p_j: &Charted<F::Elem>,
    block: &Block<F::Elem>,
) -> bool {
    let (by_f, by_cameras) = affine_jacobians(field, p_i, p_j, block);
    (0..10).all(|t| {
        (0..22).all(|u| {
            let sum = (0..8).fold(by_cameras[(t, u)].clone(), |sum, q| {
                field.add(&sum, &field.mul(&by_f[(t, q)], &block.derivative[q][u]))
            });
            field.is_zero(&sum)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::super::explicit::{block, chart};
    use super::*;
    use proptest::prelude::*;
    use viewcert::geometry::draw::{DrawKey, cameras_mod, cameras_rational};
    use viewcert::linalg::prime::PrimeField;
    use viewcert::linalg::rational::{Rational, Rationals};

    fn key(seed: u64) -> DrawKey {
        DrawKey {
            graph_sha256: [0; 32],
            core_sha256: None,
            seed,
            draw: 0,
        }
    }

    fn pair(seed: u64) -> Vec<Charted<Rational>> {
        let drawn = cameras_rational(2, 9, 4, &key(seed)).unwrap().values;
        drawn
            .into_iter()
            .map(|camera| chart(&Rationals, &camera.map(|row| row.map(Rational::from))))
            .collect()
    }

    /// Multiplies an 8 x 10 matrix of small integers with a matrix of ten rows.
    fn combine(seed: u64, m: &Matrix<Rational>) -> Matrix<Rational> {
        let mut residue = key(seed).residues(&PrimeField::new(101).unwrap());
        let a: Vec<Rational> = (0..80)
            .map(|_| Rationals.from_i64((residue() % 101) as i64 - 50))
            .collect();
        Matrix::from_fn(8, m.cols(), |i, j| {
            (0..10).fold(Rationals.zero(), |sum, k| {
                Rationals.add(&sum, &Rationals.mul(&a[10 * i + k], &m[(k, j)]))
            })
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        /// Rank 8 and kernel F, over both fields.
        #[test]
        fn the_kernel_is_the_fundamental_matrix(seed in 0..u64::MAX) {
            let [p, q] = &pair(seed)[..] else { unreachable!() };
            let f = block(&Rationals, p, q).fundamental;
            prop_assert!(kernel_is(&Rationals, &p.camera, &q.camera, &f));
            // Of other cameras it is not.
            prop_assert!(!kernel_is(&Rationals, &q.camera, &p.camera, &f));
            for prime in [PrimeField::new(10_007).unwrap(), PrimeField::mersenne61()] {
                let drawn = cameras_mod(&prime, 2, &key(seed)).unwrap().values;
                let charted: Vec<_> = drawn.iter().map(|camera| chart(&prime, camera)).collect();
                let f = block(&prime, &charted[0], &charted[1]);
                prop_assert!(kernel_is(&prime, &drawn[0], &drawn[1], &f.fundamental));
                prop_assert!(identity_holds(&prime, &charted[0], &charted[1], &f));
            }
        }

        /// dF/dP = -(A dPhi/dF)^-1 (A dPhi/dP) for a random A: the reduced echelon form of
        /// [A dPhi/dF | A dPhi/dP] is [I | -dF/dP], so every column of the right part is
        /// minus the left part times a column of dF/dP, and the left part is invertible.
        #[test]
        fn the_implicit_function_theorem(seed in 0..u64::MAX) {
            let [p, q] = &pair(seed)[..] else { unreachable!() };
            let block = block(&Rationals, p, q);
            prop_assert!(identity_holds(&Rationals, p, q, &block));
            let (by_f, by_cameras) = affine_jacobians(&Rationals, p, q, &block);
            let (left, right) = (combine(seed, &by_f), combine(seed, &by_cameras));
            prop_assert_eq!(textbook::eliminate(&Rationals, &left).rank(), 8);
            for u in 0..22 {
                let both = Matrix::from_fn(8, 9, |i, k| {
                    if k < 8 { left[(i, k)].clone() } else { right[(i, u)].clone() }
                });
                // The kernel vector is (dF/dP column, 1): left x = -right.
                let kernel = textbook::kernel(&Rationals, &both);
                prop_assert_eq!(kernel.len(), 1);
                for (value, row) in kernel[0].iter().zip(&block.derivative) {
                    prop_assert_eq!(value, &row[u]);
                }
            }
        }
    }
}
