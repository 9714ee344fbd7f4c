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
//!   priors     what is determined if one sensor more is known        17.18
//! ```

mod bound;
mod members;
mod priors;
mod sensors;
mod system;

pub use priors::Prior;
pub use sensors::Sensors;

use crate::decide::Verdict;
use crate::geometry::draw::DrawKey;
use crate::geometry::model::Model;
use crate::graph::Graph;
use crate::watch::{Stopped, Watch};
use bound::Alike;
use members::Members;
use system::System;

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
    /// What the degree of its entries, as polynomials in what is drawn, is not above.
    pub degree: usize,
}

impl Metric {
    /// Whether all cameras are determined, with their intrinsics, up to similarities and finitely many
    /// choices. It is proved.
    pub fn is_metric(&self) -> bool {
        self.rank == self.required
    }

    /// Whether the rank is known, by bounds from both sides, and with it all that is said.
    pub fn is_proved(&self) -> bool {
        self.rank == self.at_most
    }

    /// An upper bound for the probability, over the draws, that the rank is larger than said, as its
    /// negative logarithm to the base 2; `None` if it is proved. A minor of the system has the degree of
    /// an entry for each unknown at most (Theorems 17.6 and 17.13), and the prime is 2^61 - 1 (Schwartz 1980).
    pub fn error_bits(&self) -> Option<u32> {
        let degree = (self.degree * self.unknowns.max(1)) as u64;
        (!self.is_proved()).then(|| 60_u32.saturating_sub(degree.ilog2()))
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
        assert_eq!(verdict.model, Model::Projective, "the projective verdict");
        let members = Members::new(graph, verdict, sensors);
        let nodes = 0..graph.nodes();
        let all = sensors.unknowns(nodes.clone());
        let held = nodes.filter(|&v| !members.of_node[v].is_empty());
        let of_held = sensors.unknowns(held);
        let required = all.saturating_sub(7);
        let every: Vec<u32> = (0..graph.nodes() as u32).collect();
        let mut found: Option<(usize, usize, Alike)> = None;
        let (mut unknowns, mut degree) = (0, 0);
        for draw in 0..DRAWS {
            let key = DrawKey {
                graph_sha256: verdict.sha256,
                core_sha256: None,
                seed,
                draw,
            };
            let system = System::new(&members, sensors, &key);
            let motions = system.motions(1, watch)?;
            (unknowns, degree) = (motions.columns, system.degree());
            let rank = of_held - motions.dimension;
            let alike = Alike::new(&members, &motions.first());
            let bound = alike.bound(&members, sensors).min(required);
            // A larger rank is nearer to the generic one, and its motions are those that there are.
            found = Some(match found {
                Some((before, at_most, alike)) if before >= rank => {
                    (before, at_most.min(bound), alike)
                }
                Some((_, at_most, _)) => (rank, at_most.min(bound), alike),
                None => (rank, bound, alike),
            });
            if found.as_ref().is_some_and(|found| found.0 == found.1) {
                break;
            }
        }
        let (rank, at_most, alike) = found.expect("a draw at least");
        let components = alike.components(graph, &members);
        let in_components: usize = components.iter().map(|component| component.pairs).sum();
        Ok(Self {
            rank,
            at_most,
            required,
            other_pairs: graph.edges().len() - in_components,
            components,
            determined: alike.determined(sensors),
            conditions: sensors.conditions(&every).0,
            unknowns,
            degree,
        })
    }
}

#[cfg(test)]
mod tests;
