//! The rank of a large core by plane flows (docs/theory.md, Corollary 3.3): rows of N, columns of
//! Lambda and flows modulo 65521.
//!
//! In: a graph, and centres whose first coordinates differ on its edges. Out: what is used of each
//! edge, the flows, and a motion. N has a quarter as many columns as J_P, and Lambda fewer still.

use super::eliminated::{Eliminated, PRIME, next};
use crate::geometry::model::Model;
use crate::geometry::plane_flow::PlaneFlows;
use crate::graph::Graph;
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::watch::{Stopped, Task, unwatched};

/// Bits of a mask: both rows of N, in the order of the rows 1 and 2 of the edge's matrix F, and the
/// column of Lambda.
const ROW_1: u32 = 1;
const ROW_2: u32 = 2;
const COLUMN: u32 = 4;

/// Rows, columns, flows and a motion at centres (of each node that at its `place`), if the rank is `rank`
/// at least. `None` if it is not, or first coordinates are equal on an edge.
///
/// An elimination of N, O(n^3) at worst.
pub(super) fn eliminate(
    graph: &Graph,
    place: &[usize],
    centres: Vec<[u64; 3]>,
    rank: usize,
    state: &mut u64,
) -> Option<Eliminated> {
    unwatched(|task| of_centres(graph, place, centres, rank, state, task))
}

fn of_centres(
    graph: &Graph,
    place: &[usize],
    centres: Vec<[u64; 3]>,
    rank: usize,
    state: &mut u64,
    task: &Task,
) -> Result<Option<Eliminated>, Stopped> {
    let field = PrimeField::new(PRIME).expect("a prime");
    let of_node = place.iter().map(|&k| centres[k]);
    let of_node = of_node.map(|centre| centre.map(|x| field.from_u64(x)));
    let of_node: Vec<[u64; 3]> = of_node.collect();
    let differ = |&(i, j): &(u32, u32)| of_node[i as usize][0] != of_node[j as usize][0];
    if !graph.edges().iter().all(differ) {
        return Ok(None);
    }
    let flows = PlaneFlows::new(&field, graph, &of_node, task)?;
    let draws = *state;
    let mut drawn = || field.from_u64(next(state));
    let lambda = flows.lambda(&mut drawn, task)?;
    let found = flows.rank(&lambda);
    let Some(motion) = flows.motion(&lambda, &mut drawn) else {
        return Ok(None);
    };
    if found.rank(graph.edges().len()) < rank {
        return Ok(None);
    }
    let mut masks = vec![0; graph.edges().len()];
    for &row in &found.rigidity.rows {
        masks[row / 2] |= [ROW_2, ROW_1][row % 2];
    }
    for &edge in &found.lambda.cols {
        masks[edge] |= COLUMN;
    }
    // The flows of Lambda once more: the same draws.
    let mut again = draws;
    let dimension = 2 * graph.edges().len() - found.rigidity.rank();
    let draw = |_, _| field.from_u64(next(&mut again));
    let weights = Matrix::from_fn(found.flows, dimension, draw);
    let weights = flows.combined(&weights, task)?;
    // The direction of row 2e of N is minus row 2 of F, that of row 2e + 1 is row 1.
    let of_edge = |w: &[u64]| [w[1], field.minus(0, w[0])].map(|x| field.to_u64(x) as u32);
    let of_flow = |f: usize| weights.row(f).chunks_exact(2).map(of_edge).collect();
    let mut by_place = vec![0; 12 * graph.nodes()];
    for (b, column) in motion.columns.iter().enumerate() {
        for (at, &x) in column.iter().enumerate() {
            by_place[12 * place[at / 3] + 4 * (at % 3) + b] = field.to_u64(x);
        }
    }
    Ok(Some(Eliminated {
        model: Model::default(),
        masks,
        // Without any, the rows would be taken for those of J_P.
        flows: match found.flows {
            0 => vec![vec![[0; 2]; graph.edges().len()]],
            count => (0..count).map(of_flow).collect(),
        },
        place: place.to_vec(),
        centres,
        motion: by_place,
    }))
}
