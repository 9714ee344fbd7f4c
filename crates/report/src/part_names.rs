//! The images of parts by name: the first and the last of each part, and every image in none.

use super::counted;
use serde::Serialize;
use std::collections::HashMap;
use std::io::{self, Write};
use viewcert_advice::mapper::Sees;
use viewcert_formats::NamedGraph;

/// How many parts, and how many images in none, are shown.
const PARTS: usize = 8;
const OUTSIDE: usize = 40;

/// A part, by its first and last image in the order of names.
#[derive(Serialize)]
pub(crate) struct PartLine {
    pub(crate) images: usize,
    pub(crate) first: String,
    pub(crate) last: String,
    /// Whether images of other parts are between the two.
    #[serde(skip)]
    has_gaps: bool,
}

impl PartLine {
    /// "a ... c (3 images)".
    pub(crate) fn words(&self) -> String {
        let gaps = if self.has_gaps { ", with gaps" } else { "" };
        let images = counted(self.images, "image");
        format!("{} ... {} ({images}{gaps})", self.first, self.last)
    }
}

/// The names of all images of some cameras: images of a frame at one place are one camera.
pub(crate) fn names(input: &NamedGraph, cameras: &[u32]) -> Vec<String> {
    let together = input.frames.as_ref().map(|frames| &frames.together);
    let all = cameras.iter().flat_map(|camera| {
        let others = together.and_then(|together| together.get(camera));
        let others = others.into_iter().flatten().map(ToString::to_string);
        std::iter::once(input.labels.label(*camera).into_owned()).chain(others)
    });
    all.collect()
}

/// How many images some cameras are.
pub(crate) fn images(input: &NamedGraph, cameras: &[u32]) -> usize {
    let together = input.frames.as_ref().map(|frames| &frames.together);
    let others = |camera| Some(together?.get(camera)?.len());
    cameras
        .iter()
        .map(|camera| 1 + others(camera).unwrap_or(0))
        .sum()
}

/// The parts, whose images are increasing.
pub(crate) fn parts(input: &NamedGraph, parts: &[Vec<u32>]) -> Vec<PartLine> {
    // Numbers as such.
    let key = |name: &String| (name.parse::<u64>().ok(), name.clone());
    let sorted = |images: &[u32]| {
        let mut names = names(input, images);
        names.sort_by_cached_key(key);
        names
    };
    let all = sorted(&parts.concat());
    let part = |images: &Vec<u32>| {
        let mut names = sorted(images);
        let place = |name: &String| all.partition_point(|other| key(other) < key(name));
        let between = place(names.last()?) - place(names.first()?);
        Some(PartLine {
            images: names.len(),
            has_gaps: between >= names.len(),
            first: names.first()?.clone(),
            last: names.pop()?,
        })
    };
    parts.iter().filter_map(part).collect()
}

/// Writes the parts, and the images in none, with how much of a model each `sees`.
///
/// # Errors
/// Those of the writer.
pub(crate) fn write<W: Write>(
    out: &mut W,
    parts: &[PartLine],
    outside: &[String],
    sees: &HashMap<&str, &Sees>,
    wrapped: impl Fn(&mut W, &str, &str) -> io::Result<()>,
) -> io::Result<()> {
    for (k, part) in (1..).zip(parts.iter().take(PARTS)) {
        writeln!(out, "  {:<12}{}", format!("part {k}"), part.words())?;
    }
    if parts.len() > PARTS {
        writeln!(
            out,
            "              {} more parts (--json lists them)",
            parts.len() - PARTS
        )?;
    }
    if outside.is_empty() {
        return Ok(());
    }
    let noted = |name: &String| noted(name, sees);
    let mut shown: Vec<String> = outside.iter().take(OUTSIDE).map(noted).collect();
    if outside.len() > OUTSIDE {
        shown.push(format!(
            "{} more (--json lists them)",
            outside.len() - OUTSIDE
        ));
    }
    wrapped(out, "in no part", &shown.join(", "))
}

/// An image outside, with how much of a model it sees.
pub(crate) fn noted(name: &str, sees: &HashMap<&str, &Sees>) -> String {
    match sees.get(name) {
        Some(Sees { sees, needs, .. }) => {
            format!("{name} (sees {sees} of the {needs} points it needs)")
        }
        None => name.to_owned(),
    }
}
