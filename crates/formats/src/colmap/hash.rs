//! The hash of what a certificate of contradictions is held against (docs/contradictions.md, section 5).

use super::DatabaseError;
use super::tables::columns;
use rusqlite::Connection;
use rusqlite::types::ValueRef;
use sha2::{Digest, Sha256};
use viewcert::certificate::hex;

/// The tables, the key that orders each, and its other columns; numbers before blobs.
const TABLES: [(&str, &str, &[&str]); 4] = [
    (
        "cameras",
        "camera_id",
        &["model", "prior_focal_length", "params"],
    ),
    ("images", "image_id", &["camera_id", "name"]),
    ("keypoints", "image_id", &["rows", "cols", "data"]),
    (
        "two_view_geometries",
        "pair_id",
        &["rows", "config", "data", "E", "qvec", "tvec"],
    ),
];

/// The hash of these tables; none, where they hold what no checker reads. Linear in them.
///
/// # Errors
/// Those of SQLite.
pub(super) fn hash(connection: &Connection) -> Result<Option<String>, DatabaseError> {
    let mut hash = Sha256::new();
    hash.update(b"viewcert database 1\n");
    for (table, key, others) in TABLES {
        let present = columns(connection, table)?;
        if present.is_empty() && table == "keypoints" {
            hash.update([0; 8]);
            continue;
        }
        let column = |name: &&str| match present.iter().any(|is| is == name) {
            true => Some((*name).to_owned()),
            false => matches!(*name, "E" | "qvec" | "tvec").then(|| "null".to_owned()),
        };
        let all: Option<Vec<String>> = std::iter::once(&key).chain(others).map(column).collect();
        let Some(all) = all else {
            return Ok(None);
        };
        let count: i64 =
            connection.query_row(&format!("select count(*) from {table}"), [], |row| {
                row.get(0)
            })?;
        hash.update(count.to_le_bytes());
        let query = format!("select {} from {table} order by {key}", all.join(", "));
        let mut statement = connection.prepare(&query)?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            for at in 0..all.len() {
                let is_blob = at > 0
                    && matches!(
                        others[at - 1],
                        "params" | "name" | "data" | "E" | "qvec" | "tvec"
                    );
                match (row.get_ref(at)?, is_blob) {
                    (ValueRef::Integer(number), false) => hash.update(number.to_le_bytes()),
                    (ValueRef::Null, true) => hash.update([0; 8]),
                    (ValueRef::Blob(bytes) | ValueRef::Text(bytes), true) => {
                        hash.update((bytes.len() as u64).to_le_bytes());
                        hash.update(bytes);
                    }
                    _ => return Ok(None),
                }
            }
        }
    }
    Ok(Some(hex(&hash.finalize())))
}
