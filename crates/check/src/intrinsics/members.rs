//! Members that are metric, their clusters and columns (section 15; theory, Theorems 17.3, 17.6 and 17.12).

use super::sensors::{Class, Sensors};
use crate::elimination::SPARSE;
use crate::forest::{root, unite};
use crate::rejection::Checked;
use crate::structure::Structure;

/// The conditions that make a member metric.
const ENOUGH: usize = 8;

/// The members in their order, and where their columns are.
pub(super) struct Members<'a> {
    /// The nodes of each, increasing.
    pub nodes: Vec<&'a [u32]>,
    /// For each metric member, which come first, the first column of its cluster.
    pub turn: Vec<usize>,
    /// The first column of each member.
    pub first: Vec<usize>,
    /// The members of each node, increasing.
    pub of_node: Vec<Vec<usize>>,
    /// Which nodes are bound.
    pub bound: Vec<bool>,
    /// The first column of each sensor that has columns.
    pub intrinsics: Vec<Option<usize>>,
    pub columns: usize,
}

impl<'a> Members<'a> {
    pub(super) fn new(structure: &'a Structure, sensors: &Sensors) -> Checked<Self> {
        let all = structure.everything.iter();
        let all: Vec<&[u32]> = all.map(|&member| structure.nodes_of(member)).collect();
        let size: usize = all.iter().map(|nodes| nodes.len()).sum();
        let meter = structure.setting.meter;
        meter.charge(50 * SPARSE * (size + sensors.of_node.len()) as u64)?;
        let (is_metric, unknowns) = metric(&all, sensors);
        let of = |kind: bool| {
            let all = all.iter().zip(&is_metric);
            all.filter(move |&(_, &is)| is == kind)
                .map(|(&nodes, _)| nodes)
        };
        let nodes: Vec<&[u32]> = of(true).chain(of(false)).collect();
        let of_node = members_of(&nodes, sensors.of_node.len());
        let metric = of(true).count();
        let mut forest: Vec<usize> = (0..metric).collect();
        for held in &of_node {
            for &k in held.iter().filter(|&&k| k < metric) {
                unite(&mut forest, held[0], k);
            }
        }
        // The root of a cluster is its least member, so roots come in the order of clusters.
        let mut columns = 0;
        let mut turn = Vec::with_capacity(metric);
        for k in 0..metric {
            let least = root(&mut forest, k);
            turn.push(if least == k { columns } else { turn[least] });
            columns += 3 * usize::from(least == k);
        }
        let mut next = |width: usize| {
            columns += width;
            columns - width
        };
        let widths = (0..nodes.len()).map(|k| if k < metric { 4 } else { 15 });
        let first = widths.map(&mut next).collect();
        let bound = (0..of_node.len()).map(|v| {
            let says = sensors.classes[v] != Class::Unknown || sensors.is_shared[v];
            says && of_node[v].first().is_some_and(|&k| k >= metric)
        });
        let bound: Vec<bool> = bound.collect();
        let mut intrinsics = vec![None; of_node.len()];
        for v in (0..of_node.len()).filter(|&v| bound[v]) {
            let sensor = sensors.of_node[v];
            if unknowns[sensor] > 0 && intrinsics[sensor].is_none() {
                intrinsics[sensor] = Some(next(unknowns[sensor]));
            }
        }
        meter.allow_core(columns.div_ceil(15))?;
        Ok(Members {
            nodes,
            turn,
            first,
            of_node,
            bound,
            intrinsics,
            columns,
        })
    }
}

/// The members of each node.
fn members_of(all: &[&[u32]], nodes: usize) -> Vec<Vec<usize>> {
    let mut of_node = vec![Vec::new(); nodes];
    for (k, nodes) in all.iter().enumerate() {
        nodes.iter().for_each(|&v| of_node[v as usize].push(k));
    }
    of_node
}

/// Which members are metric, and how many intrinsics of each sensor are unknown then: none if a node of it
/// is in one of these.
fn metric(all: &[&[u32]], sensors: &Sensors) -> (Vec<bool>, Vec<usize>) {
    let nodes = sensors.of_node.len();
    let mut unknowns: Vec<usize> = (0..nodes).map(|v| sensors.unknowns(v)).collect();
    let mut of_sensor = vec![Vec::new(); nodes];
    let mut sums = Vec::with_capacity(all.len());
    for (k, nodes) in all.iter().enumerate() {
        let of_member = sensors.of(nodes.iter().map(|&v| v as usize));
        let less: usize = of_member.iter().map(|&s| unknowns[s]).sum();
        sums.push(5 * nodes.len() - less);
        of_member.into_iter().for_each(|s| of_sensor[s].push(k));
    }
    let mut is_metric = vec![false; all.len()];
    let mut todo: Vec<usize> = (0..all.len()).collect();
    while let Some(k) = todo.pop() {
        if is_metric[k] || sums[k] < ENOUGH {
            continue;
        }
        is_metric[k] = true;
        for &v in all[k] {
            let sensor = sensors.of_node[v as usize];
            let more = std::mem::take(&mut unknowns[sensor]);
            if more > 0 {
                for &other in &of_sensor[sensor] {
                    sums[other] += more;
                    todo.push(other);
                }
            }
        }
    }
    (is_metric, unknowns)
}
