//! Any bytes as a file of tracks: refused, or a graph between cameras and points in which every
//! point is seen as often as it has to be.
#![no_main]

use std::io::Cursor;

use libfuzzer_sys::fuzz_target;
use viewcert_formats::read::graphs;
use viewcert_formats::{ReadOptions, TrackOptions};

fuzz_target!(|data: &[u8]| {
    let tracks = TrackOptions {
        min_views: 2,
        ..TrackOptions::default()
    };
    let options = ReadOptions {
        tracks: Some(tracks),
        ..ReadOptions::default()
    };
    for graph in graphs("in".into(), Cursor::new(data.to_vec()), options) {
        let graph = match graph {
            Ok(graph) => graph,
            Err(error) => {
                assert!(!error.problem.remedy().is_empty());
                continue;
            }
        };
        let cameras = graph.cameras.expect("a camera-point graph");
        let mut views = vec![0; graph.graph.nodes()];
        for &(camera, point) in graph.graph.edges() {
            assert!(camera < cameras && cameras <= point);
            views[point as usize] += 1;
        }
        let points = &views[cameras as usize..];
        assert!(points.iter().all(|&count| count >= tracks.min_views));
    }
});
