//! Points with values that are zero or infinite, which no solution comes near: condition (S18a) of
//! section 12 (theory, Theorem 10.14).

use super::dense::{Sparse, columns, dot};
use super::system::{Known, System};
use crate::algebra::Ring;
use crate::document::solutions::Outside;
use crate::elimination::Echelon;
use crate::rejection::{Checked, ensure};
use std::collections::BTreeSet;

/// Verifies such a point; returns the values of the listed unknowns, `None` standing for infinity.
pub(super) fn check(
    text: &Outside,
    listed: &[usize],
    known: &Known,
    system: &System,
) -> Checked<Vec<Option<u64>>> {
    let point = Boundary::new(text, known, system)?;
    let limits: Vec<Option<u64>> = listed.iter().map(|&f| point.values[f]).collect();
    ensure!(
        limits.iter().any(|limit| matches!(limit, None | Some(0))),
        "no value of the listed unknowns is zero or infinite"
    );
    point.check_sets(text)?;
    let blocks = point.rank_of_blocks(&text.blocks)?;
    point.check_dependent(&text.dependent)?;
    let in_sets: usize = text
        .blocks
        .iter()
        .chain(&text.dependent)
        .map(Vec::len)
        .sum();
    let dependent: usize = text.dependent.iter().map(|rows| rows.len() - 1).sum();
    let bound = blocks + dependent + system.rows.len() - in_sets;
    ensure!(
        bound <= system.target,
        "the rank at the point is at most {bound}, which is above {}",
        system.target
    );
    Ok(limits)
}

/// N(u) where unknowns may be zero or infinite.
struct Boundary<'a> {
    system: &'a System<'a>,
    /// The values of all unknowns, `None` standing for infinity.
    values: Vec<Option<u64>>,
    /// The factors of both sides of each row.
    factors: Vec<[u64; 2]>,
}

impl<'a> Boundary<'a> {
    fn new(text: &Outside, known: &Known, system: &'a System<'a>) -> Checked<Boundary<'a>> {
        ensure!(
            text.values.len() == known.len(),
            "{} values for {} unknowns",
            text.values.len(),
            known.len()
        );
        let mut values = Vec::new();
        for value in &text.values {
            let finite = value.as_ref().map(std::slice::from_ref);
            let finite = finite.map(|value| system.residues(value)).transpose()?;
            values.push(finite.map(|value| value[0]));
        }
        let one = Some(system.field.one);
        let changed = (0..known.len()).find(|&f| known[f].is_some() && values[f] != one);
        ensure!(
            changed.is_none(),
            "unknown {} is known to be one, and is not",
            changed.unwrap_or_default()
        );
        let mut point = Boundary {
            system,
            values,
            factors: Vec::new(),
        };
        point.check_infinite()?;
        for row in 0..system.rows.len() {
            let factors = point.factors_of(row)?;
            point.factors.push(factors);
        }
        Ok(point)
    }

    /// What is infinite is in three rows at most: the degree of minors in it.
    fn check_infinite(&self) -> Checked<()> {
        let mut rows = vec![0; self.values.len()];
        let unknowns = self.system.rows.iter().flatten();
        unknowns
            .filter_map(|side| side.unknown)
            .for_each(|f| rows[f] += 1);
        let many = (0..rows.len()).find(|&f| self.values[f].is_none() && rows[f] > 3);
        ensure!(
            many.is_none(),
            "the infinite unknown {} is in more than three rows",
            many.unwrap_or_default()
        );
        Ok(())
    }

    /// The side of an infinite scale is left alone.
    fn factors_of(&self, row: usize) -> Checked<[u64; 2]> {
        let one = self.system.field.one;
        let sides = &self.system.rows[row];
        let limit = |which: usize| sides[which].unknown.map_or(Some(one), |f| self.values[f]);
        let factors = match [limit(0), limit(1)] {
            [Some(first), Some(second)] => [first, second],
            [None, Some(_)] => [one, 0],
            [Some(_), None] => [0, one],
            [None, None] => [0, 0],
        };
        ensure!(
            factors != [0, 0],
            "both scales of row {row} are zero, or both are infinite"
        );
        Ok(factors)
    }

    /// Sets of rows are increasing lists, none of them empty, and disjoint.
    fn check_sets(&self, text: &Outside) -> Checked<()> {
        let mut listed = BTreeSet::new();
        for rows in text.blocks.iter().chain(&text.dependent) {
            ensure!(
                !rows.is_empty()
                    && rows.is_sorted_by(|a, b| a < b)
                    && rows.iter().all(|&row| row < self.system.rows.len()),
                "a set of rows is empty, or not increasing"
            );
            let twice = rows.iter().find(|&&row| !listed.insert(row));
            ensure!(
                twice.is_none(),
                "row {} is in two sets",
                twice.copied().unwrap_or_default()
            );
        }
        Ok(())
    }

    /// The ranks that blocks do not exceed, added up: the rows of one annihilate all y_v = P_v x.
    fn rank_of_blocks(&self, blocks: &[Vec<usize>]) -> Checked<usize> {
        let one = self.system.field.one;
        let mut rank = 0;
        for &row in blocks.iter().flatten() {
            ensure!(
                self.factors[row] == [one; 2],
                "row {row} of a block has a scale that is not one"
            );
        }
        for rows in blocks {
            rank += 3 * self.columns(rows).len() - 4;
        }
        Ok(rank)
    }

    /// The first columns of the nodes in which rows have a side that is not struck out.
    fn columns(&self, rows: &[usize]) -> BTreeSet<usize> {
        let sides = |&row: &usize| {
            let sides = self.system.rows[row].iter().zip(self.factors[row]);
            sides.filter_map(|(side, factor)| (factor != 0).then_some(side.column))
        };
        rows.iter().flat_map(sides).collect()
    }

    /// Dependent sets have one relation each, for just these values of the unknowns that are not
    /// zero, one or infinite, and simply so.
    fn check_dependent(&self, dependent: &[Vec<usize>]) -> Checked<()> {
        let special = [None, Some(0), Some(self.system.field.one)];
        let free: Vec<usize> = (0..self.values.len())
            .filter(|&f| !special.contains(&self.values[f]))
            .collect();
        let (field, meter) = (&self.system.field, self.system.meter);
        let (mut independent, mut conditions) = (Echelon::new(field, free.len(), meter), 0);
        for (k, rows) in dependent.iter().enumerate() {
            let set = Dependent::new(k, rows, self)?;
            for free_column in set.space.free() {
                conditions += 1;
                let derivative = set.derivative(free_column, &free, self)?;
                independent.push(derivative.into_iter().enumerate(), None)?;
            }
        }
        let rank = independent.rank();
        ensure!(
            conditions == free.len() && rank == free.len(),
            "{conditions} conditions of rank {rank} for {} values",
            free.len()
        );
        Ok(())
    }

    /// A row in the columns of some nodes.
    fn row(&self, row: usize, place: impl Fn(usize) -> Option<usize>) -> Sparse {
        let field = &self.system.field;
        let mut entries = Sparse::new();
        for (which, side) in self.system.rows[row].iter().enumerate() {
            let factor = self.factors[row][which];
            let factor = [factor, field.neg(factor)][which];
            if let Some(at) = place(side.column).filter(|_| factor != 0) {
                let vector = side.vector.iter().enumerate();
                entries.extend(vector.map(|(k, &value)| (at + k, field.mul(factor, value))));
            }
        }
        entries
    }
}

/// A set of rows with one relation, in the columns of its nodes.
struct Dependent<'a> {
    rows: &'a [usize],
    nodes: Vec<usize>,
    relation: Vec<u64>,
    space: Echelon<'a>,
}

impl<'a> Dependent<'a> {
    fn new(k: usize, rows: &'a [usize], point: &Boundary<'a>) -> Checked<Dependent<'a>> {
        let (field, meter) = (&point.system.field, point.system.meter);
        let nodes: Vec<usize> = point.columns(rows).into_iter().collect();
        let place = |column: usize| nodes.binary_search(&column).ok().map(|node| 3 * node);
        let matrix: Vec<Sparse> = rows.iter().map(|&row| point.row(row, place)).collect();
        let relations = columns(field, meter, &matrix)?;
        let free = relations.free();
        ensure!(
            free.len() == 1,
            "dependent[{k}] has {} relations, and not one",
            free.len()
        );
        Ok(Dependent {
            rows,
            relation: relations.orthogonal(free[0])?,
            space: Echelon::of(field, 3 * nodes.len(), meter, matrix)?,
            nodes,
        })
    }

    /// The derivatives of w R y by the free unknowns, for the y that a free column stands for.
    fn derivative(&self, column: usize, free: &[usize], point: &Boundary) -> Checked<Vec<u64>> {
        let (system, field) = (point.system, &point.system.field);
        let y = self.space.orthogonal(column)?;
        let mut derivative = vec![0; free.len()];
        for (&row, &weight) in self.rows.iter().zip(&self.relation) {
            for (which, side) in system.rows[row].iter().enumerate() {
                // A side beside an infinite one is struck out, whatever its scale.
                let unknown = side.unknown.filter(|_| point.factors[row][which] != 0);
                let f = unknown.and_then(|f| free.binary_search(&f).ok());
                let node = self.nodes.binary_search(&side.column).ok();
                let (Some(f), Some(node)) = (f, node) else {
                    continue;
                };
                let sign = [weight, field.neg(weight)][which];
                let product = dot(field, &side.vector, &y[3 * node..3 * node + 3]);
                derivative[f] = field.add(derivative[f], field.mul(sign, product));
            }
        }
        Ok(derivative)
    }
}
