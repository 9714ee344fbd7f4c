//! Positions for drawings of graphs with up to some thousand nodes.
//!
//! Each connected part by itself: pivot multidimensional scaling (Brandes and Pich,
//! *Eigensolver methods for progressive multidimensional scaling of large data*, 2006) gives the
//! overall shape, forces between nodes the details. The parts then stand on shelves. The same
//! graph has the same drawing each time.

use fjadra::{Collide, Link as Springs, ManyBody, PositionX, PositionY, SimulationBuilder};
use viewcert::graph::{Lists, UnionFind};

/// A line of the drawing.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// The nodes that it joins, two different ones.
    pub ends: (u32, u32),
    /// How long it would like to be.
    pub length: f64,
}

/// Where everything is.
#[derive(Clone, Debug)]
pub struct Layout {
    /// The position of every node; x goes to the right, y down, both from 0.
    pub points: Vec<[f64; 2]>,
    /// Width and height: the nodes with their radii lie within.
    pub size: [f64; 2],
}

/// Most pivots of a part.
const PIVOTS: usize = 40;
/// Rounds in which the two main axes of the pivots' distances are found.
const ROUNDS: usize = 60;
/// How lively the simulation starts: the overall shape is there already.
const ALPHA: f64 = 0.5;
/// Brings that down to 0.001 in 200 steps.
const ALPHA_DECAY: f64 = 0.0306;
/// Pull towards the middle, so that loosely tied nodes do not drift away.
const GRAVITY: f64 = 0.01;
/// Least push of a node on the others; larger ones push by their area.
const CHARGE: f64 = 40.0;
/// Space around a part.
const GAP: f64 = 10.0;
/// Width of the whole drawing by its height, about.
const ASPECT: f64 = 1.6;

/// Places discs with these radii. O(200 (n log n + m)).
pub fn layout(radii: &[f64], links: &[Link]) -> Layout {
    let parts = connected_parts(radii.len(), links);
    let mut local = vec![0u32; radii.len()];
    for nodes in &parts {
        for (k, &v) in (0..).zip(nodes) {
            local[v as usize] = k;
        }
    }
    let mut part_of = vec![0; radii.len()];
    for (part, nodes) in parts.iter().enumerate() {
        nodes.iter().for_each(|&v| part_of[v as usize] = part);
    }
    let mut links_of = vec![Vec::new(); parts.len()];
    for link in links {
        let (i, j) = link.ends;
        links_of[part_of[i as usize]].push(Link {
            ends: (local[i as usize], local[j as usize]),
            length: link.length,
        });
    }
    let boxes = parts.into_iter().zip(&links_of).map(|(nodes, links)| {
        let radii: Vec<f64> = nodes.iter().map(|&v| radii[v as usize]).collect();
        Part::new(nodes, place(&radii, links), &radii)
    });
    shelve(radii.len(), boxes.collect())
}

/// The nodes of each connected part, the part of the smallest node first.
fn connected_parts(nodes: usize, links: &[Link]) -> Vec<Vec<u32>> {
    let mut sets = UnionFind::new(nodes);
    for link in links {
        sets.union(link.ends.0 as usize, link.ends.1 as usize);
    }
    let mut number = vec![usize::MAX; nodes];
    let mut parts: Vec<Vec<u32>> = Vec::new();
    for v in 0..nodes {
        let root = sets.find(v);
        if number[root] == usize::MAX {
            number[root] = parts.len();
            parts.push(Vec::new());
        }
        parts[number[root]].push(v as u32);
    }
    parts
}

/// Positions of the nodes of a connected part, the longer side across.
fn place(radii: &[f64], links: &[Link]) -> Vec<[f64; 2]> {
    if links.is_empty() {
        return vec![[0.0; 2]; radii.len()];
    }
    let mean = links.iter().map(|link| link.length).sum::<f64>() / links.len() as f64;
    let both = links.iter().flat_map(|link| {
        let (i, j) = link.ends;
        [(i, j), (j, i)]
    });
    let neighbours = Lists::group(radii.len(), both);
    let start = spread(&pivot_scaling(&neighbours), mean);
    turn(&simulate(&start, radii, links))
}

fn simulate(start: &[[f64; 2]], radii: &[f64], links: &[Link]) -> Vec<[f64; 2]> {
    let ends = links.iter().map(|link| link.ends);
    let ends = ends.map(|(i, j)| (i as usize, j as usize));
    let lengths: Vec<f64> = links.iter().map(|link| link.length).collect();
    let (sizes, charges) = (radii.to_vec(), radii.to_vec());
    let mut simulation = SimulationBuilder::new()
        .with_alpha(ALPHA)
        .with_alpha_decay(ALPHA_DECAY)
        .build(start.iter().copied())
        .add_force(
            "springs",
            Springs::new(ends).distance(move |_: &_, k: usize| lengths[k]),
        )
        .add_force(
            "charge",
            ManyBody::new().strength(move |_, k: usize| -CHARGE.max(charges[k] * charges[k])),
        )
        .add_force("collide", Collide::new().radius(move |k| sizes[k] + 1.5))
        .add_force("x", PositionX::new().strength(GRAVITY))
        .add_force("y", PositionY::new().strength(GRAVITY));
    simulation.step();
    simulation.positions().collect()
}

/// Steps along edges from one node to all others of a connected part.
fn steps_from(from: u32, neighbours: &Lists) -> Vec<u32> {
    let mut steps = vec![u32::MAX; neighbours.len()];
    steps[from as usize] = 0;
    let mut queue = vec![from];
    let mut at = 0;
    while let Some(&v) = queue.get(at) {
        at += 1;
        for &w in neighbours.of(v as usize) {
            if steps[w as usize] == u32::MAX {
                steps[w as usize] = steps[v as usize] + 1;
                queue.push(w);
            }
        }
    }
    steps
}

/// Positions whose distances are close to numbers of steps, up to a factor. O(PIVOTS (n + m)).
fn pivot_scaling(neighbours: &Lists) -> Vec<[f64; 2]> {
    let nodes = neighbours.len();
    let mut nearest = vec![u32::MAX; nodes];
    let mut pivot = 0;
    // A column a pivot: minus half the squared distances.
    let mut columns: Vec<Vec<f64>> = Vec::new();
    while columns.len() < PIVOTS.min(nodes) {
        let steps = steps_from(pivot, neighbours);
        for (least, &found) in nearest.iter_mut().zip(&steps) {
            *least = found.min(*least);
        }
        // The next pivot is the node farthest from those there are, the first of several.
        pivot = (0..nodes)
            .rev()
            .max_by_key(|&v| nearest[v])
            .map_or(0, |v| v as u32);
        let squares = steps.iter().map(|&d| -0.5 * f64::from(d) * f64::from(d));
        columns.push(squares.collect());
    }
    centre(&mut columns);
    let axes = main_axes(&columns);
    let mut points = vec![[0.0; 2]; nodes];
    for (k, axis) in axes.iter().enumerate() {
        for (column, weight) in columns.iter().zip(axis) {
            for (point, x) in points.iter_mut().zip(column) {
                point[k] += weight * x;
            }
        }
        // The axes of scaling go with the square roots of these lengths.
        let length = points.iter().map(|point| point[k] * point[k]).sum::<f64>();
        let scale = length.sqrt().sqrt().max(1e-9);
        points.iter_mut().for_each(|point| point[k] /= scale);
    }
    points
}

/// Takes the means off rows and columns.
fn centre(columns: &mut [Vec<f64>]) {
    let nodes = columns[0].len();
    for column in &mut *columns {
        let mean = column.iter().sum::<f64>() / nodes as f64;
        column.iter_mut().for_each(|x| *x -= mean);
    }
    let count = columns.len() as f64;
    for v in 0..nodes {
        let mean = columns.iter().map(|column| column[v]).sum::<f64>() / count;
        columns.iter_mut().for_each(|column| column[v] -= mean);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The two main eigenvectors of the products of the columns, by power iteration.
fn main_axes(columns: &[Vec<f64>]) -> [Vec<f64>; 2] {
    let gram: Vec<Vec<f64>> = columns
        .iter()
        .map(|a| columns.iter().map(|b| dot(a, b)).collect())
        .collect();
    let mut next = random();
    let mut axes = [(); 2].map(|()| columns.iter().map(|_| next()).collect::<Vec<f64>>());
    for _ in 0..ROUNDS {
        for k in 0..2 {
            let mut axis: Vec<f64> = gram.iter().map(|row| dot(row, &axes[k])).collect();
            if k == 1 {
                let along = dot(&axis, &axes[0]);
                axis.iter_mut()
                    .zip(&axes[0])
                    .for_each(|(x, y)| *x -= along * y);
            }
            let length = dot(&axis, &axis).sqrt().max(1e-12);
            axes[k] = axis.into_iter().map(|x| x / length).collect();
        }
    }
    axes
}

/// Numbers in -0.5..0.5, the same each time: the linear congruential generator of Knuth's MMIX.
fn random() -> impl FnMut() -> f64 {
    let mut state = 1u64;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1 << 24) - 0.5
    }
}

/// Scales steps to lengths, and parts nodes that lie on one point.
fn spread(points: &[[f64; 2]], length: f64) -> Vec<[f64; 2]> {
    let mut next = random();
    points
        .iter()
        .map(|point| point.map(|x| (x + 0.1 * next()) * length))
        .collect()
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
    fn new(nodes: Vec<u32>, points: Vec<[f64; 2]>, radii: &[f64]) -> Self {
        let discs = || points.iter().zip(radii);
        let least = |k: usize| discs().map(|(p, r)| p[k] - r).fold(f64::INFINITY, f64::min);
        let most = |k: usize| {
            discs()
                .map(|(p, r)| p[k] + r)
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let (low, high) = ([least(0), least(1)], [most(0), most(1)]);
        let corner = low.map(|x| x - GAP);
        let points = points.iter().map(|[x, y]| [x - corner[0], y - corner[1]]);
        Self {
            points: points.collect(),
            size: [0, 1].map(|k| high[k] - low[k] + 2.0 * GAP),
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
        let found = layout(&[3.0; 30], &links(&pairs));
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
        let radii = [5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 20.0, 20.0];
        let found = layout(&radii, &pairs);
        for v in 0..8 {
            for w in 0..v {
                let apart = distance(found.points[v], found.points[w]);
                assert!(apart >= radii[v] + radii[w], "{v} {w}: {apart}");
            }
        }
        assert_eq!(found.points, layout(&radii, &pairs).points);
        assert_eq!(layout(&[], &[]).points.len(), 0);
    }
}
