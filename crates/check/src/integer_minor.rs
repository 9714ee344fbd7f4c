//! `integer-minor` (section 7 of the specification): a minor and kernel vectors of J_P over the
//! integers. Statements about integers are verified modulo as many primes as their size asks for
//! (theory, section 8), so that no number is computed that is larger than those of the certificate.

use crate::algebra::{Field, Integers, is_prime};
use crate::cameras::{self, Camera, Stream};
use crate::core::Core;
use crate::document::IntegerMinor;
use crate::elimination::{Echelon, Factors, SPARSE};
use crate::json::Big;
use crate::limits::Meter;
use crate::matrices::{jacobian, map_motion, scale_motion};
use crate::pivots::Pivots;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::{Lower, Setting};
use crate::vectors::gcd;

/// The primes modulo which integers are compared have at least this many bits behind the first.
const PRIME_BITS: u64 = 61;

/// Verifies `integer-minor`: an exact minor of the integer J_P, and kernel vectors (theory, section
/// 8).
pub(crate) fn check_integer_minor(
    evidence: &IntegerMinor,
    setting: &Setting,
    core: &Core,
) -> Checked<Lower> {
    let IntegerMinor {
        numerator,
        denominator,
        seed,
        draw,
        rows,
        cols,
        ..
    } = evidence;
    let mut stream = Stream::new("draw", core.hashes(setting), *seed, *draw);
    let bounds = (*numerator, *denominator);
    let cameras = cameras::integer(&mut stream, bounds, core.nodes)?;
    let matrix = IntegerMatrix::jacobian(core, &cameras);
    let pivots = Pivots::of_jacobian(rows, cols, core)?;
    match (&evidence.determinant, evidence.prime) {
        (Some(Big(claimed)), None) => matrix.check_determinant(&pivots, claimed, setting.meter)?,
        (None, Some(prime)) => matrix.check_non_singular(&pivots, prime, setting.meter)?,
        _ => {
            return Err(Failure::rejected(
                "one of `determinant` and `prime` is null, and one is not",
            ));
        }
    }
    let kernel = &evidence.kernel;
    matrix
        .check_kernel(kernel, setting.meter)
        .within(|| "kernel".into())?;
    check_independent(kernel, &cameras, setting.meter).within(|| "kernel".into())?;
    let (r, nodes) = (rows.len(), core.nodes);
    let exact = r + nodes + 15 + kernel.len() == 12 * nodes;
    let place = format!("integer cameras (seed {seed}, draw {draw})");
    let note = format!("a core of {nodes} nodes has rank exactly {r} over Q at {place}");
    Ok(Lower {
        rank: r as i64,
        at: None,
        note: exact.then_some(note),
    })
}

/// The integer J_P, each row divided by the greatest common divisor of its entries.
struct IntegerMatrix {
    rows: Vec<Vec<(usize, i128)>>,
    width: usize,
}

impl IntegerMatrix {
    fn jacobian(core: &Core, cameras: &[Camera<i128>]) -> IntegerMatrix {
        let row = |number| {
            let mut entries = jacobian(&Integers, &core.edges, cameras, number);
            entries.retain(|(_, value)| *value != 0);
            let content = entries
                .iter()
                .fold(0, |content, &(_, value)| gcd(content, value));
            entries.iter_mut().for_each(|(_, value)| *value /= content);
            entries
        };
        IntegerMatrix {
            rows: (0..10 * core.edges.len()).map(row).collect(),
            width: 12 * core.nodes,
        }
    }

    fn modulo(&self, field: &Field, row: usize) -> Vec<(usize, u64)> {
        let entries = self.rows[row].iter();
        entries
            .map(|&(column, value)| (column, field.signed(value)))
            .collect()
    }

    /// Sees that a minor does not vanish modulo a prime, with these pivots.
    fn check_non_singular(&self, pivots: &Pivots, prime: u64, meter: &Meter) -> Checked<()> {
        let field = &Field::new(prime)?;
        let row = |row| self.modulo(field, row);
        Factors::new(Echelon::new(field, self.width, meter), pivots, row).map(drop)
    }

    /// Sees that a minor is the claimed number, which is not zero, and that no pivot vanishes over
    /// Q.
    ///
    /// Leading minors are below 2^B by Hadamard's bound. One that is divisible by as many primes as
    /// their product needs to be 2^(B+1) is zero, and two numbers below 2^B that are equal modulo
    /// as many primes are equal (theory, 8.1).
    fn check_determinant(&self, pivots: &Pivots, claimed: &str, meter: &Meter) -> Checked<()> {
        ensure!(claimed != "0", "`determinant` is zero");
        let bits = self.hadamard_bits(pivots).max(decimal_bits(claimed));
        meter.allow_bits(bits)?;
        let needed = (bits + 1).div_ceil(PRIME_BITS);
        let (mut agreed, mut vanished) = (0, vec![0; pivots.rows.len()]);
        for field in primes() {
            meter.charge(SPARSE * claimed.len() as u64)?;
            match self.determinant_modulo(&field, pivots, meter)? {
                Ok(found) => {
                    ensure!(
                        found == field.decimal(claimed),
                        "`determinant` is not that of the minor"
                    );
                    agreed += 1;
                }
                Err(pivot) => {
                    vanished[pivot] += 1;
                    ensure!(vanished[pivot] < needed, "pivot {pivot} vanishes");
                }
            }
            if agreed == needed {
                break;
            }
        }
        Ok(())
    }

    /// The minor modulo a prime, or the first pivot that vanishes.
    fn determinant_modulo(
        &self,
        field: &Field,
        pivots: &Pivots,
        meter: &Meter,
    ) -> Checked<Result<u64, usize>> {
        let mut place = vec![None; self.width];
        for (k, &column) in pivots.cols.iter().enumerate() {
            place[column] = Some(k);
        }
        let mut echelon = Echelon::new(field, pivots.cols.len(), meter);
        for (k, &number) in pivots.rows.iter().enumerate() {
            let entries = self.modulo(field, number).into_iter();
            let inside = entries.filter_map(|(column, value)| Some((place[column]?, value)));
            if !echelon.push(inside, Some(k))? {
                return Ok(Err(k));
            }
        }
        Ok(Ok(echelon.determinant))
    }

    /// B for which all leading minors are below 2^B in absolute value: a row of nu entries of at
    /// most b bits is shorter than the square root of 2^(2 b + bits(nu)).
    fn hadamard_bits(&self, pivots: &Pivots) -> u64 {
        let squares = pivots.rows.iter().map(|&row| {
            let row = &self.rows[row];
            2 * most_bits(row) + bits(row.len() as u128)
        });
        squares.sum::<u64>().div_ceil(2)
    }

    /// Sees that vectors are in the kernel: all products are below 2^B, and zero modulo primes with
    /// a product of at least 2^B.
    fn check_kernel(&self, kernel: &[Vec<Big<String>>], meter: &Meter) -> Checked<()> {
        let mut most = 0;
        for (k, vector) in kernel.iter().enumerate() {
            ensure!(
                vector.len() == self.width,
                "vector {k} has {} entries instead of {}",
                vector.len(),
                self.width
            );
            let entries = vector.iter().map(|Big(digits)| decimal_bits(digits));
            most = entries.fold(most, u64::max);
        }
        if kernel.is_empty() {
            return Ok(());
        }
        meter.allow_bits(most)?;
        let row_bits = |row: &Vec<_>| most_bits(row) + bits(row.len() as u128);
        let bound = most + self.rows.iter().map(row_bits).max().unwrap_or(0);
        for field in primes().take(bound.div_ceil(PRIME_BITS) as usize) {
            let entries: usize = self.rows.iter().map(Vec::len).sum();
            meter.charge(SPARSE * entries as u64)?;
            let rows: Vec<_> = (0..self.rows.len())
                .map(|row| self.modulo(&field, row))
                .collect();
            for (k, vector) in kernel.iter().enumerate() {
                let vector = residues(&field, vector, meter)?;
                meter.charge(SPARSE * entries as u64)?;
                let inside = rows.iter().all(|row| product(&field, row, &vector) == 0);
                ensure!(inside, "vector {k} is not in the kernel");
            }
        }
        Ok(())
    }
}

/// Sees that vectors are linearly independent together with the trivial ones: modulo a prime, which
/// is enough.
fn check_independent(
    kernel: &[Vec<Big<String>>],
    cameras: &[Camera<i128>],
    meter: &Meter,
) -> Checked<()> {
    if kernel.is_empty() {
        return Ok(());
    }
    let field = &Field::new((1 << 61) - 1)?;
    let camera = |camera: &Camera<i128>| camera.map(|row| row.map(|entry| field.signed(entry)));
    let cameras: Vec<Camera<u64>> = cameras.iter().map(camera).collect();
    let scales = (0..cameras.len()).map(|v| scale_motion(&cameras, v));
    let maps = (0..15).map(|ab| map_motion(&cameras, 4, ab));
    let mut echelon = Echelon::new(field, 12 * cameras.len(), meter);
    let mut independent = true;
    for motion in scales.chain(maps) {
        independent &= echelon.push(motion, None)?;
    }
    for vector in kernel {
        let vector = residues(field, vector, meter)?;
        independent &= echelon.push(vector.into_iter().enumerate(), None)?;
    }
    ensure!(
        independent,
        "the vectors depend on each other or on the trivial ones"
    );
    Ok(())
}

fn product(field: &Field, row: &[(usize, u64)], vector: &[u64]) -> u64 {
    use crate::algebra::Ring;
    let terms = row
        .iter()
        .map(|&(column, value)| field.mul(value, vector[column]));
    terms.fold(0, |sum, term| field.add(sum, term))
}

fn residues(field: &Field, vector: &[Big<String>], meter: &Meter) -> Checked<Vec<u64>> {
    let digits: usize = vector.iter().map(|Big(digits)| digits.len()).sum();
    meter.charge(SPARSE * digits as u64)?;
    Ok(vector
        .iter()
        .map(|Big(digits)| field.decimal(digits))
        .collect())
}

/// The primes above 2^61, in increasing order.
fn primes() -> impl Iterator<Item = Field> {
    let odd = (1 << PRIME_BITS | 1..1 << 62).step_by(2);
    odd.filter(|&p| is_prime(p))
        .filter_map(|p| Field::new(p).ok())
}

fn bits(value: u128) -> u64 {
    u64::from(128 - value.leading_zeros())
}

fn most_bits(row: &[(usize, i128)]) -> u64 {
    let entries = row.iter().map(|(_, value)| bits(value.unsigned_abs()));
    entries.max().unwrap_or(0)
}

/// At least the bits of a decimal integer: a digit has less than ten thirds.
fn decimal_bits(digits: &str) -> u64 {
    (10 * digits.len() as u64).div_ceil(3)
}

#[cfg(test)]
mod tests;
