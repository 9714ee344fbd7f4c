//! Rigid bodies that become metric and grow (docs/theory.md, Theorems 17.3 and 17.5).
//!
//! In: a projective verdict and sensors with their classes. Out: the members, bodies and loose edges, whether they are
//! metric, and the clusters of metric ones that hang together, which turn alike.

use super::Sensors;
use crate::contract::Contraction;
use crate::decide::Verdict;
use crate::geometry::model::Model;
use crate::graph::{Graph, KnownParts, UnionFind};

/// The conditions that make a rigid body metric.
const ENOUGH: usize = 8;

/// A body or a loose edge.
pub(super) struct Member {
    /// Its nodes, increasing.
    pub(super) nodes: Vec<u32>,
    /// The cluster of a metric one.
    pub(super) cluster: Option<usize>,
}

/// The members of a graph.
pub(super) struct Members {
    pub(super) all: Vec<Member>,
    pub(super) clusters: usize,
    /// For each node the members that hold it, metric ones first.
    pub(super) of_node: Vec<Vec<usize>>,
}

impl Members {
    pub(super) fn new(graph: &Graph, verdict: &Verdict, sensors: &Sensors) -> Self {
        let rigid = verdict.components.iter().map(|found| found.nodes());
        let mut bodies: Vec<Vec<u32>> = rigid.filter(|nodes| nodes.len() > 2).collect();
        loop {
            let members = contracted(graph, bodies, Model::Projective);
            let metric = metric(&members, sensors);
            let (of_metric, others): (Vec<_>, Vec<_>) =
                members.into_iter().zip(metric).partition(|&(_, is)| is);
            let (of_metric, others) = (nodes(of_metric), nodes(others));
            let before = of_metric.len();
            let joined = joined(graph.nodes() as u32, of_metric);
            if joined.len() == before {
                return Self::of(graph.nodes(), joined, others);
            }
            bodies = joined.into_iter().chain(others).collect();
            bodies.retain(|nodes| nodes.len() > 2);
        }
    }

    /// Members that are there, metric ones first, otherwise in their order.
    pub(super) fn listed(list: Vec<Vec<u32>>, sensors: &Sensors) -> Self {
        let metric = metric(&list, sensors);
        let (of_metric, others): (Vec<_>, Vec<_>) =
            list.into_iter().zip(metric).partition(|&(_, is)| is);
        Self::of(sensors.nodes(), nodes(of_metric), nodes(others))
    }

    fn of(count: usize, metric: Vec<Vec<u32>>, others: Vec<Vec<u32>>) -> Self {
        let mut of_node = vec![Vec::new(); count];
        for (k, nodes) in metric.iter().chain(&others).enumerate() {
            for &v in nodes {
                of_node[v as usize].push(k);
            }
        }
        let mut linked = UnionFind::new(metric.len());
        for held in &of_node {
            let held: Vec<usize> = held.iter().copied().filter(|&k| k < metric.len()).collect();
            for two in held.windows(2) {
                linked.union(two[0], two[1]);
            }
        }
        let mut number = vec![None; metric.len()];
        let mut clusters = 0;
        let mut cluster = |k: usize| {
            *number[linked.find(k)].get_or_insert_with(|| {
                clusters += 1;
                clusters - 1
            })
        };
        let of_metric = metric.into_iter().enumerate().map(|(k, nodes)| Member {
            nodes,
            cluster: Some(cluster(k)),
        });
        let mut all: Vec<Member> = of_metric.collect();
        all.extend(others.into_iter().map(|nodes| Member {
            nodes,
            cluster: None,
        }));
        Self {
            all,
            clusters,
            of_node,
        }
    }
}

fn nodes(of: Vec<(Vec<u32>, bool)>) -> Vec<Vec<u32>> {
    of.into_iter().map(|(nodes, _)| nodes).collect()
}

/// What the rules of a model leave of a graph with bodies from the start.
fn contracted(graph: &Graph, bodies: Vec<Vec<u32>>, model: Model) -> Vec<Vec<u32>> {
    let parts = KnownParts::new(graph.nodes() as u32, bodies).expect("nodes of the graph");
    let found = Contraction::with_parts(graph, &parts, model);
    let finals = found.finals.iter();
    let bodies = finals.map(|&body| found.bodies[body as usize].nodes.clone());
    let loose = found.loose.iter().map(|&(i, j)| vec![i, j]);
    bodies.chain(loose).collect()
}

/// Metric bodies that the calibrated rules join, which work within clusters, and those that are left.
fn joined(count: u32, metric: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    let (pairs, bodies): (Vec<_>, Vec<_>) = metric.into_iter().partition(|body| body.len() == 2);
    let pairs = pairs.iter().map(|pair| (pair[0], pair[1]));
    let graph = Graph::new(count, pairs).expect("pairs of the graph");
    contracted(&graph, bodies, Model::Calibrated)
}

/// Which members are metric, where the sensors of metric ones are known (Theorems 17.3 and 17.12).
fn metric(members: &[Vec<u32>], sensors: &Sensors) -> Vec<bool> {
    let mut of_sensor = vec![Vec::new(); sensors.count()];
    let mut sums = Vec::with_capacity(members.len());
    for (k, nodes) in members.iter().enumerate() {
        let (conditions, of_member) = sensors.conditions(nodes);
        sums.push(conditions);
        for sensor in of_member {
            of_sensor[sensor].push(k);
        }
    }
    let mut next: Vec<usize> = (0..members.len()).filter(|&k| sums[k] >= ENOUGH).collect();
    let mut is_metric = vec![false; members.len()];
    while let Some(k) = next.pop() {
        if std::mem::replace(&mut is_metric[k], true) {
            continue;
        }
        for &v in &members[k] {
            let sensor = sensors.of_node(v as usize);
            let more = sensors.class(sensor).unknowns();
            // Only once: a sensor that is known then is in no list any more.
            for other in std::mem::take(&mut of_sensor[sensor]) {
                sums[other] += more;
                if sums[other] >= ENOUGH {
                    next.push(other);
                }
            }
        }
    }
    is_metric
}
