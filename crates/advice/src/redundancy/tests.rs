//! Against ranks by textbook elimination of whole matrices at random cameras, without each pair in
//! turn, and against the loss of every set in turn.

use super::*;
use crate::Weak;
use crate::condensation::without;
use crate::parts::Alone;
use crate::parts::Parts;
use crate::tests::{clusters, graphs, options, sequences, together, tracks, verdict};
use crate::weak::{weak_images, weak_pairs};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::collections::BTreeMap;
use viewcert::decide::Options;
use viewcert::geometry::camera::normal_form;
use viewcert::geometry::jacobian::{dense, jacobian};
use viewcert::geometry::plane_direction::direction_rows;
use viewcert::geometry::plane_flow::rigidity_rows;
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::textbook;
use viewcert::{Graph, Model, Strength};

type Pair = (u32, u32);

/// The rank of J_P (calibrated: of N; affine: four times that of R) at random cameras.
fn rank(graph: &Graph, model: Model) -> usize {
    let field = PrimeField::mersenne61();
    let mut random = ChaCha8Rng::seed_from_u64(77);
    let mut residue = || field.from_u64(random.random_range(0..field.modulus()));
    let n = graph.nodes();
    let centres: Vec<[u64; 3]> = (0..n).map(|_| [residue(), residue(), residue()]).collect();
    let points: Vec<[u64; 2]> = centres.iter().map(|c| [c[0], c[1]]).collect();
    let (rows, columns, times) = match model {
        Model::Projective => {
            let cameras: Vec<_> = centres.iter().map(|c| normal_form(&field, c)).collect();
            (jacobian(&field, graph, &cameras), 12 * n, 1)
        }
        Model::Calibrated => (rigidity_rows(&field, graph, &centres), 3 * n, 1),
        Model::Affine => (direction_rows(&field, graph, &points), 2 * n, 4),
    };
    times * textbook::eliminate(&field, &dense(&field, &rows, columns)).rank()
}

/// The pairs without full surplus, by ranks.
fn expected(graph: &Graph, model: Model) -> Vec<(Pair, usize)> {
    let (whole, own) = (model.required(2), rank(graph, model));
    let of_pair = graph.edges().iter().map(|&pair| {
        let taken = own - rank(&without(graph, &[pair]), model);
        (pair, whole - taken)
    });
    of_pair.filter(|&(_, surplus)| surplus < whole).collect()
}

/// 500 random graphs in each model: sparse and dense ones, clusters, camera-point graphs, sequences.
#[test]
fn surplus_is_what_ranks_say() {
    for model in Model::ALL {
        let all = graphs(300)
            .chain(clusters(30))
            .chain(tracks(80))
            .chain(sequences(90, 10));
        let all: Vec<Graph> = all.collect();
        assert_eq!(all.len(), 500);
        let counts: Vec<[usize; 8]> = all
            .par_iter()
            .map(|graph| {
                let verdict = verdict(graph, model);
                let found = surplus(graph, &verdict, &options(model)).unwrap();
                assert!(
                    found.iter().all(|one| one.strength == Strength::Proof),
                    "{graph:?}"
                );
                let found: Vec<(Pair, usize)> =
                    found.iter().map(|one| (one.pair, one.surplus)).collect();
                assert_eq!(found, expected(graph, model), "{model} {graph:?}");
                let mut counts = [0; 8];
                for (_, surplus) in &found {
                    counts[*surplus] += 1;
                }
                counts[7] = graph.edges().len() - found.len();
                counts
            })
            .collect();
        let sum = |k: usize| counts.iter().map(|counts| counts[k]).sum::<usize>();
        assert!(
            sum(0) > 500 && sum(7) > 1000,
            "{model} {} {}",
            sum(0),
            sum(7)
        );
        match model {
            Model::Projective => assert!((1..=4).all(|k| sum(k) > 3), "{counts:?}"),
            Model::Calibrated => assert!(sum(1) > 100),
            Model::Affine => assert!((1..=3).all(|k| sum(k) == 0)),
        }
    }
}

/// What is alone in its group is what nothing checks.
#[test]
fn alone_in_a_group_is_surplus_zero() {
    for model in Model::ALL {
        for graph in graphs(60)
            .chain(clusters(20))
            .chain(tracks(30))
            .chain(sequences(14, 30))
        {
            let verdict = verdict(&graph, model);
            let options = options(model);
            let found = surplus(&graph, &verdict, &options).unwrap();
            let none = found
                .iter()
                .filter(|one| one.surplus == 0)
                .map(|one| one.pair);
            let groups = viewcert::decide::groups(&graph, &verdict, &options)
                .unwrap()
                .unwrap();
            let mut sizes = vec![0; groups.count];
            groups
                .of_pairs
                .iter()
                .for_each(|&group| sizes[group as usize] += 1);
            let of_pairs = graph.edges().iter().zip(&groups.of_pairs);
            let alone = of_pairs.filter(|(_, group)| sizes[**group as usize] == 1);
            let alone: Vec<Pair> = alone.map(|(&pair, _)| pair).collect();
            assert_eq!(none.collect::<Vec<_>>(), alone, "{model} {graph:?}");
        }
    }
}

/// Gamma of Example 5.6 has 12 pairs and rank 83: one stress, which every pair is in. No partition
/// into its components, which are single pairs, shows that.
#[test]
fn one_stress_of_a_flexible_graph() {
    let pairs = [
        (0, 2),
        (0, 3),
        (0, 5),
        (1, 4),
        (1, 5),
        (1, 6),
        (1, 7),
        (1, 8),
        (2, 4),
        (2, 6),
        (3, 7),
        (3, 8),
    ];
    // And a pair that hangs on it.
    let graph = Graph::new(10, pairs.into_iter().chain([(8, 9)])).unwrap();
    let verdict = verdict(&graph, Model::Projective);
    let options = options(Model::Projective);
    // Only a hub shows that the rank of the group is 83.
    let groups = viewcert::decide::groups(&graph, &verdict, &options);
    let groups = groups.unwrap().unwrap();
    assert_eq!((groups.count, groups.strength), (2, Strength::Proof));
    let found = surplus(&graph, &verdict, &options).unwrap();
    let ones = found.iter().filter(|one| one.surplus == 1);
    assert_eq!(ones.count(), 12);
    assert_eq!(
        found.last().map(|one| (one.pair, one.surplus)),
        Some(((8, 9), 0))
    );
    assert!(found.iter().all(|one| one.strength == Strength::Proof));
}

/// Graphs in which little is weak: random ones with most pairs, some of them two that share nodes.
fn tough(count: u64) -> impl Iterator<Item = Graph> {
    (0..count).map(|seed| {
        let mut random = ChaCha8Rng::seed_from_u64(9000 + seed);
        let nodes = random.random_range(4..10);
        let percent = random.random_range(60..100);
        let shift = if seed % 3 == 0 {
            nodes - random.random_range(1..4)
        } else {
            nodes
        };
        let one = (0..nodes).flat_map(|i| (i + 1..nodes).map(move |j| (i, j)));
        let all: Vec<Pair> = if seed % 3 == 0 {
            one.flat_map(|(i, j)| [(i, j), (i + shift, j + shift)])
                .collect()
        } else {
            one.collect()
        };
        let mut pairs: Vec<Pair> = all
            .into_iter()
            .filter(|_| random.random_range(0..100) < percent)
            .collect();
        if seed % 3 == 0 {
            for _ in 0..random.random_range(0..6) {
                let (a, b) = (
                    random.random_range(0..shift),
                    random.random_range(nodes..nodes + shift),
                );
                if a < b {
                    pairs.push((a, b));
                }
            }
        }
        Graph::new(2 * nodes, pairs).unwrap()
    })
}

/// Whether a component breaks, by leaving out every set in turn.
fn breaks(graph: &Graph, model: Model, nodes: &[u32], edges: &[Pair], lost: Weak) -> bool {
    match lost {
        Weak::Pairs => {
            let gone = |gone: &[Pair]| !together(&without(graph, gone), model, nodes);
            edges.iter().any(|&one| gone(&[one]))
        }
        Weak::Images => {
            let gone = |gone: &[u32]| {
                let left: Vec<u32> = nodes
                    .iter()
                    .copied()
                    .filter(|v| !gone.contains(v))
                    .collect();
                let place = |v: u32| v - gone.iter().filter(|&&w| w < v).count() as u32;
                let left: Vec<u32> = left.into_iter().map(place).collect();
                left.len() > 1 && !together(&without_nodes(graph, gone), model, &left)
            };
            nodes.iter().any(|&one| gone(&[one]))
        }
    }
}

#[test]
fn nothing_is_weak_where_no_loss_breaks() {
    for model in Model::ALL {
        for lost in [Weak::Pairs, Weak::Images] {
            let graphs: Vec<Graph> = graphs(40).chain(tough(60)).chain(tracks(10)).collect();
            let counts: Vec<[usize; 2]> = graphs
                .par_iter()
                .map(|graph| check_weak(graph, model, lost))
                .collect();
            let sum = |k: usize| counts.iter().map(|count| count[k]).sum::<usize>();
            assert!(
                sum(0) > 5 && sum(1) > 5,
                "{model} {lost:?} {} {}",
                sum(0),
                sum(1)
            );
        }
    }
}

/// For each component with something weak the first of that: two images, or one.
fn first_weak(graph: &Graph, parts: &Parts, lost: Weak, of: &Options) -> BTreeMap<usize, Vec<u32>> {
    let pairs = || weak_pairs(graph, parts, of).unwrap().into_iter();
    let images = || weak_images(graph, parts, of).unwrap().into_iter();
    match lost {
        Weak::Pairs => pairs()
            .rev()
            .map(|weak| (weak.component, vec![weak.pair.0, weak.pair.1]))
            .collect(),
        Weak::Images => images()
            .rev()
            .map(|weak| (weak.component, vec![weak.image]))
            .collect(),
    }
}

/// How many components stay, and how many break.
fn check_weak(graph: &Graph, model: Model, lost: Weak) -> [usize; 2] {
    let verdict = verdict(graph, model);
    let parts = Parts::new(graph, &verdict);
    let found = first_weak(graph, &parts, lost, &options(model));
    let mut counts = [0; 2];
    for (part, edges) in parts.parts.iter().zip(parts.edges(graph)) {
        let broken = found.get(&part.component);
        let expected = breaks(graph, model, &part.nodes, &edges, lost);
        assert_eq!(
            broken.is_some(),
            expected,
            "{model} {lost:?} {:?} {graph:?}",
            part.nodes
        );
        counts[usize::from(expected)] += 1;
        let Some(broken) = broken else {
            continue;
        };
        // What is named does break it.
        let named = match (lost, &broken[..]) {
            (Weak::Pairs, &[a, b]) => {
                assert!(edges.contains(&(a, b)));
                !together(&without(graph, &[(a, b)]), model, &part.nodes)
            }
            (Weak::Images, &[v]) => part.contains(v),
            _ => false,
        };
        assert!(named, "{model} {lost:?} {broken:?} {graph:?}");
    }
    counts
}

/// A thin sequence of 2,000 cameras: each pair of its inside takes 4 of its 7 equations away where
/// the next two are paired, and all check each other. With the next three paired all
/// is checked in full, and whatever pair or image is lost does no harm.
#[test]
fn sequences_are_near_linear() {
    let n = 2000;
    let next =
        |most: u32| (0..n).flat_map(move |i| (i + 1..n.min(i + most + 1)).map(move |j| (i, j)));
    let graph = Graph::new(n, next(2)).unwrap();
    let of = options(Model::Projective);
    let found = surplus(&graph, &verdict(&graph, Model::Projective), &of).unwrap();
    assert_eq!(found.len(), graph.edges().len());
    assert!(found.iter().all(|one| one.strength == Strength::Proof));
    let at = |pair| found.iter().find(|one| one.pair == pair).unwrap().surplus;
    // At the end: 7 of 11 equations of a camera are left, 18 - 14 = 4 are taken.
    assert_eq!(at((0, 1)), 3);
    // The next three: at the end a camera has three pairs, and three cameras separate the rest.
    for most in [3, 4] {
        let graph = Graph::new(n, next(most)).unwrap();
        let verdict = verdict(&graph, Model::Projective);
        assert_eq!(surplus(&graph, &verdict, &of).unwrap(), []);
        let parts = Parts::new(&graph, &verdict);
        for lost in [Weak::Pairs, Weak::Images] {
            assert!(first_weak(&graph, &parts, lost, &of).is_empty());
        }
    }
}

/// A graph without some nodes, given increasing, renumbered.
fn without_nodes(graph: &Graph, gone: &[u32]) -> Graph {
    let stays = |v: &u32| gone.binary_search(v).is_err();
    let nodes: Vec<u32> = (0..graph.nodes() as u32).filter(|v| stays(v)).collect();
    let edges = graph.edges().iter().copied();
    let edges: Vec<(u32, u32)> = edges.filter(|(i, j)| stays(i) && stays(j)).collect();
    Alone::new(&nodes, &edges).graph
}
