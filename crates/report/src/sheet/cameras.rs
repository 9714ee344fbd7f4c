//! The images of a reconstruction as a graph: a line where two see points together, a dashed one
//! where they are matched and their tracks are too short, a dotted one where a match would help.
//!
//! A line has the colour of the part that holds both images. Of many lines those are drawn that
//! hold the picture together: a spanning forest of the strongest, and the strongest of every image.

use super::scene::{Between, Kind, Scene, strongest};
use crate::counted;
use crate::force_layout::{Layout, Link, layout};
use crate::graph_picture::{Mark, alone, hinge, shortened, symbol};
use crate::svg::{COLOURS, Svg, escaped};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Width of the picture in pixels, and what is left free around it.
const WIDTH: f64 = 1100.0;
const MARGIN: f64 = 16.0;
/// Most lines of a kind that are all drawn; of more, those of a forest and so many of each image.
const LINES: usize = 4000;
/// Up to so many images have their names beside them.
const NAMED: usize = 40;
/// Size of names in pixels.
const LETTER: f64 = 11.0;
/// Marks that tell parts apart by colour; further parts look alike.
const MARKS: usize = 4 * COLOURS.len();
/// Most parts in the legend.
const LISTED: usize = 8;
/// Width by height of a drawing, about, and the room between its rows.
const ASPECT: f64 = 1.8;
const BETWEEN_ROWS: f64 = 40.0;
/// How far the line of a suggestion goes aside, by its length.
const BEND: f64 = 0.08;
/// Grey of lines in no part.
const GREY: &str = "#8a929c";

impl Scene<'_> {
    /// The colour of a part in a small picture.
    pub(super) fn swatch(&self, part: usize) -> String {
        glyph(&symbol(mark(part), 6.0))
    }

    /// The picture and its legend.
    pub(super) fn html(&self) -> String {
        let (lines, all) = self.chosen();
        let mut notes = String::new();
        if lines.len() < all {
            let _ = writeln!(
                notes,
                "<p class=\"soft\">Drawn are {} of {all} lines: those that hold most, and the strongest of every \
                 image.</p>",
                lines.len()
            );
        }
        format!(
            "<div id=\"picture\">\n{}</div>\n{}{notes}",
            self.drawn(&lines),
            self.legend()
        )
    }

    /// The lines that are drawn, and how many there are.
    fn chosen(&self) -> (Vec<Between>, usize) {
        let mut chosen = Vec::new();
        for kind in [Kind::Tracks, Kind::Short, Kind::Suggested] {
            let lines = self.between.iter().filter(|line| line.kind == kind);
            let mut lines: Vec<Between> = lines.copied().collect();
            if lines.len() > LINES && kind != Kind::Suggested {
                lines.sort_by_key(|line| (std::cmp::Reverse(line.weight), line.ends));
                lines = strongest(self.images as usize, &lines);
            }
            chosen.append(&mut lines);
        }
        (chosen, self.between.len())
    }

    fn drawn(&self, lines: &[Between]) -> String {
        let count = self.images as usize;
        let is_named = count <= NAMED;
        let radius = match count {
            0..=60 => 7.0,
            61..=250 => 5.0,
            _ => 3.4,
        };
        let links = lines.iter().map(|line| Link {
            ends: line.ends,
            length: match line.kind {
                _ if is_named => 130.0,
                Kind::Tracks => 42.0,
                Kind::Short | Kind::Suggested => 90.0,
            },
        });
        let room = if is_named { 16.0 } else { radius };
        let found = layout(&vec![room; count], &links.collect::<Vec<_>>());
        let found = folded(found);
        let names = if is_named {
            (0..self.images).map(|v| shortened(&self.name(v))).collect()
        } else {
            Vec::new()
        };
        let longest = names.iter().map(|name: &String| name.chars().count()).max();
        let sides = MARGIN + 0.6 * LETTER * longest.unwrap_or(0) as f64 / 2.0;
        let below = if names.is_empty() { 0.0 } else { LETTER + 4.0 };
        let scale = ((WIDTH - 2.0 * sides) / found.size[0].max(1.0)).min(1.7);
        let points: Vec<[f64; 2]> = found
            .points
            .iter()
            .map(|[x, y]| [sides + scale * x, MARGIN + scale * y])
            .collect();
        let radius = radius * scale.clamp(0.7, 1.0);
        let radius = |v: u32| match self.parts_of(v).len() {
            0 | 1 => radius,
            _ => radius * 1.45,
        };
        let size = [
            scale * found.size[0] + 2.0 * sides,
            scale * found.size[1] + 2.0 * MARGIN + below,
        ];
        let parts = counted(self.parts.len(), "part");
        let title = format!("{} in {parts}", counted(count, "image"));
        let mut svg = Svg::new(size[0] as u32, size[1] as u32).titled(&title);
        svg.element(self.paths(lines, &points));
        for (v, &[x, y]) in (0..self.images).zip(&points) {
            svg.element(format_args!(
                "<g data-image=\"{v}\" transform=\"translate({x:.1} {y:.1})\"><title>{}</title>{}</g>",
                escaped(&self.title(v)),
                self.node(v, radius(v))
            ));
        }
        for ((v, name), &[x, y]) in (0..).zip(&names).zip(&points) {
            svg.element(format_args!(
                "<text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"{LETTER}\" text-anchor=\"middle\" \
                 class=\"ink-text\" fill=\"#444\">{}</text>",
                y + radius(v) + LETTER,
                escaped(name)
            ));
        }
        svg.finish()
    }

    /// What is said of an image where the pointer rests on it.
    fn title(&self, image: u32) -> String {
        let parts = self.parts_of(image).iter();
        let parts = parts.map(|&k| self.parts[k as usize].component.to_string());
        let parts: Vec<String> = parts.collect();
        let name = self.name(image);
        match parts.len() {
            0 => format!("{name}: in no part"),
            1 => format!("{name}: part {}", parts[0]),
            _ => format!("{name}: parts {}", parts.join(", ")),
        }
    }

    fn node(&self, image: u32, radius: f64) -> String {
        let parts = self.parts_of(image);
        let marks: Vec<Mark> = parts.iter().map(|&k| mark(k as usize)).collect();
        match marks[..] {
            [] => alone(radius),
            [mark] => symbol(mark, radius),
            _ => hinge(&marks, radius),
        }
    }

    /// A path for each part and kind of line.
    fn paths(&self, lines: &[Between], points: &[[f64; 2]]) -> String {
        let mut paths: BTreeMap<(Kind, Option<usize>), String> = BTreeMap::new();
        for line in lines {
            let ([a, b], [c, d]) = (points[line.ends.0 as usize], points[line.ends.1 as usize]);
            let part = match line.kind {
                Kind::Tracks => self.part_of(line.ends),
                _ => None,
            };
            let path = paths.entry((line.kind, part)).or_default();
            // Writing to a string does not fail.
            let _ = match line.kind {
                // Beside the line of a pair that is matched already.
                Kind::Suggested => {
                    let (x, y) = (
                        (a + c) / 2.0 + BEND * (d - b),
                        (b + d) / 2.0 - BEND * (c - a),
                    );
                    write!(path, "M{a:.1} {b:.1}Q{x:.1} {y:.1} {c:.1} {d:.1}")
                }
                _ => write!(path, "M{a:.1} {b:.1}L{c:.1} {d:.1}"),
            };
        }
        let width = match lines.len() {
            0..=200 => 1.6,
            201..=1500 => 0.9,
            _ => 0.5,
        };
        let mut body = String::new();
        for ((kind, part), path) in paths {
            let colour = part.map_or(GREY, |part| mark(part).colour());
            let style = style(kind, width, colour);
            let _ = writeln!(body, "<path d=\"{path}\" fill=\"none\" {style}/>");
        }
        body
    }

    fn legend(&self) -> String {
        let mut items = Vec::new();
        for (k, part) in self.parts.iter().enumerate().take(LISTED) {
            let images = counted(part.images.len(), "image");
            items.push((self.swatch(k), format!("part {}: {images}", part.component)));
        }
        if let Some(more) = self.parts.len().checked_sub(LISTED + 1) {
            items.push((
                String::new(),
                format!("and {}", counted(more + 1, "smaller part")),
            ));
        }
        let hinges = (0..self.images)
            .filter(|&v| self.parts_of(v).len() > 1)
            .count();
        if hinges > 0 {
            let words = format!("{} in several parts", counted(hinges, "image"));
            items.push((glyph(&hinge(&[Mark::Own(0), Mark::Own(1)], 6.5)), words));
        }
        let outside = self.outside().count();
        if outside > 0 {
            items.push((
                glyph(&alone(6.0)),
                format!("{} in no part", counted(outside, "image")),
            ));
        }
        let of = |kind| self.between.iter().filter(|line| line.kind == kind).count();
        let together = match self.report.input.cameras {
            Some(_) => "see points together",
            None => "are matched",
        };
        for (kind, words) in [
            (Kind::Tracks, together),
            (Kind::Short, "are matched, their tracks too short"),
            (Kind::Suggested, "are suggested to be matched"),
        ] {
            let count = of(kind);
            if count > 0 {
                let line = format!(
                    "<path d=\"M-9 0H9\" fill=\"none\" {}/>",
                    style(kind, 2.0, GREY)
                );
                let words = format!("{} of images {words}", counted(count, "pair"));
                items.push((glyph(&line), words));
            }
        }
        let items = items
            .iter()
            .map(|(glyph, words)| format!("<li>{glyph}<span>{words}</span></li>\n"));
        format!(
            "<ul class=\"legend\">\n{}</ul>\n",
            items.collect::<String>()
        )
    }
}

/// A drawing that is much wider than high in rows from left to right and back, as a walk with many
/// images is laid out along a line.
fn folded(layout: Layout) -> Layout {
    let [width, height] = layout.size;
    let rows = (width / height.max(1.0) / ASPECT).sqrt().round();
    if rows < 2.0 {
        return layout;
    }
    let row = width / rows;
    let points = layout.points.iter().map(|&[x, y]| {
        let number = (x / row).floor().min(rows - 1.0);
        let along = x - number * row;
        let is_back = number % 2.0 == 1.0;
        let x = if is_back { row - along } else { along };
        [x, y + number * (height + BETWEEN_ROWS)]
    });
    Layout {
        points: points.collect(),
        size: [row, rows * (height + BETWEEN_ROWS) - BETWEEN_ROWS],
    }
}

/// How a line of a kind looks.
fn style(kind: Kind, width: f64, colour: &str) -> String {
    match kind {
        Kind::Tracks => format!("stroke=\"{colour}\" stroke-width=\"{width}\""),
        Kind::Short => format!(
            "stroke=\"#444\" class=\"cut\" stroke-width=\"{width}\" stroke-dasharray=\"6 4\""
        ),
        Kind::Suggested => format!(
            "stroke=\"#0b5cad\" class=\"suggested\" stroke-width=\"{}\" stroke-dasharray=\"1.5 3.5\" \
             stroke-linecap=\"round\"",
            1.4 * width.max(1.2)
        ),
    }
}

/// A small picture in a line of text.
fn glyph(symbol: &str) -> String {
    format!(
        "<svg width=\"20\" height=\"16\" viewBox=\"-10 -8 20 16\" aria-hidden=\"true\">{symbol}</svg>"
    )
}

/// How the parts look, those with most images first.
fn mark(part: usize) -> Mark {
    if part < MARKS {
        Mark::Own(part)
    } else {
        Mark::Other
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neighbours on a line stay neighbours, and everything lies inside.
    #[test]
    fn a_long_drawing_is_folded() {
        let points = (0..100).map(|k| [f64::from(k) * 10.0, 10.0]);
        let long = Layout {
            points: points.collect(),
            size: [1000.0, 20.0],
        };
        let found = folded(long.clone());
        assert!(found.size[0] < 300.0, "{:?}", found.size);
        for two in found.points.windows(2) {
            let far = (two[0][0] - two[1][0]).hypot(two[0][1] - two[1][1]);
            assert!(far <= 20.0 + BETWEEN_ROWS + 10.0, "{two:?}");
        }
        let inside = |p: &[f64; 2]| (0..2).all(|k| 0.0 <= p[k] && p[k] <= found.size[k]);
        assert!(found.points.iter().all(inside));
        let square = Layout {
            size: [1000.0, 600.0],
            ..long
        };
        assert_eq!(folded(square.clone()).points, square.points);
    }
}
