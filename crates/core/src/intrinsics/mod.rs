//! Cameras of which each has a class of its own: which intrinsics does a viewing graph determine?
//! (docs/theory.md, section 17.)
//!
//! In: a verdict of the projective model, and what is not known of the intrinsics of each camera.
//! Out: whether the graph is metric, that is, determines all cameras up to similarities and finitely
//! many choices; the pairs that are metric against each other, and the cameras whose intrinsics are
//! determined.
//!
//! ```text
//! metric(graph, classes)
//!   sensors    which images have the same intrinsics                 theory 17.11
//!   members    rigid bodies grow, become metric, and grow again      17.3, 17.5, 17.12
//!   system     what they share, at drawn centres and axes            17.6, 17.9, 17.13
//!   bound      what moves alike in one motion, counted               17.7, 17.8, 17.14
//!
//! certified(graph, classes)
//!   certified  the same on the members of a certificate, with what shows it
//! ```

mod bound;
mod certified;
mod members;
mod sensors;
mod system;

pub use certified::Certified;
pub use sensors::Sensors;

use crate::decide::Verdict;
use crate::geometry::draw::DrawKey;
use crate::graph::Graph;
use crate::watch::{Stopped, Watch};
use bound::Alike;
use members::Members;
use system::{Motions, System};

/// How many draws are tried while the bounds do not meet.
const DRAWS: u64 = 3;

/// What is not known of the intrinsics of a camera; what is not named is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    /// Nothing: a calibrated camera.
    Known,
    /// The focal length.
    Focal,
    /// The focal length and the principal point.
    FocalAndPoint,
    /// All five.
    Unknown,
}

impl Class {
    /// All classes, and the words that stand for them in files and reports.
    pub const ALL: [(Self, &'static str); 4] = [
        (Self::Known, "known"),
        (Self::Focal, "focal"),
        (Self::FocalAndPoint, "focal+point"),
        (Self::Unknown, "unknown"),
    ];

    /// The class that a word stands for.
    pub fn of_word(word: &str) -> Option<Self> {
        let mut all = Self::ALL.into_iter();
        all.find(|(_, of_class)| *of_class == word)
            .map(|(class, _)| class)
    }

    /// The word that stands for it.
    pub fn word(self) -> &'static str {
        let mut all = Self::ALL.into_iter();
        let found = all.find(|&(class, _)| class == self);
        found.expect("one of all").1
    }

    /// How many intrinsics are unknown, d_v.
    pub fn unknowns(self) -> usize {
        match self {
            Self::Known => 0,
            Self::Focal => 1,
            Self::FocalAndPoint => 3,
            Self::Unknown => 5,
        }
    }

    /// How many conditions a camera puts on a motion of a rigid body, q_v.
    pub fn conditions(self) -> usize {
        5 - self.unknowns()
    }
}

/// Pairs that are metric against each other: all motions are one similarity on their nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MetricComponent {
    /// Its nodes, increasing.
    pub nodes: Vec<u32>,
    /// How many pairs it has.
    pub pairs: usize,
}

/// What a graph determines whose cameras have classes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Metric {
    /// The rank at drawn centres and axes, which the generic rank is not below.
    pub rank: usize,
    /// What the generic rank is not above.
    pub at_most: usize,
    /// The rank of a metric graph: all unknowns less the 7 of similarities.
    pub required: usize,
    /// The metric components, the largest first. What they are is proved if the rank is.
    pub components: Vec<MetricComponent>,
    /// How many pairs are in none.
    pub other_pairs: usize,
    /// For each node whether its intrinsics are determined; those of known cameras are. It is proved
    /// if the rank is.
    pub determined: Vec<bool>,
    /// The sum of all conditions, of which a metric graph needs 8.
    pub conditions: usize,
    /// How many unknowns the system has that was eliminated.
    pub unknowns: usize,
}

/// What one draw shows.
struct Shown {
    rank: usize,
    at_most: usize,
    alike: Alike,
    draw: u64,
    motions: Motions,
}

impl Metric {
    /// Whether all cameras are determined, with their intrinsics, up to similarities and finitely many
    /// choices. It is proved.
    pub fn is_metric(&self) -> bool {
        self.rank == self.required
    }

    /// `metric`, `not-metric`, or `open` if the bounds do not tell: as certificates and JSON have it.
    pub fn verdict(&self) -> &'static str {
        verdict(self.rank, self.at_most, self.required)
    }

    /// Whether the rank is known, by bounds from both sides, and with it all that is said. Otherwise nothing
    /// is claimed of how likely it is that the rank is larger: one fixed prime says nothing of that.
    pub fn is_proved(&self) -> bool {
        self.rank == self.at_most
    }

    /// Asks what classes of cameras add to the verdict of the projective model on a graph, where each
    /// node has a sensor of its own; otherwise as [`Metric::with_sensors`].
    ///
    /// # Errors
    /// If the work was stopped.
    ///
    /// # Panics
    /// If there is not one class for each node, or the verdict is of another model or graph.
    pub fn new(
        graph: &Graph,
        verdict: &Verdict,
        classes: &[Class],
        seed: u64,
        watch: &Watch,
    ) -> Result<Self, Stopped> {
        Self::with_sensors(graph, verdict, &Sensors::own(classes), seed, watch)
    }

    /// Asks what the intrinsics of sensors add to the verdict of the projective model on a graph. The
    /// cost is that of a few contractions, and of an elimination with 15 columns for each member that is
    /// not metric and 4 for each other.
    ///
    /// # Errors
    /// If the work was stopped.
    ///
    /// # Panics
    /// If there is not one sensor for each node, or the verdict is of another model or graph.
    pub fn with_sensors(
        graph: &Graph,
        verdict: &Verdict,
        sensors: &Sensors,
        seed: u64,
        watch: &Watch,
    ) -> Result<Self, Stopped> {
        assert_eq!(sensors.nodes(), graph.nodes(), "a sensor for each node");
        assert!(!verdict.model.is_linear(), "the projective verdict");
        let members = Members::new(graph, verdict, sensors);
        let of = (graph, verdict.sha256);
        Ok(Self::of_members(of, &members, sensors, seed, watch)?.0)
    }

    /// What is found with these members, and the draw that shows it.
    fn of_members(
        (graph, graph_sha256): (&Graph, [u8; 32]),
        members: &Members,
        sensors: &Sensors,
        seed: u64,
        watch: &Watch,
    ) -> Result<(Self, Shown), Stopped> {
        let nodes = 0..graph.nodes();
        let all = sensors.unknowns(nodes.clone());
        let held = nodes.filter(|&v| !members.of_node[v].is_empty());
        let of_held = sensors.unknowns(held);
        let required = all.saturating_sub(7);
        let every: Vec<u32> = (0..graph.nodes() as u32).collect();
        let mut best: Option<Shown> = None;
        for draw in 0..DRAWS {
            let key = key(graph_sha256, sensors, seed, draw);
            let motions = System::new(members, sensors, &key).motions(watch)?;
            let rank = of_held - motions.dimension;
            let alike = Alike::new(members, &motions.moved);
            let at_most = alike.bound(members, sensors).min(required);
            // A larger rank is nearer to the generic one, and its motions are those that there are.
            let is_better = best
                .as_ref()
                .is_none_or(|best| rank > best.rank || rank == best.rank && at_most < best.at_most);
            if is_better {
                best = Some(Shown {
                    rank,
                    at_most,
                    alike,
                    draw,
                    motions,
                });
            }
            if rank == at_most {
                break;
            }
        }
        let shown = best.expect("a draw at least");
        let components = shown.alike.components(graph, members);
        let in_components: usize = components.iter().map(|component| component.pairs).sum();
        let found = Self {
            rank: shown.rank,
            at_most: shown.at_most,
            required,
            other_pairs: graph.edges().len() - in_components,
            components,
            determined: shown.alike.determined(sensors),
            conditions: sensors.conditions(&every).0,
            unknowns: shown.motions.motion.len(),
        };
        Ok((found, shown))
    }
}

/// What bounds of the rank say.
fn verdict(rank: usize, at_most: usize, required: usize) -> &'static str {
    if rank == required {
        "metric"
    } else if at_most < required {
        "not-metric"
    } else {
        "open"
    }
}

/// The draws of centres, axes and rotations.
fn key(graph_sha256: [u8; 32], sensors: &Sensors, seed: u64, draw: u64) -> DrawKey {
    DrawKey {
        graph_sha256,
        core_sha256: Some(sensors.sha256()),
        seed,
        draw,
    }
}

#[cfg(test)]
mod tests;
