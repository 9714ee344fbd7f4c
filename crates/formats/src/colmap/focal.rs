//! Which camera took each image of a database, and which cameras have a prior focal length.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use rusqlite::Connection;

use super::open::Opened;
use super::tables::{columns, images};
use super::{DatabaseError, FocalLengths};

/// Reads the camera of each image, and `prior_focal_length` of each camera. O(n log n) for n images.
///
/// # Errors
/// A database that cannot be read, or without cameras; an image whose camera is not there.
pub(crate) fn focal_lengths(path: &Path) -> Result<FocalLengths, DatabaseError> {
    let opened = Opened::new(path)?;
    let connection = &opened.connection;
    for (table, needed) in [("cameras", "prior_focal_length"), ("images", "camera_id")] {
        if !columns(connection, table)?
            .iter()
            .any(|name| name == needed)
        {
            return Err(DatabaseError::NotColmap(format!(
                "its table `{table}` has no column `{needed}`"
            )));
        }
    }
    let lengths = read(connection)?;
    opened.finish()?;
    Ok(lengths)
}

fn read(connection: &Connection) -> Result<FocalLengths, DatabaseError> {
    let (names, nodes) = images(connection)?;
    let mut statement = connection.prepare("select camera_id, prior_focal_length from cameras")?;
    let known = statement.query_map([], |row| Ok((row.get(0)?, row.get::<_, i64>(1)? != 0)))?;
    let known: HashMap<i64, bool> = known.collect::<Result<_, _>>()?;
    let mut statement = connection.prepare("select image_id, camera_id from images")?;
    let of_images = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?;
    let of_images: Vec<(i64, i64)> = of_images.collect::<Result<_, _>>()?;
    let mut cameras = BTreeMap::new();
    for (image, camera) in of_images {
        let name = nodes.get(&image).map(|&node| &names[node as usize]);
        let name = name.ok_or(DatabaseError::Changed)?;
        if !known.contains_key(&camera) {
            return Err(DatabaseError::NoCamera {
                image: name.to_string(),
                camera,
            });
        }
        cameras.insert(name.clone(), camera);
    }
    Ok(FocalLengths { cameras, known })
}
