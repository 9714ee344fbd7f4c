//! What a database holds of cameras, images, keypoints and verified pairs, as it is stored: for whoever
//! checks numbers himself (docs/contradictions.md, section 5).

use super::error;
use std::fs::File;
use std::path::Path;

use rusqlite::Connection;
use rusqlite::types::ValueRef;
use sha2::{Digest, Sha256};
use viewcert::certificate::hex;

use super::open::Opened;
use super::tables::columns;
use crate::ReadError;
use crate::error::{Fault, Problem};

/// A row: its numbers, and its texts and blobs, each in the order of the columns; NULL is an empty blob.
pub type RawRow = (Vec<i64>, Vec<Vec<u8>>);

/// The tables and their columns, by the first of which rows are ordered.
const TABLES: [(&str, &[&str]); 4] = [
    (
        "cameras",
        &["camera_id", "model", "prior_focal_length", "params"],
    ),
    ("images", &["image_id", "camera_id", "name"]),
    ("keypoints", &["image_id", "rows", "cols", "data"]),
    (
        "two_view_geometries",
        &["pair_id", "rows", "config", "data", "E", "qvec", "tvec"],
    ),
];

/// All rows of `cameras`, `images`, `keypoints` and `two_view_geometries`, by their first column. O(size).
///
/// # Errors
/// What is no database of COLMAP, or cannot be read.
pub fn raw_tables(path: &Path) -> Result<[Vec<RawRow>; 4], ReadError> {
    let read = || {
        // SQLite's own words about a file that is not there say less.
        File::open(path).map_err(|error| error::other(error.to_string()))?;
        let opened = Opened::new(path)?;
        let tables = read_tables(&opened.connection)?;
        opened.finish()?;
        Ok(tables)
    };
    read().map_err(|error: Problem| {
        let name = path.display().to_string();
        Fault::from(error).in_file(&name)
    })
}

fn read_tables(connection: &Connection) -> Result<[Vec<RawRow>; 4], Problem> {
    let mut tables = [const { Vec::new() }; 4];
    for (rows, table) in tables.iter_mut().zip(TABLES) {
        *rows = read_table(connection, table)?;
    }
    Ok(tables)
}

/// The hash of these tables, as a certificate of contradictions has it.
///
/// # Errors
/// As of [`raw_tables`].
pub(super) fn hash(connection: &Connection) -> Result<String, Problem> {
    let mut hash = Sha256::new();
    hash.update(b"viewcert database 1\n");
    for rows in read_tables(connection)? {
        hash.update((rows.len() as u64).to_le_bytes());
        for (numbers, blobs) in rows {
            numbers
                .iter()
                .for_each(|number| hash.update(number.to_le_bytes()));
            for blob in blobs {
                hash.update((blob.len() as u64).to_le_bytes());
                hash.update(blob);
            }
        }
    }
    Ok(hex(&hash.finalize()))
}

fn read_table(
    connection: &Connection,
    (table, names): (&str, &[&str]),
) -> Result<Vec<RawRow>, Problem> {
    let present = columns(connection, table)?;
    if present.is_empty() && table == "keypoints" {
        return Ok(Vec::new());
    }
    let mut chosen = Vec::new();
    for &name in names {
        match present.iter().any(|is| is.eq_ignore_ascii_case(name)) {
            true => chosen.push(name),
            // Versions before 3.6 have none of these.
            false if matches!(name, "E" | "qvec" | "tvec") => chosen.push("null"),
            false => {
                let missing = format!("its table `{table}` has no column `{name}`");
                return Err(error::not_colmap(missing));
            }
        }
    }
    let query = format!(
        "select {} from {table} order by {}",
        chosen.join(", "),
        names[0]
    );
    let mut statement = connection.prepare(&query)?;
    let mut rows = statement.query([])?;
    let mut found = Vec::new();
    while let Some(row) = rows.next()? {
        let (mut numbers, mut blobs) = (Vec::new(), Vec::new());
        for (k, &name) in names.iter().enumerate() {
            let is_blob = matches!(name, "params" | "data" | "E" | "qvec" | "tvec");
            match row.get_ref(k)? {
                ValueRef::Integer(number) if !is_blob && name != "name" => numbers.push(number),
                ValueRef::Text(text) if name == "name" => blobs.push(text.to_vec()),
                ValueRef::Blob(blob) if is_blob => blobs.push(blob.to_vec()),
                ValueRef::Null if is_blob => blobs.push(Vec::new()),
                _ => {
                    let wrong = format!("`{name}` of `{table}` is of another type");
                    return Err(error::damaged(wrong));
                }
            }
        }
        found.push((numbers, blobs));
    }
    Ok(found)
}
