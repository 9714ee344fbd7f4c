//! Writes a certificate and has it checked by the independent checker:
//! `cargo run --example certify`.

use viewcert::certificate::{self, Layout};
use viewcert::{Graph, Options, decide};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let graph = Graph::new(5, [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (2, 4), (3, 4)])?;
    let verdict = decide(&graph, &Options::default())?;
    let mut text = Vec::new();
    certificate::write(&mut text, "a strip", &graph, &verdict, true, Layout::Lines)?;
    let verified = viewcert_check::check(&text, None).map_err(|failure| format!("{failure:?}"))?;
    println!("{verified}");
    assert_eq!(verified.verdict.0.to_string(), verdict.value.name());
    Ok(())
}
