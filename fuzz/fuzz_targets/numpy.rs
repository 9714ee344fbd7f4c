//! Any bytes as an array of NumPy, and as an archive of them: refused, or a graph, and no more memory
//! than the bytes account for (which the fuzzer's own limit watches).
#![no_main]

use libfuzzer_sys::fuzz_target;
use viewcert_formats::{Parsed, numpy};

fuzz_target!(|data: &[u8]| {
    let read = [
        numpy::read(data),
        numpy::read_archive(data, None),
        numpy::read_archive(data, Some("data")),
    ];
    for Parsed { graph, labels, .. } in read.into_iter().flatten() {
        assert!(graph.edges().is_sorted_by(|a, b| a < b));
        let nodes = graph.nodes() as u32;
        assert!(graph.edges().iter().all(|&(i, j)| i < j && j < nodes));
        let last = nodes.checked_sub(1).map(|node| labels.label(node));
        assert!(last.is_some_and(|label| !label.is_empty()));
    }
});
