//! The points to which solutions come near, at one assignment of centres: conditions (S17) and (S18) of
//! section 12 (theory, Theorem 10.8).

use super::chart::Chart;
use super::linear;
use super::span::Span;
use super::system::{Known, System, ensure_all_known};
use crate::algebra::{Field, Ring};
use crate::document::solutions::{Point, Points};
use crate::elimination::Echelon;
use crate::limits::Meter;
use crate::rejection::{Checked, Within, ensure};
use std::collections::HashSet;

/// Verifies that there are no more solutions than points, and returns how many these are.
pub(super) fn check(text: &Points, chart: &Chart, known: &Known, meter: &Meter) -> Checked<usize> {
    let system = System::new(chart, &text.centres, meter).within(|| "centres".into())?;
    // What steps made known is one, at these centres as well.
    let one = system.field.one;
    let known: Known = known.iter().map(|value| value.map(|_| one)).collect();
    let span = Span::new(&system, &known, text)?;
    let mut found = Found {
        inner: inner(&system, &span)?,
        values: Echelon::new(&system.field, span.is_present.len(), meter),
        points: HashSet::new(),
        system: &system,
        span: &span,
    };
    for (k, point) in text.points.iter().enumerate() {
        let checked = found.add_point(point, text, &known);
        checked.within(|| format!("points[{k}]"))?;
    }
    found.conclude()?;
    Ok(text.points.len())
}

/// The exponents of which the products with all unknowns are in A: A'.
fn inner(system: &System, span: &Span) -> Checked<Vec<Vec<usize>>> {
    let unknowns = span.exponents.bounds.len();
    let work = span.is_present.len() * (unknowns + 1);
    system.meter.charge(work as u64)?;
    let unit = |f: usize| -> Vec<usize> { (0..unknowns).map(|g| usize::from(f == g)).collect() };
    let units: Vec<Vec<usize>> = (0..unknowns).map(unit).collect();
    let mut inner = span.all_present();
    inner.retain(|a| units.iter().all(|unit| span.has_sum(a, unit)));
    Ok(inner)
}

/// Points, of which each has a vector that all minors annihilate.
struct Found<'a> {
    /// A'.
    inner: Vec<Vec<usize>>,
    /// What the vectors are there.
    values: Echelon<'a>,
    points: HashSet<Vec<u64>>,
    system: &'a System<'a>,
    span: &'a Span<'a>,
}

impl Found<'_> {
    /// A point to which solutions may come near: all other unknowns follow (S18).
    fn add_point(&mut self, point: &Point, text: &Points, known: &Known) -> Checked<()> {
        let values = self.system.residues(&point.values)?;
        ensure!(
            values.len() == text.unknowns.len(),
            "{} values for {} unknowns",
            values.len(),
            text.unknowns.len()
        );
        self.add(&values)?;
        let mut known = known.clone();
        for (&f, &value) in text.unknowns.iter().zip(&values) {
            known[f] = Some(value);
        }
        linear::check_all(&point.steps, self.system, &mut known)?;
        ensure_all_known(&known)
    }

    /// (S17) for a point.
    fn add(&mut self, point: &[u64]) -> Checked<()> {
        let (field, span) = (&self.system.field, self.span);
        // Points are independent, so that no more than these can be right.
        ensure!(
            self.points.len() < span.present(),
            "there are more points than exponents"
        );
        ensure!(
            self.points.insert(point.to_vec()),
            "the point is there twice"
        );
        let mut vector = vec![0; span.is_present.len()];
        for exponent in span.all_present() {
            vector[span.exponents.place(&exponent)] = monomial(field, &exponent, point);
        }
        ensure!(
            span.shifts.annihilates(&vector)?,
            "a minor does not vanish at the point"
        );
        let values = self.inner.iter().map(|a| vector[span.exponents.place(a)]);
        self.values.push(values.enumerate(), None)?;
        Ok(())
    }

    /// (S17) for all points together.
    fn conclude(self) -> Checked<()> {
        let (span, points) = (self.span, self.points.len());
        ensure!(
            self.values.rank() == points,
            "the points are not independent on the inner exponents"
        );
        ensure!(
            span.shifts.rank() + points == span.present(),
            "{points} points, where {} exponents less a rank of {} are asked for",
            span.present(),
            span.shifts.rank()
        );
        Ok(())
    }
}

/// The value of a monomial. Zero to the power of zero is one.
fn monomial(field: &Field, exponent: &[usize], point: &[u64]) -> u64 {
    let powers = exponent.iter().zip(point);
    powers.fold(field.one, |product, (&e, &value)| {
        (0..e).fold(product, |product, _| field.mul(product, value))
    })
}
