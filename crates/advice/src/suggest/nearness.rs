//! Which images were probably taken near each other: by the names of their files, and by where they
//! were taken. A guess about what is worth trying; nothing is decided by it.

use std::collections::{BTreeMap, HashMap};

/// How many nearest images are looked at for every image.
const NEAREST: usize = 12;

/// Up to so many images every two are compared by place; beyond, images near each other from west to
/// east.
const ALL: usize = 4000;

/// Why two images are taken for near.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Near {
    /// So many files apart in one sequence of names.
    Name(u32),
    /// Of the same number, or so many apart, in two sequences that are numbered alike.
    Twin(u32),
    /// One is the k-th nearest to the other by position, from 1.
    Position(u32),
}

impl Near {
    /// How far that is, in steps of a sequence.
    pub fn steps(self) -> u32 {
        match self {
            Self::Name(steps) => steps,
            // The other sensor of a rig, or another walk along the same way.
            Self::Twin(steps) => 1 + steps,
            Self::Position(rank) => rank,
        }
    }
}

/// Images in sequences, and their nearest by position.
#[derive(Clone, Debug, Default)]
pub struct Nearness {
    /// For every image its sequence and its place there.
    places: Vec<(u32, u32)>,
    /// For every image the place of its number among the numbers of all sequences.
    numbers: Vec<u32>,
    /// The images of every sequence, in order.
    sequences: Vec<Vec<u32>>,
    /// Sequences that are numbered alike, both ways, increasing.
    alike: Vec<(u32, u32)>,
    /// Pairs near by position, the smaller image first, and their rank from 1.
    nearest: HashMap<(u32, u32), u32>,
}

impl Nearness {
    /// Images by their names, in the order of the nodes, and by their positions, if any are known.
    /// O(n log n), and for positions n^2 for a few thousand images.
    pub fn new(names: &[impl AsRef<str>], positions: &[Option<[f64; 3]>]) -> Self {
        let keys: Vec<Key> = names.iter().map(|name| Key::of(name.as_ref())).collect();
        let mut by_kind: BTreeMap<(&str, &str), Vec<u32>> = BTreeMap::new();
        for (image, key) in (0..).zip(&keys) {
            by_kind.entry(key.kind()).or_default().push(image);
        }
        let mut places = vec![(0, 0); names.len()];
        let mut sequences: Vec<Vec<u32>> = by_kind.into_values().collect();
        for (sequence, images) in (0..).zip(&mut sequences) {
            images.sort_by_key(|&image| (keys[image as usize].order(), image));
            for (place, &image) in (0..).zip(&*images) {
                places[image as usize] = (sequence, place);
            }
        }
        let mut orders: Vec<[(usize, &str); 2]> = keys.iter().map(Key::order).collect();
        orders.sort_unstable();
        orders.dedup();
        let number = |key: &Key| orders.partition_point(|order| *order < key.order()) as u32;
        let numbers: Vec<u32> = keys.iter().map(number).collect();
        Self {
            alike: alike(&sequences, &numbers),
            nearest: nearest(positions),
            places,
            numbers,
            sequences,
        }
    }

    /// Why two images may be near, if anything says so. O(log s) for s sequences numbered alike.
    pub fn of(&self, a: u32, b: u32) -> Option<Near> {
        let by_place = self.nearest.get(&(a.min(b), a.max(b)));
        let by_place = by_place.map(|&rank| Near::Position(rank));
        by_place
            .into_iter()
            .chain(self.by_name(a, b))
            .min_by_key(|near| near.steps())
    }

    fn by_name(&self, a: u32, b: u32) -> Option<Near> {
        let (&(one, i), &(other, j)) = (self.places.get(a as usize)?, self.places.get(b as usize)?);
        if one == other {
            return Some(Near::Name(i.abs_diff(j)));
        }
        let [k, l] = [a, b].map(|image| self.numbers[image as usize]);
        let found = self.alike.binary_search(&(one, other));
        found.ok().map(|_| Near::Twin(k.abs_diff(l)))
    }

    /// Pairs that are near: at most so many steps apart in a sequence or in two that are numbered
    /// alike, and those near by position.
    pub fn pairs(&self, steps: u32) -> Vec<(u32, u32)> {
        let mut pairs: Vec<(u32, u32)> = self.nearest.keys().copied().collect();
        let ordered = |a: u32, b: u32| (a.min(b), a.max(b));
        for images in &self.sequences {
            for (k, &a) in images.iter().enumerate() {
                let after = images[k + 1..].iter().take(steps as usize);
                pairs.extend(after.map(|&b| ordered(a, b)));
            }
        }
        for &(one, other) in self.alike.iter().filter(|(one, other)| one < other) {
            let other = &self.sequences[other as usize];
            for &a in &self.sequences[one as usize] {
                let at = |image: u32| self.numbers[image as usize];
                let from = other.partition_point(|&b| at(b) + steps < at(a));
                let near = other[from..]
                    .iter()
                    .take_while(|&&b| at(b) <= at(a) + steps);
                pairs.extend(near.map(|&b| ordered(a, b)));
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }
}

/// A name, cut at its last number; a time before that, of six digits and more, goes with it, as in
/// 20240131_120501 and 1305031102.175304.
struct Key<'a> {
    before: &'a str,
    /// The time, and the number, both without leading zeros.
    numbers: [&'a str; 2],
    after: &'a str,
    whole: &'a str,
}

/// Fewest digits of a time.
const TIME: usize = 6;

impl<'a> Key<'a> {
    fn of(whole: &'a str) -> Self {
        let is_digit = |c: char| c.is_ascii_digit();
        let Some(end) = whole.rfind(is_digit).map(|last| last + 1) else {
            let folder = whole.rfind('/').map_or(0, |slash| slash + 1);
            return Self {
                before: &whole[..folder],
                numbers: [""; 2],
                after: "",
                whole,
            };
        };
        let start = whole[..end].trim_end_matches(is_digit).len();
        let number = &whole[start..end];
        let (mut before, mut time) = (&whole[..start], "");
        if let Some(rest) = before.strip_suffix(['.', '_', '-']) {
            let of_time = rest.trim_end_matches(is_digit).len();
            if rest.len() - of_time >= TIME {
                (before, time) = rest.split_at(of_time);
            }
        }
        Self {
            before,
            numbers: [time, number].map(|digits| digits.trim_start_matches('0')),
            after: &whole[end..],
            whole,
        }
    }

    /// What names of one sequence have in common.
    fn kind(&self) -> (&'a str, &'a str) {
        (self.before, self.after)
    }

    /// Increasing along a sequence: by number, or names without one by themselves.
    fn order(&self) -> [(usize, &'a str); 2] {
        match self.numbers {
            // The number 0 has no digits left, and its name has.
            ["", ""] if !self.whole.contains('0') => [(0, self.whole); 2],
            numbers => numbers.map(|digits| (digits.len(), digits)),
        }
    }
}

/// Sequences of which one has at least half of the numbers of the other, and two at least.
fn alike(sequences: &[Vec<u32>], numbers: &[u32]) -> Vec<(u32, u32)> {
    let mut of_number: HashMap<u32, Vec<u32>> = HashMap::new();
    for (k, images) in (0..).zip(sequences) {
        for &image in images {
            of_number
                .entry(numbers[image as usize])
                .or_default()
                .push(k);
        }
    }
    // Numbers that very many sequences have, such as the 1 of a thousand folders, say nothing.
    let few = of_number.values().filter(|sequences| sequences.len() <= 64);
    let mut common: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for sequences in few {
        for (k, &one) in sequences.iter().enumerate() {
            for &other in sequences[k + 1..].iter().filter(|&&other| other != one) {
                *common.entry((one.min(other), one.max(other))).or_default() += 1;
            }
        }
    }
    let length = |k: u32| sequences[k as usize].len();
    let found = common
        .into_iter()
        .filter(|&((one, other), count)| count >= 2 && 2 * count >= length(one).min(length(other)));
    let mut found: Vec<(u32, u32)> = found.flat_map(|((a, b), _)| [(a, b), (b, a)]).collect();
    found.sort_unstable();
    found
}

/// For every image its nearest by position.
fn nearest(positions: &[Option<[f64; 3]>]) -> HashMap<(u32, u32), u32> {
    let mut known: Vec<(u32, [f64; 3])> = (0..)
        .zip(positions)
        .filter_map(|(image, place)| Some((image, (*place)?)))
        .collect();
    known.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]).then(a.0.cmp(&b.0)));
    let reach = match known.len() {
        count if count <= ALL => count,
        _ => 16 * NEAREST,
    };
    let mut nearest: HashMap<(u32, u32), u32> = HashMap::new();
    for (k, (a, from)) in known.iter().enumerate() {
        let around = known[k.saturating_sub(reach)..(k + reach + 1).min(known.len())].iter();
        let distance = |to: &[f64; 3]| (0..3).map(|i| (from[i] - to[i]).powi(2)).sum::<f64>();
        let mut others: Vec<(f64, u32)> = around
            .filter(|(b, _)| b != a)
            .map(|(b, to)| (distance(to), *b))
            .collect();
        let closer = |x: &(f64, u32), y: &(f64, u32)| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1));
        if others.len() > NEAREST {
            others.select_nth_unstable_by(NEAREST - 1, closer);
            others.truncate(NEAREST);
        }
        others.sort_by(closer);
        for (rank, (_, b)) in (1..).zip(others) {
            let best = nearest.entry((*a.min(&b), *a.max(&b))).or_insert(rank);
            *best = rank.min(*best);
        }
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_counted_by_their_numbers() {
        let names = [
            "IMG_10.JPG",
            "IMG_2.JPG",
            "IMG_9.JPG",
            "cover.png",
            "x/IMG_2.JPG",
        ];
        let near = Nearness::new(&names, &[]);
        assert_eq!(near.of(0, 2), Some(Near::Name(1)));
        assert_eq!(near.of(1, 0), Some(Near::Name(2)));
        assert_eq!(near.of(0, 3), None);
        // One number in common is no other walk.
        assert_eq!(near.of(1, 4), None);
        assert_eq!(near.pairs(1), [(0, 2), (1, 2)]);
    }

    #[test]
    fn times_go_on_into_the_next_day() {
        let names = [
            "IMG_20240131_235959.jpg",
            "IMG_20240201_000001.jpg",
            "IMG_20240131_120000.jpg",
        ];
        let near = Nearness::new(&names, &[]);
        assert_eq!(near.of(0, 1), Some(Near::Name(1)));
        assert_eq!(near.of(1, 2), Some(Near::Name(2)));
        let near = Nearness::new(
            &["13050.2.png", "1305031102.9.png", "1305031103.1.png"],
            &[],
        );
        assert_eq!((near.of(1, 2), near.of(0, 1)), (Some(Near::Name(1)), None));
    }

    #[test]
    fn the_same_number_in_another_folder_is_near() {
        let names = [
            "a/01.jpg", "a/02.jpg", "a/03.jpg", "b/1.jpg", "b/2.jpg", "c/77.jpg",
        ];
        let near = Nearness::new(&names, &[]);
        assert_eq!(near.of(0, 3), Some(Near::Twin(0)));
        assert_eq!(near.of(2, 4), Some(Near::Twin(1)));
        assert_eq!(near.of(0, 5), None);
        assert_eq!(near.pairs(0), [(0, 3), (1, 4)]);
    }

    #[test]
    fn positions_count_where_they_are_nearer() {
        let names = ["1", "2", "3", "4"];
        let at = |x: f64| Some([x, 0.0, 0.0]);
        let near = Nearness::new(&names, &[at(0.0), at(90.0), None, at(1.0)]);
        assert_eq!(near.of(0, 3), Some(Near::Position(1)));
        // Its nearest is the image 4; the next file is as near as that.
        assert_eq!(near.of(0, 1), Some(Near::Name(1)));
        assert_eq!(near.of(1, 2), Some(Near::Name(1)));
    }
}
