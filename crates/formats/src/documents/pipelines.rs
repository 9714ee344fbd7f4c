//! Pairs of other pipelines: the edges of Open3D's pose graphs, and MVSNet's `pair.txt`.

use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::documents::collected::Collected;
use crate::documents::malformed;
use crate::edge_list::columns::ListOptions;
use crate::edge_list::fields::{integer, is_number};
use crate::error::{Fault, Place};
use crate::read_as::Parsed;
use viewcert::wording::counted;

/// A pose graph of Open3D (`io.write_pose_graph`): nodes without names, and edges between their places.
#[derive(Deserialize)]
struct PoseGraph {
    nodes: Vec<IgnoredAny>,
    edges: Vec<PoseEdge>,
}

#[derive(Deserialize)]
struct PoseEdge {
    source_node_id: usize,
    target_node_id: usize,
    #[serde(default)]
    uncertain: bool,
}

/// Whether a text begins like a pose graph of Open3D.
pub(super) fn is_pose_graph(head: &str) -> bool {
    head.trim_start().starts_with('{') && head.contains("\"PoseGraph\"")
}

/// Reads a pose graph. Edges that its optimisation may drop count like the others, and a note says how many
/// they are.
pub(super) fn pose_graph(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let found: PoseGraph = serde_json::from_str(text).map_err(|error| {
        let problem = malformed("pose graph of Open3D", error.to_string());
        Place::Line(error.line() as u64).fault(problem)
    })?;
    let mut collected = Collected::new(options);
    for node in 0..found.nodes.len() {
        collected.list(&node.to_string())?;
    }
    for edge in &found.edges {
        let end = |node: usize| match collected.find(&node.to_string()) {
            Some(node) => Ok(node),
            None => {
                let what = format!("an edge ends at node {node}, which there is not");
                Err(malformed("pose graph of Open3D", what))
            }
        };
        let (a, b) = (end(edge.source_node_id)?, end(edge.target_node_id)?);
        collected.pair(a, b)?;
    }
    let uncertain = found.edges.iter().filter(|edge| edge.uncertain).count();
    if uncertain > 0 {
        let edges = counted(uncertain, "edge");
        let note = format!("{edges} marked uncertain, as loop closures are, count as pairs");
        collected.notes.push(note);
    }
    collected.finish()
}

/// Whether a text begins like MVSNet's `pair.txt`: a number of views, the number of one, and its neighbours.
pub(super) fn is_view_selection(head: &str) -> bool {
    let mut lines = head.lines().map(|line| line.split_ascii_whitespace());
    let mut next = || lines.next().map(Vec::from_iter).unwrap_or_default();
    let (count, view, neighbours) = (next(), next(), next());
    let [count, view] = [count, view].map(|line| match line[..] {
        [word] => integer(word).is_some(),
        _ => false,
    });
    count && view && neighbours_of(&neighbours).is_some_and(|found| !found.is_empty())
}

/// The neighbours on a line: how many they are, and the number and the score of each.
fn neighbours_of<'t>(words: &[&'t str]) -> Option<Vec<&'t str>> {
    let (count, pairs) = words.split_first()?;
    let is_whole = count.parse() == Ok(pairs.len() / 2);
    let is_pair = |pair: &[&str]| {
        pair.len() == 2 && integer(pair[0]).is_some() && is_number(pair[1].as_bytes())
    };
    (is_whole && pairs.chunks(2).all(is_pair)).then(|| pairs.iter().step_by(2).copied().collect())
}

/// Reads MVSNet's `pair.txt`. Its neighbours are the views that were chosen to match with each.
pub(super) fn view_selection(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let wrong =
        |line: u64, what: &str| Place::Line(line).fault(malformed("MVSNet's pair.txt", what));
    let mut collected = Collected::new(options);
    let lines = (1..).zip(
        text.lines()
            .map(|line| Vec::from_iter(line.split_ascii_whitespace())),
    );
    let mut lines = lines.filter(|(_, words)| !words.is_empty());
    let count = lines
        .next()
        .and_then(|(_, words)| words.first()?.parse::<usize>().ok());
    let count = count.ok_or_else(|| wrong(1, "the number of views is missing"))?;
    let mut views = 0;
    while let Some((line, view)) = lines.next() {
        let [view] = view[..] else {
            return Err(wrong(line, "the number of a view stands alone on its line"));
        };
        let fault = |problem| Place::Line(line).fault(problem);
        let view = collected.list(view).map_err(fault)?;
        let words = lines.next().map(|(_, words)| words).unwrap_or_default();
        let neighbours = neighbours_of(&words).ok_or_else(|| {
            let what = "behind a view follow the number of its neighbours, and a number and a score of each";
            wrong(line, what)
        })?;
        for neighbour in neighbours {
            let neighbour = collected.node(neighbour).map_err(fault)?;
            collected.pair(view, neighbour).map_err(fault)?;
        }
        views += 1;
    }
    if views != count {
        let what = format!("line 1 says {count} views, and there are {views}");
        return Err(wrong(1, &what));
    }
    let mut parsed = collected.finish()?;
    parsed.read.taken = Some("each view with the neighbours chosen for it".to_owned());
    parsed.read.ignored.push("scores".to_owned());
    Ok(parsed)
}
