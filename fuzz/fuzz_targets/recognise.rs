//! Any bytes as an input of unknown format: the stream ends, every graph is one, and nothing
//! depends on how the bytes arrive.
#![no_main]

use std::io::{Cursor, Read};

use libfuzzer_sys::fuzz_target;
use viewcert_formats::read::graphs;
use viewcert_formats::ReadOptions;

/// Gives its bytes three at a time.
struct Slowly(Cursor<Vec<u8>>);

impl Read for Slowly {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let size = buffer.len().min(3);
        self.0.read(&mut buffer[..size])
    }
}

fuzz_target!(|data: &[u8]| {
    let input = Cursor::new(data.to_vec());
    let options = ReadOptions::default();
    let at_once = graphs("in".into(), input.clone(), options.clone());
    let mut slowly = graphs("in".into(), Slowly(input), options);
    for graph in at_once {
        let again = slowly.next().expect("as many graphs");
        match (graph, again) {
            (Ok(graph), Ok(again)) => {
                assert!(graph.graph.nodes() > 0);
                assert!(graph.graph.edges().is_sorted_by(|a, b| a < b));
                assert_eq!(graph, again);
            }
            (Err(error), Err(again)) => {
                assert_eq!(error.to_string(), again.to_string());
                assert!(!error.problem.remedy().is_empty());
            }
            (graph, again) => panic!("{graph:?} and {again:?}"),
        }
    }
    assert!(slowly.next().is_none());
});
