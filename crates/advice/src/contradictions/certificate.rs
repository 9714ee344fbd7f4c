//! The certificate of contradictions as written: docs/contradictions.md.

use super::Contradictions;
use super::packing::Packing;
use serde::Serialize;
use serde_json::{Value, json};
use viewcert_formats::{Motion, Motions};

/// What is written; `format` comes first, by which files of this program are known.
#[derive(Serialize)]
pub struct Certificate<'a> {
    format: &'static str,
    version: u32,
    question: &'static str,
    program: &'static str,
    database: Option<&'a str>,
    images: Vec<String>,
    pairs: Value,
    excluded: Value,
    packings: Value,
    upper: Value,
}

/// The certificate of what was found about motions.
pub fn certificate<'a>(motions: &'a Motions, found: &Contradictions) -> Certificate<'a> {
    let pair = |motion: &Motion| {
        json!({
            "ends": motion.images,
            "configuration": motion.configuration,
            "q": motion.rotation,
            "t": motion.vector,
        })
    };
    let pairs = |motions: &[Motion]| motions.iter().map(pair).collect::<Value>();
    let packed = |packing: &Packing| {
        let is_directed = packing.cycles.iter().any(|(one, _)| one.witness.is_some());
        let cycles = packing.cycles.iter().map(|(cycle, weight)| {
            let steps = cycle.walk.iter();
            let steps = steps.map(|&(pair, forth)| json!([pair, if forth { 1 } else { -1 }]));
            json!({
                "walk": steps.collect::<Value>(),
                "weight": weight,
                "witness": cycle.witness,
            })
        });
        json!({
            "theta": packing.terms.theta,
            "phi": is_directed.then_some(packing.terms.phi),
            "assumed": packing.terms.assumed,
            "assumed_within": packing.terms.assumed_within,
            "denominator": packing.denominator,
            "cycles": cycles.collect::<Value>(),
            "at_least": packing.at_least(),
        })
    };
    let others = [&found.directed, &found.finer].map(Option::as_ref);
    let supposed = found.neighbours.as_ref().map(|found| &found.packing);
    let packings = [Some(&found.packing), supposed].into_iter().chain(others);
    let names = (0..motions.images as u32).map(|image| motions.labels.label(image));
    Certificate {
        format: "viewcert certificate",
        version: 3,
        question: "contradictions",
        program: concat!("viewcert ", env!("CARGO_PKG_VERSION")),
        database: motions.hash.as_deref(),
        images: names.map(|name| name.into_owned()).collect(),
        pairs: pairs(&motions.pairs),
        excluded: pairs(&motions.excluded),
        packings: packings.flatten().map(packed).collect(),
        upper: json!([{
            "theta": found.packing.terms.theta,
            "rotations": found.rotations,
            "at_most": found.at_most(),
        }]),
    }
}
