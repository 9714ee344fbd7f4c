//! The rank of the paper's whole J_P by plain dense elimination modulo 2^61 - 1: what sparse
//! elimination (`verify --no-contraction --prime`) and plane flows are compared with.
//!
//! ```text
//! cargo run --release --example dense -- GRAPH
//! ```

use anyhow::{Context, Result, bail};
use viewcert::camera::{DrawKey, cameras_mod};
use viewcert::exact::modular::eliminate_mod;
use viewcert::exact::prime::PrimeField;
use viewcert::formulation::skew;
use viewcert::graph::{ReadOptions, read_graphs, sha256};

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path] = arguments.as_slice() else {
        bail!("usage: dense GRAPH");
    };
    let input = read_graphs(path, &ReadOptions::default())
        .next()
        .context("no graph")??;
    let graph = &input.graph;
    // What `verify` takes by default.
    let key = DrawKey {
        graph_sha256: sha256(graph),
        seed: 1,
        draw: 0,
    };
    let field = PrimeField::mersenne61();
    let cameras = cameras_mod(&field, graph.nodes(), &key)?.values;
    let jacobian = skew::jacobian(&field, graph, &cameras);
    let matrix = skew::dense(&field, &jacobian, 12 * graph.nodes());
    println!("{{\"rank\":{}}}", eliminate_mod(&field, matrix).rank());
    Ok(())
}
