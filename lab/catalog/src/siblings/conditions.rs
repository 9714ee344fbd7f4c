//! Which edges of a kernel can be subdivided so that N and Lambda keep full rank.
//!
//! Proposition 3.8 of docs/theory.md: the edges that are subdivided are four rows each, beside one row for
//! each independent cycle, and what is asked is whether all of these are independent. The rows are
//! computed once for the kernel. Taking an edge reduces the rows of those that may still come by its four,
//! and drops four columns, so subdivisions that begin with the same edges share what that took, and of the
//! last edge nothing is left to see but whether its own four rows are independent.

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

/// A point or a plane.
type Vector = [u32; 4];

/// The most columns: four for each flow of a kernel with k nodes, of which there are 2 c + 2 - k.
const MOST_COLUMNS: usize = 8 * MAX_CYCLES;

/// Rows of whole groups of eight entries, so that they are computed side by side.
const GROUP: usize = 8;

/// The rows of edges, reduced by those of the edges that are subdivided already.
#[derive(Clone, Default)]
struct Level {
    /// How many columns are left.
    columns: usize,
    /// The first edge that has rows, by its place in the order of [`Conditions::new`].
    first: usize,
    /// Four rows for each edge, each with zeros up to a whole group.
    entries: Vec<u32>,
}

/// The rows of a kernel, and of one subdivision after the other.
pub(super) struct Conditions {
    /// The first is that of the edges which every subdivision has, each other one of one edge more; none
    /// if their rows are dependent already.
    levels: Vec<Level>,
    /// That of the last edge but one.
    reducer: Option<Reducer>,
    /// The rows of the last edge.
    last: Vec<u32>,
}

impl Level {
    fn stride(&self) -> usize {
        self.columns.max(1).next_multiple_of(GROUP)
    }

    fn rows(&self, edge: usize) -> &[u32] {
        let size = 4 * self.stride();
        let at = (edge - self.first) * size;
        &self.entries[at..at + size]
    }

    /// Takes an edge: the rows of those after it, reduced by its own, without four columns. False if its
    /// own are dependent. O(4^2 columns) for each edge after it.
    fn take(&self, edge: usize, next: &mut Self) -> bool {
        let Some(reducer) = self.reducer(edge) else {
            return false;
        };
        next.first = edge + 1;
        next.columns = self.columns - 4;
        let (size, width) = (4 * self.stride(), 4 * next.stride());
        next.entries.clear();
        let rows = &self.entries[(next.first - self.first) * size..];
        next.entries.resize(rows.len() / size * width, 0);
        for (rows, out) in rows
            .chunks_exact(size)
            .zip(next.entries.chunks_exact_mut(width))
        {
            reducer.reduce(rows, out);
        }
        true
    }

    /// What reduces rows by those of an edge; `None` if these are dependent.
    fn reducer(&self, edge: usize) -> Option<Reducer> {
        let stride = self.stride();
        let mut own = [[0; MOST_COLUMNS]; 4];
        for (row, entries) in own.iter_mut().zip(self.rows(edge).chunks_exact(stride)) {
            row[..stride].copy_from_slice(entries);
        }
        let mut pivots = [0; 4];
        for k in 0..4 {
            let row = own[k];
            let at = row[..stride].iter().position(|&entry| entry != 0)?;
            pivots[k] = at;
            for (_, other) in own.iter_mut().enumerate().filter(|&(j, _)| j != k) {
                cancel(&mut other[..stride], &row[..stride], at);
            }
        }
        let mut places = pivots;
        places.sort_unstable_by(|a, b| b.cmp(a));
        // Without inverses: all rows are multiplied by the product of the pivots, and each of its own by
        // that of the other pivots.
        let scales: [u32; 4] = std::array::from_fn(|k| own[k][pivots[k]]);
        let mut reducer = Reducer {
            columns: self.columns,
            pivots,
            places,
            whole: u64::from(scales.into_iter().fold(1, multiply)),
            rows: own,
        };
        for (k, row) in reducer.rows.iter_mut().enumerate() {
            let others = (0..4).filter(|&j| j != k);
            let scale = others.fold(1, |product, j| multiply(product, scales[j]));
            for entry in &mut row[..stride] {
                *entry = multiply(*entry, scale);
            }
            drop_columns(row, self.columns, places);
        }
        Some(reducer)
    }
}

/// The rows of an edge, by which those of others are reduced.
struct Reducer {
    /// How many columns they have.
    columns: usize,
    /// Where each row has its pivot.
    pivots: [usize; 4],
    /// The same from the right.
    places: [usize; 4],
    /// The product of the pivots.
    whole: u64,
    /// The rows without the columns of pivots, each times the other pivots.
    rows: [[u32; MOST_COLUMNS]; 4],
}

impl Reducer {
    /// The rows of another edge, four of a length, reduced: four that have four columns less.
    fn reduce(&self, rows: &[u32], out: &mut [u32]) {
        let (stride, width) = (rows.len() / 4, out.len() / 4);
        let [a, b, c, d] = self
            .rows
            .each_ref()
            .map(|row| row[..width].as_chunks::<GROUP>().0);
        let mut before = [0u32; MOST_COLUMNS];
        for (row, out) in rows.chunks_exact(stride).zip(out.chunks_exact_mut(width)) {
            before[..stride].copy_from_slice(row);
            let [w, x, y, z] = self.pivots.map(|at| P - u64::from(row[at]));
            drop_columns(&mut before, self.columns, self.places);
            let groups = before.as_chunks::<GROUP>().0.iter();
            let groups = groups.zip(out.as_chunks_mut::<GROUP>().0).enumerate();
            for (g, (before, out)) in groups {
                for k in 0..GROUP {
                    // Three products are below 2^64; folded, with one more each, the sums stay below 2^63.
                    let sum = w * u64::from(a[g][k]) + x * u64::from(b[g][k]);
                    let sum = fold(sum + y * u64::from(c[g][k])) + z * u64::from(d[g][k]);
                    out[k] = reduce(u64::from(before[k]) * self.whole + fold(sum));
                }
            }
        }
    }
}

/// Drops four columns, given from the right: the last ones take their places.
fn drop_columns(row: &mut [u32], columns: usize, places: [usize; 4]) {
    for (last, place) in (columns - 4..columns).rev().zip(places) {
        row[place] = row[last];
        row[last] = 0;
    }
}

/// Whether four rows are independent.
fn independent(own: &mut [u32]) -> bool {
    let stride = own.len() / 4;
    for k in 0..4 {
        let (done, below) = own.split_at_mut((k + 1) * stride);
        let row = &done[k * stride..];
        let Some(at) = row.iter().position(|&entry| entry != 0) else {
            return false;
        };
        for other in below.chunks_exact_mut(stride) {
            cancel(other, row, at);
        }
    }
    true
}

impl Conditions {
    /// The rows of a kernel at random centres, for its edges in the given order (places in
    /// [`Multigraph::edge_list`]), those that every subdivision has taken first.
    /// O((n + m) m^2) for n nodes and m edges.
    pub(super) fn new(
        kernel: &Multigraph,
        taken: &[usize],
        order: &[usize],
        random: &mut impl Rng,
    ) -> Self {
        let ends = kernel.edge_list();
        let pencils = draw(kernel.nodes(), &ends, random);
        let cotree = outside_of_a_tree(kernel.nodes(), &ends);
        let flows = conserved(kernel.nodes(), &ends, &pencils);
        let mut conditions = Self {
            levels: Vec::new(),
            reducer: None,
            last: Vec::new(),
        };
        // N of the kernel has full rank, 3 n - 4.
        if flows.len() + 3 * kernel.nodes() != 2 * ends.len() + 4 {
            return conditions;
        }
        let columns = 4 * flows.len();
        let stride = columns.max(1).next_multiple_of(GROUP);
        let all = taken.iter().chain(order);
        let mut entries = vec![0; (all.clone().count() * 4) * stride];
        for (rows, &edge) in entries.chunks_exact_mut(4 * stride).zip(all) {
            for (k, row) in rows.chunks_exact_mut(stride).enumerate() {
                for (i, flow) in flows.iter().enumerate() {
                    row[4 * i + k] = flow[2 * edge + 1];
                }
            }
        }
        let mut cycles = vec![0; cotree.len() * stride];
        for (row, &edge) in cycles.chunks_exact_mut(stride).zip(&cotree) {
            let [first, second] = &pencils[edge];
            for (flow, plane) in flows.iter().zip(row.chunks_exact_mut(4)) {
                let (x, y) = (u64::from(flow[2 * edge]), u64::from(flow[2 * edge + 1]));
                for ((entry, &a), &b) in plane.iter_mut().zip(first).zip(second) {
                    *entry = reduce(x * u64::from(a) + y * u64::from(b));
                }
            }
        }
        let Some(kept) = reduced(&mut cycles, &mut entries, columns, stride) else {
            return conditions;
        };
        let mut level = Level {
            columns: kept.len(),
            ..Level::default()
        };
        let width = level.stride();
        level.entries = vec![0; entries.len() / stride * width];
        for (row, out) in (entries.chunks_exact(stride)).zip(level.entries.chunks_exact_mut(width))
        {
            for (entry, &at) in out.iter_mut().zip(&kept) {
                *entry = row[at];
            }
        }
        for edge in 0..taken.len() {
            let mut next = Level::default();
            if !level.take(edge, &mut next) {
                return conditions;
            }
            level = next;
        }
        level.first = 0;
        conditions.levels.push(level);
        conditions
    }

    /// Whether the rows of the cycles and of the edges that every subdivision has are independent.
    pub(super) fn hold(&self) -> bool {
        !self.levels.is_empty()
    }

    /// Takes an edge after `depth` others: whether all their rows are independent. Edges are taken in
    /// their order.
    pub(super) fn take(&mut self, depth: usize, edge: usize) -> bool {
        if self.levels.len() < depth + 2 {
            self.levels.push(Level::default());
        }
        let [from, to] = &mut self.levels[depth..depth + 2] else {
            unreachable!("two levels");
        };
        from.take(edge, to)
    }

    /// Takes an edge after `depth` others, if only one more is to come: whether all their rows are independent.
    pub(super) fn take_last_but_one(&mut self, depth: usize, edge: usize) -> bool {
        let level = &self.levels[depth];
        self.reducer = level.reducer(edge);
        self.last.resize(4 * level.stride(), 0);
        self.reducer.is_some()
    }

    /// Whether the rows of an edge are independent of those of the `depth` edges that were taken: then
    /// the subdivision of all these is finite solvable (Proposition 3.8). Otherwise nothing is proved.
    pub(super) fn independent(&mut self, depth: usize, edge: usize) -> bool {
        match (&self.reducer, depth.checked_sub(1)) {
            (Some(reducer), Some(before)) => {
                let level = &self.levels[before];
                let width = 4 * (level.columns - 4).max(1).next_multiple_of(GROUP);
                reducer.reduce(level.rows(edge), &mut self.last[..width]);
                independent(&mut self.last[..width])
            }
            _ => {
                self.last.clear();
                self.last.extend_from_slice(self.levels[depth].rows(edge));
                independent(&mut self.last)
            }
        }
    }
}

/// Reduces `rows` by the rows of `by`; the columns that are left, or `None` if these are dependent.
fn reduced(by: &mut [u32], rows: &mut [u32], columns: usize, stride: usize) -> Option<Vec<usize>> {
    let mut kept: Vec<usize> = (0..columns).collect();
    for k in 0..by.len() / stride {
        let (done, below) = by.split_at_mut((k + 1) * stride);
        let row = &done[k * stride..];
        let at = row.iter().position(|&entry| entry != 0)?;
        let others = below.chunks_exact_mut(stride);
        for other in others.chain(rows.chunks_exact_mut(stride)) {
            cancel(other, row, at);
        }
        kept.retain(|&column| column != at);
    }
    Some(kept)
}

/// Makes entry `at` of `other` vanish: `other` times that of `row`, minus `row` times that of
/// `other`. No inverse is taken.
fn cancel(other: &mut [u32], row: &[u32], at: usize) {
    if other[at] == 0 {
        return;
    }
    let (scale, minus) = (u64::from(row[at]), P - u64::from(other[at]));
    for (entry, &above) in other.iter_mut().zip(row) {
        *entry = reduce(u64::from(*entry) * scale + u64::from(above) * minus);
    }
}

/// A number below 2^64, smaller by a multiple of 2^31 - 1: below 2^34.
fn fold(x: u64) -> u64 {
    (x & P) + (x >> 31)
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
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha12Rng;
    use viewcert::Graph;
    use viewcert::decide::{Options, Value, decide};

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
        for x in [0, P, P + 1, 3 * P * P, u64::MAX] {
            assert_eq!(fold(x) % P, x % P, "{x}");
            assert!(fold(x) < 1 << 34, "{x}");
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

    /// Rows are independent iff the subdivided graph is finite solvable, for all sets of edges
    /// that leave a simple graph, taken one after the other.
    #[test]
    fn independent_rows_are_finite_solvable_graphs() {
        let mut seen = [0, 0];
        for cycles in 2..=5 {
            for kernel in
                kernels(cycles, usize::MAX)
                    .iter()
                    .step_by(if cycles == 5 { 9 } else { 1 })
            {
                let kernel = kernel.multigraph();
                let ends = kernel.edge_list();
                let (free, forced): (Vec<usize>, Vec<usize>) =
                    (0..ends.len()).partition(|&edge| ends.get(edge + 1) != Some(&ends[edge]));
                let mut random = ChaCha12Rng::seed_from_u64(7);
                let mut conditions = Conditions::new(&kernel, &forced, &free, &mut random);
                for set in 0..1u32 << free.len().min(9) {
                    let chosen: Vec<usize> =
                        (0..free.len()).filter(|k| set >> k & 1 == 1).collect();
                    let found = conditions.hold()
                        && match chosen.split_last() {
                            None => true,
                            Some((&last, before)) => {
                                let many = before.len().saturating_sub(1);
                                let mut taken = before[..many].iter().enumerate();
                                taken.all(|(depth, &edge)| conditions.take(depth, edge))
                                    && before[many..]
                                        .iter()
                                        .all(|&edge| conditions.take_last_but_one(many, edge))
                                    && conditions.independent(before.len(), last)
                            }
                        };
                    let mut next = kernel.nodes() as u32;
                    let mut pairs = Vec::new();
                    for (edge, &(u, v)) in ends.iter().enumerate() {
                        let (u, v) = (u as u32, v as u32);
                        if forced.contains(&edge) || chosen.iter().any(|&k| free[k] == edge) {
                            pairs.extend([(u, next), (v, next)]);
                            next += 1;
                        } else {
                            pairs.push((u, v));
                        }
                    }
                    let graph = Graph::new(next, pairs).unwrap();
                    let value = decide(&graph, &Options::default()).unwrap().value;
                    assert_eq!(found, value != Value::NotFiniteSolvable, "{graph:?}");
                    seen[usize::from(found)] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 300), "{seen:?}");
    }
}
