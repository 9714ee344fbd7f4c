//! Unknown base lines that all frames of a rig share (docs/theory.md, Theorems 13.26 and 13.27).
//!
//! In: a verdict on a graph whose cameras have centres of their own, and which cameras are images of
//! one frame. Out: the rank of the same graph where a sensor is at one unknown place in its rig,
//! turned with every frame, between a lower bound at drawn centres and an upper one by counting.
//! What is solvable without frames is solvable with them, so this is asked for the rest. The evidence is
//! that of docs/certificate.md, section 13.

mod drawn;
mod members;

use crate::contract::Contraction;
use crate::contract::piece::Members as Block;
use crate::decide::claim::Strength;
use crate::decide::evidence::ModularDraw;
use crate::decide::solution_count::SolutionCount;
use crate::decide::verdict::{Component, Value, Verdict};
use crate::geometry::draw::DrawKey;
use crate::geometry::model::Model;
use crate::graph::Graph;
use crate::linalg::textbook::Pivots;
use crate::watch::{Stopped, Watch};
use drawn::Drawn;
use members::{Layout, Members};
use sha2::{Digest, Sha256};
use std::collections::HashMap;

/// How many draws of centres are tried while the bounds do not meet.
const DRAWS: u64 = 3;

/// Images of frames, by their nodes, and the sensor of each; in the one order and numbering in which
/// certificates have them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RigFrames {
    /// The images of every frame that has two or more: increasing nodes, none of them twice, and
    /// sensors; by first nodes.
    frames: Vec<Vec<(u32, u32)>>,
    /// For every sensor, in the order in which they occur first, whether its place in its rig is known.
    known: Vec<bool>,
}

impl RigFrames {
    /// Frames of the sensors `0 .. known.len()`, each with its images: nodes and their sensors, which
    /// are numbered anew. A frame with a single image says nothing and is left out. O(images log images).
    ///
    /// # Errors
    /// A node that is in two frames, a sensor twice in one, or a sensor that is not there.
    pub fn new(
        frames: impl IntoIterator<Item = Vec<(u32, u32)>>,
        known: Vec<bool>,
    ) -> Result<Self, &'static str> {
        let frames = frames.into_iter().filter(|images| images.len() > 1);
        let mut frames: Vec<Vec<(u32, u32)>> = frames.collect();
        let mut nodes: Vec<u32> = frames.iter().flatten().map(|&(node, _)| node).collect();
        nodes.sort_unstable();
        if nodes.windows(2).any(|two| two[0] == two[1]) {
            return Err("a node is in two frames");
        }
        for images in &frames {
            let mut sensors: Vec<u32> = images.iter().map(|&(_, sensor)| sensor).collect();
            sensors.sort_unstable();
            if sensors.windows(2).any(|two| two[0] == two[1]) {
                return Err("a frame has two images of one sensor");
            }
            if sensors.iter().any(|&sensor| sensor as usize >= known.len()) {
                return Err("a sensor is not there");
            }
        }
        frames.iter_mut().for_each(|images| images.sort_unstable());
        frames.sort_unstable();
        let mut number: HashMap<u32, u32> = HashMap::new();
        let mut known_anew = Vec::new();
        for (_, sensor) in frames.iter_mut().flatten() {
            let next = number.len() as u32;
            *sensor = *number.entry(*sensor).or_insert_with(|| {
                known_anew.push(known[*sensor as usize]);
                next
            });
        }
        Ok(Self {
            frames,
            known: known_anew,
        })
    }

    /// The frames, by their first nodes: their images, increasing nodes with their sensors.
    pub fn frames(&self) -> &[Vec<(u32, u32)>] {
        &self.frames
    }

    /// The sensors whose places are known, increasing.
    pub fn known(&self) -> impl Iterator<Item = u32> + '_ {
        (0..)
            .zip(&self.known)
            .filter_map(|(sensor, &known)| known.then_some(sensor))
    }

    /// Whether the place of some sensor is unknown beside another one of linked sensors.
    pub fn has_unknown(&self) -> bool {
        Layout::new(self).unknown > 0
    }

    /// The hash by which certificates name the frames (docs/certificate.md, section 13). O(images).
    pub fn sha256(&self) -> [u8; 32] {
        let mut hash = Sha256::new_with_prefix(b"viewcert frames 1\n");
        hash.update((self.frames.len() as u64).to_le_bytes());
        for images in &self.frames {
            hash.update((images.len() as u64).to_le_bytes());
            for (node, sensor) in images {
                hash.update(node.to_le_bytes());
                hash.update(sensor.to_le_bytes());
            }
        }
        hash.update((self.known().count() as u64).to_le_bytes());
        self.known().for_each(|k| hash.update(k.to_le_bytes()));
        hash.finalize().into()
    }

    /// How many frames have two images or more.
    pub fn len(&self) -> usize {
        self.frames.len()
    }

    /// Whether there is no such frame.
    pub fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }
}

/// How frames turn against each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turns {
    /// Not at all: a car on a straight road, a drone on one line.
    No,
    /// About one axis: a vehicle.
    AboutOneAxis,
    /// In general.
    General,
}

impl Turns {
    /// With how few turns a graph is determined that frames in general determine, as far as drawn
    /// positions show; known base lines and unknown ones count.
    ///
    /// # Errors
    /// If the work was stopped.
    pub fn needed(
        graph: &Graph,
        frames: &RigFrames,
        seed: u64,
        watch: &Watch,
    ) -> Result<Self, Stopped> {
        let layout = Layout::new(frames);
        // Displacements that are known merge bodies as if frames turned in general.
        let contraction = Contraction::new(graph, Model::Calibrated);
        let members = Members::new(graph, &contraction, &layout);
        let key = DrawKey {
            graph_sha256: crate::graph::sha256(graph),
            core_sha256: Some(frames.sha256()),
            seed,
            draw: 2 * DRAWS,
        };
        for turns in [Self::No, Self::AboutOneAxis] {
            if let Some(drawn) = Drawn::new(&members, &layout, &key, turns) {
                let free = drawn.motion(&vec![false; layout.unknown], watch)?;
                if free.dimension + members.outside == members.trivial() {
                    return Ok(turns);
                }
            }
        }
        Ok(Self::General)
    }
}

/// What a graph determines if base lines that are not known are the same in all frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SharedBaseLines {
    /// Frames with two images or more.
    pub frames: usize,
    /// Base lines that are not known.
    pub base_lines: usize,
    /// The rank at drawn centres, which the generic rank is not below.
    pub rank: usize,
    /// What the generic rank is not above.
    pub at_most: usize,
    /// The rank of a graph that determines all.
    pub required: usize,
    /// How many parts move against each other, cameras that nothing holds among them: so many at
    /// least if the rank is proved.
    pub parts: usize,
    /// If all is determined, whether it is so too where all frames turn about one axis, like a
    /// vehicle: proved if it is, and otherwise what drawn positions show.
    pub about_one_axis: bool,
    /// The hash of the graph.
    pub(crate) graph_sha256: [u8; 32],
    pub(crate) evidence: BaseLinesEvidence,
}

/// What a certificate shows of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct BaseLinesEvidence {
    pub(crate) frames: RigFrames,
    /// Pivots at drawn centres, and, where all is determined, at centres with one axis.
    pub(crate) lower: (ModularDraw, Pivots),
    pub(crate) one_axis: Option<(ModularDraw, Pivots)>,
    /// Sensors whose places are held, and the blocks with the bound they give, if it is below what
    /// is required.
    pub(crate) upper: Option<(Vec<u32>, Vec<Block>)>,
    /// How many nodes, frames and places nothing holds; no block has them.
    pub(crate) alone: usize,
}

impl SharedBaseLines {
    /// Whether all cameras, points and base lines are unique, up to translation and, where nothing
    /// fixes it, scale. It is proved.
    pub fn is_determined(&self) -> bool {
        self.rank == self.required
    }

    /// Whether it is proved that they are not.
    pub fn is_refuted(&self) -> bool {
        self.at_most < self.required
    }

    /// Whether it is proved that there are just so many parts: counting allows each of them no motion
    /// in itself, and one motion tells all of them apart (docs/theory.md, Theorem 13.28).
    pub fn parts_are_all(&self) -> bool {
        let blocks = self.evidence.upper.as_ref();
        let blocks = blocks.map_or(1, |(_, blocks)| blocks.len());
        self.rank == self.at_most && blocks + self.evidence.alone == self.parts
    }

    /// A verdict on the graph, if frames determine all of it: with them it is one component.
    pub fn held(&self, graph: &Graph, verdict: &Verdict) -> Option<Verdict> {
        self.is_determined().then(|| Verdict {
            value: Value::Solvable,
            value_strength: Strength::Proof,
            solutions: Some(SolutionCount::one()),
            rank: self.rank,
            required: self.required,
            components: vec![Component::whole(graph, &verdict.contraction)],
            pieces: Vec::new(),
            ..verdict.clone()
        })
    }

    /// The answer, as certificates have it.
    pub fn value(&self) -> &'static str {
        if self.is_determined() {
            Value::Solvable.name()
        } else if self.is_refuted() {
            Value::NotFiniteSolvable.name()
        } else {
            "open"
        }
    }

    /// Asks what frames add to a verdict of the calibrated model on a graph. `None` if no base line is
    /// unknown, or the vectors of displacements are given, with which this is not asked. The cost is
    /// that of an elimination with three columns for each frame and for each node that two bodies or
    /// loose edges share.
    ///
    /// # Errors
    /// If the work was stopped.
    ///
    /// # Panics
    /// If verdict or frames are of another graph.
    pub fn new(
        graph: &Graph,
        verdict: &Verdict,
        frames: &RigFrames,
        seed: u64,
        watch: &Watch,
    ) -> Result<Option<Self>, Stopped> {
        let layout = Layout::new(frames);
        if layout.unknown == 0 || verdict.displacements.vectors().is_some() {
            return Ok(None);
        }
        let members = Members::new(graph, &verdict.contraction, &layout);
        let frames_sha256 = frames.sha256();
        let key = |draw| DrawKey {
            graph_sha256: verdict.sha256,
            core_sha256: Some(frames_sha256),
            seed,
            draw,
        };
        let mut found: Option<Self> = None;
        for draw in 0..DRAWS {
            let Some(drawn) = Drawn::new(&members, &layout, &key(draw), Turns::General) else {
                continue;
            };
            let required = members.required(&layout);
            let free = drawn.motion(&vec![false; layout.unknown], watch)?;
            let rank = required + members.trivial() - free.dimension - members.outside;
            let before = found.as_mut();
            let (mut at_most, mut upper) = before.map_or((required, None), |before| {
                (before.at_most, before.evidence.upper.take())
            });
            for held in layout.sets() {
                if rank >= at_most {
                    break;
                }
                let motion = drawn.motion(&held, watch)?;
                let bound = members.bound(&layout, &held, &motion.classes);
                if bound < at_most {
                    at_most = bound;
                    upper = Some((layout.sensors(&held), members.blocks(&motion.classes)));
                }
            }
            let alone = members.alone + members.unseen;
            let now = Self {
                frames: frames.len(),
                base_lines: layout.unknown,
                rank,
                at_most,
                required,
                about_one_axis: false,
                parts: free.classes.iter().max().map_or(0, |last| last + 1) + alone,
                graph_sha256: verdict.sha256,
                evidence: BaseLinesEvidence {
                    frames: frames.clone(),
                    lower: (drawn.name(), free.pivots),
                    one_axis: None,
                    upper: None,
                    alone,
                },
            };
            // A larger rank is nearer to the generic one, and its motions are those that there are.
            let mut best = found
                .take()
                .filter(|before| before.rank >= now.rank)
                .unwrap_or(now);
            (best.at_most, best.evidence.upper) = (at_most, upper);
            let meet = best.rank == best.at_most;
            found = Some(best);
            if meet {
                break;
            }
        }
        if let Some(found) = found.as_mut().filter(|found| found.is_determined())
            && let Some(drawn) = Drawn::new(&members, &layout, &key(2 * DRAWS), Turns::AboutOneAxis)
        {
            let free = drawn.motion(&vec![false; layout.unknown], watch)?;
            found.about_one_axis = free.dimension + members.outside == members.trivial();
            let shown = found.about_one_axis.then(|| (drawn.name(), free.pivots));
            found.evidence.one_axis = shown;
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests;
