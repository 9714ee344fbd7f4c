use super::*;
use crate::cameras::{NORM, normalise};
use crate::dense::singular;
use crate::jacobian::{Blocks, Jacobian};
use proptest::prelude::*;
use viewcert::Model;
use viewcert::geometry::jacobian::reference;

fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
    Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
}

fn complete(nodes: u32) -> Graph {
    let pairs: Vec<_> = (0..nodes)
        .flat_map(|i| (i + 1..nodes).map(move |j| (i, j)))
        .collect();
    graph(nodes, &pairs)
}

fn value(x: &Rational) -> f64 {
    decimal(x, 17, false).parse().unwrap()
}

fn narrow(found: &Enclosure) -> bool {
    value(&found.most) <= 1.000_000_1 * value(&found.least)
}

fn rationals<const K: usize>(entries: [i64; K]) -> [Rational; K] {
    entries.map(|x| Integer::from(x).into())
}

fn found(matrix: Matrix, graph: &Graph, centres: &Centres) -> Enclosure {
    let found = enclose(matrix, graph, centres, None, narrow, &Watch::default());
    found.unwrap().unwrap()
}

/// By hand: two cameras at distance 2 along the first axis. I - g g^T has rank 2, so the matrix has the singular values 0, 0, 0, 0,
/// sqrt 2, sqrt 2; divided by the length, half of that.
#[test]
fn a_pair_of_directions() {
    let points = [rationals([0, 0, 0]), rationals([2, 0, 0])];
    let centres = Centres::of_points(Model::Calibrated, &points).unwrap();
    for (matrix, expected) in [
        (Matrix::Bearing, 2f64.sqrt()),
        (Matrix::BearingByLength, 0.5f64.sqrt()),
    ] {
        let found = found(matrix, &complete(2), &centres);
        assert!(
            value(&found.least) <= expected && expected <= value(&found.most) * (1.0 + 1e-15),
            "{found:?}"
        );
        assert!(narrow(&found), "{found:?}");
    }
    let norm = None;
    let nothing = enclose(
        Matrix::Plain,
        &complete(2),
        &centres,
        norm,
        narrow,
        &Watch::default(),
    );
    assert_eq!(nothing.unwrap(), None);
}

/// Three on a line that is bent by 2^-14, 2^-24 and 2^-34: the value falls with the bend, far below where the squares of
/// doubles end, and is found all the same. By perturbation the ratios are 2^-10 up to terms of the size of the bend.
#[test]
fn where_doubles_are_blind() {
    let at = |bend: i64| {
        let d = Integer::from(1i64 << bend);
        let mut points = [
            rationals([0, 0, 0]),
            rationals([1, 0, 0]),
            rationals([3, 0, 0]),
        ];
        points[1][1] = Rational::new(Integer::one(), d).unwrap();
        let centres = Centres::of_points(Model::Calibrated, &points).unwrap();
        found(Matrix::Bearing, &complete(3), &centres)
    };
    let values = [14, 24, 34].map(at);
    for pair in values.windows(2) {
        assert!(pair.iter().all(narrow), "{pair:?}");
        let ratio = value(&pair[1].least) / value(&pair[0].most);
        assert!((ratio * 1024.0 - 1.0).abs() < 1e-5, "{ratio}");
    }
}

#[test]
fn decimals() {
    let third = Rational::new(Integer::one(), Integer::from(3u64)).unwrap();
    assert_eq!(decimal(&third, 4, false), "3.333e-1");
    assert_eq!(decimal(&third, 4, true), "3.334e-1");
    let almost = Rational::new(Integer::from(99_996u64), Integer::from(10u64)).unwrap();
    assert_eq!(decimal(&almost, 4, true), "1.000e4");
    assert_eq!(decimal(&almost, 4, false), "9.999e3");
    assert_eq!(decimal(&Integer::zero().into(), 4, true), "0");
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
        let floats: Vec<_> = entries.iter().map(|p| {
            let mut camera = std::array::from_fn(|r| std::array::from_fn(|c| p[4 * r + c] as f64));
            normalise(&mut camera);
            camera
        }).collect();
        let blocks = Blocks::new(&graph, &floats);
        let dense = Jacobian::new(&blocks, reference(&graph)).dense();
        let rows = 10 * graph.edges().len();
        let plain = dense.iter().map(|column| column[..rows].to_vec()).collect();
        for (matrix, dense) in [(Matrix::Augmented, dense), (Matrix::Plain, plain)] {
            let (values, _) = singular(dense, false).unwrap();
            let expected = values[48 - matrix.place(4)];
            let found = found(matrix, &graph, &centres);
            let slack = 1e-12 * NORM * NORM;
            prop_assert!(value(&found.least) - slack <= expected && expected <= value(&found.most) + slack,
                "{:?} {expected} {found:?}", matrix);
        }
    }
}
