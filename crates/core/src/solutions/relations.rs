//! Relations between rows of N(u) at a point (docs/theory.md, Theorem 10.22): where equations repeat what
//! others say, a simple point of a core that is not tight may still be one of generic cameras.
//!
//! In: a point. Out: as many sets of rows as the rank is below their number, each with one relation, such
//! that what they ask of the unknowns are as many equations as there are unknowns.

use super::evidence::Relation;
use super::system::System;
use crate::linalg::span::{Span, left_kernel};
use std::collections::BTreeSet;

/// The relations at a point, those of hubs first; `None` if they are too few or ask too much.
pub(super) fn relations(system: &System<'_>, values: &[u64]) -> Option<Vec<Relation>> {
    let field = &system.field;
    let all: Vec<usize> = (0..system.rows.len()).collect();
    let nodes = system.core.left_nodes();
    let touches = |row: usize, node: usize| system.rows[row].sides.iter().any(|s| s.node == node);
    let is_constant = |row: usize| system.rows[row].unknowns().next().is_none();
    let of_hub = |hub: usize| {
        let rows = all.iter().copied();
        rows.filter(move |&row| is_constant(row) || touches(row, hub))
            .collect::<Vec<_>>()
    };
    let hubs = (0..nodes.len()).map(|hub| (Some(hub), of_hub(hub)));
    let needed = all.len().checked_sub(system.target)?;
    let (mut found, mut equations) = (Vec::with_capacity(needed), 0);
    let mut independent = Span::default();
    for (hub, rows) in hubs.chain([(None, all.clone())]) {
        let vectors: Vec<Vec<u64>> = rows
            .iter()
            .map(|&row| system.rows[row].at(field, system.columns, |f| values[f]))
            .collect();
        // Each vector of this basis is one at a row where the others are zero, and zero at all other such
        // rows: no relation between fewer of its rows is there.
        for weights in left_kernel(field, &vectors, system.columns) {
            let mut relation = vec![0; all.len()];
            for (&row, &weight) in rows.iter().zip(&weights) {
                relation[row] = weight;
            }
            let own: Vec<usize> = all
                .iter()
                .copied()
                .filter(|&row| relation[row] != 0)
                .collect();
            if found.len() == needed || !independent.insert(field, relation) {
                continue;
            }
            let sides = own.iter().flat_map(|&row| &system.rows[row].sides);
            let touched: BTreeSet<usize> = sides.map(|side| side.node).collect();
            equations += 3 * touched.len() + 1 - own.len() - usize::from(hub.is_some());
            found.push(Relation {
                rows: own,
                hub: hub.map(|hub| nodes[hub]),
            });
        }
    }
    (found.len() == needed && equations == system.core.unknowns).then_some(found)
}
