//! Second solutions to look at: the one that a verdict knows, or why there is none; and as files, JSON
//! objects with a camera a line, long numbers as strings, so that no reader rounds them.

use crate::second_scene::{SecondScene, labels};
use serde_json::to_string;
use std::fmt;
use std::io::{Result, Write};
use viewcert::decide::Verdict;
use viewcert::linalg::integer::Integer;
use viewcert::solutions::{Interval, Witness};
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
    /// No real ones were looked for.
    NotLookedFor,
    /// Of those that were found none is of a scene in front of its cameras.
    NoneOriented,
}

impl NoSecond {
    /// A word for programs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Infinite => "infinite",
            Self::One => "one",
            Self::Unknown => "unknown",
            Self::NotLookedFor => "not-looked-for",
            Self::NoneOriented => "none-oriented",
        }
    }
}

impl fmt::Display for NoSecond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Infinite => "there are infinitely many solutions",
            Self::One => "there is one solution only",
            Self::Unknown => "no second solution is known",
            Self::NotLookedFor => {
                "real solutions are looked for where there are two to eight, known exactly, of one core"
            }
            Self::NoneOriented => {
                "no second scene in front of its cameras was found; another --seed may find one"
            }
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

/// A scene, and another one with the same images.
///
/// # Errors
/// Why there are none to look at.
pub fn second_scene(verdict: &Verdict) -> std::result::Result<SecondScene<'_>, NoSecond> {
    let count = verdict.solutions.as_ref().ok_or(NoSecond::Infinite)?;
    if count.is_one() {
        return Err(NoSecond::One);
    }
    let evidence = count.evidence.as_ref();
    let oriented = evidence.and_then(|found| found.oriented.as_ref());
    SecondScene::of(oriented.ok_or(NoSecond::NotLookedFor)?).ok_or(NoSecond::NoneOriented)
}

/// What all witnesses begin with.
fn write_head(out: &mut dyn Write, input: &NamedGraph) -> Result<()> {
    writeln!(out, "{{\"format\": \"viewcert witness\", \"version\": 1,")?;
    writeln!(out, " \"graph\": {},", to_string(&input.name)?)
}

/// The graph and the names of its nodes.
fn write_graph(out: &mut dyn Write, input: &NamedGraph) -> Result<()> {
    writeln!(out, " \"nodes\": {},", to_string(&labels(input))?)?;
    writeln!(out, " \"edges\": {},", to_string(&input.graph.edges())?)
}

/// Two families of cameras modulo a prime.
///
/// # Errors
/// Those of the writer.
pub fn write_witness(out: &mut dyn Write, input: &NamedGraph, witness: &Witness) -> Result<()> {
    write_head(out, input)?;
    writeln!(out, " \"prime\": \"{}\",", witness.prime)?;
    write_graph(out, input)?;
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

/// Integer centres of the first scene, whose cameras are `[ I | -c ]`; the cameras of the second one, their
/// entries polynomials in the root of `eliminant` in the interval `between` (from, to, denominator), by
/// coefficients from the constant one up; and its plane at infinity.
///
/// # Errors
/// Those of the writer.
pub fn write_second_scene(
    out: &mut dyn Write,
    input: &NamedGraph,
    second: &SecondScene<'_>,
) -> Result<()> {
    let scene = second.scene;
    let decimals = |f: &Vec<Integer>| f.iter().map(Integer::to_string).collect::<Vec<_>>();
    write_head(out, input)?;
    write_graph(out, input)?;
    writeln!(out, " \"centres\": {},", to_string(&scene.centres)?)?;
    writeln!(
        out,
        " \"eliminant\": {},",
        to_string(&decimals(&scene.eliminant))?
    )?;
    let Interval {
        from,
        to,
        denominator,
    } = &scene.roots[second.root].between;
    let between = [from, to, denominator].map(Integer::to_string);
    writeln!(out, " \"between\": {},", to_string(&between)?)?;
    writeln!(out, " \"plane\": {},", to_string(&second.plane)?)?;
    writeln!(out, " \"second\": [")?;
    for (v, camera) in (1..).zip(&scene.cameras) {
        let rows = camera.each_ref().map(|row| row.each_ref().map(decimals));
        let comma = if v < scene.cameras.len() { "," } else { "" };
        writeln!(out, "  {}{comma}", to_string(&rows)?)?;
    }
    writeln!(out, " ]}}")
}
