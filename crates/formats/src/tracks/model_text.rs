//! COLMAP's models as text.
//!
//! A line of points3D.txt: number, position (3), colour (3), error, and of each view image and
//! feature. Two lines for every image in images.txt: number, rotation (4), translation (3), camera
//! and name; then its features, which may be an empty line.

use std::io::Read;

use super::model_files::{Image, Points};
use super::words::{Words, integer, shown};
use crate::error::Fault;

/// Numbers of a point before its track.
const BEFORE_TRACK: usize = 8;

/// Numbers of an image before its name.
const BEFORE_NAME: usize = 9;

/// The tracks of points3D.txt. O(bytes).
pub(super) fn points(input: impl Read) -> Result<Points, Fault> {
    let mut words = Words::new(input);
    let mut points = Points::default();
    while words.next_full_line()? {
        for _ in 0..BEFORE_TRACK {
            if words.word_of_line().is_none() {
                return Err(words.corrupt("the line of a point has fewer than 8 numbers"));
            }
        }
        while let Some(word) = words.word_of_line() {
            let Some(image) = integer(word).and_then(|image| u32::try_from(image).ok()) else {
                let why = format!("`{}` stands where an image is expected", shown(word));
                return Err(words.corrupt(why));
            };
            points.images.push(image);
            if words.word_of_line().is_none() {
                return Err(words.corrupt("the last view of the track has no feature"));
            }
        }
        points.ends.push(points.images.len());
    }
    Ok(points)
}

/// The images of images.txt. O(bytes).
pub(super) fn images(input: impl Read) -> Result<Vec<Image>, Fault> {
    let mut words = Words::new(input);
    let mut images = Vec::new();
    while words.next_full_line()? {
        let id = words.number_below(u64::from(u32::MAX), "the number of an image")?;
        for _ in 1..BEFORE_NAME {
            words.word_of_line();
        }
        let name = std::str::from_utf8(words.rest());
        let name = name.map_err(|_| words.corrupt("the name of the image is no UTF-8"))?;
        if name.is_empty() {
            return Err(words.corrupt("the line of an image has fewer than 10 fields"));
        }
        images.push(Image {
            id,
            name: name.into(),
        });
        // The features, if there are any.
        words.next_line()?;
    }
    Ok(images)
}
