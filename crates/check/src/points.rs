//! `points` (section 7 of the specification): what a block loses because plane flows of some of its
//! edges, seen from points, circulate in few edges.

use crate::core::Core;
use crate::document::{Model, Pair, Points};
use crate::elimination::SPARSE;
use crate::forest::unite;
use crate::rejection::{Checked, Within, ensure};
use crate::structure::{Part, Structure};

/// Points in space that are independent.
const MOST_POINTS: usize = 4;

/// An edge of a core by its ends i < j.
type Edge = (usize, usize);

/// Verifies `points` of a block; returns what they take off (theory, Theorem 5.16 and Corollary
/// 5.17).
pub(crate) fn check_points(points: &Points, structure: &Structure, block: &Part) -> Checked<i64> {
    let model = structure.setting.model;
    ensure!(model == Model::Projective, "points in the {model} model");
    let core = structure.core(block)?;
    let base = DividedSet::new(&points.base, structure, &core).within(|| "base".into())?;
    let count = points.at.len();
    ensure!(
        count <= MOST_POINTS,
        "{count} points, but at most four are independent"
    );
    let mut nodes: Vec<usize> = Vec::new();
    let mut sum = (MOST_POINTS - count) as i64 * base.flows;
    let mut circulating = base.circulating(None, structure)?;
    for (k, point) in points.at.iter().enumerate() {
        let at = || format!("at[{k}]");
        let node = point.node as usize;
        let set = DividedSet::new(&point.edges, structure, &core).within(at)?;
        let checked = || {
            ensure!(node < core.nodes, "node {node} is not in the core");
            ensure!(!nodes.contains(&node), "node {node} is there twice");
            let missing = base
                .edges
                .iter()
                .find(|edge| set.edges.binary_search(edge).is_err());
            ensure!(
                missing.is_none(),
                "the edge {:?} of `base` is not in the set",
                missing.unwrap_or(&(0, 0))
            );
            Ok(())
        };
        checked().within(at)?;
        nodes.push(node);
        sum += set.flows;
        circulating.extend(set.circulating(Some(node), structure)?);
    }
    circulating.sort_unstable();
    circulating.dedup();
    let cycles = independent_cycles(&circulating, core.nodes);
    ensure!(
        cycles == points.cycles,
        "there are {cycles} independent cycles, not {}",
        points.cycles
    );
    let independent = 7 * core.edges.len() as i64 - core.required(structure.setting);
    let less = sum - cycles as i64 - independent;
    ensure!(
        less == points.less && less >= 1,
        "the points take off {less}, not {}",
        points.less
    );
    Ok(less)
}

/// Edges of a core, in increasing order, and how many plane flows they have at least.
struct DividedSet {
    edges: Vec<Edge>,
    flows: i64,
}

impl DividedSet {
    /// Sees that lists of edges of the core have none in common, and counts flows: a list has a rank
    /// of 3 n_B - 4 at most in N (theory, Theorem 5.1).
    fn new(lists: &[Vec<Pair>], structure: &Structure, core: &Core) -> Checked<DividedSet> {
        let count = core.edges.len() + lists.iter().map(Vec::len).sum::<usize>();
        structure.setting.meter.charge(SPARSE * count as u64)?;
        let (mut edges, mut rank) = (Vec::new(), 0);
        for (k, list) in lists.iter().enumerate() {
            ensure!(
                !list.is_empty() && list.is_sorted_by(|a, b| a < b),
                "list {k} is not an increasing list of edges"
            );
            let all: Vec<Edge> = list
                .iter()
                .map(|&[i, j]| (i as usize, j as usize))
                .collect();
            let outside = all
                .iter()
                .find(|edge| core.edges.binary_search(edge).is_err());
            ensure!(
                outside.is_none(),
                "{:?} is not an edge (i < j) of the core",
                outside.unwrap_or(&(0, 0))
            );
            rank += Model::Calibrated.required(count_nodes(&all));
            edges.extend(all);
        }
        edges.sort_unstable();
        ensure!(edges.is_sorted_by(|a, b| a < b), "an edge is in two lists");
        let flows = 2 * edges.len() as i64 - rank;
        ensure!(flows >= 0, "{flows} flows are counted");
        Ok(DividedSet { edges, flows })
    }

    /// The edges that lie on a cycle of edges of the set, those at a node left out: whose ends the
    /// other edges connect.
    fn circulating(&self, without: Option<usize>, structure: &Structure) -> Checked<Vec<Edge>> {
        let is_there = |&&(i, j): &&Edge| without != Some(i) && without != Some(j);
        let edges: Vec<Edge> = self.edges.iter().filter(is_there).copied().collect();
        let nodes = edges.iter().map(|&(_, j)| j + 1).max().unwrap_or(0);
        let steps = edges.len() as u64 * (edges.len() + nodes) as u64;
        structure.setting.meter.charge(SPARSE * steps)?;
        let on_cycle = |&k: &usize| {
            let mut forest: Vec<usize> = (0..nodes).collect();
            let others = (0..edges.len()).filter(|&other| other != k);
            others.for_each(|other| {
                unite(&mut forest, edges[other].0, edges[other].1);
            });
            !unite(&mut forest, edges[k].0, edges[k].1)
        };
        Ok((0..edges.len())
            .filter(on_cycle)
            .map(|k| edges[k])
            .collect())
    }
}

/// The number of nodes of edges.
fn count_nodes(edges: &[Edge]) -> usize {
    let mut nodes: Vec<usize> = edges.iter().flat_map(|&(i, j)| [i, j]).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes.len()
}

/// How many of the edges close a cycle, each with those before it.
fn independent_cycles(edges: &[Edge], nodes: usize) -> usize {
    let mut forest: Vec<usize> = (0..nodes).collect();
    let closes = |&&(i, j): &&Edge| !unite(&mut forest, i, j);
    edges.iter().filter(closes).count()
}
