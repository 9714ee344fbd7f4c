//! Small graphs for tests.

use crate::joints::{Joints, joints};
use crate::parts::Parts;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use viewcert::Graph;
use viewcert::decide::{Options, Question};
use viewcert::graph::Displacements;
use viewcert::{Model, Verdict, decide};

/// Random graphs of 4 to 9 nodes, sparse ones and dense ones.
pub(crate) fn graphs(count: u64) -> impl Iterator<Item = Graph> {
    (0..count).map(|seed| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let nodes = random.random_range(4..10);
        let percent = random.random_range(25..75);
        let all = (0..nodes).flat_map(|i| (i + 1..nodes).map(move |j| (i, j)));
        let pairs: Vec<_> = all
            .filter(|_| random.random_range(0..100) < percent)
            .collect();
        Graph::new(nodes, pairs).unwrap()
    })
}

/// Clusters of four or five nodes, each a complete graph, and random pairs besides.
pub(crate) fn clusters(count: u64) -> impl Iterator<Item = Graph> {
    (0..count).map(|seed| {
        let mut random = ChaCha8Rng::seed_from_u64(1000 + seed);
        let clusters = random.random_range(2..4);
        let mut pairs = Vec::new();
        let mut nodes = 0u32;
        for _ in 0..clusters {
            let size = random.random_range(4..6);
            // Some clusters begin with a node of the one before.
            let first = nodes - u32::from(nodes > 0 && random.random_range(0..3) == 0);
            let all = first..first + size;
            pairs.extend(
                all.clone()
                    .flat_map(|i| (i + 1..first + size).map(move |j| (i, j))),
            );
            nodes = first + size;
        }
        nodes += 2;
        for _ in 0..random.random_range(1..6) {
            let (i, j) = (random.random_range(0..nodes), random.random_range(0..nodes));
            if i != j {
                pairs.push((i, j));
            }
        }
        Graph::new(nodes, pairs).unwrap()
    })
}

/// Camera-point graphs: four to six cameras, points that two to four of them see.
pub(crate) fn tracks(count: u64) -> impl Iterator<Item = Graph> {
    (0..count).map(|seed| {
        let mut random = ChaCha8Rng::seed_from_u64(2000 + seed);
        let cameras: u32 = random.random_range(4..7);
        let points: u32 = random.random_range(4..13);
        let mut observations = Vec::new();
        for point in cameras..cameras + points {
            // Views in a row, from anywhere.
            let first = random.random_range(0..cameras);
            let views = random.random_range(2..5);
            observations.extend((first..first + views).map(|c| (c % cameras, point)));
        }
        Graph::new(cameras + points, observations).unwrap()
    })
}

/// Camera-point graphs in two groups of cameras, with few tracks between these, and frames of two or
/// three cameras of any groups.
pub(crate) fn frames(count: u64) -> impl Iterator<Item = (Graph, Displacements)> {
    (0..count).map(|seed| {
        let mut random = ChaCha8Rng::seed_from_u64(4000 + seed);
        let cameras: u32 = random.random_range(6..11);
        let half = cameras / 2;
        let points: u32 = random.random_range(6..17);
        let mut observations = Vec::new();
        for point in cameras..cameras + points {
            let side = if random.random_range(0..2) == 0 {
                0..half
            } else {
                half..cameras
            };
            let seen = side.filter(|_| random.random_range(0..10) < 7);
            observations.extend(seen.map(|camera| (camera, point)));
            if random.random_range(0..12) == 0 {
                observations.push((random.random_range(0..cameras), point));
            }
        }
        let mut all: Vec<u32> = (0..cameras).collect();
        all.shuffle(&mut random);
        let mut pairs = Vec::new();
        for _ in 0..random.random_range(1..4) {
            let size = random.random_range(2..4);
            let frame = all.split_off(all.len().saturating_sub(size));
            pairs.extend(frame.windows(2).map(|two| (two[0], two[1])));
        }
        let graph = Graph::from_pairs(cameras + points, observations).unwrap().0;
        (graph, Displacements::new(cameras + points, pairs).unwrap())
    })
}

/// Sequences of cameras, each paired with the next two to four, some pairs missing and some further
/// ones, in any order of names.
pub(crate) fn sequences(count: u64, nodes: u32) -> impl Iterator<Item = Graph> {
    (0..count).map(move |seed| {
        let mut random = ChaCha8Rng::seed_from_u64(3000 + seed);
        let mut names: Vec<u32> = (0..nodes).collect();
        if seed % 2 == 1 {
            names.shuffle(&mut random);
        }
        let next = random.random_range(2..5);
        let missing = random.random_range(0..12);
        let mut pairs: Vec<(u32, u32)> = (0..nodes)
            .flat_map(|i| (i + 1..nodes.min(i + 1 + next)).map(move |j| (i, j)))
            .filter(|_| random.random_range(0..100) >= missing)
            .collect();
        for _ in 0..random.random_range(0..4) {
            pairs.push((
                random.random_range(0..nodes / 2),
                random.random_range(nodes / 2..nodes),
            ));
        }
        let named = pairs.iter();
        let named = named.map(|&(i, j)| (names[i as usize], names[j as usize]));
        Graph::new(nodes, named).unwrap()
    })
}

/// Grids of `side` times `side` cameras: each is paired with its four neighbours, and some with more near ones.
pub(crate) fn grids(count: u64, side: u32) -> impl Iterator<Item = Graph> {
    (0..count).map(move |seed| {
        let mut random = ChaCha8Rng::seed_from_u64(5000 + seed);
        let more = random.random_range(10..60);
        let mut pairs = Vec::new();
        for (x, y) in (0..side * side).map(|v| (v % side, v / side)) {
            for (dx, dy, percent) in [(1, 0, 100), (0, 1, 100), (1, 1, more), (2, 0, more)] {
                let (i, j) = (x + dx, y + dy);
                if i < side && j < side && random.random_range(0..100) < percent {
                    pairs.push((y * side + x, j * side + i));
                }
            }
        }
        Graph::new(side * side, pairs).unwrap()
    })
}

/// The question in a model.
pub(crate) fn options(model: Model) -> Options {
    Options::default().question(Question::without_solutions(model))
}

/// The verdict in a model.
pub(crate) fn verdict(graph: &Graph, model: Model) -> Verdict {
    decide(graph, &options(model)).unwrap()
}

/// The verdict, its parts, and their joints.
pub(crate) fn found(graph: &Graph, model: Model) -> (Verdict, Parts, Joints) {
    let verdict = verdict(graph, model);
    let parts = Parts::new(graph, &verdict);
    let joints = joints(graph, &verdict, &parts, &options(model), 1000).unwrap();
    (verdict, parts, joints)
}

/// Whether some nodes lie in one component.
pub(crate) fn together(graph: &Graph, model: Model, nodes: &[u32]) -> bool {
    let verdict = verdict(graph, model);
    verdict.components.iter().any(|component| {
        let all = component.nodes();
        nodes.iter().all(|v| all.binary_search(v).is_ok())
    })
}
