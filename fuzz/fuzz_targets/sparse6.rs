//! Any bytes as a line of sparse6, or as one that changes a graph: refused, or a simple graph.
//! Changing a graph twice in the same way leaves it as it was.
#![no_main]

use libfuzzer_sys::fuzz_target;
use viewcert_formats::sparse6;

fuzz_target!(|data: &[u8]| {
    let Ok((previous, _)) = sparse6::decode(b":Fa@x^", None) else {
        unreachable!("the example of the format");
    };
    for before in [None, Some(&previous)] {
        let Ok((graph, _)) = sparse6::decode(data, before) else {
            continue;
        };
        assert!(graph.edges().is_sorted_by(|a, b| a < b));
        let nodes = graph.nodes() as u32;
        assert!(graph.edges().iter().all(|&(i, j)| i < j && j < nodes));
        if data.starts_with(b";") {
            let (back, _) = sparse6::decode(data, Some(&graph)).expect("the same change");
            assert_eq!(back, previous);
        }
    }
});
