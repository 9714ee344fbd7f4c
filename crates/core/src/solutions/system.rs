//! N(u) at one assignment of centres modulo a prime, some of its unknowns known to be one.

use super::chart::{Core, Row};
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;
use crate::watch::Work;

/// The rows of N(u) at given centres.
pub(super) struct System<'a> {
    pub(super) field: PrimeField,
    pub(super) core: &'a Core,
    pub(super) centres: &'a [[u64; 3]],
    pub(super) rows: Vec<Row>,
    pub(super) columns: usize,
    /// 3 n' - 4, the rank at a solution.
    pub(super) target: usize,
    /// What may be stopped.
    work: Option<&'a Work<'a>>,
}

/// What is known of each unknown: its value at a point.
pub(super) type Values = Vec<Option<u64>>;

impl<'a> System<'a> {
    /// `None` if the centres are degenerate.
    pub(super) fn new(field: PrimeField, core: &'a Core, centres: &'a [[u64; 3]]) -> Option<Self> {
        Some(Self {
            field,
            core,
            centres,
            rows: core.rows(&field, centres)?,
            columns: core.columns(),
            target: core.target(),
            work: None,
        })
    }

    /// The same, for work that may be stopped.
    pub(super) fn under(self, work: &'a Work<'a>) -> Self {
        Self {
            work: Some(work),
            ..self
        }
    }

    /// Whether what is being computed will be thrown away.
    pub(super) fn is_stopped(&self) -> bool {
        self.work.is_some_and(Work::is_stopped)
    }

    /// The rows with an unknown that has no value.
    pub(super) fn scaled(&self, values: &Values) -> Vec<usize> {
        (0..self.rows.len())
            .filter(|&k| !self.is_constant(k, values))
            .collect()
    }

    pub(super) fn is_constant(&self, row: usize, values: &Values) -> bool {
        self.rows[row].unknowns().all(|f| values[f].is_some())
    }

    /// A row all of whose unknowns have values.
    pub(super) fn constant(&self, row: usize, values: &Values) -> Vec<u64> {
        self.rows[row].at(&self.field, self.columns, |f| values[f].unwrap_or_default())
    }

    /// All rows without unknowns that have no value, and which of them are independent.
    pub(super) fn constants(&self, values: &Values) -> (Span, Vec<usize>) {
        let mut span = Span::default();
        let mut used = Vec::new();
        for row in (0..self.rows.len()).filter(|&row| self.is_constant(row, values)) {
            if span.insert(&self.field, self.constant(row, values)) {
                used.push(row);
            }
        }
        (span, used)
    }

    /// Whether the rows of every body are independent where u = 1; those of a body with two nodes
    /// always are.
    pub(super) fn chains_are_independent(&self) -> bool {
        let ones = vec![Some(self.field.from_u64(1)); self.core.unknowns];
        let mut next = 0;
        self.core.row_counts().all(|count| {
            let mut span = Span::default();
            let mut rows = next..next + count;
            next += count;
            rows.all(|row| span.insert(&self.field, self.constant(row, &ones)))
        })
    }
}

/// Calls `each` with every subset of `items` that has `size` members, until it returns false;
/// returns whether it never did.
pub(super) fn subsets(
    items: &[usize],
    size: usize,
    each: &mut impl FnMut(&[usize]) -> bool,
) -> bool {
    fn extend(
        items: &[usize],
        size: usize,
        chosen: &mut Vec<usize>,
        each: &mut impl FnMut(&[usize]) -> bool,
    ) -> bool {
        if size == 0 {
            return each(chosen);
        }
        for k in 0..items.len() {
            if items.len() - k < size {
                break;
            }
            chosen.push(items[k]);
            let go_on = extend(&items[k + 1..], size - 1, chosen, each);
            chosen.pop();
            if !go_on {
                return false;
            }
        }
        true
    }
    extend(items, size, &mut Vec::with_capacity(size), each)
}
