//! Known displacements: which cameras know the whole vector to each other, with its length.

use super::error::GraphError;
use super::union_find::UnionFind;
use super::vectors::{self, Hanging, MAX_DIGITS, Vector, minus};
use crate::linalg::rational::Rational;
use sha2::{Digest, Sha256};
use std::fmt;

/// Groups of nodes between any two of which the displacement is known, whether they are joined by
/// an edge or not (docs/theory.md, Theorems 13.6 and 13.16 to 13.20).
///
/// Displacements add up, so pairs that hang together are one group, and the groups are all that
/// is known. Each has two nodes at least, increasing; no node is in two; groups are in the order of
/// their first nodes.
///
/// The vectors may be given as numbers ([`with_vectors`](Self::with_vectors)): then the question is
/// about these vectors, and otherwise about displacements in general position.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Displacements {
    groups: Vec<Vec<u32>>,
    /// For each group the vectors from its first node to each other one, in one unit for all, in
    /// which their coordinates have no common divisor; nothing if they are not given.
    vectors: Option<Vec<Vec<Vector>>>,
}

/// Why given vectors are no displacements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VectorError {
    /// The nodes are no pair of the graph's.
    Pair(GraphError),
    /// A vector is not what those before it add up to.
    Contradiction {
        /// The number of the vector, from 0 on.
        vector: usize,
    },
    /// Two nodes would have the same centre.
    SamePlace {
        /// One node.
        first: u32,
        /// The other.
        second: u32,
    },
    /// In one unit, as integers, they have more than 30 digits.
    TooLong,
}

impl fmt::Display for VectorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pair(error) => error.fmt(f),
            Self::Contradiction { vector } => {
                write!(f, "vector {vector} is not the sum of vectors before it")
            }
            Self::SamePlace { first, second } => {
                write!(f, "the nodes {first} and {second} are at one place")
            }
            Self::TooLong => write!(
                f,
                "as multiples of one unit the vectors have more than {MAX_DIGITS} digits"
            ),
        }
    }
}

impl std::error::Error for VectorError {}

impl From<vectors::Fault> for VectorError {
    fn from(fault: vectors::Fault) -> Self {
        match fault {
            vectors::Fault::Contradiction(vector) => Self::Contradiction { vector },
            vectors::Fault::TooLong => Self::TooLong,
        }
    }
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
        crate::graph::sort_once(&mut ends);
        let mut place = vec![None; nodes as usize];
        let mut groups: Vec<Vec<u32>> = Vec::new();
        for v in ends {
            let at = *place[sets.find(v as usize)].get_or_insert_with(|| {
                groups.push(Vec::new());
                groups.len() - 1
            });
            groups[at].push(v);
        }
        Ok(Self {
            groups,
            vectors: None,
        })
    }

    /// The groups of the given pairs `(u, v)`, in any order, with the vectors c_v - c_u from the
    /// centre of u to that of v. What they are measured in does not matter: multiplied by one positive
    /// number they are the same. O(n + p log p) for p pairs.
    ///
    /// # Errors
    /// As [`new`](Self::new); vectors that contradict each other, that put two nodes at one place,
    /// or are too long.
    ///
    /// ```
    /// use viewcert::graph::Displacements;
    /// use viewcert::linalg::rational::parse;
    ///
    /// let rigs = [(0, 1, ["1", "0", "0"]), (2, 1, ["0.5", "0", "0"])];
    /// let rigs = rigs.map(|(u, v, vector)| (u, v, vector.map(|text| parse(text).unwrap())));
    /// let known = Displacements::with_vectors(3, rigs)?;
    /// assert_eq!(known.groups(), [vec![0, 1, 2]]);
    /// assert_eq!(known.vectors().unwrap(), [vec![[2, 0, 0], [1, 0, 0]]]);
    /// # Ok::<(), viewcert::graph::VectorError>(())
    /// ```
    pub fn with_vectors(
        nodes: u32,
        pairs: impl IntoIterator<Item = (u32, u32, [Rational; 3])>,
    ) -> Result<Self, VectorError> {
        let known = Self::anywhere(nodes, pairs)?;
        for (group, vectors) in known.groups.iter().zip(known.vectors.iter().flatten()) {
            let ends = vectors.iter().zip(&group[1..]);
            let mut places: Vec<_> = ends.map(|(&vector, &v)| (vector, v)).collect();
            places.push(([0; 3], group[0]));
            places.sort_unstable();
            if let Some(same) = places.windows(2).find(|pair| pair[0].0 == pair[1].0) {
                let [first, second] = [same[0].1, same[1].1];
                return Err(VectorError::SamePlace { first, second });
            }
        }
        Ok(known)
    }

    /// The same where two nodes may be at one place: in a frame of their own they are nodes of parts
    /// that have no edge in common (docs/theory.md, Theorem 13.29).
    ///
    /// # Errors
    /// As [`with_vectors`](Self::with_vectors), but for nodes at one place.
    pub fn anywhere(
        nodes: u32,
        pairs: impl IntoIterator<Item = (u32, u32, [Rational; 3])>,
    ) -> Result<Self, VectorError> {
        let (pairs, given): (Vec<_>, Vec<_>) = pairs
            .into_iter()
            .map(|(u, v, vector)| ((u, v), vector))
            .unzip();
        let known = Self::new(nodes, pairs.iter().copied()).map_err(VectorError::Pair)?;
        let mut hanging = Hanging::new(nodes);
        let given = vectors::integers(&given)?;
        for (item, (&pair, vector)) in pairs.iter().zip(given).enumerate() {
            hanging.join(item, pair, vector)?;
        }
        let mut all = Vec::with_capacity(known.groups.len());
        for group in &known.groups {
            all.push(from_first(group, &mut hanging)?);
        }
        vectors::reduce(&mut all)?;
        let vectors = Some(all).filter(|all| !all.is_empty());
        Ok(Self { vectors, ..known })
    }

    /// The groups.
    pub fn groups(&self) -> &[Vec<u32>] {
        &self.groups
    }

    /// For each group the vectors from its first node to each other one, integers of at most 30
    /// digits in one unit; nothing if they are not given.
    pub fn vectors(&self) -> Option<&[Vec<[i128; 3]>]> {
        self.vectors.as_deref()
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
        hash.update(match self.vectors {
            Some(_) => b"viewcert displacements 2\n",
            None => b"viewcert displacements 1\n",
        });
        hash.update((self.groups.len() as u64).to_le_bytes());
        for group in &self.groups {
            hash.update((group.len() as u64).to_le_bytes());
            group
                .iter()
                .for_each(|node| hash.update(node.to_le_bytes()));
        }
        for n in self.vectors.iter().flatten().flatten().flatten() {
            hash.update(format!("{n}\n"));
        }
        hash.finalize().into()
    }
}

/// The vectors from the first node of a group to the others.
fn from_first(group: &[u32], hanging: &mut Hanging) -> Result<Vec<Vector>, VectorError> {
    let (_, start) = hanging.find(group[0])?;
    let ends = group[1..].iter().map(|&v| {
        let (_, end) = hanging.find(v)?;
        minus(end, start).ok_or(VectorError::TooLong)
    });
    ends.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::rational::parse;

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

    fn given(items: &[(u32, u32, [&str; 3])]) -> Result<Displacements, VectorError> {
        let items = items.iter().map(|&(u, v, vector)| {
            let vector = vector.map(|text| parse(text).unwrap());
            (u, v, vector)
        });
        Displacements::with_vectors(9, items)
    }

    #[test]
    fn vectors_add_up_in_a_unit_of_their_own() {
        let known = given(&[
            (4, 1, ["0.5", "0", "-1/3"]),
            (6, 4, ["1", "1", "1"]),
            (2, 3, ["0", "0", "2e1"]),
            (1, 6, ["-1.5", "-1", "-2/3"]),
        ]);
        let known = known.unwrap();
        assert_eq!(known.groups(), [vec![1, 4, 6], vec![2, 3]]);
        let expected = [vec![[-3, 0, 2], [-9, -6, -4]], vec![[0, 0, 120]]];
        assert_eq!(known.vectors().unwrap(), expected);
        // In another unit it is the same, and another hash than without vectors.
        let again = given(&[
            (2, 3, ["0", "0", "120000"]),
            (1, 4, ["-3000", "0", "2000"]),
            (1, 6, ["-9000", "-6000", "-4000"]),
        ]);
        assert_eq!(again.unwrap(), known);
        let plain = Displacements::new(9, [(1, 4), (4, 6), (2, 3)]).unwrap();
        assert_ne!(plain.sha256(), known.sha256());
    }

    #[test]
    fn vectors_that_cannot_be_are_refused() {
        let (x, y, zero) = (["1", "0", "0"], ["0", "1", "0"], ["0", "0", "0"]);
        let cycle = [(0, 1, x), (1, 2, y), (3, 4, x), (0, 2, x), (0, 1, y)];
        assert_eq!(given(&cycle), Err(VectorError::Contradiction { vector: 3 }));
        let (first, second) = (0, 5);
        let same = Err(VectorError::SamePlace { first, second });
        assert_eq!(given(&[(5, 0, zero)]), same);
        assert_eq!(given(&[(0, 1, x), (5, 1, x)]), same);
        let long = ["1e29", "1e-29", "0"];
        assert_eq!(given(&[(0, 1, long)]), Err(VectorError::TooLong));
        assert_eq!(given(&[]), Ok(Displacements::default()));
        let out = VectorError::Pair(GraphError::SelfLoop(3));
        assert_eq!(given(&[(3, 3, x)]), Err(out));
    }

    /// By Python's hashlib, from the page.
    #[test]
    fn the_hash_with_vectors_is_that_of_the_page() {
        let known = given(&[(1, 4, ["3", "0", "-2"]), (2, 3, ["0", "0", "20"])]).unwrap();
        let hex: String = known.sha256().map(|byte| format!("{byte:02x}")).concat();
        assert_eq!(
            hex,
            "ef905f274b7c7f9c2b348a53e07546bf10011b1bc2a214baa895914e61549475"
        );
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
