//! The JSON text of a certificate of intrinsics (section 15 of the specification).

use crate::document::{Body, GraphName};
use crate::json::{Big, Optional, Strict, objects};
use crate::rejection::{Checked, Failure, ensure};

/// What the member `format` says.
pub(crate) const FORMAT: &str = "viewcert certificate of intrinsics";

objects! {
    Document {
        format: String, version: u64, program: String, graph: GraphName, classes: Vec<String>,
        shared: Optional<Vec<Vec<u32>>>,
        claim: Claim, bodies: Vec<Body>, prime: Big<u64>, seed: Big<u64>, draw: u64,
        rows: Vec<usize>, cols: Vec<usize>, motion: Vec<Big<u64>>,
    }
    Claim {
        verdict: String, at_least: i64, at_most: i64, required: i64,
        components: Option<Vec<Vec<u32>>>, not_determined: Option<Vec<u32>>,
    }
}

/// Reads a certificate.
pub(super) fn parse(text: &[u8]) -> Checked<Document> {
    let document = serde_json::from_slice(text);
    let Strict(document): Strict<Document> =
        document.map_err(|error| Failure::rejected(error.to_string()))?;
    ensure!(document.format == FORMAT, "`format` is not \"{FORMAT}\"");
    ensure!(
        document.version == 1,
        "version {} is unknown to this program",
        document.version
    );
    Ok(document)
}
