//! How many multiply-adds modulo p the plane flows of a graph cost, and how many the paper's
//! Jacobian: what to divide by the rates of the example `rate`.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example operations -- GRAPH
//! ```
//!
//! Counted is what runs dense: the end of the elimination of N, the plane flows from it, the
//! elimination of Lambda. The sparse part of N is not counted, and neither are components and
//! certificate.

mod input;

use anyhow::{Context, Result};
use viewcert::geometry::draw::centres_mod;
use viewcert::geometry::plane_flow::{PlaneFlows, rigidity_rows};
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::sparse_lu::Factorisation;
use viewcert::watch::unwatched;

fn main() -> Result<()> {
    let path = std::env::args().nth(1).context("usage: operations GRAPH")?;
    let (graph, key) = &input::graph_and_key(&path)?;
    let (nodes, edges) = (graph.nodes(), graph.edges().len());
    let field = PrimeField::mersenne61();
    let centres = centres_mod(&field, nodes, key)?.values;

    let rigidity = rigidity_rows(&field, graph, &centres);
    let done = unwatched(|task| Factorisation::new(&field, rigidity, 3 * nodes, task));
    let (rows, cols) = done.dense_size();
    let free = done.free_rows().len();
    // Free rows of the sparse part are zero rows: what is not a pivot lies in the dense part.
    let rank = rows.saturating_sub(free);
    let of_rigidity = elimination(rows, cols, rank);

    let flows = unwatched(|task| PlaneFlows::new(&field, graph, &centres, task));
    let lambda = unwatched(|task| flows.lambda(key.flow_weights(&field), task));
    let count = flows.rank(&lambda).flows;
    let of_flows = count as f64 * rank as f64 * (free as f64 + rank as f64 / 2.0);
    let cotree = edges + 1 - nodes;
    let of_lambda = elimination(4 * count, cotree, lambda.rank());
    let of_jacobian = elimination(10 * edges, 12 * nodes, 11 * nodes - 15);

    println!("{nodes} cameras, {edges} pairs");
    println!("N, dense part   {rows} x {cols} of rank {rank}: {of_rigidity:.3e} multiply-adds");
    println!("flows           {count} of {free}: {of_flows:.3e}");
    println!(
        "Lambda          {} x {cotree} of rank {}: {of_lambda:.3e}",
        4 * count,
        lambda.rank()
    );
    println!("together        {:.3e}", of_rigidity + of_flows + of_lambda);
    println!("J_P, dense      {of_jacobian:.3e}");
    Ok(())
}

/// Multiply-adds of a dense elimination.
fn elimination(rows: usize, cols: usize, rank: usize) -> f64 {
    (1..=rank)
        .map(|k| (rows - k) as f64 * (cols - k) as f64)
        .sum()
}
