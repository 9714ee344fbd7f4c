//! Matches that a list has twice.

use std::collections::HashSet;

/// How many of the matches of a pair were there before. Nothing is lost by them: a track has each
/// feature once. O(matches); lists in the order of the first features, as COLMAP writes them, take no
/// memory.
pub(super) fn doubles(matches: &[[u8; 8]]) -> usize {
    let feature = |m: &[u8; 8]| u32::from_le_bytes([m[0], m[1], m[2], m[3]]);
    if matches.is_sorted_by(|one, other| feature(one) < feature(other)) {
        return 0;
    }
    let mut seen = HashSet::with_capacity(matches.len());
    matches.iter().filter(|m| !seen.insert(**m)).count()
}

#[cfg(test)]
mod tests {
    use super::doubles;

    #[test]
    fn only_the_same_two_features_again_are_counted() {
        let list = |matches: &[(u32, u32)]| -> Vec<[u8; 8]> {
            let bytes = |&(a, b): &(u32, u32)| {
                let both = [a.to_le_bytes(), b.to_le_bytes()];
                both.concat().try_into().expect("8 bytes")
            };
            matches.iter().map(bytes).collect()
        };
        assert_eq!(doubles(&list(&[(0, 5), (1, 5), (7, 2)])), 0);
        assert_eq!(doubles(&list(&[(0, 5), (0, 6), (2, 5)])), 0);
        assert_eq!(doubles(&list(&[(3, 5), (1, 5), (3, 5), (3, 5), (5, 3)])), 2);
    }
}
