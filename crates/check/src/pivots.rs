//! Pivots: the rows and columns of a minor, in an order in which elimination meets no zero (section
//! 7 of the specification).

use crate::elimination::Echelon;
use crate::rejection::{Checked, ensure};
use crate::structure::Core;
use std::collections::HashSet;

/// Different rows and as many different columns of a matrix.
pub(crate) struct Pivots<'p> {
    pub rows: &'p [usize],
    pub cols: &'p [usize],
}

impl<'p> Pivots<'p> {
    /// Sees that the lists are as long as each other, and each index is there once.
    pub fn new(
        rows: &'p [usize],
        cols: &'p [usize],
        [height, width]: [usize; 2],
    ) -> Checked<Pivots<'p>> {
        ensure!(
            rows.len() == cols.len(),
            "{} pivot rows, but {} pivot columns",
            rows.len(),
            cols.len()
        );
        for (list, limit) in [(rows, height), (cols, width)] {
            let inside = list.iter().filter(|&&index| index < limit);
            let different: HashSet<&usize> = inside.collect();
            ensure!(
                different.len() == list.len(),
                "the pivots are not different indices below {limit}"
            );
        }
        Ok(Pivots { rows, cols })
    }

    /// Pivots of J_P of a core.
    pub fn of_jacobian(rows: &'p [usize], cols: &'p [usize], core: &Core) -> Checked<Pivots<'p>> {
        Pivots::new(rows, cols, [10 * core.edges.len(), 12 * core.nodes])
    }

    /// The rows with their columns.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize)> {
        self.rows.iter().copied().zip(self.cols.iter().copied())
    }
}

/// Eliminates along pivots, none of which may vanish.
pub(crate) fn eliminate<'f, E: IntoIterator<Item = (usize, u64)>>(
    mut echelon: Echelon<'f>,
    pivots: &Pivots,
    row: impl Fn(usize) -> E,
) -> Checked<Echelon<'f>> {
    for (k, (number, column)) in pivots.iter().enumerate() {
        ensure!(
            echelon.push(row(number), Some(column))?,
            "pivot {k} vanishes"
        );
    }
    Ok(echelon)
}
