//! A graph as it is drawn: nodes, lines between them, and the groups that are told apart by colours.
//!
//! In: a graph and its verdict. Out: a picture ([`Scene::svg`]), or places and colours for pictures of others.
//! Of a camera-point graph the nodes are the images, and a line joins two that see points together.
//! A line lies in one component and has its colour. A node may lie in several, a *hinge*.
//! Of a large graph some nodes are drawn, each for those near it; of many lines, those that hold the picture together.

mod layout;
mod svg;

use crate::{Report, counted};
use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap, VecDeque};
use viewcert::decide::{Component, Verdict};
use viewcert::graph::{Lists, UnionFind};
use viewcert_formats::NamedGraph;

pub use svg::{COLOURS, document, escaped, text};

/// Most nodes that are all drawn; of more, so many, and of these so many outside the largest component.
const MOST_NODES: usize = 1000;
const SAMPLED: usize = 600;
const MOST_OUTSIDE: usize = 200;
/// Most lines of a kind that are all drawn; of more, a forest and the strongest so many of each node.
const MOST_LINES: usize = 6000;
const STRONGEST: usize = 5;
/// Colours, then colours with other shapes, tell so many groups apart.
const MARKS: usize = 4 * COLOURS.len();

/// What a line stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A pair of the graph, or images that see points together.
    Pair,
    /// Images that are matched, and no track of theirs counts.
    Short,
    /// Images that would help if they were matched.
    Suggested,
    /// Images whose pair is in a contradiction.
    Contradicting,
}

/// A line between two nodes, the smaller one first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The two nodes.
    pub ends: (u32, u32),
    /// Its group, if it is in one.
    pub group: Option<u32>,
    /// What it stands for.
    pub kind: Kind,
    /// How many points, or lines, it stands for.
    pub weight: u32,
}

/// How a group looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mark {
    /// A colour and a shape of its own.
    Own(usize),
    /// Larger than a pair, but not among the largest.
    Other,
    /// A single pair among larger groups.
    Pair,
}

/// A graph as it is drawn.
pub struct Scene {
    /// Above the picture.
    pub title: String,
    /// Of each node.
    pub names: Vec<String>,
    /// What each group is, in words.
    pub groups: Vec<String>,
    /// How many groups, the first ones, have more than one edge.
    pub larger: usize,
    /// For every node its groups, increasing.
    pub groups_of: Lists,
    /// The lines.
    pub edges: Vec<Edge>,
    /// What an edge of the graph is.
    pub edge: &'static str,
}

impl Scene {
    /// A graph with the components of its verdict. O(n + m log n), and for tracks O(k log k) with k pairs of
    /// images that see a point together, with repetition.
    pub fn new(input: &NamedGraph, verdict: &Verdict) -> Self {
        let mut scene = Self::with(input, &verdict.components);
        let count = counted(verdict.components.len(), "component");
        scene.title = format!("{}, {count}", scene.title);
        scene
    }

    /// A graph of which nothing is decided.
    pub fn plain(input: &NamedGraph) -> Self {
        Self::with(input, &[])
    }

    fn with(input: &NamedGraph, components: &[Component]) -> Self {
        let nodes = input.cameras.unwrap_or(input.graph.nodes() as u32);
        let counts = |component: &&Component| input.cameras.is_none() || component.edge_count() > 1;
        let members = components.iter().take_while(counts).map(Component::nodes);
        let members: Vec<(u32, u32)> = (0..)
            .zip(members)
            .flat_map(|(k, members)| members.into_iter().map(move |v| (v, k)))
            .filter(|&(v, _)| v < nodes)
            .collect();
        let groups_of = Lists::group(nodes as usize, members.into_iter());
        let groups = components.iter().map(|component| {
            let cameras = component.nodes().partition_point(|&v| v < nodes);
            size(
                cameras,
                component.node_count() - cameras,
                component.edge_count(),
            )
        });
        let names = (0..nodes).map(|v| input.labels.label(v).into_owned());
        let edges = together(input).into_iter().map(|(ends, weight)| Edge {
            ends,
            group: shared(&groups_of, ends),
            kind: Kind::Pair,
            weight,
        });
        let (cameras, all) = (nodes as usize, input.graph.nodes());
        let size = size(cameras, all - cameras, input.graph.edges().len());
        Self {
            title: format!("{}: {size}", input.name),
            names: names.collect(),
            groups: groups.collect(),
            larger: components.partition_point(|component| component.edge_count() > 1),
            edges: edges.collect(),
            groups_of,
            edge: if input.cameras.is_some() {
                "observation"
            } else {
                "pair"
            },
        }
    }

    /// The graph of a report with what is suggested, with `matched` pairs beside tracks, and with the names of pairs
    /// that contradict each other.
    pub(crate) fn of(
        report: &Report,
        matched: &[(u32, u32)],
        contradicting: &[[Cow<'_, str>; 2]],
    ) -> Self {
        let mut scene = Self::new(report.input, report.verdict);
        let suggested = report.advice.suggestions.iter().flatten();
        let suggested = suggested.flat_map(|one| &one.pairs);
        let nodes: HashMap<&str, u32> = (scene.names.iter().map(String::as_str)).zip(0..).collect();
        let node = |name: &str| nodes.get(name).copied();
        let suggested = suggested.filter_map(|[a, b]| Some((node(a)?, node(b)?)));
        let suggested: Vec<(u32, u32)> = suggested.collect();
        let off = contradicting.iter();
        let off = off.filter_map(|[a, b]| Some((node(a)?, node(b)?)));
        let off: Vec<(u32, u32)> = off.collect();
        let count = scene.edges.len();
        for (kind, pairs) in [
            (Kind::Short, matched),
            (Kind::Suggested, &suggested),
            (Kind::Contradicting, &off),
        ] {
            let ordered = pairs.iter().map(|&(a, b)| (a.min(b), a.max(b)));
            let there = &scene.edges[..count];
            let is_new = |ends: &(u32, u32)| {
                kind != Kind::Short || there.binary_search_by_key(ends, |edge| edge.ends).is_err()
            };
            let mut ends: Vec<_> = ordered.filter(is_new).collect();
            ends.sort_unstable();
            ends.dedup();
            scene.edges.extend(ends.into_iter().map(|ends| Edge {
                ends,
                group: None,
                kind,
                weight: 0,
            }));
        }
        scene
    }

    /// How many groups, the first ones, have a mark of their own.
    pub(crate) fn marked(&self) -> usize {
        let some = if self.larger == 0 {
            self.groups.len()
        } else {
            self.larger
        };
        some.min(MARKS)
    }

    pub(crate) fn mark(&self, group: usize) -> Mark {
        match group {
            _ if group < self.marked() => Mark::Own(group),
            _ if group < self.larger => Mark::Other,
            _ => Mark::Pair,
        }
    }

    /// The colour of each group.
    pub fn colours(&self) -> Vec<&'static str> {
        (0..self.groups.len())
            .map(|k| self.mark(k).colour())
            .collect()
    }

    /// Where each node is drawn, x to the right and y down; `None` if nodes are not drawn one by one.
    pub fn points(&self) -> Option<Vec<[f64; 2]>> {
        self.is_whole().then(|| {
            let (nodes, edges) = self.shown();
            self.placed(nodes.len(), &edges).points
        })
    }

    /// Whether all nodes are drawn.
    pub(crate) fn is_whole(&self) -> bool {
        self.names.len() <= MOST_NODES
    }

    pub(crate) fn of_kind(&self, kind: Kind) -> usize {
        self.edges.iter().filter(|edge| edge.kind == kind).count()
    }

    /// The nodes that are drawn, increasing, and the lines, by numbers among these.
    fn shown(&self) -> (Vec<u32>, Vec<Edge>) {
        let nodes = self.names.len();
        let (chosen, edges) = match self.is_whole() {
            true => ((0..nodes as u32).collect(), self.edges.clone()),
            false => self.sampled(),
        };
        let mut lines = Vec::new();
        for kind in [
            Kind::Pair,
            Kind::Short,
            Kind::Suggested,
            Kind::Contradicting,
        ] {
            let some = edges.iter().filter(|edge| edge.kind == kind);
            let mut some: Vec<Edge> = some.copied().collect();
            if some.len() > MOST_LINES {
                // Lines of smaller components are few and must not be lost.
                some.sort_by_key(|edge| (edge.group == Some(0), Reverse(edge.weight), edge.ends));
                some = strongest(chosen.len(), &some);
            }
            lines.append(&mut some);
        }
        (chosen, lines)
    }

    /// Some nodes, and lines where an edge leads from nodes near one to nodes near the other: so a sequence is a
    /// line, and a city has its streets. O(n + m log m).
    fn sampled(&self) -> (Vec<u32>, Vec<Edge>) {
        let nodes = self.names.len() as u32;
        let is_inside = |v: u32| matches!(self.groups_of.of(v as usize), [0]);
        let outside = (0..nodes).filter(|&v| !is_inside(v)).take(MOST_OUTSIDE);
        let mut chosen: Vec<u32> = outside.collect();
        let step = (nodes as usize).div_ceil(SAMPLED - chosen.len());
        chosen.extend((0..nodes).step_by(step));
        chosen.sort_unstable();
        chosen.dedup();
        let ends = self.edges.iter().map(|edge| edge.ends);
        let both = ends.flat_map(|(a, b)| [(a, b), (b, a)]);
        let neighbours = Lists::group(nodes as usize, both);
        let mut nearest = vec![None; nodes as usize];
        (0..)
            .zip(&chosen)
            .for_each(|(k, &v)| nearest[v as usize] = Some(k));
        let mut queue = VecDeque::from(chosen.clone());
        while let Some(v) = queue.pop_front() {
            for &w in neighbours.of(v as usize) {
                if nearest[w as usize].is_none() {
                    nearest[w as usize] = nearest[v as usize];
                    queue.push_back(w);
                }
            }
        }
        let mut weights = BTreeMap::new();
        for edge in &self.edges {
            let [a, b] = [edge.ends.0, edge.ends.1].map(|v| nearest[v as usize]);
            if let (Some(a), Some(b)) = (a, b)
                && a != b
            {
                let key = ((u32::min(a, b), u32::max(a, b)), edge.group, edge.kind);
                *weights.entry(key).or_insert(0u32) += edge.weight.max(1);
            }
        }
        let line = |((ends, group, kind), weight)| Edge {
            ends,
            group,
            kind,
            weight,
        };
        (chosen, weights.into_iter().map(line).collect())
    }
}

fn size(cameras: usize, points: usize, edges: usize) -> String {
    let cameras = counted(cameras, "camera");
    match points {
        0 => format!("{cameras}, {}", counted(edges, "pair")),
        points => format!("{cameras}, {}", counted(points, "point")),
    }
}

/// The pairs of a graph; of cameras and points, the pairs of images that see points together, with their number.
/// Increasing.
fn together(input: &NamedGraph) -> Vec<((u32, u32), u32)> {
    let edges = input.graph.edges().iter();
    let Some(cameras) = input.cameras else {
        return edges.map(|&ends| (ends, 1)).collect();
    };
    let views = edges.map(|&(camera, point)| (point - cameras, camera));
    let views = Lists::group(input.graph.nodes() - cameras as usize, views);
    let of_image = |own: &[(u32, u32)]| {
        let seen = own.iter().map(|&(_, point)| (point - cameras) as usize);
        let others = seen.flat_map(|point| views.of(point)).copied();
        let mut others: Vec<u32> = others.filter(|&other| own[0].0 < other).collect();
        others.sort_unstable();
        let same = others.chunk_by(|one, other| one == other);
        let weighted = same.map(|same| ((own[0].0, same[0]), same.len() as u32));
        weighted.collect::<Vec<_>>()
    };
    let edges = input.graph.edges().chunk_by(|one, other| one.0 == other.0);
    edges.flat_map(of_image).collect()
}

/// The first group that has both ends of an edge; two components share at most one node.
fn shared(groups_of: &Lists, (i, j): (u32, u32)) -> Option<u32> {
    let (a, b) = (groups_of.of(i as usize), groups_of.of(j as usize));
    let (few, many) = if a.len() < b.len() { (a, b) } else { (b, a) };
    few.iter().copied().find(|k| many.binary_search(k).is_ok())
}

/// Of lines, the strongest first, a spanning forest, and some of each node.
fn strongest(nodes: usize, lines: &[Edge]) -> Vec<Edge> {
    let mut sets = UnionFind::new(nodes);
    let mut taken = vec![0; nodes];
    let mut chosen = Vec::new();
    for line in lines {
        let (a, b) = (line.ends.0 as usize, line.ends.1 as usize);
        let joins = sets.union(a, b);
        if joins || taken[a] < STRONGEST || taken[b] < STRONGEST {
            taken[a] += 1;
            taken[b] += 1;
            chosen.push(*line);
        }
    }
    chosen
}

#[cfg(test)]
mod tests;
