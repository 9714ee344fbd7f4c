//! A few lines a graph, for people.

use super::{Report, condition, counted, database, size_with_parts, tracks};
use crate::assumptions::Scope;
use std::io::{self, Write};
use viewcert::Model;
use viewcert::contract::Merge;
use viewcert::decide::Strength;
use viewcert::decide::evidence::{Evidence, Witness};
use viewcert::decide::{Component, SolutionCount, Value, Verdict};
use viewcert::wording::printable;
use viewcert_formats::NamedGraph;

/// How many components are shown with their sizes.
const SHOWN: usize = 8;

/// Writes the report.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut impl Write, report: &Report) -> io::Result<()> {
    let (input, verdict) = (report.input, report.verdict);
    writeln!(out, "{}", printable(&input.name))?;
    writeln!(out, "  read as     {}", input.read)?;
    writeln!(out, "  graph       {}", size_with_parts(input, verdict))?;
    if let Some(facts) = &input.database {
        database::write(out, facts)?;
    }
    if let Some(facts) = &input.tracks {
        tracks::write(out, facts)?;
    }
    for note in &input.notes {
        writeln!(out, "  note        {note}")?;
    }
    if let Some(own_frame) = report.scope.own_frame() {
        writeln!(out, "  known       {}", own_frame.known())?;
    }
    if !verdict.displacements.is_empty() {
        let known = &verdict.displacements;
        writeln!(
            out,
            "  known       displacements between {} in {}{}",
            counted(known.nodes(), "camera"),
            counted(known.groups().len(), "group"),
            known.vectors().map_or("", |_| ", as given vectors")
        )?;
    }
    writeln!(out, "  verdict     {}", answer(report))?;
    if let Some(own_frame) = report.scope.own_frame() {
        writeln!(out, "  because     {}", own_frame.because())?;
        writeln!(out, "  with given  {}", own_frame.count(input))?;
        let (rank, required) = (verdict.rank, verdict.required);
        let measured = measured(report);
        writeln!(out, "  measured    {measured}, rank {rank} of {required}")?;
    } else {
        let because = because(input, verdict, report.scope);
        writeln!(out, "  because     {because}")?;
    }
    let of_components = verdict.components.iter().map(|one| &one.solutions);
    let mut counts = of_components.chain([&verdict.solutions]).flatten();
    if counts.any(|count| count.full_may_tell_more) {
        let hint = "--solutions=full may tell how many solutions, in seconds or minutes";
        writeln!(out, "  hint        {hint}")?;
    }
    for condition in report.scope.conditions() {
        writeln!(out, "  condition   {condition}")?;
    }
    if let Some(planar) = report.scope.planar() {
        writeln!(out, "  in a plane  {}", planar.words())?;
    }
    if let Some(base_lines) = report.scope.base_lines() {
        writeln!(out, "  base lines  {}", base_lines.words())?;
    }
    if let Some(intrinsics) = report.scope.intrinsics() {
        intrinsics.write(out)?;
    }
    match report.scope.own_frame() {
        Some(own_frame) => writeln!(out, "  rank        {}", own_frame.rank_words())?,
        None => writeln!(
            out,
            "  rank        {} of {} ({})",
            verdict.rank,
            verdict.required,
            strength(verdict.rank_claim().strength)
        )?,
    }
    write_components(out, report)?;
    if let Some(here) = &report.here {
        here.write_text(out, report.list_components)?;
    }
    writeln!(out, "  time        {}", seconds(report.time.as_micros()))
}

/// Writes the components of a verdict.
///
/// # Errors
/// Those of the writer.
pub(super) fn write_components(out: &mut impl Write, report: &Report) -> io::Result<()> {
    let (input, verdict) = (report.input, report.verdict);
    let strength = strength(verdict.components_claim().strength);
    if let Some(cameras) = input.cameras {
        return tracks::write_components(out, report, cameras, &strength);
    }
    writeln!(
        out,
        "  components  {} ({strength}){}",
        verdict.components.len(),
        sizes(verdict)
    )?;
    if report.list_components {
        for (k, component) in (1..).zip(&verdict.components) {
            write!(out, "  component {k}:")?;
            for v in component.nodes() {
                write!(out, " {}", input.labels.display(v))?;
            }
            writeln!(out)?;
        }
    }
    Ok(())
}

/// The verdict and how strong it is.
pub(super) fn answer(report: &Report) -> String {
    match report.scope.own_frame() {
        Some(own_frame) => {
            let condition = promised(report.input, report.verdict, report.scope);
            own_frame.words(report.input, condition)
        }
        None => measured(report),
    }
}

/// The verdict on pairs and rigs, and how strong it is.
fn measured(report: &Report) -> String {
    let verdict = report.verdict;
    let known = verdict.solutions.as_ref();
    let known = known.filter(|count| count.at_least > 1 || count.at_most.is_some());
    let means = match (verdict.value, report.input.cameras) {
        (Value::NotFiniteSolvable, None) => "infinitely many sets of cameras".into(),
        (Value::NotFiniteSolvable, Some(_)) => {
            "infinitely many positions of the cameras and points".into()
        }
        (_, Some(_)) => "the positions of all cameras and points are unique".into(),
        (Value::Solvable, None) => "the cameras are unique".into(),
        (Value::FiniteSolvable, None) => match known {
            Some(count) => format!("{count} over the complex numbers"),
            None => "finitely many sets of cameras".into(),
        },
    };
    let condition = condition(report.input, verdict, report.scope);
    let condition = condition.map_or_else(String::new, |words| format!(" {words}"));
    format!(
        "{}: {means}{condition} ({})",
        verdict.value.name(),
        strength(verdict.value_claim().strength)
    )
}

/// What a good answer rests on.
pub(super) fn condition(input: &NamedGraph, verdict: &Verdict, scope: &Scope) -> Option<String> {
    let is_good = verdict.value != Value::NotFiniteSolvable;
    promised(input, verdict, scope).filter(|_| is_good)
}

/// What an answer rests on if it is good.
pub(super) fn promised(input: &NamedGraph, verdict: &Verdict, scope: &Scope) -> Option<String> {
    // Pairs fix focal lengths then, and no mapper finds them.
    let model = if scope.asks_focal() {
        Model::default()
    } else {
        verdict.model
    };
    scope.promise(condition::of_photographs(input, model))
}

/// What the answer rests on, in a line.
pub(super) fn because(input: &NamedGraph, verdict: &Verdict, scope: &Scope) -> String {
    let by_frames = scope.base_lines();
    match by_frames.filter(|found| found.is_determined()) {
        Some(found) => found.hold(input.graph.nodes()),
        None => reason(input, verdict),
    }
}

/// The strength of a claim in words.
pub(super) fn strength(strength: Strength) -> String {
    match strength {
        Strength::Proof => "proved".into(),
        Strength::ErrorBound(e) => format!("error at most 2^{e}"),
    }
}

fn reason(input: &NamedGraph, verdict: &Verdict) -> String {
    let nodes = input.graph.nodes();
    let (members, single) = match input.cameras {
        None => ("cameras", "single cameras"),
        Some(_) => ("cameras and points", "single cameras or points"),
    };
    if nodes == 1 {
        return "a single camera has nothing to be relative to".into();
    }
    let is_scaled = !verdict.displacements.is_empty();
    if verdict.pieces.is_empty() && verdict.value == Value::Solvable && is_scaled {
        return match verdict.contraction.bodies.len() {
            1 => format!("the displacements of all {nodes} cameras are known"),
            _ => {
                format!(
                    "known displacements and pairs merge into one body of all {nodes} {members}"
                )
            }
        };
    }
    if verdict.pieces.is_empty() && verdict.value == Value::Solvable {
        return match verdict.contraction.bodies.len() {
            1 if !verdict.known_parts.is_empty() => {
                format!("one known part has all {nodes} cameras")
            }
            _ if !verdict.known_parts.is_empty() => {
                format!("known parts and pairs merge into one body with all {nodes} cameras")
            }
            0 => "a single pair determines its two cameras".into(),
            1 => match input.cameras {
                None => match &verdict.contraction.bodies[0].merge[..] {
                    [Merge::Biclique { .. }, ..] => {
                        format!("one body of {nodes} cameras around a K_{{2,3}}")
                    }
                    [Merge::Cycle { .. }, ..] => {
                        format!("one body of {nodes} cameras around a cycle of four")
                    }
                    _ => format!("one body grows from a triangle to all {nodes} cameras"),
                },
                Some(_) => format!("one body grows to all {nodes} {members}"),
            },
            merges => format!("{merges} bodies merge into one with all {nodes} {members}"),
        };
    }
    if let Some(why) = verdict.solutions.as_ref().and_then(SolutionCount::because) {
        return why;
    }
    if verdict.value != Value::NotFiniteSolvable {
        return full_rank(verdict)
            + if verdict.value == verdict.value_by_rank() {
                ""
            } else {
                "; the scales of its parts have one solution"
            };
    }
    let parts = verdict.rigid.len() + verdict.pieces.len();
    let covered: usize = verdict.pieces.iter().map(|piece| piece.upper).sum();
    match verdict.value_claim().strength {
        Strength::ErrorBound(_) => "the rank falls short at random cameras".into(),
        Strength::Proof if parts == 0 => match input.cameras {
            None => "there are no pairs".into(),
            Some(_) => "no track counts".into(),
        },
        Strength::Proof if parts > 1 => {
            format!("{parts} parts hang together in {single}, or not at all")
        }
        Strength::Proof if !verdict.pieces.is_empty() && covered < verdict.required => {
            format!("counting allows rank {covered} at most")
        }
        Strength::Proof => match input.cameras {
            None if !verdict.known_parts.is_empty() => {
                "some cameras have no pairs and are in no known part".into()
            }
            None => "some cameras have no pairs".into(),
            Some(_) => "some cameras see no track that counts".into(),
        },
    }
}

/// By which minor the rank is full.
fn full_rank(verdict: &Verdict) -> String {
    let by_rank = verdict.by_rank.len();
    if verdict.pieces.is_empty() && by_rank > 0 {
        return match by_rank {
            1 => "all cameras are in one body of full rank".into(),
            parts => format!("{parts} parts of full rank merge into one body with all cameras"),
        };
    }
    let kind = verdict
        .pieces
        .iter()
        .flat_map(|piece| &piece.evidence)
        .next_back();
    match kind {
        Some(Evidence::IntegerMinor(minor)) => {
            let witness = match &minor.witness {
                Witness::Determinant(determinant) => {
                    format!(
                        "a determinant of {}",
                        counted(determinant.bits() as usize, "bit")
                    )
                }
                Witness::Prime(prime) => format!("not even modulo {prime}"),
            };
            format!("a minor of the Jacobian at rational cameras is not zero ({witness})")
        }
        Some(Evidence::Minor { draw, .. }) => {
            format!("a minor of the Jacobian is not zero modulo {}", draw.prime)
        }
        Some(Evidence::PlaneFlow { draw, .. }) => {
            format!("full rank at one camera set modulo {}", draw.prime)
        }
        Some(Evidence::PlaneMinor { draw, .. }) => {
            format!("full rank at points in the plane modulo {}", draw.prime)
        }
        _ => "full rank".into(),
    }
}

/// The sizes of the components, behind a colon if there are any.
fn sizes(verdict: &Verdict) -> String {
    let mut text: Vec<String> = verdict
        .components
        .iter()
        .take(SHOWN)
        .map(|component| {
            let (nodes, edges) = (component.node_count(), component.edge_count());
            let size = format!("{} / {}", counted(nodes, "camera"), counted(edges, "pair"));
            match several(verdict, component) {
                Some(count) => format!("{size} ({count})"),
                None => size,
            }
        })
        .collect();
    if verdict.components.len() > SHOWN {
        text.push(format!("and {} more", verdict.components.len() - SHOWN));
    }
    if text.is_empty() {
        return String::new();
    }
    format!(": {}", text.join(", "))
}

/// How many solutions a component of a graph that falls apart has, as far as that is known, unless it is just one.
pub(super) fn several<'v>(
    verdict: &Verdict,
    component: &'v Component,
) -> Option<&'v SolutionCount> {
    let falls_apart = verdict.value == Value::NotFiniteSolvable;
    let count = component.solutions.as_ref().filter(|_| falls_apart)?;
    (!count.is_one()).then_some(count)
}

/// A time for people.
pub(super) fn seconds(micros: u128) -> String {
    match micros {
        0..10_000 => format!("{}.{} ms", micros / 1000, micros % 1000 / 100),
        10_000..10_000_000 => format!("{} ms", micros / 1000),
        _ => format!("{} s", micros / 1_000_000),
    }
}
