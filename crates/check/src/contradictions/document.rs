//! The JSON text of a certificate of contradictions (docs/contradictions.md, sections 2 to 4).

use crate::document::{Format, Version};
use crate::json::objects;
use crate::question::Question;

objects! {
    Document {
        format: Format, version: Version, question: Question, program: String,
        database: Option<String>, images: Vec<String>, pairs: Vec<Pair>, excluded: Vec<Pair>, packings: Vec<Packing>, upper: Vec<Upper>,
    }
    Pair { ends: [usize; 2], configuration: Option<i64>, q: [i64; 4], t: Option<[i64; 3]> }
    Packing {
        theta: usize, phi: Option<usize>, assumed: Vec<usize>, assumed_within: usize, denominator: u64,
        cycles: Vec<Cycle>, at_least: u64,
    }
    Cycle { walk: Vec<[i64; 2]>, weight: u64, witness: Option<[i64; 3]> }
    Upper { theta: usize, rotations: Vec<[i64; 4]>, at_most: usize }
}
