//! The text of section 13 as typed values.

use super::Members;
use crate::json::{Big, Value, objects};
use serde::de::{Deserialize, Deserializer};

objects! {
    BaseLines {
        frames: Vec<Vec<[u32; 2]>>, known: Vec<u32>, lower: Lower, upper: Option<Upper>,
        one_axis: Option<Lower>,
    }
    Lower { prime: Big<u64>, seed: Big<u64>, draw: u64, rows: Vec<usize>, cols: Vec<usize> }
    Upper { held: Vec<u32>, blocks: Vec<Members>, bound: i64 }
    BaseLinesClaim {
        value: String, at_least: i64, at_most: i64, required: i64, about_one_axis: bool,
        strength: String, error_log2: Option<i64>,
    }
}

impl Value for bool {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        bool::deserialize(from)
    }
}
