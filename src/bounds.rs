//! Bounds on the entries of rational cameras.

use std::fmt;
use std::str::FromStr;
use viewcert::geometry::draw::{MAX_DENOMINATOR, MAX_NUMERATOR};

/// Numerators and denominators of rational cameras, at most: `9,4`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// The largest numerator.
    pub numerator: u64,
    /// The largest denominator.
    pub denominator: u64,
}

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.numerator, self.denominator)
    }
}

impl FromStr for Bounds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bounds = text.split_once(',').and_then(|(numerator, denominator)| {
            Some(Self {
                numerator: within(numerator, MAX_NUMERATOR)?,
                denominator: within(denominator, MAX_DENOMINATOR)?,
            })
        });
        bounds.ok_or_else(|| {
            format!(
                "two numbers, as in 9,4: the largest numerator, 1 to {MAX_NUMERATOR}, and the largest \
                 denominator, 1 to {MAX_DENOMINATOR}"
            )
        })
    }
}

fn within(text: &str, most: u64) -> Option<u64> {
    text.parse()
        .ok()
        .filter(|number| (1..=most).contains(number))
}
