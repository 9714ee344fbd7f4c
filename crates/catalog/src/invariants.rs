//! Invariants of small graphs.

use super::canonical::canonical;
use super::multigraph::{Multigraph, bits};

/// What the catalog lists of a graph besides its verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Invariants {
    /// Degrees, falling.
    pub degrees: Vec<usize>,
    /// Length of a shortest cycle; `None` for a forest.
    pub girth: Option<usize>,
    /// Number of automorphisms.
    pub group_order: u64,
    /// Number of triangles.
    pub triangles: usize,
}

impl Invariants {
    /// The invariants of a simple graph. O(n m) and a canonical form.
    pub fn new(graph: &Multigraph) -> Self {
        let mut degrees: Vec<usize> = (0..graph.nodes()).map(|v| graph.degree(v)).collect();
        degrees.sort_unstable_by(|a, b| b.cmp(a));
        let common = |(u, v, _)| (graph.neighbours(u) & graph.neighbours(v)).count_ones();
        Self {
            degrees,
            girth: girth(graph),
            group_order: canonical(graph).group_order,
            triangles: graph.pairs().map(common).sum::<u32>() as usize / 3,
        }
    }
}

/// The length of a shortest cycle: a shortest path between the ends of an edge without
/// that edge, and the edge.
fn girth(graph: &Multigraph) -> Option<usize> {
    graph
        .pairs()
        .filter_map(|(u, v, _)| {
            let mut without = *graph;
            without.remove(u, v);
            let (mut reached, mut new, mut length) = (1u16 << u, 1u16 << u, 1);
            while new != 0 {
                if reached >> v & 1 == 1 {
                    return Some(length);
                }
                let next = bits(new).fold(0, |all, w| all | without.neighbours(w));
                new = next & !reached;
                reached |= new;
                length += 1;
            }
            None
        })
        .min()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_known_graphs() {
        let house = Multigraph::with_pairs(5, &[(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4)]);
        let expected = Invariants {
            degrees: vec![3, 3, 2, 2, 2],
            girth: Some(3),
            group_order: 2,
            triangles: 1,
        };
        assert_eq!(Invariants::new(&house), expected);
        let bipartite =
            Multigraph::with_pairs(5, &[(0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (1, 4)]);
        let found = Invariants::new(&bipartite);
        assert_eq!(
            (found.girth, found.triangles, found.group_order),
            (Some(4), 0, 12)
        );
        let path = Multigraph::with_pairs(3, &[(0, 1), (1, 2)]);
        assert_eq!(Invariants::new(&path).girth, None);
        let complete: Vec<_> = (0..5).flat_map(|v| (0..v).map(move |u| (u, v))).collect();
        let found = Invariants::new(&Multigraph::with_pairs(5, &complete));
        assert_eq!((found.triangles, found.group_order), (10, 120));
    }
}
