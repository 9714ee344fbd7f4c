//! Scales settled by linear algebra (docs/theory.md, Theorem 10.6).
//!
//! Up to four rows with one unknown each are freed, all others with unknowns dropped. If the left
//! kernel of what is left has no more than its least dimension, it gives the scale of each freed
//! row that takes part in it.

use super::evidence::Linear;
use super::system::{System, Values, subsets};
use crate::linalg::span::left_kernel;

/// Settles what it can, more and more unknowns; returns the steps. The values of unknowns that
/// are settled are entered. At most C(r, 4) eliminations for each step, r rows with unknowns.
pub(super) fn settle(system: &System<'_>, values: &mut Values) -> Vec<Linear> {
    let mut steps = Vec::new();
    while values.contains(&None) {
        let Some(step) = step(system, values) else {
            break;
        };
        steps.push(step);
    }
    steps
}

fn step(system: &System<'_>, values: &mut Values) -> Option<Linear> {
    let single = |&row: &usize| {
        system.rows[row]
            .unknowns()
            .filter(|&f| values[f].is_none())
            .count()
            == 1
    };
    let scaled: Vec<usize> = system.scaled(values).into_iter().filter(single).collect();
    let mut found = None;
    for size in (1..=4.min(scaled.len())).rev() {
        subsets(&scaled, size, &mut |freed| {
            found = apply(system, values, freed);
            found.is_none() && !system.is_stopped()
        });
        if found.is_some() {
            break;
        }
    }
    let (step, settled) = found?;
    for (f, value) in settled {
        values[f] = Some(value);
    }
    Some(step)
}

/// The step with these rows freed, and what it settles; nothing if the left kernel is too large.
fn apply(
    system: &System<'_>,
    values: &Values,
    freed: &[usize],
) -> Option<(Linear, Vec<(usize, u64)>)> {
    let field = &system.field;
    let constant = (0..system.rows.len()).filter(|&row| system.is_constant(row, values));
    let mut rows: Vec<Vec<u64>> = constant.map(|row| system.constant(row, values)).collect();
    let others = rows.len();
    // Fewer rows than this have no left kernel where the rank is 3 n' - 4.
    let least = (others + freed.len())
        .checked_sub(system.target)
        .filter(|&least| least > 0)?;
    for &row in freed {
        let sides = [0, 1].map(|which| {
            let mut side = system.rows[row].side(which, system.columns);
            let scale = system.rows[row].sides[which].scale;
            if let Some(value) = scale.and_then(|f| values[f]) {
                side.iter_mut().for_each(|x| *x = field.times(*x, value));
            }
            side
        });
        rows.extend(sides);
    }
    let kernel = left_kernel(field, &rows, system.columns);
    if kernel.len() != least {
        return None;
    }
    let mut settled: Vec<(usize, u64)> = Vec::new();
    for (k, &row) in freed.iter().enumerate() {
        let at = others + 2 * k;
        let sides = &system.rows[row].sides;
        let plus_is_unknown = sides[0].scale.is_some_and(|f| values[f].is_none());
        // mu (x plus - y minus) with one of x, y unknown and in the kernel (mu x, - mu y).
        let (known, unknown) = if plus_is_unknown {
            (at + 1, at)
        } else {
            (at, at + 1)
        };
        let f = sides[usize::from(!plus_is_unknown)].scale?;
        let Some(vector) = kernel.iter().find(|vector| vector[known] != 0) else {
            continue;
        };
        let value = field.negate(field.times(vector[unknown], field.inverse(vector[known])?));
        // The other row of an edge may have said so before; where it says something else, no
        // solution is near.
        match settled.iter().find(|&&(g, _)| g == f) {
            Some(&(_, said)) if said != value => return None,
            Some(_) => {}
            None => settled.push((f, value)),
        }
    }
    if settled.is_empty() {
        return None;
    }
    let step = Linear {
        freed: freed.to_vec(),
        settled: settled.iter().map(|&(f, _)| f).collect(),
    };
    Some((step, settled))
}
