//! Any bytes as a MATLAB 7.3 file, which is HDF5: refused, or a graph.
#![no_main]

use libfuzzer_sys::fuzz_target;
use viewcert_formats::matlab;

fuzz_target!(|data: &[u8]| {
    for variable in [None, Some("A")] {
        if let Ok(graph) = matlab::read(data, variable) {
            assert!(graph.nodes() > 0);
            assert!(graph.edges().is_sorted_by(|a, b| a < b));
        }
    }
});
