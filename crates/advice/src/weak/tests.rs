use super::*;
use crate::condensation::without;
use crate::tests::{clusters, graphs, grids, options, sequences, together, tracks, verdict};
use std::collections::BTreeSet;
use viewcert::Model;

fn pair(weak: &Weakness) -> Pair {
    (weak.nodes[0], weak.nodes[1])
}

/// Pairs and images, each with its component.
type Places = (Vec<(Pair, usize)>, Vec<(u32, usize)>);

/// The weak pairs and images, and what pairs and images are weak by leaving out each in turn, each
/// with its component.
fn found_and_expected(graph: &Graph, model: Model) -> [Places; 2] {
    let verdict = verdict(graph, model);
    let parts = Parts::new(graph, &verdict);
    let pairs = weak_pairs(graph, &parts, &options(model)).unwrap();
    let images = weak_images(graph, &parts, &options(model)).unwrap();
    let found = (
        pairs.iter().map(|weak| (pair(weak), weak.component)),
        images.iter().map(|weak| (weak.nodes[0], weak.component)),
    );
    let mut expected = (Vec::new(), Vec::new());
    for (part, edges) in parts.parts.iter().zip(parts.edges(graph)) {
        for pair in edges {
            if !together(&without(graph, &[pair]), model, &part.nodes) {
                expected.0.push((pair, part.component));
            }
        }
        for &v in &part.nodes {
            let left = graph.edges().iter().filter(|(i, j)| *i != v && *j != v);
            let left = Graph::new(graph.nodes() as u32, left.copied()).unwrap();
            let rest: Vec<u32> = part.nodes.iter().copied().filter(|&u| u != v).collect();
            if !together(&left, model, &rest) {
                expected.1.push((v, part.component));
            }
        }
    }
    [(found.0.collect(), found.1.collect()), expected]
}

/// Each pair, and each image, left out of the whole graph in turn.
#[test]
fn weak_is_what_falls_apart_when_it_is_left_out() {
    let (mut weak, mut all) = (0, 0);
    for model in Model::ALL {
        for graph in graphs(120).chain(clusters(30)).chain(tracks(60)) {
            let [found, expected] = found_and_expected(&graph, model);
            assert_eq!(found, expected, "{model} {graph:?}");
            weak += expected.0.len();
            all += graph.edges().len();
        }
    }
    assert!(weak > 100 && all > weak + 100, "{weak} of {all}");
}

/// Sequences with missing pairs and loop closures: bodies that hang on few pairs, one after another.
#[test]
fn a_sequence_hangs_on_what_it_falls_apart_without() {
    let (mut weak, mut images, mut all) = (0, 0, 0);
    for model in Model::ALL {
        for graph in sequences(12, 100)
            .chain(sequences(40, 30))
            .chain(grids(9, 6))
        {
            let [found, expected] = found_and_expected(&graph, model);
            assert_eq!(found, expected, "{model} {graph:?}");
            weak += expected.0.len();
            images += expected.1.len();
            all += graph.edges().len();
        }
    }
    assert!(
        weak > 1000 && images > 300 && all > 3 * weak,
        "{weak} {images} {all}"
    );
}

/// A core with 9 nodes and 12 pairs, 7 * 12 = 11 * 9 - 15: none can be missing, and all are alike in
/// that count. Six hang at the nodes 2, 6 and 8; of the others one is decided.
#[test]
fn one_count_tells_of_many_pairs() {
    let pairs = [
        (0, 1),
        (0, 7),
        (0, 8),
        (1, 2),
        (1, 5),
        (2, 3),
        (3, 4),
        (3, 8),
        (4, 5),
        (4, 7),
        (5, 6),
        (6, 7),
    ];
    let graph = Graph::new(9, pairs).unwrap();
    let verdict = verdict(&graph, Model::Projective);
    let parts = Parts::new(&graph, &verdict);
    let found = weak_pairs(&graph, &parts, &options(Model::Projective)).unwrap();
    assert_eq!(found.len(), 12);
    let counted = found.iter();
    let counted = counted.filter(|weak| matches!(weak.why, Why::Counted(_)));
    let decided = found.iter().filter(|weak| weak.why == Why::Decided);
    assert_eq!((counted.count(), decided.count()), (5, 1));
}

/// 4,000 cameras, each paired with the next two: every pair is weak, each inner one by a count on a
/// graph of some nodes.
#[test]
fn all_pairs_of_a_thin_sequence_are_weak() {
    let n = 4000;
    let pairs = (0..n).flat_map(|i| (i + 1..n.min(i + 3)).map(move |j| (i, j)));
    let graph = Graph::new(n, pairs).unwrap();
    let verdict = verdict(&graph, Model::Projective);
    let parts = Parts::new(&graph, &verdict);
    let found = weak_pairs(&graph, &parts, &options(Model::Projective)).unwrap();
    assert_eq!(found.len(), graph.edges().len());
    assert!(found.iter().all(|weak| weak.strength == Strength::Proof));
    let images = weak_images(&graph, &parts, &options(Model::Projective)).unwrap();
    // Without the first or the last image the rest is a sequence.
    let images: BTreeSet<u32> = images.iter().map(|weak| weak.nodes[0]).collect();
    assert_eq!(images, (1..n - 1).collect());
}

/// Two complete graphs joined by three disjoint pairs (projective): each of these is needed, as
/// two leave one degree of freedom, and no other is.
#[test]
fn the_pairs_of_a_tight_joint_are_weak() {
    let complete =
        |first: u32| (first..first + 6).flat_map(move |i| (i + 1..first + 6).map(move |j| (i, j)));
    let pairs = [(0, 6), (1, 7), (2, 8)];
    let graph = Graph::new(12, complete(0).chain(complete(6)).chain(pairs)).unwrap();
    let verdict = verdict(&graph, Model::Projective);
    assert_eq!(verdict.components.len(), 1);
    let parts = Parts::new(&graph, &verdict);
    let found = weak_pairs(&graph, &parts, &options(Model::Projective)).unwrap();
    let found: Vec<Pair> = found.iter().map(pair).collect();
    assert_eq!(found, pairs);
    let images = weak_images(&graph, &parts, &options(Model::Projective)).unwrap();
    let images: Vec<u32> = images.iter().map(|weak| weak.nodes[0]).collect();
    assert_eq!(images, [0, 1, 2, 6, 7, 8]);
}

/// Six cameras and twelve points, each seen by four of them: any half of the points makes the
/// cameras one body. The thirteenth is seen by two.
#[test]
fn where_tracks_abound_all_observations_are_cleared_by_leaving_out_points() {
    let views = (6..18u32).flat_map(|p| (0..4).map(move |k| ((p + k) % 6, p)));
    let graph = Graph::new(19, views.clone().chain([(0, 18), (1, 18)])).unwrap();
    let all = graph.edges().to_vec();
    let left = left_out::not_cleared(&graph, all, &options(Model::Calibrated)).unwrap();
    assert_eq!(left, [(0, 18), (1, 18)]);
    let verdict = verdict(&graph, Model::Calibrated);
    let parts = Parts::new(&graph, &verdict);
    let found = weak_pairs(&graph, &parts, &options(Model::Calibrated)).unwrap();
    let found: Vec<(Pair, Why)> = found.iter().map(|weak| (pair(weak), weak.why)).collect();
    let hangs = Why::Hangs(18);
    assert_eq!(found, [((0, 18), hangs), ((1, 18), hangs)]);
}

/// Images that contraction clears are none that decisions name, which look at all images on their own: on grids,
/// sequences and clusters.
#[test]
fn cleared_images_are_those_that_decisions_clear() {
    let (mut weak, mut cleared) = (0, 0);
    for model in Model::ALL {
        let small = grids(20, 5).chain(sequences(20, 60)).chain(clusters(60));
        for graph in small.chain(grids(4, 20)) {
            let verdict = verdict(&graph, model);
            let parts = Parts::new(&graph, &verdict);
            for (part, edges) in parts.parts.iter().zip(parts.edges(&graph)) {
                let alone = Alone::new(&part.nodes, &edges).graph;
                let neighbours = Adjacency::new(&alone);
                let (n, options) = (alone.nodes() as u32, options(model));
                let hangs = |v| {
                    neighbours
                        .neighbours(v)
                        .iter()
                        .any(|&u| neighbours.degree(u) == 2)
                };
                let open: Vec<u32> = (0..n).filter(|&v| n > 3 && !hangs(v)).collect();
                let sets = independent(&alone, open.clone()).into_iter();
                let decided =
                    sets.map(|set| decisions::weak_images(&alone, set, &options).unwrap());
                let mut decided = decided.collect::<Vec<_>>().concat();
                decided.sort_unstable_by_key(|&(v, _)| v);
                let found = images_of(&alone, &options).unwrap().into_iter();
                let found = found.filter(|(_, why, _)| *why == Why::Decided);
                let found: Vec<_> = found.map(|(v, _, strength)| (v, strength)).collect();
                assert_eq!(found, decided, "{model} {alone:?}");
                let left = left_out::images_not_cleared(&alone, open.clone(), &options).unwrap();
                weak += decided.len();
                cleared += open.len() - left.len();
            }
        }
    }
    assert!(weak > 1000 && cleared > 5 * weak, "{weak} {cleared}");
}
