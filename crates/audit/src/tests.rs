use super::*;
use crate::enclosure::{Enclosure, enclose, matrix};
use proptest::prelude::*;
use viewcert::Model;
use viewcert::at_cameras::{Centres, at_cameras};
use viewcert::linalg::integer::{Integer, Integers};
use viewcert::linalg::rational::{Rational, scaled};
use viewcert::watch::Watch;

fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
    Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
}

fn complete(nodes: u32) -> Graph {
    let pairs: Vec<_> = (0..nodes)
        .flat_map(|i| (i + 1..nodes).map(move |j| (i, j)))
        .collect();
    graph(nodes, &pairs)
}

#[test]
fn what_is_not_a_number_is_no_verdict() {
    let verdict = |x: f64| is_solvable(x, 0.25);
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(verdict(value), None);
    }
    assert_eq!(verdict(0.625), Some(true));
    assert_eq!(verdict(0.5), Some(false));
    assert_eq!(verdict(0.0), Some(false));
}

#[test]
fn draws_are_repeated() {
    let graph = graph(3, &[(0, 1), (1, 2)]);
    assert_eq!(uniform(&graph, 7, 0, 24), uniform(&graph, 7, 0, 24));
    assert_ne!(uniform(&graph, 7, 0, 24), uniform(&graph, 7, 1, 24));
    assert!(
        uniform(&graph, 7, 0, 24)
            .iter()
            .all(|x| (0.0..1.0).contains(x))
    );
}

/// K4 and the 4-cycle: the right verdicts, and the value that a dense decomposition finds.
#[test]
fn verdicts_and_values() {
    let square = graph(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]);
    for seed in 0..5 {
        for (graph, verdict) in [(&complete(4), Some(true)), (&square, Some(false))] {
            let found = smallest(graph, seed, 0).unwrap();
            assert_eq!(is_solvable(found, TOLERANCE), verdict);
            let values = all_values(&augmented(graph, seed, 0), 48);
            assert!((found - values[0]).abs() < 1e-6 * values[1], "{found}");
        }
    }
    let none = smallest(&graph(2, &[]), 3, 0);
    assert_eq!(none, Err(AuditError::NoPairs));
}

/// All singular values of a matrix, rising.
fn all_values(rows: &SparseRows<f64>, columns: usize) -> Vec<f64> {
    let mut dense = vec![vec![0.0; rows.len()]; columns];
    for (r, row) in rows.iter().enumerate() {
        row.iter().for_each(|&(column, x)| dense[column][r] = x);
    }
    linear::singular(dense.clone(), dense).unwrap().0
}

/// Two triangles at a node and a tail: three components.
#[test]
fn blocks_are_components() {
    let graph = graph(6, &[(0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4), (4, 5)]);
    let found = components(&graph, 3, TOLERANCE).unwrap();
    let [a, b, c, d, e, f, g] = found[..] else {
        panic!("seven edges")
    };
    assert!(a == b && b == c && d == e && e == f && a != d && g != a && g != d);
}

/// At small integer cameras J_P is the exact one, but for the norms.
#[test]
fn the_exact_jacobian() {
    let graph = complete(3);
    let entries: [[[i64; 4]; 3]; 3] = [
        [[1, 2, 0, 1], [0, 1, 3, 1], [2, 0, 1, 1]],
        [[1, 0, 2, 1], [3, 1, 0, 0], [0, 1, 1, 2]],
        [[2, 1, 1, 0], [1, 0, 0, 1], [0, 3, 1, 1]],
    ];
    let exact = entries.map(|camera| camera.map(|row| row.map(Integer::from)));
    let float = entries.map(|camera| camera.map(|row| row.map(|x| x as f64)));
    let value = |x: &Integer| x.to_string().parse::<f64>().unwrap();
    let norm = |entries: Vec<f64>| entries.iter().map(|x| x * x).sum::<f64>().sqrt();
    let found = plain(&graph, float.to_vec());
    let rows = jacobian::jacobian(&Integers, &graph, &exact);
    for (r, (row, found)) in rows.iter().zip(&found).enumerate() {
        let (i, j) = graph.edges()[r / 10];
        let ends = [i, j].map(|v| v as usize);
        let f = jacobian::fundamental(&Integers, &exact[ends[0]], &exact[ends[1]]);
        let of_f = norm(f.iter().flatten().map(value).collect());
        for ((column, x), (at, y)) in row.iter().zip(found) {
            // Columns of one camera are multiples of the other.
            let other = ends[usize::from(column / 12 == ends[0])];
            let of_camera = norm(float[other].iter().flatten().copied().collect());
            let expected = value(x) * NORM * NORM / of_f / of_camera;
            assert!(column == at && (y - expected).abs() < 1e-9, "{r} {column}");
        }
        assert_eq!(row.len(), found.len());
    }
}

fn value(x: &Rational) -> f64 {
    let [above, below] = [x.numer(), x.denom()].map(|x| x.to_string());
    above.parse::<f64>().unwrap() / below.parse::<f64>().unwrap()
}

fn narrow(found: &Enclosure) -> bool {
    value(&found.most) <= 1.000_000_1 * value(&found.least)
}

fn rationals<const K: usize>(entries: [i64; K]) -> [Rational; K] {
    entries.map(|x| Integer::from(x).into())
}

fn enclosed(graph: &Graph, centres: &Centres) -> Option<Enclosure> {
    let watch = &Watch::default();
    let here = at_cameras(graph, centres, watch).unwrap();
    enclose(graph, (centres, &here), None, watch).unwrap()
}

/// By hand: two cameras at distance 2 along the first axis. I - g g^T has rank 2, so the matrix has the singular values
/// 0, 0, 0, 0, sqrt 2, sqrt 2.
#[test]
fn a_pair_of_directions() {
    let points = [rationals([0, 0, 0]), rationals([2, 0, 0])];
    let centres = Centres::of_points(Model::Calibrated, &points).unwrap();
    let found = enclosed(&complete(2), &centres).unwrap();
    let (expected, least, most) = (2f64.sqrt(), value(&found.least), value(&found.most));
    assert!(least <= expected * (1.0 + 1e-15), "{found:?}");
    assert!(expected <= most * (1.0 + 1e-15), "{found:?}");
    assert!(narrow(&found), "{found:?}");
}

/// A matrix of whole cameras cannot be had from centres, and the affine model has none.
#[test]
fn centres_alone() {
    let points: Vec<_> = (0..4).map(|k| rationals([k, k * k, k * k * k])).collect();
    let centres = Centres::of_points(Model::Projective, &points).unwrap();
    assert_eq!(enclosed(&complete(4), &centres), None);
    assert_eq!(matrix(Model::Affine, 4), None);
}

/// Three on a line that is bent by 2^-14, 2^-24 and 2^-34: the value falls with the bend, far below where the squares of
/// doubles end, and is found all the same. By perturbation the ratios are 2^-10 up to terms of the size of the bend.
#[test]
fn where_doubles_are_blind() {
    let at = |bend: i64| {
        let mut points = [
            rationals([0, 0, 0]),
            rationals([1, 0, 0]),
            rationals([3, 0, 0]),
        ];
        points[1][1] = Rational::new(1.into(), (1i64 << bend).into());
        let centres = Centres::of_points(Model::Calibrated, &points).unwrap();
        enclosed(&complete(3), &centres).unwrap()
    };
    let values = [14, 24, 34].map(at);
    for pair in values.windows(2) {
        assert!(pair.iter().all(narrow), "{pair:?}");
        let ratio = value(&pair[1].least) / value(&pair[0].most);
        assert!((ratio * 1024.0 - 1.0).abs() < 1e-5, "{ratio}");
    }
}

/// Bounds are rounded outward: 1/2^60 less and more than 1/3 is not seen, and a double is between both.
#[test]
fn decimals() {
    let third = scaled(Integer::from((1i64 << 62) / 3), 2, -62);
    let found = |least: Rational, most: Rational| Enclosure { least, most }.decimals();
    let [least, most] = found(third.clone(), third).map(|x| x.parse::<f64>().unwrap());
    assert!(least < 1.0 / 3.0 && 1.0 / 3.0 < most && most - least < 1e-15);
    assert_eq!(Enclosure::zero().decimals(), ["0", "0"]);
    let tiny = scaled(1.into(), 2, -2000);
    let [least, most] = found(tiny.clone(), tiny).map(|x| x.parse::<f64>().unwrap());
    assert!(least == 0.0 && most > 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    /// The enclosure holds what a dense decomposition in doubles finds, up to its rounding.
    #[test]
    fn as_floating_point_finds(
        entries in proptest::collection::vec(proptest::array::uniform12(-20i64..21), 4),
        square in any::<bool>(),
    ) {
        let graph = if square { graph(4, &[(0, 1), (1, 2), (2, 3), (0, 2), (0, 3)]) } else { complete(4) };
        let exact: Vec<_> = entries.iter().map(|p| {
            let p = rationals(*p);
            std::array::from_fn(|r| std::array::from_fn(|c| p[4 * r + c].clone()))
        }).collect();
        let centres = Centres::of_cameras(Model::Projective, &exact);
        prop_assume!(centres.as_ref().is_ok_and(|centres| centres.check(&graph).is_ok()));
        let centres = centres.unwrap();
        let float = entries.iter().map(|p| {
            std::array::from_fn(|r| std::array::from_fn(|c| p[4 * r + c] as f64))
        });
        let rows = plain(&graph, float.collect());
        let (_, _, place) = matrix(Model::Projective, 4).unwrap();
        let expected = all_values(&rows, 48)[place - 1];
        let found = enclosed(&graph, &centres).unwrap();
        let slack = 1e-12 * NORM * NORM;
        prop_assert!(value(&found.least) - slack <= expected && expected <= value(&found.most) + slack,
            "{expected} {found:?}");
    }
}
