//! Known positions from the pose priors of a COLMAP database.
//!
//! In: a database, and a graph whose cameras are called as its images. Out: one group of the cameras
//! that have a position ([`Displacements`]). That they have one is what is used, not where it is:
//! priors are metres off, and the answer is about positions in general position.

use std::collections::BTreeMap;
use std::path::Path;

use crate::NamedGraph;
use crate::cameras::Cameras;
use crate::colmap::{PosePriors, pose_priors};
use crate::error::{Fault, Place, Problem, ReadError};
use crate::given::Given;
use viewcert::Known;
use viewcert::graph::Displacements;
use viewcert::wording::counted;

/// The cameras of `graph` to which the database `path` gives a position. O(n log n).
///
/// # Errors
/// A database that cannot be read or contradicts itself; one without positions of two cameras.
pub(super) fn read(path: &Path, graph: &NamedGraph) -> Result<Given, ReadError> {
    let name = path.display().to_string();
    let fault = |problem: Problem| Place::Input.fault(problem).in_file(&name);
    let priors = pose_priors(path).map_err(|error| fault(error.into()))?;
    let mut given = of(&priors, graph).map_err(|fault| fault.in_file(&name))?;
    for note in &mut given.notes {
        *note = format!("{name}: {note}");
    }
    Ok(given)
}

fn of(priors: &PosePriors, graph: &NamedGraph) -> Result<Given, Fault> {
    let cameras = Cameras::new(graph);
    // An image at the place of another one of its frame is called by that one.
    let frames = graph.frames.as_ref().into_iter();
    let aliases = frames.flat_map(|frames| &frames.together);
    let aliases: BTreeMap<&str, u32> = aliases
        .flat_map(|(&camera, names)| names.iter().map(move |name| (&**name, camera)))
        .collect();
    let node = |name: &str| aliases.get(name).copied().or_else(|| cameras.node(name));
    let mut known: BTreeMap<u32, [f64; 3]> = BTreeMap::new();
    let mut strangers = 0;
    for (name, &place) in &priors.positions {
        match node(name) {
            Some(node) => drop(known.insert(node, place)),
            None => strangers += 1,
        }
    }
    let Some(first) = known.keys().next().copied().filter(|_| known.len() > 1) else {
        return Err(Place::Input.fault(Problem::new(
            format!(
                "the pose priors of the database give {} of the graph a position, and two are needed",
                counted(known.len(), "camera")
            ),
            "import positions into the database, or write the cameras whose position is known into a file, `position` before each",
        )));
    };
    let stars = known.keys().skip(1).map(|&other| (first, other));
    let group = Displacements::new(graph.graph.nodes() as u32, stars);
    Ok(Given {
        known: Known::Displacements(group.expect("nodes of the graph")),
        notes: notes(priors, &known, strangers, graph),
    })
}

/// What was read, merged and ignored, in words.
fn notes(
    priors: &PosePriors,
    known: &BTreeMap<u32, [f64; 3]>,
    strangers: usize,
    graph: &NamedGraph,
) -> Vec<String> {
    let system = if priors.on_earth {
        "latitude, longitude and altitude"
    } else {
        "x, y and z"
    };
    let deviation = priors.deviation.map_or(String::new(), |deviation| {
        format!(" (standard deviations up to {deviation:.3})")
    });
    let mut notes = vec![format!(
        "the positions of {} ({system}) are taken for known, in general position and in the frame of \
         the directions; how far they are off{deviation} is left out of account",
        counted(known.len(), "camera")
    )];
    if priors.unknown > 0 {
        let has = if priors.unknown == 1 { "has" } else { "have" };
        notes.push(format!(
            "{} {has} a pose prior without a position",
            counted(priors.unknown, "image")
        ));
    }
    if strangers > 0 {
        let is = if strangers == 1 { "is" } else { "are" };
        notes.push(format!(
            "ignored: {} with a position that {is} not in the graph",
            counted(strangers, "image")
        ));
    }
    let mut at: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let mut again = Vec::new();
    for (&node, place) in known {
        // Zero has two signs.
        let bits = place.map(|number| (number + 0.0).to_bits());
        if let Some(&other) = at.get(&bits) {
            again.push((other, node));
        } else {
            at.insert(bits, node);
        }
    }
    if let Some(&(first, second)) = again.first() {
        let [first, second] = [first, second].map(|v| graph.labels.label(v));
        let has = if again.len() == 1 { "has" } else { "have" };
        notes.push(format!(
            "{} {has} the very position of another one, first {second} that of {first}: 'not-finite-solvable' \
             is proved all the same, 'solvable' supposes that they are at different places",
            counted(again.len(), "camera")
        ));
    }
    notes
}
