//! Coefficients of minors that are zero at all centres, for want of a transversal (docs/theory.md,
//! Theorems 10.7 and 10.23).

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

/// Whether there is a transversal for some choice of a side of each row with an unknown, each unknown being
/// that of as many as its exponent says (Theorem 10.23).
pub(super) fn has_choice(
    system: &System<'_>,
    minor: &Minor,
    unknowns: &[usize],
    exponent: &[usize],
) -> bool {
    let place = |scale: Option<usize>| scale.and_then(|f| unknowns.iter().position(|&g| g == f));
    let columns = |row: usize, which: usize| entries(system, minor, row, which);
    let mut choices = Choices {
        open: Vec::new(),
        allowed: Vec::with_capacity(minor.rows.len()),
        left: exponent.to_vec(),
        columns: system.columns,
    };
    for part in &minor.rows {
        match *part {
            Part::Plus(row) => choices.allowed.push(columns(row, 0)),
            Part::Minus(row) => choices.allowed.push(columns(row, 1)),
            Part::Whole(row) => {
                let both = [columns(row, 0), columns(row, 1)];
                let scales = system.rows[row]
                    .sides
                    .each_ref()
                    .map(|side| place(side.scale));
                match scales {
                    [None, None] => choices.allowed.push(both.concat()),
                    _ => choices.open.push(OpenRow { both, scales }),
                }
            }
        }
    }
    choices.any_matched(0)
}

/// A row with unknowns: the columns of both sides, and which unknowns these are.
#[derive(Clone)]
struct OpenRow {
    both: [Vec<usize>; 2],
    scales: [Option<usize>; 2],
}

/// Rows of a minor and what may be chosen of them.
struct Choices {
    open: Vec<OpenRow>,
    /// The columns of the other rows, and of the sides that are chosen.
    allowed: Vec<Vec<usize>>,
    /// How often each unknown has still to be chosen.
    left: Vec<usize>,
    columns: usize,
}

impl Choices {
    /// Whether there is a transversal for some choice in the rows from one on.
    fn any_matched(&mut self, next: usize) -> bool {
        let Some(OpenRow { both, scales }) = self.open.get(next).cloned() else {
            return self.left.iter().all(|&left| left == 0)
                && is_matched(&self.allowed, self.columns);
        };
        both.into_iter().zip(scales).any(|(side, scale)| {
            if let Some(f) = scale {
                if self.left[f] == 0 {
                    return false;
                }
                self.left[f] -= 1;
            }
            self.allowed.push(side);
            let matched = self.any_matched(next + 1);
            self.allowed.pop();
            if let Some(f) = scale {
                self.left[f] += 1;
            }
            matched
        })
    }
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
