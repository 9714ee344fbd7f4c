//! What an answer holds for: what a graph determines if all centres lie in one plane
//! (docs/theory.md, Corollary 13.4 and Theorem 13.23), what unknown focal lengths ask for, and which
//! parts were taken for known.

use crate::condition;
use crate::intrinsics::IntrinsicsLine;
use crate::own_frame::{self, OwnFrameLine};
use serde::Serialize;
use std::borrow::Cow;
use std::collections::BTreeSet;
use viewcert::contract::Merge;
use viewcert::decide::{Options, SharedBaseLines, Turns, Value, Verdict, rank_in_plane};
use viewcert::geometry::model::Model;
use viewcert::graph::{Graph, UnionFind};
use viewcert::intrinsics::{Metric, Sensors};
use viewcert::watch::{Stopped, Watch};
use viewcert::wording::counted;
use viewcert_formats::NamedGraph;

/// What known displacements rest on.
const DISPLACEMENTS: &str = "displacements are vectors in the frame of the directions: positions \
                             (GPS) need the rotation between the two frames; they are in general \
                             position, and so in no relation";

/// The same if the vectors are given.
const VECTORS: &str = "the displacements are those that are given, vectors in the frame of the \
                       directions; otherwise centres are in general position";

/// What `--model focal` rests on.
const FOCAL: &str = "unknown focal lengths: decided as calibrated, because a pair fixes both focal \
                     lengths if pixels are square, principal points are known, its two optical axes do not \
                     lie in one plane, and the planes through them and the base line are not at right angles";

/// The same in the promise itself.
const AXES: &str = "no pair has its optical axes in one plane";

/// What frames have to do where base lines need it.
const TURN: &str = "frames turn against each other";
const TURN_MORE: &str = "frames turn about more than one axis";

/// The condition where a plane is another case.
const NO_PLANE: &str = "the centres do not all lie in one plane";

/// The answer for centres that are generic in one plane. All of it is proved.
#[derive(Clone, Debug, Serialize)]
pub struct Planar {
    verdict: &'static str,
    rank: usize,
    rank_required: usize,
    /// What the promise rests on besides.
    #[serde(skip_serializing_if = "Option::is_none")]
    condition: Option<String>,
}

impl Planar {
    /// Counts. Known parts are as good as all their pairs (Theorem 4.14).
    ///
    /// # Errors
    /// If the work was stopped.
    pub fn new(
        graph: &Graph,
        verdict: &Verdict,
        model: Model,
        watch: &Watch,
    ) -> Result<Self, Stopped> {
        let rank = rank_in_plane(graph, model, &verdict.known_parts, watch)?;
        let rank_required = model.required(graph.nodes());
        let verdict = match rank < rank_required {
            true => "not-finite-solvable",
            false => "solvable",
        };
        Ok(Self {
            verdict,
            rank,
            rank_required,
            condition: None,
        })
    }

    /// Whether no motion is left, beyond the trivial ones.
    pub fn is_determined(&self) -> bool {
        self.rank == self.rank_required
    }

    /// The answer in words.
    pub fn words(&self) -> String {
        let (rank, required) = (self.rank, self.rank_required);
        let condition = self.condition.as_ref();
        let condition = condition.map_or_else(String::new, |condition| format!(" {condition}"));
        let answer = match self.is_determined() {
            true => format!("solvable: the cameras are unique{condition}"),
            false => "not-finite-solvable: infinitely many sets of cameras".to_owned(),
        };
        format!("{answer} (proved), rank {rank} of {required}")
    }
}

/// What is supposed where the base lines of rigs are one unknown for all frames.
const BASE_LINES: &str = "base lines: a sensor is at one place in its rig in all frames, these places and the turns of \
                          frames are in general position, rotations known";

/// What is supposed where cameras have classes.
const INTRINSICS: &str = "intrinsics: what is known of them is known exactly, and optical axes \
                          are in general position (axes that are parallel, as of a nadir flight, or meet in one point are not)";

/// What is supposed where several images are of one sensor with unknown intrinsics.
const SENSORS: &str = "sensors: images of one sensor have the same intrinsics, and rotations are in general position (a \
                       camera that is moved and not turned, or turned about one direction only, is not)";

/// What unknown base lines that are the same in all frames determine.
#[derive(Clone, Debug, Serialize)]
pub struct BaseLines {
    frames: usize,
    unknown: usize,
    verdict: &'static str,
    /// What *solvable* rests on.
    #[serde(skip_serializing_if = "Option::is_none")]
    condition: Option<String>,
    rank: usize,
    rank_at_most: usize,
    rank_required: usize,
    parts: usize,
    /// Whether there are just so many.
    parts_proved: bool,
    /// Whether it is solvable too if all frames turn about one axis, and if they do not turn.
    about_one_axis: bool,
    without_turns: bool,
    /// How many groups of images are not turned against each other by pairs and known poses, if more
    /// than one: where they are then rests on rotations that nothing gives.
    #[serde(skip_serializing_if = "Option::is_none")]
    groups_not_turned: Option<usize>,
    /// What images determine alone, where frames add the rest.
    #[serde(skip)]
    alone: String,
}

impl BaseLines {
    fn new(found: &SharedBaseLines, turns: Turns, input: &NamedGraph, verdict: &Verdict) -> Self {
        let groups = groups_turned(input);
        let components = counted(verdict.components.len(), "component");
        let (rank, required) = (verdict.rank, verdict.required);
        Self {
            condition: None,
            alone: format!("; without it {components}, rank {rank} of {required}"),
            about_one_axis: found.about_one_axis && turns != Turns::General,
            without_turns: turns == Turns::No,
            groups_not_turned: Some(groups).filter(|&groups| groups > 1),
            frames: found.frames,
            unknown: found.base_lines,
            verdict: match found.is_determined() && groups > 1 {
                true => "open",
                false => found.value(),
            },
            rank: found.rank,
            rank_at_most: found.at_most,
            rank_required: found.required,
            parts: found.parts,
            parts_proved: found.parts_are_all(),
        }
    }

    /// Whether all positions are unique, with a proof, rotations being known.
    pub fn is_determined(&self) -> bool {
        self.verdict == "solvable"
    }

    /// What holds so many cameras and points together.
    pub(crate) fn hold(&self, nodes: usize) -> String {
        let frames = counted(self.frames, "frame");
        format!("base lines that {frames} share hold all {nodes} cameras and points together")
    }

    /// The answer in words.
    pub fn words(&self) -> String {
        let (rank, rank_at_most, rank_required) =
            (self.rank, self.rank_at_most, self.rank_required);
        let condition = self.condition.as_ref();
        let condition = condition.map_or_else(String::new, |words| format!(" {words}"));
        let (parts, exact) = (counted(self.parts, "part"), self.parts_proved);
        let least = if exact { "" } else { "at least " };
        let unknown = counted(self.unknown, "unknown base line");
        let frames = counted(self.frames, "frame");
        let answer = match self.verdict {
            "solvable" => format!(
                "solvable: the positions of all cameras and points are unique{condition} (proved)"
            ),
            "open" if rank == rank_required => format!(
                "open: the positions would be unique if rotations were known, but no pair of images and no \
                 known pose turns {} against each other",
                counted(self.groups_not_turned.unwrap_or(0), "group")
            ),
            "open" => format!(
                "open: not determined at drawn positions, and counting gives no proof (rank {rank_at_most} at most)"
            ),
            _ if rank == rank_at_most => {
                format!("not-finite-solvable: {least}{parts} move against each other (proved)")
            }
            _ => format!(
                "not-finite-solvable (proved): {parts} move against each other at drawn positions, rank \
                 {rank_at_most} at most"
            ),
        };
        let alone = match self.is_determined() {
            true => &*self.alone,
            false => "",
        };
        format!("{unknown}, the same in {frames}: {answer}, rank {rank} of {rank_required}{alone}")
    }
}

/// How many groups of images that see points are left when pairs that are used, and known poses in
/// rigs, turn images against each other; 1 where pairs are not known, as in models, whose images have
/// rotations.
fn groups_turned(input: &NamedGraph) -> usize {
    let (Some(matching), Some(cameras)) = (&input.matching, input.cameras) else {
        return 1;
    };
    let mut sets = UnionFind::new(cameras as usize);
    let pairs = matching.others.iter().filter(|pair| pair.used);
    let pairs = pairs.map(|pair| pair.images);
    let known = input.frames.iter().flat_map(|frames| &frames.groups);
    let known = known.flat_map(|group| group[1..].iter().map(|&other| (group[0], other)));
    for (a, b) in pairs.chain(known) {
        sets.union(a as usize, b as usize);
    }
    let ends = input.graph.edges().iter().map(|&(camera, _)| camera);
    let groups: BTreeSet<usize> = ends.map(|camera| sets.find(camera as usize)).collect();
    groups.len()
}

/// What base lines of rigs that are not known determine, with its evidence, where a verdict on tracks
/// does not say it all.
///
/// # Errors
/// If the work was stopped.
pub fn base_lines(
    input: &NamedGraph,
    verdict: &Verdict,
    watch: &Watch,
) -> Result<Option<(BaseLines, SharedBaseLines)>, Stopped> {
    let is_good = verdict.value != Value::NotFiniteSolvable;
    // That bodies by rules are rigid holds with frames as well; of a rank it is asked.
    let is_asked = verdict.model.in_space() && !(is_good && verdict.pieces.is_empty());
    let Some(frames) = input.frames.as_ref().filter(|_| is_asked) else {
        return Ok(None);
    };
    let (frames, seed) = (frames.rig_frames(), Options::default().seed);
    let Some(found) = SharedBaseLines::new(&input.graph, verdict, &frames, seed, watch)? else {
        return Ok(None);
    };
    let turns = turns(input, watch)?;
    let lines = BaseLines::new(&found, turns, input, verdict);
    Ok(Some((lines, found)).filter(|(lines, _)| !(is_good && lines.is_determined())))
}

/// A verdict with what base lines add that frames share, if they hold all together.
///
/// # Errors
/// If the work was stopped.
pub fn held(
    input: &NamedGraph,
    verdict: &Verdict,
    watch: &Watch,
) -> Result<Option<Verdict>, Stopped> {
    let found = base_lines(input, verdict, watch)?;
    Ok(found.and_then(|found| held_by(&found, input, verdict)))
}

fn held_by(
    (lines, found): &(BaseLines, SharedBaseLines),
    input: &NamedGraph,
    verdict: &Verdict,
) -> Option<Verdict> {
    let is_good = lines.is_determined();
    is_good.then(|| found.held(&input.graph, verdict))?
}

/// With how few turns of frames what frames determine is determined.
fn turns(input: &NamedGraph, watch: &Watch) -> Result<Turns, Stopped> {
    let Some(frames) = &input.frames else {
        return Ok(Turns::No);
    };
    let seed = Options::default().seed;
    Turns::needed(&input.graph, &frames.all_frames(), seed, watch)
}

/// How many images of frames see no track: their rig places them.
fn placed_by_rig(input: &NamedGraph) -> usize {
    let frames = input.frames.iter().map(|frames| frames.all_frames());
    let images = frames.flat_map(|frames| frames.frames().to_vec().concat());
    let unseen = images.filter(|&(image, _)| input.graph.edges_from(image).is_empty());
    unseen.count()
}

/// Whether a verdict shows already that nothing is lost in a plane: one body, by the merge rules
/// that hold there as well.
fn is_rigid_by_triangles(verdict: &Verdict) -> bool {
    let merges = verdict.contraction.bodies.iter();
    let mut merges = merges.flat_map(|body| &body.merge);
    verdict.pieces.is_empty()
        && verdict.contraction.by_rank.is_empty()
        && merges.all(|merge| matches!(merge, Merge::Shared { .. } | Merge::Triangle { .. }))
}

/// An answer on intrinsics, under the condition that centres are not all in one plane where calibrated cameras
/// are lost there, as far as that is looked at unasked.
///
/// # Errors
/// If the work was stopped.
pub fn of_intrinsics(
    (input, verdict): (&NamedGraph, &Verdict),
    (sensors, found): (&Sensors, &Metric),
    list_components: bool,
    watch: &Watch,
) -> Result<IntrinsicsLine, Stopped> {
    let graph = &input.graph;
    let mut line = IntrinsicsLine::new(input, sensors, found, list_components);
    let is_asked = line.is_metric() && graph.edges().len() <= UNASKED;
    if is_asked
        && !is_rigid_by_triangles(verdict)
        && !Planar::new(graph, verdict, Model::Calibrated, watch)?.is_determined()
    {
        line = line.under(NO_PLANE);
    }
    Ok(line)
}

/// Up to this many pairs centres in one plane are looked at unasked: the time of a pebble game grows
/// with the square of what contraction leaves.
const UNASKED: usize = 2000;

/// What is asked about the scope of an answer.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked {
    /// Whether all centres lie in one plane.
    pub planar: bool,
    /// Whether focal lengths are unknown.
    pub focal: bool,
}

/// What an answer holds for, beyond generic cameras of the model.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    conditions: Vec<String>,
    /// The conditions that decide, for the promise itself.
    provided: Vec<String>,
    planar: Option<Planar>,
    needs_turns: bool,
    focal: bool,
    base_lines: Option<(BaseLines, SharedBaseLines)>,
    own_frame: Option<OwnFrameLine>,
    intrinsics: Option<IntrinsicsLine>,
}

impl Scope {
    /// Centres in one plane are looked at if that is asked for, and, in graphs that are not large,
    /// if the general answer, which is good, may hide that it is not as good there. Base lines of rigs
    /// that are not known are looked at where tracks do not determine all without them.
    ///
    /// # Errors
    /// If the work was stopped.
    pub fn new(
        input: &NamedGraph,
        verdict: &Verdict,
        asked: Asked,
        watch: &Watch,
    ) -> Result<Self, Stopped> {
        let is_good = verdict.value != Value::NotFiniteSolvable;
        let may_hide = is_good
            && !verdict.model.in_plane()
            && input.cameras.is_none()
            && verdict.displacements.is_empty()
            && verdict.own_frame.is_none()
            && input.graph.edges().len() <= UNASKED
            && !is_rigid_by_triangles(verdict);
        let mut planar = (asked.planar || may_hide)
            .then(|| Planar::new(&input.graph, verdict, verdict.model, watch))
            .transpose()?;
        let is_lost = planar
            .as_ref()
            .is_some_and(|planar| !planar.is_determined());
        let hidden = is_good && is_lost;
        let (mut conditions, mut provided) = (Vec::new(), Vec::new());
        if asked.focal {
            conditions.push(FOCAL.to_owned());
            provided.push(AXES.to_owned());
        }
        let known = verdict.known_parts.len();
        if known > 0 {
            let parts = counted(known, "known part");
            conditions.push(format!(
                "taken for given: {parts}, sets of cameras whose relative position is known"
            ));
        }
        if !verdict.displacements.is_empty() {
            let is_given = verdict.displacements.vectors().is_some();
            let condition = if is_given { VECTORS } else { DISPLACEMENTS };
            conditions.push(condition.to_owned());
        }
        let mut base_lines = base_lines(input, verdict, watch)?;
        let by_frames = base_lines.as_ref().map(|(found, _)| found);
        let by_frames = by_frames.filter(|found| found.is_determined());
        let turns = match by_frames {
            Some(found) if found.without_turns => Turns::No,
            Some(found) if found.about_one_axis => Turns::AboutOneAxis,
            Some(_) => Turns::General,
            None if is_good && !verdict.displacements.is_empty() => turns(input, watch)?,
            None => Turns::No,
        };
        match turns {
            Turns::No => {}
            Turns::AboutOneAxis => provided.push(TURN.to_owned()),
            Turns::General => provided.push(TURN_MORE.to_owned()),
        }
        let placed = placed_by_rig(input);
        if placed > 0 && (is_good || by_frames.is_some()) {
            let images = counted(placed, "image");
            let are = if placed == 1 { "is" } else { "are" };
            provided.push(format!("{images} without a track {are} where the rig says"));
        }
        if base_lines.is_some() {
            conditions.push(BASE_LINES.to_owned());
        }
        if verdict.own_frame.is_some() {
            conditions.push(own_frame::CONDITION.to_owned());
        }
        if hidden {
            let condition = "holds for centres in general position; if all lie in one plane: not";
            conditions.push(condition.to_owned());
            provided.push(NO_PLANE.to_owned());
        }
        let photographs = condition::of_photographs(input, Model::Calibrated);
        let condition = condition::with(photographs, &provided);
        if let Some(planar) = planar.as_mut().filter(|planar| planar.is_determined()) {
            planar.condition.clone_from(&condition);
        }
        match &mut base_lines {
            Some((found, _)) if found.is_determined() => found.condition = condition,
            _ => {}
        }
        Ok(Self {
            conditions,
            provided,
            needs_turns: turns != Turns::No,
            focal: asked.focal,
            planar: planar.filter(|planar| asked.planar || !planar.is_determined()),
            base_lines,
            own_frame: OwnFrameLine::new(input, verdict),
            intrinsics: None,
        })
    }

    /// The verdict with what frames hold together, which is one component then.
    pub fn held<'v>(&self, input: &NamedGraph, verdict: &'v Verdict) -> Cow<'v, Verdict> {
        let found = self.base_lines.as_ref();
        let held = found.and_then(|found| held_by(found, input, verdict));
        held.map_or(Cow::Borrowed(verdict), Cow::Owned)
    }

    /// The condition of a promise, with those that decide here.
    pub(crate) fn promise(&self, condition: Option<String>) -> Option<String> {
        condition::with(condition, &self.provided)
    }

    /// Whether focal lengths are unknown.
    pub(crate) fn asks_focal(&self) -> bool {
        self.focal
    }

    /// Whether a promise holds only if frames turn.
    pub(crate) fn needs_turns(&self) -> bool {
        self.needs_turns
    }

    /// With what classes of cameras determine.
    pub fn with_intrinsics(mut self, found: IntrinsicsLine) -> Self {
        self.conditions.push(INTRINSICS.to_owned());
        if found.is_shared() {
            self.conditions.push(SENSORS.to_owned());
        }
        self.intrinsics = Some(found);
        self
    }

    /// What classes of cameras determine, if that was asked for.
    pub fn intrinsics(&self) -> Option<&IntrinsicsLine> {
        self.intrinsics.as_ref()
    }

    /// The conditions, in words.
    pub fn conditions(&self) -> &[String] {
        &self.conditions
    }

    /// What base lines that are not known determine, if there are any and they are needed.
    pub fn base_lines(&self) -> Option<&BaseLines> {
        self.base_lines.as_ref().map(|(found, _)| found)
    }

    /// What is given in a frame of its own, and what it adds.
    pub fn own_frame(&self) -> Option<&OwnFrameLine> {
        self.own_frame.as_ref()
    }

    /// The same with its evidence, for a certificate.
    pub fn shared_base_lines(&self) -> Option<&SharedBaseLines> {
        self.base_lines.as_ref().map(|(_, found)| found)
    }

    /// The answer for centres in one plane, if it was asked for or is worse.
    pub fn planar(&self) -> Option<&Planar> {
        self.planar.as_ref()
    }
}
