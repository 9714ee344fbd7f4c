//! What contraction and counting leave open, by decisions.
//!
//! In: a condensation and pairs of it, or a graph and images. Out: which of them are weak. They are left out
//! together, and the components of what is left are condensed in their turn. One pair is decided by itself:
//! its count may tell of others. Then each half of the rest is looked at in the smaller graph. The
//! halves lie apart: pairs are taken in the order in which a search comes to them, so that where
//! separators are small the graph without a half is a few components.

use super::{Pair, Why};
use crate::condensation::{Condensation, terminals, without};
use crate::parts::{Alone, Parts};
use std::collections::VecDeque;
use viewcert::decide::{Options, Value, VerdictError, decide};
use viewcert::graph::Adjacency;
use viewcert::{Graph, Strength, Verdict};

type Weak = Vec<(Pair, Why, Strength)>;

/// Which of some pairs of a condensation are weak; pairs by the nodes that it was made of.
///
/// # Errors
/// Those of [`decide`].
pub(super) fn weak(
    small: &Condensation,
    pairs: &[Pair],
    options: &Options,
) -> Result<Weak, VerdictError> {
    let place = by_distance(&small.graph);
    let mut open: Vec<Open> = pairs
        .iter()
        .map(|&name| Open {
            here: small.pair(name),
            name,
        })
        .collect();
    open.sort_by_key(|pair| {
        let [a, b] = [pair.here.0, pair.here.1].map(|v| place[v as usize]);
        (a.min(b), a.max(b))
    });
    let mut found = Vec::new();
    search(&small.graph, open, options, &mut found)?;
    Ok(found)
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
    let mut found = Vec::new();
    search_images(graph, &open, options, &mut found)?;
    found.sort_unstable_by_key(|&(image, _)| image);
    Ok(found)
}

fn search_images(
    graph: &Graph,
    open: &[OpenImage],
    options: &Options,
    found: &mut Vec<(u32, Strength)>,
) -> Result<(), VerdictError> {
    let Some(&(_, first)) = open.first() else {
        return Ok(());
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
        return Ok(());
    }
    if open.len() == 1 {
        found.push((first, verdict.value_claim().strength));
        return Ok(());
    }
    let parts = Parts::new(&left.graph, &verdict);
    let name = |v: u32| left.nodes[v as usize];
    let bodies = parts
        .parts
        .iter()
        .map(|part| part.nodes.iter().map(|&v| name(v)).collect());
    let bodies: Vec<Vec<u32>> = bodies.collect();
    let bodies: Vec<&[u32]> = bodies.iter().map(Vec::as_slice).collect();
    let links = parts.links.iter().map(|&((a, b), _)| (name(a), name(b)));
    let pairs = links.chain(back);
    let ends = pairs.clone().flat_map(|(a, b)| [a, b]);
    let small = Condensation::new(terminals(&bodies, ends), pairs, std::iter::empty());
    let moved = open.iter().map(|&(here, image)| {
        let here = small.number(here);
        (here.expect("a node with its pairs"), image)
    });
    let moved: Vec<OpenImage> = moved.collect();
    let (one, other) = moved.split_at(moved.len() / 2);
    search_images(&small.graph, one, options, found)?;
    search_images(&small.graph, other, options, found)
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

fn search(
    graph: &Graph,
    mut open: Vec<Open>,
    options: &Options,
    found: &mut Weak,
) -> Result<(), VerdictError> {
    if open.is_empty() {
        return Ok(());
    }
    let (verdict, parts) = left(graph, &open, options)?;
    let is_alone = open.len() == 1;
    // A rigid part without them, with both ends of one: that one follows from it.
    open.retain(|pair| parts.common(pair.here.0, pair.here.1).is_none());
    if is_alone {
        found.extend(open.iter().map(|pair| decided(pair, &verdict)));
        return Ok(());
    }
    if open.is_empty() {
        return Ok(());
    }
    let small = condensed(&parts, &open);
    for pair in &mut open {
        pair.here = small.pair(pair.here);
    }
    let pair = open.pop().expect("one at least");
    let (verdict, parts) = left(&small.graph, &[pair], options)?;
    if parts.common(pair.here.0, pair.here.1).is_none() {
        found.push(decided(&pair, &verdict));
        exchange(&pair, &mut open, &verdict, &parts, found);
    }
    let half = open.split_off(open.len() / 2);
    search(&small.graph, open, options, found)?;
    search(&small.graph, half, options, found)
}

/// What is left without some pairs.
fn left(graph: &Graph, gone: &[Open], options: &Options) -> Result<(Verdict, Parts), VerdictError> {
    let mut gone: Vec<Pair> = gone.iter().map(|pair| pair.here).collect();
    gone.sort_unstable();
    let graph = without(graph, &gone);
    let verdict = decide(&graph, options)?;
    let parts = Parts::new(&graph, &verdict);
    Ok((verdict, parts))
}

fn decided(pair: &Open, verdict: &Verdict) -> (Pair, Why, Strength) {
    (pair.name, Why::Decided, verdict.value_claim().strength)
}

/// Components as chains, and pairs.
fn condensed(parts: &Parts, open: &[Open]) -> Condensation {
    let bodies: Vec<&[u32]> = parts.parts.iter().map(|part| &part.nodes[..]).collect();
    let links = parts.links.iter().map(|&(pair, _)| pair);
    let pairs = links.chain(open.iter().map(|pair| pair.here));
    let ends = pairs.clone().flat_map(|(a, b)| [a, b]);
    Condensation::new(terminals(&bodies, ends), pairs, std::iter::empty())
}

/// The components without a weak pair may refute by their number alone. Then another pair that is a
/// component by itself can take the place of the weak one in that count.
fn exchange(weak: &Open, open: &mut Vec<Open>, verdict: &Verdict, parts: &Parts, found: &mut Weak) {
    let sizes = verdict.components.iter().map(|part| part.node_count());
    let bound: usize = sizes.map(|n| verdict.model.required(n)).sum();
    if bound >= verdict.required {
        return;
    }
    let is_link = |pair: Pair| {
        let at = parts.links.binary_search_by_key(&pair, |&(pair, _)| pair);
        at.is_ok()
    };
    open.retain(|pair| {
        let counted = is_link(pair.here);
        if counted {
            found.push((pair.name, Why::Counted(weak.name), Strength::Proof));
        }
        !counted
    });
}
