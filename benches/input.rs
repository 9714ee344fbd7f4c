//! The graph that a benchmark is run on, with the draw that `verify` takes by default.

use anyhow::{Context, Result};
use viewcert::camera::DrawKey;
use viewcert::graph::{Graph, ReadOptions, read_graphs, sha256};

/// The first graph of a file, and the key of its first draw.
pub fn graph_and_key(path: &str) -> Result<(Graph, DrawKey)> {
    let input = read_graphs(path, &ReadOptions::default())
        .next()
        .context("no graph")??;
    let key = DrawKey {
        graph_sha256: sha256(&input.graph),
        seed: 1,
        draw: 0,
    };
    Ok((input.graph, key))
}
