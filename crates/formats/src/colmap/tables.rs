//! The tables that every reader of a database looks into: which are there, images, and the images of a
//! pair.

use super::error;
use crate::error::Problem;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension};
use std::collections::HashMap;

/// A pair's number is this times the smaller image's number, plus the larger one's.
pub(super) const PAIR_FACTOR: i64 = 2_147_483_647;

/// The tables of verified pairs; the second is that of versions before 2018.
const VERIFIED: [&str; 2] = ["two_view_geometries", "inlier_matches"];

/// The table of verified pairs.
pub(super) fn verified_table(connection: &Connection) -> Result<&'static str, Problem> {
    let needed = |table, needed: &[&str]| -> Result<Option<String>, Problem> {
        let present = columns(connection, table)?;
        if present.is_empty() {
            return Ok(Some(format!("it has no table `{table}`")));
        }
        let missing = needed
            .iter()
            .find(|&&name| !present.iter().any(|is| is == name));
        Ok(missing.map(|name| format!("its table `{table}` has no column `{name}`")))
    };
    if let Some(missing) = needed("images", &["image_id", "name"])? {
        return Err(error::not_colmap(missing));
    }
    let mut first = None;
    for table in VERIFIED {
        match needed(table, &["pair_id", "rows"])? {
            None => return Ok(table),
            Some(missing) => first = first.or(Some(missing)),
        }
    }
    Err(error::not_colmap(first.unwrap_or_default()))
}

/// The names of a table's columns; none if there is no such table.
///
/// # Errors
/// A view or a virtual table: what it computes may never end.
pub(super) fn columns(connection: &Connection, table: &str) -> Result<Vec<String>, Problem> {
    let stored = "select rootpage > 0 from sqlite_schema where name = ? collate nocase and type in ('table', 'view')";
    let is_stored = connection.query_row(stored, [table], |row| row.get(0));
    if is_stored.optional()? == Some(false) {
        let why = format!("its `{table}` is a view, and tables are read here");
        return Err(error::not_colmap(why));
    }
    let mut statement = connection.prepare("select name from pragma_table_info(?)")?;
    let names = statement.query_map([table], |row| row.get(0))?;
    Ok(names.collect::<Result<_, _>>()?)
}

/// Whether a table has these columns.
pub(super) fn has(connection: &Connection, table: &str, wanted: &[&str]) -> Result<bool, Problem> {
    let present = columns(connection, table)?;
    let is_there = |column: &&str| present.iter().any(|name| name == column);
    Ok(wanted.iter().all(is_there))
}

/// The images: names in bytewise order, and the node of every number.
pub(super) type Images = (Vec<Box<str>>, HashMap<i64, u32>);

/// Reads the table of images.
pub(super) fn images(connection: &Connection) -> Result<Images, Problem> {
    let mut statement = connection.prepare("select image_id, name from images")?;
    let mut rows = statement.query([])?;
    let mut images: Vec<(Box<str>, i64)> = Vec::new();
    while let Some(row) = rows.next()? {
        let id = row.get(0)?;
        let name = match row.get_ref(1)? {
            ValueRef::Text(bytes) => std::str::from_utf8(bytes),
            _ => return Err(error::damaged(format!("image {id} has no name"))),
        };
        let rename = |what: String| error::refused(what, "rename the image");
        let name = name.map_err(|_| rename(format!("the name of image {id} is no UTF-8")))?;
        if name.contains(char::is_control) {
            return Err(rename(format!(
                "the name of image {id} has a control character"
            )));
        }
        images.push((name.into(), id));
    }
    if images.is_empty() {
        return Err(error::refused(
            "the database has no images",
            "extract features first: `colmap feature_extractor --database_path FILE --image_path images`",
        ));
    }
    images.sort_unstable();
    if let Some(two) = images.windows(2).find(|two| two[0].0 == two[1].0) {
        let what = format!("two images are called `{}`", two[0].0);
        return Err(error::refused(what, "rename the image"));
    }
    let nodes = (0..).zip(&images).map(|(node, (_, id))| (*id, node));
    let nodes = nodes.collect();
    Ok((images.into_iter().map(|(name, _)| name).collect(), nodes))
}

/// Why a number of a pair gives no edge.
pub(super) enum NoPair {
    Dangling,
    Loop,
}

/// The nodes of the two images of a pair's number.
pub(super) fn ends(pair: i64, nodes: &HashMap<i64, u32>) -> Result<(u32, u32), NoPair> {
    let (first, second) = (pair.div_euclid(PAIR_FACTOR), pair.rem_euclid(PAIR_FACTOR));
    match (nodes.get(&first), nodes.get(&second)) {
        (Some(a), Some(b)) if a == b => Err(NoPair::Loop),
        (Some(&a), Some(&b)) => Ok((a.min(b), a.max(b))),
        _ => Err(NoPair::Dangling),
    }
}
