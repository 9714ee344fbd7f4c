//! Contracts graphs in the calibrated model, without deciding what is left, and prints how many
//! bodies and loose edges that is.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example contraction -- GRAPH...
//! ```

use std::process::ExitCode;
use viewcert::Model;
use viewcert::contract::Contraction;
use viewcert_formats::{ReadOptions, read_graphs};

fn main() -> ExitCode {
    for path in std::env::args().skip(1) {
        for input in read_graphs(&path, &ReadOptions::default()) {
            match input {
                Ok(input) => {
                    let found = Contraction::new(&input.graph, Model::Calibrated);
                    let (bodies, loose) = (found.finals.len(), found.loose.len());
                    println!("{} {bodies} {loose}", input.name);
                }
                Err(error) => {
                    eprintln!("contraction: {error}");
                    return ExitCode::from(2);
                }
            }
        }
    }
    ExitCode::SUCCESS
}
