//! What pairs and tracks of one input determine, as one page: everything that the screen says, and the report of the
//! graph that decides.

use crate::Report;
use crate::contradictions::Contradicted;
use crate::overview::Overview;
use crate::page::{self, Foreword};
use crate::scene::Scene;
use crate::screen;
use std::io;
use viewcert_advice::Advice;

/// The page of an overview; `advice` has the joints and suggestions of the graph that decides.
///
/// # Errors
/// None that an input can cause.
pub fn html(overview: &Overview, advice: &Advice) -> io::Result<Vec<u8>> {
    let (mut first, mut rest) = (Vec::new(), Vec::new());
    screen::write(&mut first, overview, true)?;
    overview.write_rest(&mut rest)?;
    first.truncate(first.len() - rest.len());
    // The name stands above, and a page is the same each time.
    let [first, rest] = [first, rest].map(|text| String::from_utf8_lossy(&text).into_owned());
    let first = first.split_once('\n').map_or("", |(_, lines)| lines);
    let timed = rest.rfind("  time ").unwrap_or(rest.len());
    let pairs = overview.pairs.as_ref().map(|[_, calibrated]| calibrated);
    let report = overview.tracks.as_ref().or(pairs);
    let Some(report) = report else {
        return Err(io::Error::other("neither pairs nor tracks"));
    };
    let matched = match (&overview.tracks, pairs) {
        (Some(_), Some(pairs)) => pairs.input.graph.edges(),
        _ => &[],
    };
    let report = Report { advice, ..*report };
    let is_good = overview.determined();
    let what = if overview.tracks.is_some() {
        "tracks"
    } else {
        "pairs"
    };
    let what = match (overview.no_model(), overview.is_promised()) {
        (Some(why), _) => format!("Mappers {why}"),
        (None, true) => format!("The {what} determine all images {}", overview.condition()),
        (None, false) => format!("The {what} do not determine all images"),
    };
    let foreword = Foreword {
        kind: "What to expect of a reconstruction",
        answer: (format!("{what}."), is_good),
        text: first,
        rest: &rest[..timed],
    };
    let motions = overview.contradictions.as_ref();
    let off = motions.map(Contradicted::contradicting);
    let scene = Scene::of(&report, matched, &off.unwrap_or_default());
    let mut page = Vec::new();
    page::write(&mut page, &report, &scene, Some(&foreword))?;
    Ok(page)
}
