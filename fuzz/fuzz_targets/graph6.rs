//! Any bytes as a line of graph6: refused, or the graph whose graph6 it is.
#![no_main]

use libfuzzer_sys::fuzz_target;
use viewcert::graph::graph6;

fuzz_target!(|data: &[u8]| {
    let Ok(graph) = graph6::decode(data) else {
        return;
    };
    assert!(graph.edges().is_sorted_by(|a, b| a < b));
    let nodes = graph.nodes() as u32;
    assert!(graph.edges().iter().all(|&(i, j)| i < j && j < nodes));
    let text = graph6::encode(&graph);
    assert_eq!(graph6::decode(text.as_bytes()), Ok(graph.clone()));
    let line = data.strip_prefix(graph6::HEADER.as_bytes()).unwrap_or(data);
    assert_eq!(text.as_bytes(), line);
});
