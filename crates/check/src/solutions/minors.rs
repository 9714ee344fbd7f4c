//! Minors of N(u) as polynomials in a few unknowns: condition (S13) of section 12 (theory, Lemma
//! 10.2), and their coefficients, by interpolation.

use super::dense::{ENTRY, Sparse, determinant};
use super::system::{Known, System};
use crate::algebra::{Field, Ring};
use crate::document::solutions::Minor;
use crate::elimination::Echelon;
use crate::rejection::{Checked, ensure};
use std::collections::BTreeSet;

/// Exponents up to bounds, the last one fastest.
pub(super) struct Exponents<'b> {
    pub bounds: &'b [usize],
}

impl Exponents<'_> {
    /// How many there are; `None` if there are more than 4096.
    pub(super) fn count(&self) -> Option<usize> {
        let times = |count: usize, &bound: &usize| {
            let count = bound.checked_add(1).and_then(|n| count.checked_mul(n));
            count.filter(|&count| count <= 4096)
        };
        self.bounds.iter().try_fold(1, times)
    }

    pub(super) fn place(&self, exponent: &[usize]) -> usize {
        let digits = exponent.iter().zip(self.bounds);
        digits.fold(0, |place, (e, bound)| place * (bound + 1) + e)
    }

    pub(super) fn contain(&self, exponent: &[usize]) -> bool {
        let mut entries = exponent.iter().zip(self.bounds);
        exponent.len() == self.bounds.len() && entries.all(|(e, bound)| e <= bound)
    }

    pub(super) fn all(&self) -> Vec<Vec<usize>> {
        let mut all = vec![Vec::new()];
        for &bound in self.bounds {
            let extend =
                |exponent: Vec<usize>| (0..=bound).map(move |e| [&exponent[..], &[e]].concat());
            all = all.into_iter().flat_map(extend).collect();
        }
        all
    }
}

/// The unknowns in which minors are polynomials; those behind them are known.
pub(super) struct Place<'a> {
    pub system: &'a System<'a>,
    pub known: &'a Known,
    pub unknowns: &'a [usize],
}

impl Place<'_> {
    /// The places in the list of unknowns of those of a row, by its sides.
    pub(super) fn listed(&self, row: usize) -> [Option<usize>; 2] {
        [0, 1].map(|which| {
            let unknown = self.system.rows[row][which].unknown;
            unknown.and_then(|f| self.unknowns.iter().position(|&g| g == f))
        })
    }

    /// (S13), and the degrees of a minor.
    pub(super) fn check(&self, minor: &Minor, bounds: &[usize]) -> Checked<Vec<usize>> {
        let system = self.system;
        for (name, list, limit) in [
            ("rows", &minor.rows, system.rows.len()),
            ("plus", &minor.plus, system.rows.len()),
            ("minus", &minor.minus, system.rows.len()),
            ("cols", &minor.cols, system.columns),
        ] {
            ensure!(
                list.is_sorted_by(|a, b| a < b) && list.last().is_none_or(|&last| last < limit),
                "`{name}` is not an increasing list below {limit}"
            );
        }
        let height = minor.rows.len() + minor.plus.len() + minor.minus.len();
        ensure!(
            height == minor.cols.len(),
            "{height} rows and {} columns",
            minor.cols.len()
        );
        let freed: BTreeSet<usize> = minor.plus.iter().chain(&minor.minus).copied().collect();
        let least = system.target + 1 + freed.len();
        ensure!(
            height >= least,
            "a minor of size {height} need not vanish, one of size {least} does"
        );
        let twice = minor.rows.iter().find(|row| freed.contains(row));
        ensure!(
            twice.is_none(),
            "row {} is freed and not freed",
            twice.copied().unwrap_or_default()
        );
        self.degrees(minor, bounds)
    }

    /// The degrees: how many rows have the unknown, but a node has three columns.
    fn degrees(&self, minor: &Minor, bounds: &[usize]) -> Checked<Vec<usize>> {
        let mut degrees = vec![0; self.unknowns.len()];
        for &row in &minor.rows {
            let open = self.system.open(row, self.known).count();
            let listed = self.listed(row);
            ensure!(
                open == listed.iter().flatten().count(),
                "row {row} has an unknown that is neither known nor listed"
            );
            listed.iter().flatten().for_each(|&f| degrees[f] += 1);
        }
        degrees
            .iter_mut()
            .for_each(|degree| *degree = 3.min(*degree));
        for ((degree, bound), f) in degrees.iter().zip(bounds).zip(self.unknowns) {
            ensure!(
                degree <= bound,
                "the degree {degree} in unknown {f} is above its bound {bound}"
            );
        }
        Ok(degrees)
    }

    /// The coefficients of a minor, in the order of [`Exponents`] up to its degrees; up to a
    /// factor. Empty if all are zero because its constant rows are dependent.
    pub(super) fn coefficients(&self, minor: &Minor, degrees: &[usize]) -> Checked<Vec<u64>> {
        let (system, field) = (self.system, &self.system.field);
        let within = |row: Sparse| -> Sparse {
            let entries = row.into_iter();
            let place = |(column, entry)| Some((minor.cols.binary_search(&column).ok()?, entry));
            entries.filter_map(place).collect()
        };
        let none = vec![None; self.known.len()];
        let is_constant = |row: &&usize| self.listed(**row) == [None, None];
        let constant = minor.rows.iter().filter(is_constant);
        let mut rows: Vec<Sparse> = constant.map(|&row| system.row(row, self.known)).collect();
        rows.extend(minor.plus.iter().map(|&row| system.side(row, 0, &none)));
        rows.extend(minor.minus.iter().map(|&row| system.side(row, 1, &none)));
        let height = rows.len();
        let rows = rows.into_iter().map(within);
        let mut space = Echelon::of(field, minor.cols.len(), system.meter, rows)?;
        if space.rank() < height {
            return Ok(Vec::new());
        }
        // What is left are the rows with unknowns, less constant ones, in the other columns.
        let free = space.free();
        let grid = Exponents { bounds: degrees }.all();
        let size = free.len() as u64 + 1;
        system
            .meter
            .charge(ENTRY * grid.len() as u64 * size * size * size)?;
        let mut sides = Vec::new();
        for &row in minor.rows.iter().filter(|row| !is_constant(row)) {
            let mut both = [Vec::new(), Vec::new()];
            for (which, side) in both.iter_mut().enumerate() {
                let rest = space.residue(within(system.side(row, which, self.known)))?;
                let place = |(at, entry)| Some((free.binary_search(&at).ok()?, entry));
                *side = rest.into_iter().filter_map(place).collect();
            }
            sides.push((both, self.listed(row)));
        }
        let values = grid.iter().map(|point| {
            let row = |(both, listed): &([Sparse; 2], [Option<usize>; 2])| {
                let [x, y] =
                    listed.map(|f| f.map_or(field.one, |f| field.element(point[f] as u64)));
                let mut row = vec![0; free.len()];
                for (side, scale) in both.iter().zip([x, field.neg(y)]) {
                    for &(at, entry) in side {
                        row[at] = field.add(row[at], field.mul(scale, entry));
                    }
                }
                row
            };
            determinant(field, sides.iter().map(row).collect())
        });
        Ok(interpolated(field, degrees, values.collect()))
    }
}

/// Coefficients from the values on the grid 0, 1, .., degree in each unknown: in one after the other,
/// sums of values times the coefficients of Lagrange's polynomials.
fn interpolated(field: &Field, degrees: &[usize], mut values: Vec<u64>) -> Vec<u64> {
    let mut stride = values.len();
    for &degree in degrees {
        let block = stride;
        stride /= degree + 1;
        let basis = lagrange(field, degree);
        for start in (0..values.len()).step_by(block) {
            for at in start..start + stride {
                let line: Vec<u64> = (0..=degree).map(|k| values[at + k * stride]).collect();
                for power in 0..=degree {
                    let terms = line.iter().zip(&basis);
                    values[at + power * stride] = terms.fold(0, |sum, (&value, polynomial)| {
                        field.add(sum, field.mul(value, polynomial[power]))
                    });
                }
            }
        }
    }
    values
}

/// The polynomials of degree d that are one at one of 0, 1, .., d and zero at the others. Degrees are
/// at most 3, below the prime.
fn lagrange(field: &Field, degree: usize) -> Vec<Vec<u64>> {
    let element = |k: usize| field.element(k as u64);
    let one_at = |node: usize| {
        let (mut polynomial, mut divisor) = (vec![field.one], field.one);
        for other in (0..=degree).filter(|&other| other != node) {
            // Times x less the other.
            let mut product = vec![0; polynomial.len() + 1];
            for (k, &coefficient) in polynomial.iter().enumerate() {
                product[k + 1] = field.add(product[k + 1], coefficient);
                let part = field.mul(element(other), coefficient);
                product[k] = field.sub(product[k], part);
            }
            polynomial = product;
            divisor = field.mul(divisor, field.sub(element(node), element(other)));
        }
        let inverse = field.inverse(divisor);
        let scaled = polynomial.into_iter();
        scaled
            .map(|coefficient| field.mul(inverse, coefficient))
            .collect()
    };
    (0..=degree).map(one_at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (1 - x) (2 - y^2) + 3 x^3 y on the grid of degrees 3 and 2.
    #[test]
    fn a_polynomial_from_its_values() {
        let field = Field::new(101).unwrap();
        let degrees = [3, 2];
        let value = |x: i128, y: i128| field.signed((1 - x) * (2 - y * y) + 3 * x * x * x * y);
        let grid = Exponents { bounds: &degrees }.all();
        let values = grid
            .iter()
            .map(|point| value(point[0] as i128, point[1] as i128));
        let found = interpolated(&field, &degrees, values.collect());
        for (exponent, &coefficient) in grid.iter().zip(&found) {
            let expected = match exponent[..] {
                [0, 0] => 2,
                [1, 0] => -2,
                [0, 2] => -1,
                [1, 2] => 1,
                [3, 1] => 3,
                _ => 0,
            };
            assert_eq!(coefficient, field.signed(expected), "{exponent:?}");
        }
    }

    #[test]
    fn exponents_are_numbered_in_their_order() {
        let exponents = Exponents { bounds: &[1, 2] };
        let all = exponents.all();
        assert_eq!(all, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
        for (place, exponent) in all.iter().enumerate() {
            assert_eq!(exponents.place(exponent), place);
        }
        assert!(!exponents.contain(&[1, 3]) && !exponents.contain(&[1]));
        let many = [usize::MAX, 4095, 1].map(|bound| Exponents { bounds: &[bound] }.count());
        assert_eq!(many, [None, Some(4096), Some(2)]);
        assert_eq!(Exponents { bounds: &[4095, 1] }.count(), None);
    }
}
