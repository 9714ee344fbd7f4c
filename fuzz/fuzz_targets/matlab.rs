//! Any bytes as a MATLAB file: refused, or a graph whose edges are the non-zero
//! entries of the matrix.
#![no_main]

use libfuzzer_sys::fuzz_target;
use viewcert_formats::matlab;

fuzz_target!(|data: &[u8]| {
    let Ok(graph) = matlab::read(data, None) else {
        return;
    };
    assert!(graph.edges().is_sorted_by(|a, b| a < b));
    let nodes = graph.nodes() as u32;
    assert!(graph.edges().iter().all(|&(i, j)| i < j && j < nodes));
    if let Ok(entries) = matlab::entries(data, "A") {
        assert_eq!(entries.len(), 2 * graph.edges().len());
        for (row, column, _) in entries {
            assert!(graph.edge_number(row, column).is_some());
        }
    }
});
