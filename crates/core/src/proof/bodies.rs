//! The record of a contraction, played again: every body as a list of nodes, each with two before it
//! (docs/theory.md, Theorem 4.1).

use super::Unproved;
use super::core::eliminate;
use super::eliminated::Eliminated;
use super::listed::{Listed, Reason};
use crate::contract::{Contraction, Members, Merge, Part, Seed};
use crate::geometry::model::Model;
use crate::graph::Graph;
use std::collections::{BTreeMap, HashSet};

/// Nodes, all pairs of which may be used for the reason given.
pub(super) type Set = (Vec<u32>, Reason);

/// A body that has the rank `rank` at least: a core of the nodes that lie in two sets (those
/// that hang on one node left aside), then the others.
pub(super) fn of_sets(model: Model, sets: &[Set], rank: usize) -> Result<Listed, Unproved> {
    let frame = Frame::of(model, sets)?;
    let found = eliminate(model, &frame.graph, frame.of_core(rank), |_| true);
    Ok(frame.listed(&found.ok_or(Unproved::Unlucky)?))
}

/// The same, and a motion of its core that moves sets which share a node differently, unless they
/// are in one interval: for some nodes of the core in the one and in the other, the pair of these
/// forbids it.
pub(super) fn of_sets_told_apart(
    model: Model,
    sets: &[Set],
    rank: usize,
    interval: impl Fn(usize) -> usize,
) -> Result<(Listed, Vec<u32>), Unproved> {
    let frame = Frame::of(model, sets)?;
    let cores: Vec<Vec<usize>> = sets.iter().map(|(nodes, _)| frame.places(nodes)).collect();
    let mut of_node = vec![Vec::new(); frame.core.len()];
    for (k, core) in cores.iter().enumerate() {
        core.iter().for_each(|&v| of_node[v].push(k));
    }
    let told_apart = |found: &Eliminated| {
        let differ = |k: usize, l: usize| {
            let mut pairs = cores[k]
                .iter()
                .flat_map(|&x| cores[l].iter().map(move |&y| (x, y)));
            interval(k) == interval(l) || pairs.any(|(x, y)| x != y && !found.allows(x, y))
        };
        of_node.iter().all(|near| {
            let pairs = near.iter().enumerate();
            pairs
                .into_iter()
                .all(|(at, &k)| near[..at].iter().all(|&l| differ(k, l)))
        })
    };
    let found = eliminate(model, &frame.graph, frame.of_core(rank), told_apart);
    let found = found.ok_or(Unproved::Unlucky)?;
    Ok((frame.listed(&found), found.motion()))
}

/// The core of some sets, and the other nodes.
struct Frame {
    model: Model,
    /// Nodes that lie in two sets, increasing.
    core: Vec<u32>,
    /// On their places: as many pairs in each set as it takes to make its nodes one body.
    graph: Graph,
    reasons: Vec<Reason>,
    joins: Vec<(u32, Vec<(u32, Reason)>)>,
}

impl Frame {
    fn of(model: Model, sets: &[Set]) -> Result<Self, Unproved> {
        let Ends { core, leaves } = Ends::of(sets);
        if core.len() > super::LARGEST_CORE {
            return Err(Unproved::Core(core.len()));
        }
        let place = |v: &u32| core.binary_search(v).ok();
        let mut joins = Vec::new();
        let mut pairs = BTreeMap::new();
        let is_leaf: HashSet<usize> = leaves.iter().map(|&(k, _)| k).collect();
        for (_, (nodes, why)) in sets
            .iter()
            .enumerate()
            .filter(|(k, _)| !is_leaf.contains(k))
        {
            let (inner, outer): (Vec<u32>, Vec<u32>) =
                nodes.iter().partition(|v| place(v).is_some());
            for step in [1, 2] {
                let chain = inner.iter().zip(inner.iter().skip(step));
                let local = chain.filter_map(|(i, j)| place(i).zip(place(j)));
                pairs.extend(local.map(|(i, j)| ((i.min(j) as u32, i.max(j) as u32), *why)));
            }
            join_all(&mut joins, inner.into_iter().take(2), outer, *why);
        }
        for &(k, at) in leaves.iter().rev() {
            let (nodes, why) = &sets[k];
            let others = nodes.iter().copied().filter(|&v| Some(v) != at);
            join_all(&mut joins, at.into_iter(), others, *why);
        }
        let graph = Graph::new(core.len() as u32, pairs.keys().copied());
        Ok(Self {
            model,
            graph: graph.expect("pairs of core nodes"),
            reasons: pairs.into_values().collect(),
            core,
            joins,
        })
    }

    /// Where nodes stand in the core, those that do.
    fn places(&self, nodes: &[u32]) -> Vec<usize> {
        let place = |v| self.core.binary_search(v).ok();
        nodes.iter().filter_map(place).collect()
    }

    /// What the core has to have of a rank.
    fn of_core(&self, rank: usize) -> usize {
        let added = self
            .joins
            .iter()
            .map(|(_, before)| self.model.joined()[before.len()]);
        rank.saturating_sub(added.sum())
    }

    fn listed(&self, found: &Eliminated) -> Listed {
        let node = |v: u32| self.core[v as usize];
        let rows = self.graph.edges().iter().zip(&self.reasons);
        Listed {
            core: found.core(node),
            rows: rows
                .zip(&found.masks)
                .filter(|&(_, &mask)| mask != 0 || !found.flows.is_empty())
                .map(|((&(i, j), &why), &mask)| (node(i), node(j), mask, why))
                .collect(),
            flows: found.flows.clone(),
            joins: self.joins.clone(),
        }
    }
}

/// Joins nodes of a set to two of those before.
fn join_all(
    joins: &mut Vec<(u32, Vec<(u32, Reason)>)>,
    first: impl Iterator<Item = u32>,
    others: impl IntoIterator<Item = u32>,
    why: Reason,
) {
    let mut before: Vec<(u32, Reason)> = first.map(|v| (v, why)).collect();
    for v in others {
        joins.push((v, before.clone()));
        if before.len() < 2 {
            before.push((v, why));
        }
    }
}

/// Sets that are taken off one after the other, as long as there is one that shares at most one
/// node with those that are left, and what is left then.
struct Ends {
    /// The nodes that lie in two of the sets that are left at least, increasing.
    core: Vec<u32>,
    /// The sets that were taken off, with that node.
    leaves: Vec<(usize, Option<u32>)>,
}

impl Ends {
    fn of(sets: &[Set]) -> Self {
        // For every node that two sets share: how many are left, and the sum of their numbers.
        let mut near: BTreeMap<u32, (usize, usize)> =
            core_nodes(sets).into_iter().map(|v| (v, (0, 0))).collect();
        for (k, (nodes, _)) in sets.iter().enumerate() {
            for v in nodes {
                near.entry(*v)
                    .and_modify(|(count, sum)| (*count, *sum) = (*count + 1, *sum + k));
            }
        }
        let mut left: Vec<HashSet<u32>> = sets
            .iter()
            .map(|(nodes, _)| {
                nodes
                    .iter()
                    .copied()
                    .filter(|v| near.contains_key(v))
                    .collect()
            })
            .collect();
        let mut leaves = Vec::new();
        let mut waiting: Vec<usize> = (0..sets.len()).filter(|&k| left[k].len() < 2).collect();
        while let Some(k) = waiting.pop() {
            let at = left[k].drain().next();
            leaves.push((k, at));
            let Some(v) = at else { continue };
            let (count, sum) = near.get_mut(&v).expect("a shared node");
            (*count, *sum) = (*count - 1, *sum - k);
            if *count == 1 {
                let last = *sum;
                left[last].remove(&v);
                if left[last].len() == 1 {
                    waiting.push(last);
                }
            }
        }
        near.retain(|_, (count, _)| *count > 1);
        Self {
            core: near.into_keys().collect(),
            leaves,
        }
    }
}

/// The nodes that lie in two of the sets at least, increasing.
fn core_nodes(sets: &[Set]) -> Vec<u32> {
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
pub(super) struct Record {
    model: Model,
    edges: Vec<(u32, u32)>,
    growing: Vec<Option<Growing>>,
    number: Vec<Option<Reason>>,
    pub(super) done: Vec<Listed>,
}

impl Record {
    /// The bodies of a contraction, the final ones written down.
    pub(super) fn of(
        model: Model,
        graph: &Graph,
        contraction: &Contraction,
    ) -> Result<Self, Unproved> {
        let bodies = contraction.bodies.len();
        let mut record = Self {
            model,
            edges: graph.edges().to_vec(),
            growing: (0..bodies).map(|_| None).collect(),
            number: vec![None; bodies],
            done: Vec::new(),
        };
        for (k, body) in contraction.bodies.iter().enumerate() {
            let mut growing = match body.seed {
                Seed::Edge(i, j) => Growing::edge(i, j),
                Seed::Body(k) => record.growing[k as usize].take().ok_or(Unproved::Record)?,
                Seed::Known => return Err(Unproved::Known),
                Seed::Rank(k) => record.of_rank(&contraction.by_rank[k as usize])?,
            };
            for &[v, a, b] in &body.add {
                growing.join(v, [(a, 0), (b, 0)]);
            }
            for merge in &body.merge {
                record.merge(&mut growing, merge)?;
            }
            record.growing[k] = Some(growing);
        }
        for &k in &contraction.finals {
            record.reason(Part::Body(k))?;
        }
        Ok(record)
    }

    /// A body by rank, from members that are written down first (Proposition 4.15).
    fn of_rank(&mut self, members: &Members) -> Result<Growing, Unproved> {
        for &k in &members.bodies {
            self.reason(Part::Body(k))?;
        }
        let nodes = self.nodes(members);
        let listed = of_sets(
            self.model,
            &self.sets(members),
            self.model.full(nodes.len()),
        )?;
        Ok(Growing {
            listed,
            inside: nodes.into_iter().collect(),
        })
    }

    /// Members of the contraction, each with the reason by which its pairs may be used.
    fn sets(&self, members: &Members) -> Vec<Set> {
        let body = |&k: &u32| {
            let why = self.number[k as usize].expect("a body that is written down");
            (self.done[why as usize - 1].nodes().collect(), why)
        };
        let bodies = members.bodies.iter().map(body);
        bodies
            .chain(members.edges.iter().map(|&(i, j)| (vec![i, j], 0)))
            .collect()
    }

    /// The nodes of some members, increasing.
    pub(super) fn nodes(&self, members: &Members) -> Vec<u32> {
        let sets = self.sets(members).into_iter();
        let mut nodes: Vec<u32> = sets.flat_map(|(nodes, _)| nodes).collect();
        crate::graph::sort_once(&mut nodes);
        nodes
    }

    /// The nodes of members that are rigid together, and the reason by which all their pairs may be
    /// used; a body is written down for it.
    pub(super) fn rigid(&mut self, members: &Members) -> Result<Set, Unproved> {
        let mut sets = self.sets(members);
        if let ([(_, why)], 1) = (&sets[..], members.bodies.len()) {
            let why = *why;
            return Ok((sets.swap_remove(0).0, why));
        }
        let nodes = self.nodes(members);
        let body = match &members.edges[..] {
            &[(i, j)] if members.bodies.is_empty() => Growing::edge(i, j).listed,
            _ => of_sets(self.model, &sets, self.model.full(nodes.len()))?,
        };
        Ok((nodes, self.push(body)))
    }

    /// All members, for the last body, which shows the rank; none if there is one body, which does.
    pub(super) fn last(&self, contraction: &Contraction) -> Vec<Set> {
        let all = Members {
            bodies: contraction.finals.clone(),
            edges: contraction.loose.clone(),
        };
        match (all.bodies.len(), all.edges.len()) {
            (1, 0) => Vec::new(),
            _ => self.sets(&all),
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
            Merge::Cycle { parts, at } => self.cycle(body, parts, at)?,
            Merge::Tripod { at, .. } => self.tripod(body, merge.parts(), at)?,
            Merge::Link { parts, at } => self.link(body, parts, at)?,
            Merge::Scaled { .. } => return Err(Unproved::Known),
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
        let pairs = [(v1, b), (a, v2), (v2, b), (a, v3), (v3, b)].map(|pair| vec![pair]);
        self.around(body, &parts, &[(a, v1)], &pairs)
    }

    /// Theorem 19.7, as [`biclique`](Self::biclique).
    fn tripod(
        &mut self,
        body: &mut Growing,
        parts: &[Part],
        [a, b, c, d, e, f]: [u32; 6],
    ) -> Result<(), Unproved> {
        let mut pairs = vec![vec![(a, d)], vec![(d, e)], vec![(e, b)], vec![(f, c)]];
        match parts.len() {
            4 => pairs[1].extend([(d, f), (e, f)]),
            _ => pairs.push(vec![(d, f)]),
        }
        self.around(body, parts, &[(a, b), (a, c), (b, c)], &pairs)
    }

    /// Theorem 19.8, as [`biclique`](Self::biclique).
    fn link(
        &mut self,
        body: &mut Growing,
        parts: [Part; 5],
        [a, b, c, d, e, f, g]: [u32; 7],
    ) -> Result<(), Unproved> {
        let held = |x: u32, y: u32, z: u32| {
            let mut pairs = vec![(x, y)];
            if z != x && z != y {
                pairs.extend([(x, z), (y, z)]);
            }
            pairs
        };
        let ways = [(a, d), (b, e), (c, g), (g, f)];
        let others = ways.map(|pair| vec![pair]);
        let pairs: Vec<_> = [held(d, e, f)].into_iter().chain(others).collect();
        self.around(body, &parts, &held(a, b, c), &pairs)
    }

    /// Rule 5 of Theorem 4.9: the four nodes are a body by rank, and share two with this one.
    fn cycle(
        &mut self,
        body: &mut Growing,
        parts: [Part; 3],
        [a, b, c, d]: [u32; 4],
    ) -> Result<(), Unproved> {
        let pairs = [(a, b), (b, c), (c, d)].map(|pair| vec![pair]);
        self.around(body, &parts, &[(d, a)], &pairs)
    }

    /// Some nodes are a body by the rank of pairs: this body holds its own ones, and each part those in
    /// its place.
    fn around(
        &mut self,
        body: &mut Growing,
        parts: &[Part],
        own: &[(u32, u32)],
        of_parts: &[Vec<(u32, u32)>],
    ) -> Result<(), Unproved> {
        let is_edge = |&(i, j): &(u32, u32)| {
            let edge = (i.min(j), i.max(j));
            self.edges.binary_search(&edge).is_ok()
        };
        let why = if own.iter().all(is_edge) {
            0
        } else {
            self.push(body.listed.clone())
        };
        let mut whys = vec![why];
        let mut held = Vec::new();
        for &part in parts {
            let (nodes, why) = self.part(part)?;
            held.push(nodes);
            whys.push(why);
        }
        let all = || std::iter::once(own).chain(of_parts.iter().map(Vec::as_slice));
        let pairs: Vec<((u32, u32), usize)> = (0..)
            .zip(all())
            .flat_map(|(k, pairs)| pairs.iter().map(move |&pair| (pair, k)))
            .collect();
        let mut hinges: Vec<u32> = pairs.iter().flat_map(|&((i, j), _)| [i, j]).collect();
        crate::graph::sort_once(&mut hinges);
        let place = |v: u32| hinges.binary_search(&v).expect("a hinge") as u32;
        let local = pairs.iter().map(|&((i, j), _)| (place(i), place(j)));
        let local = Graph::new(hinges.len() as u32, local).expect("pairs of the hinges");
        let rank = self.model.full(hinges.len());
        let found = eliminate(self.model, &local, rank, |_| true).ok_or(Unproved::Unlucky)?;
        let row = |(&(i, j), &mask): (&(u32, u32), &u32)| {
            let (i, j) = (hinges[i as usize], hinges[j as usize]);
            let same = |&&((x, y), _): &&((u32, u32), usize)| (x.min(y), x.max(y)) == (i, j);
            let &(_, k) = pairs.iter().find(same).expect("one of the pairs");
            (i, j, mask, whys[k])
        };
        let why = self.push(Listed {
            core: found.core(|v| hinges[v as usize]),
            rows: local.edges().iter().zip(&found.masks).map(row).collect(),
            ..Listed::default()
        });
        body.take_in(&hinges, own[0].into(), why);
        for (k, nodes) in held.iter().enumerate() {
            body.take_in(nodes, of_parts[k][0].into(), whys[k + 1]);
        }
        Ok(())
    }
}
