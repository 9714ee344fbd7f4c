//! All singular values of J as a dense matrix.

use super::AuditError;
use super::jacobian::{GramBlock, Jacobian};
use faer::{Mat, Side};

/// The singular values, falling, one a column of J.
///
/// # Errors
/// No convergence, or an entry that is not a number.
pub fn singular_values(j: &Jacobian) -> Result<Vec<f64>, AuditError> {
    j.dense()
        .singular_values()
        .map_err(|_| AuditError::NoConvergence)
}

/// The smallest eigenvalue of J^T J, formed as a matrix.
///
/// # Errors
/// As for [`singular_values`].
pub fn gram_eigenvalue(j: &Jacobian) -> Result<f64, AuditError> {
    let (diagonal, below) = j.gram();
    let columns = j.size().1;
    let mut gram = Mat::zeros(columns, columns);
    let mut put = |v: usize, w: usize, block: &GramBlock| {
        for (r, line) in block.iter().enumerate() {
            for (c, &x) in line.iter().enumerate() {
                gram[(12 * v + r, 12 * w + c)] = x;
            }
        }
    };
    for (v, block) in diagonal.iter().enumerate() {
        put(v, v, block);
    }
    for (&(i, j), block) in j.blocks.graph.edges().iter().zip(&below) {
        put(j as usize, i as usize, block);
    }
    let values = gram
        .self_adjoint_eigenvalues(Side::Lower)
        .map_err(|_| AuditError::NoConvergence)?;
    Ok(values.first().copied().unwrap_or(f64::NAN))
}

/// The rank by MATLAB's default tolerance, max(rows, columns) eps(sigma_1), where eps(x) is
/// the distance from x to the next larger double.
pub fn matlab_rank(values: &[f64], (rows, columns): (usize, usize)) -> usize {
    let largest = values.first().copied().unwrap_or(0.0);
    let tolerance = rows.max(columns) as f64 * (largest.next_up() - largest);
    values.iter().filter(|&&x| x > tolerance).count()
}

/// Orthonormal vectors with |J v|^2 at most `tolerance`, one a column.
///
/// # Errors
/// As for [`singular_values`].
pub fn null_space(j: &Jacobian, tolerance: f64) -> Result<Mat<f64>, AuditError> {
    let matrix = j.dense();
    let svd = matrix.thin_svd().map_err(|_| AuditError::NoConvergence)?;
    let values = svd.S().column_vector();
    let small: Vec<usize> = (0..values.nrows())
        .filter(|&k| values[k] * values[k] <= tolerance)
        .collect();
    Ok(Mat::from_fn(matrix.ncols(), small.len(), |row, k| {
        svd.V()[(row, small[k])]
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rank_of_matlab() {
        // eps(1) = 2^-52; a 3 x 2 matrix has the tolerance 3 * 2^-52.
        let eps = f64::EPSILON;
        assert_eq!(matlab_rank(&[1.0, 3.5 * eps], (3, 2)), 2);
        assert_eq!(matlab_rank(&[1.0, 2.5 * eps], (3, 2)), 1);
        assert_eq!(matlab_rank(&[1.0, f64::NAN], (3, 2)), 1);
    }
}
