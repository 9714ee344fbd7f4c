//! Any bytes as a MatrixMarket file: refused, or a graph whose matrix is read as the same graph.
#![no_main]

use std::io::Write;

use libfuzzer_sys::fuzz_target;
use viewcert_formats::{Parsed, matrix_market};

fuzz_target!(|data: &[u8]| {
    let Ok(Parsed { graph, .. }) = matrix_market::read(data) else {
        return;
    };
    assert!(graph.edges().is_sorted_by(|a, b| a < b));
    let (nodes, edges) = (graph.nodes(), graph.edges().len());
    let mut text = Vec::new();
    writeln!(text, "{} matrix coordinate pattern symmetric", matrix_market::HEADER).unwrap();
    writeln!(text, "{nodes} {nodes} {edges}").unwrap();
    for (i, j) in graph.edges() {
        writeln!(text, "{} {}", j + 1, i + 1).unwrap();
    }
    let Parsed { graph: again, notes, .. } = matrix_market::read(&text[..]).expect("own text is read");
    assert_eq!(again, graph);
    assert!(notes.is_empty());
});
