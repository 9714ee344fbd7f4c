//! Rulings on claims.

use serde::Serialize;
use std::io::{self, Write};
use std::path::PathBuf;
use viewcert::decide::Verdict;
use viewcert_formats::NamedGraph;
use viewcert_report::json::{GraphLine, write_line};
use viewcert_report::text;
use viewcert_studies::audit::claims::Ruling;

/// The ruling on one row.
#[derive(Clone, Debug)]
pub(super) struct Ruled {
    /// The row, from 1.
    pub(super) number: usize,
    /// Its line in the table, from 1.
    pub(super) line: usize,
    /// What was found.
    pub(super) ruling: Ruling,
    /// The graph.
    pub(super) input: NamedGraph,
    /// Its exact verdict.
    pub(super) exact: Verdict,
    /// The certificate, where one was written.
    pub(super) certificate: Option<PathBuf>,
}

fn word(ruling: &Ruling) -> &'static str {
    match ruling {
        Ruling::Confirmed => "confirmed",
        Ruling::Refuted(_) => "REFUTED",
        Ruling::NotDecidable(_) => "not decidable",
    }
}

fn reasons(ruling: &Ruling) -> String {
    match ruling {
        Ruling::Confirmed => String::new(),
        Ruling::Refuted(wrong) => wrong.join("; "),
        Ruling::NotDecidable(why) => why.clone(),
    }
}

/// Writes one line.
///
/// # Errors
/// Those of the writer.
pub(super) fn text(out: &mut impl Write, ruled: &Ruled) -> io::Result<()> {
    write!(out, "row {:4}  {:13}", ruled.number, word(&ruled.ruling))?;
    let (input, exact) = (&ruled.input, &ruled.exact);
    write!(
        out,
        "  {}: {} ({}), components {}, rank {}",
        input.name,
        text::value(exact.value, exact.model),
        exact.value_claim().strength.name(),
        exact.components.len(),
        exact.rank
    )?;
    match &ruled.ruling {
        Ruling::Confirmed => writeln!(out)?,
        other => writeln!(out, "; {}", reasons(other))?,
    }
    if let Some(path) = &ruled.certificate {
        writeln!(out, "          certificate {}", path.display())?;
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
pub(super) fn json(out: &mut impl Write, ruled: &Ruled) -> io::Result<()> {
    let (input, exact) = (&ruled.input, &ruled.exact);
    let line = Json {
        row: ruled.number,
        line: ruled.line,
        ruling: match &ruled.ruling {
            Ruling::Refuted(_) => "refuted",
            other => word(other),
        },
        reason: reasons(&ruled.ruling),
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
    write_line(out, &line)
}
