//! What contradicts what among measured motions, for people and for programs.

use super::counted;
use super::json::write_line;
use crate::shown::time;
use serde_json::{Value, json};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::wording::printable;
use viewcert_advice::contradictions::{Contradictions, Look, Packing, Terms};
use viewcert_advice::export::{python, shell};
use viewcert_formats::{Motions, Source};

/// What a line about contradictions begins with.
const TITLE: &str = "contradictions  ";

/// Motions, and what was found about them.
pub struct Contradicted {
    /// The input.
    pub path: String,
    /// Its motions.
    pub motions: Motions,
    /// What was found.
    pub found: Contradictions,
    /// How long it took.
    pub time: Duration,
}

impl Contradicted {
    /// What makes the pairs doubtful, if anything contradicts anything.
    pub fn doubt(&self) -> Option<String> {
        let off = self.answer().strip_prefix(TITLE)?.to_owned();
        let rest = [self.look_at(), self.mostly_uncalibrated()];
        let all: Vec<String> = [Some(off)].into_iter().chain(rest).flatten().collect();
        Some(format!("{} (verify contradictions)", all.join("; ")))
    }

    /// That nothing can contradict anything, and why.
    pub(crate) fn unseen(&self) -> Option<String> {
        let why = self.motions.unchecked.keys().map(|why| why.name());
        let why = Vec::from_iter(why).join(", ");
        let is_unseen = self.motions.pairs.is_empty() && !why.is_empty();
        is_unseen.then(|| format!("no pair is checked ({why}): a look-alike cannot show"))
    }

    /// Whether nothing contradicts anything.
    pub fn is_good(&self) -> bool {
        self.found.at_least() == 0
    }

    /// The answer in a line.
    pub fn answer(&self) -> String {
        let (motions, found) = (&self.motions, &self.found);
        let checkable = counted(motions.pairs.len(), "checkable pair");
        let theta = found.packing.terms.theta;
        let mut besides = match found.without_cycle {
            0 => String::new(),
            1 => "; 1 is in no cycle".to_owned(),
            count => format!("; {count} are in no cycle"),
        };
        if !motions.unchecked.is_empty() {
            let why: Vec<&str> = motions.unchecked.keys().map(|why| why.name()).collect();
            let count = motions.unchecked.values().sum::<usize>();
            besides += if besides.is_empty() { "; " } else { ", " };
            besides += &format!("{count} cannot be checked ({})", why.join(", "));
        }
        match found.at_least() {
            0 => {
                let unseen = match motions.pairs.is_empty() {
                    true => "",
                    false => "; look-alikes that agree are not seen",
                };
                format!("no contradiction among {checkable}{besides}{unseen}")
            }
            count => format!(
                "{TITLE}at least {count} of {checkable} {} off by more than {theta} degrees (proved), \
                 at most {} need be{besides}",
                if count == 1 { "is" } else { "are" },
                found.at_most()
            ),
        }
    }

    /// The half sentences about a smaller angle and about directions.
    fn further(&self) -> Option<String> {
        let by = |packing: &Packing| format!("at least {} by more than", packing.at_least());
        let finer = self.found.finer.as_ref().map(|packing| {
            let theta = packing.terms.theta;
            format!(
                "{} {theta} degrees, which right pairs may come close to",
                by(packing)
            )
        });
        let directed = self.found.directed.as_ref().map(|packing| {
            let Terms { theta, phi, .. } = packing.terms;
            format!("{} {theta} degrees or {phi} in direction", by(packing))
        });
        let both: Vec<String> = finer.into_iter().chain(directed).collect();
        (!both.is_empty()).then(|| both.join("; "))
    }

    /// The first line of what follows if neighbours are right.
    fn neighbours(&self) -> Option<String> {
        let found = self.found.neighbours.as_ref()?;
        let others = others(found.packing.at_least());
        if self.motions.source == Source::PoseGraph {
            let Terms {
                theta,
                assumed_within,
                ..
            } = found.packing.terms;
            let within = f64::from(assumed_within) / 1000.0;
            return Some(format!(
                "if each step of the odometry is right within {within} degrees: at least {others} off by more than {theta}"
            ));
        }
        let first = found.first.map(|pair| {
            let inliers = counted(self.motions.pairs[pair as usize].inliers as usize, "inlier");
            format!(", first {} ({inliers})", self.pair(pair))
        });
        let within = match found.window {
            1 => String::new(),
            window => format!(" ({window} files apart at most)"),
        };
        let first = first.unwrap_or_default();
        Some(format!(
            "if neighbours by name{within} are right: at least {others} wrong{first}"
        ))
    }

    /// Which pairs to look at.
    fn look_at(&self) -> Option<String> {
        let pairs = self.found.look_at.iter().map(|look| self.pair(look.pair));
        match &pairs.collect::<Vec<_>>()[..] {
            [one, other] => Some(format!(
                "look at {one} and {other}: one of the two groups is wrong"
            )),
            [one] => Some(format!("look at {one}")),
            _ => None,
        }
    }

    /// What a pair says from both sides.
    fn sides(&self, look: &Look) -> String {
        let theta = self.found.packing.terms.theta;
        let pair = self.pair(look.pair);
        let right = format!("{pair}: if it is right, {} off", others(look.if_right));
        if look.if_off == 0 {
            return right;
        }
        let (far, off) = (3 * theta, others(look.if_off));
        format!("{right}; if it is off by more than {far} degrees, {off} off by more than {theta}")
    }

    /// A pair by its names; without their ending, where all have the same.
    fn pair(&self, pair: u32) -> String {
        let ending = self.ending().unwrap_or_default();
        let names = self.names(pair);
        let names = names.map(|name| printable(name.strip_suffix(&*ending).unwrap_or(&name)));
        names.join("-")
    }

    fn names(&self, pair: u32) -> [Cow<'_, str>; 2] {
        let images = self.motions.pairs[pair as usize].images;
        images.map(|image| self.motions.labels.label(image))
    }

    /// The pairs that are in contradictions.
    pub(crate) fn contradicting(&self) -> Vec<[Cow<'_, str>; 2]> {
        let pairs = self.found.packing.pairs().into_iter();
        pairs.map(|pair| self.names(pair)).collect()
    }

    /// The ending that all names have, with its point.
    fn ending(&self) -> Option<String> {
        let mut names = (0..self.motions.images as u32).map(|v| self.motions.labels.label(v));
        let first = names.next()?;
        let ending = &first[first.rfind('.').filter(|&at| at > 0)?..];
        let is_word = ending.chars().any(char::is_alphabetic);
        (is_word && names.all(|name| name.ends_with(ending))).then(|| ending.to_owned())
    }

    fn uncalibrated(&self) -> usize {
        let pairs = self.motions.pairs.iter();
        pairs
            .filter(|motion| motion.configuration == Some(3))
            .count()
    }

    /// That focal lengths may be wrong, if most pairs are uncalibrated.
    fn mostly_uncalibrated(&self) -> Option<String> {
        let (uncalibrated, all) = (self.uncalibrated(), self.motions.pairs.len());
        (2 * uncalibrated > all).then(|| {
            format!(
                "{uncalibrated} of {all} checkable pairs are uncalibrated (configuration 3): focal lengths may be wrong"
            )
        })
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.motions.either_way {
            notes.push("rotations count in the sense that leaves fewer contradictions".to_owned());
        }
        notes.extend(self.mostly_uncalibrated());
        if !self.is_good() {
            notes.push(
                "off is the motion of a pair: wrong matches do it, and so does a wrong focal length".to_owned(),
            );
        }
        notes
    }

    /// The recipe: the neighbours mapped alone, and two models held against each other.
    fn next(&self) -> Vec<String> {
        if self.is_good() || self.motions.source != Source::Database {
            return Vec::new();
        }
        let window = self
            .found
            .neighbours
            .as_ref()
            .map_or(1, |found| found.window);
        let script = format!(
            "import pycolmap, re, sqlite3; d = sqlite3.connect('neighbours.db'); sqlite3.connect({}).backup(d); \
             number = lambda row: [int(x) if x.isdecimal() else x for x in re.split('([0-9]+)', row[1])]; \
             ids = [i for i, _ in sorted(d.execute('select image_id, name from images'), key=number)]; \
             near = {{2147483647 * min(p) + max(p) for k in range(1, {}) for p in zip(ids, ids[k:])}}; \
             [d.execute('delete from two_view_geometries where pair_id = ?', p) for p in \
             d.execute('select pair_id from two_view_geometries').fetchall() if p[0] not in near]; d.commit(); \
             pycolmap.incremental_mapping('neighbours.db', '.', 'neighbours')",
            python(&self.path),
            window + 1
        );
        vec![
            format!("python3 -c {}", shell(&script)),
            "verify merge sparse/0 neighbours/0".to_owned(),
        ]
    }

    /// Writes some lines for people.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "{}", self.answer())?;
        let lines = [self.further(), self.neighbours(), self.look_at()];
        for line in lines.into_iter().flatten() {
            writeln!(out, "  {line}")?;
        }
        for look in &self.found.look_at {
            writeln!(out, "    {}", self.sides(look))?;
        }
        for note in self.notes() {
            writeln!(out, "  note        {note}")?;
        }
        for (k, command) in self.next().iter().enumerate() {
            if k == 0 {
                let why = "map the neighbours alone, and compare with your model:";
                writeln!(out, "  next        {why}")?;
            }
            writeln!(out, "    {command}")?;
        }
        time(out, self.time)
    }

    /// What is written as JSON.
    pub(crate) fn line(&self) -> Value {
        let (motions, found) = (&self.motions, &self.found);
        let reasons = motions.unchecked.iter();
        let reasons: BTreeMap<_, _> = reasons.map(|(why, count)| (why.name(), count)).collect();
        let finer = found.finer.as_ref();
        let directed = found.directed.as_ref();
        let near = found.neighbours.as_ref();
        let look = |look: &Look| {
            json!({
                "images": self.names(look.pair),
                "inliers": motions.pairs[look.pair as usize].inliers,
                "if_right": look.if_right,
                "if_off": look.if_off,
            })
        };
        json!({
            "answer": self.answer(),
            "angle": found.packing.terms.theta,
            "at_least": found.at_least(),
            "at_most": found.at_most(),
            "checkable": motions.pairs.len(),
            "unchecked": motions.unchecked.values().sum::<usize>(),
            "reasons": reasons,
            "without_cycle": found.without_cycle,
            "uncalibrated": self.uncalibrated(),
            "finer": finer.map(|finer| json!({ "angle": finer.terms.theta, "at_least": finer.at_least() })),
            "directed": directed.map(|more| json!({ "angle": more.terms.phi, "at_least": more.at_least() })),
            "neighbours": near.map(|near| json!({
                "window": near.window,
                "within": f64::from(near.packing.terms.assumed_within) / 1000.0,
                "at_least": near.packing.at_least(),
                "first": near.first.map(|pair| self.names(pair)),
            })),
            "look_at": found.look_at.iter().map(look).collect::<Value>(),
            "contradicting": self.contradicting(),
        })
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let mut line = self.line();
        line["input"] = json!(self.path);
        line["notes"] = json!(self.notes());
        line["next"] = json!(self.next());
        line["seconds"] = json!(self.time.as_secs_f64());
        write_line(out, "contradictions", None, &line)
    }
}

/// "1 other is", "3 others are".
fn others(count: usize) -> String {
    match count {
        1 => "1 other is".to_owned(),
        _ => format!("{count} others are"),
    }
}
