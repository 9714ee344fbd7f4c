//! The published formulation for affine cameras: a matrix with 4 m + 12 rows and 8 n columns that
//! has full column rank exactly for affine solvable graphs (docs/theory.md, Theorem 13.2).
//!
//! Its unknowns are the entries of the cameras [A t]. An affine fundamental matrix fixes, up to a
//! factor, the left null vector (b_i, b_j) of [A_i; A_j] and b_i t_i + b_j t_j, which gives four
//! linear equations an edge; twelve more rows fix the affine frame.

use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::Graph;
use viewcert::linalg::Ring;

/// Where it was published.
pub const SOURCE: &str = "Solvability of the Viewing Graph under the Affine Camera Model, 2026";

/// An affine camera: the rows of [A t].
pub type AffineCamera<E> = [[E; 4]; 2];

/// Rows and columns.
pub fn size(graph: &Graph) -> (usize, usize) {
    (4 * graph.edges().len() + 12, 8 * graph.nodes())
}

/// The viewing direction ker A: the vector product of the rows of A; zero if their rank is below 2.
pub fn direction<F: Ring>(field: &F, camera: &AffineCamera<F::Elem>) -> [F::Elem; 3] {
    let [a, b] = camera;
    std::array::from_fn(|k| {
        let (r, s) = ((k + 1) % 3, (k + 2) % 3);
        field.sub(&field.mul(&a[r], &b[s]), &field.mul(&a[s], &b[r]))
    })
}

/// The left null vector (b_i, b_j) of [A_i; A_j]: up to sign its 3 x 3 minors. It is zero if the
/// viewing directions coincide.
pub fn left_null_vector<F: Ring>(
    field: &F,
    i: &AffineCamera<F::Elem>,
    j: &AffineCamera<F::Elem>,
) -> [[F::Elem; 2]; 2] {
    let dot = |row: &[F::Elem; 4], direction: &[F::Elem; 3]| {
        let terms = row.iter().zip(direction);
        terms.fold(field.zero(), |sum, (x, y)| {
            field.add(&sum, &field.mul(x, y))
        })
    };
    let [from_i, from_j] = [i, j].map(|camera| direction(field, camera));
    // The minor without a row of A_i is that row's partner times the direction of j, and so on.
    [
        [dot(&i[1], &from_j), field.neg(&dot(&i[0], &from_j))],
        [dot(&j[1], &from_i), field.neg(&dot(&j[0], &from_i))],
    ]
}

/// The fundamental matrix by Lemma 13.1: b_j in the last column, b_i in the last row, and
/// -(b_i t_i + b_j t_j) in the corner.
pub fn fundamental<F: Ring>(
    field: &F,
    i: &AffineCamera<F::Elem>,
    j: &AffineCamera<F::Elem>,
) -> [[F::Elem; 3]; 3] {
    let [at_i, at_j] = left_null_vector(field, i, j);
    let terms = [(&at_i, i), (&at_j, j)].into_iter();
    let terms = terms.flat_map(|(b, camera)| b.iter().zip(camera));
    let sum = terms.fold(field.zero(), |sum, (x, row)| {
        field.add(&sum, &field.mul(x, &row[3]))
    });
    let [b0, b1] = at_i;
    let [c0, c1] = at_j;
    [
        [field.zero(), field.zero(), c0],
        [field.zero(), field.zero(), c1],
        [b0, b1, field.neg(&sum)],
    ]
}

/// Whether the rows of all A are independent, viewing directions differ on edges, and the rows that
/// fix the frame do: generic cameras are always admitted.
pub fn admits<F: Ring>(field: &F, graph: &Graph, cameras: &[AffineCamera<F::Elem>]) -> bool {
    let is_zero = |entries: &[F::Elem]| entries.iter().all(|x| field.is_zero(x));
    let ranks = cameras
        .iter()
        .all(|camera| !is_zero(&direction(field, camera)));
    let edges = graph.edges().iter().all(|&(i, j)| {
        let halves = left_null_vector(field, &cameras[i as usize], &cameras[j as usize]);
        !halves.iter().any(|half| is_zero(half))
    });
    let frame = graph.edges().first().is_none_or(|&(first, second)| {
        // An affine map that keeps the first camera adds a multiple of its direction.
        let direction = direction(field, &cameras[first as usize]);
        let row = cameras[second as usize][0].iter().zip(&direction);
        let dot = row.fold(field.zero(), |sum, (x, y)| {
            field.add(&sum, &field.mul(x, y))
        });
        !field.is_zero(&dot)
    });
    ranks && edges && frame
}

/// R of affine cameras: row e = (i, j) holds b_i in the columns 2i, 2i+1 and b_j in 2j, 2j+1.
///
/// # Panics
/// If there is not one camera a node.
pub fn directions<F: Ring>(
    field: &F,
    graph: &Graph,
    cameras: &[AffineCamera<F::Elem>],
) -> SparseRows<F::Elem> {
    assert_eq!(cameras.len(), graph.nodes(), "one camera a node");
    let row = |&(i, j): &(u32, u32)| {
        let (i, j) = (i as usize, j as usize);
        let [at_i, at_j] = left_null_vector(field, &cameras[i], &cameras[j]);
        let at_i = at_i.into_iter().enumerate().map(|(r, x)| (2 * i + r, x));
        let at_j = at_j.into_iter().enumerate().map(|(r, x)| (2 * j + r, x));
        at_i.chain(at_j)
            .filter(|(_, x)| !field.is_zero(x))
            .collect()
    };
    graph.edges().iter().map(row).collect()
}

/// The matrix. Column `8 v + 4 r + c` belongs to entry (r, c) of [A_v t_v]; rows `4 e + c` say that
/// b_i times column c of camera i and b_j times that of camera j add up to what they are given as;
/// the last twelve rows hold all entries of the first edge's first camera (of node 0 if there is
/// none) and the first row of its second camera.
///
/// # Panics
/// If there is not one camera a node, or there are fewer than two nodes.
pub fn matrix<F: Ring>(
    field: &F,
    graph: &Graph,
    cameras: &[AffineCamera<F::Elem>],
) -> SparseRows<F::Elem> {
    assert!(graph.nodes() >= 2, "a frame takes two cameras");
    let mut rows = Vec::with_capacity(size(graph).0);
    for row in directions(field, graph, cameras) {
        for c in 0..4 {
            let entries = row.iter();
            let entries = entries.map(|(col, x)| (8 * (col / 2) + 4 * (col % 2) + c, x.clone()));
            rows.push(entries.collect());
        }
    }
    let &(first, second) = graph.edges().first().unwrap_or(&(0, 1));
    let fixed = (0..8).map(|k| 8 * first as usize + k);
    let fixed = fixed.chain((0..4).map(|k| 8 * second as usize + k));
    rows.extend(fixed.map(|col| vec![(col, field.one())]));
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formulation::rank::RankField;
    use viewcert::linalg::rational::{Rational, Rationals};

    fn camera(rows: [[i64; 4]; 2]) -> AffineCamera<Rational> {
        rows.map(|row| row.map(|x| Rationals.from_i64(x)))
    }

    /// Cameras [I | -p] with translations: b_i = -b_j is orthogonal to p_i - p_j.
    #[test]
    fn null_vectors_by_hand() {
        let cameras = [
            camera([[1, 0, 0, 5], [0, 1, 0, 7]]),
            camera([[1, 0, -3, 1], [0, 1, -4, 2]]),
        ];
        let [[a, b], [c, d]] = left_null_vector(&Rationals, &cameras[0], &cameras[1]);
        let number = |x| Rationals.from_i64(x);
        // p_1 - p_0 = (3, 4), and (4, -3) is orthogonal to it.
        let scale = if a == number(4) { 1 } else { -1 };
        assert_eq!([a, b], [number(4 * scale), number(-3 * scale)]);
        assert_eq!([c, d], [number(-4 * scale), number(3 * scale)]);
        // Equal viewing directions have no fundamental matrix.
        let parallel = camera([[2, 0, 0, 1], [1, 1, 0, 0]]);
        let zero = left_null_vector(&Rationals, &cameras[0], &parallel);
        assert!(zero.iter().flatten().all(|x| Rationals.is_zero(x)));
    }

    /// Over the rationals: a triangle is solvable, 8 * 3 = 24; the 4-cycle is not, 4 * 4 + 12 of
    /// 32.
    #[test]
    fn a_triangle_and_a_square_over_the_rationals() {
        let cameras = [
            camera([[1, 0, 0, 5], [0, 1, 0, 7]]),
            camera([[1, 2, -3, 1], [0, 1, -4, 2]]),
            camera([[3, 1, 1, 0], [2, 0, 5, 1]]),
            camera([[1, -1, 2, 2], [4, 1, 1, 3]]),
        ];
        let rank = |nodes: u32, pairs: &[(u32, u32)]| {
            let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
            let rows = matrix(&Rationals, &graph, &cameras[..nodes as usize]);
            let (height, width) = size(&graph);
            assert_eq!(rows.len(), height);
            Rationals.rank(rows, width)
        };
        assert_eq!(rank(2, &[(0, 1)]), 16);
        assert_eq!(rank(3, &[(0, 1), (1, 2), (0, 2)]), 24);
        assert_eq!(rank(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]), 28);
    }
}
