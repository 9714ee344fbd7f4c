//! Any bytes as an edge list: refused, or a graph that survives being written
//! and read again.
#![no_main]

use std::io::Write;

use libfuzzer_sys::fuzz_target;
use viewcert::graph::edge_list;

fuzz_target!(|data: &[u8]| {
    let Ok((graph, labels, _)) = edge_list::read(data) else {
        return;
    };
    assert!(!graph.edges().is_empty());
    assert!(graph.edges().is_sorted_by(|a, b| a < b));
    let nodes = graph.nodes() as u32;
    assert!(graph.edges().iter().all(|&(i, j)| i < j && j < nodes));
    let mut text = Vec::new();
    for node in (0..nodes).rev() {
        writeln!(text, "{}", labels.display(node)).unwrap();
    }
    for &(i, j) in graph.edges().iter().rev() {
        writeln!(text, "{}\t{}", labels.display(j), labels.display(i)).unwrap();
    }
    let (again, labels_again, notes) = edge_list::read(&text[..]).expect("own text is read");
    assert_eq!(again, graph);
    assert_eq!(labels_again, labels);
    assert!(notes.is_empty());
});
