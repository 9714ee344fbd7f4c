use super::*;
use crate::samples::{clusters, graphs, options, together, tracks, verdict};

/// Each pair, and each image, left out of the whole graph in turn.
#[test]
fn weak_is_what_falls_apart_when_it_is_left_out() {
    let (mut weak, mut strong, mut counted) = (0, 0, 0);
    for model in Model::ALL {
        for graph in graphs(120).chain(clusters(30)).chain(tracks(60)) {
            let verdict = verdict(&graph, model);
            let parts = Parts::new(&graph, &verdict);
            let found = weak_pairs(&graph, &verdict, &parts, &options(model)).unwrap();
            counted += found
                .iter()
                .filter(|pair| matches!(pair.why, Why::Counted(_)))
                .count();
            let found: Vec<(Pair, usize)> = found
                .iter()
                .map(|weak| (weak.pair, weak.component))
                .collect();
            let images = weak_images(&graph, &parts, &options(model)).unwrap();
            let images: Vec<(u32, usize)> = images
                .iter()
                .map(|weak| (weak.image, weak.component))
                .collect();
            let mut expected = Vec::new();
            let mut expected_images = Vec::new();
            for (part, edges) in parts.parts.iter().zip(parts.edges(&graph)) {
                for pair in edges {
                    if together(&without(&graph, &[pair]), model, &part.nodes) {
                        strong += 1;
                    } else {
                        expected.push((pair, part.component));
                    }
                }
                for &v in &part.nodes {
                    let left = graph.edges().iter().filter(|(i, j)| *i != v && *j != v);
                    let left = Graph::new(graph.nodes() as u32, left.copied()).unwrap();
                    let rest: Vec<u32> = part.nodes.iter().copied().filter(|&u| u != v).collect();
                    if !together(&left, model, &rest) {
                        expected_images.push((v, part.component));
                    }
                }
            }
            weak += expected.len();
            assert_eq!(found, expected, "{model} {graph:?}");
            assert_eq!(images, expected_images, "{model} {graph:?}");
        }
    }
    assert!(
        weak > 100 && strong > 100 && counted > 10,
        "{weak} {strong} {counted}"
    );
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
    let found = weak_pairs(&graph, &verdict, &parts, &options(Model::Projective)).unwrap();
    let found: Vec<Pair> = found.iter().map(|weak| weak.pair).collect();
    assert_eq!(found, pairs);
    let images = weak_images(&graph, &parts, &options(Model::Projective)).unwrap();
    let images: Vec<u32> = images.iter().map(|weak| weak.image).collect();
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
    let found = weak_pairs(&graph, &verdict, &parts, &options(Model::Calibrated)).unwrap();
    let found: Vec<(Pair, Why)> = found.iter().map(|weak| (weak.pair, weak.why)).collect();
    let hangs = Why::Hangs(18);
    assert_eq!(found, [((0, 18), hangs), ((1, 18), hangs)]);
}
