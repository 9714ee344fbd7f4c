//! Which images hang together by pairs that have a base line.
//!
//! Two images taken at one place have no fundamental matrix, and every verdict takes one for granted.
//! Nor has a pair that is degenerate, or of which a watermark was matched.

use super::pairs::Pair;
use super::{Estimate, Groups, config_name};
use crate::error::Problem;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use viewcert::graph::{Lists, UnionFind};
use viewcert::wording::counted;

/// Most pairs without a base line that are looked at; later ones count as having one.
const MOST: usize = 20_000;

/// The groups of each part, whose images increase; images of a frame stay together. O(pairs + images of
/// parts) where parts share few images, and what `geometry` takes for pairs that a homography explains and
/// that lead from one group to another.
///
/// # Errors
/// Those of `geometry`.
pub(super) fn groups(
    pairs: &[Pair],
    images: usize,
    parts: &[Vec<u32>],
    frames: &[Vec<u32>],
    mut geometry: impl FnMut((u32, u32)) -> Result<Option<Estimate>, Problem>,
) -> Result<Vec<Groups>, Problem> {
    let members = (0..).zip(parts);
    let members = members.flat_map(|(k, part)| part.iter().map(move |&image| (image, k)));
    let parts_of = Lists::group(images, members);
    // Where two images are in a part, the part and their places in it.
    let places = |(a, b): (u32, u32)| {
        let of_other = parts_of.of(b as usize);
        let common = parts_of.of(a as usize).iter();
        let common = common.filter(move |part| of_other.contains(part));
        common.map(move |&part| {
            let place = |image| parts[part as usize].partition_point(|&other| other < image);
            (part as usize, place(a), place(b))
        })
    };
    let mut sets: Vec<UnionFind> = parts
        .iter()
        .map(|part| UnionFind::new(part.len()))
        .collect();
    let (doubtful, sure): (Vec<&Pair>, Vec<&Pair>) = pairs
        .iter()
        .filter(|pair| pair.used)
        .partition(|pair| matches!(pair.config, 1 | 4..=8));
    let of_frames = frames.iter().flat_map(|frame| frame.windows(2));
    let of_frames = of_frames.map(|two| (two[0], two[1]));
    for two in of_frames.chain(sure.iter().map(|pair| pair.nodes)) {
        for (part, a, b) in places(two) {
            sets[part].union(a, b);
        }
    }
    let mut without: Vec<Vec<&Pair>> = vec![Vec::new(); parts.len()];
    let mut looked_at = 0;
    for pair in doubtful {
        for (part, a, b) in places(pair.nodes) {
            if sets[part].find(a) == sets[part].find(b) {
                continue;
            }
            if looked_at < MOST
                && geometry(pair.nodes)?.is_some_and(|known| known.has_no_base_line())
            {
                looked_at += 1;
                without[part].push(pair);
            } else {
                sets[part].union(a, b);
            }
        }
    }
    let found = parts.iter().zip(sets).zip(without);
    let found = found.map(|((part, mut sets), mut without)| {
        let mut set_of = |image: u32| sets.find(part.partition_point(|&other| other < image));
        without.retain(|pair| set_of(pair.nodes.0) != set_of(pair.nodes.1));
        let mut groups: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
        for &image in part {
            groups.entry(set_of(image)).or_default().push(image);
        }
        let mut groups: Vec<Vec<u32>> = groups.into_values().collect();
        groups.sort_by_key(|group| (Reverse(group.len()), group[0]));
        let configs: BTreeSet<i64> = without.iter().map(|pair| pair.config).collect();
        Groups {
            groups,
            pairs: without.len(),
            configs: configs.into_iter().map(config_name).collect(),
        }
    });
    Ok(found.collect())
}

/// That pairs have no base line, if no others connect what they connect.
///
/// # Errors
/// Those of `geometry`.
pub(super) fn note(
    pairs: &[Pair],
    images: usize,
    geometry: impl FnMut((u32, u32)) -> Result<Option<Estimate>, Problem>,
) -> Result<Option<String>, Problem> {
    let all: Vec<u32> = (0..images as u32).collect();
    let found = groups(pairs, images, &[all], &[], geometry)?;
    let found = found.into_iter().find(|found| found.pairs > 0);
    Ok(found.map(|found| {
        let has = if found.pairs == 1 { "has" } else { "have" };
        format!(
            "{} ({}) {has} no base line that shows and so no fundamental matrix, which every verdict takes for \
             granted; no other pairs connect the same images (verify overview)",
            counted(found.pairs, "used pair"),
            found.configs.join(", "),
        )
    }))
}
