//! Sorting pairs that are nearly sorted already, as lists of pairs mostly are.
//!
//! In: pairs in any order. Out: the same, sorted. What is in order stays where it is; the few
//! others are taken out, sorted and merged back from behind.

/// If more than one in so many pairs is out of order, all are sorted.
const RARE: usize = 16;

/// Sorts pairs, of which the first `sorted` are sorted. O(m + r log r), where r pairs are taken out,
/// if these are few; O(m log m) if not. Memory for r pairs.
pub(super) fn sort(pairs: &mut [(u32, u32)], sorted: usize) {
    let (kept, mut strays) = take_out(pairs, sorted, pairs.len() / RARE);
    if kept + strays.len() < pairs.len() {
        // Too many: what has been taken out goes back to where there is room, next to the kept.
        pairs[kept..kept + strays.len()].copy_from_slice(&strays);
        pairs.sort_unstable();
        return;
    }
    strays.sort_unstable();
    merge(pairs, kept, &strays);
}

/// Moves an increasing sequence to the front, which begins with the first `sorted` pairs, and takes
/// the others out, until there are more than `most` of them. Returns how many pairs are in front, and
/// the others.
///
/// One pair that is too large would make strays of all that follow it: it is taken out itself if
/// what follows it fits behind what is before it.
fn take_out(pairs: &mut [(u32, u32)], sorted: usize, most: usize) -> (usize, Vec<(u32, u32)>) {
    let mut kept = sorted;
    let mut strays = Vec::new();
    for next in sorted..pairs.len() {
        let pair = pairs[next];
        if kept > 0 && pair < pairs[kept - 1] {
            if strays.len() == most {
                return (kept, strays);
            }
            if kept == 1 || pair >= pairs[kept - 2] {
                strays.push(pairs[kept - 1]);
                pairs[kept - 1] = pair;
            } else {
                strays.push(pair);
            }
        } else {
            pairs[kept] = pair;
            kept += 1;
        }
    }
    (kept, strays)
}

/// Merges `others` into the first `kept` pairs. Both are sorted, and are as many as `pairs`.
fn merge(pairs: &mut [(u32, u32)], mut kept: usize, others: &[(u32, u32)]) {
    let mut free = pairs.len();
    for &other in others.iter().rev() {
        while kept > 0 && pairs[kept - 1] > other {
            kept -= 1;
            free -= 1;
            pairs[free] = pairs[kept];
        }
        free -= 1;
        pairs[free] = other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against the standard library: nearly sorted lists, with strays anywhere, and others.
        #[test]
        fn any_list_is_sorted(
            mut pairs in prop::collection::vec((0u32..40, 0u32..4), 0..200),
            nearly in any::<bool>(),
            strays in prop::collection::vec((any::<prop::sample::Index>(), 0u32..40), 0..14),
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
            let increasing = |end: &usize| pairs[..*end].is_sorted();
            let most = (0..=pairs.len()).rev().find(increasing).unwrap();
            sort(&mut pairs, most / 2);
            prop_assert_eq!(pairs, expected);
        }
    }

    /// What is taken out is what is out of order: one that is too large, one that is too small.
    #[test]
    fn single_strays() {
        let mut pairs = [(9, 0), (1, 0), (2, 0), (8, 8), (3, 0), (0, 0), (4, 0)];
        let (kept, strays) = take_out(&mut pairs, 0, 7);
        assert_eq!(pairs[..kept], [(1, 0), (2, 0), (3, 0), (4, 0)]);
        assert_eq!(strays, [(9, 0), (8, 8), (0, 0)]);
    }
}
