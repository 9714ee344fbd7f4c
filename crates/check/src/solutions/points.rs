//! The points to which solutions come near, at one assignment of centres: conditions (S17) and (S18)
//! of section 12 (theory, Theorem 10.8).

use super::chart::Chart;
use super::dense::Space;
use super::grammar::{Point, Points, Step};
use super::linear;
use super::support::{Span, Text};
use super::system::{Known, System, ensure_all_known};
use crate::algebra::{Field, Ring};
use crate::limits::Meter;
use crate::rejection::{Checked, Failure, Within, ensure};

/// Verifies that there are no more solutions than points, and returns how many these are.
pub(super) fn check(
    points: &Points,
    chart: &Chart,
    known: &Known,
    meter: &Meter,
) -> Checked<usize> {
    let system = System::new(chart, &points.centres, meter).within(|| "centres".into())?;
    // What steps made known is one, at these centres as well.
    let one = system.field.one;
    let known: Known = known.iter().map(|value| value.map(|_| one)).collect();
    let span = Span::new(
        &system,
        &known,
        Text {
            unknowns: &points.unknowns,
            bounds: &points.bounds,
            absent: &points.absent,
            minors: &points.minors,
        },
    )?;
    let mut inner = Space::new(&system.field, span.is_present.len(), meter);
    for (k, point) in points.points.iter().enumerate() {
        let checked = check_point(point, points, &known, (&system, &span));
        let evaluation = checked.within(|| format!("points[{k}]"))?;
        inner.insert(restricted(&span, evaluation))?;
    }
    ensure!(
        inner.rank() == points.points.len(),
        "the points are not independent on the inner exponents"
    );
    ensure!(
        span.shifts.rank() + points.points.len() == span.present(),
        "{} points, where {} exponents less a rank of {} are asked for",
        points.points.len(),
        span.present(),
        span.shifts.rank()
    );
    Ok(points.points.len())
}

/// A point is one of the minors, and all other unknowns follow; returns the values of the monomials
/// in A, and zero at all others.
fn check_point(
    point: &Point,
    points: &Points,
    known: &Known,
    (system, span): (&System, &Span),
) -> Checked<Vec<u64>> {
    let values = system.residues(&point.values)?;
    ensure!(
        values.len() == points.unknowns.len(),
        "{} values for {} unknowns",
        values.len(),
        points.unknowns.len()
    );
    let mut evaluation = vec![0; span.is_present.len()];
    for exponent in span.all_present() {
        evaluation[span.exponents.place(&exponent)] = monomial(&system.field, &exponent, &values);
    }
    ensure!(
        span.shifts.annihilate(&evaluation)?,
        "a minor does not vanish at the point"
    );
    let mut known = known.clone();
    for (&f, &value) in points.unknowns.iter().zip(&values) {
        known[f] = Some(value);
    }
    settle(&point.steps, system, &mut known)?;
    Ok(evaluation)
}

/// (S18): at the point, steps make all other unknowns known.
fn settle(steps: &[Step], system: &System, known: &mut Known) -> Checked<()> {
    for (k, step) in steps.iter().enumerate() {
        let Step::Linear(step) = step else {
            return Err(Failure::rejected(format!("steps[{k}] is not `linear`")));
        };
        linear::check(step, system, known).within(|| format!("steps[{k}]"))?;
    }
    ensure_all_known(known)
}

/// The value of a monomial; zero to the power of zero is one.
fn monomial(field: &Field, exponent: &[usize], values: &[u64]) -> u64 {
    let powers = exponent.iter().zip(values);
    powers.fold(field.one, |product, (&e, &value)| {
        (0..e).fold(product, |product, _| field.mul(product, value))
    })
}

/// A vector on A', the exponents with all their next ones in A; zero elsewhere.
fn restricted(span: &Span, mut vector: Vec<u64>) -> Vec<u64> {
    for exponent in span.all_present() {
        let inner = (0..exponent.len()).all(|f| span.next(&exponent, f).is_some());
        if !inner {
            vector[span.exponents.place(&exponent)] = 0;
        }
    }
    vector
}
