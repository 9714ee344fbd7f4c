//! Two models and what they share, for people and for programs.

use super::json::{joined, present, write_line};
use super::{condition, counted};
use crate::shown::{SHOWN, rest, row, some_names, time};
use serde_json::json;
use std::io::{self, Write};
use std::time::Duration;
use viewcert_advice::merge::Merge;
use viewcert_advice::misfit::{Misfit, OFF, TURNED};

/// Two models, and what was found about them.
pub struct MergeReport<'a> {
    /// The folders of the models.
    pub models: [String; 2],
    /// Whether the tracks of their database count.
    pub has_database: bool,
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
        let right = condition::RIGHT;
        let words = match (self.merge.is_determined(), self.merge.agree()) {
            (true, true) => &format!("yes: rotation, translation and scale are determined {right}"),
            (true, false) => "no: the models share enough, but what they share contradicts them",
            (false, true) => "no",
            (false, false) => "no, and what the models share contradicts them",
        };
        words.to_owned()
    }

    /// What leads on.
    fn next(&self) -> &'static str {
        let merge = self.merge;
        match (merge.agree(), merge.is_determined(), self.has_database) {
            (false, ..) => {
                "one model is wrong, or both: `verify split MODEL DIR` says whether its own tracks hold it together"
            }
            (_, false, false) => {
                "name the database of both behind the models: its tracks may fix more"
            }
            (_, false, true) => {
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
            "determined": self.merge.is_determined(),
            "free": self.merge.free(),
            "condition": self.merge.is_good().then_some(condition::RIGHT),
            "seconds": self.time.as_secs_f64(),
        }));
        write_line(out, "merge", None, &joined(line, self.merge))
    }
}

/// How well two models fit, in words.
fn fit(misfit: &Misfit) -> String {
    let [images, points] = [(misfit.images, "image"), (misfit.points, "point")];
    let [images, points] = [images, points].map(|(count, what)| counted(count, what));
    let (bad, bad_points) = (misfit.disagree.len(), misfit.points_disagree);
    let answer = match misfit.agree {
        true => "the models agree",
        false => "the models contradict each other",
    };
    format!(
        "{bad} of {images} disagree; {bad_points} of {points} disagree\n              {answer} (measured, not proved; more than {OFF} of the spread or {TURNED} \
         degrees is a disagreement)"
    )
}
