//! The same images at other thresholds for the number of inliers.

use crate::Known;
use rayon::prelude::*;
use viewcert::Graph;
use viewcert::decide::{Options, Value, VerdictError, decide};
use viewcert::graph::UnionFind;

/// What a threshold gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Pairs with so many inliers and more count.
    pub threshold: u32,
    /// How many pairs these are.
    pub pairs: usize,
    /// How many images have a pair.
    pub images: usize,
    /// In how many connected parts these images are.
    pub connected: usize,
    /// How many components are more than a single pair.
    pub parts: usize,
    /// How many components are a single pair.
    pub links: usize,
    /// How many images the component with the most of them has.
    pub largest: usize,
    /// The verdict on all images.
    pub value: Value,
}

/// Decides the graph of each threshold. A pair that was left out counts if its inliers reach the
/// threshold; but one that has as many as some pair that was used was left out for another
/// reason, and stays out.
///
/// A decision for each threshold.
///
/// # Errors
/// Those of [`decide`].
///
/// # Panics
/// If the inliers are not those of the graph's edges.
pub fn sweep(
    graph: &Graph,
    known: Known,
    thresholds: &[u32],
    options: &Options,
) -> Result<Vec<Row>, VerdictError> {
    assert_eq!(
        known.inliers.len(),
        graph.edges().len(),
        "inliers of every edge"
    );
    let used_from = known.inliers.iter().copied().min().unwrap_or(u32::MAX);
    let rows = thresholds.par_iter().map(|&threshold| {
        let used = graph.edges().iter().zip(known.inliers);
        let used = used.filter(|(_, inliers)| **inliers >= threshold);
        let others = known.others.iter();
        let others = others.filter(|pair| (threshold..used_from).contains(&pair.inliers));
        let pairs = used
            .map(|(pair, _)| *pair)
            .chain(others.map(|pair| pair.images));
        let graph = Graph::new(graph.nodes() as u32, pairs).expect("pairs of its nodes");
        row(threshold, &graph, options)
    });
    rows.collect()
}

fn row(threshold: u32, graph: &Graph, options: &Options) -> Result<Row, VerdictError> {
    let verdict = decide(graph, options)?;
    let mut sets = UnionFind::new(graph.nodes());
    let mut seen = vec![false; graph.nodes()];
    let mut joins = 0;
    for &(i, j) in graph.edges() {
        joins += usize::from(sets.union(i as usize, j as usize));
        seen[i as usize] = true;
        seen[j as usize] = true;
    }
    let images = seen.iter().filter(|seen| **seen).count();
    let sizes = verdict
        .components
        .iter()
        .map(|component| component.node_count());
    let links = sizes.clone().filter(|&nodes| nodes == 2).count();
    Ok(Row {
        threshold,
        pairs: graph.edges().len(),
        images,
        connected: images - joins,
        parts: verdict.components.len() - links,
        links,
        largest: sizes.max().unwrap_or(0),
        value: verdict.value,
    })
}

#[cfg(test)]
mod tests;
