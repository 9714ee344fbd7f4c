//! Which columns and lines of a list are asked for.

use std::fmt;
use std::str::FromStr;

use crate::edge_list::decimal::Decimal;
use crate::edge_list::fields::integer;

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

/// The two columns of pairs, and the one of weights if that is not found by its name or place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    pub(super) ends: [Column; 2],
    pub(super) weight: Option<Column>,
}

/// A column, as it is called or counted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Column {
    /// By its place from 0.
    Place(usize),
    /// By its name in the head.
    Name(Box<str>),
}

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
        let column = |name: &str| match (name.trim(), integer(name.trim())) {
            ("", _) | (_, Some(0)) => Err(NoColumns),
            (_, Some(number)) => usize::try_from(number - 1)
                .map(Column::Place)
                .map_err(|_| NoColumns),
            (name, None) => Ok(Column::Name(name.into())),
        };
        let columns: Vec<Column> = text.split(',').map(column).collect::<Result<_, _>>()?;
        let (ends, weight) = match &columns[..] {
            [first, second] => ([first, second], None),
            [first, second, weight] => ([first, second], Some(weight)),
            _ => return Err(NoColumns),
        };
        if ends[0] == ends[1] {
            return Err(NoColumns);
        }
        Ok(Self {
            ends: ends.map(Column::clone),
            weight: weight.cloned(),
        })
    }
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Place(place) => write!(f, "{}", place + 1),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// As [`FromStr`] reads it.
impl fmt::Display for Columns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = &self.ends;
        write!(f, "{first},{second}")?;
        self.weight
            .iter()
            .try_for_each(|weight| write!(f, ",{weight}"))
    }
}
