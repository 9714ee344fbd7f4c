//! The core of some members whose scales are settled by linear algebra (docs/theory.md, Theorem 10.6),
//! at centres modulo 65521.

use super::eliminated::{PRIME, next};
use super::links::{Link, Member, Step, Unique, Via, pairs};
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;
use std::collections::{BTreeMap, BTreeSet};

/// Spanning trees that are tried.
const TREES: usize = 6;

/// Most rows that are freed at once: the dimension of what cameras and solutions span.
const MOST_FREED: usize = 4;

/// Candidates for freeing beyond which the search would be long.
const MOST_CANDIDATES: usize = 30;

/// Core, tree and steps for members, if linear algebra shows that their union is uniquely
/// determined. O(r^4) ranks of nine rows for each step, r candidates to be freed, 30 at most.
pub(super) fn settle(members: &[&Member]) -> Option<Unique> {
    let links = Links::of(members)?;
    (0..TREES).find_map(|seed| Search::new(&links, seed)?.run())
}

/// The nodes that are eliminated, each between its two neighbours.
pub(super) fn middles(members: &[&Member]) -> Vec<Link> {
    Links::of(members).map_or_else(Vec::new, |links| links.middle)
}

/// The nodes that are left, and which of them have a link.
struct Links {
    nodes: Vec<u32>,
    /// By sets, the largest ones first.
    direct: Vec<Link>,
    middle: Vec<Link>,
}

impl Links {
    fn of(members: &[&Member]) -> Option<Self> {
        let mut near: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (k, member) in members.iter().enumerate() {
            for &v in &member.nodes {
                near.entry(v).or_default().push(k);
            }
        }
        near.retain(|_, sets| sets.len() > 1);
        let shared = |k: usize| -> Vec<u32> {
            let nodes = members[k].nodes.iter().copied();
            nodes.filter(|v| near.contains_key(v)).collect()
        };
        let mut sets: Vec<Vec<u32>> = (0..members.len()).map(shared).collect();
        if sets.iter().any(|set| set.len() < 2) {
            return None;
        }
        let mut middle = Vec::new();
        let mut kept: BTreeSet<u32> = BTreeSet::new();
        let mut gone: BTreeSet<u32> = BTreeSet::new();
        let mut left = sets.len();
        for (&v, of_v) in &near {
            let other = |k: usize| sets[k].iter().copied().find(|&w| w != v);
            // One set has to be left, for the first link.
            if let &[k, l] = &of_v[..]
                && let (2, 2, Some(a), Some(b)) = (sets[k].len(), sets[l].len(), other(k), other(l))
                && a != b
                && left > 2
                && !kept.contains(&v)
                && !gone.contains(&a)
                && !gone.contains(&b)
            {
                let whys = [members[k].why, members[l].why];
                middle.push(Link {
                    ends: [a, b],
                    via: Via::Middle { node: v, whys },
                });
                kept.extend([a, b]);
                gone.insert(v);
                left -= 2;
            }
        }
        let mut order: Vec<usize> = (0..sets.len()).collect();
        sets.iter_mut()
            .for_each(|set| set.retain(|v| !gone.contains(v)));
        order.sort_by_key(|&k| std::cmp::Reverse(sets[k].len()));
        let direct = order.iter().flat_map(|&k| {
            let (set, why) = (&sets[k], members[k].why);
            pairs(set.len()).map(move |(i, j)| Link {
                ends: [set[i], set[j]],
                via: Via::Pair { plane: 0, why },
            })
        });
        Some(Self {
            direct: direct.collect(),
            nodes: near.into_keys().filter(|v| !gone.contains(v)).collect(),
            middle,
        })
    }
}

/// Links that are known to have scale one, at some centres.
struct Search<'a> {
    links: &'a Links,
    field: PrimeField,
    centres: BTreeMap<u32, [u64; 3]>,
    place: BTreeMap<u32, usize>,
    tree: Vec<Link>,
    known: Vec<bool>,
    steps: Vec<Step>,
}

impl<'a> Search<'a> {
    fn all(links: &'a Links) -> impl Iterator<Item = &'a Link> {
        links.direct.iter().chain(&links.middle)
    }

    /// A spanning tree, by another order of the links for each seed.
    fn new(links: &'a Links, seed: usize) -> Option<Self> {
        let mut state = seed as u64;
        let middle = links.middle.iter().filter_map(|link| match link.via {
            Via::Middle { node, .. } => Some(node),
            Via::Pair { .. } => None,
        });
        let all = links.nodes.iter().copied().chain(middle);
        let centres = all.map(|v| (v, [(); 3].map(|()| next(&mut state))));
        let centres = centres.collect();
        let mut order: Vec<&Link> = links.direct.iter().collect();
        let turn = seed * links.direct.len() / TREES;
        order.rotate_left(turn);
        let mut middle: Vec<&Link> = links.middle.iter().collect();
        middle.rotate_left(seed * links.middle.len() / TREES);
        order.extend(middle);
        let chosen = spanning(&links.nodes, &order);
        let tree = rooted(&links.nodes, &chosen)?;
        let first = tree.first()?.ends[0];
        let mut place = BTreeMap::from([(first, 0)]);
        for link in &tree {
            place.insert(link.ends[1], place.len());
        }
        let in_tree = |link: &Link| {
            let same = |other: &&Link| ends(other) == ends(link) && same_kind(other, link);
            tree.iter().any(|other| same(&other))
        };
        Some(Self {
            field: PrimeField::new(PRIME).ok()?,
            known: Self::all(links).map(in_tree).collect(),
            steps: Vec::new(),
            links,
            centres,
            place,
            tree,
        })
    }

    fn run(mut self) -> Option<Unique> {
        loop {
            self.corners();
            let span = self.span();
            if span.dimension() + MOST_FREED >= self.columns() {
                return Some(self.found());
            }
            let (links, settled) = self.step(&span)?;
            self.known[settled] = true;
            self.steps.push(Step::Settle(links));
        }
    }

    fn columns(&self) -> usize {
        3 * self.place.len()
    }

    /// Pairs that are tied to a third node both.
    fn corners(&mut self) {
        let direct = &self.links.direct;
        let mut ties: BTreeSet<[u32; 2]> = BTreeSet::new();
        for (link, &known) in direct.iter().zip(&self.known) {
            if known {
                ties.insert(ends(link));
            }
        }
        let mut changed = true;
        while changed {
            changed = false;
            for (k, link) in direct.iter().enumerate() {
                let [i, j] = link.ends;
                let tied = |a: u32, b: u32| ties.contains(&[a.min(b), a.max(b)]);
                let Via::Pair { why, .. } = link.via else {
                    continue;
                };
                if self.known[k] {
                    continue;
                }
                let third = |&&v: &&u32| v != i && v != j && tied(i, v) && tied(v, j);
                if let Some(&v) = self.links.nodes.iter().find(third) {
                    self.steps.push(Step::Corner([i, v, j], why));
                    self.known[k] = true;
                    ties.insert(ends(link));
                    changed = true;
                }
            }
        }
    }

    /// The line of a link, in both images.
    fn line(&self, link: &Link) -> [u64; 3] {
        let [ci, cj] = link.ends.map(|v| self.centres[&v]);
        let minus = |x: u64, y: u64| (x + PRIME - y) % PRIME;
        let d: [u64; 3] = std::array::from_fn(|k| minus(ci[k], cj[k]));
        let f = [
            [0, d[2], minus(0, d[1])],
            [minus(0, d[2]), 0, d[0]],
            [d[1], minus(0, d[0]), 0],
        ];
        match link.via {
            Via::Pair { plane, .. } => f[plane],
            Via::Middle { node, .. } => {
                let cv = self.centres[&node];
                let e: [u64; 3] = std::array::from_fn(|k| minus(cv[k], cj[k]));
                std::array::from_fn(|h| (0..3).map(|k| e[k] * f[k][h] % PRIME).sum::<u64>() % PRIME)
            }
        }
    }

    /// Both sides of a row, each in the columns of its node.
    fn sides(&self, link: &Link) -> [Vec<u64>; 2] {
        let line = self.line(link);
        [0, 1].map(|k| {
            let mut side = vec![0; self.columns()];
            let at = 3 * self.place[&link.ends[k]];
            for (entry, &x) in side[at..].iter_mut().zip(&line) {
                let x = if k == 0 { x } else { (PRIME - x) % PRIME };
                *entry = self.field.from_u64(x);
            }
            side
        })
    }

    /// What is known.
    fn span(&self) -> Span {
        let mut span = Span::default();
        for (link, _) in Self::all(self.links)
            .zip(&self.known)
            .filter(|&(_, &known)| known)
        {
            for row in rows(link) {
                let [from, to] = self.sides(&row);
                let whole = from.iter().zip(&to);
                let whole = whole.map(|(&x, &y)| self.field.plus(x, y)).collect();
                span.insert(&self.field, whole);
            }
        }
        span
    }

    /// Links to be freed, the first one of which is settled, and its number.
    fn step(&self, span: &Span) -> Option<(Vec<Link>, usize)> {
        let unknown = Self::all(self.links).enumerate();
        let unknown = unknown.filter(|&(k, _)| !self.known[k]);
        let candidates: Vec<(usize, Link)> = unknown
            .flat_map(|(k, link)| rows(link).into_iter().skip(1).map(move |row| (k, row)))
            .collect();
        if candidates.len() > MOST_CANDIDATES {
            return None;
        }
        let sides: Vec<[Vec<u64>; 2]> = candidates
            .iter()
            .map(|(_, link)| {
                let mut sides = self.sides(link);
                for side in &mut sides {
                    span.reduce(&self.field, side);
                }
                sides
            })
            .collect();
        let least = (self.columns() - 3).saturating_sub(span.dimension()).max(1);
        for size in least..=MOST_FREED.min(candidates.len()) {
            let wanted = self.columns() - 4 + size - span.dimension();
            let mut chosen: Vec<usize> = (0..size).collect();
            loop {
                if let Some(h) = self.settled(&sides, &chosen, wanted) {
                    let mut links = vec![candidates[chosen[h]].1];
                    let others = chosen.iter().enumerate().filter(|&(k, _)| k != h);
                    links.extend(others.map(|(_, &g)| candidates[g].1));
                    return Some((links, candidates[chosen[h]].0));
                }
                if !next_subset(&mut chosen, candidates.len()) {
                    break;
                }
            }
        }
        None
    }

    /// Which of the chosen rows can be left out on its first side without loss of this rank.
    fn settled(&self, sides: &[[Vec<u64>; 2]], chosen: &[usize], wanted: usize) -> Option<usize> {
        let rank = |without: Option<usize>| {
            let mut span = Span::default();
            for (k, &g) in chosen.iter().enumerate() {
                span.insert(&self.field, sides[g][1].clone());
                if without != Some(k) {
                    span.insert(&self.field, sides[g][0].clone());
                }
            }
            span.dimension()
        };
        if rank(None) < wanted {
            return None;
        }
        (0..chosen.len()).find(|&h| rank(Some(h)) >= wanted)
    }

    fn found(self) -> Unique {
        let centre = |v: u32| (v, self.centres[&v].map(|x| x as u32));
        let mut core: Vec<u32> = self.place.keys().copied().collect();
        core.sort_by_key(|v| self.place[v]);
        let middle = self.links.middle.iter().filter_map(|link| match link.via {
            Via::Middle { node, .. } => Some(centre(node)),
            Via::Pair { .. } => None,
        });
        Unique {
            middle: middle.collect(),
            core: core.into_iter().map(centre).collect(),
            tree: self.tree,
            steps: self.steps,
            joins: Vec::new(),
        }
    }
}

fn ends(link: &Link) -> [u32; 2] {
    let [i, j] = link.ends;
    [i.min(j), i.max(j)]
}

fn same_kind(one: &Link, other: &Link) -> bool {
    match (one.via, other.via) {
        (Via::Pair { .. }, Via::Pair { .. }) => true,
        (Via::Middle { node, .. }, Via::Middle { node: same, .. }) => node == same,
        _ => false,
    }
}

/// The rows of a link: three of rank two, or one, which is then listed twice.
fn rows(link: &Link) -> Vec<Link> {
    match link.via {
        Via::Pair { why, .. } => (0..3)
            .map(|plane| Link {
                ends: link.ends,
                via: Via::Pair { plane, why },
            })
            .collect(),
        Via::Middle { .. } => vec![*link; 2],
    }
}

/// Links that join what was apart, in this order.
fn spanning(nodes: &[u32], order: &[&Link]) -> Vec<Link> {
    let mut class: BTreeMap<u32, u32> = nodes.iter().map(|&v| (v, v)).collect();
    let mut chosen = Vec::new();
    for &&link in order {
        let [from, to] = link.ends.map(|v| class[&v]);
        if from != to {
            class
                .values_mut()
                .filter(|x| **x == from)
                .for_each(|x| *x = to);
            chosen.push(link);
        }
    }
    chosen
}

/// The same links, each of which begins at a node before the one where it ends; the first one is a
/// pair. `None` if they do not reach all nodes.
fn rooted(nodes: &[u32], chosen: &[Link]) -> Option<Vec<Link>> {
    let first = chosen
        .iter()
        .position(|link| matches!(link.via, Via::Pair { .. }))?;
    let mut tree = vec![chosen[first]];
    let mut inside = BTreeSet::from(chosen[first].ends);
    while inside.len() < nodes.len() {
        let next = chosen.iter().find_map(|&link| {
            let [i, j] = link.ends;
            match (inside.contains(&i), inside.contains(&j)) {
                (true, false) => Some(link),
                (false, true) => Some(turned(link)),
                _ => None,
            }
        })?;
        inside.insert(next.ends[1]);
        tree.push(next);
    }
    Some(tree)
}

fn turned(link: Link) -> Link {
    let [i, j] = link.ends;
    let via = match link.via {
        Via::Middle { node, whys: [a, b] } => Via::Middle { node, whys: [b, a] },
        pair @ Via::Pair { .. } => pair,
    };
    Link { ends: [j, i], via }
}

/// The next choice of so many numbers below `count`, in lexicographic order.
fn next_subset(chosen: &mut [usize], count: usize) -> bool {
    let size = chosen.len();
    let Some(k) = (0..size).rev().find(|&k| chosen[k] < count - size + k) else {
        return false;
    };
    chosen[k] += 1;
    for l in k + 1..size {
        chosen[l] = chosen[l - 1] + 1;
    }
    true
}
