//! What frames add, as certificates have it (docs/certificate.md, section 13).

use super::objects::{Big, objects};
use crate::contract::piece::Members;
use crate::decide::evidence::ModularDraw;
use crate::decide::{BaseLinesEvidence, SharedBaseLines};
use crate::linalg::textbook::Pivots;
use serde::Serialize;

objects! {
    BaseLinesView<'a> {
        frames: &'a [Vec<(u32, u32)>],
        known: Vec<u32>,
        lower: LowerView<'a>,
        upper: Option<UpperView<'a>>,
        one_axis: Option<LowerView<'a>>,
    }

    LowerView<'a> {
        prime: Big<u64>,
        seed: Big<u64>,
        draw: u64,
        rows: &'a [usize],
        cols: &'a [usize],
    }

    UpperView<'a> {
        held: &'a [u32],
        blocks: Vec<BlockView<'a>>,
        bound: usize,
    }

    BlockView<'a> {
        bodies: &'a [u32],
        edges: &'a [(u32, u32)],
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
            lower: lower.into(),
            upper: upper.as_ref().map(|(held, blocks)| UpperView {
                held,
                blocks: blocks.iter().map(BlockView::from).collect(),
                bound: found.at_most,
            }),
            one_axis: one_axis.as_ref().map(LowerView::from),
        }
    }
}

impl<'a> From<&'a (ModularDraw, Pivots)> for LowerView<'a> {
    fn from((draw, pivots): &'a (ModularDraw, Pivots)) -> Self {
        Self {
            prime: Big(draw.prime),
            seed: Big(draw.seed),
            draw: draw.draw,
            rows: &pivots.rows,
            cols: &pivots.cols,
        }
    }
}

impl<'a> From<&'a Members> for BlockView<'a> {
    fn from(members: &'a Members) -> Self {
        Self {
            bodies: &members.bodies,
            edges: &members.edges,
        }
    }
}
