//! Pairs that are tried besides those that candidates name: one for every joint, a second one for images
//! that hang on one, and the two that place an image of no part.

use super::{CHOICE, Candidate, Pair, Search, TRIED, ordered, touched};
use crate::joints::Joint;
use std::collections::BTreeMap;

impl Search<'_> {
    /// A pair for every joint.
    pub(super) fn near_joints(&self, joints: &[Joint], at: Option<u32>) -> Vec<Pair> {
        let here = |joint: &&Joint| {
            at.is_none_or(|v| {
                let of = self.parts.components_of(v);
                joint.components.iter().any(|part| of.contains(part))
            })
        };
        let joints = joints.iter().filter(here).take(TRIED);
        joints.filter_map(|joint| self.near(joint, at)).collect()
    }

    /// A pair between the two components of a joint, of images near it.
    fn near(&self, joint: &Joint, at: Option<u32>) -> Option<Pair> {
        let [one, other] = [0, 1].map(|side| {
            let nodes = self.parts.nodes_of(joint.components[side]);
            let touched = touched(&joint.how, side);
            match at.filter(|v| nodes.binary_search(v).is_ok() && !touched.contains(v)) {
                Some(v) => vec![v],
                None => self.ends(&nodes, &touched, CHOICE),
            }
        });
        let pairs = one
            .iter()
            .flat_map(|&a| other.iter().map(move |&b| ordered((a, b))));
        pairs.into_iter().find(|&pair| self.is_candidate(pair, at))
    }

    /// A second pair for images that hang on a part by one.
    pub(super) fn hanging(&self, at: Option<u32>) -> Vec<Pair> {
        let mut found = Vec::new();
        for &((a, b), _) in &self.parts.links {
            for (x, y) in [(a, b), (b, a)] {
                let wanted = at.is_none_or(|v| v == x);
                let Some(&part) = self.parts.of(y).first().filter(|_| wanted) else {
                    continue;
                };
                if self.parts.of(x).is_empty() {
                    let nodes = &self.parts.parts[part as usize].nodes;
                    let ends = self.ends(nodes, &[y], CHOICE);
                    let pairs = ends.into_iter().map(|z| ordered((x, z)));
                    found.extend(pairs.into_iter().find(|&pair| self.is_candidate(pair, at)));
                }
            }
            if found.len() >= TRIED {
                break;
            }
        }
        found
    }

    /// The two best pairs with one part, for images that are in none; and for two such images that are a
    /// pair the best pair of each with one part, and one of different images there if there is any.
    pub(super) fn twice(&self, best: &[Candidate]) -> Vec<Vec<Pair>> {
        let mut by_gap: BTreeMap<Pair, Vec<Pair>> = BTreeMap::new();
        for &Candidate { pair: (a, b), .. } in best {
            let gap = ordered((self.group(a), self.group(b)));
            by_gap.entry(gap).or_default().push((a, b));
        }
        let apart = |one: &Pair, other: &Pair| {
            let [a, b] = [one.0, one.1];
            ![a, b].contains(&other.0) && ![a, b].contains(&other.1)
        };
        let mut sets = Vec::new();
        for &((x, y), _) in &self.parts.links {
            for part in 0..self.parts.parts.len() as u32 {
                let of = |v: u32| by_gap.get(&(part, self.group(v)));
                let (Some(of_x), Some(of_y)) = (of(x), of(y)) else {
                    continue;
                };
                let other = of_y.iter().find(|other| apart(&of_x[0], other));
                let mut set = vec![of_x[0], of_y[0]];
                set.extend(other);
                set.sort_unstable();
                set.dedup();
                sets.push(set);
            }
        }
        let two = by_gap.into_values().filter_map(|mut pairs| {
            pairs.truncate(2);
            (pairs.len() == 2).then_some(pairs)
        });
        sets.extend(two);
        sets.truncate(TRIED);
        sets.iter_mut().for_each(|set| set.sort_unstable());
        sets
    }
}
