//! The images of a reconstruction as a graph: a line where two see points together, a dashed one
//! where they are matched and their tracks are too short, a dotted one where a match would help.
//!
//! A line has the colour of the part that holds both images. Of many lines those are drawn that
//! hold the picture together: a spanning forest of the strongest, and the strongest of every image.

use crate::force_layout::{Layout, Link, layout};
use crate::graph_picture::{Mark, alone, hinge, shortened, symbol};
use crate::svg::{COLOURS, Svg, escaped};
use crate::{Report, counted, tracks};
use std::collections::BTreeMap;
use std::fmt::Write;
use viewcert::graph::{Lists, UnionFind};
use viewcert_advice::Advice;

/// Width of the picture in pixels, and what is left free around it.
const WIDTH: f64 = 1100.0;
const MARGIN: f64 = 16.0;
/// Most lines of a kind that are all drawn; of more, those of a forest and so many of each image.
const LINES: usize = 1500;
const STRONGEST: usize = 2;
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

/// What a line stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// The two see points together, or are a pair of a graph without tracks.
    Tracks,
    /// They are matched, and no track of theirs counts.
    Short,
    /// To match them would help.
    Suggested,
}

/// A line between two images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Between {
    /// The smaller node first.
    ends: (u32, u32),
    kind: Kind,
    /// How many points they see together.
    weight: u32,
}

/// A part: a component with two cameras and more of tracks, with three images and more of pairs.
pub(super) struct Part {
    /// Its number among the components, from 1.
    pub(super) component: usize,
    /// Its images, increasing.
    pub(super) images: Vec<u32>,
    /// How many points it has, if there are tracks.
    pub(super) points: Option<usize>,
}

/// The images of a report, in what parts they are and what is between them.
pub struct Scene<'a> {
    report: Report<'a>,
    /// The parts, those with most images first.
    pub(super) parts: Vec<Part>,
    of_image: Lists,
    images: u32,
    between: Vec<Between>,
}

impl<'a> Scene<'a> {
    /// The images of a report on tracks, or on calibrated pairs. `pairs` are pairs that are matched,
    /// where the report is on tracks. O(k log k) for k pairs of images that see a point together,
    /// with repetition.
    pub fn new(report: Report<'a>, pairs: &[(u32, u32)]) -> Self {
        let graph = &report.input.graph;
        let images = report.input.cameras.unwrap_or(graph.nodes() as u32);
        let components = report.verdict.components.iter().zip(1..);
        let mut parts: Vec<Part> = components
            .filter_map(|(component, number)| {
                let (least, images, points) = match report.input.cameras {
                    None => (3, component.nodes(), None),
                    Some(cameras) => {
                        let (images, points) = tracks::members(component, cameras);
                        (2, images, Some(points))
                    }
                };
                (images.len() >= least).then_some(Part {
                    component: number,
                    images,
                    points,
                })
            })
            .collect();
        parts.sort_by_key(|part| std::cmp::Reverse(part.images.len()));
        let of_image = (0..).zip(&parts).flat_map(|(k, part): (u32, &Part)| {
            let images = part.images.iter();
            images.map(move |&v| (v, k))
        });
        let of_image = Lists::group(images as usize, of_image);
        let mut between = together(&report);
        let shown = |pair: &(u32, u32)| {
            between
                .binary_search_by_key(pair, |line| line.ends)
                .is_err()
        };
        let ordered = pairs.iter().map(|&(a, b)| (a.min(b), a.max(b)));
        let short = ordered.filter(shown).map(|ends| Between {
            ends,
            kind: Kind::Short,
            weight: 0,
        });
        let short: Vec<Between> = short.collect();
        let suggested = suggested(&report, images);
        between.extend(short);
        between.extend(suggested);
        Self {
            report,
            parts,
            of_image,
            images,
            between,
        }
    }

    /// The name of an image.
    pub(super) fn name(&self, image: u32) -> String {
        self.report.input.labels.label(image).into_owned()
    }

    /// The parts of an image.
    pub(super) fn parts_of(&self, image: u32) -> &[u32] {
        self.of_image.of(image as usize)
    }

    /// The images of no part.
    pub(super) fn outside(&self) -> impl Iterator<Item = u32> {
        (0..self.images).filter(|&v| self.parts_of(v).is_empty())
    }

    /// The colour of a part in a small picture.
    pub(super) fn swatch(&self, part: usize) -> String {
        glyph(&symbol(mark(part), 6.0))
    }

    /// The part that holds both ends of a line.
    fn part_of(&self, (a, b): (u32, u32)) -> Option<usize> {
        let others = self.parts_of(b);
        let mut parts = self.parts_of(a).iter();
        let found = parts.find(|part| others.contains(part))?;
        Some(*found as usize)
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
        let names = match is_named {
            true => (0..self.images).map(|v| shortened(&self.name(v))).collect(),
            false => Vec::new(),
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
        let radius = radius * scale.clamp(0.5, 1.0);
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
            None => "are a pair",
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
    match part < MARKS {
        true => Mark::Own(part),
        false => Mark::Other,
    }
}

/// The pairs of images that see points together, with their number; or the pairs of a graph of
/// pairs. Increasing.
fn together(report: &Report) -> Vec<Between> {
    let graph = &report.input.graph;
    let edges = graph.edges().iter();
    let Some(cameras) = report.input.cameras else {
        let line = |&ends: &(u32, u32)| Between {
            ends,
            kind: Kind::Tracks,
            weight: 1,
        };
        return edges.map(line).collect();
    };
    let views = edges.map(|&(camera, point)| (point - cameras, camera));
    let points = graph.nodes() - cameras as usize;
    let views = Lists::group(points, views);
    let mut seen: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for point in 0..points {
        let images = views.of(point);
        for (k, &b) in images.iter().enumerate() {
            for &a in &images[..k] {
                *seen.entry((a.min(b), a.max(b))).or_default() += 1;
            }
        }
    }
    let line = |(ends, weight)| Between {
        ends,
        kind: Kind::Tracks,
        weight,
    };
    seen.into_iter().map(line).collect()
}

/// The pairs that are suggested.
fn suggested(report: &Report, images: u32) -> Vec<Between> {
    let advice: &Advice = report.advice;
    let pairs = advice.suggestions.iter().flatten();
    let pairs = pairs.flat_map(|one| &one.pairs);
    let labels = &report.input.labels;
    let nodes: BTreeMap<String, u32> = (0..images)
        .map(|v| (labels.label(v).into_owned(), v))
        .collect();
    let mut ends: Vec<(u32, u32)> = pairs
        .filter_map(|[a, b]| {
            let (a, b) = (*nodes.get(a)?, *nodes.get(b)?);
            Some((a.min(b), a.max(b)))
        })
        .collect();
    ends.sort_unstable();
    ends.dedup();
    let line = |ends| Between {
        ends,
        kind: Kind::Suggested,
        weight: 0,
    };
    ends.into_iter().map(line).collect()
}

/// Of lines in falling order of strength a spanning forest, and some of each node.
fn strongest(nodes: usize, lines: &[Between]) -> Vec<Between> {
    let mut sets = UnionFind::new(nodes);
    let mut taken = vec![0; nodes];
    let mut chosen = Vec::new();
    for line in lines {
        let (a, b) = (line.ends.0 as usize, line.ends.1 as usize);
        let joins = sets.union(a, b);
        if joins || taken[a] < STRONGEST || taken[b] < STRONGEST {
            taken[a] += 1;
            taken[b] += 1;
            chosen.push(*line);
        }
    }
    chosen
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

    /// A forest of the strongest lines, and the strongest of each image.
    #[test]
    fn what_is_drawn_holds_together() {
        let line = |a, b, weight| Between {
            ends: (a, b),
            kind: Kind::Tracks,
            weight,
        };
        let mut lines = vec![line(0, 5, 1)];
        for a in 0..5 {
            lines.extend((a + 1..5).map(|b| line(a, b, 10 + a + b)));
        }
        lines.sort_by_key(|line| std::cmp::Reverse(line.weight));
        let chosen = strongest(6, &lines);
        assert!(chosen.len() < lines.len());
        assert!(chosen.contains(&line(0, 5, 1)), "the only line of an image");
        assert!(chosen.contains(&lines[0]));
    }
}
