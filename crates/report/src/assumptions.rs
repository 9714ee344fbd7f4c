//! What an answer holds for: what a graph determines if all centres lie in one plane
//! (docs/theory.md, Corollary 13.4 and Theorem 13.23), what unknown focal lengths ask for, and which
//! parts were taken for known.

use crate::condition;
use crate::intrinsics::IntrinsicsLine;
use serde::Serialize;
use std::collections::BTreeSet;
use viewcert::contract::Merge;
use viewcert::decide::{Options, SharedBaseLines, Value, Verdict, plane_rank_with_parts};
use viewcert::geometry::model::Model;
use viewcert::graph::{Graph, UnionFind};
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
                     lengths if pixels are square, principal points are known, and its two optical \
                     axes do not meet";

/// The answer for centres that are generic in one plane. All of it is proved.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Planar {
    verdict: &'static str,
    rank: usize,
    rank_required: usize,
}

impl Planar {
    /// Counts, with rank R the generic rank of the plane direction matrix: 4 rank R + 3 (n - k)
    /// for J_P and rank R + n - k for N, k the number of connected components. Known parts are as
    /// good as all their pairs (Theorem 4.14).
    ///
    /// # Errors
    /// If the work was stopped.
    pub fn new(graph: &Graph, verdict: &Verdict, watch: &Watch) -> Result<Self, Stopped> {
        let (model, known) = (verdict.model, &verdict.known_parts);
        let plane = plane_rank_with_parts(graph, known, watch)?;
        let mut parts = UnionFind::new(graph.nodes());
        let edges = graph.edges().iter().copied();
        let neighbours = known.iter().flat_map(|part| part.iter().zip(&part[1..]));
        let edges = edges.chain(neighbours.map(|(&i, &j)| (i, j)));
        let unions = edges.filter(|&(i, j)| parts.union(i as usize, j as usize));
        // n - k: the edges of a spanning forest.
        let joined = unions.count();
        let rank = match model {
            Model::Projective => 4 * plane + 3 * joined,
            Model::Calibrated => plane + joined,
            Model::Affine => 4 * plane,
        };
        let rank_required = model.required(graph.nodes());
        let verdict = match model {
            _ if rank < rank_required => "not-finite-solvable",
            _ => "solvable",
        };
        Ok(Self {
            verdict,
            rank,
            rank_required,
        })
    }

    /// Whether no motion is left, beyond the trivial ones.
    pub fn is_determined(&self) -> bool {
        self.rank == self.rank_required
    }

    /// The answer in words.
    pub fn words(&self) -> String {
        let answer = if self.is_determined() {
            "solvable: the cameras are unique"
        } else {
            "not-finite-solvable: infinitely many sets of cameras"
        };
        let Self {
            rank,
            rank_required,
            ..
        } = self;
        format!("{answer} (proved), rank {rank} of {rank_required}")
    }
}

/// What is supposed where the base lines of rigs are one unknown for all frames.
const BASE_LINES: &str = "base lines: a sensor is at one place in its rig in all frames, these places and the turns of \
                          frames are in general position, rotations known";

/// What is supposed where cameras have classes.
const INTRINSICS: &str = "intrinsics: what is known of them is known exactly, and optical axes \
                          are in general position (cameras that all look at one point are not)";

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
    /// Whether it is solvable too if all frames turn about one axis.
    about_one_axis: bool,
    /// How many groups of images are not turned against each other by pairs and known poses, if more
    /// than one: where they are then rests on rotations that nothing gives.
    #[serde(skip_serializing_if = "Option::is_none")]
    groups_not_turned: Option<usize>,
}

impl BaseLines {
    fn new(found: &SharedBaseLines, input: &NamedGraph) -> Self {
        let groups = groups_turned(input);
        let is_good = found.is_determined() && groups <= 1;
        let condition = condition::of_photographs(input, Model::Calibrated);
        Self {
            condition: condition.filter(|_| is_good),
            about_one_axis: found.about_one_axis,
            groups_not_turned: Some(groups).filter(|&groups| groups > 1),
            frames: found.frames,
            unknown: found.base_lines,
            verdict: if found.is_determined() && groups > 1 {
                "open"
            } else {
                found.value()
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

    /// The answer in words.
    pub fn words(&self) -> String {
        let Self {
            rank,
            rank_at_most,
            rank_required,
            ..
        } = self;
        let unknown = counted(self.unknown, "unknown base line");
        let frames = counted(self.frames, "frame");
        let answer = match self.verdict {
            "solvable" => format!(
                "solvable: the positions of all cameras and points are unique{} (proved)",
                self.condition
                    .iter()
                    .map(|words| format!(" {words}"))
                    .collect::<String>()
            ),
            "open" if rank == rank_required => format!(
                "open: the positions would be unique if rotations were known, but no pair of images and no \
                 known pose turns {} against each other",
                counted(self.groups_not_turned.unwrap_or(0), "group")
            ),
            "open" => format!(
                "open: not determined at drawn positions, and counting gives no proof (rank {rank_at_most} at most)"
            ),
            _ if rank == rank_at_most => format!(
                "not-finite-solvable: {}{} move against each other (proved)",
                if self.parts_proved { "" } else { "at least " },
                counted(self.parts, "part")
            ),
            _ => format!(
                "not-finite-solvable (proved): {} move against each other at drawn positions, rank \
                 {rank_at_most} at most",
                counted(self.parts, "part")
            ),
        };
        let axis = if self.is_determined() && !self.about_one_axis {
            "; if all frames turn about one axis, as a vehicle's do: not"
        } else {
            ""
        };
        format!("{unknown}, the same in {frames}: {answer}, rank {rank} of {rank_required}{axis}")
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
    let is_asked = verdict.model == Model::Calibrated && !(is_good && verdict.pieces.is_empty());
    let Some(frames) = input.frames.as_ref().filter(|_| is_asked) else {
        return Ok(None);
    };
    let (frames, seed) = (frames.rig_frames(), Options::default().seed);
    let found = SharedBaseLines::new(&input.graph, verdict, &frames, seed, watch)?;
    let found = found.map(|found| (BaseLines::new(&found, input), found));
    Ok(found.filter(|(found, _)| !(is_good && found.is_determined())))
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
    planar: Option<Planar>,
    base_lines: Option<(BaseLines, SharedBaseLines)>,
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
            && verdict.model != Model::Affine
            && input.cameras.is_none()
            && verdict.displacements.is_empty()
            && input.graph.edges().len() <= UNASKED
            && !is_rigid_by_triangles(verdict);
        let planar = (asked.planar || may_hide)
            .then(|| Planar::new(&input.graph, verdict, watch))
            .transpose()?;
        let hidden = is_good && planar.is_some_and(|planar| !planar.is_determined());
        let mut conditions = Vec::new();
        if asked.focal {
            conditions.push(FOCAL.to_owned());
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
        let base_lines = base_lines(input, verdict, watch)?;
        if base_lines.is_some() {
            conditions.push(BASE_LINES.to_owned());
        }
        if hidden {
            let condition = "holds for centres in general position; if all lie in one plane: not";
            conditions.push(condition.to_owned());
        }
        Ok(Self {
            conditions,
            planar: planar.filter(|planar| asked.planar || !planar.is_determined()),
            base_lines,
            intrinsics: None,
        })
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

    /// The same with its evidence, for a certificate.
    pub fn shared_base_lines(&self) -> Option<&SharedBaseLines> {
        self.base_lines.as_ref().map(|(_, found)| found)
    }

    /// The answer for centres in one plane, if it was asked for or is worse.
    pub fn planar(&self) -> Option<&Planar> {
        self.planar.as_ref()
    }
}
