//! `pinching` (section 7 of the specification): independent rows of the plane direction matrix R
//! without arithmetic. A set of edges is built step by step, as Henneberg builds frameworks, and
//! stays (2,3)-sparse.

use crate::core::Core;
use crate::document::Pinching;
use crate::elimination::SPARSE;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::{Lower, Setting};
use std::collections::HashSet;

/// What the search for an edge among those that are there counts as, in steps of sorting.
const SEARCH: u64 = 8;

/// Verifies `pinching`: the core edges that are there at the end are independent (theory, Lemma
/// 13.5 and Corollary 13.12).
pub(crate) fn check_pinching(
    evidence: &Pinching,
    setting: &Setting,
    core: &Core,
) -> Checked<Lower> {
    let searches = 4 * evidence.steps.len() + core.edges.len();
    setting.meter.charge(SEARCH * SPARSE * searches as u64)?;
    let mut built = Built::begin(evidence.start.map(|node| node as usize), core)?;
    for (k, step) in evidence.steps.iter().enumerate() {
        built.add(step).within(|| format!("steps[{k}]"))?;
    }
    let rows = core.edges.iter().filter(|edge| built.edges.contains(edge));
    let rows = rows.count() as i64;
    ensure!(
        rows == evidence.rank,
        "{rows} edges of the core are there at the end, not {}",
        evidence.rank
    );
    Ok(Lower {
        rank: 4 * rows,
        at: None,
        note: None,
    })
}

/// The nodes and edges that are there; an edge by its ends in increasing order.
struct Built {
    is_there: Vec<bool>,
    edges: HashSet<(usize, usize)>,
}

impl Built {
    /// Two nodes and their edge.
    fn begin([a, b]: [usize; 2], core: &Core) -> Checked<Built> {
        ensure!(
            a < b && b < core.nodes,
            "`start` is not two nodes of the core in increasing order"
        );
        let mut is_there = vec![false; core.nodes];
        (is_there[a], is_there[b]) = (true, true);
        let edges = HashSet::from([(a, b)]);
        Ok(Built { is_there, edges })
    }

    /// Adds a node z and joins it to up to three others; if it is three, the edge between the
    /// first two of them is pinched: z takes its place.
    fn add(&mut self, step: &[usize]) -> Checked<()> {
        let Some((&z, ends)) = step.split_first() else {
            return Err(Failure::rejected("no node is added"));
        };
        ensure!(
            ends.len() <= 3,
            "a node is joined to three others at most, not to {}",
            ends.len()
        );
        let is_there = self.is_there.get(z);
        ensure!(is_there.is_some(), "{z} is not a node of the core");
        ensure!(is_there != Some(&true), "node {z} is there already");
        for (k, &end) in ends.iter().enumerate() {
            let is_there = self.is_there.get(end) == Some(&true);
            ensure!(is_there, "node {end} is not there yet");
            ensure!(!ends[..k].contains(&end), "node {end} is named twice");
        }
        if let &[a, b, _] = ends {
            let pinched = self.edges.remove(&(a.min(b), a.max(b)));
            ensure!(pinched, "there is no edge between {a} and {b}");
        }
        let edges = ends.iter().map(|&end| (end.min(z), end.max(z)));
        self.edges.extend(edges);
        self.is_there[z] = true;
        Ok(())
    }
}

#[cfg(test)]
mod tests;
