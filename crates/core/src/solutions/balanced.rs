//! Minors that are balanced: with their shift, every node is taken as often in each term (docs/theory.md,
//! Lemma 10.24).
//!
//! A term of a minor takes one side of each row that is whole and both of each that is freed. With a shift
//! that takes the one side of a row left out, and of both sides of a freed row gives the one back, it is a
//! choice of a side of each row of N(u). Where all minors take each node as often, the exponents are
//! few: those of a transport from rows to nodes, the same in every chart.

use super::minors::{Minors, Polynomial};
use super::system::{System, Values};
use std::collections::BTreeSet;

/// A source of balanced minors.
pub(super) struct Balanced<'a> {
    system: &'a System<'a>,
    /// How much less than three times each node is taken.
    lacking: Vec<usize>,
    /// How many rows are left out of a minor.
    out: usize,
    /// For each node the rows with a side there, and which one.
    at: Vec<Vec<(usize, usize)>>,
    state: u64,
    drawn: BTreeSet<Draw>,
}

/// Rows with one of their sides, and columns.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Draw {
    /// Rows left out; the shift takes this side.
    out: Vec<(usize, usize)>,
    /// Rows freed; the shift gives this side back.
    freed: Vec<(usize, usize)>,
}

/// A minor has so many rows freed, and all columns.
const FREED: usize = 3;

impl<'a> Balanced<'a> {
    /// `None` if N(u) has so many rows, or so few, that no minor takes all nodes three times or a little
    /// less. `which` says where less.
    pub(super) fn new(system: &'a System<'a>, which: usize) -> Option<Self> {
        let (rows, columns) = (system.rows.len(), system.columns);
        // 3 n' sides, two of each freed row and one of each that is whole.
        let out = (rows + FREED).checked_sub(columns)?;
        let mut lack = columns.checked_sub(rows)?;
        let mut at = vec![Vec::new(); columns / 3];
        for (row, sides) in system.rows.iter().map(|row| &row.sides).enumerate() {
            for (which, side) in sides.iter().enumerate() {
                at[side.node].push((row, which));
            }
        }
        let mut balanced = Self {
            system,
            lacking: vec![0; columns / 3],
            out,
            at,
            state: which as u64,
            drawn: BTreeSet::new(),
        };
        while lack > 0 {
            let node = balanced.below(columns / 3);
            if balanced.lacking[node] < 3 {
                balanced.lacking[node] += 1;
                lack -= 1;
            }
        }
        Some(balanced)
    }

    /// A minor with its shift, that was not drawn before; `None` if it was, or if it vanishes.
    pub(super) fn draw(
        &mut self,
        minors: &Minors<'_>,
        values: &Values,
        unknowns: &[usize],
    ) -> Option<Polynomial> {
        let draw = self.choose()?;
        if !self.drawn.insert(draw.clone()) {
            return None;
        }
        let rows = |list: &[(usize, usize)]| list.iter().map(|&(row, _)| row).collect::<Vec<_>>();
        let mut found = minors.single(&rows(&draw.freed), &rows(&draw.out))?;
        let kept = draw.freed.iter().map(|&(row, side)| (row, 1 - side));
        let mut shift = vec![0; unknowns.len()];
        for (row, side) in kept.chain(draw.out.iter().copied()) {
            let scale = self.system.rows[row].sides[side].scale;
            if let Some(f) = scale.filter(|&f| values[f].is_none()) {
                shift[unknowns.iter().position(|&g| g == f)?] += 1;
            }
        }
        found.minor.shifts = Some(vec![shift]);
        Some(found)
    }

    fn choose(&mut self) -> Option<Draw> {
        let mut draw = Draw {
            out: Vec::with_capacity(self.out),
            freed: Vec::with_capacity(FREED),
        };
        let mut lacking = self.lacking.clone();
        for _ in 0..self.out {
            let row = self.below(self.system.rows.len());
            let side = self.below(2);
            if draw.out.iter().any(|&(other, _)| other == row) {
                return None;
            }
            lacking[self.system.rows[row].sides[side].node] += 1;
            draw.out.push((row, side));
        }
        // Three columns are lacking now; each is made good by a freed row.
        let places = (0..lacking.len()).flat_map(|node| vec![node; lacking[node]]);
        for node in places {
            let choice = self.below(self.at[node].len());
            let (row, side) = self.at[node][choice];
            let mut used = draw.out.iter().chain(&draw.freed);
            if used.any(|&(other, _)| other == row) {
                return None;
            }
            draw.freed.push((row, side));
        }
        draw.out.sort_unstable();
        draw.freed.sort_unstable();
        Some(draw)
    }

    /// A number below a bound, which is positive, that looks random: Splitmix64 (Steele, Lea, Flood 2014).
    /// Which minors are drawn decides nothing but whether they are enough.
    fn below(&mut self, bound: usize) -> usize {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.state;
        mixed = (mixed ^ mixed >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^= mixed >> 31;
        (mixed % bound as u64) as usize
    }
}
