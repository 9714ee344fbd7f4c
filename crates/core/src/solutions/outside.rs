//! Points on the boundary that no solution comes near (docs/theory.md, Theorem 10.14).
//!
//! In: a vector that all polynomials of a span annihilate, not from a point with scales other than
//! zero. Out: the values of all unknowns, zero and infinite among them, and sets of rows that show
//! that the rank of N(u) is small there at all centres: the point is there whatever the centres
//! are, so it is not the limit of a solution.

use super::chart::{Row, Side};
use super::evidence::{Limit, Outside};
use super::exponents::Exponents;
use super::system::{System, Values};
use crate::linalg::prime::PrimeField;
use crate::linalg::span::{Span, left_kernel};

/// What the others of a point may be, besides those that are read off.
const LIMITS: [Limit; 3] = [Limit::Finite(1), Limit::Finite(0), Limit::Infinite];

/// Shows that the vector is that of a point on the boundary that is there at all centres.
pub(super) fn outside(
    system: &System<'_>,
    known: &Values,
    unknowns: &[usize],
    exponents: &Exponents,
    absent: &[bool],
    vector: &[u64],
) -> Option<Outside> {
    let limits = limits(&system.field, exponents, absent, vector)?;
    let mut values = vec![Limit::Finite(1); known.len()];
    for (&f, &limit) in unknowns.iter().zip(&limits) {
        values[f] = limit;
    }
    // Unknowns that are not among those of the span may have any values.
    let others: Vec<usize> = (0..known.len())
        .filter(|f| known[*f].is_none() && !unknowns.contains(f))
        .collect();
    (0..LIMITS.len().pow(others.len() as u32)).find_map(|mut choice| {
        for &f in &others {
            values[f] = LIMITS[choice % LIMITS.len()];
            choice /= LIMITS.len();
        }
        Limited::new(system, &values)?.sets(&values)
    })
}

/// The point whose monomials, homogeneous in each unknown, are the entries of a vector; `None` if
/// there is none, or if no value of it is zero or infinite.
pub(super) fn limits(
    field: &PrimeField,
    exponents: &Exponents,
    absent: &[bool],
    vector: &[u64],
) -> Option<Vec<Limit>> {
    let all = exponents.all();
    let support: Vec<usize> = (0..vector.len()).filter(|&k| vector[k] != 0).collect();
    let value = |f: usize| {
        let everywhere = |e: usize| support.iter().all(|&k| all[k][f] == e);
        if everywhere(0) {
            return Some(Limit::Finite(0));
        }
        if everywhere(exponents.bounds[f]) {
            return Some(Limit::Infinite);
        }
        let stride = exponents.stride(f);
        let next = |&&k: &&usize| all[k][f] < exponents.bounds[f] && vector[k + stride] != 0;
        let &from = support.iter().find(next)?;
        let ratio = field.times(vector[from + stride], field.inverse(vector[from])?);
        Some(Limit::Finite(field.to_u64(ratio)))
    };
    let limits: Vec<Limit> = (0..exponents.bounds.len())
        .map(value)
        .collect::<Option<_>>()?;
    let monomial = |exponent: &[usize]| {
        let powers = limits.iter().enumerate().map(|(f, limit)| match *limit {
            Limit::Finite(x) => field.pow(field.from_u64(x), exponent[f] as u64),
            Limit::Infinite => field.from_u64(u64::from(exponent[f] == exponents.bounds[f])),
        });
        powers.fold(field.from_u64(1), |product, power| {
            field.times(product, power)
        })
    };
    let &at = support.first()?;
    let scale = monomial(&all[at]);
    let is_point = (0..vector.len())
        .filter(|&k| !absent[k])
        .all(|k| field.times(vector[k], scale) == field.times(vector[at], monomial(&all[k])));
    let special = |limit: &Limit| matches!(limit, Limit::Finite(0) | Limit::Infinite);
    (is_point && scale != 0 && limits.iter().any(special)).then_some(limits)
}

/// N(u) at a point on the boundary.
struct Limited<'a> {
    system: &'a System<'a>,
    /// The factors of both sides of each row.
    factors: Vec<[u64; 2]>,
    rows: Vec<Vec<u64>>,
    /// The unknowns with values that are neither 0, 1 nor infinite.
    parameters: Vec<usize>,
    kernel: Vec<Vec<u64>>,
}

impl<'a> Limited<'a> {
    /// `None` if a row has no side left, or if the rank is too large.
    fn new(system: &'a System<'a>, values: &[Limit]) -> Option<Self> {
        let field = &system.field;
        // An infinite scale in more rows than its node has columns lowers the degree.
        let many = |f: usize| {
            let with = |row: &&Row| row.unknowns().any(|g| g == f);
            system.rows.iter().filter(with).count() > 3
        };
        if (0..values.len()).any(|f| values[f] == Limit::Infinite && many(f)) {
            return None;
        }
        let factors: Vec<[u64; 2]> = system
            .rows
            .iter()
            .map(|row| factors(field, row, |f| values[f]))
            .collect::<Option<_>>()?;
        let mut span = Span::default();
        let mut rows = Vec::with_capacity(factors.len());
        for (row, [plus, minus]) in system.rows.iter().zip(&factors) {
            let mut vector = vec![0; system.columns];
            for (side, factor) in row.sides.iter().zip([*plus, field.negate(*minus)]) {
                field.axpy(&mut vector[3 * side.node..][..3], factor, &side.vector);
            }
            rows.push(vector.clone());
            span.insert(field, vector);
        }
        if span.dimension() > system.target {
            return None;
        }
        let other = |f: &usize| !matches!(values[*f], Limit::Finite(0 | 1) | Limit::Infinite);
        Some(Self {
            system,
            factors,
            rows,
            parameters: (0..values.len()).filter(other).collect(),
            kernel: span.kernel(field, system.columns),
        })
    }

    /// Blocks and dependent sets that bound the rank by 3 n' - 4 at all centres.
    fn sets(&self, values: &[Limit]) -> Option<Outside> {
        let (mut blocks, mut dependent) = (Vec::new(), Vec::new());
        let mut bound = self.rows.len();
        let mut left: Vec<usize> = (0..self.rows.len()).collect();
        let one = self.system.field.from_u64(1);
        for seed in 0..self.rows.len() {
            if !left.contains(&seed) || self.factors[seed] != [one; 2] {
                continue;
            }
            let nodes = self.together(seed);
            let inside = |row: &usize| {
                let mut sides = self.system.rows[*row].sides.iter();
                self.factors[*row] == [one; 2] && sides.all(|side| nodes.contains(&side.node))
            };
            let block: Vec<usize> = left.iter().copied().filter(inside).collect();
            let rank = 3 * nodes.len() - 4;
            if rank < block.len() {
                bound -= block.len() - rank;
                left.retain(|row| !block.contains(row));
                blocks.push(block);
            }
        }
        if !self.parameters.is_empty() {
            dependent = self.dependent(&left)?;
            bound -= dependent.len();
        }
        (bound <= self.system.target).then(|| Outside {
            values: values.to_vec(),
            blocks,
            dependent,
        })
    }

    /// The nodes of a row, and more as long as kernel vectors are y_v = P_v x on them.
    fn together(&self, seed: usize) -> Vec<usize> {
        let centres = self.system.core.left_centres(self.system.centres);
        let sides = &self.system.rows[seed].sides;
        let mut nodes: Vec<usize> = sides.iter().map(|side| side.node).collect();
        for v in 0..centres.len() {
            if sides.iter().all(|side| side.node != v) {
                nodes.push(v);
                if !is_trivial(&self.system.field, &centres, &self.kernel, &nodes) {
                    nodes.pop();
                }
            }
        }
        nodes
    }

    /// Sets of rows that are dependent at these values of the parameters, which are an isolated
    /// and simple solution of that.
    fn dependent(&self, left: &[usize]) -> Option<Vec<Vec<usize>>> {
        let (field, columns) = (&self.system.field, self.system.columns);
        let rows: Vec<Vec<u64>> = left.iter().map(|&row| self.rows[row].clone()).collect();
        let mut sets: Vec<Vec<usize>> = Vec::new();
        let mut conditions = 0;
        let mut jacobian = Span::default();
        for weights in left_kernel(field, &rows, columns) {
            let support = left.iter().zip(&weights).filter(|(_, w)| **w != 0);
            let nodes: Vec<usize> = (0..columns / 3)
                .filter(|&v| support.clone().any(|(&row, _)| self.touches(row, v)))
                .collect();
            let inside = |row: &usize| {
                (0..columns / 3).all(|v| nodes.contains(&v) || !self.touches(*row, v))
                    && sets.iter().all(|set| !set.contains(row))
            };
            let set: Vec<usize> = left.iter().copied().filter(inside).collect();
            let Some(derivatives) = self.derivatives(&set, &nodes) else {
                continue;
            };
            conditions += derivatives.len();
            for vector in derivatives {
                jacobian.insert(field, vector);
            }
            sets.push(set);
        }
        let parameters = self.parameters.len();
        (conditions == parameters && jacobian.dimension() == parameters).then_some(sets)
    }

    /// Whether a row has an entry in the columns of a node.
    fn touches(&self, row: usize, v: usize) -> bool {
        let sides = self.system.rows[row].sides.iter();
        let mut kept = sides
            .zip(&self.factors[row])
            .filter(|(_, factor)| **factor != 0);
        kept.any(|(side, _)| side.node == v)
    }

    /// The derivatives by the parameters of the conditions that the rows be dependent, as many as
    /// there are vectors y on the nodes that the rows annihilate; `None` if there is not just
    /// one relation between the rows.
    fn derivatives(&self, set: &[usize], nodes: &[usize]) -> Option<Vec<Vec<u64>>> {
        let field = &self.system.field;
        let within = |vector: &[u64]| -> Vec<u64> {
            let of_node = |&v: &usize| vector[3 * v..3 * v + 3].iter().copied();
            nodes.iter().flat_map(of_node).collect()
        };
        let rows: Vec<Vec<u64>> = set.iter().map(|&row| within(&self.rows[row])).collect();
        let left = left_kernel(field, &rows, 3 * nodes.len());
        let [w] = &left[..] else { return None };
        let mut span = Span::default();
        for row in rows {
            span.insert(field, row);
        }
        let of_vector = |y: Vec<u64>| self.derivative(set, nodes, w, &y);
        let right = span.kernel(field, 3 * nodes.len()).into_iter();
        Some(right.map(of_vector).collect())
    }

    /// The derivatives of `w R y` by the parameters, R being the rows of a set.
    fn derivative(&self, set: &[usize], nodes: &[usize], w: &[u64], y: &[u64]) -> Vec<u64> {
        let field = &self.system.field;
        let derivative = |&f: &usize| {
            set.iter().zip(w).fold(0, |mut sum, (&row, &weight)| {
                for (which, side) in self.system.rows[row].sides.iter().enumerate() {
                    let Some(place) = nodes.iter().position(|&v| v == side.node) else {
                        continue;
                    };
                    // A side whose partner is infinite is not there.
                    if side.scale == Some(f) && self.factors[row][which] != 0 {
                        let product = field.dot(0, &side.vector, &y[3 * place..3 * place + 3]);
                        let term = field.times(weight, product);
                        sum = match which {
                            0 => field.plus(sum, term),
                            _ => field.minus(sum, term),
                        };
                    }
                }
                sum
            })
        };
        self.parameters.iter().map(derivative).collect()
    }
}

/// The factors of both sides of a row; `None` if both vanish.
pub(super) fn factors(
    field: &PrimeField,
    row: &Row,
    value: impl Fn(usize) -> Limit,
) -> Option<[u64; 2]> {
    let one = field.from_u64(1);
    let limit = |side: &Side| side.scale.map_or(Limit::Finite(1), &value);
    match row.sides.each_ref().map(limit) {
        [Limit::Infinite, Limit::Infinite] | [Limit::Finite(0), Limit::Finite(0)] => None,
        [Limit::Infinite, Limit::Finite(_)] => Some([one, 0]),
        [Limit::Finite(_), Limit::Infinite] => Some([0, one]),
        [Limit::Finite(plus), Limit::Finite(minus)] => {
            Some([plus, minus].map(|factor| field.from_u64(factor)))
        }
    }
}

/// Whether the vectors are y_v = x' - x_4 c_v on some nodes.
fn is_trivial(
    field: &PrimeField,
    centres: &[[u64; 3]],
    kernel: &[Vec<u64>],
    nodes: &[usize],
) -> bool {
    let one = field.from_u64(1);
    let mut trivial = Span::default();
    for k in 0..4 {
        let of_node = |&v: &usize| match k {
            3 => centres[v],
            _ => std::array::from_fn(|l| if k == l { one } else { 0 }),
        };
        trivial.insert(field, nodes.iter().flat_map(of_node).collect());
    }
    kernel.iter().all(|vector| {
        let mut rest: Vec<u64> = nodes
            .iter()
            .flat_map(|&v| vector[3 * v..3 * v + 3].iter().copied())
            .collect();
        trivial.reduce(field, &mut rest);
        rest.iter().all(|&x| x == 0)
    })
}

/// Whether the values are those of a point on the boundary that is there at all centres.
#[cfg(test)]
pub(super) fn is_outside(system: &System<'_>, values: &[Limit]) -> bool {
    Limited::new(system, values).is_some_and(|limited| limited.sets(values).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The point (3, infinite) in degrees 2 and 1, and vectors that are those of no point or of
    /// one that is finite.
    #[test]
    fn limits_by_hand() {
        let f = PrimeField::mersenne61();
        let exponents = Exponents { bounds: vec![2, 1] };
        let of = |vector: [u64; 6], absent: [bool; 6]| {
            limits(&f, &exponents, &absent, &vector.map(|x| f.from_u64(x)))
        };
        let none = [false; 6];
        let expected = Some(vec![Limit::Finite(3), Limit::Infinite]);
        assert_eq!(of([0, 1, 0, 3, 0, 9], none), expected);
        assert_eq!(of([0, 1, 0, 3, 0, 8], none), None);
        let mut last = none;
        last[5] = true;
        assert_eq!(of([0, 1, 0, 3, 0, 0], last), expected);
        assert_eq!(of([0, 1, 0, 3, 0, 0], none), None);
        assert_eq!(of([1; 6], none), None);
        let corner = Some(vec![Limit::Finite(0), Limit::Finite(0)]);
        assert_eq!(of([5, 0, 0, 0, 0, 0], none), corner);
    }
}
