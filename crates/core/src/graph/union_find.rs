//! Disjoint sets.

/// Disjoint sets of `0 .. len`, by path halving and union to the smaller root, so
/// that the representative of a set is its least element.
#[derive(Clone, Debug)]
pub struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    /// `len` sets of one element.
    pub fn new(len: usize) -> Self {
        Self {
            parent: (0..len as u32).collect(),
        }
    }

    /// One set of one element more, and that element.
    ///
    /// # Panics
    /// With 2^32 elements.
    pub fn push(&mut self) -> usize {
        let element = self.parent.len();
        let parent = u32::try_from(element).expect("fewer than 2^32 elements");
        self.parent.push(parent);
        element
    }

    /// The least element of the set of `k`.
    pub fn find(&mut self, mut k: usize) -> usize {
        while self.parent[k] as usize != k {
            let up = self.parent[self.parent[k] as usize];
            self.parent[k] = up;
            k = up as usize;
        }
        k
    }

    /// Unites two sets; returns whether they were different.
    pub fn union(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b)] = a.min(b) as u32;
        a != b
    }
}
