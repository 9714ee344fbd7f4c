//! Unknown base lines that all frames of a rig share (docs/theory.md, Theorems 13.26 and 13.27).
//!
//! In: a verdict on a graph whose cameras have centres of their own, and which cameras are images of
//! one frame. Out: the rank of the same graph where a sensor is at one unknown place in its rig,
//! turned with every frame, between a lower bound at drawn centres and an upper one by counting.
//! What is solvable without frames is solvable with them, so this is asked for the rest.

mod drawn;
mod members;

use crate::decide::verdict::Verdict;
use crate::geometry::draw::DrawKey;
use crate::graph::Graph;
use crate::watch::{Stopped, Watch};
use drawn::Drawn;
use members::{Layout, Members};

/// How many draws of centres are tried while the bounds do not meet.
const DRAWS: u64 = 3;

/// Images of frames, by their nodes, and the sensor of each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RigFrames {
    /// The images of every frame that has two or more: nodes, none of them twice, and sensors.
    frames: Vec<Vec<(u32, u32)>>,
    /// For every sensor whether its place in its rig is known.
    known: Vec<bool>,
}

impl RigFrames {
    /// Frames of the sensors `0 .. known.len()`, each with its images: nodes and their sensors. A
    /// frame with a single image says nothing and is left out. O(images log images).
    ///
    /// # Errors
    /// A node that is in two frames, a sensor twice in one, or a sensor that is not there.
    pub fn new(
        frames: impl IntoIterator<Item = Vec<(u32, u32)>>,
        known: Vec<bool>,
    ) -> Result<Self, &'static str> {
        let frames = frames.into_iter().filter(|images| images.len() > 1);
        let frames: Vec<Vec<(u32, u32)>> = frames.collect();
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
        Ok(Self { frames, known })
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

/// What a graph determines if base lines that are not known are the same in all frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
        let mut found: Option<Self> = None;
        for draw in 0..DRAWS {
            let key = DrawKey {
                graph_sha256: verdict.sha256,
                core_sha256: None,
                seed,
                draw,
            };
            let Some(drawn) = Drawn::new(&members, &layout, &key, false) else {
                continue;
            };
            let required = members.required(&layout);
            let free = drawn.motion(&vec![false; layout.unknown], watch)?;
            let rank = required + members.trivial() - free.dimension - members.outside;
            let mut at_most = found.map_or(required, |before| before.at_most);
            for held in layout.sets() {
                if rank >= at_most {
                    break;
                }
                let motion = drawn.motion(&held, watch)?;
                at_most = at_most.min(members.bound(&layout, &held, &motion.classes));
            }
            let now = Self {
                frames: frames.len(),
                base_lines: layout.unknown,
                rank,
                at_most,
                required,
                about_one_axis: false,
                parts: free.classes.iter().max().map_or(0, |last| last + 1) + members.alone,
            };
            // A larger rank is nearer to the generic one, and its motions are those that there are.
            let best = match found {
                Some(before) if before.rank >= now.rank => Self {
                    at_most: now.at_most,
                    ..before
                },
                _ => now,
            };
            found = Some(best);
            if best.rank == best.at_most {
                break;
            }
        }
        if let Some(found) = found.as_mut().filter(|found| found.is_determined()) {
            let key = DrawKey {
                graph_sha256: verdict.sha256,
                core_sha256: None,
                seed,
                draw: 2 * DRAWS,
            };
            if let Some(drawn) = Drawn::new(&members, &layout, &key, true) {
                let free = drawn.motion(&vec![false; layout.unknown], watch)?;
                found.about_one_axis = free.dimension + members.outside == members.trivial();
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests;
