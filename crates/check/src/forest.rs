//! Union-find.

/// The smallest index connected to this one in a forest of parents (union-find with path halving).
pub(crate) fn root(forest: &mut [usize], mut at: usize) -> usize {
    while forest[at] != at {
        forest[at] = forest[forest[at]];
        at = forest[at];
    }
    at
}

/// Connects two indices; returns whether they were not connected before.
pub(crate) fn unite(forest: &mut [usize], a: usize, b: usize) -> bool {
    let (a, b) = (root(forest, a), root(forest, b));
    forest[a.max(b)] = a.min(b);
    a != b
}
