//! What somebody's floating point found at given cameras, beside what is so there.

use super::json::{GraphLine, write_line};
use super::{counted, text};
use serde::Serialize;
use std::io::{self, Write};
use viewcert::certificate::hex;
use viewcert::here::Here;
use viewcert_audit::at_cameras::{FloatClaim, decimals};
use viewcert_audit::claims::Ruling;
use viewcert_audit::enclosure::{Enclosure, Matrix};
use viewcert_formats::NamedGraph;

/// The exact side of one row, or of none.
#[derive(Clone, Copy, Debug)]
pub struct AtCameras<'a> {
    /// The graph.
    pub input: &'a NamedGraph,
    /// What is so at the cameras.
    pub here: &'a Here,
    /// The singular value, where one is asked for.
    pub sigma: Option<(Matrix, &'a Enclosure)>,
    /// The row, with its number from 1, and the ruling on it.
    pub ruled: Option<(usize, &'a FloatClaim, &'a Ruling)>,
}

impl AtCameras<'_> {
    fn verdict(&self) -> &'static str {
        match self.here.is_determined() {
            true => "determined",
            false => "not-determined",
        }
    }

    /// Writes a line or two.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_text(&self, out: &mut impl Write) -> io::Result<()> {
        let here = self.here;
        match self.ruled {
            Some((row, claim, ruling)) => {
                let name = claim.name.as_ref().map(|name| format!("{name}: "));
                write!(
                    out,
                    "row {row:4}  {:13}  {}",
                    ruling.word(),
                    name.unwrap_or_default()
                )?;
            }
            None => write!(out, "  at cameras  ")?,
        }
        let (rank, required) = (here.rank.value, here.required);
        write!(
            out,
            "{} ({}), {}, rank {rank} of {required}",
            self.verdict().replace('-', " "),
            text::strength(here.rank.strength),
            counted(here.components.value.len(), "component")
        )?;
        match self.ruled {
            Some((.., ruling)) if *ruling != Ruling::Confirmed => {
                writeln!(out, "; {}", ruling.reasons())?;
            }
            _ => writeln!(out)?,
        }
        let Some((matrix, found)) = self.sigma else {
            return Ok(());
        };
        let ([least, most], place) = (decimals(found), matrix.place(self.input.graph.nodes()));
        let behind = match self.ruled {
            Some(_) => "          sigma       ",
            None => "  sigma       ",
        };
        writeln!(
            out,
            "{behind}{least} to {most}: {}, number {place} from below ({})",
            matrix.name(),
            text::strength(here.rank.strength)
        )
    }

    /// Writes one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let here = self.here;
        let sigma = self.sigma.map(|(matrix, found)| {
            let [least, most] = decimals(found);
            let place = matrix.place(self.input.graph.nodes());
            SigmaLine {
                matrix: matrix.name(),
                place,
                least,
                most,
            }
        });
        let line = Line {
            row: self.ruled.map(|(row, ..)| row),
            line: self.ruled.map(|(_, claim, _)| claim.line),
            name: self.ruled.and_then(|(_, claim, _)| claim.name.as_deref()),
            ruling: self.ruled.map(|(.., ruling)| ruling.name()),
            reason: self.ruled.map(|(.., ruling)| ruling.reasons()),
            graph: GraphLine::of(self.input),
            model: here.model.name(),
            verdict: self.verdict(),
            strength: here.rank.strength.name(),
            error_log2: here.rank.strength.error_log2(),
            rank: here.rank.value,
            rank_required: here.required,
            components: here.components.value.len(),
            sigma,
            centres_sha256: hex(&here.sha256),
            notes: &self.input.notes,
        };
        write_line(out, "float_ruling", &line)
    }
}

#[derive(Serialize)]
struct Line<'a> {
    row: Option<usize>,
    line: Option<usize>,
    name: Option<&'a str>,
    ruling: Option<&'static str>,
    reason: Option<String>,
    graph: GraphLine<'a>,
    model: &'static str,
    verdict: &'static str,
    strength: &'static str,
    error_log2: Option<i64>,
    rank: usize,
    rank_required: usize,
    components: usize,
    sigma: Option<SigmaLine>,
    centres_sha256: String,
    notes: &'a [String],
}

/// Two decimals between which a singular value is.
#[derive(Serialize)]
struct SigmaLine {
    matrix: &'static str,
    /// Its number, from the smallest on.
    place: usize,
    least: String,
    most: String,
}
