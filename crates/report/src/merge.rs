//! Two models and what they share, for people and for programs.

use super::json::{GraphLine, write_line};
use super::{counted, text};
use crate::advice::suggestions as write_suggestions;
use serde::Serialize;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::Verdict;
use viewcert_advice::merge::{MERGER, Merge};
use viewcert_formats::NamedGraph;

/// Most names that are shown.
const SHOWN: usize = 8;

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
            writeln!(out, "  tracks      of {}", input.name)?;
            for note in &input.notes {
                writeln!(out, "  note        {note}")?;
            }
        }
        let shown = merge.shared_images.iter().take(SHOWN).cloned();
        let mut shown: Vec<String> = shown.collect();
        if merge.shared_images.len() > SHOWN {
            shown.push(format!("and {} more", merge.shared_images.len() - SHOWN));
        }
        let colon = if shown.is_empty() { "" } else { ": " };
        let images = counted(merge.shared_images.len(), "image");
        writeln!(out, "  shared      {images}{colon}{}", shown.join(", "))?;
        match merge.shared_points {
            Some(points) => writeln!(out, "              {}", counted(points, "point"))?,
            None => writeln!(
                out,
                "              points are not compared: images of both have other features here and \
                 there"
            )?,
        }
        let answer = if merge.determined {
            "yes: rotation, translation and scale are determined"
        } else {
            "no"
        };
        writeln!(out, "  fixed       {answer}")?;
        if !merge.determined {
            writeln!(out, "  free        {}", merge.free)?;
        }
        writeln!(out, "  because     {}", self.because())?;
        writeln!(out, "  merger      {}", self.merger())?;
        match &merge.suggestions {
            _ if merge.determined => (),
            Some(found) if found.is_empty() => writeln!(
                out,
                "  suggested   none found: match images of the one with images of the other, and verify \
                 them"
            )?,
            Some(found) => {
                let count = found.len();
                writeln!(
                    out,
                    "  suggested   {count} (proved: these would join the two)"
                )?;
                write_suggestions(out, found)?;
            }
            None => writeln!(
                out,
                "  next        name the database of both models as well: what to match is found there"
            )?,
        }
        writeln!(
            out,
            "  time        {}",
            text::seconds(self.time.as_micros())
        )
    }

    /// What the answer rests on.
    fn because(&self) -> String {
        let merge = self.merge;
        let images = merge.shared_places;
        match (merge.by, merge.determined) {
            ("tracks", true) => {
                "with both models known, the tracks of the database leave nothing free between them".into()
            }
            ("tracks", false) => {
                "with both models known, the tracks of the database do not make them one".into()
            }
            (_, true) if images > 1 => {
                "an image in both fixes the rotation, and two places in both the translation and the \
                 scale"
                    .into()
            }
            (_, true) if merge.scaled == [true, true] => {
                "the place in both fixes rotation and translation, and the base lines of rigs in both the \
                 scale"
                    .into()
            }
            (_, true) => "the image in both fixes rotation and translation, and how far the points in both \
                          are from it the scale"
                .into(),
            (_, false) if images == 0 => "nothing is in both".into(),
            (_, false) if merge.shared_images.len() > 1 => {
                "the images in both are of one frame and at one place: they fix rotation and translation, and \
                 say nothing about scale"
                    .into()
            }
            (_, false) => {
                "the image in both fixes rotation and translation; one place in both says nothing about \
                 scale"
                    .into()
            }
        }
    }

    /// What COLMAP's own command does with it.
    fn merger(&self) -> String {
        let shared = self.merge.shared_images.len();
        match (self.merge.model_merger, self.merge.determined) {
            (true, false) if self.merge.shared_places < 2 => format!(
                "colmap model_merger needs {MERGER} images in both and finds {shared}, all at one place: it would \
                 make up the scale"
            ),
            (true, _) => {
                format!("colmap model_merger needs {MERGER} images in both and finds {shared}")
            }
            (false, true) => format!(
                "colmap model_merger refuses: it needs {MERGER} images in both and finds {shared}, though \
                 less is enough"
            ),
            (false, false) => {
                format!(
                    "colmap model_merger refuses: it needs {MERGER} images in both and finds {shared}"
                )
            }
        }
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let line = Line {
            models: &self.models,
            graph: self
                .tracks
                .map(|(input, verdict)| GraphLine::new(input, verdict)),
            notes: self.tracks.map_or(&[][..], |(input, _)| &input.notes),
            merge: self.merge,
            because: self.because(),
            seconds: self.time.as_secs_f64(),
        };
        write_line(out, &line)
    }
}

#[derive(Serialize)]
struct Line<'a> {
    models: &'a [String; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    graph: Option<GraphLine<'a>>,
    notes: &'a [String],
    #[serde(flatten)]
    merge: &'a Merge,
    because: String,
    seconds: f64,
}
