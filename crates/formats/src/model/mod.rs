//! COLMAP's models: a folder with cameras, images and points3D, as `.bin` or as `.txt`, and with rigs and
//! frames if a COLMAP of version 3.12 or later wrote it.
//!
//! In: such a folder. Out: who sees what ([`Model`]), and on request a copy of it
//! ([`Model::write`]) or of what some of its images see ([`Model::of_images`]). What is not read
//! (poses, intrinsics, positions, colours) is carried over as it stands in the file, so that a
//! copy has the same numbers to the last bit. Graphs of tracks are made elsewhere
//! ([`tracks`](crate::tracks)) of what is read here; this module decides nothing.

mod fields;
mod posed;
mod records;

use std::collections::{HashMap, HashSet};
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;
use viewcert::at_cameras::finished::Dyadic;
use viewcert::linalg::rational::{Rational, parse};

use crate::error::{Fault, Problem, ReadError};
use crate::tracks::Frames;

pub(crate) use fields::{Encoding, Fields, fields};
pub use posed::{Lens, Posed};
pub(crate) use records::{each_point, frames, images, known, rigs};

/// A file of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Cameras,
    Images,
    Points,
    Rigs,
    Frames,
}

/// What the files are called in messages: binary and text.
const TITLES: [[&str; 2]; 5] = [
    ["COLMAP's cameras.bin", "COLMAP's cameras.txt"],
    ["COLMAP's images.bin", "COLMAP's images.txt"],
    ["COLMAP's points3D.bin", "COLMAP's points3D.txt"],
    ["COLMAP's rigs.bin", "COLMAP's rigs.txt"],
    ["COLMAP's frames.bin", "COLMAP's frames.txt"],
];

impl Part {
    /// The name of the file.
    pub(crate) fn file(self, encoding: Encoding) -> &'static str {
        &TITLES[self as usize][encoding as usize]["COLMAP's ".len()..]
    }

    /// Whether the file is in a folder.
    pub(crate) fn is_in(self, folder: &Path, encoding: Encoding) -> bool {
        folder.join(self.file(encoding)).is_file()
    }

    /// Reads the file in a folder.
    pub(crate) fn read<T>(
        self,
        folder: &Path,
        encoding: Encoding,
        read: impl FnOnce(&mut dyn Fields) -> Result<T, Fault>,
    ) -> Result<T, Fault> {
        let name = self.file(encoding);
        let file = File::open(folder.join(name)).map_err(|error| Problem::from(error).into());
        let found = file.and_then(|file| read(&mut *fields(file, encoding)));
        found.map_err(|fault| within(name, fault))
    }

    /// The file as it is.
    fn bytes(self, folder: &Path, encoding: Encoding) -> Result<Vec<u8>, Fault> {
        let name = self.file(encoding);
        let bytes = std::fs::read(folder.join(name));
        bytes.map_err(|error| within(name, Problem::from(error).into()))
    }
}

/// A fault in one of the files of a folder.
fn within(file: &str, fault: Fault) -> Fault {
    let part = format!("{file}{}", fault.place);
    fault.problem.within(&part).into()
}

/// How the model in a folder is written, if there is one; `.bin` goes first, as in COLMAP.
pub(crate) fn encoding_in(folder: &Path) -> Option<Encoding> {
    let there = |&encoding: &_| Part::Points.is_in(folder, encoding);
    [Encoding::Binary, Encoding::Text].into_iter().find(there)
}

/// Whether there is a model in a folder, and no point in it. O(bytes) of the comments.
pub(crate) fn has_no_points(folder: &Path) -> bool {
    encoding_in(folder).is_some_and(|encoding| {
        let any = Part::Points.read(folder, encoding, |fields| fields.record());
        matches!(any, Ok(false))
    })
}

/// What a file is called that has the name of a file of a model.
pub(crate) fn title_of(path: &Path) -> Option<&'static str> {
    let name = path.file_name()?.to_str()?;
    let mut titles = TITLES.iter().flatten().copied();
    titles.find(|title| title["COLMAP's ".len()..] == *name)
}

/// The folder of a model, if a path is that of one of its files.
pub(crate) fn folder_of(path: &Path) -> Option<(&Path, &'static str)> {
    let folder = path.parent()?;
    // The folder of a bare name.
    let here = folder.as_os_str().is_empty();
    let folder = if here { Path::new(".") } else { folder };
    let encoding = encoding_in(folder)?;
    let title = title_of(path)?;
    let is_read = TITLES
        .iter()
        .any(|titles| titles[encoding as usize] == title);
    is_read.then_some((folder, title))
}

/// A model: who sees what, and everything else as it was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Model {
    /// The images, in the order of the file.
    pub images: Vec<Image>,
    /// The points, in the order of the file.
    pub points: Vec<Point>,
    encoding: Encoding,
    /// The file of cameras as it is.
    cameras: Vec<u8>,
    /// The file of rigs as it is, if there is one.
    rigs: Option<Vec<u8>>,
    /// The frames, if there are any.
    frames: Option<Vec<Frame>>,
    /// What rigs and frames say of the images, by their places in `images`.
    known: Frames,
}

/// An image of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Its number in the model.
    pub id: u32,
    /// Its name.
    pub name: Box<str>,
    /// For every feature the point of the model that it is a view of, if it is one.
    pub points: Vec<Option<u64>>,
    /// Pose and camera, as in the file.
    pose: Vec<u8>,
    /// The features' places, as in the file, one after another: of so many bytes in a binary file,
    /// with a line feed behind each in a text file.
    places: Vec<u8>,
}

/// A point of a model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Point {
    /// Its number in the model.
    pub id: u64,
    /// Its views: the number of an image, and that of a feature there.
    pub track: Vec<(u32, u32)>,
    /// Position and colour, as in the file.
    place: Vec<u8>,
    /// The mean error over the track, as in the file; nothing if this is another track.
    error: Option<Vec<u8>>,
}

/// A frame: what the sensors of a rig took at one time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Frame {
    id: u32,
    rig: u32,
    /// As in the file.
    pose: Vec<u8>,
    data: Vec<Datum>,
}

/// What one sensor took.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Datum {
    /// The type of the sensor, as in the file.
    kind: Vec<u8>,
    sensor: u32,
    id: i64,
}

impl Datum {
    /// The number of an image, if the sensor is a camera.
    fn image(&self) -> Option<u32> {
        let id = u32::try_from(self.id).ok();
        id.filter(|_| records::is_camera(&self.kind))
    }
}

impl Model {
    /// Reads the model in a folder; `.bin` goes before `.txt`, as in COLMAP. Linear in the bytes,
    /// which are held in memory.
    ///
    /// # Errors
    /// A folder without a model; a file that is damaged, or contradicts another one.
    pub fn read(folder: &Path) -> Result<Self, ReadError> {
        let name = folder.display().to_string();
        Self::read_files(folder).map_err(|fault| fault.in_file(&name))
    }

    fn read_files(folder: &Path) -> Result<Self, Fault> {
        let there = |part: Part, encoding| part.is_in(folder, encoding);
        let whole = |&encoding: &_| there(Part::Cameras, encoding) && there(Part::Images, encoding);
        let Some(encoding) = encoding_in(folder).filter(whole) else {
            return Err(no_model().into());
        };
        let images = Part::Images.read(folder, encoding, |fields| images(fields, true))?;
        let points = Part::Points.read(folder, encoding, |fields| {
            let mut points = Vec::new();
            each_point(fields, |point| points.push(point.clone()))?;
            Ok(points)
        })?;
        let frames = match there(Part::Frames, encoding) {
            true => Some(Part::Frames.read(folder, encoding, frames)?),
            false => None,
        };
        let mut model = Self {
            known: Frames::default(),
            encoding,
            cameras: Part::Cameras.bytes(folder, encoding)?,
            rigs: None,
            frames,
            images,
            points,
        };
        if there(Part::Rigs, encoding) {
            model.rigs = Some(Part::Rigs.bytes(folder, encoding)?);
            let rigs = Part::Rigs.read(folder, encoding, rigs)?;
            if let Some(frames) = &model.frames {
                let images = &model.images;
                let names: Vec<_> = images.iter().map(|image| image.name.clone()).collect();
                let places = images.iter().map(|image| image.id).zip(0..).collect();
                model.known = known(&rigs, frames, &names, &places)?;
            }
        }
        model.check()?;
        Ok(model)
    }

    /// That tracks name images and features that are there.
    fn check(&self) -> Result<(), Fault> {
        let features = self
            .images
            .iter()
            .map(|image| (image.id, image.points.len()));
        let features: HashMap<u32, usize> = features.collect();
        let corrupt = |why| Problem::corrupt(why).into();
        if features.len() < self.images.len() {
            return Err(corrupt("two images have one number".to_owned()));
        }
        for point in &self.points {
            for &(image, feature) in &point.track {
                let count = features.get(&image).copied();
                if count.is_none_or(|count| count <= feature as usize) {
                    return Err(corrupt(format!(
                        "point {} is seen in feature {feature} of image {image}, which is not there",
                        point.id
                    )));
                }
            }
        }
        Ok(())
    }

    /// The model that some of the images make, which have a number for their place: themselves, the
    /// points that are seen from two places at least, each with the views in these images, and the
    /// frames with one of them. Cameras and
    /// rigs stay as they are. Nothing is computed anew: positions are those of the whole model,
    /// and the error of a point that has lost a view is not known. Linear in the model.
    #[must_use]
    pub fn of_images(&self, place: impl Fn(&Image) -> Option<u32>) -> Self {
        let placed = self.images.iter();
        let placed = placed.filter_map(|image| Some((image, place(image)?)));
        let (images, places): (Vec<&Image>, Vec<u32>) = placed.unzip();
        let ids = images.iter().map(|image| image.id).zip(places);
        let ids: HashMap<u32, u32> = ids.collect();
        let points = self.points.iter().filter_map(|point| point.seen_in(&ids));
        let points: Vec<Point> = points.collect();
        let kept: HashSet<u64> = points.iter().map(|point| point.id).collect();
        let images = images.into_iter().map(|image| Image {
            points: image
                .points
                .iter()
                .map(|point| point.filter(|id| kept.contains(id)))
                .collect(),
            ..image.clone()
        });
        let frames = self.frames.as_ref().map(|frames| {
            let frames = frames.iter().filter_map(|frame| frame.with(&ids));
            frames.collect()
        });
        Self {
            encoding: self.encoding,
            cameras: self.cameras.clone(),
            rigs: self.rigs.clone(),
            frames,
            known: Frames::default(),
            images: images.collect(),
            points,
        }
    }

    /// Writes the model's files into a folder that is there.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let encoding = self.encoding;
        let path = |part: Part| folder.join(part.file(encoding));
        let create = |part| File::create(path(part)).map(BufWriter::new);
        std::fs::write(path(Part::Cameras), &self.cameras)?;
        if let Some(rigs) = &self.rigs {
            std::fs::write(path(Part::Rigs), rigs)?;
        }
        records::write_images(create(Part::Images)?, encoding, &self.images)?;
        records::write_points(create(Part::Points)?, encoding, &self.points)?;
        if let Some(frames) = &self.frames {
            records::write_frames(create(Part::Frames)?, encoding, frames)?;
        }
        Ok(())
    }

    /// Which images know their place to each other by their rig, and which were taken at one place;
    /// images are called by their places in [`images`](Self::images). Of a part that was taken out of a
    /// model nothing is known.
    pub fn known_frames(&self) -> &Frames {
        &self.known
    }

    /// Rotation (a quaternion, the real part first) and translation of every image, exactly as they are in
    /// the file.
    ///
    /// # Errors
    /// The first image with a number that is none, by its name.
    pub fn poses(&self) -> Result<Vec<[Rational; 7]>, String> {
        let image = |image: &Image| {
            let double = |bytes| exact(f64::from_le_bytes(bytes));
            let pose = fields_of(self.encoding, &image.pose, double, |word| parse(word).ok());
            pose.ok_or_else(|| image.name.to_string())
        };
        self.images.iter().map(image).collect()
    }

    /// The poses once more, in floating point.
    ///
    /// # Errors
    /// The first image whose numbers are no pose, with its file.
    pub fn measured_poses(&self) -> Result<Vec<[f64; 7]>, String> {
        let is_pose = |pose: &[f64; 7]| pose[..4].iter().any(|&x| x != 0.0);
        let image = |image: &Image| {
            let pose = numbers(self.encoding, &image.pose).filter(is_pose);
            pose.ok_or_else(|| {
                let (file, name) = (Part::Images.file(self.encoding), &image.name);
                format!(
                    "{file}: the pose of image {name} is no rotation and place in finite numbers"
                )
            })
        };
        self.images.iter().map(image).collect()
    }

    /// The places of the points, in floating point.
    ///
    /// # Errors
    /// The first point whose numbers are no place, with its file.
    pub fn measured_points(&self) -> Result<Vec<[f64; 3]>, String> {
        let point = |point: &Point| {
            numbers(self.encoding, &point.place).ok_or_else(|| {
                let (file, id) = (Part::Points.file(self.encoding), point.id);
                format!("{file}: the place of point {id} is not in finite numbers")
            })
        };
        self.points.iter().map(point).collect()
    }

    /// The names of the files that [`write`](Self::write) makes.
    pub fn files(&self) -> Vec<String> {
        let rigs = self.rigs.as_ref().map(|_| Part::Rigs);
        let frames = self.frames.as_ref().map(|_| Part::Frames);
        let always = [Part::Cameras, Part::Images, Part::Points];
        let parts = always.into_iter().chain(rigs).chain(frames);
        parts
            .map(|part| part.file(self.encoding).to_owned())
            .collect()
    }
}

/// The first numbers of a record, if they are finite.
fn numbers<const N: usize>(encoding: Encoding, record: &[u8]) -> Option<[f64; N]> {
    let double = |bytes| Some(f64::from_le_bytes(bytes));
    let numbers = fields_of(encoding, record, double, |word| word.parse().ok());
    numbers.filter(|all| all.iter().all(|x| x.is_finite()))
}

/// The first numbers of a record, by what each is in bytes and in text.
fn fields_of<T, const N: usize>(
    encoding: Encoding,
    record: &[u8],
    double: impl Fn([u8; 8]) -> Option<T>,
    word: impl Fn(&str) -> Option<T>,
) -> Option<[T; N]> {
    let numbers: Option<Vec<T>> = match encoding {
        Encoding::Binary => {
            let (numbers, _) = record.as_chunks::<8>();
            numbers.iter().take(N).map(|&bytes| double(bytes)).collect()
        }
        Encoding::Text => str::from_utf8(record)
            .ok()?
            .split(' ')
            .take(N)
            .map(word)
            .collect(),
    };
    numbers?.try_into().ok()
}

impl Point {
    /// The point with its views in some images, whose places are given, if it is seen from two.
    fn seen_in(&self, images: &HashMap<u32, u32>) -> Option<Self> {
        let track = self.track.iter();
        let track = track.filter(|(image, _)| images.contains_key(image));
        let track: Vec<(u32, u32)> = track.copied().collect();
        let (first, _) = track.first()?;
        if track
            .iter()
            .all(|(image, _)| images[image] == images[first])
        {
            return None;
        }
        let is_whole = track.len() == self.track.len();
        Some(Self {
            id: self.id,
            track,
            place: self.place.clone(),
            error: self.error.clone().filter(|_| is_whole),
        })
    }
}

impl Frame {
    /// The frame with some images, if it has one of them; what is no image stays.
    fn with(&self, images: &HashMap<u32, u32>) -> Option<Self> {
        let is_image = |datum: &Datum| records::is_camera(&datum.kind);
        let is_in = |datum: &&Datum| {
            let image = datum.image();
            !is_image(datum) || image.is_some_and(|id| images.contains_key(&id))
        };
        let data: Vec<Datum> = self.data.iter().filter(is_in).cloned().collect();
        data.iter().any(is_image).then(|| Self {
            data,
            pose: self.pose.clone(),
            ..*self
        })
    }
}

/// A double as the rational number that it is; nothing for infinities and what is no number.
pub(crate) fn exact(number: f64) -> Option<Rational> {
    Dyadic::from_bits(number.to_bits()).map(Dyadic::exact)
}

/// A part of a model without its tracks.
pub(crate) fn no_model() -> Problem {
    Problem::new(
        "there is no model here: points3D.bin or points3D.txt, which holds the tracks, is missing",
        "name the folder that has all files of the model",
    )
}

#[cfg(test)]
mod rig_tests;
#[cfg(test)]
mod tests;
