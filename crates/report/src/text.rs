//! A few lines a graph, for people.

use super::{Report, condition, counted, database, size_with_parts, tracks};
use crate::assumptions::Scope;
use crate::shown::{notes, row, time};
use std::io::{self, Write};
use viewcert::Model;
use viewcert::decide::Strength;
use viewcert::decide::evidence::Evidence;
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
    row(out, "read as", &input.read)?;
    row(out, "graph", size_with_parts(input, verdict))?;
    if let Some(facts) = &input.database {
        database::write(out, facts)?;
    }
    if let Some(facts) = &input.tracks {
        tracks::write(out, facts)?;
    }
    notes(out, &input.notes)?;
    let own_frame = report.scope.own_frame();
    if let Some(own_frame) = own_frame {
        row(out, "known", own_frame.known())?;
    }
    let known = &verdict.displacements;
    if !known.is_empty() {
        let cameras = counted(known.nodes(), "camera");
        let groups = counted(known.groups().len(), "group");
        let given = known.vectors().map_or("", |_| ", as given vectors");
        let words = format!("displacements between {cameras} in {groups}{given}");
        row(out, "known", words)?;
    }
    row(out, "verdict", answer(report))?;
    let rank = format!("{} of {}", verdict.rank, verdict.required);
    if let Some(own_frame) = own_frame {
        row(out, "because", own_frame.because())?;
        row(out, "with given", own_frame.count(input))?;
        row(
            out,
            "measured",
            format_args!("{}, rank {rank}", measured(report)),
        )?;
    } else {
        row(out, "because", because(input, verdict, report.scope))?;
    }
    let of_components = verdict.components.iter().map(|one| &one.solutions);
    let mut counts = of_components.chain([&verdict.solutions]).flatten();
    if counts.any(|count| count.full_may_tell_more) {
        let hint = "--solutions=full may tell how many solutions, in seconds or minutes";
        writeln!(out, "  hint        {hint}")?;
    }
    for condition in report.scope.conditions() {
        row(out, "condition", condition)?;
    }
    if let Some(planar) = report.scope.planar() {
        row(out, "in a plane", planar.words())?;
    }
    if let Some(base_lines) = report.scope.base_lines() {
        row(out, "base lines", base_lines.words())?;
    }
    if let Some(intrinsics) = report.scope.intrinsics() {
        intrinsics.write(out)?;
    }
    match own_frame {
        Some(own_frame) => row(out, "rank", own_frame.rank_words())?,
        None => {
            let strength = strength(verdict.rank_claim().strength);
            row(out, "rank", format_args!("{rank} ({strength})"))?;
        }
    }
    write_components(out, report)?;
    if let Some(here) = &report.here {
        here.write_text(out, report.list_components)?;
    }
    time(out, report.time)
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
    let (count, sizes) = (verdict.components.len(), sizes(verdict));
    row(
        out,
        "components",
        format_args!("{count} ({strength}){sizes}"),
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
    if verdict.pieces.is_empty() && verdict.value == Value::Solvable {
        let known = match (verdict.displacements.is_empty(), verdict.known_parts.len()) {
            (false, _) => "known displacements and pairs",
            (true, 1..) => "known parts and pairs",
            (true, 0) => "pairs",
        };
        return format!("{known} merge into one body of all {nodes} {members}");
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
        Strength::Proof if parts == 0 && input.cameras.is_none() => "there are no pairs".into(),
        Strength::Proof if parts > 1 => {
            format!("{parts} parts hang together in {single}, or not at all")
        }
        Strength::Proof if !verdict.pieces.is_empty() && covered < verdict.required => {
            format!("counting allows rank {covered} at most")
        }
        Strength::Proof => match input.cameras {
            None => "some cameras have no pairs and are in no known part".into(),
            Some(_) => "some cameras see no track that counts".into(),
        },
    }
}

/// By which minor the rank is full.
fn full_rank(verdict: &Verdict) -> String {
    let pieces = verdict.pieces.iter();
    match pieces.flat_map(|piece| &piece.evidence).next_back() {
        Some(Evidence::IntegerMinor(_)) => {
            "a minor of the Jacobian at rational cameras is not zero".into()
        }
        Some(
            Evidence::Minor { draw, .. }
            | Evidence::PlaneFlow { draw, .. }
            | Evidence::PlaneMinor { draw, .. },
        ) => format!("full rank at drawn cameras modulo {}", draw.prime),
        _ if !verdict.by_rank.is_empty() => "parts of full rank merge into one body".into(),
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
