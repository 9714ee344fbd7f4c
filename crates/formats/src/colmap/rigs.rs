//! The rigs and frames of a database of COLMAP 3.12 and later.

use super::error;
use crate::error::Problem;
use std::collections::{BTreeMap, HashMap};

use rusqlite::Connection;
use rusqlite::types::ValueRef;

use super::tables::columns;
use crate::tracks::{Frame, Frames, Pose, Rig, read_frames};

/// What COLMAP calls a camera among sensors (`SensorType::CAMERA`).
const CAMERA: i64 = 0;

/// The bytes of a pose: four numbers of a rotation, three of a translation.
const POSE: usize = 7 * 8;

/// What the frames say of the images, nothing in a database without rigs. Linear in the tables, but
/// for sorting.
///
/// # Errors
/// Tables that contradict themselves.
pub(super) fn read(
    connection: &Connection,
    names: &[Box<str>],
    nodes: &HashMap<i64, u32>,
) -> Result<Option<Frames>, Problem> {
    for table in ["rigs", "rig_sensors", "frames", "frame_data"] {
        if columns(connection, table)?.is_empty() {
            return Ok(None);
        }
    }
    let (rigs, frames) = (rigs(connection)?, frames(connection, nodes)?);
    let frames = read_frames(&rigs, &frames, names).map_err(error::rigs)?;
    Ok(Some(frames))
}

fn rigs(connection: &Connection) -> Result<BTreeMap<i64, Rig>, Problem> {
    let reference = Pose {
        rotation: [0.0, 0.0, 0.0, 1.0],
        translation: [0.0; 3],
    };
    let mut rigs: BTreeMap<i64, Rig> = BTreeMap::new();
    let mut statement =
        connection.prepare("select rig_id, ref_sensor_id, ref_sensor_type from rigs")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let rig = rigs.entry(row.get(0)?).or_default();
        if row.get::<_, i64>(2)? == CAMERA {
            rig.sensors.insert(row.get(1)?, Some(reference));
        }
    }
    let mut statement = connection
        .prepare("select rig_id, sensor_id, sensor_type, sensor_from_rig from rig_sensors")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let (id, sensor): (i64, i64) = (row.get(0)?, row.get(1)?);
        let Some(rig) = rigs.get_mut(&id) else {
            let why = format!("sensor {sensor} is of rig {id}, which is not there");
            return Err(error::rigs(why));
        };
        if row.get::<_, i64>(2)? != CAMERA {
            continue;
        }
        let pose = match row.get_ref(3)? {
            ValueRef::Null => None,
            ValueRef::Blob(bytes) if bytes.len() == POSE => Some(pose(bytes)),
            _ => {
                let why = format!("the pose of sensor {sensor} in rig {id} is not seven numbers");
                return Err(error::rigs(why));
            }
        };
        if rig.sensors.insert(sensor, pose).is_some() {
            let why = format!("rig {id} has sensor {sensor} twice");
            return Err(error::rigs(why));
        }
    }
    Ok(rigs)
}

/// COLMAP writes the rotation as x, y, z, w, and behind it the translation.
fn pose(bytes: &[u8]) -> Pose {
    let (numbers, _) = bytes.as_chunks();
    let at = |k: usize| f64::from_le_bytes(numbers[k]);
    Pose {
        rotation: std::array::from_fn(at),
        translation: std::array::from_fn(|k| at(4 + k)),
    }
}

/// The frames, of which what is no image of the table of images is left out.
fn frames(connection: &Connection, nodes: &HashMap<i64, u32>) -> Result<Vec<Frame>, Problem> {
    let mut frames: BTreeMap<i64, Frame> = BTreeMap::new();
    let mut statement = connection.prepare("select frame_id, rig_id from frames")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let (id, rig) = (row.get(0)?, row.get(1)?);
        let images = Vec::new();
        frames.insert(id, Frame { id, rig, images });
    }
    let mut statement =
        connection.prepare("select frame_id, data_id, sensor_id, sensor_type from frame_data")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let (id, image): (i64, i64) = (row.get(0)?, row.get(1)?);
        let Some(frame) = frames.get_mut(&id) else {
            let why = format!("image {image} is of frame {id}, which is not there");
            return Err(error::rigs(why));
        };
        if let Some(&node) = nodes.get(&image)
            && row.get::<_, i64>(3)? == CAMERA
        {
            frame.images.push((node, row.get(2)?));
        }
    }
    Ok(frames.into_values().collect())
}
