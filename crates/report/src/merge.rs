//! Two models and what they share, for people and for programs.

use super::json::{GraphLine, joined, present, write_line};
use super::{condition, counted};
use crate::shown::{SHOWN, notes, rest, row, some_names, time};
use serde_json::json;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::decide::Options;
use viewcert::wording::printable;
use viewcert_advice::export::shell;
use viewcert_advice::merge::{By, MERGER, Merge, Merger};
use viewcert_advice::misfit::{Misfit, OFF, TURNED};
use viewcert_formats::NamedGraph;

/// What an answer by tracks rests on.
const BY_TRACKS: &str =
    "if every pair is right, its rotation included, and places are in general position";

/// Why points are not compared.
const OTHER_FEATURES: &str =
    "points are not compared: images of both have other features here and there";

/// Two models, and what was found about them.
pub struct MergeReport<'a> {
    /// The folders of the models.
    pub models: [String; 2],
    /// The camera-point graph of their database.
    pub tracks: Option<&'a NamedGraph>,
    /// What was found.
    pub merge: &'a Merge,
    /// How long it took.
    pub time: Duration,
}

impl MergeReport<'_> {
    /// Writes some lines for people.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let merge = self.merge;
        writeln!(out, "{} and {}", self.models[0], self.models[1])?;
        for (k, model) in self.models.iter().enumerate() {
            let images = counted(merge.images[k], "image");
            let points = counted(merge.points[k], "point");
            let words = format!("{model}: {images}, {points}");
            row(out, &format!("model {}", k + 1), words)?;
        }
        if let Some(input) = self.tracks {
            row(out, "tracks", format!("of {}", printable(&input.name)))?;
            notes(out, &input.notes)?;
        }
        let shown = some_names(&merge.shared_images);
        let colon = if shown.is_empty() { "" } else { ": " };
        let images = counted(merge.shared_images.len(), "image");
        row(out, "shared", images + colon + &shown)?;
        let points = match merge.shared_points {
            Some(points) => counted(points, "point"),
            None => OTHER_FEATURES.to_owned(),
        };
        row(out, "", points)?;
        row(out, "fixed", self.answer())?;
        if !merge.is_determined() {
            row(out, "free", merge.free())?;
        }
        if let Some(misfit) = &merge.misfit {
            row(out, "misfit", fit(misfit))?;
            for one in misfit.disagree.iter().take(SHOWN) {
                let (image, off, turned) = (&one.image, one.off, one.turned);
                let words = format!("{off:.4} of the spread off, turned by {turned:.4} degrees");
                writeln!(out, "    {image}: {words}")?;
            }
            rest(out, misfit.disagree.len(), "--json lists them")?;
        }
        row(out, "merger", self.merger())?;
        let (command, purpose) = self.next();
        row(out, "next", format!("{purpose}:\n    {command}"))?;
        time(out, self.time)
    }

    /// The answer in a line.
    fn answer(&self) -> String {
        let merge = self.merge;
        let places = match merge.shared_images.len() > 1 && merge.shared_places == 1 {
            true => ": the images in both are at one place",
            false => "",
        };
        match (merge.is_determined(), merge.agree()) {
            (true, true) => format!(
                "yes: rotation, translation and scale are determined {}",
                self.condition().unwrap_or_default()
            ),
            (true, false) => {
                "no: the models share enough, but what they share contradicts them".to_owned()
            }
            (false, true) => format!("no{places}"),
            (false, false) => "no, and what the models share contradicts them".to_owned(),
        }
    }

    /// What a good answer rests on.
    fn condition(&self) -> Option<&'static str> {
        let condition = match self.merge.by {
            By::Tracks => BY_TRACKS,
            By::Models | By::Points => condition::RIGHT,
        };
        self.merge.is_good().then_some(condition)
    }

    /// What COLMAP's own command does with it.
    fn merger(&self) -> String {
        let shared = self.merge.shared_images.len();
        let needs = format!("needs {MERGER} images in both");
        match &self.merge.merger {
            Merger::Works => format!("colmap model_merger {needs} and finds {shared}"),
            Merger::OnePlace => format!(
                "colmap model_merger {needs} and finds {shared}, all at one place: it would make up the scale"
            ),
            Merger::TooFew(useful) => format!(
                "colmap model_merger refuses: it {needs} that see a point in both, and finds {useful}"
            ),
            Merger::Other(image) => format!(
                "colmap model_merger aborts: image {image} has another number, or other features, in the other \
                 model; it merges models of one database"
            ),
        }
    }

    /// The command that leads on, and what for.
    fn next(&self) -> (String, &'static str) {
        let merge = self.merge;
        let [one, other] = self.models.each_ref().map(|model| shell(model));
        let database = self.tracks.map(|input| shell(&input.name));
        if !merge.agree() {
            return (
                format!("verify split {one} parts"),
                "one model is wrong, or both; see whether its own tracks hold each together",
            );
        }
        match (database, &merge.misfit) {
            (None, _) if !merge.is_determined() => (
                format!("verify merge {one} {other} database.db"),
                "name the database of both models: its tracks may fix more",
            ),
            (Some(database), _) if !merge.is_determined() => (
                format!("verify advise --tracks {database}"),
                "see what to match: a pair between the two models would join them",
            ),
            (_, Some(misfit)) if merge.merger != Merger::Works => (
                format!(
                    "python3 -c {}",
                    shell(&transformed(&self.models[0], misfit))
                ),
                "pycolmap writes model 1 in the frame of model 2",
            ),
            (Some(database), None) if merge.merger != Merger::Works => (
                format!("verify export {database} parts"),
                "map again: the tracks hold the images of both together, and the models show too little of it",
            ),
            _ => (
                format!(
                    "mkdir -p merged && colmap model_merger --input_path1 {one} --input_path2 {other} \
                     --output_path merged"
                ),
                "merge them, and adjust the result (colmap bundle_adjuster)",
            ),
        }
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let (command, purpose) = self.next();
        let line = present(json!({
            "models": self.models,
            "graph": self.tracks.map(GraphLine::of),
            "read": self.tracks.map(|input| &input.read),
            "notes": self.tracks.map_or(&[][..], |input| &input.notes),
            "determined": self.merge.is_determined(),
            "free": self.merge.free(),
            "condition": self.condition(),
            "model_merger": matches!(self.merge.merger, Merger::Works | Merger::OnePlace),
            "merger": self.merger(),
            "next": [{ "command": command, "purpose": purpose }],
            "seconds": self.time.as_secs_f64(),
        }));
        let seed = self.tracks.map(|_| Options::default().seed);
        write_line(out, "merge", seed, &joined(line, self.merge))
    }
}

/// How well two models fit, in words.
fn fit(misfit: &Misfit) -> String {
    let (images, points) = (misfit.disagree.len(), misfit.points_disagree);
    let both = [
        ("image", misfit.images, images, misfit.images_off),
        ("point", misfit.points, points, misfit.points_off),
    ];
    let both = both.into_iter().filter(|(_, count, ..)| *count > 0);
    let both = both.map(|(what, count, bad, off)| {
        let middle = |off| format!(", the middle one {off:.4} of their spread off");
        let off = off.map_or_else(String::new, middle);
        format!("{bad} of {} disagree{off}", counted(count, what))
    });
    let both: Vec<String> = both.collect();
    let answer = match misfit.agree {
        true => "the models agree",
        false => "the models contradict each other",
    };
    format!(
        "{}\n              {answer} (measured, not proved; more than {OFF} of the spread or {TURNED} degrees is a \
         disagreement)",
        both.join("; ")
    )
}

/// A script that brings the first model into the frame of the second.
fn transformed(model: &str, misfit: &Misfit) -> String {
    let by = &misfit.similarity;
    let rows: Vec<String> = (0..3)
        .map(|k| {
            let row = by.rotation[k].map(|x| x * by.scale);
            format!("{:?}", [row[0], row[1], row[2], by.translation[k]])
        })
        .collect();
    format!(
        "import os, pycolmap; model = pycolmap.Reconstruction({}); \
         model.transform(pycolmap.Sim3d([{}])); os.makedirs(\"moved\", exist_ok=True); model.write(\"moved\")",
        viewcert_advice::export::python(model),
        rows.join(", ")
    )
}
