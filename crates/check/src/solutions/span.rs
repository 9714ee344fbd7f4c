//! The span of minors: conditions (S12) to (S14) of section 12 (theory, Theorem 10.8).

use super::dense::{ENTRY, Sparse};
use super::minors::{Exponents, Place};
use super::system::{Known, System};
use super::zeros::Pattern;
use crate::document::solutions::{Minor, Points};
use crate::elimination::Echelon;
use crate::rejection::{Checked, Failure, Within, ensure};
use std::collections::HashSet;

/// The coefficients of minors and their shifts.
pub(super) struct Span<'t> {
    pub exponents: Exponents<'t>,
    /// Which exponents are in A, in their order.
    pub is_present: Vec<bool>,
    pub shifts: Echelon<'t>,
}

impl<'t> Span<'t> {
    pub(super) fn new(system: &'t System, known: &Known, text: &'t Points) -> Checked<Span<'t>> {
        check_unknowns(&text.unknowns, known)?;
        ensure!(
            text.bounds.len() == text.unknowns.len(),
            "{} bounds for {} unknowns",
            text.bounds.len(),
            text.unknowns.len()
        );
        let constant = text.bounds.iter().position(|&bound| bound == 0);
        ensure!(
            constant.is_none(),
            "bounds[{}] is not positive",
            constant.unwrap_or_default()
        );
        let exponents = Exponents {
            bounds: &text.bounds,
        };
        let many = || Failure::rejected("there are more than 4096 exponents");
        let count = exponents.count().ok_or_else(many)?;
        let mut span = Span {
            is_present: is_present(&exponents, count, &text.absent)?,
            shifts: Echelon::new(&system.field, count, system.meter),
            exponents,
        };
        let place = Place {
            system,
            known,
            unknowns: &text.unknowns,
        };
        for (k, minor) in text.minors.iter().enumerate() {
            let added = span.add(minor, &place);
            added.within(|| format!("minors[{k}]"))?;
        }
        Ok(span)
    }

    /// |A|.
    pub(super) fn present(&self) -> usize {
        self.is_present.iter().filter(|&&present| present).count()
    }

    /// Whether the sum of two exponents is in A.
    pub(super) fn has_sum(&self, a: &[usize], b: &[usize]) -> bool {
        let sum = sum(a, b);
        self.exponents.contain(&sum) && self.is_present[self.exponents.place(&sum)]
    }

    /// A.
    pub(super) fn all_present(&self) -> Vec<Vec<usize>> {
        let all = self.exponents.all().into_iter().zip(&self.is_present);
        all.filter_map(|(exponent, &present)| present.then_some(exponent))
            .collect()
    }

    /// Adds the coefficients of the shifts of a minor.
    fn add(&mut self, minor: &Minor, place: &Place) -> Checked<()> {
        let degrees = place.check(minor, self.exponents.bounds)?;
        let room = self.exponents.bounds.iter().zip(&degrees);
        let room: Vec<usize> = room.map(|(bound, degree)| bound - degree).collect();
        let shifts = Exponents { bounds: &room }.all();
        let own = Exponents { bounds: &degrees }.all();
        let work = shifts.len() * own.len() * (degrees.len() + 1);
        place.system.meter.charge(ENTRY * work as u64)?;
        self.check_absent(minor, place, (&shifts, &own))?;
        let coefficients = place.coefficients(minor, &degrees)?;
        for shift in &shifts {
            let terms = own.iter().zip(&coefficients);
            let terms = terms.filter(|(_, coefficient)| **coefficient != 0);
            let place = |exponent| self.exponents.place(&sum(exponent, shift));
            let row: Sparse = terms.map(|(e, &entry)| (place(e), entry)).collect();
            self.shifts.push(row, None)?;
        }
        Ok(())
    }

    /// (S14): no shift has a coefficient at an exponent that is absent.
    fn check_absent(
        &self,
        minor: &Minor,
        place: &Place,
        (shifts, own): (&[Vec<usize>], &[Vec<usize>]),
    ) -> Checked<()> {
        if self.is_present.iter().all(|&present| present) {
            return Ok(());
        }
        let pattern = Pattern::new(minor, place);
        let entries = 6 * minor.cols.len() * minor.cols.len();
        for exponent in own {
            let mut shifted = shifts.iter().map(|shift| sum(exponent, shift));
            let Some(absent) = shifted.find(|e| !self.is_present[self.exponents.place(e)]) else {
                continue;
            };
            place.system.meter.charge(ENTRY * entries as u64)?;
            ensure!(
                !pattern.has_transversal(exponent),
                "the exponent {absent:?} is said to be absent, but there may be a coefficient"
            );
        }
        Ok(())
    }
}

/// (S12): unknowns that are not known, each once, and one at least.
fn check_unknowns(unknowns: &[usize], known: &Known) -> Checked<()> {
    ensure!(!unknowns.is_empty(), "no unknown is listed");
    let mut listed = HashSet::new();
    for &f in unknowns {
        let is_open = known.get(f).is_some_and(Option::is_none);
        ensure!(
            is_open && listed.insert(f),
            "unknown {f} is listed twice, or known, or none"
        );
    }
    Ok(())
}

/// Which exponents are in A (S12).
fn is_present(exponents: &Exponents, count: usize, absent: &[Vec<usize>]) -> Checked<Vec<bool>> {
    ensure!(
        absent.is_sorted_by(|a, b| a < b),
        "`absent` is not increasing"
    );
    let mut is_present = vec![true; count];
    for exponent in absent {
        ensure!(
            exponents.contain(exponent),
            "the exponent {exponent:?} of `absent` is not within the bounds"
        );
        is_present[exponents.place(exponent)] = false;
    }
    Ok(is_present)
}

/// The sum of two exponents.
pub(super) fn sum(a: &[usize], b: &[usize]) -> Vec<usize> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}
