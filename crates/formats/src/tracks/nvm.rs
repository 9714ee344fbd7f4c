//! NVM, the models of VisualSFM.
//!
//! A line `NVM_V3`, the number of cameras, a line for each with its file name and ten numbers, the
//! number of points, and for each `x y z r g b`, the number of its views and for each view
//! `camera feature x y`. Further models may follow; the first is read.

use std::io::Read;

use super::bundler::points_of;
use super::graph::{TrackGraph, TrackOptions, sorted};
use super::words::{Words, integer};
use crate::NamedGraph;
use crate::error::Fault;

/// Focal length, quaternion, centre, distortion, and a zero.
const NUMBERS_OF_A_CAMERA: usize = 10;

pub(super) fn read<R: Read>(
    mut words: Words<R>,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    // `NVM_V3`, and perhaps a calibration that all cameras share.
    words.next_full_line()?;
    words.next_full_line()?;
    let count = words.number_below(u64::from(u32::MAX), "the number of cameras")?;
    let mut names = Vec::new();
    for _ in 0..count {
        if !words.next_full_line()? {
            return Err(words.truncated("a camera"));
        }
        let name = name(words.rest())
            .ok_or_else(|| words.corrupt("a line of a camera holds a file name and ten numbers"))?;
        names.push(name);
    }
    let (names, nodes) = sorted(names)?;
    let mut graph = TrackGraph::new(names, options)?;
    // A file of cameras alone may end here.
    let points = match words.next_full_line()? {
        true => words.number("the number of points")?,
        false => 0,
    };
    points_of(&mut words, points, &nodes, &mut graph)?;
    let more = words.next_full_line()? && integer(words.rest()).is_some_and(|count| count > 0);
    let mut graph = graph.finish()?;
    if more {
        let note = "the file holds several models; the first is read";
        graph.notes.insert(0, note.to_owned());
    }
    Ok(graph)
}

/// The file name on a line: what stands before a tab, or before the last ten words. VisualSFM
/// writes a quote for a blank.
fn name(line: &[u8]) -> Option<Box<str>> {
    let line = std::str::from_utf8(line).ok()?;
    let name = match line.split_once('\t') {
        Some((name, rest)) if rest.split_whitespace().count() >= NUMBERS_OF_A_CAMERA => name,
        _ => {
            let mut name = line;
            for _ in 0..NUMBERS_OF_A_CAMERA {
                let (before, _) = name.trim_end().rsplit_once([' ', '\t'])?;
                name = before;
            }
            name
        }
    };
    let name = name.trim().replace('"', " ");
    (!name.is_empty()).then(|| name.into())
}
