//! A second solution to look at: two families of cameras modulo a prime that have the same
//! fundamental matrices and are not equivalent.
//!
//! In: a graph, and simple points of a core (Theorem 10.10 of docs/theory.md). Out: cameras of all
//! nodes. The shared nodes get theirs from the kernel of N(u), by (10.1); the others follow their
//! members. Everything is verified by (1.1) before it leaves.

use super::count::{Draws, points_at};
use super::evidence::{Lower, Solutions};
use crate::geometry::camera::{Camera, normal_form};
use crate::geometry::draw::{DrawKey, centres_mod};
use crate::geometry::jacobian::fundamental;
use crate::geometry::plane_flow::directions;
use crate::graph::{Adjacency, Graph, sha256};
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;
use crate::watch::{Step, unwatched};

/// Two families of cameras with the same fundamental matrices on all edges, up to factors, of which
/// none is the other one times one 4 x 4 matrix.
///
/// They are solutions at the cameras of the first family. Theorem 10.10 says that there are as many
/// at generic ones; that two are here is no proof of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Witness {
    /// The modulus.
    pub prime: u64,
    /// The 3 x 4 cameras of every node, as least residues.
    pub families: [Vec<[[u64; 4]; 3]>; 2],
}

impl Solutions {
    /// Two solutions of the graph that was counted; `None` if no second one is known. `seed` selects
    /// the centres of nodes that no two members share. O(n^3) for n shared nodes.
    pub fn witness(&self, graph: &Graph, seed: u64) -> Option<Witness> {
        let lower = self.lower.as_ref()?;
        let field = PrimeField::new(lower.place.prime).ok()?;
        let key = DrawKey {
            graph_sha256: sha256(graph),
            core_sha256: None,
            seed,
            // Centres of a count are drawn before it: no two nodes may be in one place.
            draw: 1 << 40,
        };
        let mut centres = centres_mod(&field, graph.nodes(), &key).ok()?.values;
        for &(v, centre) in &lower.place.centres {
            centres[v as usize] = centre.map(|x| field.from_u64(x));
        }
        let place = At::new(field, graph, centres, lower, other_points(lower).next()?);
        let first = place.given();
        let second = place.second(&first)?;
        place.is_witness(&first, &second).then(|| {
            let residues = |cameras: Vec<Camera<u64>>| {
                let entry = |x| field.to_u64(x);
                cameras
                    .into_iter()
                    .map(|camera| camera.map(|row| row.map(entry)))
                    .collect()
            };
            Witness {
                prime: field.modulus(),
                families: [first, second].map(residues),
            }
        })
    }
}

/// The points of a core other than u = 1.
fn other_points(lower: &Lower) -> impl Iterator<Item = &Vec<u64>> {
    let points = lower.points.iter();
    points.filter(|point| point.iter().any(|&u| u != 1))
}

impl Solutions {
    /// The cameras of all other solutions at these centres of all nodes, modulo the prime of the lower bound.
    /// `None` if they are not as many as were counted, or not all simple, or have no residues.
    pub fn families_at(
        &self,
        graph: &Graph,
        centres: Vec<[u64; 3]>,
        seed: u64,
    ) -> Option<Vec<Vec<Camera<u64>>>> {
        let lower = unwatched(|task| {
            let work = task.at(Step::Solutions).begin(0);
            let draws = Draws::new(graph, seed, &work).at(centres.clone());
            Ok(points_at(self, graph, &draws))
        })?;
        let field = PrimeField::new(lower.place.prime).ok()?;
        let families = other_points(&lower).map(|point| {
            let place = At::new(field, graph, centres.clone(), &lower, point);
            let first = place.given();
            let second = place.second(&first)?;
            place.is_witness(&first, &second).then_some(second)
        });
        families.collect()
    }
}

/// A point of a core, and the centres of all nodes.
struct At<'a> {
    field: PrimeField,
    graph: &'a Graph,
    centres: Vec<[u64; 3]>,
    lower: &'a Lower,
    scales: Vec<u64>,
}

impl<'a> At<'a> {
    fn new(
        field: PrimeField,
        graph: &'a Graph,
        centres: Vec<[u64; 3]>,
        lower: &'a Lower,
        point: &[u64],
    ) -> Self {
        Self {
            scales: point.iter().map(|&u| field.from_u64(u)).collect(),
            field,
            graph,
            centres,
            lower,
        }
    }

    fn given(&self) -> Vec<Camera<u64>> {
        self.centres
            .iter()
            .map(|c| normal_form(&self.field, c))
            .collect()
    }

    /// The scale of a member at a node.
    fn scale(&self, member: usize, node: u32) -> u64 {
        let unknowns = self.lower.place.chart.unknowns.iter();
        unknowns
            .zip(&self.scales)
            .find(|(unknown, _)| (unknown.member, unknown.node) == (member, node))
            .map_or(self.field.from_u64(1), |(_, &scale)| scale)
    }

    /// The cameras of the other solution.
    fn second(&self, given: &[Camera<u64>]) -> Option<Vec<Camera<u64>>> {
        let members = &self.lower.place.chart.members;
        let mut shared: Vec<u32> = members.concat();
        crate::graph::sort_once(&mut shared);
        let mut cameras: Vec<Option<Camera<u64>>> = vec![None; self.graph.nodes()];
        for (v, camera) in shared.iter().zip(self.of_shared(&shared)?) {
            cameras[*v as usize] = Some(camera);
        }
        for inside in self.interiors(&shared) {
            // Its neighbours are shared nodes of the member that it lies in, two or more.
            let adjacency = Adjacency::new(self.graph);
            let around = inside.iter().flat_map(|&v| adjacency.neighbours(v));
            let around: Vec<u32> = around
                .copied()
                .filter(|v| shared.binary_search(v).is_ok())
                .collect();
            let member = members
                .iter()
                .position(|member| around.iter().all(|v| member.contains(v)))?;
            let map = self.map_of(member, given, &cameras)?;
            for v in inside {
                cameras[v as usize] = Some(self.times(&given[v as usize], &map));
            }
        }
        cameras.into_iter().collect()
    }

    /// The cameras of shared nodes: the kernel of the rows (10.1), which has dimension four.
    fn of_shared(&self, shared: &[u32]) -> Option<Vec<Camera<u64>>> {
        let field = &self.field;
        let columns = 3 * shared.len();
        let mut rows = Span::default();
        for (k, member) in self.lower.place.chart.members.iter().enumerate() {
            for (j, &w) in member.iter().enumerate() {
                for &v in &member[j.saturating_sub(2)..j] {
                    let [c, d] = [v, w].map(|x| &self.centres[x as usize]);
                    for direction in directions(field, c, d)? {
                        let mut row = vec![0; columns];
                        for (node, negative) in [(v, false), (w, true)] {
                            let at = 3 * shared.binary_search(&node).ok()?;
                            let scale = self.scale(k, node);
                            let scale = if negative { field.negate(scale) } else { scale };
                            for (entry, a) in row[at..at + 3].iter_mut().zip(direction) {
                                *entry = field.times(scale, a);
                            }
                        }
                        rows.insert(field, row);
                    }
                }
            }
        }
        let kernel: [Vec<u64>; 4] = rows.kernel(field, columns).try_into().ok()?;
        let camera = |k: usize| -> Camera<u64> {
            std::array::from_fn(|r| std::array::from_fn(|c| kernel[c][3 * k + r]))
        };
        Some((0..shared.len()).map(camera).collect())
    }

    /// The nodes that are not shared, those together that hang together without the shared ones.
    fn interiors(&self, shared: &[u32]) -> Vec<Vec<u32>> {
        let adjacency = Adjacency::new(self.graph);
        let mut seen = vec![false; self.graph.nodes()];
        for &v in shared {
            seen[v as usize] = true;
        }
        let mut interiors = Vec::new();
        for start in 0..self.graph.nodes() as u32 {
            if std::mem::replace(&mut seen[start as usize], true) {
                continue;
            }
            let mut inside = vec![start];
            let mut next = 0;
            while let Some(&v) = inside.get(next) {
                next += 1;
                for &w in adjacency.neighbours(v) {
                    if !std::mem::replace(&mut seen[w as usize], true) {
                        inside.push(w);
                    }
                }
            }
            interiors.push(inside);
        }
        interiors
    }

    /// The 4 x 4 matrix H of a member, with P_v H = u_v Q_v at its shared nodes.
    fn map_of(
        &self,
        member: usize,
        given: &[Camera<u64>],
        cameras: &[Option<Camera<u64>>],
    ) -> Option<[[u64; 4]; 4]> {
        let field = &self.field;
        let mut rows = Span::default();
        for &v in &self.lower.place.chart.members[member] {
            let scale = self.scale(member, v);
            for (p, q) in given[v as usize].iter().zip(cameras[v as usize]?) {
                let right = q.map(|x| field.times(scale, x));
                rows.insert(field, p.iter().copied().chain(right).collect());
            }
        }
        if rows.dimension() != 4 || rows.pivots().iter().any(|&pivot| pivot > 3) {
            return None;
        }
        let mut map = [[0; 4]; 4];
        for (k, row) in map.iter_mut().enumerate() {
            // e_k less its part in the row space is minus row k of H, behind four zeros.
            let mut unit = vec![0; 8];
            unit[k] = field.from_u64(1);
            rows.reduce(field, &mut unit);
            for (entry, &rest) in row.iter_mut().zip(&unit[4..]) {
                *entry = field.negate(rest);
            }
        }
        Some(map)
    }

    fn times(&self, camera: &Camera<u64>, map: &[[u64; 4]; 4]) -> Camera<u64> {
        let column = |c: usize| map.map(|row| row[c]);
        camera.map(|row| std::array::from_fn(|c| self.field.dot(0, &row, &column(c))))
    }

    /// Whether the fundamental matrices are the same on all edges, and not zero, and differ
    /// elsewhere: cameras that are the same up to one matrix have the same ones everywhere.
    fn is_witness(&self, first: &[Camera<u64>], second: &[Camera<u64>]) -> bool {
        let field = &self.field;
        let same = |i: usize, j: usize| {
            let [f, g] = [first, second]
                .map(|cameras| fundamental(field, &cameras[i], &cameras[j]).concat());
            let parallel = |k: usize, l: usize| field.times(f[k], g[l]) == field.times(f[l], g[k]);
            let is_zero = |matrix: &[u64]| matrix.iter().all(|&x| x == 0);
            !is_zero(&f) && !is_zero(&g) && (0..9).all(|k| (0..k).all(|l| parallel(k, l)))
        };
        let nodes = self.graph.nodes();
        let edges = self.graph.edges().iter();
        edges
            .map(|&(i, j)| (i as usize, j as usize))
            .all(|(i, j)| same(i, j))
            && (0..nodes).any(|j| (0..j).any(|i| !same(i, j)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::graph6;
    use crate::solutions::count;

    fn witness(graph: &Graph) -> Option<Witness> {
        count(graph, 1)?.witness(graph, 1)
    }

    /// Published graphs with two solutions, as they are and with a triangle for every edge but one.
    #[test]
    fn two_families() {
        for name in ["HBQkcP_", "HBjCaOc", "H@ZccPO"] {
            let graph = graph6::decode(name.as_bytes()).unwrap();
            let found = witness(&graph).unwrap();
            assert_eq!(found.families.each_ref().map(Vec::len), [9, 9]);
            let edges = graph.edges().to_vec();
            let tips = edges[1..].iter().zip(9..);
            let sides = tips.flat_map(|(&(i, j), tip)| [(i, tip), (j, tip)]);
            let with_bodies: Vec<(u32, u32)> = edges.iter().copied().chain(sides).collect();
            let with_bodies = Graph::from_edges(with_bodies).unwrap();
            let found = witness(&with_bodies).unwrap();
            assert_eq!(found.families[1].len(), 9 + edges.len() - 1);
        }
    }

    /// Eight nodes with one solution.
    #[test]
    fn none_where_there_is_one_solution() {
        let graph = graph6::decode(b"G@TclO").unwrap();
        assert_eq!(witness(&graph), None);
    }
}
