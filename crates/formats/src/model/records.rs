//! The records of a model's files; COLMAP's documentation, "Output Format".
//!
//! An image: number, pose (a quaternion, the real part first, and a translation), camera, name; and its
//! features, in text on a line of their own: place (2) and point (-1 for none). A point: number, position
//! (3), colour (3), error, and of each view image and feature. A rig: number, number of sensors, the
//! reference sensor, and of each other one whether its pose is known, and the pose. A frame: number, rig,
//! pose, number of data, and of each its sensor and number. A sensor is a type and a number. A camera:
//! number, model, width, height, parameters.

use std::collections::{BTreeMap, HashMap};
use std::io::{self, Write};

use super::fields::{Encoding, Fields, Out};
use super::{Datum, Frame, Image, Point, numbers};
use crate::error::{Fault, Problem};
use crate::tracks::{self, Frames, Pose, Rig};

/// Bytes and fields.
const POSE: (usize, usize) = (56, 7);
const POSE_AND_CAMERA: (usize, usize) = (60, 8);
pub(super) const PLACE: (usize, usize) = (16, 2);
const POSITION: (usize, usize) = (27, 6);
const ERROR: (usize, usize) = (8, 1);
const KIND: (usize, usize) = (4, 1);
/// The error of a point that is not known.
const NO_ERROR: f64 = -1.0;

/// Models of cameras by the names that text has, in the order of their numbers in COLMAP 4.2.
const MODELS: &str = "SIMPLE_PINHOLE PINHOLE SIMPLE_RADIAL RADIAL OPENCV OPENCV_FISHEYE FULL_OPENCV FOV \
                      SIMPLE_RADIAL_FISHEYE RADIAL_FISHEYE THIN_PRISM_FISHEYE RAD_TAN_THIN_PRISM_FISHEYE SIMPLE_DIVISION \
                      DIVISION SIMPLE_FISHEYE FISHEYE EUCM EQUIRECTANGULAR";
/// How many parameters they have.
const PARAMETERS: [usize; 18] = [3, 4, 4, 5, 8, 8, 12, 5, 4, 5, 12, 16, 4, 5, 3, 4, 6, 2];

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

/// The images, with their features if they are asked for. O(bytes).
pub(crate) fn images(fields: &mut dyn Fields, with_features: bool) -> Result<Vec<Image>, Fault> {
    let mut images = Vec::new();
    while fields.record()? {
        let id = fields.short("the number of an image")?;
        let mut pose = Vec::new();
        fields.raw(POSE_AND_CAMERA, "the pose or camera of an image", &mut pose)?;
        let name = fields.name()?;
        let (mut points, mut places) = (Vec::new(), Vec::new());
        if with_features {
            fields.features()?;
            for _ in 0..fields.length("the number of an image's features")? {
                if fields.is_end() {
                    break;
                }
                fields.raw(PLACE, "the place of a feature", &mut places)?;
                if fields.encoding() == Encoding::Text {
                    places.push(b'\n');
                }
                let point = fields.long("the point of a feature")?;
                points.push(u64::try_from(point).ok());
            }
        } else {
            fields.skip_features()?;
        }
        images.push(Image {
            id,
            name,
            points,
            pose,
            places,
        });
    }
    Ok(images)
}

/// Calls `each` with every point. O(bytes).
pub(crate) fn each_point(
    fields: &mut dyn Fields,
    mut each: impl FnMut(&Point),
) -> Result<(), Fault> {
    let mut point = Point::default();
    while fields.record()? {
        let error = point.error.get_or_insert_default();
        error.clear();
        point.place.clear();
        point.track.clear();
        point.id = fields.long("the number of a point")? as u64;
        fields.raw(
            POSITION,
            "the position or colour of a point",
            &mut point.place,
        )?;
        fields.raw(ERROR, "the error of a point", error)?;
        for _ in 0..fields.length("the length of a track")? {
            if fields.is_end() {
                break;
            }
            let image = fields.short("an image of a track")?;
            point
                .track
                .push((image, fields.short("a feature of a track")?));
        }
        each(&point);
    }
    Ok(())
}

fn sensor(fields: &mut dyn Fields) -> Result<(Vec<u8>, u32), Fault> {
    let mut kind = Vec::new();
    fields.raw(KIND, "the type of a sensor", &mut kind)?;
    Ok((kind, fields.short("the number of a sensor")?))
}

/// Whether a type of sensors is that of cameras, in text or in bytes.
pub(super) fn is_camera(kind: &[u8]) -> bool {
    kind == b"CAMERA" || kind == [0; 4]
}

/// A camera.
pub(super) struct Camera {
    /// The number of its model.
    pub(super) model: usize,
    pub(super) width: u64,
    pub(super) parameters: Vec<f64>,
}

/// The cameras, by their numbers. O(bytes).
pub(super) fn cameras(fields: &mut dyn Fields) -> Result<BTreeMap<u32, Camera>, Fault> {
    let mut cameras = BTreeMap::new();
    while fields.record()? {
        let id = fields.short("the number of a camera")?;
        let model = match fields.encoding() {
            Encoding::Binary => Some(fields.short("the model of a camera")? as usize),
            Encoding::Text => {
                let mut name = Vec::new();
                fields.raw((0, 1), "the model of a camera", &mut name)?;
                MODELS.split(' ').position(|model| model.as_bytes() == name)
            }
        };
        let width = fields.long("the width of a camera")? as u64;
        fields.long("the height of a camera")?;
        let known = model.and_then(|model| Some((model, *PARAMETERS.get(model)?)));
        let unknown = || fields.corrupt(format!("camera {id} has a model that is not known"));
        let (model, count) = known.ok_or_else(unknown)?;
        let parameters = (0..count).map(|_| fields.float("a parameter of a camera"));
        let parameters = parameters.collect::<Result<_, _>>()?;
        let camera = Camera {
            model,
            width,
            parameters,
        };
        cameras.insert(id, camera);
    }
    Ok(cameras)
}

/// The number of the camera of an image.
pub(super) fn camera_of(encoding: Encoding, image: &Image) -> Option<u32> {
    match encoding {
        Encoding::Binary => Some(u32::from_le_bytes(*image.pose.last_chunk()?)),
        Encoding::Text => std::str::from_utf8(&image.pose)
            .ok()?
            .rsplit(' ')
            .next()?
            .parse()
            .ok(),
    }
}

/// The rigs. O(bytes log bytes).
pub(crate) fn rigs(fields: &mut dyn Fields) -> Result<BTreeMap<i64, Rig>, Fault> {
    let mut rigs = BTreeMap::new();
    while fields.record()? {
        let id = fields.short("the number of a rig")?;
        let mut rig = Rig::default();
        for k in 0..fields.short("the number of a rig's sensors")? {
            let (kind, sensor) = sensor(fields)?;
            let known = if k == 0 {
                Some([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
            } else if fields.flag("whether the pose of a sensor is known")? {
                let mut pose = [0.0; 7];
                for number in &mut pose {
                    *number = fields.float("a number of a sensor's pose")?;
                }
                Some(pose)
            } else {
                None
            };
            let known = known.map(|[w, x, y, z, t @ ..]| Pose {
                rotation: [x, y, z, w],
                translation: t,
            });
            if is_camera(&kind) && rig.sensors.insert(sensor.into(), known).is_some() {
                return Err(fields.corrupt(format!("rig {id} has sensor {sensor} twice")));
            }
        }
        if rigs.insert(id.into(), rig).is_some() {
            return Err(fields.corrupt(format!("two rigs have the number {id}")));
        }
    }
    Ok(rigs)
}

/// The frames. O(bytes).
pub(crate) fn frames(fields: &mut dyn Fields) -> Result<Vec<Frame>, Fault> {
    let mut frames = Vec::new();
    while fields.record()? {
        let id = fields.short("the number of a frame")?;
        let rig = fields.short("the rig of a frame")?;
        let mut pose = Vec::new();
        fields.raw(POSE, "the pose of a frame", &mut pose)?;
        if numbers::<7>(fields.encoding(), &pose).is_none() {
            return Err(fields.corrupt(format!("the pose of frame {id} is not in finite numbers")));
        }
        let mut data = Vec::new();
        for _ in 0..fields.short("the number of a frame's data")? {
            let (kind, sensor) = sensor(fields)?;
            let id = fields.long("the number of a datum")?;
            data.push(Datum { kind, sensor, id });
        }
        frames.push(Frame {
            id,
            rig,
            pose,
            data,
        });
    }
    Ok(frames)
}

/// What rigs and frames say of the images `names`, whose nodes are known by their numbers.
///
/// # Errors
/// Rigs and frames that contradict each other or the images.
pub(crate) fn known(
    rigs: &BTreeMap<i64, Rig>,
    frames: &[Frame],
    names: &[Box<str>],
    nodes: &HashMap<u32, u32>,
) -> Result<Frames, Fault> {
    let frame = |frame: &Frame| {
        let data = frame.data.iter().filter_map(|datum| {
            let node = *nodes.get(&datum.image()?)?;
            Some((node, datum.sensor.into()))
        });
        tracks::Frame {
            id: frame.id.into(),
            rig: frame.rig.into(),
            images: data.collect(),
        }
    };
    let frames: Vec<_> = frames.iter().map(frame).collect();
    tracks::read_frames(rigs, &frames, names).map_err(|why| Problem::corrupt(why).into())
}

pub(super) fn write_images(
    out: impl Write,
    encoding: Encoding,
    images: &[Image],
) -> io::Result<()> {
    let mut out = Out::new(out, encoding, IMAGE_HEAD, images.len())?;
    for image in images {
        out.short(image.id)?;
        out.raw(&image.pose)?;
        out.name(&image.name)?;
        out.length(image.points.len())?;
        let mut places: &[u8] = &image.places;
        for point in &image.points {
            let (place, rest) = match encoding {
                Encoding::Binary => places.split_at(PLACE.0),
                Encoding::Text => {
                    let end = places.iter().position(|&byte| byte == b'\n');
                    let end = end.unwrap_or(places.len());
                    (&places[..end], &places[end + 1..])
                }
            };
            places = rest;
            out.raw(place)?;
            out.long(point.map_or(-1, |point| point as i64))?;
        }
        out.end()?;
    }
    out.flush()
}

pub(super) fn write_points(
    out: impl Write,
    encoding: Encoding,
    points: &[Point],
) -> io::Result<()> {
    let no_error = match encoding {
        Encoding::Binary => NO_ERROR.to_le_bytes().to_vec(),
        Encoding::Text => NO_ERROR.to_string().into_bytes(),
    };
    let mut out = Out::new(out, encoding, POINT_HEAD, points.len())?;
    for point in points {
        out.long(point.id as i64)?;
        out.raw(&point.place)?;
        out.raw(point.error.as_ref().unwrap_or(&no_error))?;
        out.length(point.track.len())?;
        for &(image, feature) in &point.track {
            out.short(image)?;
            out.short(feature)?;
        }
        out.end()?;
    }
    out.flush()
}

pub(super) fn write_frames(
    out: impl Write,
    encoding: Encoding,
    frames: &[Frame],
) -> io::Result<()> {
    let mut out = Out::new(out, encoding, FRAME_HEAD, frames.len())?;
    for frame in frames {
        out.short(frame.id)?;
        out.short(frame.rig)?;
        out.raw(&frame.pose)?;
        out.short(frame.data.len() as u32)?;
        for datum in &frame.data {
            out.raw(&datum.kind)?;
            out.short(datum.sensor)?;
            out.long(datum.id)?;
        }
        out.end()?;
    }
    out.flush()
}
