//! The plane direction matrix R of points in the plane (docs/theory.md, section 13): the affine
//! model, and centres in a plane.

use crate::graph::Graph;
use crate::linalg::prime::PrimeField;
use crate::linalg::sparse_lu::Factorisation;
use crate::linalg::textbook::Pivots;
use crate::linalg::{Field, Ring};
use crate::watch::{Stopped, Task};

/// R as sparse rows `(column, value)`, columns increasing: for edge e = (i, j) and
/// d = p_i - p_j, row e holds b = (d_2, -d_1), which is orthogonal to d, in the columns 2i, 2i+1
/// and -b in 2j, 2j+1. Zero entries are left out.
///
/// # Panics
/// If the points of an edge coincide.
pub fn direction_rows<R: Ring>(
    ring: &R,
    graph: &Graph,
    points: &[[R::Elem; 2]],
) -> Vec<Vec<(usize, R::Elem)>> {
    let row = |&(i, j): &(u32, u32)| {
        let (i, j) = (i as usize, j as usize);
        let [x, y] = std::array::from_fn(|r| ring.sub(&points[i][r], &points[j][r]));
        assert!(
            !ring.is_zero(&x) || !ring.is_zero(&y),
            "points of an edge are distinct"
        );
        let entries = [
            (2 * i, y.clone()),
            (2 * i + 1, ring.neg(&x)),
            (2 * j, ring.neg(&y)),
            (2 * j + 1, x),
        ];
        let entries = entries.into_iter();
        entries.filter(|(_, value)| !ring.is_zero(value)).collect()
    };
    graph.edges().iter().map(row).collect()
}

/// R of a graph at given points modulo p, eliminated.
#[derive(Clone, Debug)]
pub struct PlaneDirections<'a> {
    field: &'a PrimeField,
    graph: &'a Graph,
    points: &'a [[u64; 2]],
    matrix: Factorisation,
}

impl<'a> PlaneDirections<'a> {
    /// Eliminates R: sparse at first, then what fills in as a dense matrix, O(n^3) at worst.
    ///
    /// # Errors
    /// If the task was stopped.
    ///
    /// # Panics
    /// If there is not one point a node, or the points of an edge coincide.
    pub fn new(
        field: &'a PrimeField,
        graph: &'a Graph,
        points: &'a [[u64; 2]],
        task: &Task,
    ) -> Result<Self, Stopped> {
        assert_eq!(points.len(), graph.nodes(), "one point a node");
        let rows = direction_rows(field, graph, points);
        Ok(Self {
            field,
            graph,
            points,
            matrix: Factorisation::new(field, rows, 2 * graph.nodes(), task)?,
        })
    }

    /// The rank of R.
    pub fn rank(&self) -> usize {
        self.matrix.rank()
    }

    /// The pivots of R.
    pub fn pivots(&self) -> Pivots {
        self.matrix.pivots()
    }

    /// A random element y of ker R, entry `2 v + r`, with the scale and translation (s_e, t_e) of
    /// every edge: y_i = s_e p_i + t_e, y_j = s_e p_j + t_e (Theorem 13.13).
    pub(crate) fn motion(&self, mut random: impl FnMut() -> u64) -> (Vec<u64>, Vec<[u64; 3]>) {
        let f = self.field;
        let mut y = vec![0; 2 * self.graph.nodes()];
        for &col in self.matrix.free_cols() {
            y[col] = random();
        }
        let rows = direction_rows(f, self.graph, self.points);
        let sides: Vec<u64> = rows
            .iter()
            .map(|row| {
                let terms = row.iter().map(|&(col, value)| f.times(value, y[col]));
                terms.fold(0, |sum, term| f.minus(sum, term))
            })
            .collect();
        let rest = self.matrix.solve(&sides);
        let rest = rest.expect("the free columns are combinations of the others");
        for (value, part) in y.iter_mut().zip(&rest) {
            *value = f.plus(*value, *part);
        }
        let transforms = self.graph.edges().iter();
        let transforms = transforms.map(|&edge| self.transform(&y, edge)).collect();
        (y, transforms)
    }

    fn transform(&self, y: &[u64], (i, j): (u32, u32)) -> [u64; 3] {
        let f = self.field;
        let (i, j) = (i as usize, j as usize);
        let [p, q] = [&self.points[i], &self.points[j]];
        let r = usize::from(p[0] == q[0]);
        let apart = f.inv(&f.minus(p[r], q[r]));
        let apart = apart.expect("points of an edge are distinct");
        let scale = f.times(f.minus(y[2 * i + r], y[2 * j + r]), apart);
        let t = |r: usize| f.minus(y[2 * i + r], f.times(scale, p[r]));
        [scale, t(0), t(1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::unwatched;

    /// A square with one diagonal is rigid, 2 * 4 - 3 = 5; without it the triangle of its sides
    /// shears: two classes of parallel sides, and every side moves by itself.
    #[test]
    fn a_square_with_and_without_its_diagonal() {
        let field = PrimeField::mersenne61();
        let points = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|p| p.map(|x| field.from_u64(x)));
        let sides = [(0, 1), (1, 2), (2, 3), (0, 3)];
        let braced = Graph::new(4, sides.into_iter().chain([(0, 2)])).unwrap();
        let directions = unwatched(|task| PlaneDirections::new(&field, &braced, &points, task));
        assert_eq!((directions.rank(), directions.pivots().rank()), (5, 5));
        let mut next = 2;
        let mut random = || {
            next = field.times(next, 48_271);
            next
        };
        let (_, transforms) = directions.motion(&mut random);
        assert!(
            transforms
                .iter()
                .all(|transform| *transform == transforms[0])
        );
        let open = Graph::new(4, sides).unwrap();
        let directions = unwatched(|task| PlaneDirections::new(&field, &open, &points, task));
        assert_eq!(directions.rank(), 4);
        let (y, transforms) = directions.motion(&mut random);
        for row in direction_rows(&field, &open, &points) {
            let sum = row.iter().fold(0, |sum, &(col, value)| {
                field.plus(sum, field.times(value, y[col]))
            });
            assert_eq!(sum, 0);
        }
        // Edges in order: 01, 03, 12, 23. Opposite sides are scaled alike at a square.
        let [a, b, c, d] = [0, 1, 2, 3].map(|e| transforms[e][0]);
        assert_eq!((a, b), (d, c));
        assert_ne!(a, b);
    }
}
