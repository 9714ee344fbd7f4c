use super::*;
use crate::samples::{clusters, graphs, options, together, verdict};

/// Each pair, and each image, left out of the whole graph in turn.
#[test]
fn weak_is_what_falls_apart_when_it_is_left_out() {
    let (mut weak, mut strong, mut counted) = (0, 0, 0);
    for model in Model::ALL {
        for graph in graphs(120).chain(clusters(30)) {
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
