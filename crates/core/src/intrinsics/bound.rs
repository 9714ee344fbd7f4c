//! What moves alike in one motion, and what counting says of it (docs/theory.md, Theorems 17.7,
//! 17.8 and 17.14).
//!
//! In: members and a motion. Out: blocks and groups, the bound that they give, metric components and
//! the nodes whose intrinsics are determined.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::members::Members;
use super::system::Moved;
use super::{Class, MetricComponent, Sensors};
use crate::graph::Graph;

/// Members and nodes that move alike in a motion.
pub(super) struct Alike {
    /// The members of each block.
    blocks: Vec<Vec<usize>>,
    /// The group of each node whose intrinsics do not move.
    group: Vec<Option<usize>>,
    groups: usize,
}

impl Alike {
    pub(super) fn new(members: &Members, moved: &Moved) -> Self {
        let mut place = HashMap::new();
        let mut blocks: Vec<Vec<usize>> = Vec::new();
        for (k, of_member) in moved.members.iter().enumerate() {
            let block = *place.entry(of_member).or_insert(blocks.len());
            if block == blocks.len() {
                blocks.push(Vec::new());
            }
            blocks[block].push(k);
        }
        let mut number = HashMap::new();
        let group = moved.turns.iter().map(|turn| {
            let next = number.len();
            turn.as_ref()
                .map(|turn| *number.entry(turn).or_insert(next))
        });
        let group = group.collect();
        debug_assert_eq!(members.all.len(), moved.members.len());
        Self {
            blocks,
            group,
            groups: number.len(),
        }
    }

    /// The bound of Theorems 17.7 and 17.14.
    pub(super) fn bound(&self, members: &Members, sensors: &Sensors) -> usize {
        let is_determined = self.determined_sensors(sensors);
        let mut sizes = vec![0; self.groups];
        for &group in self.group.iter().flatten() {
            sizes[group] += 1;
        }
        let of_groups = sizes.iter().map(|size| 3 * (size - 1));
        let of_blocks = self.blocks.iter().map(|block| {
            let nodes = nodes_of(members, block);
            let mut met: BTreeMap<usize, usize> = BTreeMap::new();
            let mut others = BTreeSet::new();
            let mut sum = 0;
            for &v in &nodes {
                match self.group[v as usize] {
                    Some(group) => *met.entry(group).or_default() += 1,
                    None => {
                        others.insert(sensors.of_node(v as usize));
                        sum += 6;
                    }
                }
            }
            let others = others.into_iter().filter(|&s| !is_determined[s]);
            sum += others.map(|s| sensors.class(s).unknowns()).sum::<usize>();
            sum += met.values().map(|count| 3 * (count + 1)).sum::<usize>();
            (sum - 7).min(11 * nodes.len() - 15)
        });
        let of_sensors = sensors.intrinsics_where(|sensor| is_determined[sensor]);
        of_sensors + of_groups.chain(of_blocks).sum::<usize>()
    }

    /// For each sensor whether a node of it is in a group: then its intrinsics do not move.
    fn determined_sensors(&self, sensors: &Sensors) -> Vec<bool> {
        let mut is_determined = vec![false; sensors.count()];
        for (v, group) in self.group.iter().enumerate() {
            is_determined[sensors.of_node(v)] |= group.is_some();
        }
        is_determined
    }

    /// For each node whether its intrinsics are determined; those of known cameras are.
    pub(super) fn determined(&self, sensors: &Sensors) -> Vec<bool> {
        let is_determined = self.determined_sensors(sensors);
        let of_node = |v: usize| {
            let sensor = sensors.of_node(v);
            is_determined[sensor] || sensors.class(sensor) == Class::Known
        };
        (0..sensors.nodes()).map(of_node).collect()
    }

    /// The blocks that are metric, the largest first.
    pub(super) fn components(&self, graph: &Graph, members: &Members) -> Vec<MetricComponent> {
        let metric = self.blocks.iter().filter(|block| {
            let nodes = nodes_of(members, block);
            let first = self.group[nodes[0] as usize];
            // A body whose cameras all keep their intrinsics and turn alike moves by a similarity.
            first.is_some() && nodes.iter().all(|&v| self.group[v as usize] == first)
        });
        let mut found: Vec<MetricComponent> = metric
            .map(|block| {
                let pairs = block
                    .iter()
                    .map(|&k| pairs_in(graph, &members.all[k].nodes));
                MetricComponent {
                    pairs: pairs.sum(),
                    nodes: nodes_of(members, block),
                }
            })
            .collect();
        found.sort_by(|a, b| (b.nodes.len(), &a.nodes).cmp(&(a.nodes.len(), &b.nodes)));
        found
    }
}

/// The nodes of members, increasing.
fn nodes_of(members: &Members, of: &[usize]) -> Vec<u32> {
    let all = of.iter().flat_map(|&k| &members.all[k].nodes).copied();
    let mut nodes: Vec<u32> = all.collect();
    crate::graph::sort_once(&mut nodes);
    nodes
}

/// How many pairs a set of nodes has.
fn pairs_in(graph: &Graph, nodes: &[u32]) -> usize {
    let inside = |&&(_, j): &&(u32, u32)| nodes.binary_search(&j).is_ok();
    let of_node = |&v: &u32| graph.edges_from(v).iter().filter(inside).count();
    nodes.iter().map(of_node).sum()
}
