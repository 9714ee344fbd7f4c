//! The JSON text of a certificate at given cameras (section 14 of the specification).

use crate::document::{Body, GraphName, Members, Model, Pair, RankClaim, VerdictClaim};
use crate::json::{Big, Strict, Value, objects};
use crate::rejection::{Checked, Failure};
use serde::de::{Deserializer, Error};

/// What the member `format` says.
pub(crate) const FORMAT: &str = "viewcert certificate at cameras";

objects! {
    Document {
        format: Format, version: Version, program: String, graph: GraphName, model: Model,
        cameras: Option<Vec<Vec<Big<String>>>>, centres: Vec<[Big<String>; 4]>, claim: Claims,
        bodies: Vec<Body>, rigid: Members, pieces: Vec<Piece>,
    }
    Claims { verdict: VerdictClaim, rank: RankClaim, components: ComponentsClaim }
    ComponentsClaim { value: i64, strength: String, error_log2: Option<i64> }
    Piece {
        bodies: Vec<u32>, edges: Vec<Pair>, rank: i64, primes: u64, kernel: Vec<Big<u64>>,
        classes: Vec<Class>,
    }
    Class { bodies: Vec<u32>, edges: Vec<Pair>, split: Option<Split> }
    Split { rigid: Members, pieces: Vec<Piece> }
}

#[derive(Debug)]
pub(crate) struct Format;

impl Value for Format {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let wrong = || D::Error::custom(format!("`format` is not \"{FORMAT}\""));
        (String::read(from)? == FORMAT)
            .then_some(Format)
            .ok_or_else(wrong)
    }
}

#[derive(Debug)]
pub(crate) struct Version;

impl Value for Version {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        match u64::read(from)? {
            1 => Ok(Version),
            other => Err(D::Error::custom(format!(
                "version {other} is unknown to this program"
            ))),
        }
    }
}

/// Reads a certificate.
pub(super) fn parse(text: &[u8]) -> Checked<Document> {
    let document = serde_json::from_slice(text);
    let Strict(document) = document.map_err(|error| Failure::rejected(error.to_string()))?;
    Ok(document)
}
