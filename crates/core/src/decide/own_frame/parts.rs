//! What is unknown where displacements have a frame of their own, and what counting says of it
//! (docs/theory.md, Theorem 13.30).

use std::collections::{BTreeMap, BTreeSet};

use super::TurningPart;
use crate::contract::Contraction;
use crate::contract::piece::Members as Block;
use crate::geometry::placed::Placed;
use crate::graph::{Displacements, Graph, UnionFind, gcd};

/// A body or a loose edge.
pub(super) struct Member {
    body: Option<u32>,
    /// All its nodes, increasing.
    pub(super) nodes: Vec<u32>,
    pub(super) scaled: bool,
    /// The part it lies in.
    pub(super) part: usize,
}

/// The members of a graph, by parts: what shared nodes connect.
pub(super) struct Parts {
    pub(super) members: Vec<Member>,
    /// For every node its group, if it is in one.
    pub(super) group: Vec<Option<u32>>,
    /// How many groups there are.
    pub(super) groups: usize,
    /// Where nodes of groups are, if vectors are given.
    pub(super) vectors: Option<Placed>,
    /// For every part the number of its rotation, if it has nodes of groups.
    pub(super) turns: Vec<Option<usize>>,
    /// The nodes of no member, increasing.
    pub(super) alone: Vec<u32>,
}

/// A direction between two nodes of a group: a vector without its length and sign, or, where no vectors are
/// given, the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Direction {
    Along([i128; 3]),
    Between(u32, u32),
}

/// The directions that are given of some nodes: none, one, or such as are not parallel.
#[derive(Clone, Debug, Default)]
pub(super) struct Span(BTreeSet<Direction>);

impl Span {
    /// How many there are; what is beyond two counts as two.
    pub(super) fn len(&self) -> usize {
        self.0.len().min(2)
    }

    /// Whether two are not parallel: then they show how what holds them is turned.
    pub(super) fn is_wide(&self) -> bool {
        self.0.len() > 1
    }
}

impl Parts {
    pub(super) fn new(graph: &Graph, contraction: &Contraction, given: &Displacements) -> Self {
        let bodies = contraction.finals.iter().map(|&body| {
            let found = &contraction.bodies[body as usize];
            (Some(body), found.nodes.clone(), found.scaled)
        });
        let loose = contraction.loose.iter();
        let loose = loose.map(|&(i, j)| (None, vec![i, j], false));
        let mut sets = UnionFind::new(graph.nodes());
        let mut held = vec![false; graph.nodes()];
        let members: Vec<_> = bodies.chain(loose).collect();
        for (_, nodes, _) in &members {
            for &v in nodes {
                sets.union(nodes[0] as usize, v as usize);
                held[v as usize] = true;
            }
        }
        let mut group = vec![None; graph.nodes()];
        for (g, nodes) in (0..).zip(given.groups()) {
            nodes.iter().for_each(|&v| group[v as usize] = Some(g));
        }
        let mut number = BTreeMap::new();
        let (mut turns, mut turning) = (Vec::new(), 0);
        for v in (0..graph.nodes()).filter(|&v| held[v]) {
            let part = *number.entry(sets.find(v)).or_insert_with(|| {
                turns.push(None);
                turns.len() - 1
            });
            if group[v].is_some() && turns[part].is_none() {
                turns[part] = Some(turning);
                turning += 1;
            }
        }
        let members = members.into_iter().map(|(body, nodes, scaled)| Member {
            body,
            part: number[&sets.find(nodes[0] as usize)],
            nodes,
            scaled,
        });
        Self {
            members: members.collect(),
            group,
            groups: given.groups().len(),
            vectors: Placed::new(graph.nodes(), given),
            turns,
            alone: (0..graph.nodes() as u32)
                .filter(|&v| !held[v as usize])
                .collect(),
        }
    }

    /// How many parts have a rotation.
    pub(super) fn turning_count(&self) -> usize {
        self.turns.iter().flatten().count()
    }

    /// How many numbers are unknown: three for every node in no group, every group, every part with
    /// nodes of groups, and every node of a group that nothing else holds, whose camera is turned in
    /// some way.
    pub(super) fn unknowns(&self) -> usize {
        let free = self.group.iter().filter(|group| group.is_none()).count();
        let alone = self.alone.iter();
        let alone = alone.filter(|&&v| self.group[v as usize].is_some()).count();
        3 * (free + self.groups + self.turning_count() + alone)
    }

    /// The nodes of some members, increasing.
    pub(super) fn nodes_of(&self, members: &[usize]) -> Vec<u32> {
        let nodes = members.iter().flat_map(|&m| &self.members[m].nodes);
        let mut nodes: Vec<u32> = nodes.copied().collect();
        crate::graph::sort_once(&mut nodes);
        nodes
    }

    /// Whether a member has a known scale.
    pub(super) fn is_scaled(&self, members: &[usize]) -> bool {
        members.iter().any(|&m| self.members[m].scaled)
    }

    /// The members as certificates name them.
    pub(super) fn block(&self, members: &[usize]) -> Block {
        let mut block = Block::default();
        for member in members.iter().map(|&m| &self.members[m]) {
            match member.body {
                Some(body) => block.bodies.push(body),
                None => block.edges.push((member.nodes[0], member.nodes[1])),
            }
        }
        block
    }

    /// Adds the directions that are given between some nodes.
    pub(super) fn widen(&self, span: &mut Span, nodes: &[u32]) {
        let mut first: BTreeMap<u32, u32> = BTreeMap::new();
        for &v in nodes {
            let Some(group) = self.group[v as usize].filter(|_| !span.is_wide()) else {
                continue;
            };
            let u = *first.entry(group).or_insert(v);
            if u == v {
                continue;
            }
            span.0.insert(match &self.vectors {
                None => Direction::Between(u, v),
                Some(vectors) => Direction::Along(primitive(vectors.between(u, v))),
            });
        }
    }

    /// What bodies show of the rotation of each part that has one.
    pub(super) fn spans(&self) -> Vec<Span> {
        let mut spans = vec![Span::default(); self.turning_count()];
        for member in &self.members {
            if let Some(turn) = self.turns[member.part] {
                self.widen(&mut spans[turn], &member.nodes);
            }
        }
        spans
    }

    /// The parts with nodes of groups.
    pub(super) fn turning(&self) -> Vec<TurningPart> {
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (m, member) in self.members.iter().enumerate() {
            if let Some(turn) = self.turns[member.part] {
                members.entry(turn).or_default().push(m);
            }
        }
        let part = |members: &Vec<usize>| {
            let nodes = self.nodes_of(members);
            let given = nodes.iter().copied();
            let given = given.filter(|&v| self.group[v as usize].is_some());
            let given: Vec<u32> = given.collect();
            let mut span = Span::default();
            self.widen(&mut span, &nodes);
            let groups: BTreeSet<_> = given.iter().map(|&v| self.group[v as usize]).collect();
            TurningPart {
                nodes,
                given,
                turns: groups.len() == 1 && !span.is_wide(),
                is_fixed: false,
            }
        };
        members.values().map(part).collect()
    }

    /// What some members of one part add to the rank at most (Theorem 13.30 b).
    fn bound(&self, members: &[usize]) -> usize {
        let nodes = self.nodes_of(members);
        let groups = nodes.iter().filter_map(|&v| self.group[v as usize]);
        let held = groups.clone().count();
        let groups: BTreeSet<u32> = groups.collect();
        let scale = 1 - usize::from(self.is_scaled(members));
        let mut span = Span::default();
        self.widen(&mut span, &nodes);
        let free = nodes.len() - held;
        let motions = match span.len() {
            _ if held == 0 => 3 + scale,
            0 => 6 + scale,
            1 => 4,
            _ => 3,
        };
        3 * (free + groups.len() + usize::from(held > 0)) - motions
    }

    /// The better partition of each part, by what moves alike or not at all, and the bound they give.
    pub(super) fn blocks(&self, classes: &[usize]) -> (Vec<Block>, usize) {
        let mut parts: BTreeMap<usize, BTreeMap<usize, Vec<usize>>> = BTreeMap::new();
        for (m, member) in self.members.iter().enumerate() {
            let part = parts.entry(member.part).or_default();
            part.entry(classes[m]).or_default().push(m);
        }
        let (mut blocks, mut sum) = (Vec::new(), 0);
        for classes in parts.into_values() {
            let mut whole: Vec<usize> = classes.values().flatten().copied().collect();
            whole.sort_unstable();
            let apart = classes.values().map(|class| self.bound(class)).sum();
            let together = self.bound(&whole);
            sum += together.min(apart);
            if together <= apart {
                blocks.push(self.block(&whole));
            } else {
                blocks.extend(classes.values().map(|class| self.block(class)));
            }
        }
        (blocks, sum)
    }
}

/// A vector without its length and sign.
fn primitive(vector: [i128; 3]) -> [i128; 3] {
    let length = vector.into_iter().fold(0, gcd).max(1);
    let is_negative = vector.iter().find(|&&n| n != 0).is_some_and(|&n| n < 0);
    let length = if is_negative { -length } else { length };
    vector.map(|n| n / length)
}
