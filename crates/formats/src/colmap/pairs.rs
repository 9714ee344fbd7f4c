//! The tables of images and pairs, and the choice of the pairs that a mapper takes.

use super::error;
use crate::error::Problem;
use std::collections::HashMap;

use rusqlite::{Connection, Row};

use super::tables::{NoPair, columns, ends, has, images, verified_table};
use super::{DEFAULT_MIN_INLIERS, Pipeline};
use crate::{Matching, OtherPair, ReadOptions};
use viewcert::graph::Graph;

/// What the tables say, and the choice of pairs.
pub(super) struct Tables {
    /// The images by name.
    pub(super) names: Vec<Box<str>>,
    /// Their nodes by their numbers.
    pub(super) nodes: HashMap<i64, u32>,
    /// Pairs of known images, in the order of the table.
    pub(super) pairs: Vec<Pair>,
    /// Matches before verification of pairs of known images, by the two nodes, increasing.
    pub(super) matches: Vec<((u32, u32), u32)>,
    /// Pairs with an image that is not there.
    pub(super) dangling: usize,
    /// Pairs of an image with itself.
    pub(super) loops: usize,
    /// Rigs of several sensors.
    pub(super) rigs: usize,
    /// The version of COLMAP that wrote it, if it says so.
    pub(super) version: Option<u32>,
    pub(super) table: &'static str,
    pub(super) pipeline: Pipeline,
    pub(super) min_inliers: u32,
    /// For every node whether its pairs count.
    pub(super) meant: Vec<bool>,
}

/// A row of the table of verified pairs.
pub(super) struct Pair {
    /// The smaller node first.
    pub(super) nodes: (u32, u32),
    pub(super) inliers: u32,
    pub(super) config: i64,
    /// Whether a relative pose is stored; not asked where the configuration is enough for global mapping.
    posed: bool,
    pub(super) used: bool,
}

impl Tables {
    /// Reads them. O(images + pairs) and the sorting of both.
    ///
    /// # Errors
    /// What is no database of COLMAP, is damaged, or has no verified pair.
    pub(super) fn read(connection: &Connection, options: &ReadOptions) -> Result<Self, Problem> {
        let table = verified_table(connection)?;
        let (names, nodes) = images(connection)?;
        let meant = names.iter().map(|name| {
            let only = options.only.as_ref();
            only.is_none_or(|only| only.contains(&**name))
        });
        let mut tables = Self {
            meant: meant.collect(),
            names,
            nodes,
            pairs: Vec::new(),
            matches: Vec::new(),
            dangling: 0,
            loops: 0,
            rigs: several_sensors(connection)?,
            version: version(connection)?,
            table,
            pipeline: options.pipeline.unwrap_or_default(),
            min_inliers: options.min_inliers.unwrap_or(DEFAULT_MIN_INLIERS),
        };
        tables.read_pairs(connection)?;
        tables.read_matches(connection)?;
        if tables.pairs.is_empty() && tables.dangling == 0 {
            let matched = tables.matches.iter().filter(|&&(_, count)| count > 0);
            return Err(match matched.count() {
                0 => error::refused(
                    format!(
                        "the database has images, {}, but no matches",
                        tables.names.len()
                    ),
                    "match the images first, for example with `colmap exhaustive_matcher --database_path FILE`",
                ),
                matched => error::refused(
                    format!(
                        "{} matched, but none is verified: {table} is empty",
                        error::are(matched)
                    ),
                    "run the geometric verification: `colmap geometric_verifier --database_path FILE`, or in Python `pycolmap.geometric_verification(FILE)`; COLMAP 3.8 has neither, there match again, for example with `colmap exhaustive_matcher`",
                ),
            });
        }
        Ok(tables)
    }

    /// The verified pairs. Of a row only numbers are read, not what was matched.
    fn read_pairs(&mut self, connection: &Connection) -> Result<(), Problem> {
        let present = columns(connection, self.table)?;
        let has = |column: &str| present.iter().any(|name| name == column);
        let config = if has("config") { "config" } else { "0" };
        // Poses stand behind the matches: they are read of the few pairs that need one.
        let pose = |column: &str| match has(column) {
            true => format!("case when {config} between 2 and 6 then null else {column} end"),
            false => "null".to_owned(),
        };
        let pose = format!("{}, {}", pose("qvec"), pose("tvec"));
        let table = self.table;
        let query = format!("select pair_id, rows, {config}, {pose} from {table}");
        let mut statement = connection.prepare(&query)?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let inliers = count(row, 1)?;
            let config: Option<i64> = row.get(2)?;
            let config = config.unwrap_or(0);
            let Some(ends) = self.ends(row.get(0)?) else {
                continue;
            };
            let mut pair = Pair {
                nodes: ends,
                inliers,
                config,
                posed: has_pose(row)?,
                used: false,
            };
            pair.used = self.takes(&pair, self.pipeline);
            self.pairs.push(pair);
        }
        Ok(())
    }

    /// Whether a pair counts for a mapper.
    fn takes(&self, pair: &Pair, pipeline: Pipeline) -> bool {
        let (a, b) = pair.nodes;
        let meant = self.meant[a as usize] && self.meant[b as usize];
        let is_global = (2..=6).contains(&pair.config) || pair.posed;
        meant
            && pair.inliers >= self.min_inliers
            && (pipeline == Pipeline::Incremental || is_global)
    }

    /// The pairs that a mapper of COLMAP 4.2 takes, with their inliers, increasing: it leaves out those that
    /// are undefined or degenerate.
    pub(super) fn taken_by(&self, pipeline: Pipeline) -> Vec<((u32, u32), u32)> {
        let taken = self.pairs.iter();
        let taken =
            taken.filter(|pair| !matches!(pair.config, 0 | 1) && self.takes(pair, pipeline));
        let mut taken: Vec<_> = taken.map(|pair| (pair.nodes, pair.inliers)).collect();
        taken.sort_unstable();
        taken
    }

    /// How many matches there were before verification, where the table says so.
    fn read_matches(&mut self, connection: &Connection) -> Result<(), Problem> {
        if !has(connection, "matches", &["pair_id", "rows"])? {
            return Ok(());
        }
        let mut statement = connection.prepare("select pair_id, rows from matches")?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let matches = count(row, 1)?;
            // A row without matches says that the pair was tried.
            if let Ok(ends) = ends(row.get(0)?, &self.nodes) {
                self.matches.push((ends, matches));
            }
        }
        // Of two numbers for one pair the later one counts.
        self.matches.sort_by_key(|&(ends, _)| ends);
        self.matches.dedup_by(|later, first| {
            let same = later.0 == first.0;
            if same {
                first.1 = later.1;
            }
            same
        });
        Ok(())
    }

    /// The nodes of a pair; counts those that are none.
    fn ends(&mut self, pair: i64) -> Option<(u32, u32)> {
        match ends(pair, &self.nodes) {
            Ok(ends) => return Some(ends),
            Err(NoPair::Loop) => self.loops += 1,
            Err(NoPair::Dangling) => self.dangling += 1,
        }
        None
    }

    /// The graph of the pairs that are used, and what is known of all pairs.
    pub(super) fn graph(&self) -> Result<(Graph, Matching), Problem> {
        let nodes = u32::try_from(self.names.len())
            .map_err(|_| error::other("it has more than 4294967295 images"))?;
        let mut used: Vec<_> = self.pairs.iter().filter(|pair| pair.used).collect();
        used.sort_unstable_by_key(|pair| pair.nodes);
        let edges = used.iter().map(|pair| pair.nodes).collect();
        // Rows are keyed by the pair, so no edge comes twice; loops and strangers are left out.
        let (graph, merged) =
            Graph::from_pairs(nodes, edges).map_err(|error| error::damaged(error.to_string()))?;
        if merged > 0 {
            return Err(error::damaged(format!("{} has pairs twice", self.table)));
        }
        let other = |images, inliers, matches| OtherPair {
            images,
            inliers,
            matches,
            verified: matches.is_none(),
            used: false,
        };
        let unused = self.pairs.iter().filter(|pair| !pair.used);
        let unused = unused.map(|pair| other(pair.nodes, pair.inliers, None));
        let matched = self.matches.iter();
        let matched = matched.filter(|(images, _)| graph.edge_number(images.0, images.1).is_none());
        let matched = matched.map(|&(images, matches)| other(images, 0, Some(matches)));
        let mut others: Vec<OtherPair> = unused.chain(matched).collect();
        // Of a pair with both, what was verified comes first and learns how many were matched.
        others.sort_by_key(|pair| pair.images);
        others.dedup_by(|later, first| {
            let same = later.images == first.images;
            if same {
                first.matches = later.matches;
            }
            same
        });
        let matching = Matching {
            inliers: used.iter().map(|pair| pair.inliers).collect(),
            others,
            positions: Vec::new(),
        };
        Ok((graph, matching))
    }

    /// What is known of all pairs, for a graph in which no pair of cameras is an edge.
    pub(super) fn between_cameras(&self, pairs: &Graph, matching: Matching) -> Matching {
        let used = pairs.edges().iter().zip(matching.inliers);
        let used = used.map(|(&images, inliers)| OtherPair {
            images,
            inliers,
            matches: self.matches_of(images),
            verified: true,
            used: true,
        });
        let mut others: Vec<OtherPair> = used.chain(matching.others).collect();
        others.sort_unstable_by_key(|pair| pair.images);
        Matching {
            inliers: Vec::new(),
            others,
            positions: matching.positions,
        }
    }

    /// How many matches two images have, where the table says so. O(log m).
    fn matches_of(&self, images: (u32, u32)) -> Option<u32> {
        let found = self
            .matches
            .binary_search_by_key(&images, |&(ends, _)| ends);
        found.ok().map(|at| self.matches[at].1)
    }
}

/// What is known of images and their pairs, for cameras that may stand for several: of two cameras the
/// pair with most inliers, of a camera the first position.
pub(super) fn of_cameras(matching: Matching, camera_of: impl Fn(u32) -> u32) -> Matching {
    let mut others = matching.others;
    for pair in &mut others {
        let (a, b) = pair.images;
        let (a, b) = (camera_of(a), camera_of(b));
        pair.images = (a.min(b), a.max(b));
    }
    others.retain(|pair| pair.images.0 != pair.images.1);
    others.sort_unstable_by_key(|pair| (pair.images, std::cmp::Reverse(pair.inliers)));
    others.dedup_by_key(|pair| pair.images);
    let images = (0..).zip(&matching.positions);
    let of_images = images.map(|(image, &place)| (camera_of(image) as usize, place));
    let of_images: Vec<_> = of_images.collect();
    let count = of_images.iter().map(|&(camera, _)| camera + 1).max();
    let mut positions = vec![None; count.unwrap_or(0)];
    for (camera, place) in of_images {
        positions[camera] = positions[camera].or(place);
    }
    Matching {
        others,
        positions,
        ..matching
    }
}

/// How many rigs have sensors besides their reference sensor.
fn several_sensors(connection: &Connection) -> Result<usize, Problem> {
    if !has(connection, "rig_sensors", &["rig_id"])? {
        return Ok(0);
    }
    let query = "select count(distinct rig_id) from rig_sensors";
    let count: i64 = connection.query_row(query, [], |row| row.get(0))?;
    Ok(count.max(0) as usize)
}

/// The version that a database was written by.
fn version(connection: &Connection) -> Result<Option<u32>, Problem> {
    let version: i64 = connection.pragma_query_value(None, "user_version", |row| row.get(0))?;
    Ok(u32::try_from(version).ok().filter(|&version| version > 0))
}

/// A number of matches.
fn count(row: &Row, column: usize) -> Result<u32, Problem> {
    let count: Option<i64> = row.get(column)?;
    u32::try_from(count.unwrap_or(0))
        .map_err(|_| error::damaged(format!("a pair has {} matches", count.unwrap_or(0))))
}

/// Whether a relative pose is stored: a quaternion that is not zero, and a translation.
fn has_pose(row: &Row) -> Result<bool, Problem> {
    let blob = |column| -> Result<Option<Vec<u8>>, Problem> {
        Ok(row
            .get_ref(column)?
            .as_blob_or_null()
            .map_err(|_| error::damaged("a relative pose is not stored as bytes"))?
            .map(<[u8]>::to_vec))
    };
    // COLMAP 3.8 writes zeros, some of them negative, where there is no pose.
    let zero = |bytes: &[u8]| {
        let (numbers, _) = bytes.as_chunks();
        numbers.iter().all(|&b| u64::from_le_bytes(b) << 1 == 0)
    };
    Ok(match (blob(3)?, blob(4)?) {
        (Some(rotation), Some(translation)) => {
            rotation.len() == 32 && translation.len() == 24 && !zero(&rotation)
        }
        _ => false,
    })
}
