//! Components by the paper's own method (its section 4.2), on the exact null space.
//!
//! Fix the gauge at an edge; the nodes whose rows of the null space of J are zero form its
//! component; go on with the edges that are left. The method takes what never moves
//! against the edge for rigid, so that on rare graphs it merges components
//! (docs/theory.md, Example 6.2); it is here as an independent check of the others.

use viewcert::geometry::camera::Camera;
use viewcert::geometry::draw;
use viewcert::geometry::draw::{DrawError, DrawKey};
use viewcert::geometry::jacobian;
use viewcert::graph::Graph;
use viewcert::linalg::dense_lu::eliminate_mod;
use viewcert::linalg::prime::PrimeField;
use viewcert::watch::unwatched;

/// The components of a graph by the paper's method at general cameras modulo p, as lists of
/// edges, each increasing, in the order in which they are found: that of their first edges.
///
/// One elimination of the dense (10m + n + 15) x 12n matrix J for every component, with
/// the edges that are left.
///
/// # Errors
/// If no cameras can be drawn modulo so small a prime.
pub fn components(
    field: &PrimeField,
    graph: &Graph,
    key: &DrawKey,
) -> Result<Vec<Vec<(u32, u32)>>, DrawError> {
    components_from(field, graph, key, 0)
}

/// The same, with the edge of this number as the first at which the gauge is fixed. How many
/// components there are may depend on it.
///
/// # Errors
/// If no cameras can be drawn modulo so small a prime.
///
/// # Panics
/// If there is no such edge.
pub fn components_from(
    field: &PrimeField,
    graph: &Graph,
    key: &DrawKey,
    mut start: usize,
) -> Result<Vec<Vec<(u32, u32)>>, DrawError> {
    let mut left = graph.edges().to_vec();
    let mut components = Vec::new();
    while !left.is_empty() {
        let mut nodes: Vec<u32> = left.iter().flat_map(|&(i, j)| [i, j]).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let number = |v: u32| nodes.partition_point(|&w| w < v) as u32;
        let pairs = left.iter().map(|&(i, j)| (number(i), number(j))).collect();
        let (rest, _) = Graph::from_pairs(nodes.len() as u32, pairs).expect("edges of a graph");
        let cameras = draw::cameras_mod(field, rest.nodes(), key)?.values;
        let fixed = fixed_nodes(field, &rest, &cameras, start);
        let inside = |v: u32| fixed[number(v) as usize];
        let (inside, outside) = left.iter().partition(|&&(i, j)| inside(i) && inside(j));
        components.push(inside);
        left = outside;
        start = 0;
    }
    Ok(components)
}

/// Which nodes do not move if the gauge is fixed at the edge `frame`.
pub fn fixed_nodes(
    field: &PrimeField,
    graph: &Graph,
    cameras: &[Camera<u64>],
    frame: usize,
) -> Vec<bool> {
    let rows = jacobian::augmented(field, graph, cameras, frame);
    let matrix = jacobian::dense(field, &rows, 12 * graph.nodes());
    let kernel = unwatched(|task| eliminate_mod(field, matrix, task)).right_kernel();
    let fixed = |at: usize| {
        (0..kernel.rows()).all(|k| kernel.row(k)[12 * at..12 * at + 12].iter().all(|&x| x == 0))
    };
    (0..graph.nodes()).map(fixed).collect()
}
