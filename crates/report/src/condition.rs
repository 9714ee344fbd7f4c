//! What a promise about photographs rests on: words that stand in the promise itself.
//!
//! Verdicts are about a graph, and are proved of it. Whether photographs are placed right depends on pairs
//! that are right too: look-alikes are matched, and no verdict sees it.

use viewcert::Model;
use viewcert::wording::counted;
use viewcert_formats::NamedGraph;
use viewcert_formats::colmap::DatabaseFacts;

/// The condition of whatever pairs of photographs say.
pub(crate) const RIGHT: &str = "if every pair is right";

/// The condition of whatever tracks of a model say.
pub(crate) const TRACKS: &str = "if every track is right";

/// The condition for what the input says of pairs or tracks.
pub(crate) fn of(input: &NamedGraph) -> String {
    let focal = input.database.as_deref().map_or_else(String::new, focal);
    if_right(input) + &focal
}

/// The same, where the input is of photographs; plain graphs are not.
pub(crate) fn of_photographs(input: &NamedGraph, model: Model) -> Option<String> {
    let are_photographs = input.database.is_some() || input.cameras.is_some();
    are_photographs.then(|| match model.is_linear() {
        false => if_right(input),
        true => of(input),
    })
}

/// The condition without focal lengths.
pub(crate) fn if_right(input: &NamedGraph) -> String {
    let is_model = input.cameras.is_some() && input.database.is_none();
    if is_model { TRACKS } else { RIGHT }.to_owned()
}

/// What has to hold of optical axes for intrinsics to be found.
pub(crate) fn axes(are_known: bool, facts: &DatabaseFacts) -> &'static str {
    match (are_known, facts.axes_parallel) {
        (true, _) => "",
        (_, true) => " and optical axes are not parallel, as they are here",
        _ => " and optical axes are neither parallel nor meet in one point",
    }
}

/// What has to hold of focal lengths that are guesses.
fn focal(facts: &DatabaseFacts) -> String {
    let shared = |more: &str| {
        let found = match facts.focal_shared {
            1 => format!("the {more}focal length"),
            count => format!("{count} {more}focal lengths"),
        };
        match facts.axes_parallel {
            false => {
                format!(" and the mapper finds {found} from optical axes that are not parallel")
            }
            true => format!(" and so is the guess of {found}, as all optical axes are parallel"),
        }
    };
    match (facts.focal_guessed, facts.focal_shared) {
        (0, 0) => String::new(),
        (0, _) => shared(""),
        (guessed, several) => {
            let are = if guessed == 1 { "is" } else { "are" };
            let others = if several == 0 {
                String::new()
            } else {
                format!(",{}", shared("other "))
            };
            format!(
                " and so {are} {}{others}",
                counted(guessed, "guessed focal length")
            )
        }
    }
}

/// A condition, and more of them.
pub(crate) fn with(condition: Option<String>, more: &[String]) -> Option<String> {
    let all = condition.into_iter().chain(more.iter().cloned());
    let all: Vec<String> = all.collect();
    let first = all.first()?;
    let begin = if first.starts_with("if ") { "" } else { "if " };
    Some(format!("{begin}{}", all.join(" and ")))
}
