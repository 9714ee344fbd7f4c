//! COLMAP's models in binary files: little endian, without a magic number.
//!
//! Each begins with the number of its records (64 bits). A point: number (64), position (3
//! doubles), colour (3 bytes), error (double), length of the track (64), and of each view image and
//! feature (32 each). An image: number (32), rotation (4 doubles), translation (3), camera (32),
//! name with a zero byte at the end, number of features (64), of each position (2 doubles) and
//! point (64). A camera: number (32), model (32), width and height (64 each), parameters (doubles).

use std::io::{BufRead, BufReader, ErrorKind, Read, Seek};

use super::model_files::{CAMERA_MODELS, Image, Part, Points};
use crate::error::{Fault, Place, Problem};

/// The longest name of an image.
const NAME_LIMIT: u64 = 1 << 16;

/// Bytes of a feature in images.bin.
const FEATURE: u64 = 24;

fn fault(problem: Problem) -> Fault {
    Place::Input.fault(problem)
}

fn corrupt(why: String) -> Fault {
    fault(Problem::Corrupt(why))
}

/// Bytes that come to an end too early are said to be truncated.
fn exact<const N: usize>(input: &mut impl Read, what: &str) -> Result<[u8; N], Fault> {
    let mut bytes = [0; N];
    match input.read_exact(&mut bytes) {
        Ok(()) => Ok(bytes),
        Err(error) if error.kind() == ErrorKind::UnexpectedEof => {
            Err(fault(Problem::Truncated(format!("{what} is missing"))))
        }
        Err(error) => Err(fault(error.into())),
    }
}

fn long(input: &mut impl Read, what: &str) -> Result<u64, Fault> {
    exact(input, what).map(u64::from_le_bytes)
}

fn short(input: &mut impl Read, what: &str) -> Result<u32, Fault> {
    exact(input, what).map(u32::from_le_bytes)
}

/// Nothing may follow.
fn end(input: &mut impl BufRead) -> Result<(), Fault> {
    match input.fill_buf() {
        Ok([]) => Ok(()),
        Ok(_) => Err(corrupt("bytes follow the last record".into())),
        Err(error) => Err(fault(error.into())),
    }
}

/// The tracks of points3D.bin. O(bytes).
pub(super) fn points(input: impl Read) -> Result<Points, Fault> {
    let mut input = BufReader::with_capacity(1 << 16, input);
    let count = long(&mut input, "the number of points")?;
    let mut points = Points::default();
    for _ in 0..count {
        exact::<43>(&mut input, "a point")?;
        let length = long(&mut input, "the length of a track")?;
        for _ in 0..length {
            let view: [u8; 8] = exact(&mut input, "a view of a point")?;
            let [a, b, c, d, ..] = view;
            points.images.push(u32::from_le_bytes([a, b, c, d]));
        }
        points.ends.push(points.images.len());
    }
    end(&mut input)?;
    Ok(points)
}

/// The images of images.bin; features are passed over. O(images), without those.
pub(super) fn images(input: impl Read + Seek) -> Result<Vec<Image>, Fault> {
    let mut input = BufReader::with_capacity(1 << 16, input);
    let count = long(&mut input, "the number of images")?;
    let mut images = Vec::new();
    for _ in 0..count {
        let id = short(&mut input, "an image")?;
        exact::<60>(&mut input, "the pose of an image")?;
        let mut name = Vec::new();
        let read = input.by_ref().take(NAME_LIMIT).read_until(0, &mut name);
        read.map_err(|error| fault(error.into()))?;
        if name.pop() != Some(0) {
            let why = format!("the name of image {id} has no end");
            return Err(fault(Problem::Truncated(why)));
        }
        let name = String::from_utf8(name)
            .map_err(|_| corrupt(format!("the name of image {id} is no UTF-8")))?;
        let features = long(&mut input, "the number of an image's features")?;
        let skip = features.checked_mul(FEATURE);
        let skip = skip.and_then(|skip| i64::try_from(skip).ok());
        let skip = skip.ok_or_else(|| corrupt(format!("image {id} has {features} features")))?;
        input
            .seek_relative(skip)
            .map_err(|error| fault(error.into()))?;
        images.push(Image {
            id,
            name: name.into(),
        });
    }
    // Who goes beyond the end of a file is not told.
    let at = input
        .stream_position()
        .map_err(|error| fault(error.into()))?;
    let size = input
        .seek(std::io::SeekFrom::End(0))
        .map_err(|error| fault(error.into()))?;
    match at.cmp(&size) {
        std::cmp::Ordering::Equal => Ok(images),
        std::cmp::Ordering::Less => Err(corrupt("bytes follow the last image".into())),
        std::cmp::Ordering::Greater => {
            let why = "features of the last image are missing";
            Err(fault(Problem::Truncated(why.into())))
        }
    }
}

/// Why a beginning is no record, if it is none.
enum Unlike {
    /// The bytes end, and what there is fits.
    Short,
    Other,
}

/// The bytes at the beginning of a file.
struct Head<'a>(&'a [u8]);

impl Head<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Unlike> {
        let (bytes, rest) = self.0.split_first_chunk::<N>().ok_or(Unlike::Short)?;
        self.0 = rest;
        Ok(*bytes)
    }

    fn short(&mut self) -> Result<u32, Unlike> {
        self.take().map(u32::from_le_bytes)
    }

    /// A number up to a limit.
    fn long(&mut self, limit: u64) -> Result<u64, Unlike> {
        let value = self.take().map(u64::from_le_bytes)?;
        (value <= limit).then_some(value).ok_or(Unlike::Other)
    }

    /// Doubles that are finite.
    fn doubles(&mut self, count: u64) -> Result<f64, Unlike> {
        let mut squares = 0.0;
        for _ in 0..count {
            let value = f64::from_le_bytes(self.take()?);
            if !value.is_finite() {
                return Err(Unlike::Other);
            }
            squares += value * value;
        }
        Ok(squares)
    }

    fn skip(&mut self, count: u64) -> Result<(), Unlike> {
        let count = usize::try_from(count).map_err(|_| Unlike::Short)?;
        self.0 = self.0.get(count..).ok_or(Unlike::Short)?;
        Ok(())
    }

    fn point(&mut self) -> Result<(), Unlike> {
        self.long(u64::MAX)?;
        self.doubles(3)?;
        self.skip(3)?;
        self.doubles(1)?;
        let length = self.long(1 << 32)?;
        self.skip(8 * length)
    }

    fn image(&mut self) -> Result<(), Unlike> {
        self.short()?;
        let norm = self.doubles(4)?;
        self.doubles(3)?;
        self.short()?;
        // A quaternion of length one, but for rounding.
        if !(0.99..1.01).contains(&norm) {
            return Err(Unlike::Other);
        }
        let end = self.0.iter().position(|&byte| byte == 0);
        let name = &self.0[..end.unwrap_or(self.0.len())];
        if name.iter().any(|byte| byte.is_ascii_control()) {
            return Err(Unlike::Other);
        }
        match end {
            None => return Err(Unlike::Short),
            Some(0) => return Err(Unlike::Other),
            Some(end) => self.skip(end as u64 + 1)?,
        }
        let features = self.long(1 << 32)?;
        self.skip(FEATURE * features)
    }

    fn camera(&mut self) -> Result<(), Unlike> {
        self.short()?;
        let model = self.short()?;
        let size = [self.long(1 << 32)?, self.long(1 << 32)?];
        let parameters = CAMERA_MODELS.get(model as usize).ok_or(Unlike::Other)?;
        if size.contains(&0) {
            return Err(Unlike::Other);
        }
        self.doubles(parameters.1).map(|_| ())
    }
}

/// Which part of a model begins with these bytes, which are all if `whole`: all records that can be
/// seen are as they have to be, and, if all bytes are there, nothing is missing or left.
pub(super) fn part(head: &[u8], whole: bool) -> Option<Part> {
    type Record = for<'a, 'b> fn(&'a mut Head<'b>) -> Result<(), Unlike>;
    let parts: [(Part, Record); 3] = [
        (Part::Points, |head| head.point()),
        (Part::Images, |head| head.image()),
        (Part::Cameras, |head| head.camera()),
    ];
    let fits = |record: Record| {
        let mut head = Head(head);
        let Ok(count @ 1..) = head.long(1 << 40) else {
            return false;
        };
        for _ in 0..count {
            match record(&mut head) {
                Ok(()) => (),
                Err(Unlike::Short) => return !whole,
                Err(Unlike::Other) => return false,
            }
        }
        whole && head.0.is_empty()
    };
    let mut fitting = parts.into_iter().filter(|(_, record)| fits(*record));
    let (part, _) = fitting.next()?;
    fitting.next().is_none().then_some(part)
}
