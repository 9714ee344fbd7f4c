use super::*;
use crate::condensation::with;
use crate::tests::{clusters, found, graphs, options, verdict};
use std::collections::BTreeSet;
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
/// none but the first can be left out.
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
                // The first of a set is named because it is the most promising.
                for k in usize::from(pairs.len() > 1)..pairs.len() {
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
            // Image 12 has no pair at all.
            let of_both: Vec<_> = found.iter().filter(|found| found.gain == 6).collect();
            let fewest = of_both.iter().map(|one| one.pairs.len()).min();
            assert_eq!(fewest.unwrap_or(0), count, "{model} {more:?} {found:?}");
            // More pairs come first only if they are as promising.
            let cost = |one: &Suggestion| one.candidates.iter().map(|one| one.cost).max();
            if let Some((best, others)) = of_both.split_first() {
                let mut fewer = others
                    .iter()
                    .filter(|one| one.pairs.len() < best.pairs.len());
                assert!(fewer.all(|one| cost(best) <= cost(one)), "{found:?}");
            }
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
    let others = [other(3, 12, 4), other(4, 11, 9), other(5, 10, 19)];
    let found = suggested(&graph, Model::Projective, &others, None);
    let pairs: Vec<Pair> = found.iter().map(|found| found.pairs[0].0).collect();
    // Enough inliers first, then what nobody tried, and last what gave too little.
    assert_eq!(pairs[0], (5, 10));
    let tried: Vec<Tried> = found
        .iter()
        .map(|found| found.candidates[0].tried)
        .collect();
    assert!(tried.is_sorted(), "{tried:?}");
    assert_eq!((tried[0], tried[1]), (Tried::LeftOut, Tried::Not));
    assert_eq!(found[0].pairs[0].1, Some(others[2]));
    assert_eq!((found[0].images, found[0].gain), (12, 6));
    assert!(
        found
            .iter()
            .any(|found| (found.images, found.gain) == (7, 1))
    );
    // Several, of different images of both sides.
    let both = |found: &&Suggestion| found.gain == 6 && found.candidates[0].tried == Tried::Not;
    let [one, other] = [0, 1].map(|k| found.iter().filter(both).nth(k).unwrap().pairs[0].0);
    assert!(one.0 != other.0 && one.1 != other.1, "{one:?} {other:?}");
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
    let others = [other(2, 12, 17), other(3, 12, 18)];
    let found = suggested(
        &two(&[(0, 6), (1, 7), (2, 8)]),
        Model::Projective,
        &others,
        None,
    );
    let pairs: Vec<_> = found[0].pairs.iter().map(|&(pair, _)| pair).collect();
    assert_eq!(pairs, [(2, 12), (3, 12)]);
    assert_eq!((found[0].images, found[0].gain), (13, 1));
    assert!(
        found[0]
            .candidates
            .iter()
            .all(|one| one.tried == Tried::LeftOut)
    );
}

#[test]
fn what_has_become_of_a_pair() {
    let of = |inliers, matches, verified, used| {
        Tried::of(Some(&OtherPair {
            images: (0, 1),
            inliers,
            matches,
            verified,
            used,
        }))
    };
    assert_eq!(Tried::of(None), Tried::Not);
    assert_eq!(of(40, Some(90), true, true), Tried::Used);
    assert_eq!(of(15, None, true, false), Tried::LeftOut);
    assert_eq!(of(0, Some(15), false, false), Tried::Unverified);
    assert_eq!(of(0, Some(14), false, false), Tried::Few);
    assert_eq!(of(14, None, true, false), Tried::Few);
    // Matches that the verification threw away, no matches, and an empty row.
    assert_eq!(of(0, Some(200), true, false), Tried::InVain);
    assert_eq!(of(0, Some(0), false, false), Tried::InVain);
    assert_eq!(of(0, None, true, false), Tried::InVain);
}

/// Where one side is tried in vain again and again, other images come first; names say who is near.
#[test]
fn near_ones_come_first_and_failures_cost() {
    let near = Nearness::new(
        &[
            "0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "10", "11", "12",
        ],
        &[],
    );
    let graph = two(&[(0, 6), (1, 7)]);
    let first = |others: &[OtherPair]| {
        let (_, parts, joints) = found(&graph, Model::Projective);
        let known = Known {
            inliers: &[],
            others,
            near: Some(&near),
        };
        let wanted = Wanted { most: 10, at: None };
        let options = options(Model::Projective);
        let found = suggest(&graph, &parts, &joints.joints, known, wanted, &options).unwrap();
        found[0].candidates[0]
    };
    let vain = |(a, b)| OtherPair {
        images: (a, b),
        inliers: 0,
        matches: Some(0),
        verified: true,
        used: false,
    };
    // One step by name, or with a third image that both match.
    let mut failed: Vec<OtherPair> = Vec::new();
    let mut sides = [BTreeSet::new(), BTreeSet::new()];
    for count in 0..6 {
        let best = first(&failed);
        assert_eq!(best.tried, Tried::Not);
        assert!(count > 0 || best.cost == 2, "{best:?}");
        assert!(
            failed.iter().all(|pair| pair.images != best.pair),
            "{best:?}"
        );
        sides[0].insert(best.pair.0);
        sides[1].insert(best.pair.1);
        failed.push(vain(best.pair));
    }
    // Each failure counts against both of its images, so that others come.
    assert!(sides.iter().all(|side| side.len() >= 4), "{sides:?}");
}
