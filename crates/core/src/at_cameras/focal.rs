//! Which cameras have a focal length that no pair fixes, where these are unknown and cameras are given.
//!
//! In: a graph, and cameras whose matrices are given. Out: nodes none of whose pairs fixes both focal lengths:
//! the rank of the 7 unknowns of a pair in its fundamental matrix is below 7. It is where the optical axes of
//! the pair lie in one plane (they meet or are parallel), or where the planes through them and the base line are
//! at right angles. The rank modulo a prime proves what it says of a pair that fixes them.

use super::Centres;
use crate::graph::Graph;
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::linalg::textbook::eliminate;

type Rows = [[u64; 3]; 3];

/// The nodes whose focal length no pair fixes; `None` if centres were given and no cameras. Nodes without
/// pairs are among them. O(pairs).
pub fn open_focal_lengths(graph: &Graph, centres: &Centres) -> Option<Vec<u32>> {
    let field = PrimeField::mersenne61();
    let cofactors = centres.cameras()?.iter().map(|camera| {
        let at = |r: usize, c: usize| field.from_integer(&camera[4 * r + c]);
        let rows: Rows = [0, 1, 2].map(|r| [0, 1, 2].map(|c| at(r, c)));
        [0, 1, 2].map(|r| cross(&field, &rows[(r + 1) % 3], &rows[(r + 2) % 3]))
    });
    let cofactors: Vec<Rows> = cofactors.collect();
    let mut fixed = vec![false; graph.nodes()];
    for &(i, j) in graph.edges() {
        let [one, two] = [i, j].map(|v| v as usize);
        let ([x @ .., v], [y @ .., w]) = (&centres.residues[one], &centres.residues[two]);
        let between = [0, 1, 2].map(|k| field.minus(field.times(*v, y[k]), field.times(*w, x[k])));
        if !(fixed[one] && fixed[two])
            && is_fixed(&field, [&cofactors[one], &cofactors[two]], between)
        {
            (fixed[one], fixed[two]) = (true, true);
        }
    }
    let nodes = (0..).zip(fixed);
    Some(
        nodes
            .filter_map(|(v, fixed)| (!fixed).then_some(v))
            .collect(),
    )
}

/// Whether a pair fixes both focal lengths: F = A_2 [t] A_1^T of the cofactors A and the base line t has rank 7
/// in them, three turns of one camera and three steps, of which that along t scales it.
fn is_fixed(field: &PrimeField, [one, two]: [&Rows; 2], between: [u64; 3]) -> bool {
    let zero = field.from_u64(0);
    let unit = |k: usize| -> [u64; 3] { [0, 1, 2].map(|c| field.from_u64(u64::from(c == k))) };
    let skew = |v: [u64; 3]| -> Rows { [0, 1, 2].map(|k| cross(field, &unit(k), &v)) };
    let times = |a: &Rows, b: &Rows, transposed: bool| -> Rows {
        let column = |c: usize| [0, 1, 2].map(|k| if transposed { b[c][k] } else { b[k][c] });
        a.map(|row| [0, 1, 2].map(|c| field.dot(0, &row, &column(c))))
    };
    let line = skew(between);
    let found = times(&times(two, &line, false), one, true);
    let turned = |k: usize| {
        times(
            &times(&times(two, &skew(unit(k)), false), &line, false),
            one,
            true,
        )
    };
    let moved = |k: usize| times(&times(two, &skew(unit(k)), false), one, true);
    let of_focal = [
        [[zero; 3], [zero; 3], found[2]],
        found.map(|row| [zero, zero, row[2]]),
    ];
    let all = (0..3).map(turned).chain((0..3).map(moved)).chain(of_focal);
    let data: Vec<u64> = all.flat_map(|rows| rows.concat()).collect();
    eliminate(field, &Matrix::new(8, 9, data)).rank() == 8
}

fn cross(field: &PrimeField, a: &[u64; 3], b: &[u64; 3]) -> [u64; 3] {
    let minor = |p: usize, q: usize| field.minus(field.times(a[p], b[q]), field.times(a[q], b[p]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}
