//! Where images were taken, by the pose priors of a database: to find neighbours, and for nothing
//! that is decided.

use std::collections::HashMap;

use rusqlite::Connection;
use rusqlite::types::ValueRef;

use super::DatabaseError;
use super::tables::columns;

/// COLMAP's number of latitude, longitude and altitude (`PosePrior::CoordinateSystem::WGS84`).
const WGS84: i64 = 0;

/// COLMAP's number of cameras among sensors (`SensorType::CAMERA`).
const CAMERA: i64 = 0;

/// Metres of a degree along a meridian.
const DEGREE: f64 = 111_195.0;

/// The position of every node, if any is known; else no list. O(images).
///
/// # Errors
/// Tables that cannot be read.
pub(super) fn read(
    connection: &Connection,
    nodes: &HashMap<i64, u32>,
) -> Result<Vec<Option<[f64; 3]>>, DatabaseError> {
    let present = columns(connection, "pose_priors")?;
    let has = |column: &str| present.iter().any(|name| name == column);
    if !has("position") || !has("coordinate_system") {
        return Ok(Vec::new());
    }
    // COLMAP 4 has priors of any sensor, older versions of images.
    let (image, wanted) = match has("corr_data_id") && has("corr_sensor_type") {
        true => ("corr_data_id", format!("where corr_sensor_type = {CAMERA}")),
        false if has("image_id") => ("image_id", String::new()),
        false => return Ok(Vec::new()),
    };
    let query = format!("select {image}, position, coordinate_system from pose_priors {wanted}");
    let mut statement = connection.prepare(&query)?;
    let mut rows = statement.query([])?;
    let mut positions = vec![None; nodes.len()];
    let mut any = false;
    while let Some(row) = rows.next()? {
        let id: i64 = row.get(0)?;
        let ValueRef::Blob(bytes) = row.get_ref(1)? else {
            continue;
        };
        let system: Option<i64> = row.get(2)?;
        let (Some(&node), Some(place)) = (nodes.get(&id), place(bytes)) else {
            continue;
        };
        positions[node as usize] = Some(match system {
            Some(WGS84) => on_earth(place),
            _ => place,
        });
        any = true;
    }
    Ok(if any { positions } else { Vec::new() })
}

/// Three finite numbers; COLMAP writes NaN where nothing is known.
fn place(bytes: &[u8]) -> Option<[f64; 3]> {
    let (numbers, []) = bytes.as_chunks() else {
        return None;
    };
    let &[x, y, z] = numbers else { return None };
    let place = [x, y, z].map(f64::from_le_bytes);
    let plane = place[..2].iter().all(|number| number.is_finite());
    // An unknown altitude is no reason to know nothing.
    let [x, y, z] = place;
    plane.then_some([x, y, if z.is_finite() { z } else { 0.0 }])
}

/// Latitude, longitude and altitude in metres, near enough for neighbours: meridians are taken for
/// parallel at each latitude.
fn on_earth([latitude, longitude, altitude]: [f64; 3]) -> [f64; 3] {
    let east = longitude * latitude.to_radians().cos() * DEGREE;
    [east, latitude * DEGREE, altitude]
}
