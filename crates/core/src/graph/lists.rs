//! Lists of numbers, one after another in one array.

use std::ops::Range;

use rayon::prelude::*;

use super::sort::SHARE;
use super::viewing_graph::Graph;

/// Lists of neighbours are made by so many threads at most, as each of them looks at all edges.
const MOST_SHARES: usize = 4;

/// Lists for the keys `0..len`, compressed: 4 bytes an item, 8 bytes a list. Lists can shrink.
#[derive(Clone, Debug)]
pub struct Lists {
    start: Vec<u32>,
    len: Vec<u32>,
    items: Vec<u32>,
}

impl Lists {
    /// Groups `(key, item)` by key, the items of a key in the order given. O(keys + pairs); the
    /// pairs are walked through twice.
    ///
    /// # Panics
    /// With 2^32 pairs and more, or a key that is not below `keys`.
    pub fn group(keys: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        let mut start = vec![0u32; keys + 1];
        let mut total = 0u32;
        for (key, _) in pairs.clone() {
            total = total.checked_add(1).expect("fewer than 2^32 pairs");
            start[key as usize + 1] += 1;
        }
        for key in 0..keys {
            start[key + 1] += start[key];
        }
        let mut len = vec![0u32; keys];
        let mut items = vec![0; total as usize];
        for (key, item) in pairs {
            let key = key as usize;
            items[(start[key] + len[key]) as usize] = item;
            len[key] += 1;
        }
        start.pop();
        Self { start, len, items }
    }

    /// The neighbours of every node in increasing order. O(n + m) for each thread; there are
    /// several if there are many edges.
    pub(super) fn of_edges(graph: &Graph) -> Self {
        let (nodes, edges) = (graph.nodes(), graph.edges());
        let count = |end: fn(&(u32, u32)) -> u32| {
            let mut counts = vec![0u32; nodes];
            edges
                .iter()
                .for_each(|edge| counts[end(edge) as usize] += 1);
            counts
        };
        let (smaller, larger) = rayon::join(|| count(|edge| edge.1), || count(|edge| edge.0));
        let len: Vec<u32> = smaller.iter().zip(&larger).map(|(a, b)| a + b).collect();
        let start = sums(&len);
        let first_edge = sums(&larger);
        drop((smaller, larger));
        let mut items = vec![0; 2 * edges.len()];
        // Each thread fills the lists of as many neighbours as the others.
        let shares = (edges.len() / SHARE).clamp(1, rayon::current_num_threads().min(MOST_SHARES));
        let (mut rest, mut from, mut parts) = (&mut items[..], 0, Vec::with_capacity(shares));
        for share in 1..=shares {
            let before = share * 2 * edges.len() / shares;
            let to = if share == shares {
                nodes
            } else {
                start.partition_point(|&start| (start as usize) < before)
            };
            let size: usize = len[from..to].iter().map(|&len| len as usize).sum();
            let (own, others) = rest.split_at_mut(size);
            parts.push((from..to, own));
            (rest, from) = (others, to);
        }
        let places = [&start[..], &first_edge];
        parts
            .into_par_iter()
            .for_each(|(nodes, items)| fill(nodes, items, edges, places));
        Self { start, len, items }
    }

    /// How many lists there are.
    pub fn len(&self) -> usize {
        self.len.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The list of a key.
    pub fn of(&self, key: usize) -> &[u32] {
        let start = self.start[key] as usize;
        &self.items[start..start + self.len[key] as usize]
    }

    /// Keeps only the items of one list that `keep` accepts, in their order. O(length).
    pub fn retain(&mut self, key: usize, mut keep: impl FnMut(u32) -> bool) {
        let start = self.start[key] as usize;
        let mut kept = start;
        for at in start..start + self.len[key] as usize {
            let item = self.items[at];
            if keep(item) {
                self.items[kept] = item;
                kept += 1;
            }
        }
        self.len[key] = (kept - start) as u32;
    }

    /// Empties one list.
    pub fn clear(&mut self, key: usize) {
        self.len[key] = 0;
    }

    /// Puts other items in the place of a list. O(items).
    ///
    /// # Panics
    /// If these are more than the list has.
    pub fn rewrite(&mut self, key: usize, items: &[u32]) {
        assert!(items.len() <= self.of(key).len(), "lists do not grow");
        let start = self.start[key] as usize;
        self.items[start..start + items.len()].copy_from_slice(items);
        self.len[key] = items.len() as u32;
    }
}

/// Fills the lists of some nodes with their neighbours, given where every list begins, and where
/// the edges of every node do.
fn fill(
    nodes: Range<usize>,
    items: &mut [u32],
    edges: &[(u32, u32)],
    [start, first_edge]: [&[u32]; 2],
) {
    let Some(&base) = start.get(nodes.start) else {
        return;
    };
    let end = first_edge.get(nodes.end);
    let end = end.map_or(edges.len(), |&end| end as usize);
    // Where the next smaller neighbour goes, and after these the larger ones.
    let mut at: Vec<u32> = start[nodes.clone()].iter().map(|s| s - base).collect();
    for &(i, j) in &edges[..end] {
        if nodes.contains(&(j as usize)) {
            let at = &mut at[j as usize - nodes.start];
            items[*at as usize] = i;
            *at += 1;
        }
    }
    let own = &edges[first_edge[nodes.start] as usize..end];
    for larger in own.chunk_by(|a, b| a.0 == b.0) {
        let at = at[larger[0].0 as usize - nodes.start] as usize;
        let items = items[at..].iter_mut().zip(larger);
        items.for_each(|(item, &(_, j))| *item = j);
    }
}

/// The sums of all numbers before each.
fn sums(numbers: &[u32]) -> Vec<u32> {
    let mut sum = 0;
    let before = |number: &u32| {
        let after = sum + number;
        std::mem::replace(&mut sum, after)
    };
    numbers.iter().map(before).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// As by grouping, in one share and in several.
        #[test]
        fn neighbours_are_those_of_edges(
            nodes in 2..60u32,
            pairs in prop::collection::vec((any::<u32>(), any::<u32>()), 0..200),
            more in prop::sample::select(vec![0, 3 * SHARE as u32]),
        ) {
            let wide = nodes + more;
            let pairs = pairs.into_iter().map(|(i, j)| (i % wide, j % wide)).filter(|(i, j)| i != j);
            // A path makes many edges of few.
            let path = (1..wide).filter(|_| more > 0).map(|v| (v - 1, v));
            let graph = Graph::new(wide, pairs.chain(path)).unwrap();
            let back = graph.edges().iter().map(|&(i, j)| (j, i));
            let both = back.chain(graph.edges().iter().copied());
            let grouped = Lists::group(wide as usize, both);
            let found = Lists::of_edges(&graph);
            prop_assert!((0..wide as usize).all(|v| found.of(v) == grouped.of(v)));
        }
    }

    #[test]
    fn items_keep_their_order_and_lists_shrink() {
        let pairs = [(2, 7), (0, 1), (2, 3), (2, 5)];
        let mut lists = Lists::group(4, pairs.into_iter());
        let all = |lists: &Lists| {
            (0..lists.len())
                .map(|k| lists.of(k).to_vec())
                .collect::<Vec<_>>()
        };
        assert_eq!(all(&lists), [vec![1], vec![], vec![7, 3, 5], vec![]]);
        lists.retain(2, |item| item != 3);
        assert_eq!(all(&lists), [vec![1], vec![], vec![7, 5], vec![]]);
        lists.rewrite(2, &[9]);
        assert_eq!(all(&lists), [vec![1], vec![], vec![9], vec![]]);
        assert!(Lists::group(0, std::iter::empty()).is_empty());
    }
}
