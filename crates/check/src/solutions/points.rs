//! The points to which solutions come near, at one assignment of centres: conditions (S17), (S18) and
//! the first part of (S18b) of section 12 (theory, Theorems 10.8, 10.13 and 10.21).

use super::chart::Chart;
use super::outside;
use super::spurious;
use super::support::{Span, Text, sum};
use super::system::{Known, System, ensure_all_known};
use crate::algebra::{Field, Ring};
use crate::document::solutions::{Point, Points, Term};
use crate::elimination::Echelon;
use crate::limits::Meter;
use crate::rejection::{Checked, Failure, Within, ensure};
use std::collections::HashSet;

/// Verifies that there are no more solutions than points, and returns how many these are.
pub(super) fn check(text: &Points, chart: &Chart, known: &Known, meter: &Meter) -> Checked<usize> {
    let system = System::new(chart, &text.centres, meter).within(|| "centres".into())?;
    // What steps made known is one, at these centres as well.
    let one = system.field.one;
    let known: Known = known.iter().map(|value| value.map(|_| one)).collect();
    let span = Span::new(
        &system,
        &known,
        Text {
            unknowns: &text.unknowns,
            bounds: &text.bounds,
            absent: &text.absent,
            minors: &text.minors,
        },
    )?;
    let mut found = Found {
        form: Form::new(text.form.0.as_deref(), &system, &span)?,
        values: Echelon::new(&system.field, span.is_present.len(), meter),
        points: 0,
        ratios: HashSet::new(),
        system: &system,
        span: &span,
    };
    for (k, point) in text.points.iter().enumerate() {
        let checked = found.add_point(point, text, &known);
        checked.within(|| format!("points[{k}]"))?;
    }
    for (k, point) in text.outside.0.iter().flatten().enumerate() {
        let limits = outside::check(point, &text.unknowns, &known, &system);
        let added = limits.and_then(|limits| found.add(&limits));
        added.within(|| format!("outside[{k}]"))?;
    }
    for (k, point) in text.spurious.0.iter().flatten().enumerate() {
        let limits = spurious::limits(point, &text.unknowns, &system);
        let checked = limits.and_then(|limits| {
            found.add(&limits)?;
            found.tells_all(&limits)?;
            spurious::check(point, &text.unknowns, &limits, &known, &system)
        });
        checked.within(|| format!("spurious[{k}]"))?;
    }
    found.conclude()?;
    Ok(text.points.len())
}

/// A form, by which kernel vectors are told apart.
struct Form {
    /// Monomials without squares, with their weights.
    terms: Vec<(Vec<usize>, u64)>,
    /// The exponents of which the products with all these monomials are in A: A'.
    inner: Vec<Vec<usize>>,
}

impl Form {
    fn new(text: Option<&[Term]>, system: &System, span: &Span) -> Checked<Form> {
        let unknowns = span.exponents.bounds.len();
        let unit =
            |f: usize| -> Vec<usize> { (0..unknowns).map(|g| usize::from(f == g)).collect() };
        // The last of these is zero.
        let least: Vec<Vec<usize>> = (0..=unknowns).map(unit).collect();
        let terms = match text {
            None => {
                let weight = |k: usize| if k == unknowns { system.field.one } else { 0 };
                let terms = least.into_iter().enumerate();
                terms.map(|(k, exponent)| (exponent, weight(k))).collect()
            }
            Some(text) => {
                check_form(text, &least)?;
                let weights = text.iter().map(|term| {
                    let weight = system.residues(std::slice::from_ref(&term.weight))?;
                    Ok((term.exponent.clone(), weight[0]))
                });
                weights.collect::<Checked<Vec<_>>>()?
            }
        };
        system
            .meter
            .charge((span.is_present.len() * terms.len()) as u64)?;
        let mut inner = span.all_present();
        inner.retain(|a| terms.iter().all(|(d, _)| span.has_sum(a, d)));
        Ok(Form { terms, inner })
    }
}

/// Monomials without squares, each once, among them one and all unknowns.
fn check_form(text: &[Term], least: &[Vec<usize>]) -> Checked<()> {
    let listed: HashSet<&Vec<usize>> = text.iter().map(|term| &term.exponent).collect();
    let unknowns = least.len() - 1;
    ensure!(
        listed.len() == text.len()
            && least.iter().all(|exponent| listed.contains(exponent))
            && listed
                .iter()
                .all(|d| d.len() == unknowns && d.iter().all(|&e| e <= 1)),
        "`form` has not one, each unknown and other products of different unknowns, each once"
    );
    Ok(())
}

/// Points, of which each has a vector that all minors annihilate.
struct Found<'a> {
    form: Form,
    /// What the form gives at each, at the inner exponents.
    values: Echelon<'a>,
    points: usize,
    /// What the monomials of the form are, divided by it, at each.
    ratios: HashSet<Vec<u64>>,
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
        let limits: Vec<Option<u64>> = values.iter().copied().map(Some).collect();
        self.add(&limits)?;
        let mut known = known.clone();
        for (&f, &value) in text.unknowns.iter().zip(&values) {
            known[f] = Some(value);
        }
        spurious::follow(&point.steps, self.system, &mut known)?;
        ensure_all_known(&known)
    }

    /// (S18b): each value is that of a quotient of entries of the vector.
    fn tells_all(&self, limits: &[Option<u64>]) -> Checked<()> {
        let (field, span) = (&self.system.field, self.span);
        let bounds = span.exponents.bounds;
        let present = span.all_present();
        for (f, limit) in limits.iter().enumerate() {
            self.system
                .meter
                .charge((present.len() * limits.len()) as u64)?;
            let unit: Vec<usize> = (0..limits.len()).map(|g| usize::from(f == g)).collect();
            let tells = |a: &Vec<usize>| {
                let next = sum(a, &unit);
                let at = if limit.is_some() { a } else { &next };
                span.has_sum(a, &unit) && monomial(field, at, limits, bounds) != 0
            };
            ensure!(
                present.iter().any(tells),
                "no exponents tell the value of unknown {f} of the list"
            );
        }
        Ok(())
    }

    /// (S17) for a point, of which values may be infinite.
    fn add(&mut self, limits: &[Option<u64>]) -> Checked<()> {
        let (field, span) = (&self.system.field, self.span);
        // Points are independent, so that no more than these can be right.
        ensure!(
            self.points < span.present(),
            "there are more points than exponents"
        );
        self.points += 1;
        let mut vector = vec![0; span.is_present.len()];
        for exponent in span.all_present() {
            let bounds = span.exponents.bounds;
            vector[span.exponents.place(&exponent)] = monomial(field, &exponent, limits, bounds);
        }
        ensure!(
            span.shifts.annihilates(&vector)?,
            "a minor does not vanish at the point"
        );
        let at = |a: &[usize], d: &[usize]| vector[span.exponents.place(&sum(a, d))];
        let value = |a: &Vec<usize>| {
            let terms = self.form.terms.iter();
            terms.fold(0, |sum, (d, weight)| {
                field.add(sum, field.mul(*weight, at(a, d)))
            })
        };
        let values: Vec<u64> = self.form.inner.iter().map(value).collect();
        let nonzero = self.form.inner.iter().zip(&values);
        let nonzero = nonzero.into_iter().find(|&(_, &value)| value != 0);
        let missing = || Failure::rejected("the form vanishes at the point");
        let (a, &value) = nonzero.ok_or_else(missing)?;
        let inverse = field.inverse(value);
        let ratio = |(d, _): &(Vec<usize>, u64)| field.mul(inverse, at(a, d));
        let ratios: Vec<u64> = self.form.terms.iter().map(ratio).collect();
        ensure!(
            self.ratios.insert(ratios),
            "the form does not tell the point from another one"
        );
        self.values.push(values.into_iter().enumerate(), None)?;
        Ok(())
    }

    /// (S17) for all points together.
    fn conclude(self) -> Checked<()> {
        let (span, points) = (self.span, self.points);
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

/// The value of a monomial. Zero to the power of zero is one; of an infinite value the highest power
/// is one, and the others are zero.
fn monomial(field: &Field, exponent: &[usize], limits: &[Option<u64>], bounds: &[usize]) -> u64 {
    let powers = exponent.iter().zip(limits).zip(bounds);
    powers.fold(field.one, |product, ((&e, limit), &bound)| match *limit {
        Some(value) => (0..e).fold(product, |product, _| field.mul(product, value)),
        None if e == bound => product,
        None => 0,
    })
}
