//! A second solution to look at: the one that a verdict knows, or why there is none; and as a file, a JSON
//! object with a camera a line, long numbers as strings, so that no reader rounds them.

use serde_json::to_string;
use std::fmt;
use std::io::{Result, Write};
use viewcert::decide::Verdict;
use viewcert::solutions::Witness;
use viewcert_formats::NamedGraph;

/// Why there is no second solution to look at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoSecond {
    /// There are infinitely many.
    Infinite,
    /// There is one alone.
    One,
    /// None is known.
    Unknown,
}

impl NoSecond {
    /// A word for programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Infinite => "infinite",
            Self::One => "one",
            Self::Unknown => "unknown",
        }
    }
}

impl fmt::Display for NoSecond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Infinite => "there are infinitely many solutions",
            Self::One => "there is one solution only",
            Self::Unknown => "no second solution is known",
        })
    }
}

/// Two solutions modulo a prime, of a verdict whose solutions were counted.
///
/// # Errors
/// Why there are none to look at.
pub fn second(
    input: &NamedGraph,
    verdict: &Verdict,
    seed: u64,
) -> std::result::Result<Witness, NoSecond> {
    let count = verdict.solutions.as_ref().ok_or(NoSecond::Infinite)?;
    if count.is_one() {
        return Err(NoSecond::One);
    }
    let evidence = count.evidence.as_ref();
    let found = evidence.and_then(|found| found.witness(&input.graph, seed));
    found.ok_or(NoSecond::Unknown)
}

/// The name of each node.
pub(super) fn labels(input: &NamedGraph) -> Vec<String> {
    let nodes = 0..input.graph.nodes() as u32;
    nodes.map(|v| input.labels.label(v).into_owned()).collect()
}

/// Two families of cameras modulo a prime.
///
/// # Errors
/// Those of the writer.
pub fn write_witness(out: &mut dyn Write, input: &NamedGraph, witness: &Witness) -> Result<()> {
    writeln!(out, "{{\"format\": \"viewcert witness\", \"version\": 1,")?;
    writeln!(out, " \"graph\": {},", to_string(&input.name)?)?;
    writeln!(out, " \"prime\": \"{}\",", witness.prime)?;
    writeln!(out, " \"nodes\": {},", to_string(&labels(input))?)?;
    writeln!(out, " \"edges\": {},", to_string(&input.graph.edges())?)?;
    for (k, family) in witness.families.iter().enumerate() {
        writeln!(out, " \"{}\": [", ["first", "second"][k])?;
        for (v, camera) in (1..).zip(family) {
            let entries = camera.map(|row| row.map(|x| x.to_string()));
            let comma = if v < family.len() { "," } else { "" };
            writeln!(out, "  {}{comma}", to_string(&entries)?)?;
        }
        writeln!(out, " ]{}", if k == 0 { "," } else { "}" })?;
    }
    Ok(())
}
