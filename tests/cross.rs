//! Independent ways to the same answer, on random graphs around the threshold of
//! solvability. `VIEWCERT_CASES` scales the volume.

use crate::common::{TABLE_1, geng};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use viewcert::decide::{Arithmetic, Options, Question, Verdict, decide};
use viewcert::geometry::draw::DrawKey;
use viewcert::geometry::jacobian;
use viewcert::geometry::model::Model;
use viewcert::geometry::plane_flow::PlaneFlows;
use viewcert::geometry::{camera, draw};
use viewcert::graph::{Graph, graph6, sha256};
use viewcert::linalg::matrix::Matrix;
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::textbook;
use viewcert::watch::unwatched;

fn cases(default: u64) -> u64 {
    match std::env::var("VIEWCERT_CASES") {
        Ok(scale) => default * scale.parse::<u64>().expect("VIEWCERT_CASES is a number") / 100,
        Err(_) => default,
    }
}

/// A random graph with `nodes` nodes and `edges` different pairs.
fn random_graph(nodes: u32, edges: usize, random: &mut ChaCha8Rng) -> Graph {
    let mut pairs: Vec<(u32, u32)> = (0..nodes)
        .flat_map(|i| (i + 1..nodes).map(move |j| (i, j)))
        .collect();
    let edges = edges.min(pairs.len());
    for k in 0..edges {
        let l = k + random.next_u32() as usize % (pairs.len() - k);
        pairs.swap(k, l);
    }
    pairs.truncate(edges);
    Graph::from_pairs(nodes, pairs).unwrap().0
}

/// Graphs with 4 to 14 nodes and about as many edges as solvability takes.
fn around_the_threshold(count: u64, largest: u32) -> impl Iterator<Item = Graph> {
    let mut random = ChaCha8Rng::seed_from_u64(20);
    (0..count).map(move |k| {
        let nodes = 4 + k as u32 % (largest - 3);
        let threshold = (11 * nodes as usize - 15).div_ceil(7);
        let edges = threshold - 2 + random.next_u32() as usize % 7;
        random_graph(nodes, edges, &mut random)
    })
}

fn key(graph: &Graph, draw: u64) -> DrawKey {
    DrawKey {
        graph_sha256: sha256(graph),
        core_sha256: None,
        seed: 77,
        draw,
    }
}

/// The rank of the paper's J_P at general cameras, by textbook elimination.
fn textbook_rank(field: &PrimeField, graph: &Graph) -> usize {
    let cameras = draw::cameras_mod(field, graph.nodes(), &key(graph, 0)).unwrap();
    let rows = jacobian::jacobian(field, graph, &cameras.values);
    textbook::eliminate(field, &jacobian::dense(field, &rows, 12 * graph.nodes())).rank()
}

/// The edges of every component, sorted.
fn components(graph: &Graph, verdict: &Verdict) -> Vec<Vec<(u32, u32)>> {
    let mut components: Vec<Vec<(u32, u32)>> = verdict
        .components
        .iter()
        .map(|component| {
            let nodes = component.nodes();
            let inside = |&&(i, j): &&(u32, u32)| nodes.contains(&i) && nodes.contains(&j);
            let edges: Vec<(u32, u32)> = graph.edges().iter().filter(inside).copied().collect();
            assert_eq!(component.edges(graph), edges);
            assert_eq!(edges.len(), component.edge_count());
            assert_eq!(nodes.len(), component.node_count());
            edges
        })
        .collect();
    components.sort();
    components
}

#[test]
fn pipeline_against_the_paper() {
    let field = PrimeField::mersenne61();
    let whole = Options::default().question(Question {
        whole_graph: true,
        ..Question::default()
    });
    let bounds = Options::default().question(Question {
        counting: false,
        ..Question::default()
    });
    for graph in around_the_threshold(cases(2000), 14) {
        let name = graph6::encode(&graph);
        let verdict = decide(&graph, &Options::default()).unwrap();
        assert!(verdict.value_claim().is_proved(), "{name}");
        assert_eq!(verdict.rank, textbook_rank(&field, &graph), "{name}");
        let found = components(&graph, &verdict);
        assert_eq!(
            found.iter().map(Vec::len).sum::<usize>(),
            graph.edges().len()
        );

        let other = decide(&graph, &whole).unwrap();
        assert_eq!(other.rank, verdict.rank, "{name}");
        assert_eq!(components(&graph, &other), found, "{name}");
        let other = decide(&graph, &bounds).unwrap();
        assert_eq!(other.rank, verdict.rank, "{name}");
        assert_eq!(components(&graph, &other), found, "{name}");
    }
}

#[test]
fn rational_against_prime() {
    let rational = Options::default().question(Question {
        arithmetic: Arithmetic::Rational {
            numerator: 9,
            denominator: 4,
        },
        ..Question::default()
    });
    for graph in around_the_threshold(cases(120), 9) {
        let name = graph6::encode(&graph);
        let verdict = decide(&graph, &Options::default()).unwrap();
        let other = decide(&graph, &rational).unwrap();
        assert_eq!(other.value, verdict.value, "{name}");
        assert_eq!(other.rank, verdict.rank, "{name}");
        assert_eq!(
            components(&graph, &other),
            components(&graph, &verdict),
            "{name}"
        );
    }
}

/// Theorem 3.2 of docs/theory.md at the given graph, at one draw of centres.
fn identity_holds(field: &PrimeField, graph: &Graph) {
    let key = key(graph, 5);
    let centres = draw::centres_mod(field, graph.nodes(), &key)
        .unwrap()
        .values;
    let cameras: Vec<_> = centres
        .iter()
        .map(|c| camera::normal_form(field, c))
        .collect();
    let rows = jacobian::jacobian(field, graph, &cameras);
    let rank =
        textbook::eliminate(field, &jacobian::dense(field, &rows, 12 * graph.nodes())).rank();

    // Lambda from a whole basis of plane flows, by the textbook.
    let flows = unwatched(|task| PlaneFlows::new(field, graph, &centres, task));
    let basis = unwatched(|task| flows.flows(task));
    let m = graph.edges().len();
    let lambda = Matrix::from_fn(4 * basis.len(), m, |row, e| {
        let omega = &basis[row / 4][e];
        let cj = &centres[graph.edges()[e].1 as usize];
        match row % 4 {
            3 => field.dot(0, omega, cj),
            k => omega[k],
        }
    });
    let rigidity = flows.rigidity_rank();
    let by_flows = 4 * rigidity + textbook::eliminate(field, &lambda).rank() - m;
    assert_eq!(by_flows, rank, "{}", graph6::encode(graph));
    // And from random flows, as the pipeline does.
    let lambda = unwatched(|task| flows.lambda(key.flow_weights(field), task));
    assert_eq!(
        flows.rank(&lambda).rank(m),
        rank,
        "{}",
        graph6::encode(graph)
    );
}

#[test]
fn plane_flow_identity_on_random_graphs() {
    let field = PrimeField::mersenne61();
    identity_holds(&field, &Graph::from_pairs(2, vec![(0, 1)]).unwrap().0);
    // Disconnected, with isolated nodes.
    identity_holds(
        &field,
        &Graph::from_pairs(5, vec![(0, 1), (3, 4)]).unwrap().0,
    );
    let mut random = ChaCha8Rng::seed_from_u64(4);
    for _ in 0..cases(400) {
        let nodes = 2 + random.next_u32() % 9;
        let edges = 1 + random.next_u32() as usize % (2 * nodes as usize);
        identity_holds(&field, &random_graph(nodes, edges, &mut random));
    }
}

#[test]
#[ignore = "needs geng"]
fn plane_flow_identity_on_the_candidates_of_table_1() {
    let field = PrimeField::mersenne61();
    for (nodes, edges, candidates, _) in TABLE_1.into_iter().take(7) {
        let graphs = geng(nodes, edges);
        assert_eq!(graphs.lines().count(), candidates);
        for line in graphs.lines() {
            identity_holds(&field, &graph6::decode(line.as_bytes()).unwrap());
        }
    }
}

/// The calibrated model against the rank of N at other centres and against Whiteley's count
/// over the found components.
#[test]
fn calibrated_against_the_textbook() {
    let field = PrimeField::mersenne61();
    let options = Options::default().model(Model::Calibrated);
    for graph in around_the_threshold(cases(600), 14) {
        let verdict = decide(&graph, &options).unwrap();
        let centres = draw::centres_mod(&field, graph.nodes(), &key(&graph, 3))
            .unwrap()
            .values;
        let rank =
            unwatched(|task| PlaneFlows::new(&field, &graph, &centres, task)).rigidity_rank();
        assert_eq!(verdict.rank, rank, "{}", graph6::encode(&graph));
        let count: usize = verdict
            .components
            .iter()
            .map(|c| 3 * c.node_count() - 4)
            .sum();
        assert_eq!(count, rank, "{}", graph6::encode(&graph));
        assert!(verdict.rank_claim().is_proved());
        assert!(verdict.components_claim().is_proved());
    }
}
