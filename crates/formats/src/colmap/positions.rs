//! Where images were taken, by the pose priors of a database: to find neighbours, and, where it is
//! asked for, as known positions.

use super::error;
use crate::error::Problem;
use std::collections::HashMap;
use std::path::Path;

use rusqlite::Connection;
use rusqlite::types::ValueRef;

use super::PosePriors;
use super::open::Opened;
use super::tables::{columns, images};

/// COLMAP's number of a system that is not said (`PosePrior::CoordinateSystem::UNDEFINED`).
const UNDEFINED: i64 = -1;

/// COLMAP's number of latitude, longitude and altitude (`PosePrior::CoordinateSystem::WGS84`).
const WGS84: i64 = 0;

/// COLMAP's number of x, y, z (`PosePrior::CoordinateSystem::CARTESIAN`).
const CARTESIAN: i64 = 1;

/// COLMAP's number of cameras among sensors (`SensorType::CAMERA`).
const CAMERA: i64 = 0;

/// Metres of a degree along a meridian.
const DEGREE: f64 = 111_195.0;

/// A pose prior of an image, as it stands in its row.
struct Prior {
    /// The number of the image.
    image: i64,
    /// The bytes of its position, if there are any.
    position: Option<Vec<u8>>,
    system: i64,
    /// The bytes of its covariance, if there are any.
    covariance: Option<Vec<u8>>,
}

/// The pose priors of images; none in a database that has no table for them. O(images).
fn priors(connection: &Connection) -> Result<Vec<Prior>, Problem> {
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
    let covariance = if has("position_covariance") {
        "position_covariance"
    } else {
        "null"
    };
    let query = format!(
        "select {image}, position, coordinate_system, {covariance} from pose_priors {wanted}"
    );
    let mut statement = connection.prepare(&query)?;
    let mut rows = statement.query([])?;
    let bytes = |value: ValueRef| match value {
        ValueRef::Blob(bytes) => Some(bytes.to_vec()),
        _ => None,
    };
    let mut priors = Vec::new();
    while let Some(row) = rows.next()? {
        priors.push(Prior {
            image: row.get(0)?,
            position: bytes(row.get_ref(1)?),
            system: row.get::<_, Option<i64>>(2)?.unwrap_or(UNDEFINED),
            covariance: bytes(row.get_ref(3)?),
        });
    }
    Ok(priors)
}

/// The position of every node, if any is known; else no list. What is no position is left out, as
/// this is for neighbours alone. O(images).
///
/// # Errors
/// Tables that cannot be read.
pub(super) fn read(
    connection: &Connection,
    nodes: &HashMap<i64, u32>,
) -> Result<Vec<Option<[f64; 3]>>, Problem> {
    let mut positions = vec![None; nodes.len()];
    let mut any = false;
    for prior in priors(connection)? {
        let place = prior.position.as_deref().and_then(near);
        let (Some(&node), Some(place)) = (nodes.get(&prior.image), place) else {
            continue;
        };
        positions[node as usize] = Some(match prior.system {
            WGS84 => on_earth(place),
            _ => place,
        });
        any = true;
    }
    Ok(if any { positions } else { Vec::new() })
}

/// The positions in the database `path`. A position counts if its three numbers are finite, as in
/// COLMAP (`PosePrior::HasPosition`). O(n log n) for n images.
///
/// # Errors
/// A database that cannot be read; positions that are none, systems that are mixed or not known, as
/// COLMAP refuses them or cannot read them.
pub(crate) fn pose_priors(path: &Path) -> Result<PosePriors, Problem> {
    let opened = Opened::new(path)?;
    let (names, nodes) = images(&opened.connection)?;
    let mut read = PosePriors::default();
    let mut system: Option<(i64, &str)> = None;
    for prior in priors(&opened.connection)? {
        let Some(&node) = nodes.get(&prior.image) else {
            continue;
        };
        let name = &names[node as usize];
        let wrong = |why: &str| {
            error::refused(
                format!("the position of the image {name} {why}"),
                "write the pose priors again, all in one system of coordinates, or write the cameras whose position is known into a file, `position` before each",
            )
        };
        if !(UNDEFINED..=CARTESIAN).contains(&prior.system) {
            return Err(wrong("has a coordinate system that COLMAP does not have"));
        }
        let place = match prior.position.as_deref().map(numbers) {
            None => [f64::NAN; 3],
            Some(Some(place)) => place,
            Some(None) => return Err(wrong("is not three numbers")),
        };
        if !place.iter().all(|number| number.is_finite()) {
            read.unknown += 1;
            continue;
        }
        let is_on_earth = prior.system == WGS84;
        if is_on_earth && (place[0].abs() > 90.0 || place[1].abs() > 180.0) {
            return Err(wrong("is no latitude and longitude in degrees"));
        }
        let (first, of) = *system.get_or_insert((prior.system, name));
        if (first == WGS84) != is_on_earth {
            return Err(wrong(&format!(
                "is in another system of coordinates than that of {of}"
            )));
        }
        read.on_earth = is_on_earth;
        if read.positions.insert(name.clone(), place).is_some() {
            return Err(wrong("is there twice"));
        }
        let covariance = match prior.covariance.as_deref().map(numbers::<9>) {
            None => continue,
            Some(Some(covariance)) => covariance,
            Some(None) => return Err(wrong("has a covariance that is not nine numbers")),
        };
        let variances = [covariance[0], covariance[4], covariance[8]];
        let largest = variances.into_iter().fold(0.0, f64::max);
        if covariance.iter().all(|number| number.is_finite()) && largest > 0.0 {
            let other = read.deviation.unwrap_or_default();
            read.deviation = Some(largest.sqrt().max(other));
        }
    }
    opened.finish()?;
    Ok(read)
}

/// So many numbers, whatever they are.
fn numbers<const N: usize>(bytes: &[u8]) -> Option<[f64; N]> {
    let (numbers, []) = bytes.as_chunks() else {
        return None;
    };
    let numbers: &[[u8; 8]; N] = numbers.try_into().ok()?;
    Some(numbers.map(f64::from_le_bytes))
}

/// A position for neighbours: an unknown altitude is no reason to know nothing.
fn near(bytes: &[u8]) -> Option<[f64; 3]> {
    let [x, y, z] = numbers(bytes)?;
    let plane = x.is_finite() && y.is_finite();
    plane.then_some([x, y, if z.is_finite() { z } else { 0.0 }])
}

/// Latitude, longitude and altitude in metres, near enough for neighbours: meridians are taken for
/// parallel at each latitude.
fn on_earth([latitude, longitude, altitude]: [f64; 3]) -> [f64; 3] {
    let east = longitude * latitude.to_radians().cos() * DEGREE;
    [east, latitude * DEGREE, altitude]
}
