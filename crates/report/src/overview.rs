//! What pairs and tracks of one input determine, in full and in JSON.
//!
//! In: reports about the graphs of an input. Out: whether they promise all images, what makes that doubtful, and
//! their verdicts side by side (docs/reconstruction.md, 'Overview'): no more than theory 4 and 12 prove.

use super::json::{AnswerLine, GraphLine, joined, present, write_line};
use super::tracks::TrackLine;
use super::{
    Report, bottlenecks, condition, counted, database, mappers, part_names, size_of, text, tracks,
};
use crate::advice::{joints as write_joints, photograph, suggestions as write_suggestions};
use crate::contradictions::Contradicted;
use crate::intrinsics::IntrinsicsLine;
use crate::shown::{notes, row, several, time};
use serde::Serialize;
use serde_json::json;
use std::cell::OnceCell;
use std::collections::HashMap;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::graph::{Adjacency, UnionFind, biconnected_components};
use viewcert_advice::Advice;
use viewcert_advice::degenerate::Narrow;
use viewcert_advice::mapper::{Foreseen, Sees};
use viewcert_advice::named::Suggestion;
use viewcert_formats::colmap::{DatabaseFacts, Groups, Pipeline};
use viewcert_formats::{NamedGraph, ReadAs};

/// How many gaps are shown with what to match.
const GAPS: usize = 3;

/// Where words begin, and where lines end.
const MARGIN: usize = 14;
const WIDTH: usize = 100;

/// Everything that is found about one input; at least one of `pairs` and `tracks` is there.
pub struct Overview<'a> {
    /// The input.
    pub name: &'a str,
    /// What was merged, ignored or guessed.
    pub notes: Vec<String>,
    /// How it was read.
    pub read: &'a ReadAs,
    /// The pairs in the projective and in the calibrated model, unless the input has tracks alone.
    pub pairs: Option<[Report<'a>; 2]>,
    /// What these determine of the intrinsics, as the database knows them, or why that is not said.
    pub intrinsics: Option<Result<IntrinsicsLine, String>>,
    /// The cameras and points.
    pub tracks: Option<Report<'a>>,
    /// Why there are no tracks, if there are none.
    pub no_tracks: Option<&'a str>,
    /// The joints of the parts of `tracks`, or of the calibrated pairs.
    pub joints: &'a Advice,
    /// The images that are to be determined.
    pub wanted: Wanted,
    /// What mappers will probably do, if the tracks are from a database.
    pub mappers: Option<Foreseen>,
    /// Where everything hangs on few images or pairs.
    pub narrow: Narrow,
    /// The parts of `tracks`, found when they are asked for first.
    pub parts: OnceCell<Option<Parts>>,
    /// Parts that no pairs with a base line hold together.
    pub without_base_line: Vec<WithoutBaseLine>,
    /// What contradicts what among the motions of a database.
    pub contradictions: Option<Contradicted>,
    /// The other models of the folder that was named.
    pub beside: Vec<(String, usize)>,
    /// What to do next, and what to expect of it.
    pub next: Next,
    /// How long it took.
    pub time: Duration,
}

/// The images that are to be determined.
pub struct Wanted {
    /// Those that have a pair, or, where only tracks are known, all; increasing.
    images: Vec<u32>,
    /// How many there are together, with a pair or without.
    all: u32,
    /// The same two numbers in images, of which several may be one camera.
    pub(crate) count: usize,
    pub(crate) of: usize,
}

/// What to do next.
#[derive(Default)]
pub struct Next {
    /// Commands, one after another.
    pub commands: Vec<Do>,
    /// What to do where no command helps.
    pub by_hand: Option<String>,
    /// What to expect of it.
    pub expect: String,
}

/// A command, and why.
#[derive(Serialize)]
pub struct Do {
    /// Its words.
    pub command: Vec<String>,
    /// What it does for whom.
    pub why: String,
}

/// What makes a promise doubtful.
pub(crate) struct Doubt {
    /// A line or two.
    pub(crate) words: String,
    /// Whether nothing is promised then, so that the exit code is 1.
    pub(crate) refutes: bool,
}

impl Wanted {
    /// Those of a graph. O(nodes + edges).
    pub fn of(input: &NamedGraph) -> Self {
        if let Some(cameras) = input.cameras {
            let images: Vec<u32> = (0..cameras).collect();
            let count = part_names::images(input, &images);
            return Self {
                images,
                all: cameras,
                count,
                of: count,
            };
        }
        let mut paired = vec![false; input.graph.nodes()];
        for &(i, j) in input.graph.edges() {
            paired[i as usize] = true;
            paired[j as usize] = true;
        }
        let nodes = (0..).zip(paired);
        let images = nodes.filter_map(|(v, paired)| paired.then_some(v));
        let images: Vec<u32> = images.collect();
        Self {
            count: images.len(),
            of: input.graph.nodes(),
            images,
            all: input.graph.nodes() as u32,
        }
    }

    /// "all 15 images", "15 of 16 images".
    pub(crate) fn words(&self) -> String {
        match self.count == self.of {
            true => format!("all {}", counted(self.count, "image")),
            false => format!("{} of {}", self.count, counted(self.of, "image")),
        }
    }
}

/// The parts of a graph: its components of two cameras with their points, or of three images.
#[derive(Clone, Debug)]
pub struct Parts {
    /// Whether one component has all images that are wanted.
    pub whole: bool,
    /// With how many images a component is a part.
    least: usize,
    /// The images of each, falling; of images that are one camera this.
    pub(crate) images: Vec<Vec<u32>>,
    /// How many images each has.
    pub(crate) sizes: Vec<usize>,
    /// Pairs that are components by themselves.
    single_pairs: usize,
    /// How many of the wanted images are in no part.
    outside: usize,
}

impl Parts {
    fn new(report: &Report, wanted: &Wanted) -> Self {
        let components = &report.verdict.components;
        let all: Vec<Vec<u32>> = match report.input.cameras {
            None => components.iter().map(|part| part.nodes()).collect(),
            // A frame that no point holds to anything is no part.
            Some(cameras) => components
                .iter()
                .filter(|part| part.edge_count() > 0)
                .map(|part| tracks::members(part, cameras).0)
                .collect(),
        };
        let holds = |images: &Vec<u32>| {
            let mut wanted = wanted.images.iter();
            !wanted.as_slice().is_empty() && wanted.all(|v| images.binary_search(v).is_ok())
        };
        let whole = all.iter().any(holds);
        let (least, pairs) = match report.input.cameras {
            None => (3, all.iter().filter(|images| images.len() == 2).count()),
            Some(_) => (2, 0),
        };
        let mut images: Vec<Vec<u32>> =
            all.into_iter().filter(|part| part.len() >= least).collect();
        images.sort_by_key(|part| std::cmp::Reverse(part.len()));
        let mut inside: Vec<u32> = images.iter().flatten().copied().collect();
        inside.sort_unstable();
        let mut outside = wanted.images.clone();
        outside.retain(|v| inside.binary_search(v).is_err());
        let count = |some: &[u32]| part_names::images(report.input, some);
        Self {
            whole,
            least,
            outside: count(&outside),
            sizes: images.iter().map(|part| count(part)).collect(),
            images,
            single_pairs: pairs,
        }
    }

    /// "2 parts (6, 6) and 3 images".
    pub(crate) fn brief(&self) -> String {
        let parts = counted(self.images.len(), "part");
        let outside = match self.outside {
            0 => String::new(),
            count => format!(" and {}", counted(count, "image")),
        };
        format!("{parts} ({}){outside}", mappers::largest(&self.sizes))
    }

    /// "2 parts (6, 6 images)", and what is in none of them.
    pub(crate) fn words(&self) -> String {
        let mut words = match self.images.len() {
            0 => format!("no part of {} images or more", self.least),
            count => {
                let sizes = several(&self.sizes, ", ");
                format!("{} ({sizes} images)", counted(count, "part"))
            }
        };
        if self.single_pairs > 0 {
            words += &format!(", {}", counted(self.single_pairs, "single pair"));
        }
        if self.outside > 0 {
            words += &format!(", {} in no part", counted(self.outside, "image"));
        }
        words
    }
}

impl Overview<'_> {
    /// The report that decides: of the tracks, or without any of the calibrated pairs.
    pub(crate) fn decisive(&self) -> Option<&Report<'_>> {
        let calibrated = || self.pairs.as_ref().map(|[_, calibrated]| calibrated);
        self.tracks.as_ref().or_else(calibrated)
    }

    /// What tracks determine, if there are any.
    fn by_tracks(&self) -> Option<Parts> {
        let parts = self.parts.get_or_init(|| {
            let report = self.tracks.as_ref()?;
            Some(Parts::new(report, &self.wanted))
        });
        parts.clone()
    }

    /// What pairwise directions determine, if there are pairs.
    fn averaging(&self) -> Option<Parts> {
        let [_, calibrated] = self.pairs.as_ref()?;
        Some(Parts::new(calibrated, &self.wanted))
    }

    /// Whether the tracks, or without any the calibrated pairs, determine all images, mappers make something of
    /// it, and no doubt refutes it.
    pub fn determined(&self) -> bool {
        let is_refuted = self.doubts().iter().any(|doubt| doubt.refutes);
        self.is_promised() && self.no_model().is_none() && !is_refuted
    }

    /// The same, whatever mappers make of it, and whatever is doubtful.
    pub(crate) fn is_promised(&self) -> bool {
        let all_paired = self.wanted.images.len() == self.wanted.all as usize;
        all_paired && self.is_one_part()
    }

    /// Finds the parts that no pairs with a base line hold together; `groups` splits images by such pairs.
    ///
    /// # Errors
    /// Those of `groups`.
    pub fn split_by_base_lines<E>(
        &mut self,
        groups: impl FnOnce(&[Vec<u32>]) -> Result<Vec<Groups>, E>,
    ) -> Result<(), E> {
        let parts = self.parts().map(|parts| parts.images).unwrap_or_default();
        let found = (1..).zip(groups(&parts)?);
        let found = found.filter(|(_, part)| !part.is_one());
        let found = found.map(|(part, groups)| WithoutBaseLine {
            part,
            groups: groups.groups.iter().map(|one| self.named(one)).collect(),
            pairs: groups.pairs,
            configurations: groups.configs,
        });
        self.without_base_line = found.collect();
        Ok(())
    }

    /// What is known of the database, if it is one.
    pub(crate) fn facts(&self) -> Option<&DatabaseFacts> {
        let [pairs, _] = self.pairs.as_ref()?;
        pairs.input.database.as_deref()
    }

    /// How many images have a focal length that is a guess and that mappers do not find.
    pub(crate) fn guessed(&self) -> usize {
        self.facts().map_or(0, |facts| facts.focal_guessed)
    }

    /// What everything that is promised rests on.
    pub(crate) fn condition(&self) -> String {
        self.decisive().map_or_else(String::new, condition_of)
    }

    /// What makes the promise doubtful, the heaviest first. What else contradicts the pairs belongs in front.
    pub(crate) fn doubts(&self) -> Vec<Doubt> {
        let doubt = |refutes| move |words| Doubt { words, refutes };
        let base_lines = self.without_base_line.iter().map(WithoutBaseLine::words);
        let guessed = self.guessed();
        let guessed = (guessed > 0).then(|| {
            let (have, own) = match guessed {
                1 => ("1 image has".to_owned(), "its own"),
                count => (format!("{count} images have"), "their own"),
            };
            format!(
                "{have} a guessed focal length of {own}, which mappers rarely find: they place such images wrong \
                 silently"
            )
        });
        let axes = self.facts().is_some_and(|facts| facts.axes_parallel);
        let axes = axes.then(|| {
            "the optical axes of all images are parallel, as of a nadir flight (measured): focal length and heights \
             scale together, and mappers keep their guess (give it: --ImageReader.camera_params)"
                .to_owned()
        });
        let scope = self.decisive().map(|report| report.scope);
        let turns = scope.filter(|scope| scope.needs_turns()).map(|_| {
            "parts hang together by base lines of rigs alone: if frames hardly turn, as of a car on one line, both \
             mappers misplace these parts silently"
                .to_owned()
        });
        let off = self.contradictions.as_ref();
        let off = off.and_then(Contradicted::doubt).into_iter();
        let others = guessed.into_iter().chain(axes).chain(turns);
        let refuting = off.chain(base_lines).chain(others).map(doubt(true));
        let lesser = bottlenecks::warnings(&self.narrow).into_iter();
        let lesser = lesser.chain(bottlenecks::few(&self.narrow));
        let unseen = self.contradictions.as_ref().and_then(Contradicted::unseen);
        let lesser = lesser
            .chain(self.unchecked())
            .chain(unseen)
            .map(doubt(false));
        refuting.chain(lesser).collect()
    }

    /// The pairs that no cycle holds: a wrong one contradicts nothing. Frames may check pairs, and what alone
    /// holds groups together is said before.
    fn unchecked(&self) -> Option<String> {
        let input = self.pairs.as_ref()?[1].input;
        let mut alone = Vec::new();
        biconnected_components(Adjacency::new(&input.graph).lists(), |nodes| {
            if let [a, b] = *nodes {
                alone.push([a.min(b), a.max(b)]);
            }
        });
        let known = self.narrow.few.iter().filter(|few| few.pairs.len() == 1);
        if input.frames.is_some() || alone.len() == known.count() {
            return None;
        }
        let [a, b] = alone.iter().min()?.map(|v| input.labels.label(v));
        let all = counted(input.graph.edges().len(), "pair");
        Some(match alone.len() {
            1 => format!("no other pair checks {a} {b}: an error of it cannot show"),
            count => format!(
                "no other pair checks {count} of {all}, as {a} {b}: an error of these cannot show"
            ),
        })
    }

    /// Why mappers make nothing of a database, where that is known beforehand.
    pub(crate) fn no_model(&self) -> Option<String> {
        let facts = self.facts()?;
        if facts.pairs_used > 0 {
            let paired = facts.images - facts.images_without_pair;
            let why = "make no model: the database has no keypoints, and a mapper needs the places of what is \
                       matched (`colmap feature_extractor` writes them)";
            return (facts.images_without_keypoints == paired).then(|| why.to_owned());
        }
        let (pairs, least) = (counted(facts.pairs, "verified pair"), facts.min_inliers);
        let configuration = match facts.pipeline {
            Pipeline::Incremental => "",
            Pipeline::Global => " and a configuration that global mapping takes",
        };
        let enough = match self.weak_pairs() {
            Some(count) => format!(
                "; with {count} they hang together as far as they can (--min-inliers {count}; in COLMAP \
                 --Mapper.min_num_matches and --GlobalMapper.min_num_matches)"
            ),
            None => {
                "; match other pairs, with other features, or take photographs that overlap more"
                    .into()
            }
        };
        Some(format!(
            "make no model: none of {pairs} has {}{configuration}{enough}",
            counted(least as usize, "inlier")
        ))
    }

    /// Where no pair is used: with how many inliers of a pair everything that is verified hangs together.
    pub(crate) fn weak_pairs(&self) -> Option<u32> {
        let [pairs, _] = self.pairs.as_ref()?;
        self.facts().filter(|facts| facts.pairs_used == 0)?;
        let matching = pairs.input.matching.as_ref()?;
        let known = matching.others.iter().filter(|pair| pair.inliers > 0);
        let mut known: Vec<_> = known.collect();
        known.sort_by_key(|pair| std::cmp::Reverse(pair.inliers));
        let mut parts = UnionFind::new(pairs.input.graph.nodes());
        let joining = known.into_iter().filter(|pair| {
            let (a, b) = pair.images;
            parts.union(a as usize, b as usize)
        });
        let least = self.facts()?.min_inliers;
        let count = joining.map(|pair| pair.inliers).last();
        count.filter(|&count| count < least)
    }

    /// Whether they determine all images that have a pair.
    pub(crate) fn is_one_part(&self) -> bool {
        self.parts().is_some_and(|parts| parts.whole)
    }

    /// The parts of what decides.
    pub(crate) fn parts(&self) -> Option<Parts> {
        self.by_tracks().or_else(|| self.averaging())
    }

    /// Every image that is in no part.
    pub(crate) fn in_no_part(&self) -> Vec<u32> {
        let mut outside = vec![true; self.wanted.all as usize];
        for image in self
            .parts()
            .into_iter()
            .flat_map(|parts| parts.images.concat())
        {
            outside[image as usize] = false;
        }
        let all = (0..).zip(outside);
        all.filter_map(|(image, outside)| outside.then_some(image))
            .collect()
    }

    /// Writes what the first screen leaves out.
    ///
    /// # Errors
    /// Those of the writer.
    pub(crate) fn write_rest(&self, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "  read as     {}", self.read)?;
        if let Some([projective, calibrated]) = &self.pairs {
            match &projective.input.database {
                Some(facts) => database::write(out, facts)?,
                None => writeln!(out, "  graph       {}", size_of(projective.input))?,
            }
            for (model, report) in [("projective", projective), ("calibrated", calibrated)] {
                writeln!(out, "  {model}  pairs alone: {}", text::answer(report))?;
                text::write_components(out, report)?;
            }
        }
        match &self.intrinsics {
            Some(Ok(found)) => wrapped(out, "intrinsics", &found.words_of_database())?,
            Some(Err(why)) => wrapped(out, "intrinsics", &format!("not asked: {why}"))?,
            None => {}
        }
        match (&self.tracks, self.no_tracks) {
            (Some(report), _) => {
                if let Some(facts) = &report.input.tracks {
                    tracks::write_size(out, facts)?;
                }
                writeln!(out, "  positions   {}", text::answer(report))?;
                if let Some(found) = report.scope.base_lines() {
                    writeln!(out, "  base lines  {}", found.words())?;
                }
                text::write_components(out, report)?;
            }
            (None, Some(reason)) => writeln!(out, "  tracks      none: {reason}")?,
            (None, None) => {}
        }
        notes(out, &self.notes)?;
        self.write_parts(out)?;
        self.write_joints(out)?;
        self.write_suggested(out)?;
        if let Some(foreseen) = self.mappers.as_ref().filter(|_| self.no_model().is_none()) {
            for words in mappers::beginnings(&foreseen.incremental) {
                wrapped(out, "begins at", &words)?;
            }
        }
        time(out, self.time)
    }

    fn write_parts<W: Write>(&self, out: &mut W) -> io::Result<()> {
        let (Some(parts), Some(report)) = (self.parts(), self.decisive()) else {
            return Ok(());
        };
        let named = part_names::parts(report.input, &parts.images);
        let outside = self.named(&self.in_no_part());
        part_names::write(out, &named, &outside, &self.sees(), wrapped)
    }

    /// How much of a simulated model each image outside sees.
    pub(crate) fn sees(&self) -> HashMap<&str, &Sees> {
        let models = self.mappers.iter();
        let all = models.flat_map(|mappers| &mappers.incremental.outside);
        let some = all.filter(|sees| sees.sees > 0);
        some.map(|sees| (&sees.image[..], sees)).collect()
    }

    /// The names of images.
    pub(crate) fn named(&self, images: &[u32]) -> Vec<String> {
        let input = self.decisive().map(|report| report.input);
        let names = input.map(|input| part_names::names(input, images));
        names.unwrap_or_default()
    }

    fn write_joints(&self, out: &mut impl Write) -> io::Result<()> {
        let several = self.parts().is_some_and(|parts| parts.images.len() > 1);
        if several && self.joints.has_no_joints() {
            return writeln!(out, "  joints      none: no two parts touch");
        }
        write_joints(out, self.joints)
    }

    /// What to match, the first for each gap, and between which images nothing is left to match.
    fn write_suggested<W: Write>(&self, out: &mut W) -> io::Result<()> {
        if self.facts().is_some_and(|facts| facts.pairs_used == 0) {
            // What all mappers lack was said first.
            return Ok(());
        }
        let mut gaps: Vec<&[usize]> = Vec::new();
        let all = self.joints.suggestions.iter().flatten();
        let first = all.filter(|one| {
            let is_new = !gaps.contains(&&one.joins[..]);
            gaps.push(&one.joins);
            is_new
        });
        let first: Vec<&Suggestion> = first.take(GAPS).collect();
        if !first.is_empty() {
            let words = "to match (the first for each gap; each would join components if the images really overlap):";
            row(out, "suggested", words)?;
            write_suggestions(out, first)?;
        }
        match &self.joints.photograph {
            Some(found) => wrapped(out, "photograph", &photograph(found)),
            None => Ok(()),
        }
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let pairs = self.pairs.as_ref().map(|[projective, calibrated]| {
            let graph = &projective.input.graph;
            json!({
                "images": graph.nodes(),
                "images_with_pair": self.wanted.count,
                "pairs": graph.edges().len(),
                "projective": AnswerLine::from(projective),
                "calibrated": AnswerLine::from(calibrated),
            })
        });
        let tracks = self.tracks.as_ref().and_then(|report| {
            let (cameras, facts) = report.input.cameras.zip(report.input.tracks.as_ref())?;
            let positions = AnswerLine::from(report);
            let positions =
                present(json!({ "positions": positions, "base_lines": report.scope.base_lines() }));
            Some(joined(positions, &TrackLine { cameras, facts }))
        });
        let parts = match (self.parts(), self.decisive()) {
            (Some(parts), Some(report)) => part_names::parts(report.input, &parts.images),
            _ => Vec::new(),
        };
        let split = Some(&self.without_base_line).filter(|split| !split.is_empty());
        let off = self.contradictions.as_ref().map(Contradicted::line);
        let decided = self.decisive();
        let line = present(json!({
            // The graph that determines: of tracks, if there are any, or else of pairs.
            "graph": decided.map(|report| GraphLine::new(report.input, report.verdict)),
            "read": self.read,
            "notes": self.notes,
            "database": self.facts(),
            "pairs": pairs,
            "intrinsics": self.intrinsics.as_ref().and_then(|found| found.as_ref().ok()),
            "tracks": tracks,
            "no_tracks": self.no_tracks,
            "determined": self.determined(),
            "condition": self.condition(),
            "determined_by": if self.tracks.is_some() { "tracks" } else { "pairs" },
            "images": self.wanted.count,
            "of": self.wanted.of,
            "parts": parts,
            "in_no_part": self.named(&self.in_no_part()),
            "without_base_line": split,
            "contradictions": off,
            "narrow": self.narrow,
            "mappers": self.mappers.as_ref().filter(|_| self.no_model().is_none()),
            "no_model": self.no_model(),
            "do_next": self.next.commands,
            "by_hand": self.next.by_hand,
            "expect": self.next.expect,
            "seconds": self.time.as_secs_f64(),
        }));
        let seed = decided.map(|report| report.verdict.seed);
        write_line(out, "overview", seed, &joined(line, self.joints))
    }
}

/// A part whose images no pairs with a base line hold together.
#[derive(Serialize)]
pub struct WithoutBaseLine {
    /// The part, from 1.
    pub(crate) part: usize,
    /// The images that such pairs connect, larger groups first.
    pub(crate) groups: Vec<Vec<String>>,
    /// How many pairs lead from one group to another.
    pub(crate) pairs: usize,
    /// Their configurations.
    pub(crate) configurations: Vec<&'static str>,
}

impl WithoutBaseLine {
    /// What that means.
    pub(crate) fn words(&self) -> String {
        let sizes: Vec<usize> = self.groups.iter().map(Vec::len).collect();
        let [pairs, images] =
            [(self.pairs, "pair"), (sizes.iter().sum(), "image")].map(|(n, of)| counted(n, of));
        let configurations = self.configurations.join(", ");
        let part = self.part;
        let groups = format!("between groups of {} images ", several(&sizes, " + "));
        let (between, nothing) = match sizes[0] {
            1 => ("", "where the cameras are"),
            _ => (&*groups, "how the groups lie to each other"),
        };
        format!(
            "part {part}, {images}: {between}no pair has a base line that shows ({pairs}: {configurations}), \
             so nothing says {nothing}"
        )
    }
}

/// What the promises of a report rest on.
fn condition_of(report: &Report) -> String {
    let condition = report.scope.promise(Some(condition::of(report.input)));
    condition.unwrap_or_default()
}

/// Writes words in lines of limited width.
pub(crate) fn wrapped<W: Write>(out: &mut W, title: &str, words: &str) -> io::Result<()> {
    let mut line = format!("  {title:<11}");
    for word in words.split(' ') {
        if line.len() > MARGIN && line.len() + 1 + word.len() > WIDTH {
            writeln!(out, "{line}")?;
            line = " ".repeat(MARGIN - 1);
        }
        line += " ";
        line += word;
    }
    writeln!(out, "{line}")
}
