//! The paper's method of components without rounding, on random graphs around the threshold of solvability.
//! `VIEWCERT_CASES` scales the volume.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use viewcert::decide::{Options, Verdict, decide};
use viewcert::geometry::draw;
use viewcert::geometry::draw::DrawKey;
use viewcert::geometry::jacobian;
use viewcert::graph::{Graph, graph6, sha256};
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::textbook;
use viewcert_lab_studies::paper_components;

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
fn the_papers_method_never_splits_components() {
    let field = PrimeField::mersenne61();
    for graph in around_the_threshold(cases(500), 14) {
        let name = graph6::encode(&graph);
        let verdict = decide(&graph, &Options::default()).unwrap();
        assert!(verdict.value_claim().is_proved(), "{name}");
        let found = components(&graph, &verdict);
        // The paper's method may merge components, never split them.
        let mut papers = paper_components::components(&field, &graph, &key(&graph, 1)).unwrap();
        papers.sort();
        if papers != found {
            for part in &papers {
                let refined: Vec<_> = found.iter().filter(|c| part.contains(&c[0])).collect();
                assert_eq!(
                    refined.iter().map(|c| c.len()).sum::<usize>(),
                    part.len(),
                    "{name}"
                );
                if refined.len() > 1 {
                    assert!(is_flexible_alone(&field, part), "{name}: {part:?}");
                }
            }
        }
    }
}

fn is_flexible_alone(field: &PrimeField, part: &[(u32, u32)]) -> bool {
    let mut nodes: Vec<u32> = part.iter().flat_map(|&(i, j)| [i, j]).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let number = |v: &u32| nodes.binary_search(v).unwrap() as u32;
    let pairs = part.iter().map(|(i, j)| (number(i), number(j))).collect();
    let (alone, _) = Graph::from_pairs(nodes.len() as u32, pairs).unwrap();
    textbook_rank(field, &alone) < 11 * alone.nodes() - 15
}

/// Ψ of docs/theory.md, Example 6.2, numbered so that the method starts in the 4-cycle
/// 0, 1, 3, 2 (there 0, 9, 2, 10), which the rest holds together.
#[test]
fn the_papers_method_merges_components_of_psi() {
    let psi = "0 4,0 6,5 7,6 7,7 8,7 9,7 10,3 5,3 8,4 9,4 10,0 1,1 3,0 2,2 3";
    let pairs = psi.split(',').map(|pair| {
        let (i, j) = pair.split_once(' ').unwrap();
        (i.parse().unwrap(), j.parse().unwrap())
    });
    let (graph, _) = Graph::from_pairs(11, pairs.collect()).unwrap();
    let field = PrimeField::mersenne61();
    let papers = paper_components::components(&field, &graph, &key(&graph, 0)).unwrap();
    assert_eq!(papers[0], [(0, 1), (0, 2), (1, 3), (2, 3)]);
    assert!(is_flexible_alone(&field, &papers[0]));
    let verdict = decide(&graph, &Options::default()).unwrap();
    assert_eq!(components(&graph, &verdict).len(), 15);
}
