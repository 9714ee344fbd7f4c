//! Camera-point graphs in the calibrated model (docs/theory.md, section 12): answers worked out by
//! hand, and ranks of the whole matrix beside those that contraction comes to.

use crate::common::{verify, verify_with};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha20Rng;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use viewcert::geometry::plane_flow::PlaneFlows;
use viewcert::graph::Graph;
use viewcert::linalg::prime::PrimeField;

/// Observations: a camera and a point.
type Observations = Vec<(u32, u32)>;

fn list(observations: &[(u32, u32)]) -> String {
    let line = |(camera, point): &(u32, u32)| format!("{camera} {point}\n");
    let lines: String = observations.iter().map(line).collect();
    format!("# viewcert pairs\n{lines}")
}

/// The line of `--json`, and the certificate, which the checker has accepted.
fn decided(observations: &[(u32, u32)], options: &[&str]) -> (Value, Value) {
    let text = list(observations);
    let with = |more: &[&str]| {
        let arguments = [&["-", "--model", "calibrated"], options, more].concat();
        verify_with(text.as_bytes(), &arguments)
    };
    let run = with(&["--json"]);
    assert!(run.code <= 1, "{}", run.err);
    let certificate = with(&["--certificate", "-"]).out;
    let check = verify_with(certificate.as_bytes(), &["check", "-"]);
    assert_eq!(check.code, 0, "{}{}", check.out, check.err);
    (
        run.json().remove(0),
        serde_json::from_str(&certificate).unwrap(),
    )
}

/// Holds verdict, rank and components against those worked out by hand; `components` are pairs
/// of nodes and edges, by falling number of edges.
fn expect(what: &str, observations: &[(u32, u32)], rank: usize, components: &[(usize, usize)]) {
    let nodes: BTreeSet<u32> = observations.iter().flat_map(|&(c, p)| [c, p]).collect();
    let required = 3 * nodes.len() - 4;
    let (line, _) = decided(observations, &[]);
    let verdict = if rank == required {
        "solvable"
    } else {
        "not-finite-solvable"
    };
    assert_eq!(line["verdict"], verdict, "{what}");
    assert_eq!(line["strength"], "proof", "{what}");
    assert_eq!(line["rank"], rank, "{what}");
    assert_eq!(line["rank_required"], required, "{what}");
    let expected: Vec<Value> = components
        .iter()
        .map(|&(nodes, edges)| json!({"nodes": nodes, "edges": edges}))
        .collect();
    assert_eq!(line["components"], Value::from(expected), "{what}");
}

/// The number of a point.
fn point(k: u32) -> u32 {
    1000 + k
}

/// Four cameras that see the same four points: 8 nodes, 16 observations, rank 20.
fn cluster(cameras: [u32; 4], points: [u32; 4]) -> Observations {
    let sees = |&camera: &u32| points.map(|k| (camera, point(k)));
    cameras.iter().flat_map(sees).collect()
}

fn clusters_and(a: &[(u32, u32)], b: &[(u32, u32)], joints: &[(u32, u32)]) -> Observations {
    let joints = joints.iter().map(|&(camera, k)| (camera, point(k)));
    a.iter().chain(b).copied().chain(joints).collect()
}

#[test]
fn two_clusters_by_hand() {
    let a = cluster([0, 1, 2, 3], [0, 1, 2, 3]);
    let b = cluster([4, 5, 6, 7], [4, 5, 6, 7]);
    let join = |joints: &[(u32, u32)]| clusters_and(&a, &b, joints);
    expect("apart", &join(&[]), 40, &[(8, 16), (8, 16)]);
    expect(
        "one observation",
        &join(&[(0, 4)]),
        42,
        &[(8, 16), (8, 16), (2, 1)],
    );
    expect(
        "two with four ends",
        &join(&[(0, 4), (5, 1)]),
        44,
        &[(16, 34)],
    );
    expect(
        "two with four ends, one way",
        &join(&[(0, 4), (1, 5)]),
        44,
        &[(16, 34)],
    );
    // The common end joins the other side.
    expect(
        "two by one camera",
        &join(&[(0, 4), (0, 5)]),
        43,
        &[(9, 18), (8, 16)],
    );
    expect(
        "two of one point",
        &join(&[(0, 4), (1, 4)]),
        43,
        &[(9, 18), (8, 16)],
    );
    // The hinge camera 0 has joined; another observation elsewhere fixes the scale.
    expect(
        "a hinge and one more",
        &join(&[(0, 4), (0, 5), (6, 1)]),
        44,
        &[(16, 35)],
    );

    // Points that each side sees once are one equation each.
    let once: Vec<(u32, u32)> = (0..4).flat_map(|k| [(k, 8 + k), (4 + k, 8 + k)]).collect();
    let mut single = vec![(8, 16), (8, 16)];
    single.extend([(2, 1); 6]);
    expect("three points", &join(&once[..6]), 52, &single);
    expect("four points", &join(&once), 56, &[(20, 40)]);
    // All through one pair of cameras they are a body with it, hinged to both: 20 + 20 + 14.
    let through_one_pair: Vec<(u32, u32)> = (8..12).flat_map(|k| [(0, k), (4, k)]).collect();
    expect(
        "four points of one pair",
        &join(&through_one_pair),
        54,
        &[(8, 16), (8, 16), (6, 8)],
    );

    // A point that two cameras of one side see belongs to it.
    let twice = [(0, 8), (1, 8), (4, 8)];
    expect("seen twice", &join(&twice), 45, &[(9, 18), (8, 16), (2, 1)]);
    let both = [twice.as_slice(), &[(2, 9), (3, 9), (5, 9)]].concat();
    expect("two seen twice", &join(&both), 50, &[(18, 38)]);
}

#[test]
fn clusters_that_share_nodes() {
    let a = cluster([0, 1, 2, 3], [0, 1, 2, 3]);
    // A common camera: 15 nodes, the scales are free against each other.
    let b = cluster([3, 4, 5, 6], [4, 5, 6, 7]);
    let join = |joints: &[(u32, u32)]| clusters_and(&a, &b, joints);
    expect("a common camera", &join(&[]), 40, &[(8, 16), (8, 16)]);
    expect("and an observation", &join(&[(0, 4)]), 41, &[(15, 33)]);
    // A common point, and two.
    let b = cluster([4, 5, 6, 7], [3, 4, 5, 6]);
    expect(
        "a common point",
        &clusters_and(&a, &b, &[]),
        40,
        &[(8, 16), (8, 16)],
    );
    let b = cluster([4, 5, 6, 7], [2, 3, 4, 5]);
    expect(
        "two common points",
        &clusters_and(&a, &b, &[]),
        38,
        &[(14, 32)],
    );
}

#[test]
fn a_point_seen_once_is_never_determined() {
    let mut seen = cluster([0, 1, 2, 3], [0, 1, 2, 3]);
    seen.push((0, point(4)));
    expect("seen once", &seen, 22, &[(8, 16), (2, 1)]);
}

#[test]
fn a_point_seen_twice_follows_its_cameras() {
    let mut seen = cluster([0, 1, 2, 3], [0, 1, 2, 3]);
    seen.extend([(0, point(4)), (1, point(4))]);
    expect("seen twice", &seen, 23, &[(9, 18)]);
}

/// Three clusters in a row, each hinged to the next at a camera: two hinges, three components,
/// and the outer ones have no camera in common.
#[test]
fn hinges_are_not_transitive() {
    let rows = [
        cluster([0, 1, 2, 3], [0, 1, 2, 3]),
        cluster([3, 4, 5, 6], [4, 5, 6, 7]),
        cluster([6, 7, 8, 9], [8, 9, 10, 11]),
    ];
    let seen = rows.concat();
    expect("three in a row", &seen, 60, &[(8, 16), (8, 16), (8, 16)]);
    let (_, certificate) = decided(&seen, &[]);
    // Pieces that are one body each: nothing is left to compute.
    assert_eq!(certificate["rigid"]["bodies"].as_array().unwrap().len(), 3);
    assert_eq!(certificate["pieces"], json!([]));
    // A ring of four clusters, each hinged to the next one, is rigid: no two share two nodes.
    let mut ring = seen;
    ring.extend(cluster([9, 10, 11, 0], [12, 13, 14, 15]));
    expect("a ring of four", &ring, 80, &[(28, 64)]);
}

fn tracks_of_pairs(pairs: &[(u32, u32)]) -> Observations {
    let two = |(k, &(i, j)): (u32, &(u32, u32))| [(i, point(k)), (j, point(k))];
    (0..).zip(pairs).flat_map(two).collect()
}

/// Points with two observations: one equation for each, and 3 c - 4 = 8 are needed.
#[test]
fn tracks_of_two_images() {
    let ring = [(0, 1), (1, 2), (2, 3), (0, 3)];
    let twice = [ring, ring].concat();
    expect("a ring, twice", &tracks_of_pairs(&twice), 32, &[(12, 16)]);
    let spread = [
        (0, 1),
        (0, 1),
        (2, 3),
        (2, 3),
        (0, 2),
        (1, 3),
        (0, 3),
        (1, 2),
    ];
    expect(
        "all pairs, two of them twice",
        &tracks_of_pairs(&spread),
        32,
        &[(12, 16)],
    );
    // Seven are too few. What two points tie together are the pairs that are there twice.
    let mut parts = vec![(4, 4), (4, 4)];
    parts.extend([(2, 1); 6]);
    expect("one point less", &tracks_of_pairs(&spread[..7]), 28, &parts);
    // Six for three cameras, which can use five, and two for the fourth.
    let heaped = [
        (0, 1),
        (0, 1),
        (1, 2),
        (1, 2),
        (0, 2),
        (0, 2),
        (0, 3),
        (1, 3),
    ];
    let mut parts = vec![(9, 12)];
    parts.extend([(2, 1); 4]);
    expect("heaped", &tracks_of_pairs(&heaped), 31, &parts);
}

/// Camera k of Fano's plane sees the points k, k + 1 and k + 3 modulo 7.
fn heawood() -> Observations {
    let line = |k: u32| [0, 1, 3].map(|step| (k, point((k + step) % 7)));
    (0..7).flat_map(line).collect()
}

#[test]
fn heawood_is_rigid_without_a_body() {
    expect("Heawood", &heawood(), 38, &[(14, 21)]);
    let (_, certificate) = decided(&heawood(), &[]);
    assert_eq!(certificate["bodies"], json!([]));
    assert_eq!(certificate["pieces"].as_array().unwrap().len(), 1);
    // Two cameras have one point in common, so there is no pair to average.
    let sees = |camera: u32| -> BTreeSet<u32> {
        let seen = heawood().into_iter().filter(|&(c, _)| c == camera);
        seen.map(|(_, point)| point).collect()
    };
    for i in 0..7 {
        for j in 0..i {
            assert_eq!(sees(i).intersection(&sees(j)).count(), 1);
        }
    }
}

/// Tracks of three images among nine in a row of fourteen, thinned until no two cameras see two
/// common points: closure finds nothing. Some of these graphs are rigid and some are not; the rank
/// is that of the whole matrix.
#[test]
fn thinned_tracks_against_the_whole_matrix() {
    let mut rigid = 0;
    for seed in 0..30 {
        let mut random = ChaCha20Rng::seed_from_u64(seed);
        let mut seen = Observations::new();
        let mut pairs = BTreeSet::new();
        for k in 0..200 {
            let first = random.next_u32() % 6;
            let mut cameras = BTreeSet::new();
            while cameras.len() < 3 {
                cameras.insert(first + random.next_u32() % 9);
            }
            let cameras: Vec<u32> = cameras.into_iter().collect();
            let its = [(0, 1), (0, 2), (1, 2)].map(|(a, b)| (cameras[a], cameras[b]));
            if pairs.len() < 3 * 18 && its.iter().all(|pair| !pairs.contains(pair)) {
                pairs.extend(its);
                seen.extend(cameras.into_iter().map(|camera| (camera, point(k))));
            }
        }
        let (line, certificate) = decided(&seen, &[]);
        assert_eq!(certificate["bodies"], json!([]));
        let (whole, _) = decided(&seen, &["--method", "matrix"]);
        for member in ["rank", "verdict", "components"] {
            assert_eq!(line[member], whole[member], "seed {seed}");
        }
        rigid += usize::from(line["verdict"] == "solvable");
    }
    assert!(0 < rigid && rigid < 30, "{rigid}");
}

/// The rank of N modulo 2^61 - 1 at these positions.
fn rank_at(seen: &[(u32, u32)], positions: impl Fn(u32) -> [i64; 3]) -> usize {
    let names: BTreeSet<u32> = seen.iter().flat_map(|&(c, p)| [c, p]).collect();
    let numbers: BTreeMap<u32, u32> = names.iter().copied().zip(0..).collect();
    let pairs = seen.iter().map(|&(c, p)| (numbers[&c], numbers[&p]));
    let graph = Graph::new(names.len() as u32, pairs).unwrap();
    let field = PrimeField::mersenne61();
    let residue = |x: i64| field.from_u64(x.rem_euclid(field.modulus() as i64) as u64);
    let centres: Vec<[u64; 3]> = names
        .iter()
        .map(|&name| positions(name).map(residue))
        .collect();
    let flows = viewcert::watch::unwatched(|task| PlaneFlows::new(&field, &graph, &centres, task));
    flows.rigidity_rank()
}

/// A position without anything special about it.
fn somewhere(name: u32) -> [i64; 3] {
    let mut random = ChaCha20Rng::seed_from_u64(name.into());
    std::array::from_fn(|_| i64::from(random.next_u32()))
}

#[test]
fn coplanar_cameras_and_zero_baselines() {
    let at_one_height = |name: u32| {
        let [x, y, z] = somewhere(name);
        [x, y, if name < point(0) { 0 } else { z }]
    };
    // Two clusters joined through points do not mind; a ring of four cameras moves.
    let a = cluster([0, 1, 2, 3], [0, 1, 2, 3]);
    let b = cluster([4, 5, 6, 7], [4, 5, 6, 7]);
    let joined = clusters_and(&a, &b, &[(0, 4), (5, 1)]);
    assert_eq!(rank_at(&joined, somewhere), 44);
    assert_eq!(rank_at(&joined, at_one_height), 44);
    let ring = [(0, 1), (1, 2), (2, 3), (0, 3)];
    let ring = tracks_of_pairs(&[ring, ring].concat());
    assert_eq!(rank_at(&ring, somewhere), 32);
    assert_eq!(rank_at(&ring, at_one_height), 31);

    // Point 4, which cameras 0 and 1 see, may slide if these are at one place.
    let mut seen = a;
    seen.extend([(0, point(4)), (1, point(4))]);
    let no_baseline = |name: u32| somewhere(name.max(1));
    assert_eq!(rank_at(&seen, somewhere), 23);
    assert_eq!(rank_at(&seen, no_baseline), 22);
}

/// A list of observations may be verified from a file as well, and what is too large to be
/// embedded is checked against it.
#[test]
fn a_long_path_is_one_body() {
    let folder = tempfile::tempdir().unwrap();
    let graph = folder.path().join("tracks.txt");
    let certificate = folder.path().join("certificate.json");
    // Point k is seen by the cameras k / 2 to k / 2 + 2: neighbours share three points and more.
    let seen: Observations = (0..400)
        .flat_map(|k| [0, 1, 2].map(|step| (k / 2 + step, point(k))))
        .collect();
    std::fs::write(&graph, list(&seen)).unwrap();
    let [graph, certificate] = [&graph, &certificate].map(|path| path.to_str().unwrap());
    let model = ["--model", "calibrated", "--json"];
    let arguments = [&[graph], &model[..], &["--certificate", certificate]].concat();
    let run = verify(&arguments);
    assert_eq!(run.code, 0, "{}", run.err);
    assert_eq!(run.json()[0]["rank"], 3 * 602 - 4);
    let written: Value = serde_json::from_slice(&std::fs::read(certificate).unwrap()).unwrap();
    assert_eq!(written["pieces"], json!([]));
    let check = verify(&["check", certificate, graph, "--model", "calibrated"]);
    assert_eq!(check.code, 0, "{}{}", check.out, check.err);
}
