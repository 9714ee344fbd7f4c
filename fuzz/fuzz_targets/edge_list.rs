//! Any bytes as an edge list: refused, or a graph that survives being written
//! and read again. What is read strictly is read leniently, as the same graph if it has no head.
#![no_main]

use std::io::Write;

use libfuzzer_sys::fuzz_target;
use viewcert_formats::Parsed;
use viewcert_formats::edge_list::{Reading, read};

fuzz_target!(|data: &[u8]| {
    let lenient = read(data, Reading::Lenient);
    if let Ok(strict) = read(data, Reading::Strict) {
        // A head names the columns.
        if strict.read.guessed.is_empty()
            && let Ok(whole) = &lenient
        {
            assert_eq!((&whole.graph, &whole.labels), (&strict.graph, &strict.labels));
        }
    }
    let Ok(Parsed { graph, labels, .. }) = lenient else {
        return;
    };
    assert!(graph.edges().is_sorted_by(|a, b| a < b));
    let nodes = graph.nodes() as u32;
    assert!(graph.edges().iter().all(|&(i, j)| i < j && j < nodes));
    let quoted = |node| format!("\"{}\"", labels.label(node).replace('"', "\"\""));
    let mut text = Vec::new();
    for node in (0..nodes).rev() {
        writeln!(text, "{}", quoted(node)).unwrap();
    }
    for &(i, j) in graph.edges().iter().rev() {
        writeln!(text, "{}\t{}", quoted(j), quoted(i)).unwrap();
    }
    let again = read(&text[..], Reading::Lenient).expect("own text is read");
    assert_eq!(again.graph, graph);
    assert_eq!(again.labels, labels);
    assert!(again.notes.is_empty());
});
