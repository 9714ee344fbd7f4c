//! The conditions of the literature and the grounds on which they are decided.

use serde::Serialize;
use std::io::{self, Write};
use viewcert::geometry::model::Model;
use viewcert::wording::printable;
use viewcert_formats::{NamedGraph, ReadAs};
use viewcert_lab_studies::conditions::moves::Move;
use viewcert_lab_studies::conditions::{Answer, Condition, Grounds, refuted, solvable};
use viewcert_report::json::{GraphLine, write_line};
use viewcert_report::{counted, size};

fn answer(condition: &Condition) -> &'static str {
    match condition.answer {
        Answer::Yes => "yes",
        Answer::No => "no",
        Answer::NotApplicable(_) => "not applicable",
    }
}

/// What decided a condition, a line a step.
fn grounds(condition: &Condition, input: &NamedGraph) -> Vec<String> {
    if let Answer::NotApplicable(why) = &condition.answer {
        return vec![why.clone()];
    }
    let label = |v: u32| input.labels.display(v).to_string();
    let list = |nodes: &[u32]| {
        let names: Vec<String> = nodes.iter().map(|&v| label(v)).collect();
        names.join(" ")
    };
    match &condition.grounds {
        None => Vec::new(),
        Some(Grounds::Degree(v, degree)) => vec![format!("{} has degree {degree}", label(*v))],
        Some(Grounds::Adjacent(i, j)) => {
            vec![format!("{} and {} have degree 2", label(*i), label(*j))]
        }
        Some(Grounds::Cut(v, part)) => vec![format!("{} cuts off {}", label(*v), list(part))],
        Some(Grounds::Apart(part)) => vec![format!("not connected with the rest: {}", list(part))],
        Some(Grounds::Count(text)) => vec![text.clone()],
        Some(Grounds::Vertices(nodes, d, whole)) => {
            vec![format!("d is {d} on {}, and {whole} on all", list(nodes))]
        }
        Some(Grounds::Partition(blocks, bound)) => {
            let required = Model::Projective.required(input.graph.nodes());
            let head = format!("rank at most {bound} of {required}, by the blocks:");
            std::iter::once(head)
                .chain(blocks.iter().map(|block| list(block)))
                .collect()
        }
        Some(Grounds::Growth((i, j), steps)) => {
            let start = format!("{} - {}", label(*i), label(*j));
            let step = |&[v, a, b]: &[u32; 3]| {
                format!(
                    "{} joins, seen from {} and {}",
                    label(v),
                    label(a),
                    label(b)
                )
            };
            std::iter::once(start)
                .chain(steps.iter().map(step))
                .collect()
        }
        Some(Grounds::Reached(count)) => {
            let nodes = input.graph.nodes();
            let cameras = counted(nodes, "camera");
            vec![format!("at most {count} of {cameras} are reached")]
        }
        Some(Grounds::Moves(moves)) => moves.iter().map(|step| describe(step, &label)).collect(),
        Some(Grounds::Missing(count)) => {
            let edges = counted(*count, "edge");
            vec![format!("{edges} of the complete graph missing")]
        }
    }
}

fn describe(step: &Move, label: &impl Fn(u32) -> String) -> String {
    match step {
        Move::Solid([a, b], [i, j]) => format!(
            "solid {} - {}, triangles with {} - {}",
            label(*a),
            label(*b),
            label(*i),
            label(*j)
        ),
        Move::Dashed([a, b], [k, l]) => format!(
            "dashed {} -> {}, by way of {} and {}",
            label(*a),
            label(*b),
            label(*k),
            label(*l)
        ),
        Move::Upgrade([a, b], [x, y, z]) => format!(
            "solid {} - {}, from dashed by {}, {} and {}",
            label(*a),
            label(*b),
            label(*x),
            label(*y),
            label(*z)
        ),
    }
}

fn conclusion(conditions: &[Condition]) -> &'static str {
    if refuted(conditions) {
        "not solvable: a necessary condition fails"
    } else if solvable(conditions) {
        "solvable: a sufficient condition holds"
    } else {
        "open: the conditions do not decide; `verify GRAPH` does"
    }
}

/// How many lines of the grounds are shown to people.
const SHOWN: usize = 12;

/// Writes a few lines a condition.
///
/// # Errors
/// Those of the writer.
pub fn text(out: &mut impl Write, input: &NamedGraph, found: &[Condition]) -> io::Result<()> {
    writeln!(out, "{}", printable(&input.name))?;
    writeln!(out, "  read as     {}", input.read)?;
    writeln!(out, "  graph       {}", size(&input.graph))?;
    for note in &input.notes {
        writeln!(out, "  note        {note}")?;
    }
    for condition in found {
        let kind = if condition.necessary {
            "necessary"
        } else {
            "sufficient"
        };
        writeln!(
            out,
            "  {kind:10}  {:30} {:14} ({})",
            condition.name,
            answer(condition),
            condition.source
        )?;
        let lines = grounds(condition, input);
        for line in lines.iter().take(SHOWN) {
            writeln!(out, "                {line}")?;
        }
        if lines.len() > SHOWN {
            let more = lines.len() - SHOWN;
            writeln!(out, "                and {more} more, with --json")?;
        }
    }
    writeln!(out, "  result      {}", conclusion(found))
}

#[derive(Serialize)]
struct Json<'a> {
    graph: GraphLine<'a>,
    read: &'a ReadAs,
    notes: &'a [String],
    result: &'static str,
    conditions: Vec<JsonCondition>,
}

#[derive(Serialize)]
struct JsonCondition {
    name: &'static str,
    source: &'static str,
    kind: &'static str,
    answer: &'static str,
    #[serde(rename = "witness")]
    grounds: Vec<String>,
}

/// Writes one line of JSON.
///
/// # Errors
/// Those of the writer.
pub fn json(out: &mut impl Write, input: &NamedGraph, found: &[Condition]) -> io::Result<()> {
    let conditions = found
        .iter()
        .map(|condition| JsonCondition {
            name: condition.name,
            source: condition.source,
            kind: if condition.necessary {
                "necessary"
            } else {
                "sufficient"
            },
            answer: answer(condition),
            grounds: grounds(condition, input),
        })
        .collect();
    let line = Json {
        graph: GraphLine::of(input),
        read: &input.read,
        notes: &input.notes,
        result: conclusion(found),
        conditions,
    };
    write_line(out, "conditions", None, &line)
}
