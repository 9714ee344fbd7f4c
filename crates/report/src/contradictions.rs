//! What contradicts what among measured motions, for people and for programs.

use super::json::write_line;
use super::{counted, text};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::wording::printable;
use viewcert_advice::contradictions::{Contradictions, Look};
use viewcert_advice::export::{python, shell};
use viewcert_formats::Motions;

/// What a line about contradictions begins with.
const TITLE: &str = "contradictions  ";

/// Motions, and what was found about them.
pub struct ContradictionsReport<'a> {
    /// The input.
    pub path: String,
    /// Its motions.
    pub motions: &'a Motions,
    /// What was found.
    pub found: &'a Contradictions,
    /// How long it took.
    pub time: Duration,
}

/// The same, of an input that more is known of.
pub struct Contradicted {
    /// Its motions.
    pub motions: Motions,
    /// What was found about them.
    pub found: Contradictions,
}

impl Contradicted {
    /// What there is to report.
    pub fn report(&self) -> ContradictionsReport<'_> {
        ContradictionsReport {
            path: self.motions.name.clone(),
            motions: &self.motions,
            found: &self.found,
            time: Duration::ZERO,
        }
    }
}

impl ContradictionsReport<'_> {
    /// What makes the pairs doubtful, if anything contradicts anything.
    pub fn doubt(&self) -> Option<String> {
        let answer = self.answer();
        let off = answer.strip_prefix(TITLE)?;
        let look = self
            .look_at()
            .map_or_else(String::new, |look| format!("; {look}"));
        let focal = self.mostly_uncalibrated();
        let focal = focal.map_or_else(String::new, |focal| format!("; {focal}"));
        Some(format!("{off}{look}{focal} (verify contradictions)"))
    }

    /// Whether nothing contradicts anything.
    pub fn is_good(&self) -> bool {
        self.found.at_least() == 0
    }

    /// The answer in a line.
    pub fn answer(&self) -> String {
        let (motions, found) = (self.motions, self.found);
        let checkable = counted(motions.pairs.len(), "checkable pair");
        let [theta, _] = found.angles;
        let mut besides = Vec::new();
        match found.without_cycle {
            0 => {}
            1 => besides.push("1 is in no cycle".to_owned()),
            count => besides.push(format!("{count} are in no cycle")),
        }
        let unchecked = motions.unchecked.values().sum::<usize>();
        if unchecked > 0 {
            let why: Vec<&str> = motions.unchecked.keys().map(|why| why.name()).collect();
            besides.push(format!(
                "{unchecked} cannot be checked ({})",
                why.join(", ")
            ));
        }
        let besides = match besides.is_empty() {
            true => String::new(),
            false => format!("; {}", besides.join(", ")),
        };
        match found.at_least() {
            0 if motions.pairs.is_empty() => {
                format!("no contradiction among {checkable}{besides}")
            }
            0 => format!(
                "no contradiction among {checkable}{besides}; look-alikes that agree are not seen"
            ),
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
        let [theta, phi] = self.found.angles;
        let finer = self.found.finer.as_ref().map(|(finer, packing)| {
            format!(
                "at least {} by more than {finer} degrees, which right pairs may come close to",
                packing.at_least()
            )
        });
        let directed = self.found.directed.as_ref().map(|packing| {
            format!(
                "at least {} by more than {theta} degrees or {phi} in direction",
                packing.at_least()
            )
        });
        let both: Vec<String> = finer.into_iter().chain(directed).collect();
        (!both.is_empty()).then(|| both.join("; "))
    }

    /// The first line of what follows if neighbours are right.
    pub fn neighbours(&self) -> Option<String> {
        let found = self.found.neighbours.as_ref()?;
        let first = found.first.map(|pair| {
            let inliers = counted(self.motions.pairs[pair as usize].inliers as usize, "inlier");
            format!(", first {} ({inliers})", self.pair(pair))
        });
        let within = match found.window {
            1 => String::new(),
            window => format!(" ({window} files apart at most)"),
        };
        Some(format!(
            "if neighbours by name{within} are right: at least {} wrong{}",
            match found.packing.at_least() {
                1 => "1 other is".to_owned(),
                count => format!("{count} others are"),
            },
            first.unwrap_or_default()
        ))
    }

    /// Which pairs to look at.
    pub fn look_at(&self) -> Option<String> {
        let pairs: Vec<String> = self
            .found
            .look_at
            .iter()
            .map(|look| self.pair(look.pair))
            .collect();
        match &pairs[..] {
            [one, other] => Some(format!(
                "look at {one} and {other}: one of the two groups is wrong"
            )),
            [one] => Some(format!("look at {one}")),
            _ => None,
        }
    }

    /// What a pair says from both sides.
    fn sides(&self, look: &Look) -> String {
        let [theta, _] = self.found.angles;
        let others = |count: usize| match count {
            1 => "1 other is".to_owned(),
            _ => format!("{count} others are"),
        };
        let mut sides = format!(
            "{}: if it is right, {} off",
            self.pair(look.pair),
            others(look.if_right)
        );
        if look.if_off > 0 {
            let far = 3 * theta;
            let by = format!(
                "; if it is off by more than {far} degrees, {} off by more than {theta}",
                others(look.if_off)
            );
            sides += &by;
        }
        sides
    }

    /// A pair by its names; without their ending, where all have the same.
    fn pair(&self, pair: u32) -> String {
        let ending = self.ending();
        let [one, other] = self.names(pair).map(|name| {
            let name = name
                .strip_suffix(ending.as_str())
                .unwrap_or(&name)
                .to_owned();
            printable(&name)
        });
        format!("{one}-{other}")
    }

    fn names(&self, pair: u32) -> [String; 2] {
        let images = self.motions.pairs[pair as usize].images;
        images.map(|image| self.motions.labels.label(image).into_owned())
    }

    /// The ending that all names have, with its point.
    fn ending(&self) -> String {
        let mut endings = (0..self.motions.images as u32).map(|image| {
            let name = self.motions.labels.label(image);
            name.rfind('.')
                .filter(|&at| at > 0)
                .map(|at| name[at..].to_owned())
        });
        let first = endings.next().flatten().unwrap_or_default();
        let is_common = endings.all(|ending| ending.as_ref() == Some(&first));
        let is_word = first.chars().any(char::is_alphabetic);
        if is_common && is_word {
            first
        } else {
            String::new()
        }
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
        if self.is_good() || !self.motions.is_database {
            return Vec::new();
        }
        let window = self
            .found
            .neighbours
            .as_ref()
            .map_or(1, |found| found.window);
        let script = format!(
            "import pycolmap, shutil, sqlite3; shutil.copy({}, 'neighbours.db'); d = sqlite3.connect('neighbours.db'); \
             ids = [i for i, in d.execute('select image_id from images order by name')]; \
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
        let next = self.next();
        if !next.is_empty() {
            writeln!(
                out,
                "  next        map the neighbours alone, and compare with your model:"
            )?;
        }
        for command in next {
            writeln!(out, "    {command}")?;
        }
        writeln!(
            out,
            "  time        {}",
            text::seconds(self.time.as_micros())
        )
    }

    /// What is written as JSON.
    pub fn line(&self) -> ContradictionsLine {
        let found = self.found;
        let unchecked = self.motions.unchecked.iter();
        let contradicting = found.packing.pairs();
        ContradictionsLine {
            angle: found.angles[0],
            at_least: found.at_least(),
            at_most: found.at_most(),
            checkable: self.motions.pairs.len(),
            unchecked: self.motions.unchecked.values().sum(),
            reasons: unchecked.map(|(why, &count)| (why.name(), count)).collect(),
            without_cycle: found.without_cycle,
            uncalibrated: self.uncalibrated(),
            finer: found.finer.as_ref().map(|(angle, packing)| Finer {
                angle: *angle,
                at_least: packing.at_least(),
            }),
            directed: found.directed.as_ref().map(|packing| Finer {
                angle: found.angles[1],
                at_least: packing.at_least(),
            }),
            neighbours: found.neighbours.as_ref().map(|near| NeighboursLine {
                window: near.window,
                at_least: near.packing.at_least(),
                first: near.first.map(|pair| self.names(pair)),
            }),
            look_at: found
                .look_at
                .iter()
                .map(|look| LookLine {
                    images: self.names(look.pair),
                    inliers: self.motions.pairs[look.pair as usize].inliers,
                    if_right: look.if_right,
                    if_off: look.if_off,
                })
                .collect(),
            contradicting: contradicting
                .into_iter()
                .map(|pair| self.names(pair))
                .collect(),
            answer: self.answer(),
        }
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let line = Line {
            input: &self.path,
            notes: self.notes(),
            line: self.line(),
            next: self.next(),
            seconds: self.time.as_secs_f64(),
        };
        write_line(out, "contradictions", None, &line)
    }
}

#[derive(Serialize)]
struct Line<'a> {
    input: &'a str,
    notes: Vec<String>,
    #[serde(flatten)]
    line: ContradictionsLine,
    next: Vec<String>,
    seconds: f64,
}

/// What was found, as JSON.
#[derive(Serialize)]
pub struct ContradictionsLine {
    angle: u32,
    at_least: usize,
    at_most: usize,
    checkable: usize,
    unchecked: usize,
    reasons: BTreeMap<&'static str, usize>,
    without_cycle: usize,
    uncalibrated: usize,
    finer: Option<Finer>,
    directed: Option<Finer>,
    neighbours: Option<NeighboursLine>,
    look_at: Vec<LookLine>,
    contradicting: Vec<[String; 2]>,
    answer: String,
}

#[derive(Serialize)]
struct Finer {
    angle: u32,
    at_least: usize,
}

#[derive(Serialize)]
struct NeighboursLine {
    window: u32,
    at_least: usize,
    first: Option<[String; 2]>,
}

#[derive(Serialize)]
struct LookLine {
    images: [String; 2],
    inliers: u32,
    if_right: usize,
    if_off: usize,
}
