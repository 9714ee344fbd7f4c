//! Random thinnings: how often a part stays whole when some of its pairs, or tracks, are missing.
//!
//! An experiment with a fixed seed, not a proof: a part that stays whole has more pairs than it
//! needs. Every thinned graph is decided exactly, all parts at once: what is left of the pairs of
//! a part has components of its own, since a component of fewer pairs lies in one of all.

use crate::parts::Parts;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use viewcert::Graph;
use viewcert::decide::{Options, VerdictError, decide};

/// How often is thinned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Thinning {
    /// How many thinnings for each rate.
    pub draws: u32,
    /// The seed.
    pub seed: u64,
}

/// The shares of pairs or tracks, in percent, that are left out.
pub const MISSING: [u32; 5] = [10, 30, 50, 80, 95];

/// How a part stood the thinnings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Margin {
    /// The component, by its place in the verdict.
    pub component: usize,
    /// For each share of [`MISSING`] how many of the draws left it whole: all its images (its
    /// cameras, in a camera-point graph) in one component.
    pub whole: [u32; MISSING.len()],
    /// For each share how many of its images (cameras) lie in one component after a draw, at
    /// most, summed over the draws.
    pub together: [u64; MISSING.len()],
    /// How many images (cameras) the component has.
    pub images: usize,
}

/// Thins all parts, in the order of the verdict. In a camera-point graph, of which the first
/// `cameras` nodes are cameras, points go with all their observations; else pairs go, each by
/// itself.
///
/// `draws` decisions of the whole graph for each of five rates, however many parts it has.
///
/// # Errors
/// Those of [`decide`].
pub fn margin(
    graph: &Graph,
    parts: &Parts,
    cameras: Option<u32>,
    thinning: Thinning,
    options: &Options,
) -> Result<Vec<Margin>, VerdictError> {
    let images = 0..cameras.unwrap_or(graph.nodes() as u32);
    let mut found: Vec<Margin> = parts
        .parts
        .iter()
        .map(|part| Margin {
            component: part.component,
            whole: [0; MISSING.len()],
            together: [0; MISSING.len()],
            images: part.nodes.partition_point(|v| images.contains(v)),
        })
        .collect();
    if found.is_empty() {
        return Ok(found);
    }
    let nodes = graph.nodes() as u32;
    let in_parts = Graph::new(nodes, parts.edges(graph).into_iter().flatten());
    let in_parts = in_parts.expect("edges of a graph");
    let draws = (0..MISSING.len()).flat_map(|k| (0..thinning.draws).map(move |draw| (k, draw)));
    let draws: Vec<(usize, u32)> = draws.collect();
    let decided = draws.into_par_iter().map(|(k, draw)| {
        let missing = MISSING[k];
        let random = random(thinning.seed, missing, draw);
        let left = thinned(&in_parts, cameras, missing, random);
        let together = most_together(&left, parts, images.end, options)?;
        Ok::<_, VerdictError>((k, together))
    });
    let decided: Result<Vec<(usize, Vec<u32>)>, VerdictError> = decided.collect();
    for (k, together) in decided? {
        for (part, together) in found.iter_mut().zip(together) {
            part.whole[k] += u32::from(together as usize == part.images);
            part.together[k] += u64::from(together);
        }
    }
    Ok(found)
}

/// A generator for each rate and draw.
fn random(seed: u64, missing: u32, draw: u32) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(u64::from(missing) << 32 | u64::from(draw));
    random
}

/// What is left of a graph. The nodes stay.
fn thinned(graph: &Graph, cameras: Option<u32>, missing: u32, mut random: ChaCha8Rng) -> Graph {
    let mut stays = || random.random_range(0..100) >= missing;
    let edges = graph.edges().iter().copied();
    let left: Vec<(u32, u32)> = match cameras {
        None => edges.filter(|_| stays()).collect(),
        Some(cameras) => {
            let points: Vec<bool> = (cameras..graph.nodes() as u32).map(|_| stays()).collect();
            edges
                .filter(|&(_, point)| points[(point - cameras) as usize])
                .collect()
        }
    };
    Graph::new(graph.nodes() as u32, left).expect("edges of a graph")
}

/// For every part how many of its images, the nodes before `images`, lie in one component of a
/// graph with some of its edges, at most; one, if there is none.
fn most_together(
    graph: &Graph,
    parts: &Parts,
    images: u32,
    options: &Options,
) -> Result<Vec<u32>, VerdictError> {
    let verdict = decide(graph, options)?;
    let mut most = vec![1; parts.parts.len()];
    for component in &verdict.components {
        let nodes = component.nodes();
        // A component of fewer edges lies in one of all.
        if let Some(part) = parts.common(nodes[0], nodes[1]) {
            most[part] = most[part].max(nodes.partition_point(|&v| v < images) as u32);
        }
    }
    Ok(most)
}

#[cfg(test)]
mod tests;
