//! The rank of a sparse matrix over each of the two fields.

use crate::formulation::plane_ranks;
use crate::formulation::plane_ranks::PlaneRanks;
use viewcert::geometry::camera::Camera;
use viewcert::geometry::draw::DrawKey;
use viewcert::geometry::jacobian::SparseRows;
use viewcert::graph::Graph;
use viewcert::linalg::Field;
use viewcert::linalg::dixon::{IntegerRow, rank_exact};
use viewcert::linalg::integer::{Division, Integer, One, content};
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::linalg::sparse_lu::Factorisation;
use viewcert::watch::unwatched;

/// A field with an elimination of its own.
pub trait RankField: Field + 'static {
    /// The rank of a matrix with `cols` columns.
    fn rank(&self, rows: SparseRows<Self::Elem>, cols: usize) -> usize;

    /// The ranks of N and Lambda at cameras that [`plane_ranks::admits`] takes, with
    /// distinct centres on edges.
    fn plane_ranks(
        &self,
        graph: &Graph,
        cameras: &[Camera<Self::Elem>],
        key: &DrawKey,
    ) -> PlaneRanks;

    /// How many entries Lambda counts for in a graph with this number of edges.
    fn lambda_entries(&self, edges: usize) -> usize;
}

impl RankField for PrimeField {
    /// Sparse elimination with a dense end.
    fn rank(&self, rows: SparseRows<u64>, cols: usize) -> usize {
        unwatched(|task| Factorisation::new(self, rows, cols, task)).rank()
    }

    fn plane_ranks(&self, graph: &Graph, cameras: &[Camera<u64>], key: &DrawKey) -> PlaneRanks {
        plane_ranks::modular(self, graph, cameras, key)
    }

    /// About as many rows as columns. It is dense, and so takes longer than matrices of its size
    /// that are not: it counts eightfold.
    fn lambda_entries(&self, edges: usize) -> usize {
        edges.saturating_mul(8 * (edges + 16))
    }
}

impl RankField for Rationals {
    /// Every row is multiplied to integers without a common divisor. Then elimination
    /// modulo a prime for the lower bound, and verified integer kernel vectors for the
    /// upper one.
    fn rank(&self, rows: SparseRows<Self::Elem>, cols: usize) -> usize {
        let rows = integer_rows(&rows);
        unwatched(|task| rank_exact(&rows, cols, task)).rank()
    }

    fn plane_ranks(&self, graph: &Graph, cameras: &[Camera<Rational>], _: &DrawKey) -> PlaneRanks {
        plane_ranks::rational(graph, cameras)
    }

    /// Four rows for each of at most 2m flows.
    fn lambda_entries(&self, edges: usize) -> usize {
        edges.saturating_mul(8 * edges)
    }
}

/// The rows over their greatest common divisors, as integers.
fn integer_rows(rows: &SparseRows<Rational>) -> Vec<IntegerRow> {
    rows.iter()
        .map(|row| {
            let denominator = row
                .iter()
                .fold(Integer::one(), |lcm, (_, x)| lcm.lcm(x.denom()));
            let whole = row.iter().map(|(col, x)| {
                let factor = &denominator / x.denom();
                (*col, x.numer() * factor)
            });
            let whole: IntegerRow = whole.collect();
            let gcd = content(whole.iter().map(|(_, x)| x));
            whole.iter().map(|(col, x)| (*col, x / &gcd)).collect()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::linalg::Ring;

    #[test]
    fn fractions_and_residues() {
        // (1/2, 1/3) and (3/4, 1/2) are proportional, (1/2, 1/4) is not.
        let fraction = |a: i64, b: i64| Rational::new(a.into(), b.into());
        let row = |x, y| vec![(0, x), (1, y)];
        let first = row(fraction(1, 2), fraction(1, 3));
        let second = row(fraction(3, 4), fraction(1, 2));
        let third = row(fraction(1, 2), fraction(1, 4));
        assert_eq!(Rationals.rank(vec![first.clone(), second], 2), 1);
        assert_eq!(Rationals.rank(vec![first, third, vec![]], 2), 2);
        // det (1 3; 1 10) = 7.
        let f = PrimeField::new(7).unwrap();
        let row = |a, b| vec![(0, f.from_i64(a)), (1, f.from_i64(b))];
        assert_eq!(f.rank(vec![row(1, 3), row(1, 10)], 2), 1);
    }
}
