//! Biconnected components: Hopcroft and Tarjan (1973), without recursion.
//!
//! A *biconnected component* with three vertices or more is a maximal subgraph that stays
//! connected without any one of its vertices; every other edge is one by itself (a *bridge*). Two
//! components share at most one vertex, an *articulation*.

use super::lists::Lists;

const UNSEEN: u32 = u32::MAX;

/// Hands the vertices of every biconnected component to `each`, in an order that depends on
/// nothing but the lists. Vertices without neighbours are in none.
///
/// `neighbours` holds every edge in the lists of both its ends. O(vertices + edges).
///
/// ```
/// use viewcert::graph::{Lists, biconnected_components};
///
/// // A triangle 0, 1, 2 and a bridge from 2 to 3.
/// let edges = [(0, 1), (0, 2), (1, 2), (2, 3)];
/// let both = edges.into_iter().flat_map(|(i, j)| [(i, j), (j, i)]);
/// let mut found = Vec::new();
/// biconnected_components(&Lists::group(4, both), |component| {
///     let mut component = component.to_vec();
///     component.sort_unstable();
///     found.push(component);
/// });
/// assert_eq!(found, [vec![2, 3], vec![0, 1, 2]]);
/// ```
pub fn biconnected_components(neighbours: &Lists, mut each: impl FnMut(&[u32])) {
    let mut search = Search::new(neighbours);
    for root in 0..neighbours.len() as u32 {
        if search.number[root as usize] == UNSEEN {
            search.from(root, &mut each);
        }
    }
}

struct Search<'a> {
    neighbours: &'a Lists,
    /// When a vertex was met.
    number: Vec<u32>,
    /// The earliest vertex that it and those below it reach.
    low: Vec<u32>,
    met: u32,
    /// Vertices met but not yet in a finished component, besides the one that this hangs on.
    open: Vec<u32>,
    /// The way to the current vertex, with the next neighbour to look at.
    path: Vec<(u32, usize)>,
}

impl<'a> Search<'a> {
    fn new(neighbours: &'a Lists) -> Self {
        Self {
            neighbours,
            number: vec![UNSEEN; neighbours.len()],
            low: vec![UNSEEN; neighbours.len()],
            met: 0,
            open: Vec::new(),
            path: Vec::new(),
        }
    }

    /// Searches what is connected with a vertex not met so far.
    fn from(&mut self, root: u32, each: &mut impl FnMut(&[u32])) {
        self.meet(root);
        while let Some((v, at)) = self.path.last_mut() {
            let v = *v;
            let next = self.neighbours.of(v as usize).get(*at);
            *at += 1;
            match next {
                Some(&w) if self.number[w as usize] == UNSEEN => self.meet(w),
                Some(&w) => self.lower(v, self.number[w as usize]),
                None => {
                    self.path.pop();
                    self.leave(v, each);
                }
            }
        }
        // What is left is the root.
        self.open.clear();
    }

    fn meet(&mut self, v: u32) {
        self.number[v as usize] = self.met;
        self.low[v as usize] = self.met;
        self.met += 1;
        self.open.push(v);
        self.path.push((v, 0));
    }

    fn lower(&mut self, v: u32, to: u32) {
        let low = &mut self.low[v as usize];
        *low = (*low).min(to);
    }

    /// All neighbours of a vertex have been looked at.
    fn leave(&mut self, v: u32, each: &mut impl FnMut(&[u32])) {
        let Some(&(parent, _)) = self.path.last() else {
            return;
        };
        let low = self.low[v as usize];
        self.lower(parent, low);
        if low >= self.number[parent as usize] {
            // Nothing from v on reaches beyond its parent: they are a component with it.
            let from = self.open.iter().rposition(|&w| w == v).expect("v is open");
            self.open.push(parent);
            each(&self.open[from..]);
            self.open.truncate(from);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::UnionFind;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    fn lists(nodes: usize, edges: &BTreeSet<(u32, u32)>) -> Lists {
        let both = edges.iter().flat_map(|&(i, j)| [(i, j), (j, i)]);
        Lists::group(nodes, both)
    }

    fn connected_without(nodes: usize, edges: &BTreeSet<(u32, u32)>, v: u32) -> UnionFind {
        let mut sets = UnionFind::new(nodes);
        for &(i, j) in edges {
            if i != v && j != v {
                sets.union(i as usize, j as usize);
            }
        }
        sets
    }

    /// By the definition: two edges at a vertex v are in one component iff their other ends are
    /// connected without v; this relation, closed, gives the components.
    fn by_definition(nodes: usize, edges: &BTreeSet<(u32, u32)>) -> BTreeSet<BTreeSet<u32>> {
        let list: Vec<(u32, u32)> = edges.iter().copied().collect();
        let mut classes = UnionFind::new(list.len());
        for v in 0..nodes as u32 {
            let mut sets = connected_without(nodes, edges, v);
            let at: Vec<(usize, u32)> = (0..)
                .zip(&list)
                .filter(|(_, (i, j))| *i == v || *j == v)
                .map(|(k, &(i, j))| (k, i + j - v))
                .collect();
            for &(k, a) in &at {
                for &(l, b) in &at {
                    if sets.find(a as usize) == sets.find(b as usize) {
                        classes.union(k, l);
                    }
                }
            }
        }
        let mut components = vec![BTreeSet::new(); list.len()];
        for (k, &(i, j)) in list.iter().enumerate() {
            components[classes.find(k)].extend([i, j]);
        }
        components
            .into_iter()
            .filter(|nodes| !nodes.is_empty())
            .collect()
    }

    proptest! {
        #[test]
        fn components_are_those_of_the_definition(
            pairs in proptest::collection::btree_set((0u32..9, 0u32..9), 0..16)
        ) {
            let edges: BTreeSet<(u32, u32)> =
                pairs.into_iter().filter(|(i, j)| i < j).collect();
            let mut found = BTreeSet::new();
            biconnected_components(&lists(9, &edges), |component| {
                let nodes: BTreeSet<u32> = component.iter().copied().collect();
                assert_eq!(nodes.len(), component.len(), "each vertex once");
                assert!(found.insert(nodes), "each component once");
            });
            prop_assert_eq!(found, by_definition(9, &edges));
        }
    }
}
