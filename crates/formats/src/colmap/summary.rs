//! What is said of a database: its summary, and what was chosen and left out.

use crate::error::{Kind, Problem};
use std::collections::{BTreeMap, BTreeSet, HashMap};

use rusqlite::Connection;

use super::focal::{of_cameras, of_images};
use super::keypoints;
use super::pairs::Tables;
use super::{Bin, ConfigCount, DatabaseFacts, Focal, Pipeline};
use viewcert::graph::{Graph, UnionFind};
use viewcert::wording::counted;

impl Tables {
    /// The summary; so many images have a position.
    ///
    /// # Errors
    /// Those of SQLite.
    pub(super) fn facts(
        &self,
        connection: &Connection,
        graph: &Graph,
        positions: usize,
    ) -> Result<DatabaseFacts, Problem> {
        let paired: BTreeSet<u32> = graph.edges().iter().flat_map(|&(a, b)| [a, b]).collect();
        let number_paired = paired.len();
        let [focal_guessed, focal_shared, all] = guesses(connection, &self.nodes, &paired)?;
        let keypoints = match keypoints::counts(connection, &self.names, &self.nodes) {
            // Who asks for tracks hears of it.
            Err(problem) if problem.kind == Kind::Keypoints => None,
            counts => counts?,
        };
        let has_none = |&image: &u32| {
            keypoints
                .as_ref()
                .is_some_and(|all| all[image as usize].is_none())
        };
        let images_without_keypoints = paired.into_iter().filter(has_none).count();
        let mut configs: BTreeMap<i64, ConfigCount> = BTreeMap::new();
        for pair in &self.pairs {
            let config = pair.config;
            let count = configs.entry(config).or_insert(ConfigCount {
                config,
                pairs: 0,
                used: 0,
            });
            count.pairs += 1;
            count.used += usize::from(pair.used);
        }
        let connected = connected(graph);
        Ok(DatabaseFacts {
            table: self.table.into(),
            pipeline: self.pipeline,
            min_inliers: self.min_inliers,
            images: self.names.len(),
            images_without_pair: connected.iter().filter(|&&size| size == 1).count(),
            pairs: self.pairs.len(),
            pairs_used: graph.edges().len(),
            configs: configs.into_values().collect(),
            inliers: bins(self.pairs.iter().map(|pair| pair.inliers)),
            rigs: self.rigs,
            version: self.version,
            positions,
            focal_guessed,
            focal_shared,
            // To be seen where no focal length is known.
            axes_parallel: all > 0 && all == number_paired,
            images_without_keypoints,
            connected,
        })
    }

    /// Pairs that tracks are made of and that global mapping may not take.
    pub(super) fn other_mapper(&self) -> Option<String> {
        if self.pipeline == Pipeline::Global {
            return None;
        }
        let others = self.pairs.iter().filter(|pair| pair.used);
        let others = others.filter(|pair| !(2..=6).contains(&pair.config));
        match others.count() {
            0 => None,
            used => Some(format!(
                "{} of another configuration than 2 to 6: global mapping takes these only with a \
                 stored relative pose (--pipeline global)",
                counted(used, "used pair")
            )),
        }
    }

    /// What was chosen and left out, in words; and that rigs do not count, if they do not.
    pub(super) fn notes(&self, facts: &DatabaseFacts, rigs_count: bool) -> Vec<String> {
        let mut notes = Vec::new();
        let least = self.min_inliers;
        let few = self
            .pairs
            .iter()
            .filter(|pair| pair.inliers < least)
            .count();
        if few > 0 {
            let pairs = counted(few, "verified pair");
            let has = if few == 1 { "has" } else { "have" };
            notes.push(format!(
                "{pairs} of {} {has} fewer than {least} inliers and {} not used (--min-inliers)",
                facts.pairs,
                if few == 1 { "is" } else { "are" }
            ));
        }
        let unfit = facts.pairs - few - facts.pairs_used;
        if unfit > 0 {
            notes.push(format!(
                "{} with enough inliers left out: global mapping takes the configurations 2 to 6, and \
                 pairs with a stored pose (--pipeline)",
                counted(unfit, "verified pair")
            ));
        }
        if let Some(zero) = facts.configs.iter().find(|count| count.config == 0)
            && zero.used > 0
        {
            notes.push(format!(
                "used although the database does not say how they were verified, if at all: {} of \
                 undefined configuration (0)",
                counted(zero.used, "pair")
            ));
        }
        if self.dangling > 0 {
            notes.push(format!(
                "ignored: {} with an image that the database does not have",
                counted(self.dangling, "verified pair")
            ));
        }
        if self.loops > 0 {
            notes.push(format!(
                "ignored: {} of an image with itself",
                counted(self.loops, "verified pair")
            ));
        }
        if facts.images_without_pair > 0 {
            let (these, they) = match facts.images_without_pair {
                1 => ("is in no pair that is used", "it"),
                _ => ("are in no pair that is used", "them"),
            };
            let images = counted(facts.images_without_pair, "image");
            notes.push(format!("{images} {these}: no pair determines {they}"));
        }
        let numbers = self.nodes.iter().map(|(&id, &node)| (node, id));
        let mut numbers: Vec<(u32, i64)> = numbers.collect();
        numbers.sort_unstable();
        if !numbers.is_sorted_by_key(|&(_, id)| id) {
            notes.push("the numbers of the images are not in the order of their names".to_owned());
        }
        if facts.rigs > 0 && !rigs_count {
            notes.push(format!(
                "{} of several cameras in the database: poses that are known within a rig are not \
                 used here",
                counted(facts.rigs, "rig")
            ));
        }
        notes
    }
}

/// The images whose focal length is a guess of a camera that no two others have, and the cameras with a
/// guess that three images or more have, of the images that have a pair; and all images with a guess.
/// O(images).
///
/// # Errors
/// Those of SQLite.
pub(super) fn guesses(
    connection: &Connection,
    nodes: &HashMap<i64, u32>,
    paired: &BTreeSet<u32>,
) -> Result<[usize; 3], Problem> {
    let (Some(known), Some(cameras)) = (of_cameras(connection)?, of_images(connection, nodes)?)
    else {
        return Ok([0; 3]);
    };
    let mut images: HashMap<i64, usize> = HashMap::new();
    for camera in paired.iter().filter_map(|node| cameras.get(node)) {
        if known.get(camera) == Some(&Focal::Guess) {
            *images.entry(*camera).or_default() += 1;
        }
    }
    let few = images.values().filter(|&&count| count < SELF_CALIBRATED);
    let shared = images.len() - few.clone().count();
    Ok([few.sum(), shared, images.values().sum()])
}

/// Of how many images of one camera mappers usually find its focal length.
const SELF_CALIBRATED: usize = 3;

/// Where bins begin; doubling from the mappers' threshold on.
const BINS: [u32; 9] = [0, 1, 15, 30, 60, 120, 240, 480, 960];

/// Numbers of inliers, counted. O(numbers).
pub(super) fn bins(numbers: impl Iterator<Item = u32>) -> Vec<Bin> {
    let mut pairs = [0; BINS.len()];
    for number in numbers {
        pairs[BINS.partition_point(|&from| from <= number) - 1] += 1;
    }
    (0..BINS.len())
        .filter(|&k| pairs[k] > 0)
        .map(|k| Bin {
            from: BINS[k],
            to: BINS.get(k + 1).map(|next| next - 1),
            pairs: pairs[k],
        })
        .collect()
}

/// The sizes of the connected parts, falling. O(nodes + edges).
fn connected(graph: &Graph) -> Vec<usize> {
    let mut parts = UnionFind::new(graph.nodes());
    for &(i, j) in graph.edges() {
        parts.union(i as usize, j as usize);
    }
    let mut sizes = vec![0; graph.nodes()];
    for node in 0..graph.nodes() {
        sizes[parts.find(node)] += 1;
    }
    sizes.retain(|&size| size > 0);
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes
}
