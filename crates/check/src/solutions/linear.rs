//! Steps by linear algebra: conditions (S9) to (S11) of section 12 (theory, Theorem 10.6).

use super::dense::{Sparse, columns};
use super::system::{Known, System};
use crate::algebra::Ring;
use crate::document::solutions::{Linear, Step};
use crate::elimination::Echelon;
use crate::rejection::{Checked, Failure, Within, ensure};

/// A row of which both sides stand for themselves.
struct Freed {
    /// The unknown that is not known, and at which side.
    unknown: usize,
    side: usize,
}

/// Verifies steps, one after the other.
pub(super) fn check_all(steps: &[Step], system: &System, known: &mut Known) -> Checked<()> {
    for (k, step) in steps.iter().enumerate() {
        let Step::Linear(linear) = step;
        let checked = check(linear, system, known);
        checked.within(|| format!("steps[{k}] ({})", step.kind()))?;
    }
    Ok(())
}

/// Verifies a step, and makes its unknowns known.
fn check(step: &Linear, system: &System, known: &mut Known) -> Checked<()> {
    let freed = freed_rows(step, system, known)?;
    let relations = relations(step, system, known)?;
    ensure!(!step.settled.is_empty(), "no unknown is settled");
    for &f in &step.settled {
        let value = value(f, &freed, &relations, system)?;
        let place = known.get_mut(f).filter(|place| place.is_none());
        let wrong = || Failure::rejected(format!("unknown {f} is known already"));
        *place.ok_or_else(wrong)? = Some(value);
    }
    Ok(())
}

/// (S9): one to four rows, with one unknown each.
fn freed_rows(step: &Linear, system: &System, known: &Known) -> Checked<Vec<Freed>> {
    let rows = &step.freed;
    ensure!(
        (1..=4).contains(&rows.len())
            && rows.is_sorted_by(|a, b| a < b)
            && rows.iter().all(|&row| row < system.rows.len()),
        "`freed` is not an increasing list of one to four rows"
    );
    let mut freed = Vec::new();
    for &row in rows {
        let sides = system.rows[row].iter().enumerate();
        let open = sides.filter_map(|(side, of_node)| {
            let unknown = of_node.unknown.filter(|&f| known[f].is_none())?;
            Some(Freed { unknown, side })
        });
        let mut open: Vec<Freed> = open.collect();
        ensure!(
            open.len() == 1,
            "row {row} has {} unknowns that are not known, and not one",
            open.len()
        );
        freed.append(&mut open);
    }
    Ok(freed)
}

/// (S10): the left kernel of the constant rows and the sides of freed ones, of which the entries at
/// these sides are returned. It is not larger than at any solution.
///
/// What is left of the sides once constant rows are subtracted has just these relations; those
/// among constant rows alone vanish at the sides.
fn relations(step: &Linear, system: &System, known: &Known) -> Checked<Vec<Vec<u64>>> {
    let (field, meter) = (&system.field, system.meter);
    let (mut constant, mut rows) = (Echelon::new(field, system.columns, meter), 0);
    for row in system.constant(known) {
        constant.push(system.row(row, known), None)?;
        rows += 1;
    }
    let sides = step.freed.iter().flat_map(|&row| [(row, 0), (row, 1)]);
    let rests = sides.map(|(row, which)| constant.residue(system.side(row, which, known)));
    let rests = columns(field, meter, &rests.collect::<Checked<Vec<Sparse>>>()?)?;
    let free = rests.free();
    let dimension = rows - constant.rank() + free.len();
    let least = rows + step.freed.len();
    ensure!(
        dimension + system.target == least,
        "the left kernel has dimension {dimension}, where {least} less {} is asked for",
        system.target
    );
    free.into_iter().map(|at| rests.orthogonal(at)).collect()
}

/// (S11): the value of an unknown, which follows from the entries at both sides of its freed rows.
fn value(f: usize, freed: &[Freed], relations: &[Vec<u64>], system: &System) -> Checked<u64> {
    let field = &system.field;
    let mut entries = Vec::new();
    for (k, row) in freed.iter().enumerate().filter(|(_, row)| row.unknown == f) {
        let sides = relations.iter().map(|relation| &relation[2 * k..2 * k + 2]);
        entries.extend(sides.map(|sides| (sides[row.side], sides[1 - row.side])));
    }
    let given = entries.iter().find(|&&(_, other)| other != 0);
    let missing = || Failure::rejected(format!("unknown {f} does not follow from the left kernel"));
    let &(own, other) = given.ok_or_else(missing)?;
    let value = field.neg(field.mul(own, field.inverse(other)));
    let agrees = |&(own, other): &(u64, u64)| field.add(own, field.mul(value, other)) == 0;
    ensure!(
        entries.iter().all(agrees),
        "the left kernel gives two values for unknown {f}"
    );
    Ok(value)
}
