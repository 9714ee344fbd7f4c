//! Certificates for the number of solutions: what the prover counts the checker verifies.

use std::collections::BTreeMap;
use viewcert::graph::{Graph, graph6};
use viewcert::solutions::count;
use viewcert::watch::Watch;
use viewcert::{CountSolutions, Model, Options, Question, Value, decide};
use viewcert_catalog::candidates::has_adjacent_nodes_of_degree_2;
use viewcert_catalog::{candidates, least_edges};

/// The certificate of a graph with the evidence for its number of solutions; nothing if the graph is
/// not finite solvable.
fn certificate(graph: &Graph) -> Option<String> {
    // Rounds would leave nothing to count.
    let by_rank = Question::without_solutions(Model::Projective);
    let verdict = decide(graph, &Options::default().question(by_rank)).unwrap();
    if verdict.value == Value::NotFiniteSolvable {
        return None;
    }
    let solutions = count(graph, 1).unwrap();
    let certificate = verdict.certificate(graph).compact();
    Some(certificate.with_solutions(&solutions).unwrap().to_string())
}

/// Verifies the certificates of every so many of the graphs with the fewest edges; how many of them
/// have how many solutions. Graphs of which the verdict says it all have one.
fn verified(nodes: usize, every: usize) -> BTreeMap<usize, usize> {
    let mut graphs = candidates(nodes, least_edges(nodes), &Watch::default()).unwrap();
    graphs.retain(|graph| !has_adjacent_nodes_of_degree_2(graph));
    let mut tally = BTreeMap::new();
    let certificates = graphs
        .iter()
        .filter_map(|graph| Some((graph, certificate(graph)?)));
    for (graph, certificate) in certificates.step_by(every) {
        let name = graph6::encode(graph);
        let verified = viewcert_check::check(certificate.as_bytes(), None)
            .unwrap_or_else(|failure| panic!("{name}: {failure}"));
        let solutions = match verified.solutions {
            Some(count) if count.at_most == Some(count.at_least) => count.at_least,
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

/// The pairs of a graph with nine nodes, twelve pairs and two solutions (Arrigoni, Kohn, Fusiello, Pajdla).
fn core() -> Vec<(u32, u32)> {
    graph6::decode(b"HBQkcP_").unwrap().edges().to_vec()
}

/// Two cores that share one camera, and a triangle: each component is counted by itself.
#[test]
fn components_of_a_graph_that_falls_apart() {
    let other = core().into_iter().map(|(i, j)| (i + 8, j + 8));
    let triangle = [(20, 21), (21, 22), (20, 22)];
    let graph = Graph::from_edges(core().into_iter().chain(other).chain(triangle)).unwrap();
    let of = |solutions| {
        let question = Question::with_solutions(solutions);
        let verdict = decide(&graph, &Options::default().question(question)).unwrap();
        assert_eq!(verdict.value, Value::NotFiniteSolvable);
        let components = verdict.components.iter();
        let words = components.map(|component| component.solutions.as_ref().unwrap().to_string());
        words.collect::<Vec<_>>()
    };
    let [one, two] = ["exactly 1 solution", "exactly 2 solutions"];
    assert_eq!(of(CountSolutions::Quick), [two, two, one]);
    let open = "finitely many solutions";
    assert_eq!(of(CountSolutions::Off), [open, open, one]);
}

/// A quick count says where a full one is worth while, and only there.
#[test]
fn what_a_full_count_may_tell() {
    let counts = |graph6: &[u8]| {
        let graph = graph6::decode(graph6).unwrap();
        [CountSolutions::Quick, CountSolutions::Full].map(|solutions| {
            let question = Question::with_solutions(solutions);
            let verdict = decide(&graph, &Options::default().question(question)).unwrap();
            verdict.solutions.unwrap()
        })
    };
    // Twenty-two nodes that a quick count does not look at.
    let [quick, full] = counts(b"U??_?CA?W?O_cAKHS?AO???O?GS?OOC?b??@IK??");
    assert!(quick.full_may_tell_more && quick.exactly().is_none());
    assert!(!full.full_may_tell_more);
    // Nineteen nodes, by rounds.
    let [quick, full] = counts(b"RC?OA?__?]HCg_CDAC??@??oG`OAA?");
    for count in [&quick, &full] {
        assert!(!count.full_may_tell_more && count.is_one() && count.because().is_some());
    }
    let [quick, full] = counts(b"HBQkcP_");
    assert!(!quick.full_may_tell_more && !full.full_may_tell_more);
}
