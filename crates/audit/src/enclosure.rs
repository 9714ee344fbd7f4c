//! The smallest singular value of a Jacobian at given cameras, enclosed (docs/theory, Theorem 16.6).
//!
//! In: a graph, the centres or cameras of its nodes, and which matrix. Out: two fractions between which the value
//! lies. An elimination in integers of 256 bits counts the eigenvalues of M^T M below a square and keeps what every
//! division leaves over, so a count is a proof. Floating point only proposes the squares.

use crate::linear::{envelope_order, gram};
use ethnum::{AsI256, I256};
use std::cmp::Ordering;
use viewcert::Model;
use viewcert::at_cameras::Centres;
use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian;
use viewcert::graph::Graph;
use viewcert::linalg::Ring;
use viewcert::linalg::integer::{Integer, Integers};
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::watch::{Step, Stopped, Task, Watch};

/// Columns at most: about an hour.
const COLUMNS: usize = 3_600;
/// Eliminations at most.
const TESTS: usize = 120;
/// Bits of the largest entries of a rounded matrix.
const BITS: i64 = 100;
/// Factors of an elimination are below 2 to this power, so that sums of their products fit.
const FACTOR_BITS: u32 = 113;

/// A matrix of the literature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matrix {
    /// Projective: the Jacobian J_P of the paper, 10m x 12n.
    Plain,
    /// Projective: the paper's J, with n + 15 rows that fix frame and scales.
    Augmented,
    /// Calibrated: rows (I - g g^T)(y_i - y_j), g the direction of the pair, 3m x 3n. The squares of its singular
    /// values are the eigenvalues of the bearing Laplacian.
    Bearing,
    /// The same with each pair's rows divided by its length: the bearing rigidity matrix.
    BearingByLength,
}

impl Matrix {
    /// All of them; the first of each model is the usual one.
    pub const ALL: [Self; 4] = [
        Self::Plain,
        Self::Augmented,
        Self::Bearing,
        Self::BearingByLength,
    ];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "J_P",
            Self::Augmented => "J",
            Self::Bearing => "bearing",
            Self::BearingByLength => "R_B",
        }
    }

    /// The model in which it is computed.
    pub fn model(self) -> Model {
        match self {
            Self::Plain | Self::Augmented => Model::Projective,
            Self::Bearing | Self::BearingByLength => Model::Calibrated,
        }
    }

    /// The place of the singular value that is looked at, from the smallest on: one more than the dimension of the
    /// trivial motions.
    pub fn place(self, nodes: usize) -> usize {
        match self {
            Self::Plain => nodes + 16,
            Self::Augmented => 1,
            Self::Bearing | Self::BearingByLength => 5,
        }
    }

    /// The most cameras that are enclosed, if a graph has more.
    pub fn too_large(self, graph: &Graph) -> Option<usize> {
        let most = match self.model() {
            Model::Projective => COLUMNS / 12,
            _ => COLUMNS / 3,
        };
        (graph.nodes() > most).then_some(most)
    }

    /// Its entries; nothing if it takes cameras and there are centres alone.
    fn entries(self, graph: &Graph, centres: &Centres, norm: &Rational) -> Option<Surds> {
        let place = envelope_order(graph);
        if self.model().in_space() {
            let by_length = self == Self::BearingByLength;
            return Some(bearing(graph, centres.places(), &place, by_length));
        }
        let mut found = projective(graph, centres.cameras()?, &place, norm);
        if self == Self::Augmented {
            let (one, fraction) = (Integer::one(), found.fractions.len());
            found.fractions.push([one.clone(), one]);
            let gauge = jacobian::gauge(&Integers, graph, jacobian::reference(graph));
            found.rows.extend(gauge.into_iter().map(|row| {
                let entry = |(k, x)| (12 * place[k / 12] + k % 12, x, fraction);
                row.into_iter().map(entry).collect()
            }));
        }
        Some(found)
    }
}

/// A sparse matrix with entries e sqrt(a / b).
#[derive(Default)]
struct Surds {
    columns: usize,
    /// All a and b.
    fractions: Vec<[Integer; 2]>,
    /// For every entry its column, e, and the number of its fraction.
    rows: Vec<Vec<(usize, Integer, usize)>>,
}

fn squares<'a>(entries: impl IntoIterator<Item = &'a Integer>) -> Integer {
    let entries = entries.into_iter();
    entries.fold(Integer::zero(), |sum, x| sum.add(&x.mul(x)))
}

/// J_P at cameras, where all P_v and F_ij have one Frobenius norm.
fn projective(graph: &Graph, cameras: &[[Integer; 12]], place: &[usize], norm: &Rational) -> Surds {
    let fourth = [norm.numerator(), norm.denominator()].map(|x| {
        let square = x.mul(x);
        square.mul(&square)
    });
    let matrix =
        |p: &[Integer; 12]| std::array::from_fn(|r| std::array::from_fn(|c| p[4 * r + c].clone()));
    let matrices: Vec<Camera<Integer>> = cameras.iter().map(matrix).collect();
    let mut found = Surds {
        columns: 12 * cameras.len(),
        ..Surds::default()
    };
    for &(i, j) in graph.edges() {
        let ends = [i as usize, j as usize];
        let [p_i, p_j] = ends.map(|v| &matrices[v]);
        let f = jacobian::fundamental(&Integers, p_i, p_j);
        let of_f = squares(f.iter().flatten());
        let (first, fraction) = (found.rows.len(), found.fractions.len());
        // The columns of a camera are those of F times the other camera.
        found.fractions.extend([1, 0].map(|other| {
            let of_camera = squares(&cameras[ends[other]]);
            [fourth[0].clone(), of_f.mul(&of_camera).mul(&fourth[1])]
        }));
        found
            .rows
            .resize_with(first + jacobian::VECH.len(), Vec::new);
        jacobian::edge_rows(&Integers, p_i, p_j, &f, |row, column, entry| {
            if !entry.is_zero() {
                let end = column / 12;
                let at = 12 * place[ends[end]] + column % 12;
                found.rows[first + row].push((at, entry, fraction + end));
            }
        });
    }
    found
}

/// The bearing matrices, at centres that are not at infinity.
fn bearing(graph: &Graph, places: &[[Integer; 4]], place: &[usize], by_length: bool) -> Surds {
    let mut found = Surds {
        columns: 3 * places.len(),
        ..Surds::default()
    };
    for &(i, j) in graph.edges() {
        let [a, b] = [i, j].map(|v| &places[v as usize]);
        let d: [Integer; 3] = std::array::from_fn(|k| a[k].mul(&b[3]).sub(&b[k].mul(&a[3])));
        let (square, weight) = (squares(&d), a[3].mul(&b[3]));
        found.fractions.push(match by_length {
            true => [weight.mul(&weight), square.mul(&square).mul(&square)],
            false => [Integer::one(), square.mul(&square)],
        });
        let fraction = found.fractions.len() - 1;
        for r in 0..3 {
            let mut row = Vec::with_capacity(6);
            for (v, sign) in [(i, 1i64), (j, -1)] {
                row.extend((0..3).map(|c| {
                    let all = if r == c {
                        square.clone()
                    } else {
                        Integer::zero()
                    };
                    let entry = all.sub(&d[r].mul(&d[c])).mul(&Integer::from(sign));
                    (3 * place[v as usize] + c, entry, fraction)
                }));
            }
            row.retain(|(_, entry, _)| !entry.is_zero());
            found.rows.push(row);
        }
    }
    found
}

/// The largest integer whose square is at most x >= 0.
fn square_root(x: &Integer) -> Integer {
    let mut root = power_of_two(x.bits().div_ceil(2) as i64);
    while !root.is_zero() {
        let next = root.add(&x.div_rem_euclid(&root).0);
        let next = next.div_rem_euclid(&Integer::from(2u64)).0;
        if next.sub(&root).sign() != Ordering::Less {
            break;
        }
        root = next;
    }
    root
}

fn power_of_two(k: i64) -> Integer {
    let power = Rational::scaled(Integer::one(), 2, k);
    power.numerator().clone()
}

/// M^T M of a rounded matrix M.
struct Gram {
    /// Of each row of the lower triangle the column of the first entry that is not zero, and all from there on.
    rows: Vec<(usize, Vec<I256>)>,
    /// M is 2^beta times the matrix that is meant, up to rounding.
    beta: i64,
    /// By how much, in units of 2^-beta, rounding may have moved a singular value.
    error: Integer,
}

impl Gram {
    fn new(meant: &Surds) -> Self {
        let entries = meant.rows.iter().flatten();
        let bits = entries.clone().map(|(_, e, fraction)| {
            let [a, b] = &meant.fractions[*fraction];
            2 * e.bits() as i64 + a.bits() as i64 - b.bits() as i64 + 1
        });
        let beta = BITS - bits.max().unwrap_or(0).div_euclid(2) - 1;
        // |e| sqrt(a / b) 2^beta, rounded down.
        let rounded = |(column, e, fraction): &(usize, Integer, usize)| {
            let [a, b] = &meant.fractions[*fraction];
            let [up, down] = [beta.max(0), (-beta).max(0)].map(|k| power_of_two(2 * k));
            let square = e.mul(e).mul(a).mul(&up).div_rem_euclid(&b.mul(&down)).0;
            let root = of_integer(&square_root(&square));
            (*column, if e.sign().is_lt() { -root } else { root })
        };
        let rows = meant
            .rows
            .iter()
            .map(|row| row.iter().map(rounded).collect());
        let rows: Vec<Vec<(usize, I256)>> = rows.collect();
        let error = square_root(&Integer::from(entries.count() as u64)).add(&Integer::one());
        Self {
            rows: gram(&rows, meant.columns),
            beta,
            error,
        }
    }

    /// Eliminates H = M^T M - shift: C S C^T + E with a triangle C of integers and signs S. Nothing if numbers grow too
    /// much. O(N^3) products of integers, less what stands before the first entries of rows.
    fn eliminated(&self, shift: I256, task: &Task<'_>) -> Result<Option<Inertia>, Stopped> {
        let mut found = Inertia::default();
        // C, and C S.
        let mut factors: Vec<[Vec<I256>; 2]> = Vec::with_capacity(self.rows.len());
        let mut remainders = vec![I256::ZERO; self.rows.len()];
        let (mut signs, most) = (Vec::new(), I256::ONE << FACTOR_BITS);
        let work = task.begin(self.rows.len() as u64);
        for (i, (from, given)) in self.rows.iter().enumerate() {
            work.done(1)?;
            let mut own: [Vec<I256>; 2] = [Vec::with_capacity(given.len()), Vec::new()];
            for (j, &entry) in (*from..).zip(given) {
                let (other, first) = (factors.get(j).unwrap_or(&own), self.rows[j].0);
                let both = first.max(*from).min(j);
                let pairs = own[0][both - from..]
                    .iter()
                    .zip(&other[1][both.saturating_sub(first)..]);
                let left = entry - pairs.fold(I256::ZERO, |sum, (&x, &y)| sum + x * y);
                let (factor, remainder) = if j < i {
                    let divisor = other[1][j - first];
                    (left / divisor, left % divisor)
                } else {
                    let left = left - shift;
                    let root = root(left.abs());
                    signs.push(left.signum());
                    found.negative += usize::from(left < I256::ZERO);
                    found.logarithm += 2.0 * root.as_f64().ln();
                    (root, left.abs() - root * root)
                };
                if factor.abs() >= most {
                    return Ok(None);
                }
                remainders[i] += remainder.abs();
                if j < i {
                    remainders[j] += remainder.abs();
                }
                own[0].push(factor);
                own[1].push(if signs[j] < I256::ZERO {
                    -factor
                } else {
                    factor
                });
            }
            factors.push(own);
        }
        found.rho = remainders.into_iter().max().unwrap_or_default();
        Ok(Some(found))
    }
}

/// What an elimination finds.
#[derive(Default)]
struct Inertia {
    /// H - E has so many negative eigenvalues, and no zero.
    negative: usize,
    /// The largest sum of remainders in a row: a bound on the norm of E.
    rho: I256,
    /// The logarithm of the determinant, which only proposes.
    logarithm: f64,
}

/// An integer near a square root, 1 at least: what it misses is a remainder.
fn root(square: I256) -> I256 {
    let near = square.as_f64().sqrt().as_i256().max(I256::ONE);
    (0..3).fold(near, |root, _| {
        ((root + square / root) / I256::from(2)).max(I256::ONE)
    })
}

fn of_integer(x: &Integer) -> I256 {
    let found = x.to_string().parse();
    found.unwrap_or_else(|_| unreachable!("{x} has few bits"))
}

/// Two fractions between which a singular value lies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enclosure {
    /// At least this, and not negative.
    pub least: Rational,
    /// At most this.
    pub most: Rational,
}

/// As a is smaller than b, equal or larger.
pub fn compare(a: &Rational, b: &Rational) -> Ordering {
    Rationals.sub(a, b).numerator().sign()
}

impl Enclosure {
    /// Where the rank is smaller than the place needs.
    pub fn zero() -> Self {
        let [least, most] = [(); 2].map(|()| Rational::from(Integer::zero()));
        Self { least, most }
    }

    /// Of the squares of a rounded matrix.
    fn new(gram: &Gram, low: I256, high: I256) -> Self {
        let root = |x: I256| {
            let x = Integer::from_decimal(&x.to_string());
            square_root(&x.unwrap_or_else(|_| unreachable!("these are digits")))
        };
        let least = root(low).sub(&gram.error);
        let least = if least.sign().is_lt() {
            Integer::zero()
        } else {
            least
        };
        let most = root(high).add(&gram.error).add(&Integer::one());
        let [least, most] = [least, most].map(|x| Rational::scaled(x, 2, -gram.beta));
        Self { least, most }
    }

    /// Whether the bounds agree in nine digits, or are both zero.
    fn is_narrow(&self) -> bool {
        let times = |x, factor: u64| Rationals.mul(x, &Integer::from(factor).into());
        let least = times(&self.least, 1_000_000_001);
        compare(&times(&self.most, 1_000_000_000), &least).is_le()
    }

    /// Whether the value is surely between two bounds, or surely not; nothing if neither is sure.
    pub fn is_within(&self, [least, most]: &[Rational; 2]) -> Option<bool> {
        if compare(least, &self.least).is_le() && compare(&self.most, most).is_le() {
            return Some(true);
        }
        let is_apart = compare(&self.most, least).is_lt() || compare(most, &self.least).is_lt();
        is_apart.then_some(false)
    }

    /// Both bounds as decimals, rounded away from each other.
    pub fn decimals(&self) -> [String; 2] {
        let [least, most] = [outward(&self.least, false), outward(&self.most, true)];
        [least, most].map(|x| {
            if x == 0.0 {
                "0".into()
            } else {
                format!("{x:e}")
            }
        })
    }
}

/// A fraction of which the denominator is a power of two, in doubles, rounded down or up by a few units at most.
fn outward(x: &Rational, up: bool) -> f64 {
    let double = |x: &Integer| x.to_string().parse().unwrap_or(f64::INFINITY);
    let (above, below): (f64, f64) = (double(x.numerator()), double(x.denominator()));
    match up {
        _ if x.numerator().is_zero() => 0.0,
        false => (0..4).fold(above / below, |x, _| x.next_down()).max(0.0),
        true => (0..4).fold(above / below.min(f64::MAX), |x, _| x.next_up()),
    }
}

/// Encloses the singular value at [`Matrix::place`] in nine digits at least, and until it is surely within `claimed` or
/// surely not; or until rounding to 100 bits hides more. `norm` is the positive one of cameras and fundamental matrices,
/// 10 in the literature; bearings have none. Nothing if the matrix takes cameras, and centres alone are given. About a
/// dozen eliminations, each O(N^3), N the columns.
///
/// # Errors
/// Work that was stopped.
pub fn enclose(
    matrix: Matrix,
    graph: &Graph,
    centres: &Centres,
    norm: Option<&Rational>,
    claimed: Option<&[Rational; 2]>,
    watch: &Watch,
) -> Result<Option<Enclosure>, Stopped> {
    let usual = Rational::from(Integer::from(10u64));
    let Some(meant) = matrix.entries(graph, centres, norm.unwrap_or(&usual)) else {
        return Ok(None);
    };
    let (gram, place) = (Gram::new(&meant), matrix.place(graph.nodes()));
    let diagonal = gram.rows.iter().filter_map(|(_, row)| row.last());
    let (mut low, mut high) = (I256::ZERO, diagonal.fold(I256::ONE, |sum, &x| sum + x));
    // Below the value det(M^T M - s) / (-s)^(place - 1), up to rounding a polynomial with real roots, falls and is convex:
    // the secant through two points there ends between the second one and the value.
    let mut below: Vec<[f64; 2]> = Vec::new();
    let (mut rho, mut aside) = (0.0f64, 1.0);
    for test in 0..TESTS {
        let found = Enclosure::new(&gram, low, high);
        let [from, to] = [low, high].map(I256::as_f64);
        let is_settled = claimed.is_none_or(|claimed| found.is_within(claimed).is_some());
        if found.is_narrow() && is_settled || to - from <= 8.0 * rho {
            break;
        }
        let least = from.max(rho).max(1.0);
        let proposed = match below[..] {
            _ if to > 4096.0 * least => (least * to).sqrt(),
            [.., [s, f], [t, g]] if test % 3 != 2 => {
                let ratio = (g - f).exp();
                let step = (t - s) * ratio / (1.0 - ratio);
                match step > 1e-11 * t {
                    true => t + step,
                    false => t + step + (5e-10 * t).min((to - t) / 8.0),
                }
            }
            _ => f64::NAN,
        };
        let is_between = from < proposed && proposed < to;
        let at = aside
            * if is_between {
                proposed
            } else {
                from.midpoint(to)
            };
        let task = watch.task(Step::Elimination, graph.nodes());
        let square = at.as_i256();
        let Some(found) = gram.eliminated(square, &task)? else {
            // Numbers grow where a pivot happens to be small.
            aside *= 1.001;
            continue;
        };
        (rho, aside) = (found.rho.as_f64(), 1.0);
        if found.negative >= place {
            high = high.min(square + found.rho);
        } else {
            low = low.max(square - found.rho);
            let zeros = (place - 1) as f64;
            below.push([at, found.logarithm - zeros * at.ln()]);
            below.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
    }
    Ok(Some(Enclosure::new(&gram, low, high)))
}
