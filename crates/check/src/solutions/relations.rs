//! Relations between rows at a point of a core that is not tight: condition (S23a) of section 12 (theory,
//! Theorem 10.22).

use super::dense::{Sparse, columns};
use super::system::{Known, System};
use crate::document::solutions::Relation;
use crate::elimination::Echelon;
use crate::rejection::{Checked, Within, ensure};
use std::collections::BTreeSet;

/// (S23a): as many independent relations as the rank of N(u) is below the number of its rows, which
/// together ask for as many equations as there are unknowns.
pub(super) fn check(relations: &[Relation], values: &[u64], system: &System) -> Checked<()> {
    let height = system.rows.len();
    ensure!(
        relations.len() + system.target == height,
        "{} of them, and {height} rows of rank {}",
        relations.len(),
        system.target
    );
    let known: Known = values.iter().copied().map(Some).collect();
    let mut independent = Echelon::new(&system.field, height, system.meter);
    let mut equations = 0;
    for (k, relation) in relations.iter().enumerate() {
        let checked = relation_of(relation, &known, system);
        let (vector, own) = checked.within(|| format!("{k}"))?;
        independent.push(vector, None)?;
        equations += own;
    }
    ensure!(
        independent.rank() == relations.len(),
        "they are not independent"
    );
    ensure!(
        equations == values.len(),
        "{equations} equations in {} unknowns",
        values.len()
    );
    Ok(())
}

/// The one relation between some rows, and how many equations say that there is one.
fn relation_of(relation: &Relation, known: &Known, system: &System) -> Checked<(Sparse, usize)> {
    let rows = &relation.rows;
    ensure!(
        rows.is_sorted_by(|a, b| a < b) && rows.iter().all(|&row| row < system.rows.len()),
        "`rows` is not an increasing list of rows"
    );
    let entries: Vec<Sparse> = rows.iter().map(|&row| system.row(row, known)).collect();
    let space = columns(&system.field, system.meter, &entries)?;
    let free = space.free();
    ensure!(
        free.len() == 1,
        "the rows have {} relations, not one",
        free.len()
    );
    let weights = space.orthogonal(free[0])?;
    let touched = |row: usize| system.rows[row].each_ref().map(|side| side.column);
    let nodes: BTreeSet<usize> = rows.iter().flat_map(|&row| touched(row)).collect();
    if let Some(hub) = relation.hub {
        let column = system.chart.place(hub).and_then(|node| system.column[node]);
        let column = column.filter(|column| nodes.contains(column));
        ensure!(column.is_some(), "the rows have no side at the hub");
        let is_scaled = |row: usize| system.rows[row].iter().any(|side| side.unknown.is_some());
        let mut scaled = rows.iter().filter(|&&row| is_scaled(row));
        let is_near = |row: usize| touched(row).iter().any(|&at| Some(at) == column);
        ensure!(
            scaled.all(|&row| is_near(row)),
            "a row with an unknown has no side at the hub"
        );
    }
    let equations = 3 * nodes.len() + 1 - rows.len() - usize::from(relation.hub.is_some());
    let vector = rows
        .iter()
        .copied()
        .zip(weights)
        .filter(|&(_, weight)| weight != 0);
    Ok((vector.collect(), equations))
}
