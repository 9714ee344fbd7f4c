//! What a component of bodies hangs on, in near-linear time.
//!
//! In: a graph, and pairs or images of it. Out: without which of them it falls apart, by a count,
//! and of which that stays open; the others are cleared by contraction. All of them are left out
//! together first. What then lies in a body stays in it whatever is left out of the rest, so the
//! bodies are replaced by chains of triangles on the nodes where they touch anything else
//! (docs/theory.md, Theorem 4.4), and each half of the rest is looked at in that smaller graph.
//! A graph in which k pairs or images are looked at has about k bodies and their terminals,
//! unless it has a core: so each of log k rounds costs O(k).

use super::{Pair, bodies_of_nodes, check, final_nodes, is_in_one};
use crate::condensation::{Condensation, terminals, without};
use viewcert::contract::Contraction;
use viewcert::decide::{Options, VerdictError};
use viewcert::{Graph, Model};

/// A condensation with more nodes than the first number, and the second for each item, has a core:
/// what contraction cannot look into is left open.
const MOST_NODES: usize = 32;
const NODES_EACH: usize = 8;

/// Halves of so many are worth a thread of their own.
const SHARE: usize = 1 << 10;

/// What can be left out of a graph: a pair, or an image with its pairs.
pub(super) trait Item: Copy + Ord + Send + Sync {
    /// The pairs that go with some of them, which are given increasing; increasing.
    fn pairs(graph: &Graph, items: &[Self]) -> Vec<Pair>;
    /// How many nodes are left without so many of them.
    fn nodes_left(graph: &Graph, gone: usize) -> usize;
    /// Those of some that no body holds once all of them are left out, given and returned
    /// increasing; the contraction is that of the graph without them.
    fn not_held(graph: &Graph, without: &Contraction, items: Vec<Named<Self>>) -> Vec<Named<Self>>;
    /// The same in a condensation.
    fn moved(self, to: &Condensation) -> Self;
}

/// An item of a condensation, and what it is in the graph where the search began.
#[derive(Clone, Copy)]
pub(super) struct Named<T> {
    here: T,
    name: T,
}

/// What was found of some items; those that are in neither list are cleared.
pub(super) struct Sorted<T> {
    /// Without each of them the graph falls apart, as counting proves.
    pub(super) falls: Vec<T>,
    /// Nothing is known of them.
    pub(super) open: Vec<T>,
}

impl<T> Default for Sorted<T> {
    fn default() -> Self {
        Self {
            falls: Vec::new(),
            open: Vec::new(),
        }
    }
}

impl<T> Sorted<T> {
    /// Adds what was found of others.
    pub(super) fn extend(&mut self, other: Self) {
        self.falls.extend(other.falls);
        self.open.extend(other.open);
    }
}

/// Looks at some items, given increasing, of a rigid graph. Images must be pairwise no pairs and
/// have two neighbours each.
///
/// # Errors
/// If the work is stopped.
pub(super) fn sort<T: Item>(
    graph: &Graph,
    items: Vec<T>,
    options: &Options,
) -> Result<Sorted<T>, VerdictError> {
    let named = items.into_iter().map(|item| Named {
        here: item,
        name: item,
    });
    let mut sorted = sort_named(graph, named.collect(), options)?;
    sorted.falls.sort_unstable();
    sorted.open.sort_unstable();
    Ok(sorted)
}

fn sort_named<T: Item>(
    graph: &Graph,
    items: Vec<Named<T>>,
    options: &Options,
) -> Result<Sorted<T>, VerdictError> {
    let mut sorted = Sorted::default();
    if items.is_empty() {
        return Ok(sorted);
    }
    check(graph, options)?;
    let here: Vec<T> = items.iter().map(|item| item.here).collect();
    let gone = T::pairs(graph, &here);
    let contraction = Contraction::new(&without(graph, &gone), options.question.model);
    let rest = T::not_held(graph, &contraction, items);
    match (&here[..], &rest[..]) {
        (_, []) => {}
        ([_], [item]) => {
            let bound = bound(&contraction, options.question.model);
            let falls = bound < options.question.model.required(T::nodes_left(graph, 1));
            let list = if falls {
                &mut sorted.falls
            } else {
                &mut sorted.open
            };
            list.push(item.name);
        }
        _ => {
            let small = condensed(graph, &contraction, &rest);
            if small.nodes.len() > MOST_NODES + NODES_EACH * rest.len() {
                sorted.open.extend(rest.iter().map(|item| item.name));
                return Ok(sorted);
            }
            let half = |odd: usize| -> Vec<Named<T>> {
                let of_half = rest.iter().skip(odd).step_by(2);
                let moved = of_half.map(|item| Named {
                    here: item.here.moved(&small),
                    name: item.name,
                });
                moved.collect()
            };
            let of_half = |odd| sort_named(&small.graph, half(odd), options);
            let (even, odd) = if rest.len() < SHARE {
                (of_half(0), of_half(1))
            } else {
                rayon::join(|| of_half(0), || of_half(1))
            };
            sorted.extend(even?);
            sorted.extend(odd?);
        }
    }
    Ok(sorted)
}

/// The rank is at most this (Theorem 5.1).
fn bound(contraction: &Contraction, model: Model) -> usize {
    let of_bodies = final_nodes(contraction).map(|nodes| model.required(nodes.len()));
    of_bodies.sum::<usize>() + contraction.loose.len() * model.required(2)
}

/// The graph with its bodies as chains, and the items that are left with all their pairs.
fn condensed<T: Item>(graph: &Graph, contraction: &Contraction, rest: &[Named<T>]) -> Condensation {
    let here: Vec<T> = rest.iter().map(|item| item.here).collect();
    let back = T::pairs(graph, &here);
    let pairs = || contraction.loose.iter().chain(&back).copied();
    let ends = pairs().flat_map(|(a, b)| [a, b]);
    let bodies: Vec<&[u32]> = final_nodes(contraction).collect();
    Condensation::new(terminals(&bodies, ends), pairs(), std::iter::empty())
}

impl Item for Pair {
    fn pairs(_: &Graph, items: &[Self]) -> Vec<Pair> {
        items.to_vec()
    }

    fn nodes_left(graph: &Graph, _: usize) -> usize {
        graph.nodes()
    }

    fn not_held(
        graph: &Graph,
        without: &Contraction,
        mut items: Vec<Named<Self>>,
    ) -> Vec<Named<Self>> {
        let bodies = bodies_of_nodes(without, graph.nodes());
        items.retain(|item| !is_in_one(&bodies, item.here));
        items
    }

    fn moved(self, to: &Condensation) -> Self {
        to.pair(self)
    }
}

impl Item for u32 {
    fn pairs(graph: &Graph, items: &[Self]) -> Vec<Pair> {
        let is_one = |v: &u32| items.binary_search(v).is_ok();
        let edges = graph.edges().iter().copied();
        edges.filter(|(a, b)| is_one(a) || is_one(b)).collect()
    }

    fn nodes_left(graph: &Graph, gone: usize) -> usize {
        graph.nodes() - gone
    }

    /// All, or none: if the rest is one body, it sees each of them from two nodes, and so it is
    /// one body with all but one of them as well (docs/theory.md, Theorem 4.1, rule 3).
    fn not_held(graph: &Graph, without: &Contraction, items: Vec<Named<Self>>) -> Vec<Named<Self>> {
        let left = graph.nodes() - items.len();
        let is_one = match (&without.finals[..], &without.loose[..]) {
            ([body], []) => without.bodies[*body as usize].nodes.len() == left,
            ([], [_]) => left == 2,
            _ => false,
        };
        if is_one { Vec::new() } else { items }
    }

    fn moved(self, to: &Condensation) -> Self {
        to.number(self).expect("a node with its pairs")
    }
}
