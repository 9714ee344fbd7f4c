//! Any bytes as a file of what is given besides a graph: refused with a remedy, or nodes of the graph.
#![no_main]

use libfuzzer_sys::fuzz_target;
use viewcert::graph::Labels;
use viewcert::{Graph, Known};
use viewcert_formats::{NamedGraph, given};

fuzz_target!(|data: &[u8]| {
    let graph = Graph::new(6, [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)]).expect("a path");
    for labels in [
        Labels::Numbers { first: 0 },
        Labels::Names(["a", "b c", "d", "e", "f", "part"].map(Into::into).into()),
    ] {
        let input = NamedGraph::new("path", graph.clone(), labels);
        match given::read(data, &input, false) {
            Err(fault) => assert!(!fault.problem.remedy().is_empty()),
            Ok(found) => match found.known {
                Known::Parts(parts) => assert!(parts.iter().flatten().all(|&node| node < 6)),
                Known::Displacements(known) | Known::OwnFrame { given: known, .. } => {
                    assert!(!known.is_empty());
                    assert!(known.groups().iter().flatten().all(|&node| node < 6));
                }
            },
        }
    }
});
