//! A database of matches on a few lines.

use super::counted;
use crate::shown::{row, several};
use std::io::{self, Write};
use viewcert_formats::colmap::{Bin, DatabaseFacts, Pipeline, config_name};

/// Writes the summary.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut impl Write, facts: &DatabaseFacts) -> io::Result<()> {
    let without = match facts.images_without_pair {
        0 => String::new(),
        count => format!(" ({count} without a pair)"),
    };
    let (images, pairs) = (
        counted(facts.images, "image"),
        counted(facts.pairs, "verified pair"),
    );
    let (used, pipeline) = (facts.pairs_used, facts.pipeline);
    let least = counted(facts.min_inliers as usize, "inlier");
    let words =
        format!("{images}{without}, {pairs}, {used} used ({pipeline} mapping, at least {least})");
    row(out, "database", words)?;
    let configs = facts.configs.iter().map(|count| {
        let used = match count.used == count.pairs {
            true => String::new(),
            false => format!(" ({} used)", count.used),
        };
        format!("{} {}{used}", count.pairs, config_name(count.config))
    });
    list(out, "pairs", configs)?;
    list(out, "inliers", facts.inliers.iter().map(bin))?;
    let mut parts = facts.connected.clone();
    parts.retain(|&size| size > 1);
    let count = counted(parts.len(), "part");
    match parts.is_empty() {
        true => row(out, "connected", "nothing"),
        false => row(
            out,
            "connected",
            format!("{count}: {} images", several(&parts, ", ")),
        ),
    }
}

fn bin(bin: &Bin) -> String {
    let range = match bin.to {
        Some(to) if to == bin.from => to.to_string(),
        Some(to) => format!("{}-{to}", bin.from),
        None => format!("{} and more", bin.from),
    };
    format!("{} with {range}", counted(bin.pairs, "pair"))
}

fn list(out: &mut impl Write, title: &str, items: impl Iterator<Item = String>) -> io::Result<()> {
    let items: Vec<String> = items.collect();
    match items.is_empty() {
        true => Ok(()),
        false => row(out, title, items.join(", ")),
    }
}

/// What the mapper that was not named does otherwise with some of the pairs.
pub fn other_mapper(facts: &DatabaseFacts) -> Option<String> {
    let others = facts.configs.iter();
    let others = others.filter(|count| !(2..=6).contains(&count.config));
    match facts.pipeline {
        Pipeline::Incremental => match others.map(|count| count.used).sum() {
            0 => None,
            used => Some(format!(
                "{} of another configuration than 2 to 6: global mapping takes these only with a \
                 stored relative pose (--pipeline global)",
                counted(used, "used pair")
            )),
        },
        Pipeline::Global => match others.map(|count| count.pairs - count.used).sum() {
            0 => None,
            unused => Some(format!(
                "{} of another configuration than 2 to 6: incremental mapping takes those that have \
                 enough inliers (--pipeline incremental)",
                counted(unused, "unused pair")
            )),
        },
    }
}
