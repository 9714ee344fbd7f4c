//! Rulings on claims.

use super::json::{GraphLine, write_line};
use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;
use viewcert::decide::Verdict;
use viewcert::wording::printable;
use viewcert_audit::claims::Ruling;
use viewcert_formats::NamedGraph;

/// The ruling on one row.
#[derive(Clone, Debug)]
pub struct Ruled {
    /// The row, from 1.
    pub number: usize,
    /// Its line in the table, from 1.
    pub line: usize,
    /// What was found.
    pub ruling: Ruling,
    /// The graph.
    pub input: NamedGraph,
    /// Its exact verdict.
    pub exact: Verdict,
    /// The certificate, where one was written.
    pub certificate: Option<PathBuf>,
}

/// Writes one line.
///
/// # Errors
/// Those of the writer.
pub fn text(out: &mut impl Write, ruled: &Ruled) -> io::Result<()> {
    write!(out, "row {:4}  {:13}", ruled.number, ruled.ruling.word())?;
    let (input, exact) = (&ruled.input, &ruled.exact);
    write!(
        out,
        "  {}: {} ({}), components {}, rank {}",
        input.name,
        exact.value.name(),
        exact.value_claim().strength.name(),
        exact.components.len(),
        exact.rank
    )?;
    match &ruled.ruling {
        Ruling::Confirmed => writeln!(out)?,
        other => writeln!(out, "; {}", other.reasons())?,
    }
    if let Some(path) = &ruled.certificate {
        writeln!(
            out,
            "          certificate {}",
            printable(&path.display().to_string())
        )?;
    }
    Ok(())
}

#[derive(Serialize)]
struct Json<'a> {
    row: usize,
    line: usize,
    ruling: &'static str,
    reason: String,
    graph: GraphLine<'a>,
    verdict: &'static str,
    strength: &'static str,
    components: usize,
    rank: usize,
    certificate: Option<String>,
}

/// Writes one line of JSON.
///
/// # Errors
/// Those of the writer.
pub fn json(out: &mut impl Write, ruled: &Ruled) -> io::Result<()> {
    let (input, exact) = (&ruled.input, &ruled.exact);
    let line = Json {
        row: ruled.number,
        line: ruled.line,
        ruling: ruled.ruling.name(),
        reason: ruled.ruling.reasons(),
        graph: GraphLine::new(input, exact),
        verdict: exact.value.name(),
        strength: exact.value_claim().strength.name(),
        components: exact.components.len(),
        rank: exact.rank,
        certificate: ruled
            .certificate
            .as_ref()
            .map(|path| path.display().to_string()),
    };
    write_line(out, "ruling", &line)
}
