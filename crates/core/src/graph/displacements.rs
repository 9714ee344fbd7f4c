//! Known displacements: which cameras know the whole vector to each other, with its length.

use super::{GraphError, UnionFind};
use sha2::{Digest, Sha256};

/// Groups of nodes between any two of which the displacement is known, whether they are joined by
/// an edge or not (docs/theory.md, Theorems 13.6 and 13.16 to 13.20).
///
/// Displacements add up, so pairs that hang together are one group, and the groups are all that
/// is known. Each has two nodes at least, increasing; no node is in two; groups are in the order of
/// their first nodes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Displacements {
    groups: Vec<Vec<u32>>,
}

impl Displacements {
    /// The groups of the given pairs of nodes below `nodes`, in any order and orientation.
    /// O(n + p log p) for p pairs.
    ///
    /// # Errors
    /// A pair of a node with itself, or a node that is not below `nodes`.
    ///
    /// ```
    /// use viewcert::graph::Displacements;
    ///
    /// let known = Displacements::new(7, [(4, 1), (4, 6), (2, 3)])?;
    /// assert_eq!(known.groups(), [vec![1, 4, 6], vec![2, 3]]);
    /// # Ok::<(), viewcert::GraphError>(())
    /// ```
    pub fn new(
        nodes: u32,
        pairs: impl IntoIterator<Item = (u32, u32)>,
    ) -> Result<Self, GraphError> {
        let mut sets = UnionFind::new(nodes as usize);
        let mut ends = Vec::new();
        for (i, j) in pairs {
            let node = i.max(j);
            if i == j {
                return Err(GraphError::SelfLoop(i));
            }
            if node >= nodes {
                return Err(GraphError::OutOfRange { node, nodes });
            }
            sets.union(i as usize, j as usize);
            ends.extend([i, j]);
        }
        ends.sort_unstable();
        ends.dedup();
        let mut place = vec![None; nodes as usize];
        let mut groups: Vec<Vec<u32>> = Vec::new();
        for v in ends {
            let at = *place[sets.find(v as usize)].get_or_insert_with(|| {
                groups.push(Vec::new());
                groups.len() - 1
            });
            groups[at].push(v);
        }
        Ok(Self { groups })
    }

    /// The groups.
    pub fn groups(&self) -> &[Vec<u32>] {
        &self.groups
    }

    /// Whether nothing is known.
    pub fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// How many nodes are in groups.
    pub fn nodes(&self) -> usize {
        self.groups.iter().map(Vec::len).sum()
    }

    /// The hash that names them (docs/certificate.md, section 3).
    pub fn sha256(&self) -> [u8; 32] {
        let mut hash = Sha256::new();
        hash.update(b"viewcert displacements 1\n");
        hash.update((self.groups.len() as u64).to_le_bytes());
        for group in &self.groups {
            hash.update((group.len() as u64).to_le_bytes());
            group
                .iter()
                .for_each(|node| hash.update(node.to_le_bytes()));
        }
        hash.finalize().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_that_hang_together_are_one_group() {
        let known = Displacements::new(9, [(8, 0), (3, 2), (5, 8), (2, 3), (0, 5)]).unwrap();
        assert_eq!(known.groups(), [vec![0, 5, 8], vec![2, 3]]);
        assert_eq!((known.nodes(), known.is_empty()), (5, false));
        let nothing = Displacements::new(3, []).unwrap();
        assert!(nothing.is_empty() && nothing.nodes() == 0);
    }

    #[test]
    fn what_is_no_pair_of_nodes_is_refused() {
        let known = |pairs: &[(u32, u32)]| Displacements::new(3, pairs.iter().copied());
        assert_eq!(known(&[(0, 1), (2, 2)]), Err(GraphError::SelfLoop(2)));
        let out = GraphError::OutOfRange { node: 3, nodes: 3 };
        assert_eq!(known(&[(3, 1)]), Err(out));
    }

    /// By Python's hashlib, from the page.
    #[test]
    fn the_hash_is_that_of_the_page() {
        let known = Displacements::new(7, [(4, 1), (4, 6), (2, 3)]).unwrap();
        let hex: String = known.sha256().map(|byte| format!("{byte:02x}")).concat();
        assert_eq!(
            hex,
            "6f28eb231b527a0ac01f5c13354edeb3b136a46f1d72f6971fcf08c88e5bf071"
        );
    }
}
