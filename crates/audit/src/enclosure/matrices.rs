//! The matrices of the literature at given cameras, rounded (docs/theory.md, section 16).
//!
//! In: a graph and the centres, or cameras, of its nodes. Out: the Jacobian whose smallest singular values
//! people compute, its cameras and fundamental matrices scaled to one norm.

use super::rounded::{BITS, Factor, Rounded, power};
use std::collections::VecDeque;
use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian;
use viewcert::geometry::jacobian::reference;
use viewcert::graph::Graph;
use viewcert::here::Centres;
use viewcert::linalg::integer::{Integer, Integers};
use viewcert::linalg::rational::Rational;

/// Columns at most: some 4 GiB, and hours.
const COLUMNS: usize = 12_000;

/// A matrix of the literature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Matrix {
    /// Projective: the Jacobian J_P of the paper, 10m x 12n.
    Plain,
    /// Projective: the paper's J, with n + 15 rows that fix frame and scales.
    Augmented,
    /// Calibrated: rows (I - g g^T)(y_i - y_j), g the direction of the pair, 3m x 3n. With the cross product by
    /// g in the place of I - g g^T the singular values are the same; their squares are the eigenvalues of the bearing Laplacian.
    Bearing,
    /// The same with each pair's rows divided by its length: the bearing rigidity matrix.
    BearingByLength,
}

impl Matrix {
    /// All of them.
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

    /// The place of the singular value that is looked at, from the smallest on: one more than the dimension of
    /// the trivial motions.
    pub fn place(self, nodes: usize) -> usize {
        match self {
            Self::Plain => nodes + 16,
            Self::Augmented => 1,
            Self::Bearing | Self::BearingByLength => 5,
        }
    }

    /// The most cameras that are enclosed, if a graph has more.
    pub fn too_large(self, graph: &Graph) -> Option<usize> {
        let most = match self {
            Self::Plain | Self::Augmented => COLUMNS / 12,
            Self::Bearing | Self::BearingByLength => COLUMNS / 3,
        };
        (graph.nodes() > most).then_some(most)
    }

    /// Rounded; nothing if it takes cameras and there are centres alone. O(m) operations with integers.
    pub(super) fn rounded(
        self,
        graph: &Graph,
        centres: &Centres,
        norm: &Rational,
    ) -> Option<Rounded> {
        let order = envelope_order(graph);
        match self {
            Self::Plain | Self::Augmented => {
                let cameras = centres.cameras()?;
                let mut found = projective(graph, cameras, &order, norm);
                if self == Self::Augmented {
                    found.trivial.clear();
                    // Norms from 0.1 to 1e9 leave beta between 40 and 105.
                    let one = 1i128 << found.beta;
                    let rows = jacobian::gauge(&Integers, graph, reference(graph));
                    found.rows.extend(rows.iter().map(|row| {
                        let entry =
                            |(k, _): &(usize, Integer)| (12 * order[k / 12] + (k % 12) as u32, one);
                        row.iter().map(entry).collect()
                    }));
                }
                Some(found)
            }
            Self::Bearing | Self::BearingByLength => Some(bearing(
                graph,
                centres.places(),
                &order,
                self == Self::BearingByLength,
            )),
        }
    }
}

/// The place of each node in an order in which neighbours stand near each other (Cuthill and McKee 1969, reversed).
fn envelope_order(graph: &Graph) -> Vec<u32> {
    let n = graph.nodes();
    let mut neighbours = vec![Vec::new(); n];
    for &(i, j) in graph.edges() {
        neighbours[i as usize].push(j);
        neighbours[j as usize].push(i);
    }
    let degree: Vec<usize> = neighbours.iter().map(Vec::len).collect();
    for list in &mut neighbours {
        list.sort_by_key(|&v| degree[v as usize]);
    }
    let mut by_degree: Vec<u32> = (0..n as u32).collect();
    by_degree.sort_by_key(|&v| degree[v as usize]);
    let (mut place, mut seen, mut count) = (vec![0; n], vec![false; n], n as u32);
    for start in by_degree {
        let mut queue = VecDeque::from([start]);
        while let Some(v) = queue.pop_front() {
            if std::mem::replace(&mut seen[v as usize], true) {
                continue;
            }
            count -= 1;
            place[v as usize] = count;
            queue.extend(&neighbours[v as usize]);
        }
    }
    place
}

fn squares<'a>(entries: impl IntoIterator<Item = &'a Integer>) -> Integer {
    let entries = entries.into_iter();
    entries.fold(Integer::zero(), |sum, x| sum.add(&x.mul(x)))
}

fn float(x: i128) -> f64 {
    x as f64
}

/// J_P at cameras, where all P_v and F_ij have one Frobenius norm.
fn projective(graph: &Graph, cameras: &[[Integer; 12]], order: &[u32], norm: &Rational) -> Rounded {
    // An entry is 2 |P| |F| = 2 norm^2 at most.
    let squared = [norm.numerator(), norm.denominator()].map(|x| x.mul(x));
    let size = squared[0].bits() as i64 + 2 - squared[1].bits() as i64;
    let beta = BITS as i64 - size;
    let fourth = squared.each_ref().map(|x| x.mul(x));
    let matrices: Vec<Camera<Integer>> = cameras
        .iter()
        .map(|p| std::array::from_fn(|r| std::array::from_fn(|c| p[4 * r + c].clone())))
        .collect();
    let of_cameras: Vec<Integer> = cameras.iter().map(squares).collect();
    let mut rows = Vec::with_capacity(10 * graph.edges().len());
    for &(i, j) in graph.edges() {
        let ends = [i as usize, j as usize];
        let [p_i, p_j] = ends.map(|v| &matrices[v]);
        let f = jacobian::fundamental(&Integers, p_i, p_j);
        let of_f = squares(f.iter().flatten());
        // The columns of a camera are those of F times the other camera.
        let factors = [1, 0].map(|other| {
            let below = of_f.mul(&of_cameras[ends[other]]).mul(&fourth[1]);
            Factor::new(&fourth[0], &below, beta)
        });
        let first = rows.len();
        rows.resize_with(first + jacobian::VECH.len(), Vec::new);
        jacobian::edge_rows(&Integers, p_i, p_j, &f, |row, column, entry| {
            if !entry.is_zero() {
                let end = column / 12;
                let place = 12 * order[ends[end]] + (column % 12) as u32;
                rows[first + row].push((place, factors[end].times(&entry)));
            }
        });
    }
    Rounded {
        columns: 12 * graph.nodes(),
        rows,
        beta,
        trivial: trivial(cameras, &of_cameras, order),
    }
}

/// The scales of the cameras, and the changes of frame but one.
fn trivial(cameras: &[[Integer; 12]], squares: &[Integer], order: &[u32]) -> Vec<Vec<f64>> {
    let scaled: Vec<[f64; 12]> = cameras
        .iter()
        .zip(squares)
        .map(|(p, square)| {
            let factor = Factor::new(&Integer::one(), square, 60);
            p.each_ref().map(|x| float(factor.times(x)) / 2f64.powi(60))
        })
        .collect();
    let columns = 12 * cameras.len();
    let mut all = Vec::new();
    for (p, &place) in scaled.iter().zip(order) {
        let mut vector = vec![0.0; columns];
        for (k, x) in p.iter().enumerate() {
            vector[12 * place as usize + 3 * (k % 4) + k / 4] = *x;
        }
        all.push(vector);
    }
    // X = (entry (a, b) alone): column b of P X is column a of P. Their sum over a = b is that of all scales.
    for (a, b) in (0..15).map(|k| (k / 4, k % 4)) {
        let mut vector = vec![0.0; columns];
        for (p, &place) in scaled.iter().zip(order) {
            for r in 0..3 {
                vector[12 * place as usize + 3 * b + r] = p[4 * r + a];
            }
        }
        all.push(vector);
    }
    all
}

/// The bearing matrices, at centres that are not at infinity.
fn bearing(graph: &Graph, places: &[[Integer; 4]], order: &[u32], by_length: bool) -> Rounded {
    let ends: Vec<[Integer; 4]> = graph
        .edges()
        .iter()
        .map(|&(i, j)| {
            let [a, b] = [i, j].map(|v| &places[v as usize]);
            let along = |k: usize| a[k].mul(&b[3]).sub(&b[k].mul(&a[3]));
            [along(0), along(1), along(2), a[3].mul(&b[3])]
        })
        .collect();
    // Of the inverse lengths w / |d| the largest says how many bits an entry has.
    let bits = |d: &[Integer; 4]| 2 * d[3].bits() as i64 + 1 - squares(&d[..3]).bits() as i64;
    let size = if by_length {
        ends.iter()
            .map(|d| bits(d).div_euclid(2) + 1)
            .max()
            .unwrap_or(0)
    } else {
        0
    };
    let beta = BITS as i64 - size - 1;
    let mut rows = Vec::with_capacity(3 * ends.len());
    for (&(i, j), d) in graph.edges().iter().zip(&ends) {
        let square = squares(&d[..3]);
        let (above, below) = match by_length {
            true => (d[3].mul(&d[3]), square.mul(&square).mul(&square)),
            false => (Integer::one(), square.mul(&square)),
        };
        let factor = Factor::new(&above, &below, beta);
        for a in 0..3 {
            let entry = |b: usize| {
                let product = d[a].mul(&d[b]).neg();
                factor.times(&if a == b {
                    product.add(&square)
                } else {
                    product
                })
            };
            let entries: [i128; 3] = std::array::from_fn(entry);
            let mut row = Vec::with_capacity(6);
            for (v, sign) in [(i, 1), (j, -1)] {
                let at = 3 * order[v as usize];
                row.extend((at..).zip(entries).map(|(at, x)| (at, sign * x)));
            }
            rows.push(row);
        }
    }
    let mut trivial = vec![vec![0.0; 3 * places.len()]; 4];
    for (place, &at) in places.iter().zip(order) {
        for k in 0..3 {
            let at = 3 * at as usize + k;
            trivial[k][at] = 1.0;
            // Rounded: this only proposes.
            let value = |x: &Integer| x.to_string().parse::<f64>().unwrap_or(0.0);
            trivial[3][at] = value(&place[k]) / value(&place[3]);
        }
    }
    Rounded {
        columns: 3 * places.len(),
        rows,
        beta,
        trivial,
    }
}

/// The norm of the literature.
pub(super) fn default_norm() -> Rational {
    Integer::from(10u64).into()
}

/// x / 2^beta.
pub(super) fn scaled(x: &Integer, beta: i64) -> Rational {
    let unit = power(beta.unsigned_abs());
    let found = match beta {
        0.. => Rational::new(x.clone(), unit),
        _ => Rational::new(x.mul(&unit), Integer::one()),
    };
    found.unwrap_or_else(|| unreachable!("a power of two is not zero"))
}
