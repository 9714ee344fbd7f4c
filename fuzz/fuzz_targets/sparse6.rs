//! Any bytes as a line of sparse6: refused, or a simple graph.
#![no_main]

use libfuzzer_sys::fuzz_target;
use viewcert_formats::sparse6;

fuzz_target!(|data: &[u8]| {
    let Ok((graph, _)) = sparse6::decode(data) else {
        return;
    };
    assert!(graph.edges().is_sorted_by(|a, b| a < b));
    let nodes = graph.nodes() as u32;
    assert!(graph.edges().iter().all(|&(i, j)| i < j && j < nodes));
});
