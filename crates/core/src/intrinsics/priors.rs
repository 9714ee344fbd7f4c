//! What one prior more would do (docs/theory.md, Corollary 17.18).
//!
//! In: a graph, its sensors, what they determine. Out: for each sensor of which the intrinsics are not
//! determined, what is once they are known.

use super::bound::Alike;
use super::members::Members;
use super::system::{Motions, Moved, System};
use super::{Class, DRAWS, Metric, Sensors, key, verdict};
use crate::decide::Verdict;
use crate::graph::Graph;
use crate::linalg::sparse_lu::{Factorisation, SparseRow};
use crate::watch::{Step, Stopped, Task, Watch};
use std::cmp::Reverse;

/// The numbers that say how intrinsics move, and one motion more, so that some motion is left with none.
const MOTIONS: usize = 6;

/// What is determined once the intrinsics of a sensor are known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Prior {
    /// The sensor.
    pub sensor: usize,
    /// The nodes that it took, increasing.
    pub nodes: Vec<u32>,
    /// How many nodes have determined intrinsics then, those of the sensor and of known ones included.
    pub determined: usize,
    /// How many nodes the largest metric component has then.
    pub largest: usize,
    /// A lower bound of the generic rank then.
    pub rank: usize,
    /// An upper bound.
    pub at_most: usize,
    /// The rank of a metric graph then.
    pub required: usize,
}

impl Prior {
    /// Whether all cameras are determined then. It is proved.
    pub fn is_metric(&self) -> bool {
        self.rank == self.required
    }

    /// `metric`, `not-metric`, or `open` if the bounds do not tell.
    pub fn verdict(&self) -> &'static str {
        verdict(self.rank, self.at_most, self.required)
    }

    /// Whether another prior makes as much of the graph metric, and determines as many intrinsics.
    pub fn is_as_good_as(&self, other: &Self) -> bool {
        self.effect() == other.effect()
    }

    /// Whether the bounds meet, so that all that is said is proved.
    pub fn is_proved(&self) -> bool {
        self.rank == self.at_most
    }

    /// By this priors are sorted, the best first: a metric graph, then most cameras with determined
    /// intrinsics, then the largest component.
    fn effect(&self) -> (bool, usize, usize) {
        (self.is_metric(), self.determined, self.largest)
    }
}

impl Metric {
    /// What one prior more would do: for each sensor whose intrinsics are not determined, the best first.
    /// Takes one elimination, as the answer did, and O(n + m) operations for each sensor.
    ///
    /// # Errors
    /// If the work was stopped.
    ///
    /// # Panics
    /// If the answer is of another graph or of other sensors.
    pub fn priors(
        &self,
        graph: &Graph,
        verdict: &Verdict,
        sensors: &Sensors,
        seed: u64,
        watch: &Watch,
    ) -> Result<Vec<Prior>, Stopped> {
        assert_eq!(self.determined.len(), graph.nodes(), "another graph");
        let members = Members::new(graph, verdict, sensors);
        let mut nodes = vec![Vec::new(); sensors.count()];
        for (v, is_determined) in (0..).zip(&self.determined) {
            let of = sensors.of_node(v as usize);
            if !is_determined {
                nodes[of].push(v);
            }
        }
        let open = nodes.into_iter().enumerate();
        let open = open.filter(|(_, nodes)| !nodes.is_empty());
        let open: Vec<(usize, Vec<u32>)> = open.collect();
        if open.is_empty() {
            return Ok(Vec::new());
        }
        let motions = self.motions(verdict, &members, sensors, seed, watch)?;
        let task = watch.task(Step::Draws, graph.nodes());
        let work = task.begin(open.len() as u64);
        let mut found = Vec::new();
        for (sensor, nodes) in open {
            let held = |&&v: &&u32| !members.of_node[v as usize].is_empty();
            if let Some(&v) = nodes.iter().find(held) {
                let (moved, taken) = with_prior(&motions, v as usize, &task)?;
                let known = sensors.with_class(sensor, Class::Known);
                let less = sensors.class(sensor).unknowns();
                let alike = Alike::new(&members, &moved);
                let required = self.required - less;
                let determined = alike.determined(&known);
                let components = alike.components(graph, &members);
                found.push(Prior {
                    sensor,
                    nodes,
                    determined: determined.iter().filter(|&&is| is).count(),
                    largest: components.first().map_or(0, |found| found.nodes.len()),
                    rank: self.rank + taken - less,
                    at_most: alike.bound(&members, &known).min(required),
                    required,
                });
            }
            work.done(1)?;
        }
        found.sort_by_key(|prior| (Reverse(prior.effect()), prior.sensor));
        Ok(found)
    }

    /// Motions where the rank is that of the answer.
    fn motions(
        &self,
        verdict: &Verdict,
        members: &Members,
        sensors: &Sensors,
        seed: u64,
        watch: &Watch,
    ) -> Result<Motions, Stopped> {
        let held = (0..sensors.nodes()).filter(|&v| !members.of_node[v].is_empty());
        let of_held = sensors.unknowns(held);
        for draw in 0..DRAWS {
            let key = key(verdict.sha256, sensors, seed, draw);
            let motions = System::new(members, sensors, &key).motions(MOTIONS, watch)?;
            if of_held - motions.dimension == self.rank {
                return Ok(motions);
            }
        }
        panic!("an answer about other sensors");
    }
}

/// A random one of the motions that leave the intrinsics of a node as they are, and how many dimensions
/// less these have: at most that, if chance was against it.
fn with_prior(motions: &Motions, v: usize, task: &Task) -> Result<(Moved, usize), Stopped> {
    let moves = motions.intrinsics(v).expect("a node of a member");
    let row = |k: usize| -> SparseRow {
        let entries = moves.iter().enumerate().map(|(at, of)| (at, of[k]));
        entries.filter(|&(_, x)| x != 0).collect()
    };
    let rows: Vec<SparseRow> = (0..5).map(row).filter(|row| !row.is_empty()).collect();
    let done = Factorisation::new(motions.field(), rows.clone(), MOTIONS, task)?;
    // The motions are random; any one of those that are left is as random as another.
    let mut next = 0;
    let factors = done.kernel_vector(&rows, || {
        next += 1;
        next
    });
    Ok((motions.combined(&factors), done.rank()))
}
