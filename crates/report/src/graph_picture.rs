//! A graph with its components in colours: the picture of a paper (`--svg`), and of the page.
//!
//! An edge lies in one component and has its colour. A node may lie in several, a *hinge*: it is
//! drawn as a disc cut into their colours. Components that are single pairs are grey, unless there
//! are no others: they join larger ones. Few nodes have their names beside them. Of graphs too large
//! for that with one large component some nodes are drawn, each in the place of those near it
//! (`sample`); others are drawn component by component.

mod sample;

use super::counted;
use super::force_layout::{Link, layout};
use super::svg::{COLOURS, Svg, escaped};
use std::collections::BTreeMap;
use std::fmt::Write;
use viewcert::decide::Verdict;
use viewcert::graph::Lists;
use viewcert_formats::NamedGraph;

/// Most nodes, and most edges, that are drawn one by one.
const MOST_NODES: usize = 1000;
const MOST_EDGES: usize = 150_000;
/// Most components drawn as discs.
const MOST_DISCS: usize = 300;

/// The marks that tell components apart: first by colours, then by shapes as well.
const SHAPES: usize = 4;
const MARKS: usize = SHAPES * COLOURS.len();

/// Grey of single pairs, in the middle between white and black grounds.
const GREY: &str = "#8a929c";
/// Of components beyond the marks.
const OTHER: &str = "#5b6470";

/// Width of a whole picture in pixels, and the least.
const WIDTH: f64 = 900.0;
const LEAST_WIDTH: f64 = 460.0;
const MARGIN: f64 = 14.0;
const LEGEND_LINE: f64 = 20.0;
const LEGEND_COLUMN: f64 = 215.0;
/// Most components in the legend.
const LISTED: usize = 12;

/// How a component looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A colour and a shape of its own.
    Own(usize),
    /// Larger than a pair, but not among the largest.
    Other,
    /// A single pair among larger components.
    Pair,
}

impl Mark {
    /// The colour of its edges and nodes.
    pub fn colour(self) -> &'static str {
        match self {
            Self::Own(k) => COLOURS[k % COLOURS.len()],
            Self::Other => OTHER,
            Self::Pair => GREY,
        }
    }

    /// The number of its shape; lines have as many patterns.
    fn shape(self) -> usize {
        match self {
            Self::Own(k) => k / COLOURS.len() % SHAPES,
            _ => 0,
        }
    }

    /// A colour for text on it.
    fn text(self) -> &'static str {
        const TEXT: [&str; COLOURS.len()] = ["#fff", "#111", "#fff", "#111", "#111", "#fff"];
        match self {
            Self::Own(k) => TEXT[k % COLOURS.len()],
            _ => "#fff",
        }
    }
}

/// How large a component is. The nodes of a camera-point graph are cameras and points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Size {
    cameras: usize,
    points: usize,
    edges: usize,
}

impl Size {
    fn words(self) -> String {
        let cameras = counted(self.cameras, "camera");
        match self.points {
            0 => format!("{cameras}, {}", counted(self.edges, "pair")),
            points => format!("{cameras}, {}", counted(points, "point")),
        }
    }
}

/// What a picture shows of a graph and its verdict.
pub struct Picture<'a> {
    /// The graph.
    pub input: &'a NamedGraph,
    /// The sizes of the components.
    sizes: Vec<Size>,
    /// For every node its components, increasing.
    components_of: Lists,
    /// For every edge its component.
    of_edge: Vec<u32>,
}

impl<'a> Picture<'a> {
    /// Sorts out who lies where. O(n + m log n).
    pub fn new(input: &'a NamedGraph, verdict: &Verdict) -> Self {
        let components = (0..).zip(&verdict.components);
        let nodes: Vec<(u32, u32)> = components
            .flat_map(|(k, component)| {
                let nodes = component.nodes().into_iter();
                nodes.map(move |v| (v, k))
            })
            .collect();
        let components_of = Lists::group(input.graph.nodes(), nodes.iter().copied());
        let edges = input.graph.edges().iter();
        let of_edge = edges
            .map(|&(i, j)| shared(&components_of, i, j).expect("an edge lies in a component"))
            .collect();
        let mut sizes: Vec<Size> = verdict
            .components
            .iter()
            .map(|component| Size {
                cameras: 0,
                points: 0,
                edges: component.edge_count(),
            })
            .collect();
        let cameras = input.cameras.unwrap_or(u32::MAX);
        for &(v, k) in &nodes {
            let size = &mut sizes[k as usize];
            *if v < cameras {
                &mut size.cameras
            } else {
                &mut size.points
            } += 1;
        }
        Self {
            input,
            sizes,
            components_of,
            of_edge,
        }
    }

    /// How many of the nodes, the first ones, are cameras; the others are points.
    pub fn cameras(&self) -> usize {
        let nodes = self.input.graph.nodes();
        self.input.cameras.map_or(nodes, |cameras| cameras as usize)
    }

    /// What an edge is.
    fn edge_word(&self) -> &'static str {
        match self.input.cameras {
            None => "pair",
            Some(_) => "observation",
        }
    }

    /// What edges are.
    fn edge_words(&self) -> String {
        format!("{}s", self.edge_word())
    }

    /// Whether nodes and edges are drawn one by one.
    pub fn is_detailed(&self) -> bool {
        let graph = &self.input.graph;
        graph.nodes() <= MOST_NODES && graph.edges().len() <= MOST_EDGES
    }

    /// Whether one component has half of the cameras, in a graph of cameras alone.
    fn has_large_component(&self) -> bool {
        let largest = self.sizes.first().map_or(0, |size| size.cameras);
        self.input.cameras.is_none() && 2 * largest >= self.cameras()
    }

    /// How many components have more than one edge; they come first.
    pub fn larger(&self) -> usize {
        self.sizes.partition_point(|size| size.edges > 1)
    }

    /// How many components have a mark of their own; they come first.
    pub fn marked(&self) -> usize {
        match self.larger() {
            0 => self.sizes.len().min(MARKS),
            larger => larger.min(MARKS),
        }
    }

    /// How a component looks.
    pub fn mark(&self, component: usize) -> Mark {
        if component < self.marked() {
            Mark::Own(component)
        } else if component < self.larger() {
            Mark::Other
        } else {
            Mark::Pair
        }
    }

    /// The components of a node, increasing.
    pub fn components_of(&self, node: u32) -> &[u32] {
        self.components_of.of(node as usize)
    }

    /// The component of an edge.
    pub fn of_edge(&self, edge: usize) -> usize {
        self.of_edge[edge] as usize
    }

    fn nodes(&self) -> impl Iterator<Item = u32> {
        0..self.input.graph.nodes() as u32
    }

    fn lines(&self) -> Vec<sample::Line> {
        let lines = self.input.graph.edges().iter().zip(&self.of_edge);
        let line = |(&ends, &component): (&(u32, u32), &u32)| sample::Line { ends, component };
        lines.map(line).collect()
    }

    /// Where each node is drawn, x to the right and y down; `None` if nodes are not drawn one by one.
    pub fn points(&self) -> Option<Vec<[f64; 2]>> {
        let nodes: Vec<u32> = self.nodes().collect();
        let (radii, links) = to_place(self, &nodes, &self.lines());
        self.is_detailed().then(|| layout(&radii, &links).points)
    }
}

/// The component that has both ends of an edge: two components share at most one node.
fn shared(components_of: &Lists, i: u32, j: u32) -> Option<u32> {
    let (a, b) = (components_of.of(i as usize), components_of.of(j as usize));
    let (few, many) = if a.len() < b.len() { (a, b) } else { (b, a) };
    few.iter().copied().find(|k| many.binary_search(k).is_ok())
}

/// Draws the graph: node by node, some nodes of it, or component by component.
pub fn draw(picture: &Picture) -> Drawn {
    if picture.is_detailed() {
        draw_nodes(picture)
    } else if picture.has_large_component() {
        draw_sample(picture)
    } else {
        draw_components(picture)
    }
}

/// The picture as a document, with a legend below for a paper; the page has its own.
pub fn document(picture: &Picture, drawn: &Drawn, with_legend: bool) -> String {
    let legend = if with_legend {
        legend(picture)
    } else {
        Vec::new()
    };
    let width = drawn.size[0].max(if with_legend { LEAST_WIDTH } else { 0.0 });
    let columns = ((width - 2.0 * MARGIN) / LEGEND_COLUMN).max(1.0) as usize;
    let lines = legend.len().div_ceil(columns);
    let below = lines as f64 * LEGEND_LINE + if lines > 0 { MARGIN } else { 0.0 };
    let graph = &picture.input.graph;
    let size = Size {
        cameras: picture.cameras(),
        points: graph.nodes() - picture.cameras(),
        edges: graph.edges().len(),
    };
    let title = format!(
        "{}: {}, {}",
        picture.input.name,
        size.words(),
        counted(picture.sizes.len(), "component")
    );
    let height = drawn.size[1] + below;
    let mut svg = Svg::new(width as u32, height as u32).titled(&title);
    let shift = (width - drawn.size[0]) / 2.0;
    svg.element(format_args!(
        "<g transform=\"translate({shift:.0} 0)\">\n{}</g>",
        drawn.body
    ));
    for (k, (symbol, text)) in legend.iter().enumerate() {
        let x = MARGIN + (k / lines) as f64 * LEGEND_COLUMN;
        let y = drawn.size[1] + (k % lines) as f64 * LEGEND_LINE + LEGEND_LINE / 2.0;
        svg.element(format_args!(
            "<g transform=\"translate({:.1} {y:.1})\">{symbol}</g>",
            x + 7.0
        ));
        svg.text([x + 20.0, y + 4.5], 13, "start", text);
    }
    svg.finish()
}

/// What is drawn, and the room that it takes.
pub struct Drawn {
    body: String,
    size: [f64; 2],
}

impl Drawn {
    /// Adds words below.
    fn note(&mut self, words: &str) {
        const LETTER: f64 = 6.4;
        self.size[0] = self.size[0].max(LEAST_WIDTH);
        let most = ((self.size[0] - 2.0 * MARGIN) / LETTER) as usize;
        let mut lines = vec![String::new()];
        for word in words.split(' ') {
            let line = lines.last_mut().expect("never empty");
            match line.len() + word.len() < most {
                true => *line += &format!("{word} "),
                false => lines.push(format!("{word} ")),
            }
        }
        for line in lines {
            // Writing to a string does not fail.
            let _ = writeln!(
                self.body,
                r##"<text x="{MARGIN}" y="{:.1}" font-size="12" class="ink-text" fill="#444">{}</text>"##,
                self.size[1] + 6.0,
                line.trim_end()
            );
            self.size[1] += 16.0;
        }
    }
}

/// Radius of a node in pixels.
fn radius_for(nodes: usize) -> f64 {
    match nodes {
        0..=60 => 6.0,
        61..=250 => 4.5,
        _ => 3.2,
    }
}

/// Width of lines in pixels, and how opaque they are, so that many leave something to be seen.
fn line_for(edges: usize) -> (f64, f64) {
    match edges {
        0..=150 => (2.0, 1.0),
        151..=1500 => (1.0, 1.0),
        1501..=12_000 => (0.5, 0.8),
        _ => (0.3, 0.5),
    }
}

fn draw_nodes(picture: &Picture) -> Drawn {
    let nodes: Vec<u32> = picture.nodes().collect();
    draw_some(picture, &nodes, &picture.lines())
}

/// The discs of some nodes, given increasing, and the lines between them, for the layout.
fn to_place(picture: &Picture, nodes: &[u32], lines: &[sample::Line]) -> (Vec<f64>, Vec<Link>) {
    let radius = radius_for(nodes.len());
    let place = |v: u32| nodes.binary_search(&v).expect("a node that is drawn");
    let links = lines.iter().map(|line| Link {
        ends: (place(line.ends.0) as u32, place(line.ends.1) as u32),
        length: match picture.mark(line.component as usize) {
            Mark::Pair => 70.0,
            _ => 38.0,
        },
    });
    let radii = nodes.iter().map(|&v| radius_of(picture, v, radius));
    (radii.collect(), links.collect())
}

fn draw_sample(picture: &Picture) -> Drawn {
    let (nodes, lines) = sample::sample(picture);
    let mut drawn = draw_some(picture, &nodes, &lines);
    let (all, some) = (picture.input.graph.nodes(), nodes.len());
    let note = format!("drawn: {some} of {all} cameras, each for those near it");
    drawn.note(&note);
    drawn
}

/// Draws some nodes, given increasing, with the lines between them.
fn draw_some(picture: &Picture, nodes: &[u32], lines: &[sample::Line]) -> Drawn {
    let radius = radius_for(nodes.len());
    let place = |v: u32| nodes.binary_search(&v).expect("a node that is drawn");
    let (radii, links) = to_place(picture, nodes, lines);
    let found = layout(&radii, &links);
    let labels = Names::new(picture, nodes);
    // As many pixels as it takes, but no wider than a page.
    let sides = MARGIN + labels.room;
    let scale = ((WIDTH - 2.0 * sides) / found.size[0]).min(1.5);
    let points: Vec<[f64; 2]> = found
        .points
        .iter()
        .map(|[x, y]| [sides + scale * x, MARGIN + labels.high() + scale * y])
        .collect();
    let mut body = String::new();
    write_lines(&mut body, picture, lines, |v| points[place(v)]);
    let mut order: Vec<usize> = (0..nodes.len()).collect();
    order.sort_by_key(|&k| picture.components_of(nodes[k]).len());
    for k in order {
        let (v, [x, y]) = (nodes[k], points[k]);
        let _ = writeln!(
            body,
            r#"<g data-node="{v}" transform="translate({x:.1} {y:.1})"><title>{}</title>{}</g>"#,
            escaped(&picture.input.labels.label(v)),
            node_symbol(picture, v, radius)
        );
    }
    labels.write(&mut body, &points, &links, &radii);
    let [width, height] = found.size.map(|x| scale * x);
    Drawn {
        body,
        size: [width + 2.0 * sides, height + 2.0 * (MARGIN + labels.high())],
    }
}

/// A path for every component.
fn write_lines(
    body: &mut String,
    picture: &Picture,
    lines: &[sample::Line],
    point: impl Fn(u32) -> [f64; 2],
) {
    // The largest are drawn first, single pairs last: they must not be lost.
    let mut paths: BTreeMap<u32, (String, usize)> = BTreeMap::new();
    for &sample::Line { ends, component } in lines {
        let ([a, b], [c, d]) = (point(ends.0), point(ends.1));
        let (path, count) = paths.entry(component).or_default();
        *count += 1;
        // Writing to a string does not fail.
        let _ = write!(path, "M{a:.1} {b:.1}L{c:.1} {d:.1}");
    }
    let single = picture.sizes.len() - picture.larger();
    for (component, (path, count)) in paths {
        let mark = picture.mark(component as usize);
        let (width, opacity) = line_for(count.max(match mark {
            Mark::Pair => single,
            _ => 0,
        }));
        let _ = writeln!(
            body,
            r#"<path data-component="{component}" d="{path}" fill="none" stroke="{}" stroke-width="{width}" stroke-opacity="{opacity}"{}/>"#,
            mark.colour(),
            dashes(mark)
        );
    }
}

/// The names beside the nodes, if these are few.
struct Names {
    /// One for each node, or none at all.
    text: Vec<String>,
    /// The room that they take on either side.
    room: f64,
}

impl Names {
    const MOST: usize = 40;
    const SIZE: f64 = 11.0;

    fn new(picture: &Picture, nodes: &[u32]) -> Self {
        if nodes.len() > Self::MOST || picture.input.cameras.is_some() {
            return Self {
                text: Vec::new(),
                room: 0.0,
            };
        }
        let name = |&v: &u32| shortened(&picture.input.labels.label(v));
        let text: Vec<String> = nodes.iter().map(name).collect();
        let letters = text.iter().map(|name| name.chars().count()).max();
        Self {
            room: 0.6 * Self::SIZE * letters.unwrap_or(0) as f64 + 8.0,
            text,
        }
    }

    /// The room above and below.
    fn high(&self) -> f64 {
        if self.text.is_empty() {
            0.0
        } else {
            Self::SIZE
        }
    }

    /// Writes each on the side of its node that is away from the neighbours.
    fn write(&self, body: &mut String, points: &[[f64; 2]], links: &[Link], radii: &[f64]) {
        let mut away = vec![[0.0, 0.0]; points.len()];
        for link in links {
            let (i, j) = (link.ends.0 as usize, link.ends.1 as usize);
            let apart = [points[i][0] - points[j][0], points[i][1] - points[j][1]];
            let length = apart[0].hypot(apart[1]).max(1.0);
            for axis in 0..2 {
                away[i][axis] += apart[axis] / length;
                away[j][axis] -= apart[axis] / length;
            }
        }
        for (k, name) in self.text.iter().enumerate() {
            let ([x, y], [dx, dy]) = (points[k], away[k]);
            let length = dx.hypot(dy);
            // In the middle of its neighbours a name stands on the right.
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
            let far = radii[k] * 1.5 + 4.0;
            // Writing to a string does not fail.
            let _ = writeln!(
                body,
                r##"<text x="{:.1}" y="{:.1}" font-size="{}" text-anchor="{anchor}" class="ink-text name" fill="#444">{}</text>"##,
                x + far * dx,
                y + (far + 3.0) * dy + 0.35 * Self::SIZE,
                Self::SIZE,
                escaped(name)
            );
        }
    }
}

/// A name with so many letters at most: the end of a long one tells most.
pub(crate) fn shortened(name: &str) -> String {
    const LETTERS: usize = 20;
    let letters = name.chars().count();
    match letters.checked_sub(LETTERS) {
        None | Some(0) => name.to_owned(),
        Some(more) => {
            let end: String = name.chars().skip(more + 1).collect();
            format!("\u{2026}{end}")
        }
    }
}

/// Hinges are larger, points are smaller.
fn radius_of(picture: &Picture, node: u32, radius: f64) -> f64 {
    let hinge = picture.components_of(node).len() > 1;
    let point = node as usize >= picture.cameras();
    radius * if hinge { 1.45 } else { 1.0 } * if point { 0.5 } else { 1.0 }
}

fn node_symbol(picture: &Picture, node: u32, radius: f64) -> String {
    let components = picture.components_of(node);
    let mut marks: Vec<Mark> = Vec::new();
    for &component in components {
        let mark = picture.mark(component as usize);
        if !marks.contains(&mark) {
            marks.push(mark);
        }
    }
    let radius = radius_of(picture, node, radius);
    match (components.len(), marks.as_slice()) {
        (0, _) => alone(radius),
        (1, &[mark]) => symbol(mark, radius),
        _ => hinge(&marks, radius),
    }
}

/// A node without pairs: an empty circle.
pub(crate) fn alone(radius: f64) -> String {
    format!(
        r##"<circle r="{:.1}" fill="#fff" class="ground" stroke="{OTHER}" stroke-width="1.2"/>"##,
        radius - 0.6
    )
}

/// A node of one component, in its colour and shape.
pub(crate) fn symbol(mark: Mark, radius: f64) -> String {
    let r = radius;
    let points = match mark.shape() {
        0 => {
            return format!(
                r##"<circle r="{r:.1}" fill="{}" stroke="#fff" stroke-width="0.8" class="edge-of-node"/>"##,
                mark.colour()
            );
        }
        1 => vec![[-0.88, -0.88], [0.88, -0.88], [0.88, 0.88], [-0.88, 0.88]],
        2 => vec![[0.0, -1.2], [1.1, 0.75], [-1.1, 0.75]],
        _ => vec![[0.0, -1.25], [1.25, 0.0], [0.0, 1.25], [-1.25, 0.0]],
    };
    let points: Vec<String> = points
        .iter()
        .map(|[x, y]| format!("{:.1},{:.1}", r * x, r * y))
        .collect();
    format!(
        r##"<polygon points="{}" fill="{}" stroke="#fff" stroke-width="0.8" class="edge-of-node"/>"##,
        points.join(" "),
        mark.colour()
    )
}

/// A node of several components: a disc cut into their colours, in a dark ring.
pub(crate) fn hinge(marks: &[Mark], radius: f64) -> String {
    let mut text = match marks {
        [mark] => format!(r#"<circle r="{radius:.1}" fill="{}"/>"#, mark.colour()),
        _ => String::new(),
    };
    if marks.len() > 1 {
        let at = |k: usize| {
            let turn = std::f64::consts::TAU * k as f64 / marks.len() as f64;
            [radius * turn.sin(), -radius * turn.cos()]
        };
        for (k, mark) in marks.iter().enumerate() {
            let ([a, b], [c, d]) = (at(k), at(k + 1));
            let _ = write!(
                text,
                r#"<path d="M0 0L{a:.2} {b:.2}A{radius:.2} {radius:.2} 0 0 1 {c:.2} {d:.2}Z" fill="{}"/>"#,
                mark.colour()
            );
        }
    }
    let _ = write!(
        text,
        r##"<circle r="{radius:.1}" fill="none" stroke="#222" stroke-width="1.4" class="ink"/>"##
    );
    text
}

/// The pattern of a component's lines; single pairs have short lines of their own.
fn dashes(mark: Mark) -> &'static str {
    match (mark, mark.shape()) {
        (Mark::Pair, _) | (_, 0) => "",
        (_, 1) => r#" stroke-dasharray="7 2""#,
        (_, 2) => r#" stroke-dasharray="3 2""#,
        _ => r#" stroke-dasharray="7 2 2 2""#,
    }
}

/// What the symbols mean, and how many of each there are.
fn legend(picture: &Picture) -> Vec<(String, String)> {
    let (larger, count) = (picture.larger(), picture.sizes.len());
    let listed = picture.marked().min(LISTED);
    let mut entries: Vec<(String, String)> = (0..listed)
        .map(|k| {
            let text = format!("{}: {}", k + 1, picture.sizes[k].words());
            (symbol(picture.mark(k), 6.0), text)
        })
        .collect();
    let pairs = if larger == 0 {
        count - listed
    } else {
        count - larger
    };
    let more = count - listed - pairs;
    if more > 0 {
        entries.push((symbol(Mark::Other, 6.0), counted(more, "more component")));
    }
    if pairs > 0 {
        let line = format!(r#"<path d="M-7 0H7" stroke="{GREY}" stroke-width="2"/>"#);
        let word = format!("single {}", picture.edge_word());
        entries.push((line, counted(pairs, &word)));
    }
    let hinges = picture
        .nodes()
        .filter(|&v| picture.components_of(v).len() > 1);
    let (cameras, points): (Vec<u32>, Vec<u32>) =
        hinges.partition(|&v| (v as usize) < picture.cameras());
    for (nodes, word) in [(cameras, "camera"), (points, "point")] {
        if !nodes.is_empty() {
            let text = format!("{} in several", counted(nodes.len(), word));
            entries.push((hinge(&[Mark::Own(0), Mark::Own(1)], 6.5), text));
        }
    }
    let isolated = picture
        .nodes()
        .filter(|&v| picture.components_of(v).is_empty());
    let isolated = isolated.count();
    if isolated > 0 {
        let what = format!("without {}", picture.edge_words());
        let text = format!("{} {what}", counted(isolated, "camera"));
        entries.push((alone(6.0), text));
    }
    entries
}

/// Components as discs, their areas as their numbers of nodes; shared nodes as dots between them.
fn draw_components(picture: &Picture) -> Drawn {
    let discs = Discs::new(picture);
    let radii = discs.radii();
    // Shapes with corners take more room than discs.
    let room: Vec<f64> = radii.iter().map(|radius| 1.25 * radius).collect();
    let found = layout(&room, &discs.links(&room));
    let scale = ((WIDTH - 2.0 * MARGIN) / found.size[0]).min(1.0);
    let places: Vec<[f64; 2]> = found
        .points
        .iter()
        .map(|p| p.map(|x| MARGIN + scale * x))
        .collect();
    let mut body = String::new();
    discs.write_lines(&mut body, &places);
    for (k, (&at, radius)) in places.iter().zip(&radii[..discs.count]).enumerate() {
        write_disc(&mut body, picture, k, at, scale * radius);
    }
    discs.write_hinges(&mut body, &places);
    let mut drawn = Drawn {
        body,
        size: found.size.map(|x| scale * x + 2.0 * MARGIN),
    };
    let joining: usize = discs.joined.values().sum();
    let mut words = format!(
        "{} are too many to draw: a symbol is a component, with its number in the report; its area is as its cameras.",
        counted(picture.cameras(), "camera")
    );
    if joining > 0 {
        words += &format!(" A line: {} that join two of them.", picture.edge_words());
    }
    if !discs.hinges.is_empty() {
        words += " A dot: a node in several.";
    }
    drawn.note(&words);
    let hidden = picture.sizes.len() - discs.count - joining;
    if hidden > 0 {
        drawn.note(&format!(
            "not drawn: {}",
            counted(hidden, "smaller component")
        ));
    }
    drawn
}

/// Components as discs, and what joins them.
struct Discs<'a> {
    picture: &'a Picture<'a>,
    /// How many components, the first ones, are drawn.
    count: usize,
    /// Nodes in several of them, which are dots, and in which.
    hinges: Vec<(u32, Vec<usize>)>,
    /// How many single pairs lead from one disc to another.
    joined: BTreeMap<(usize, usize), usize>,
}

impl<'a> Discs<'a> {
    fn new(picture: &'a Picture<'a>) -> Self {
        let candidates = match picture.larger() {
            0 => picture.sizes.len(),
            larger => larger,
        };
        let count = candidates.min(MOST_DISCS);
        let drawn = |v: u32| {
            let of = picture.components_of(v).iter().map(|&k| k as usize);
            of.take_while(|&k| k < count).collect::<Vec<_>>()
        };
        let nodes = picture.nodes().map(|v| (v, drawn(v)));
        let hinges = nodes.filter(|(_, of)| of.len() > 1).collect();
        let mut joined: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (k, &(i, j)) in picture.input.graph.edges().iter().enumerate() {
            if picture.of_edge(k) >= count
                && let (Some(&a), Some(&b)) = (drawn(i).first(), drawn(j).first())
                && a != b
            {
                *joined.entry((a.min(b), a.max(b))).or_default() += 1;
            }
        }
        Self {
            picture,
            count,
            hinges,
            joined,
        }
    }

    /// The dots, by their places behind the discs.
    fn dots(&self) -> impl Iterator<Item = (usize, &(u32, Vec<usize>))> {
        (self.count..).zip(&self.hinges)
    }

    /// The radii of discs and dots: areas are as numbers of cameras.
    fn radii(&self) -> Vec<f64> {
        let cameras = || {
            let sizes = self.picture.sizes[..self.count].iter();
            sizes.map(|size| size.cameras)
        };
        let most = cameras().max().unwrap_or(1).max(1) as f64;
        let discs = cameras().map(|count| (80.0 * (count as f64 / most).sqrt()).max(5.0));
        discs.chain(self.hinges.iter().map(|_| 4.0)).collect()
    }

    /// What pulls discs and dots together.
    fn links(&self, radii: &[f64]) -> Vec<Link> {
        let link = |a: usize, b: usize, apart: f64| Link {
            ends: (a as u32, b as u32),
            length: radii[a] + radii[b] + apart,
        };
        let dots = self.dots();
        let dots = dots.flat_map(|(dot, (_, of))| of.iter().map(move |&disc| (disc, dot)));
        dots.map(|(disc, dot)| link(disc, dot, 8.0))
            .chain(self.joined.keys().map(|&(a, b)| link(a, b, 40.0)))
            .collect()
    }

    /// Lines between discs, and from dots to their discs.
    fn write_lines(&self, body: &mut String, places: &[[f64; 2]]) {
        let mut line = |a: usize, b: usize, width: f64| {
            let ([a, b], [c, d]) = (places[a], places[b]);
            // Writing to a string does not fail.
            let _ = writeln!(
                body,
                r#"<path d="M{a:.1} {b:.1}L{c:.1} {d:.1}" stroke="{GREY}" stroke-width="{width:.1}"/>"#
            );
        };
        for (&(a, b), &count) in &self.joined {
            line(a, b, 1.0 + (count as f64).log2());
        }
        for (dot, (_, of)) in self.dots() {
            of.iter().for_each(|&disc| line(disc, dot, 1.5));
        }
    }

    fn write_hinges(&self, body: &mut String, places: &[[f64; 2]]) {
        for (dot, (v, of)) in self.dots() {
            let [x, y] = places[dot];
            let marks: Vec<Mark> = of.iter().map(|&k| self.picture.mark(k)).collect();
            let _ = writeln!(
                body,
                r#"<g data-node="{v}" transform="translate({x:.1} {y:.1})"><title>{}</title>{}</g>"#,
                escaped(&self.picture.input.labels.label(*v)),
                hinge(&marks, 4.5)
            );
        }
    }
}

/// A component as a disc, with its number, and how many cameras it has if there is room.
fn write_disc(body: &mut String, picture: &Picture, k: usize, [x, y]: [f64; 2], radius: f64) {
    let (mark, size) = (picture.mark(k), picture.sizes[k]);
    let mut text = String::new();
    let mut write = |y: f64, high: f64, fill: &str, words: &str| {
        // Writing to a string does not fail.
        let _ = write!(
            text,
            r#"<text y="{y:.1}" font-size="{high:.0}" text-anchor="middle" {fill}>{words}</text>"#
        );
    };
    let number = (k + 1).to_string();
    if radius > 12.0 {
        let high = (radius * 0.45).clamp(8.0, 22.0);
        // A triangle has its room below the middle.
        let down = match mark.shape() {
            2 => 0.25 * radius,
            _ => 0.0,
        };
        let fill = format!(r#"fill="{}""#, mark.text());
        write(high * 0.35 + down, high, &fill, &number);
        if radius > 36.0 {
            write(
                high * 0.35 + down + 14.0,
                11.0,
                &fill,
                &counted(size.cameras, "camera"),
            );
        }
    } else if picture.larger() <= 2 * MARKS {
        write(
            radius * 1.25 + 9.0,
            9.0,
            r##"class="ink-text" fill="#444""##,
            &number,
        );
    }
    let _ = writeln!(
        body,
        r#"<g data-component="{k}" transform="translate({x:.1} {y:.1})"><title>component {}: {}</title>{}{text}</g>"#,
        k + 1,
        size.words(),
        symbol(mark, radius)
    );
}

#[cfg(test)]
mod tests;
