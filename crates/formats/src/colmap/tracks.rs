//! The matches of a database, joined to tracks.

use rusqlite::Connection;
use rusqlite::types::ValueRef;

use super::error;
use super::keypoints::Keypoints;
use super::pairs::Tables;
use super::tables::{NoPair, PAIR_FACTOR, ends, has};
use super::{FeatureTracks, ImageTracks};
use crate::NamedGraph;
use crate::error::{Fault, Kind, Problem};
use crate::tracks::{Frames, Joined, TrackGraph, TrackOptions};
use viewcert::graph::Graph;

/// Bytes of a match: the numbers of two features.
const MATCH: usize = 8;

/// The camera-point graph of the pairs that are edges of `pairs`, whose nodes are the images
/// `names`, of which those that frames say to be at one place are one camera. Linear in the matches,
/// but for nearly constant factors.
///
/// # Errors
/// Lists of matches that are missing or damaged; damaged keypoints.
pub(super) fn read(
    connection: &Connection,
    tables: &Tables,
    pairs: &Graph,
    frames: Option<Frames>,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let keypoints = Keypoints::new(connection, &tables.names, &tables.nodes, options.max_spread);
    let mut keypoints = keypoints?;
    let mut joined = Joined::new(tables.names.len());
    let beyond = each_match(connection, tables, pairs, &keypoints, |a, b| {
        joined.join(a, b)
    });
    let beyond = beyond?;
    let mut graph = TrackGraph::new(tables.names.clone(), options)?;
    graph.spread = Some(options.max_spread);
    graph.frames = frames;
    let order: Vec<u32> = (0..tables.names.len() as u32).collect();
    joined.tracks(&order, Some(&mut keypoints), &mut graph)?;
    let unknown = keypoints.unknown();
    graph.places_missing = unknown.is_some();
    let mut graph = graph.finish().map_err(|fault| match fault.problem.kind {
        Kind::NoPoints(_) => no_tracks(pairs.edges().len()).into(),
        _ => fault,
    })?;
    graph.notes.extend(beyond.into_iter().chain(unknown));
    Ok(graph)
}

/// Which features are the same point by the pairs that are edges of `pairs`. Linear in the matches, but
/// for nearly constant factors.
///
/// # Errors
/// As of [`read`].
pub(super) fn of_features(
    connection: &Connection,
    tables: &Tables,
    pairs: &Graph,
) -> Result<FeatureTracks, Problem> {
    let keypoints = Keypoints::new(connection, &tables.names, &tables.nodes, 0)?;
    let mut joined = Joined::new(tables.names.len());
    each_match(connection, tables, pairs, &keypoints, |a, b| {
        joined.join(a, b)
    })?;
    let images = (0..).zip(&tables.names).zip(joined.of_features());
    let images = images.map(|((node, name), tracks)| {
        let features = keypoints.count(node);
        (name.clone(), ImageTracks { features, tracks })
    });
    Ok(images.collect())
}

/// The matches of all pairs that are edges of `pairs`: two images and a feature of each.
///
/// # Errors
/// As of [`read`].
pub(super) fn matches(
    connection: &Connection,
    tables: &Tables,
    pairs: &Graph,
) -> Result<Vec<[(u32, u32); 2]>, Problem> {
    let keypoints = Keypoints::new(connection, &tables.names, &tables.nodes, 0)?;
    let mut all = Vec::new();
    each_match(connection, tables, pairs, &keypoints, |a, b| {
        all.push([a, b]);
        Ok(())
    })?;
    Ok(all)
}

/// Matches were emptied.
fn no_lists(pairs: usize) -> Problem {
    Problem::of(
        Kind::NoLists,
        format!("{pairs} of the pairs that are used have inliers, but no list of them"),
        "tracks need the lists: give the database as the matching left it, or decide its pairs, without --tracks (of export: --model projective)",
    )
}

/// No match of the pairs that are used counts, or no pair is used.
fn no_tracks(pairs: usize) -> Problem {
    match pairs {
        0 => error::refused(
            "the database has no tracks: no pair has enough inliers to be used",
            "ask for fewer inliers (--min-inliers; in COLMAP --Mapper.min_num_matches and --GlobalMapper.min_num_matches), or decide its pairs without --tracks",
        ),
        _ => error::refused(
            format!("the database has no tracks: {} used", error::are(pairs)),
            "match the images again: the features that are matched are not in the database",
        ),
    }
}

/// Reads the lists of all pairs that are used. Matches of features that their image does not have
/// are left out, as COLMAP leaves them out (`CorrespondenceGraph::AddTwoViewGeometry`), and said.
fn each_match(
    connection: &Connection,
    tables: &Tables,
    pairs: &Graph,
    keypoints: &Keypoints,
    mut take: impl FnMut((u32, u32), (u32, u32)) -> Result<(), Problem>,
) -> Result<Option<String>, Problem> {
    let Tables {
        names,
        nodes,
        table,
        ..
    } = tables;
    if !has(connection, table, &["data"])? {
        return Err(no_lists(pairs.edges().len()));
    }
    let mut without = 0;
    let mut beyond = 0;
    let mut first_beyond = None;
    let query = format!("select pair_id, rows, data from {table}");
    let mut statement = connection.prepare(&query)?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let pair: i64 = row.get(0)?;
        let (a, b) = match ends(pair, nodes) {
            Ok((a, b)) if pairs.edge_number(a, b).is_some() => (a, b),
            Ok(_) | Err(NoPair::Dangling | NoPair::Loop) => continue,
        };
        // Columns are in the order of the images' numbers, nodes in that of their names.
        let first = nodes.get(&pair.div_euclid(PAIR_FACTOR)).copied();
        let (first, second) = if first == Some(a) { (a, b) } else { (b, a) };
        let count: i64 = row.get(1)?;
        let list = match row.get_ref(2)? {
            ValueRef::Blob(list) => list,
            _ => &[],
        };
        if list.is_empty() && count > 0 {
            without += 1;
            continue;
        }
        let damaged = |why: String| {
            let [first, second] = [first, second].map(|image| &names[image as usize]);
            let what = format!("the matches of the images {first} and {second} are damaged: {why}");
            error::refused(what, error::AGAIN)
        };
        if usize::try_from(count)
            .ok()
            .and_then(|count| count.checked_mul(MATCH))
            != Some(list.len())
        {
            let bytes = list.len();
            let why = format!("{count} matches of two features are not {bytes} bytes");
            return Err(damaged(why));
        }
        let (matches, _) = list.as_chunks::<MATCH>();
        for &[a0, a1, a2, a3, b0, b1, b2, b3] in matches {
            let a = u32::from_le_bytes([a0, a1, a2, a3]);
            let b = u32::from_le_bytes([b0, b1, b2, b3]);
            if !keypoints.has(first, a) || !keypoints.has(second, b) {
                beyond += 1;
                first_beyond.get_or_insert((first, second));
                continue;
            }
            take((first, a), (second, b)).map_err(|problem| damaged(problem.what))?;
        }
    }
    if without > 0 {
        return Err(no_lists(without));
    }
    let beyond = first_beyond.map(|(first, second): (u32, u32)| {
        let matches = match beyond {
            1 => "1 match".to_owned(),
            count => format!("{count} matches"),
        };
        let (first, second) = (&names[first as usize], &names[second as usize]);
        format!(
            "ignored: {matches} with a feature that its image does not have, first of {first} and \
             {second}"
        )
    });
    Ok(beyond)
}
