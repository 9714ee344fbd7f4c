//! Motion classes of a piece from one motion of its core (docs/theory.md, Theorem 6.4 and
//! Propositions 6.6 and 6.7).
//!
//! In a component every motion is one transformation, so edges that a motion
//! transforms differently lie in different components; a random motion tells all of
//! them apart but with probability about 1/p. The converse fails: what always moves as
//! one need not be rigid by itself, so that a class is a component only if its own
//! rank says so.

use crate::contract::piece::{Core, Members};
use crate::graph::UnionFind;
use std::collections::BTreeMap;

/// Groups the members of a piece by the transformations of a motion: two members are in
/// one class if some of their core edges are transformed alike. Classes come in a fixed
/// order, that of their first members.
pub(crate) fn classes<T: Ord>(part: &Members, core: &Core, transforms: &[T]) -> Vec<Members> {
    let mut sets = UnionFind::new(part.len());
    let owners = core.owner.iter().map(|&owner| owner as usize);
    unite(&mut sets, transforms.iter().zip(owners));
    part.grouped(|member| sets.find(member))
}

/// Unites the owners of equal transformations.
pub(crate) fn unite<'a, T: Ord + 'a>(
    sets: &mut UnionFind,
    transforms: impl Iterator<Item = (&'a T, usize)>,
) {
    let mut first: BTreeMap<&T, usize> = BTreeMap::new();
    for (transform, owner) in transforms {
        sets.union(*first.entry(transform).or_insert(owner), owner);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Contraction;
    use crate::contract::piece::Assembly;
    use crate::geometry::model::Model;
    use crate::graph::Graph;

    #[test]
    fn members_with_equal_transforms_are_one_class() {
        // The 4-cycle 0-1-2-3: four loose edges, one piece.
        let pairs = vec![(0, 1), (1, 2), (2, 3), (0, 3)];
        let (graph, _) = Graph::from_pairs(4, pairs).unwrap();
        let assembly = Assembly::new(&graph, &Contraction::new(&graph, Model::default()));
        let piece = &assembly.split(&assembly.all()).pieces[0];
        let core = assembly.core(piece);
        let found = classes(piece, &core, &[7, 8, 7, 9]);
        let edges: Vec<_> = found.iter().map(|c| c.edges.clone()).collect();
        assert_eq!(edges, [vec![(0, 1), (1, 2)], vec![(0, 3)], vec![(2, 3)]]);
    }
}
