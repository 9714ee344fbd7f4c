//! Members that are metric, their clusters and columns (section 15; theory, Theorems 17.3 and 17.6).

use super::Class;
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
    /// The first column of each node that is bound.
    pub bound: Vec<Option<usize>>,
    pub columns: usize,
}

impl<'a> Members<'a> {
    pub fn new(structure: &'a Structure, classes: &[Class]) -> Checked<Self> {
        let all = structure.everything.iter();
        let all: Vec<&[u32]> = all.map(|&member| structure.nodes_of(member)).collect();
        let size: usize = all.iter().map(|nodes| nodes.len()).sum();
        let meter = structure.setting.meter;
        meter.charge(50 * SPARSE * (size + classes.len()) as u64)?;
        let is_metric = metric(&all, classes);
        let of = |kind: bool| {
            let all = all.iter().zip(&is_metric);
            all.filter(move |&(_, &is)| is == kind)
                .map(|(&nodes, _)| nodes)
        };
        let nodes: Vec<&[u32]> = of(true).chain(of(false)).collect();
        let of_node = members_of(&nodes, classes.len());
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
        let bound = of_node.iter().zip(classes).map(|(held, class)| {
            let is_bound = held.first().is_some_and(|&k| k >= metric);
            (is_bound && *class != Class::Unknown).then(|| next(class.unknowns()))
        });
        let bound = bound.collect();
        meter.allow_core(columns.div_ceil(15))?;
        Ok(Members {
            nodes,
            turn,
            first,
            of_node,
            bound,
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

/// Which members are metric: the nodes of those that are have five conditions in all others.
fn metric(all: &[&[u32]], classes: &[Class]) -> Vec<bool> {
    let of_node = members_of(all, classes.len());
    let mut missing: Vec<usize> = classes.iter().map(|class| class.unknowns()).collect();
    let mut sums: Vec<usize> = all
        .iter()
        .map(|nodes| nodes.iter().map(|&v| 5 - missing[v as usize]).sum())
        .collect();
    let mut is_metric = vec![false; all.len()];
    let mut todo: Vec<usize> = (0..all.len()).collect();
    while let Some(k) = todo.pop() {
        if is_metric[k] || sums[k] < ENOUGH {
            continue;
        }
        is_metric[k] = true;
        for &v in all[k] {
            let more = std::mem::take(&mut missing[v as usize]);
            if more > 0 {
                for &other in &of_node[v as usize] {
                    sums[other] += more;
                    todo.push(other);
                }
            }
        }
    }
    is_metric
}
