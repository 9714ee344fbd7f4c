//! Floating point and claims of others beside the exact answer, in words and as JSON.

use super::json::{GraphLine, write_line};
use super::read::ReadLine;
use super::{at_cameras, counted, size, text};
use serde_json::json;
use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Duration;
use viewcert::at_cameras::Here;
use viewcert::certificate::hex;
use viewcert::decide::Verdict;
use viewcert::wording::printable;
use viewcert_audit::at_cameras::FloatClaim;
use viewcert_audit::claims::Ruling;
use viewcert_audit::enclosure::{Enclosure, Matrix};
use viewcert_audit::{Beside, FloatVerdict};
use viewcert_formats::NamedGraph;

/// The lines that say what graph it is and how it was read.
///
/// # Errors
/// Those of the writer.
pub fn head(out: &mut impl Write, input: &NamedGraph) -> io::Result<()> {
    writeln!(out, "{}", printable(&input.name))?;
    writeln!(out, "  read as     {}", input.read)?;
    writeln!(out, "  graph       {}", size(&input.graph))?;
    let mut notes = input.notes.iter();
    notes.try_for_each(|note| writeln!(out, "  note        {note}"))
}

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
    /// Why the sides do not agree, as far as it is known; `None` if they do.
    fn reason(&self) -> Option<String> {
        let Beside {
            misjudged, draws, ..
        } = self.float;
        match self.float.components {
            _ if self.float.agrees => None,
            None => Some("floating point gave no number".into()),
            _ if misjudged > 0 => Some(format!(
                "the smallest eigenvalue is on the wrong side of the tolerance at {misjudged} of {}",
                counted(draws, "draw")
            )),
            _ => Some(
                "the components differ: the published method takes pairs that always move as one for a component \
                 (docs/theory.md, Example 6.2), and rounds"
                    .into(),
            ),
        }
    }

    /// Writes a few lines.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let (exact, float, tolerance) = (self.exact, &self.float, self.tolerance);
        let outcome = &float.outcome;
        head(out, self.input)?;
        writeln!(
            out,
            "  exact       {} ({}), components {}, {:.3} s",
            exact.value.name(),
            exact.value_claim().strength.name(),
            exact.components.len(),
            self.exact_time.as_secs_f64()
        )?;
        let components = float.components.map(|count| count.to_string());
        writeln!(
            out,
            "  float       {}, components {}, {:.3} s",
            outcome.verdict.name(),
            components.as_deref().unwrap_or("undecided"),
            float.time.as_secs_f64()
        )?;
        write!(
            out,
            "  smallest    singular value {:.3e}, eigenvalue {:.3e}; tolerance {tolerance:e}",
            outcome.smallest,
            outcome.eigenvalue()
        )?;
        match outcome.margin(tolerance) {
            margin if margin.is_nan() => writeln!(out, ", no margin")?,
            margin => writeln!(out, ", margin {margin:+.1} decades")?,
        }
        if float.draws > 1 {
            let percent = 100.0 * float.misjudged as f64 / float.draws as f64;
            let (wrong, draws) = (float.misjudged, float.draws);
            writeln!(
                out,
                "  draws       {wrong} of {draws} misjudged ({percent:.2} %)"
            )?;
        }
        let result = match (float.agrees, outcome.verdict) {
            (true, _) => "agree",
            (false, FloatVerdict::Undecided) => "undecided",
            (false, _) => "DISAGREE",
        };
        writeln!(out, "  result      {result}")?;
        let mut reason = self.reason().into_iter();
        reason.try_for_each(|reason| writeln!(out, "  because     {reason}"))
    }

    /// Writes one line of JSON; numbers that are none become `null`.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let (exact, float) = (self.exact, &self.float);
        let outcome = &float.outcome;
        let line = json!({
            "graph": GraphLine::new(self.input, exact),
            "read": ReadLine::from(&self.input.read),
            "notes": self.input.notes,
            "prime": exact.prime(),
            "exact": {
                "verdict": exact.value.name(),
                "strength": exact.value_claim().strength.name(),
                "components": exact.components.len(),
                "seconds": self.exact_time.as_secs_f64(),
            },
            "float": {
                "verdict": outcome.verdict.name(),
                "tolerance": self.tolerance,
                "smallest_singular_value": outcome.smallest,
                "smallest_eigenvalue": outcome.eigenvalue(),
                "margin_decades": outcome.margin(self.tolerance),
                "components": float.components,
                "seconds": float.time.as_secs_f64(),
            },
            "agree": float.agrees,
            "draws": float.draws,
            "misjudged": float.misjudged,
            "reason": self.reason(),
        });
        write_line(out, "audit", Some(exact.seed), &line)
    }
}

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

impl Ruled {
    /// Writes one line.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let exact = &self.exact;
        write!(
            out,
            "row {:4}  {:13}  {}: {} ({}), components {}, rank {}",
            self.number,
            word(&self.ruling),
            printable(&self.input.name),
            exact.value.name(),
            exact.value_claim().strength.name(),
            exact.components.len(),
            exact.rank
        )?;
        because(out, &self.ruling)?;
        let path = self
            .certificate
            .iter()
            .map(|path| path.display().to_string());
        let mut path = path.map(|path| printable(&path));
        path.try_for_each(|path| writeln!(out, "          certificate {path}"))
    }

    /// Writes one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let exact = &self.exact;
        let line = json!({
            "row": self.number,
            "line": self.line,
            "ruling": self.ruling.said().0,
            "reason": self.ruling.said().1,
            "graph": GraphLine::new(&self.input, exact),
            "read": ReadLine::from(&self.input.read),
            "model": exact.model.name(),
            "verdict": exact.value.name(),
            "strength": exact.value_claim().strength.name(),
            "components": exact.components.len(),
            "rank": exact.rank,
            "prime": exact.prime(),
            "certificate": self.certificate.as_ref().map(|path| path.display().to_string()),
        });
        write_line(out, "ruling", Some(exact.seed), &line)
    }
}

/// The name of a ruling; a refutation has to be seen.
fn word(ruling: &Ruling) -> &'static str {
    match ruling {
        Ruling::Refuted(_) => "REFUTED",
        other => other.said().0,
    }
}

/// Ends a line with what speaks against a claim.
fn because(out: &mut impl Write, ruling: &Ruling) -> io::Result<()> {
    match ruling.said().1 {
        "" => writeln!(out),
        why => writeln!(out, "; {}", printable(why)),
    }
}

/// What is so at given cameras, for one row of what floating point found there, or for none.
#[derive(Clone, Copy, Debug)]
pub struct AtCameras<'a> {
    /// The graph.
    pub input: &'a NamedGraph,
    /// What is so at the cameras.
    pub here: &'a Here,
    /// The singular value, where one is asked for.
    pub sigma: Option<&'a (Matrix, Enclosure)>,
    /// The row, with its number from 1, and the ruling on it.
    pub ruled: Option<(usize, &'a FloatClaim, &'a Ruling)>,
}

impl AtCameras<'_> {
    /// Writes a line or two.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let (here, is_ruled) = (self.here, self.ruled.is_some());
        match self.ruled {
            Some((row, claim, ruling)) => {
                let name = claim
                    .name
                    .as_ref()
                    .map(|name| format!("{}: ", printable(name)));
                let name = name.unwrap_or_default();
                write!(out, "row {row:4}  {:13}  {name}", word(ruling))?;
            }
            None => write!(out, "  at cameras  ")?,
        }
        let strength = text::strength(here.rank.strength);
        write!(
            out,
            "{} ({strength}), {}, rank {} of {}",
            at_cameras::answer(here, &self.input.graph, None),
            counted(here.components.value.len(), "component"),
            here.rank.value,
            here.required
        )?;
        because(
            out,
            self.ruled.map_or(&Ruling::Confirmed, |(.., ruling)| ruling),
        )?;
        let Some((matrix, found)) = self.sigma else {
            return Ok(());
        };
        let ([least, most], name) = (found.decimals(), matrix.name());
        let place = matrix.place(self.input.graph.nodes());
        let behind = if is_ruled { "          " } else { "  " };
        let what = format!("{name}, number {place} from below ({strength})");
        writeln!(out, "{behind}sigma       {least} to {most}: {what}")
    }

    /// Writes one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let here = self.here;
        let sigma = self.sigma.map(|(matrix, found)| {
            let [least, most] = found.decimals();
            let place = matrix.place(self.input.graph.nodes());
            json!({ "matrix": matrix.name(), "place": place, "least": least, "most": most })
        });
        let line = json!({
            "row": self.ruled.map(|(row, ..)| row),
            "line": self.ruled.map(|(_, claim, _)| claim.line),
            "name": self.ruled.and_then(|(_, claim, _)| claim.name.as_deref()),
            "ruling": self.ruled.map(|(.., ruling)| ruling.said().0),
            "reason": self.ruled.map(|(.., ruling)| ruling.said().1),
            "graph": GraphLine::of(self.input),
            "read": ReadLine::from(&self.input.read),
            "model": here.model.name(),
            "verdict": if here.is_determined() { "determined" } else { "not-determined" },
            "strength": here.rank.strength.name(),
            "error_log2": here.rank.strength.error_log2(),
            "rank": here.rank.value,
            "rank_required": here.required,
            "components": here.components.value.len(),
            "sigma": sigma,
            "centres_sha256": hex(&here.sha256),
            "notes": self.input.notes,
        });
        write_line(out, "float_ruling", None, &line)
    }
}
