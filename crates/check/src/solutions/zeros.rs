//! Coefficients of minors that are zero for generic centres: condition (S14) of section 12 (theory,
//! Theorem 10.7).

use super::minors::Place;
use super::system::Side;
use crate::document::solutions::Minor;

/// The sides of a row that are in a minor: columns, by their places among those of the minor, and the place of
/// the unknown.
type Sides = Vec<(Vec<usize>, Option<usize>)>;

/// What may be in the rows of a minor.
pub(super) struct Pattern {
    rows: Vec<Sides>,
    columns: usize,
    /// How many rows have each unknown.
    with: Vec<usize>,
}

impl Pattern {
    pub(super) fn new(minor: &Minor, place: &Place) -> Pattern {
        let columns_of = |side: &Side| {
            let generic = (0..3).filter(|&k| side.is_generic[k]);
            let columns = generic.map(|k| side.column + k);
            let places = columns.filter_map(|column| minor.cols.binary_search(&column).ok());
            places.collect::<Vec<usize>>()
        };
        let rows = &place.system.rows;
        let mut pattern = Pattern {
            rows: Vec::new(),
            columns: minor.cols.len(),
            with: vec![0; place.unknowns.len()],
        };
        for &row in &minor.rows {
            let listed = place.listed(row);
            listed.iter().flatten().for_each(|&f| pattern.with[f] += 1);
            let sides = [0, 1].map(|which| (columns_of(&rows[row][which]), listed[which]));
            pattern.rows.push(sides.into());
        }
        for (list, which) in [(&minor.plus, 0), (&minor.minus, 1)] {
            let sides = list
                .iter()
                .map(|&row| vec![(columns_of(&rows[row][which]), None)]);
            pattern.rows.extend(sides);
        }
        pattern
    }

    /// Whether there is a choice of one entry in each row, in different columns, among those that
    /// terms with this exponent may have.
    pub(super) fn has_transversal(&self, exponent: &[usize]) -> bool {
        let rows = self
            .rows
            .iter()
            .map(|sides| self.columns_left(sides, exponent));
        let rows: Vec<Vec<usize>> = rows.collect();
        have_transversal(&rows, self.columns)
    }

    /// The columns of the sides of a row that are not struck out: a side with an unknown whose
    /// exponent is zero is, and so is the other one if all rows with the unknown must give it.
    fn columns_left(
        &self,
        sides: &[(Vec<usize>, Option<usize>)],
        exponent: &[usize],
    ) -> Vec<usize> {
        let is_out = |which: usize| {
            let own = sides[which].1;
            let others = sides
                .iter()
                .enumerate()
                .filter(|&(other, _)| other != which);
            own.is_some_and(|f| exponent[f] == 0)
                || others
                    .filter_map(|(_, (_, unknown))| *unknown)
                    .any(|f| exponent[f] == self.with[f])
        };
        let left = (0..sides.len()).filter(|&which| !is_out(which));
        left.flat_map(|which| sides[which].0.iter().copied())
            .collect()
    }
}

/// Whether there is a choice of one of these columns in each row, all of them different.
pub(super) fn have_transversal(rows: &[Vec<usize>], columns: usize) -> bool {
    let mut row_at = vec![None; columns];
    (0..rows.len()).all(|row| place_row(row, rows, &mut row_at, &mut vec![false; columns]))
}

/// Finds a column for a row; rows that have one may move to others.
fn place_row(
    row: usize,
    rows: &[Vec<usize>],
    row_at: &mut [Option<usize>],
    seen: &mut [bool],
) -> bool {
    // Rows, each of which wants a column of the one before it, with how many of its own were tried.
    // A list and no recursion: it may be as long as there are rows.
    let mut path = vec![(row, 0)];
    while let Some((row, tried)) = path.last_mut() {
        let Some(&column) = rows[*row].get(*tried) else {
            path.pop();
            continue;
        };
        *tried += 1;
        if std::mem::replace(&mut seen[column], true) {
            continue;
        }
        let Some(other) = row_at[column] else {
            for (row, tried) in path {
                row_at[rows[row][tried - 1]] = Some(row);
            }
            return true;
        };
        path.push((other, 0));
    }
    false
}
