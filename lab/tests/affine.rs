//! The affine model against the published formulation, on all small graphs.

use crate::common::{geng_connected, run_with};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use viewcert::decide::plane_rank;
use viewcert::geometry::draw::DrawKey;
use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::{Graph, graph6, sha256};
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::sparse_lu::Factorisation;
use viewcert::watch::{Watch, unwatched};
use viewcert_lab_studies::formulation::affine;

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

/// The published matrix has 12 + 4 rank R, and rank R is what counting says.
fn published(graph: &Graph) {
    let field = PrimeField::mersenne61();
    let mut random = residues(&field, graph);
    let mut camera = || std::array::from_fn(|_| std::array::from_fn(|_| random()));
    let cameras: Vec<_> = (0..graph.nodes()).map(|_| camera()).collect();
    let counted = plane_rank(graph, &Watch::default()).unwrap();
    let directions = affine::directions(&field, graph, &cameras);
    assert_eq!(rank(&field, directions, 2 * graph.nodes()), counted);
    let rows = affine::matrix(&field, graph, &cameras);
    assert_eq!(
        rank(&field, rows, 8 * graph.nodes()),
        4 * counted + 12,
        "{graph:?}"
    );
}

#[test]
#[ignore = "needs geng"]
fn the_published_matrix_on_all_small_graphs() {
    for nodes in 2..=7 {
        graphs(nodes).iter().for_each(published);
    }
    random_graphs(300).for_each(|graph| published(&graph));
}

/// The same with 8 nodes.
#[test]
#[ignore = "needs geng and a minute"]
fn the_published_matrix_with_eight_nodes() {
    graphs(8).iter().for_each(published);
}

/// `viewcert-lab compare --model affine`: the published matrix of the 4-cycle has rank 4 * 4 + 12 of 32.
#[test]
fn the_published_matrix_in_the_comparison() {
    let cycle = crate::common::cycle(4);
    for field in [&["--rational"][..], &["--prime", "1000003"], &[]] {
        let arguments = [&["compare", "-", "--model", "affine"], field].concat();
        let run = run_with("viewcert-lab", cycle.as_bytes(), &arguments);
        assert_eq!(run.code, 0, "{}", run.err);
        for words in [
            "28 x 32",
            "4 x 8",
            "on 4 of 4 pairs",
            "4 dimensions of motions",
        ] {
            assert!(run.out.contains(words), "{words}: {}", run.out);
        }
        let run = run_with(
            "viewcert-lab",
            cycle.as_bytes(),
            &[&arguments[..], &["--json"]].concat(),
        );
        let line = &run.json()[0];
        assert_eq!((&line["agree"], &line["excess"]), (&true.into(), &4.into()));
        assert_eq!(line["affine_f"], 4);
        assert!(line.get("kernel_is_f").is_none());
        let of = |k: usize| line["formulations"][k]["rank"].as_u64().unwrap();
        assert_eq!((of(0), of(1)), (28, 16));
    }
    let run = run_with(
        "viewcert-lab",
        crate::common::cycle(3).as_bytes(),
        &["compare", "-", "--model", "affine"],
    );
    assert!(
        run.out.contains("full rank, affine solvable"),
        "{}",
        run.out
    );
}
