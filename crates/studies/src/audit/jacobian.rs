//! The augmented Jacobian in double precision, by blocks.

use super::cameras::{Camera, fundamental};
use super::doubles::Doubles;
use crate::formulation::augmented;
use faer::Mat;
use viewcert::geometry::jacobian;
use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::Graph;

/// The rows of one edge: 12 columns of the first camera, then 12 of the second.
pub type EdgeRows = [[f64; 24]; 10];

/// A block of J^T J, row by row.
pub type GramBlock = [[f64; 12]; 12];

/// J_P at given cameras and fundamental matrices of norm 10, which J shares for every choice
/// of the frame.
#[derive(Debug)]
pub struct Blocks<'a> {
    /// The graph.
    pub graph: &'a Graph,
    /// For every edge its rows.
    pub edges: Vec<EdgeRows>,
}

impl<'a> Blocks<'a> {
    /// Computes the rows of all edges. O(m).
    pub fn new(graph: &'a Graph, cameras: &[Camera]) -> Self {
        let block = |&(i, j): &(u32, u32)| {
            let (p_i, p_j) = (&cameras[i as usize], &cameras[j as usize]);
            let f = fundamental(p_i, p_j);
            let mut rows = [[0.0; 24]; 10];
            jacobian::edge_rows(&Doubles, p_i, p_j, &f, |row, column, entry| {
                rows[row][column] = entry;
            });
            rows
        };
        Self {
            graph,
            edges: graph.edges().iter().map(block).collect(),
        }
    }
}

/// J: the blocks, and the rows of the gauge below them.
#[derive(Clone, Debug)]
pub struct Jacobian<'a> {
    /// J_P.
    pub blocks: &'a Blocks<'a>,
    gauge: SparseRows<f64>,
}

impl<'a> Jacobian<'a> {
    /// With the frame on edge number `reference`.
    ///
    /// # Panics
    /// If there is no such edge.
    pub fn new(blocks: &'a Blocks<'a>, reference: usize) -> Self {
        Self {
            blocks,
            gauge: jacobian::gauge(&Doubles, blocks.graph, reference),
        }
    }

    /// Rows and columns.
    pub fn size(&self) -> (usize, usize) {
        augmented::size(self.blocks.graph)
    }

    /// The dense matrix, with rows of zeros added until there are as many as columns.
    pub fn dense(&self) -> Mat<f64> {
        let (rows, columns) = self.size();
        let mut matrix = Mat::zeros(rows.max(columns), columns);
        let edges = self.blocks.graph.edges().iter().zip(&self.blocks.edges);
        for (e, (&(i, j), block)) in edges.enumerate() {
            for (t, row) in block.iter().enumerate() {
                for k in 0..12 {
                    matrix[(10 * e + t, 12 * i as usize + k)] = row[k];
                    matrix[(10 * e + t, 12 * j as usize + k)] = row[12 + k];
                }
            }
        }
        for (row, entries) in (10 * self.blocks.edges.len()..).zip(&self.gauge) {
            for &(column, entry) in entries {
                matrix[(row, column)] = entry;
            }
        }
        matrix
    }

    /// J V for a matrix V of 12n rows.
    pub fn times(&self, v: &Mat<f64>) -> Mat<f64> {
        let mut product = Mat::zeros(self.size().0, v.ncols());
        for column in 0..v.ncols() {
            let edges = self.blocks.graph.edges().iter().zip(&self.blocks.edges);
            for (e, (&(i, j), block)) in edges.enumerate() {
                for (t, row) in block.iter().enumerate() {
                    let mut sum = 0.0;
                    for k in 0..12 {
                        sum += row[k] * v[(12 * i as usize + k, column)];
                        sum += row[12 + k] * v[(12 * j as usize + k, column)];
                    }
                    product[(10 * e + t, column)] = sum;
                }
            }
            let start = 10 * self.blocks.edges.len();
            for (row, entries) in (start..).zip(&self.gauge) {
                let terms = entries.iter().map(|&(at, entry)| entry * v[(at, column)]);
                product[(row, column)] = terms.sum();
            }
        }
        product
    }

    /// The 12 x 12 blocks of the lower triangle of J^T J: on the diagonal one a node, and
    /// below it one an edge, with rows of the larger node.
    pub fn gram(&self) -> (Vec<GramBlock>, Vec<GramBlock>) {
        let nodes = self.blocks.graph.nodes();
        let mut diagonal = vec![[[0.0; 12]; 12]; nodes];
        let mut below = vec![[[0.0; 12]; 12]; self.blocks.edges.len()];
        let edges = self.blocks.graph.edges().iter().zip(&self.blocks.edges);
        for ((&(i, j), block), below) in edges.zip(&mut below) {
            for row in block {
                let (of_i, of_j) = row.split_at(12);
                for (x, line) in diagonal[i as usize].iter_mut().enumerate() {
                    add(line, of_i[x], of_i);
                }
                for (x, line) in diagonal[j as usize].iter_mut().enumerate() {
                    add(line, of_j[x], of_j);
                }
                for (x, line) in below.iter_mut().enumerate() {
                    add(line, of_j[x], of_i);
                }
            }
        }
        // A row of the gauge has entries of one camera only.
        for entries in &self.gauge {
            for &(x, of_x) in entries {
                for &(y, of_y) in entries {
                    diagonal[x / 12][x % 12][y % 12] += of_x * of_y;
                }
            }
        }
        (diagonal, below)
    }
}

fn add(line: &mut [f64; 12], factor: f64, row: &[f64]) {
    for (x, y) in line.iter_mut().zip(row) {
        *x += factor * y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::cameras::NORM;
    use viewcert::linalg::integer::{Integer, Integers};

    /// At small integer cameras J is the exact one, but for the norm of F.
    #[test]
    fn the_exact_jacobian() {
        let (graph, _) = Graph::from_pairs(3, vec![(0, 1), (0, 2), (1, 2)]).unwrap();
        let entries: [[[i64; 4]; 3]; 3] = [
            [[1, 2, 0, 1], [0, 1, 3, 1], [2, 0, 1, 1]],
            [[1, 0, 2, 1], [3, 1, 0, 0], [0, 1, 1, 2]],
            [[2, 1, 1, 0], [1, 0, 0, 1], [0, 3, 1, 1]],
        ];
        let exact = entries.map(|camera| camera.map(|row| row.map(Integer::from)));
        let float = entries.map(|camera| camera.map(|row| row.map(|x| x as f64)));
        let value = |x: &Integer| x.to_string().parse::<f64>().unwrap();
        let blocks = Blocks::new(&graph, &float);
        let j = Jacobian::new(&blocks, 1);
        let dense = j.dense();
        let rows = jacobian::augmented(&Integers, &graph, &exact, 1);
        assert_eq!(j.size(), (rows.len(), 36));
        for (r, row) in rows.iter().enumerate() {
            let scale = graph.edges().get(r / 10).map_or(1.0, |&(a, b)| {
                let f = jacobian::fundamental(&Integers, &exact[a as usize], &exact[b as usize]);
                let squares: f64 = f.iter().flatten().map(|x| value(x).powi(2)).sum();
                NORM / squares.sqrt()
            });
            let mut expected = [0.0; 36];
            for (column, x) in row {
                expected[*column] = scale * value(x);
            }
            for (column, x) in expected.iter().enumerate() {
                assert!((dense[(r, column)] - x).abs() < 1e-12, "{r} {column}");
            }
        }
        let identity = Mat::from_fn(36, 36, |a, b| f64::from(u8::from(a == b)));
        let product = j.times(&identity);
        let (diagonal, below) = j.gram();
        for a in 0..36 {
            for r in 0..rows.len() {
                assert_eq!(product[(r, a)], dense[(r, a)]);
            }
            for b in 0..36 {
                let expected: f64 = (0..rows.len()).map(|r| dense[(r, a)] * dense[(r, b)]).sum();
                let found = match graph.edge_number(a as u32 / 12, b as u32 / 12) {
                    _ if a / 12 == b / 12 => diagonal[a / 12][a % 12][b % 12],
                    Some(e) if a > b => below[e][a % 12][b % 12],
                    Some(e) => below[e][b % 12][a % 12],
                    None => 0.0,
                };
                assert!((found - expected).abs() < 1e-9);
            }
        }
    }
}
