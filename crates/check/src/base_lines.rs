//! Unknown base lines (section 13 of the specification; theory, Theorems 13.26 and 13.27): what frames
//! add where the places of sensors in their rigs are the same unknown vectors in all of them.
//!
//! `frames` reads what is supposed, `matrix` proves a lower bound on the rank.

mod frames;
mod matrix;

use crate::document::Document;
use crate::document::base_lines::{BaseLinesClaim, Upper};
use crate::forest::{root, unite};
use crate::graph::Graph;
use crate::rejection::{Checked, Within, ensure};
use crate::structure::Structure;
use frames::Frames;
use matrix::Layout;
use std::collections::BTreeMap;
use std::fmt;

/// What is proved of base lines that are not known.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BaseLines {
    /// How many frames there are, of two images or more.
    pub frames: usize,
    /// How many base lines are unknown.
    pub unknown: usize,
    /// The SHA-256 of the canonical form of the frames, in lower-case hexadecimal digits.
    pub sha256: String,
    /// The rank is not below this.
    pub at_least: i64,
    /// It is not above this.
    pub at_most: i64,
    /// The rank at which all centres and places are unique.
    pub required: i64,
    /// Whether that is so too if all frames turn about one axis.
    pub about_one_axis: bool,
}

impl BaseLines {
    /// What follows: `solvable`, `not-finite-solvable`, or `open`.
    pub fn value(&self) -> &'static str {
        if self.at_least == self.required {
            "solvable"
        } else if self.at_most < self.required {
            "not-finite-solvable"
        } else {
            "open"
        }
    }
}

impl fmt::Display for BaseLines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let BaseLines {
            frames,
            unknown,
            sha256,
            at_least,
            at_most,
            required,
            about_one_axis,
        } = self;
        let value = self.value();
        let axis = if *about_one_axis {
            ", also about one axis"
        } else {
            ""
        };
        write!(
            f,
            "{value}{axis}, rank {at_least} to {at_most} of {required} required (proof), where frames ({frames}) share \
             unknown base lines ({unknown}), SHA-256 {sha256}"
        )
    }
}

/// Verifies what a certificate says of base lines, if it does.
pub(crate) fn check(
    document: &Document,
    structure: &Structure,
    given: Option<&Graph>,
) -> Checked<Option<BaseLines>> {
    let (stated, claim) = (document.base_lines.0.as_ref(), &document.claim.base_lines.0);
    let (stated, claim) = match (stated, claim) {
        (Some(stated), Some(claim)) => (stated, claim),
        (None, None) => return Ok(None),
        _ => {
            return Err(From::from(String::from(
                "claim and document have `base_lines`, or neither has",
            )));
        }
    };
    let setting = structure.setting;
    ensure!(
        setting.model.in_space(),
        "base lines in the {} model",
        setting.model
    );
    ensure!(setting.vectors.is_none(), "base lines beside given vectors");
    let nodes = document.graph.nodes;
    let frames = &Frames::new(stated, nodes).within(|| "frames".into())?;
    let sha256 = frames.digits();
    ensure!(
        given.is_none_or(|given| given.frames.as_ref() == Some(&sha256)),
        "the frames are not those that are given: SHA-256 {sha256}"
    );
    let is_scaled = frames.are_scaled || document.displacements.0.is_some();
    let free = nodes - frames.at.len();
    let unknowns = 3 * (free + frames.count + frames.places);
    let required = unknowns as i64 - 4 + i64::from(is_scaled);
    let layout = Layout::new(frames, structure, nodes)?;
    let at_least = layout.check_lower(&stated.lower, false);
    let at_least = at_least.within(|| "lower".into())?;
    let bound = stated.upper.as_ref().map(|upper| {
        let bound = check_upper(upper, frames, structure, is_scaled);
        bound.within(|| "upper".into())
    });
    let at_most = bound
        .transpose()?
        .map_or(required, |bound| bound.min(required));
    ensure!(
        at_least <= at_most,
        "the rank is {at_least} at least and {at_most} at most"
    );
    let one_axis = stated.one_axis.as_ref().map(|lower| {
        let rank = layout.check_lower(lower, true)?;
        ensure!(
            rank == required,
            "the rank is {rank} at least, not {required}"
        );
        Ok(())
    });
    let one_axis = one_axis.transpose().within(|| "one_axis".into())?;
    let found = BaseLines {
        frames: frames.count,
        unknown: frames.places,
        sha256,
        at_least,
        at_most,
        required,
        about_one_axis: one_axis.is_some(),
    };
    compare(claim, &found).within(|| "claim".into())?;
    Ok(Some(found))
}

/// Sees that what is claimed is what was found.
fn compare(claim: &BaseLinesClaim, found: &BaseLines) -> Checked<()> {
    ensure!(
        claim.about_one_axis == found.about_one_axis,
        "`about_one_axis` is there with `one_axis`, and not without"
    );
    compare_ranks(
        [claim.at_least, claim.at_most, claim.required],
        [found.at_least, found.at_most, found.required],
        [&claim.value, found.value()],
        (&claim.strength, claim.error_log2),
    )
}

/// Sees that the bounds of a rank, the rank that is required, and what follows are claimed as they were found, as
/// proofs.
pub(crate) fn compare_ranks(
    claimed: [i64; 3],
    found: [i64; 3],
    [value, follows]: [&str; 2],
    (strength, error_log2): (&str, Option<i64>),
) -> Checked<()> {
    for (k, name) in ["at_least", "at_most", "required"].into_iter().enumerate() {
        let (claimed, found) = (claimed[k], found[k]);
        ensure!(claimed == found, "`{name}` is {found}, not {claimed}");
    }
    ensure!(
        value == follows,
        "`{value}` is claimed, but the evidence gives `{follows}`"
    );
    ensure!(
        strength == "proof" && error_log2.is_none(),
        "the strength is not a proof"
    );
    Ok(())
}

/// Verifies (B4); returns the bound.
fn check_upper(
    upper: &Upper,
    frames: &Frames,
    structure: &Structure,
    is_scaled: bool,
) -> Checked<i64> {
    let held = &upper.held;
    ensure!(held.is_sorted_by(|a, b| a < b), "`held` is not increasing");
    let is_unknown = |&sensor: &u32| matches!(frames.unknown.get(sensor as usize), Some(Some(_)));
    ensure!(
        held.iter().all(is_unknown),
        "a sensor of `held` has no unknown place"
    );
    let list = upper
        .blocks
        .iter()
        .map(|block| (&block.bodies, &block.edges));
    let partition = structure.partition(&structure.everything, list);
    let (blocks, _) = partition.within(|| "blocks".into())?;
    let mut sum = 3 * held.len() as i64 - i64::from(!held.is_empty() && !is_scaled);
    for block in &blocks {
        sum += block_rank(block, frames, structure, held);
    }
    ensure!(
        sum == upper.bound,
        "the bound is {}, but the blocks sum up to {sum}",
        upper.bound
    );
    Ok(sum)
}

/// What a block contributes.
fn block_rank(block: &[usize], frames: &Frames, structure: &Structure, held: &[u32]) -> i64 {
    let nodes = structure.nodes(block);
    let images: Vec<(usize, usize)> = nodes
        .iter()
        .filter_map(|node| frames.at.get(node).copied())
        .collect();
    // Vertices: frames, and sensors behind them.
    let mut number: BTreeMap<usize, usize> = BTreeMap::new();
    for &(frame, sensor) in &images {
        number.insert(frame, 0);
        number.insert(frames.count + sensor, 0);
    }
    (0..)
        .zip(number.values_mut())
        .for_each(|(next, place)| *place = next);
    let mut forest: Vec<usize> = (0..number.len()).collect();
    for &(frame, sensor) in &images {
        unite(
            &mut forest,
            number[&frame],
            number[&(frames.count + sensor)],
        );
    }
    let mut fixed: BTreeMap<usize, i64> = BTreeMap::new();
    for (&vertex, &place) in &number {
        let count = fixed.entry(root(&mut forest, place)).or_default();
        let sensor = vertex.checked_sub(frames.count);
        *count += i64::from(sensor.is_some_and(|sensor| {
            frames.unknown[sensor].is_none() || held.binary_search(&(sensor as u32)).is_ok()
        }));
    }
    let is_scaled = structure.is_scaled(block) || fixed.values().any(|&count| count >= 2);
    let fixed: i64 = fixed.values().map(|&count| count.max(1)).sum();
    let vectors = (nodes.len() - images.len() + number.len()) as i64 - fixed;
    3 * vectors - 4 + i64::from(is_scaled)
}
