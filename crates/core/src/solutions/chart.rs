//! The core with scales: what is left of a graph when half-edges are eliminated, and N(u).
//!
//! In: members that share nodes, and centres modulo a prime. Out: a chart, that is which
//! scales u are one and which are unknowns, and the rows of N(u) (docs/theory.md, (10.1) and
//! Lemma 10.4).

use super::evidence::{Chart, Scale};
use super::members::{Members, Set, bits};
use crate::geometry::plane_flow::directions;
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;

/// One side of a row of N(u): `scale * vector` in the columns of a node.
#[derive(Clone, Debug)]
pub(super) struct Side {
    /// The node, among those that were not eliminated.
    pub(super) node: usize,
    pub(super) vector: [u64; 3],
    /// Which of the three entries are not the zero polynomial in the centres.
    pub(super) pattern: [bool; 3],
    /// The unknown, if the scale is not one.
    pub(super) scale: Option<usize>,
}

/// A row of N(u): the one side less the other.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) sides: [Side; 2],
}

impl Row {
    /// The unknowns in it.
    pub(super) fn unknowns(&self) -> impl Iterator<Item = usize> + '_ {
        self.sides.iter().filter_map(|side| side.scale)
    }

    /// A side as a vector with `columns` entries.
    pub(super) fn side(&self, which: usize, columns: usize) -> Vec<u64> {
        let side = &self.sides[which];
        let mut row = vec![0; columns];
        row[3 * side.node..3 * side.node + 3].copy_from_slice(&side.vector);
        row
    }

    /// The row where the unknowns have these values. `None` stands for an unknown without value.
    pub(super) fn at(
        &self,
        field: &PrimeField,
        columns: usize,
        value: impl Fn(usize) -> u64,
    ) -> Vec<u64> {
        let mut row = vec![0; columns];
        let [plus, minus] = [0, 1].map(|k| self.sides[k].scale.map(&value));
        for (side, factor, negative) in
            [(&self.sides[0], plus, false), (&self.sides[1], minus, true)]
        {
            for (at, &entry) in (3 * side.node..).zip(&side.vector) {
                let entry = factor.map_or(entry, |factor| field.times(factor, entry));
                row[at] = if negative { field.negate(entry) } else { entry };
            }
        }
        row
    }
}

/// Members with shared nodes as indices, half-edges apart.
#[derive(Clone, Debug)]
pub(super) struct Core {
    /// Nodes of the graph, by index: all that are shared.
    pub(super) nodes: Vec<u32>,
    /// For every shared node its number among those that are not eliminated.
    number: Vec<Option<usize>>,
    /// The members that are left, each as indices of nodes, in the order of its chain.
    pub(super) bodies: Vec<Vec<usize>>,
    /// `[v, a, b]`, as indices of nodes.
    pub(super) half_edges: Vec<[usize; 3]>,
    /// The unknown of each body at each of its nodes, if its scale is not one.
    body_scales: Vec<Vec<Option<usize>>>,
    /// The unknown of each half-edge at b, if its scale is not one.
    half_edge_scales: Vec<Option<usize>>,
    /// How many unknowns there are.
    pub(super) unknowns: usize,
}

impl Core {
    /// The core of members of which there are two or more; `None` if one of them shares less
    /// than two nodes, so that the graph is not finite solvable. Charts differ in the
    /// nodes that are eliminated and in the spanning tree.
    pub(super) fn new(members: &Members, chart: usize) -> Option<Self> {
        let sets = &members.sets;
        if sets.iter().any(|set| set.count_ones() < 2) {
            return None;
        }
        let mut nodes: Vec<usize> = (0..members.nodes.len()).collect();
        shuffle(&mut nodes, chart);
        let (mut half_edges, mut bodies) = half_edges(sets, &nodes);
        shuffle(&mut bodies, chart);
        shuffle(&mut half_edges, chart);
        // Big members first: their scales stay in few rows, and half-edges come last of all.
        bodies.sort_by_key(|body| std::cmp::Reverse(body.len()));
        let mut number = vec![None; members.nodes.len()];
        let mut left = 0;
        for (v, number) in number.iter_mut().enumerate() {
            if !half_edges.iter().any(|half| half[0] == v) {
                *number = Some(left);
                left += 1;
            }
        }
        let mut core = Self {
            nodes: members.nodes.clone(),
            number,
            bodies,
            half_edges,
            body_scales: Vec::new(),
            half_edge_scales: Vec::new(),
            unknowns: 0,
        };
        core.choose_tree();
        Some(core)
    }

    /// Puts scales into a spanning tree as long as they join what was apart.
    fn choose_tree(&mut self) {
        let mut class: Vec<usize> = (0..self.nodes.len()).collect();
        let mut join = |a: usize, b: usize| {
            let (from, to) = (class[a], class[b]);
            for x in &mut class {
                if *x == from {
                    *x = to;
                }
            }
            from != to
        };
        let mut unknowns = 0;
        let mut unknown = || {
            unknowns += 1;
            Some(unknowns - 1)
        };
        for body in &mut self.bodies {
            let first = body[0];
            let (mut known, mut rest) = (vec![first], Vec::new());
            for &v in &body[1..] {
                if join(first, v) {
                    known.push(v);
                } else {
                    rest.push(v);
                }
            }
            let mut scales = vec![None; known.len()];
            scales.extend(rest.iter().map(|_| unknown()));
            self.body_scales.push(scales);
            known.extend(rest);
            *body = known;
        }
        for &[_, a, b] in &self.half_edges {
            let scale = if join(a, b) { None } else { unknown() };
            self.half_edge_scales.push(scale);
        }
        self.unknowns = unknowns;
    }

    /// Columns of N(u): three for each node that is not eliminated.
    pub(super) fn columns(&self) -> usize {
        3 * self.number.iter().flatten().count()
    }

    /// The rank of N(u) at a solution, at most: 3 n' - 4.
    pub(super) fn target(&self) -> usize {
        self.columns() - 4
    }

    /// The chart in terms of the graph.
    pub(super) fn chart(&self) -> Chart {
        let name = |&v: &usize| self.nodes[v];
        let mut members: Vec<Vec<u32>> = self
            .bodies
            .iter()
            .map(|body| body.iter().map(name).collect())
            .collect();
        let mut unknowns = Vec::new();
        for (member, (body, scales)) in self.bodies.iter().zip(&self.body_scales).enumerate() {
            let of_body = body.iter().zip(scales).filter(|(_, scale)| scale.is_some());
            unknowns.extend(of_body.map(|(v, _)| Scale {
                node: name(v),
                member,
            }));
        }
        for ([v, a, b], scale) in self.half_edges.iter().zip(&self.half_edge_scales) {
            members.push(vec![name(v), name(a)]);
            members.push(vec![name(v), name(b)]);
            if scale.is_some() {
                unknowns.push(Scale {
                    node: name(b),
                    member: members.len() - 1,
                });
            }
        }
        let half_edges = self
            .half_edges
            .iter()
            .map(|half| half.map(|v| self.nodes[v]))
            .collect();
        Chart {
            members,
            half_edges,
            unknowns,
        }
    }

    /// The rows of N(u): those of the bodies, 3 |s| - 4 each, then one for each half-edge.
    /// `None` if centres coincide or a half-edge is degenerate. `centres` are by index of node.
    pub(super) fn rows(&self, field: &PrimeField, centres: &[[u64; 3]]) -> Option<Vec<Row>> {
        let mut rows = Vec::new();
        let number = |v: usize| self.number[v];
        for (body, scales) in self.bodies.iter().zip(&self.body_scales) {
            let mut put = |i: usize, j: usize, pattern: [bool; 3], vector: [u64; 3]| {
                let side = |k: usize| {
                    number(body[k]).map(|node| Side {
                        node,
                        vector,
                        pattern,
                        scale: scales[k],
                    })
                };
                rows.push(Row {
                    sides: [side(i)?, side(j)?],
                });
                Some(())
            };
            for j in 1..body.len() {
                let [first, second] =
                    fixed_directions(field, &centres[body[j - 1]], &centres[body[j]])?;
                put(j - 1, j, [true, true, false], first)?;
                put(j - 1, j, [true, false, true], second)?;
                if j > 1 {
                    let [third, _] =
                        fixed_directions(field, &centres[body[j - 2]], &centres[body[j]])?;
                    put(j - 2, j, [true, true, false], third)?;
                }
            }
        }
        for (&[v, a, b], &scale) in self.half_edges.iter().zip(&self.half_edge_scales) {
            let vector = normal(field, &centres[v], &centres[a], &centres[b])?;
            let [plus, minus] = [a, b].map(number);
            rows.push(Row {
                sides: [
                    Side {
                        node: plus?,
                        vector,
                        pattern: [true; 3],
                        scale: None,
                    },
                    Side {
                        node: minus?,
                        vector,
                        pattern: [true; 3],
                        scale,
                    },
                ],
            });
        }
        Some(rows)
    }

    /// How many rows each body has; the rows are in the order of the bodies.
    pub(super) fn row_counts(&self) -> impl Iterator<Item = usize> + '_ {
        self.bodies.iter().map(|body| 3 * body.len() - 4)
    }

    /// The highest degree of every unknown in minors of N(u): that of a node's column in each of
    /// its rows, 3 at most.
    pub(super) fn degrees(&self, rows: &[Row]) -> Vec<usize> {
        (0..self.unknowns)
            .map(|f| {
                rows.iter()
                    .filter(|row| row.unknowns().any(|g| g == f))
                    .count()
                    .min(3)
            })
            .collect()
    }

    /// Kernel vectors of N(u) as 3 x 4 cameras of all shared nodes that lie in the core, by index
    /// of node; `None` if an eliminated node has none, or there are not four vectors.
    pub(super) fn cameras(
        &self,
        field: &PrimeField,
        centres: &[[u64; 3]],
        kernel: &[Vec<u64>],
        values: &[u64],
    ) -> Option<Vec<Option<[[u64; 4]; 3]>>> {
        let [w, x, y, z] = kernel else { return None };
        let columns = [w, x, y, z];
        let mut cameras: Vec<Option<[[u64; 4]; 3]>> = self
            .number
            .iter()
            .map(|number| {
                let at = 3 * (*number)?;
                Some(std::array::from_fn(|row| {
                    columns.map(|column| column[at + row])
                }))
            })
            .collect();
        for (&[v, a, b], scale) in self.half_edges.iter().zip(&self.half_edge_scales) {
            let scale = scale.map_or(field.from_u64(1), |f| values[f]);
            let (at_a, at_b) = (cameras[a]?, cameras[b]?);
            let mut rows = Span::default();
            for (other, camera, factor) in [(a, at_a, field.from_u64(1)), (b, at_b, scale)] {
                for direction in directions(field, &centres[v], &centres[other])? {
                    // direction . y_v, and what it is in each of the four columns.
                    let right = [0, 1, 2, 3].map(|k| {
                        let column = camera.map(|row| row[k]);
                        field.times(factor, field.dot(0, &direction, &column))
                    });
                    rows.insert(field, direction.into_iter().chain(right).collect());
                }
            }
            cameras[v] = Some(solve(field, &rows)?);
        }
        Some(cameras)
    }
}

/// The 3 x 4 matrix Y with [ I | Y ] in the row space of three rows; `None` if there is none.
fn solve(field: &PrimeField, rows: &Span) -> Option<[[u64; 4]; 3]> {
    if rows.dimension() != 3 || rows.pivots().iter().any(|&pivot| pivot > 2) {
        return None;
    }
    let one = field.from_u64(1);
    let mut solution = [[0; 4]; 3];
    for k in 0..3 {
        // e_k less its part in the row space is minus row k of Y, behind three zeros.
        let mut unit = vec![0; 7];
        unit[k] = one;
        rows.reduce(field, &mut unit);
        for (entry, &rest) in solution[k].iter_mut().zip(&unit[3..]) {
            *entry = field.negate(rest);
        }
        if unit[..3].iter().any(|&x| x != 0) {
            return None;
        }
    }
    Some(solution)
}

/// The directions (3.1) with q = 1: polynomials in the centres, and not chosen at the point. `None`
/// if the first coordinates are equal.
fn fixed_directions(field: &PrimeField, c: &[u64; 3], d: &[u64; 3]) -> Option<[[u64; 3]; 2]> {
    if c[0] == d[0] {
        return None;
    }
    directions(field, c, d)
}

/// Nodes in just two members, both of two nodes, no two of them adjacent, the first ones of a list; and
/// the other members.
fn half_edges(sets: &[Set], nodes: &[usize]) -> (Vec<[usize; 3]>, Vec<Vec<usize>>) {
    let mut used = vec![false; sets.len()];
    let mut half_edges = Vec::new();
    let mut apart: Set = 0;
    for &v in nodes {
        let at_v: Vec<usize> = (0..sets.len()).filter(|&k| sets[k] >> v & 1 == 1).collect();
        let [k, l] = at_v[..] else { continue };
        if [k, l].iter().any(|&x| sets[x].count_ones() != 2) {
            continue;
        }
        let others = (sets[k] | sets[l]) & !(1 << v);
        if apart & (others | 1 << v) != 0 || others.count_ones() != 2 {
            continue;
        }
        // Neither its neighbours nor the node may be an end of another such elimination.
        if half_edges
            .iter()
            .any(|&[w, _, _]: &[usize; 3]| others >> w & 1 == 1)
        {
            continue;
        }
        apart |= 1 << v;
        (used[k], used[l]) = (true, true);
        let end = |set: Set| (set & !(1 << v)).trailing_zeros() as usize;
        half_edges.push([v, end(sets[k]), end(sets[l])]);
    }
    let left = sets.iter().zip(used).filter(|&(_, used)| !used);
    (
        half_edges,
        left.map(|(&set, _)| bits(set).collect()).collect(),
    )
}

/// An order that looks random, the same one for the same number; 0 leaves a list as it is.
fn shuffle<T>(list: &mut [T], number: usize) {
    let mut state = number as u64;
    for k in (1..list.len()).rev().filter(|_| number > 0) {
        // Splitmix64 (Steele, Lea, Flood 2014); which order is taken decides nothing.
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = state;
        mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^= mixed >> 31;
        list.swap(k, (mixed % (k as u64 + 1)) as usize);
    }
}

/// (a - v) x (b - v), which is normal to the plane of three centres; `None` if they are collinear.
fn normal(field: &PrimeField, v: &[u64; 3], a: &[u64; 3], b: &[u64; 3]) -> Option<[u64; 3]> {
    let difference =
        |x: &[u64; 3]| -> [u64; 3] { std::array::from_fn(|k| field.minus(x[k], v[k])) };
    let (d, e) = (difference(a), difference(b));
    let cross: [u64; 3] = std::array::from_fn(|k| {
        let (l, m) = ((k + 1) % 3, (k + 2) % 3);
        field.minus(field.times(d[l], e[m]), field.times(d[m], e[l]))
    });
    cross.iter().any(|&x| x != 0).then_some(cross)
}
