//! Decides a graph: `cargo run --example decide`.

use viewcert::{Graph, Options, Value, decide};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let graph = Graph::new(4, [(0, 1), (1, 2), (2, 3), (3, 0)])?;
    let verdict = decide(&graph, &Options::default())?;
    assert_eq!(verdict.value, Value::NotFiniteSolvable);
    assert_eq!((verdict.rank, verdict.required), (28, 29));
    // not-finite-solvable (proof): rank 28 (proof) of 29
    let (answer, rank) = (verdict.value_claim(), verdict.rank_claim());
    println!("{answer}: rank {rank} of {}", verdict.required);
    Ok(())
}
