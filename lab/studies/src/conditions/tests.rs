//! The conditions and the exact verdict never contradict each other.

use super::{decide, refuted, solvable};
use viewcert::decide::{CountSolutions, Options, Question, Value};
use viewcert::graph::{Graph, graph6};
use viewcert_lab_catalog::random::{Sampler, generator};
use viewcert_lab_catalog::{Candidates, least_edges};

/// What the two say of a graph, as counts.
#[derive(Debug, Default, PartialEq, Eq)]
struct Agreement {
    graphs: usize,
    /// A necessary condition fails.
    refuted: usize,
    /// A sufficient condition holds.
    unique: usize,
    /// Of these, the verdict does not know that there is one solution.
    unknown: usize,
}

impl Agreement {
    fn enter(&mut self, graph: &Graph) {
        let name = graph6::encode(graph);
        let conditions = decide(graph);
        // What the conditions prove is worth every effort; of the others only 'finite or not' counts.
        let effort = if solvable(&conditions) {
            CountSolutions::Full
        } else {
            CountSolutions::Off
        };
        let options = Options::default().question(Question::with_solutions(effort));
        let verdict = viewcert::decide(graph, &options).unwrap();
        self.graphs += 1;
        if refuted(&conditions) {
            self.refuted += 1;
            assert_eq!(verdict.value, Value::NotFiniteSolvable, "{name}");
            assert!(!solvable(&conditions), "{name}");
        }
        if solvable(&conditions) {
            self.unique += 1;
            self.unknown += usize::from(verdict.value != Value::Solvable);
            assert_ne!(verdict.value, Value::NotFiniteSolvable, "{name}");
            assert_eq!(verdict.solutions.unwrap().at_least, 1, "{name}");
        }
    }
}

/// All 627 candidates with up to nine nodes: what the moves prove the verdict proves.
#[test]
fn agreement_on_the_catalog() {
    let mut found = Agreement::default();
    for nodes in 3..=9 {
        let candidates = Candidates::new(nodes, least_edges(nodes), false).unwrap();
        candidates.for_each(&mut |graph| {
            found.enter(&graph);
            true
        });
    }
    // 1, 1, 2, 9, 20, 161 and 433 candidates.
    assert_eq!(found.graphs, 627);
    assert!(found.unique > 0 && found.refuted > 0, "{found:?}");
    assert_eq!(found.unknown, 0, "{found:?}");
}

/// Random graphs with 8 to 12 nodes and about as many edges as it takes.
#[test]
fn agreement_on_random_graphs() {
    let mut found = Agreement::default();
    for nodes in 8..=12 {
        for density in ["0.3", "0.35", "0.4", "0.5"] {
            let sampler = Sampler::new(nodes, &density.parse().unwrap());
            for sample in 0..20 {
                found.enter(&sampler.draw(&mut generator(7, sample)));
            }
        }
    }
    assert_eq!(found.graphs, 400);
    assert!(found.unique > 20 && found.refuted > 20, "{found:?}");
    assert_eq!(found.unknown, 0, "{found:?}");
}
