//! Sets of nodes that are uniquely determined, one after the other: pairs, what rules 2 and 3 of
//! Theorem 4.1 merge, and what linear algebra settles (docs/theory.md, Theorem 10.6).
//!
//! In: the pairs of a graph. Out: a list of such sets with their proofs, the last one of which holds
//! all nodes. Nothing rests on how they are found.

use super::links::{Member, Unique, Via, pairs};
use super::listed::{Join, Reason};
use super::scales;
use std::collections::BTreeSet;

/// Graphs with more pairs are not tried: the search takes more than O(m^3).
const MOST_PAIRS: usize = 200;

/// Sets, the last one of which holds all nodes; `None` if there are none that were found.
/// The first one has the number `first`.
pub(super) fn determine_all(
    edges: &[(u32, u32)],
    nodes: usize,
    first: Reason,
) -> Option<Vec<Unique>> {
    if edges.len() > MOST_PAIRS {
        return None;
    }
    let pair = |&(i, j): &(u32, u32)| Member {
        nodes: BTreeSet::from([i, j]),
        why: 0,
    };
    let mut members: Vec<Member> = edges.iter().map(pair).collect();
    let mut found = Vec::new();
    loop {
        let merged = shared(&members)
            .or_else(|| triangle(&members))
            .or_else(|| biclique(&members))
            .or_else(|| all(&members, nodes))?;
        let (used, unique) = merged;
        let union = used.iter().flat_map(|&k| members[k].nodes.iter().copied());
        let nodes_of: BTreeSet<u32> = union.collect();
        found.push(unique);
        if nodes_of.len() == nodes {
            return Some(found);
        }
        let mut at = 0..members.len();
        members.retain(|_| !used.contains(&at.next().expect("a member")));
        members.push(Member {
            nodes: nodes_of,
            why: first + found.len() as Reason - 1,
        });
    }
}

type Merged = (Vec<usize>, Unique);

/// Nodes in the order in which they join.
#[derive(Default)]
struct Growing {
    joins: Vec<Join>,
    inside: BTreeSet<u32>,
}

impl Growing {
    /// All nodes of a member, two of them first.
    fn of(member: &Member, at: [u32; 2]) -> Self {
        let mut growing = Self::default();
        growing.join(at[0], Vec::new());
        growing.join(at[1], vec![(at[0], member.why)]);
        growing.take_in(member, at);
        growing
    }

    fn join(&mut self, v: u32, before: Vec<(u32, Reason)>) {
        if self.inside.insert(v) {
            self.joins.push((v, before));
        }
    }

    /// A member that holds two of the nodes.
    fn take_in(&mut self, member: &Member, at: [u32; 2]) {
        for &v in &member.nodes {
            self.join(v, at.map(|a| (a, member.why)).to_vec());
        }
    }
}

/// Rule 2: two members that share two nodes.
fn shared(members: &[Member]) -> Option<Merged> {
    let (k, l, at) = pairs(members.len()).find_map(|(k, l)| {
        let mut both = members[k].nodes.intersection(&members[l].nodes);
        Some((k, l, [*both.next()?, *both.next()?]))
    })?;
    let mut growing = Growing::of(&members[k], at);
    growing.take_in(&members[l], at);
    Some((vec![k, l], of_joins(growing)))
}

/// Rule 3: three members that share a node pairwise.
fn triangle(members: &[Member]) -> Option<Merged> {
    let common = |k: usize, l: usize| {
        let mut both = members[k].nodes.intersection(&members[l].nodes);
        both.next().copied()
    };
    let (three, [a, b, c]) = pairs(members.len()).find_map(|(k, l)| {
        let b = common(k, l)?;
        ((l + 1)..members.len()).find_map(|m| {
            let (a, c) = (common(k, m)?, common(l, m)?);
            (a != b && b != c && a != c).then_some(([k, l, m], [a, b, c]))
        })
    })?;
    let [of_ab, of_bc, of_ac] = three.map(|k| &members[k]);
    let mut growing = Growing::of(of_ab, [a, b]);
    growing.join(c, vec![(a, of_ac.why), (b, of_bc.why)]);
    growing.take_in(of_bc, [b, c]);
    growing.take_in(of_ac, [a, c]);
    Some((three.to_vec(), of_joins(growing)))
}

/// Theorem 10.3: two nodes that are joined to each of three others.
fn biclique(members: &[Member]) -> Option<Merged> {
    let nodes: BTreeSet<u32> = members
        .iter()
        .flat_map(|member| member.nodes.iter().copied())
        .collect();
    let with = |v: u32, w: u32| {
        let both = |member: &Member| member.nodes.contains(&v) && member.nodes.contains(&w);
        members.iter().position(both)
    };
    let list: Vec<u32> = nodes.into_iter().collect();
    pairs(list.len()).find_map(|(a, b)| {
        let (a, b) = (list[a], list[b]);
        if with(a, b).is_some() {
            return None;
        }
        let between = list.iter().filter(|&&v| v != a && v != b);
        let between = between.filter_map(|&v| Some([with(a, v)?, with(v, b)?]));
        let three: Vec<usize> = between.take(3).flatten().collect();
        let used: BTreeSet<usize> = three.iter().copied().collect();
        (three.len() == 6 && used.len() == 6).then_some(())?;
        let used: Vec<usize> = used.into_iter().collect();
        linear(members, &used).map(|unique| (used, unique))
    })
}

/// All members, by linear algebra.
fn all(members: &[Member], nodes: usize) -> Option<Merged> {
    let used: Vec<usize> = (0..members.len()).collect();
    let unique = linear(members, &used)?;
    (unique.core.len() + unique.joins.len() == nodes).then_some((used, unique))
}

fn linear(members: &[Member], used: &[usize]) -> Option<Unique> {
    let members: Vec<&Member> = used.iter().map(|&k| &members[k]).collect();
    let mut unique = scales::settle(&members)?;
    let inside = unique.core.iter().map(|&(v, _)| v).collect();
    let mut growing = Growing {
        joins: Vec::new(),
        inside,
    };
    for link in scales::middles(&members) {
        if let (ends, Via::Middle { node, whys }) = (link.ends, link.via) {
            growing.join(node, vec![(ends[0], whys[0]), (ends[1], whys[1])]);
        }
    }
    for member in members {
        let placed = member.nodes.intersection(&growing.inside);
        let at: Vec<u32> = placed.copied().take(2).collect();
        growing.take_in(member, [*at.first()?, *at.get(1)?]);
    }
    unique.joins = growing.joins;
    Some(unique)
}

fn of_joins(growing: Growing) -> Unique {
    Unique {
        joins: growing.joins,
        ..Unique::default()
    }
}
