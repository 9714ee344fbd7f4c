//! The text files of a model: a record a line, two lines an image; `#` begins a comment.
//!
//! An image: number, rotation (4), translation (3), camera, name; and on the next line, which may be
//! empty, its features: place (2) and point (-1 for none). A point: number, position (3), colour
//! (3), error, and of each view image and feature. A frame: numbers of frame and rig, rotation and
//! translation (7), number of data, and of each the type of the sensor (`CAMERA`), the number of the
//! sensor and that of the datum.

use std::io::{self, Write};
use std::str::FromStr;

use super::{Datum, Frame, Image, Point};
use crate::error::{Fault, Place, Problem};

/// Fields of an image between its number and its name.
const POSE: usize = 8;
/// Fields of a point between its number and its error.
const POSITION: usize = 6;
/// Fields of a frame before the number of its data.
const FRAME: usize = 9;
/// The type of a sensor that takes images.
const CAMERA: &str = "CAMERA";

const IMAGE_HEAD: &str = "\
# Image list with two lines of data per image:
#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME
#   POINTS2D[] as (X, Y, POINT3D_ID)
";
const POINT_HEAD: &str = "\
# 3D point list with one line of data per point:
#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)
";
const FRAME_HEAD: &str = "\
# Frame list with one line of data per frame:
#   FRAME_ID, RIG_ID, RIG_FROM_WORLD[QW, QX, QY, QZ, TX, TY, TZ], NUM_DATA_IDS, DATA_IDS[] as (SENSOR_TYPE, SENSOR_ID, DATA_ID)
";

/// A line, and its number.
struct Line<'a> {
    text: &'a str,
    number: u64,
}

/// All lines.
fn lines(bytes: &[u8]) -> Result<impl Iterator<Item = Line<'_>>, Fault> {
    let text = std::str::from_utf8(bytes);
    let text = text.map_err(|_| Place::Input.fault(Problem::Corrupt("it is no UTF-8".into())))?;
    Ok((1..).zip(text.lines()).map(|(number, text)| Line {
        text: text.trim(),
        number,
    }))
}

impl<'a> Line<'a> {
    /// Whether there is a record.
    fn is_record(&self) -> bool {
        !self.text.is_empty() && !self.text.starts_with('#')
    }

    fn corrupt(&self, why: impl Into<String>) -> Fault {
        Place::Line(self.number).fault(Problem::Corrupt(why.into()))
    }

    fn fields(&self) -> std::str::SplitAsciiWhitespace<'a> {
        self.text.split_ascii_whitespace()
    }

    fn number<T: FromStr>(&self, field: Option<&str>, what: &str) -> Result<T, Fault> {
        let Some(field) = field else {
            return Err(self.corrupt(format!("{what} is missing")));
        };
        let number = field.parse();
        number.map_err(|_| self.corrupt(format!("`{field}` stands where {what} is expected")))
    }

    /// So many fields, as they are.
    fn some(
        &self,
        fields: &mut impl Iterator<Item = &'a str>,
        count: usize,
    ) -> Result<Box<[u8]>, Fault> {
        let some: Vec<&str> = fields.take(count).collect();
        if some.len() == count {
            Ok(some.join(" ").into_bytes().into())
        } else {
            Err(self.corrupt("the line is too short"))
        }
    }
}

pub(super) fn images(bytes: &[u8]) -> Result<Vec<Image>, Fault> {
    let mut images = Vec::new();
    let mut lines = lines(bytes)?;
    while let Some(line) = lines.next() {
        if !line.is_record() {
            continue;
        }
        let mut words = line.text.splitn(POSE + 2, ' ');
        let id = line.number(words.next(), "the number of an image")?;
        let pose = line.some(&mut words, POSE)?;
        let name = words.next().map(str::trim).filter(|name| !name.is_empty());
        let name = name.ok_or_else(|| line.corrupt("the image has no name"))?;
        let (mut places, mut points) = (Vec::new(), Vec::new());
        if let Some(line) = lines.next() {
            let mut fields = line.fields().peekable();
            while fields.peek().is_some() {
                places.extend_from_slice(&line.some(&mut fields, 2)?);
                places.push(b'\n');
                let point: i64 = line.number(fields.next(), "the point of a feature")?;
                points.push(u64::try_from(point).ok());
            }
        }
        images.push(Image {
            id,
            name: name.into(),
            points,
            pose,
            places: places.into(),
        });
    }
    Ok(images)
}

pub(super) fn points(bytes: &[u8]) -> Result<Vec<Point>, Fault> {
    let lines = lines(bytes)?.filter(Line::is_record);
    let point = |line: Line| {
        let mut fields = line.fields().peekable();
        let id = line.number(fields.next(), "the number of a point")?;
        let place = line.some(&mut fields, POSITION)?;
        let error = line.some(&mut fields, 1)?;
        let mut track = Vec::new();
        while fields.peek().is_some() {
            let image = line.number(fields.next(), "an image of a track")?;
            track.push((image, line.number(fields.next(), "a feature of a track")?));
        }
        Ok(Point {
            id,
            track,
            place,
            error: Some(error),
        })
    };
    lines.map(point).collect()
}

pub(super) fn frames(bytes: &[u8]) -> Result<Vec<Frame>, Fault> {
    let lines = lines(bytes)?.filter(Line::is_record);
    let frame = |line: Line| {
        let mut fields = line.fields();
        let head = line.some(&mut fields, FRAME)?;
        let count: usize = line.number(fields.next(), "the number of a frame's data")?;
        let mut data = Vec::new();
        for _ in 0..count {
            let sensor = line.some(&mut fields, 2)?;
            data.push(Datum {
                is_image: sensor.starts_with(CAMERA.as_bytes()),
                sensor,
                id: line.number(fields.next(), "a datum of a frame")?,
            });
        }
        Ok(Frame { head, data })
    };
    lines.map(frame).collect()
}

pub(super) fn write_images(out: &mut impl Write, images: &[Image]) -> io::Result<()> {
    out.write_all(IMAGE_HEAD.as_bytes())?;
    for image in images {
        write!(out, "{} ", image.id)?;
        out.write_all(&image.pose)?;
        writeln!(out, " {}", image.name)?;
        let places = image.places.split(|&byte| byte == b'\n');
        let features = places.zip(&image.points);
        for (k, (place, point)) in features.enumerate() {
            if k > 0 {
                out.write_all(b" ")?;
            }
            out.write_all(place)?;
            match point {
                Some(point) => write!(out, " {point}")?,
                None => out.write_all(b" -1")?,
            }
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

pub(super) fn write_points(out: &mut impl Write, points: &[Point]) -> io::Result<()> {
    out.write_all(POINT_HEAD.as_bytes())?;
    for point in points {
        write!(out, "{} ", point.id)?;
        out.write_all(&point.place)?;
        out.write_all(b" ")?;
        out.write_all(point.error.as_deref().unwrap_or(b"-1"))?;
        for (image, feature) in &point.track {
            write!(out, " {image} {feature}")?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

pub(super) fn write_frames(out: &mut impl Write, frames: &[Frame]) -> io::Result<()> {
    out.write_all(FRAME_HEAD.as_bytes())?;
    for frame in frames {
        out.write_all(&frame.head)?;
        write!(out, " {}", frame.data.len())?;
        for datum in &frame.data {
            out.write_all(b" ")?;
            out.write_all(&datum.sensor)?;
            write!(out, " {}", datum.id)?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}
