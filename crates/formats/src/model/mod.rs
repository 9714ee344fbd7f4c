//! COLMAP's models, whole: to be written again with some of their images.
//!
//! In: a folder with cameras, images and points3D, as `.bin` or as `.txt`, and with rigs and frames
//! if a COLMAP of version 4 wrote it. Out: who sees what ([`Model`]), and on request a copy of it
//! ([`Model::write`]) or of what some of its images see ([`Model::of_images`]). What is not read
//! (poses, intrinsics, positions, colours) is carried over as it stands in the file, so that a
//! copy has the same numbers to the last bit. Graphs of tracks are read elsewhere
//! ([`tracks`](crate::tracks)); this module decides nothing.

mod binary;
mod text;

use std::collections::{HashMap, HashSet};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::Rational;

use crate::error::{Fault, Place, Problem, ReadError};
use crate::tracks::{Frames, ModelEncoding as Encoding};

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
    pose: Box<[u8]>,
    /// The features' places, as in the file, one after another: of so many bytes in a binary file,
    /// with a line feed behind each in a text file.
    places: Box<[u8]>,
}

/// A point of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    /// Its number in the model.
    pub id: u64,
    /// Its views: the number of an image, and that of a feature there.
    pub track: Vec<(u32, u32)>,
    /// Position and colour, as in the file.
    place: Box<[u8]>,
    /// The mean error over the track, as in the file; nothing if this is another track.
    error: Option<Box<[u8]>>,
}

/// A frame: what the sensors of a rig took at one time.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Frame {
    /// Numbers of frame and rig, and the pose, as in the file.
    head: Box<[u8]>,
    data: Vec<Datum>,
}

/// What one sensor took.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Datum {
    /// The sensor, as in the file.
    sensor: Box<[u8]>,
    /// The number of an image, if the sensor is a camera.
    id: u64,
    is_image: bool,
}

/// A file of a model, and its name without extension.
const CAMERAS: &str = "cameras";
const RIGS: &str = "rigs";
const FRAMES: &str = "frames";
const IMAGES: &str = "images";
const POINTS: &str = "points3D";

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
        let Some(encoding) = crate::tracks::encoding_in(folder) else {
            return Err(Place::Input.fault(Problem::NoModel));
        };
        let file = |stem: &str| file_name(stem, encoding);
        let there = |stem: &str| folder.join(file(stem)).is_file();
        if !there(CAMERAS) || !there(IMAGES) {
            return Err(Place::Input.fault(Problem::NoModel));
        }
        let bytes = |stem: &str| {
            let read = std::fs::read(folder.join(file(stem)));
            read.map_err(|error| within(&file(stem), Place::Input.fault(error.into())))
        };
        let inside = |stem: &'static str| move |fault| within(&file_name(stem, encoding), fault);
        let of_images = bytes(IMAGES)?;
        let images = match encoding {
            Encoding::Binary => binary::images(&of_images),
            Encoding::Text => text::images(&of_images),
        };
        let images = images.map_err(inside(IMAGES))?;
        let of_points = bytes(POINTS)?;
        let points = match encoding {
            Encoding::Binary => binary::points(&of_points),
            Encoding::Text => text::points(&of_points),
        };
        let points = points.map_err(inside(POINTS))?;
        let frames = if there(FRAMES) {
            let of_frames = bytes(FRAMES)?;
            let frames = match encoding {
                Encoding::Binary => binary::frames(&of_frames),
                Encoding::Text => text::frames(&of_frames),
            };
            Some(frames.map_err(inside(FRAMES))?)
        } else {
            None
        };
        let rigs = there(RIGS).then(|| bytes(RIGS)).transpose()?;
        let names: Vec<Box<str>> = images.iter().map(|image| image.name.clone()).collect();
        let places = images.iter().map(|image| image.id).zip(0..).collect();
        let model = Self {
            known: crate::tracks::frames_in(folder, encoding, &names, &places)?,
            encoding,
            cameras: bytes(CAMERAS)?,
            rigs,
            frames,
            images,
            points,
        };
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
        let corrupt = |why| Place::Input.fault(Problem::Corrupt(why));
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
        let create = |stem| File::create(folder.join(file_name(stem, self.encoding)));
        create(CAMERAS)?.write_all(&self.cameras)?;
        if let Some(rigs) = &self.rigs {
            create(RIGS)?.write_all(rigs)?;
        }
        let mut images = BufWriter::new(create(IMAGES)?);
        let mut points = BufWriter::new(create(POINTS)?);
        match self.encoding {
            Encoding::Binary => {
                binary::write_images(&mut images, &self.images)?;
                binary::write_points(&mut points, &self.points)?;
            }
            Encoding::Text => {
                text::write_images(&mut images, &self.images)?;
                text::write_points(&mut points, &self.points)?;
            }
        }
        images.flush()?;
        points.flush()?;
        if let Some(all) = &self.frames {
            let mut frames = BufWriter::new(create(FRAMES)?);
            match self.encoding {
                Encoding::Binary => binary::write_frames(&mut frames, all)?,
                Encoding::Text => text::write_frames(&mut frames, all)?,
            }
            frames.flush()?;
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
            let numbers: Option<Vec<Rational>> = match self.encoding {
                Encoding::Binary => {
                    let (numbers, _) = image.pose.as_chunks::<8>();
                    numbers
                        .iter()
                        .map(|&bytes| exact(f64::from_le_bytes(bytes)))
                        .collect()
                }
                Encoding::Text => {
                    let text = std::str::from_utf8(&image.pose).ok();
                    text.and_then(|text| text.split(' ').map(|word| word.parse().ok()).collect())
                }
            };
            let pose = numbers.and_then(|all| all.first_chunk::<7>().cloned());
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
            let pose = self.numbers(&image.pose).filter(is_pose);
            pose.ok_or_else(|| {
                let (file, name) = (file_name(IMAGES, self.encoding), &image.name);
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
            self.numbers(&point.place).ok_or_else(|| {
                let (file, id) = (file_name(POINTS, self.encoding), point.id);
                format!("{file}: the place of point {id} is not in finite numbers")
            })
        };
        self.points.iter().map(point).collect()
    }

    /// The first numbers of a record, if they are finite.
    fn numbers<const N: usize>(&self, record: &[u8]) -> Option<[f64; N]> {
        let numbers: Vec<f64> = match self.encoding {
            Encoding::Binary => {
                let (numbers, _) = record.as_chunks::<8>();
                numbers.iter().copied().map(f64::from_le_bytes).collect()
            }
            Encoding::Text => {
                let words = std::str::from_utf8(record).ok()?.split(' ');
                words.map_while(|word| word.parse().ok()).collect()
            }
        };
        let numbers = numbers.first_chunk::<N>().copied();
        numbers.filter(|all| all.iter().all(|x| x.is_finite()))
    }

    /// The names of the files that [`write`](Self::write) makes.
    pub fn files(&self) -> Vec<String> {
        let always = [Some(CAMERAS), Some(IMAGES), Some(POINTS)].into_iter();
        let rigs = self.rigs.as_ref().map(|_| RIGS);
        let frames = self.frames.as_ref().map(|_| FRAMES);
        let stems = always.chain([rigs, frames]).flatten();
        stems.map(|stem| file_name(stem, self.encoding)).collect()
    }
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
        let is_in = |datum: &&Datum| {
            !datum.is_image || u32::try_from(datum.id).is_ok_and(|id| images.contains_key(&id))
        };
        let data: Vec<Datum> = self.data.iter().filter(is_in).cloned().collect();
        data.iter().any(|datum| datum.is_image).then(|| Self {
            head: self.head.clone(),
            data,
        })
    }
}

fn file_name(stem: &str, encoding: Encoding) -> String {
    let extension = match encoding {
        Encoding::Binary => "bin",
        Encoding::Text => "txt",
    };
    format!("{stem}.{extension}")
}

/// Every file that a model may have.
pub fn is_file_of_model(name: &str) -> bool {
    let stem = name.strip_suffix(".bin").or(name.strip_suffix(".txt"));
    stem.is_some_and(|stem| [CAMERAS, RIGS, FRAMES, IMAGES, POINTS].contains(&stem))
}

/// A fault in one of the files of a folder.
fn within(file: &str, fault: Fault) -> Fault {
    Place::Input.fault(Problem::Within {
        part: format!("{file}{}", fault.place),
        problem: Box::new(fault.problem),
    })
}

/// A double as the rational number that it is; nothing for infinities and what is no number.
pub(crate) fn exact(number: f64) -> Option<Rational> {
    let bits = number.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
    let (mantissa, exponent) = match exponent {
        0x7ff => return None,
        0 => (fraction, -1074),
        _ => (fraction | 1 << 52, exponent - 1075),
    };
    let mantissa = Integer::from(mantissa);
    let mantissa = if number.is_sign_negative() {
        mantissa.neg()
    } else {
        mantissa
    };
    Some(Rational::scaled(mantissa, 2, exponent))
}

#[cfg(test)]
mod tests;
