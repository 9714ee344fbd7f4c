//! Every camera model side by side, for people and for programs.

use super::json::{AnswerLine, GraphLine, joined, parts, present, write_line};
use super::{counted, size_of, size_with_parts, text};
use crate::assumptions::Scope;
use crate::shown::{SHOWN, head_with, row, several, some_names};
use serde::Serialize;
use serde_json::json;
use std::collections::{BTreeMap, HashMap};
use std::io::{self, Write};
use viewcert::decide::{Strength, Verdict};
use viewcert::geometry::model::Model;
use viewcert::wording::printable;
use viewcert_formats::NamedGraph;

/// Components of one model that are one in the next.
#[derive(Serialize)]
pub struct Change {
    from: &'static str,
    to: &'static str,
    /// The component of the model `to`, from 1 on, and how many cameras it has...
    component: usize,
    cameras: usize,
    /// ... the components of the model `from` that it consists of, from 1 on...
    joins: Vec<usize>,
    /// ... and the cameras at which these touch: those that lie in several of them.
    at: Vec<String>,
}

/// The models, each of which determines no more than the next one: affine solvable implies finite
/// solvable, and that implies solvable with known intrinsics (Corollary 13.4 of docs/theory.md).
pub const ORDER: [Model; 3] = [Model::Affine, Model::Projective, Model::Calibrated];

/// What changes from each verdict to the next; they are in this order of models.
pub fn all_changes(input: &NamedGraph, verdicts: &[(Verdict, Scope)]) -> Vec<Change> {
    let next = verdicts.windows(2);
    next.flat_map(|pair| changes(input, &pair[0].0, &pair[1].0))
        .collect()
}

/// What changes from one model to one that determines at least as much.
///
/// The components of the first refine those of the second: a part that is determined in the first
/// is in the second, so it lies in a component there. Two components of a graph share at most one
/// node, so two nodes of a part tell in which. O(n + sizes of components).
fn changes(input: &NamedGraph, from: &Verdict, to: &Verdict) -> Vec<Change> {
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
                at: shared
                    .map(|(v, _)| input.labels.label(v).into_owned())
                    .collect(),
            }
        })
        .collect()
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
    let size = verdicts.first().map_or_else(
        || size_of(input),
        |(verdict, _)| size_with_parts(input, verdict),
    );
    head_with(out, input, size)?;
    for (verdict, scope) in verdicts {
        let (rank, required) = (verdict.rank, verdict.required);
        let components = counted(verdict.components.len(), "component");
        let claims = [
            verdict.value_claim().strength,
            verdict.rank_claim().strength,
            verdict.components_claim().strength,
        ];
        let strength = text::strength(Strength::all(claims));
        let condition = text::condition(input, verdict, scope);
        let condition = condition.map_or_else(String::new, |words| format!(" {words}"));
        let answer = verdict.value.name();
        let words =
            format!("{answer}{condition}, rank {rank} of {required}, {components} ({strength})");
        row(out, verdict.model.name(), words)?;
    }
    for change in changes.iter().take(SHOWN) {
        let Change {
            from,
            to,
            component,
            ..
        } = change;
        let cameras = counted(change.cameras, "camera");
        let (joins, at) = (several(&change.joins, ", "), some_names(&change.at));
        let words = format!(
            "{to} component {component} ({cameras}) joins the {from} components {joins} at {at}"
        );
        row(out, "change", printable(&words))?;
    }
    match changes.len().saturating_sub(SHOWN) {
        0 => Ok(()),
        more => row(out, "change", format_args!("and {more} more")),
    }
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
    let model = |(verdict, scope): &(Verdict, Scope)| {
        let answer = AnswerLine::new(input, verdict, scope, false);
        joined(json!({"model": verdict.model.name()}), &answer)
    };
    let line = json!({
        "graph": GraphLine::new(input, &verdicts[0].0),
        "parts": parts(&verdicts[0].0),
        "read": input.read,
        "notes": input.notes,
        "models": verdicts.iter().map(model).collect::<Vec<_>>(),
        "changes": changes,
    });
    write_line(out, "models", Some(verdicts[0].0.seed), &present(line))
}
