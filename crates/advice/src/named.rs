//! What was found, in the user's names: the members of `verify --json` (docs/reconstruction.md).
//! Components are counted from 1 here, as in the text.

use serde::Serialize;
use viewcert_formats::NamedGraph;

/// Everything that was found about one graph.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Advice {
    /// Where components touch.
    pub joints: Vec<Joint>,
    /// Whether these are all.
    pub joints_complete: bool,
    /// Whether there is no component larger than a pair: joints are of little use to people then.
    #[serde(skip)]
    pub single_pairs_only: bool,
    /// Whether one component holds everything: nothing is to be joined.
    #[serde(skip)]
    pub is_whole: bool,
    /// Whether the graph is one of cameras and points.
    #[serde(skip)]
    pub of_tracks: bool,
    /// What components hang on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weak: Option<Weak>,
    /// Pairs that would join components.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub suggestions: Option<Vec<Suggestion>>,
    /// Where a photograph would help, if all that could be matched was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub photograph: Option<Photograph>,
    /// The list of pairs to match.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_match: Option<ToMatch>,
    /// One image.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub explain: Option<Explain>,
    /// What was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub export: Option<Export>,
}

impl Advice {
    /// Of one component, or none: nothing to do.
    pub(crate) fn whole() -> Self {
        Self::without_joints(true)
    }

    /// Nothing was looked for; `complete` if there is nothing to find.
    pub(crate) fn without_joints(complete: bool) -> Self {
        Self {
            joints_complete: complete,
            ..Self::default()
        }
    }

    /// Whether no two components touch, as far as joints were looked for.
    pub fn has_no_joints(&self) -> bool {
        self.joints.is_empty() && self.joints_complete
    }
}

/// Two components that touch.
#[derive(Clone, Debug, Serialize)]
pub struct Joint {
    /// The components.
    pub between: [usize; 2],
    /// How they touch, in words.
    pub how: String,
    /// The images (and points) where they touch.
    pub images: Vec<String>,
    /// The pairs.
    pub pairs: Vec<[String; 2]>,
    /// Paths from the one to the other through a third node.
    pub through: Vec<[String; 3]>,
    /// How many pairs, and paths through a third node, cross.
    pub crossing: usize,
    /// Of each of the pairs, if they are known.
    pub inliers: Option<Vec<u32>>,
    /// Degrees of freedom that are left between the two.
    pub freedom: usize,
    /// These in words.
    pub meaning: String,
    /// How strong the statement is: `proof` or `error-bound`.
    pub strength: &'static str,
}

/// What components hang on.
#[derive(Clone, Debug, Serialize)]
pub struct Weak {
    /// `pairs` or `images`; in a camera-point graph `observations` or `cameras and points`.
    pub of: &'static str,
    /// What a component stays without any other one: `finite-solvable`, if not unique, or `solvable`.
    pub kept: &'static str,
    /// What each of them is.
    pub items: Vec<WeakItem>,
    /// How many pairs are components by themselves; they are not among the items.
    pub single_pairs: usize,
}

/// Something that a component hangs on.
#[derive(Clone, Debug, Serialize)]
pub struct WeakItem {
    /// The two images of a pair, or one image.
    #[serde(rename = "images")]
    pub what: Vec<String>,
    /// The component.
    pub component: usize,
    /// Why, in words.
    pub why: String,
    /// How strong the statement is: `proof` or `error-bound`.
    pub strength: &'static str,
}

/// Pairs that would join components.
#[derive(Clone, Debug, Serialize)]
pub struct Suggestion {
    /// The pairs.
    pub pairs: Vec<[String; 2]>,
    /// Those of them that are left to match, with all images at the place of each.
    #[serde(skip)]
    pub open: Vec<[String; 2]>,
    /// Images of a frame at the place of one of these, which are the same camera: to be matched as well.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub also: Vec<String>,
    /// Verified matches of each pair, if they are known.
    pub inliers: Option<Vec<u32>>,
    /// Matches before verification of each pair, if they are known.
    pub matches: Option<Vec<u32>>,
    /// Components that become one.
    pub joins: Vec<usize>,
    /// How many single pairs become part of it as well.
    pub single_pairs: usize,
    /// How many frames without points of their own become part of it as well.
    #[serde(skip_serializing_if = "is_none")]
    pub frames: usize,
    /// How many images.
    pub images: usize,
    /// How many images the largest of the components gains.
    pub gain: usize,
    /// What has become of matching each pair so far: `not-tried`, `not-verified`, `left-out`, `few`,
    /// `in-vain`, `used`; null if the input does not say.
    pub tried: Option<Vec<&'static str>>,
    /// Why each pair is worth trying, in words.
    pub why: Vec<String>,
    /// What COLMAP's mappers need, of a database.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub needs: Option<Needs>,
    /// In a camera-point graph: how much has to come of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub enough: Option<Enough>,
}

/// A list of pairs to match that was written.
#[derive(Clone, Debug, Serialize)]
pub struct ToMatch {
    /// The list.
    pub file: String,
    /// How many pairs it has.
    pub pairs: usize,
    /// The command that matches and verifies them, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub command: Option<String>,
}

/// Two groups of images that need a photograph between them.
#[derive(Clone, Debug, Serialize)]
pub struct Photograph {
    /// The two images that are nearest to each other, one of each group.
    pub between: [String; 2],
    /// The images of both groups.
    pub groups: [Vec<String>; 2],
}

/// What COLMAP's mappers need by default, beside what is enough.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Needs {
    /// Inliers of a pair.
    pub inliers: u32,
    /// Points with a place that an image sees when it is registered.
    pub points: u32,
}

/// What is enough to join components of a camera-point graph.
#[derive(Clone, Debug, Serialize)]
pub struct Enough {
    /// Points that images would have to see.
    pub observations: Vec<Further>,
    /// Whether the two images are matched and used.
    pub matched: bool,
}

/// Points of a component that an image would have to see.
#[derive(Clone, Debug, Serialize)]
pub struct Further {
    /// The image.
    pub image: String,
    /// The component.
    pub component: usize,
    /// How many points.
    pub points: usize,
}

/// One image.
#[derive(Clone, Debug, Serialize)]
pub struct Explain {
    /// The image.
    pub image: String,
    /// Its components.
    pub components: Vec<usize>,
    /// How many of its pairs are in them.
    pub pairs_inside: usize,
    /// Its other pairs.
    pub pairs_outside: Vec<Outside>,
    /// In a camera-point graph: how many points of each component it sees, those first of which it
    /// sees most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sees: Option<Vec<SeesOf>>,
    /// Its pairs that are known and not used.
    pub unused: Vec<Unused>,
    /// Pairs of it that would join components.
    pub suggestions: Vec<Suggestion>,
}

/// How many points of a component an image sees.
#[derive(Clone, Debug, Serialize)]
pub struct SeesOf {
    /// The component.
    pub component: usize,
    /// How many of its points.
    pub points: usize,
    /// How many an incremental mapper wants by default, to add the image to a model of them.
    pub needs: u32,
}

/// A pair in no larger component.
#[derive(Clone, Debug, Serialize)]
pub struct Outside {
    /// The image.
    pub image: String,
    /// Its verified matches, if they are known.
    pub inliers: Option<u32>,
    /// The components of the other image.
    pub reaches: Vec<usize>,
}

/// A pair that was not used.
#[derive(Clone, Debug, Serialize)]
pub struct Unused {
    /// The image.
    pub image: String,
    /// Its verified matches.
    pub inliers: u32,
    /// Its matches before verification, if they are known.
    pub matches: Option<u32>,
}

/// What was written.
#[derive(Clone, Debug, Serialize)]
pub struct Export {
    /// The folder.
    pub folder: String,
    /// How many components have a folder.
    pub components: usize,
    /// Images in several of these.
    pub shared_images: Vec<String>,
    /// Images in none of these.
    pub outside: usize,
    /// The next commands, for each component.
    pub commands: Vec<Vec<String>>,
}

fn is_none(count: &usize) -> bool {
    *count == 0
}

/// Most names that are offered for one that is not there.
const MEANT: usize = 3;

/// What the user calls nodes.
pub(crate) struct Names<'a>(&'a NamedGraph);

impl<'a> Names<'a> {
    pub(crate) fn new(input: &'a NamedGraph) -> Self {
        Self(input)
    }

    pub(crate) fn of(&self, node: u32) -> String {
        self.0.labels.label(node).into_owned()
    }

    /// All images that a camera stands for: those of a frame that were taken at one place are one.
    pub(crate) fn all_of(&self, node: u32) -> impl Iterator<Item = String> {
        let frames = self.0.frames.as_ref();
        let others = frames.and_then(|frames| frames.together.get(&node));
        let others = others.into_iter().flatten().map(ToString::to_string);
        std::iter::once(self.of(node)).chain(others)
    }

    pub(crate) fn pair(&self, (a, b): (u32, u32)) -> [String; 2] {
        [self.of(a), self.of(b)]
    }

    /// What an edge is.
    pub(crate) fn edge(&self) -> &'static str {
        match self.0.cameras {
            None => "pair",
            Some(_) => "observation",
        }
    }

    /// The images: the cameras of a camera-point graph, else all nodes.
    pub(crate) fn images(&self) -> std::ops::Range<u32> {
        0..self.0.cameras.unwrap_or(self.0.graph.nodes() as u32)
    }

    /// The node of an image.
    pub(crate) fn find(&self, image: &str) -> anyhow::Result<u32> {
        let mut images = self.images();
        let found = images.find(|&v| self.0.labels.label(v) == image);
        found.ok_or_else(|| self.unknown(image))
    }

    /// An image that is not in the graph: those whose names end so, or an example.
    fn unknown(&self, image: &str) -> anyhow::Error {
        let names = || self.images().map(|v| self.of(v));
        let ends = |name: &String| !image.is_empty() && name.ends_with(image);
        let found: Vec<String> = names().filter(ends).take(MEANT + 1).collect();
        let meant = match &found[..] {
            [] => names().next().map_or(String::new(), |name| {
                format!("; names are those of the input, such as {name}")
            }),
            [one] => format!("; did you mean {one}?"),
            some if some.len() > MEANT => format!(
                "; {MEANT} and more names end so: {}, ...",
                some[..MEANT].join(", ")
            ),
            some => format!("; {} names end so: {}", some.len(), some.join(", ")),
        };
        anyhow::anyhow!("--explain {image}: no image has this name{meant}")
    }
}
