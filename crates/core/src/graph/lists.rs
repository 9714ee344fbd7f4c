//! Lists of numbers, one after another in one array.

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

#[cfg(test)]
mod tests {
    use super::*;

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
