//! The rank of the paper's whole J_P by plain dense elimination modulo 2^61 - 1: what sparse
//! elimination (`verify --method matrix --prime`) and plane flows are compared with.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example dense -- GRAPH
//! ```

mod input;

use anyhow::{Result, bail};
use viewcert::geometry::draw::cameras_mod;
use viewcert::geometry::jacobian;
use viewcert::linalg::dense_lu::eliminate_mod;
use viewcert::linalg::prime::PrimeField;
use viewcert::watch::unwatched;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path] = arguments.as_slice() else {
        bail!("usage: dense GRAPH");
    };
    let (graph, key) = &input::graph_and_key(path)?;
    let field = PrimeField::mersenne61();
    let cameras = cameras_mod(&field, graph.nodes(), key)?.values;
    let jacobian = jacobian::jacobian(&field, graph, &cameras);
    let matrix = jacobian::dense(&field, &jacobian, 12 * graph.nodes());
    let done = unwatched(|task| eliminate_mod(&field, matrix, task));
    println!("{{\"rank\":{}}}", done.rank());
    Ok(())
}
