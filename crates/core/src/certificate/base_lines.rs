//! What frames add, as certificates have it (docs/certificate.md, section 13).

use super::objects::{Big, object, objects, written};
use crate::contract::piece::Members;
use crate::decide::evidence::ModularDraw;
use crate::decide::{BaseLinesEvidence, SharedBaseLines};
use crate::linalg::textbook::Pivots;
use serde::Serialize;

objects! {
    BaseLinesView<'a> {
        frames: &'a [Vec<(u32, u32)>],
        known: Vec<u32>,
        lower: At<'a>,
        upper: Option<UpperView<'a>>,
        one_axis: Option<At<'a>>,
    }

    UpperView<'a> {
        held: &'a [u32],
        blocks: &'a [Members],
        bound: usize,
    }

    ClaimedBaseLines {
        value: &'static str,
        at_least: usize,
        at_most: usize,
        required: usize,
        about_one_axis: bool,
        strength: &'static str,
        error_log2: Option<i64>,
    }
}

impl From<&SharedBaseLines> for ClaimedBaseLines {
    fn from(found: &SharedBaseLines) -> Self {
        Self {
            value: found.value(),
            at_least: found.rank,
            at_most: found.at_most,
            required: found.required,
            about_one_axis: found.about_one_axis,
            strength: "proof",
            error_log2: None,
        }
    }
}

impl<'a> From<&'a SharedBaseLines> for BaseLinesView<'a> {
    fn from(found: &'a SharedBaseLines) -> Self {
        let BaseLinesEvidence {
            frames,
            lower,
            one_axis,
            upper,
            ..
        } = &found.evidence;
        Self {
            frames: frames.frames(),
            known: frames.known().collect(),
            lower: At(lower),
            upper: upper.as_ref().map(|(held, blocks)| UpperView {
                held,
                blocks,
                bound: found.at_most,
            }),
            one_axis: one_axis.as_ref().map(At),
        }
    }
}

/// Pivots, and where they were found.
pub(super) struct At<'a>(pub(super) &'a (ModularDraw, Pivots));

written! {
    At<'_>: |own| {
        prime: Big(own.0.0.prime), seed: Big(own.0.0.seed), draw: own.0.0.draw,
        rows: own.0.1.rows, cols: own.0.1.cols,
    }
}
