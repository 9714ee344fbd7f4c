//! Reads a file and walks through the parts that its pairs determine:
//! `cargo run --example components [FILE]`.

use viewcert::{Options, decide};
use viewcert_formats::{ReadOptions, read_graphs};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1);
    let path = path.as_deref().unwrap_or("examples/house.txt");
    for input in read_graphs(path, &ReadOptions::default()) {
        let input = input?;
        let verdict = decide(&input.graph, &Options::default())?;
        println!("{}: {}", input.name, verdict.value);
        for part in &verdict.components {
            let pairs = verdict.component_edges(&input.graph, part);
            let label = |node| input.labels.label(node);
            let names: Vec<_> = verdict
                .component_nodes(part)
                .into_iter()
                .map(label)
                .collect();
            println!("  {} ({} pairs)", names.join(" "), pairs.len());
        }
    }
    Ok(())
}
