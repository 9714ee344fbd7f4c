use super::*;
use crate::OtherPair;
use crate::samples::options;
use viewcert::Model;

/// A triangle of strong pairs, a second of weaker ones at its image 2, and pairs that were not
/// used.
#[test]
fn components_by_threshold() {
    let graph = Graph::new(6, [(0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4)]).unwrap();
    let other = |a, b, inliers| OtherPair {
        images: (a, b),
        inliers,
        matches: None,
        verified: true,
        used: false,
    };
    // The last has as many inliers as a pair that was used: something else is wrong with it.
    let others = [other(0, 3, 12), other(1, 5, 3), other(4, 5, 30)];
    let known = Known {
        inliers: &[100, 90, 80, 20, 25, 30],
        others: &others,
        near: None,
    };
    let options = options(Model::Projective);
    let rows = sweep(&graph, known, &[1, 10, 15, 28, 85], &options).unwrap();
    let seen = |row: &Row| {
        let shape = (row.parts, row.links, row.largest);
        (row.threshold, row.pairs, row.images, row.connected, shape)
    };
    let expected = [
        (1, 8, 6, 1, (1, 1, 5)),
        (10, 7, 5, 1, (1, 0, 5)),
        (15, 6, 5, 1, (2, 0, 3)),
        (28, 4, 5, 2, (1, 1, 3)),
        (85, 2, 3, 1, (0, 2, 2)),
    ];
    assert_eq!(rows.iter().map(seen).collect::<Vec<_>>(), expected);
    assert!(rows.iter().all(|row| row.value == Value::NotFiniteSolvable));
}
