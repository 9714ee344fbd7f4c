//! Sets of nodes that stay together whatever two pairs, or images, are lost
//! (docs/theory.md, Theorem 15.5).

use crate::condensation::without;
use crate::weak::{bodies_of_nodes, check, used};
use std::collections::HashMap;
use viewcert::contract::Contraction;
use viewcert::decide::{Options, VerdictError};
use viewcert::graph::{Growing, Lists};
use viewcert::{Graph, Model};

/// So many pairs to a set are two when two are lost.
const ENOUGH: usize = 4;

/// Some sets of nodes, looked at by node.
pub(super) struct Sets(Lists);

impl Sets {
    pub(super) fn new(nodes: usize, sets: &[Vec<u32>]) -> Self {
        let of_node = (0..).zip(sets);
        let of_node = of_node.flat_map(|(k, set): (u32, _)| set.iter().map(move |&v| (v, k)));
        Self(Lists::group(nodes, of_node))
    }

    /// Whether one set holds both ends.
    pub(super) fn hold(&self, (a, b): (u32, u32)) -> bool {
        let other = self.0.of(b as usize);
        self.0.of(a as usize).iter().any(|k| other.contains(k))
    }
}

/// Sets of three nodes or more, each increasing, any two of which share one node at most, that one
/// rigid part holds after the loss of any two pairs. Three subgraphs without common pairs, by three
/// contractions; cliques of five nodes, which are rigid without any two pairs; and what these take in.
///
/// # Errors
/// If the work is stopped.
pub(super) fn without_pairs(
    graph: &Graph,
    model: Model,
    options: &Options,
) -> Result<Vec<Vec<u32>>, VerdictError> {
    // Three subgraphs without common pairs: two losses leave one of them whole.
    let mut rest = graph.clone();
    let mut seeds: Vec<Vec<u32>> = vec![(0..graph.nodes() as u32).collect()];
    for _ in 0..3 {
        check(graph, options)?;
        let contraction = Contraction::new(&rest, model);
        let of_node = bodies_of_nodes(&contraction, graph.nodes());
        let mut common = Vec::new();
        for seed in &seeds {
            let mut parts: HashMap<u32, Vec<u32>> = HashMap::new();
            for &v in seed {
                for &body in of_node.of(v as usize) {
                    parts.entry(body).or_default().push(v);
                }
            }
            common.extend(parts.into_values().filter(|part| part.len() > 2));
        }
        common.sort_unstable();
        seeds = common;
        let used = used(&contraction);
        let in_bodies: Vec<(u32, u32)> = used
            .into_iter()
            .filter(|pair| contraction.loose.binary_search(pair).is_err())
            .collect();
        rest = without(&rest, &in_bodies);
    }
    let mut growing = Growing::new(graph, ENOUGH, 2);
    seeds.iter().for_each(|seed| growing.add(seed));
    growing.add_cliques(graph, 5);
    Ok(growing.into_sets())
}

/// The same for the loss of any two images: what is left of a set lies in one rigid part of the rest.
/// Cliques of four nodes stay cliques; two sets that share four nodes are one.
pub(super) fn without_images(graph: &Graph) -> Vec<Vec<u32>> {
    let mut growing = Growing::new(graph, ENOUGH, 4);
    growing.add_cliques(graph, 4);
    growing.into_sets()
}
