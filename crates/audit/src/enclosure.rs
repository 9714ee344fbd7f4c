//! The smallest singular value of a Jacobian at given cameras, enclosed (docs/theory, Theorem 16.6).
//!
//! In: a graph, the centres or cameras of its nodes, and which matrix. Out: two fractions between which the value
//! lies. An elimination in integers of 256 bits counts the eigenvalues of M^T M below a square and keeps what every
//! division leaves over, so a count is a proof. Floating point only proposes the squares.

use crate::linear::{envelope_order, gram, reordered};
use ethnum::{AsI256, I256};
use std::cmp::Ordering;
use viewcert::Model;
use viewcert::at_cameras::{Centres, Here};
use viewcert::geometry::jacobian::{self, SparseRows, VECH};
use viewcert::graph::Graph;
use viewcert::linalg::Ring;
use viewcert::linalg::integer::{Integer, Integers};
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::watch::{Step, Stopped, Task, Watch};
use viewcert::wording::counted;

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
        ["J_P", "J", "bearing", "R_B"][self as usize]
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

    /// The columns of a camera.
    fn width(self) -> usize {
        if self.model().in_space() { 3 } else { 12 }
    }

    /// The matrix times a power of two, with entries rounded to integers towards zero, and the power; nothing if it
    /// takes cameras and there are centres alone.
    fn rounded(self, graph: &Graph, centres: &Centres, norm: &Rational) -> Option<Rounded> {
        if self.width() == 3 {
            let by_length = self == Self::BearingByLength;
            return Some(bearing(graph, centres.places(), by_length));
        }
        let is_framed = self == Self::Augmented;
        Some(projective(graph, centres.cameras()?, norm, is_framed))
    }
}

/// A matrix of integers, which is 2^beta times the one that is meant, up to rounding; and beta.
type Rounded = (SparseRows<I256>, i64);

/// The beta for entries whose squares are a / b at most.
fn beta([a, b]: &[Integer; 2]) -> i64 {
    BITS - (a.bits() as i64 - b.bits() as i64 + 1).div_euclid(2) - 1
}

/// A fraction times 4^beta.
fn scaled([a, b]: [Integer; 2], beta: i64) -> [Integer; 2] {
    let power = |k: i64| Rational::scaled(Integer::one(), 4, k.max(0));
    [
        a.mul(power(beta).numerator()),
        b.mul(power(-beta).numerator()),
    ]
}

/// e sqrt(a / b), rounded towards zero.
fn root_of(e: &Integer, [a, b]: &[Integer; 2]) -> I256 {
    let square = e.mul(e).mul(a).div_rem_euclid(b).0;
    let root = square.square_root().to_string().parse();
    let root: I256 = root.unwrap_or_else(|_| unreachable!("entries have few bits"));
    if e.sign().is_lt() { -root } else { root }
}

fn squares<'a>(entries: impl IntoIterator<Item = &'a Integer>) -> Integer {
    let entries = entries.into_iter();
    entries.fold(Integer::zero(), |sum, x| sum.add(&x.mul(x)))
}

/// J_P at cameras, where all P_v and F_ij have one Frobenius norm; with the rows that fix frame and scales, J.
fn projective(
    graph: &Graph,
    cameras: &[[Integer; 12]],
    norm: &Rational,
    is_framed: bool,
) -> Rounded {
    let [above, below] = [norm.numerator(), norm.denominator()].map(|x| {
        let square = x.mul(x);
        square.mul(&square)
    });
    // No entry is above twice the square of the norm, or above 1.
    let most = above.mul(&Integer::from(4u64)).add(&below);
    let beta = beta(&[most, below.clone()]);
    let matrix =
        |p: &[Integer; 12]| std::array::from_fn(|r| std::array::from_fn(|c| p[4 * r + c].clone()));
    let matrices: Vec<_> = cameras.iter().map(matrix).collect();
    let exact = jacobian::jacobian(&Integers, graph, &matrices);
    let mut rows = Vec::new();
    for (block, &(i, j)) in exact.chunks(VECH.len()).zip(graph.edges()) {
        let ends = [i as usize, j as usize];
        let [p_i, p_j] = ends.map(|v| &matrices[v]);
        let of_f = squares(jacobian::fundamental(&Integers, p_i, p_j).iter().flatten());
        let of_f = below.mul(&of_f);
        // The columns of a camera are those of F times the other camera.
        let others = [ends[1], ends[0]]
            .map(|other| scaled([above.clone(), of_f.mul(&squares(&cameras[other]))], beta));
        rows.extend(block.iter().map(|row| {
            let entry = |(k, e): &(usize, Integer)| {
                (*k, root_of(e, &others[usize::from(k / 12 != ends[0])]))
            };
            row.iter().map(entry).collect()
        }));
    }
    if is_framed {
        let one = scaled([Integer::one(), Integer::one()], beta);
        let gauge = jacobian::gauge(&Integers, graph, jacobian::reference(graph));
        let entry = |(k, e)| (k, root_of(&e, &one));
        rows.extend(
            gauge
                .into_iter()
                .map(|row| row.into_iter().map(entry).collect()),
        );
    }
    (rows, beta)
}

/// The bearing matrices, at centres that are not at infinity.
fn bearing(graph: &Graph, places: &[[Integer; 4]], by_length: bool) -> Rounded {
    let pair = |&(i, j): &(u32, u32)| {
        let [a, b] = [i, j].map(|v| &places[v as usize]);
        let d: [Integer; 3] = std::array::from_fn(|k| a[k].mul(&b[3]).sub(&b[k].mul(&a[3])));
        let (square, weight) = (squares(&d), a[3].mul(&b[3]));
        let most = match by_length {
            true => [weight.mul(&weight), square.clone()],
            false => [Integer::one(), Integer::one()],
        };
        (d, square, most)
    };
    let pairs: Vec<_> = graph.edges().iter().map(pair).collect();
    let beta = pairs.iter().map(|(.., most)| beta(most)).min().unwrap_or(0);
    let mut rows = Vec::new();
    for (&(i, j), (d, square, [a, b])) in graph.edges().iter().zip(pairs) {
        let by = scaled([a, b.mul(&square).mul(&square)], beta);
        rows.extend((0..3).map(|r| {
            let entry = |c: usize| {
                let all = if r == c {
                    square.clone()
                } else {
                    Integer::zero()
                };
                root_of(&all.sub(&d[r].mul(&d[c])), &by)
            };
            let of =
                |v: u32, sign: I256| (0..3).map(move |c| (3 * v as usize + c, sign * entry(c)));
            of(i, I256::ONE).chain(of(j, -I256::ONE)).collect()
        }));
    }
    (rows, beta)
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
    /// Eliminates H = M^T M - shift: C S C^T + E with a triangle C of integers and signs S. Nothing if numbers grow too
    /// much. O(N^3) products of integers, less what stands before the first entries of rows.
    fn eliminated(&self, shift: I256, task: &Task<'_>) -> Result<Option<Inertia>, Stopped> {
        let (mut found, most) = (Inertia::default(), I256::ONE << FACTOR_BITS);
        // C, and C S.
        let mut factors: Vec<Vec<[I256; 2]>> = Vec::with_capacity(self.rows.len());
        let mut remainders = vec![I256::ZERO; self.rows.len()];
        let mut signs = Vec::new();
        let work = task.begin(self.rows.len() as u64);
        for (i, (from, given)) in self.rows.iter().enumerate() {
            work.done(1)?;
            let mut own = Vec::with_capacity(given.len());
            for (j, &entry) in (*from..).zip(given) {
                let (other, first) = (factors.get(j).unwrap_or(&own), self.rows[j].0);
                let both = first.max(*from).min(j);
                let pairs = own[both - from..]
                    .iter()
                    .zip(&other[both.saturating_sub(first)..]);
                let left = entry - pairs.fold(I256::ZERO, |sum, (x, y)| sum + x[0] * y[1]);
                let (factor, remainder) = if j < i {
                    let divisor = other[j - first][1];
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
                own.push([
                    factor,
                    if signs[j] < I256::ZERO {
                        -factor
                    } else {
                        factor
                    },
                ]);
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

/// Why a singular value is not enclosed.
#[derive(Clone, Debug, thiserror::Error)]
pub enum SigmaError {
    /// More cameras than that.
    #[error("sigma: {}, and it is enclosed for up to {most}", counted(*.cameras, "camera"))]
    TooLarge {
        /// Cameras of the graph.
        cameras: usize,
        /// Cameras at most.
        most: usize,
    },
    /// The matrix takes whole cameras.
    #[error(
        "sigma: {0} takes whole cameras, and the file gives centres alone; give `camera` or `pose`"
    )]
    CentresAlone(&'static str),
    /// Work was stopped.
    #[error(transparent)]
    Stopped(#[from] Stopped),
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
            x.unwrap_or_else(|_| unreachable!("these are digits"))
                .square_root()
        };
        let least = root(low).sub(&gram.error).max(Integer::zero());
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

/// Encloses the singular value at [`Matrix::place`] at cameras of which the answer is known: exactly zero where the rank
/// is not full, else in nine digits at least, and until it is surely within `claimed` or surely not; or until rounding to
/// 100 bits hides more. `norm` is the positive one of cameras and fundamental matrices, 10 in the literature; bearings
/// have none. About a dozen eliminations, each O(N^3), N the columns.
///
/// # Errors
/// See [`SigmaError`].
pub fn enclose(
    matrix: Matrix,
    graph: &Graph,
    (centres, here): (&Centres, &Here),
    (norm, claimed): (Option<&Rational>, Option<&[Rational; 2]>),
    watch: &Watch,
) -> Result<Enclosure, SigmaError> {
    if !here.is_determined() {
        return Ok(Enclosure::zero());
    }
    let (cameras, most) = (graph.nodes(), COLUMNS / matrix.width());
    if cameras > most {
        return Err(SigmaError::TooLarge { cameras, most });
    }
    let usual = Rational::from(Integer::from(10u64));
    let rounded = matrix.rounded(graph, centres, norm.unwrap_or(&usual));
    let (mut rows, beta) = rounded.ok_or(SigmaError::CentresAlone(matrix.name()))?;
    let entries: usize = rows.iter().map(Vec::len).sum();
    reordered(&mut rows, matrix.width(), &envelope_order(graph));
    let gram = Gram {
        rows: gram(&rows, matrix.width() * cameras),
        beta,
        error: Integer::from(entries as u64)
            .square_root()
            .add(&Integer::one()),
    };
    let place = matrix.place(cameras);
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
    Ok(Enclosure::new(&gram, low, high))
}
