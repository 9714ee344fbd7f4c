//! Where pairs are: the component of each, and the pairs among some nodes.
//!
//! In: a graph, and the nodes of its components as one array with the ends of each. Out: arrays.

use crate::errors::InputError;
use crate::graph::{Graph, all, pair_array};
use crate::work;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::Arc;

/// For every node the components that hold it, increasing: those of node v are
/// `lists[starts[v]..starts[v + 1]]`.
struct Holders {
    starts: Vec<usize>,
    lists: Vec<i32>,
}

impl Holders {
    /// From the nodes of all components, one after another, and where each ends. O(size).
    fn new(nodes: usize, members: &[u32], ends: &[u64]) -> Self {
        let mut starts = vec![0; nodes + 1];
        for &node in members {
            starts[node as usize + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let (mut free, mut lists) = (starts.clone(), vec![0; members.len()]);
        let mut first = 0;
        for (component, &end) in (0..).zip(ends) {
            for &node in &members[first..end as usize] {
                lists[free[node as usize]] = component;
                free[node as usize] += 1;
            }
            first = end as usize;
        }
        Self { starts, lists }
    }

    #[inline]
    fn of(&self, node: u32) -> &[i32] {
        &self.lists[self.starts[node as usize]..self.starts[node as usize + 1]]
    }

    /// The component that holds both nodes. Two components share at most one node, so there is at
    /// most one. O(k log l) for a node in k of them and one in l >= k.
    #[inline]
    fn both(&self, a: u32, b: u32) -> Option<i32> {
        let (few, many) = match (self.of(a), self.of(b)) {
            (a, b) if a.len() <= b.len() => (a, b),
            (a, b) => (b, a),
        };
        let held = |component: &&i32| many.binary_search(component).is_ok();
        few.iter().find(held).copied()
    }
}

/// Where the edges of every node begin: a search among these alone stays in the cache, and one among
/// all does not.
struct Rows<'g> {
    edges: &'g [(u32, u32)],
    starts: Vec<usize>,
}

impl<'g> Rows<'g> {
    fn new(graph: &'g viewcert::Graph) -> Self {
        let mut starts = vec![0; graph.nodes() + 1];
        for &(i, _) in graph.edges() {
            starts[i as usize + 1] += 1;
        }
        for node in 0..graph.nodes() {
            starts[node + 1] += starts[node];
        }
        Self {
            edges: graph.edges(),
            starts,
        }
    }

    #[inline]
    fn has(&self, &(a, b): &(u32, u32)) -> bool {
        let (i, j) = (a.min(b), a.max(b));
        let row = self.starts.get(i as usize..i as usize + 2);
        let row = row.map_or(&[][..], |ends| &self.edges[ends[0]..ends[1]]);
        row.binary_search(&(i, j)).is_ok()
    }
}

/// The component of every pair of the graph, or of those that are given by node numbers, which have
/// to be pairs of the graph. `members` and `ends` are the nodes of the components, one after another,
/// and where each ends.
#[pyfunction]
#[pyo3(signature = (graph, members, ends, pairs=None))]
pub(crate) fn component_of_pairs<'py>(
    py: Python<'py>,
    graph: &Graph,
    members: PyReadonlyArray1<'py, u32>,
    ends: PyReadonlyArray1<'py, u64>,
    pairs: Option<PyReadonlyArray2<'py, u32>>,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let input = Arc::clone(&graph.0);
    let (members, ends) = (members.as_array().to_vec(), ends.as_array().to_vec());
    let asked: Option<Vec<(u32, u32)>> = pairs.and_then(|pairs| all(&pairs.as_array()));
    let found = work::run(py, move || {
        let nodes = input.graph.nodes();
        let holders = Holders::new(nodes, &members, &ends);
        let place = |&(a, b): &(u32, u32)| holders.both(a, b).unwrap_or(-1);
        match asked {
            None => Ok(input.graph.edges().par_iter().map(place).collect()),
            Some(asked) => {
                let rows = Rows::new(&input.graph);
                let place = |(row, pair)| match rows.has(pair) {
                    true => Ok(place(pair)),
                    false => Err(row),
                };
                let asked = asked.par_iter().enumerate();
                asked.map(place).collect::<Result<Vec<i32>, usize>>()
            }
        }
    })?;
    match found {
        Ok(places) => Ok(places.into_pyarray(py)),
        Err(row) => Err(InputError::new_err(format!(
            "row {row} of the pairs is no pair of the graph"
        ))),
    }
}

/// The pairs of the graph with both ends among the nodes, an array of shape (k, 2), increasing.
/// `nodes` increase.
#[pyfunction]
pub(crate) fn pairs_among<'py>(
    py: Python<'py>,
    graph: &Graph,
    nodes: PyReadonlyArray1<'py, u32>,
) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let nodes = nodes.as_array().to_vec();
    let input = &graph.0.graph;
    let found = work::briefly(py, || {
        let inside = |&&(_, j): &&(u32, u32)| nodes.binary_search(&j).is_ok();
        if nodes.len() == input.nodes() {
            return input.edges().to_vec();
        }
        let of_node = |&node: &u32| input.edges_from(node).iter().filter(inside).copied();
        nodes.iter().flat_map(of_node).collect()
    })?;
    pair_array(py, &found)
}
