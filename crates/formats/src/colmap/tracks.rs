//! The matches of a database, joined to tracks.

use std::collections::HashMap;

use rusqlite::Connection;
use rusqlite::types::ValueRef;

use super::doubles::doubles;
use super::keypoints::Keypoints;
use super::tables::{NoPair, PAIR_FACTOR, columns, ends};
use super::{DatabaseError, FeatureTracks, ImageTracks};
use crate::NamedGraph;
use crate::error::{Fault, Place, Problem};
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
    table: &str,
    names: &[Box<str>],
    nodes: &HashMap<i64, u32>,
    pairs: &Graph,
    frames: Option<Frames>,
    options: TrackOptions,
) -> Result<NamedGraph, Fault> {
    let input = |problem: Problem| Place::Input.fault(problem);
    let keypoints = Keypoints::new(connection, names, nodes, options.max_spread);
    let mut keypoints = keypoints.map_err(|error| input(error.into()))?;
    let mut joined = Joined::new(names.len());
    let beyond = each_match(
        (connection, table),
        names,
        nodes,
        pairs,
        &keypoints,
        |a, b| joined.join(a, b),
    );
    let beyond = beyond.map_err(input)?;
    let mut graph = TrackGraph::new(names.to_vec(), options)?;
    graph.set_spread(options.max_spread);
    if let Some(frames) = frames {
        graph.set_frames(frames);
    }
    let order: Vec<u32> = (0..names.len() as u32).collect();
    joined
        .tracks(&order, Some(&mut keypoints), &mut graph)
        .map_err(input)?;
    let unknown = keypoints.unknown();
    if unknown.is_some() {
        graph.set_places_missing();
    }
    let mut graph = graph.finish().map_err(|fault| match fault.problem {
        Problem::NoPoints { .. } => input(DatabaseError::NoTracks(pairs.edges().len()).into()),
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
    table: &str,
    names: &[Box<str>],
    nodes: &HashMap<i64, u32>,
    pairs: &Graph,
) -> Result<FeatureTracks, Problem> {
    let keypoints = Keypoints::new(connection, names, nodes, 0)?;
    let mut joined = Joined::new(names.len());
    each_match(
        (connection, table),
        names,
        nodes,
        pairs,
        &keypoints,
        |a, b| joined.join(a, b),
    )?;
    let images = (0..).zip(names).zip(joined.of_features());
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
    table: &str,
    names: &[Box<str>],
    nodes: &HashMap<i64, u32>,
    pairs: &Graph,
) -> Result<Vec<[(u32, u32); 2]>, Problem> {
    let keypoints = Keypoints::new(connection, names, nodes, 0)?;
    let mut all = Vec::new();
    each_match(
        (connection, table),
        names,
        nodes,
        pairs,
        &keypoints,
        |a, b| {
            all.push([a, b]);
            Ok(())
        },
    )?;
    Ok(all)
}

/// Reads the lists of all pairs that are used. Matches of features that their image does not have
/// are left out, as COLMAP leaves them out (`CorrespondenceGraph::AddTwoViewGeometry`), and said.
fn each_match(
    (connection, table): (&Connection, &str),
    names: &[Box<str>],
    nodes: &HashMap<i64, u32>,
    pairs: &Graph,
    keypoints: &Keypoints,
    mut take: impl FnMut((u32, u32), (u32, u32)) -> Result<(), Problem>,
) -> Result<Vec<String>, Problem> {
    let sql = |error: rusqlite::Error| Problem::from(DatabaseError::from(error));
    if !columns(connection, table)?
        .iter()
        .any(|name| name == "data")
    {
        return Err(DatabaseError::NoLists(pairs.edges().len()).into());
    }
    let mut without = 0;
    let mut beyond = 0;
    let mut first_beyond = None;
    let mut doubled = 0;
    let query = format!("select pair_id, rows, data from {table}");
    let mut statement = connection.prepare(&query).map_err(sql)?;
    let mut rows = statement.query([]).map_err(sql)?;
    while let Some(row) = rows.next().map_err(sql)? {
        let pair: i64 = row.get(0).map_err(sql)?;
        let (a, b) = match ends(pair, nodes) {
            Ok((a, b)) if pairs.edge_number(a, b).is_some() => (a, b),
            Ok(_) | Err(NoPair::Dangling | NoPair::Loop) => continue,
        };
        // Columns are in the order of the images' numbers, nodes in that of their names.
        let first = nodes.get(&pair.div_euclid(PAIR_FACTOR)).copied();
        let (first, second) = if first == Some(a) { (a, b) } else { (b, a) };
        let count: i64 = row.get(1).map_err(sql)?;
        let list = match row.get_ref(2).map_err(sql)? {
            ValueRef::Blob(list) => list,
            _ => &[],
        };
        if list.is_empty() && count > 0 {
            without += 1;
            continue;
        }
        let damaged = |why: String| DatabaseError::Matches {
            first: names[first as usize].to_string(),
            second: names[second as usize].to_string(),
            why,
        };
        if usize::try_from(count)
            .ok()
            .and_then(|count| count.checked_mul(MATCH))
            != Some(list.len())
        {
            let bytes = list.len();
            let why = format!("{count} matches of two features are not {bytes} bytes");
            return Err(damaged(why).into());
        }
        let (matches, _) = list.as_chunks::<MATCH>();
        doubled += doubles(matches);
        for &[a0, a1, a2, a3, b0, b1, b2, b3] in matches {
            let a = u32::from_le_bytes([a0, a1, a2, a3]);
            let b = u32::from_le_bytes([b0, b1, b2, b3]);
            if !keypoints.has(first, a) || !keypoints.has(second, b) {
                beyond += 1;
                first_beyond.get_or_insert((first, second));
                continue;
            }
            take((first, a), (second, b)).map_err(|problem| damaged(problem.to_string()))?;
        }
    }
    if without > 0 {
        return Err(DatabaseError::NoLists(without).into());
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
    let doubled = (doubled > 0).then(|| {
        let matches = match doubled {
            1 => "1 match stands".to_owned(),
            count => format!("{count} matches stand"),
        };
        format!("{matches} in the list of a pair that has it already, and does not count again")
    });
    Ok(beyond.into_iter().chain(doubled).collect())
}
