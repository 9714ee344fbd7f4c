//! A model taken apart where its observations do not hold it together: one model for each part.
//!
//! In: a model of COLMAP, and what its observations hold at its poses ([`Held`]). Out: what is free, in words, and for each
//! part a copy of what its images see ([`Model::of_images`]). Nothing is computed anew, and the model is not touched.

use crate::folder::{ensure_new, resolved};
use anyhow::{Result, ensure};
use serde::Serialize;
use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::path::Path;
use viewcert::at_cameras::finished::{Held, Hinge, Motion};
use viewcert_formats::model::{Model, Posed};
use viewcert_session::Outputs;

/// What a model was taken apart into.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Split {
    /// The folder that holds the parts.
    pub folder: String,
    /// The parts, larger ones first.
    pub parts: Vec<Piece>,
    /// The images of no part.
    pub outside: Vec<String>,
    /// How many points no two images of one part see: they are in no part.
    pub points_left_out: usize,
}

/// A part of a model: a model of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Piece {
    /// Its folder.
    pub folder: String,
    /// Its images.
    pub images: Vec<String>,
    /// How many points it has.
    pub points: usize,
}

/// What is free between two parts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Free {
    /// The parts, counted from 1.
    pub between: [usize; 2],
    /// How many motions.
    pub freedom: usize,
    /// These in words.
    pub meaning: String,
}

impl Free {
    /// The motions of a model, in words.
    pub fn of(held: &Held, model: &Model, posed: &Posed) -> Vec<Self> {
        let free = held.joints.iter().map(|joint| Self {
            between: joint.parts.map(|part| part + 1),
            freedom: joint.freedom,
            meaning: meaning(joint, model, posed),
        });
        free.collect()
    }
}

/// A motion in words, by what stays where it is.
fn meaning(joint: &Hinge, model: &Model, posed: &Posed) -> String {
    let points = joint.points.iter().map(|&k| posed.ids[k as usize]);
    let points: Vec<u64> = points.collect();
    let image = joint.images.first();
    let image = image.map(|&v| format!("image {}", model.images[v as usize].name));
    let still = image.or_else(|| Some(format!("point {}", points.first()?)));
    let about = still.as_ref().map(|still| format!(" about {still}"));
    let about = about.unwrap_or_default();
    match (joint.motion, &points[..]) {
        (Motion::Turn, [a, b]) => format!("turns about the line through points {a} and {b}"),
        (Motion::Turn, _) => "turns about a line".to_owned(),
        (Motion::Scale, _) => format!("scale{about}"),
        (Motion::Slide, _) => "slides along a line".to_owned(),
        (Motion::Screw, _) => "turns about a line and slides along it".to_owned(),
        (Motion::Spiral, _) => format!("turns and scales{about}"),
        (Motion::Several, _) => match (joint.freedom, still) {
            (7, _) => "everything: rotation, translation and scale".to_owned(),
            (6, None) => "rotation and translation, or scale with a part of them".to_owned(),
            (4, Some(still)) => format!("turns about {still} in every direction, and scale"),
            (count, Some(still)) => format!("{count} motions, which leave {still} where it is"),
            (count, None) => format!("{count} motions"),
        },
    }
}

/// Refuses a folder that holds anything, or that is in the model's folder.
///
/// # Errors
/// What is in the way.
pub fn check(folder: &Path, model: &Path) -> Result<()> {
    ensure!(
        !resolved(folder).starts_with(resolved(model)),
        "split {}: this is in the folder of the model, where nothing is ever written; name another \
         folder",
        folder.display()
    );
    ensure_new("split", folder)
}

/// Writes the parts of a model into a folder, whole or not at all. A point is in a part if two of its images see it from
/// different places. Linear in the model for each part.
///
/// # Errors
/// Those of the file system; a folder with something else in it.
pub fn split(
    outputs: &Outputs,
    folder: &Path,
    model: &Model,
    posed: &Posed,
    parts: &[Vec<u32>],
) -> Result<Split> {
    let first = posed.first_at_place();
    let names = |images: &[u32]| {
        let name = |&v: &u32| model.images[v as usize].name.to_string();
        let mut names: Vec<String> = images.iter().map(name).collect();
        names.sort();
        names
    };
    let inside: BTreeSet<u32> = parts.iter().flatten().copied().collect();
    let outside = (0..model.images.len() as u32).filter(|v| !inside.contains(v));
    let (mut written, mut points) = (Vec::new(), BTreeSet::new());
    let digits = parts.len().to_string().len().max(3);
    outputs.folder(folder, |new| {
        for (number, images) in (1..).zip(parts) {
            let place = |&v: &u32| (model.images[v as usize].id, first[v as usize] as u32);
            let places: HashMap<u32, u32> = images.iter().map(place).collect();
            let part = model.of_images(|image| places.get(&image.id).copied());
            let folder = format!("{number:0digits$}");
            fs::create_dir(new.join(&folder))?;
            part.write(&new.join(&folder))?;
            points.extend(part.points.iter().map(|point| point.id));
            written.push(Piece {
                folder,
                images: names(images),
                points: part.points.len(),
            });
        }
        Ok(())
    })?;
    Ok(Split {
        folder: folder.display().to_string(),
        parts: written,
        outside: names(&outside.collect::<Vec<u32>>()),
        points_left_out: model.points.len() - points.len(),
    })
}
