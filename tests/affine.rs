//! The affine model and centres in a plane against matrices and lists of all small graphs: Theorem 13.3.

use crate::common::geng_connected;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use viewcert::decide::{Options, decide, plane_rank};
use viewcert::geometry::camera::normal_form;
use viewcert::geometry::draw::DrawKey;
use viewcert::geometry::jacobian::{SparseRows, jacobian};
use viewcert::geometry::model::Model;
use viewcert::geometry::plane_direction::direction_rows;
use viewcert::geometry::plane_flow::rigidity_rows;
use viewcert::graph::{Graph, UnionFind, graph6, sha256};
use viewcert::linalg::Ring;
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::sparse_lu::Factorisation;
use viewcert::sparsity::Space;
use viewcert::watch::{Watch, unwatched};

fn graphs(nodes: usize) -> Vec<Graph> {
    let lines = geng_connected(nodes);
    let decode = |line: &str| graph6::decode(line.as_bytes()).unwrap();
    lines.lines().map(decode).collect()
}

/// A connected random graph with `nodes` nodes, with about as many edges as rigidity takes.
fn random_graph(nodes: u32, random: &mut ChaCha8Rng) -> Graph {
    let mut next = |below: u32| random.next_u32() % below;
    let mut pairs: Vec<(u32, u32)> = (1..nodes).map(|v| (next(v), v)).collect();
    for _ in 0..next(2 * nodes) {
        let (i, j) = (next(nodes), next(nodes));
        if i != j {
            pairs.push((i, j));
        }
    }
    Graph::new(nodes, pairs).unwrap()
}

fn random_graphs(count: u32) -> impl Iterator<Item = Graph> {
    let mut random = ChaCha8Rng::seed_from_u64(13);
    (0..count).map(move |k| random_graph(3 + k % 10, &mut random))
}

fn rank(field: &PrimeField, rows: SparseRows<u64>, cols: usize) -> usize {
    unwatched(|task| Factorisation::new(field, rows, cols, task)).rank()
}

fn residues(field: &PrimeField, graph: &Graph) -> impl FnMut() -> u64 {
    let key = DrawKey {
        graph_sha256: sha256(graph),
        core_sha256: None,
        seed: 3,
        draw: 0,
    };
    key.residues(field)
}

/// Theorem 13.3 at random centres in a plane, and the pebble game with three pebbles at random
/// centres in space.
fn in_a_plane(graph: &Graph) {
    let field = PrimeField::mersenne61();
    let mut random = residues(&field, graph);
    let nodes = graph.nodes();
    let points: Vec<[u64; 2]> = (0..nodes).map(|_| [random(), random()]).collect();
    // The plane z = 3 x + 5 y + 7.
    let height = |[x, y]: [u64; 2]| {
        let terms = [(3, x), (5, y)].map(|(a, x)| field.mul(&field.from_u64(a), &x));
        terms
            .iter()
            .fold(field.from_u64(7), |sum, x| field.add(&sum, x))
    };
    let centres: Vec<[u64; 3]> = points.iter().map(|&p| [p[0], p[1], height(p)]).collect();
    let cameras: Vec<_> = centres.iter().map(|c| normal_form(&field, c)).collect();
    let in_plane = rank(&field, direction_rows(&field, graph, &points), 2 * nodes);
    let mut parts = UnionFind::new(nodes);
    let joined = graph.edges().iter();
    let joined = joined
        .filter(|(i, j)| parts.union(*i as usize, *j as usize))
        .count();
    let of_n = rank(&field, rigidity_rows(&field, graph, &centres), 3 * nodes);
    assert_eq!(of_n, in_plane + joined, "{graph:?}");
    let of_j = rank(&field, jacobian(&field, graph, &cameras), 12 * nodes);
    assert_eq!(of_j, 4 * in_plane + 3 * joined, "{graph:?}");
    assert_eq!(plane_rank(graph, &Watch::default()), Ok(in_plane));
    let generic: Vec<[u64; 3]> = (0..nodes).map(|_| [random(), random(), random()]).collect();
    let generic = rank(&field, rigidity_rows(&field, graph, &generic), 3 * nodes);
    let counted = unwatched(|task| Space::new(graph, task)).rank();
    assert_eq!(counted, generic, "{graph:?}");
}

#[test]
#[ignore = "needs geng"]
fn ranks_at_centres_in_a_plane() {
    for nodes in 2..=7 {
        graphs(nodes).iter().for_each(in_a_plane);
    }
    random_graphs(1000).for_each(|graph| in_a_plane(&graph));
}

/// Every certificate of the affine model is verified by the checker, which shares no code with the
/// prover, and its claim is that of counting.
fn certified(graph: &Graph) {
    let options = Options::default().model(Model::Affine);
    let verdict = decide(graph, &options).unwrap();
    let text = verdict.certificate(graph).compact().to_string();
    viewcert_check::check(text.as_bytes(), None)
        .unwrap_or_else(|error| panic!("{graph:?}: {error}\n{text}"));
    let counted = plane_rank(graph, &Watch::default()).unwrap();
    assert_eq!(verdict.rank, 4 * counted);
}

#[test]
#[ignore = "needs geng"]
fn certificates_of_all_small_graphs_are_verified() {
    for nodes in 1..=6 {
        graphs(nodes).iter().for_each(certified);
    }
    random_graphs(300).for_each(|graph| certified(&graph));
    // Pieces and cores with many bodies: triangles in rings, some braced.
    let mut random = ChaCha8Rng::seed_from_u64(14);
    for _ in 0..50 {
        let corners = 4 + random.next_u32() % 6;
        let mut pairs = Vec::new();
        for v in 0..corners {
            let (next, tip) = ((v + 1) % corners, corners + v);
            pairs.extend([(v, next), (v, tip), (next, tip)]);
        }
        for _ in 0..random.next_u32() % corners {
            let [i, j] = [(); 2].map(|()| random.next_u32() % (2 * corners));
            if i != j {
                pairs.push((i, j));
            }
        }
        certified(&Graph::new(2 * corners, pairs).unwrap());
    }
}
