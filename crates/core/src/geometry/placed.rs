//! Nodes of which given displacements say where they are (docs/theory.md, Theorem 13.21).
//!
//! In: the groups and vectors of a graph. Out: for each node the first of its group and the vector
//! from there; and which nodes are in general position all the same.

use crate::graph::Displacements;
use crate::linalg::Ring;
use crate::linalg::prime::PrimeField;

/// For each node of a graph the first node of its group, and the vector from there: itself and zero
/// for one that is in no group.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    first: Vec<u32>,
    vector: Vec<[i128; 3]>,
}

impl Placed {
    /// Of a graph with so many nodes; nothing if no vectors are given.
    pub(crate) fn new(nodes: usize, known: &Displacements) -> Option<Self> {
        let vectors = known.vectors()?;
        let mut placed = Self {
            first: (0..nodes as u32).collect(),
            vector: vec![[0; 3]; nodes],
        };
        for (group, vectors) in known.groups().iter().zip(vectors) {
            for (&v, vector) in group[1..].iter().zip(vectors) {
                placed.first[v as usize] = group[0];
                placed.vector[v as usize] = *vector;
            }
        }
        Some(placed)
    }

    /// The first node of the group of a node, or the node.
    pub(crate) fn first(&self, node: u32) -> u32 {
        self.first[node as usize]
    }

    /// The vector from the first node of its group to a node. Coordinates are below 2^101.
    pub(crate) fn vector(&self, node: u32) -> [i128; 3] {
        self.vector[node as usize]
    }

    /// The vector from one node to another one of its group.
    pub(crate) fn between(&self, from: u32, to: u32) -> [i128; 3] {
        let (from, to) = (self.vector(from), self.vector(to));
        [0, 1, 2].map(|k| to[k] - from[k])
    }

    /// Whether at most four nodes are affinely independent, unless the free positions are special:
    /// whether the vectors from the first one of each group among them to the others are linearly
    /// independent; two or three are seen to be so modulo 2^61 - 1.
    pub(crate) fn are_independent(&self, nodes: &[u32]) -> bool {
        let field = PrimeField::mersenne61();
        let mut vectors: Vec<[u64; 3]> = Vec::with_capacity(3);
        for (k, &v) in nodes.iter().enumerate() {
            let earlier = nodes[..k].iter();
            let mut earlier = earlier.filter(|&&u| self.first(u) == self.first(v));
            if let Some(&u) = earlier.next() {
                vectors.push(self.between(u, v).map(|n| residue(&field, n)));
            }
        }
        let f = &field;
        let cross = |a: &[u64; 3], b: &[u64; 3]| {
            [(1, 2), (2, 0), (0, 1)].map(|(r, s)| f.sub(&f.mul(&a[r], &b[s]), &f.mul(&a[s], &b[r])))
        };
        match &vectors[..] {
            // No vector of a group is zero.
            [] | [_] => true,
            [a, b] => cross(a, b) != [0; 3],
            [a, b, c] => f.dot(0, &cross(a, b), c) != 0,
            _ => false,
        }
    }
}

/// An integer as an element of a field.
pub(crate) fn residue(field: &PrimeField, n: i128) -> u64 {
    let residue = n.rem_euclid(i128::from(field.modulus()));
    field.from_u64(residue as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn which_nodes_are_independent() {
        let vector = |entries: [i32; 3]| entries.map(|n| n.to_string().parse().unwrap());
        let known = Displacements::with_vectors(
            12,
            [
                (0, 1, vector([1, 0, 0])),
                (0, 2, vector([3, 0, 0])),
                (0, 3, vector([0, 1, 0])),
                (0, 4, vector([2, 5, 0])),
                (0, 5, vector([0, 0, 1])),
                (6, 7, vector([4, 0, 0])),
                (8, 9, vector([0, 2, 2])),
            ],
        );
        let placed = Placed::new(12, &known.unwrap()).unwrap();
        for (nodes, expected) in [
            // Three in a row, and not.
            (&[0, 1, 2][..], false),
            (&[0, 1, 3], true),
            (&[2, 0, 10], true),
            (&[0, 1, 2, 10], false),
            // Four in a plane, and not.
            (&[0, 1, 3, 4], false),
            (&[5, 1, 3, 4], true),
            (&[0, 1, 3, 10], true),
            (&[0, 1, 10, 11], true),
            // Two pairs.
            (&[0, 6, 1, 7], false),
            (&[0, 6, 7, 3], true),
            (&[0, 8, 9, 1], true),
            (&[6, 8, 10, 11], true),
        ] {
            assert_eq!(placed.are_independent(nodes), expected, "{nodes:?}");
        }
        assert!(Placed::new(3, &Displacements::new(3, [(0, 1)]).unwrap()).is_none());
    }
}
