//! The published test of affine solvability in floating point: singular values of the matrix of
//! [`formulation::affine`](crate::formulation::affine), with 4 m + 12 rows and 8 n columns.
//!
//! Cameras have entries uniform in [0, 1), not scaled. A graph is called affine solvable if the
//! smallest singular value is above a tolerance, or if MATLAB's `rank` is 8 n. What is true is
//! decided by counting (Theorem 13.2 of docs/theory.md).

use crate::dense::{matlab_rank, singular};
use crate::formulation::affine::{AffineCamera, matrix, size};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::ops::Range;
use viewcert::graph::Graph;
use viewcert_audit::linear::Doubles;
use viewcert_audit::{AuditError, uniform};

/// The tolerance of the published demonstration, on the smallest singular value.
pub const TOLERANCE: f64 = 1e-6;

/// What floating point finds at one draw of cameras.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The smallest singular value.
    pub smallest: f64,
    /// The rank as MATLAB's `rank` takes it.
    pub rank: usize,
    /// 8 n.
    pub columns: usize,
}

impl Outcome {
    /// Whether the smallest singular value is above a tolerance.
    pub fn is_above(&self, tolerance: f64) -> bool {
        self.smallest > tolerance
    }

    /// Whether the rank is full.
    pub fn is_full(&self) -> bool {
        self.rank == self.columns
    }
}

/// Affine cameras, one a node.
fn cameras(graph: &Graph, seed: u64, draw: u64) -> Vec<AffineCamera<f64>> {
    let entries = uniform(graph, seed, draw, 8 * graph.nodes());
    let camera =
        |entries: &[f64]| std::array::from_fn(|r| std::array::from_fn(|c| entries[4 * r + c]));
    entries.chunks_exact(8).map(camera).collect()
}

/// The singular values at one draw of cameras, falling, as many as columns.
fn singular_values(graph: &Graph, seed: u64, draw: u64) -> Result<Vec<f64>, AuditError> {
    let (rows, columns) = size(graph);
    let mut dense = vec![vec![0.0; rows]; columns];
    let sparse = matrix(&Doubles, graph, &cameras(graph, seed, draw));
    for (row, entries) in sparse.iter().enumerate() {
        entries
            .iter()
            .for_each(|&(column, x)| dense[column][row] = x);
    }
    Ok(singular(dense, false)?.0)
}

/// The test at one draw of cameras. Takes time in the cube of the number of nodes.
///
/// # Errors
/// No convergence.
///
/// # Panics
/// If the graph has fewer than two nodes.
pub fn decide(graph: &Graph, seed: u64, draw: u64) -> Result<Outcome, AuditError> {
    let values = singular_values(graph, seed, draw)?;
    let smallest = values.last().copied();
    let (rows, columns) = size(graph);
    Ok(Outcome {
        smallest: smallest.unwrap_or(0.0),
        rank: matlab_rank(&values, (rows, columns)),
        columns,
    })
}

/// How many of some draws were misjudged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Misjudged {
    /// All draws.
    pub draws: usize,
    /// Draws at which the smallest singular value is on the wrong side of [`TOLERANCE`].
    pub by_tolerance: usize,
    /// Draws at which MATLAB's rank is full and should not be, or the other way around.
    pub by_rank: usize,
}

impl Misjudged {
    /// Adds those of another graph.
    pub fn add(&mut self, other: Misjudged) {
        self.draws += other.draws;
        self.by_tolerance += other.by_tolerance;
        self.by_rank += other.by_rank;
    }
}

/// Runs the test at several draws of cameras, in parallel, of a graph that is affine solvable or
/// is not.
///
/// # Errors
/// No convergence.
///
/// # Panics
/// If the graph has fewer than two nodes.
pub fn misjudged(
    graph: &Graph,
    is_solvable: bool,
    seed: u64,
    draws: Range<u64>,
) -> Result<Misjudged, AuditError> {
    let found: Vec<Outcome> = draws
        .into_par_iter()
        .map(|draw| decide(graph, seed, draw))
        .collect::<Result<_, _>>()?;
    let wrong = |says: fn(&Outcome) -> bool| {
        let wrong = found.iter().filter(|&outcome| says(outcome) != is_solvable);
        wrong.count()
    };
    Ok(Misjudged {
        draws: found.len(),
        by_tolerance: wrong(|outcome| outcome.is_above(TOLERANCE)),
        by_rank: wrong(Outcome::is_full),
    })
}

/// Triangles of which each shares an edge with the next: nodes i, i + 1 and i + 2. It is affine
/// solvable, with the fewest edges possible.
///
/// # Panics
/// If there are fewer than two nodes.
pub fn triangle_strip(nodes: u32) -> Graph {
    let near = (1..nodes).map(|j| (j - 1, j));
    let far = (2..nodes).map(|j| (j - 2, j));
    Graph::new(nodes, near.chain(far)).expect("different nodes")
}

/// A random graph that is affine solvable with the fewest edges possible: each node is joined to two
/// earlier ones or, as often, to three of which two lose their edge (Henneberg's steps).
///
/// # Panics
/// If there are fewer than two nodes.
pub fn random_laman(nodes: u32, seed: u64) -> Graph {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut below = |limit: u32| random.next_u32() % limit;
    let mut edges = vec![(0, 1)];
    for z in 2..nodes {
        let (a, b) = if z > 2 && below(2) == 1 {
            let pinched = below(edges.len() as u32) as usize;
            let (a, b) = edges.swap_remove(pinched);
            let others: Vec<u32> = (0..z).filter(|&c| c != a && c != b).collect();
            edges.push((others[below(z - 2) as usize], z));
            (a, b)
        } else {
            let a = below(z);
            (a, (a + 1 + below(z - 1)) % z)
        };
        edges.extend([(a, z), (b, z)]);
    }
    Graph::new(nodes, edges).expect("different nodes")
}

/// A graph without its first edge, which is not affine solvable if it had the fewest edges possible.
///
/// # Panics
/// If it has no edge.
pub fn without_an_edge(graph: &Graph) -> Graph {
    let edges = graph.edges()[1..].iter().copied();
    Graph::new(graph.nodes() as u32, edges).expect("different nodes")
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::decide::plane_rank;
    use viewcert::watch::Watch;

    #[test]
    fn families_are_what_they_are_called() {
        let rank = |graph: &Graph| plane_rank(graph, &Watch::default()).unwrap();
        for nodes in [2, 3, 8, 25] {
            let full = 2 * nodes as usize - 3;
            for graph in [triangle_strip(nodes), random_laman(nodes, 5)] {
                assert_eq!(graph.edges().len(), full);
                assert_eq!(rank(&graph), full);
                assert_eq!(rank(&without_an_edge(&graph)), full - 1);
            }
        }
        assert_ne!(random_laman(8, 5).edges(), random_laman(8, 6).edges());
    }

    /// Small graphs are judged right, and a wide matrix has no full rank.
    #[test]
    fn small_graphs() {
        let triangle = triangle_strip(3);
        let outcome = decide(&triangle, 1, 0).unwrap();
        assert_eq!((outcome.rank, outcome.columns), (24, 24));
        assert!(outcome.is_above(TOLERANCE) && outcome.is_full());
        assert_eq!(outcome, decide(&triangle, 1, 0).unwrap());
        assert_ne!(outcome, decide(&triangle, 1, 1).unwrap());
        // 20 rows and 24 columns: the last four values are zero but for rounding, which leaves a small
        // multiple of the unit roundoff (1.1e-16) times the largest one, for matrices so small below 1e-12.
        let path = without_an_edge(&triangle);
        let values = singular_values(&path, 1, 0).unwrap();
        assert_eq!((size(&path), values.len()), ((20, 24), 24));
        let zero = 1e-12 * values[0];
        assert!(values[20..].iter().all(|&x| x <= zero), "{values:?}");
        assert!(values[19] > zero, "{values:?}");
        let path = decide(&path, 1, 0).unwrap();
        assert_eq!((path.rank, path.smallest), (20, values[23]));
        assert!(!path.is_above(TOLERANCE) && !path.is_full());
        let expected = Misjudged {
            draws: 20,
            ..Misjudged::default()
        };
        let square = Graph::new(4, [(0, 1), (1, 2), (2, 3), (0, 3)]).unwrap();
        assert_eq!(misjudged(&triangle, true, 1, 0..20).unwrap(), expected);
        assert_eq!(misjudged(&square, false, 1, 0..20).unwrap(), expected);
        // Held against the wrong answer all draws are misjudged.
        let wrong = misjudged(&square, true, 1, 0..20).unwrap();
        assert_eq!((wrong.by_tolerance, wrong.by_rank), (20, 20));
    }
}
