//! The features of a database: how many every image has, and where those lie that are asked for.
//!
//! Numbers of features are in columns of their own and are read for all images. Places are read of
//! single images, and only when tracks have two features there.

use std::collections::HashMap;

use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension};

use super::DatabaseError;
use super::tables::columns;
use crate::error::Problem;
use crate::tracks::Places;

/// Bytes of a coordinate.
const COORDINATE: usize = 4;

/// The features of all images.
pub(super) struct Keypoints<'a> {
    connection: &'a Connection,
    names: &'a [Box<str>],
    /// How many every image has, by its node; none where the database has no list of them.
    counts: Vec<Option<u32>>,
    /// The number of every image, by its node.
    ids: Vec<i64>,
    spread: u32,
    /// Images that were asked for and have no list.
    missing: usize,
}

fn damaged(names: &[Box<str>], node: u32, why: String) -> DatabaseError {
    DatabaseError::Keypoints {
        image: names[node as usize].to_string(),
        why,
    }
}

/// How many features every image has, by its node; none where the database has no list of them, and nothing
/// at all where it has no table for them. O(images).
///
/// # Errors
/// Numbers that are none.
pub(super) fn counts(
    connection: &Connection,
    names: &[Box<str>],
    nodes: &HashMap<i64, u32>,
) -> Result<Option<Vec<Option<u32>>>, DatabaseError> {
    let mut counts = vec![None; names.len()];
    let present = columns(connection, "keypoints")?;
    let wanted = ["image_id", "rows", "cols", "data"];
    if !wanted
        .iter()
        .all(|column| present.iter().any(|name| name == column))
    {
        return Ok(None);
    }
    let mut statement = connection.prepare("select image_id, rows from keypoints")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let (id, count): (i64, i64) = (row.get(0)?, row.get(1)?);
        let Some(&node) = nodes.get(&id) else {
            continue;
        };
        let count = u32::try_from(count)
            .map_err(|_| damaged(names, node, format!("there are {count} of them")))?;
        counts[node as usize] = (count > 0).then_some(count);
    }
    Ok(Some(counts))
}

impl<'a> Keypoints<'a> {
    /// Reads how many there are. O(images).
    ///
    /// # Errors
    /// Numbers that are none.
    pub(super) fn new(
        connection: &'a Connection,
        names: &'a [Box<str>],
        nodes: &HashMap<i64, u32>,
        spread: u32,
    ) -> Result<Self, DatabaseError> {
        let mut ids = vec![0; names.len()];
        for (&id, &node) in nodes {
            ids[node as usize] = id;
        }
        Ok(Self {
            connection,
            names,
            counts: counts(connection, names, nodes)?.unwrap_or_else(|| vec![None; names.len()]),
            ids,
            spread,
            missing: 0,
        })
    }

    /// How many features an image has, as far as is known.
    pub(super) fn count(&self, node: u32) -> Option<u32> {
        self.counts[node as usize]
    }

    /// Whether an image has a feature of this number, as far as is known.
    pub(super) fn has(&self, node: u32, feature: u32) -> bool {
        self.count(node).is_none_or(|count| feature < count)
    }

    /// What could not be known, in words.
    pub(super) fn unknown(&self) -> Option<String> {
        let (images, have) = match self.missing {
            0 => return None,
            1 => ("1 image has".to_owned(), "it"),
            count => (format!("{count} images have"), "them"),
        };
        Some(format!(
            "{images} matches and no keypoints in the database: whether two features of one track \
             are one is not known there, and tracks with two in {have} are dropped"
        ))
    }

    fn damaged(&self, node: u32, why: String) -> DatabaseError {
        damaged(self.names, node, why)
    }

    /// The places of some features in a list as the database has it.
    fn of_list(
        &self,
        node: u32,
        [rows, cols]: [i64; 2],
        list: &[u8],
        features: &[u32],
    ) -> Result<Vec<[f32; 2]>, DatabaseError> {
        let size = |count: i64| usize::try_from(count).ok();
        let bytes = size(rows).zip(size(cols)).and_then(|(rows, cols)| {
            let row = cols.checked_mul(COORDINATE)?;
            Some((row, rows.checked_mul(row)?))
        });
        let Some((row, _)) = bytes.filter(|&(_, all)| cols >= 2 && all == list.len()) else {
            let bytes = list.len();
            let why = format!("{rows} features of {cols} numbers are not {bytes} bytes");
            return Err(self.damaged(node, why));
        };
        let at = |feature: u32| {
            let start = feature as usize * row;
            let (numbers, _) = list.get(start..start + 2 * COORDINATE)?.as_chunks();
            let [x, y] = [0, 1].map(|k: usize| f32::from_le_bytes(numbers[k]));
            (x.is_finite() && y.is_finite()).then_some([x, y])
        };
        let places = features.iter().map(|&feature| {
            at(feature).ok_or_else(|| self.damaged(node, format!("feature {feature} has no place")))
        });
        places.collect()
    }
}

impl Places for Keypoints<'_> {
    fn places(&mut self, image: u32, features: &[u32]) -> Result<Option<Vec<[f32; 2]>>, Problem> {
        let sql = |error: rusqlite::Error| Problem::from(DatabaseError::from(error));
        if self.counts[image as usize].is_none() {
            self.missing += 1;
            return Ok(None);
        }
        let query = "select rows, cols, data from keypoints where image_id = ?";
        let mut statement = self.connection.prepare_cached(query).map_err(sql)?;
        let found = statement.query_row([self.ids[image as usize]], |row| {
            let size = [row.get(0)?, row.get(1)?];
            let list = match row.get_ref(2)? {
                ValueRef::Blob(list) => list,
                _ => &[],
            };
            // Emptied, and the numbers are left.
            let known = !list.is_empty();
            Ok(known.then(|| self.of_list(image, size, list, features)))
        });
        let found = found.optional().map_err(sql)?.flatten().transpose()?;
        self.missing += usize::from(found.is_none());
        Ok(found)
    }

    fn spread(&self) -> u32 {
        self.spread
    }
}
