//! Plane flows in either field, to be compared with the other formulations: the two
//! matrices N and Lambda as they are eliminated, and
//!
//! ```text
//! rank J_P = 4 rank N + rank Lambda - m
//! ```
//!
//! Modulo a prime this is the verifier's own computation. Over Q it is another: all flows,
//! as integer vectors that are verified to be flows.

use viewcert::geometry::camera::{Camera, centre};

use viewcert::geometry::draw::DrawKey;
use viewcert::geometry::jacobian::SparseRows;
use viewcert::geometry::plane_flow::{PlaneFlows, cotree, directions, rigidity_rows};
use viewcert::graph::Graph;
use viewcert::linalg::Field;
use viewcert::linalg::Ring;
use viewcert::linalg::dixon::{IntegerRow, rank_exact};
use viewcert::linalg::integer::{Division, Integer, Integers, One, Zero, content};
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::rational::Rational;
use viewcert::watch::unwatched;

/// The two matrices, eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlaneRanks {
    /// N.
    pub rigidity: Shape,
    /// Lambda without the columns of a spanning forest, and with the rows of as many flows
    /// as were taken.
    pub lambda: Shape,
}

/// What is reported of a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Rows and columns.
    pub size: (usize, usize),
    /// Entries that are not zero.
    pub nonzeros: usize,
    /// The rank.
    pub rank: usize,
}

impl PlaneRanks {
    /// The rank of J_P at the same cameras.
    pub fn rank(&self, edges: usize) -> usize {
        4 * self.rigidity.rank + self.lambda.rank - edges
    }
}

/// Whether all centres lie in the affine chart x_4 = 1, where N is written down.
pub fn admits<F: Field>(field: &F, cameras: &[Camera<F::Elem>]) -> bool {
    cameras
        .iter()
        .all(|camera| !field.is_zero(&centre(field, camera)[3]))
}

/// Below this prime a basis of all flows is taken. From here on as many random flows as the
/// verifier takes, which miss a part of Lambda with probability below 2^-59: either all
/// flows were asked for and the drawn ones are dependent, 1 / (p - 1), or two flows or more
/// fell into a proper subspace, 1 / p^2.
const FEW_FLOWS: u64 = 1 << 60;

/// Modulo a prime, by the verifier's elimination; below 2^60, where its random flows might
/// miss a part of Lambda, by all flows. O(n^3) at worst for N, and O((m - n) m^2) for
/// Lambda.
///
/// # Panics
/// If there is not one camera a node, a centre is not [admitted](admits), or those of an
/// edge coincide.
pub fn modular(
    field: &PrimeField,
    graph: &Graph,
    cameras: &[Camera<u64>],
    key: &DrawKey,
) -> PlaneRanks {
    let affine = |camera| {
        let [x, y, z, last] = centre(field, camera);
        let inverse = field.inv(&last).expect("the centre is in the chart");
        [x, y, z].map(|x| field.mul(&x, &inverse))
    };
    let centres: Vec<[u64; 3]> = cameras.iter().map(affine).collect();
    let flows = unwatched(|task| PlaneFlows::new(field, graph, &centres, task));
    let lambda = unwatched(|task| {
        if field.modulus() < FEW_FLOWS {
            flows.lambda_of_all_flows(task)
        } else {
            flows.lambda(key.flow_weights(field), task)
        }
    });
    let nonzeros = |rows: &SparseRows<u64>| rows.iter().map(Vec::len).sum();
    PlaneRanks {
        rigidity: Shape {
            size: (2 * graph.edges().len(), 3 * graph.nodes()),
            nonzeros: nonzeros(&rigidity_rows(field, graph, &centres)),
            rank: flows.rigidity_rank(),
        },
        lambda: Shape {
            size: lambda.size(),
            nonzeros: lambda.nonzeros(),
            rank: lambda.rank(),
        },
    }
}

/// A point in homogeneous integer coordinates without a common divisor.
fn homogeneous(camera: &Camera<Rational>) -> [Integer; 4] {
    let rows = camera.each_ref().map(whole);
    let point = centre(&Integers, &rows);
    let gcd = content(&point);
    point.map(|x| x / &gcd)
}

/// The multiple of a row that has integer entries: a camera with its rows scaled has the
/// same centre.
fn whole(row: &[Rational; 4]) -> [Integer; 4] {
    let lcm = row.iter().fold(Integer::one(), |lcm, x| lcm.lcm(x.denom()));
    row.each_ref().map(|x| x.numer() * (&lcm / x.denom()))
}

/// Two integer directions orthogonal to the difference of two centres.
fn integer_directions(ci: &[Integer; 4], cj: &[Integer; 4]) -> [[Integer; 3]; 2] {
    let d: [Integer; 3] = std::array::from_fn(|k| &ci[k] * &cj[3] - &cj[k] * &ci[3]);
    let gcd = content(&d);
    assert!(!gcd.is_zero(), "centres are distinct");
    let d = d.map(|x| x / &gcd);
    let zero = std::array::from_fn(|_| Integer::zero());
    directions(&Integers, &d, &zero).expect("the difference is not zero")
}

/// Over Q: rank and left kernel of N, and the rank of Lambda, each by [`rank_exact`], whose
/// cost it is.
///
/// # Panics
/// As for [`modular`].
pub fn rational(graph: &Graph, cameras: &[Camera<Rational>]) -> PlaneRanks {
    let centres: Vec<[Integer; 4]> = cameras.iter().map(homogeneous).collect();
    let at = |v: u32| &centres[v as usize];
    let both: Vec<[[Integer; 3]; 2]> = graph
        .edges()
        .iter()
        .map(|&(i, j)| integer_directions(at(i), at(j)))
        .collect();

    // N by columns, so that the kernel is that of the rows.
    let (edges, nodes) = (graph.edges().len(), graph.nodes());
    let mut columns: Vec<IntegerRow> = vec![Vec::new(); 3 * nodes];
    for (e, (&(i, j), both)) in graph.edges().iter().zip(&both).enumerate() {
        for (t, a) in both.iter().enumerate() {
            for (k, x) in a.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
                columns[3 * i as usize + k].push((2 * e + t, x.clone()));
                columns[3 * j as usize + k].push((2 * e + t, -x));
            }
        }
    }
    let nonzeros = columns.iter().map(Vec::len).sum();
    let transposed = unwatched(|task| rank_exact(&columns, 2 * edges, task));

    let cotree = cotree(graph);
    let mut rows = Vec::with_capacity(4 * transposed.kernel().len());
    for weights in transposed.kernel() {
        let normal = |e: usize| -> [Integer; 3] {
            let (s, t) = (&weights[2 * e], &weights[2 * e + 1]);
            std::array::from_fn(|k| s * &both[e][0][k] + t * &both[e][1][k])
        };
        let normals: Vec<[Integer; 3]> = cotree.iter().map(|&e| normal(e)).collect();
        for k in 0..3 {
            rows.push(sparse(normals.iter().map(|omega| omega[k].clone())));
        }
        // omega . c_j with c_j over its last coordinate: one denominator for the row.
        let ends: Vec<&[Integer; 4]> = cotree.iter().map(|&e| at(graph.edges()[e].1)).collect();
        let lcm = ends.iter().fold(Integer::one(), |lcm, c| lcm.lcm(&c[3]));
        rows.push(sparse(normals.iter().zip(ends).map(|(omega, c)| {
            let dot = (0..3).fold(Integer::zero(), |sum, k| sum + &omega[k] * &c[k]);
            dot * (&lcm / &c[3])
        })));
    }
    PlaneRanks {
        rigidity: Shape {
            size: (2 * edges, 3 * nodes),
            nonzeros,
            rank: transposed.rank(),
        },
        lambda: Shape {
            size: (rows.len(), cotree.len()),
            nonzeros: rows.iter().map(Vec::len).sum(),
            rank: unwatched(|task| rank_exact(&rows, cotree.len(), task)).rank(),
        },
    }
}

fn sparse(row: impl Iterator<Item = Integer>) -> IntegerRow {
    row.enumerate().filter(|(_, x)| !x.is_zero()).collect()
}
