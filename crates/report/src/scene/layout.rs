//! Positions for drawings of graphs with up to some thousand nodes.
//!
//! Each connected part by itself: steps from three far nodes give the overall shape, forces between nodes the
//! details. The parts then stand on shelves. The same graph has the same drawing each time.

use fjadra::{Collide, Link as Springs, ManyBody, PositionX, PositionY, SimulationBuilder};
use viewcert::graph::{Lists, UnionFind};

/// A line of the drawing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    /// The nodes that it joins, two different ones.
    pub(super) ends: (u32, u32),
    /// How long it would like to be.
    pub(super) length: f64,
}

/// Where everything is.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// The position of every node; x goes to the right, y down, both from 0.
    pub(super) points: Vec<[f64; 2]>,
    /// Width and height: the nodes with their radii lie within.
    pub(super) size: [f64; 2],
}

/// How lively the simulation starts: the overall shape is there already.
const ALPHA: f64 = 0.5;
/// Brings that down to 0.001 in 200 steps.
const ALPHA_DECAY: f64 = 0.0306;
/// Pull towards the middle, so that loosely tied nodes do not drift away.
const GRAVITY: f64 = 0.01;
/// Push of a node on the others.
const CHARGE: f64 = 40.0;
/// Space around a part.
const GAP: f64 = 10.0;
/// Width of the whole drawing by its height, about.
const ASPECT: f64 = 1.6;

/// Places discs of this radius. O(200 (n log n + m)).
pub(super) fn layout(nodes: usize, radius: f64, links: &[Link]) -> Layout {
    let mut sets = UnionFind::new(nodes);
    for link in links {
        sets.union(link.ends.0 as usize, link.ends.1 as usize);
    }
    let mut parts: Vec<Vec<u32>> = vec![Vec::new(); nodes];
    let mut local = vec![0; nodes];
    for v in 0..nodes {
        let part = &mut parts[sets.find(v)];
        local[v] = part.len() as u32;
        part.push(v as u32);
    }
    let mut links_of = vec![Vec::new(); nodes];
    for link in links {
        let (i, j) = (link.ends.0 as usize, link.ends.1 as usize);
        let ends = (local[i], local[j]);
        links_of[sets.find(i)].push(Link { ends, ..*link });
    }
    let boxes = parts
        .into_iter()
        .zip(&links_of)
        .filter(|(nodes, _)| !nodes.is_empty());
    let boxes =
        boxes.map(|(nodes, links)| Part::new(place(nodes.len(), radius, links), nodes, radius));
    shelve(nodes, boxes.collect())
}

/// Positions of the nodes of a connected part, the longer side across.
fn place(nodes: usize, radius: f64, links: &[Link]) -> Vec<[f64; 2]> {
    if links.is_empty() {
        return vec![[0.0; 2]; nodes];
    }
    let mean = links.iter().map(|link| link.length).sum::<f64>() / links.len() as f64;
    let ends = links.iter().map(|link| link.ends);
    let neighbours = Lists::group(nodes, ends.clone().flat_map(|(i, j)| [(i, j), (j, i)]));
    let ends = ends.map(|(i, j)| (i as usize, j as usize));
    let lengths: Vec<f64> = links.iter().map(|link| link.length).collect();
    let mut simulation = SimulationBuilder::new()
        .with_alpha(ALPHA)
        .with_alpha_decay(ALPHA_DECAY)
        .build(start(&neighbours, mean))
        .add_force(
            "springs",
            Springs::new(ends).distance(move |_: &_, k: usize| lengths[k]),
        )
        .add_force("charge", ManyBody::new().strength(|_, _| -CHARGE))
        .add_force("collide", Collide::new().radius(move |_| radius + 1.5))
        .add_force("x", PositionX::new().strength(GRAVITY))
        .add_force("y", PositionY::new().strength(GRAVITY));
    simulation.step();
    turn(&simulation.positions().collect::<Vec<_>>())
}

/// Steps along edges from one node to all others of a connected part.
fn steps_from(from: usize, neighbours: &Lists) -> Vec<f64> {
    let mut steps = vec![f64::INFINITY; neighbours.len()];
    steps[from] = 0.0;
    let mut queue = vec![from as u32];
    let mut at = 0;
    while let Some(&v) = queue.get(at) {
        at += 1;
        for &w in neighbours.of(v as usize) {
            if steps[w as usize].is_infinite() {
                steps[w as usize] = steps[v as usize] + 1.0;
                queue.push(w);
            }
        }
    }
    steps
}

/// Where the simulation starts: across by the steps from two far nodes, down by those from a third. O(n + m).
fn start(neighbours: &Lists, length: f64) -> Vec<[f64; 2]> {
    let nodes = 0..neighbours.len();
    let farthest = |steps: &dyn Fn(usize) -> f64| {
        let all = nodes.clone().rev();
        all.max_by(|&v, &w| steps(v).total_cmp(&steps(w)))
            .unwrap_or(0)
    };
    let first = steps_from(0, neighbours);
    let a = steps_from(farthest(&|v| first[v]), neighbours);
    let b = steps_from(farthest(&|v| a[v]), neighbours);
    let c = steps_from(farthest(&|v| a[v].min(b[v])), neighbours);
    let point = |v: usize| {
        // Nodes that would lie on one point are parted, the same way each time.
        let (aside, down) = (2.4 * v as f64).sin_cos();
        [
            length * ((a[v] - b[v]) / 2.0 + 0.05 * aside),
            length * (c[v] - (a[v] - b[v]).abs() / 2.0 + 0.05 * down),
        ]
    };
    nodes.clone().map(point).collect()
}

/// Turns the longer axis across.
fn turn(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let count = points.len().max(1) as f64;
    let mean = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for [x, y] in points
        .iter()
        .map(|point| [point[0] - mean[0], point[1] - mean[1]])
    {
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    let (sin, cos) = (0.5 * f64::atan2(2.0 * xy, xx - yy)).sin_cos();
    points
        .iter()
        .map(|[x, y]| [cos * x + sin * y, cos * y - sin * x])
        .collect()
}

/// A connected part in a box that begins at the origin.
struct Part {
    nodes: Vec<u32>,
    points: Vec<[f64; 2]>,
    size: [f64; 2],
}

impl Part {
    fn new(points: Vec<[f64; 2]>, nodes: Vec<u32>, radius: f64) -> Self {
        let room = radius + GAP;
        let least = |k: usize| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let most = |k: usize| {
            points
                .iter()
                .map(|p| p[k])
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let low = [least(0), least(1)];
        let size = [0, 1].map(|k| most(k) - low[k] + 2.0 * room);
        let points = points
            .iter()
            .map(|[x, y]| [x - low[0] + room, y - low[1] + room]);
        Self {
            points: points.collect(),
            size,
            nodes,
        }
    }
}

/// Puts parts on shelves, the highest first.
fn shelve(nodes: usize, mut parts: Vec<Part>) -> Layout {
    parts.sort_by(|a, b| b.size[1].total_cmp(&a.size[1]));
    let area: f64 = parts.iter().map(|part| part.size[0] * part.size[1]).sum();
    let widest = parts.iter().map(|part| part.size[0]).fold(0.0, f64::max);
    let width = (area * ASPECT).sqrt().max(widest);
    let mut points = vec![[0.0; 2]; nodes];
    let (mut x, mut top, mut bottom, mut used) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
    for part in &parts {
        // Rounding must not break the line of the widest.
        if x > 0.0 && x + part.size[0] > width + 1e-6 {
            (x, top) = (0.0, bottom);
        }
        for (&v, point) in part.nodes.iter().zip(&part.points) {
            points[v as usize] = [x + point[0], top + point[1]];
        }
        x += part.size[0];
        used = used.max(x);
        bottom = bottom.max(top + part.size[1]);
    }
    Layout {
        points,
        size: [used, bottom],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn links(pairs: &[(u32, u32)]) -> Vec<Link> {
        let link = |&ends| Link { ends, length: 30.0 };
        pairs.iter().map(link).collect()
    }

    fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
        (a[0] - b[0]).hypot(a[1] - b[1])
    }

    /// Along a path the distance from its first node grows; nothing lies outside.
    #[test]
    fn a_path_is_laid_out_along_itself() {
        let pairs: Vec<(u32, u32)> = (0..29).map(|v| (v, v + 1)).collect();
        let found = layout(30, 3.0, &links(&pairs));
        let far: Vec<f64> = found
            .points
            .iter()
            .step_by(5)
            .map(|&point| distance(point, found.points[0]))
            .collect();
        assert!(far.is_sorted(), "{far:?}");
        assert!(found.size[0] > 2.0 * found.size[1]);
        let inside =
            |point: &[f64; 2]| (0..2).all(|k| 3.0 <= point[k] && point[k] <= found.size[k] - 3.0);
        assert!(found.points.iter().all(inside));
    }

    #[test]
    fn parts_stand_apart_and_every_run_is_the_same() {
        // Two triangles, two nodes alone.
        let pairs = links(&[(0, 2), (2, 4), (0, 4), (1, 3), (3, 5), (1, 5)]);
        let found = layout(8, 5.0, &pairs);
        for v in 0..8 {
            for w in 0..v {
                let apart = distance(found.points[v], found.points[w]);
                assert!(apart >= 10.0, "{v} {w}: {apart}");
            }
        }
        assert_eq!(found.points, layout(8, 5.0, &pairs).points);
        assert_eq!(layout(0, 5.0, &[]).points.len(), 0);
    }
}
