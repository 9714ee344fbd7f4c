//! Against ranks by textbook elimination of the whole matrices at random cameras, which share
//! nothing with contraction, cores, stresses and pebble games.

use super::*;
use crate::decide::options::Options;
use crate::decide::question::Question;
use crate::decide::{GAMMA, Strength, decide};
use crate::geometry::camera::normal_form;
use crate::geometry::draw::DrawKey;
use crate::geometry::jacobian::{dense, jacobian};
use crate::geometry::model::Model;
use crate::geometry::plane_direction::direction_rows;
use crate::geometry::plane_flow::rigidity_rows;
use crate::graph::{Graph, graph6};
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::linalg::textbook;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;

type Pairs = Vec<(u32, u32)>;

/// The rank of all rows of some pairs in a model's own matrix.
fn rank(nodes: u32, pairs: &[(u32, u32)], model: Model) -> usize {
    let field = PrimeField::mersenne61();
    let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
    let key = DrawKey {
        graph_sha256: [5; 32],
        core_sha256: None,
        seed: 3,
        draw: 0,
    };
    let mut random = key.residues(&field);
    let n = nodes as usize;
    let centres: Vec<[u64; 3]> = (0..n).map(|_| [random(), random(), random()]).collect();
    let of_rows = |rows: Vec<Vec<(usize, u64)>>, columns: usize| {
        let mut matrix = Matrix::new(rows.len(), columns, vec![0; rows.len() * columns]);
        for (r, row) in rows.iter().enumerate() {
            for &(c, value) in row {
                matrix[(r, c)] = value;
            }
        }
        textbook::eliminate(&field, &matrix).rank()
    };
    match model {
        Model::Projective => {
            let cameras: Vec<_> = centres.iter().map(|c| normal_form(&field, c)).collect();
            let rows = jacobian(&field, &graph, &cameras);
            textbook::eliminate(&field, &dense(&field, &rows, 12 * n)).rank()
        }
        Model::Calibrated => of_rows(rigidity_rows(&field, &graph, &centres), 3 * n),
        Model::Affine => {
            let points: Vec<[u64; 2]> = centres.iter().map(|c| [c[0], c[1]]).collect();
            4 * of_rows(direction_rows(&field, &graph, &points), 2 * n)
        }
    }
}

fn random_graph(seed: u64, most: usize) -> (u32, Pairs) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    loop {
        let nodes = random.random_range(4..8);
        let percent = random.random_range(30..90);
        let all = (0..nodes).flat_map(|i| (i + 1..nodes).map(move |j| (i, j)));
        let pairs: Pairs = all
            .filter(|_| random.random_range(0..100) < percent)
            .collect();
        if (3..=most).contains(&pairs.len()) {
            return (nodes, pairs);
        }
    }
}

fn options(model: Model) -> Options {
    Options::default().question(Question::without_solutions(model))
}

/// The finest partition whose ranks add up: two pairs are together unless a set that adds up with
/// the rest holds one of them alone.
fn expected_groups(nodes: u32, pairs: &[(u32, u32)], model: Model) -> Vec<u32> {
    let m = pairs.len();
    let rank_of = |set: u32| {
        let inside = (0..m).filter(|k| set >> k & 1 == 1);
        rank(nodes, &inside.map(|k| pairs[k]).collect::<Pairs>(), model)
    };
    let ranks: Vec<usize> = (0..1u32 << m).map(rank_of).collect();
    let all = (1usize << m) - 1;
    let adds_up: Vec<usize> = (0..=all)
        .filter(|set| ranks[*set] + ranks[all ^ set] == ranks[all])
        .collect();
    let mut first: Vec<usize> = Vec::new();
    (0..m)
        .map(|k| {
            let with = |j: usize| adds_up.iter().all(|set| set >> k & 1 == set >> j & 1);
            let known = first.iter().position(|&j| with(j));
            let number = known.unwrap_or(first.len());
            if known.is_none() {
                first.push(k);
            }
            number as u32
        })
        .collect()
}

#[test]
fn groups_are_what_ranks_say() {
    for model in Model::ALL {
        let mut sizes = BTreeSet::new();
        for seed in 0..60 {
            let (nodes, pairs) = random_graph(seed, 9);
            let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
            let verdict = decide(&graph, &options(model)).unwrap();
            let found = groups(&graph, &verdict, &options(model)).unwrap().unwrap();
            let expected = expected_groups(nodes, &pairs, model);
            assert_eq!(found.of_pairs, expected, "{model} {pairs:?}");
            assert_eq!(found.count, 1 + *expected.iter().max().unwrap() as usize);
            sizes.insert(found.count);
        }
        assert!(sizes.len() > 4, "{model} {sizes:?}");
    }
}

#[test]
fn implied_pairs_are_those_that_leave_the_rank() {
    for model in Model::ALL {
        let mut implied = 0;
        for seed in 0..100 {
            let (nodes, pairs) = random_graph(1000 + seed, 15);
            implied += check_closure(nodes, &pairs, model);
        }
        assert!(implied > 30, "{model} {implied}");
    }
}

/// How many pairs are implied that no component holds.
fn check_closure(nodes: u32, pairs: &[(u32, u32)], model: Model) -> u64 {
    let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
    let verdict = decide(&graph, &options(model)).unwrap();
    let found = closure(&graph, &verdict, &options(model)).unwrap();
    let all = (0..nodes).flat_map(|i| (i + 1..nodes).map(move |j| (i, j)));
    let own = rank(nodes, pairs, model);
    let expected: BTreeSet<(u32, u32)> = all
        .filter(|pair| graph.edge_number(pair.0, pair.1).is_none())
        .filter(|&pair| {
            let more: Pairs = pairs.iter().copied().chain([pair]).collect();
            rank(nodes, &more, model) == own
        })
        .collect();
    let listed: Vec<(u32, u32)> = found.implied(&graph).collect();
    assert_eq!(listed.len() as u64, found.count(&graph));
    assert_eq!(
        listed.into_iter().collect::<BTreeSet<_>>(),
        expected,
        "{model} {pairs:?}"
    );
    expected.len() as u64
}

/// Psi of Example 6.2: 02 is implied, and with it the other diagonal of the 4-cycle, although every
/// component is a single pair.
#[test]
fn psi_implies_pairs_that_no_component_holds() {
    let gamma = GAMMA.into_iter().filter(|&pair| pair != (0, 2));
    let cycle = [(0, 9), (2, 9), (0, 10), (2, 10)];
    let pairs: Pairs = gamma.chain(cycle).collect();
    assert_eq!(check_closure(11, &pairs, Model::Projective), 2);
    let graph = Graph::new(11, pairs.iter().copied()).unwrap();
    let verdict = decide(&graph, &options(Model::Projective)).unwrap();
    let found = closure(&graph, &verdict, &options(Model::Projective)).unwrap();
    assert_eq!(found.sets, [vec![0, 2, 9, 10]]);
    assert_eq!(
        (found.pairs.len(), found.implied, found.complete),
        (0, Strength::Proof, Strength::Proof)
    );
    // No row depends on others: nothing checks anything.
    let found = groups(&graph, &verdict, &options(Model::Projective))
        .unwrap()
        .unwrap();
    assert_eq!((found.count, found.strength), (15, Strength::Proof));
    assert_eq!(rank(11, &pairs, Model::Projective), 7 * 15);
}

/// Three triangles that pairwise share a node, and four around a cycle: in space the first are one
/// group and the second four; in the plane nothing depends on anything. With K_4 for the triangles three
/// around a cycle are three groups in the plane.
#[test]
fn groups_of_hinged_parts() {
    let hinged = |parts: u32, clique: u32| -> Pairs {
        let at = |part: u32, k: u32| match k {
            0 => part,
            1 => (part + 1) % parts,
            _ => parts + part * (clique - 2) + k - 2,
        };
        let of_part = |part: u32| {
            let of = move |k: u32| (k + 1..clique).map(move |l| (at(part, k), at(part, l)));
            (0..clique).flat_map(of)
        };
        let all = (0..parts).flat_map(of_part);
        all.map(|(i, j)| (i.min(j), i.max(j))).collect()
    };
    let count = |parts: u32, clique: u32, model: Model| {
        let pairs = hinged(parts, clique);
        let graph = Graph::new(parts * (clique - 1), pairs).unwrap();
        let verdict = decide(&graph, &options(model)).unwrap();
        let found = groups(&graph, &verdict, &options(model)).unwrap();
        found.unwrap().count
    };
    assert_eq!(count(3, 3, Model::Calibrated), 1);
    assert_eq!(count(4, 3, Model::Calibrated), 4);
    assert_eq!(count(3, 3, Model::Affine), 9);
    assert_eq!(count(3, 4, Model::Affine), 3);
    assert_eq!(count(3, 3, Model::Projective), 1);
    assert_eq!(count(3, 4, Model::Projective), 1);
}

/// The graph of Example 5.14: the diagonals of its 4-cycle 3-5-4-6 are implied, and nothing else.
#[test]
fn the_diagonals_of_a_cycle_are_implied() {
    let graph = graph6::decode(b"O?IWqCO_K@K?W?GOCC@@?").unwrap();
    let verdict = decide(&graph, &options(Model::Projective)).unwrap();
    let found = closure(&graph, &verdict, &options(Model::Projective)).unwrap();
    let implied: Pairs = found.implied(&graph).collect();
    assert_eq!(implied, [(3, 4), (5, 6)]);
    assert_eq!(found.sets, [vec![3, 4, 5, 6]]);
    // No evidence of the search proves this graph's rank: residues bound it, but for an error.
    let bounded = |strength: Strength| matches!(strength, Strength::ErrorBound(e) if e <= -100);
    assert!(bounded(found.complete));
    // With the diagonals the 4-cycle is a body, and the searches for a bound see less.
    assert!(found.implied.error_log2().is_none_or(|e| e <= -100));
    // One stress, which vanishes at no pair: all check each other, each in one equation.
    let found = groups(&graph, &verdict, &options(Model::Projective)).unwrap();
    let found = found.unwrap();
    assert!(found.count == 1 && bounded(found.strength));
}
