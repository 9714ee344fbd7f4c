//! Minors of N(u) with rows freed and dropped, as polynomials in a few unknowns (docs/theory.md,
//! Lemma 10.2).
//!
//! At every solution the rank of N(u) with rows freed and dropped is bounded, so minors one larger
//! vanish. Each is named by its rows and columns; its polynomial is computed at one
//! assignment of centres, by interpolation on a grid.

use super::evidence::{Minor, Part};
use super::exponents::Exponents;
use super::system::{System, Values, subsets};
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;

/// A minor and its polynomial at the centres.
pub(super) struct Polynomial {
    pub(super) minor: Minor,
    /// The degree in each unknown, at most.
    pub(super) degrees: Vec<usize>,
    /// Coefficients in the order of [`Exponents`] for `degrees`.
    pub(super) coefficients: Vec<u64>,
}

/// Most choices of rows, and of columns where they are taken one by one, for one choice of freed
/// rows.
const MOST_CHOICES: usize = 60;

/// Most columns in which all minors of some rows are computed at once: 2^12 of them.
const MOST_COLUMNS: usize = 12;

/// The minors of a system in some unknowns.
pub(super) struct Minors<'a> {
    system: &'a System<'a>,
    values: &'a Values,
    unknowns: &'a [usize],
    /// The rows without open unknowns, and which of them are independent.
    constants: (Span, Vec<usize>),
    /// The rows all of whose open unknowns are among those of the minors.
    variable: Vec<usize>,
    /// 1/1, 1/2, 1/3.
    inverses: [u64; 3],
}

impl<'a> Minors<'a> {
    pub(super) fn new(system: &'a System<'a>, values: &'a Values, unknowns: &'a [usize]) -> Self {
        let inside = |row: &usize| {
            let mut open = system.rows[*row]
                .unknowns()
                .filter(|&f| values[f].is_none())
                .peekable();
            open.peek().is_some() && open.all(|f| unknowns.contains(&f))
        };
        let mut inverses = [1, 2, 3].map(|k| system.field.from_u64(k));
        system.field.invert_all(&mut inverses);
        Self {
            system,
            values,
            unknowns,
            constants: system.constants(values),
            variable: (0..system.rows.len()).filter(inside).collect(),
            inverses,
        }
    }

    /// Calls `each` with the minors for one choice of freed rows, until it wants nothing more; returns
    /// whether it always did.
    pub(super) fn with_freed(
        &self,
        freed: &[usize],
        each: &mut impl FnMut(Polynomial) -> bool,
    ) -> bool {
        let Some(reduced) = self.reduced(freed) else {
            return true;
        };
        let places: Vec<usize> = (0..reduced.variable.len()).collect();
        let mut choices = 0;
        let mut go_on = true;
        subsets(&places, reduced.size, &mut |chosen| {
            choices += 1;
            go_on = self.of_rows(&reduced, freed.len(), chosen, each);
            go_on && choices < MOST_CHOICES
        });
        go_on
    }

    /// The rows with open unknowns after elimination of all others; `None` if there are too few
    /// of them for a minor.
    fn reduced(&self, freed: &[usize]) -> Option<Reduced> {
        let (system, field) = (self.system, &self.system.field);
        let variable = self.variable.iter().copied();
        let variable: Vec<usize> = variable.filter(|row| !freed.contains(row)).collect();
        // Each freed row adds two at most.
        if system.target + 1 > self.constants.1.len() + freed.len() + variable.len() {
            return None;
        }
        let mut span = self.constants.0.clone();
        let mut parts: Vec<Part> = self.constants.1.iter().copied().map(Part::Whole).collect();
        for &row in freed {
            for (which, part) in [(0, Part::Plus(row)), (1, Part::Minus(row))] {
                if span.insert(field, system.rows[row].side(which, system.columns)) {
                    parts.push(part);
                }
            }
        }
        let free: Vec<usize> = (0..system.columns)
            .filter(|column| !span.pivots().contains(column))
            .collect();
        let size = (system.target + freed.len() + 1).saturating_sub(span.dimension());
        if size == 0 || size > variable.len() || size > free.len() {
            return None;
        }
        let reduced_side = |row: usize, which: usize| {
            let mut side = self.side(row, which);
            span.reduce(field, &mut side);
            free.iter().map(|&column| side[column]).collect()
        };
        Some(Reduced {
            sides: variable
                .iter()
                .map(|&row| [reduced_side(row, 0), reduced_side(row, 1)])
                .collect(),
            pivots: span.pivots().to_vec(),
            parts,
            variable,
            free,
            size,
        })
    }

    /// A side of a row with open unknowns, with the scale that has a value.
    fn side(&self, row: usize, which: usize) -> Vec<u64> {
        let (system, field) = (self.system, &self.system.field);
        let mut side = system.rows[row].side(which, system.columns);
        let scale = system.rows[row].sides[which].scale;
        if let Some(value) = scale.and_then(|f| self.values[f]) {
            side.iter_mut().for_each(|x| *x = field.times(*x, value));
        }
        side
    }

    fn scaled_row<'s>(&self, row: usize, sides: &'s [Vec<u64>; 2]) -> ScaledRow<'s> {
        let place = |which: usize| {
            let scale = self.system.rows[row].sides[which].scale;
            scale.and_then(|f| self.unknowns.iter().position(|&g| g == f))
        };
        ScaledRow {
            sides,
            scales: [0, 1].map(place),
        }
    }

    /// How many rows have each unknown; a node has three columns.
    fn degrees(&self, rows: &[ScaledRow<'_>]) -> Vec<usize> {
        let with = |f| move |row: &&ScaledRow<'_>| row.scales.contains(&Some(f));
        let degree = |f| rows.iter().filter(with(f)).count().min(3);
        (0..self.unknowns.len()).map(degree).collect()
    }

    /// The minors with some of the rows with open unknowns; whether more of them are wanted.
    fn of_rows(
        &self,
        reduced: &Reduced,
        freed: usize,
        chosen: &[usize],
        each: &mut impl FnMut(Polynomial) -> bool,
    ) -> bool {
        let rows: Vec<ScaledRow<'_>> = chosen
            .iter()
            .map(|&k| self.scaled_row(reduced.variable[k], &reduced.sides[k]))
            .collect();
        let degrees = self.degrees(&rows);
        let field = &self.system.field;
        for (columns, mut values) in on_grid(field, &rows, reduced.free.len(), &degrees) {
            interpolate(field, &self.inverses, &degrees, &mut values);
            let whole = chosen.iter().map(|&k| Part::Whole(reduced.variable[k]));
            let of_free = columns.into_iter().map(|k| reduced.free[k]);
            let minor = Minor {
                freed,
                rows: reduced.parts.iter().copied().chain(whole).collect(),
                columns: reduced.pivots.iter().copied().chain(of_free).collect(),
            };
            let polynomial = Polynomial {
                minor,
                degrees: degrees.clone(),
                coefficients: values,
            };
            if !each(polynomial) {
                return false;
            }
        }
        true
    }
}

/// The rows with open unknowns, without what the other rows span.
struct Reduced {
    /// The other rows, and their pivots.
    parts: Vec<Part>,
    pivots: Vec<usize>,
    /// The rows with open unknowns, and both sides of each in the columns without pivot.
    variable: Vec<usize>,
    sides: Vec<[Vec<u64>; 2]>,
    free: Vec<usize>,
    /// How many of them a minor takes.
    size: usize,
}

/// A row `x sides[0] - y sides[1]`, x and y being one or unknowns.
struct ScaledRow<'a> {
    sides: &'a [Vec<u64>; 2],
    scales: [Option<usize>; 2],
}

/// The minors of some rows in choices of as many columns, by their values on the grid of the
/// degrees: the columns, and the values in the order of [`Exponents`]; without those that are zero.
fn on_grid(
    field: &PrimeField,
    rows: &[ScaledRow<'_>],
    columns: usize,
    degrees: &[usize],
) -> Vec<(Vec<usize>, Vec<u64>)> {
    let grid = Exponents {
        bounds: degrees.to_vec(),
    };
    let matrices: Vec<Vec<u64>> =
        grid.all()
            .iter()
            .map(|point| {
                let mut matrix = Vec::with_capacity(rows.len() * columns);
                for row in rows {
                    let times = |scale: Option<usize>, entry: u64| {
                        scale.map_or(entry, |f| multiple(field, entry, point[f]))
                    };
                    let sides = row.sides[0].iter().zip(&row.sides[1]);
                    matrix.extend(sides.map(|(&a, &b)| {
                        field.minus(times(row.scales[0], a), times(row.scales[1], b))
                    }));
                }
                matrix
            })
            .collect();
    let size = rows.len();
    let all: Vec<usize> = (0..columns).collect();
    let mut found = Vec::new();
    if columns <= MOST_COLUMNS && columns > size + 1 {
        all_on_grid(field, &matrices, size, columns, &mut found);
    } else {
        subsets(&all, size, &mut |chosen| {
            let determinants = matrices
                .iter()
                .map(|matrix| determinant(field, matrix, columns, chosen));
            found.push((chosen.to_vec(), determinants.collect()));
            found.len() < MOST_CHOICES
        });
    }
    found.retain(|(_, values): &(_, Vec<u64>)| values.iter().any(|&x| x != 0));
    found
}

/// A small multiple of an element.
fn multiple(field: &PrimeField, x: u64, by: usize) -> u64 {
    (0..by).fold(0, |sum, _| field.plus(sum, x))
}

/// The minors in all choices of columns. O(2^columns * columns) for each matrix.
fn all_on_grid(
    field: &PrimeField,
    matrices: &[Vec<u64>],
    size: usize,
    columns: usize,
    found: &mut Vec<(Vec<usize>, Vec<u64>)>,
) {
    let masks: Vec<usize> = (0..1usize << columns)
        .filter(|mask| mask.count_ones() as usize == size)
        .collect();
    let mut of_mask = vec![Vec::with_capacity(matrices.len()); masks.len()];
    let mut table = vec![0; 1 << columns];
    for matrix in matrices {
        all_minors(field, matrix, size, columns, &mut table);
        for (values, &mask) in of_mask.iter_mut().zip(&masks) {
            values.push(table[mask]);
        }
    }
    let columns_of = |mask: usize| (0..columns).filter(move |k| mask >> k & 1 == 1).collect();
    found.extend(masks.into_iter().map(columns_of).zip(of_mask));
}

/// Enters the determinants of the first k rows in every set of k columns, by Laplace expansion
/// along the last row.
fn all_minors(field: &PrimeField, matrix: &[u64], rows: usize, columns: usize, table: &mut [u64]) {
    table[0] = field.from_u64(1);
    for mask in 1..1usize << columns {
        let size = mask.count_ones() as usize;
        if size > rows {
            continue;
        }
        let row = &matrix[(size - 1) * columns..size * columns];
        let mut sum = 0;
        let mut left = mask;
        let mut above = size;
        while left != 0 {
            let column = left.trailing_zeros() as usize;
            left &= left - 1;
            above -= 1;
            let term = field.times(row[column], table[mask & !(1 << column)]);
            sum = if above.is_multiple_of(2) {
                field.plus(sum, term)
            } else {
                field.minus(sum, term)
            };
        }
        table[mask] = sum;
    }
}

/// The determinant in some columns, as many as there are rows: by elimination with one division
/// at the end. O(size^3).
fn determinant(field: &PrimeField, matrix: &[u64], columns: usize, chosen: &[usize]) -> u64 {
    let n = chosen.len();
    let mut rows: Vec<u64> = matrix
        .chunks(columns)
        .flat_map(|row| chosen.iter().map(|&column| row[column]))
        .collect();
    let one = field.from_u64(1);
    let (mut product, mut divisor) = (one, one);
    for k in 0..n {
        let Some(pivot) = (k..n).find(|&row| rows[row * n + k] != 0) else {
            return 0;
        };
        if pivot != k {
            for column in k..n {
                rows.swap(pivot * n + column, k * n + column);
            }
            product = field.negate(product);
        }
        let (head, tail) = rows.split_at_mut((k + 1) * n);
        let top = &head[k * n..];
        product = field.times(product, top[k]);
        for row in tail.chunks_mut(n).filter(|row| row[k] != 0) {
            // The row times the pivot, less a multiple of the pivot's.
            divisor = field.times(divisor, top[k]);
            let factor = field.negate(row[k]);
            for (x, &y) in row[k..].iter_mut().zip(&top[k..]) {
                *x = field.plus(field.times(*x, top[k]), field.times(factor, y));
            }
        }
    }
    // A product of pivots has an inverse.
    field.times(product, field.inverse(divisor).unwrap_or_default())
}

/// Turns values on the grid 0, 1, .., degree in each unknown into coefficients, by divided
/// differences. `inverses` are those of 1, 2, 3.
fn interpolate(field: &PrimeField, inverses: &[u64; 3], degrees: &[usize], values: &mut [u64]) {
    let mut stride = values.len();
    for &degree in degrees {
        let block = stride;
        stride /= degree + 1;
        for start in (0..values.len()).step_by(block) {
            for offset in start..start + stride {
                let at = |k: usize| offset + k * stride;
                for order in 1..=degree {
                    for k in (order..=degree).rev() {
                        let difference = field.minus(values[at(k)], values[at(k - 1)]);
                        values[at(k)] = field.times(difference, inverses[order - 1]);
                    }
                }
                // Newton's form sum d_k x (x - 1) .. (x - k + 1), unfolded from inside.
                for k in (0..degree).rev() {
                    for l in k..degree {
                        let part = multiple(field, values[at(l + 1)], k);
                        values[at(l)] = field.minus(values[at(l)], part);
                    }
                }
            }
        }
    }
}

impl Polynomial {
    /// The coefficients at the centres of another system.
    #[cfg(test)]
    pub(super) fn elsewhere(&self, system: &System<'_>, unknowns: &[usize]) -> Vec<u64> {
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
                let matrix: Vec<u64> = rows.flatten().collect();
                determinant(field, &matrix, system.columns, &self.minor.columns)
            })
            .collect();
        let mut inverses = [1, 2, 3].map(|k| field.from_u64(k));
        field.invert_all(&mut inverses);
        interpolate(field, &inverses, &self.degrees, &mut values);
        values
    }
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
        let inverses = [1, 2, 3].map(|k| f.inverse(element(k)).unwrap());
        interpolate(&f, &inverses, &[3, 2], &mut values);
        let expected = [2, 0, -1, -2, 0, 1, 0, 0, 0, 0, 3, 0].map(element);
        assert_eq!(values, expected);
    }

    #[test]
    fn minors_by_hand() {
        let f = PrimeField::new(10007).unwrap();
        let matrix = [1, 2, 3, 4, 5, 7].map(|x| f.from_u64(x));
        let mut table = vec![0; 8];
        all_minors(&f, &matrix, 2, 3, &mut table);
        let negative = |x: u64| f.negate(f.from_u64(x));
        let expected = [negative(3), negative(5), negative(1)];
        assert_eq!([table[3], table[5], table[6]], expected);
        let chosen = [[0, 1], [0, 2], [1, 2]];
        let single = chosen.map(|chosen| determinant(&f, &matrix, 3, &chosen));
        assert_eq!(single, expected);
        // The first pivot is zero.
        let turned = [0, 2, 3, 4].map(|x| f.from_u64(x));
        assert_eq!(determinant(&f, &turned, 2, &[0, 1]), negative(6));
    }
}
