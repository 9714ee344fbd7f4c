//! Points at which the rank of N(u) is too large for a solution to be near: condition (S18b) of section 12
//! (theory, Theorem 10.21).

use super::dense::Sparse;
use super::linear;
use super::system::{Known, System};
use crate::algebra::Ring;
use crate::document::solutions::{Spurious, Step};
use crate::elimination::Echelon;
use crate::rejection::{Checked, Failure, Within, ensure};

/// What is known of an unknown at the point: nothing, or a value, `None` standing for infinity.
type Limit = Option<Option<u64>>;

/// The values of the listed unknowns, `None` standing for infinity.
pub(super) fn limits(
    text: &Spurious,
    listed: &[usize],
    system: &System,
) -> Checked<Vec<Option<u64>>> {
    ensure!(
        text.values.len() == listed.len(),
        "{} values for {} unknowns",
        text.values.len(),
        listed.len()
    );
    let residue = |value: &Option<_>| {
        let finite = value.as_ref().map(std::slice::from_ref);
        let finite = finite.map(|value| system.residues(value)).transpose()?;
        Ok(finite.map(|value| value[0]))
    };
    text.values.iter().map(residue).collect()
}

/// Verifies that at such a point the rows whose scales are known have too large a rank.
pub(super) fn check(
    text: &Spurious,
    listed: &[usize],
    limits: &[Option<u64>],
    known: &Known,
    system: &System,
) -> Checked<()> {
    ensure!(
        text.steps.is_empty() || !limits.contains(&None),
        "there are steps, and an infinite value"
    );
    let mut known = known.clone();
    for (&f, &limit) in listed.iter().zip(limits) {
        known[f] = limit;
    }
    follow(&text.steps, system, &mut known)?;
    let mut values: Vec<Limit> = known.into_iter().map(|value| value.map(Some)).collect();
    for (&f, &limit) in listed.iter().zip(limits) {
        values[f] = Some(limit);
    }
    let mut rows = Echelon::new(&system.field, system.columns, system.meter);
    for row in 0..system.rows.len() {
        if let Some(row) = kept(row, system, &values) {
            rows.push(row, None)?;
        }
    }
    let rank = rows.rank();
    ensure!(
        rank > system.target,
        "the rank at the point is {rank}, which is not above {}",
        system.target
    );
    Ok(())
}

/// Makes unknowns known by linear steps.
pub(super) fn follow(steps: &[Step], system: &System, known: &mut Known) -> Checked<()> {
    for (k, step) in steps.iter().enumerate() {
        let Step::Linear(step) = step else {
            return Err(Failure::rejected(format!("steps[{k}] is not `linear`")));
        };
        linear::check(step, system, known).within(|| format!("steps[{k}]"))?;
    }
    Ok(())
}

/// A row at the point; nothing if it is left out.
fn kept(row: usize, system: &System, values: &[Limit]) -> Option<Sparse> {
    let field = &system.field;
    let sides = &system.rows[row];
    let limit = |which: usize| {
        sides[which]
            .unknown
            .map_or(Some(Some(field.one)), |f| values[f])
    };
    let factors = match [limit(0)?, limit(1)?] {
        [Some(first), Some(second)] => [first, second],
        [None, Some(_)] => [field.one, 0],
        [Some(_), None] => [0, field.one],
        [None, None] => return None,
    };
    let mut entries = Sparse::new();
    for (side, factor) in sides.iter().zip([factors[0], field.neg(factors[1])]) {
        let vector = side.vector.iter().enumerate();
        entries.extend(vector.map(|(k, &entry)| (side.column + k, field.mul(factor, entry))));
    }
    Some(entries)
}
