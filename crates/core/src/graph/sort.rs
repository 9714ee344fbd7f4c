//! Sorting pairs that are sorted already, as lists of pairs often are.
//!
//! In: pairs in any order. Out: the same, turned and sorted, each of them once.

use rayon::prelude::*;

use super::error::GraphError;

/// How many pairs a core takes at least: fewer are not worth waking another one.
pub(super) const SHARE: usize = 1 << 14;

/// Turns a share of pairs of nodes so that their smaller ends come first; returns whether each pair in it is
/// above the one before. O(length).
///
/// # Errors
/// A self-loop, or a node that is not below `nodes`.
pub(super) fn orient(nodes: u32, share: &mut [(u32, u32)]) -> Result<bool, GraphError> {
    let (mut is_increasing, mut before) = (true, 0);
    for pair in share {
        let (mut i, mut j) = *pair;
        if i >= j {
            if i == j {
                return Err(GraphError::SelfLoop(i));
            }
            (i, j) = (j, i);
            *pair = (i, j);
        }
        if j >= nodes {
            return Err(GraphError::OutOfRange { node: j, nodes });
        }
        // In the order of the pairs; nothing is below the first one, as j is not zero.
        let order = u64::from(i) << 32 | u64::from(j);
        is_increasing &= order > before;
        before = order;
    }
    Ok(is_increasing)
}

/// Sorts pairs and leaves out those that are given again, unless their shares are increasing and follow
/// each other. O(m log m), or O(m / share) if they are.
pub(super) fn sort(pairs: &mut Vec<(u32, u32)>, are_increasing: &[bool]) {
    let follow = |first: usize| pairs[first - 1] < pairs[first];
    let increasing = are_increasing.iter().filter(|is| **is).count();
    if increasing == are_increasing.len() && (SHARE..pairs.len()).step_by(SHARE).all(follow) {
        return;
    }
    // Merging the runs of a list that is nearly sorted takes a quarter of the time, and sorting another one in place
    // half of the memory.
    if 2 * increasing > are_increasing.len() {
        pairs.par_sort();
    } else {
        pairs.par_sort_unstable();
    }
    pairs.dedup();
}

/// Sorts a list, and keeps each item once. O(n log n).
pub(crate) fn sort_once<T: Ord>(list: &mut Vec<T>) {
    list.sort_unstable();
    list.dedup();
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against the standard library: nearly sorted lists, with strays anywhere, and others.
        #[test]
        fn any_list_is_sorted(
            mut pairs in prop::collection::vec((0u32..90, 0u32..4), 0..300),
            nearly in any::<bool>(),
            strays in prop::collection::vec((any::<prop::sample::Index>(), 0u32..90), 0..20),
        ) {
            if nearly {
                pairs.sort_unstable();
            }
            for (place, value) in strays {
                if !pairs.is_empty() {
                    let place = place.index(pairs.len());
                    pairs[place].0 = value;
                }
            }
            let mut expected = pairs.clone();
            expected.sort();
            expected.dedup();
            let is_increasing = pairs.is_sorted_by(|a, b| a < b);
            sort(&mut pairs, &[is_increasing]);
            prop_assert_eq!(pairs, expected);
        }
    }

    /// Shares are put together as one list.
    #[test]
    fn shares_are_one_list() {
        let mut pairs: Vec<_> = (0..3 * SHARE as u32 - 5).map(|k| (k, k + 1)).collect();
        let sorted = pairs.clone();
        for places in [
            [5, 9],
            [SHARE - 1, SHARE],
            [SHARE, SHARE + 1],
            [7, 2 * SHARE],
        ] {
            let [a, b] = places;
            pairs.swap(a, b);
            // One of them the other way round, and another given again.
            let (i, j) = pairs[a];
            pairs[a] = (j, i);
            pairs.insert(2 * SHARE, sorted[3]);
            let shares = pairs.chunks_mut(SHARE);
            let are_increasing: Vec<_> = shares
                .map(|share| orient(u32::MAX, share).unwrap())
                .collect();
            sort(&mut pairs, &are_increasing);
            assert!(pairs == sorted, "{places:?}");
        }
    }
}
