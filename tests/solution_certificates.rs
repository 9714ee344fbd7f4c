//! Certificates for the number of solutions: what the prover counts the checker verifies.

use std::collections::BTreeMap;
use viewcert::graph::{Graph, graph6};
use viewcert::solutions::{Effort, count};
use viewcert::{Options, Value, decide};
use viewcert_studies::catalog::{Candidates, least_edges};

/// The certificate of a graph with the evidence for its number of solutions; nothing if the graph is
/// not finite solvable.
fn certificate(graph: &Graph) -> Option<String> {
    let verdict = decide(graph, &Options::default()).unwrap();
    if verdict.value == Value::NotFiniteSolvable {
        return None;
    }
    let solutions = count(graph, Effort::default(), 1).unwrap();
    let certificate = verdict.certificate(graph).compact();
    Some(certificate.with_solutions(&solutions).unwrap().to_string())
}

/// Verifies the certificates of every so many of the graphs with the fewest edges; how many of them
/// have how many solutions. Graphs of which the verdict says it all have one.
fn verified(nodes: usize, every: usize) -> BTreeMap<usize, usize> {
    let mut graphs = Vec::new();
    let candidates = Candidates::new(nodes, least_edges(nodes), true).unwrap();
    candidates.for_each(&mut |graph| {
        graphs.push(graph);
        true
    });
    let mut tally = BTreeMap::new();
    let certificates = graphs
        .iter()
        .filter_map(|graph| Some((graph, certificate(graph)?)));
    for (graph, certificate) in certificates.step_by(every) {
        let name = graph6::encode(graph);
        let verified = viewcert_check::check(certificate.as_bytes(), None)
            .unwrap_or_else(|failure| panic!("{name}: {failure}"));
        let solutions = match verified.solutions {
            Some(count) if count.at_most.as_ref() == Some(&count.at_least) => {
                count.at_least.to_string().parse().unwrap()
            }
            Some(_) => 0,
            None if verified.verdict.0 == viewcert_check::Verdict::Solvable => 1,
            None => 0,
        };
        let solvable = verified.verdict.0 == viewcert_check::Verdict::Solvable;
        assert_eq!(solvable, solutions == 1, "{name}");
        *tally.entry(solutions).or_default() += 1;
    }
    tally
}

/// The published numbers: one solution each up to eight nodes, and ten graphs with nine nodes that
/// have two.
#[test]
fn all_graphs_up_to_nine_nodes() {
    for (nodes, expected) in [
        (5, vec![(1, 1)]),
        (8, vec![(1, 36)]),
        (9, vec![(1, 17), (2, 10)]),
    ] {
        let expected: BTreeMap<usize, usize> = expected.into_iter().collect();
        assert_eq!(verified(nodes, 1), expected, "{nodes} nodes");
    }
}

#[test]
fn some_graphs_with_ten_nodes() {
    let tally = verified(10, 40);
    assert_eq!(tally.values().sum::<usize>(), 19);
    assert!(tally.keys().all(|&solutions| solutions < 4), "{tally:?}");
    assert!(tally.get(&0).is_none_or(|&open| open < 2), "{tally:?}");
}
