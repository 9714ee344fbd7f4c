//! The rigs and frames of COLMAP's models (version 3.12 and later).
//!
//! A record of rigs: number, number of sensors, the reference sensor, and of each other one whether
//! its pose is known, and the pose: rotation (w, x, y, z) and translation. A record of frames: number,
//! rig, pose (7), and for each datum its sensor and number. A sensor is a type and a number; in
//! text the type is a word.

use std::collections::{BTreeMap, HashMap};

use super::frames::{Frame, Frames, Pose, Rig, read};
use super::model_files::Encoding;
use crate::error::{Fault, Place, Problem};

/// The type of cameras among sensors.
const CAMERA: &str = "CAMERA";

/// What the frames say of the images `names`, whose nodes are known by their numbers. Linear in the
/// bytes, but for sorting.
///
/// # Errors
/// Files that are damaged or contradict each other or the images.
pub(super) fn frames(
    rigs: &[u8],
    frames: &[u8],
    encoding: Encoding,
    names: &[Box<str>],
    nodes: &HashMap<u32, u32>,
) -> Result<Frames, Fault> {
    let corrupt = |why: String| Place::Input.fault(Problem::Corrupt(why));
    let (rigs, frames) = match encoding {
        Encoding::Binary => (
            all(Bytes(rigs), |bytes| rig(bytes))?,
            all(Bytes(frames), |bytes| frame(bytes, nodes))?,
        ),
        Encoding::Text => (
            lines(rigs, |words| rig(words))?,
            lines(frames, |words| frame(words, nodes))?,
        ),
    };
    let count = rigs.len();
    let rigs: BTreeMap<i64, Rig> = rigs.into_iter().collect();
    if rigs.len() < count {
        return Err(corrupt("two rigs have one number".to_owned()));
    }
    read(&rigs, &frames, names).map_err(corrupt)
}

/// The fields of a record, one after another.
trait Fields {
    fn number(&mut self) -> Result<i64, Fault>;
    fn count(&mut self) -> Result<i64, Fault>;
    /// The number of a datum.
    fn long(&mut self) -> Result<i64, Fault>;
    /// Whether a sensor is a camera.
    fn is_camera(&mut self) -> Result<bool, Fault>;
    fn flag(&mut self) -> Result<bool, Fault>;
    fn float(&mut self) -> Result<f64, Fault>;
}

fn pose(fields: &mut impl Fields) -> Result<Pose, Fault> {
    let mut numbers = [0.0; 7];
    for number in &mut numbers {
        *number = fields.float()?;
    }
    let [w, x, y, z, t @ ..] = numbers;
    Ok(Pose {
        rotation: [x, y, z, w],
        translation: t,
    })
}

fn rig(fields: &mut impl Fields) -> Result<(i64, Rig), Fault> {
    let (id, sensors) = (fields.number()?, fields.count()?);
    let mut rig = Rig::default();
    for k in 0..sensors {
        let (is_camera, sensor) = (fields.is_camera()?, fields.number()?);
        let known = if k == 0 {
            Some(Pose {
                rotation: [0.0, 0.0, 0.0, 1.0],
                translation: [0.0; 3],
            })
        } else if fields.flag()? {
            Some(pose(fields)?)
        } else {
            None
        };
        if is_camera && rig.sensors.insert(sensor, known).is_some() {
            let why = format!("rig {id} has sensor {sensor} twice");
            return Err(Place::Input.fault(Problem::Corrupt(why)));
        }
    }
    Ok((id, rig))
}

fn frame(fields: &mut impl Fields, nodes: &HashMap<u32, u32>) -> Result<Frame, Fault> {
    let (id, rig) = (fields.number()?, fields.number()?);
    pose(fields)?;
    let mut images = Vec::new();
    for _ in 0..fields.count()? {
        let (is_camera, sensor, datum) = (fields.is_camera()?, fields.number()?, fields.long()?);
        let node = u32::try_from(datum)
            .ok()
            .and_then(|datum| nodes.get(&datum));
        images.extend(node.filter(|_| is_camera).map(|&node| (node, sensor)));
    }
    Ok(Frame { id, rig, images })
}

/// What is left of a binary file.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let short = || {
            Place::Input.fault(Problem::Truncated(
                "a record of rigs or frames is cut off".to_owned(),
            ))
        };
        let (bytes, rest) = self.0.split_first_chunk().ok_or_else(short)?;
        self.0 = rest;
        Ok(*bytes)
    }
}

impl Fields for Bytes<'_> {
    fn number(&mut self) -> Result<i64, Fault> {
        Ok(u32::from_le_bytes(self.take()?).into())
    }

    fn count(&mut self) -> Result<i64, Fault> {
        self.number()
    }

    fn long(&mut self) -> Result<i64, Fault> {
        Ok(i64::from_le_bytes(self.take()?))
    }

    fn is_camera(&mut self) -> Result<bool, Fault> {
        Ok(self.number()? == 0)
    }

    fn flag(&mut self) -> Result<bool, Fault> {
        Ok(self.take::<1>()? != [0])
    }

    fn float(&mut self) -> Result<f64, Fault> {
        Ok(f64::from_le_bytes(self.take()?))
    }
}

/// All records of a binary file, behind their number.
fn all<T>(
    mut bytes: Bytes,
    mut record: impl FnMut(&mut Bytes) -> Result<T, Fault>,
) -> Result<Vec<T>, Fault> {
    let count = u64::from_le_bytes(bytes.take()?);
    let mut records = Vec::new();
    for _ in 0..count {
        records.push(record(&mut bytes)?);
    }
    if !bytes.0.is_empty() {
        let why = "rigs or frames: bytes follow the last record".to_owned();
        return Err(Place::Input.fault(Problem::Corrupt(why)));
    }
    Ok(records)
}

/// The words of a line of text.
struct Words<'a> {
    words: std::str::SplitAsciiWhitespace<'a>,
    line: u64,
}

impl Words<'_> {
    fn parse<T: std::str::FromStr>(&mut self) -> Result<T, Fault> {
        let word = self.words.next().unwrap_or_default();
        let why = || {
            let why = format!("`{word}` stands where a number of a rig or frame is expected");
            Place::Line(self.line).fault(Problem::Corrupt(why))
        };
        word.parse().map_err(|_| why())
    }
}

impl Fields for Words<'_> {
    fn number(&mut self) -> Result<i64, Fault> {
        Ok(self.parse::<u32>()?.into())
    }

    fn count(&mut self) -> Result<i64, Fault> {
        self.number()
    }

    fn long(&mut self) -> Result<i64, Fault> {
        self.parse()
    }

    fn is_camera(&mut self) -> Result<bool, Fault> {
        Ok(self.parse::<String>()? == CAMERA)
    }

    fn flag(&mut self) -> Result<bool, Fault> {
        Ok(self.number()? != 0)
    }

    fn float(&mut self) -> Result<f64, Fault> {
        self.parse()
    }
}

/// All records of a text file, one a line.
fn lines<T>(
    bytes: &[u8],
    mut record: impl FnMut(&mut Words) -> Result<T, Fault>,
) -> Result<Vec<T>, Fault> {
    let text = std::str::from_utf8(bytes).map_err(|_| {
        Place::Input.fault(Problem::Corrupt("rigs or frames are no text".to_owned()))
    })?;
    let mut records = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let is_record = !text.trim().is_empty() && !text.starts_with('#');
        if is_record {
            let words = text.split_ascii_whitespace();
            records.push(record(&mut Words { words, line })?);
        }
    }
    Ok(records)
}

#[cfg(test)]
mod tests;
