//! Writes a certificate and has it checked by the independent checker:
//! `cargo run --example certify`.

use viewcert::{Graph, Options, decide};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let graph = Graph::new(5, [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (2, 4), (3, 4)])?;
    let verdict = decide(&graph, &Options::default())?;
    let text = verdict.certificate(&graph).named("a strip").to_string();
    let verified =
        viewcert_check::check(text.as_bytes(), None).map_err(|failure| format!("{failure:?}"))?;
    println!("{verified}");
    assert_eq!(verified.verdict.0.to_string(), verdict.value.to_string());
    Ok(())
}
