//! What the commands print and draw.

pub mod bars;
pub mod comparison;
pub mod conditions;
pub mod curves;
pub mod verdicts;
