//! Which camera took each image of a database, and what it knows of the focal length of each camera.

use super::error;
use crate::error::Problem;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use rusqlite::Connection;

use super::open::Opened;
use super::tables::{has, images};
use super::{Focal, FocalLengths};

/// The number of COLMAP's model of a whole sphere (`EQUIRECTANGULAR`), whose parameters are the width and
/// height of the image.
pub(super) const SPHERICAL: i64 = 17;

/// What is known of the focal length of each camera, by its number; nothing, if the database does not say.
/// O(cameras).
///
/// # Errors
/// Those of SQLite.
pub(super) fn of_cameras(connection: &Connection) -> Result<Option<HashMap<i64, Focal>>, Problem> {
    if !has(connection, "cameras", &["camera_id", "prior_focal_length"])? {
        return Ok(None);
    }
    let model = if has(connection, "cameras", &["model"])? {
        "model"
    } else {
        "0"
    };
    let query = format!("select camera_id, {model}, prior_focal_length from cameras");
    let mut statement = connection.prepare(&query)?;
    let known = statement.query_map([], |row| {
        let (model, prior): (i64, i64) = (row.get(1)?, row.get(2)?);
        let focal = match (model, prior) {
            (SPHERICAL, _) => Focal::Spherical,
            (_, 0) => Focal::Guess,
            _ => Focal::Prior,
        };
        Ok((row.get(0)?, focal))
    })?;
    Ok(Some(known.collect::<Result<_, _>>()?))
}

/// The number of the camera of each image, by its node; nothing, if the database does not say. O(images).
///
/// # Errors
/// Those of SQLite.
pub(super) fn of_images(
    connection: &Connection,
    nodes: &HashMap<i64, u32>,
) -> Result<Option<HashMap<u32, i64>>, Problem> {
    if !has(connection, "images", &["camera_id"])? {
        return Ok(None);
    }
    let mut statement = connection.prepare("select image_id, camera_id from images")?;
    let rows = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?;
    let mut cameras = HashMap::new();
    for row in rows {
        let (image, camera): (i64, i64) = row?;
        let node = nodes.get(&image).ok_or(error::changed())?;
        cameras.insert(*node, camera);
    }
    Ok(Some(cameras))
}

/// Reads the camera of each image, and what is known of the focal length of each. O(n log n) for n images.
///
/// # Errors
/// A database that cannot be read, or without cameras; an image whose camera is not there.
pub(crate) fn focal_lengths(path: &Path) -> Result<FocalLengths, Problem> {
    let opened = Opened::new(path)?;
    let connection = &opened.connection;
    let missing =
        |table, column| error::not_colmap(format!("its table `{table}` has no column `{column}`"));
    let known = of_cameras(connection)?;
    let known = known.ok_or_else(|| missing("cameras", "prior_focal_length"))?;
    let (names, nodes) = images(connection)?;
    let of_nodes = of_images(connection, &nodes)?;
    let of_nodes = of_nodes.ok_or_else(|| missing("images", "camera_id"))?;
    let mut cameras = BTreeMap::new();
    for (node, camera) in of_nodes {
        let name = &names[node as usize];
        if !known.contains_key(&camera) {
            let what = format!("the image {name} is taken by camera {camera}, which is not there");
            let remedy = "write the classes of cameras into a file, and give it to --intrinsics";
            return Err(error::refused(what, remedy));
        }
        cameras.insert(name.clone(), camera);
    }
    opened.finish()?;
    Ok(FocalLengths { cameras, known })
}
