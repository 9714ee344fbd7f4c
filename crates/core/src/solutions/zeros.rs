//! Coefficients of minors that are zero at all centres, for want of a transversal (docs/theory.md,
//! Theorem 10.7).

use super::evidence::{Minor, Part};
use super::system::System;

/// Whether the rows and columns of a minor can be matched where the coefficient of `exponent` has
/// entries that are not the zero polynomial: without the sides with an unknown of exponent 0,
/// and with these alone where every row with the unknown must give it (Theorem 10.7).
pub(super) fn has_transversal(
    system: &System<'_>,
    minor: &Minor,
    unknowns: &[usize],
    exponent: &[usize],
) -> bool {
    let place = |f: usize| unknowns.iter().position(|&g| g == f);
    let of_row = |row: usize, f: usize| system.rows[row].unknowns().any(|g| g == f);
    let whole = |part: &Part| match part {
        Part::Whole(row) => Some(*row),
        _ => None,
    };
    let counts: Vec<usize> = unknowns
        .iter()
        .map(|&f| {
            minor
                .rows
                .iter()
                .filter_map(whole)
                .filter(|&row| of_row(row, f))
                .count()
        })
        .collect();
    let columns = |row: usize, which: usize| entries(system, minor, row, which);
    let columns_of = |part: &Part| -> Vec<usize> {
        match *part {
            Part::Plus(row) => columns(row, 0),
            Part::Minus(row) => columns(row, 1),
            Part::Whole(row) => {
                let kept = |which: usize| {
                    let [own, other] =
                        [which, 1 - which].map(|k| system.rows[row].sides[k].scale.and_then(place));
                    own.is_none_or(|f| exponent[f] > 0)
                        && other.is_none_or(|f| exponent[f] < counts[f])
                };
                (0..2)
                    .filter(|&which| kept(which))
                    .flat_map(|which| columns(row, which))
                    .collect()
            }
        }
    };
    let allowed: Vec<Vec<usize>> = minor.rows.iter().map(columns_of).collect();
    is_matched(&allowed, system.columns)
}

/// The columns of a minor in which a side has an entry other than the zero polynomial.
fn entries(system: &System<'_>, minor: &Minor, row: usize, which: usize) -> Vec<usize> {
    let side = &system.rows[row].sides[which];
    let of_pattern = (0..3).filter(|&k| side.pattern[k]);
    of_pattern
        .map(|k| 3 * side.node + k)
        .filter(|column| minor.columns.contains(column))
        .collect()
}

/// Whether rows can have different columns of those that are allowed.
fn is_matched(allowed: &[Vec<usize>], columns: usize) -> bool {
    let mut row_of = vec![None; columns];
    (0..allowed.len()).all(|row| {
        let mut seen = vec![false; columns];
        augment(row, allowed, &mut row_of, &mut seen)
    })
}

/// Finds a column for a row, moving other rows to other columns if need be.
fn augment(
    row: usize,
    allowed: &[Vec<usize>],
    row_of: &mut [Option<usize>],
    seen: &mut [bool],
) -> bool {
    for &column in &allowed[row] {
        if seen[column] {
            continue;
        }
        seen[column] = true;
        if row_of[column].is_none_or(|other| augment(other, allowed, row_of, seen)) {
            row_of[column] = Some(row);
            return true;
        }
    }
    false
}
