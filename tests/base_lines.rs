//! Certificates for unknown base lines from the prover to both checkers, on small graphs with frames of
//! all kinds: rigs with places that are known, unknown or some of them, images that see nothing, nodes
//! that are in no pair, known displacements across frames, known parts.

use crate::common::second_checker;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use viewcert::certificate::hex;
use viewcert::decide::{RigFrames, SharedBaseLines};
use viewcert::graph::{Displacements, Graph, KnownParts};
use viewcert::watch::Watch;
use viewcert::{Known, Options, Question, decide};
use viewcert_check::Verified;

/// What is certified.
struct Certified {
    graph: Graph,
    displacements: Option<String>,
    frames: String,
    found: SharedBaseLines,
    text: String,
}

/// A graph of up to 12 nodes with frames; nothing where no base line is unknown.
fn certified(seed: u64) -> Option<Certified> {
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    let (mut known, mut frames, mut nodes) = (Vec::new(), Vec::new(), 0);
    for _ in 0..dice.random_range(1..=2) {
        let first = known.len() as u32;
        let sensors = dice.random_range(2..=3);
        known.extend((0..sensors).map(|_| dice.random_bool(0.4)));
        for _ in 0..dice.random_range(1..=3) {
            let mut images = Vec::new();
            for sensor in first..first + sensors {
                if dice.random_bool(0.8) {
                    images.push((nodes, sensor));
                    nodes += 1;
                }
            }
            frames.push(images);
        }
    }
    nodes += dice.random_range(0..=4);
    if !(2..=12).contains(&nodes) {
        return None;
    }
    // Now and then sensors see nothing in common.
    let (share, by_sensor) = (dice.random_range(0.1..0.6), dice.random_bool(0.2));
    let at = |v: u32| frames.iter().flatten().find(|(node, _)| *node == v);
    let sensor_at = |v: u32| at(v).map_or(0, |(_, sensor)| *sensor);
    let pairs = (0..nodes).flat_map(|j| (0..j).map(move |i| (i, j)));
    let pairs = pairs.filter(|&(i, j)| match by_sensor {
        true => sensor_at(i) == sensor_at(j),
        false => dice.random_bool(share),
    });
    let pairs: Vec<_> = pairs.collect();
    let graph = Graph::new(nodes, pairs).unwrap();
    let mut groups: Vec<(u32, u32)> = Vec::new();
    let is_given = dice.random_bool(0.7);
    for images in frames.iter().filter(|_| is_given) {
        let places = images.iter().filter(|(_, k)| known[*k as usize]);
        let places: Vec<u32> = places.map(|&(node, _)| node).collect();
        groups.extend(places.windows(2).map(|two| (two[0], two[1])));
    }
    if dice.random_bool(0.2) {
        let (i, j) = (dice.random_range(0..nodes), dice.random_range(0..nodes));
        groups.extend((i != j).then_some((i, j)));
    }
    let groups = Displacements::new(nodes, groups).unwrap();
    let parts = dice.random_bool(0.2) && groups.is_empty();
    let displacements = (!groups.is_empty()).then(|| hex(&groups.sha256()));
    let given = if parts {
        let part: BTreeSet<u32> = (0..3).map(|_| dice.random_range(0..nodes)).collect();
        Known::Parts(KnownParts::new(nodes, [part.into_iter().collect::<Vec<u32>>()]).unwrap())
    } else {
        Known::Displacements(groups)
    };
    let options = Options::default().question(Question::calibrated(given));
    let verdict = decide(&graph, &options).unwrap();
    let frames = RigFrames::new(frames, known).unwrap();
    let found =
        SharedBaseLines::new(&graph, &verdict, &frames, seed, &Watch::default()).unwrap()?;
    let certificate = verdict.certificate(&graph).with_base_lines(&found);
    let text = certificate.compact().to_string();
    let frames = hex(&frames.sha256());
    Some(Certified {
        displacements,
        frames,
        found,
        text,
        graph,
    })
}

fn checked(text: &str, graph: Option<&viewcert_check::Graph>) -> Result<Verified, String> {
    viewcert_check::check(text.as_bytes(), graph).map_err(|failure| failure.to_string())
}

#[test]
#[ignore = "needs python3"]
fn both_checkers_verify_what_is_found() {
    let all: Vec<Certified> = (0..2500).filter_map(certified).collect();
    let mut lines = String::new();
    let mut counts = [0; 9];
    for case in &all {
        let Certified { found, text, .. } = case;
        let verified = checked(text, None).unwrap_or_else(|why| panic!("{why}\n{text}"));
        let shown = verified.base_lines.expect("base lines");
        assert_eq!(shown.sha256, case.frames);
        assert_eq!(
            (shown.frames, shown.unknown),
            (found.frames, found.base_lines)
        );
        let bounds = [shown.at_least, shown.at_most, shown.required];
        assert_eq!(
            bounds.map(|x| x as usize),
            [found.rank, found.at_most, found.required]
        );
        assert_eq!(shown.about_one_axis, found.about_one_axis);
        let value = shown.value();
        assert_eq!(value, found.value());
        for (count, is_so) in counts.iter_mut().zip([
            true,
            value == "solvable",
            value == "not-finite-solvable",
            value == "open",
            shown.about_one_axis,
            case.displacements.is_some(),
            verified.parts > 0,
            text.contains("\"upper\":{\"held\":[0") || text.contains("\"upper\":{\"held\":[1"),
            value == "solvable" && !shown.about_one_axis,
        ]) {
            *count += usize::from(is_so);
        }
        lines += text;
    }
    let least = [1500, 500, 1000, 1, 500, 400, 200, 20, 10];
    assert!(counts.iter().zip(least).all(|(a, b)| *a >= b), "{counts:?}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("certificates.jsonl");
    std::fs::write(&path, lines).unwrap();
    let out = second_checker(&["--list", path.to_str().unwrap()]).out;
    let sum = all.len();
    let last = out.lines().last().unwrap_or_default();
    assert_eq!(
        last,
        format!("{sum} verified, 0 rejected, 0 too large"),
        "{out}"
    );
}

/// The frames are bound: with a graph, those that are given have to be those that are stated.
#[test]
fn frames_are_those_that_are_given() {
    let case = (0..).find_map(certified).unwrap();
    let pairs = case.graph.edges().iter().copied();
    let graph = viewcert_check::Graph::new(case.graph.nodes(), pairs).unwrap();
    let graph = match &case.displacements {
        Some(hash) => graph.with_displacements(hash.clone()),
        None => graph,
    };
    let why = checked(&case.text, Some(&graph)).unwrap_err();
    assert!(
        why.contains("the frames are not those that are given"),
        "{why}"
    );
    let others = graph.clone().with_frames("0".repeat(64));
    assert!(checked(&case.text, Some(&others)).is_err());
    assert!(checked(&case.text, Some(&graph.with_frames(case.frames))).is_ok());
}
