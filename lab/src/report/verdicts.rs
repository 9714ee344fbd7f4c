//! The tables of verdicts alone, and of runs that were put together.

use std::collections::BTreeMap;
use std::io::{self, Write};
use viewcert_lab_catalog::verdicts::Tally;
use viewcert_lab_catalog::{Counts, Merged};
use viewcert_report::table::{Row, write};

/// One source of candidates of which the verdicts alone were counted.
#[derive(Clone, Debug)]
pub struct VerdictRow {
    /// What it is called.
    pub name: String,
    /// Its counts.
    pub tally: Tally,
    /// How long it took.
    pub seconds: Option<f64>,
}

/// Writes the table of verdicts, the digests, and what is not proved.
///
/// # Errors
/// Those of the writer.
pub fn write_verdicts(out: &mut impl Write, rows: &[VerdictRow]) -> io::Result<()> {
    let width = rows.iter().map(|row| row.name.len()).max().unwrap_or(0);
    writeln!(
        out,
        "{:width$}  candidates  fin_solv  contract  proved negative  one block  several  \
         otherwise  unproved  seconds",
        ""
    )?;
    for VerdictRow {
        name,
        tally,
        seconds,
    } in rows
    {
        let seconds = seconds.map_or(String::new(), |seconds| format!("{seconds:.2}"));
        writeln!(
            out,
            "{name:width$}  {:>10}  {:>8}  {:>8}  {:>15}  {:>9}  {:>7}  {:>9}  {:>8}  {seconds:>7}",
            tally.candidates,
            tally.count_finite_solvable(),
            tally.unique,
            tally.refuted(),
            tally.by_one_block,
            tally.by_blocks,
            tally.otherwise,
            tally.unproved.len(),
        )?;
    }
    for VerdictRow { name, tally, .. } in rows {
        writeln!(out, "{name}: finite solvable {}", tally.finite_solvable)?;
        for graph in &tally.unproved {
            writeln!(out, "{name}: unproved {graph}")?;
        }
    }
    Ok(())
}

/// Writes the table of a run whose shards have been put together, the digest of its lines, and what
/// came of deciding graphs again; only that, if anything contradicts.
///
/// # Errors
/// Those of the writer.
pub fn write_merged(out: &mut impl Write, merged: Merged) -> io::Result<()> {
    let (name, seconds) = (merged.source, None);
    let rechecked = merged.rechecked.unwrap_or_default();
    for contradiction in &rechecked.contradictions {
        writeln!(out, "CONTRADICTED {contradiction}")?;
    }
    if !rechecked.contradictions.is_empty() {
        return Ok(());
    }
    match merged.counts {
        Counts::Entries(summary, rows) => {
            let solutions = BTreeMap::new();
            let row = Row {
                name: name.clone(),
                summary,
                solutions,
                seconds,
            };
            write(out, &[row])?;
            writeln!(out, "{name}: lines {rows}")?;
        }
        Counts::Verdicts(tally) => {
            let row = VerdictRow {
                name: name.clone(),
                tally,
                seconds,
            };
            write_verdicts(out, &[row])?;
        }
    }
    if rechecked.of > 0 {
        let (graphs, of) = (rechecked.graphs, rechecked.of);
        writeln!(out, "{name}: decided again {graphs} of {of}: all agree")?;
    }
    Ok(())
}
