//! Reads viewing graphs and prints how large they are: the yardstick for how long deciding
//! and certifying may take.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example read_only -- GRAPH...
//! ```

use std::process::ExitCode;
use viewcert_formats::{ReadOptions, read_graphs};

fn main() -> ExitCode {
    for path in std::env::args().skip(1) {
        for input in read_graphs(&path, &ReadOptions::default()) {
            match input {
                Ok(input) => {
                    let (nodes, edges) = (input.graph.nodes(), input.graph.edges().len());
                    println!("{} {nodes} {edges}", input.name);
                }
                Err(error) => {
                    eprintln!("read_only: {error}");
                    return ExitCode::from(2);
                }
            }
        }
    }
    ExitCode::SUCCESS
}
