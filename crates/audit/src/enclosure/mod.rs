//! The smallest singular value of a Jacobian at given cameras, enclosed (docs/theory.md, Theorem 16.6).
//!
//! In: a graph, the centres or cameras of its nodes, and which matrix. Out: two fractions between which the value
//! lies, proved by integers: a guess in floating point says where to look, and an elimination by
//! integers counts the eigenvalues below, and keeps what every division leaves over.

mod guess;
mod inertia;
mod matrices;
mod rounded;
mod wide;

pub use matrices::Matrix;

use self::inertia::{Symmetric, inertia};
use self::rounded::{Rounded, square_root};
use self::wide::Wide;
use std::cmp::Ordering;
use viewcert::graph::Graph;
use viewcert::here::Centres;
use viewcert::linalg::Ring;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::watch::{Step, Stopped, Watch};

/// Eliminations at most.
const TESTS: usize = 120;
/// How near to a guess it is looked for, one after the other.
const NEAR: [f64; 5] = [1e-12, 1e-9, 1e-6, 1e-3, 0.3];

/// Two fractions between which a singular value lies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enclosure {
    /// At least this, and not negative.
    pub least: Rational,
    /// At most this.
    pub most: Rational,
    /// How many eliminations it took.
    pub tests: usize,
}

/// -1, 0 or 1 as a is smaller than b, equal or larger.
pub fn compare(a: &Rational, b: &Rational) -> Ordering {
    Rationals.sub(a, b).numerator().sign()
}

impl Enclosure {
    /// Where the rank is smaller than the place needs.
    pub fn zero() -> Self {
        let zero = || Rational::from(Integer::zero());
        Self {
            least: zero(),
            most: zero(),
            tests: 0,
        }
    }

    /// Whether the bounds agree in nine digits, or are both zero.
    pub fn is_narrow(&self) -> bool {
        let billion = Rational::from(Integer::from(1_000_000_001u64));
        let least = Rationals.mul(&self.least, &billion);
        let most = Rationals.mul(&self.most, &Integer::from(1_000_000_000u64).into());
        compare(&most, &least).is_le()
    }

    /// Whether the value is surely between two bounds.
    pub fn is_within(&self, least: &Rational, most: &Rational) -> bool {
        compare(least, &self.least).is_le() && compare(&self.most, most).is_le()
    }

    /// Whether it is surely not.
    pub fn is_apart(&self, least: &Rational, most: &Rational) -> bool {
        compare(&self.most, least).is_lt() || compare(most, &self.least).is_lt()
    }
}

/// A search between two squares.
struct Search<'a> {
    matrix: Rounded,
    gram: Symmetric,
    place: usize,
    watch: &'a Watch,
    nodes: usize,
    low: Wide,
    high: Wide,
    rho: Wide,
    tests: usize,
}

impl Search<'_> {
    /// Counts the eigenvalues below a square; whether it could.
    fn test(&mut self, at: Wide) -> Result<bool, Stopped> {
        self.tests += 1;
        let task = self.watch.task(Step::Elimination, self.nodes);
        let Some(found) = inertia(&self.gram, at, &task)? else {
            return Ok(false);
        };
        self.rho = found.rho;
        if found.negative >= self.place {
            let most = at + found.rho;
            if most.is_below(self.high) {
                self.high = most;
            }
        } else {
            let least = at - found.rho;
            if self.low.is_below(least) {
                self.low = least;
            }
        }
        Ok(true)
    }

    /// The bounds on the singular value of the matrix that is meant, which rounding may move.
    fn enclosure(&self) -> Enclosure {
        let error = self.matrix.error();
        let least = square_root(&self.low.to_integer()).sub(&error);
        let least = if least.sign() == Ordering::Less {
            Integer::zero()
        } else {
            least
        };
        let most = square_root(&self.high.to_integer())
            .add(&error)
            .add(&Integer::one());
        let scaled = |x: &Integer| matrices::scaled(x, self.matrix.beta);
        Enclosure {
            least: scaled(&least),
            most: scaled(&most),
            tests: self.tests,
        }
    }

    /// Halves, in size first, until the bounds are as near to each other as is asked, or rounding hides more.
    fn halve(&mut self, is_enough: impl Fn(&Enclosure) -> bool) -> Result<(), Stopped> {
        while self.tests < TESTS && !is_enough(&self.enclosure()) {
            let rho = self.rho.to_f64();
            let (low, high) = (self.low.to_f64(), self.high.to_f64());
            if high - low <= 8.0 * rho {
                return Ok(());
            }
            let middle = if high > 4.0 * low.max(rho) {
                Wide::from_f64((low.max(rho).max(1.0) * high).sqrt()).unwrap_or(self.high)
            } else {
                (self.low + self.high).half()
            };
            let before = (self.low, self.high);
            if !self.test(middle)? {
                let aside = Wide::from_f64(middle.to_f64() * 1.001).unwrap_or(middle);
                self.test(aside)?;
            }
            if before == (self.low, self.high) {
                return Ok(());
            }
        }
        Ok(())
    }
}

/// Encloses the singular value at [`Matrix::place`] until the bounds are enough, or rounding to 100 bits hides
/// more. `norm` is that of cameras and fundamental matrices, from 0.1 to 1e9, and 10 in the literature; bearings have none. Nothing if the matrix takes cameras, and centres alone are
/// given. O(N^3) for every elimination, N the columns; two or three where floating point sees the value, and up to 120 where it does not.
///
/// # Errors
/// Work that was stopped.
///
/// # Panics
/// If the norm is far outside of its bounds.
pub fn enclose(
    matrix: Matrix,
    graph: &Graph,
    centres: &Centres,
    norm: Option<&Rational>,
    is_enough: impl Fn(&Enclosure) -> bool,
    watch: &Watch,
) -> Result<Option<Enclosure>, Stopped> {
    let usual = matrices::default_norm();
    let Some(rounded) = matrix.rounded(graph, centres, norm.unwrap_or(&usual)) else {
        return Ok(None);
    };
    let gram = rounded.gram();
    let trace = gram.rows.iter().enumerate().filter_map(|(i, row)| {
        row.last()
            .filter(|&&(at, _)| at as usize == i)
            .map(|&(_, x)| x)
    });
    let high = trace.fold(Wide::from(1), |sum, x| sum + x);
    let guess = guess::square(&rounded);
    let mut search = Search {
        matrix: rounded,
        gram,
        place: matrix.place(graph.nodes()),
        watch,
        nodes: graph.nodes(),
        low: Wide::default(),
        high,
        rho: Wide::default(),
        tests: 0,
    };
    if let Some(guess) = guess {
        let bounds = |near: f64| [guess * (1.0 - near), guess * (1.0 + near)];
        for (k, near) in NEAR.into_iter().enumerate() {
            let (low, high) = (search.low, search.high);
            for at in bounds(near).into_iter().filter_map(Wide::from_f64) {
                if k == 0 || !at.is_below(search.low) && at.is_below(search.high) {
                    search.test(at)?;
                }
            }
            let is_found =
                search.low.to_f64() > 0.0 && search.high.to_f64() < 4.0 * search.low.to_f64();
            if is_found || (k > 2 && (low, high) == (search.low, search.high)) {
                break;
            }
        }
    }
    search.halve(is_enough)?;
    Ok(Some(search.enclosure()))
}

/// A bound in scientific notation with so many digits, rounded down or up.
pub fn decimal(x: &Rational, digits: usize, up: bool) -> String {
    let (numerator, denominator) = (x.numerator().abs(), x.denominator());
    if numerator.is_zero() {
        return "0".to_owned();
    }
    let ten = |k: u64| {
        (0..k).fold(Integer::one(), |product, _| {
            product.mul(&Integer::from(10u64))
        })
    };
    let digits_of = |x: &Integer| x.to_string().len() as i64;
    let wanted = digits as i64;
    let mut exponent = digits_of(&numerator) - digits_of(denominator);
    loop {
        let shift = wanted - 1 - exponent;
        let (above, below) = match shift {
            0.. => (
                numerator.mul(&ten(shift.unsigned_abs())),
                denominator.clone(),
            ),
            _ => (
                numerator.clone(),
                denominator.mul(&ten(shift.unsigned_abs())),
            ),
        };
        let (mut quotient, rest) = above.div_rem_euclid(&below);
        if up && !rest.is_zero() {
            quotient = quotient.add(&Integer::one());
        }
        match digits_of(&quotient).cmp(&wanted) {
            Ordering::Less => exponent -= 1,
            Ordering::Greater => exponent += 1,
            Ordering::Equal => {
                let text = quotient.to_string();
                let (head, tail) = text.split_at(1);
                let point = if tail.is_empty() { "" } else { "." };
                return format!("{head}{point}{tail}e{exponent}");
            }
        }
    }
}

#[cfg(test)]
mod tests;
