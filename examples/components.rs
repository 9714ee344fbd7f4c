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
            let nodes = part.nodes();
            let names: Vec<_> = nodes.iter().map(|&v| input.labels.label(v)).collect();
            println!("  {} ({} pairs)", names.join(" "), part.edge_count());
            for (i, j) in part.edges(&input.graph) {
                println!(
                    "    {} - {}",
                    input.labels.display(i),
                    input.labels.display(j)
                );
            }
        }
    }
    Ok(())
}
