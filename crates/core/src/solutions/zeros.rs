//! Coefficients of minors that are zero at all centres, for want of a transversal or for a hub
//! (docs/theory.md, Theorems 10.7 and 10.23).

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

/// Whether however a side of each row with an unknown is chosen that a term with this exponent may take,
/// there is no transversal or a hub (Theorem 10.23): the coefficient is the zero polynomial in the centres.
pub(super) fn has_hubs(
    system: &System<'_>,
    minor: &Minor,
    unknowns: &[usize],
    exponent: &[usize],
) -> bool {
    let place = |scale: Option<usize>| scale.and_then(|f| unknowns.iter().position(|&g| g == f));
    let mut chosen = Chosen {
        system,
        minor,
        open: Vec::new(),
        parts: Vec::with_capacity(minor.rows.len()),
        left: exponent.to_vec(),
    };
    for &part in &minor.rows {
        match part {
            Part::Whole(row) => match system.rows[row]
                .sides
                .each_ref()
                .map(|side| place(side.scale))
            {
                [None, None] => chosen.parts.push(part),
                places => chosen.open.push((row, places)),
            },
            _ => chosen.parts.push(part),
        }
    }
    chosen.all_singular(0)
}

/// A minor with one side of some of its rows.
struct Chosen<'a> {
    system: &'a System<'a>,
    minor: &'a Minor,
    /// The rows with unknowns, and those of their sides.
    open: Vec<(usize, [Option<usize>; 2])>,
    /// The other rows, and what is chosen of the first of these.
    parts: Vec<Part>,
    /// How often each unknown has still to be chosen.
    left: Vec<usize>,
}

impl Chosen<'_> {
    /// Whether all choices for the rows from one on are singular at all centres.
    fn all_singular(&mut self, next: usize) -> bool {
        let Some(&(row, places)) = self.open.get(next) else {
            return self.left.iter().any(|&left| left > 0) || self.is_singular();
        };
        [Part::Plus(row), Part::Minus(row)]
            .into_iter()
            .zip(places)
            .all(|(part, place)| {
                if let Some(f) = place {
                    if self.left[f] == 0 {
                        return true;
                    }
                    self.left[f] -= 1;
                }
                self.parts.push(part);
                let singular = self.all_singular(next + 1);
                self.parts.pop();
                if let Some(f) = place {
                    self.left[f] += 1;
                }
                singular
            })
    }

    fn is_singular(&self) -> bool {
        let nodes = self.system.columns / 3;
        !self.is_matched() || (0..nodes).any(|hub| self.is_hub(hub))
    }

    fn is_matched(&self) -> bool {
        let columns = |row: usize, which: usize| entries(self.system, self.minor, row, which);
        let allowed = self.parts.iter().map(|part| match *part {
            Part::Plus(row) => columns(row, 0),
            Part::Minus(row) => columns(row, 1),
            Part::Whole(row) => [columns(row, 0), columns(row, 1)].concat(),
        });
        is_matched(&allowed.collect::<Vec<_>>(), self.system.columns)
    }

    /// Whether all that leads out of some nodes, which whole rows join, leads to this one.
    fn is_hub(&self, hub: usize) -> bool {
        let nodes = self.system.columns / 3;
        let ends = |row: usize| self.system.rows[row].sides.each_ref().map(|side| side.node);
        let mut class: Vec<usize> = (0..nodes).collect();
        let mut leads_elsewhere: Vec<bool> = (0..nodes)
            .map(|v| (3 * v..3 * v + 3).any(|column| !self.minor.columns.contains(&column)))
            .collect();
        for &part in &self.parts {
            match part {
                Part::Whole(row) => {
                    let [v, w] = ends(row);
                    if v != hub && w != hub {
                        let (from, to) = (class[v], class[w]);
                        for x in class.iter_mut().filter(|x| **x == from) {
                            *x = to;
                        }
                    }
                }
                Part::Plus(row) | Part::Minus(row) => {
                    let [plus, minus] = ends(row);
                    let (at, other) = match part {
                        Part::Plus(_) => (plus, minus),
                        _ => (minus, plus),
                    };
                    leads_elsewhere[at] |= other != hub;
                }
            }
        }
        let is_closed = |of: usize| (0..nodes).all(|v| class[v] != of || !leads_elsewhere[v]);
        (0..nodes).any(|v| v != hub && is_closed(class[v]))
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
