//! A guess at a singular value, in floating point: nothing rests on it.

use super::rounded::Rounded;
use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

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
    let mut gram = Mat::<f64>::zeros(n, n);
    for row in &rows {
        for &(i, x) in row {
            for &(j, y) in row {
                gram[(i, j)] += x * y;
            }
        }
    }
    let largest = (0..n).map(|k| gram[(k, k)]).fold(0.0, f64::max);
    let trivial = Mat::from_fn(n, matrix.trivial.len(), |r, c| matrix.trivial[c][r]);
    let basis = (trivial.ncols() > 0).then(|| trivial.qr().compute_thin_Q());
    if let Some(basis) = &basis {
        gram += faer::Scale(largest) * (basis * basis.transpose());
    }
    let factor = gram.llt(Side::Lower).ok()?;
    let mut random = 1u64;
    let mut x = Mat::from_fn(n, 1, |_, _| {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (random >> 11) as f64 / 2f64.powi(53) - 0.5
    });
    let mut found = f64::INFINITY;
    for _ in 0..STEPS {
        factor.solve_in_place(x.as_mut());
        if let Some(basis) = &basis {
            x = &x - basis * (basis.transpose() * &x);
        }
        let norm = x.norm_l2();
        x = faer::Scale(1.0 / norm) * x;
        let image = rows
            .iter()
            .map(|row| row.iter().map(|&(k, y)| y * x[(k, 0)]).sum::<f64>());
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
