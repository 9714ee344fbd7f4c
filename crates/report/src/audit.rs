//! Floating point and claims of others beside the exact answer, in words and as JSON.

use super::json::{GraphLine, joined, write_line};
use super::{at_cameras, counted, head, text};
use serde_json::json;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::Model;
use viewcert::at_cameras::Here;
use viewcert::certificate::hex;
use viewcert::decide::{Strength, Verdict};
use viewcert::wording::printable;
use viewcert_audit::claims::{Claim, Ruling};
use viewcert_audit::enclosure::{Enclosure, Matrix};
use viewcert_audit::{Beside, FloatVerdict};
use viewcert_formats::NamedGraph;

/// Why numbers of components differ.
const DIFFER: &str = "the components differ: the published method takes pairs that always move as one for a component \
                      (docs/theory.md, Example 6.2), and rounds";

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
        let draws = counted(draws, "draw");
        match self.float.components {
            _ if self.float.agrees => None,
            None => Some("floating point gave no number".into()),
            _ if misjudged > 0 => Some(format!(
                "the smallest eigenvalue is on the wrong side of the tolerance at {misjudged} of {draws}"
            )),
            _ => Some(DIFFER.into()),
        }
    }

    /// Writes a few lines, or one of JSON, where numbers that are none become `null`.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write, json: bool) -> io::Result<()> {
        match json {
            true => self.write_json(out),
            false => self.write_text(out),
        }
    }

    fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let (exact, float, tolerance) = (self.exact, &self.float, self.tolerance);
        let outcome = &float.outcome;
        head(out, self.input)?;
        let (value, strength) = (exact.value.name(), exact.value_claim().strength.name());
        let (parts, time) = (exact.components.len(), self.exact_time.as_secs_f64());
        writeln!(
            out,
            "  exact       {value} ({strength}), components {parts}, {time:.3} s"
        )?;
        let (value, time) = (outcome.verdict.name(), float.time.as_secs_f64());
        let parts = float.components.map(|count| count.to_string());
        let parts = parts.unwrap_or_else(|| "undecided".to_owned());
        writeln!(
            out,
            "  float       {value}, components {parts}, {time:.3} s"
        )?;
        let margin = match outcome.margin(tolerance) {
            margin if margin.is_nan() => "no margin".to_owned(),
            margin => format!("margin {margin:+.1} decades"),
        };
        let (sigma, eigenvalue) = (outcome.smallest, outcome.eigenvalue());
        writeln!(
            out,
            "  smallest    singular value {sigma:.3e}, eigenvalue {eigenvalue:.3e}; tolerance {tolerance:e}, {margin}"
        )?;
        if float.draws > 1 {
            let (wrong, draws) = (float.misjudged, float.draws);
            let percent = 100.0 * wrong as f64 / draws as f64;
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

    fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let (exact, float) = (self.exact, &self.float);
        let outcome = &float.outcome;
        let line = json!({
            "graph": GraphLine::new(self.input, exact),
            "read": self.input.read,
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

/// What is so of a graph, or at cameras, and what that makes of a row.
#[derive(Clone, Copy, Debug)]
pub struct Ruled<'a> {
    /// The row, with its number from 1, and the ruling on it; nothing where there is no table.
    pub row: Option<(usize, &'a Claim, &'a Ruling)>,
    /// The graph.
    pub input: &'a NamedGraph,
    /// What is so.
    pub found: Found<'a>,
}

/// What is so.
#[derive(Clone, Copy, Debug)]
pub enum Found<'a> {
    /// Of the graph.
    Generic(&'a Verdict),
    /// At given cameras, with a singular value where one is asked for.
    AtCameras(&'a Here, Option<&'a (Matrix, Enclosure)>),
}

impl Ruled<'_> {
    /// Writes a line or two, or one of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write, json: bool) -> io::Result<()> {
        match json {
            true => self.write_json(out),
            false => self.write_text(out),
        }
    }

    /// The model, the strength, and the numbers of components, the rank and what it has to be.
    fn is(&self) -> (Model, Strength, [usize; 3]) {
        match self.found {
            Found::Generic(exact) => {
                let counts = [exact.components.len(), exact.rank, exact.required];
                (exact.model, exact.value_claim().strength, counts)
            }
            Found::AtCameras(here, _) => {
                let counts = [here.components.value.len(), here.rank.value, here.required];
                (here.model, here.rank.strength, counts)
            }
        }
    }

    fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let (graph, row) = (&self.input.graph, self.row);
        let name = row.and_then(|(_, claim, _)| claim.name.as_deref());
        let (_, strength, [parts, rank, required]) = self.is();
        let (name, is) = match self.found {
            Found::Generic(exact) => (Some(&*self.input.name), exact.value.name().to_owned()),
            Found::AtCameras(here, _) => (name, at_cameras::answer(here, graph, None)),
        };
        let ruling = row.map(|(_, _, ruling)| ruling.said());
        match (row, ruling) {
            (Some((row, ..)), Some((word, _))) => {
                // A refutation has to be seen.
                let word = word.replace("refuted", "REFUTED");
                let name = name.map(|name| format!("{}: ", printable(name)));
                write!(out, "row {row:4}  {word:13}  {}", name.unwrap_or_default())?;
            }
            _ => write!(out, "  at cameras  ")?,
        }
        let (strength, parts) = (text::strength(strength), counted(parts, "component"));
        write!(out, "{is} ({strength}), {parts}, rank {rank} of {required}")?;
        match ruling {
            None | Some((_, "")) => writeln!(out)?,
            Some((_, why)) => writeln!(out, "; {}", printable(why))?,
        }
        let Found::AtCameras(_, Some((matrix, found))) = self.found else {
            return Ok(());
        };
        let ([least, most], place) = (found.decimals(), matrix.place(graph.nodes()));
        let (behind, name) = (if row.is_some() { 10 } else { 2 }, matrix.name());
        let what = format!("{name}, number {place} from below ({strength})");
        writeln!(out, "{:behind$}sigma       {least} to {most}: {what}", "")
    }

    fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let (row, (model, strength, [components, rank, required])) = (self.row, self.is());
        let line = json!({
            "row": row.map(|(row, ..)| row),
            "line": row.map(|(_, claim, _)| claim.line),
            "name": row.and_then(|(_, claim, _)| claim.name.as_deref()),
            "ruling": row.map(|(.., ruling)| ruling.said().0),
            "reason": row.map(|(.., ruling)| ruling.said().1),
            "graph": GraphLine::of(self.input),
            "read": self.input.read,
            "notes": self.input.notes,
            "model": model.name(),
            "strength": strength.name(),
            "components": components,
            "rank": rank,
            "rank_required": required,
        });
        let (found, seed) = match self.found {
            Found::Generic(exact) => {
                let found = json!({ "verdict": exact.value.name(), "prime": exact.prime() });
                (found, Some(exact.seed))
            }
            Found::AtCameras(here, sigma) => {
                let sigma = sigma.map(|(matrix, found)| {
                    let ([least, most], place) =
                        (found.decimals(), matrix.place(self.input.graph.nodes()));
                    json!({ "matrix": matrix.name(), "place": place, "least": least, "most": most })
                });
                let found = json!({
                    "verdict": if here.is_determined() { "determined" } else { "not-determined" },
                    "error_log2": strength.error_log2(),
                    "sigma": sigma,
                    "centres_sha256": hex(&here.sha256),
                });
                (found, None)
            }
        };
        write_line(out, "ruling", seed, &joined(line, &found))
    }
}
