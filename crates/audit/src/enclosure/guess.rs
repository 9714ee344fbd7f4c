//! A guess at a singular value, in floating point: nothing rests on it.

use super::rounded::Rounded;
use crate::dense::{Cholesky, add, dot, orthonormal};

/// Steps of inverse iteration.
const STEPS: usize = 60;

/// The square of the smallest singular value behind those of trivial motions, in units of the rounded matrix; nothing
/// where doubles do not see it. O(N^3).
pub(super) fn square(matrix: &Rounded) -> Option<f64> {
    let (n, unit) = (matrix.columns, 2f64.powi(-(super::rounded::BITS as i32)));
    let rows: Vec<Vec<(usize, f64)>> = matrix
        .rows
        .iter()
        .map(|row| {
            row.iter()
                .map(|&(k, x)| (k as usize, x as f64 * unit))
                .collect()
        })
        .collect();
    let mut gram: Vec<Vec<f64>> = (1..=n).map(|width| vec![0.0; width]).collect();
    for row in &rows {
        for &(i, x) in row {
            for &(j, y) in row.iter().filter(|&&(j, _)| j <= i) {
                gram[i][j] += x * y;
            }
        }
    }
    let largest = (0..n).map(|k| gram[k][k]).fold(0.0, f64::max);
    let mut basis = matrix.trivial.clone();
    orthonormal(&mut basis);
    for (i, row) in gram.iter_mut().enumerate() {
        basis
            .iter()
            .for_each(|v| add(row, largest * v[i], &v[..=i]));
    }
    let factor = Cholesky::new(gram)?;
    let mut random = 1u64;
    let mut uniform = || {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (random >> 11) as f64 / 2f64.powi(53) - 0.5
    };
    let mut x: Vec<f64> = (0..n).map(|_| uniform()).collect();
    let mut found = f64::INFINITY;
    for _ in 0..STEPS {
        factor.solve(&mut x);
        for v in &basis {
            let along = dot(v, &x);
            add(&mut x, -along, v);
        }
        let norm = dot(&x, &x).sqrt();
        x.iter_mut().for_each(|y| *y /= norm);
        let image = rows
            .iter()
            .map(|row| row.iter().map(|&(k, y)| y * x[k]).sum::<f64>());
        let value: f64 = image.map(|y| y * y).sum();
        if !value.is_finite() {
            return None;
        }
        let is_settled = (found - value).abs() <= 1e-15 * value;
        found = value;
        if is_settled {
            break;
        }
    }
    let visible = found > 1e-13 * largest;
    visible.then_some(found / (unit * unit))
}
