//! The binary files of a model: little endian, numbers of records first.
//!
//! An image: number (32 bits), rotation (4 doubles), translation (3), camera (32), name with a zero
//! byte at the end, number of features (64), of each position (2 doubles) and point (64, all ones
//! for none). A point: number (64), position (3 doubles), colour (3 bytes), error (double), length
//! of the track (64), of each view image and feature (32 each). A frame: numbers of frame and rig
//! (32 each), rotation and translation (7 doubles), number of data (32), of each type of the sensor
//! (32, 0 is a camera), number of the sensor (32) and number of the datum (64).

use std::io::{self, Write};

use super::{Datum, Frame, Image, Point};
use crate::error::{Fault, Place, Problem};

/// Bytes of a pose and a camera.
const POSE: usize = 60;
/// Bytes of a feature's place.
const PLACE: usize = 16;
/// Bytes of a position and a colour.
const POSITION: usize = 27;
/// Bytes of a frame before its data.
const FRAME: usize = 64;
/// What stands for no point.
const NO_POINT: u64 = u64::MAX;
/// The type of a sensor that takes images.
const CAMERA: u32 = 0;
/// The error of a point that is not known.
const NO_ERROR: f64 = -1.0;

/// The bytes that are still to be read.
struct Bytes<'a>(&'a [u8]);

fn truncated(what: &str) -> Fault {
    Place::Input.fault(Problem::Truncated(format!("{what} is missing")))
}

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], Fault> {
        let split = self.0.split_at_checked(count);
        let (bytes, rest) = split.ok_or_else(|| truncated(what))?;
        self.0 = rest;
        Ok(bytes)
    }

    fn array<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Fault> {
        let (bytes, rest) = self
            .0
            .split_first_chunk::<N>()
            .ok_or_else(|| truncated(what))?;
        self.0 = rest;
        Ok(*bytes)
    }

    fn short(&mut self, what: &str) -> Result<u32, Fault> {
        self.array(what).map(u32::from_le_bytes)
    }

    fn long(&mut self, what: &str) -> Result<u64, Fault> {
        self.array(what).map(u64::from_le_bytes)
    }

    /// So many records, and nothing behind them.
    fn records<T>(
        mut self,
        what: &str,
        mut record: impl FnMut(&mut Self) -> Result<T, Fault>,
    ) -> Result<Vec<T>, Fault> {
        let count = self.long(&format!("the number of {what}"))?;
        let mut records = Vec::new();
        for _ in 0..count {
            records.push(record(&mut self)?);
        }
        if self.0.is_empty() {
            return Ok(records);
        }
        let why = "bytes follow the last record".to_owned();
        Err(Place::Input.fault(Problem::Corrupt(why)))
    }
}

pub(super) fn images(bytes: &[u8]) -> Result<Vec<Image>, Fault> {
    Bytes(bytes).records("images", |bytes| {
        let id = bytes.short("an image")?;
        let pose = bytes.take(POSE, "the pose of an image")?;
        let end = bytes.0.iter().position(|&byte| byte == 0);
        let end = end.ok_or_else(|| truncated("the end of an image's name"))?;
        let name = bytes.take(end, "a name")?;
        bytes.take(1, "the end of a name")?;
        let name = std::str::from_utf8(name).map_err(|_| {
            let why = format!("the name of image {id} is no UTF-8");
            Place::Input.fault(Problem::Corrupt(why))
        })?;
        let (mut places, mut points) = (Vec::new(), Vec::new());
        for _ in 0..bytes.long("the number of an image's features")? {
            places.extend_from_slice(bytes.take(PLACE, "a feature")?);
            let point = bytes.long("the point of a feature")?;
            points.push((point != NO_POINT).then_some(point));
        }
        Ok(Image {
            id,
            name: name.into(),
            points,
            pose: pose.into(),
            places: places.into(),
        })
    })
}

pub(super) fn points(bytes: &[u8]) -> Result<Vec<Point>, Fault> {
    Bytes(bytes).records("points", |bytes| {
        let id = bytes.long("a point")?;
        let place = bytes.take(POSITION, "the position of a point")?;
        let error = bytes.take(8, "the error of a point")?;
        let mut track = Vec::new();
        for _ in 0..bytes.long("the length of a track")? {
            let what = "a view of a point";
            track.push((bytes.short(what)?, bytes.short(what)?));
        }
        Ok(Point {
            id,
            track,
            place: place.into(),
            error: Some(error.into()),
        })
    })
}

pub(super) fn frames(bytes: &[u8]) -> Result<Vec<Frame>, Fault> {
    Bytes(bytes).records("frames", |bytes| {
        let head = bytes.take(FRAME, "a frame")?;
        let mut data = Vec::new();
        for _ in 0..bytes.short("the number of a frame's data")? {
            let sensor: [u8; 8] = bytes.array("a sensor of a frame")?;
            let [a, b, c, d, ..] = sensor;
            data.push(Datum {
                sensor: sensor.into(),
                id: bytes.long("a datum of a frame")?,
                is_image: u32::from_le_bytes([a, b, c, d]) == CAMERA,
            });
        }
        Ok(Frame {
            head: head.into(),
            data,
        })
    })
}

fn count(out: &mut impl Write, records: usize) -> io::Result<()> {
    out.write_all(&(records as u64).to_le_bytes())
}

pub(super) fn write_images(out: &mut impl Write, images: &[Image]) -> io::Result<()> {
    count(out, images.len())?;
    for image in images {
        out.write_all(&image.id.to_le_bytes())?;
        out.write_all(&image.pose)?;
        out.write_all(image.name.as_bytes())?;
        out.write_all(&[0])?;
        count(out, image.points.len())?;
        for (place, point) in image.places.chunks_exact(PLACE).zip(&image.points) {
            out.write_all(place)?;
            out.write_all(&point.unwrap_or(NO_POINT).to_le_bytes())?;
        }
    }
    Ok(())
}

pub(super) fn write_points(out: &mut impl Write, points: &[Point]) -> io::Result<()> {
    count(out, points.len())?;
    for point in points {
        out.write_all(&point.id.to_le_bytes())?;
        out.write_all(&point.place)?;
        match &point.error {
            Some(error) => out.write_all(error)?,
            None => out.write_all(&NO_ERROR.to_le_bytes())?,
        }
        count(out, point.track.len())?;
        for (image, feature) in &point.track {
            out.write_all(&image.to_le_bytes())?;
            out.write_all(&feature.to_le_bytes())?;
        }
    }
    Ok(())
}

pub(super) fn write_frames(out: &mut impl Write, frames: &[Frame]) -> io::Result<()> {
    count(out, frames.len())?;
    for frame in frames {
        out.write_all(&frame.head)?;
        out.write_all(&(frame.data.len() as u32).to_le_bytes())?;
        for datum in &frame.data {
            out.write_all(&datum.sensor)?;
            out.write_all(&datum.id.to_le_bytes())?;
        }
    }
    Ok(())
}
