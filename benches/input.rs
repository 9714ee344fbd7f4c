//! The graph that a benchmark is run on, with the draw that `verify` takes by default.

use anyhow::{Context, Result};
use viewcert::geometry::draw::DrawKey;
use viewcert::graph::{Graph, core_sha256, sha256};
use viewcert_formats::{ReadOptions, read_graphs};

/// The first graph of a file, and the key of its first draw.
pub fn graph_and_key(path: &str) -> Result<(Graph, DrawKey)> {
    let input = read_graphs(path, &ReadOptions::default())
        .next()
        .context("no graph")??;
    let nodes: Vec<u32> = (0..input.graph.nodes() as u32).collect();
    let key = DrawKey {
        graph_sha256: sha256(&input.graph),
        core_sha256: Some(core_sha256(&nodes, &input.graph)),
        seed: 1,
        draw: 0,
    };
    Ok((input.graph, key))
}
