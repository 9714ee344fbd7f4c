//! Writes a matrix that the program eliminates, for others to eliminate: the same cameras,
//! the same entries.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example matrix -- residues|integers|rigidity GRAPH
//! ```
//!
//! `residues`: J_P at general cameras modulo 2^61 - 1, as of `verify --method matrix --prime`.
//! `integers`: J_P at rational cameras, rows divided by their content, as of `verify
//! --method matrix --rational`. `rigidity`: N at the centres of the default mode, modulo
//! 2^61 - 1; these are those of the program where contraction leaves the graph as it is.
//!
//! The first line of the output is `ROWS COLS MODULUS`, the modulus being 0 for integers; then
//! come the non-zero entries, a line `ROW COL VALUE` each, counted from 0.

mod input;

use anyhow::{Result, bail};
use std::fmt::Display;
use std::io::{self, BufWriter, Write};
use viewcert::geometry::draw::{cameras_mod, cameras_rational, centres_mod};
use viewcert::geometry::{jacobian, plane_flow};
use viewcert::linalg::integer::{Integers, content};
use viewcert::linalg::prime::PrimeField;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, path] = arguments.as_slice() else {
        bail!("usage: matrix residues|integers|rigidity GRAPH");
    };
    let (graph, key) = &input::graph_and_key(path)?;
    let field = PrimeField::mersenne61();
    let out = &mut BufWriter::new(io::stdout().lock());
    let cols = 12 * graph.nodes();
    match kind.as_str() {
        "residues" => {
            let cameras = cameras_mod(&field, graph.nodes(), key)?.values;
            let rows = jacobian::jacobian(&field, graph, &cameras);
            write(out, &rows, cols, field.modulus(), |&x| field.to_u64(x))?;
        }
        "integers" => {
            let cameras = cameras_rational(graph.nodes(), 9, 4, key)?.values;
            let mut rows = jacobian::jacobian(&Integers, graph, &cameras);
            for row in &mut rows {
                let content = content(row.iter().map(|(_, x)| x));
                for (_, x) in row {
                    *x /= &content;
                }
            }
            write(out, &rows, cols, 0, Clone::clone)?;
        }
        "rigidity" => {
            let centres = centres_mod(&field, graph.nodes(), key)?.values;
            let rows = plane_flow::rigidity_rows(&field, graph, &centres);
            let cols = 3 * graph.nodes();
            write(out, &rows, cols, field.modulus(), |&x| field.to_u64(x))?;
        }
        _ => bail!("{kind}: not residues, integers or rigidity"),
    }
    Ok(out.flush()?)
}

fn write<E, T: Display>(
    out: &mut impl Write,
    rows: &[Vec<(usize, E)>],
    cols: usize,
    modulus: u64,
    value: impl Fn(&E) -> T,
) -> io::Result<()> {
    writeln!(out, "{} {cols} {modulus}", rows.len())?;
    for (at, row) in rows.iter().enumerate() {
        for (col, entry) in row {
            writeln!(out, "{at} {col} {}", value(entry))?;
        }
    }
    Ok(())
}
