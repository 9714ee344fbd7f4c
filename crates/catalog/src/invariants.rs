//! Invariants of small graphs.

use super::label::{automorphisms, neighbours};
use viewcert::graph::Graph;

/// What is counted of a graph besides its verdict.
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
    /// The invariants of a graph; `None` if it has too many nodes for a label. O(n m), and as
    /// [`greatest`](super::label::greatest).
    pub fn new(graph: &Graph) -> Option<Self> {
        let group_order = automorphisms(graph)?;
        let around = &neighbours(graph)[..graph.nodes()];
        let mut degrees: Vec<usize> = around.iter().map(|set| set.count_ones() as usize).collect();
        degrees.sort_unstable_by(|a, b| b.cmp(a));
        let common = |&(u, v): &(u32, u32)| (around[u as usize] & around[v as usize]).count_ones();
        Some(Self {
            degrees,
            girth: graph
                .edges()
                .iter()
                .filter_map(|&pair| cycle(around, pair))
                .min(),
            group_order,
            triangles: graph.edges().iter().map(common).sum::<u32>() as usize / 3,
        })
    }
}

/// The length of a shortest cycle with a pair: a shortest path between its ends without it, and the pair.
fn cycle(around: &[u16], (u, v): (u32, u32)) -> Option<usize> {
    let (mut reached, mut new, mut length) = (1u16 << u, 1u16 << u, 1);
    while new != 0 {
        if reached >> v & 1 == 1 {
            return Some(length);
        }
        let of = |w: usize| match w == u as usize {
            true => around[w] & !(1 << v),
            false => around[w],
        };
        let next = (0..around.len())
            .filter(|w| new >> w & 1 == 1)
            .fold(0, |all, w| all | of(w));
        new = next & !reached;
        reached |= new;
        length += 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(nodes: u32, pairs: &[(u32, u32)]) -> Invariants {
        Invariants::new(&Graph::new(nodes, pairs.iter().copied()).unwrap()).unwrap()
    }

    #[test]
    fn of_known_graphs() {
        let expected = Invariants {
            degrees: vec![3, 3, 2, 2, 2],
            girth: Some(3),
            group_order: 2,
            triangles: 1,
        };
        assert_eq!(
            of(5, &[(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4)]),
            expected
        );
        let found = of(5, &[(0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (1, 4)]);
        assert_eq!(
            (found.girth, found.triangles, found.group_order),
            (Some(4), 0, 12)
        );
        assert_eq!(of(3, &[(0, 1), (1, 2)]).girth, None);
        let complete: Vec<_> = (0..5).flat_map(|v| (0..v).map(move |u| (u, v))).collect();
        let found = of(5, &complete);
        assert_eq!((found.triangles, found.group_order), (10, 120));
        // The Petersen graph: no two nodes can be exchanged by themselves.
        let outer = (0..5).map(|v| (v, (v + 1) % 5));
        let inner = (0..5).map(|v| (5 + v, 5 + (v + 2) % 5));
        let petersen: Vec<_> = outer
            .chain(inner)
            .chain((0..5).map(|v| (v, v + 5)))
            .collect();
        let found = of(10, &petersen);
        assert_eq!((found.girth, found.group_order), (Some(5), 120));
    }
}
