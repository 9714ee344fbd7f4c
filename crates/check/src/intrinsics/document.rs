//! The JSON text of a certificate of intrinsics (section 15 of the specification).

use crate::document::{Body, Format, GraphName, Version};
use crate::json::{Big, Optional, objects};
use crate::question::Question;

objects! {
    Document {
        format: Format, version: Version, question: Question, program: String, graph: GraphName,
        classes: Vec<String>, shared: Optional<Vec<Vec<u32>>>,
        claim: Claim, bodies: Vec<Body>, prime: Big<u64>, seed: Big<u64>, draw: u64,
        rows: Vec<usize>, cols: Vec<usize>, motion: Vec<Big<u64>>,
    }
    Claim {
        verdict: String, at_least: i64, at_most: i64, required: i64,
        components: Option<Vec<Vec<u32>>>, not_determined: Option<Vec<u32>>,
    }
}
