//! Random thinnings: how often a part stays whole when some of its pairs, or tracks, are missing.
//!
//! An experiment with a fixed seed, not a proof: a part that stays whole has more pairs than it
//! needs. Each thinned part is decided exactly.

use crate::parts::{Alone, Parts};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::HashMap;
use viewcert::Graph;
use viewcert::decide::{Options, VerdictError, decide};

/// What is thinned, and how often.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Thinning {
    /// How many thinnings for each rate.
    pub draws: u32,
    /// The seed.
    pub seed: u64,
    /// How many parts, the largest ones.
    pub parts: usize,
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

/// Thins the largest parts. In a camera-point graph, of which the first `cameras` nodes are
/// cameras, points go with all their observations; else pairs go, each by itself.
///
/// `draws` decisions of a part for each of five rates.
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
    let edges = parts.edges(graph);
    let largest = parts.parts.iter().zip(&edges).take(thinning.parts);
    let of_part = largest.enumerate().map(|(number, (part, edges))| {
        let alone = Alone::new(&part.nodes, edges);
        let kept = cameras.map(|c| part.nodes.partition_point(|&v| v < c) as u32);
        let images = kept.unwrap_or(part.nodes.len() as u32);
        let mut found = Margin {
            component: part.component,
            whole: [0; MISSING.len()],
            together: [0; MISSING.len()],
            images: images as usize,
        };
        for (k, &missing) in MISSING.iter().enumerate() {
            let draws = (0..thinning.draws).into_par_iter().map(|draw| {
                let stream = [number as u64, u64::from(missing), u64::from(draw)];
                let random = random(thinning.seed, stream);
                most_together(
                    &thinned(&alone.graph, kept, missing, random),
                    images,
                    options,
                )
            });
            for together in draws.collect::<Result<Vec<u32>, VerdictError>>()? {
                found.whole[k] += u32::from(together == images);
                found.together[k] += u64::from(together);
            }
        }
        Ok(found)
    });
    of_part.collect()
}

/// A generator for each part, rate and draw.
fn random(seed: u64, [part, missing, draw]: [u64; 3]) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(part << 40 | missing << 32 | draw);
    random
}

/// What is left of a part. The nodes stay, but for points that go.
fn thinned(graph: &Graph, cameras: Option<u32>, missing: u32, mut random: ChaCha8Rng) -> Graph {
    let mut stays = || random.random_range(0..100) >= missing;
    let Some(cameras) = cameras else {
        let edges = graph.edges().iter().copied().filter(|_| stays());
        return Graph::new(graph.nodes() as u32, edges).expect("edges of a graph");
    };
    let points = (cameras..graph.nodes() as u32).filter(|_| stays());
    let number: HashMap<u32, u32> = (0..cameras).chain(points).zip(0..).collect();
    let edges = graph.edges().iter();
    let edges = edges.filter_map(|(i, j)| number.get(i).copied().zip(number.get(j).copied()));
    Graph::new(number.len() as u32, edges).expect("edges of a graph")
}

/// How many of the first `images` nodes lie in one component, at most; one, if there is none.
fn most_together(graph: &Graph, images: u32, options: &Options) -> Result<u32, VerdictError> {
    let verdict = decide(graph, options)?;
    let sizes = verdict.components.iter().map(|component| {
        let nodes = component.nodes();
        nodes.partition_point(|&v| v < images) as u32
    });
    Ok(sizes.max().unwrap_or(1))
}

#[cfg(test)]
mod tests;
