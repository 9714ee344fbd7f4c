//! The certificate of contradictions as written: docs/contradictions.md, version 1.

use super::Contradictions;
use super::packing::Packing;
use serde::Serialize;
use std::borrow::Cow;
use viewcert_formats::{Motion, Motions};

#[derive(Serialize)]
struct Document<'a> {
    format: &'static str,
    version: u32,
    program: &'static str,
    database: Option<&'a str>,
    images: Vec<Cow<'a, str>>,
    pairs: Vec<Pair>,
    excluded: Vec<Pair>,
    packings: Vec<Packed<'a>>,
    upper: Vec<Upper<'a>>,
}

#[derive(Serialize)]
struct Pair {
    ends: [u32; 2],
    configuration: Option<i64>,
    q: [i64; 4],
    t: Option<[i64; 3]>,
}

#[derive(Serialize)]
struct Packed<'a> {
    theta: u32,
    phi: Option<u32>,
    assumed: &'a [u32],
    denominator: u64,
    cycles: Vec<Walk>,
    at_least: usize,
}

#[derive(Serialize)]
struct Walk {
    walk: Vec<(u32, i8)>,
    weight: u64,
    witness: Option<[i64; 3]>,
}

#[derive(Serialize)]
struct Upper<'a> {
    theta: u32,
    rotations: &'a [[i64; 4]],
    at_most: usize,
}

/// The certificate of what was found about motions.
pub fn certificate<'a>(motions: &'a Motions, found: &'a Contradictions) -> impl Serialize + 'a {
    let pairs = |motions: &[Motion]| {
        let pair = |motion: &Motion| Pair {
            ends: motion.images,
            configuration: motion.configuration,
            q: motion.rotation,
            t: motion.vector,
        };
        motions.iter().map(pair).collect()
    };
    let [theta, phi] = found.angles;
    let packed = |packing: &'a Packing, theta, assumed: &'a [u32]| {
        let walks = packing.cycles.iter().map(|(cycle, weight)| Walk {
            walk: cycle
                .walk
                .iter()
                .map(|&(pair, forth)| (pair, if forth { 1 } else { -1 }))
                .collect(),
            weight: *weight,
            witness: cycle.witness,
        });
        let cycles: Vec<Walk> = walks.collect();
        Packed {
            theta,
            phi: cycles
                .iter()
                .any(|walk| walk.witness.is_some())
                .then_some(phi),
            assumed,
            denominator: packing.denominator,
            cycles,
            at_least: packing.at_least(),
        }
    };
    let finer = found
        .finer
        .as_ref()
        .map(|(theta, packing)| packed(packing, *theta, &[]));
    let directed = found
        .directed
        .as_ref()
        .map(|packing| packed(packing, theta, &[]));
    let neighbours = found.neighbours.as_ref();
    let neighbours = neighbours.map(|found| packed(&found.packing, theta, &found.assumed));
    let first = packed(&found.packing, theta, &[]);
    Document {
        format: "viewcert certificate of contradictions",
        version: 1,
        program: concat!("viewcert ", env!("CARGO_PKG_VERSION")),
        database: motions.hash.as_deref(),
        images: (0..motions.images as u32)
            .map(|image| motions.labels.label(image))
            .collect(),
        pairs: pairs(&motions.pairs),
        excluded: pairs(&motions.excluded),
        packings: [Some(first), directed, finer, neighbours]
            .into_iter()
            .flatten()
            .collect(),
        upper: vec![Upper {
            theta,
            rotations: &found.rotations,
            at_most: found.at_most(),
        }],
    }
}
