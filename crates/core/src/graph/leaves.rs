//! Pruning of leaves: what lies on a cycle, or between cycles, is left.

use super::lists::Lists;

/// Removes the edges at vertices with a single neighbour from symmetric neighbour lists, again
/// and again until there is no such vertex but those that are `held`. Returns the removed edges,
/// the leaf first, in the order in which they fell. O(n + m).
pub fn prune_leaves(neighbours: &mut Lists, held: impl Fn(u32) -> bool) -> Vec<(u32, u32)> {
    let n = neighbours.len();
    let mut degree: Vec<u32> = (0..n).map(|v| neighbours.of(v).len() as u32).collect();
    // The exclusive or of the neighbours that are left: the last one itself, once it is alone.
    let mut mixed: Vec<u32> = (0..n)
        .map(|v| neighbours.of(v).iter().fold(0, |mix, w| mix ^ w))
        .collect();
    let may_fall = |degree: u32, v: u32| degree == 1 && !held(v);
    let mut leaves: Vec<u32> = (0..n as u32)
        .filter(|&v| may_fall(degree[v as usize], v))
        .collect();
    let mut removed = Vec::new();
    while let Some(v) = leaves.pop() {
        // The other end of an edge that stood alone has lost it by now.
        if degree[v as usize] == 0 {
            continue;
        }
        let w = mixed[v as usize];
        removed.push((v, w));
        degree[v as usize] = 0;
        degree[w as usize] -= 1;
        mixed[w as usize] ^= v;
        if may_fall(degree[w as usize], w) {
            leaves.push(w);
        }
    }
    for &(v, w) in &removed {
        neighbours.retain(v as usize, |_| false);
        if neighbours.of(w as usize).len() > degree[w as usize] as usize {
            neighbours.retain(w as usize, |x| degree[x as usize] > 0);
        }
    }
    removed
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lists(n: usize, edges: &[(u32, u32)]) -> Lists {
        let both = edges.iter().flat_map(|&(a, b)| [(a, b), (b, a)]);
        Lists::group(n, both)
    }

    #[test]
    fn trees_fall_and_cycles_stay() {
        // A triangle 0 1 2 with a path 2 3 4 and a leaf 5 at 3; an edge 6 7; a star around 8.
        let edges = [
            (0, 1),
            (1, 2),
            (0, 2),
            (2, 3),
            (3, 4),
            (3, 5),
            (6, 7),
            (8, 9),
            (8, 10),
            (8, 11),
        ];
        let mut pruned = lists(12, &edges);
        let mut removed: Vec<_> = prune_leaves(&mut pruned, |_| false)
            .into_iter()
            .map(|(a, b)| (a.min(b), a.max(b)))
            .collect();
        removed.sort_unstable();
        assert_eq!(removed, edges[3..]);
        let kept: Vec<&[u32]> = (0..12).map(|v| pruned.of(v)).collect();
        let mut expected: Vec<&[u32]> = vec![&[1, 2], &[0, 2], &[1, 0]];
        expected.resize(12, &[]);
        assert_eq!(kept, expected);
    }

    #[test]
    fn paths_between_cycles_stay() {
        let edges = [
            (0, 1),
            (1, 2),
            (0, 2),
            (2, 3),
            (3, 4),
            (4, 5),
            (5, 6),
            (4, 6),
        ];
        let mut pruned = lists(7, &edges);
        assert_eq!(prune_leaves(&mut pruned, |_| false), []);
        assert_eq!(pruned.of(3), [2, 4]);
    }

    #[test]
    fn held_vertices_stay() {
        // A path 0 1 2 3 4 with both ends held, or one; and a branch 2 5.
        let edges = [(0, 1), (1, 2), (2, 3), (3, 4), (2, 5)];
        let mut pruned = lists(6, &edges);
        let removed = prune_leaves(&mut pruned, |v| v == 0 || v == 4);
        assert_eq!(removed, [(5, 2)]);
        assert_eq!(pruned.of(2), [1, 3]);
        let mut pruned = lists(6, &edges);
        assert_eq!(prune_leaves(&mut pruned, |v| v == 0).len(), 5);
    }
}
