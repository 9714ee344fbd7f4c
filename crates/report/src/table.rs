//! The table of a catalog, in the form of the paper's Table 1 with further columns.

use std::collections::BTreeMap;
use std::io::{self, Write};
use viewcert_catalog::mine::Summary;

/// One source of candidates.
#[derive(Clone, Debug)]
pub struct Row {
    /// What it is called.
    pub name: String,
    /// Its counts.
    pub summary: Summary,
    /// How many graphs have each number of solutions, or bounds for it; empty if these were not
    /// counted.
    pub solutions: BTreeMap<String, u64>,
    /// How long it took.
    pub seconds: Option<f64>,
}

/// Writes the table, and under it the numbers of solutions where they were counted.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut impl Write, rows: &[Row]) -> io::Result<()> {
    let width = rows.iter().map(|row| row.name.len()).max().unwrap_or(0);
    writeln!(
        out,
        "{:width$}  candidates  fin_solv  contract  proved negative  by a hub  unproved  \
         rank proved  seconds",
        ""
    )?;
    for Row {
        name,
        summary,
        seconds,
        ..
    } in rows
    {
        let seconds = seconds.map_or(String::new(), |seconds| format!("{seconds:.2}"));
        writeln!(
            out,
            "{name:width$}  {:>10}  {:>8}  {:>8}  {:>15}  {:>8}  {:>8}  {:>11}  {seconds:>7}",
            summary.candidates,
            summary.finite_solvable(),
            summary.unique,
            summary.refuted,
            summary.hub,
            summary.unproved,
            summary.rank_proved,
        )?;
    }
    for row in rows.iter().filter(|row| !row.solutions.is_empty()) {
        let each = row.solutions.iter();
        let each = each.map(|(solutions, graphs)| format!("{solutions}: {graphs}"));
        let each = each.collect::<Vec<_>>().join(", ");
        writeln!(out, "{}: solutions: graphs  {each}", row.name)?;
    }
    Ok(())
}
