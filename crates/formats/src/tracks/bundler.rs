//! Bundler's `bundle.out`, versions 0.1 to 0.4.
//!
//! A comment, `cameras points`, 15 numbers for every camera, and for every point its position and
//! colour, the number of its views, and for each view `camera feature x y`. Cameras have no names
//! there, only numbers from 0.

use std::io::Read;

use super::graph::{TrackGraph, TrackOptions, numbered};
use super::words::Words;
use crate::NamedGraph;
use crate::error::Fault;

/// Focal length, two coefficients of distortion, rotation, translation.
const NUMBERS_OF_A_CAMERA: u64 = 15;

pub(super) fn read<R: Read>(
    mut words: Words<R>,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    if !words.next_full_line()? {
        return Err(words.truncated("the number of cameras"));
    }
    let most = u64::from(u32::MAX);
    let cameras = words.number_below(most, "the number of cameras")?;
    let points = words.number_below(most, "the number of points")?;
    for _ in 0..cameras {
        words.skip(NUMBERS_OF_A_CAMERA, "a camera")?;
    }
    let mut graph = TrackGraph::new(numbered(cameras), options)?;
    points_of(
        &mut words,
        points.into(),
        &Vec::from_iter(0..cameras),
        &mut graph,
    )?;
    graph.finish()
}

/// Takes in so many points: position and colour, the number of views, and of each the camera, whose node
/// is known by its number, and three numbers more.
pub(super) fn points_of<R: Read>(
    words: &mut Words<R>,
    count: u64,
    nodes: &[u32],
    graph: &mut TrackGraph,
) -> Result<(), Fault> {
    let mut views = Vec::new();
    for _ in 0..count {
        words.skip(6, "the position or colour of a point")?;
        views.clear();
        for _ in 0..words.number("the number of a point's views")? {
            let camera = words.number_below(nodes.len() as u64, "the number of a camera")?;
            views.push(nodes[camera as usize]);
            words.skip(3, "a view of a point")?;
        }
        graph.push(&views)?;
    }
    Ok(())
}
