//! The smallest singular value of a Jacobian at given cameras, enclosed (docs/theory, Theorem 16.6).
//!
//! In: a graph, the centres or cameras of its nodes, and which matrix. Out: two fractions between which the value
//! lies. An elimination in integers of 256 bits counts the eigenvalues of M^T M below a square and keeps what every
//! division leaves over, so a count is a proof. Floating point only proposes the squares.

use crate::linear::{envelope_order, gram, reordered};
use ethnum::{AsI256, I256};
use viewcert::Model;
use viewcert::at_cameras::{Centres, Here};
use viewcert::decide::VerdictError;
use viewcert::geometry::jacobian::{self, SparseRows, VECH};
use viewcert::graph::Graph;
use viewcert::linalg::integer::{Integer, Integers, One, Signed, Zero, decimal};
use viewcert::linalg::rational::{Rational, scaled};
use viewcert::watch::{Step, Stopped, Task, Watch};

/// Why nothing is enclosed at centres.
pub const CENTRES_ALONE: &str =
    "sigma: J_P takes whole cameras, and the file gives centres alone; give `camera` or `pose`";
/// Columns at most: about an hour.
const COLUMNS: usize = 3_600;
/// Eliminations at most.
const TESTS: usize = 120;
/// Factors of an elimination are below 2 to this power, so that sums of their products fit.
const FACTOR_BITS: u32 = 113;

/// The name of a model's matrix, its columns for each camera, and the place of the singular value that is looked at, from
/// the smallest on: one more than the dimension of the trivial motions. None is enclosed in the affine model.
///
/// Projective: the Jacobian J_P of the paper. Calibrated: rows (I - g g^T)(y_i - y_j), g the direction of the pair, so that
/// squares of singular values are eigenvalues of the bearing Laplacian.
pub fn matrix(model: Model, nodes: usize) -> Option<(&'static str, usize, usize)> {
    match model {
        Model::Projective => Some(("J_P", 12, nodes + 16)),
        Model::Calibrated => Some(("bearing", 3, 5)),
        Model::Affine => None,
    }
}

/// e sqrt(a / b), rounded towards zero.
fn root_of(e: &Integer, a: &Integer, b: &Integer) -> I256 {
    let square = e * e * a / b;
    let root = square.sqrt().to_string().parse();
    let root: I256 = root.unwrap_or_else(|_| unreachable!("entries have few bits"));
    if e.is_negative() { -root } else { root }
}

fn squares<'a>(entries: impl IntoIterator<Item = &'a Integer>) -> Integer {
    let entries = entries.into_iter();
    entries.fold(Integer::zero(), |sum, x| sum + x * x)
}

/// J_P at cameras, where all P_v and F_ij have Frobenius norm 10 as in the literature, times 2 to a power; and that power.
/// No entry is above twice the square of the norm.
fn projective(graph: &Graph, cameras: &[[Integer; 12]]) -> (SparseRows<I256>, i64) {
    let beta = 91;
    let above = scaled(Integer::from(10_000u64), 2, 2 * beta);
    let matrix =
        |p: &[Integer; 12]| std::array::from_fn(|r| std::array::from_fn(|c| p[4 * r + c].clone()));
    let matrices: Vec<_> = cameras.iter().map(matrix).collect();
    let exact = jacobian::jacobian(&Integers, graph, &matrices);
    let pairs = exact.chunks(VECH.len()).zip(graph.edges());
    let rows = pairs.flat_map(|(block, &(i, j))| {
        let ends = [i as usize, j as usize];
        let [p_i, p_j] = ends.map(|v| &matrices[v]);
        let of_f = squares(jacobian::fundamental(&Integers, p_i, p_j).iter().flatten());
        // The columns of a camera are those of F times the other camera.
        let below = [ends[1], ends[0]].map(|other| &of_f * squares(&cameras[other]));
        let entry = |(k, e): &(usize, Integer)| {
            let below = &below[usize::from(k / 12 != ends[0])];
            (*k, root_of(e, above.numer(), below))
        };
        let rows = block.iter().map(|row| row.iter().map(entry).collect());
        rows.collect::<Vec<_>>()
    });
    (rows.collect(), beta)
}

/// The bearing matrix at centres that are not at infinity, times 2 to a power; and that power. No entry is above 1.
fn bearing(graph: &Graph, places: &[[Integer; 4]]) -> (SparseRows<I256>, i64) {
    let beta = 99;
    let above = scaled(Integer::one(), 2, 2 * beta);
    let mut rows = Vec::new();
    for &(i, j) in graph.edges() {
        let [a, b] = [i, j].map(|v| &places[v as usize]);
        let d: [Integer; 3] = std::array::from_fn(|k| &a[k] * &b[3] - &b[k] * &a[3]);
        let square = squares(&d);
        let below = &square * &square;
        rows.extend((0..3).map(|r| {
            let entry = |c: usize| {
                let all = if r == c { &square } else { &Integer::zero() };
                root_of(&(all - &d[r] * &d[c]), above.numer(), &below)
            };
            let of =
                |v: u32, sign: I256| (0..3).map(move |c| (3 * v as usize + c, sign * entry(c)));
            of(i, I256::ONE).chain(of(j, -I256::ONE)).collect()
        }));
    }
    (rows, beta)
}

/// Eliminates H = A - shift, of whose lower triangle each row has the column of its first entry that is not zero and all
/// from there on: C S C^T + E with a triangle C of integers and signs S. O(N^3) products of integers, less what stands before
/// the first entries of rows.
///
/// H - E has so many negative eigenvalues, and no zero; the largest sum of remainders in a row bounds the norm of E; the
/// logarithm of the determinant only proposes. Nothing if numbers grow too much.
fn eliminated(
    rows: &[(usize, Vec<I256>)],
    shift: I256,
    task: &Task<'_>,
) -> Result<Option<(usize, I256, f64)>, Stopped> {
    let (mut negative, mut logarithm) = (0, 0.0);
    // C, and C S.
    let mut factors: Vec<Vec<[I256; 2]>> = Vec::with_capacity(rows.len());
    let mut remainders = vec![I256::ZERO; rows.len()];
    let mut signs = Vec::new();
    let work = task.begin(rows.len() as u64);
    for (i, (from, given)) in rows.iter().enumerate() {
        work.done(1)?;
        let mut own = Vec::with_capacity(given.len());
        for (j, &entry) in (*from..).zip(given) {
            let (other, first) = (factors.get(j).unwrap_or(&own), rows[j].0);
            let both = first.max(*from).min(j);
            let shared = &other[both.saturating_sub(first)..];
            let pairs = own[both - from..].iter().zip(shared);
            let left = entry - pairs.fold(I256::ZERO, |sum, (x, y)| sum + x[0] * y[1]);
            let (factor, remainder) = if j < i {
                let divisor = other[j - first][1];
                (left / divisor, left % divisor)
            } else {
                let left = left - shift;
                let root = root(left.abs());
                let is_below = u8::from(left < I256::ZERO);
                signs.push(I256::ONE - I256::from(2 * is_below));
                negative += usize::from(is_below);
                logarithm += 2.0 * root.as_f64().ln();
                (root, left.abs() - root * root)
            };
            if factor.abs() >= I256::ONE << FACTOR_BITS {
                return Ok(None);
            }
            remainders[i] += remainder.abs();
            if j < i {
                remainders[j] += remainder.abs();
            }
            own.push([factor, factor * signs[j]]);
        }
        factors.push(own);
    }
    let rho = remainders.into_iter().max().unwrap_or_default();
    Ok(Some((negative, rho, logarithm)))
}

/// An integer near a square root, 1 at least: what it misses is a remainder.
fn root(square: I256) -> I256 {
    let near = square.as_f64().sqrt().as_i256().max(I256::ONE);
    let step = |root: I256, _| ((root + square / root) / 2).max(I256::ONE);
    (0..3).fold(near, step)
}

/// Two fractions between which a singular value lies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enclosure {
    /// At least this, and not negative.
    pub least: Rational,
    /// At most this.
    pub most: Rational,
}

impl Enclosure {
    /// Where the rank is smaller than the place needs.
    pub(crate) fn zero() -> Self {
        let zero = Rational::from(Integer::zero());
        let (least, most) = (zero.clone(), zero);
        Self { least, most }
    }

    /// By bounds of the square of that of a matrix, which is 2^beta times the one that is meant up to so much.
    fn new([low, high]: [I256; 2], beta: i64, error: &Integer) -> Self {
        let root = |x: I256| {
            let x = decimal(&x.to_string());
            x.unwrap_or_else(|| unreachable!("these are digits")).sqrt()
        };
        let least = (root(low) - error).max(Integer::zero());
        let most = root(high) + error + 1;
        let [least, most] = [least, most].map(|x| scaled(x, 2, -beta));
        Self { least, most }
    }

    /// Whether the bounds agree in nine digits, or are both zero.
    fn is_narrow(&self) -> bool {
        let times = |x: &Rational, factor: u64| x * Integer::from(factor);
        times(&self.most, 1_000_000_000) <= times(&self.least, 1_000_000_001)
    }

    /// Whether the value is surely between two bounds, or surely not; nothing if neither is sure.
    pub fn is_within(&self, [least, most]: &[Rational; 2]) -> Option<bool> {
        let is_inside = *least <= self.least && self.most <= *most;
        let is_apart = self.most < *least || *most < self.least;
        (is_inside || is_apart).then_some(is_inside)
    }

    /// Both bounds as decimals, rounded away from each other.
    pub fn decimals(&self) -> [String; 2] {
        [outward(&self.least, false), outward(&self.most, true)]
    }
}

/// A fraction of which the denominator is a power of two, in doubles, rounded down or up by a few units at most.
fn outward(x: &Rational, up: bool) -> String {
    let double = |x: &Integer| x.to_string().parse().unwrap_or(f64::INFINITY);
    let (above, below): (f64, f64) = (double(x.numer()), double(x.denom()));
    let x = match up {
        _ if x.numer().is_zero() => 0.0,
        false => (0..4).fold(above / below, |x, _| x.next_down()).max(0.0),
        true => (0..4).fold(above / below.min(f64::MAX), |x, _| x.next_up()),
    };
    match x {
        0.0 => "0".to_owned(),
        _ => format!("{x:e}"),
    }
}

/// Encloses the singular value of a [`matrix`] at cameras of which the answer is known: exactly zero where the rank is not
/// full, else in nine digits at least, and until it is surely within `claimed` or surely not; or until rounding to 100 bits
/// hides more. Nothing where the model has no matrix, or it takes cameras and there are centres alone. About a dozen
/// eliminations, each O(N^3), N the columns.
///
/// # Errors
/// Too many cameras; work that was stopped.
pub fn enclose(
    graph: &Graph,
    (centres, here): (&Centres, &Here),
    claimed: Option<&[Rational; 2]>,
    watch: &Watch,
) -> Result<Option<Enclosure>, VerdictError> {
    let Some((_, width, place)) = matrix(here.model, graph.nodes()) else {
        return Ok(None);
    };
    if !here.is_determined() {
        return Ok(Some(Enclosure::zero()));
    }
    if width * graph.nodes() > COLUMNS {
        return Err(VerdictError::TooLarge {
            what: "an enclosed singular value",
            nodes: graph.nodes(),
            edges: graph.edges().len(),
            needs: "hours".to_owned(),
            advice: "it is enclosed for up to 300 projective or 1200 calibrated cameras",
        });
    }
    let (mut rows, beta) = match (width, centres.cameras()) {
        (3, _) => bearing(graph, centres.places()),
        (_, Some(cameras)) => projective(graph, cameras),
        _ => return Ok(None),
    };
    let entries: usize = rows.iter().map(Vec::len).sum();
    reordered(&mut rows, width, &envelope_order(graph));
    let rows = gram(&rows, width * graph.nodes());
    // By how much rounding may have moved a singular value.
    let error = Integer::from(entries as u64).sqrt() + 1;
    let diagonal = rows.iter().filter_map(|(_, row)| row.last());
    let (mut low, mut high) = (I256::ZERO, diagonal.fold(I256::ONE, |sum, &x| sum + x));
    // Below the value det(M^T M - s) / (-s)^(place - 1), up to rounding a polynomial with real roots, falls and is convex:
    // the secant through two points there ends between the second one and the value.
    let mut below: Vec<[f64; 2]> = Vec::new();
    let (mut rho, mut aside) = (0.0f64, 1.0);
    for test in 0..TESTS {
        let found = Enclosure::new([low, high], beta, &error);
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
                let beyond = (5e-10 * t).min((to - t) / 8.0);
                t + step + if step > 1e-11 * t { 0.0 } else { beyond }
            }
            _ => f64::NAN,
        };
        let inside = Some(proposed).filter(|at| from < *at && *at < to);
        let at = aside * inside.unwrap_or(from.midpoint(to));
        let task = watch.task(Step::Elimination, graph.nodes());
        let square = at.as_i256();
        let Some((negative, left, logarithm)) = eliminated(&rows, square, &task)? else {
            // Numbers grow where a pivot happens to be small.
            aside *= 1.001;
            continue;
        };
        (rho, aside) = (left.as_f64(), 1.0);
        if negative >= place {
            high = high.min(square + left);
        } else {
            low = low.max(square - left);
            below.push([at, logarithm - (place - 1) as f64 * at.ln()]);
            below.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
    }
    Ok(Some(Enclosure::new([low, high], beta, &error)))
}
