//! Pivots: the rows and columns of a minor, in an order in which elimination meets no zero (section
//! 7 of the specification).

use crate::core::Core;
use crate::rejection::{Checked, ensure};
use std::collections::HashSet;

/// Different rows and as many different columns of a matrix.
pub(crate) struct Pivots<'p> {
    pub rows: &'p [usize],
    pub cols: &'p [usize],
}

impl<'p> Pivots<'p> {
    /// Sees that the lists are as long as each other, and each index is there once.
    pub(crate) fn new(
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
    pub(crate) fn of_jacobian(
        rows: &'p [usize],
        cols: &'p [usize],
        core: &Core,
    ) -> Checked<Pivots<'p>> {
        Pivots::new(rows, cols, [10 * core.edges.len(), 12 * core.nodes])
    }
}
