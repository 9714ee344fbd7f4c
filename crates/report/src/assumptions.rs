//! What an answer holds for: what a graph determines if all centres lie in one plane
//! (docs/theory.md, Corollary 13.4 and Theorem 13.23), what unknown focal lengths ask for, and which
//! parts were taken for known.

use serde::Serialize;
use viewcert::contract::Merge;
use viewcert::decide::{Value, Verdict, plane_rank_with_parts};
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
            "not solvable: infinitely many sets of cameras"
        };
        let Self {
            rank,
            rank_required,
            ..
        } = self;
        format!("{answer} (proved), rank {rank} of {rank_required}")
    }
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
}

impl Scope {
    /// Centres in one plane are looked at if that is asked for, and, in graphs that are not large,
    /// if the general answer, which is good, may hide that it is not as good there.
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
        if hidden {
            let condition = "holds for centres in general position; if all lie in one plane: not";
            conditions.push(condition.to_owned());
        }
        Ok(Self {
            conditions,
            planar: planar.filter(|planar| asked.planar || !planar.is_determined()),
        })
    }

    /// The conditions, in words.
    pub fn conditions(&self) -> &[String] {
        &self.conditions
    }

    /// The answer for centres in one plane, if it was asked for or is worse.
    pub fn planar(&self) -> Option<&Planar> {
        self.planar.as_ref()
    }
}
