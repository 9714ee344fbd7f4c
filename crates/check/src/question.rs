//! What a certificate is about (section 3).

use crate::json::Value;
use serde::de::{Deserializer, Error};

/// The member `question`: what a certificate is about, and which members it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// Which cameras generic ones determine.
    Generic,
    /// Which are determined at given cameras (section 14).
    AtCameras,
    /// Which intrinsics are determined (section 15).
    Intrinsics,
    /// How many measured motions contradict each other (docs/contradictions.md).
    Contradictions,
}

impl Value for Question {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Ok(match String::read(from)?.as_str() {
            "generic" => Self::Generic,
            "at-cameras" => Self::AtCameras,
            "intrinsics" => Self::Intrinsics,
            "contradictions" => Self::Contradictions,
            other => {
                return Err(D::Error::custom(format!(
                    "`{other}` is not a question: `generic`, `at-cameras`, `intrinsics` or `contradictions`"
                )));
            }
        })
    }
}
