//! Which columns and lines of a list are asked for.

use std::fmt;
use std::str::FromStr;

use crate::edge_list::decimal::Decimal;

/// Which lines of a list count, and where in them the pairs stand; for everything else a list says so
/// itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ListOptions {
    /// The columns of the pairs.
    pub columns: Option<Columns>,
    /// The least weight of a pair.
    pub min_weight: Option<Decimal>,
    /// Whether pairs of a camera with itself are left out instead of refused.
    pub skip_loops: bool,
}

impl ListOptions {
    /// Whether a pair with so many matches does not count.
    pub(crate) fn weighs_less(&self, matches: u64) -> bool {
        let least = self.min_weight.as_ref();
        least.is_some_and(|least| least.is_above(&matches.to_string()) == Ok(true))
    }
}

/// The two columns of pairs, and perhaps the one of weights, by their names or their numbers from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns(pub(super) Vec<Box<str>>);

/// No two or three columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "expected the two columns of the pairs and perhaps that of the weights, by their names or their \
     numbers from 1, like img1,img2 or 2,3,5"
)]
pub struct NoColumns;

/// `img1,img2` or `2,3` or `img1,img2,score`.
impl FromStr for Columns {
    type Err = NoColumns;

    fn from_str(text: &str) -> Result<Self, NoColumns> {
        let columns: Vec<Box<str>> = text.split(',').map(|name| name.trim().into()).collect();
        let are_two =
            matches!(&columns[..], [first, second] | [first, second, _] if first != second);
        match are_two && !columns.iter().any(|name| ["", "0"].contains(&&**name)) {
            true => Ok(Self(columns)),
            false => Err(NoColumns),
        }
    }
}

/// As [`FromStr`] reads it.
impl fmt::Display for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.join(","))
    }
}
