//! Which cameras to calibrate, in words and JSON (docs/theory.md, Corollary 17.18).
//!
//! In: what one prior more would do. Out: lines of a report, the member `priors` of `intrinsics`.

use super::counted;
use crate::shown::row;
use serde::Serialize;
use std::borrow::Cow;
use std::io::{self, Write};
use viewcert::intrinsics::{Class, Metric, Prior, Sensors};
use viewcert_advice::priors::Priors;
use viewcert_formats::NamedGraph;

/// The member `priors`.
#[derive(Clone, Debug, Serialize)]
pub struct PriorsLine {
    /// How many sensors are not determined and have a pair.
    sensors: usize,
    /// How many of them are as good as the first.
    best: usize,
    /// What the graph is if all intrinsics are known.
    if_all_known: &'static str,
    /// What one of them does, the best first.
    each: Vec<PriorLine>,
    /// Whether all cameras are determined already, and whether their intrinsics are.
    #[serde(skip)]
    is_done: [bool; 2],
    /// How many cameras there are.
    #[serde(skip)]
    of: usize,
    /// How many cameras the largest metric component has without any.
    #[serde(skip)]
    largest: usize,
}

/// What is determined once the intrinsics of a sensor are known.
#[derive(Clone, Debug, Serialize)]
struct PriorLine {
    class: &'static str,
    /// The cameras that are one sensor.
    labels: Vec<String>,
    verdict: &'static str,
    proved: bool,
    rank: usize,
    rank_at_most: usize,
    rank_required: usize,
    /// How many cameras have intrinsics that are known or determined then.
    determined: usize,
    /// How many of them are determined by it, and are not its own.
    others: usize,
    /// How many cameras the largest metric component has.
    largest: usize,
    #[serde(skip)]
    what: &'static str,
}

impl PriorLine {
    fn new(input: &NamedGraph, sensors: &Sensors, found: &Metric, prior: &Prior) -> Self {
        let class = sensors.class(prior.sensor);
        let before = found.determined.iter().filter(|&&is| is).count();
        let labels = prior.nodes.iter().map(|&v| input.labels.label(v));
        Self {
            class: class.word(),
            labels: labels.map(Cow::into_owned).collect(),
            verdict: prior.verdict(),
            proved: prior.is_proved(),
            rank: prior.rank,
            rank_at_most: prior.at_most,
            rank_required: prior.required,
            determined: prior.determined,
            others: prior.determined.saturating_sub(before + prior.nodes.len()),
            largest: prior.largest,
            what: match class {
                Class::Known => "nothing",
                Class::Focal => "the focal length",
                Class::FocalAndPoint => "focal length and principal point",
                Class::Unknown => "all five intrinsics",
            },
        }
    }

    /// Which of the intrinsics of which cameras: "the focal length of a .. c (one sensor, 3 images)".
    fn whose(&self) -> String {
        let of = match &self.labels[..] {
            [only] => only.clone(),
            [first, .., last] => {
                let images = counted(self.labels.len(), "image");
                format!("{first} .. {last} (one sensor, {images})")
            }
            [] => String::new(),
        };
        format!("{} of {of}", self.what)
    }
}

impl PriorsLine {
    /// So many at most, the best first. O(n) for each.
    pub fn new(
        input: &NamedGraph,
        sensors: &Sensors,
        found: &Metric,
        priors: &Priors,
        most: usize,
    ) -> Self {
        let each = priors.each.iter().take(most);
        Self {
            sensors: priors.each.len(),
            best: priors.best(),
            if_all_known: priors.if_all_known,
            each: each
                .map(|prior| PriorLine::new(input, sensors, found, prior))
                .collect(),
            is_done: [
                found.is_metric(),
                found.determined.iter().all(|&is| is) && found.is_proved(),
            ],
            of: sensors.nodes(),
            largest: found.components.first().map_or(0, |part| part.nodes.len()),
        }
    }

    /// Writes the lines of a report.
    ///
    /// # Errors
    /// Those of the writer.
    pub(crate) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let nothing = match self.is_done {
            [true, _] => Some("the graph is metric"),
            [_, true] => Some("all intrinsics are determined"),
            _ if self.each.is_empty() => Some("cameras that are not determined have no pairs"),
            _ => None,
        };
        if let Some(why) = nothing {
            row(out, "suggested", format!("nothing to calibrate: {why}"))?;
            return match self.is_done[0] {
                true => Ok(()),
                false => self.write_limit(out),
            };
        }
        let count = match self.sensors {
            1 => "the only sensor that is not determined".to_owned(),
            count => format!(
                "the best of {count} sensors that are not determined; {} as good as the first",
                match self.best {
                    1 => "none is".to_owned(),
                    2 => "1 other is".to_owned(),
                    best => format!("{} others are", best - 1),
                }
            ),
        };
        writeln!(out, "  suggested   to calibrate one more ({count}):")?;
        for line in &self.each {
            writeln!(out, "    {}: {}", line.whose(), self.effect(line))?;
        }
        let helps = |line: &PriorLine| line.others > 0 || line.largest > self.largest;
        if !self.each.iter().any(helps) && self.if_all_known == "metric" {
            let words = "none alone determines anything else: it takes several";
            writeln!(out, "    {words}")?;
        }
        self.write_limit(out)
    }

    /// What one prior does, in words.
    fn effect(&self, line: &PriorLine) -> String {
        let (least, most) = (line.rank, line.rank_at_most);
        let strength = match line.proved {
            true => "proved".to_owned(),
            false => format!("the rank is {least} at least and {most} at most"),
        };
        if line.verdict == "metric" {
            return "metric, all cameras and intrinsics (proved)".to_owned();
        }
        let part = match line.largest {
            0 => "no metric part".to_owned(),
            cameras => format!("the largest metric part has {}", counted(cameras, "camera")),
        };
        format!(
            "{} besides its own, the intrinsics of {} of {} then; {part} ({strength})",
            match line.others {
                0 => "nothing".to_owned(),
                others => format!("those of {}", counted(others, "camera")),
            },
            line.determined,
            counted(self.of, "camera"),
        )
    }

    /// That no number of priors is enough, if it is not.
    fn write_limit(&self, out: &mut impl Write) -> io::Result<()> {
        match self.if_all_known {
            "not-metric" => writeln!(
                out,
                "    with all intrinsics known it is not metric either (proved): pairs are missing; \
                 verify advise with --model calibrated says which"
            ),
            _ => Ok(()),
        }
    }
}
