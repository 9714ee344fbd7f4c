//! Certificates of the affine model from the prover to the checker, on small graphs of all kinds, and
//! what becomes of their claims when these are changed.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use viewcert::geometry::model::Model;
use viewcert::graph::{Graph, graph6};
use viewcert::{Options, decide};
use viewcert_check::{Verdict, Verified};

fn certificate(graph: &Graph) -> String {
    let options = Options::default().model(Model::Affine);
    let verdict = decide(graph, &options).unwrap();
    verdict.certificate(graph).compact().to_string()
}

fn verified(graph: &Graph) -> Verified {
    let text = certificate(graph);
    viewcert_check::check(text.as_bytes(), None)
        .unwrap_or_else(|failure| panic!("{}: {failure}\n{text}", graph6::encode(graph)))
}

/// The graph with these of the pairs of its nodes.
fn graph(nodes: u32, chosen: u32) -> Graph {
    let pairs = (0..nodes).flat_map(|j| (0..j).map(move |i| (i, j)));
    let chosen = pairs.enumerate().filter(|(k, _)| chosen >> k & 1 == 1);
    Graph::new(nodes, chosen.map(|(_, pair)| pair)).unwrap()
}

/// The largest (2,3)-sparse set of edges, by the definition: edges are added one after another as
/// long as no set of nodes spans too many.
fn rank_by_definition(nodes: u32, edges: &[(u32, u32)]) -> usize {
    let mut independent: Vec<(u32, u32)> = Vec::new();
    for &edge in edges {
        independent.push(edge);
        let mut sets = (0..1_u32 << nodes).filter(|set| set.count_ones() >= 2);
        let is_sparse = sets.all(|set| {
            let inside = |&&(i, j): &&(u32, u32)| (set >> i) & (set >> j) & 1 == 1;
            independent.iter().filter(inside).count() as u32 <= 2 * set.count_ones() - 3
        });
        if !is_sparse {
            independent.pop();
        }
    }
    independent.len()
}

/// Components by the definition: pairs that can be added without more rank are implied, and the
/// edges of a component are those of a complete graph of implied pairs.
fn components_by_definition(nodes: u32, edges: &[(u32, u32)]) -> usize {
    let rank = rank_by_definition(nodes, edges);
    let is_implied = |i: u32, j: u32| {
        let more = [edges, &[(i.min(j), i.max(j))]].concat();
        i == j || rank_by_definition(nodes, &more) == rank
    };
    let members = |&(i, j): &(u32, u32)| -> Vec<u32> {
        let inside = |&v: &u32| is_implied(i, v) && is_implied(j, v);
        (0..nodes).filter(inside).collect()
    };
    let mut all: Vec<Vec<u32>> = edges.iter().map(members).collect();
    all.sort_unstable();
    all.dedup();
    all.len()
}

/// All graphs with up to four nodes, and many with five and six, connected or not.
#[test]
fn small_graphs_are_verified() {
    for (nodes, step) in [(1, 1), (2, 1), (3, 1), (4, 1), (5, 3), (6, 41)] {
        let pairs = nodes * (nodes - 1) / 2;
        for chosen in (0..1_u32 << pairs).step_by(step) {
            let graph = graph(nodes, chosen);
            let verified = verified(&graph);
            let rank = rank_by_definition(nodes, graph.edges());
            let name = graph6::encode(&graph);
            assert_eq!(verified.rank.0, 4 * rank as i64, "{name}");
            let is_solvable = nodes == 1 || rank == 2 * nodes as usize - 3;
            let verdict = if is_solvable {
                Verdict::Solvable
            } else {
                Verdict::NotFiniteSolvable
            };
            assert_eq!(verified.verdict.0, verdict, "{name}");
            let components = components_by_definition(nodes, graph.edges());
            assert_eq!(verified.components.0, components, "{name}");
        }
    }
}

/// Random graphs that are about rigid, so that cores and components of many sizes come about.
fn random_graph(nodes: u32, random: &mut ChaCha8Rng) -> Graph {
    let mut next = |below: u32| random.next_u32() % below;
    let edges = 2 * nodes - 6 + next(6);
    let pairs = (0..edges).map(|_| {
        let i = next(nodes);
        (i, (i + 1 + next(nodes - 1)) % nodes)
    });
    let pairs: Vec<(u32, u32)> = pairs.collect();
    Graph::new(nodes, pairs).unwrap()
}

#[test]
fn random_graphs_are_verified() {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    for k in 0..150 {
        verified(&random_graph(6 + k % 30, &mut random));
    }
}

/// Evidence proves one claim: any other one is rejected.
#[test]
fn other_claims_are_rejected() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    for _ in 0..40 {
        let graph = random_graph(9, &mut random);
        let text = certificate(&graph);
        let original: Value = serde_json::from_str(&text).unwrap();
        let rank = original["claim"]["rank"]["value"].as_i64().unwrap();
        let components = original["claim"]["components"]["value"].as_i64().unwrap();
        let verdict = original["claim"]["verdict"]["value"].as_str().unwrap();
        let other = ["solvable", "not-finite-solvable"][usize::from(verdict == "solvable")];
        for (pointer, wrong) in [
            ("/claim/rank/value", json!(rank + 4)),
            ("/claim/rank/value", json!(rank - 4)),
            ("/claim/rank/value", json!(rank / 4)),
            ("/claim/rank/required", json!(2 * 9 - 3)),
            ("/claim/components/value", json!(components + 1)),
            ("/claim/components/value", json!(components - 1)),
            ("/claim/verdict/value", json!(other)),
            ("/claim/verdict/value", json!("finite-solvable")),
            ("/claim/rank/strength", json!("error-bound")),
            ("/model", json!("calibrated")),
            ("/model", json!("projective")),
        ] {
            let mut changed = original.clone();
            *changed.pointer_mut(pointer).unwrap() = wrong.clone();
            let checked = viewcert_check::check(changed.to_string().as_bytes(), None);
            assert!(
                checked.is_err(),
                "{}: {pointer} {wrong}",
                graph6::encode(&graph)
            );
        }
    }
}
