//! What moves at given cameras, drawn: an arrow for every centre, for each motion of a basis
//! (docs/theory.md, Proposition 16.7).
//!
//! In: centres and velocities, exact. Out: a picture in floating point, which proves nothing, still with arrows
//! or also moving to and fro. Velocities are of first order: arrows are tangents of paths, and their
//! lengths are to scale within one motion only.

use super::counted;
use super::here::HereReport;
use super::svg::{COLOURS, Svg};
use super::witness_file::labels;
use std::fmt::Write;
use viewcert::here::Motion;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::Rational;

/// Most motions that are drawn, in rows of three.
const DRAWN: usize = 6;
const COLUMNS: usize = 3;
/// Most cameras that have their names.
const NAMED: usize = 24;

const SIZE: f64 = 280.0;
const MARGIN: f64 = 36.0;
/// The longest arrow, as a part of the panel.
const LONGEST: f64 = 0.22;

const GREY: &str = "#8a929c";
const ARROW: &str = "stroke:#222;stroke-width:1.5;fill:none";

/// Whether the picture moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frames {
    /// Arrows alone.
    Still,
    /// Also to and fro along the arrows, by SMIL, in elements of the class `moving`.
    Moving,
}

/// The picture of the motions that are left; `None` if there are none, or none that can be drawn.
pub fn picture(report: &HereReport, frames: Frames) -> Option<String> {
    let motions = &report.motions[..report.motions.len().min(DRAWN)];
    if motions.is_empty() {
        return None;
    }
    let places: Vec<Option<[f64; 3]>> = report.centres.places().iter().map(centre).collect();
    let plane = Plane::through(places.iter().flatten())?;
    let rows = motions.len().div_ceil(COLUMNS);
    let columns = motions.len().min(COLUMNS);
    let width = columns as f64 * (SIZE + MARGIN) + MARGIN;
    let height = rows as f64 * (SIZE + 2.0 * MARGIN) + MARGIN;
    let all = report.motions.len();
    let title = format!(
        "{}: what moves at the given cameras, {} of first order",
        report.input.name,
        counted(all, "motion")
    );
    let mut svg = Svg::new(width as u32, height as u32).titled(&title);
    let places: Vec<Option<[f64; 2]>> = places
        .iter()
        .map(|place| Some(plane.flat(&(*place)?)))
        .collect();
    let extent = Extent::of(places.iter().flatten());
    let labels = labels(report.input);
    for (k, motion) in motions.iter().enumerate() {
        let left = MARGIN + (k % COLUMNS) as f64 * (SIZE + MARGIN);
        let top = 2.0 * MARGIN + (k / COLUMNS) as f64 * (SIZE + 2.0 * MARGIN);
        let velocities = motion.velocities.iter().map(|velocity| {
            let velocity = velocity.as_ref()?.each_ref().map(float);
            Some(plane.flat(&velocity))
        });
        let panel = Panel {
            places: places
                .iter()
                .map(|place| Some(extent.place(&(*place)?, [left, top])))
                .collect(),
            arrows: arrows(&velocities.collect::<Vec<_>>(), &places),
        };
        let moving = (0..places.len() as u32)
            .filter(|&v| motion.moves(v))
            .count();
        let words = format!(
            "motion {} of {all}: {} {}",
            k + 1,
            counted(moving, "centre"),
            if moving == 1 { "moves" } else { "move" }
        );
        svg.text([left, top - 16.0], 13, "start", &words);
        panel.draw(&mut svg, report, motion, &labels, frames);
    }
    let mut words = "first order; the largest part is held still".to_owned();
    let far = places.iter().filter(|place| place.is_none()).count();
    if far > 0 {
        // Writing to a string does not fail.
        let _ = write!(words, "; not drawn: {} at infinity", counted(far, "camera"));
    }
    svg.text([MARGIN, height - 12.0], 12, "start", &words);
    Some(svg.finish())
}

/// A motion, in pixels.
struct Panel {
    places: Vec<Option<[f64; 2]>>,
    arrows: Vec<[f64; 2]>,
}

impl Panel {
    fn draw(
        &self,
        svg: &mut Svg,
        report: &HereReport,
        motion: &Motion,
        labels: &[String],
        frames: Frames,
    ) {
        for (&(i, j), part) in report
            .input
            .graph
            .edges()
            .iter()
            .zip(report.parts_of_edges())
        {
            let (i, j) = (i as usize, j as usize);
            let (Some(a), Some(b)) = (self.places[i], self.places[j]) else {
                continue;
            };
            let colour = part.map_or(GREY, |part| COLOURS[part % COLOURS.len()]);
            svg.line(
                a,
                b,
                &format!("stroke:{colour};stroke-width:1.5;opacity:.6"),
            );
            if frames == Frames::Moving {
                let ([x, y], [z, w]) = (a, b);
                let [from, to] = [i, j].map(|v| self.arrows[v]);
                let ends = [
                    ("x1", x, from[0]),
                    ("y1", y, from[1]),
                    ("x2", z, to[0]),
                    ("y2", w, to[1]),
                ];
                svg.element(format_args!(
                    r#"<line class="moving" x1="{x:.1}" y1="{y:.1}" x2="{z:.1}" y2="{w:.1}" style="stroke:{colour};stroke-width:2">{}</line>"#,
                    animated(&ends)
                ));
            }
        }
        for (v, place) in self.places.iter().enumerate() {
            let (Some([x, y]), [dx, dy]) = (*place, self.arrows[v]) else {
                continue;
            };
            let moves = motion.moves(v as u32);
            if moves {
                arrow(svg, [x, y], [dx, dy]);
            }
            let fill = if moves { COLOURS[1] } else { COLOURS[0] };
            svg.circle([x, y], 4.0, &format!("fill:{fill}"));
            if frames == Frames::Moving && moves {
                svg.element(format_args!(
                    r#"<circle class="moving" cx="{x:.1}" cy="{y:.1}" r="4" style="fill:{fill}">{}</circle>"#,
                    animated(&[("cx", x, dx), ("cy", y, dy)])
                ));
            }
            if labels.len() <= NAMED {
                svg.text([x + 6.0, y - 6.0], 11, "start", &labels[v]);
            }
        }
    }
}

/// Values of attributes that go to and fro.
fn animated(ends: &[(&str, f64, f64)]) -> String {
    let mut all = String::new();
    for (name, at, by) in ends {
        let (ahead, behind) = (at + by, at - by);
        // Writing to a string does not fail.
        let _ = write!(
            all,
            r#"<animate attributeName="{name}" dur="4s" repeatCount="indefinite" values="{at:.1};{ahead:.1};{at:.1};{behind:.1};{at:.1}"/>"#
        );
    }
    all
}

fn arrow(svg: &mut Svg, [x, y]: [f64; 2], [dx, dy]: [f64; 2]) {
    let length = dx.hypot(dy);
    // A motion along the line of sight has no arrow but a ring.
    if length < 1.0 {
        svg.circle([x, y], 8.0, ARROW);
        return;
    }
    let (tip, [u, v]) = ([x + dx, y + dy], [dx / length, dy / length]);
    svg.line([x, y], tip, ARROW);
    let barb = |side: f64| {
        [
            tip[0] - 7.0 * u - side * 4.0 * v,
            tip[1] - 7.0 * v + side * 4.0 * u,
        ]
    };
    svg.polyline(&[barb(1.0), tip, barb(-1.0)], ARROW);
}

/// Arrows in pixels, the longest one of the length that is meant. A velocity is to the extent of the scene what an
/// arrow is to the panel, but for one factor for all.
fn arrows(velocities: &[Option<[f64; 2]>], places: &[Option<[f64; 2]>]) -> Vec<[f64; 2]> {
    let drawn = |(velocity, place): (&Option<[f64; 2]>, &Option<[f64; 2]>)| {
        let shown =
            velocity.filter(|velocity| place.is_some() && velocity.iter().all(|x| x.is_finite()));
        shown.unwrap_or_default()
    };
    let all: Vec<[f64; 2]> = velocities.iter().zip(places).map(drawn).collect();
    let longest = all
        .iter()
        .map(|[x, y]| x.hypot(*y))
        .fold(f64::MIN_POSITIVE, f64::max);
    let scale = LONGEST * SIZE / longest;
    all.into_iter()
        .map(|[x, y]| [x * scale, y * scale])
        .collect()
}

/// From where centres are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Plane {
    /// Along an axis in which all coordinates are equal.
    Along(usize),
    /// From a corner.
    Corner,
}

impl Plane {
    /// Nothing if there are no centres.
    fn through<'a>(places: impl Iterator<Item = &'a [f64; 3]>) -> Option<Self> {
        let places: Vec<&[f64; 3]> = places.collect();
        let first = places.first()?;
        let is_flat = |k: &usize| places.iter().all(|place| place[*k] == first[*k]);
        Some(
            [2, 1, 0]
                .into_iter()
                .find(is_flat)
                .map_or(Self::Corner, Self::Along),
        )
    }

    /// Right, and down.
    fn flat(self, [x, y, z]: &[f64; 3]) -> [f64; 2] {
        match self {
            Self::Along(0) => [*y, -z],
            Self::Along(1) => [*x, -z],
            Self::Along(_) => [*x, -y],
            Self::Corner => [0.8 * x - 0.6 * y, 0.36 * x + 0.48 * y - 0.8 * z],
        }
    }
}

/// Where points are.
struct Extent {
    least: [f64; 2],
    size: f64,
}

impl Extent {
    fn of<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Self {
        let (mut least, mut most) = ([f64::MAX; 2], [f64::MIN; 2]);
        for point in points {
            for k in 0..2 {
                least[k] = least[k].min(point[k]);
                most[k] = most[k].max(point[k]);
            }
        }
        let size = (most[0] - least[0]).max(most[1] - least[1]);
        Self {
            least,
            size: size.max(f64::MIN_POSITIVE),
        }
    }

    /// In a square of the panel that leaves room for arrows.
    fn place(&self, point: &[f64; 2], corner: [f64; 2]) -> [f64; 2] {
        let room = LONGEST * SIZE / 2.0;
        let inner = SIZE - 2.0 * room;
        [0, 1].map(|k| corner[k] + room + (point[k] - self.least[k]) / self.size * inner)
    }
}

/// A centre in space; nothing at infinity.
fn centre([x, y, z, w]: &[Integer; 4]) -> Option<[f64; 3]> {
    let over = |x: &Integer| Rational::new(x.clone(), w.clone()).map(|x| float(&x));
    Some([over(x)?, over(y)?, over(z)?])
}

/// The number that is nearly this one, however long its numerator and denominator are.
fn float(x: &Rational) -> f64 {
    let digits = |x: &Integer| {
        let text = x.abs().to_string();
        let mantissa: f64 = format!("0.{text}").parse().unwrap_or_default();
        (mantissa, text.len() as i32)
    };
    let (above, below) = (digits(x.numerator()), digits(x.denominator()));
    let size = above.0 / below.0 * 10f64.powi(above.1 - below.1);
    if x.numerator().sign().is_lt() {
        -size
    } else {
        size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(n: &str, d: &str) -> Rational {
        let integer = |text: &str| Integer::from_decimal(text).unwrap();
        Rational::new(integer(n), integer(d)).unwrap()
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
        let at = Some([0.0, 0.0]);
        let found = arrows(&[Some([3.0, 4.0]), Some([0.0, -2.5]), None], &[at, at, at]);
        let longest = LONGEST * SIZE;
        assert!((found[0][0].hypot(found[0][1]) - longest).abs() < 1e-9);
        assert!((found[1][1] + longest / 2.0).abs() < 1e-9);
        assert_eq!(found[2], [0.0, 0.0]);
    }

    #[test]
    fn a_plane_is_looked_at_from_above() {
        let places = [[0.0, 1.0, 5.0], [2.0, 3.0, 5.0]];
        assert_eq!(Plane::through(places.iter()), Some(Plane::Along(2)));
        let places = [[0.0, 1.0, 5.0], [2.0, 3.0, 4.0]];
        assert_eq!(Plane::through(places.iter()), Some(Plane::Corner));
        assert_eq!(Plane::through([].iter()), None);
    }
}
