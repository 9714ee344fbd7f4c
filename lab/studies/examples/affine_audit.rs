//! How often the published test of affine solvability errs in floating point: the tables of
//! docs/audit.md. An argument is the number of draws for each graph (100).

use viewcert::graph::Graph;
use viewcert_audit::AuditError;
use viewcert_lab_studies::affine_audit::{
    Misjudged, decide, misjudged, random_laman, triangle_strip, without_an_edge,
};

const SIZES: [u32; 4] = [10, 20, 40, 80];

/// A line of a table: graphs of one kind and size, and the smallest singular values.
fn row(name: &str, graphs: &[Graph], is_solvable: bool, draws: u64) -> Result<(), AuditError> {
    let mut all = Misjudged::default();
    let mut smallest = Vec::new();
    for (seed, graph) in graphs.iter().enumerate() {
        all.add(misjudged(graph, is_solvable, seed as u64, 0..draws)?);
        for draw in 0..draws.min(20) {
            smallest.push(decide(graph, seed as u64, draw)?.smallest);
        }
    }
    smallest.sort_by(f64::total_cmp);
    println!(
        "| {name} | {} | {} | {} | {} | {:.1e} | {:.1e} |",
        graphs[0].nodes(),
        all.draws,
        all.by_tolerance,
        all.by_rank,
        smallest[0],
        smallest[smallest.len() / 2],
    );
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let draws = std::env::args().nth(1);
    let draws: u64 = draws.map_or(Ok(100), |draws| draws.parse())?;
    println!("| graphs | cameras | draws | wrong by 1e-6 | wrong by `rank` | least | median |");
    println!("|---|---:|---:|---:|---:|---:|---:|");
    for nodes in SIZES {
        let strip = [triangle_strip(nodes)];
        row("triangle strip", &strip, true, draws)?;
        let laman: Vec<Graph> = (0..10).map(|seed| random_laman(nodes, seed)).collect();
        row("ten random Laman graphs", &laman, true, draws / 10)?;
        let less: Vec<Graph> = laman.iter().map(without_an_edge).collect();
        row("the same, without an edge", &less, false, draws / 10)?;
    }
    Ok(())
}
