//! What was found, in the user's names: the members of `verify --json` (docs/reconstruction.md).
//! Components are counted from 1 here, as in the text.

use serde::Serialize;
use viewcert_formats::NamedGraph;
use viewcert_reconstruction::margin::MISSING;

/// Everything that was found about one graph.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct Acted {
    pub(super) joints: Vec<Joint>,
    pub(super) joints_complete: bool,
    /// Whether there is no component larger than a pair: joints are of little use to people then.
    #[serde(skip)]
    pub(super) single_pairs_only: bool,
    /// Whether one component holds everything: nothing is to be joined.
    #[serde(skip)]
    pub(super) is_whole: bool,
    /// Whether the graph is one of cameras and points.
    #[serde(skip)]
    pub(super) of_tracks: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) weak: Option<Weak>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) suggestions: Option<Vec<Suggestion>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) explain: Option<Explain>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) sweep: Option<Vec<SweepRow>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) margin: Option<Margin>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) export: Option<Export>,
}

impl Acted {
    /// Of one component, or none: nothing to do.
    pub(super) fn whole() -> Self {
        Self::without_joints(true)
    }

    /// Nothing was looked for; `complete` if there is nothing to find.
    pub(super) fn without_joints(complete: bool) -> Self {
        Self {
            joints_complete: complete,
            ..Self::default()
        }
    }

    /// Whether no two components touch, as far as joints were looked for.
    pub(crate) fn has_no_joints(&self) -> bool {
        self.joints.is_empty() && self.joints_complete
    }
}

/// Two components that touch.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Joint {
    pub(super) between: [usize; 2],
    pub(super) how: String,
    /// The images (and points) where they touch.
    pub(super) images: Vec<String>,
    pub(super) pairs: Vec<[String; 2]>,
    pub(super) through: Vec<[String; 3]>,
    /// How many pairs, and paths through a third node, cross.
    pub(super) crossing: usize,
    /// Of each of the pairs, if they are known.
    pub(super) inliers: Option<Vec<u32>>,
    pub(super) freedom: usize,
    pub(super) meaning: String,
    pub(super) strength: &'static str,
}

/// What components hang on.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Weak {
    /// `pairs` or `images`; in a camera-point graph `observations` or `cameras and points`.
    pub(super) of: &'static str,
    pub(super) items: Vec<WeakItem>,
    /// How many pairs are components by themselves; they are not among the items.
    pub(super) single_pairs: usize,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct WeakItem {
    /// The two images of a pair, or one image.
    #[serde(rename = "images")]
    pub(super) what: Vec<String>,
    pub(super) component: usize,
    pub(super) why: String,
    pub(super) strength: &'static str,
}

/// Pairs that would join components.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Suggestion {
    pub(super) pairs: Vec<[String; 2]>,
    pub(super) inliers: Option<Vec<u32>>,
    pub(super) matches: Option<Vec<u32>>,
    /// Components that become one.
    pub(super) joins: Vec<usize>,
    /// How many single pairs become part of it as well.
    pub(super) single_pairs: usize,
    pub(super) images: usize,
    pub(super) gain: usize,
    /// In a camera-point graph: how much has to come of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) enough: Option<Enough>,
}

/// What is enough to join components of a camera-point graph.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Enough {
    pub(super) observations: Vec<Further>,
    /// How many points of the one component have to become one with points of the other; null if
    /// none can.
    pub(super) merged: Option<usize>,
    /// Whether the two images are matched and used.
    pub(super) matched: bool,
}

/// Points of a component that an image would have to see.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Further {
    pub(super) image: String,
    pub(super) component: usize,
    pub(super) points: usize,
}

/// One image.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Explain {
    pub(super) image: String,
    pub(super) components: Vec<usize>,
    pub(super) pairs_inside: usize,
    pub(super) pairs_outside: Vec<Outside>,
    pub(super) unused: Vec<Unused>,
    pub(super) suggestions: Vec<Suggestion>,
}

/// A pair in no larger component.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Outside {
    pub(super) image: String,
    pub(super) inliers: Option<u32>,
    pub(super) reaches: Vec<usize>,
}

/// A pair that was not used.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Unused {
    pub(super) image: String,
    pub(super) inliers: u32,
    pub(super) matches: Option<u32>,
}

/// What a threshold gives.
#[derive(Clone, Debug, Serialize)]
pub(super) struct SweepRow {
    pub(super) threshold: u32,
    pub(super) pairs: usize,
    pub(super) images: usize,
    pub(super) connected: usize,
    pub(super) components: usize,
    pub(super) single_pairs: usize,
    pub(super) largest: usize,
    pub(super) verdict: &'static str,
}

/// Random thinnings.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Margin {
    /// `pairs` or `tracks`.
    pub(super) of: &'static str,
    pub(super) draws: u32,
    pub(super) seed: u64,
    /// Percent left out.
    pub(super) missing: [u32; MISSING.len()],
    pub(super) components: Vec<MarginOf>,
}

#[derive(Clone, Debug, Serialize)]
pub(super) struct MarginOf {
    pub(super) component: usize,
    /// How many draws left it whole, for each of `missing`.
    pub(super) whole: [u32; MISSING.len()],
    /// What percentage of its images stays in one component, on average and rounded down.
    pub(super) together: [u64; MISSING.len()],
}

/// What was written.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Export {
    pub(super) folder: String,
    /// How many components have a folder.
    pub(super) components: usize,
    /// Images in several of these.
    pub(super) shared_images: Vec<String>,
    /// Images in none of these.
    pub(super) outside: usize,
    /// The next commands, for each component.
    pub(super) commands: Vec<Vec<String>>,
}

/// What the user calls nodes.
pub(super) struct Names<'a>(&'a NamedGraph);

impl<'a> Names<'a> {
    pub(super) fn new(input: &'a NamedGraph) -> Self {
        Self(input)
    }

    pub(super) fn of(&self, node: u32) -> String {
        self.0.labels.label(node).into_owned()
    }

    pub(super) fn pair(&self, (a, b): (u32, u32)) -> [String; 2] {
        [self.of(a), self.of(b)]
    }

    /// What an edge is.
    pub(super) fn edge(&self) -> &'static str {
        match self.0.cameras {
            None => "pair",
            Some(_) => "observation",
        }
    }

    /// The images: the cameras of a camera-point graph, else all nodes.
    pub(super) fn images(&self) -> std::ops::Range<u32> {
        0..self.0.cameras.unwrap_or(self.0.graph.nodes() as u32)
    }

    /// The node of an image.
    pub(super) fn find(&self, image: &str) -> anyhow::Result<u32> {
        let mut images = self.images();
        let found = images.find(|&v| self.0.labels.label(v) == image);
        found.ok_or_else(|| super::unknown(image, self.images().next().map(|v| self.of(v))))
    }
}
