//! Two models and what they share, for people and for programs.

use super::json::{GraphLine, joined, present, write_line};
use super::{condition, counted};
use crate::shown::{SHOWN, notes, rest, row, some_names, time};
use serde_json::json;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::wording::printable;
use viewcert_advice::merge::Merge;
use viewcert_advice::misfit::{Misfit, OFF, TURNED};
use viewcert_formats::NamedGraph;

/// Two models, and what was found about them.
pub struct MergeReport<'a> {
    /// The folders of the models.
    pub models: [String; 2],
    /// The pairs of their database.
    pub input: Option<&'a NamedGraph>,
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
        if let Some(input) = self.input {
            row(out, "tracks", format!("of {}", printable(&input.name)))?;
            notes(out, &input.notes)?;
        }
        let images = counted(merge.shared_images.len(), "image");
        let points = counted(merge.shared_points, "point");
        let places = counted(merge.shared_places, "place");
        row(out, "shared", format!("{images} at {places}, {points}"))?;
        row(out, "images", some_names(&merge.shared_images))?;
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
        row(out, "next", self.next())?;
        time(out, self.time)
    }

    /// The answer in a line.
    fn answer(&self) -> String {
        let merge = self.merge;
        match (merge.is_determined(), self.condition()) {
            (_, Some(condition)) => {
                format!("yes: rotation, translation and scale are determined {condition}")
            }
            (true, None) => {
                "no: the models share enough, but what they share contradicts them".to_owned()
            }
            (false, None) if merge.agree() => "no".to_owned(),
            (false, None) => "no, and what the models share contradicts them".to_owned(),
        }
    }

    /// What a good answer rests on.
    fn condition(&self) -> Option<&'static str> {
        self.merge.is_good().then_some(condition::RIGHT)
    }

    /// What leads on.
    fn next(&self) -> &'static str {
        match (self.merge.agree(), self.merge.is_determined(), self.input) {
            (false, ..) => {
                "one model is wrong, or both: `verify split MODEL DIR` says whether its own tracks hold it together"
            }
            (_, false, None) => {
                "name the database of both behind the models: its tracks may fix more"
            }
            (_, false, Some(_)) => {
                "match a pair between the two models: `verify advise --tracks DATABASE` names some"
            }
            _ => {
                "merge them by `colmap model_merger`, or bring one to the other by `similarity` of --json \
                 (docs/reconstruction.md)"
            }
        }
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let line = present(json!({
            "models": self.models,
            "graph": self.input.map(GraphLine::of),
            "read": self.input.map(|input| &input.read),
            "notes": self.input.map_or(&[][..], |input| &input.notes),
            "determined": self.merge.is_determined(),
            "free": self.merge.free(),
            "condition": self.condition(),
            "seconds": self.time.as_secs_f64(),
        }));
        write_line(out, "merge", None, &joined(line, self.merge))
    }
}

/// How well two models fit, in words.
fn fit(misfit: &Misfit) -> String {
    let of = |what, count, bad: usize, off: Option<f64>| {
        let middle = |off| format!(", the middle one {off:.4} of their spread off");
        let off = off.map_or_else(String::new, middle);
        format!("{bad} of {} disagree{off}", counted(count, what))
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
    let answer = match misfit.agree {
        true => "the models agree",
        false => "the models contradict each other",
    };
    format!(
        "{images}; {points}\n              {answer} (measured, not proved; more than {OFF} of the spread or {TURNED} \
         degrees is a disagreement)"
    )
}
