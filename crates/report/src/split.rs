//! What a finished model's observations hold, and the parts that were written, for people and for programs.

use super::json::write_line;
use super::{condition, counted, text};
use crate::shown::{SHOWN, notes, rest, row, some_names, time};
use serde_json::json;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::at_cameras::finished::Held;
use viewcert::wording::printable;
use viewcert_advice::split::{Free, Split};
use viewcert_audit::softness::{ROUNDING, SHARE};
use viewcert_formats::model::Posed;

/// What was found of a model.
pub struct SplitReport<'a> {
    /// The folder of the model.
    pub model: String,
    /// What to know of how it was read.
    pub notes: Vec<String>,
    /// Its numbers, with the points that count.
    pub posed: &'a Posed,
    /// In how many images each is at least.
    pub least: usize,
    /// What the observations hold.
    pub held: &'a Held,
    /// What is free between parts.
    pub free: &'a [Free],
    /// How soft the model is, if it was measured.
    pub softness: Option<f64>,
    /// What was written.
    pub split: &'a Split,
    /// How long it took.
    pub time: Duration,
}

impl SplitReport<'_> {
    /// Whether nothing is free, rounding included.
    pub fn is_whole(&self) -> bool {
        let is_one = self.split.parts.len() == 1 && self.split.outside.is_empty();
        is_one && self.held.freedom.value == 0 && !self.is_soft()
    }

    /// Whether a motion of images changes no observation but by rounding.
    fn is_soft(&self) -> bool {
        self.softness.is_some_and(|pixels| pixels < ROUNDING)
    }

    /// The answer.
    fn answer(&self) -> String {
        let strength = text::strength(self.held.freedom.strength);
        let similarity = match self.held.is_scaled {
            true => "rotation and translation of the whole",
            false => "a similarity of the whole",
        };
        match (self.held.freedom.value, self.is_soft()) {
            (0, false) => format!(
                "fixed: no motion but {similarity} leaves all observations as they are {} ({strength}, intrinsics \
                 known)",
                condition::TRACKS
            ),
            (0, true) => format!(
                "free within rounding: the exact numbers allow no motion but {similarity} ({strength}), and rounding \
                 does (softest)"
            ),
            (count, _) => format!(
                "free: {} of first order beside {similarity}, without a change of any observation ({strength}, intrinsics \
                 known)",
                counted(count, "motion")
            ),
        }
    }

    fn softest(&self) -> String {
        match self.softness {
            Some(pixels) if pixels.is_finite() => format!(
                "{pixels:.1e} pixels (floating point, intrinsics fixed): the largest change of an observation where images \
                 move by {SHARE} of their spread; below {ROUNDING} is rounding"
            ),
            Some(_) => "no motion of images to measure".to_owned(),
            None => "not measured: too many images see points in common".to_owned(),
        }
    }

    /// Writes some lines for people.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let split = self.split;
        writeln!(out, "{}", printable(&self.model))?;
        notes(out, &self.notes)?;
        let points = counted(self.posed.points.len(), "point");
        let observations = counted(self.observations(), "observation");
        let words = format!("{points} in at least {} images: {observations}", self.least);
        row(out, "points", words)?;
        row(out, "images", self.answer())?;
        for free in self.free.iter().take(SHOWN) {
            let [one, other] = free.between;
            let words = format!("parts {one} and {other}: {}", free.meaning);
            row(out, "free", words)?;
        }
        rest(out, self.free.len(), "--json lists them")?;
        row(out, "softest", self.softest())?;
        let models = counted(split.parts.len(), "model");
        row(out, "written", format!("{models} in {}", split.folder))?;
        for part in split.parts.iter().take(SHOWN) {
            let images = counted(part.images.len(), "image");
            let points = counted(part.points, "point");
            let names = some_names(&part.images);
            writeln!(out, "    {}: {points}, {images}: {names}", part.folder)?;
        }
        rest(out, split.parts.len(), "--json lists them")?;
        if split.points_left_out > 0 {
            row(out, "in no part", counted(split.points_left_out, "point"))?;
        }
        if !split.outside.is_empty() {
            row(out, "in no part", some_names(&split.outside))?;
        }
        time(out, self.time)
    }

    fn observations(&self) -> usize {
        self.posed.tracks.iter().map(Vec::len).sum()
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let freedom = self.held.freedom;
        let softest = self.softness.filter(|pixels| pixels.is_finite());
        let line = json!({
            "model": self.model,
            "notes": self.notes,
            "points": self.posed.points.len(),
            "min_views": self.least,
            "observations": self.observations(),
            "images": self.posed.images.len(),
            "freedom": freedom.value,
            "strength": freedom.strength.name(),
            "error_log2": freedom.strength.error_log2(),
            "free": self.free,
            "softest": softest.map(|pixels| json!({ "pixels": pixels, "rounding": self.is_soft() })),
            "split": self.split,
            "whole": self.is_whole(),
            "seconds": self.time.as_secs_f64(),
        });
        write_line(out, "split", None, &line)
    }
}
