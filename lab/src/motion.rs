//! What moves at given cameras, drawn: an arrow for every centre, for each motion of a basis
//! (docs/theory.md, Proposition 16.7).
//!
//! In: centres and velocities, exact. Out: a picture in floating point, which proves nothing. Velocities are of
//! first order: arrows are tangents of paths, and their lengths are to scale within one motion only.

use std::fmt::Write;
use viewcert::at_cameras::{Centres, Here, Motion};
use viewcert::decide::Component;
use viewcert::graph::Lists;
use viewcert::linalg::integer::{Integer, Signed};
use viewcert::linalg::rational::{Rational, quotient};
use viewcert::wording::counted;
use viewcert_formats::NamedGraph;
use viewcert_report::scene::{Edge, Kind, Scene, document, text};

/// Most motions that are drawn, in rows of three.
const DRAWN: usize = 6;
const COLUMNS: usize = 3;
/// Most cameras that have their names.
const NAMED: usize = 24;
const SIZE: f64 = 280.0;
const MARGIN: f64 = 36.0;
/// The longest arrow, as a part of the panel.
const LONGEST: f64 = 0.22;

/// What moves, and where.
pub(super) struct Moved<'a> {
    pub(super) input: &'a NamedGraph,
    pub(super) here: &'a Here,
    pub(super) centres: &'a Centres,
    /// A basis.
    pub(super) motions: &'a [Motion],
}

/// The picture of the motions that are left; `None` if there are none, or none that can be drawn.
pub(super) fn picture(report: &Moved) -> Option<String> {
    let input = report.input;
    let centres: Vec<(u32, [f64; 3])> = (0..)
        .zip(report.centres.places())
        .filter_map(|(v, place)| Some((v, centre(place)?)))
        .collect();
    let motions = &report.motions[..report.motions.len().min(DRAWN)];
    let (Some((_, first)), false) = (centres.first(), motions.is_empty()) else {
        return None;
    };
    // Along an axis in which all coordinates are equal, or from a corner.
    let axis = [2, 1, 0]
        .into_iter()
        .find(|&k| centres.iter().all(|(_, place)| place[k] == first[k]));
    let places: Vec<[f64; 2]> = centres.iter().map(|(_, place)| flat(axis, place)).collect();
    let bound =
        |k: usize, pick: fn(f64, f64) -> f64, from| places.iter().map(|p| p[k]).fold(from, pick);
    let least = [0, 1].map(|k| bound(k, f64::min, f64::MAX));
    let extent = [0, 1].map(|k| bound(k, f64::max, f64::MIN) - least[k]);
    let extent = extent[0].max(extent[1]).max(f64::MIN_POSITIVE);
    let scene = scene(report, &centres);
    let nodes: Vec<u32> = (0..centres.len() as u32).collect();
    let names = if input.graph.nodes() <= NAMED {
        &scene.names[..]
    } else {
        &[]
    };
    let (mut body, all) = (String::new(), report.motions.len());
    for (k, motion) in motions.iter().enumerate() {
        let left = MARGIN + (k % COLUMNS) as f64 * (SIZE + MARGIN);
        let top = 2.0 * MARGIN + (k / COLUMNS) as f64 * (SIZE + 2.0 * MARGIN);
        // A square of the panel leaves room for arrows.
        let room = LONGEST * SIZE / 2.0;
        let place = |p: &[f64; 2]| {
            let at = |k: usize| room + (p[k] - least[k]) / extent * (SIZE - 2.0 * room);
            [left + at(0), top + at(1)]
        };
        let points: Vec<[f64; 2]> = places.iter().map(place).collect();
        let moving = (0..input.graph.nodes() as u32)
            .filter(|&v| motion.moves(v))
            .count();
        let verb = if moving == 1 { "moves" } else { "move" };
        let words = format!(
            "motion {} of {all}: {} {verb}",
            k + 1,
            counted(moving, "centre")
        );
        text(&mut body, [left, top - 16.0], 13, "start", &words);
        body += &scene.body(&nodes, &scene.edges, &points, names);
        let velocities = centres.iter().map(|&(v, _)| {
            let velocity = motion.velocities[v as usize].as_ref();
            velocity.map(|velocity| flat(axis, &velocity.each_ref().map(float)))
        });
        let arrows = to_scale(
            &velocities
                .map(Option::unwrap_or_default)
                .collect::<Vec<_>>(),
        );
        for ((&(v, _), &at), by) in centres.iter().zip(&points).zip(arrows) {
            if motion.moves(v) {
                arrow(&mut body, at, by);
            }
        }
    }
    let (rows, columns) = (motions.len().div_ceil(COLUMNS), motions.len().min(COLUMNS));
    let width = columns as f64 * (SIZE + MARGIN) + MARGIN;
    let height = rows as f64 * (SIZE + 2.0 * MARGIN) + MARGIN;
    let far = match report.centres.places().len() - centres.len() {
        0 => String::new(),
        far => format!("; not drawn: {} at infinity", counted(far, "camera")),
    };
    let words = format!("first order; the largest part is held still{far}");
    text(&mut body, [MARGIN, height - 12.0], 12, "start", &words);
    let motions = counted(all, "motion");
    let title = format!(
        "{}: what moves at the given cameras, {motions} of first order",
        input.name
    );
    Some(document([width, height], &title, &body))
}

/// The cameras whose centres are not at infinity, in the colours of the parts here.
fn scene(report: &Moved, centres: &[(u32, [f64; 3])]) -> Scene {
    let node = |v: u32| {
        centres
            .binary_search_by_key(&v, |&(v, _)| v)
            .ok()
            .map(|k| k as u32)
    };
    let parts = report.here.components.value.iter().map(Component::nodes);
    let parts: Vec<Vec<u32>> = parts.collect();
    let part_of = |&(i, j): &(u32, u32)| {
        let holds = |part: &Vec<u32>, v: u32| part.binary_search(&v).is_ok();
        parts
            .iter()
            .position(|part| holds(part, i) && holds(part, j))
    };
    let pairs = report.input.graph.edges().iter();
    let pairs = pairs.map(|pair| (pair, part_of(pair)));
    let edges = pairs.filter_map(|(&(i, j), part)| {
        Some(Edge {
            ends: (node(i)?, node(j)?),
            group: part.map(|part| part as u32),
            kind: Kind::Pair,
            weight: 1,
        })
    });
    let edges: Vec<Edge> = edges.collect();
    let ends = edges
        .iter()
        .filter_map(|edge| Some((edge.ends, edge.group?)));
    let mut members: Vec<(u32, u32)> = ends
        .flat_map(|((i, j), part)| [(i, part), (j, part)])
        .collect();
    members.sort_unstable();
    members.dedup();
    let parts = parts.len();
    let name = |&(v, _): &(u32, _)| report.input.labels.label(v).into_owned();
    Scene {
        title: String::new(),
        names: centres.iter().map(name).collect(),
        groups: vec![String::new(); parts],
        larger: parts,
        groups_of: Lists::group(centres.len(), members.into_iter()),
        edges,
        edge: "pair",
    }
}

fn arrow(out: &mut String, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) {
    const STYLE: &str = "stroke:#222;stroke-width:1.5;fill:none";
    let length = dx.hypot(dy);
    let (right, down) = (x + dx, y + dy);
    let [u, v] = [dx / length, dy / length];
    let barb = |side: f64| {
        let (x, y) = (
            right - 7.0 * u - side * 4.0 * v,
            down - 7.0 * v + side * 4.0 * u,
        );
        format!("{x:.1},{y:.1}")
    };
    // Writing to a string does not fail. A motion along the line of sight has no arrow but a ring.
    let _ = match length < 1.0 {
        true => writeln!(
            out,
            r#"<circle cx="{x:.1}" cy="{y:.1}" r="8.0" style="{STYLE}"/>"#
        ),
        false => writeln!(
            out,
            "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{right:.1}\" y2=\"{down:.1}\" style=\"{STYLE}\"/>\n\
             <polyline points=\"{} {right:.1},{down:.1} {}\" style=\"{STYLE}\"/>",
            barb(1.0),
            barb(-1.0)
        ),
    };
}

/// Velocities in pixels, the longest one of the length that is meant.
fn to_scale(velocities: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let finite = velocities
        .iter()
        .map(|v| v.map(|x| if x.is_finite() { x } else { 0.0 }));
    let longest = finite
        .clone()
        .map(|[x, y]| x.hypot(y))
        .fold(f64::MIN_POSITIVE, f64::max);
    finite
        .map(|v| v.map(|x| x * LONGEST * SIZE / longest))
        .collect()
}

/// Right, and down.
fn flat(axis: Option<usize>, [x, y, z]: &[f64; 3]) -> [f64; 2] {
    match axis {
        Some(0) => [*y, -z],
        Some(1) => [*x, -z],
        Some(_) => [*x, -y],
        None => [0.8 * x - 0.6 * y, 0.36 * x + 0.48 * y - 0.8 * z],
    }
}

/// A centre in space; nothing at infinity.
fn centre([x, y, z, w]: &[Integer; 4]) -> Option<[f64; 3]> {
    let over = |x: &Integer| quotient(x.clone(), w.clone()).map(|x| float(&x));
    Some([over(x)?, over(y)?, over(z)?])
}

/// The number that is nearly this one, however long its numerator and denominator are.
fn float(x: &Rational) -> f64 {
    let digits = |x: &Integer| {
        let text = x.abs().to_string();
        let mantissa: f64 = format!("0.{text}").parse().unwrap_or_default();
        (mantissa, text.len() as i32)
    };
    let (above, below) = (digits(x.numer()), digits(x.denom()));
    let size = above.0 / below.0 * 10f64.powi(above.1 - below.1);
    if x.numer().is_negative() { -size } else { size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::linalg::integer::decimal;

    fn rational(n: &str, d: &str) -> Rational {
        let integer = |text: &str| decimal(text).unwrap();
        Rational::new(integer(n), integer(d))
    }

    #[test]
    fn long_fractions_are_floats() {
        assert!((float(&rational("-3", "4")) + 0.75).abs() < 1e-12);
        assert_eq!(float(&rational("0", "7")), 0.0);
        let long = format!("1{}", "0".repeat(400));
        let near = float(&rational(&long, &format!("8{}", "0".repeat(399))));
        assert!((near - 1.25).abs() < 1e-12, "{near}");
    }

    /// The longest arrow has the length that is meant, and others are to scale.
    #[test]
    fn arrows_are_to_scale() {
        let found = to_scale(&[[3.0, 4.0], [0.0, -2.5], [0.0, 0.0]]);
        let longest = LONGEST * SIZE;
        assert!((found[0][0].hypot(found[0][1]) - longest).abs() < 1e-9);
        assert!((found[1][1] + longest / 2.0).abs() < 1e-9);
        assert_eq!(found[2], [0.0, 0.0]);
    }
}
