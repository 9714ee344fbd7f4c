//! The augmented Jacobian in double precision, by blocks.

use super::cameras::{Camera, fundamental};
use super::dense::{Columns, add, dot, identity};
use super::doubles::Doubles;
use viewcert::geometry::jacobian;
use viewcert::geometry::jacobian::{SparseRows, augmented_size};
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
        augmented_size(self.blocks.graph)
    }

    /// The columns of the dense matrix.
    pub fn dense(&self) -> Columns {
        self.times(&identity(self.size().1))
    }

    /// J V for a matrix V of 12n rows.
    pub fn times(&self, v: &Columns) -> Columns {
        let edges = self.blocks.graph.edges().iter().zip(&self.blocks.edges);
        let image = |x: &Vec<f64>| {
            let rows = edges.clone().flat_map(|(&(i, j), block)| {
                let [of_i, of_j] = [i, j].map(|v| &x[12 * v as usize..][..12]);
                let times = |row: &[f64; 24]| dot(&row[..12], of_i) + dot(&row[12..], of_j);
                block.iter().map(times)
            });
            let gauge = self.gauge.iter().map(|entries| {
                let terms = entries.iter().map(|&(at, entry)| entry * x[at]);
                terms.sum()
            });
            rows.chain(gauge).collect()
        };
        v.iter().map(image).collect()
    }

    /// J^T J as a dense matrix.
    pub fn dense_gram(&self) -> Columns {
        let (diagonal, below) = self.gram();
        let columns = self.size().1;
        let mut gram = vec![vec![0.0; columns]; columns];
        let mut put = |v: usize, w: usize, block: &GramBlock| {
            for (r, line) in block.iter().enumerate() {
                for (c, &x) in line.iter().enumerate() {
                    gram[12 * v + r][12 * w + c] = x;
                    gram[12 * w + c][12 * v + r] = x;
                }
            }
        };
        diagonal
            .iter()
            .enumerate()
            .for_each(|(v, block)| put(v, v, block));
        for (&(i, j), block) in self.blocks.graph.edges().iter().zip(&below) {
            put(j as usize, i as usize, block);
        }
        gram
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cameras::NORM;
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
                assert!((dense[column][r] - x).abs() < 1e-12, "{r} {column}");
            }
        }
        let (diagonal, below) = j.gram();
        for a in 0..36 {
            for b in 0..36 {
                let expected: f64 = dot(&dense[a], &dense[b]);
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
