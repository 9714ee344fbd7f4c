use std::io::Cursor;

use super::*;
use crate::model::{self, Encoding};
use crate::read::graphs;
use crate::{ReadError, ReadOptions};
use proptest::prelude::*;
use viewcert::graph::Labels;

fn views(min_views: u32) -> TrackOptions {
    TrackOptions {
        min_views,
        ..TrackOptions::default()
    }
}

fn tracks(bytes: &[u8], min_views: u32) -> Result<NamedGraph, ReadError> {
    let options = ReadOptions {
        tracks: Some(views(min_views)),
        ..ReadOptions::default()
    };
    let mut graphs = graphs("in".into(), Cursor::new(bytes.to_vec()), options);
    let graph = graphs.next().unwrap();
    assert!(graphs.next().is_none());
    graph
}

fn message(bytes: &[u8]) -> String {
    tracks(bytes, 2).unwrap_err().to_string()
}

#[test]
fn a_track_counts_if_it_is_long_and_consistent() {
    let names = || ["a", "b", "c"].map(Into::into).to_vec();
    let mut graph = TrackGraph::new(names(), views(2)).unwrap();
    for views in [&[2, 0][..], &[1], &[], &[0, 1, 0], &[0, 1, 2]] {
        graph.push(views).unwrap();
    }
    let graph = graph.finish().unwrap();
    assert_eq!(
        graph.graph.edges(),
        [(0, 3), (0, 4), (1, 4), (2, 3), (2, 4)]
    );
    assert_eq!(graph.cameras, Some(3));
    assert_eq!(graph.labels, Labels::CamerasAndPoints(names()));
    let facts = graph.tracks.unwrap();
    assert_eq!((facts.points, facts.observations), (2, 5));
    assert_eq!((facts.inconsistent, facts.short), (1, 2));
}

#[test]
fn files_are_known_by_their_beginning() {
    let known = |bytes: &[u8]| kind(bytes, true);
    assert_eq!(known(b"\n2 1 2\n0 0 1 2\n1 0 1 2\n"), Some(TrackFile::Bal));
    assert_eq!(known(b"0 1\n1\n5 5\n"), Some(TrackFile::OpenMvgMatches));
    for pairs in [
        &b"0 1\n1 2\n"[..],
        b"a b\n",
        b"",
        b"0 1 1\n0 2 1\n",
        b"\0\0\0\0\0\0\0\0",
    ] {
        assert_eq!(known(pairs), None, "{pairs:?}");
    }
}

#[test]
fn what_is_broken_is_said_with_its_line() {
    for (text, phrase) in [
        (
            &b"2 1 2\n0 0 1 2\n1 1 1 2\n"[..],
            "in:3: the file is corrupt: the number of a point is 1",
        ),
        (
            b"2 1 2\n0 0 1 2\n",
            "in:2: the file is truncated: the number of a camera is missing",
        ),
        (
            b"2 1 2\n0 0 1 2\nx 0 1 2\n",
            "in:3: the file is corrupt: `x` stands where",
        ),
        (b"9 4000000000 1\n0 0 1 2\n", "have only 1 observations"),
        (b"0 0\n1\n5 5\n", "view 0 is matched with itself"),
        (b"0 1\n2\n5 5\n", "the number of a feature is missing"),
        (b"0 1\n1\n5 16777216\n", "a feature has the number 16777216"),
        (b"# Bundle file v0.3\n", "the number of cameras is missing"),
        (b"# Bundle file v0.3\n0 0\n", "it has no cameras"),
        (b"NVM_V3\n1\na.jpg 1 2\n0\n", "a file name and ten numbers"),
    ] {
        let message = message(text);
        assert!(message.contains(phrase), "{phrase}: {message}");
    }
}

/// A point of points3D.bin that two images see.
fn points(count: u64, length: u64) -> Vec<u8> {
    let mut bytes = count.to_le_bytes().to_vec();
    bytes.extend(1u64.to_le_bytes());
    bytes.extend(
        [0.5f64, 1.0, 2.0]
            .iter()
            .flat_map(|value| value.to_le_bytes()),
    );
    bytes.extend([1, 2, 3]);
    bytes.extend(0.5f64.to_le_bytes());
    bytes.extend(length.to_le_bytes());
    for image in [3u32, 8] {
        bytes.extend(image.to_le_bytes());
        bytes.extend(0u32.to_le_bytes());
    }
    bytes
}

#[test]
fn binary_files_hold_what_they_promise() {
    let read = |count, length| {
        let mut fields = model::fields(Cursor::new(points(count, length)), Encoding::Binary);
        model::each_point(&mut *fields, |point| assert_eq!(point.track[0], (3, 0)))
    };
    assert!(read(1, 2).is_ok());
    for (count, length) in [(2, 2), (1, 3), (1, 1), (u64::MAX, 2), (1, u64::MAX)] {
        assert!(read(count, length).is_err());
    }
}

/// An image and a feature of it.
type Feature = (u32, u32);

/// Tracks by repeated merging of sets, without any thought of speed: sorted lists of (image,
/// feature).
fn slow(matches: &[(Feature, Feature)]) -> Vec<Vec<Feature>> {
    let mut sets: Vec<Vec<Feature>> = Vec::new();
    for &(a, b) in matches {
        let (touched, mut rest): (Vec<_>, Vec<_>) = sets
            .into_iter()
            .partition(|set| set.contains(&a) || set.contains(&b));
        let mut set: Vec<_> = touched.into_iter().flatten().chain([a, b]).collect();
        set.sort_unstable();
        set.dedup();
        rest.push(set);
        sets = rest;
    }
    sets.sort();
    sets
}

proptest! {
    #[test]
    fn matches_join_to_tracks(
        matches in prop::collection::vec(((0u32..5, 0u32..4), (0u32..5, 0u32..4)), 1..12),
        min_views in 1u32..4,
    ) {
        let mut joined = Joined::new(5);
        for &(a, b) in &matches {
            joined.join(a, b).unwrap();
        }
        // Images are nodes in another order.
        let nodes = [3, 0, 4, 1, 2];
        let names = ["a", "b", "c", "d", "e"].map(Into::into).to_vec();
        let mut graph = TrackGraph::new(names, views(min_views)).unwrap();
        joined.tracks(&nodes, None, &mut graph).unwrap();
        let graph = graph.finish().unwrap();
        let mut expected: Vec<Vec<u32>> = Vec::new();
        let (mut inconsistent, mut short) = (0, 0);
        for set in slow(&matches) {
            let mut views: Vec<u32> = set.iter().map(|&(image, _)| nodes[image as usize]).collect();
            views.sort_unstable();
            if views.windows(2).any(|two| two[0] == two[1]) {
                inconsistent += 1;
            } else if views.len() < min_views as usize {
                short += 1;
            } else {
                expected.push(views);
            }
        }
        let points = graph.graph.nodes() as u32 - 5;
        let views = |point| {
            let edges = graph.graph.edges().iter();
            edges.filter(|edge| edge.1 == point + 5).map(|edge| edge.0).collect::<Vec<_>>()
        };
        let mut found: Vec<Vec<u32>> = (0..points).map(views).collect();
        found.sort();
        expected.sort();
        prop_assert_eq!(found, expected);
        let facts = graph.tracks.unwrap();
        prop_assert_eq!((facts.inconsistent, facts.short), (inconsistent, short));
    }
}
