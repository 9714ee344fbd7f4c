//! A scene as scalable vector graphics.

use super::layout::{Layout, Link, layout};
use super::{Edge, Kind, Mark, Scene};
use crate::counted;
use std::collections::BTreeMap;
use std::fmt::Write;
use viewcert::wording::spelt;

/// Colours that are told apart by people who do not tell red from green (P. Tol's bright scheme), and those of text
/// on them.
pub const COLOURS: [&str; 6] = [
    "#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377",
];
/// Grey of single pairs, in the middle between white and black grounds; and of groups beyond the marks.
const GREY: &str = "#8a929c";
const OTHER: &str = "#5b6470";

/// Width of a whole picture in pixels, and the least with words below.
const WIDTH: f64 = 900.0;
const LEAST_WIDTH: f64 = 460.0;
const MARGIN: f64 = 14.0;
const LEGEND_LINE: f64 = 20.0;
const LEGEND_COLUMN: f64 = 215.0;
/// Most groups in the legend.
const LISTED: usize = 12;
/// Up to so many nodes have their names beside them, of this size in pixels, and so many letters.
const NAMED: usize = 40;
const LETTER: f64 = 11.0;
const LETTERS: usize = 20;
/// How far the line of a suggestion goes aside, by its length.
const BEND: f64 = 0.08;

impl Mark {
    /// The colour of its lines and nodes.
    pub(super) fn colour(self) -> &'static str {
        match self {
            Self::Own(k) => COLOURS[k % COLOURS.len()],
            Self::Other => OTHER,
            Self::Pair => GREY,
        }
    }

    /// The number of its shape; lines have as many patterns.
    fn shape(self) -> usize {
        match self {
            Self::Own(k) => k / COLOURS.len() % 4,
            _ => 0,
        }
    }
}

impl Scene {
    /// The picture, with a legend below for a paper; a page has its own.
    pub fn svg(&self, with_legend: bool) -> String {
        let (nodes, edges) = self.shown();
        let found = self.placed(nodes.len(), &edges);
        let is_named = nodes.len() <= NAMED;
        let name = |&v: &u32| shortened(&self.names[v as usize]);
        let names: Vec<String> = nodes.iter().filter(|_| is_named).map(name).collect();
        let letters = names.iter().map(|name| name.chars().count()).max();
        let sides = MARGIN + letters.map_or(0.0, |letters| 0.6 * LETTER * letters as f64 + 8.0);
        let ends = MARGIN + if is_named { LETTER } else { 0.0 };
        // As many pixels as it takes, but no wider than a page.
        let scale = ((WIDTH - 2.0 * sides) / found.size[0]).min(1.5);
        let place = |[x, y]: &[f64; 2]| [sides + scale * x, ends + scale * y];
        let points: Vec<[f64; 2]> = found.points.iter().map(place).collect();
        let mut width = scale * found.size[0] + 2.0 * sides;
        let mut height = scale * found.size[1] + 2.0 * ends;
        let body = self.body(&nodes, &edges, &points, &names);
        let notes = self.notes(nodes.len(), edges.len());
        let legend = if with_legend {
            self.legend()
        } else {
            Vec::new()
        };
        let mut shift = 0.0;
        if !legend.is_empty() || !notes.is_empty() {
            shift = (LEAST_WIDTH - width).max(0.0) / 2.0;
            width = width.max(LEAST_WIDTH);
        }
        let mut below = String::new();
        for note in notes {
            text(&mut below, [MARGIN, height + 6.0], 12, "start", &note);
            height += 16.0;
        }
        let columns = ((width - 2.0 * MARGIN) / LEGEND_COLUMN).max(1.0) as usize;
        let lines = legend.len().div_ceil(columns);
        for (k, (symbol, words)) in legend.iter().enumerate() {
            let x = MARGIN + (k / lines) as f64 * LEGEND_COLUMN;
            let y = height + (k % lines) as f64 * LEGEND_LINE + LEGEND_LINE / 2.0;
            // Writing to a string does not fail.
            let _ = writeln!(
                below,
                "<g transform=\"translate({:.1} {y:.1})\">{symbol}</g>",
                x + 7.0
            );
            text(&mut below, [x + 20.0, y + 4.5], 13, "start", words);
        }
        if lines > 0 {
            height += lines as f64 * LEGEND_LINE + MARGIN;
        }
        let body = format!("<g transform=\"translate({shift:.0} 0)\">\n{body}</g>\n{below}");
        document([width, height], &self.title, &body)
    }

    /// Where so many nodes and lines between them go.
    pub(super) fn placed(&self, nodes: usize, edges: &[Edge]) -> Layout {
        let wider = if nodes <= NAMED { 1.5 } else { 1.0 };
        // What is drawn on the line of a pair pulls nothing.
        let links: Vec<Link> = edges
            .iter()
            .filter(|edge| edge.kind != Kind::Contradicting)
            .map(|edge| Link {
                ends: edge.ends,
                length: wider * if self.is_grey(edge) { 70.0 } else { 38.0 },
            })
            .collect();
        layout(nodes, 1.2 * radius_for(nodes), &links)
    }

    fn is_grey(&self, edge: &Edge) -> bool {
        edge.group
            .is_none_or(|group| self.mark(group as usize) == Mark::Pair)
    }

    /// Some nodes, given increasing, with lines and names if there are any.
    pub fn body(
        &self,
        nodes: &[u32],
        edges: &[Edge],
        points: &[[f64; 2]],
        names: &[String],
    ) -> String {
        let mut body = self.lines(edges, points);
        let radius = radius_for(nodes.len());
        let mut order: Vec<usize> = (0..nodes.len()).collect();
        order.sort_by_key(|&k| self.groups_of.of(nodes[k] as usize).len());
        for k in order {
            let (v, [x, y]) = (nodes[k], points[k]);
            // Writing to a string does not fail.
            let _ = writeln!(
                body,
                r#"<g data-node="{v}" transform="translate({x:.1} {y:.1})"><title>{}</title>{}</g>"#,
                escaped(&self.names[v as usize]),
                self.symbol(v as usize, radius)
            );
        }
        // Each name stands on the side that is away from the neighbours, or on the right.
        let mut away = vec![[0.0, 0.0]; points.len()];
        for edge in edges {
            let (i, j) = (edge.ends.0 as usize, edge.ends.1 as usize);
            let apart = [points[i][0] - points[j][0], points[i][1] - points[j][1]];
            let length = apart[0].hypot(apart[1]).max(1.0);
            for axis in 0..2 {
                away[i][axis] += apart[axis] / length;
                away[j][axis] -= apart[axis] / length;
            }
        }
        for ((name, [x, y]), [dx, dy]) in names.iter().zip(points).zip(away) {
            let length = dx.hypot(dy);
            let [dx, dy] = if length < 0.2 {
                [1.0, 0.0]
            } else {
                [dx / length, dy / length]
            };
            let anchor = match dx {
                _ if dx > 0.4 => "start",
                _ if dx < -0.4 => "end",
                _ => "middle",
            };
            let far = 1.5 * radius + 4.0;
            text(
                &mut body,
                [x + far * dx, y + (far + 3.0) * dy + 0.35 * LETTER],
                11,
                anchor,
                name,
            );
        }
        body
    }

    /// A path for every kind of line and every group.
    fn lines(&self, edges: &[Edge], points: &[[f64; 2]]) -> String {
        // The largest are drawn first, single pairs last: they must not be lost.
        let mut paths: BTreeMap<(Kind, Option<u32>), String> = BTreeMap::new();
        for edge in edges {
            let ([a, b], [c, d]) = (points[edge.ends.0 as usize], points[edge.ends.1 as usize]);
            let path = paths.entry((edge.kind, edge.group)).or_default();
            // Writing to a string does not fail. A suggestion stands beside the line of a pair that is matched.
            let _ = match edge.kind {
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
        // Many lines have to leave something to be seen.
        let (width, opacity) = match edges.len() {
            0..=150 => (2.0, 1.0),
            151..=1500 => (1.0, 1.0),
            _ => (0.5, 0.8),
        };
        let mut body = String::new();
        for ((kind, group), path) in paths {
            let mark = group.map_or(Mark::Pair, |group| self.mark(group as usize));
            let number = group.map_or(String::new(), |group| {
                format!("data-component=\"{group}\" ")
            });
            let style = match kind {
                Kind::Pair => format!("stroke=\"{}\"{}", mark.colour(), dashes(mark)),
                Kind::Short => format!("stroke=\"{OTHER}\" class=\"short\" stroke-dasharray=\"6 4\""),
                Kind::Suggested => {
                    "stroke=\"#0b5cad\" class=\"suggested\" stroke-dasharray=\"1.5 3.5\" stroke-linecap=\"round\"".into()
                }
                Kind::Contradicting => "stroke=\"#d1242f\" class=\"contradicting\"".into(),
            };
            let _ = writeln!(
                body,
                "<path {number}d=\"{path}\" fill=\"none\" {style} stroke-width=\"{width}\" stroke-opacity=\"{opacity}\"/>"
            );
        }
        body
    }

    /// What is not drawn.
    fn notes(&self, nodes: usize, edges: usize) -> Vec<String> {
        let mut notes = Vec::new();
        let all = self.names.len();
        if nodes < all {
            notes.push(format!(
                "drawn: {nodes} of {all} cameras, each for those near it"
            ));
        } else if edges < self.edges.len() {
            let all = self.edges.len();
            notes.push(format!(
                "drawn: {edges} of {all} lines: those that join, and the strongest of each camera"
            ));
        }
        notes
    }

    /// A disc in the colour of its group; of several, cut into their colours in a dark ring; of none, empty.
    fn symbol(&self, node: usize, radius: f64) -> String {
        let mut marks: Vec<Mark> = Vec::new();
        let groups = self.groups_of.of(node);
        for mark in groups.iter().map(|&group| self.mark(group as usize)) {
            if !marks.contains(&mark) {
                marks.push(mark);
            }
        }
        match (groups.len(), &marks[..]) {
            (0, _) => alone(radius),
            (1, &[mark]) => symbol(mark, radius),
            _ => hinge(&marks, 1.45 * radius),
        }
    }

    /// What the symbols mean, and how many of each there are.
    fn legend(&self) -> Vec<(String, String)> {
        let (larger, count) = (self.larger, self.groups.len());
        let listed = self.marked().min(LISTED);
        let entry = |k: usize| {
            (
                symbol(self.mark(k), 6.0),
                format!("{}: {}", k + 1, self.groups[k]),
            )
        };
        let mut entries: Vec<(String, String)> = (0..listed).map(entry).collect();
        let mut add = |count: usize, symbol: String, words: &str, rest: &str| {
            if count > 0 {
                entries.push((symbol, counted(count, words) + rest));
            }
        };
        let line =
            |style: &str| format!(r#"<path d="M-7 0H7" fill="none" stroke-width="2" {style}/>"#);
        let single = count - if larger == 0 { listed } else { larger };
        add(
            count - listed - single,
            symbol(Mark::Other, 6.0),
            "more component",
            "",
        );
        add(
            single,
            line(&format!("stroke=\"{GREY}\"")),
            &format!("single {}", self.edge),
            "",
        );
        let several = |least: usize| {
            let nodes = 0..self.names.len();
            nodes
                .filter(|&v| self.groups_of.of(v).len() >= least)
                .count()
        };
        let without = match self.edge {
            "pair" => " without pairs",
            _ => " in no larger component",
        };
        add(
            several(2),
            hinge(&[Mark::Own(0), Mark::Own(1)], 6.5),
            "camera",
            " in several",
        );
        add(self.names.len() - several(1), alone(6.0), "camera", without);
        entries
    }
}

/// Text whose anchor is `"start"`, `"middle"` or `"end"`.
pub fn text(out: &mut String, [x, y]: [f64; 2], size: u32, anchor: &str, words: &str) {
    // Writing to a string does not fail.
    let _ = writeln!(
        out,
        r##"<text x="{x:.1}" y="{y:.1}" font-size="{size}" text-anchor="{anchor}" class="ink-text" fill="#444">{}</text>"##,
        escaped(words)
    );
}

/// Radius of a node in pixels.
fn radius_for(nodes: usize) -> f64 {
    match nodes {
        0..=60 => 6.0,
        61..=250 => 4.5,
        _ => 3.2,
    }
}

/// A name with so many letters at most: the end of a long one tells most.
fn shortened(name: &str) -> String {
    match name.chars().count().checked_sub(LETTERS) {
        None | Some(0) => name.to_owned(),
        Some(more) => format!(
            "\u{2026}{}",
            name.chars().skip(more + 1).collect::<String>()
        ),
    }
}

fn alone(radius: f64) -> String {
    let radius = radius - 0.6;
    format!(
        r##"<circle r="{radius:.1}" fill="#fff" class="ground" stroke="{OTHER}" stroke-width="1.2"/>"##
    )
}

fn symbol(mark: Mark, radius: f64) -> String {
    let style = format!(
        r##"fill="{}" stroke="#fff" stroke-width="0.8" class="edge-of-node""##,
        mark.colour()
    );
    let points: &[[f64; 2]] = match mark.shape() {
        0 => return format!(r#"<circle r="{radius:.1}" {style}/>"#),
        1 => &[[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]],
        2 => &[[0.0, -1.2], [1.1, 0.75], [-1.1, 0.75]],
        _ => &[[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]],
    };
    let points = points
        .iter()
        .map(|[x, y]| format!("{:.1},{:.1}", radius * x, radius * y));
    format!(
        r#"<polygon points="{}" {style}/>"#,
        points.collect::<Vec<_>>().join(" ")
    )
}

fn hinge(marks: &[Mark], radius: f64) -> String {
    let mut text = format!(r#"<circle r="{radius:.1}" fill="{}"/>"#, marks[0].colour());
    let at = |k: usize| {
        let turn = std::f64::consts::TAU * k as f64 / marks.len() as f64;
        [radius * turn.sin(), -radius * turn.cos()]
    };
    for (k, mark) in marks.iter().enumerate().skip(1) {
        let ([a, b], [c, d]) = (at(k), at(k + 1));
        let fill = mark.colour();
        // Writing to a string does not fail.
        let _ = write!(
            text,
            r#"<path d="M0 0L{a:.2} {b:.2}A{radius:.2} {radius:.2} 0 0 1 {c:.2} {d:.2}Z" fill="{fill}"/>"#
        );
    }
    text + &format!(
        r##"<circle r="{radius:.1}" fill="none" stroke="#222" stroke-width="1.4" class="ink"/>"##
    )
}

/// The pattern of a group's lines; single pairs have short lines of their own.
fn dashes(mark: Mark) -> &'static str {
    match (mark, mark.shape()) {
        (Mark::Pair, _) | (_, 0) => "",
        (_, 1) => r#" stroke-dasharray="7 2""#,
        (_, 2) => r#" stroke-dasharray="3 2""#,
        _ => r#" stroke-dasharray="7 2 2 2""#,
    }
}

/// Elements on a white ground, and in words what they show.
pub fn document([width, height]: [f64; 2], title: &str, body: &str) -> String {
    let (width, height) = (width as u32, height as u32);
    let title = match title {
        "" => String::new(),
        title => format!("<title>{}</title>\n", escaped(title)),
    };
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" fill=\"#222\">\n{title}\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// Text as it stands between tags, and in attributes with double quotes. XML has no way to write
/// control characters; they are spelt out, as on a terminal.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            c => spelt(c, &mut escaped),
        }
    }
    escaped
}
