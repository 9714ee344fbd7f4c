//! Plane flows: the rank of the paper's Jacobian from matrices a quarter of its size
//! (docs/theory.md, section 3).
//!
//! At cameras [ I | -c_v ] with c_i != c_j on every edge,
//!
//! ```text
//! rank J_P = 4 rank N + rank Lambda - m
//! ```
//!
//! where N (2m x 3n) is the parallel rigidity matrix of the centres and Lambda the map
//! from edge scalars to the plane flows, the left kernel of N.

use crate::graph::Graph;
use crate::graph::UnionFind;
use crate::linalg::dense_lu::{Echelon, eliminate_mod, elimination_products};
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::linalg::sparse_lu::Factorisation;
use crate::linalg::textbook::Pivots;
use crate::linalg::{Field, Ring};
use crate::watch::{Reservation, Step, Stopped, Task, matrix_bytes};

/// The two directions orthogonal to d = c_i - c_j on an edge: with q the first index
/// at which d is not zero and r < s the others, d_q e_r - d_r e_q and d_q e_s - d_s e_q.
/// `None` for coincident centres.
pub fn directions<R: Ring>(
    ring: &R,
    ci: &[R::Elem; 3],
    cj: &[R::Elem; 3],
) -> Option<[[R::Elem; 3]; 2]> {
    let d: [R::Elem; 3] = std::array::from_fn(|k| ring.sub(&ci[k], &cj[k]));
    let q = d.iter().position(|x| !ring.is_zero(x))?;
    let direction = |r: usize| {
        std::array::from_fn(|k| {
            if k == r {
                d[q].clone()
            } else if k == q {
                ring.neg(&d[r])
            } else {
                ring.zero()
            }
        })
    };
    let (r, s) = [(1, 2), (0, 2), (0, 1)][q];
    Some([direction(r), direction(s)])
}

/// N as sparse rows `(column, value)`, columns increasing: for edge e = (i, j) and its
/// directions a, rows 2e and 2e + 1 hold a in the columns 3i, 3i+1, 3i+2 and -a in
/// 3j, 3j+1, 3j+2. Zero entries are left out.
///
/// # Panics
/// If the centres of an edge coincide.
pub fn rigidity_rows<R: Ring>(
    ring: &R,
    graph: &Graph,
    centres: &[[R::Elem; 3]],
) -> Vec<Vec<(usize, R::Elem)>> {
    let mut rows = Vec::with_capacity(2 * graph.edges().len());
    for &(i, j) in graph.edges() {
        let (i, j) = (i as usize, j as usize);
        let both = directions(ring, &centres[i], &centres[j]).expect("centres are distinct");
        for a in both {
            let at_i = (0..3).map(|k| (3 * i + k, a[k].clone()));
            let at_j = (0..3).map(|k| (3 * j + k, ring.neg(&a[k])));
            rows.push(at_i.chain(at_j).filter(|(_, x)| !ring.is_zero(x)).collect());
        }
    }
    rows
}

/// The rows of edges (i, j) whose length is known: with q the first index at which their centres
/// differ, 1 in the column 3i + q and -1 in 3j + q (Theorem 13.18).
fn scale_rows<'r>(
    field: &'r PrimeField,
    scales: &'r [(u32, u32)],
    centres: &'r [[u64; 3]],
) -> impl Iterator<Item = Vec<(usize, u64)>> + 'r {
    scales.iter().map(|&(i, j)| {
        let (i, j) = (i as usize, j as usize);
        let q = (0..3)
            .find(|&q| centres[i][q] != centres[j][q])
            .expect("centres are distinct");
        let minus = field.neg(&field.one());
        let mut row = vec![(3 * i + q, field.one()), (3 * j + q, minus)];
        row.sort_unstable();
        row
    })
}

/// The right-hand sides of the four column systems N y^k = rho_k lambda: entry
/// `(row, k)` is -a^T P_j e_k for the direction a of the row, that is -a_k for k < 3
/// and a . c_j for k = 3.
fn right_side(field: &PrimeField, a: &[u64; 3], cj: &[u64; 3]) -> [u64; 4] {
    let [x, y, z] = a.map(|value| field.neg(&value));
    let dot = a
        .iter()
        .zip(cj)
        .fold(0, |sum, (s, t)| field.add(&sum, &field.mul(s, t)));
    [x, y, z, dot]
}

/// The edges outside a spanning forest, ascending, which hold the rank of Lambda (Lemma 3.4): an
/// edge is in the forest if it joins parts that the edges before it do not.
pub fn cotree(graph: &Graph) -> Vec<usize> {
    let mut forest = UnionFind::new(graph.nodes());
    (0..)
        .zip(graph.edges())
        .filter(|&(_, &(i, j))| !forest.union(i as usize, j as usize))
        .map(|(e, _)| e)
        .collect()
}

/// Flows that are computed beyond those needed at full rank.
const SPARE_FLOWS: usize = 2;

/// The flows that Lambda is computed from at first, of so many independent ones and for so many
/// columns.
fn first_flows(dimension: usize, columns: usize) -> usize {
    dimension.min(columns.div_ceil(4) + SPARE_FLOWS)
}

/// The bytes for Lambda with the rows of so many flows, and for its elimination.
fn lambda_bytes(flows: usize, columns: usize) -> u64 {
    matrix_bytes(4 * flows, columns).saturating_mul(2)
}

/// Asks for the memory that Lambda of a graph takes at least, whatever the centres: before N is
/// eliminated, which may take long as well. Returns the task with the elimination of Lambda
/// expected after it.
///
/// # Errors
/// If there is not as much left.
pub(crate) fn expect_lambda<'w>(graph: &Graph, task: &Task<'w>) -> Result<Task<'w>, Stopped> {
    let (edges, columns) = (graph.edges().len(), cotree(graph).len());
    // N has a kernel of dimension 4 at least: translations and the scale.
    let rank = (3 * graph.nodes()).saturating_sub(4);
    let flows = first_flows((2 * edges).saturating_sub(rank), columns);
    let (lambda, mut memory) = (task.at(Step::Lambda), empty(task)?);
    reserve_lambda(&mut memory, flows, columns, &lambda)?;
    let bytes = matrix_bytes(flows, 2 * edges);
    lambda.reserve(bytes, format_args!("{flows} flows beside Lambda"))?;
    Ok(task.followed_by(Some(elimination_products(4 * flows, columns))))
}

/// Nothing, on the account of the task's watch.
fn empty(task: &Task) -> Result<Reservation, Stopped> {
    task.reserve(0, format_args!("nothing"))
}

fn reserve_lambda(
    memory: &mut Reservation,
    flows: usize,
    columns: usize,
    task: &Task,
) -> Result<(), Stopped> {
    let rows = 4 * flows;
    let what = format_args!("Lambda ({rows} x {columns}) with its elimination");
    memory.resize(lambda_bytes(flows, columns), task, what)
}

/// N and Lambda of a graph at given centres modulo p, eliminated.
#[derive(Clone, Debug)]
pub struct PlaneFlows<'a> {
    field: &'a PrimeField,
    graph: &'a Graph,
    centres: &'a [[u64; 3]],
    /// Edges whose length is known.
    scales: &'a [(u32, u32)],
    rigidity: Factorisation,
}

/// A lower bound on rank J_P that elimination found, with its pivots.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PlaneFlowRank {
    /// Pivots of N.
    pub rigidity: Pivots,
    /// How many flows the rows of Lambda come from.
    pub flows: usize,
    /// Pivots of Lambda; row 4 f + k belongs to the f-th flow, columns are edges.
    pub lambda: Pivots,
}

impl PlaneFlowRank {
    /// 4 rank N + rank Lambda - m.
    pub fn rank(&self, edges: usize) -> usize {
        4 * self.rigidity.rank() + self.lambda.rank() - edges
    }
}

/// A motion of the cameras that keeps the fundamental matrices up to scale.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Motion {
    /// `columns[k][3 v + r]` is entry (r, k) of dP_v.
    pub columns: [Vec<u64>; 4],
    /// For every edge the X_e with dP_i = P_i X_e and dP_j = P_j X_e + lambda_e P_j,
    /// row by row, less the multiple of I that makes its last entry zero.
    pub transforms: Vec<[u64; 16]>,
}

impl Motion {
    /// The entries in the order of J_P's columns: `12 v + 3 c + r` for entry (r, c) of
    /// dP_v.
    pub(crate) fn by_node(&self) -> Vec<u64> {
        let nodes = self.columns[0].len() / 3;
        (0..nodes)
            .flat_map(|v| {
                let column = move |y: &Vec<u64>| [y[3 * v], y[3 * v + 1], y[3 * v + 2]];
                self.columns.iter().flat_map(column)
            })
            .collect()
    }
}

impl<'a> PlaneFlows<'a> {
    /// Eliminates N at the given centres: sparse at first, then what fills in as a dense
    /// matrix, O(n^3) at worst.
    ///
    /// # Errors
    /// If the task was stopped.
    ///
    /// # Panics
    /// If there is not one centre a node, or the centres of an edge coincide.
    pub fn new(
        field: &'a PrimeField,
        graph: &'a Graph,
        centres: &'a [[u64; 3]],
        task: &Task,
    ) -> Result<Self, Stopped> {
        Self::with_scales(field, graph, &[], centres, task)
    }

    /// The same with a row more for each edge of `scales`, whose length is known: N is then the
    /// matrix of Theorem 13.18, of which only the rank, the pivots and the motions are asked.
    ///
    /// # Errors
    /// If the task was stopped.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn with_scales(
        field: &'a PrimeField,
        graph: &'a Graph,
        scales: &'a [(u32, u32)],
        centres: &'a [[u64; 3]],
        task: &Task,
    ) -> Result<Self, Stopped> {
        assert_eq!(centres.len(), graph.nodes(), "one centre a node");
        let mut rows = rigidity_rows(field, graph, centres);
        rows.extend(scale_rows(field, scales, centres));
        let columns = 3 * graph.nodes();
        Ok(Self {
            field,
            graph,
            centres,
            scales,
            rigidity: Factorisation::new(field, rows, columns, task)?,
        })
    }

    /// The rank of N.
    pub fn rigidity_rank(&self) -> usize {
        self.rigidity.rank()
    }

    /// How many independent plane flows there are.
    pub(crate) fn dimension(&self) -> usize {
        self.rigidity.free_rows().len()
    }

    /// The pivots of N.
    pub(crate) fn rigidity_pivots(&self) -> Pivots {
        self.rigidity.pivots()
    }

    fn edge_directions(&self, edge: usize) -> [[u64; 3]; 2] {
        let (i, j) = self.graph.edges()[edge];
        directions(
            self.field,
            &self.centres[i as usize],
            &self.centres[j as usize],
        )
        .expect("centres are distinct")
    }

    /// A basis of the plane flows: for each the omega_e of every edge (the normal of its
    /// plane), omega flowing from j to i on the edge (i, j).
    ///
    /// # Errors
    /// If the task was stopped.
    pub fn flows(&self, task: &Task) -> Result<Vec<Vec<[u64; 3]>>, Stopped> {
        let dimension = self.dimension();
        let edges = self.graph.edges().len();
        let _memory = task.reserve(
            matrix_bytes(dimension, 3 * edges),
            format_args!("{dimension} flows on {edges} pairs"),
        )?;
        let one = self.field.one();
        let unit = Matrix::from_fn(dimension, dimension, |f, g| if f == g { one } else { 0 });
        let kernel = self.rigidity.left_combinations(&unit, task)?;
        let both: Vec<_> = (0..self.graph.edges().len())
            .map(|e| self.edge_directions(e))
            .collect();
        Ok((0..kernel.rows())
            .map(|f| {
                let weights = kernel.row(f).chunks_exact(2);
                let combine = |(w, [a, b]): (&[u64], &[[u64; 3]; 2])| {
                    std::array::from_fn(|k| self.field.dot(0, w, &[a[k], b[k]]))
                };
                weights.zip(&both).map(combine).collect()
            })
            .collect())
    }

    /// Flows with the given entries at the rows of N that are not pivots: for each of them two
    /// weights an edge, those of its [`directions`].
    ///
    /// # Errors
    /// If the task was stopped.
    pub(crate) fn combined(
        &self,
        weights: &Matrix<u64>,
        task: &Task,
    ) -> Result<Matrix<u64>, Stopped> {
        self.rigidity.left_combinations(weights, task)
    }

    /// Eliminates Lambda. The columns of a spanning forest are left out: they depend
    /// on the others by the potentials.
    ///
    /// Flows are random: their entries at the rows of N that are not pivots are the values
    /// of `weights`, one flow after another (docs/certificate.md, section 7). Each gives four
    /// rows, so that about a quarter as many flows as columns are enough at full rank; more
    /// are taken until they no longer raise the rank.
    ///
    /// # Errors
    /// If the task was stopped.
    pub fn lambda(&self, mut weights: impl FnMut() -> u64, task: &Task) -> Result<Lambda, Stopped> {
        let cotree = cotree(self.graph);
        let dimension = self.dimension();
        let mut flows = 0;
        let mut rows = Vec::new();
        let mut memory = empty(task)?;
        let elimination = task.at(Step::Elimination).followed_by(Some(0));
        let task = task.at(Step::Lambda);
        let mut rank = None;
        loop {
            let more = match rank {
                None => first_flows(dimension, cotree.len()),
                Some(_) => (dimension - flows).min(flows / 4 + SPARE_FLOWS),
            };
            reserve_lambda(&mut memory, flows + more, cotree.len(), &task)?;
            let products = elimination_products(4 * (flows + more), cotree.len());
            let task = task.followed_by(Some(products));
            let weights = Matrix::from_fn(more, dimension, |_, _| weights());
            let new = self.lambda_rows(&weights, &cotree, &task)?;
            if rows.is_empty() {
                rows = new;
            } else {
                rows.extend(new);
            }
            flows += more;
            let matrix = Matrix::new(4 * flows, cotree.len(), rows.clone());
            let echelon = eliminate_mod(self.field, matrix, &elimination)?;
            let found = echelon.rank();
            if found == cotree.len() || flows == dimension || rank == Some(found) {
                return Ok(Lambda {
                    rows: Matrix::new(4 * flows, cotree.len(), rows),
                    cotree,
                    echelon,
                    _memory: memory,
                });
            }
            rank = Some(found);
        }
    }

    /// Eliminates Lambda with the rows of a basis of all flows: certain at any prime, at up
    /// to four times the cost of [`lambda`](Self::lambda).
    ///
    /// # Errors
    /// If the task was stopped.
    pub fn lambda_of_all_flows(&self, task: &Task) -> Result<Lambda, Stopped> {
        let cotree = cotree(self.graph);
        let dimension = self.dimension();
        let one = self.field.one();
        let unit = Matrix::from_fn(dimension, dimension, |f, g| if f == g { one } else { 0 });
        let rows = self.lambda_rows(&unit, &cotree, task)?;
        let rows = Matrix::new(4 * dimension, cotree.len(), rows);
        Ok(Lambda {
            echelon: eliminate_mod(self.field, rows.clone(), task)?,
            rows,
            cotree,
            _memory: Reservation::default(),
        })
    }

    /// At most so many random stresses, combined from the flows of `lambda`, by lists x: column k of
    /// W_e on the edge e is x[8 e + 2 k] times the first direction and x[8 e + 2 k + 1] times the
    /// second one (section 19). `weights` gives those of the flows of `lambda` once more.
    ///
    /// # Errors
    /// If the task was stopped.
    pub(crate) fn stresses(
        &self,
        lambda: &Lambda,
        most: usize,
        mut weights: impl FnMut() -> u64,
        mut random: impl FnMut() -> u64,
        task: &Task,
    ) -> Result<Vec<Vec<u64>>, Stopped> {
        let (pivots, free) = (lambda.echelon.pivots().rows, lambda.echelon.free_rows());
        let count = most.min(free.len());
        let at_free = Matrix::from_fn(count, free.len(), |_, _| random());
        let work = task.begin(lambda.echelon.combination_products(count));
        let at_pivots = lambda.echelon.combined_left_weights(&at_free, &work)?;
        let (flows, width) = (lambda.rows.rows() / 4, self.dimension());
        let weights = Matrix::from_fn(flows, width, |_, _| weights());
        let mut combined = Matrix::new(4 * count, width, vec![0; 4 * count * width]);
        for s in 0..count {
            let at_pivots = pivots.iter().zip(at_pivots.row(s));
            for (&row, factor) in at_pivots.chain(free.iter().zip(at_free.row(s))) {
                let sums = combined.row_mut(4 * s + row % 4).iter_mut();
                for (sum, weight) in sums.zip(weights.row(row / 4)) {
                    *sum = self.field.add(sum, &self.field.mul(factor, weight));
                }
            }
        }
        let columns = self.combined(&combined, task)?;
        let of_stress = |s: usize| {
            let edges = 0..self.graph.edges().len();
            let entries = edges.flat_map(|e| (0..4).map(move |k| (4 * s + k, 2 * e)));
            let entries = entries.flat_map(|(row, at)| [(row, at), (row, at + 1)]);
            entries.map(|at| columns[at]).collect()
        };
        Ok((0..count).map(of_stress).collect())
    }

    /// The matrix W_e of a stress, row by row.
    pub(crate) fn stress_on(&self, stress: &[u64], e: usize) -> [[u64; 4]; 3] {
        let [a, b] = self.edge_directions(e);
        std::array::from_fn(|r| {
            std::array::from_fn(|k| {
                let at = 8 * e + 2 * k;
                self.field.dot(0, &stress[at..at + 2], &[a[r], b[r]])
            })
        })
    }

    /// The rows of Lambda that the flows with the given entries at the free rows of N give,
    /// one after another: four rows a flow, restricted to the given edges.
    fn lambda_rows(
        &self,
        weights: &Matrix<u64>,
        edges: &[usize],
        task: &Task,
    ) -> Result<Vec<u64>, Stopped> {
        let kernel = self.rigidity.left_combinations(weights, task)?;
        let width = edges.len();
        let mut rows = vec![0; 4 * kernel.rows() * width];
        for (at, &e) in edges.iter().enumerate() {
            task.check()?;
            let cj = &self.centres[self.graph.edges()[e].1 as usize];
            let [a, b] = self
                .edge_directions(e)
                .map(|direction| right_side(self.field, &direction, cj));
            for f in 0..kernel.rows() {
                let (s, t) = (kernel[(f, 2 * e)], kernel[(f, 2 * e + 1)]);
                if (s, t) == (0, 0) {
                    continue;
                }
                for k in 0..4 {
                    let value = self.field.dot(0, &[s, t], &[a[k], b[k]]);
                    rows[(4 * f + k) * width + at] = self.field.neg(&value);
                }
            }
        }
        Ok(rows)
    }

    /// The lower bound on rank J_P, with its pivots (Theorem 3.2 and Corollary 3.3).
    pub fn rank(&self, lambda: &Lambda) -> PlaneFlowRank {
        let mut pivots = lambda.echelon.pivots();
        for col in &mut pivots.cols {
            *col = lambda.cotree[*col];
        }
        PlaneFlowRank {
            rigidity: self.rigidity.pivots(),
            flows: pivots.rows.iter().map(|row| row / 4 + 1).max().unwrap_or(0),
            lambda: pivots,
        }
    }

    /// A random element of ker J_P (Lemma 3.1, Proposition 6.6), uniform modulo the scales of the
    /// cameras; `None` if the flows of `lambda` do not span all flows, which is unlikely but modulo
    /// a small prime. `random` gives uniform elements of the field.
    pub(crate) fn motion(
        &self,
        lambda: &Lambda,
        mut random: impl FnMut() -> u64,
    ) -> Option<Motion> {
        let scales = lambda.random_kernel_vector(self.field, self.graph.edges().len(), &mut random);
        let mut column = |k: usize| {
            let mut sides = Vec::with_capacity(2 * self.graph.edges().len());
            for (e, &(_, j)) in self.graph.edges().iter().enumerate() {
                for a in self.edge_directions(e) {
                    let side = right_side(self.field, &a, &self.centres[j as usize])[k];
                    sides.push(self.field.mul(&side, &scales[e]));
                }
            }
            self.solve(sides, &mut random)
        };
        let columns = [column(0)?, column(1)?, column(2)?, column(3)?];
        let transforms = (0..self.graph.edges().len())
            .map(|e| self.transform(&columns, e, scales[e]))
            .collect();
        Some(Motion {
            columns,
            transforms,
        })
    }

    /// A uniformly random solution y of N y = sides, if there is one.
    fn solve(&self, mut sides: Vec<u64>, random: &mut impl FnMut() -> u64) -> Option<Vec<u64>> {
        let field = self.field;
        let mut y = vec![0; 3 * self.graph.nodes()];
        for &col in self.rigidity.free_cols() {
            y[col] = random();
        }
        let mut rows = rigidity_rows(field, self.graph, self.centres);
        rows.extend(scale_rows(field, self.scales, self.centres));
        for (row, side) in rows.iter().zip(&mut sides) {
            for &(col, value) in row {
                *side = field.sub(side, &field.mul(&value, &y[col]));
            }
        }
        let pivot_part = self.rigidity.solve(&sides)?;
        for (value, part) in y.iter_mut().zip(&pivot_part) {
            *value = field.add(value, part);
        }
        Some(y)
    }

    /// Equation (6.1): X_e with dP_i = P_i X_e and dP_j = P_j X_e + lambda_e P_j: column k is
    /// (u_k, w_k) with (c_j - c_i) w_k = y_i^k - y_j^k + lambda_e P_j e_k and
    /// u_k = y_i^k + w_k c_i.
    fn transform(&self, columns: &[Vec<u64>; 4], edge: usize, scale: u64) -> [u64; 16] {
        let f = self.field;
        let (i, j) = self.graph.edges()[edge];
        let (i, j) = (i as usize, j as usize);
        let (ci, cj) = (&self.centres[i], &self.centres[j]);
        let q = (0..3)
            .find(|&q| ci[q] != cj[q])
            .expect("centres are distinct");
        let inverse = f.inv(&f.sub(&cj[q], &ci[q])).expect("they differ at q");
        let mut x = [0; 16];
        for (k, y) in columns.iter().enumerate() {
            let camera_entry = match k {
                3 => f.neg(&cj[q]),
                _ if k == q => f.one(),
                _ => 0,
            };
            let moved = f.add(
                &f.sub(&y[3 * i + q], &y[3 * j + q]),
                &f.mul(&scale, &camera_entry),
            );
            let w = f.mul(&moved, &inverse);
            for r in 0..3 {
                x[4 * r + k] = f.add(&y[3 * i + r], &f.mul(&w, &ci[r]));
            }
            x[12 + k] = w;
        }
        let last = x[15];
        for r in 0..4 {
            x[5 * r] = f.sub(&x[5 * r], &last);
        }
        x
    }

    /// A random element of ker N (the calibrated model, Theorem 6.8), with the scale and
    /// translation (s_e, t_e) of every edge: y_i = s_e c_i + t_e, y_j = s_e c_j + t_e.
    pub(crate) fn calibrated_motion(
        &self,
        mut random: impl FnMut() -> u64,
    ) -> (Vec<u64>, Vec<[u64; 4]>) {
        let f = self.field;
        let y = self
            .solve(
                vec![0; 2 * self.graph.edges().len() + self.scales.len()],
                &mut random,
            )
            .expect("zero is a solution");
        let transforms = self
            .graph
            .edges()
            .iter()
            .map(|&(i, j)| {
                let (i, j) = (i as usize, j as usize);
                let (ci, cj) = (&self.centres[i], &self.centres[j]);
                let q = (0..3)
                    .find(|&q| ci[q] != cj[q])
                    .expect("centres are distinct");
                let inverse = f.inv(&f.sub(&ci[q], &cj[q])).expect("they differ at q");
                let scale = f.mul(&f.sub(&y[3 * i + q], &y[3 * j + q]), &inverse);
                let t = |r: usize| f.sub(&y[3 * i + r], &f.mul(&scale, &ci[r]));
                [scale, t(0), t(1), t(2)]
            })
            .collect();
        (y, transforms)
    }
}

/// Lambda restricted to the edges outside a spanning forest, eliminated.
#[derive(Clone, Debug)]
pub struct Lambda {
    /// The edge of every column.
    cotree: Vec<usize>,
    rows: Matrix<u64>,
    echelon: Echelon,
    _memory: Reservation,
}

impl Lambda {
    /// The rank of Lambda.
    pub fn rank(&self) -> usize {
        self.echelon.rank()
    }

    /// Rows and columns of the matrix that was eliminated.
    pub fn size(&self) -> (usize, usize) {
        (self.rows.rows(), self.rows.cols())
    }

    /// Its entries that are not zero.
    pub fn nonzeros(&self) -> usize {
        self.rows.data().iter().filter(|&&x| x != 0).count()
    }

    /// A uniformly random lambda of the kernel that vanishes on the spanning forest, one
    /// value an edge.
    fn random_kernel_vector(
        &self,
        field: &PrimeField,
        edges: usize,
        random: &mut impl FnMut() -> u64,
    ) -> Vec<u64> {
        let mut part = vec![0; self.cotree.len()];
        for col in self.echelon.pivots().free_cols(part.len()) {
            part[col] = random();
        }
        let sides: Vec<u64> = (0..self.rows.rows())
            .map(|row| field.neg(&field.dot(0, self.rows.row(row), &part)))
            .collect();
        let pivot_part = self
            .echelon
            .solve(&sides)
            .expect("free columns depend on pivots");
        let mut scales = vec![0; edges];
        for (col, &e) in self.cotree.iter().enumerate() {
            scales[e] = field.add(&part[col], &pivot_part[col]);
        }
        scales
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::camera::normal_form;
    use crate::geometry::jacobian::{dense, jacobian};
    use crate::linalg::textbook;
    use crate::watch::unwatched;
    use proptest::prelude::*;
    use rand::{Rng, SeedableRng};

    fn at(field: &PrimeField, centres: &[[i64; 3]]) -> Vec<[u64; 3]> {
        let centre = |c: &[i64; 3]| c.map(|x| field.from_i64(x));
        centres.iter().map(centre).collect()
    }

    /// The paper's matrix at cameras with these centres.
    fn whole(field: &PrimeField, graph: &Graph, centres: &[[u64; 3]]) -> Matrix<u64> {
        let cameras: Vec<_> = centres.iter().map(|c| normal_form(field, c)).collect();
        let rows = jacobian(field, graph, &cameras);
        dense(field, &rows, 12 * graph.nodes())
    }

    /// rank N, and rank Lambda from a basis of all flows.
    fn ranks(field: &PrimeField, graph: &Graph, centres: &[[u64; 3]]) -> (usize, usize) {
        let flows = unwatched(|task| PlaneFlows::new(field, graph, centres, task));
        let lambda = unwatched(|task| flows.lambda_of_all_flows(task));
        (flows.rigidity_rank(), lambda.rank())
    }

    #[test]
    fn directions_by_hand() {
        let field = PrimeField::mersenne61();
        let both = |d: [i64; 3]| {
            let [d, zero] = at(&field, &[d, [0; 3]])[..] else {
                unreachable!("two points");
            };
            directions(&field, &d, &zero).map(|both| both.to_vec())
        };
        let expected = |rows: [[i64; 3]; 2]| Some(at(&field, &rows));
        assert_eq!(both([2, 3, 5]), expected([[-3, 2, 0], [-5, 0, 2]]));
        assert_eq!(both([0, 3, 5]), expected([[3, 0, 0], [0, -5, 3]]));
        assert_eq!(both([0, 0, 5]), expected([[5, 0, 0], [0, 5, 0]]));
        assert_eq!(both([0, 0, 0]), None);
    }

    /// Three centres in the plane z = 1. The only flow is that plane, around the triangle: with
    /// sign + at the smaller end it is n, -n, n on the edges 01, 02, 12. Lambda has the four rows
    /// k of (0, 0, 1, -1)_k (1, -1, 1), of rank 1, so that rank J_P = 4 * 5 + 1 - 3 = 18.
    #[test]
    fn a_triangle_has_one_flow() {
        let field = PrimeField::mersenne61();
        let graph = Graph::new(3, [(0, 1), (0, 2), (1, 2)]).unwrap();
        let centres = at(&field, &[[0, 0, 1], [1, 0, 1], [0, 1, 1]]);
        let flows = unwatched(|task| PlaneFlows::new(&field, &graph, &centres, task));
        let basis = unwatched(|task| flows.flows(task));
        let [flow] = &basis[..] else {
            panic!("{} flows", basis.len());
        };
        let z = flow[0][2];
        assert!(z != 0);
        assert_eq!(*flow, [[0, 0, z], [0, 0, field.neg(&z)], [0, 0, z]]);
        assert_eq!(cotree(&graph), [2]);
        assert_eq!(ranks(&field, &graph, &centres), (5, 1));
        let matrix = whole(&field, &graph, &centres);
        assert_eq!(textbook::eliminate(&field, &matrix).rank(), 18);
    }

    /// Three centres on a line: all planes through it flow, a space of dimension 2, and each gives
    /// Lambda the row (1, -1, 1). So rank N = 4, rank Lambda = 1 and rank J_P = 16 + 1 - 3.
    #[test]
    fn a_triangle_on_a_line_has_two() {
        let field = PrimeField::mersenne61();
        let graph = Graph::new(3, [(0, 1), (0, 2), (1, 2)]).unwrap();
        let centres = at(&field, &[[0, 0, 0], [1, 0, 0], [3, 0, 0]]);
        assert_eq!(ranks(&field, &graph, &centres), (4, 1));
        let matrix = whole(&field, &graph, &centres);
        assert_eq!(textbook::eliminate(&field, &matrix).rank(), 14);
    }

    /// The 4-cycle has 2 m = 3 n - 4 independent directions and so no flow at all: one scale is
    /// free. Its motions are in the kernel of the paper's matrix, and move the edges differently.
    #[test]
    fn a_cycle_of_four_moves() {
        let field = PrimeField::mersenne61();
        let graph = Graph::new(4, [(0, 1), (1, 2), (2, 3), (0, 3)]).unwrap();
        let centres = at(&field, &[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]);
        assert_eq!(ranks(&field, &graph, &centres), (8, 0));
        let flows = unwatched(|task| PlaneFlows::new(&field, &graph, &centres, task));
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let mut random = || field.from_u64(random.next_u64());
        let lambda = unwatched(|task| flows.lambda(&mut random, task));
        let rank = flows.rank(&lambda);
        assert_eq!((rank.rank(4), rank.flows), (28, 0));
        let motion = flows
            .motion(&lambda, &mut random)
            .expect("there are no flows to span");
        assert!(in_kernel(
            &field,
            &whole(&field, &graph, &centres),
            &motion.by_node()
        ));
        let mut transforms = motion.transforms;
        transforms.sort_unstable();
        transforms.dedup();
        assert_eq!(transforms.len(), 4);
        // With the directions alone it does not move: one scale and translation for all edges.
        let (_, transforms) = flows.calibrated_motion(&mut random);
        assert!(transforms.iter().all(|one| *one == transforms[0]));
    }

    fn in_kernel(field: &PrimeField, matrix: &Matrix<u64>, vector: &[u64]) -> bool {
        (0..matrix.rows()).all(|row| field.dot(0, matrix.row(row), vector) == 0)
    }

    proptest! {
        /// Theorem 3.2, at special positions too: centres on a coarse grid.
        #[test]
        #[test]
        fn ranks_are_those_of_the_whole_matrix(
            grid in prop::collection::vec(prop::array::uniform3(0i64..4), 2..7),
            ends in prop::collection::vec((0usize..7, 0usize..7), 1..16),
            seed: u64,
        ) {
            let field = PrimeField::mersenne61();
            let pairs = ends.into_iter().filter_map(|(a, b)| {
                let (ca, cb) = (grid.get(a)?, grid.get(b)?);
                (ca != cb).then_some((a as u32, b as u32))
            });
            let graph = Graph::new(grid.len() as u32, pairs).unwrap();
            let centres = at(&field, &grid);
            let matrix = whole(&field, &graph, &centres);
            let expected = textbook::eliminate(&field, &matrix).rank();
            let (rigidity, lambda) = ranks(&field, &graph, &centres);
            prop_assert_eq!(4 * rigidity + lambda, expected + graph.edges().len());

            let flows = unwatched(|task| PlaneFlows::new(&field, &graph, &centres, task));
            let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
            let mut random = || field.from_u64(random.next_u64());
            let lambda = unwatched(|task| flows.lambda(&mut random, task));
            prop_assert_eq!(flows.rank(&lambda).rank(graph.edges().len()), expected);
            let motion = flows.motion(&lambda, &mut random).unwrap();
            prop_assert!(in_kernel(&field, &matrix, &motion.by_node()));
        }
    }
}
