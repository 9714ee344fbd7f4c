//! Connected graphs node by node, one of each isomorphism class.
//!
//! Canonical augmentation (B. D. McKay, *Isomorph-free exhaustive generation*, J.
//! Algorithms 26, 1998): every connected graph with two or more nodes has nodes whose removal
//! leaves it connected; the parent of a graph is the graph without the one of these that
//! has the largest degree and, among those, comes last in the canonical form. A
//! graph is accepted from its parent only, so only children of the same parent need to be
//! compared.

use super::canonical::{Canonical, canonical};
use super::multigraph::{Multigraph, bits};
use std::collections::HashSet;

/// Calls `each` for every connected graph with `nodes` nodes all of whose connected
/// induced subgraphs, itself included, `keep` accepts, until it returns false; returns whether
/// it never did. `keep` must not depend on the labels. Memory: the children of one
/// graph per number of nodes.
pub fn grow(
    nodes: usize,
    keep: &impl Fn(&Multigraph) -> bool,
    each: &mut impl FnMut(&Multigraph) -> bool,
) -> bool {
    let single = Multigraph::new(1);
    nodes == 0 || !keep(&single) || extend(&single, nodes, keep, each)
}

fn extend(
    parent: &Multigraph,
    nodes: usize,
    keep: &impl Fn(&Multigraph) -> bool,
    each: &mut impl FnMut(&Multigraph) -> bool,
) -> bool {
    if parent.nodes() == nodes {
        return each(parent);
    }
    let mut known = HashSet::new();
    let largest = (0..parent.nodes()).map(|v| parent.degree(v)).max();
    for neighbours in 1..=parent.all() {
        // Its degree must be the largest among the nodes that can be removed.
        let degree = neighbours.count_ones() as usize;
        if degree < largest.unwrap_or(0) && !may_be_largest(parent, neighbours, degree) {
            continue;
        }
        let mut child = *parent;
        child.add_node(neighbours);
        if !keep(&child) {
            continue;
        }
        let form = canonical(&child);
        if is_last(&child, &form) && known.insert(form.key) && !extend(&child, nodes, keep, each) {
            return false;
        }
    }
    true
}

/// Whether a node with these neighbours has a degree as large as those of the others that
/// can be removed from the child.
fn may_be_largest(parent: &Multigraph, neighbours: u16, degree: usize) -> bool {
    bits(parent.all()).all(|v| {
        let with = parent.degree(v) + usize::from(neighbours >> v & 1);
        with <= degree || {
            // Removing v must disconnect the child.
            let mut child = *parent;
            child.add_node(neighbours);
            !child.is_connected(child.all() & !(1 << v))
        }
    })
}

/// Whether an automorphism carries the newest node to the one whose removal gives the
/// parent.
fn is_last(child: &Multigraph, form: &Canonical) -> bool {
    let nodes = child.nodes();
    let newest = nodes - 1;
    let removable = |v: &usize| child.is_connected(child.all() & !(1 << v));
    let last = (0..nodes)
        .rev()
        .map(|k| usize::from(form.order[k]))
        .filter(removable)
        // The first of several largest ones: the last in canonical order.
        .reduce(|best, v| {
            if child.degree(v) > child.degree(best) {
                v
            } else {
                best
            }
        });
    let Some(last) = last else {
        return false;
    };
    let mut orbit = 1u16 << last;
    loop {
        let images = form
            .generators
            .iter()
            .flat_map(|g| bits(orbit).map(|v| 1u16 << g[v]))
            .fold(0, |all, image| all | image);
        if images & !orbit == 0 {
            return orbit >> newest & 1 == 1;
        }
        orbit |= images;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Connected graphs with n nodes: OEIS A001349.
    #[test]
    fn connected_graphs() {
        for (nodes, expected) in [(1, 1), (2, 1), (3, 2), (4, 6), (5, 21), (6, 112), (7, 853)] {
            let mut count = 0;
            grow(nodes, &|_| true, &mut |_| {
                count += 1;
                true
            });
            assert_eq!(count, expected, "{nodes} nodes");
        }
    }

    /// Trees: OEIS A000055.
    #[test]
    fn trees() {
        for (nodes, expected) in [(6, 6), (7, 11), (8, 23), (9, 47)] {
            let mut count = 0;
            grow(nodes, &|graph| graph.edges() < graph.nodes(), &mut |_| {
                count += 1;
                true
            });
            assert_eq!(count, expected, "{nodes} nodes");
        }
    }
}
