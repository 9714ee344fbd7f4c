use super::*;
use crate::samples::{options, verdict};
use viewcert::Model;

fn thinned_parts(graph: &Graph, cameras: Option<u32>, model: Model, seed: u64) -> Vec<Margin> {
    let parts = Parts::new(graph, &verdict(graph, model));
    let thinning = Thinning { draws: 20, seed };
    margin(graph, &parts, cameras, thinning, &options(model)).unwrap()
}

/// A complete graph of 40 images has pairs to spare; of a fan of triangles each pair of the rim is
/// needed.
#[test]
fn what_has_more_pairs_than_it_needs_stays_whole() {
    let complete = (0..40).flat_map(|i| (i + 1..40).map(move |j| (i, j)));
    let fan = (41..80).flat_map(|v| [(40, v), (v, v + 1)]);
    let graph = Graph::new(81, complete.chain(fan).chain([(40, 80)])).unwrap();
    let found = thinned_parts(&graph, None, Model::Projective, 1);
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].whole[..3], [20, 20, 20]);
    assert_eq!(found[0].whole[4], 0);
    assert_eq!(found[1].whole, [0; 5]);
    assert_eq!((found[0].images, found[1].images), (40, 41));
    // A whole draw has all images together; of the rest a pair at least is left.
    assert_eq!(found[0].together[..3], [800, 800, 800]);
    assert!(
        found
            .iter()
            .all(|part| part.together[4] < 800 && part.together[4] >= 20)
    );
    assert_eq!(found, thinned_parts(&graph, None, Model::Projective, 1));
}

/// Three cameras that all see 300 points need two of them; with 60 or 15 left they have them.
#[test]
fn points_go_with_their_observations() {
    let graph = Graph::new(303, (3..303).flat_map(|p| (0..3).map(move |c| (c, p)))).unwrap();
    let found = thinned_parts(&graph, Some(3), Model::Calibrated, 7);
    assert_eq!(found[0].whole, [20; 5]);
    // Four points: hardly ever are two left of them at 95 percent.
    let graph = Graph::new(7, (3..7).flat_map(|p| (0..3).map(move |c| (c, p)))).unwrap();
    let found = thinned_parts(&graph, Some(3), Model::Calibrated, 7);
    assert!(found[0].whole[0] > found[0].whole[4]);
}

#[test]
fn about_as_many_go_as_shall() {
    let graph = Graph::new(
        200,
        (0..200).flat_map(|i| (i + 1..200).map(move |j| (i, j))),
    )
    .unwrap();
    let left = thinned(&graph, None, 80, random(3, 80, 0)).edges().len();
    // 19900 pairs, a fifth is 3980, standard deviation 56.
    assert!((3700..4260).contains(&left), "{left}");
}

/// Two hundred triangles in a row, each with an image of the next: all are thinned, and none is
/// whole without one of its pairs.
#[test]
fn all_parts_are_thinned() {
    let rows = (0..200).flat_map(|k| {
        [
            (2 * k, 2 * k + 1),
            (2 * k, 2 * k + 2),
            (2 * k + 1, 2 * k + 2),
        ]
    });
    let graph = Graph::new(401, rows).unwrap();
    let found = thinned_parts(&graph, None, Model::Projective, 5);
    assert_eq!(found.len(), 200);
    let whole: u32 = found.iter().map(|part| part.whole[0]).sum();
    // A triangle keeps its three pairs with probability 0.729: 2916 of 4000, standard deviation 28.
    assert!((2750..3080).contains(&whole), "{whole}");
    assert!(
        found
            .iter()
            .all(|part| part.images == 3 && part.together[0] <= 60)
    );
}
