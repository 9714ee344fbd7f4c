//! Pose graphs of g2o: a tag a line, then ids and numbers.
//!
//! Tags by g2o's own types (slam2d, slam3d, sba, sim3): `VERTEX_...` of a pose is a node,
//! `EDGE_...` between two poses a pair; numbers behind the ids (poses, measurements, information
//! matrices) are of no concern. All other lines are ignored, and their tags named in a note:
//! landmarks are no cameras, and their edges no pairs of cameras. Unknown edges between two poses
//! are refused, as they may be pairs.

use std::collections::BTreeMap;

use crate::documents::collected::Collected;
use crate::documents::malformed;
use crate::edge_list::columns::ListOptions;
use crate::edge_list::fields::integer;
use crate::edge_list::refusal::shown;
use crate::error::{Fault, Place, Problem};
use crate::read_as::Parsed;
use viewcert::wording::counted;

const FORMAT: &str = "g2o";

/// Tags of poses.
const POSES: [&str; 5] = [
    "VERTEX_SE2",
    "VERTEX_SE3:QUAT",
    "VERTEX_SE3:EXPMAP",
    "VERTEX_SIM3:EXPMAP",
    "VERTEX_CAM",
];

/// Tags of edges between two poses.
const PAIRS: [&str; 6] = [
    "EDGE_SE2",
    "EDGE_SE3:QUAT",
    "EDGE_SE3:EXPMAP",
    "EDGE_SIM3:EXPMAP",
    "EDGE_SE2_OFFSET",
    "EDGE_SE3_OFFSET",
];

/// Whether a text begins like a pose graph: with a tag in capitals and a number.
pub(crate) fn is_g2o(head: &str) -> bool {
    let first = head.lines().map(str::trim_start);
    let mut first = first.filter(|line| !line.is_empty() && !line.starts_with('#'));
    first.next().is_some_and(|line| {
        let mut words = line.split_ascii_whitespace();
        let (tag, id) = (words.next().unwrap_or_default(), words.next());
        let is_tag = ["VERTEX_", "EDGE_", "PARAMS_"]
            .iter()
            .any(|start| tag.starts_with(start));
        is_tag && id.is_some_and(|id| integer(id).is_some())
    })
}

/// Reads a pose graph.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut collected = Collected::new(options);
    let mut ignored: BTreeMap<&str, usize> = BTreeMap::new();
    // Lines of edges that are unknown, and the two ids on each.
    let mut unknown = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let fault = |problem| Place::Line(number).fault(problem);
        let mut words = line.split_ascii_whitespace();
        let Some(tag) = words.next().filter(|tag| !tag.starts_with('#')) else {
            continue;
        };
        if POSES.contains(&tag) {
            let [id] = ids(tag, &mut words).map_err(fault)?;
            collected.list(id).map_err(fault)?;
        } else if PAIRS.contains(&tag) {
            let [a, b] = ids(tag, &mut words).map_err(fault)?;
            let a = collected.node(a).map_err(fault)?;
            let b = collected.node(b).map_err(fault)?;
            collected.pair(a, b).map_err(fault)?;
        } else if is_tag(tag) {
            *ignored.entry(tag).or_default() += 1;
            // A prior has one pose, and a number behind it.
            let is_edge = tag.starts_with("EDGE_") && !tag.contains("PRIOR");
            if let (true, Some(a), Some(b)) = (is_edge, words.next(), words.next()) {
                unknown.push((number, tag, [a, b]));
            }
        } else {
            let what = format!("the line begins with no tag: `{}`", shown(tag));
            return Err(fault(malformed(FORMAT, what)));
        }
    }
    // Landmarks have ids of their own.
    let is_pose = |id: &&str| collected.find(id).is_some();
    if let Some((number, tag, [a, b])) = unknown.iter().find(|(.., ids)| ids.iter().all(is_pose)) {
        let what = format!(
            "edges {} are unknown here, and this one joins two poses, {} and {}",
            shown(tag),
            shown(a),
            shown(b)
        );
        return Err(Place::Line(*number).fault(malformed(FORMAT, what)));
    }
    for (tag, count) in ignored.iter().take(MOST_TAGS) {
        let are = if *count == 1 { "is" } else { "are" };
        let lines = counted(*count, "line");
        let note = format!("{lines} {} {are} ignored: no poses, or unknown", shown(tag));
        collected.notes.push(note);
    }
    collected.finish()
}

/// How many tags are named.
const MOST_TAGS: usize = 10;

/// The ids behind a tag. Nothing that follows them matters, and a cut line may lack it.
fn ids<'t, const N: usize>(
    tag: &str,
    words: &mut impl Iterator<Item = &'t str>,
) -> Result<[&'t str; N], Problem> {
    let mut ids = [""; N];
    for id in &mut ids {
        let Some(word) = words.next() else {
            let what = format!("{tag} has {N} ids, and fewer are there");
            return Err(malformed(FORMAT, what));
        };
        if integer(word).is_none() {
            let what = format!("`{}` is no id, which is an integer", shown(word));
            return Err(malformed(FORMAT, what));
        }
        *id = word;
    }
    Ok(ids)
}

/// Whether a word may be the tag of a type that is not known here.
fn is_tag(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_uppercase())
        && word
            .bytes()
            .all(|b| b.is_ascii_alphanumeric() || matches!(b, b'_' | b':' | b'-'))
}
