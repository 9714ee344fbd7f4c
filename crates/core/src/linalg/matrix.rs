//! Dense matrices.

use std::ops::{Index, IndexMut};

/// A dense matrix, stored row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Matrix<E> {
    rows: usize,
    cols: usize,
    data: Vec<E>,
}

impl<E> Matrix<E> {
    /// The matrix with `data[i * cols + j]` at `(i, j)`.
    ///
    /// # Panics
    /// If `data` does not hold `rows * cols` entries.
    pub fn new(rows: usize, cols: usize, data: Vec<E>) -> Self {
        assert_eq!(
            Some(data.len()),
            rows.checked_mul(cols),
            "entries of a {rows} x {cols} matrix"
        );
        Self { rows, cols, data }
    }

    /// The matrix with `entry(i, j)` at `(i, j)`.
    pub fn from_fn(rows: usize, cols: usize, mut entry: impl FnMut(usize, usize) -> E) -> Self {
        let data = (0..rows * cols)
            .map(|k| entry(k / cols, k % cols))
            .collect();
        Self { rows, cols, data }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of columns.
    pub fn cols(&self) -> usize {
        self.cols
    }

    /// All entries, row by row.
    pub fn data(&self) -> &[E] {
        &self.data
    }

    /// All entries, row by row.
    pub fn data_mut(&mut self) -> &mut [E] {
        &mut self.data
    }

    /// Row `i`.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, i: usize) -> &[E] {
        &self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// Row `i`.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row_mut(&mut self, i: usize) -> &mut [E] {
        &mut self.data[i * self.cols..(i + 1) * self.cols]
    }

    /// Exchanges rows `i` and `k`. O(cols)
    ///
    /// # Panics
    /// If there is no such row.
    pub fn swap_rows(&mut self, i: usize, k: usize) {
        if i != k {
            let (low, high) = (i.min(k), i.max(k));
            let (head, tail) = self.data.split_at_mut(high * self.cols);
            head[low * self.cols..(low + 1) * self.cols].swap_with_slice(&mut tail[..self.cols]);
        }
    }

    /// The matrix of the images of the entries.
    pub fn map<T>(&self, image: impl FnMut(&E) -> T) -> Matrix<T> {
        Matrix {
            rows: self.rows,
            cols: self.cols,
            data: self.data.iter().map(image).collect(),
        }
    }
}

impl<E: Clone> Matrix<E> {
    /// The transposed matrix.
    pub fn transposed(&self) -> Self {
        Self::from_fn(self.cols, self.rows, |i, j| self[(j, i)].clone())
    }

    /// The submatrix with the given rows and columns, in the order given.
    ///
    /// # Panics
    /// If there is no such row or column.
    pub fn submatrix(&self, rows: &[usize], cols: &[usize]) -> Self {
        Self::from_fn(rows.len(), cols.len(), |i, j| {
            self[(rows[i], cols[j])].clone()
        })
    }
}

impl<E> Index<(usize, usize)> for Matrix<E> {
    type Output = E;

    fn index(&self, (i, j): (usize, usize)) -> &E {
        &self.row(i)[j]
    }
}

impl<E> IndexMut<(usize, usize)> for Matrix<E> {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut E {
        &mut self.row_mut(i)[j]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices() {
        let mut m = Matrix::from_fn(3, 2, |i, j| 10 * i + j);
        assert_eq!(m.data(), [0, 1, 10, 11, 20, 21]);
        assert_eq!(m.transposed().data(), [0, 10, 20, 1, 11, 21]);
        assert_eq!(m.submatrix(&[2, 0], &[1]).data(), [21, 1]);
        m.swap_rows(2, 0);
        m[(1, 1)] = 7;
        assert_eq!(m, Matrix::new(3, 2, vec![20, 21, 10, 7, 0, 1]));
        assert_eq!(m.map(|x| x % 2 == 0).row(0), [true, false]);
        assert_eq!(Matrix::<u8>::new(0, 4, vec![]).transposed().rows(), 4);
    }
}
