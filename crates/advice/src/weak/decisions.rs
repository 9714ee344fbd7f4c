//! What contraction leaves open, by decisions.
//!
//! In: a graph, and pairs or images of it. Out: which of them are weak. They are left out
//! together, and the components of what is left are condensed in their turn. One pair is decided by itself:
//! its count may tell of others. Then each half of the rest is looked at in the smaller graph. The
//! halves lie apart: pairs are taken in the order in which a search comes to them, so that where
//! separators are small the graph without a half is a few components.

use super::{Pair, Why, bodies_of_nodes, final_nodes, in_one_body};
use crate::condensation::{Condensation, terminals, without};
use crate::parts::{Alone, Part, Parts};
use std::collections::VecDeque;
use viewcert::contract::Contraction;
use viewcert::decide::{Options, Value, VerdictError, decide};
use viewcert::graph::Adjacency;
use viewcert::{Graph, Strength};

/// A condensation with more nodes than the first number, and the second for each pair, has a core.
const MOST_NODES: usize = 32;
const NODES_EACH: usize = 8;

type Weak = Vec<(Pair, Why, Strength)>;

/// Which of some pairs of a rigid graph are weak.
///
/// # Errors
/// Those of [`decide`].
pub(super) fn weak(
    graph: &Graph,
    pairs: Vec<Pair>,
    options: &Options,
) -> Result<Weak, VerdictError> {
    let place = by_distance(graph);
    let as_it_is = |pair| Open {
        here: pair,
        name: pair,
    };
    let mut open: Vec<Open> = pairs.into_iter().map(as_it_is).collect();
    open.sort_by_key(|pair| {
        let [a, b] = [pair.here.0, pair.here.1].map(|v| place[v as usize]);
        (a.min(b), a.max(b))
    });
    search(graph, open, options)
}

/// A pair of which nothing is known yet: in the graph at hand, and as it is called.
#[derive(Clone, Copy)]
struct Open {
    here: Pair,
    name: Pair,
}

/// An image of which nothing is known yet: in the graph at hand, and as it is called.
type OpenImage = (u32, u32);

/// Which of some images are weak, with the strength of that. No two of them are a pair, and each has two
/// neighbours at least.
///
/// If the rest holds together without all of them, each of them is seen from two nodes of it, so none
/// is weak (docs/theory.md, Theorem 4.1, rule 3). Else each half is looked at where the components of the rest are
/// condensed (Theorem 4.4), so graphs shrink with the number of images that they are about.
///
/// # Errors
/// Those of [`decide`].
pub(super) fn weak_images(
    graph: &Graph,
    images: Vec<u32>,
    options: &Options,
) -> Result<Vec<(u32, Strength)>, VerdictError> {
    let place = by_distance(graph);
    let mut open: Vec<OpenImage> = images.into_iter().map(|image| (image, image)).collect();
    open.sort_by_key(|&(here, _)| place[here as usize]);
    search_images(graph, &open, options)
}

fn search_images(
    graph: &Graph,
    open: &[OpenImage],
    options: &Options,
) -> Result<Vec<(u32, Strength)>, VerdictError> {
    let Some(&(_, first)) = open.first() else {
        return Ok(Vec::new());
    };
    let mut gone: Vec<u32> = open.iter().map(|&(here, _)| here).collect();
    gone.sort_unstable();
    let stays = |v: u32| gone.binary_search(&v).is_err();
    let nodes: Vec<u32> = (0..graph.nodes() as u32).filter(|&v| stays(v)).collect();
    let (left, back): (Vec<Pair>, Vec<Pair>) = graph
        .edges()
        .iter()
        .partition(|&&(a, b)| stays(a) && stays(b));
    let left = Alone::new(&nodes, &left);
    let verdict = decide(&left.graph, options)?;
    if verdict.value != Value::NotFiniteSolvable {
        return Ok(Vec::new());
    }
    if open.len() == 1 {
        return Ok(vec![(first, verdict.value_claim().strength)]);
    }
    let parts = Parts::new(&left.graph, &verdict);
    let named = |part: &Part| part.nodes.iter().map(|&v| left.nodes[v as usize]).collect();
    let bodies: Vec<Vec<u32>> = parts.parts.iter().map(named).collect();
    let bodies: Vec<&[u32]> = bodies.iter().map(Vec::as_slice).collect();
    let links = parts.links.iter().map(|&(pair, _)| left.pair(pair));
    let small = chained(&bodies, links.chain(back));
    let at = |here| small.number(here).expect("a node with its pairs");
    let moved = open.iter().map(|&(here, image)| (at(here), image));
    let moved: Vec<OpenImage> = moved.collect();
    let (one, other) = moved.split_at(moved.len() / 2);
    let search = |half| search_images(&small.graph, half, options);
    let [one, other] = both([one, other], search);
    Ok([one?, other?].concat())
}

/// Where each node comes in a search by distance, from one of those farthest from node 0 in its
/// connected part.
fn by_distance(graph: &Graph) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let neighbours = Adjacency::new(graph);
    let nodes = graph.nodes() as u32;
    let search = |from: &[u32]| {
        let mut place = vec![NONE; nodes as usize];
        let (mut next, mut lasts) = (0, Vec::new());
        for &first in from {
            let mut queue = VecDeque::from([first]);
            let mut last = None;
            while let Some(v) = queue.pop_front() {
                if place[v as usize] == NONE {
                    place[v as usize] = next;
                    next += 1;
                    last = Some(v);
                    queue.extend(neighbours.neighbours(v));
                }
            }
            lasts.extend(last);
        }
        (place, lasts)
    };
    let all: Vec<u32> = (0..nodes).collect();
    let (_, far) = search(&all);
    search(&far).0
}

fn search(graph: &Graph, mut open: Vec<Open>, options: &Options) -> Result<Weak, VerdictError> {
    super::check(graph, options)?;
    if let [pair] = open[..] {
        return weak_by_itself(graph, &pair, &mut Vec::new(), options);
    }
    let small = condensed(graph, &mut open, options)?;
    for pair in &mut open {
        pair.here = small.pair(pair.here);
    }
    let Some(pair) = open.pop() else {
        return Ok(Vec::new());
    };
    let found = weak_by_itself(&small.graph, &pair, &mut open, options)?;
    let half = open.split_off(open.len() / 2);
    let [one, other] = both([open, half], |half| search(&small.graph, half, options));
    Ok([found, one?, other?].concat())
}

/// What is found of both halves, side by side.
fn both<I: Send, O: Send>([one, other]: [I; 2], of: impl Fn(I) -> O + Sync) -> [O; 2] {
    let (one, other) = rayon::join(|| of(one), || of(other));
    [one, other]
}

/// The graph with rigid parts of what is left without all of the pairs as chains, and with those of the pairs
/// that none of these parts holds: bodies that the rules find, and where these leave a core the components.
fn condensed(
    graph: &Graph,
    open: &mut Vec<Open>,
    options: &Options,
) -> Result<Condensation, VerdictError> {
    let mut gone: Vec<Pair> = open.iter().map(|pair| pair.here).collect();
    gone.sort_unstable();
    let rest = without(graph, &gone);
    let contraction = Contraction::new(&rest, options.question.model);
    let of_nodes = bodies_of_nodes(&contraction, graph.nodes());
    open.retain(|pair| !in_one_body(&of_nodes, &[pair.here.0, pair.here.1]));
    let bodies: Vec<&[u32]> = final_nodes(&contraction).collect();
    let here = open.iter().map(|pair| pair.here);
    let small = chained(&bodies, contraction.loose.iter().copied().chain(here));
    if small.nodes.len() <= MOST_NODES + NODES_EACH * open.len() {
        return Ok(small);
    }
    let verdict = decide(&rest, options)?;
    let parts = Parts::new(&rest, &verdict);
    open.retain(|pair| parts.common(pair.here.0, pair.here.1).is_none());
    let bodies: Vec<&[u32]> = parts.parts.iter().map(|part| &part.nodes[..]).collect();
    let links = parts.links.iter().map(|&(pair, _)| pair);
    let here = open.iter().map(|pair| pair.here);
    Ok(chained(&bodies, links.chain(here)))
}

fn chained(bodies: &[&[u32]], pairs: impl Iterator<Item = Pair> + Clone) -> Condensation {
    let ends = pairs.clone().flat_map(|(a, b)| [a, b]);
    Condensation::new(terminals(bodies, ends), pairs, std::iter::empty())
}

/// One pair, if it is weak; and those of others that can take its place in a count. The rigid parts without a weak
/// pair may refute by their number alone (docs/theory.md, Theorem 5.1). Then so they do with another pair, that no
/// part of three nodes holds, in its place.
fn weak_by_itself(
    graph: &Graph,
    pair: &Open,
    others: &mut Vec<Open>,
    options: &Options,
) -> Result<Weak, VerdictError> {
    let model = options.question.model;
    let required = model.required(graph.nodes());
    let rest = without(graph, &[pair.here]);
    let contraction = Contraction::new(&rest, model);
    let sizes = final_nodes(&contraction).map(<[u32]>::len);
    let bound = sizes.map(|n| model.required(n)).sum::<usize>();
    let bound = bound + contraction.loose.len() * model.required(2);
    let mut found = vec![(pair.name, Why::Decided, Strength::Proof)];
    let links = if bound < required {
        contraction.loose
    } else {
        let verdict = decide(&rest, options)?;
        let parts = Parts::new(&rest, &verdict);
        if parts.common(pair.here.0, pair.here.1).is_some() {
            return Ok(Vec::new());
        }
        found[0].2 = verdict.value_claim().strength;
        let sizes = verdict.components.iter().map(|part| part.node_count());
        if sizes.map(|n| model.required(n)).sum::<usize>() >= required {
            return Ok(found);
        }
        parts.links.iter().map(|&(pair, _)| pair).collect()
    };
    others.retain(|other| {
        let counted = links.binary_search(&other.here).is_ok();
        if counted {
            found.push((other.name, Why::Counted(pair.name), Strength::Proof));
        }
        !counted
    });
    Ok(found)
}
