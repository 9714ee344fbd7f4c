//! Pairs and images that a component hangs on.
//!
//! A pair of a component is weak if the component is not finite solvable without it: then it falls
//! apart. Most pairs are shown not to be weak by contraction (docs/theory.md, section 4): what no
//! merge uses can go. Sets of pairs are tried together, and what is left is decided on a
//! condensation, one decision for a set of pairs where that is enough.

mod left_out;

use crate::condensation::{Condensation, terminals, without};
use crate::parts::{Alone, Parts};
use rayon::prelude::*;
use std::collections::BTreeSet;
use viewcert::contract::{Contraction, Merge, Part as Joined, Seed};
use viewcert::decide::{Options, Value, VerdictError, decide};
use viewcert::graph::Adjacency;
use viewcert::watch::Step;
use viewcert::{Graph, Model, Strength, Verdict};

/// Why something is weak.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// Without it this image has a single pair in its component.
    Hangs(u32),
    /// The component without it was decided: it falls apart.
    Decided,
    /// Without this other pair the component falls apart, by a count that is the same with
    /// the two pairs exchanged (docs/theory.md, Theorem 5.1).
    Counted((u32, u32)),
}

/// A pair without which its component falls apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WeakPair {
    /// The pair.
    pub pair: (u32, u32),
    /// Its component, by its place in the verdict.
    pub component: usize,
    /// Why.
    pub why: Why,
    /// How strong that is.
    pub strength: Strength,
}

/// An image without which the rest of a component falls apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WeakImage {
    /// The image.
    pub image: u32,
    /// The component, by its place in the verdict.
    pub component: usize,
    /// Why.
    pub why: Why,
    /// How strong that is.
    pub strength: Strength,
}

/// The weak pairs, by component and then increasing. Pairs that are components by themselves are
/// left out: without them there is nothing to fall apart.
///
/// O(m) for the first contraction of each component. With w weak pairs, further contractions
/// of graphs with at most 6 n pairs, and decisions of condensations, about w log(n / w) of both at
/// worst, and far fewer where one count tells of many.
///
/// # Errors
/// Those of [`decide`].
pub fn weak_pairs(
    graph: &Graph,
    verdict: &Verdict,
    parts: &Parts,
    options: &Options,
) -> Result<Vec<WeakPair>, VerdictError> {
    let edges = parts.edges(graph);
    let of_part = parts.parts.par_iter().zip(&edges).map(|(part, edges)| {
        let alone = Alone::new(&part.nodes, edges);
        let found = pairs_of(&alone.graph, verdict.model, options)?;
        let global = |(a, b): (u32, u32)| (alone.nodes[a as usize], alone.nodes[b as usize]);
        let weak = found.into_iter().map(|(pair, why, strength)| WeakPair {
            pair: global(pair),
            component: part.component,
            why: match why {
                Why::Hangs(v) => Why::Hangs(alone.nodes[v as usize]),
                Why::Counted(pair) => Why::Counted(global(pair)),
                Why::Decided => Why::Decided,
            },
            strength,
        });
        Ok(weak.collect::<Vec<_>>())
    });
    let found: Result<Vec<Vec<WeakPair>>, VerdictError> = of_part.collect();
    Ok(found?.concat())
}

/// The weak images, by component and then increasing: the rest of the component, of three images or
/// more, is not finite solvable without them.
///
/// As [`weak_pairs`], on sets of images no two of which are a pair.
///
/// # Errors
/// Those of [`decide`].
pub fn weak_images(
    graph: &Graph,
    parts: &Parts,
    options: &Options,
) -> Result<Vec<WeakImage>, VerdictError> {
    let edges = parts.edges(graph);
    let of_part = parts.parts.par_iter().zip(&edges).map(|(part, edges)| {
        let alone = Alone::new(&part.nodes, edges);
        let found = images_of(&alone.graph, options)?;
        let weak = found.into_iter().map(|(image, why, strength)| WeakImage {
            image: alone.nodes[image as usize],
            component: part.component,
            why: match why {
                Why::Hangs(v) => Why::Hangs(alone.nodes[v as usize]),
                why => why,
            },
            strength,
        });
        Ok(weak.collect::<Vec<_>>())
    });
    let found: Result<Vec<Vec<WeakImage>>, VerdictError> = of_part.collect();
    Ok(found?.concat())
}

type Pair = (u32, u32);

/// The weak pairs of a component with three nodes or more, increasing.
fn pairs_of(
    graph: &Graph,
    model: Model,
    options: &Options,
) -> Result<Vec<(Pair, Why, Strength)>, VerdictError> {
    let neighbours = Adjacency::new(graph);
    let mut weak: Vec<(Pair, Why, Strength)> = Vec::new();
    for &(i, j) in graph.edges() {
        // A pair adds less to the rank (7; 2) than a node to the required one (11; 3).
        if let Some(v) = [i, j].into_iter().find(|&v| neighbours.degree(v) == 2) {
            weak.push(((i, j), Why::Hangs(v), Strength::Proof));
        }
    }
    let hanging: Vec<Pair> = weak.iter().map(|&(pair, ..)| pair).collect();
    let contraction = Contraction::new(graph, options.question.model());
    let candidates = used(&contraction).into_iter();
    let candidates = candidates.filter(|pair| hanging.binary_search(pair).is_err());
    // What is in no body now is in none with fewer pairs.
    let (loose, in_bodies): (Vec<Pair>, Vec<Pair>) =
        candidates.partition(|pair| contraction.loose.binary_search(pair).is_ok());
    let mut candidates = left_out::not_cleared(graph, in_bodies, options)?;
    if !candidates.is_empty() {
        let thinned = thinned(graph, options.question.model());
        candidates = not_cleared(&thinned, candidates, options)?;
    }
    candidates.extend(loose);
    candidates.sort_unstable();
    weak.extend(decided(graph, model, candidates, options)?);
    weak.sort_unstable_by_key(|&(pair, ..)| pair);
    Ok(weak)
}

/// The pairs that a contraction uses, and those that it leaves loose, increasing: every other pair
/// joins two nodes of a body that stands without it.
fn used(contraction: &Contraction) -> Vec<Pair> {
    let mut used: BTreeSet<Pair> = contraction.loose.iter().copied().collect();
    let ordered = |a: u32, b: u32| (a.min(b), a.max(b));
    for body in &contraction.bodies {
        if let Seed::Edge(a, b) = body.seed {
            used.insert(ordered(a, b));
        }
        used.extend(
            body.add
                .iter()
                .flat_map(|&[v, a, b]| [ordered(v, a), ordered(v, b)]),
        );
        for merge in &body.merge {
            let parts: &[Joined] = match merge {
                Merge::Scaled { part, .. } | Merge::Shared { part, .. } => {
                    std::slice::from_ref(part)
                }
                Merge::Triangle { parts, .. } => parts,
                Merge::Cycle { parts, .. } => parts,
                Merge::Biclique { parts, .. } => parts,
            };
            used.extend(parts.iter().filter_map(|part| match *part {
                Joined::Edge(a, b) => Some(ordered(a, b)),
                Joined::Body(_) => None,
            }));
        }
    }
    used.into_iter().collect()
}

/// A subgraph on the same nodes in which up to three contractions find their pairs, each without
/// those of the one before: at most 6 n pairs but for the loose ones.
fn thinned(graph: &Graph, model: Model) -> Graph {
    let mut rest = graph.clone();
    let mut kept = BTreeSet::new();
    for _ in 0..3 {
        let used = used(&Contraction::new(&rest, model));
        rest = without(&rest, &used);
        kept.extend(used);
    }
    Graph::new(graph.nodes() as u32, kept).expect("edges of a graph")
}

/// Which of some pairs are not shown to be redundant by contractions of the graph without sets of
/// them. What lies within a body of the graph without the set is.
fn not_cleared(
    graph: &Graph,
    candidates: Vec<Pair>,
    options: &Options,
) -> Result<Vec<Pair>, VerdictError> {
    let model = options.question.model();
    let mut left = Vec::new();
    let mut sets = vec![candidates];
    while let Some(set) = sets.pop() {
        if set.is_empty() {
            continue;
        }
        check(graph, options)?;
        let rest = outside_bodies(
            &Contraction::new(&without(graph, &set), model),
            graph.nodes(),
            &set,
        );
        if rest.len() == 1 && set.len() == 1 {
            left.extend(rest);
        } else {
            let half = rest.len() / 2;
            sets.extend([rest[..half].to_vec(), rest[half..].to_vec()]);
        }
    }
    left.sort_unstable();
    Ok(left)
}

fn check(graph: &Graph, options: &Options) -> Result<(), VerdictError> {
    Ok(options
        .watch
        .task(Step::Contraction, graph.nodes())
        .check()?)
}

/// Those of some pairs that no final body holds.
fn outside_bodies(contraction: &Contraction, nodes: usize, pairs: &[Pair]) -> Vec<Pair> {
    let finals = contraction.finals.iter();
    let of_node = (0..).zip(finals).flat_map(|(k, &body): (u32, _)| {
        let nodes = contraction.bodies[body as usize].nodes.iter();
        nodes.map(move |&v| (v, k))
    });
    let bodies = viewcert::graph::Lists::group(nodes, of_node);
    let together = |&(a, b): &Pair| {
        let other = bodies.of(b as usize);
        bodies
            .of(a as usize)
            .iter()
            .any(|k| other.binary_search(k).is_ok())
    };
    pairs
        .iter()
        .filter(|pair| !together(pair))
        .copied()
        .collect()
}

/// Which of the candidates are weak, decided on a condensation in which they are pairs.
fn decided(
    graph: &Graph,
    model: Model,
    mut candidates: Vec<Pair>,
    options: &Options,
) -> Result<Vec<(Pair, Why, Strength)>, VerdictError> {
    let contraction = loop {
        let contraction = Contraction::new(&without(graph, &candidates), options.question.model());
        let rest = outside_bodies(&contraction, graph.nodes(), &candidates);
        if rest.len() == candidates.len() {
            break contraction;
        }
        candidates = rest;
    };
    let bodies = contraction.finals.iter();
    let bodies: Vec<&[u32]> = bodies
        .map(|&body| &contraction.bodies[body as usize].nodes[..])
        .collect();
    let pairs = || contraction.loose.iter().chain(&candidates).copied();
    let ends = pairs().flat_map(|(a, b)| [a, b]);
    let small = Condensation::new(terminals(&bodies, ends), pairs(), std::iter::empty());
    let mut search = Search {
        small: &small,
        model,
        open: candidates.iter().map(|&pair| small.pair(pair)).collect(),
        weak: Vec::new(),
    };
    search.run(options)?;
    let global = |(a, b): Pair| (small.nodes[a as usize], small.nodes[b as usize]);
    let weak = search.weak.into_iter().map(|(pair, why, strength)| {
        let why = match why {
            Why::Counted(other) => Why::Counted(global(other)),
            why => why,
        };
        (global(pair), why, strength)
    });
    Ok(weak.collect())
}

/// Deciding the candidates of a condensation.
struct Search<'a> {
    small: &'a Condensation,
    model: Model,
    /// Candidates of which nothing is known yet.
    open: BTreeSet<Pair>,
    weak: Vec<(Pair, Why, Strength)>,
}

impl Search<'_> {
    fn run(&mut self, options: &Options) -> Result<(), VerdictError> {
        let mut sets: Vec<Vec<Pair>> = vec![self.open.iter().copied().collect()];
        while let Some(mut set) = sets.pop() {
            set.retain(|pair| self.open.contains(pair));
            if set.is_empty() {
                continue;
            }
            let graph = without(&self.small.graph, &set);
            let verdict = decide(&graph, options)?;
            let found = Parts::new(&graph, &verdict);
            // A rigid part without the set, with both ends: the pair follows from it.
            for &(a, b) in &set {
                if found.common(a, b).is_some() {
                    self.open.remove(&(a, b));
                }
            }
            if let [pair] = set[..] {
                if self.open.remove(&pair) {
                    self.weak
                        .push((pair, Why::Decided, verdict.value_claim().strength));
                    self.exchange(pair, &verdict, &found);
                }
            } else {
                set.retain(|pair| self.open.contains(pair));
                let half = set.len() / 2;
                sets.extend([set[half..].to_vec(), set[..half].to_vec()]);
            }
        }
        Ok(())
    }

    /// The components without a weak pair may refute by their number alone. Then another
    /// candidate that is a component by itself can take the place of the pair in that count.
    fn exchange(&mut self, pair: Pair, verdict: &Verdict, found: &Parts) {
        let sizes = verdict.components.iter().map(|part| part.node_count());
        let bound: usize = sizes.map(|n| self.model.required(n)).sum();
        if bound >= verdict.required {
            return;
        }
        for &(other, _) in &found.links {
            if self.open.remove(&other) {
                self.weak.push((other, Why::Counted(pair), Strength::Proof));
            }
        }
    }
}

/// The weak images of a component with three nodes or more, increasing.
fn images_of(graph: &Graph, options: &Options) -> Result<Vec<(u32, Why, Strength)>, VerdictError> {
    let model = options.question.model();
    let n = graph.nodes() as u32;
    // Without an image of a triangle there is a pair, which is solvable.
    if n < 4 {
        return Ok(Vec::new());
    }
    let neighbours = Adjacency::new(graph);
    let mut weak = Vec::new();
    let mut open = Vec::new();
    for v in 0..n {
        let near = neighbours.neighbours(v).iter();
        match near.copied().find(|&u| neighbours.degree(u) == 2) {
            Some(u) => weak.push((v, Why::Hangs(u), Strength::Proof)),
            None => open.push(v),
        }
    }
    if is_one_body(&Contraction::new(graph, model), graph.nodes()) {
        open = falling_apart(&thinned(graph, model), open, |rest| {
            check(graph, options)?;
            let whole = is_one_body(&Contraction::new(rest, model), rest.nodes());
            Ok((!whole).then_some(Strength::Proof))
        })?
        .into_iter()
        .map(|(v, _)| v)
        .collect();
    }
    let decided = falling_apart(graph, open, |rest| {
        let verdict = decide(rest, options)?;
        Ok((verdict.value == Value::NotFiniteSolvable).then_some(verdict.value_claim().strength))
    })?;
    weak.extend(
        decided
            .into_iter()
            .map(|(v, strength)| (v, Why::Decided, strength)),
    );
    weak.sort_unstable_by_key(|&(v, ..)| v);
    Ok(weak)
}

fn is_one_body(contraction: &Contraction, nodes: usize) -> bool {
    let [body] = contraction.finals[..] else {
        return false;
    };
    contraction.bodies[body as usize].nodes.len() == nodes
}

/// Those of some nodes, given and returned increasing, without which a graph does not pass a test,
/// with the strength of that; the test says `None` if a graph holds together.
///
/// Nodes that are pairwise no edges are left out together: if the rest holds together, each of them
/// is seen from two nodes of it, and so the graph without any one of them holds
/// together as well (docs/theory.md, Theorem 4.1, rule 3). Every node must have two neighbours.
fn falling_apart(
    graph: &Graph,
    nodes: Vec<u32>,
    test: impl Fn(&Graph) -> Result<Option<Strength>, VerdictError>,
) -> Result<Vec<(u32, Strength)>, VerdictError> {
    let mut found = Vec::new();
    let mut sets = independent(graph, nodes);
    while let Some(set) = sets.pop() {
        if set.is_empty() {
            continue;
        }
        if let Some(strength) = test(&without_nodes(graph, &set))? {
            if let [v] = set[..] {
                found.push((v, strength));
            } else {
                let half = set.len() / 2;
                sets.extend([set[..half].to_vec(), set[half..].to_vec()]);
            }
        }
    }
    found.sort_unstable_by_key(|&(v, _)| v);
    Ok(found)
}

/// Some nodes, given increasing, in sets without an edge in them, by greedy colouring.
fn independent(graph: &Graph, nodes: Vec<u32>) -> Vec<Vec<u32>> {
    let neighbours = Adjacency::new(graph);
    let mut colour = vec![usize::MAX; graph.nodes()];
    let mut sets: Vec<Vec<u32>> = Vec::new();
    for v in nodes {
        let near = neighbours.neighbours(v).iter();
        let taken: BTreeSet<usize> = near.map(|&u| colour[u as usize]).collect();
        let free = (0..).find(|k| !taken.contains(k)).expect("a colour");
        colour[v as usize] = free;
        if free == sets.len() {
            sets.push(Vec::new());
        }
        sets[free].push(v);
    }
    sets
}

/// A graph without some nodes, given increasing, renumbered.
fn without_nodes(graph: &Graph, gone: &[u32]) -> Graph {
    let stays = |v: &u32| gone.binary_search(v).is_err();
    let nodes: Vec<u32> = (0..graph.nodes() as u32).filter(|v| stays(v)).collect();
    let edges = graph.edges().iter().copied();
    let edges: Vec<Pair> = edges.filter(|(i, j)| stays(i) && stays(j)).collect();
    Alone::new(&nodes, &edges).graph
}

#[cfg(test)]
mod tests;
