//! Known positions from the pose priors of a COLMAP database.
//!
//! In: a database, and a graph whose cameras are called as its images. Out: one group of the cameras
//! that have a position ([`Displacements`]), with the vectors between them, rounded as docs/databases.md
//! says.

use std::collections::BTreeMap;
use std::path::Path;

use crate::NamedGraph;
use crate::cameras::Cameras;
use crate::colmap::{PosePriors, pose_priors};
use crate::error::{Fault, Place, Problem, ReadError};
use crate::given::displacements::{Vector, between, long_vectors};
use crate::given::{Given, POSITIONS, at_one_place, known_in, one_place, unmeasured};
use viewcert::graph::{CoordinateError, Displacements, coordinate};
use viewcert::wording::counted;

/// That the pose priors of a graph's own database would be known positions if they were asked for: they are
/// metres off, so nothing rests on them unasked.
pub(super) fn not_used(graph: &NamedGraph) -> Option<String> {
    let of_tracks = graph.database.as_ref().filter(|_| graph.cameras.is_some());
    let positions = of_tracks?.positions;
    (positions > 1).then(|| {
        format!(
            "the pose priors of {} count only with --given {}, which takes their positions for known",
            counted(positions, "image"),
            graph.name
        )
    })
}

/// The cameras of `graph` to which the database `path` gives a position. O(n log n).
///
/// # Errors
/// A database that cannot be read or contradicts itself; one without positions of two cameras.
pub(super) fn read(path: &Path, graph: &NamedGraph, one_frame: bool) -> Result<Given, ReadError> {
    let name = path.display().to_string();
    let fault = |problem: Problem| Place::Input.fault(problem).in_file(&name);
    let priors = pose_priors(path).map_err(fault)?;
    let mut given = of(&priors, graph, one_frame).map_err(|fault| fault.in_file(&name))?;
    for note in &mut given.notes {
        *note = format!("{name}: {note}");
    }
    Ok(given)
}

fn of(priors: &PosePriors, graph: &NamedGraph, one_frame: bool) -> Result<Given, Fault> {
    let cameras = Cameras::new(graph);
    // An image at the place of another one of its frame is called by that one.
    let frames = graph.frames.as_ref().into_iter();
    let aliases = frames.flat_map(|frames| &frames.together);
    let aliases: BTreeMap<&str, u32> = aliases
        .flat_map(|(&camera, names)| names.iter().map(move |name| (&**name, camera)))
        .collect();
    let node = |name: &str| aliases.get(name).copied().or_else(|| cameras.node(name));
    let mut known: BTreeMap<u32, Vector> = BTreeMap::new();
    let mut strangers = 0;
    for (name, &place) in &priors.positions {
        match node(name) {
            Some(node) => {
                let place = rounded(place, priors.on_earth);
                let place = place.map_err(|_| long_vectors())?;
                known.insert(node, place);
            }
            None => strangers += 1,
        }
    }
    let count = known.len();
    let places = known.iter().map(|(&node, place)| (node, place));
    let (again, same) = at_one_place(places, graph, one_frame);
    let (alone, of_alone) = unmeasured(known.keys().copied(), graph, one_frame);
    known.retain(|node, _| !again.contains(node) && !alone.contains(node));
    let first = known.iter().next();
    let Some((&first, start)) = first.filter(|_| known.len() > 1) else {
        let problem = match count {
            0 | 1 => Problem::new(
                format!(
                    "the pose priors of the database give {} of the graph a position, and two are needed",
                    counted(count, "camera")
                ),
                POSITIONS,
            ),
            _ => one_place(count),
        };
        return Err(problem.into());
    };
    let others = known.iter().skip(1);
    let vectors = others.map(|(&other, place)| (first, other, between(start, place)));
    let group = Displacements::anywhere(graph.graph.nodes() as u32, vectors);
    let group = group.map_err(|_| long_vectors())?;
    let notes = notes(priors, count, strangers, one_frame);
    Ok(Given {
        known: known_in(group, one_frame),
        notes: notes.into_iter().chain(same).chain(of_alone).collect(),
    })
}

/// A position as exact numbers: x, y, z to six decimals; of latitude and longitude in degrees, and altitude, the
/// centre of the Earth the origin, metres to three decimals.
fn rounded(place: [f64; 3], on_earth: bool) -> Result<Vector, CoordinateError> {
    let text = |number: f64| match on_earth {
        true => format!("{number:.3}"),
        false => format!("{number:.6}"),
    };
    let [x, y, z] = if on_earth { from_centre(place) } else { place };
    Ok([
        coordinate(&text(x))?,
        coordinate(&text(y))?,
        coordinate(&text(z))?,
    ])
}

/// Latitude, longitude and altitude in metres from the centre of the Earth, on the ellipsoid of WGS84.
fn from_centre([latitude, longitude, altitude]: [f64; 3]) -> [f64; 3] {
    let (equator, flattening) = (6_378_137.0, 1.0 / 298.257_223_563);
    let squared: f64 = flattening * (2.0 - flattening);
    let (sin, cos) = latitude.to_radians().sin_cos();
    let normal = equator / (1.0 - squared * sin * sin).sqrt();
    let (east, along) = longitude.to_radians().sin_cos();
    let from_axis = (normal + altitude) * cos;
    [
        from_axis * along,
        from_axis * east,
        (normal * (1.0 - squared) + altitude) * sin,
    ]
}

/// What was read, merged and ignored, in words.
fn notes(priors: &PosePriors, known: usize, strangers: usize, one_frame: bool) -> Vec<String> {
    let system = if priors.on_earth {
        "latitude, longitude and altitude, in metres to three decimals"
    } else {
        "x, y and z, to six decimals"
    };
    let frame = if one_frame {
        "in the frame of the directions (--one-frame)"
    } else {
        "in a frame of their own"
    };
    let deviation = priors.deviation.map_or(String::new(), |deviation| {
        format!(" (standard deviations up to {deviation:.3})")
    });
    let mut notes = vec![format!(
        "the positions of {} ({system}) are taken for known, {frame}; how far they are off{deviation} is \
         left out of account",
        counted(known, "camera")
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
    notes
}
