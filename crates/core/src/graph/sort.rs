//! Sorting pairs that are nearly sorted already, as lists of pairs mostly are.
//!
//! In: pairs in any order. Out: the same, turned and sorted, each of them once. Runs that are in
//! order stay together; the few pairs between them are taken out and sorted, and then everything is
//! moved once.

use std::ops::Range;

use rayon::prelude::*;

use super::error::GraphError;

/// How many pairs a core takes at least: fewer are not worth waking another one.
pub(super) const SHARE: usize = 1 << 14;

/// If more than one in so many pairs is out of order, all are sorted.
const RARE: usize = 16;

/// Runs of pairs that are increasing one after the other, and the pairs that are in none of them.
type Order = (Vec<Range<usize>>, Vec<(u32, u32)>);

/// Turns a share of pairs of nodes so that their smaller ends come first; returns the places of all
/// pairs in it that are not above the one before. O(length).
///
/// # Errors
/// A self-loop, or a node that is not below `nodes`.
pub(super) fn orient(nodes: u32, share: &mut [(u32, u32)]) -> Result<Vec<u16>, GraphError> {
    let (mut descents, mut before) = (Vec::new(), 0);
    for (pair, k) in share.iter_mut().zip(0..) {
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
        if order <= before {
            descents.push(k);
        }
        before = order;
    }
    Ok(descents)
}

/// Sorts pairs and leaves out those that are given again, given the descents of their shares.
/// O(m + r log m), where r pairs are taken out, if these are few; O(m log m) if not. Memory for O(r)
/// pairs.
pub(super) fn sort(pairs: &mut Vec<(u32, u32)>, shares: &[Vec<u16>]) {
    let within = shares.iter().zip((0..).step_by(SHARE));
    let descents = within.flat_map(|(share, first)| {
        let is_descent = first > 0 && pairs[first] <= pairs[first - 1];
        let own = share.iter().map(move |&k| first + usize::from(k));
        is_descent.then_some(first).into_iter().chain(own)
    });
    let most = pairs.len() / RARE;
    let descents: Vec<usize> = descents.take(most + 1).collect();
    if descents.is_empty() {
        return;
    }
    let few = descents.len() <= most;
    match few.then(|| take_out(pairs, &descents)).flatten() {
        Some(order) => merge(pairs, order),
        None => {
            pairs.par_sort_unstable();
            pairs.dedup();
        }
    }
}

/// Finds runs, and the other pairs unless these are too many. What is given again may be in neither.
///
/// One pair that is too large would make strays of all that follow it: it is taken out itself if
/// what follows it fits behind what is before it.
fn take_out(pairs: &[(u32, u32)], descents: &[usize]) -> Option<Order> {
    let (mut runs, mut strays) = (Vec::<Range<usize>>::new(), Vec::new());
    let mut start = 0;
    for end in descents.iter().copied().chain([pairs.len()]) {
        let mut run = std::mem::replace(&mut start, end)..end;
        let next = pairs[run.start];
        let mut kept = runs.iter().rev().flat_map(|run| run.clone().rev());
        let last = kept.next().map(|last| pairs[last]);
        let before = kept.next().map(|before| pairs[before]);
        if last.is_some_and(|last| last > next) && before.is_none_or(|before| before < next) {
            strays.extend(last);
            if let Some(run) = runs.last_mut() {
                run.end -= 1;
            }
            runs.pop_if(|run| Range::is_empty(run));
        } else if let Some(last) = last {
            let run_pairs = &pairs[run.clone()];
            let below = run_pairs.partition_point(|pair| *pair < last);
            strays.extend_from_slice(&run_pairs[..below]);
            run.start += below + usize::from(run_pairs.get(below) == Some(&last));
        }
        if strays.len() > pairs.len() / RARE {
            return None;
        }
        if !run.is_empty() {
            runs.push(run);
        }
    }
    Some((runs, strays))
}

/// Puts strays between and into runs.
fn merge(pairs: &mut Vec<(u32, u32)>, (runs, mut strays): Order) {
    strays.sort_unstable();
    strays.dedup();
    // Where parts of runs and strays go.
    let (mut moves, mut places, mut at) = (Vec::new(), Vec::new(), 0);
    let mut strays = strays.into_iter().peekable();
    for mut run in runs {
        let last = pairs[run.end - 1];
        while let Some(stray) = strays.next_if(|stray| *stray <= last) {
            let below = pairs[run.clone()].partition_point(|pair| *pair < stray);
            if pairs[run.start + below] != stray {
                moves.push((run.start..run.start + below, at));
                places.push((at + below, stray));
                run.start += below;
                at += below + 1;
            }
        }
        let length = run.len();
        moves.push((run, at));
        at += length;
    }
    for stray in strays {
        places.push((at, stray));
        at += 1;
    }
    // Neither order overwrites what has not been moved: both places of a part are behind both
    // places of the parts before it.
    for (run, to) in moves.iter().filter(|(run, to)| *to < run.start) {
        pairs.copy_within(run.clone(), *to);
    }
    for (run, to) in moves.iter().rev().filter(|(run, to)| *to > run.start) {
        pairs.copy_within(run.clone(), *to);
    }
    for (at, stray) in places {
        pairs[at] = stray;
    }
    pairs.truncate(at);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn descents(pairs: &[(u32, u32)]) -> Vec<usize> {
        (1..pairs.len())
            .filter(|&k| pairs[k] <= pairs[k - 1])
            .collect()
    }

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
            let descents = descents(&pairs).iter().map(|&k| k as u16).collect();
            sort(&mut pairs, &[descents]);
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
            let descents: Vec<_> = shares
                .map(|share| orient(u32::MAX, share).unwrap())
                .collect();
            sort(&mut pairs, &descents);
            assert!(pairs == sorted, "{places:?}");
        }
    }

    /// What is taken out is what is out of order: one that is too large, one that is too small; one
    /// that is given again is not.
    #[test]
    fn single_strays() {
        let mut pairs = vec![
            (9, 0),
            (1, 0),
            (2, 0),
            (8, 8),
            (3, 0),
            (0, 0),
            (4, 0),
            (4, 0),
        ];
        pairs.extend((10..50).map(|k| (k, 0)));
        let (runs, strays) = take_out(&pairs, &descents(&pairs)).unwrap();
        let kept: Vec<_> = runs.into_iter().flatten().map(|k| pairs[k].0).collect();
        assert_eq!(
            kept,
            [1, 2, 3, 4].into_iter().chain(10..50).collect::<Vec<_>>()
        );
        assert_eq!(strays, [(9, 0), (8, 8), (0, 0)]);
        pairs.truncate(40);
        assert!(
            take_out(&pairs, &descents(&pairs)).is_none(),
            "three of 40 are too many"
        );
    }
}
