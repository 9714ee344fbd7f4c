//! What may be lost: whether every component stays one whatever one or two pairs, or images, of it
//! are missing.
//!
//! In: a graph and its components. Out: for each component that breaks a set without which it does.
//! One is what `weak` looks for. Of two, sets of nodes that stay together whatever two are lost are
//! grown first (`robust`): nothing within them, and nothing that they alone touch, is worth losing
//! (docs/theory.md, Theorem 15.5). What is left is lost one by one, and what is weak then is found as
//! one is.

use super::losses::{RIGID, losses};
use super::robust;
use crate::condensation::{Condensation, terminals, with, without};
use crate::parts::{Alone, Parts};
use crate::weak::{falling_apart, images_of, left_out, pairs_of, used, without_nodes};
use rayon::prelude::*;
use std::fmt;
use std::str::FromStr;
use viewcert::contract::Contraction;
use viewcert::decide::{Options, Value, VerdictError, decide};
use viewcert::graph::Adjacency;
use viewcert::{Graph, Strength};

type Pair = (u32, u32);

/// What is lost, written as `1`, `2`, `images:1` or `images:2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lost {
    /// So many pairs, 1 or 2.
    Pairs(u8),
    /// So many images, 1 or 2.
    Images(u8),
}

impl FromStr for Lost {
    type Err = UnknownLoss;

    fn from_str(text: &str) -> Result<Self, UnknownLoss> {
        match text {
            "1" => Ok(Self::Pairs(1)),
            "2" => Ok(Self::Pairs(2)),
            "images:1" => Ok(Self::Images(1)),
            "images:2" => Ok(Self::Images(2)),
            _ => Err(UnknownLoss),
        }
    }
}

/// A text that does not say what is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownLoss;

impl fmt::Display for UnknownLoss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("what is lost is 1 or 2 pairs, or images:1 or images:2")
    }
}

impl std::error::Error for UnknownLoss {}

/// A component that breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Break {
    /// Its place in the verdict.
    pub component: usize,
    /// Without these it falls apart: pairs by their two images, or images alone.
    pub without: Vec<Vec<u32>>,
    /// How strong that is.
    pub strength: Strength,
}

/// The components of three images and more that do not stay finite solvable whatever is lost, each
/// with a set without which it falls apart, by component. That the others stay is proved. Of images,
/// what counts is the rest of the component.
///
/// For one as [`weak_pairs`](crate::weak_pairs) and [`weak_images`](crate::weak_images). For two near linear where sets that stay together
/// take in most of a component, or a node has few pairs; else as many searches for one as there are
/// pairs that a contraction needs, or images.
///
/// # Errors
/// Those of [`decide`].
///
/// # Panics
/// If it is not one or two that are lost.
pub fn redundant(
    graph: &Graph,
    parts: &Parts,
    lost: Lost,
    options: &Options,
) -> Result<Vec<Break>, VerdictError> {
    let (Lost::Pairs(count) | Lost::Images(count)) = lost;
    assert!((1..=2).contains(&count), "one or two are lost");
    let edges = parts.edges(graph);
    let of_part = parts.parts.par_iter().zip(&edges).map(|(part, edges)| {
        let alone = Alone::new(&part.nodes, edges);
        let Some(found) = breaking(&alone.graph, lost, options)? else {
            return Ok(None);
        };
        let verdict = decide(&left(&alone.graph, lost, &found), options)?;
        assert_eq!(
            verdict.value,
            Value::NotFiniteSolvable,
            "what was found breaks"
        );
        let global = |one: Vec<u32>| one.into_iter().map(|v| alone.nodes[v as usize]).collect();
        Ok(Some(Break {
            component: part.component,
            without: found.into_iter().map(global).collect(),
            strength: verdict.value_claim().strength,
        }))
    });
    let found: Result<Vec<Option<Break>>, VerdictError> = of_part.collect();
    let mut found: Vec<Break> = found?.into_iter().flatten().collect();
    found.sort_unstable_by_key(|one| one.component);
    Ok(found)
}

/// A component without what is lost.
fn left(graph: &Graph, lost: Lost, gone: &[Vec<u32>]) -> Graph {
    match lost {
        Lost::Pairs(_) => {
            let mut gone: Vec<Pair> = gone.iter().map(|pair| (pair[0], pair[1])).collect();
            gone.sort_unstable();
            without(graph, &gone)
        }
        Lost::Images(_) => {
            let mut gone = gone.concat();
            gone.sort_unstable();
            without_nodes(graph, &gone)
        }
    }
}

/// What breaks a component, one if one is enough.
fn breaking(
    graph: &Graph,
    lost: Lost,
    options: &Options,
) -> Result<Option<Vec<Vec<u32>>>, VerdictError> {
    match lost {
        Lost::Pairs(count) => {
            let hangs = |count| hanging(graph, count, 3, |v, w| vec![v.min(w), v.max(w)]);
            if let Some(found) = hangs(1) {
                return Ok(Some(found));
            }
            let weak = pairs_of(graph, options)?;
            if let Some(&((a, b), ..)) = weak.first() {
                return Ok(Some(vec![vec![a, b]]));
            }
            match (count, hangs(2)) {
                (1, _) => Ok(None),
                (_, Some(found)) => Ok(Some(found)),
                _ => two_pairs(graph, options),
            }
        }
        Lost::Images(count) => {
            let hangs = |count| hanging(graph, count, 3 + count, |_, w| vec![w]);
            if let Some(found) = hangs(1) {
                return Ok(Some(found));
            }
            if let Some(&(v, ..)) = images_of(graph, options)?.first() {
                return Ok(Some(vec![vec![v]]));
            }
            match (count, hangs(2)) {
                (1, _) => Ok(None),
                (_, Some(found)) => Ok(Some(found)),
                _ => two_images(graph, options),
            }
        }
    }
}

/// An image that hangs on one pair without so many: 7 (2, 4) is less than the 11 (3, 8) that it takes,
/// if three images are left. The images at the other ends of its first pairs are named by `lost`.
fn hanging(
    graph: &Graph,
    count: usize,
    least: usize,
    lost: impl Fn(u32, u32) -> Vec<u32>,
) -> Option<Vec<Vec<u32>>> {
    if graph.nodes() < least {
        return None;
    }
    let neighbours = Adjacency::new(graph);
    let v = (0..graph.nodes() as u32).find(|&v| neighbours.degree(v) == count + 1)?;
    let near = &neighbours.neighbours(v)[..count];
    Some(near.iter().map(|&w| lost(v, w)).collect())
}

/// Two pairs without which a component falls apart that none is enough for, if there are such.
fn two_pairs(graph: &Graph, options: &Options) -> Result<Option<Vec<Vec<u32>>>, VerdictError> {
    let model = options.question.model();
    let sets = robust::without_pairs(graph, model, options)?;
    let held = robust::Sets::new(graph.nodes(), &sets);
    let outside: Vec<Pair> = graph
        .edges()
        .iter()
        .copied()
        .filter(|&pair| !held.hold(pair))
        .collect();
    if outside.is_empty() {
        return Ok(None);
    }
    let bodies: Vec<&[u32]> = sets.iter().map(Vec::as_slice).collect();
    let ends = outside.iter().flat_map(|&(a, b)| [a, b]);
    let terminals = terminals(&bodies, ends);
    let small = Condensation::new(terminals, outside.iter().copied(), std::iter::empty());
    let mut here: Vec<Pair> = outside.iter().map(|&pair| small.pair(pair)).collect();
    here.sort_unstable();
    // What a contraction does not use can go with any other: that one is not weak.
    let contraction = Contraction::new(&small.graph, model);
    let first: Vec<Pair> = used(&contraction)
        .into_iter()
        .filter(|pair| here.binary_search(pair).is_ok())
        .collect();
    let tried = first.par_iter().map(|&pair| {
        let rest = without(&small.graph, &[pair]);
        let contraction = Contraction::new(&rest, model);
        let second = used(&contraction).into_iter();
        let second = second.filter(|other| here.binary_search(other).is_ok());
        let second = left_out::not_cleared(&rest, second.collect(), options)?;
        let found = losses(&rest, &second, RIGID, options)?;
        Ok::<_, VerdictError>(found.first().map(|loss| [pair, loss.pair]))
    });
    let found = tried.find_map_first(Result::transpose).transpose()?;
    let outer = |(a, b): Pair| vec![small.nodes[a as usize], small.nodes[b as usize]];
    Ok(found.map(|two| two.map(outer).to_vec()))
}

/// Two images without which the rest of a component falls apart that none is enough for, if there
/// are such.
fn two_images(graph: &Graph, options: &Options) -> Result<Option<Vec<Vec<u32>>>, VerdictError> {
    let n = graph.nodes() as u32;
    let neighbours = Adjacency::new(graph);
    // Of four images that none is enough for all are pairs.
    if n < 5 {
        return Ok(None);
    }
    let sets = robust::without_images(graph);
    let Some(largest) = sets.iter().max_by_key(|set| set.len()) else {
        return among(graph, (0..n).collect(), options);
    };
    if largest.len() == graph.nodes() {
        return Ok(None);
    }
    let inside = |v: &u32| largest.binary_search(v).is_ok();
    let touches = |v: &u32| neighbours.neighbours(*v).iter().any(|w| !inside(w));
    let kept: Vec<u32> = (0..n).filter(|v| !inside(v) || touches(v)).collect();
    let pairs = graph
        .edges()
        .iter()
        .copied()
        .filter(|(a, b)| !inside(a) || !inside(b));
    // In the place of the set three nodes that cannot be lost, and its nodes with a pair to each.
    let number = |v: u32| kept.binary_search(&v).expect("a node that is kept") as u32;
    let pairs: Vec<Pair> = pairs.map(|(a, b)| (number(a), number(b))).collect();
    let k = kept.len() as u32;
    let small = Graph::new(k + 3, pairs).expect("pairs of different nodes");
    let held = (0..k).filter(|&v| inside(&kept[v as usize]));
    let anchored = held.flat_map(|v| (k..k + 3).map(move |anchor| (v, anchor)));
    let anchors = [(k, k + 1), (k, k + 2), (k + 1, k + 2)];
    let small = with(&small, anchored.chain(anchors));
    let found = among(&small, (0..k).collect(), options)?;
    let outer = |one: Vec<u32>| one.into_iter().map(|v| kept[v as usize]).collect();
    Ok(found.map(|two| two.into_iter().map(outer).collect()))
}

/// Two of some nodes without which a graph falls apart, that stays whole without any one of them.
fn among(
    graph: &Graph,
    nodes: Vec<u32>,
    options: &Options,
) -> Result<Option<Vec<Vec<u32>>>, VerdictError> {
    let tried = nodes.par_iter().map(|&v| {
        let rest = without_nodes(graph, &[v]);
        // The others, each once with each, in the numbers of the rest.
        let others: Vec<u32> = nodes.iter().filter(|&&w| w > v).map(|&w| w - 1).collect();
        let found = falling_apart(&rest, others, |rest| {
            let verdict = decide(rest, options)?;
            let falls = verdict.value == Value::NotFiniteSolvable;
            Ok(falls.then_some(verdict.value_claim().strength))
        })?;
        Ok::<_, VerdictError>(found.first().map(|&(w, _)| vec![vec![v], vec![w + 1]]))
    });
    tried.find_map_first(Result::transpose).transpose()
}
