//! The paper's formulation: S = P_j^T F_ij P_i is skew-symmetric.
//!
//! For fixed fundamental matrices, Phi_ij = vech(S + S^T) = 0 is ten equations an edge in
//! the cameras. Their Jacobian J_P decides finite solvability by its rank 11n - 15
//! (Theorem 1 of the paper).
//!
//! # Rows and columns
//!
//! * Column `12 v + 3 c + r` belongs to entry (r, c) of camera v: cameras are vectorised
//!   column by column.
//! * Row `10 e + t` belongs to entry t of vech(S + S^T) on edge e, the lower triangle
//!   column by column: (0,0), (1,0), (2,0), (3,0), (1,1), (2,1), (3,1), (2,2), (3,2), (3,3).
//! * Edges are numbered as in the graph, (i, j) with i < j.

use crate::geometry::camera::Camera;
use crate::graph::Graph;
use crate::linalg::Ring;
use crate::linalg::matrix::Matrix;

/// The places of the lower triangle in the order of vech.
pub const VECH: [(usize, usize); 10] = [
    (0, 0),
    (1, 0),
    (2, 0),
    (3, 0),
    (1, 1),
    (2, 1),
    (3, 1),
    (2, 2),
    (3, 2),
    (3, 3),
];

/// Rows of a matrix as `(column, entry)` with ascending columns and no zeros.
pub type SparseRows<E> = Vec<Vec<(usize, E)>>;

/// The fundamental matrix of cameras P_i, P_j by the paper's equation (2): entry (h, k)
/// is (-1)^(h+k) times the determinant of P_i without row k above P_j without row h.
/// It is zero exactly when the centres coincide (for cameras of rank 3).
pub fn fundamental<R: Ring>(
    ring: &R,
    p_i: &Camera<R::Elem>,
    p_j: &Camera<R::Elem>,
) -> [[R::Elem; 3]; 3] {
    let planes_i: [[R::Elem; 6]; 3] = std::array::from_fn(|k| two_rows(ring, p_i, k));
    let planes_j: [[R::Elem; 6]; 3] = std::array::from_fn(|h| two_rows(ring, p_j, h));
    std::array::from_fn(|h| {
        std::array::from_fn(|k| {
            // Laplace expansion along the first two rows; complementary pairs of columns
            // stand at mirrored places, with signs + - + + - +.
            let (a, b) = (&planes_i[k], &planes_j[h]);
            // From left to right, which matters where numbers are rounded.
            let term = |m: usize| ring.mul(&a[m], &b[5 - m]);
            let determinant = (1..6).fold(term(0), |sum, m| match m {
                1 | 4 => ring.sub(&sum, &term(m)),
                _ => ring.add(&sum, &term(m)),
            });
            if (h + k) % 2 == 0 {
                determinant
            } else {
                ring.neg(&determinant)
            }
        })
    })
}

/// The 2 x 2 minors of a camera without one row, for the columns 01, 02, 03, 12, 13, 23.
fn two_rows<R: Ring>(ring: &R, camera: &Camera<R::Elem>, omitted: usize) -> [R::Elem; 6] {
    let (p, q) = match omitted {
        0 => (&camera[1], &camera[2]),
        1 => (&camera[0], &camera[2]),
        _ => (&camera[0], &camera[1]),
    };
    [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
        .map(|(k, l)| ring.sub(&ring.mul(&p[k], &q[l]), &ring.mul(&p[l], &q[k])))
}

/// vech(S + S^T) for S = P_j^T F P_i.
#[cfg(test)]
pub(crate) fn phi<R: Ring>(
    ring: &R,
    p_i: &Camera<R::Elem>,
    p_j: &Camera<R::Elem>,
    f: &[[R::Elem; 3]; 3],
) -> [R::Elem; 10] {
    let left = transfer(ring, p_j, |h, k| &f[h][k]);
    let s = |r: usize, c: usize| sum(ring, |k| ring.mul(&left[r][k], &p_i[k][c]));
    VECH.map(|(r, c)| ring.add(&s(r, c), &s(c, r)))
}

/// The 4 x 3 matrix P^T M.
fn transfer<'a, R: Ring>(
    ring: &R,
    camera: &Camera<R::Elem>,
    m: impl Fn(usize, usize) -> &'a R::Elem,
) -> [[R::Elem; 3]; 4]
where
    R::Elem: 'a,
{
    std::array::from_fn(|r| {
        std::array::from_fn(|k| sum(ring, |h| ring.mul(&camera[h][r], m(h, k))))
    })
}

fn sum<R: Ring>(ring: &R, term: impl Fn(usize) -> R::Elem) -> R::Elem {
    ring.add(&ring.add(&term(0), &term(1)), &term(2))
}

/// The rows of J_P of one edge with fundamental matrix `f`, which may be any multiple of
/// [`fundamental`]: the paper's equations (blockA) and (blockB).
///
/// `put` is called with the row (below 10), the column (below 12 for the first camera, from
/// 12 to 23 for the second) and the entry, row by row with ascending columns; entries of
/// one row at 12 places at most, zeros among them.
pub fn edge_rows<R: Ring>(
    ring: &R,
    p_i: &Camera<R::Elem>,
    p_j: &Camera<R::Elem>,
    f: &[[R::Elem; 3]; 3],
    mut put: impl FnMut(usize, usize, R::Elem),
) {
    // S = A P_i with A = P_j^T F, and S^T = B P_j with B = P_i^T F^T: the entry of
    // S + S^T at (r, c) moves with column c of a camera as row r of A or B, and with
    // column r as row c.
    let a = transfer(ring, p_j, |h, k| &f[h][k]);
    let b = transfer(ring, p_i, |h, k| &f[k][h]);
    for (row, (r, c)) in VECH.into_iter().enumerate() {
        for (start, block) in [(0, &a), (12, &b)] {
            let mut put_column = |column: usize, entries: [R::Elem; 3]| {
                for (place, entry) in (start + 3 * column..).zip(entries) {
                    put(row, place, entry);
                }
            };
            if r == c {
                put_column(c, block[r].each_ref().map(|entry| ring.add(entry, entry)));
            } else {
                // r > c in the lower triangle, so the columns ascend.
                put_column(c, block[r].clone());
                put_column(r, block[c].clone());
            }
        }
    }
}

/// J_P, the 10m x 12n Jacobian of Phi with respect to all cameras, as sparse rows:
/// [`edge_rows`] of every edge. A row has at most 12 entries.
///
/// # Panics
/// If there is not one camera a node.
pub fn jacobian<R: Ring>(
    ring: &R,
    graph: &Graph,
    cameras: &[Camera<R::Elem>],
) -> SparseRows<R::Elem> {
    assert_eq!(cameras.len(), graph.nodes(), "one camera a node");
    let mut rows = Vec::with_capacity(10 * graph.edges().len());
    for &(i, j) in graph.edges() {
        let (i, j) = (i as usize, j as usize);
        let (p_i, p_j) = (&cameras[i], &cameras[j]);
        let f = fundamental(ring, p_i, p_j);
        let first = rows.len();
        rows.resize_with(first + VECH.len(), || Vec::with_capacity(12));
        edge_rows(ring, p_i, p_j, &f, |row, column, entry| {
            if !ring.is_zero(&entry) {
                let node = if column < 12 { i } else { j };
                rows[first + row].push((12 * node + column % 12, entry));
            }
        });
    }
    rows
}

/// The pair that fixes the projective frame: of the edges at a node of highest degree the
/// one whose other end has the highest degree; the first node, and then the first edge,
/// among equals. 0 for a graph without edges.
pub fn reference(graph: &Graph) -> usize {
    let mut degree = vec![0usize; graph.nodes()];
    for &(i, j) in graph.edges() {
        degree[i as usize] += 1;
        degree[j as usize] += 1;
    }
    let top = degree.iter().copied().max().unwrap_or(0);
    let Some(first) = degree.iter().position(|&d| d == top) else {
        return 0;
    };
    let other = |&(i, j): &(u32, u32)| match (i as usize == first, j as usize == first) {
        (true, _) => Some(degree[j as usize]),
        (_, true) => Some(degree[i as usize]),
        _ => None,
    };
    let mut best = (0, 0);
    for (e, edge) in graph.edges().iter().enumerate() {
        if let Some(degree) = other(edge).filter(|&degree| degree > best.0) {
            best = (degree, e);
        }
    }
    best.1
}

/// The rows of the paper's section 4.1 that remove the trivial motions; below J_P they
/// make J, of 10m + n + 15 rows, with rank J = rank J_P + n + 15 at generic cameras.
///
/// The first 12 rows fix the first camera of edge number `reference`, the next 4 the first
/// row of its second camera, and n - 1 rows the sum of the entries of every camera but the
/// first, in order of the nodes.
///
/// # Panics
/// If the graph has no such edge.
pub fn gauge<R: Ring>(ring: &R, graph: &Graph, reference: usize) -> SparseRows<R::Elem> {
    let (first, second) = graph.edges()[reference];
    let (first, second) = (first as usize, second as usize);
    let camera = (0..12).map(|k| vec![(12 * first + k, ring.one())]);
    let row = (0..4).map(|col| vec![(12 * second + 3 * col, ring.one())]);
    let others = (0..graph.nodes()).filter(|&node| node != first);
    let scales = others.map(|node| (0..12).map(|k| (12 * node + k, ring.one())).collect());
    camera.chain(row).chain(scales).collect()
}

/// The augmented Jacobian J: [`jacobian`] above [`gauge`].
///
/// # Panics
/// If there is not one camera a node, or no such edge.
pub fn augmented<R: Ring>(
    ring: &R,
    graph: &Graph,
    cameras: &[Camera<R::Elem>],
    reference: usize,
) -> SparseRows<R::Elem> {
    let mut rows = jacobian(ring, graph, cameras);
    rows.extend(gauge(ring, graph, reference));
    rows
}

/// The dense matrix with the given sparse rows and `cols` columns.
///
/// # Panics
/// If an entry lies beyond the last column.
pub fn dense<R: Ring>(ring: &R, rows: &SparseRows<R::Elem>, cols: usize) -> Matrix<R::Elem> {
    let mut matrix = Matrix::from_fn(rows.len(), cols, |_, _| ring.zero());
    for (i, row) in rows.iter().enumerate() {
        for (col, entry) in row {
            matrix[(i, *col)] = entry.clone();
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::camera::normal_form;
    use crate::geometry::draw::{DrawKey, cameras_mod, cameras_rational, centres_mod};
    use crate::linalg::dense_lu::eliminate_mod;
    use crate::linalg::integer::{Integer, Integers};
    use crate::linalg::prime::{DEFAULT_PRIME, PrimeField};
    use crate::linalg::sparse_lu::Factorisation;
    use crate::linalg::{bareiss, textbook};
    use crate::watch::unwatched;
    use proptest::prelude::*;

    #[test]
    fn the_reference_joins_nodes_of_highest_degree() {
        // Node 3 has degree 4; of its neighbours 4 has degree 3, the others 1 or 2.
        let graph = graph(6, &[(0, 3), (1, 3), (2, 3), (3, 4), (2, 4), (4, 5)]);
        assert_eq!(graph.edges()[reference(&graph)], (3, 4));
    }

    fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
        Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
    }

    fn complete(nodes: u32) -> Graph {
        let pairs = (0..nodes)
            .flat_map(|j| (0..j).map(move |i| (i, j)))
            .collect();
        Graph::from_pairs(nodes, pairs).unwrap().0
    }

    fn key(seed: u64) -> DrawKey {
        DrawKey {
            graph_sha256: [0; 32],
            core_sha256: None,
            seed,
            draw: 0,
        }
    }

    fn modular(field: &PrimeField, graph: &Graph, seed: u64) -> Vec<Camera<u64>> {
        cameras_mod(field, graph.nodes(), &key(seed))
            .unwrap()
            .values
    }

    fn rational(graph: &Graph, seed: u64) -> Vec<Camera<Integer>> {
        cameras_rational(graph.nodes(), 10, 4, &key(seed))
            .unwrap()
            .values
    }

    /// Ranks by Theorem 1 and by counting: 11n - 15 for what is solvable, 7 for an edge,
    /// and sums over blocks that share one node or none; the 4-cycle has 4 edges, one too
    /// few for 11 * 4 - 15 = 29.
    fn known() -> Vec<(Graph, usize)> {
        vec![
            (graph(2, &[(0, 1)]), 7),
            (complete(3), 18),
            (complete(4), 29),
            (graph(4, &[(0, 1), (1, 2), (0, 2), (1, 3), (2, 3)]), 29),
            (graph(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]), 28),
            (
                graph(5, &[(0, 1), (0, 2), (1, 2), (2, 3), (3, 4), (2, 4)]),
                36,
            ),
            (graph(4, &[(0, 1), (2, 3)]), 14),
            (graph(3, &[]), 0),
        ]
    }

    #[test]
    fn known_ranks() {
        let field = PrimeField::mersenne61();
        for (graph, rank) in known() {
            let cols = 12 * graph.nodes();
            let rows = jacobian(&field, &graph, &modular(&field, &graph, 1));
            assert_eq!(rows.len(), 10 * graph.edges().len());
            let matrix = dense(&field, &rows, cols);
            assert_eq!(
                textbook::eliminate(&field, &matrix).rank(),
                rank,
                "{graph:?}"
            );
            assert_eq!(
                unwatched(|task| eliminate_mod(&field, matrix, task)).rank(),
                rank,
                "{graph:?}"
            );
            assert_eq!(
                unwatched(|task| Factorisation::new(&field, rows, cols, task)).rank(),
                rank,
                "{graph:?}"
            );

            let rows = jacobian(&Integers, &graph, &rational(&graph, 1));
            let matrix = dense(&Integers, &rows, cols);
            let done = unwatched(|task| bareiss::eliminate(matrix, task));
            assert_eq!(done.pivots().rank(), rank, "{graph:?}");
        }
    }

    #[test]
    fn normal_form_has_the_same_rank() {
        for (graph, rank) in known() {
            let small = PrimeField::new(101).unwrap();
            let centres = centres_mod(&small, graph.nodes(), &key(3)).unwrap().values;
            let cameras: Vec<_> = centres
                .iter()
                .map(|c| normal_form(&Integers, &c.map(|x| Integer::from(small.to_u64(x)))))
                .collect();
            let rows = jacobian(&Integers, &graph, &cameras);
            let matrix = dense(&Integers, &rows, 12 * graph.nodes());
            let done = unwatched(|task| bareiss::eliminate(matrix, task));
            assert_eq!(done.pivots().rank(), rank, "{graph:?}");
        }
    }

    #[test]
    fn normal_form_fundamental_matrix() {
        // F = -[c_i - c_j]_x; here c_i - c_j = (1, 2, 3).
        let n = |x: i64| Integer::from(x);
        let p_i = normal_form(&Integers, &[n(1), n(4), n(8)]);
        let p_j = normal_form(&Integers, &[n(0), n(2), n(5)]);
        let expected = [[0, 3, -2], [-3, 0, 1], [2, -1, 0]];
        assert_eq!(
            fundamental(&Integers, &p_i, &p_j),
            expected.map(|row| row.map(n))
        );
    }

    #[test]
    fn the_gauge_adds_the_trivial_motions() {
        let field = PrimeField::mersenne61();
        for (graph, rank) in known() {
            for reference in 0..graph.edges().len() {
                let rows = augmented(&field, &graph, &modular(&field, &graph, 5), reference);
                assert_eq!(rows.len(), 10 * graph.edges().len() + graph.nodes() + 15);
                let matrix = dense(&field, &rows, 12 * graph.nodes());
                let expected = rank + graph.nodes() + 15;
                assert_eq!(
                    unwatched(|task| eliminate_mod(&field, matrix, task)).rank(),
                    expected,
                    "{graph:?}"
                );
            }
        }
    }

    fn times<R: Ring>(ring: &R, rows: &SparseRows<R::Elem>, x: &[R::Elem]) -> Vec<R::Elem> {
        let dot = |row: &Vec<(usize, R::Elem)>| {
            let terms = row.iter().map(|(col, a)| ring.mul(a, &x[*col]));
            terms.fold(ring.zero(), |sum, term| ring.add(&sum, &term))
        };
        rows.iter().map(dot).collect()
    }

    /// A motion as a vector of J_P's columns.
    fn vectorise<E: Clone>(motion: &[Camera<E>]) -> Vec<E> {
        let column = |camera: &Camera<E>, c: usize| [0, 1, 2].map(|r| camera[r][c].clone());
        motion
            .iter()
            .flat_map(|camera| (0..4).flat_map(move |c| column(camera, c)))
            .collect()
    }

    /// What holds at every camera set over every ring.
    fn verify<R: Ring>(
        ring: &R,
        graph: &Graph,
        cameras: &[Camera<R::Elem>],
        step: &[Camera<R::Elem>],
    ) {
        let rows = jacobian(ring, graph, cameras);
        assert!(rows.iter().all(|row| row.is_sorted_by(|a, b| a.0 < b.0)));
        assert!(rows.iter().flatten().all(|(_, entry)| !ring.is_zero(entry)));
        let zero = ring.zero();
        // S is skew-symmetric, and F is not zero.
        for &(i, j) in graph.edges() {
            let (p_i, p_j) = (&cameras[i as usize], &cameras[j as usize]);
            let f = fundamental(ring, p_i, p_j);
            assert!(phi(ring, p_i, p_j, &f).iter().all(|x| ring.is_zero(x)));
            assert!(f.iter().flatten().any(|x| !ring.is_zero(x)));
        }
        // The scale of each camera, and P_v X for each elementary X, are in the kernel.
        for v in 0..cameras.len() {
            let blank = std::array::from_fn(|_| std::array::from_fn(|_| zero.clone()));
            let mut motion: Vec<Camera<R::Elem>> = vec![blank; cameras.len()];
            motion[v] = cameras[v].clone();
            assert!(
                times(ring, &rows, &vectorise(&motion))
                    .iter()
                    .all(|x| ring.is_zero(x))
            );
        }
        for (k, l) in (0..16).map(|x| (x / 4, x % 4)) {
            let motion: Vec<Camera<R::Elem>> = cameras
                .iter()
                .map(|p| {
                    std::array::from_fn(|r| {
                        std::array::from_fn(|c| {
                            if c == l {
                                p[r][k].clone()
                            } else {
                                zero.clone()
                            }
                        })
                    })
                })
                .collect();
            assert!(
                times(ring, &rows, &vectorise(&motion))
                    .iter()
                    .all(|x| ring.is_zero(x))
            );
        }
        // Phi is linear in each camera: moving one camera by its step changes Phi by
        // exactly the derivative times the step.
        for v in 0..cameras.len() {
            let blank = std::array::from_fn(|_| std::array::from_fn(|_| zero.clone()));
            let mut motion: Vec<Camera<R::Elem>> = vec![blank; cameras.len()];
            motion[v] = step[v].clone();
            let predicted = times(ring, &rows, &vectorise(&motion));
            for (e, &(i, j)) in graph.edges().iter().enumerate() {
                let (i, j) = (i as usize, j as usize);
                let f = fundamental(ring, &cameras[i], &cameras[j]);
                let moved = |node: usize| -> Camera<R::Elem> {
                    std::array::from_fn(|r| {
                        std::array::from_fn(|c| ring.add(&cameras[node][r][c], &motion[node][r][c]))
                    })
                };
                let after = phi(ring, &moved(i), &moved(j), &f);
                assert_eq!(after.as_slice(), &predicted[10 * e..10 * (e + 1)]);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn derivatives_and_trivial_motions(seed in 0..u64::MAX - 1, nodes in 2..5u32) {
            let graph = complete(nodes);
            let (at, step) = (rational(&graph, seed), rational(&graph, seed + 1));
            verify(&Integers, &graph, &at, &step);
            for p in [5, DEFAULT_PRIME, 4_611_686_018_427_387_847] {
                let field = PrimeField::new(p).unwrap();
                let (at, step) = (modular(&field, &graph, seed), modular(&field, &graph, seed + 1));
                verify(&field, &graph, &at, &step);
            }
        }
    }
}
