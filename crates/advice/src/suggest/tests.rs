use super::*;
use crate::samples::{clusters, found, graphs, options, verdict};
use viewcert::Model;

fn suggested(
    graph: &Graph,
    model: Model,
    others: &[OtherPair],
    at: Option<u32>,
) -> Vec<Suggestion> {
    let (_, parts, joints) = found(graph, model);
    let known = Known {
        inliers: &[],
        others,
        near: None,
    };
    let wanted = Wanted { most: 1000, at };
    suggest(
        graph,
        &parts,
        &joints.joints,
        known,
        wanted,
        &options(model),
    )
    .unwrap()
}

/// The whole graph with the pairs is decided for each suggestion; a set of several is one of which
/// none can be left out.
#[test]
fn suggestions_are_true() {
    let (mut single, mut several) = (0, 0);
    for model in Model::ALL {
        for graph in graphs(40).chain(clusters(40)) {
            for found in suggested(&graph, model, &[], None) {
                let pairs: Vec<Pair> = found.pairs.iter().map(|&(pair, _)| pair).collect();
                assert_eq!(
                    images_with(&graph, model, &pairs),
                    found.images,
                    "{found:?}"
                );
                assert!(found.gain > 0);
                match pairs[..] {
                    [_] => single += 1,
                    _ => several += 1,
                }
                for k in 0..pairs.len() {
                    let mut fewer = pairs.clone();
                    let gone = fewer.remove(k);
                    let images = images_at(&with(&graph, fewer), model, gone);
                    assert!(images < found.images, "{found:?}");
                }
            }
        }
    }
    assert!(single > 100 && several > 10, "{single} {several}");
}

/// The size of the component that all the pairs are in, if they are added.
fn images_with(graph: &Graph, model: Model, pairs: &[Pair]) -> usize {
    let graph = with(graph, pairs.iter().copied());
    let sizes: BTreeSet<usize> = pairs
        .iter()
        .map(|&pair| images_at(&graph, model, pair))
        .collect();
    assert_eq!(sizes.len(), 1);
    sizes.into_iter().next().unwrap()
}

/// The size of the component that holds both images; 0 if none does.
fn images_at(graph: &Graph, model: Model, (a, b): Pair) -> usize {
    let verdict = verdict(graph, model);
    let mut nodes = verdict.components.iter().map(|part| part.nodes());
    nodes
        .find(|nodes| nodes.contains(&a) && nodes.contains(&b))
        .map_or(0, |nodes| nodes.len())
}

/// Two complete graphs on 0..6 and 6..12, and more pairs.
fn two(more: &[Pair]) -> Graph {
    let complete =
        |first: u32| (first..first + 6).flat_map(move |i| (i + 1..first + 6).map(move |j| (i, j)));
    Graph::new(
        13,
        complete(0).chain(complete(6)).chain(more.iter().copied()),
    )
    .unwrap()
}

/// By hand: apart, 15 (4) degrees of freedom need 3 (2) pairs of 7 (2); one pair leaves 8 (2), that
/// is 2 (1) pairs; two leave 1 in the projective model.
#[test]
fn as_many_pairs_as_it_takes() {
    let cases: [(&[Pair], [usize; 3]); 3] = [
        (&[], [3, 2, 3]),
        (&[(0, 6)], [2, 1, 2]),
        (&[(0, 6), (1, 7)], [1, 0, 1]),
    ];
    for (more, counts) in cases {
        for (model, count) in Model::ALL.into_iter().zip(counts) {
            let found = suggested(&two(more), model, &[], None);
            let best = found.first().map_or(0, |best| best.pairs.len());
            assert_eq!(best, count, "{model} {more:?} {found:?}");
        }
    }
}

#[test]
fn pairs_with_matches_come_first() {
    let other = |a, b, inliers| OtherPair {
        images: (a, b),
        inliers,
        matches: Some(inliers + 5),
        verified: true,
        used: false,
    };
    // 12 is seen from 0 alone.
    let graph = two(&[(0, 6), (1, 7), (0, 12)]);
    let others = [other(3, 12, 4), other(4, 11, 9), other(5, 10, 12)];
    let found = suggested(&graph, Model::Projective, &others, None);
    let pairs: Vec<Pair> = found.iter().map(|found| found.pairs[0].0).collect();
    assert_eq!(pairs[..3], [(5, 10), (4, 11), (3, 12)]);
    assert_eq!(found[0].pairs[0].1, Some(others[2]));
    assert_eq!((found[0].images, found[0].gain), (12, 6));
    assert_eq!((found[2].images, found[2].gain), (7, 1));
    let at = suggested(&graph, Model::Projective, &others, Some(12));
    assert!(!at.is_empty());
    let touches = |found: &Suggestion| found.pairs.iter().any(|&((a, b), _)| a == 12 || b == 12);
    assert!(at.iter().all(touches));
}

/// An image without a pair needs two known ones with the same part.
#[test]
fn an_image_without_pairs_needs_two() {
    let other = |a, b, inliers| OtherPair {
        images: (a, b),
        inliers,
        matches: None,
        verified: true,
        used: false,
    };
    let others = [other(2, 12, 7), other(3, 12, 8)];
    let found = suggested(
        &two(&[(0, 6), (1, 7), (2, 8)]),
        Model::Projective,
        &others,
        None,
    );
    let pairs: Vec<_> = found[0].pairs.iter().map(|&(pair, _)| pair).collect();
    assert_eq!(pairs, [(2, 12), (3, 12)]);
    assert_eq!(
        (found[0].images, found[0].gain, found[0].evidence()),
        (13, 1, (7, 0))
    );
}
