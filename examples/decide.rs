//! Decides a graph: `cargo run --example decide`.

use viewcert::{Graph, Options, Value, decide};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let graph = Graph::new(4, [(0, 1), (1, 2), (2, 3), (3, 0)])?;
    let verdict = decide(&graph, &Options::default())?;
    assert_eq!(verdict.value, Value::NotFiniteSolvable);
    assert_eq!((verdict.rank, verdict.required), (28, 29));
    println!(
        "{}: rank {} of {}",
        verdict.value, verdict.rank, verdict.required
    );
    Ok(())
}
