//! Mines a small catalog: all biconnected graphs with 8 cameras and the least number of pairs, and
//! how many of them are finite solvable. `cargo run --example mine`.

use viewcert::watch::Watch;
use viewcert::{Options, Value, decide};
use viewcert_catalog::{candidates, least_edges};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let nodes = 8;
    let graphs = candidates(nodes, least_edges(nodes), &Watch::default())?;
    let mut solvable = 0;
    for graph in &graphs {
        let verdict = decide(graph, &Options::default())?;
        solvable += usize::from(verdict.value != Value::NotFiniteSolvable);
    }
    println!("{} candidates, {solvable} finite solvable", graphs.len());
    assert_eq!((graphs.len(), solvable), (161, 36));
    Ok(())
}
