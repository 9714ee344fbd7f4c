//! Floating point and claims of others beside the exact answer, in words and as JSON.

use super::json::{GraphLine, joined, write_line};
use super::{at_cameras, counted, head, text};
use serde_json::json;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::at_cameras::Here;
use viewcert::certificate::hex;
use viewcert::decide::{Value, Verdict};
use viewcert::wording::printable;
use viewcert_audit::Beside;
use viewcert_audit::claims::{Claim, Ruling};
use viewcert_audit::enclosure::{Enclosure, matrix};
use viewcert_formats::NamedGraph;

/// Why numbers of components differ.
const DIFFER: &str = "the components differ: the published method takes pairs that always move as one for a component \
                      (docs/theory.md, Example 6.2), and rounds";

/// Why the sides of a graph do not agree, as far as it is known; `None` if they do.
fn reason(float: &Beside) -> Option<String> {
    let (misjudged, draws) = (float.misjudged, counted(float.draws, "draw"));
    match float.components {
        _ if float.agrees => None,
        None => Some("floating point gave no number".into()),
        _ if misjudged > 0 => Some(format!(
            "the smallest eigenvalue is on the wrong side of the tolerance at {misjudged} of {draws}"
        )),
        _ => Some(DIFFER.into()),
    }
}

/// Writes a few lines about both sides of a graph, of which the exact one took some time; or one of JSON, where numbers that
/// are none become `null`.
///
/// # Errors
/// Those of the writer.
pub fn write_audit(
    out: &mut impl Write,
    json: bool,
    (input, exact, time): (&NamedGraph, &Verdict, Duration),
    float: &Beside,
) -> io::Result<()> {
    let (value, strength) = (exact.value.name(), exact.value_claim().strength.name());
    let (parts, time) = (exact.components.len(), time.as_secs_f64());
    let float_value = match float.is_solvable {
        Some(true) => Value::FiniteSolvable.name(),
        Some(false) => Value::NotFiniteSolvable.name(),
        None => "undecided",
    };
    let float_time = float.time.as_secs_f64();
    let (sigma, eigenvalue) = (float.smallest, float.smallest.powi(2));
    let (misjudged, draws, tolerance) = (float.misjudged, float.draws, float.tolerance);
    let (margin, reason) = ((eigenvalue / tolerance).log10(), reason(float));
    if json {
        let line = json!({
            "graph": GraphLine::new(input, exact),
            "read": input.read,
            "notes": input.notes,
            "prime": exact.prime(),
            "exact": { "verdict": value, "strength": strength, "components": parts, "seconds": time },
            "float": {
                "verdict": float_value,
                "tolerance": tolerance,
                "smallest_singular_value": sigma,
                "smallest_eigenvalue": eigenvalue,
                "margin_decades": margin,
                "components": float.components,
                "seconds": float_time,
            },
            "agree": float.agrees,
            "draws": draws,
            "misjudged": misjudged,
            "reason": reason,
        });
        return write_line(out, "audit", Some(exact.seed), &line);
    }
    head(out, input)?;
    let float_parts = float.components.map(|count| count.to_string());
    let float_parts = float_parts.unwrap_or_else(|| "undecided".to_owned());
    let result = match (float.agrees, float.is_solvable) {
        (true, _) => "agree",
        (false, None) => "undecided",
        (false, _) => "DISAGREE",
    };
    writeln!(
        out,
        "  exact       {value} ({strength}), components {parts}, {time:.3} s\n  \
               float       {float_value}, components {float_parts}, {float_time:.3} s\n  \
               smallest    singular value {sigma:.3e}, eigenvalue {eigenvalue:.3e}; tolerance {tolerance:e}, margin {margin:+.1} decades"
    )?;
    if draws > 1 {
        let percent = 100.0 * misjudged as f64 / draws as f64;
        write!(out, "  draws       {misjudged} of {draws} misjudged ")?;
        writeln!(out, "({percent:.2} %)")?;
    }
    writeln!(out, "  result      {result}")?;
    match reason {
        Some(reason) => writeln!(out, "  because     {reason}"),
        None => Ok(()),
    }
}

/// What is so.
#[derive(Clone, Copy, Debug)]
pub enum Found<'a> {
    /// Of the graph.
    Generic(&'a Verdict),
    /// At given cameras, with a singular value where one is asked for.
    AtCameras(&'a Here, Option<&'a Enclosure>),
}

/// A row with its number from 1, and the ruling on it.
pub type Row<'a> = (usize, &'a Claim, &'a Ruling);

/// Writes a line or two about what is so of a graph, or at cameras, and what that makes of a row, if there is one; or one of
/// JSON.
///
/// # Errors
/// Those of the writer.
pub fn write_ruling(
    out: &mut impl Write,
    json: bool,
    row: Option<Row<'_>>,
    input: &NamedGraph,
    found: Found<'_>,
) -> io::Result<()> {
    let (graph, claim) = (&input.graph, row.map(|(_, claim, _)| claim));
    let (number, name) = (row.map(|(number, ..)| number), claim.and_then(Claim::name));
    let ruling = row.map(|(.., ruling)| ruling.said());
    let (model, strength, [components, rank, required], sigma) = match found {
        Found::Generic(exact) => {
            let counts = [exact.components.len(), exact.rank, exact.required];
            (exact.model, exact.value_claim().strength, counts, None)
        }
        Found::AtCameras(here, sigma) => {
            let counts = [here.components.value.len(), here.rank.value, here.required];
            let sigma = sigma.map(Enclosure::decimals);
            (here.model, here.rank.strength, counts, sigma)
        }
    };
    let sigma = matrix(model, graph.nodes()).zip(sigma);
    if json {
        let line = json!({
            "row": number,
            "line": claim.map(|claim| claim.line),
            "name": name,
            "ruling": ruling.map(|(word, _)| word),
            "reason": ruling.map(|(_, why)| why),
            "graph": GraphLine::of(input),
            "read": input.read,
            "notes": input.notes,
            "model": model.name(),
            "strength": strength.name(),
            "components": components,
            "rank": rank,
            "rank_required": required,
        });
        let (answer, seed) = match found {
            Found::Generic(exact) => {
                let answer = json!({ "verdict": exact.value.name(), "prime": exact.prime() });
                (answer, Some(exact.seed))
            }
            Found::AtCameras(here, _) => {
                let sigma = sigma.map(|((matrix, _, place), [least, most])| {
                        json!({ "matrix": matrix, "place": place, "least": least, "most": most })
                    });
                let answer = json!({
                    "verdict": if here.is_determined() { "determined" } else { "not-determined" },
                    "error_log2": strength.error_log2(),
                    "sigma": sigma,
                    "centres_sha256": hex(&here.sha256),
                });
                (answer, None)
            }
        };
        return write_line(out, "ruling", seed, &joined(line, &answer));
    }
    let (name, is) = match found {
        Found::Generic(exact) => (Some(&*input.name), exact.value.name().to_owned()),
        Found::AtCameras(here, _) => (name, at_cameras::answer(here, graph, None)),
    };
    match number.zip(ruling) {
        Some((row, (word, _))) => {
            // A refutation has to be seen.
            let word = word.replace("refuted", "REFUTED");
            let name = name.map(|name| format!("{}: ", printable(name)));
            write!(out, "row {row:4}  {word:13}  {}", name.unwrap_or_default())?;
        }
        None => write!(out, "  at cameras  ")?,
    }
    let (strength, parts) = (text::strength(strength), counted(components, "component"));
    write!(out, "{is} ({strength}), {parts}, rank {rank} of {required}")?;
    match ruling {
        None | Some((_, "")) => writeln!(out)?,
        Some((_, why)) => writeln!(out, "; {}", printable(why))?,
    }
    let Some(((matrix, _, place), [least, most])) = sigma else {
        return Ok(());
    };
    let behind = if number.is_some() { 10 } else { 2 };
    let what = format!("{matrix}, number {place} from below ({strength})");
    writeln!(out, "{:behind$}sigma       {least} to {most}: {what}", "")
}
