//! Exact and float side by side.

use super::json::{GraphLine, write_line};
use super::read::ReadLine;
use super::{counted, size};
use serde::Serialize;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::decide::Verdict;
use viewcert::wording::printable;
use viewcert_audit::FloatVerdict;
use viewcert_audit::beside::Beside;
use viewcert_formats::NamedGraph;

/// Both sides of one graph.
#[derive(Clone, Debug)]
pub struct Audit<'a> {
    /// The graph.
    pub input: &'a NamedGraph,
    /// The exact side.
    pub exact: &'a Verdict,
    /// Its time.
    pub exact_time: Duration,
    /// The tolerance of the float side.
    pub tolerance: f64,
    /// The float side.
    pub float: Beside,
}

impl Audit<'_> {
    /// The margin in decades; `None` if it is not a number.
    fn margin(&self) -> Option<f64> {
        let margin = self.float.outcome.margin(self.tolerance);
        (!margin.is_nan()).then_some(margin)
    }

    /// Why the sides do not agree, as far as it is known; `None` if they do.
    fn reason(&self) -> Option<String> {
        if self.float.agrees {
            return None;
        }
        if self.float.components.is_none() {
            return Some("floating point gave no number".into());
        }
        if self.float.misjudged > 0 {
            return Some(format!(
                "the smallest eigenvalue is on the wrong side of the tolerance at {} of {}",
                self.float.misjudged,
                counted(self.float.draws, "draw")
            ));
        }
        Some(
            "the components differ: the published method takes pairs that always move as one for a component \
             (docs/theory.md, Example 6.2), and rounds"
                .into(),
        )
    }
}

/// Writes a few lines.
///
/// # Errors
/// Those of the writer.
pub fn text(out: &mut impl Write, audit: &Audit) -> io::Result<()> {
    let graph = &audit.input.graph;
    let exact = audit.exact;
    writeln!(out, "{}", printable(&audit.input.name))?;
    writeln!(out, "  read as     {}", audit.input.read)?;
    writeln!(out, "  graph       {}", size(graph))?;
    for note in &audit.input.notes {
        writeln!(out, "  note        {note}")?;
    }
    writeln!(
        out,
        "  exact       {} ({}), components {}, {:.3} s",
        exact.value.name(),
        exact.value_claim().strength.name(),
        exact.components.len(),
        audit.exact_time.as_secs_f64()
    )?;
    in_doubles(out, audit)?;
    if audit.float.draws > 1 {
        writeln!(
            out,
            "  draws       {} of {} misjudged ({:.2} %)",
            audit.float.misjudged,
            audit.float.draws,
            100.0 * audit.float.misjudged as f64 / audit.float.draws as f64
        )?;
    }
    let result = match (audit.float.agrees, audit.float.outcome.verdict) {
        (true, _) => "agree",
        (false, FloatVerdict::Undecided) => "undecided",
        (false, _) => "DISAGREE",
    };
    writeln!(out, "  result      {result}")?;
    match audit.reason() {
        Some(reason) => writeln!(out, "  because     {reason}"),
        None => Ok(()),
    }
}

/// The lines of the float side at the first draw.
fn in_doubles(out: &mut impl Write, audit: &Audit) -> io::Result<()> {
    let outcome = &audit.float.outcome;
    let components = match audit.float.components {
        Some(count) => count.to_string(),
        None => "undecided".into(),
    };
    writeln!(
        out,
        "  float       {}, components {components}, {:.3} s",
        outcome.verdict,
        audit.float.time.as_secs_f64()
    )?;
    write!(
        out,
        "  smallest    singular value {:.3e}, eigenvalue {:.3e}; tolerance {:e}",
        outcome.smallest(),
        outcome.eigenvalue,
        audit.tolerance
    )?;
    match audit.margin() {
        Some(margin) => writeln!(out, ", margin {margin:+.1} decades")?,
        None => writeln!(out, ", no margin")?,
    }
    if let (Some(rank), Some(verdict)) = (outcome.matlab_rank, outcome.by_rank()) {
        let columns = outcome.columns;
        writeln!(out, "  MATLAB rank {rank} of {columns}: {verdict}")?;
    }
    Ok(())
}

#[derive(Serialize)]
struct Json<'a> {
    graph: GraphLine<'a>,
    read: ReadLine<'a>,
    notes: &'a [String],
    exact: Side,
    float: Float,
    agree: bool,
    draws: usize,
    misjudged: usize,
    reason: Option<String>,
}

#[derive(Serialize)]
struct Side {
    verdict: &'static str,
    strength: &'static str,
    components: usize,
    seconds: f64,
}

#[derive(Serialize)]
struct Float {
    verdict: &'static str,
    method: &'static str,
    tolerance: f64,
    smallest_singular_value: f64,
    smallest_eigenvalue: f64,
    margin_decades: Option<f64>,
    matlab_rank: Option<usize>,
    matlab_verdict: Option<&'static str>,
    columns: usize,
    components: Option<usize>,
    seconds: f64,
}

/// Writes one line of JSON; numbers that are none become `null`.
///
/// # Errors
/// Those of the writer.
pub fn json(out: &mut impl Write, audit: &Audit) -> io::Result<()> {
    let outcome = &audit.float.outcome;
    let line = Json {
        graph: GraphLine::new(audit.input, audit.exact),
        read: ReadLine::from(&audit.input.read),
        notes: &audit.input.notes,
        exact: Side {
            verdict: audit.exact.value.name(),
            strength: audit.exact.value_claim().strength.name(),
            components: audit.exact.components.len(),
            seconds: audit.exact_time.as_secs_f64(),
        },
        float: Float {
            verdict: outcome.verdict.name(),
            method: outcome.method.name(),
            tolerance: audit.tolerance,
            smallest_singular_value: outcome.smallest(),
            smallest_eigenvalue: outcome.eigenvalue,
            margin_decades: audit.margin(),
            matlab_rank: outcome.matlab_rank,
            matlab_verdict: outcome.by_rank().map(FloatVerdict::name),
            columns: outcome.columns,
            components: audit.float.components,
            seconds: audit.float.time.as_secs_f64(),
        },
        agree: audit.float.agrees,
        draws: audit.float.draws,
        misjudged: audit.float.misjudged,
        reason: audit.reason(),
    };
    write_line(out, "audit", &line)
}
