//! Coefficients of minors that are zero for a hub: the second part of condition (S14) of section 12 (theory,
//! Theorem 10.23).
//!
//! A coefficient is a sum over choices of one side of each row with an unknown. Where what leads out of
//! some nodes leads to the hub alone, the differences of their centres from that of the hub are in
//! the kernel of what was chosen, wherever the centres are.

use super::dense::ENTRY;
use super::minors::Place;
use super::zeros::have_transversal;
use crate::document::solutions::Minor;
use crate::limits::Meter;
use crate::rejection::Checked;

/// A side of a row: its node, by the first column, and the places of its entries among the columns of the
/// minor.
struct End {
    node: usize,
    columns: Vec<usize>,
    /// The place of the unknown in the list.
    unknown: Option<usize>,
}

/// What is left of a row: both sides, or the one of these.
#[derive(Clone, Copy)]
enum Left {
    Both,
    One(usize),
}

/// The rows of a minor, with both sides.
pub(super) struct Hubs<'p> {
    rows: Vec<[End; 2]>,
    /// What is left of each row, as long as nothing is chosen.
    left: Vec<Left>,
    /// The rows of which a side is chosen.
    open: Vec<usize>,
    /// The nodes that are left in N(u), by the first column, and whether all three are in the minor.
    nodes: Vec<(usize, bool)>,
    columns: usize,
    meter: &'p Meter,
}

impl<'p> Hubs<'p> {
    pub fn new(minor: &Minor, place: &Place<'p>) -> Hubs<'p> {
        let has = |column: usize| minor.cols.binary_search(&column).is_ok();
        let mut hubs = Hubs {
            rows: Vec::new(),
            left: Vec::new(),
            open: Vec::new(),
            nodes: (0..place.system.columns)
                .step_by(3)
                .map(|node| (node, (node..node + 3).all(has)))
                .collect(),
            columns: minor.cols.len(),
            meter: place.system.meter,
        };
        let whole = minor.rows.iter().map(|&row| (row, Left::Both));
        let plus = minor.plus.iter().map(|&row| (row, Left::One(0)));
        let minus = minor.minus.iter().map(|&row| (row, Left::One(1)));
        for (row, left) in whole.chain(plus).chain(minus) {
            let listed = place.listed(row);
            if matches!(left, Left::Both) && listed != [None, None] {
                hubs.open.push(hubs.rows.len());
            }
            hubs.rows.push([0, 1].map(|which| {
                let side = &place.system.rows[row][which];
                let generic = (0..3).filter(|&k| side.is_generic[k]);
                let at = |k| minor.cols.binary_search(&(side.column + k)).ok();
                End {
                    node: side.column,
                    columns: generic.filter_map(at).collect(),
                    unknown: listed[which],
                }
            }));
            hubs.left.push(left);
        }
        hubs
    }

    /// Whether for each choice of sides, each unknown being that of as many as its exponent says, there is
    /// no transversal or a hub.
    pub fn are_in_all_choices(&self, exponent: &[usize]) -> Checked<bool> {
        self.all(&self.open, &mut exponent.to_vec(), &mut self.left.clone())
    }

    fn all(&self, open: &[usize], due: &mut [usize], left: &mut [Left]) -> Checked<bool> {
        self.meter.charge(1 + due.len() as u64)?;
        let Some((&row, rest)) = open.split_first() else {
            return Ok(due.iter().any(|&due| due > 0) || self.vanishes(left)?);
        };
        for which in [0, 1] {
            let unknown = self.rows[row][which].unknown;
            if unknown.is_some_and(|f| due[f] == 0) {
                continue;
            }
            unknown.into_iter().for_each(|f| due[f] -= 1);
            left[row] = Left::One(which);
            let vanish = self.all(rest, due, left)?;
            unknown.into_iter().for_each(|f| due[f] += 1);
            if !vanish {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether what is left has no transversal or a hub.
    fn vanishes(&self, left: &[Left]) -> Checked<bool> {
        let size = self.columns as u64;
        let nodes = self.nodes.len() as u64;
        self.meter.charge(ENTRY * size * (6 * size + nodes))?;
        let columns = |(row, left): (&[End; 2], &Left)| match *left {
            Left::Both => [&row[0].columns[..], &row[1].columns[..]].concat(),
            Left::One(which) => row[which].columns.clone(),
        };
        let rows: Vec<Vec<usize>> = self.rows.iter().zip(left).map(columns).collect();
        if !have_transversal(&rows, self.columns) {
            return Ok(true);
        }
        for &(hub, _) in &self.nodes {
            if self.has_closed_set(hub, left)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether there are nodes from which nothing leads to others but the hub.
    fn has_closed_set(&self, hub: usize, left: &[Left]) -> Checked<bool> {
        let mut is_open = vec![false; 3 * self.nodes.len()];
        for &(node, is_whole) in &self.nodes {
            is_open[node] = !is_whole;
        }
        for (ends, left) in self.rows.iter().zip(left) {
            if let Left::One(which) = *left {
                is_open[ends[which].node] |= ends[1 - which].node != hub;
            }
        }
        // A node that a row joins to one from which something leads out.
        let both = self.rows.iter().zip(left);
        let joined: Vec<[usize; 2]> = both
            .filter(|(_, left)| matches!(left, Left::Both))
            .map(|(ends, _)| [ends[0].node, ends[1].node])
            .filter(|ends| !ends.contains(&hub))
            .collect();
        loop {
            self.meter.charge(1 + joined.len() as u64)?;
            let mut is_more = false;
            for &[v, w] in &joined {
                is_more |= is_open[v] != is_open[w];
                let either = is_open[v] || is_open[w];
                (is_open[v], is_open[w]) = (either, either);
            }
            if !is_more {
                let mut nodes = self.nodes.iter();
                return Ok(nodes.any(|&(node, _)| node != hub && !is_open[node]));
            }
        }
    }
}
