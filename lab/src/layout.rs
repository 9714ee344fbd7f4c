//! Drawings of small graphs.
//!
//! Stress majorisation (Gansner, Koren, North, *Graph drawing by stress majorization*,
//! 2004): positions whose distances come as close as possible to the lengths of shortest paths,
//! from many starts. The best drawings are then polished: a node moves to a place of a
//! grid as long as that takes away flaws - edges that cross, nodes on foreign edges - or
//! stress. Nothing but the four operations and square roots is used, so that the same graph has
//! the same drawing on every machine.

use viewcert::graph::{Adjacency, Graph};

const STARTS: u64 = 60;
const ROUNDS: usize = 150;
/// How many drawings are polished.
const POLISHED: usize = 6;
/// Steps of the grid along each side.
const GRID: u32 = 12;

/// Positions of the nodes in the unit square. For small graphs: a round of polishing takes
/// O(grid^2 n m^2).
pub fn layout(graph: &Graph) -> Vec<[f64; 2]> {
    let distances = distances(graph);
    let cost = |points: &[[f64; 2]]| flaws(graph, points) as f64 + stress(points, &distances);
    let mut drawings: Vec<(f64, Vec<[f64; 2]>)> = (1..=STARTS)
        .map(|start| {
            let mut points = scatter(graph.nodes(), start);
            for _ in 0..ROUNDS {
                points = improve(&points, &distances);
            }
            let points = fit(&points);
            (cost(&points), points)
        })
        .collect();
    drawings.sort_by(|a, b| a.0.total_cmp(&b.0));
    drawings
        .into_iter()
        .take(POLISHED)
        .map(|(_, points)| polish(points, &cost))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map_or_else(Vec::new, |(_, points)| fit(&points))
}

/// Moves one node after the other to the best place of the grid until no move helps.
fn polish(mut points: Vec<[f64; 2]>, cost: &impl Fn(&[[f64; 2]]) -> f64) -> (f64, Vec<[f64; 2]>) {
    let mut best = cost(&points);
    loop {
        let before = best;
        for v in 0..points.len() {
            let mut place = points[v];
            for cell in 0..(GRID + 1) * (GRID + 1) {
                let step = |k: u32| f64::from(k) / f64::from(GRID);
                points[v] = [step(cell % (GRID + 1)), step(cell / (GRID + 1))];
                let moved = cost(&points);
                if moved < best {
                    best = moved;
                    place = points[v];
                }
            }
            points[v] = place;
        }
        if best >= before {
            return (best, points);
        }
    }
}

/// Lengths of shortest paths; the number of nodes where there is none.
fn distances(graph: &Graph) -> Vec<Vec<f64>> {
    let adjacency = Adjacency::new(graph);
    let nodes = graph.nodes();
    (0..nodes)
        .map(|from| {
            let mut lengths = vec![nodes as f64; nodes];
            lengths[from] = 0.0;
            let mut queue = vec![from as u32];
            let mut at = 0;
            while at < queue.len() {
                let v = queue[at];
                at += 1;
                for &w in adjacency.neighbours(v) {
                    let length = lengths[v as usize] + 1.0;
                    if length < lengths[w as usize] {
                        lengths[w as usize] = length;
                        queue.push(w);
                    }
                }
            }
            lengths
        })
        .collect()
}

/// Some points, different for every start.
fn scatter(nodes: usize, start: u64) -> Vec<[f64; 2]> {
    let mut state = start;
    let mut next = move || {
        // The linear congruential generator of Knuth's MMIX.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / f64::from(1 << 20)
    };
    (0..nodes).map(|_| [next(), next()]).collect()
}

fn length([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

fn minus([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a - c, b - d]
}

/// One round: every node moves to the mean of where the others want it.
fn improve(points: &[[f64; 2]], distances: &[Vec<f64>]) -> Vec<[f64; 2]> {
    let mut points = points.to_vec();
    for v in 0..points.len() {
        let (mut sum, mut weights) = ([0.0; 2], 0.0);
        for w in 0..points.len() {
            let wanted = distances[v][w];
            if w != v {
                let weight = 1.0 / (wanted * wanted);
                let apart = minus(points[v], points[w]);
                let scale = wanted / length(apart).max(1e-6);
                for k in 0..2 {
                    sum[k] += weight * (points[w][k] + scale * apart[k]);
                }
                weights += weight;
            }
        }
        if weights > 0.0 {
            points[v] = sum.map(|x| x / weights);
        }
    }
    points
}

/// Moves and scales to the unit square, keeping proportions.
fn fit(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let bound = |k: usize, pick: fn(f64, f64) -> f64| {
        points
            .iter()
            .map(|point| point[k])
            .reduce(pick)
            .unwrap_or(0.0)
    };
    let low = [bound(0, f64::min), bound(1, f64::min)];
    let size = minus([bound(0, f64::max), bound(1, f64::max)], low);
    let scale = 1.0 / size[0].max(size[1]).max(1e-6);
    points
        .iter()
        .map(|&point| {
            let moved = minus(point, low);
            std::array::from_fn(|k| moved[k] * scale + (1.0 - size[k] * scale) / 2.0)
        })
        .collect()
}

/// How far distances are from being proportional to those wanted, below 1 for a sensible
/// drawing.
fn stress(points: &[[f64; 2]], distances: &[Vec<f64>]) -> f64 {
    let (mut squares, mut ratios, mut count) = (0.0f64, 0.0f64, 0.0f64);
    for v in 0..points.len() {
        for w in 0..v {
            let ratio = length(minus(points[v], points[w])) / distances[v][w];
            squares += ratio * ratio;
            ratios += ratio;
            count += 1.0;
        }
    }
    if ratios > 0.0 {
        1.0 - ratios * ratios / (squares * count)
    } else {
        0.0
    }
}

/// Crossings of edges, and three for a node that an edge of others comes too close to.
fn flaws(graph: &Graph, points: &[[f64; 2]]) -> usize {
    let at = |v: u32| points[v as usize];
    let mut flaws = 0;
    for (k, &(a, b)) in graph.edges().iter().enumerate() {
        for &(c, d) in &graph.edges()[..k] {
            let apart = a != c && a != d && b != c && b != d;
            if apart && cross(at(a), at(b), at(c), at(d)) {
                flaws += 1;
            }
        }
        for v in 0..graph.nodes() as u32 {
            if v != a && v != b && distance_to_segment(at(v), at(a), at(b)) < 0.07 {
                flaws += 3;
            }
        }
    }
    flaws
}

/// Twice the signed area of a triangle.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let ([x, y], [z, w]) = (minus(b, a), minus(c, a));
    x * w - y * z
}

fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2], d: [f64; 2]) -> bool {
    turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0
}

fn distance_to_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (along, to) = (minus(b, a), minus(p, a));
    let square = (along[0] * along[0] + along[1] * along[1]).max(1e-12);
    let t = ((along[0] * to[0] + along[1] * to[1]) / square).clamp(0.0, 1.0);
    length([to[0] - t * along[0], to[1] - t * along[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planar_graphs_are_drawn_without_flaws() {
        let k23 = vec![(0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (1, 4)];
        let k4 = vec![(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)];
        for (nodes, pairs) in [(5, k23), (4, k4)] {
            let (graph, _) = Graph::from_pairs(nodes, pairs).unwrap();
            let points = layout(&graph);
            assert_eq!(flaws(&graph, &points), 0, "{points:?}");
            assert!(points.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
        }
    }

    #[test]
    fn flaws_are_seen() {
        let (graph, _) = Graph::from_pairs(4, vec![(0, 1), (2, 3)]).unwrap();
        let crossing = [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]];
        assert_eq!(flaws(&graph, &crossing), 1);
        let touching = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.01], [0.5, 1.0]];
        assert_eq!(flaws(&graph, &touching), 3);
    }
}
