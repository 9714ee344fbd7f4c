//! Two models and what they share, for people and for programs.

use super::json::{GraphLine, write_line};
use super::read::ReadLine;
use super::{counted, text};
use crate::advice::suggestions as write_suggestions;
use crate::condition::RIGHT;
use crate::shown::{SHOWN, rest, some_names};
use serde::Serialize;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::Verdict;
use viewcert::wording::printable;
use viewcert_advice::export::shell;
use viewcert_advice::merge::{MERGER, Merge, Merger};
use viewcert_advice::misfit::{Misfit, OFF, TURNED};
use viewcert_formats::NamedGraph;

/// Two models, and what was found about them.
pub struct MergeReport<'a> {
    /// The folders of the models.
    pub models: [String; 2],
    /// The camera-point graph of their database, and the verdict with both models as known parts.
    pub tracks: Option<(&'a NamedGraph, &'a Verdict)>,
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
            writeln!(out, "  model {}     {model}: {images}, {points}", k + 1)?;
        }
        if let Some((input, _)) = self.tracks {
            writeln!(out, "  tracks      of {}", printable(&input.name))?;
            for note in &input.notes {
                writeln!(out, "  note        {note}")?;
            }
        }
        let shown = some_names(&merge.shared_images);
        let colon = if shown.is_empty() { "" } else { ": " };
        let images = counted(merge.shared_images.len(), "image");
        writeln!(out, "  shared      {images}{colon}{shown}")?;
        match merge.shared_points {
            Some(points) => writeln!(out, "              {}", counted(points, "point"))?,
            None => writeln!(
                out,
                "              points are not compared: images of both have other features here and \
                 there"
            )?,
        }
        writeln!(out, "  fixed       {}", self.answer())?;
        if !merge.determined {
            writeln!(out, "  free        {}", merge.free)?;
        }
        writeln!(out, "  because     {}", self.because())?;
        if let Some(misfit) = &merge.misfit {
            writeln!(out, "  misfit      {}", fit(misfit))?;
            for one in misfit.disagree.iter().take(SHOWN) {
                let (off, turned) = (short(one.off), short(one.turned));
                writeln!(
                    out,
                    "    {}: {off} of the spread off, turned by {turned} degrees",
                    one.image
                )?;
            }
            rest(out, misfit.disagree.len(), "--json lists them")?;
        }
        writeln!(out, "  merger      {}", self.merger())?;
        if let Some(found) = merge.suggestions.as_ref().filter(|_| !merge.determined) {
            match found.len() {
                0 => writeln!(out, "  suggested   none found")?,
                count => writeln!(
                    out,
                    "  suggested   {count} (if these images really overlap, matching them joins the two: proved)"
                )?,
            }
            write_suggestions(out, found)?;
        }
        let (command, purpose) = self.next();
        writeln!(out, "  next        {purpose}:")?;
        writeln!(out, "    {command}")?;
        writeln!(
            out,
            "  time        {}",
            text::seconds(self.time.as_micros())
        )
    }

    /// The answer in a line.
    fn answer(&self) -> String {
        let answer = match (self.merge.determined, self.merge.agree()) {
            (true, true) => "yes: rotation, translation and scale are determined ",
            (true, false) => "no: the models share enough, but what they share contradicts them",
            (false, true) => "no",
            (false, false) => "no, and what the models share contradicts them",
        };
        answer.to_owned() + self.condition().unwrap_or_default()
    }

    /// What a good answer rests on.
    fn condition(&self) -> Option<&'static str> {
        (self.merge.determined && self.merge.agree()).then_some(RIGHT)
    }

    /// What the answer rests on.
    fn because(&self) -> String {
        let merge = self.merge;
        let images = merge.shared_places;
        let because = match (merge.by, merge.determined) {
            ("tracks", true) => {
                "with both models known, the tracks of the database leave nothing free between them"
            }
            ("tracks", false) => {
                "with both models known, the tracks of the database do not make them one"
            }
            (_, true) if images > 1 => {
                "an image in both fixes the rotation, and two places in both the translation and the \
                 scale"
            }
            (_, true) if merge.scaled == [true, true] => {
                "the place in both fixes rotation and translation, and the base lines of rigs in both the \
                 scale"
            }
            (_, true) => {
                "the image in both fixes rotation and translation, and how far the points in both \
                 are from it the scale"
            }
            (_, false) if images == 0 => "nothing is in both",
            (_, false) if merge.shared_images.len() > 1 => {
                "the images in both are at one place: they fix rotation and translation, and say nothing \
                 about scale"
            }
            (_, false) => {
                "the image in both fixes rotation and translation; one place in both says nothing about \
                 scale"
            }
        };
        because.to_owned()
    }

    /// What COLMAP's own command does with it.
    fn merger(&self) -> String {
        let shared = self.merge.shared_images.len();
        let here_and_there = |what: &str, [one, other]: [String; 2]| {
            format!(
                "colmap model_merger aborts: image {what} has {one} in model 1 and {other} in model 2; it \
                 merges models of one database"
            )
        };
        match &self.merge.merger {
            Merger::Works => {
                format!("colmap model_merger needs {MERGER} images in both and finds {shared}")
            }
            Merger::OnePlace => format!(
                "colmap model_merger needs {MERGER} images in both and finds {shared}, all at one place: it would \
                 make up the scale"
            ),
            Merger::TooFew(useful) if *useful < shared => format!(
                "colmap model_merger refuses: it needs {MERGER} images in both that see a point in both, and \
                 finds {useful}"
            ),
            Merger::TooFew(_) => format!(
                "colmap model_merger refuses: it needs {MERGER} images in both and finds {shared}{}",
                if self.merge.determined {
                    ", though less is enough"
                } else {
                    ""
                }
            ),
            Merger::OtherNumbers(image, ids) => {
                here_and_there(image, ids.map(|id| format!("the number {id}")))
            }
            Merger::OtherFeatures(image, counts) => {
                here_and_there(image, counts.map(|count| counted(count, "feature")))
            }
            Merger::OtherNames(number, [one, other]) => format!(
                "colmap model_merger refuses: image number {number} is {one} in model 1 and {other} in \
                 model 2; it merges models of one database"
            ),
        }
    }

    /// The command that leads on, and what for.
    fn next(&self) -> (String, String) {
        let merge = self.merge;
        let [one, other] = self.models.each_ref().map(|model| shell(model));
        let database = self.tracks.map(|(input, _)| shell(&input.name));
        let said = |command: String, purpose: &str| (command, purpose.to_owned());
        let suggested = merge.suggestions.iter().flatten().next();
        let pairs = suggested
            .filter(|_| !merge.determined)
            .map(|one| &one.pairs);
        if !merge.agree() {
            return said(
                format!("verify split {one} parts"),
                "one model is wrong, or both; see whether its own tracks hold each together",
            );
        }
        match (database, pairs, &merge.misfit) {
            (None, ..) if !merge.determined => said(
                format!("verify merge {one} {other} database.db"),
                "name the database of both models: its tracks may fix more, and say what to match",
            ),
            (Some(database), Some(pairs), _) if is_listed(pairs) => {
                let lines = pairs.iter().map(|[a, b]| shell(&format!("{a} {b}")));
                let lines: Vec<String> = lines.collect();
                said(
                    format!(
                        "printf '%s\\n' {} > pairs.txt && colmap matches_importer --database_path {database} \
                         --match_list_path pairs.txt --match_type pairs",
                        lines.join(" ")
                    ),
                    "match the first suggestion if its images overlap, and map again",
                )
            }
            (Some(database), ..) if !merge.determined => said(
                format!("verify advise --tracks {database}"),
                "see which parts there are; a photograph between the two models would join them",
            ),
            (_, _, Some(misfit)) if merge.merger != Merger::Works => said(
                format!(
                    "python3 -c {}",
                    shell(&transformed(&self.models[0], misfit))
                ),
                "pycolmap writes model 1 in the frame of model 2",
            ),
            (Some(database), ..) if merge.merger != Merger::Works => said(
                format!("verify export {database} parts"),
                "map again: the tracks hold the images of both together, and the models show too little of it",
            ),
            _ => said(
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
        let line = Line {
            models: &self.models,
            graph: self
                .tracks
                .map(|(input, verdict)| GraphLine::new(input, verdict)),
            read: self.tracks.map(|(input, _)| ReadLine::from(&input.read)),
            notes: self.tracks.map_or(&[][..], |(input, _)| &input.notes),
            merge: self.merge,
            condition: self.condition(),
            merger: self.merger(),
            because: self.because(),
            next: [Next { command, purpose }],
            seconds: self.time.as_secs_f64(),
        };
        let seed = self.tracks.map(|(_, verdict)| verdict.seed);
        write_line(out, "merge", seed, &line)
    }
}

/// How well two models fit, in words.
fn fit(misfit: &Misfit) -> String {
    let of = |what: &str, count: usize, bad: usize, off: Option<f64>| {
        let off = off.map_or(String::new(), |off| {
            format!(", the middle one {} of their spread off", short(off))
        });
        (count > 0).then(|| format!("{bad} of {} disagree{off}", counted(count, what)))
    };
    let images = of(
        "image",
        misfit.images,
        misfit.disagree.len(),
        misfit.images_off,
    );
    let points = of(
        "point",
        misfit.points,
        misfit.points_disagree,
        misfit.points_off,
    );
    let both: Vec<String> = images.into_iter().chain(points).collect();
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

/// A number with two digits that count.
fn short(number: f64) -> String {
    match number {
        number if number < 1e-4 => "0.0000".to_owned(),
        number if number < 0.1 => format!("{number:.4}"),
        number => format!("{number:.2}"),
    }
}

/// Whether a list of pairs can hold these names.
fn is_listed(pairs: &[[String; 2]]) -> bool {
    let mut names = pairs.iter().flatten();
    names.all(|name| !name.contains(char::is_whitespace) && !name.starts_with('#'))
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

#[derive(Serialize)]
struct Next {
    command: String,
    purpose: String,
}

#[derive(Serialize)]
struct Line<'a> {
    models: &'a [String; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    graph: Option<GraphLine<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    read: Option<ReadLine<'a>>,
    notes: &'a [String],
    #[serde(flatten)]
    merge: &'a Merge,
    #[serde(skip_serializing_if = "Option::is_none")]
    condition: Option<&'static str>,
    merger: String,
    because: String,
    next: [Next; 1],
    seconds: f64,
}
