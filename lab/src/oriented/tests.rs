use super::*;
use viewcert::graph::graph6;
use viewcert::linalg::integer::{Signed, Zero};
use viewcert::solutions::count;

/// What is found for a graph, and the scenes of some draws.
fn scenes(name: &str, draws: u64) -> Vec<Scene> {
    let graph = graph6::decode(name.as_bytes()).unwrap();
    let solutions = count(&graph, 1).unwrap();
    let search = Search::new(&graph, &solutions, 1).unwrap();
    let places = search.places().unwrap();
    // All that is shown of a scene was verified; here the numbers are seen to be those of its roots.
    for place in &places.places {
        assert_eq!(place.real(), 1 + place.roots.len());
        assert!(place.oriented() <= place.real() && place.real() <= 1 + place.residues.len());
    }
    let mut numbers: Vec<_> = places
        .places
        .iter()
        .map(|s| [s.real(), s.oriented()])
        .collect();
    numbers.sort_unstable();
    assert_eq!(places.numbers(), numbers);
    (0..draws).filter_map(|draw| search.at_draw(draw)).collect()
}

/// Where there are two solutions the second one is rational, so it is real; whether it is oriented
/// depends on the cameras.
#[test]
fn two_solutions() {
    for name in ["HBQkcP_", "HBjCaOc", "H@ZccPO"] {
        let found = scenes(name, 12);
        assert!(found.iter().all(|scene| scene.real() == 2), "{name}");
        let oriented = found.iter().filter(|scene| scene.oriented() == 2).count();
        assert!(0 < oriented && oriented < found.len(), "{name}");
    }
}

/// Three solutions: the other two are real, or complex conjugates of each other.
#[test]
fn three_solutions() {
    let found = scenes("I@QKn@OI?", 24);
    assert!(found.iter().all(|scene| scene.eliminant.len() == 3));
    let of = |real| found.iter().filter(|scene| scene.real() == real).count();
    assert_eq!(of(1) + of(3), found.len());
    for scene in &found {
        let [c, b, a] = &scene.eliminant[..] else {
            panic!("a quadratic polynomial")
        };
        let four = Integer::from(4i64);
        let discriminant = b * b - four * a * c;
        assert_eq!(discriminant.is_positive(), scene.real() == 3);
    }
}

/// A triangle in the place of an edge is a member with three nodes, one of which no other member has.
#[test]
fn members_with_more_nodes() {
    let core = graph6::decode(b"HBQkcP_").unwrap();
    let (i, j) = core.edges()[0];
    let edges = core.edges().iter().copied().chain([(i, 9), (j, 9)]);
    let graph = Graph::from_edges(edges).unwrap();
    let solutions = count(&graph, 1).unwrap();
    let search = Search::new(&graph, &solutions, 1).unwrap();
    assert_eq!(
        search
            .members
            .iter()
            .filter(|member| member.len() == 3)
            .count(),
        1
    );
    let scene = (0..8).find_map(|draw| search.at_draw(draw)).unwrap();
    assert_eq!((scene.cameras.len(), scene.real()), (10, 2));
}

/// The cameras near a root have the fundamental matrices of the given ones, nearly: exactly where the
/// second solution is rational.
#[test]
fn cameras_near_a_root() {
    let graph = graph6::decode(b"HBQkcP_").unwrap();
    let solutions = count(&graph, 1).unwrap();
    let search = Search::new(&graph, &solutions, 1).unwrap();
    let is_oriented = |scene: &Scene| scene.oriented() == 2;
    let mut found = (0..64).filter_map(|draw| search.at_draw(draw));
    let scene = found.find(is_oriented).unwrap();
    let cameras = scene.near(&search.members, 0).unwrap();
    for &(i, j) in graph.edges() {
        let d = [0, 1, 2]
            .map(|k| Integer::from(scene.centres[i as usize][k] - scene.centres[j as usize][k]));
        let [a, b] = [i, j].map(|v| {
            across(
                &viewcert::linalg::integer::Integers,
                &d,
                &cameras[v as usize],
            )
        });
        for (k, l) in (0..12).flat_map(|k| (0..k).map(move |l| (k, l))) {
            assert_eq!(&a[k] * &b[l], &a[l] * &b[k]);
        }
        // Signs fit: factors are positive.
        let sum = a
            .iter()
            .zip(&b)
            .fold(Integer::zero(), |sum, (x, y)| sum + x * y);
        assert!(sum.is_positive());
    }
}

/// No points of a tight core, one solution, or known ones only in factors.
#[test]
fn nothing_to_look_for() {
    let graph = graph6::decode(b"G@TclO").unwrap();
    let solutions = count(&graph, 1).unwrap();
    assert!(Search::new(&graph, &solutions, 1).is_none());
}
