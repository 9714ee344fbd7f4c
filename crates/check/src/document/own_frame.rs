//! The text of section 16 as typed values.

use super::Members;
use super::base_lines::Lower;
use crate::json::{Big, objects};

objects! {
    OwnFrame {
        groups: Vec<Vec<u32>>, vectors: Option<Vec<Vec<[Big<i128>; 3]>>>, lower: Lower,
        rigid: Vec<Rigid>, upper: Option<Upper>,
    }
    Rigid { bodies: Vec<u32>, edges: Vec<[u32; 2]>, lower: Lower }
    Upper { blocks: Vec<Members>, bound: i64 }
    OwnFrameClaim {
        value: String, at_least: i64, at_most: i64, required: i64,
        strength: String, error_log2: Option<i64>,
    }
}
