//! BAL: a problem of bundle adjustment in the large (Agarwal, Snavely, Seitz, Szeliski 2010).
//!
//! `cameras points observations`, then `camera point x y` for every observation; the parameters of
//! cameras and points that follow are not read.

use std::io::Read;

use super::graph::{TrackGraph, TrackOptions, numbered};
use super::words::Words;
use crate::NamedGraph;
use crate::error::Fault;
use viewcert::graph::Lists;

pub(super) fn read<R: Read>(
    mut words: Words<R>,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let most = u64::from(u32::MAX);
    let cameras = words.number_below(most, "the number of cameras")?;
    let points = words.number_below(most, "the number of points")?;
    let count = words.number_below(i32::MAX as u64, "the number of observations")?;
    // What is promised need not be there.
    if u64::from(cameras) + u64::from(points) > 2 * u64::from(count) + (1 << 20) {
        return Err(words.corrupt(format!(
            "{cameras} cameras and {points} points have only {count} observations"
        )));
    }
    let mut views = Vec::new();
    for _ in 0..count {
        let camera = words.number_below(cameras.into(), "the number of a camera")?;
        let point = words.number_below(points.into(), "the number of a point")?;
        words.skip(2, "the place of an observation")?;
        views.push((point, camera));
    }
    let mut graph = TrackGraph::new(numbered(cameras), options)?;
    let views = Lists::group(points as usize, views.iter().copied());
    for point in 0..views.len() {
        graph.push(views.of(point))?;
    }
    graph.finish()
}
