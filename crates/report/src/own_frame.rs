//! What displacements and positions in a frame of their own determine, in words and numbers
//! (docs/theory.md, Theorems 13.29 to 13.31).

use serde::Serialize;
use viewcert::certificate::hex;
use viewcert::decide::{Claim, OwnFrame, Strength, TurningPart, Value, Verdict};
use viewcert::wording::counted;
use viewcert_formats::NamedGraph;

/// What answers about them suppose.
pub(crate) const CONDITION: &str = "what is given is exact, in a frame of its own, and the rotation of each part against it \
                                    is unknown; points lie in front of cameras; other centres are in general position";

/// So many parts are named.
const NAMED: usize = 3;

/// What is given in a frame of its own, and what it adds.
#[derive(Clone, Debug, Serialize)]
pub struct OwnFrameLine {
    groups: usize,
    /// How many cameras are in groups.
    cameras: usize,
    /// Whether the vectors are given, so that the answer is about these.
    vectors: bool,
    sha256: String,
    rank: usize,
    rank_at_most: usize,
    rank_required: usize,
    /// How many cameras pairs hold, and what is given places; exactly so many if the bounds of the rank meet.
    determined: usize,
    /// How many cameras have a position and nothing else: no pair, no rig.
    only_given: usize,
    parts: Vec<PartLine>,
    /// None is open.
    #[serde(skip)]
    answer: Option<Value>,
    #[serde(skip)]
    because: String,
}

/// A part of which something is given.
#[derive(Clone, Debug, Serialize)]
struct PartLine {
    cameras: usize,
    given: usize,
    /// Whether it turns about the one position or line of all that is given of it.
    turns: bool,
    /// Whether a body that is rigid without what is given shows how it is turned.
    rotation_fixed: bool,
}

impl OwnFrameLine {
    /// Of a verdict, if such things are given.
    pub(crate) fn new(input: &NamedGraph, verdict: &Verdict) -> Option<Self> {
        let found = verdict.own_frame.as_ref()?;
        let cameras = |nodes: &[u32]| match input.cameras {
            None => nodes.len(),
            Some(cameras) => nodes.partition_point(|&v| v < cameras),
        };
        let given = &found.given;
        let only_given = found.only_given().len();
        let part = |part: &TurningPart| PartLine {
            cameras: cameras(&part.nodes),
            given: part.given.len(),
            turns: part.turns,
            rotation_fixed: part.is_fixed,
        };
        Some(Self {
            groups: given.groups().len(),
            cameras: given.nodes(),
            vectors: given.vectors().is_some(),
            sha256: hex(&given.sha256()),
            rank: found.rank,
            rank_at_most: found.at_most,
            rank_required: found.required,
            determined: cameras(&found.placed),
            only_given,
            parts: found.parts.iter().map(part).collect(),
            answer: value(input, found),
            because: because(input, found, only_given),
        })
    }

    /// The answer in a word.
    pub(crate) fn name(&self) -> &'static str {
        self.answer.map_or("open", Value::name)
    }

    /// Whether finitely many solutions are left.
    pub(crate) fn is_good(&self) -> bool {
        self.answer
            .is_some_and(|value| value != Value::NotFiniteSolvable)
    }

    /// Why.
    pub(crate) fn because(&self) -> &str {
        &self.because
    }

    /// The two ranks, the lower one and the one that is required.
    pub(crate) fn ranks(&self) -> (usize, usize) {
        (self.rank, self.rank_required)
    }

    /// The rank in words.
    pub(crate) fn rank_words(&self) -> String {
        let (rank, most, required) = (self.rank, self.rank_at_most, self.rank_required);
        let rank = match rank == most {
            true => rank.to_string(),
            false => format!("at least {rank} and at most {most}"),
        };
        format!("{rank} of {required} with what is given (proved)")
    }

    /// What is given, in words.
    pub(crate) fn known(&self) -> String {
        let given = match self.vectors {
            true => ", as given vectors",
            false => "",
        };
        let (cameras, groups) = (
            counted(self.cameras, "camera"),
            counted(self.groups, "group"),
        );
        format!("displacements between {cameras} in {groups}{given}, in a frame of their own")
    }

    /// The answer in words.
    pub(crate) fn words(&self, input: &NamedGraph, condition: Option<String>) -> String {
        let sets = match input.cameras {
            None => "sets of cameras",
            Some(_) => "positions of the cameras and points",
        };
        let condition = condition.map_or_else(String::new, |words| format!(" {words}"));
        match self.answer {
            Some(Value::Solvable) => {
                let all = match input.cameras {
                    None => "the cameras",
                    Some(_) => "the positions of all cameras and points",
                };
                format!("solvable: {all} are unique{condition} (proved)")
            }
            Some(Value::FiniteSolvable) => {
                format!("finite-solvable: finitely many {sets}{condition} (proved)")
            }
            None => "open: neither unique nor free is proved".to_owned(),
            Some(value) => format!("{}: infinitely many {sets} (proved)", value.name()),
        }
    }

    /// How many cameras pairs and what is given determine, and how many have a given position alone.
    pub(crate) fn count(&self, input: &NamedGraph) -> String {
        let all = input
            .cameras
            .map_or(input.graph.nodes(), |cameras| cameras as usize);
        let proved = match self.rank == self.rank_at_most {
            true => "proved",
            false => "at drawn positions",
        };
        let alone = match self.only_given {
            0 => String::new(),
            1 => "; 1 camera has a position alone, which nothing measures".to_owned(),
            count => format!("; {count} cameras have a position alone, which nothing measures"),
        };
        format!(
            "{} of {all} cameras determined ({proved}){alone}",
            self.determined
        )
    }
}

/// The answer of a verdict with all that is given; nothing if it is open.
pub fn claim(input: &NamedGraph, verdict: &Verdict) -> Option<Claim<Value>> {
    let Some(found) = &verdict.own_frame else {
        return Some(verdict.value_claim());
    };
    let strength = Strength::Proof;
    value(input, found).map(|value| Claim { value, strength })
}

fn value(input: &NamedGraph, found: &OwnFrame) -> Option<Value> {
    // Base lines that are not known, which are the same in all frames, may tie what moves here.
    let is_tied = || {
        let frames = input.frames.as_ref();
        frames.is_some_and(|frames| frames.rig_frames().has_unknown())
    };
    let value = found.value();
    value.filter(|&value| value != Value::NotFiniteSolvable || !is_tied())
}

fn because(input: &NamedGraph, found: &OwnFrame, only_given: usize) -> String {
    if found.value().is_some() && value(input, found).is_none() {
        return "base lines that are not known are left out of account beside what is given"
            .to_owned();
    }
    let parts = (1..).zip(&found.parts);
    match found.value() {
        Some(Value::Solvable) => {
            return "in each part something that is rigid without what is given shows how it is turned"
                .to_owned();
        }
        Some(Value::FiniteSolvable) => {
            let open = parts.filter(|(_, part)| !part.is_fixed);
            let open: Vec<String> = open.map(|(number, _)| number.to_string()).collect();
            let which = match &open[..] {
                [one] => format!("part {one} is"),
                all => format!("parts {} are", all.join(", ")),
            };
            return format!(
                "the rank is full; nothing that is rigid without what is given shows how {which} turned, so that \
                 several solutions may exist"
            );
        }
        Some(Value::NotFiniteSolvable) => {}
        None => {
            return format!(
                "the rank falls short at drawn positions, and counting allows {}",
                found.at_most
            );
        }
    }
    let turning: Vec<_> = parts.filter(|(_, part)| part.turns).collect();
    let mut why: Vec<String> = turning
        .iter()
        .take(NAMED)
        .map(|(number, part)| {
            let of = match found.parts.len() {
                1 => "the graph".to_owned(),
                _ => {
                    let more = if part.nodes.len() > 1 { ", .." } else { "" };
                    let first = input.labels.display(part.nodes[0]);
                    format!("part {number} ({first}{more})")
                }
            };
            match part.given.len() {
                1 => format!("{of} turns about its one position"),
                count => format!("{of} turns about the line through its {count} positions"),
            }
        })
        .collect();
    if turning.len() > NAMED {
        why.push(format!("and so do {} more", turning.len() - NAMED));
    }
    if only_given > 0 {
        let who = match only_given {
            1 => "1 camera has".to_owned(),
            count => format!("{count} cameras have"),
        };
        why.push(who + " a position and no pair");
    }
    let nothing = found.alone.len() - only_given;
    if nothing > 0 {
        let who = match nothing {
            1 => "1 camera or point has".to_owned(),
            count => format!("{count} cameras or points have"),
        };
        why.push(who + " no pair and no position");
    }
    if why.is_empty() {
        why.push(format!("counting allows rank {} at most", found.at_most));
    }
    why.join("; ")
}
