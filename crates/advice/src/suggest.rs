//! Pairs that, if they were matched, would join components.
//!
//! Each suggestion is proved: the graph with the pairs added is decided, on a condensation of its
//! components. Which pairs are tried first is a guess ([`candidates`]): pairs that are known to have
//! matches, else images that are near each other ([`nearness`]); what was matched in vain comes last
//! ([`tried`]).

use crate::condensation::{Condensation, terminals, with};
use crate::joints::{How, Joint};
use crate::parts::Parts;
use crate::{Known, OtherPair};
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Range;
use viewcert::decide::{Options, VerdictError, decide};
use viewcert::graph::{Adjacency, UnionFind};
use viewcert::{Graph, Verdict};

mod anywhere;
pub mod candidates;
mod matches;
pub mod nearness;
pub mod tried;

pub use candidates::{Candidate, Reason};
pub use matches::{SuggestedMatch, suggest_matches};
pub use nearness::{Near, Nearness};
pub use tried::{IMAGE_NEEDS, PAIR_NEEDS, Tried};

use candidates::Costs;

/// Pairs that join components, if they are matched and verified.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Suggestion {
    /// The pairs, with what is known of each. One, if one is enough; otherwise a set that is enough
    /// and of which none can be left out, though a smaller set may exist.
    pub pairs: Vec<((u32, u32), Option<OtherPair>)>,
    /// The components that become one, or parts of one, increasing.
    pub components: Vec<usize>,
    /// How many images the new component has.
    pub images: usize,
    /// How many images that is more than the largest of the components has.
    pub gain: usize,
    /// Why each of the pairs is worth trying, in their order.
    pub candidates: Vec<Candidate>,
}

/// Whether it failed, whether it is a set, how far it was tried; gain, pairs, round and cost.
type Rank = (bool, bool, Tried, (Reverse<usize>, usize, usize, u32));

impl Suggestion {
    /// The best ones first: what was tried in vain comes last, and single pairs come before sets, of
    /// which the pair that is least promising counts. Of single pairs those come first that are
    /// worth most trying, of sets those that join most.
    fn rank(&self) -> Rank {
        let ranks = self.candidates.iter().map(Candidate::rank);
        let (tried, round, cost) = ranks.max().unwrap_or((Tried::Not, 0, 0));
        let several = self.pairs.len() > 1;
        let (gain, count) = if several {
            (self.gain, self.pairs.len())
        } else {
            (0, 1)
        };
        let place = (Reverse(gain), count, round, cost);
        (self.has_failed(), several, tried, place)
    }

    /// Whether a pair of it was matched with too little coming of it.
    fn has_failed(&self) -> bool {
        self.candidates.iter().any(|one| one.tried.is_failure())
    }
}

/// How many suggestions are wanted, and where.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// Not more than these.
    pub most: usize,
    /// Only such with pairs at this image.
    pub at: Option<u32>,
}

/// Most pairs, joints, and hanging images that are tried.
const TRIED: usize = 200;

/// Most pairs of parts for which sets of several pairs are looked for.
const SETS: usize = 20;

/// Most suggestions, of pairs or of matches, that join the same components.
const ALIKE: usize = 8;

/// Suggests pairs: single ones first, as they are worth trying; then sets of several, by how many
/// images they add to a component; and last what was matched already and gave too little.
///
/// A decision of the condensed graph for each of some hundred candidates.
///
/// # Errors
/// Those of [`decide`].
pub fn suggest(
    graph: &Graph,
    parts: &Parts,
    joints: &[Joint],
    known: Known,
    wanted: Wanted,
    options: &Options,
) -> Result<Vec<Suggestion>, VerdictError> {
    let search = Search::new(graph, parts, known, graph.nodes() as u32);
    let costs = Costs::new(&search);
    let near = search.near_joints(joints, wanted.at);
    let near = near.into_iter().chain(search.hanging(wanted.at));
    // A single pair places no image that has none.
    let is_seen = |v: u32| search.neighbours.degree(v) > 0;
    let seen = costs.best(near, wanted.at, |(a, b)| is_seen(a) && is_seen(b), TRIED);
    let mut sets: Vec<Vec<Pair>> = seen.iter().map(|one| vec![one.pair]).collect();
    // Two pairs place any image that is in no part, however it hangs on single ones.
    let is_placed = |v: u32| !parts.of(v).is_empty();
    let alone = costs.best(
        std::iter::empty(),
        wanted.at,
        |(a, b)| is_placed(a) != is_placed(b),
        TRIED,
    );
    sets.extend(search.twice(&alone));
    dedup(&mut sets);
    let rounds: HashMap<Pair, Candidate> = seen.into_iter().map(|one| (one.pair, one)).collect();
    let explained = |mut found: Vec<Suggestion>| {
        for one in &mut found {
            let pairs = one.pairs.iter().map(|(pair, _)| {
                let chosen = rounds.get(pair).copied();
                chosen.unwrap_or_else(|| costs.candidate(*pair))
            });
            one.candidates = pairs.collect();
        }
        found
    };
    let mut found = explained(search.proved(sets, options)?);
    found.retain(|one| search.joins_both(one));
    // A set for two parts is about none of their images.
    if wanted.at.is_none() {
        let several = search.several(joints, &found, &costs, options)?;
        found.extend(explained(search.proved(several, options)?));
        if found.iter().all(Suggestion::has_failed) {
            let anywhere = search.anywhere(&costs, options)?;
            found.extend(explained(search.proved(anywhere, options)?));
        }
    }
    Ok(ranked(found, wanted.most))
}

type Pair = (u32, u32);

fn ordered((a, b): Pair) -> Pair {
    (a.min(b), a.max(b))
}

fn dedup(sets: &mut Vec<Vec<Pair>>) {
    let mut seen = BTreeSet::new();
    sets.retain(|set| seen.insert(set.clone()));
}

/// The best first, few of a kind.
fn ranked(mut found: Vec<Suggestion>, most: usize) -> Vec<Suggestion> {
    found.sort_by_key(|one| {
        let pairs: Vec<Pair> = one.pairs.iter().map(|&(pair, _)| pair).collect();
        (one.rank(), Reverse(one.gain), pairs)
    });
    found.dedup_by(|one, other| one.pairs == other.pairs);
    let mut alike: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    found.retain(|one| {
        let count = alike.entry(one.components.clone()).or_default();
        *count += 1;
        *count <= ALIKE
    });
    found.truncate(most);
    found
}

struct Search<'a> {
    graph: &'a Graph,
    parts: &'a Parts,
    neighbours: Adjacency,
    known: HashMap<Pair, OtherPair>,
    /// Of every pair of the graph, or empty.
    inliers: &'a [u32],
    nearness: Option<&'a Nearness>,
    /// The nodes that are images: all, or the cameras of a camera-point graph.
    images: Range<u32>,
}

impl<'a> Search<'a> {
    fn new(graph: &'a Graph, parts: &'a Parts, known: Known<'a>, images: u32) -> Self {
        let others = known.others.iter();
        Self {
            graph,
            parts,
            neighbours: Adjacency::new(graph),
            known: others.map(|pair| (pair.images, *pair)).collect(),
            inliers: known.inliers,
            nearness: known.near,
            images: 0..images,
        }
    }

    /// Whether the graph is one of cameras and points.
    fn is_of_tracks(&self) -> bool {
        self.images.len() < self.graph.nodes()
    }

    /// The group of an image: its first part, or itself.
    fn group(&self, image: u32) -> u32 {
        match self.parts.of(image) {
            [] => self.parts.parts.len() as u32 + image,
            [part, ..] => *part,
        }
    }

    /// Pairs of images that are matched and used, with how many inliers; 30 where that is not known.
    fn matched(&self) -> Vec<(Pair, u32)> {
        if self.is_of_tracks() {
            let used = self.known.values().filter(|known| known.used);
            return used.map(|known| (known.images, known.inliers)).collect();
        }
        let edges = self.graph.edges().iter().enumerate();
        let inliers = |edge: usize| self.inliers.get(edge).copied().unwrap_or(2 * PAIR_NEEDS);
        edges.map(|(edge, &pair)| (pair, inliers(edge))).collect()
    }

    /// Whether a pair could join anything, and is where it is wanted.
    fn is_candidate(&self, (a, b): Pair, at: Option<u32>) -> bool {
        a != b
            && at.is_none_or(|v| v == a || v == b)
            // Nor two images of a frame, whose base line is known.
            && !self.parts.are_of_one((a, b))
            // Of two cameras that are placed nowhere no point is known that would place either.
            && !(self.is_of_tracks() && self.parts.of(a).is_empty() && self.parts.of(b).is_empty())
    }

    /// A pair for every joint.
    fn near_joints(&self, joints: &[Joint], at: Option<u32>) -> Vec<Pair> {
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

    /// Images of a component: such that do not touch the other one first, near those that do before
    /// others, of more pairs before fewer.
    fn ends(&self, nodes: &[u32], touched: &[u32], count: usize) -> Vec<u32> {
        let nodes = self.images_of(nodes);
        let near = |v: u32| {
            let mut near = touched.iter();
            near.any(|&t| self.neighbours.neighbours(t).binary_search(&v).is_ok())
        };
        let key = |v: u32| {
            let degree = self.neighbours.degree(v);
            (touched.contains(&v), !near(v), Reverse(degree), v)
        };
        let mut keys: Vec<_> = nodes.iter().map(|&v| key(v)).collect();
        if keys.len() > count {
            keys.select_nth_unstable(count);
            keys.truncate(count);
        }
        keys.sort_unstable();
        keys.into_iter().map(|(.., v)| v).collect()
    }

    /// A second pair for images that hang on a part by one.
    fn hanging(&self, at: Option<u32>) -> Vec<Pair> {
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
    /// pair the best pair of each with one part, of different images there as far as there are any.
    fn twice(&self, best: &[Candidate]) -> Vec<Vec<Pair>> {
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
                sets.push(vec![of_x[0], *other.unwrap_or(&of_y[0])]);
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

    /// Sets of pairs for joints that no single pair closes, and for the largest part and parts that
    /// are not connected with it.
    fn several(
        &self,
        joints: &[Joint],
        found: &[Suggestion],
        costs: &Costs,
        options: &Options,
    ) -> Result<Vec<Vec<Pair>>, VerdictError> {
        let joined = |[one, other]: [usize; 2]| {
            let mut found = found.iter().filter(|found| !found.has_failed());
            found.any(|found| found.components.contains(&one) && found.components.contains(&other))
        };
        let open = joints
            .iter()
            .map(|joint| (joint.components, joint.how.clone()));
        let apart = self
            .apart()
            .into_iter()
            .map(|parts| (parts, How::default()));
        let open: Vec<([usize; 2], How)> = open
            .filter(|(components, _)| !joined(*components))
            .take(SETS)
            .chain(apart.take(SETS))
            .collect();
        let sets = open.par_iter();
        let sets = sets.map(|(components, how)| self.enough(*components, how, costs, options));
        let sets: Result<Vec<Option<Vec<Pair>>>, VerdictError> = sets.collect();
        Ok(sets?.into_iter().flatten().collect())
    }

    /// The largest part with the largest of every other connected part of the graph.
    fn apart(&self) -> Vec<[usize; 2]> {
        let mut sets = UnionFind::new(self.graph.nodes());
        for &(i, j) in self.graph.edges() {
            sets.union(i as usize, j as usize);
        }
        let mut seen = BTreeSet::new();
        let mut firsts = self.parts.parts.iter().filter(|part| {
            let root = sets.find(part.nodes[0] as usize);
            seen.insert(root)
        });
        let largest = firsts.next().map(|part| part.component);
        let others: Vec<usize> = firsts.map(|part| part.component).collect();
        let largest = largest.into_iter();
        largest
            .flat_map(|k| others.iter().map(move |&other| [k, other]))
            .collect()
    }

    /// Pairs that make one of two parts, found greedily: each the one of the pool that takes most
    /// freedom, then those left out that the others make superfluous. `None` if the pool is not
    /// enough, or one pair is.
    fn enough(
        &self,
        components: [usize; 2],
        how: &How,
        costs: &Costs,
        options: &Options,
    ) -> Result<Option<Vec<Pair>>, VerdictError> {
        let nodes = components.map(|component| self.parts.nodes_of(component));
        let all = self.pool(&nodes, how, costs);
        let hopeful: Vec<Pair> = all
            .iter()
            .copied()
            .filter(|&pair| !costs.has_failed(pair))
            .collect();
        let found = self.enough_of(&nodes, how, &hopeful, options)?;
        match found {
            None if hopeful.len() < all.len() => self.enough_of(&nodes, how, &all, options),
            _ => Ok(found),
        }
    }

    /// The same of a given pool.
    fn enough_of(
        &self,
        nodes: &[Vec<u32>; 2],
        how: &How,
        pool: &[Pair],
        options: &Options,
    ) -> Result<Option<Vec<Pair>>, VerdictError> {
        let by = how.through.iter().flat_map(|&[a, x, b]| [(a, x), (x, b)]);
        let links = how.pairs.iter().copied().chain(by);
        let ends = links
            .clone()
            .chain(pool.iter().copied())
            .flat_map(|(a, b)| [a, b]);
        let parts = [&nodes[0][..], &nodes[1]];
        let alone = pool.iter().flat_map(|&(a, b)| [a, b]);
        let small = Condensation::new(terminals(&parts, ends), links, alone);
        let small = small.with_scales(self.parts);
        let free = |set: &[Pair]| {
            let more = set.iter().map(|&pair| small.pair(pair));
            Ok::<usize, VerdictError>(small.freedom(more, options)?.0)
        };
        let mut chosen: Vec<Pair> = Vec::new();
        let mut left = free(&chosen)?;
        while left > 0 {
            let mut best = None;
            for &pair in pool.iter().filter(|pair| !chosen.contains(pair)) {
                let then = free(&[&chosen[..], &[pair]].concat())?;
                if then < best.map_or(left, |(then, _)| then) {
                    best = Some((then, pair));
                }
            }
            let Some((then, pair)) = best else {
                return Ok(None);
            };
            left = then;
            chosen.push(pair);
        }
        for k in (0..chosen.len()).rev() {
            let mut fewer = chosen.clone();
            fewer.remove(k);
            if free(&fewer)? == 0 {
                chosen = fewer;
            }
        }
        chosen.sort_unstable();
        Ok((chosen.len() > 1).then_some(chosen))
    }

    /// Pairs between two parts: the best ones, of different images first; of very large parts those
    /// near the joint.
    fn pool(&self, nodes: &[Vec<u32>; 2], how: &How, costs: &Costs) -> Vec<Pair> {
        let [one, other] = [0, 1].map(|side| self.ends(&nodes[side], &touched(how, side), CHOICE));
        if nodes[0].len().saturating_mul(nodes[1].len()) <= POOL {
            return costs.between(&nodes[0], &nodes[1], CHOICE);
        }
        let known = self.known.keys().copied();
        let near = self.nearness.map(|near| near.pairs(CHOICE as u32));
        let within = |k: usize, v: u32| nodes[k].binary_search(&v).is_ok();
        let between = |&(a, b): &Pair| within(0, a) && within(1, b) || within(1, a) && within(0, b);
        let pairs = known.chain(near.into_iter().flatten()).filter(between);
        let ends = pairs.flat_map(|(a, b)| [a, b]);
        let mut sides = [one, other];
        for v in ends {
            let side = usize::from(!within(0, v));
            if sides[side].len() < POOL.isqrt() && !sides[side].contains(&v) {
                sides[side].push(v);
            }
        }
        costs.between(&sides[0], &sides[1], CHOICE)
    }

    /// Whether a part of each end of all pairs is joined, where it has one: an image of a part that
    /// becomes one of another part as well has joined nothing yet.
    fn joins_both(&self, found: &Suggestion) -> bool {
        let mut ends = found.pairs.iter().flat_map(|&((a, b), _)| [a, b]);
        ends.all(|v| {
            let mut parts = self
                .parts
                .of(v)
                .iter()
                .map(|&part| &self.parts.parts[part as usize]);
            let none = parts.len() == 0;
            none || parts.any(|part| found.components.contains(&part.component))
        })
    }

    /// Which of some sets of pairs join components, and which.
    fn proved(
        &self,
        sets: Vec<Vec<Pair>>,
        options: &Options,
    ) -> Result<Vec<Suggestion>, VerdictError> {
        let nodes: Vec<&[u32]> = self
            .parts
            .parts
            .iter()
            .map(|part| &part.nodes[..])
            .collect();
        let links = self.parts.links.iter().map(|&(pair, _)| pair);
        let ends = || sets.iter().flatten().flat_map(|&(a, b)| [a, b]);
        let touched = links.clone().flat_map(|(a, b)| [a, b]).chain(ends());
        let small = Condensation::new(terminals(&nodes, touched), links, ends());
        let small = small.with_scales(self.parts);
        let each = sets
            .par_iter()
            .map(|set| self.joined_by_no_less(&small, set, options));
        let found: Result<Vec<Option<Suggestion>>, VerdictError> = each.collect();
        Ok(found?.into_iter().flatten().collect())
    }

    /// What a set of pairs joins, if anything, without those of them that it does not take: other
    /// components may help.
    fn joined_by_no_less(
        &self,
        small: &Condensation,
        set: &[Pair],
        options: &Options,
    ) -> Result<Option<Suggestion>, VerdictError> {
        let Some(mut found) = self.joined(small, set, options)? else {
            return Ok(None);
        };
        let mut set = set.to_vec();
        for k in (0..set.len()).rev() {
            let mut fewer = set.clone();
            fewer.remove(k);
            if fewer.is_empty() {
                break;
            }
            if let Some(same) = self.joined(small, &fewer, options)?
                && same.images == found.images
            {
                (set, found) = (fewer, same);
            }
        }
        Ok(Some(found))
    }

    /// What a set of pairs joins, if anything.
    fn joined(
        &self,
        small: &Condensation,
        set: &[Pair],
        options: &Options,
    ) -> Result<Option<Suggestion>, VerdictError> {
        let pairs: Vec<Pair> = set.iter().map(|&pair| small.pair(pair)).collect();
        let graph = with(&small.graph, pairs.iter().copied());
        let found = self.together(small, &graph, &pairs, options)?;
        let pairs = set
            .iter()
            .map(|&pair| (pair, self.known.get(&pair).copied()));
        Ok(found.map(|found| Suggestion {
            pairs: pairs.collect(),
            components: found.components,
            images: found.images,
            gain: found.gain,
            candidates: Vec::new(),
        }))
    }

    /// The component of a graph on a condensation's nodes that holds the ends of some pairs, if
    /// there is one that is more than it was.
    fn together(
        &self,
        small: &Condensation,
        graph: &Graph,
        pairs: &[Pair],
        options: &Options,
    ) -> Result<Option<Together>, VerdictError> {
        let verdict: Verdict = decide(graph, &small.options(options))?;
        let found = Parts::new(graph, &verdict);
        let mut places = pairs.iter().map(|&(a, b)| found.common(a, b));
        let Some(place) = places.next().flatten() else {
            return Ok(None);
        };
        if places.any(|other| other != Some(place)) {
            return Ok(None);
        }
        let part = &found.parts[place];
        let of_small = part.nodes.iter().map(|&v| small.nodes[v as usize]);
        let mut images: Vec<u32> = of_small.filter(|v| self.images.contains(v)).collect();
        let mut components = Vec::new();
        let mut largest = 1;
        for (k, terminals) in small.terminals.iter().enumerate() {
            // Two components of one graph share a node at most, and this one is rigid.
            let mut shared = terminals.iter().filter(|&&v| part.contains(v));
            if shared.nth(1).is_some() {
                components.push(self.parts.parts[k].component);
                let own = self.images_of(&self.parts.parts[k].nodes);
                images.extend(own);
                largest = largest.max(own.len());
            }
        }
        for &((a, b), component) in &self.parts.links {
            let ends = small.number(a).zip(small.number(b));
            if ends.is_some_and(|(a, b)| part.contains(a) && part.contains(b)) {
                components.push(component);
                largest = largest.max(self.images_of(&[a, b]).len());
            }
        }
        images.sort_unstable();
        images.dedup();
        components.sort_unstable();
        let gain = images.len() - largest;
        Ok((gain > 0).then_some(Together {
            components,
            images: images.len(),
            gain,
        }))
    }

    /// Those of some nodes, given increasing, that are images.
    fn images_of<'b>(&self, nodes: &'b [u32]) -> &'b [u32] {
        &nodes[..nodes.partition_point(|v| self.images.contains(v))]
    }
}

/// What becomes one component.
struct Together {
    /// The components of the verdict that it is made of, increasing.
    components: Vec<usize>,
    /// How many images it has.
    images: usize,
    /// How many more than the largest of these components.
    gain: usize,
}

/// How many images of each part are choices for pairs between them.
const CHOICE: usize = 6;

/// Most pairs between two parts that are compared for a set.
const POOL: usize = 250_000;

/// The images of one of the two components of a joint that touch the other.
fn touched(how: &How, side: usize) -> Vec<u32> {
    let pairs = how.pairs.iter().map(|&(a, b)| [a, b][side]);
    let through = how.through.iter().map(|by| by[2 * side]);
    how.shared.into_iter().chain(pairs).chain(through).collect()
}

#[cfg(test)]
mod tests;
