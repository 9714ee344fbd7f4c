//! The features of a database: how many every image has, and where those lie that are asked for.
//!
//! Numbers of features are in columns of their own and are read for all images. Places are read of
//! single images, and only when tracks have two features there.

use std::collections::HashMap;

use rusqlite::{Connection, OptionalExtension};

use super::error;
use super::tables::has;
use crate::error::{Kind, Problem};
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

fn damaged(names: &[Box<str>], node: u32, why: String) -> Problem {
    let what = format!(
        "the keypoints of the image {} are damaged: {why}",
        names[node as usize]
    );
    Problem::of(Kind::Keypoints, what, error::AGAIN)
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
) -> Result<Option<Vec<Option<u32>>>, Problem> {
    let mut counts = vec![None; names.len()];
    if !has(connection, "keypoints", &COLUMNS)? {
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
    ) -> Result<Self, Problem> {
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
}

/// The columns of the table of keypoints.
pub(super) const COLUMNS: [&str; 4] = ["image_id", "rows", "cols", "data"];

/// The places of all features of an image, by its number in the database: the first two of so many columns each;
/// nothing if the database has none.
///
/// # Errors
/// Those of SQLite; why the list is damaged.
#[expect(clippy::type_complexity, reason = "two kinds of errors")]
pub(super) fn places(
    connection: &Connection,
    id: i64,
) -> Result<Result<Option<Vec<[f32; 2]>>, String>, Problem> {
    let query = "select rows, cols, data from keypoints where image_id = ?";
    let mut statement = connection.prepare_cached(query)?;
    let found = statement.query_row([id], |row| {
        let (rows, columns): (Option<i64>, Option<i64>) = (row.get(0)?, row.get(1)?);
        let (rows, columns) = (rows.unwrap_or(0), columns.unwrap_or(0));
        // Emptied, and the numbers are left.
        let list = row.get_ref(2)?.as_blob().unwrap_or(&[]);
        if list.is_empty() {
            return Ok(Ok(None));
        }
        let width = usize::try_from(columns).ok().filter(|&columns| columns > 1);
        let size = width.and_then(|width| width.checked_mul(usize::try_from(rows).ok()?));
        if size.and_then(|size| size.checked_mul(COORDINATE)) != Some(list.len()) {
            let bytes = list.len();
            return Ok(Err(format!(
                "{rows} features of {columns} numbers are not {bytes} bytes"
            )));
        }
        let number = |bytes: &[u8]| f32::from_le_bytes(bytes.try_into().expect("four bytes"));
        let places = list.chunks_exact(COORDINATE * width.unwrap_or(1));
        Ok(Ok(Some(
            places
                .map(|row| [number(&row[..4]), number(&row[4..8])])
                .collect(),
        )))
    });
    Ok(found.optional()?.unwrap_or(Ok(None)))
}

impl Places for Keypoints<'_> {
    fn places(&mut self, image: u32, features: &[u32]) -> Result<Option<Vec<[f32; 2]>>, Problem> {
        if self.counts[image as usize].is_none() {
            self.missing += 1;
            return Ok(None);
        }
        let damaged = |why| damaged(self.names, image, why);
        let found = places(self.connection, self.ids[image as usize])?.map_err(damaged)?;
        self.missing += usize::from(found.is_none());
        let place = |feature: &u32| {
            let place = found.as_ref()?.get(*feature as usize).copied();
            place.filter(|place| place.iter().all(|x| x.is_finite()))
        };
        let known = |feature| {
            place(feature).ok_or_else(|| damaged(format!("feature {feature} has no place")))
        };
        match found {
            None => Ok(None),
            Some(_) => features
                .iter()
                .map(known)
                .collect::<Result<_, _>>()
                .map(Some),
        }
    }

    fn spread(&self) -> u32 {
        self.spread
    }
}
