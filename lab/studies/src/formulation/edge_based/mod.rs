//! Edge-based formulations: a 4 x 4 transformation X_e for every pair, and a link between
//! any two pairs e, e' that meet in a camera v (docs/theory.md, section 11):
//!
//! ```text
//! X_e - X_e' = lambda I + c_v w^T
//! ```
//!
//! with c_v the centre of v. Eliminating lambda and w leaves 20 linear equations of rank
//! 11 in X_e - X_e'. Unknown `16 e + 4 a + k` is entry (a, k) of X_e.

pub mod full;
pub mod reduced;

use viewcert::geometry::camera::{Camera, centre};
use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::Graph;
use viewcert::linalg::{Field, Ring};

/// The columns other than `a`, ascending.
fn others(a: usize) -> [usize; 3] {
    std::array::from_fn(|k| k + usize::from(k >= a))
}

fn entry(a: usize, k: usize) -> usize {
    4 * a + k
}

/// c_a M_bk - c_b M_ak, which is zero for M = lambda I + c w^T and k other than a and b.
fn off_diagonal<R: Ring>(
    ring: &R,
    c: &[R::Elem; 4],
    (a, b): (usize, usize),
    k: usize,
) -> Vec<(usize, R::Elem)> {
    vec![(entry(b, k), c[a].clone()), (entry(a, k), ring.neg(&c[b]))]
}

/// (c_a M_kk - c_k M_ak) - (c_a M_ll - c_l M_al), for k and l other than a: both brackets
/// are c_a lambda.
fn diagonal<R: Ring>(
    ring: &R,
    c: &[R::Elem; 4],
    a: usize,
    (k, l): (usize, usize),
) -> Vec<(usize, R::Elem)> {
    vec![
        (entry(k, k), c[a].clone()),
        (entry(a, k), ring.neg(&c[k])),
        (entry(l, l), ring.neg(&c[a])),
        (entry(a, l), c[l].clone()),
    ]
}

/// The 20 equations for M = lambda I + c w^T over the 16 entries of M: 12 of two terms,
/// 8 of four. Entries that are zero are left out, columns ascend.
pub fn twenty<R: Ring>(ring: &R, c: &[R::Elem; 4]) -> SparseRows<R::Elem> {
    let mut rows = Vec::with_capacity(20);
    for b in 1..4 {
        for a in 0..b {
            for k in (0..4).filter(|&k| k != a && k != b) {
                rows.push(off_diagonal(ring, c, (a, b), k));
            }
        }
    }
    for a in 0..4 {
        let [p, q, r] = others(a);
        rows.push(diagonal(ring, c, a, (p, q)));
        rows.push(diagonal(ring, c, a, (q, r)));
    }
    rows.into_iter().map(|row| tidy(ring, row)).collect()
}

/// Eleven of the equations that imply the others, chosen at the last coordinate of c that
/// is not zero (docs/theory.md, section 11).
///
/// # Panics
/// If c is zero.
pub fn eleven<R: Ring>(ring: &R, c: &[R::Elem; 4]) -> SparseRows<R::Elem> {
    let t = (0..4)
        .rev()
        .find(|&t| !ring.is_zero(&c[t]))
        .expect("a centre is not zero");
    let [p, q, r] = others(t);
    let mut rows = Vec::with_capacity(11);
    for k in [p, q, r] {
        for a in (0..4).filter(|&a| a != t && a != k) {
            rows.push(off_diagonal(ring, c, (t, a), k));
        }
    }
    rows.push(diagonal(ring, c, t, (p, q)));
    rows.push(diagonal(ring, c, t, (q, r)));
    for (a, k) in [(p, q), (q, r), (r, p)] {
        rows.push(diagonal(ring, c, a, (t, k)));
    }
    rows.into_iter().map(|row| tidy(ring, row)).collect()
}

fn tidy<R: Ring>(ring: &R, mut row: Vec<(usize, R::Elem)>) -> Vec<(usize, R::Elem)> {
    row.retain(|(_, x)| !ring.is_zero(x));
    row.sort_unstable_by_key(|&(col, _)| col);
    row
}

/// The equations `link` for X_e - X_e'.
fn between<R: Ring>(
    ring: &R,
    link: &SparseRows<R::Elem>,
    (e, other): (usize, usize),
) -> SparseRows<R::Elem> {
    link.iter()
        .map(|row| {
            let plus = row.iter().map(|(col, x)| (16 * e + col, x.clone()));
            let minus = row.iter().map(|(col, x)| (16 * other + col, ring.neg(x)));
            tidy(ring, plus.chain(minus).collect())
        })
        .collect()
}

/// The edges at every node, ascending.
fn stars(graph: &Graph) -> Vec<Vec<usize>> {
    let mut stars = vec![Vec::new(); graph.nodes()];
    for (e, &(i, j)) in graph.edges().iter().enumerate() {
        stars[i as usize].push(e);
        stars[j as usize].push(e);
    }
    stars
}

/// The 16 + m - 1 rows that fix the trivial motions X_e = X + lambda_e I: the sixteen
/// entries of the first transformation, and the trace of every other. (The trace of I is
/// 4, which is not zero in a field of characteristic other than 2.)
fn gauge<R: Ring>(ring: &R, edges: usize) -> SparseRows<R::Elem> {
    let first = (0..16).map(|at| vec![(at, ring.one())]);
    let traces = (1..edges).map(|e| (0..4).map(|a| (16 * e + entry(a, a), ring.one())).collect());
    first.chain(traces).collect()
}

/// Cameras without pairs: 11 dimensions each that no transformation sees.
fn unseen(graph: &Graph) -> usize {
    11 * stars(graph).iter().filter(|star| star.is_empty()).count()
}

/// The links of every node, then the gauge.
fn matrix<F: Field>(
    field: &F,
    graph: &Graph,
    cameras: &[Camera<F::Elem>],
    equations: impl Fn(&F, &[F::Elem; 4]) -> SparseRows<F::Elem>,
    pairs: impl Fn(&[usize]) -> Vec<(usize, usize)>,
) -> SparseRows<F::Elem> {
    assert_eq!(cameras.len(), graph.nodes(), "one camera a node");
    let mut rows = Vec::new();
    for (star, camera) in stars(graph).iter().zip(cameras) {
        let pairs = pairs(star);
        if !pairs.is_empty() {
            let link = equations(field, &centre(field, camera));
            for pair in pairs {
                rows.extend(between(field, &link, pair));
            }
        }
    }
    rows.extend(gauge(field, graph.edges().len()));
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use viewcert::geometry::jacobian::dense;
    use viewcert::linalg::matrix::Matrix;
    use viewcert::linalg::prime::PrimeField;
    use viewcert::linalg::rational::Rational;
    use viewcert::linalg::rational::Rationals;
    use viewcert::linalg::textbook;

    /// The rank of equations, and whether the five dimensions lambda I + c w^T solve them.
    fn check<F: Field>(field: &F, c: &[F::Elem; 4], rows: &SparseRows<F::Elem>) -> usize {
        let matrix = dense(field, rows, 16);
        for solution in 0..5 {
            let m = Matrix::from_fn(16, 1, |at, _| {
                let (a, k) = (at / 4, at % 4);
                match solution {
                    4 => field.from_i64(i64::from(a == k)),
                    w if w == k => c[a].clone(),
                    _ => field.zero(),
                }
            });
            for i in 0..matrix.rows() {
                let terms = (0..16).map(|at| field.mul(&matrix[(i, at)], &m[(at, 0)]));
                let sum = terms.fold(field.zero(), |sum, x| field.add(&sum, &x));
                assert!(field.is_zero(&sum), "equation {i}");
            }
        }
        assert!(rows.iter().all(|row| row.is_sorted_by(|x, y| x.0 < y.0)));
        textbook::eliminate(field, &matrix).rank()
    }

    proptest! {
        /// Both sets have rank 11 = 16 - 5, whichever coordinates vanish, modulo small
        /// primes as well.
        #[test]
        fn rank_eleven(values in prop::array::uniform4(-9..=9i64), zeros in 0..16u8, p in 0..4usize) {
            let values: [i64; 4] =
                std::array::from_fn(|k| if zeros >> k & 1 == 1 { 0 } else { values[k] });
            let c: [Rational; 4] = values.map(|x| Rationals.from_i64(x));
            if values.iter().any(|&x| x != 0) {
                prop_assert_eq!(check(&Rationals, &c, &twenty(&Rationals, &c)), 11);
                prop_assert_eq!(check(&Rationals, &c, &eleven(&Rationals, &c)), 11);
                prop_assert_eq!(eleven(&Rationals, &c).len(), 11);
                prop_assert_eq!(twenty(&Rationals, &c).len(), 20);
            }
            let field = PrimeField::new([5, 7, 11, 2_305_843_009_213_693_951][p]).unwrap();
            let c = values.map(|x| field.from_i64(x));
            if c.iter().any(|x| !field.is_zero(x)) {
                prop_assert_eq!(check(&field, &c, &twenty(&field, &c)), 11);
                prop_assert_eq!(check(&field, &c, &eleven(&field, &c)), 11);
            }
        }
    }
}
