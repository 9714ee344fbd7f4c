//! Every camera model side by side, for people and for programs.

use super::json::{AnswerLine, GraphLine, parts, write_line};
use super::read::ReadLine;
use super::{size_with_parts, text};
use crate::assumptions::Scope;
use serde::Serialize;
use std::collections::{BTreeMap, HashMap};
use std::io::{self, Write};
use viewcert::decide::{Strength, Verdict};
use viewcert::geometry::model::Model;
use viewcert::wording::printable;
use viewcert_formats::NamedGraph;

/// How many changes between two models people are shown.
const SHOWN: usize = 8;

/// Components of one model that are one in the next.
pub struct Change {
    from: &'static str,
    to: &'static str,
    /// The component of the model `to`, from 1 on, and how many cameras it has...
    component: usize,
    cameras: usize,
    /// ... the components of the model `from` that it consists of, from 1 on...
    joins: Vec<usize>,
    /// ... and the cameras at which these touch: those that lie in several of them.
    at: Vec<u32>,
}

/// The models, each of which determines no more than the next one: affine solvable implies finite
/// solvable, and that implies solvable with known intrinsics (Corollary 13.4 of docs/theory.md).
pub const ORDER: [Model; 3] = [Model::Affine, Model::Projective, Model::Calibrated];

/// What changes from each verdict to the next; they are in this order of models.
pub fn all_changes(verdicts: &[(Verdict, Scope)]) -> Vec<Change> {
    let next = verdicts.windows(2);
    next.flat_map(|pair| changes(&pair[0].0, &pair[1].0))
        .collect()
}

/// What changes from one model to one that determines at least as much.
///
/// The components of the first refine those of the second: a part that is determined in the first
/// is in the second, so it lies in a component there. Two components of a graph share at most one
/// node, so two nodes of a part tell in which. O(n + sizes of components).
fn changes(from: &Verdict, to: &Verdict) -> Vec<Change> {
    let mut of_node: HashMap<u32, Vec<usize>> = HashMap::new();
    for (k, component) in to.components.iter().enumerate() {
        for v in component.nodes() {
            of_node.entry(v).or_default().push(k);
        }
    }
    let mut inside: BTreeMap<usize, Vec<(usize, Vec<u32>)>> = BTreeMap::new();
    for (k, component) in from.components.iter().enumerate() {
        let nodes = component.nodes();
        let [first, second] = [nodes[0], nodes[1]].map(|v| &of_node[&v]);
        let common = first.iter().find(|k| second.contains(k));
        let common = common.expect("what one model determines lies in a component of the next");
        inside.entry(*common).or_default().push((k, nodes));
    }
    let several = inside.into_iter().filter(|(_, parts)| parts.len() > 1);
    several
        .map(|(component, parts)| {
            let mut count: BTreeMap<u32, usize> = BTreeMap::new();
            for &v in parts.iter().flat_map(|(_, nodes)| nodes) {
                *count.entry(v).or_default() += 1;
            }
            let shared = count.into_iter().filter(|&(_, count)| count > 1);
            Change {
                from: from.model.name(),
                to: to.model.name(),
                component: component + 1,
                cameras: to.components[component].node_count(),
                joins: parts.iter().map(|(k, _)| k + 1).collect(),
                at: shared.map(|(v, _)| v).collect(),
            }
        })
        .collect()
}

/// The first few of a list, and how many more there are.
fn first<T: ToString>(items: impl ExactSizeIterator<Item = T>) -> String {
    let count = items.len();
    let mut words: Vec<String> = items.take(SHOWN).map(|item| item.to_string()).collect();
    if count > SHOWN {
        words.push(format!("and {} more", count - SHOWN));
    }
    words.join(", ")
}

/// Writes a line a model, and what changes between them.
///
/// # Errors
/// Those of the writer.
pub fn text(
    out: &mut impl Write,
    input: &NamedGraph,
    verdicts: &[(Verdict, Scope)],
    changes: &[Change],
) -> io::Result<()> {
    writeln!(out, "{}", printable(&input.name))?;
    writeln!(out, "  read as     {}", input.read)?;
    writeln!(
        out,
        "  graph       {}",
        size_with_parts(input, &verdicts[0].0)
    )?;
    for note in &input.notes {
        writeln!(out, "  note        {note}")?;
    }
    for (verdict, scope) in verdicts {
        let (rank, required) = (verdict.rank, verdict.required);
        let components = super::counted(verdict.components.len(), "component");
        let answer = verdict.value.name();
        let claims = [
            verdict.value_claim().strength,
            verdict.rank_claim().strength,
            verdict.components_claim().strength,
        ];
        let strength = text::strength(Strength::all(claims));
        let condition = text::condition(input, verdict, scope);
        let condition = condition.map_or_else(String::new, |words| format!(" {words}"));
        writeln!(
            out,
            "  {:<12}{answer}{condition}, rank {rank} of {required}, {components} ({strength})",
            verdict.model.name()
        )?;
    }
    for change in changes.iter().take(SHOWN) {
        let at = change.at.iter().map(|&v| input.labels.display(v));
        writeln!(
            out,
            "  change      {} component {} ({}) joins the {} components {} at {}",
            change.to,
            change.component,
            super::counted(change.cameras, "camera"),
            change.from,
            first(change.joins.iter()),
            first(at)
        )?;
    }
    if changes.len() > SHOWN {
        writeln!(out, "  change      and {} more", changes.len() - SHOWN)?;
    }
    Ok(())
}

#[derive(Serialize)]
struct Line<'a> {
    graph: GraphLine<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parts: Option<usize>,
    read: ReadLine<'a>,
    notes: &'a [String],
    models: Vec<ModelLine>,
    changes: Vec<ChangeLine>,
}

#[derive(Serialize)]
struct ModelLine {
    model: &'static str,
    #[serde(flatten)]
    answer: AnswerLine,
}

impl ModelLine {
    fn new(input: &NamedGraph, verdict: &Verdict, scope: &Scope) -> Self {
        Self {
            model: verdict.model.name(),
            answer: AnswerLine::new(input, verdict, scope, false),
        }
    }
}

#[derive(Serialize)]
struct ChangeLine {
    from: &'static str,
    to: &'static str,
    component: usize,
    cameras: usize,
    joins: Vec<usize>,
    at: Vec<String>,
}

/// Writes everything as one line.
///
/// # Errors
/// Those of the writer.
pub fn json(
    out: &mut impl Write,
    input: &NamedGraph,
    verdicts: &[(Verdict, Scope)],
    changes: &[Change],
) -> io::Result<()> {
    let changes = changes.iter().map(|change| ChangeLine {
        from: change.from,
        to: change.to,
        component: change.component,
        cameras: change.cameras,
        joins: change.joins.clone(),
        at: change
            .at
            .iter()
            .map(|&v| input.labels.label(v).into_owned())
            .collect(),
    });
    let line = Line {
        graph: GraphLine::new(input, &verdicts[0].0),
        parts: parts(&verdicts[0].0),
        read: ReadLine::from(&input.read),
        notes: &input.notes,
        models: verdicts
            .iter()
            .map(|(verdict, scope)| ModelLine::new(input, verdict, scope))
            .collect(),
        changes: changes.collect(),
    };
    write_line(out, "models", Some(verdicts[0].0.seed), &line)
}
