//! What displacements in a frame of their own add, as certificates have it (docs/certificate.md, section 16).

use super::base_lines::At;
use super::objects::{Big, object, objects, written};
use crate::contract::piece::Members;
use crate::decide::evidence::ModularDraw;
use crate::decide::{OwnFrame, OwnFrameEvidence};
use crate::linalg::textbook::Pivots;
use serde::Serialize;

objects! {
    OwnFrameView<'a> {
        groups: &'a [Vec<u32>],
        vectors: Option<Vec<Vec<[Big<i128>; 3]>>>,
        lower: At<'a>,
        rigid: Vec<Rigid<'a>>,
        upper: Option<UpperView<'a>>,
    }

    UpperView<'a> {
        blocks: &'a [Members],
        bound: usize,
    }

    ClaimedOwnFrame {
        value: &'static str,
        at_least: usize,
        at_most: usize,
        required: usize,
        strength: &'static str,
        error_log2: Option<i64>,
    }
}

/// Members that are rigid together, and what shows it.
struct Rigid<'a>(&'a (Members, (ModularDraw, Pivots)));

written! {
    Rigid<'_>: |own| { bodies: own.0.0.bodies, edges: own.0.0.edges, lower: At(&own.0.1) }
}

impl From<&OwnFrame> for ClaimedOwnFrame {
    fn from(found: &OwnFrame) -> Self {
        Self {
            value: found.name(),
            at_least: found.rank,
            at_most: found.at_most,
            required: found.required,
            strength: "proof",
            error_log2: None,
        }
    }
}

impl<'a> From<&'a OwnFrame> for OwnFrameView<'a> {
    fn from(found: &'a OwnFrame) -> Self {
        let OwnFrameEvidence {
            lower,
            rigid,
            upper,
        } = &found.evidence;
        Self {
            groups: found.given.groups(),
            vectors: found.given.vectors().map(vectors),
            lower: At(lower),
            rigid: rigid.iter().map(Rigid).collect(),
            upper: upper.as_ref().map(|blocks| UpperView {
                blocks,
                bound: found.at_most,
            }),
        }
    }
}

/// Vectors of groups.
pub(super) fn vectors(groups: &[Vec<[i128; 3]>]) -> Vec<Vec<[Big<i128>; 3]>> {
    let vectors = |group: &Vec<[i128; 3]>| group.iter().map(|v| v.map(Big)).collect();
    groups.iter().map(vectors).collect()
}
