//! A model taken apart where its tracks do not hold it together: one model for each component.
//!
//! In: a model of COLMAP, the camera-point graph of its tracks, and the verdict on that. Out: for
//! each component with two cameras or more a copy of what its images see
//! ([`Model::of_images`](viewcert_formats::Model::of_images)). A mapper that solves for all positions at once returns one model
//! in which the components are placed against each other at a scale that nothing supports; each of
//! them by itself is what its tracks determine (docs/reconstruction.md). Nothing is computed anew,
//! and the model is not touched.

use crate::folder::{ensure_outside, paths, resolved};
use crate::named::Names;
use crate::parts::Parts;
use crate::task::number;
use anyhow::{Context, Result, bail, ensure};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use viewcert::Verdict;
use viewcert_formats::NamedGraph;
use viewcert_formats::model::{Model, is_file_of_model};
use viewcert_session::Outputs;

/// The table of parts in the folder.
const TABLE: &str = "parts.tsv";
/// The page in the folder.
pub const PAGE: &str = "page.html";
/// The first line of the table, by which an earlier run is known.
const HEAD: [&str; 5] = ["part", "images", "points", "observations", "shared"];

/// What a model was taken apart into.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Split {
    /// The folder that holds the parts.
    pub folder: String,
    /// The parts, in the order of the components.
    pub parts: Vec<Piece>,
    /// The images of several parts, and the components that these are.
    pub shared: Vec<Shared>,
    /// The images of no part.
    pub outside: Vec<String>,
    /// How many points are in a part without all of their views.
    pub points_cut: usize,
    /// How many points no two images of one part see: they are in no part.
    pub points_left_out: usize,
}

impl Split {
    /// How many images the model has.
    pub fn image_count(&self) -> usize {
        let parts = self.parts.iter().flat_map(|part| &part.images);
        parts.chain(&self.outside).collect::<BTreeSet<_>>().len()
    }
}

/// A part of a model: a model of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Piece {
    /// The component.
    pub component: usize,
    /// Its folder.
    pub folder: String,
    /// Its images.
    pub images: Vec<String>,
    /// How many points it has.
    pub points: usize,
    /// How many views these have.
    pub observations: usize,
}

/// An image of several parts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Shared {
    /// The image.
    pub image: String,
    /// The components.
    pub components: Vec<usize>,
}

/// Refuses a folder that holds anything but an earlier run of this, that holds the model, or that
/// is in the model's folder.
///
/// # Errors
/// What is in the way.
pub fn check(folder: &Path, model: &Path) -> Result<()> {
    let name = folder.display();
    let inputs = [model.to_owned()];
    ensure_outside("split", folder, &inputs, &[])?;
    ensure!(
        !resolved(folder).starts_with(resolved(model)),
        "split {name}: this is in the folder of the model, where nothing is ever written; name another \
         folder"
    );
    let Ok(found) = fs::symlink_metadata(folder) else {
        return Ok(());
    };
    ensure!(
        found.is_dir(),
        "split {name}: this is not a folder; name another place"
    );
    if let Some(foreign) = foreign(folder).with_context(|| format!("split {name}"))? {
        bail!(
            "split {name}: {} is there, which no split has written; name another folder",
            foreign.display()
        );
    }
    Ok(())
}

/// Something in a folder that is not written here.
fn foreign(folder: &Path) -> std::io::Result<Option<PathBuf>> {
    let entries = paths(folder)?;
    let table = fs::read_to_string(folder.join(TABLE)).unwrap_or_default();
    if !entries.is_empty() && table.lines().next() != Some(&HEAD.join("\t")) {
        return Ok(entries.into_iter().next());
    }
    for path in entries {
        let name = path.file_name().and_then(|name| name.to_str());
        if path.is_file() && name.is_some_and(|name| [TABLE, PAGE].contains(&name)) {
            continue;
        }
        let is_number = name.is_some_and(|name| name.bytes().all(|byte| byte.is_ascii_digit()));
        if !is_number || !path.is_dir() || path.is_symlink() {
            return Ok(Some(path));
        }
        let is_ours = |file: &PathBuf| {
            let name = file.file_name().and_then(|name| name.to_str());
            file.is_file() && name.is_some_and(is_file_of_model)
        };
        if let Some(other) = paths(&path)?.into_iter().find(|file| !is_ours(file)) {
            return Ok(Some(other));
        }
    }
    Ok(None)
}

/// Takes a model apart by the components of its camera-point graph, whose cameras have the names of
/// the model's images, and writes the folder, whole or not at all. A camera that stands for several
/// images of a frame, as these were taken at one place, is all of them; a frame without points is no
/// part. Where frames hold all of it together, though components do not (`whole`), all images are one
/// part. `page` writes what the parts are and why, for people. Linear in the model for each part.
///
/// # Errors
/// Those of the file system; a folder with something else in it.
pub fn split(
    outputs: &Outputs,
    folder: &Path,
    model: &Model,
    input: &NamedGraph,
    verdict: &Verdict,
    whole: bool,
    page: impl FnOnce(&Split) -> Result<Vec<u8>>,
) -> Result<Split> {
    let names = Names::new(input);
    let parts = Parts::new(&input.graph, verdict);
    let cameras = names.images().end;
    let has_points = |component: usize| verdict.components[component].edge_count() > 0;
    let members = parts.parts.iter().filter(|part| has_points(part.component));
    let members = members.map(|part| {
        let images = part.nodes.iter().copied().filter(|&v| v < cameras);
        (part.component, images.collect::<Vec<u32>>())
    });
    let members: Vec<(usize, Vec<u32>)> = if whole {
        vec![(0, names.images().collect())]
    } else {
        members.filter(|(_, images)| images.len() > 1).collect()
    };
    let digits = members
        .last()
        .map_or(3, |(last, _)| number(*last).to_string().len().max(3));
    let mut components: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (component, images) in &members {
        for &v in images {
            components.entry(v).or_default().push(number(*component));
        }
    }
    let mut found = Split {
        folder: folder.display().to_string(),
        parts: Vec::new(),
        shared: components
            .iter()
            .filter(|(_, of)| of.len() > 1)
            .flat_map(|(&v, of)| names.all_of(v).map(|image| (image, of.clone())))
            .map(|(image, components)| Shared { image, components })
            .collect(),
        outside: names
            .images()
            .filter(|v| !components.contains_key(v))
            .flat_map(|v| names.all_of(v))
            .collect(),
        points_cut: 0,
        points_left_out: 0,
    };
    let mut fates = Fates::default();
    outputs.folder(folder, |new| {
        for (component, images) in &members {
            let images = images.iter();
            let images = images.flat_map(|&v| names.all_of(v).map(move |name| (name, v)));
            let images: BTreeMap<String, u32> = images.collect();
            let part = model.of_images(|image| images.get(&*image.name).copied());
            let name = format!("{:0digits$}", number(*component));
            fs::create_dir(new.join(&name))?;
            part.write(&new.join(&name))?;
            fates.note(model, &part);
            found.parts.push(Piece {
                component: number(*component),
                folder: name,
                images: images.into_keys().collect(),
                points: part.points.len(),
                observations: part.points.iter().map(|point| point.track.len()).sum(),
            });
        }
        (found.points_cut, found.points_left_out) = fates.counts(model);
        write_table(&new.join(TABLE), &found)?;
        Ok(fs::write(new.join(PAGE), page(&found)?)?)
    })?;
    Ok(found)
}

/// What became of points.
#[derive(Default)]
struct Fates {
    /// Points that are in a part, and whether they have lost views in one.
    is_cut: BTreeMap<u64, bool>,
}

impl Fates {
    fn note(&mut self, model: &Model, part: &Model) {
        let mut whole = model.points.iter();
        for point in &part.points {
            // Points of a part are in the order of the model.
            let of_model = whole.find(|of_model| of_model.id == point.id);
            let lost = of_model.is_none_or(|of_model| of_model.track.len() > point.track.len());
            *self.is_cut.entry(point.id).or_default() |= lost;
        }
    }

    /// How many points have lost views, and how many are in no part.
    fn counts(&self, model: &Model) -> (usize, usize) {
        let cut = self.is_cut.values().filter(|&&is_cut| is_cut).count();
        (cut, model.points.len() - self.is_cut.len())
    }
}

fn write_table(path: &Path, split: &Split) -> Result<()> {
    let mut out = csv::WriterBuilder::new().delimiter(b'\t').from_path(path)?;
    out.write_record(HEAD)?;
    for part in &split.parts {
        let shared = split
            .shared
            .iter()
            .filter(|shared| shared.components.contains(&part.component));
        let shared: Vec<&str> = shared.map(|shared| &*shared.image).collect();
        out.write_record([
            part.folder.clone(),
            part.images.len().to_string(),
            part.points.to_string(),
            part.observations.to_string(),
            shared.join(","),
        ])?;
    }
    Ok(out.flush()?)
}
