//! The record of a contraction, played again: every body as a list of nodes, each with two before it
//! (docs/theory.md, Theorem 4.1).

use super::Unproved;
use super::core::eliminate;
use super::text::{Listed, Reason};
use crate::contract::{Contraction, Merge, Part, Seed};
use crate::graph::Graph;
use std::collections::{BTreeMap, HashSet};

/// The rank of a K_{2,3}.
const BICLIQUE_RANK: usize = 40;

/// The bodies of a proof that the rank is at least `rank`.
pub(super) fn all(
    graph: &Graph,
    contraction: &Contraction,
    rank: usize,
) -> Result<Vec<Listed>, Unproved> {
    let mut record = Record::new(graph, contraction.bodies.len());
    for (k, body) in contraction.bodies.iter().enumerate() {
        let mut growing = match body.seed {
            Seed::Edge(i, j) => Growing::edge(i, j),
            Seed::Body(k) => record.growing[k as usize].take().ok_or(Unproved::Record)?,
            Seed::Known => return Err(Unproved::Known),
            Seed::Rank(_) => return Err(Unproved::ByRank),
        };
        for &[v, a, b] in &body.add {
            growing.join(v, [(a, 0), (b, 0)]);
        }
        for merge in &body.merge {
            record.merge(&mut growing, merge)?;
        }
        record.growing[k] = Some(growing);
    }
    let mut sets = Vec::with_capacity(contraction.finals.len() + contraction.loose.len());
    for &k in &contraction.finals {
        sets.push(record.part(Part::Body(k))?);
    }
    sets.extend(contraction.loose.iter().map(|&(i, j)| (vec![i, j], 0)));
    if contraction.finals.is_empty() || sets.len() > 1 {
        record.done.push(of_sets(&sets, rank)?);
    }
    Ok(record.done)
}

/// A body on some sets of nodes, all pairs in each of which may be used for the reason given, that has
/// the rank `rank` at least: a core of the nodes that lie in two sets, then the others.
pub(super) fn of_sets(sets: &[(Vec<u32>, Reason)], rank: usize) -> Result<Listed, Unproved> {
    let core = core_nodes(sets);
    if core.len() > super::LARGEST_CORE {
        return Err(Unproved::Core(core.len()));
    }
    let place = |v: &u32| core.binary_search(v).ok();
    let mut joins = Vec::new();
    let mut pairs = BTreeMap::new();
    for (nodes, why) in sets {
        let (inner, outer): (Vec<u32>, Vec<u32>) = nodes.iter().partition(|v| place(v).is_some());
        for step in [1, 2] {
            let chain = inner.iter().zip(inner.iter().skip(step));
            let local = chain.filter_map(|(i, j)| place(i).zip(place(j)));
            pairs.extend(local.map(|(i, j)| ((i.min(j) as u32, i.max(j) as u32), *why)));
        }
        let mut before: Vec<(u32, Reason)> = inner.iter().take(2).map(|&v| (v, *why)).collect();
        for v in outer {
            joins.push((v, before.clone()));
            if before.len() < 2 {
                before.push((v, *why));
            }
        }
    }
    let added: usize = joins
        .iter()
        .map(|(_, before)| [0, 7, 11][before.len()])
        .sum();
    let graph = Graph::new(core.len() as u32, pairs.keys().copied()).expect("pairs of core nodes");
    let found = eliminate(&graph, rank.saturating_sub(added)).ok_or(Unproved::Unlucky)?;
    let node = |v: u32| core[v as usize];
    let rows = pairs.iter().zip(&found.masks);
    Ok(Listed {
        core: found.order.iter().map(|&(v, at)| (node(v), at)).collect(),
        rows: rows
            .filter(|&(_, &mask)| mask != 0)
            .map(|((&(i, j), &why), &mask)| (node(i), node(j), mask, why))
            .collect(),
        joins,
    })
}

/// The nodes that lie in two of the sets at least, increasing.
fn core_nodes(sets: &[(Vec<u32>, Reason)]) -> Vec<u32> {
    let mut nodes: Vec<u32> = sets.iter().flat_map(|(set, _)| set).copied().collect();
    nodes.sort_unstable();
    let mut twice: Vec<u32> = nodes
        .windows(2)
        .filter(|pair| pair[0] == pair[1])
        .map(|pair| pair[0])
        .collect();
    twice.dedup();
    twice
}

/// A body in the making.
struct Growing {
    listed: Listed,
    inside: HashSet<u32>,
}

impl Growing {
    fn edge(i: u32, j: u32) -> Self {
        let listed = Listed {
            joins: vec![(i, Vec::new()), (j, vec![(i, 0)])],
            ..Listed::default()
        };
        Self {
            listed,
            inside: HashSet::from([i, j]),
        }
    }

    fn join(&mut self, v: u32, before: [(u32, Reason); 2]) {
        if self.inside.insert(v) {
            self.listed.joins.push((v, before.to_vec()));
        }
    }

    /// Takes in nodes of a part that holds the two nodes `at` of this body.
    fn take_in(&mut self, nodes: &[u32], at: [u32; 2], why: Reason) {
        for &v in nodes {
            self.join(v, at.map(|a| (a, why)));
        }
    }
}

/// Bodies of the contraction in the making, and those of the proof.
struct Record<'a> {
    graph: &'a Graph,
    growing: Vec<Option<Growing>>,
    number: Vec<Option<Reason>>,
    done: Vec<Listed>,
}

impl<'a> Record<'a> {
    fn new(graph: &'a Graph, bodies: usize) -> Self {
        Self {
            graph,
            growing: (0..bodies).map(|_| None).collect(),
            number: vec![None; bodies],
            done: Vec::new(),
        }
    }

    fn push(&mut self, body: Listed) -> Reason {
        self.done.push(body);
        self.done.len() as Reason
    }

    /// Why pairs of nodes of a part may be used; a body is written down first.
    fn reason(&mut self, part: Part) -> Result<Reason, Unproved> {
        let Part::Body(k) = part else { return Ok(0) };
        if let Some(why) = self.number[k as usize] {
            return Ok(why);
        }
        let growing = self.growing[k as usize].take().ok_or(Unproved::Record)?;
        let why = self.push(growing.listed);
        self.number[k as usize] = Some(why);
        Ok(why)
    }

    fn part(&mut self, part: Part) -> Result<(Vec<u32>, Reason), Unproved> {
        let why = self.reason(part)?;
        Ok(match part {
            Part::Edge(i, j) => (vec![i, j], why),
            Part::Body(_) => (self.done[why as usize - 1].nodes().collect(), why),
        })
    }

    fn merge(&mut self, body: &mut Growing, merge: &Merge) -> Result<(), Unproved> {
        match *merge {
            Merge::Shared { part, at } => {
                let (nodes, why) = self.part(part)?;
                body.take_in(&nodes, at, why);
            }
            Merge::Triangle {
                parts,
                at: [a, b, c],
            } => {
                let ((of_a, why_a), (of_b, why_b)) = (self.part(parts[0])?, self.part(parts[1])?);
                body.join(c, [(a, why_a), (b, why_b)]);
                body.take_in(&of_a, [a, c], why_a);
                body.take_in(&of_b, [b, c], why_b);
            }
            Merge::Biclique { parts, at } => self.biclique(body, parts, at)?,
            Merge::Scaled { .. } | Merge::Cycle { .. } => return Err(Unproved::Model),
        }
        Ok(())
    }

    /// Theorem 10.3: the five nodes are a body by the rank of K_{2,3}, and share two with this one.
    fn biclique(
        &mut self,
        body: &mut Growing,
        parts: [Part; 5],
        [a, b, v1, v2, v3]: [u32; 5],
    ) -> Result<(), Unproved> {
        let is_edge = self
            .graph
            .edges()
            .binary_search(&(a.min(v1), a.max(v1)))
            .is_ok();
        let own = if is_edge {
            0
        } else {
            self.push(body.listed.clone())
        };
        let mut whys = [own; 6];
        let mut nodes: [Vec<u32>; 5] = Default::default();
        for (k, part) in parts.into_iter().enumerate() {
            (nodes[k], whys[k + 1]) = self.part(part)?;
        }
        let pairs = [(a, v1), (v1, b), (a, v2), (v2, b), (a, v3), (v3, b)];
        let five = [a, b, v1, v2, v3];
        let local =
            Graph::new(5, [(0, 2), (1, 2), (0, 3), (1, 3), (0, 4), (1, 4)]).expect("K_{2,3}");
        let found = eliminate(&local, BICLIQUE_RANK).ok_or(Unproved::Unlucky)?;
        let row = |(&(i, j), &mask): (&(u32, u32), &u32)| {
            let (i, j) = (five[i as usize], five[j as usize]);
            let at = pairs
                .iter()
                .position(|&(x, y)| (x, y) == (i, j) || (x, y) == (j, i));
            (i, j, mask, whys[at.expect("one of the six")])
        };
        let why = self.push(Listed {
            core: found
                .order
                .iter()
                .map(|&(v, c)| (five[v as usize], c))
                .collect(),
            rows: local.edges().iter().zip(&found.masks).map(row).collect(),
            joins: Vec::new(),
        });
        body.take_in(&five, [a, v1], why);
        for (k, nodes) in nodes.iter().enumerate() {
            body.take_in(nodes, pairs[k + 1].into(), whys[k + 1]);
        }
        Ok(())
    }
}
