//! Plane flows of a kernel, and of its subdivisions by conditions on them.
//!
//! Proposition 3.7 of docs/theory.md: the plane flows of a subdivision are those of the kernel
//! whose planes hold the inner nodes too. With the planes through an edge written in a basis whose
//! first one holds the centre of the node that may subdivide it, such a condition is that the second
//! coordinate vanishes. The flows of the kernel are computed once, subdivisions that begin with the
//! same edges share what these conditions leave, and only the last step, the rank of Lambda, is made
//! for each of them.

use super::super::kernel::MAX_CYCLES;
use super::super::multigraph::Multigraph;
use rand::RngExt;
use rand::rand_core::Rng;
use std::sync::LazyLock;
use viewcert::graph::UnionFind;
use viewcert::linalg::Ring;
use viewcert::linalg::dense_lu::eliminate_mod;
use viewcert::linalg::matrix::Matrix;
use viewcert::linalg::prime::PrimeField;
use viewcert::watch::unwatched;

/// All is computed modulo this prime, 2^31 - 1: a rank there is a lower bound (Proposition 1.4).
const P: u64 = (1 << 31) - 1;

/// For what is computed once per kernel.
static FIELD: LazyLock<PrimeField> =
    LazyLock::new(|| PrimeField::new(P).expect("2^31 - 1 is a prime"));

/// The most edges of a kernel.
pub(super) const MAX_EDGES: usize = 3 * (MAX_CYCLES - 1);

/// Coordinates of a flow: the second one of every edge, then the first ones of the edges outside
/// of a spanning tree. More are not needed once the flows of the kernel are known.
type Flow = [u32; MAX_EDGES + MAX_CYCLES];

/// A point or a plane.
type Vector = [u32; 4];

/// The most flows that a matrix Lambda is made of; a graph with more is not decided here.
const MAX_FLOWS: usize = 18;

/// The plane flows of a kernel, and of one subdivision after the other.
pub(super) struct PlaneFlows {
    nodes: usize,
    edges: usize,
    /// The edges outside of a spanning tree: one for each independent cycle.
    cotree: Vec<usize>,
    /// Two planes through both ends of each of these; the first one holds the inner node.
    pencils: Vec<[Vector; 2]>,
    /// The flows of the kernel, then those left by one more subdivided edge each.
    levels: Vec<Vec<Flow>>,
    /// The edges subdivided so far, increasing: `levels` has one more.
    subdivided: Vec<usize>,
}

impl PlaneFlows {
    /// The flows of a kernel at random centres. O((n + m) m^2) for n nodes and m edges.
    pub(super) fn new(kernel: &Multigraph, random: &mut impl Rng) -> Self {
        let ends = kernel.edge_list();
        let pencils = draw(kernel.nodes(), &ends, random);
        let cotree = outside_of_a_tree(kernel.nodes(), &ends);
        let flows = conserved(kernel.nodes(), &ends, &pencils)
            .iter()
            .map(|whole| {
                let mut flow = [0; MAX_EDGES + MAX_CYCLES];
                for edge in 0..ends.len() {
                    flow[edge] = whole[2 * edge + 1];
                }
                for (k, &edge) in cotree.iter().enumerate() {
                    flow[ends.len() + k] = whole[2 * edge];
                }
                flow
            })
            .collect();
        Self {
            nodes: kernel.nodes(),
            edges: ends.len(),
            pencils: cotree.iter().map(|&edge| pencils[edge]).collect(),
            cotree,
            levels: vec![flows],
            subdivided: Vec::new(),
        }
    }

    /// Whether N and Lambda of the subdivision have full rank at the centres drawn: then it is
    /// finite solvable (theory, Theorem 3.5). Otherwise nothing is proved.
    ///
    /// O(f^2 (m + c)) for every edge in which the subdivision differs from the last one asked for,
    /// f flows and c independent cycles, and O(c^2 f) for the rank of Lambda.
    pub(super) fn full_rank(&mut self, subdivided: u32) -> bool {
        let inner = subdivided.count_ones() as usize;
        // The dimension of the flows if N has full rank, 3 n - 4.
        let (nodes, edges) = (self.nodes + inner, self.edges + inner);
        let Some(dimension) = (2 * edges + 4).checked_sub(3 * nodes) else {
            return false;
        };
        self.subdivide(subdivided);
        let flows = &self.levels[inner];
        flows.len() == dimension && dimension <= MAX_FLOWS && self.lambda_has_full_rank(flows)
    }

    /// Brings the levels to the flows of this subdivision.
    fn subdivide(&mut self, subdivided: u32) {
        let mut kept = 0;
        let mut left = subdivided;
        while left != 0 {
            let edge = left.trailing_zeros() as usize;
            if self.subdivided.get(kept) != Some(&edge) {
                break;
            }
            kept += 1;
            left &= left - 1;
        }
        self.subdivided.truncate(kept);
        while left != 0 {
            let edge = left.trailing_zeros() as usize;
            left &= left - 1;
            let level = self.subdivided.len();
            if self.levels.len() < level + 2 {
                self.levels.push(Vec::new());
            }
            let [from, to] = &mut self.levels[level..level + 2] else {
                unreachable!("two levels");
            };
            vanishing(from, edge, self.edges + self.cotree.len(), to);
            self.subdivided.push(edge);
        }
    }

    /// A row for each independent cycle, four columns for each flow: the plane of the flow on the
    /// edge of the cycle outside of the tree. (Potentials take the other edges away.)
    fn lambda_has_full_rank(&self, flows: &[Flow]) -> bool {
        let columns = 4 * flows.len();
        let mut rows = [[0u32; 4 * MAX_FLOWS]; MAX_CYCLES];
        let rows = &mut rows[..self.cotree.len()];
        for (k, (row, &edge)) in rows.iter_mut().zip(&self.cotree).enumerate() {
            let [first, second] = &self.pencils[k];
            for (flow, plane) in flows.iter().zip(row.chunks_exact_mut(4)) {
                let (x, y) = (flow[self.edges + k], flow[edge]);
                for ((entry, &a), &b) in plane.iter_mut().zip(first).zip(second) {
                    *entry = reduce(u64::from(x) * u64::from(a) + u64::from(y) * u64::from(b));
                }
            }
        }
        for k in 0..rows.len() {
            let (done, below) = rows.split_at_mut(k + 1);
            let row = &done[k][..columns];
            let Some(at) = row.iter().position(|&entry| entry != 0) else {
                return false;
            };
            for other in below {
                cancel(&mut other[..columns], row, at);
            }
        }
        true
    }
}

/// Those combinations of `flows` that vanish at a coordinate; all of the first `width` ones are
/// kept up.
fn vanishing(flows: &[Flow], at: usize, width: usize, out: &mut Vec<Flow>) {
    out.clear();
    let Some(pivot) = flows.iter().position(|flow| flow[at] != 0) else {
        out.extend_from_slice(flows);
        return;
    };
    let row = &flows[pivot];
    for (k, flow) in flows.iter().enumerate() {
        if k != pivot {
            let mut flow = *flow;
            if flow[at] != 0 {
                cancel(&mut flow[..width], &row[..width], at);
            }
            out.push(flow);
        }
    }
}

/// Makes entry `at` of `other` vanish: `other` times that of `row`, minus `row` times that of
/// `other`. No inverse is taken.
fn cancel(other: &mut [u32], row: &[u32], at: usize) {
    let (scale, minus) = (u64::from(row[at]), P - u64::from(other[at]));
    for (entry, &above) in other.iter_mut().zip(row) {
        *entry = reduce(u64::from(*entry) * scale + u64::from(above) * minus);
    }
}

/// A number below 2^63 modulo 2^31 - 1.
fn reduce(x: u64) -> u32 {
    let x = (x & P) + (x >> 31);
    let x = (x & P) + (x >> 31);
    let x = x as u32;
    x.min(x.wrapping_sub(P as u32))
}

fn multiply(a: u32, b: u32) -> u32 {
    reduce(u64::from(a) * u64::from(b))
}

fn negative(a: u32) -> u32 {
    if a == 0 { 0 } else { P as u32 - a }
}

/// For every edge two planes through the random centres of its ends, which are distinct: the first
/// one through a random inner node as well and the second one not.
fn draw(nodes: usize, ends: &[(usize, usize)], random: &mut impl Rng) -> Vec<[Vector; 2]> {
    loop {
        let mut point = || -> Vector {
            let [x, y, z] = std::array::from_fn(|_| random.random_range(0..P as u32));
            [x, y, z, 1]
        };
        let centres: Vec<Vector> = (0..nodes).map(|_| point()).collect();
        let pencils: Option<Vec<_>> = ends
            .iter()
            .map(|&(u, v)| {
                let (inner, other) = (point(), point());
                let first = plane(&centres[u], &centres[v], &inner);
                let second = plane(&centres[u], &centres[v], &other);
                // So the inner node is on no line through both ends, and distinct from them.
                (dot(&second, &inner) != 0).then_some([first, second])
            })
            .collect();
        if let Some(pencils) = pencils {
            return pencils;
        }
    }
}

/// The plane through three points: the minors of the matrix of their coordinates.
fn plane(a: &Vector, b: &Vector, c: &Vector) -> Vector {
    let minor = |i: usize, j: usize, k: usize| {
        let terms = [(i, j, k), (j, k, i), (k, i, j)].map(|(i, j, k)| {
            let two = u64::from(multiply(b[j], c[k])) + u64::from(negative(multiply(b[k], c[j])));
            multiply(a[i], reduce(two))
        });
        reduce(terms.iter().map(|&term| u64::from(term)).sum())
    };
    [
        minor(1, 2, 3),
        negative(minor(0, 2, 3)),
        minor(0, 1, 3),
        negative(minor(0, 1, 2)),
    ]
}

fn dot(plane: &Vector, point: &Vector) -> u32 {
    let terms = plane.iter().zip(point).map(|(&a, &b)| multiply(a, b));
    reduce(terms.map(u64::from).sum())
}

/// The edges that do not join two trees of those before them.
fn outside_of_a_tree(nodes: usize, ends: &[(usize, usize)]) -> Vec<usize> {
    let mut trees = UnionFind::new(nodes);
    let joins_none = |&edge: &usize| !trees.union(ends[edge].0, ends[edge].1);
    (0..ends.len()).filter(joins_none).collect()
}

/// A basis of the plane flows, two coordinates for every edge: the planes sum to zero at every node.
/// Three coordinates of the sum are enough, as all planes there hold the centre, whose last
/// coordinate is 1.
fn conserved(nodes: usize, ends: &[(usize, usize)], pencils: &[[Vector; 2]]) -> Vec<Vec<u32>> {
    let field = &*FIELD;
    let columns = 2 * ends.len();
    let mut equations = Matrix::new(3 * nodes, columns, vec![0; 3 * nodes * columns]);
    for (edge, (&(u, v), pencil)) in ends.iter().zip(pencils).enumerate() {
        for (k, plane) in pencil.iter().enumerate() {
            for (r, &entry) in plane[..3].iter().enumerate() {
                let entry = field.from_u64(entry.into());
                equations.row_mut(3 * u + r)[2 * edge + k] = entry;
                equations.row_mut(3 * v + r)[2 * edge + k] = field.neg(&entry);
            }
        }
    }
    let echelon = unwatched(|task| eliminate_mod(field, equations, task));
    let flows = echelon.right_kernel();
    (0..flows.rows())
        .map(|k| {
            flows
                .row(k)
                .iter()
                .map(|&x| field.to_u64(x) as u32)
                .collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::kernel::kernels;
    use super::super::super::subdivide::{Edges, Subdivisions};
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha12Rng;
    use viewcert::decide::{Options, decide};
    use viewcert::geometry::model::Model;

    #[test]
    fn residues() {
        let p = P as u32;
        for x in [
            0,
            1,
            P - 1,
            P,
            P + 1,
            2 * P,
            P * P - 1,
            P * P,
            (1 << 63) - 1,
        ] {
            assert_eq!(u64::from(reduce(x)), x % P, "{x}");
        }
        for a in [1, 2, 3, 12345, p - 1] {
            assert_eq!(u64::from(multiply(a, a)), u64::from(a) * u64::from(a) % P);
            assert_eq!((a + negative(a)) % p, 0);
        }
        assert_eq!(negative(0), 0);
    }

    /// The plane through three coordinate points of one coordinate space holds them alone.
    #[test]
    fn planes_by_hand() {
        let [a, b, c] = [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]];
        let through = plane(&a, &b, &c);
        assert!([a, b, c].iter().all(|point| dot(&through, point) == 0));
        // x + y + z = 1.
        assert_eq!(through[0], negative(dot(&through, &[0, 0, 0, 1])));
        assert_ne!(through[0], 0);
        assert_eq!([through[1], through[2]], [through[0]; 2]);
    }

    /// Flows of the kernel with conditions against those of the subdivided graph, of which there
    /// are 2 m minus the rank of N, the calibrated one; and in whatever order subdivisions are asked for.
    #[test]
    fn flows_are_those_of_the_subdivided_graph() {
        let options = Options::default().model(Model::Calibrated);
        for (cycles, nodes) in [(3, 6), (4, 8), (5, 9)] {
            for kernel in kernels(cycles, nodes) {
                let mut random = ChaCha12Rng::seed_from_u64(7);
                let mut flows = PlaneFlows::new(&kernel, &mut random);
                let mut seen = Vec::new();
                Subdivisions::new(&kernel, nodes, Edges::Once).for_each(&mut |subdivision| {
                    seen.push((subdivision.graph(), subdivision.subdivided().unwrap()));
                    true
                });
                // Neighbours in the list share most of their edges; the reversed order and every
                // other one share others.
                let order = (0..seen.len()).chain((0..seen.len()).rev().step_by(2));
                let mut answers = vec![None; seen.len()];
                for k in order {
                    let (graph, set) = &seen[k];
                    let full = flows.full_rank(*set);
                    assert_eq!(*answers[k].get_or_insert(full), full, "{graph:?}");
                    let inner = set.count_ones() as usize;
                    let rank = decide(graph, &options).unwrap().rank;
                    assert_eq!(
                        flows.levels[inner].len(),
                        2 * graph.edges().len() - rank,
                        "{graph:?}"
                    );
                }
            }
        }
    }
}
