//! Vectors between cameras that are given as numbers: what they say about the nodes of a group.
//!
//! In: pairs of nodes with exact coordinates. Out: integers, with the vectors around every cycle
//! seen to agree (docs/theory.md, Theorem 13.21).

use std::fmt;
use std::str::FromStr;

/// Numerators and denominators have at most so many digits.
pub(super) const MAX_DIGITS: u32 = 30;

/// A vector in some unit.
pub(super) type Vector = [i128; 3];

/// A coordinate of a displacement, an exact rational number: `-1.25`, `3e-2`, `1/3`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Coordinate {
    numerator: i128,
    denominator: i128,
}

/// Why a text is no coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CoordinateError {
    /// It is no number.
    NoNumber,
    /// Numerator or denominator has more than 30 digits.
    TooLong,
}

/// Zero.
impl Default for Coordinate {
    fn default() -> Self {
        Self {
            numerator: 0,
            denominator: 1,
        }
    }
}

impl fmt::Display for CoordinateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoNumber => write!(f, "no decimal number and no fraction"),
            Self::TooLong => write!(f, "a number with more than {MAX_DIGITS} digits"),
        }
    }
}

impl std::error::Error for CoordinateError {}

impl FromStr for Coordinate {
    type Err = CoordinateError;

    /// A decimal number, with an exponent or without, or a fraction of two integers.
    ///
    /// ```
    /// use viewcert::graph::Coordinate;
    ///
    /// let half: Coordinate = "0.5".parse()?;
    /// assert_eq!(half, "50e-2".parse()?);
    /// assert_eq!(half, "1/2".parse()?);
    /// # Ok::<(), viewcert::graph::CoordinateError>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, CoordinateError> {
        let (numerator, denominator) = match text.split_once('/') {
            Some((above, below)) => (signed(above)?, digits(below)?),
            None => decimal(text)?,
        };
        Self::new(numerator, denominator)
    }
}

impl Coordinate {
    /// The difference to another one.
    ///
    /// # Errors
    /// If numerator or denominator has more than 30 digits.
    pub fn minus(self, other: Self) -> Result<Self, CoordinateError> {
        let denominator = self.denominator / gcd(self.denominator, other.denominator);
        let denominator = denominator.checked_mul(other.denominator);
        let denominator = denominator.ok_or(CoordinateError::TooLong)?;
        let times = |of: Self| of.numerator.checked_mul(denominator / of.denominator);
        let numerator = times(self).zip(times(other));
        let numerator = numerator.and_then(|(a, b)| a.checked_sub(b));
        Self::new(numerator.ok_or(CoordinateError::TooLong)?, denominator)
    }

    /// In lowest terms, of a denominator that is not negative.
    fn new(numerator: i128, denominator: i128) -> Result<Self, CoordinateError> {
        if denominator == 0 {
            return Err(CoordinateError::NoNumber);
        }
        let gcd = gcd(numerator, denominator);
        let [numerator, denominator] = [numerator, denominator].map(|n| n / gcd);
        let is_short = is_short(numerator) && is_short(denominator);
        is_short
            .then_some(Self {
                numerator,
                denominator,
            })
            .ok_or(CoordinateError::TooLong)
    }
}

/// Whether a number has few enough digits.
fn is_short(number: i128) -> bool {
    number.unsigned_abs() < 10u128.pow(MAX_DIGITS)
}

fn digits(text: &str) -> Result<i128, CoordinateError> {
    if text.is_empty() || !text.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(CoordinateError::NoNumber);
    }
    text.parse().map_err(|_| CoordinateError::TooLong)
}

fn signed(text: &str) -> Result<i128, CoordinateError> {
    match text.strip_prefix('-') {
        Some(rest) => Ok(-digits(rest)?),
        None => digits(text.strip_prefix('+').unwrap_or(text)),
    }
}

/// A decimal number as numerator and denominator.
fn decimal(text: &str) -> Result<(i128, i128), CoordinateError> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, signed(exponent)?),
        None => (text, 0),
    };
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let sign = &whole[..whole.len() - whole.trim_start_matches(['+', '-']).len()];
    let all = format!("{}{part}", &whole[sign.len()..]);
    let kept = all.trim_end_matches('0');
    if kept.is_empty() && !all.is_empty() && sign.len() < 2 {
        return Ok((0, 1));
    }
    let number = signed(&format!("{sign}{kept}"))?;
    let dropped = all.len() - kept.len();
    let exponent = exponent.checked_add(dropped as i128 - part.len() as i128);
    let exponent = exponent.ok_or(CoordinateError::TooLong)?;
    let size = u32::try_from(exponent.unsigned_abs()).map_err(|_| CoordinateError::TooLong)?;
    let power = 10i128.checked_pow(size).ok_or(CoordinateError::TooLong)?;
    if exponent < 0 {
        return Ok((number, power));
    }
    let number = number.checked_mul(power).ok_or(CoordinateError::TooLong)?;
    Ok((number, 1))
}

/// The greatest common divisor, not negative.
pub(crate) fn gcd(a: i128, b: i128) -> i128 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// What given vectors cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// The item with this number contradicts those before it.
    Contradiction(usize),
    /// In one unit they have more than 30 digits.
    TooLong,
}

/// All vectors as integers, in one unit.
pub(super) fn integers(vectors: &[[Coordinate; 3]]) -> Result<Vec<Vector>, Fault> {
    let mut unit: i128 = 1;
    for coordinate in vectors.iter().flatten() {
        let factor = coordinate.denominator / gcd(unit, coordinate.denominator);
        unit = unit.checked_mul(factor).ok_or(Fault::TooLong)?;
    }
    let integer = |coordinate: &Coordinate| {
        let factor = unit / coordinate.denominator;
        let product = coordinate.numerator.checked_mul(factor);
        product.filter(|&n| is_short(n)).ok_or(Fault::TooLong)
    };
    let vector = |[x, y, z]: &[Coordinate; 3]| Ok([integer(x)?, integer(y)?, integer(z)?]);
    vectors.iter().map(vector).collect()
}

/// Brings vectors to the unit in which their coordinates have no common divisor.
pub(super) fn reduce(vectors: &mut [Vec<Vector>]) -> Result<(), Fault> {
    let all = vectors.iter().flatten().flatten();
    let unit = all.fold(0, |unit, &n| gcd(unit, n)).max(1);
    for n in vectors.iter_mut().flatten().flatten() {
        *n /= unit;
        if !is_short(*n) {
            return Err(Fault::TooLong);
        }
    }
    Ok(())
}

pub(super) fn minus(a: Vector, b: Vector) -> Option<Vector> {
    let [x, y, z] = [0, 1, 2].map(|k| a[k].checked_sub(b[k]));
    Some([x?, y?, z?])
}

fn plus(a: Vector, b: Vector) -> Option<Vector> {
    let [x, y, z] = [0, 1, 2].map(|k| a[k].checked_add(b[k]));
    Some([x?, y?, z?])
}

/// Nodes that hang together, each with its vector from the node that stands for them.
pub(crate) struct Hanging {
    parent: Vec<u32>,
    /// From the parent.
    vector: Vec<Vector>,
}

impl Hanging {
    pub(crate) fn new(nodes: u32) -> Self {
        Self {
            parent: (0..nodes).collect(),
            vector: vec![[0; 3]; nodes as usize],
        }
    }

    /// The node that stands for a node, and the vector from it.
    pub(super) fn find(&mut self, node: u32) -> Result<(u32, Vector), Fault> {
        let mut path = Vec::new();
        let mut root = node;
        while self.parent[root as usize] != root {
            path.push(root as usize);
            root = self.parent[root as usize];
        }
        let mut from_root = [0; 3];
        for v in path.into_iter().rev() {
            from_root = plus(from_root, self.vector[v]).ok_or(Fault::TooLong)?;
            (self.parent[v], self.vector[v]) = (root, from_root);
        }
        Ok((root, from_root))
    }

    /// Takes in that the vector from u to v is this one, as the item with this number says.
    pub(super) fn join(
        &mut self,
        item: usize,
        (u, v): (u32, u32),
        vector: Vector,
    ) -> Result<(), Fault> {
        let ((of_u, to_u), (of_v, to_v)) = (self.find(u)?, self.find(v)?);
        let between = minus(to_v, to_u).and_then(|known| minus(vector, known));
        let between = between.ok_or(Fault::TooLong)?;
        if of_u != of_v {
            (self.parent[of_v as usize], self.vector[of_v as usize]) = (of_u, between);
        } else if between != [0; 3] {
            return Err(Fault::Contradiction(item));
        }
        Ok(())
    }

    /// Takes in that the vector between two nodes is this one; returns whether that agrees with what
    /// was taken in before.
    pub(crate) fn agrees(&mut self, pair: (u32, u32), vector: Vector) -> bool {
        self.join(0, pair, vector).is_ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<(i128, i128), CoordinateError> {
        let found: Coordinate = text.parse()?;
        Ok((found.numerator, found.denominator))
    }

    #[test]
    fn decimals_and_fractions_are_exact() {
        for (text, expected) in [
            ("0", (0, 1)),
            ("-0.000", (0, 1)),
            ("0e400", (0, 1)),
            ("12", (12, 1)),
            ("-1.25", (-5, 4)),
            ("+.5", (1, 2)),
            ("5.", (5, 1)),
            ("3e-2", (3, 100)),
            ("1200E1", (12_000, 1)),
            ("-6/4", (-3, 2)),
            (
                "0.1000000000000000055511151231",
                (1_000_000_000_000_000_055_511_151_231, 10i128.pow(28)),
            ),
        ] {
            assert_eq!(read(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn differences_are_exact() {
        let minus = |a: &str, b: &str| {
            let found = a.parse::<Coordinate>()?.minus(b.parse()?)?;
            Ok((found.numerator, found.denominator))
        };
        assert_eq!(minus("0.5", "1/3"), Ok((1, 6)));
        assert_eq!(minus("-2", "-2"), Ok((0, 1)));
        assert_eq!(minus("5/6", "1/3"), Ok((1, 2)));
        assert_eq!(minus("1e29", "1e-29"), Err(CoordinateError::TooLong));
    }

    #[test]
    fn what_is_no_number_or_too_long_is_refused() {
        for text in [
            "", "-", ".", "e5", "1e", "1e+", "x", "1/0", "1/-2", "1/2/3", "--1", "1,5", "nan",
            "0x1", "1 2", "1.2/3", "0/0",
        ] {
            assert_eq!(read(text), Err(CoordinateError::NoNumber), "{text}");
        }
        for text in [
            "1e30",
            "1e-31",
            "1e99999999999999999999999999999999999999999",
            "1234567890123456789012345678901",
        ] {
            assert_eq!(read(text), Err(CoordinateError::TooLong), "{text}");
        }
    }
}
