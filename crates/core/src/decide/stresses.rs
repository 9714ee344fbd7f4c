//! The stresses of a core: the left kernel of its J_P at drawn centres, as far as it is needed.
//!
//! By Lemma 5.12 of docs/theory.md a stress is four plane flows, one for each column of the cameras,
//! that the left kernel of Lambda combines. There are 7 m - rank J_P independent ones, and a part D
//! of the edges has the rank 7 |D| less the dimension of the stresses that vanish outside of D.

use crate::contract::piece::Core;
use crate::geometry::plane_flow::PlaneFlows;
use crate::graph::UnionFind;
use crate::linalg::Ring;
use crate::linalg::dense_lu::eliminate_mod;
use crate::linalg::matrix::Matrix;
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;
use crate::linalg::textbook;
use crate::watch::{Stopped, Task};

/// A basis of the stresses, by what the members see of it.
pub(crate) struct Stresses<'a> {
    field: &'a PrimeField,
    dimension: usize,
    /// For each member what its edges see: vectors with an entry for each stress of the basis.
    of_member: Vec<Vec<Vec<u64>>>,
}

impl<'a> Stresses<'a> {
    /// The stresses at random centres, with the members that own the edges.
    pub(super) fn new(
        field: &'a PrimeField,
        core: &Core,
        members: usize,
        random: &mut dyn FnMut() -> u64,
        task: &Task,
    ) -> Result<Self, Stopped> {
        let quiet = task.untold();
        let centres: Vec<[u64; 3]> = (0..core.graph.nodes())
            .map(|_| std::array::from_fn(|_| random()))
            .collect();
        let flows = PlaneFlows::new(field, &core.graph, &centres, &quiet)?.flows(&quiet)?;
        let edges = core.graph.edges();
        // Lambda, transposed: entry (k, e) of the rows of a flow.
        let entry = |flow: &[[u64; 3]], e: usize, k: usize| match k {
            3 => field.neg(&field.dot(0, &flow[e], &centres[edges[e].1 as usize])),
            _ => flow[e][k],
        };
        let lambda = Matrix::from_fn(edges.len(), 4 * flows.len(), |e, row| {
            entry(&flows[row / 4], e, row % 4)
        });
        let kernel = eliminate_mod(field, lambda, &quiet)?.right_kernel();
        let dimension = kernel.rows();
        let mut spans = vec![Span::default(); members];
        for (e, &owner) in core.owner.iter().enumerate() {
            for (column, coordinate) in (0..4).flat_map(|k| (0..3).map(move |c| (k, c))) {
                let seen: Vec<u64> = (0..dimension)
                    .map(|s| {
                        let of_flow = |(f, flow): (usize, &Vec<[u64; 3]>)| {
                            field.mul(&kernel[(s, 4 * f + column)], &flow[e][coordinate])
                        };
                        let values = flows.iter().enumerate().map(of_flow);
                        values.fold(0, |sum, value| field.add(&sum, &value))
                    })
                    .collect();
                spans[owner as usize].insert(field, seen);
            }
        }
        Ok(Self {
            field,
            dimension,
            of_member: spans.into_iter().map(Span::into_basis).collect(),
        })
    }

    /// The finest partition of the members such that the stresses are the direct sum of those of its
    /// parts, as the number of each member's part: then the rank is the sum of the parts' ranks
    /// (Lemma 5.12), so a bound that meets it is a sum of bounds that do. A member that sees no
    /// stress, whose rows are independent of all others, is a part by itself.
    pub(super) fn parts(&self) -> Vec<usize> {
        let members = self.of_member.len();
        let owners = (0..members).flat_map(|k| self.of_member[k].iter().map(move |_| k));
        let owners: Vec<usize> = owners.collect();
        let columns: Vec<&Vec<u64>> = self.of_member.iter().flatten().collect();
        let seen = Matrix::from_fn(self.dimension, columns.len(), |s, k| columns[k][s]);
        // Of a direct sum each column depends on columns of its summand alone.
        let mut joined = UnionFind::new(members);
        for dependence in textbook::kernel(self.field, &seen) {
            let mut meets = dependence.iter().zip(&owners).filter(|(x, _)| **x != 0);
            if let Some((_, &first)) = meets.next() {
                meets.for_each(|(_, &other)| {
                    joined.union(first, other);
                });
            }
        }
        (0..members).map(|member| joined.find(member)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Contraction;
    use crate::contract::piece::Assembly;
    use crate::geometry::camera::normal_form;
    use crate::geometry::draw::DrawKey;
    use crate::geometry::jacobian::{dense, jacobian};
    use crate::graph::Graph;
    use crate::watch::unwatched;

    /// The rank of the whole J_P of some edges, at other centres.
    fn rank(nodes: u32, pairs: &[(u32, u32)]) -> usize {
        let field = PrimeField::mersenne61();
        let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
        let cameras: Vec<_> = (0..u64::from(nodes))
            .map(|v| {
                normal_form(
                    &field,
                    &[v * v + 2, 7 * v * v * v + v, 5 * v + 3 * v * v * v * v],
                )
            })
            .collect();
        let rows = jacobian(&field, &graph, &cameras);
        textbook::eliminate(&field, &dense(&field, &rows, 12 * nodes as usize)).rank()
    }

    /// Two K_{2,3} that share a node with a path between them, contracted by nothing: each has
    /// stresses of its own, and the path sees none.
    #[test]
    fn parts_by_hand() {
        let field = PrimeField::mersenne61();
        let bipartite =
            |a: u32, b: u32, c: [u32; 3]| c.into_iter().flat_map(move |v| [(a, v), (b, v)]);
        let one = bipartite(0, 1, [2, 3, 4]);
        let other = bipartite(4, 5, [6, 7, 8]);
        let path = [(0, 9), (9, 10), (5, 10)];
        let pairs: Vec<(u32, u32)> = one.chain(other).chain(path).collect();
        let graph = Graph::new(11, pairs.iter().map(|&(i, j)| (i.min(j), i.max(j)))).unwrap();
        let assembly = Assembly::new(&graph, &Contraction::none(&graph));
        let core = assembly.core(&assembly.all());
        let mut random = DrawKey {
            graph_sha256: [2; 32],
            core_sha256: None,
            seed: 1,
            draw: 0,
        }
        .residues(&field);
        let stresses =
            unwatched(|task| Stresses::new(&field, &core, pairs.len(), &mut random, task));
        // Each has 6 edges of rank 40 = 11 * 5 - 15 in all, and what comes together is dependent too.
        assert_eq!(stresses.dimension, 7 * pairs.len() - rank(11, &pairs));
        let parts = stresses.parts();
        for (k, &(i, j)) in core.graph.edges().iter().enumerate() {
            for (l, &(u, v)) in core.graph.edges().iter().enumerate() {
                let block = |i: u32, j: u32| match (i.max(j) <= 4, i.min(j) >= 4 && i.max(j) <= 8) {
                    (true, _) => 0,
                    (_, true) => 1,
                    _ => 2 + i.max(j) * 100 + i.min(j),
                };
                let same = parts[core.owner[k] as usize] == parts[core.owner[l] as usize];
                assert_eq!(same, block(i, j) == block(u, v), "{i} {j} and {u} {v}");
            }
        }
    }
}
