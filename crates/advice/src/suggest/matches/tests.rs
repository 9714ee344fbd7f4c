use super::*;
use crate::suggest::{Reason, Tried};
use crate::tests::{found, frames, options, verdict};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use viewcert::Model;

fn suggested(
    graph: &Graph,
    cameras: u32,
    others: &[OtherPair],
    at: Option<u32>,
) -> Vec<SuggestedMatch> {
    let options = options(Model::Calibrated);
    let (_, parts, _) = found(graph, Model::Calibrated);
    let known = Known {
        inliers: &[],
        others,
        near: None,
    };
    let wanted = Wanted { most: 1000, at };
    suggest_matches(graph, &parts, cameras, known, wanted, &options).unwrap()
}

/// Cameras 0..4 see the points 13..17, 4..8 see 17..21, 8..12 see 21..25; 12 is a camera.
fn three(more: &[Pair]) -> Graph {
    let all = (0..12).flat_map(|camera| {
        let first = 13 + camera / 4 * 4;
        (first..first + 4).map(move |point| (camera, point))
    });
    Graph::new(25, all.chain(more.iter().copied())).unwrap()
}

/// What the best suggestion for two cameras says: observations, cameras.
fn best(more: &[Pair], cameras: Pair) -> Option<(usize, usize)> {
    let known = OtherPair {
        images: cameras,
        inliers: 25,
        matches: Some(29),
        verified: true,
        used: false,
    };
    let found = suggested(&three(more), 13, &[known], None);
    let best = found.first().filter(|best| best.cameras == cameras)?;
    assert_eq!(best.known, Some(known));
    Some((best.observations.len(), best.images))
}

/// Two groups have 4 degrees of freedom against each other; an observation takes 2, a shared node 3,
/// and a second observation by the same camera, or of the same point, 1.
#[test]
fn enough_by_hand() {
    // Nothing between: each camera sees a point of the other group.
    assert_eq!(best(&[], (0, 4)), Some((2, 8)));
    // One observation, a shared camera, a shared point: one more of other ends.
    assert_eq!(best(&[(1, 18)], (0, 4)), Some((1, 8)));
    assert_eq!(best(&[(1, 18), (1, 19)], (0, 4)), Some((1, 8)));
    assert_eq!(best(&[(1, 17), (2, 17)], (0, 4)), Some((1, 8)));
    // Two of different ends: joined already.
    assert_eq!(best(&[(1, 18), (2, 19)], (0, 4)), None);
    // A chain of two shared cameras has 2 degrees of freedom: one observation takes both.
    let chain = [(1, 18), (1, 19), (6, 22), (6, 23)];
    assert_eq!(best(&chain, (0, 8)), Some((1, 12)));
    // A camera alone has to see two points, or one more.
    assert_eq!(best(&[], (0, 12)), Some((2, 5)));
    assert_eq!(best(&[(12, 14)], (0, 12)), Some((1, 5)));
    assert_eq!(best(&[(12, 18)], (0, 12)), Some((2, 5)));
}

#[test]
fn what_is_used_comes_last_and_what_failed_is_not_named() {
    let other = |a, b, inliers, used| OtherPair {
        images: (a, b),
        inliers,
        matches: None,
        verified: true,
        used,
    };
    let others = [
        other(0, 1, 50, true),
        other(2, 5, 8, false),
        other(3, 6, 30, true),
        other(2, 3, 60, true),
        other(6, 7, 70, true),
        other(0, 12, 9, false),
    ];
    let found = suggested(&three(&[]), 13, &others, None);
    let cameras: Vec<Pair> = found.iter().map(|found| found.cameras).collect();
    let tried: Vec<Tried> = found.iter().map(|found| found.candidate.tried).collect();
    assert!(tried.is_sorted(), "{tried:?}");
    assert_eq!(tried[0], Tried::Not);
    // 3 and 6 are matched: their neighbours see what they see.
    let common = |found: &SuggestedMatch| match found.candidate.reason {
        Reason::Common(third) => [3, 6].contains(&third),
        _ => false,
    };
    assert!(common(&found[0]), "{:?}", found[0]);
    let used = cameras.iter().position(|&cameras| cameras == (3, 6));
    assert!(used.is_none_or(|at| tried[at] == Tried::Used));
    for failed in [(0, 12), (2, 5)] {
        assert!(!cameras.contains(&failed), "{failed:?}");
    }
    let at = suggested(&three(&[]), 13, &others, Some(12));
    assert!(!at.is_empty());
    assert!(at.iter().all(|found| found.cameras.1 == 12));
    assert!(at.iter().all(|found| found.cameras != (0, 12)));
    // Without any matches the largest group is named.
    let at = suggested(&three(&[]), 13, &[], Some(12));
    assert!(at.iter().all(|found| found.observations.len() == 2));
    assert_eq!(at[0].images, 5);
}

/// Groups of cameras and points, and random observations besides: nodes and cameras.
fn groups(seed: u64) -> (Graph, u32) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let groups = random.random_range(2..4);
    let cameras = 3 * groups + 2;
    let points = 4 * groups + 3;
    let mut seen = BTreeSet::new();
    for group in 0..groups {
        for camera in 3 * group..3 * group + 3 {
            for point in 4 * group..4 * group + 4 {
                seen.insert((camera, cameras + point));
            }
        }
    }
    for _ in 0..random.random_range(0..6) {
        let camera = random.random_range(0..cameras);
        seen.insert((camera, cameras + random.random_range(0..points)));
    }
    (Graph::new(cameras + points, seen).unwrap(), cameras)
}

/// The most cameras in a component that holds these.
fn cameras_with(graph: &Graph, cameras: u32, both: Pair) -> usize {
    let verdict = verdict(graph, Model::Calibrated);
    let nodes = verdict.components.iter().map(|part| part.nodes());
    let holding = nodes.filter(|nodes| nodes.contains(&both.0) && nodes.contains(&both.1));
    let sizes = holding.map(|nodes| nodes.partition_point(|&v| v < cameras));
    sizes.max().unwrap_or(0)
}

/// The whole graph is decided with what is suggested, with less, and with other points.
#[test]
fn suggestions_are_true() {
    let (mut one, mut two) = (0, 0);
    for seed in 0..60 {
        let (graph, cameras) = groups(seed);
        let whole = verdict(&graph, Model::Calibrated);
        let parts = Parts::new(&graph, &whole);
        for found in suggested(&graph, cameras, &[], None) {
            let seen = &found.observations;
            let size = |more: &[Pair]| {
                let graph = with(&graph, more.iter().copied());
                cameras_with(&graph, cameras, found.cameras)
            };
            assert_eq!(size(seen), found.images, "{found:?}");
            for k in 0..seen.len() {
                let mut fewer = seen.clone();
                fewer.remove(k);
                assert!(size(&fewer) < found.images, "{found:?}");
            }
            match seen.len() {
                1 => one += 1,
                _ => two += 1,
            }
            // Any other point of the same component that is in no other one.
            for (k, &(camera, point)) in seen.iter().enumerate() {
                let part = parts.of(point)[0];
                let alone = |&v: &u32| {
                    v >= cameras && parts.of(v) == [part] && parts.links_at(v).next().is_none()
                };
                let is_new = |&other: &u32| !seen.contains(&(camera, other));
                for other in (0..graph.nodes() as u32).filter(alone).filter(is_new) {
                    let mut changed = seen.clone();
                    changed[k] = (camera, other);
                    assert_eq!(size(&changed), found.images, "{found:?} {other}");
                }
            }
        }
    }
    assert!(one > 20 && two > 20, "{one} {two}");
}

/// With frames: what is enough joins the two cameras in the whole graph, one observation fewer does not,
/// and no two images of one frame are named.
#[test]
fn enough_with_frames_is_enough_in_the_whole_graph() {
    let mut sizes = BTreeSet::new();
    for (graph, known) in frames(200) {
        let plain = options(Model::Calibrated);
        let options = plain.clone().displacements(known.clone());
        let verdict = viewcert::decide(&graph, &options).unwrap();
        let parts = Parts::new(&graph, &verdict);
        let cameras = graph.edges().iter().map(|edge| edge.1).min().unwrap();
        let wanted = Wanted {
            most: 1000,
            at: None,
        };
        let found = suggest_matches(&graph, &parts, cameras, Known::default(), wanted, &plain);
        for one in found.unwrap() {
            let (a, b) = one.cameras;
            let of_one = known
                .groups()
                .iter()
                .any(|group| group.contains(&a) && group.contains(&b));
            assert!(!of_one, "{one:?}");
            // The components of both, where they have one.
            let mut wanted = vec![a, b];
            let of = [a, b].into_iter().filter_map(|v| parts.of(v).first());
            wanted.extend(of.flat_map(|&part| &parts.parts[part as usize].nodes));
            let joined = |more: &[Pair]| {
                let graph = with(&graph, more.iter().copied());
                let verdict = viewcert::decide(&graph, &options).unwrap();
                verdict.components.iter().any(|component| {
                    let nodes = component.nodes();
                    wanted.iter().all(|v| nodes.binary_search(v).is_ok())
                })
            };
            assert!(joined(&one.observations), "{one:?}");
            for k in 0..one.observations.len() {
                let mut fewer = one.observations.clone();
                fewer.remove(k);
                assert!(!joined(&fewer), "{one:?}");
            }
            let scaled = one
                .components
                .iter()
                .filter(|&&k| parts.is_scaled(k))
                .count();
            sizes.insert((one.observations.len(), scaled.min(2)));
        }
    }
    assert!(sizes.len() >= 5, "{sizes:?}");
}
