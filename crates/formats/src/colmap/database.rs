//! The tables of a database to a graph.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use rusqlite::{Connection, Row};

use super::open::Opened;
use super::positions;
use super::rigs;
use super::tables::{NoPair, columns, ends, images, verified_table};
use super::tracks;
use super::{Bin, ConfigCount, DEFAULT_MIN_INLIERS, DatabaseError, DatabaseFacts, Pipeline};
use crate::error::{Fault, Place};
use crate::{Matching, NamedGraph, OtherPair, ReadAs, ReadOptions};
use viewcert::graph::{Graph, Labels, UnionFind};
use viewcert::wording::counted;

/// What decides about tracks in global mapping and stands in no database.
const NOT_KNOWN: &str = "not known from a database: the pairs that global mapping drops because their \
                         rotations disagree, and the points that it drops once they are placed";

/// The graph of a database in a file, called `name`: of its pairs, or of its tracks if options ask
/// for them. O(images + pairs) and the sorting of both; tracks take the reading of all matches.
///
/// # Errors
/// See [`DatabaseError`]; tracks that no graph can hold.
pub(crate) fn read(name: &str, path: &Path, options: &ReadOptions) -> Result<NamedGraph, Fault> {
    let input = |error: DatabaseError| Place::Input.fault(error.into());
    let opened = Opened::new(path).map_err(input)?;
    let database = Tables::read(&opened.connection, options).map_err(input)?;
    let (pairs, matching) = database.graph().map_err(input)?;
    let positions = positions::read(&opened.connection, &database.nodes).map_err(input)?;
    let matching = Matching {
        positions,
        ..matching
    };
    let facts = database.facts(&pairs, matching.positions.iter().flatten().count());
    let mut notes = Vec::from_iter(opened.note.clone());
    notes.extend(database.notes(&facts));
    let mut graph = match options.tracks {
        None => NamedGraph {
            matching: Some(matching),
            ..NamedGraph::new("", pairs, Labels::Names(database.names))
        },
        Some(tracks) => {
            let (names, nodes) = (&database.names, &database.nodes);
            let connection = &opened.connection;
            let frames = if tracks.rigs {
                rigs::read(connection, names, nodes).map_err(input)?
            } else {
                None
            };
            let table = database.table;
            let graph = tracks::read(connection, table, names, nodes, &pairs, frames, tracks)?;
            notes.extend(database.other_mapper());
            let mut graph = NamedGraph {
                matching: Some(match &graph.frames {
                    Some(frames) => {
                        let known = database.between_cameras(&pairs, matching);
                        of_cameras(known, |image| frames.camera_of(image))
                    }
                    None => database.between_cameras(&pairs, matching),
                }),
                ..graph
            };
            graph
                .notes
                .extend(positions_not_used(name, facts.positions));
            graph.notes.push(NOT_KNOWN.to_owned());
            graph
        }
    };
    opened.finish().map_err(input)?;
    name.clone_into(&mut graph.name);
    notes.append(&mut graph.notes);
    graph.notes = notes;
    graph.read = ReadAs::new("COLMAP database");
    graph.database = Some(Box::new(facts));
    Ok(graph)
}

/// What the tables say, and the choice of pairs.
struct Tables {
    /// The images by name.
    names: Vec<Box<str>>,
    /// Their nodes by their numbers.
    nodes: HashMap<i64, u32>,
    /// Pairs of known images, in the order of the table.
    pairs: Vec<Pair>,
    /// Matches before verification of pairs of known images, by the two nodes, increasing.
    matches: Vec<((u32, u32), u32)>,
    /// Pairs with an image that is not there.
    dangling: usize,
    /// Pairs of an image with itself.
    loops: usize,
    /// Rigs of several sensors.
    rigs: usize,
    /// Whether they count: only where tracks are read.
    rigs_count: bool,
    /// The version of COLMAP that wrote it, if it says so.
    version: Option<u32>,
    table: &'static str,
    pipeline: Pipeline,
    min_inliers: u32,
    /// For every node whether its pairs count.
    meant: Vec<bool>,
}

/// A row of the table of verified pairs.
struct Pair {
    /// The smaller node first.
    nodes: (u32, u32),
    inliers: u32,
    config: i64,
    used: bool,
}

impl Tables {
    fn read(connection: &Connection, options: &ReadOptions) -> Result<Self, DatabaseError> {
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
            rigs_count: options.tracks.is_some_and(|tracks| tracks.rigs),
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
                0 => DatabaseError::NotMatched(tables.names.len()),
                matched => DatabaseError::NotVerified(matched, table),
            });
        }
        Ok(tables)
    }

    /// The verified pairs. Of a row only numbers are read, not what was matched.
    fn read_pairs(&mut self, connection: &Connection) -> Result<(), DatabaseError> {
        let present = columns(connection, self.table)?;
        let has = |column: &str| present.iter().any(|name| name == column);
        let config = if has("config") { "config" } else { "0" };
        // Poses stand behind the matches, and only one pipeline asks for them.
        let posed = self.pipeline == Pipeline::Global && has("qvec") && has("tvec");
        let pose = if posed { "qvec, tvec" } else { "null, null" };
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
            let (a, b) = ends;
            let used = self.meant[a as usize]
                && self.meant[b as usize]
                && inliers >= self.min_inliers
                && match self.pipeline {
                    Pipeline::Incremental => true,
                    Pipeline::Global => (2..=6).contains(&config) || has_pose(row)?,
                };
            self.pairs.push(Pair {
                nodes: ends,
                inliers,
                config,
                used,
            });
        }
        Ok(())
    }

    /// How many matches there were before verification, where the table says so.
    fn read_matches(&mut self, connection: &Connection) -> Result<(), DatabaseError> {
        let present = columns(connection, "matches")?;
        if !["pair_id", "rows"]
            .iter()
            .all(|&column| present.iter().any(|name| name == column))
        {
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
    fn graph(&self) -> Result<(Graph, Matching), DatabaseError> {
        let nodes = u32::try_from(self.names.len())
            .map_err(|_| DatabaseError::Other("it has more than 4294967295 images".into()))?;
        let mut used: Vec<_> = self.pairs.iter().filter(|pair| pair.used).collect();
        used.sort_unstable_by_key(|pair| pair.nodes);
        let edges = used.iter().map(|pair| pair.nodes).collect();
        // Rows are keyed by the pair, so no edge comes twice; loops and strangers are left out.
        let (graph, merged) = Graph::from_pairs(nodes, edges)
            .map_err(|error| DatabaseError::Damaged(error.to_string()))?;
        if merged > 0 {
            return Err(DatabaseError::Damaged(format!(
                "{} has pairs twice",
                self.table
            )));
        }
        let mut others: Vec<OtherPair> = Vec::new();
        others.extend(
            self.pairs
                .iter()
                .filter(|pair| !pair.used)
                .map(|pair| OtherPair {
                    images: pair.nodes,
                    inliers: pair.inliers,
                    matches: None,
                    verified: true,
                    used: false,
                }),
        );
        let matched = self.matches.iter();
        let matched = matched.filter(|(images, _)| graph.edge_number(images.0, images.1).is_none());
        others.extend(matched.map(|&(images, matches)| OtherPair {
            images,
            inliers: 0,
            matches: Some(matches),
            verified: false,
            used: false,
        }));
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
    fn between_cameras(&self, pairs: &Graph, matching: Matching) -> Matching {
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

    fn facts(&self, graph: &Graph, positions: usize) -> DatabaseFacts {
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
        DatabaseFacts {
            table: self.table,
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
            connected,
        }
    }

    /// Pairs that tracks are made of and that global mapping may not take.
    fn other_mapper(&self) -> Option<String> {
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

    /// What was chosen and left out, in words.
    fn notes(&self, facts: &DatabaseFacts) -> Vec<String> {
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
                1 => ("is in no pair that is used", "it is a camera"),
                _ => ("are in no pair that is used", "they are cameras"),
            };
            let images = counted(facts.images_without_pair, "image");
            notes.push(format!("{images} {these}: {they} that nothing determines"));
        }
        let numbers = self.nodes.iter().map(|(&id, &node)| (node, id));
        let mut numbers: Vec<(u32, i64)> = numbers.collect();
        numbers.sort_unstable();
        if !numbers.is_sorted_by_key(|&(_, id)| id) {
            notes.push("the numbers of the images are not in the order of their names".to_owned());
        }
        if facts.rigs > 0 && !self.rigs_count {
            notes.push(format!(
                "{} of several cameras in the database: poses that are known within a rig are not \
                 used here",
                counted(facts.rigs, "rig")
            ));
        }
        notes
    }
}

/// That pose priors would be known positions if they were asked for: they are metres off, so nothing
/// rests on them unasked.
fn positions_not_used(name: &str, positions: usize) -> Option<String> {
    (positions > 1).then(|| {
        format!(
            "the pose priors of {} count only with --given {name}, which takes their positions for \
             known",
            counted(positions, "image")
        )
    })
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
fn several_sensors(connection: &Connection) -> Result<usize, DatabaseError> {
    if !columns(connection, "rig_sensors")?
        .iter()
        .any(|name| name == "rig_id")
    {
        return Ok(0);
    }
    let query = "select count(distinct rig_id) from rig_sensors";
    let count: i64 = connection.query_row(query, [], |row| row.get(0))?;
    Ok(count.max(0) as usize)
}

/// The version that a database was written by.
fn version(connection: &Connection) -> Result<Option<u32>, DatabaseError> {
    let version: i64 = connection.pragma_query_value(None, "user_version", |row| row.get(0))?;
    Ok(u32::try_from(version).ok().filter(|&version| version > 0))
}

/// A number of matches.
fn count(row: &Row, column: usize) -> Result<u32, DatabaseError> {
    let count: Option<i64> = row.get(column)?;
    u32::try_from(count.unwrap_or(0))
        .map_err(|_| DatabaseError::Damaged(format!("a pair has {} matches", count.unwrap_or(0))))
}

/// Whether a relative pose is stored: a quaternion that is not zero, and a translation.
fn has_pose(row: &Row) -> Result<bool, DatabaseError> {
    let blob = |column| -> Result<Option<Vec<u8>>, DatabaseError> {
        Ok(row
            .get_ref(column)?
            .as_blob_or_null()
            .map_err(|_| DatabaseError::Damaged("a relative pose is not stored as bytes".into()))?
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
