//! Minors of N(u) as polynomials in a few unknowns, and their span (docs/theory.md, Theorems 10.5
//! and 10.7).
//!
//! At every solution the rank of N(u) with rows freed and dropped is bounded (Lemma 10.2), so minors
//! one larger vanish. Each is named by its rows and columns; its polynomial is computed
//! at one assignment of centres, by interpolation on a grid.

use super::echelon::Echelon;
use super::system::{System, Values, subsets};
use crate::linalg::prime::PrimeField;

/// A row of a minor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A row of N(u).
    Whole(usize),
    /// Its first side alone, without scale: the row is freed.
    Plus(usize),
    /// Its second side alone, without scale and sign: the row is freed.
    Minus(usize),
}

/// A minor of N(u), with rows freed, that vanishes at all solutions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Minor {
    /// How many rows are freed.
    pub freed: usize,
    /// Its rows: 3 n' - 4 + `freed` + 1 of them.
    pub rows: Vec<Part>,
    /// Its columns, as many.
    pub columns: Vec<usize>,
}

/// A minor and its polynomial at the centres.
#[derive(Clone, Debug)]
pub(super) struct Generator {
    pub(super) minor: Minor,
    /// The degree in each unknown of the list, at most.
    pub(super) degrees: Vec<usize>,
    /// Coefficients in the order of [`Exponents`] for `degrees`.
    coefficients: Vec<u64>,
    /// Which coefficients are the zero polynomial in the centres by Theorem 10.7.
    zero: Vec<bool>,
}

/// All exponents up to bounds, in lexicographic order, the last unknown fastest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Exponents {
    pub(super) bounds: Vec<usize>,
}

impl Exponents {
    pub(super) fn len(&self) -> usize {
        self.bounds.iter().map(|bound| bound + 1).product()
    }

    pub(super) fn index(&self, exponent: &[usize]) -> usize {
        exponent
            .iter()
            .zip(&self.bounds)
            .fold(0, |index, (e, bound)| index * (bound + 1) + e)
    }

    /// Those that are marked.
    pub(super) fn marked(&self, marks: &[bool]) -> Vec<Vec<usize>> {
        let marked = self.all().into_iter().zip(marks).filter(|(_, mark)| **mark);
        marked.map(|(exponent, _)| exponent).collect()
    }

    pub(super) fn all(&self) -> Vec<Vec<usize>> {
        self.bounds.iter().fold(vec![Vec::new()], |all, &bound| {
            let longer = all.into_iter().flat_map(|exponent: Vec<usize>| {
                (0..=bound).map(move |e| exponent.iter().copied().chain([e]).collect())
            });
            longer.collect()
        })
    }
}

/// Most columns in which all minors of some rows are computed: 2^12 of them.
const MOST_COLUMNS: usize = 12;

/// Most choices of rows that are tried for one choice of freed rows.
const MOST_ROW_CHOICES: usize = 60;

/// Most values on a grid.
const MOST_VALUES: usize = 1 << 10;

/// The span of the minors in some unknowns, shifts within the bounds included.
pub(super) struct Span {
    /// The unknowns.
    pub(super) unknowns: Vec<usize>,
    pub(super) exponents: Exponents,
    /// Minors none of which is a combination of shifts of those before it.
    pub(super) generators: Vec<Generator>,
    rank: usize,
    /// Exponents at which no shift of a generator has a coefficient, at any centres.
    pub(super) absent: Vec<bool>,
}

impl Span {
    /// The minors in some unknowns without value; other rows with unknowns are freed, three at
    /// most, or dropped. Stops early when only one point is left.
    pub(super) fn new(system: &System<'_>, values: &Values, unknowns: &[usize]) -> Option<Self> {
        let degrees = system.core.degrees(&system.rows);
        let exponents = Exponents {
            bounds: unknowns.iter().map(|&f| degrees[f]).collect(),
        };
        if exponents.len() > MOST_VALUES {
            return None;
        }
        let mut span = Self {
            unknowns: unknowns.to_vec(),
            exponents,
            generators: Vec::new(),
            rank: 0,
            absent: Vec::new(),
        };
        let full = span.exponents.len() - 1;
        let mut echelon = Echelon::default();
        let scaled = system.scaled(values);
        let constants = system.constants(values);
        for size in (0..=3.min(scaled.len())).rev() {
            let unfinished = subsets(&scaled, size, &mut |freed| {
                span.minors(system, values, &constants, freed, &mut |span, generator| {
                    let mut new = false;
                    for shifted in generator.shifts(&span.exponents) {
                        new |= echelon.insert(&system.field, shifted.1);
                    }
                    if new {
                        span.generators.push(generator);
                    }
                    echelon.rank() < full
                })
            });
            if !unfinished {
                break;
            }
        }
        span.rank = echelon.rank();
        if span.rank < full {
            for generator in &mut span.generators {
                generator.find_zeros(system, unknowns);
            }
        }
        span.absent = span.absent(&span.exponents);
        Some(span)
    }

    /// Whether only u = 1 is left (Theorem 10.5): the rank is one less than the number of exponents,
    /// and differences of exponents generate all of Z^unknowns.
    pub(super) fn is_unique(&self) -> bool {
        let present = self.absent.iter().filter(|&&absent| !absent).count();
        self.rank + 1 == present && steps_everywhere(&self.exponents, &self.absent)
    }

    /// The exponents at which no shift of a generator has a coefficient, at any centres.
    fn absent(&self, exponents: &Exponents) -> Vec<bool> {
        let mut absent = vec![true; exponents.len()];
        for generator in &self.generators {
            let own = Exponents {
                bounds: generator.degrees.clone(),
            };
            let present: Vec<Vec<usize>> = own
                .all()
                .into_iter()
                .zip(&generator.zero)
                .filter(|(_, zero)| !**zero)
                .map(|(exponent, _)| exponent)
                .collect();
            for shift in generator.room(exponents).all() {
                for exponent in &present {
                    absent[exponents.index(&sum(exponent, &shift))] = false;
                }
            }
        }
        absent
    }

    /// Calls `each` with the minors for one choice of freed rows, until it returns false; returns
    /// whether it never did.
    fn minors(
        &mut self,
        system: &System<'_>,
        values: &Values,
        constants: &(Echelon, Vec<usize>),
        freed: &[usize],
        each: &mut impl FnMut(&mut Self, Generator) -> bool,
    ) -> bool {
        let field = &system.field;
        let (mut echelon, used) = constants.clone();
        let mut parts: Vec<Part> = used.into_iter().map(Part::Whole).collect();
        for &row in freed {
            for (which, part) in [(0, Part::Plus(row)), (1, Part::Minus(row))] {
                if echelon.insert(field, system.rows[row].side(which, system.columns)) {
                    parts.push(part);
                }
            }
        }
        let inside = |row: usize| {
            let mut open = system.rows[row].unknowns().filter(|&f| values[f].is_none());
            open.all(|f| self.unknowns.contains(&f))
        };
        let variable: Vec<usize> = (0..system.rows.len())
            .filter(|&row| !system.is_constant(row, values) && inside(row) && !freed.contains(&row))
            .collect();
        let free: Vec<usize> = (0..system.columns)
            .filter(|column| !echelon.pivots().contains(column))
            .collect();
        let size = (system.target + freed.len() + 1).saturating_sub(echelon.rank());
        if size == 0 || size > variable.len() || free.len() > MOST_COLUMNS || size > free.len() {
            return true;
        }
        // Each side without the constant rows, in the columns that are left.
        let sides: Vec<[Vec<u64>; 2]> = variable
            .iter()
            .map(|&row| {
                [0, 1].map(|which| {
                    let mut side = system.rows[row].side(which, system.columns);
                    let scale = system.rows[row].sides[which].scale;
                    if let Some(value) = scale.and_then(|f| values[f]) {
                        side.iter_mut().for_each(|x| *x = field.times(*x, value));
                    }
                    echelon.reduce(field, &mut side);
                    free.iter().map(|&column| side[column]).collect()
                })
            })
            .collect();
        let places: Vec<usize> = (0..variable.len()).collect();
        let mut choices = 0;
        subsets(&places, size, &mut |chosen| {
            choices += 1;
            let rows: Vec<ScaledRow<'_>> = chosen
                .iter()
                .map(|&k| ScaledRow {
                    sides: &sides[k],
                    scales: [0, 1].map(|which| {
                        let scale = system.rows[variable[k]].sides[which].scale;
                        scale.and_then(|f| self.unknowns.iter().position(|&g| g == f))
                    }),
                })
                .collect();
            let degrees: Vec<usize> = (0..self.unknowns.len())
                .map(|f| {
                    rows.iter()
                        .filter(|row| row.scales.contains(&Some(f)))
                        .count()
                        .min(3)
                })
                .collect();
            for (columns, coefficients) in polynomials(field, &rows, free.len(), &degrees) {
                let whole = chosen.iter().map(|&k| Part::Whole(variable[k]));
                let of_free = columns.into_iter().map(|k| free[k]);
                let minor = Minor {
                    freed: freed.len(),
                    rows: parts.iter().copied().chain(whole).collect(),
                    columns: echelon.pivots().iter().copied().chain(of_free).collect(),
                };
                let degrees = degrees.clone();
                let zero = vec![false; coefficients.len()];
                if !each(
                    self,
                    Generator {
                        minor,
                        degrees,
                        coefficients,
                        zero,
                    },
                ) {
                    return false;
                }
            }
            choices < MOST_ROW_CHOICES
        }) || choices >= MOST_ROW_CHOICES
    }

    /// All exponents up to `more` above the bounds, which of them are absent, and a basis of the
    /// vectors on the others that all shifts of the generators annihilate.
    pub(super) fn annihilated(
        &self,
        field: &PrimeField,
        more: usize,
    ) -> (Exponents, Vec<bool>, Vec<Vec<u64>>) {
        let bounds = self
            .exponents
            .bounds
            .iter()
            .map(|bound| bound + more)
            .collect();
        let exponents = Exponents { bounds };
        let mut echelon = Echelon::default();
        for generator in &self.generators {
            for (_, shifted) in generator.shifts(&exponents) {
                echelon.insert(field, shifted);
            }
        }
        let absent = self.absent(&exponents);
        let mut kernel = echelon.kernel(field, exponents.len());
        // At an absent exponent all shifts vanish, so it has a vector of its own.
        kernel.retain(|vector| {
            vector
                .iter()
                .zip(&absent)
                .any(|(&x, absent)| x != 0 && !absent)
        });
        (exponents, absent, kernel)
    }
}

impl Generator {
    /// All multiples by a monomial within the bounds: the exponent, and the coefficients.
    fn shifts(&self, exponents: &Exponents) -> Vec<(Vec<usize>, Vec<u64>)> {
        let own = Exponents {
            bounds: self.degrees.clone(),
        };
        let room = self.room(exponents);
        let terms: Vec<(Vec<usize>, u64)> = own
            .all()
            .into_iter()
            .zip(self.coefficients.iter().copied())
            .filter(|&(_, coefficient)| coefficient != 0)
            .collect();
        if terms.is_empty() {
            return Vec::new();
        }
        let shifted = room.all().into_iter().map(|shift| {
            let mut vector = vec![0; exponents.len()];
            for (exponent, coefficient) in &terms {
                vector[exponents.index(&sum(exponent, &shift))] = *coefficient;
            }
            (shift, vector)
        });
        shifted.collect()
    }

    /// The shifts that stay within the bounds.
    fn room(&self, exponents: &Exponents) -> Exponents {
        let room = exponents.bounds.iter().zip(&self.degrees);
        Exponents {
            bounds: room.map(|(bound, degree)| bound - degree).collect(),
        }
    }

    /// How many coefficients are said to be zero at all centres.
    ///
    /// # Panics
    /// If one of them is not zero at the centres of this system.
    #[cfg(test)]
    pub(super) fn check_zeros(&self, system: &System<'_>, unknowns: &[usize]) -> usize {
        let own = Exponents {
            bounds: self.degrees.clone(),
        };
        let field = &system.field;
        let mut values: Vec<u64> = own
            .all()
            .iter()
            .map(|point| {
                let value = |f: usize| {
                    let place = unknowns.iter().position(|&g| g == f);
                    field.from_u64(place.map_or(1, |place| point[place] as u64))
                };
                let rows = self.minor.rows.iter().map(|part| match *part {
                    Part::Whole(row) => system.rows[row].at(field, system.columns, value),
                    Part::Plus(row) => system.rows[row].side(0, system.columns),
                    Part::Minus(row) => system.rows[row].side(1, system.columns),
                });
                let rows: Vec<Vec<u64>> = rows
                    .map(|row| {
                        self.minor
                            .columns
                            .iter()
                            .map(|&column| row[column])
                            .collect()
                    })
                    .collect();
                determinant(field, rows)
            })
            .collect();
        interpolate(field, &self.degrees, &mut values);
        let zeros = self.zero.iter().zip(&values).filter(|(zero, _)| **zero);
        zeros.inspect(|(_, value)| assert_eq!(**value, 0)).count()
    }

    /// Finds the coefficients that are zero at all centres by Theorem 10.7.
    fn find_zeros(&mut self, system: &System<'_>, unknowns: &[usize]) {
        let own = Exponents {
            bounds: self.degrees.clone(),
        };
        for (k, exponent) in own.all().iter().enumerate() {
            self.zero[k] = self.coefficients[k] == 0
                && !has_transversal(system, &self.minor, unknowns, exponent);
        }
    }
}

fn sum(a: &[usize], b: &[usize]) -> Vec<usize> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}

/// Whether for every unknown some exponent and the next one are both present.
fn steps_everywhere(exponents: &Exponents, absent: &[bool]) -> bool {
    let all = exponents.all();
    (0..exponents.bounds.len()).all(|f| {
        all.iter().enumerate().any(|(k, exponent)| {
            let mut next = exponent.clone();
            next[f] += 1;
            next[f] <= exponents.bounds[f] && !absent[k] && !absent[exponents.index(&next)]
        })
    })
}

/// Whether the rows and columns of a minor can be matched where the coefficient of `exponent` has
/// entries that are not the zero polynomial: without the sides with an unknown of exponent 0,
/// and with these alone where every row with the unknown must give it (Theorem 10.7).
fn has_transversal(
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
    let entries = |row: usize, which: usize| {
        let side = &system.rows[row].sides[which];
        (0..3)
            .filter(|&k| side.pattern[k])
            .map(|k| 3 * side.node + k)
            .collect::<Vec<_>>()
    };
    let columns_of = |part: &Part| -> Vec<usize> {
        match *part {
            Part::Plus(row) => entries(row, 0),
            Part::Minus(row) => entries(row, 1),
            Part::Whole(row) => {
                let kept = |which: usize| {
                    let [own, other] =
                        [which, 1 - which].map(|k| system.rows[row].sides[k].scale.and_then(place));
                    own.is_none_or(|f| exponent[f] > 0)
                        && other.is_none_or(|f| exponent[f] < counts[f])
                };
                (0..2)
                    .filter(|&which| kept(which))
                    .flat_map(|which| entries(row, which))
                    .collect()
            }
        }
    };
    let mut row_of = vec![None; system.columns];
    let allowed: Vec<Vec<usize>> = minor
        .rows
        .iter()
        .map(|part| {
            let columns = columns_of(part).into_iter();
            columns
                .filter(|column| minor.columns.contains(column))
                .collect()
        })
        .collect();
    (0..allowed.len()).all(|row| {
        let mut seen = vec![false; system.columns];
        augment(row, &allowed, &mut row_of, &mut seen)
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

/// A row `x sides[0] - y sides[1]`, x and y being one or unknowns.
struct ScaledRow<'a> {
    sides: &'a [Vec<u64>; 2],
    scales: [Option<usize>; 2],
}

/// The minors of some rows in all choices of as many columns, as polynomials: the columns, and the
/// coefficients in the order of [`Exponents`]. O(2^columns * columns) for each value on the grid.
fn polynomials(
    field: &PrimeField,
    rows: &[ScaledRow<'_>],
    columns: usize,
    degrees: &[usize],
) -> Vec<(Vec<usize>, Vec<u64>)> {
    let grid = Exponents {
        bounds: degrees.to_vec(),
    };
    let masks: Vec<usize> = (0..1usize << columns)
        .filter(|mask| mask.count_ones() as usize == rows.len())
        .collect();
    let mut of_mask: Vec<Vec<u64>> = masks
        .iter()
        .map(|_| Vec::with_capacity(grid.len()))
        .collect();
    let mut table = vec![0; 1 << columns];
    for point in grid.all() {
        let matrix: Vec<Vec<u64>> = rows
            .iter()
            .map(|row| {
                let [x, y] = row
                    .scales
                    .map(|f| f.map(|f| field.from_u64(point[f] as u64)));
                let times =
                    |scale: Option<u64>, entry: u64| scale.map_or(entry, |s| field.times(s, entry));
                let sides = row.sides[0].iter().zip(&row.sides[1]);
                sides
                    .map(|(&a, &b)| field.minus(times(x, a), times(y, b)))
                    .collect()
            })
            .collect();
        all_minors(field, &matrix, columns, &mut table);
        for (values, &mask) in of_mask.iter_mut().zip(&masks) {
            values.push(table[mask]);
        }
    }
    let columns_of = |mask: usize| (0..columns).filter(move |k| mask >> k & 1 == 1).collect();
    let mut found = Vec::new();
    for (&mask, mut values) in masks.iter().zip(of_mask) {
        if values.iter().any(|&x| x != 0) {
            interpolate(field, degrees, &mut values);
            found.push((columns_of(mask), values));
        }
    }
    found
}

/// Enters the determinants of the first k rows in every set of k columns, by Laplace expansion
/// along the last row.
fn all_minors(field: &PrimeField, matrix: &[Vec<u64>], columns: usize, table: &mut [u64]) {
    table[0] = field.from_u64(1);
    for mask in 1..1usize << columns {
        let size = mask.count_ones() as usize;
        if size > matrix.len() {
            continue;
        }
        let row = &matrix[size - 1];
        let mut sum = 0;
        for column in (0..columns).filter(|column| mask >> column & 1 == 1) {
            let term = field.times(row[column], table[mask & !(1 << column)]);
            let above = (mask >> column).count_ones() - 1;
            sum = if above % 2 == 0 {
                field.plus(sum, term)
            } else {
                field.minus(sum, term)
            };
        }
        table[mask] = sum;
    }
}

/// Turns values on the grid 0, 1, .., degree in each unknown into coefficients, by divided
/// differences.
fn interpolate(field: &PrimeField, degrees: &[usize], values: &mut [u64]) {
    let mut stride = values.len();
    for &degree in degrees {
        let block = stride;
        stride /= degree + 1;
        for start in (0..values.len()).step_by(block) {
            for offset in start..start + stride {
                let at = |k: usize| offset + k * stride;
                for order in 1..=degree {
                    let inverse = field
                        .inverse(field.from_u64(order as u64))
                        .unwrap_or_default();
                    for k in (order..=degree).rev() {
                        let difference = field.minus(values[at(k)], values[at(k - 1)]);
                        values[at(k)] = field.times(difference, inverse);
                    }
                }
                // Newton's form sum d_k x (x - 1) .. (x - k + 1), unfolded from inside.
                for k in (0..degree).rev() {
                    for l in k..degree {
                        let part = field.times(field.from_u64(k as u64), values[at(l + 1)]);
                        values[at(l)] = field.minus(values[at(l)], part);
                    }
                }
            }
        }
    }
}

/// By elimination.
#[cfg(test)]
fn determinant(field: &PrimeField, mut rows: Vec<Vec<u64>>) -> u64 {
    let mut product = field.from_u64(1);
    for k in 0..rows.len() {
        let Some(pivot) = (k..rows.len()).find(|&row| rows[row][k] != 0) else {
            return 0;
        };
        if pivot != k {
            rows.swap(pivot, k);
            product = field.negate(product);
        }
        product = field.times(product, rows[k][k]);
        let inverse = field.inverse(rows[k][k]).unwrap();
        let (head, tail) = rows.split_at_mut(k + 1);
        for row in tail {
            let factor = field.negate(field.times(row[k], inverse));
            field.axpy(row, factor, &head[k]);
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (1 - x) (2 - y^2) + 3 x^3 y on the grid of degrees 3 and 2.
    #[test]
    fn a_polynomial_from_its_values() {
        let f = PrimeField::new(10007).unwrap();
        let value = |x: i64, y: i64| (1 - x) * (2 - y * y) + 3 * x * x * x * y;
        let element = |x: i64| f.from_u64(x.rem_euclid(10007) as u64);
        let exponents = Exponents { bounds: vec![3, 2] };
        let mut values: Vec<u64> = exponents
            .all()
            .iter()
            .map(|point| element(value(point[0] as i64, point[1] as i64)))
            .collect();
        interpolate(&f, &[3, 2], &mut values);
        let expected = [2, 0, -1, -2, 0, 1, 0, 0, 0, 0, 3, 0].map(element);
        assert_eq!(values, expected);
    }

    #[test]
    fn minors_by_hand() {
        let f = PrimeField::new(10007).unwrap();
        let rows: [&[u64]; 2] = [&[1, 2, 3], &[4, 5, 7]];
        let matrix: Vec<Vec<u64>> = rows
            .iter()
            .map(|row| row.iter().map(|&x| f.from_u64(x)).collect())
            .collect();
        let mut table = vec![0; 8];
        all_minors(&f, &matrix, 3, &mut table);
        let negative = |x: u64| f.negate(f.from_u64(x));
        assert_eq!(
            [table[3], table[5], table[6]],
            [negative(3), negative(5), negative(1)]
        );
    }
}
