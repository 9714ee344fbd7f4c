//! Tables of cameras, whose head says what their columns are.

use crate::edge_list::fields::Field;
use crate::error::Problem;

/// A table with a head: a column of names, and those of centres, poses or matrices in any order.
pub(super) struct Table {
    /// Where each number stands behind the name.
    order: Vec<usize>,
}

impl Table {
    /// What the columns of a head may be called.
    const NAMES: [&str; 6] = ["name", "image", "camera", "label", "node", "id"];
    const COLUMNS: [&[&str]; 4] = [
        &["x", "y", "z"],
        &["qw", "qx", "qy", "qz", "tx", "ty", "tz"],
        &[
            "p11", "p12", "p13", "p14", "p21", "p22", "p23", "p24", "p31", "p32", "p33", "p34",
        ],
        &[
            "p00", "p01", "p02", "p03", "p10", "p11", "p12", "p13", "p20", "p21", "p22", "p23",
        ],
    ];

    /// If it is a head; in lower case but for the first.
    pub(super) fn of_head(first: &str, rest: &[String]) -> Option<Self> {
        if !Self::NAMES.contains(&&*first.to_lowercase()) {
            return None;
        }
        let place = |name: &&str| rest.iter().position(|column| column == name);
        let order = |columns: &&[&str]| {
            let order = columns.iter().map(place).collect::<Option<Vec<usize>>>()?;
            (order.len() == rest.len()).then_some(order)
        };
        let order = Self::COLUMNS.iter().find_map(order)?;
        Some(Self { order })
    }

    /// How many numbers a row has.
    pub(super) fn width(&self) -> usize {
        self.order.len()
    }

    /// The numbers of a row, as they are expected.
    pub(super) fn ordered(&self, fields: &[Field]) -> Result<Vec<Field>, Problem> {
        let (expected, found) = (self.order.len(), fields.len());
        match expected == found {
            true => Ok(self.order.iter().map(|&k| fields[k]).collect()),
            false => Err(super::no_numbers(expected, found)),
        }
    }
}
