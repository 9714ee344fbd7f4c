//! A model that was taken apart, for people and for programs.

use super::json::{AnswerLine, GraphLine, write_line};
use super::read::ReadLine;
use super::tracks::{self, TrackLine};
use super::{Report, condition, counted, text};
use crate::advice::joints as write_joints;
use crate::assumptions::BaseLines;
use crate::page::{self, Foreword};
use crate::scene::Scene;
use crate::shown::{SHOWN, some_names};
use serde::Serialize;
use std::io::{self, Write};
use viewcert::wording::printable;
use viewcert_advice::Advice;
use viewcert_advice::split::{PAGE, Piece, Split};

/// The verdict on a model's tracks, and the parts that were written.
pub struct SplitReport<'a> {
    /// The verdict on the camera-point graph.
    pub report: Report<'a>,
    /// What was written.
    pub split: &'a Split,
}

impl SplitReport<'_> {
    /// Whether the model is one part that has all of its images.
    pub fn is_whole(&self) -> bool {
        self.split.parts.len() == 1 && self.split.outside.is_empty()
    }

    /// Writes some lines for people.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let (report, split) = (&self.report, self.split);
        writeln!(out, "{}", printable(&report.input.name))?;
        writeln!(out, "  read as     {}", report.input.read)?;
        for note in &report.input.notes {
            writeln!(out, "  note        {note}")?;
        }
        if let Some(facts) = &report.input.tracks {
            tracks::write_size(out, facts)?;
        }
        writeln!(out, "  positions   {}", text::answer(report))?;
        if let Some(found) = report.scope.base_lines() {
            writeln!(out, "  base lines  {}", found.words())?;
        }
        let count = counted(split.parts.len(), "model");
        writeln!(out, "  written     {count} in {}", split.folder)?;
        for part in split.parts.iter().take(SHOWN) {
            writeln!(out, "    {}", self.piece(part))?;
        }
        if let Some(more) = split.parts.len().checked_sub(SHOWN + 1) {
            writeln!(out, "    and {} more (parts.tsv)", more + 1)?;
        }
        write_joints(out, report.advice)?;
        for shared in split.shared.iter().take(SHOWN) {
            let components = shared.components.iter().map(ToString::to_string);
            let components: Vec<String> = components.collect();
            writeln!(
                out,
                "  hinge       {} is in {}",
                shared.image,
                components.join(", ")
            )?;
        }
        if let Some(more) = split.shared.len().checked_sub(SHOWN + 1) {
            writeln!(out, "  hinge       and {} more (parts.tsv)", more + 1)?;
        }
        if !split.outside.is_empty() {
            writeln!(out, "  in no part  {}", some_names(&split.outside))?;
        }
        if split.points_cut + split.points_left_out > 0 {
            writeln!(
                out,
                "  points      {} without all views, {} in no part",
                split.points_cut, split.points_left_out
            )?;
        }
        writeln!(out, "  because     {}", self.why())?;
        writeln!(out, "  page        {}/{PAGE}", split.folder)?;
        writeln!(
            out,
            "  time        {}",
            text::seconds(report.time.as_micros())
        )
    }

    /// Whether base lines that frames share make one part of what tracks alone do not hold together.
    fn by_frames(&self) -> bool {
        let found = self.report.scope.base_lines();
        found.is_some_and(BaseLines::is_determined)
    }

    fn piece(&self, part: &Piece) -> String {
        let ends = match (part.images.first(), part.images.last()) {
            (Some(first), Some(last)) => format!("{first} to {last}"),
            _ => String::new(),
        };
        format!(
            "{}: {}, {} ({ends})",
            part.folder,
            counted(part.images.len(), "image"),
            counted(part.points, "point"),
        )
    }

    /// Why there are so many parts.
    pub fn why(&self) -> String {
        let all = counted(self.split.image_count(), "image");
        let right = condition::of(self.report.input);
        let without = match self.split.outside.len() {
            0 => String::new(),
            count => format!(
                "; the tracks do not hold {} to any of it",
                counted(count, "image")
            ),
        };
        match self.split.parts.len() {
            0 => "the tracks determine no two images against each other".to_owned(),
            1 if self.by_frames() => format!(
                "the tracks determine all {all} against each other {right}, as frames share their base \
                 lines: there is one part"
            ),
            1 if without.is_empty() => {
                format!(
                    "the tracks determine all {all} against each other {right}: there is one part"
                )
            }
            1 => format!("the tracks determine one part {right}{without}"),
            count => format!(
                "the tracks determine {count} parts, each in itself {right}, and leave free how these lie \
                 against each other: how they do in the model rests on no track{without}"
            ),
        }
    }

    /// The page that says what the parts are, and why.
    ///
    /// # Errors
    /// None that a model can cause.
    pub fn page(&self) -> io::Result<Vec<u8>> {
        let mut text = Vec::new();
        self.write(&mut text)?;
        let foreword = Foreword {
            kind: "A model taken apart",
            answer: (capital(&self.why()), self.is_whole()),
            text: &String::from_utf8_lossy(&text),
        };
        let mut page = Vec::new();
        page::write(
            &mut page,
            &self.report,
            &Scene::of(&self.report, &[]),
            Some(&foreword),
        )?;
        Ok(page)
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let report = &self.report;
        let facts = report.input.cameras.zip(report.input.tracks.as_ref());
        let line = Line {
            graph: GraphLine::new(report.input, report.verdict),
            read: ReadLine::from(&report.input.read),
            notes: &report.input.notes,
            tracks: facts.map(|(cameras, facts)| TrackLine::new(cameras, facts)),
            positions: AnswerLine::from(report),
            base_lines: report.scope.base_lines(),
            joints: report.advice,
            split: self.split,
            whole: self.is_whole(),
            why: self.why(),
            seed: report.verdict.seed,
            seconds: report.time.as_secs_f64(),
        };
        write_line(out, "split", &line)
    }
}

/// Words as a sentence.
fn capital(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(char::to_uppercase);
    first
        .into_iter()
        .flatten()
        .chain(letters)
        .chain(['.'])
        .collect()
}

#[derive(Serialize)]
struct Line<'a> {
    graph: GraphLine<'a>,
    read: ReadLine<'a>,
    notes: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    tracks: Option<TrackLine>,
    positions: AnswerLine,
    #[serde(skip_serializing_if = "Option::is_none")]
    base_lines: Option<&'a BaseLines>,
    #[serde(flatten)]
    joints: &'a Advice,
    split: &'a Split,
    whole: bool,
    why: String,
    seed: u64,
    seconds: f64,
}
