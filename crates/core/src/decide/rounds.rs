//! Uniqueness at any size: rounds of removing nodes (docs/theory.md, section 19).
//!
//! In: uniquely determined members, closed under the rules of contraction. Out: rounds that merge them.
//! A round removes some nodes, no two of one small member. Where what is left is rigid, each of them is
//! determined together with its neighbours there (Theorem 19.6), and its members merge. Then the rules
//! go on. One rank decides about all nodes of a round; if it is too small, stresses of the whole core
//! merge the members at a node (Theorem 19.11), and if there are too few, fewer nodes are removed.

use crate::contract::piece::{Assembly, Members};
use crate::contract::{Body, Contraction, Merge, Part, Seed};
use crate::decide::bodies_by_rank::{self, Read, Search};
use crate::decide::error::VerdictError;
use crate::decide::evidence::Evidence;
use crate::decide::options::Options;
use crate::decide::stressed::Stressed;
use crate::geometry::model::Model;
use crate::graph::{Graph, Lists, UnionFind};
use crate::solutions::Rule;
use std::collections::{BTreeSet, HashMap};

/// Members merged in rounds: the data of docs/certificate.md, section 12.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rounds {
    /// What is rigid without some nodes, and the merges that follow, in order.
    pub rounds: Vec<Round>,
    /// The shared nodes of each member that is left.
    pub left: Vec<Vec<u32>>,
    /// For each time that nodes were removed how many they were, of how many.
    pub removed: Vec<[usize; 2]>,
    /// How many times stresses merged members.
    pub stressed: usize,
}

impl Rounds {
    /// Whether one member is left, so that there is one solution.
    pub fn is_one(&self) -> bool {
        self.left.len() == 1
    }
}

/// A part that is rigid, and what merges as it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Round {
    /// The part: nodes of members.
    pub sets: Vec<Vec<u32>>,
    /// Why it is rigid.
    pub evidence: Evidence,
    /// Stresses at the centres of the evidence, by residues, if members merge by them.
    pub stresses: Vec<Vec<u64>>,
    /// Merges of members.
    pub merges: Vec<Joined>,
}

/// Members, by their numbers, that merge.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Joined {
    /// Why.
    pub rule: Rule,
    /// The members.
    pub with: Vec<usize>,
    /// The nodes that the rule speaks of.
    pub at: Vec<u32>,
}

/// Parts with at least twice as many shared nodes are looked for in regions first.
const REGION: usize = 96;

/// What all ranks of small cores may cost together, as the sum of the third powers of their nodes.
const MOST_COST: u64 = 1 << 27;

/// So many times a core as large as the first one is looked at all the same, as long as every look shows
/// something.
const MOST_LARGE: u64 = 4;

/// Smaller cores are decided in some milliseconds, before nodes are removed.
const LARGE: usize = 64;

/// One rank of larger cores costs less than a second round of removals.
const DEAR: usize = 512;

/// Members larger than this may lose several nodes at once.
const LARGE_MEMBER: usize = 8;

/// Merges members in rounds, until one is left or nothing more is found; who is not patient stops
/// with the first nodes that show nothing.
///
/// # Errors
/// If the work was stopped.
pub(super) fn merge(
    nodes: usize,
    members: Vec<Vec<u32>>,
    sha256: &[u8; 32],
    options: &Options,
    is_patient: bool,
) -> Result<Rounds, VerdictError> {
    let mut state = State::new(nodes, members);
    let (mut rounds, mut removed, mut stressed) = (Vec::new(), Vec::new(), 0);
    let first = (state.shared.len() as u64).pow(3);
    let mut left = MOST_COST.max(if is_patient {
        first
    } else {
        MOST_LARGE * first
    });
    let mut choice = Choice::default();
    // Where few nodes can go, or one rank is all that is affordable, stresses show most.
    let is_first = |state: &State| match state.shared.len() {
        DEAR.. => true,
        LARGE.. => is_patient,
        _ => is_patient && !state.loses_many(),
    };
    let (mut by_stresses, mut is_new) = (is_first(&state), true);
    while state.members.len() > 1 {
        let shared = state.shared.len();
        let cost = (shared as u64).pow(3).max(1);
        let Some(chosen) = state.choose(&choice).filter(|_| cost <= left) else {
            break;
        };
        left -= cost;
        let mut found = if by_stresses {
            state.by_stresses(sha256, options)?
        } else {
            state.by_removal(&chosen, sha256, options)?
        };
        if let Some(last) = found.last_mut() {
            last.merges.extend(state.close());
            rounds.append(&mut found);
            if by_stresses {
                stressed += 1;
            } else {
                removed.push([chosen.len(), shared]);
            }
            choice.next();
            (by_stresses, is_new) = (is_first(&state), true);
        } else if by_stresses {
            (by_stresses, is_new) = (false, false);
        } else if is_patient {
            choice.shrink(chosen.len());
            by_stresses = is_new;
        } else {
            break;
        }
    }
    Ok(Rounds {
        rounds,
        left: state.members,
        removed,
        stressed,
    })
}

/// Whether there are so many equations that a large core loses many nodes at once.
pub(super) fn may_be_many(nodes: usize, members: &[Vec<u32>]) -> bool {
    let state = State::new(nodes, members.to_vec());
    state.shared.len() >= LARGE && state.loses_many()
}

/// How many nodes are removed, and which.
#[derive(Default)]
struct Choice {
    /// The share of what the core has too many of is halved so often.
    halved: u32,
    /// Of single nodes the place, once one at a time is removed.
    single: Option<usize>,
    /// Changes which nodes are taken.
    salt: u64,
}

impl Choice {
    /// Fewer nodes, after so many that showed nothing.
    fn shrink(&mut self, nodes: usize) {
        self.salt += 1;
        match &mut self.single {
            Some(place) => *place += 1,
            None if nodes <= 2 => self.single = Some(0),
            None => self.halved += 1,
        }
    }

    /// After nodes that showed something.
    fn next(&mut self) {
        self.salt += 1;
        self.single = self.single.map(|_| 0);
    }
}

/// Members that are left, and the nodes that two of them share at least.
struct State {
    nodes: usize,
    /// The shared nodes of each member, increasing.
    members: Vec<Vec<u32>>,
    /// The number of the member that a place has become part of.
    numbers: Vec<usize>,
    sets: UnionFind,
    /// The places of each node.
    at: Lists,
    shared: Vec<u32>,
    next: usize,
    joined: Vec<Joined>,
}

/// The sets of nodes that members have in a part.
type Sets = Vec<Vec<u32>>;

impl State {
    fn new(nodes: usize, members: Vec<Vec<u32>>) -> Self {
        let numbers = (0..members.len()).collect();
        let next = members.len();
        Self::of(nodes, members, numbers, next)
    }

    /// Of members only the nodes count that two have.
    fn of(nodes: usize, mut members: Vec<Vec<u32>>, numbers: Vec<usize>, next: usize) -> Self {
        let mut times = vec![0u8; nodes];
        for &v in members.iter().flatten() {
            times[v as usize] = times[v as usize].saturating_add(1);
        }
        for member in &mut members {
            member.retain(|&v| times[v as usize] > 1);
            member.sort_unstable();
        }
        let is_shared = |&v: &u32| times[v as usize] > 1;
        let pairs = (0..)
            .zip(&members)
            .flat_map(|(place, member)| member.iter().map(move |&v| (v, place)));
        Self {
            nodes,
            at: Lists::group(nodes, pairs),
            sets: UnionFind::new(members.len()),
            members,
            numbers,
            shared: (0..nodes as u32).filter(is_shared).collect(),
            next,
            joined: Vec::new(),
        }
    }

    /// Merges the members that some places belong to now, if they are several.
    fn join(&mut self, places: &[usize], rule: Rule, at: Vec<u32>) {
        let roots: BTreeSet<usize> = places.iter().map(|&place| self.sets.find(place)).collect();
        let mut with: Vec<usize> = roots.iter().map(|&root| self.numbers[root]).collect();
        if with.len() < 2 {
            return;
        }
        with.sort_unstable();
        for &root in &roots {
            self.sets.union(places[0], root);
        }
        let root = self.sets.find(places[0]);
        self.numbers[root] = self.next;
        self.next += 1;
        self.joined.push(Joined { rule, with, at });
    }

    /// Starts again with what members have become.
    fn settle(&mut self) {
        let mut place_of = HashMap::new();
        let (mut members, mut numbers): (Vec<Vec<u32>>, Vec<usize>) = Default::default();
        for (place, nodes) in std::mem::take(&mut self.members).into_iter().enumerate() {
            let root = self.sets.find(place);
            let at = *place_of.entry(root).or_insert_with(|| {
                numbers.push(self.numbers[root]);
                members.push(Vec::new());
                members.len() - 1
            });
            members[at].extend(nodes);
        }
        members.iter_mut().for_each(crate::graph::sort_once);
        let joined = std::mem::take(&mut self.joined);
        *self = Self {
            joined,
            ..Self::of(self.nodes, members, numbers, self.next)
        };
    }

    /// What the core has more of equations than of unknowns.
    fn excess(&self) -> usize {
        let rank = |nodes: usize| Model::Projective.required(nodes);
        let all: usize = self.members.iter().map(|member| rank(member.len())).sum();
        all.saturating_sub(rank(self.shared.len()))
    }

    /// Whether one in twenty nodes can be removed at once.
    fn loses_many(&self) -> bool {
        let chosen = self.choose(&Choice::default());
        chosen.is_some_and(|chosen| 20 * chosen.len() >= self.shared.len())
    }

    /// How much of that goes with a node.
    fn cost(&self, v: u32) -> usize {
        let members = self.at.of(v as usize).iter();
        let each = members.map(|&place| match self.members[place as usize].len() {
            2 => 7,
            _ => 11,
        });
        each.sum::<usize>().saturating_sub(11)
    }

    /// Nodes to remove: cheap ones first, as many as two thirds of the excess allow, no two of them in
    /// one small member. `None` if all single nodes were tried.
    fn choose(&self, choice: &Choice) -> Option<Vec<u32>> {
        let mixed = |v: u32| {
            let mut x = (u64::from(v) + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ choice.salt;
            x = (x ^ (x >> 31)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            x ^ (x >> 29)
        };
        let mut order: Vec<u32> = self.shared.clone();
        if let Some(place) = choice.single {
            order.sort_by_key(|&v| self.cost(v));
            return order.get(place).map(|&v| vec![v]);
        }
        order.sort_by_cached_key(|&v| (self.cost(v), mixed(v)));
        let allowed = (2 * self.excess() / 3) >> choice.halved;
        let mut taken = vec![0usize; self.members.len()];
        let (mut chosen, mut spent) = (Vec::new(), 0);
        for v in order {
            let places = self.at.of(v as usize);
            let fits = |&place: &u32| {
                let size = self.members[place as usize].len();
                let most = if size > LARGE_MEMBER { size / 4 } else { 1 };
                taken[place as usize] < most
            };
            if spent + self.cost(v) > allowed && !chosen.is_empty() {
                break;
            }
            if places.iter().all(fits) {
                spent += self.cost(v);
                chosen.push(v);
                for &place in places {
                    taken[place as usize] += 1;
                }
            }
        }
        (!chosen.is_empty()).then_some(chosen)
    }

    /// What merges if some nodes are removed.
    fn by_removal(
        &mut self,
        removed: &[u32],
        sha256: &[u8; 32],
        options: &Options,
    ) -> Result<Vec<Round>, VerdictError> {
        let evidence: &Read<'_, _> = &|ranks| Ok(Some(ranks.evidence()));
        let parts = self.rigid_parts(removed, sha256, options, evidence)?;
        let rounds = parts.into_iter().map(|(sets, evidence)| Round {
            merges: self.join_neighbours(removed, &sets),
            sets,
            evidence,
            stresses: Vec::new(),
        });
        Ok(rounds.filter(|round| !round.merges.is_empty()).collect())
    }

    /// What merges by stresses.
    fn by_stresses(
        &mut self,
        sha256: &[u8; 32],
        options: &Options,
    ) -> Result<Vec<Round>, VerdictError> {
        let stressed: &Read<'_, Stressed> = &|ranks| ranks.stressed(&options.watch);
        let parts = self.rigid_parts(&[], sha256, options, stressed)?;
        let rounds = parts.into_iter().map(|(sets, stressed)| {
            for at in stressed.nodes {
                let places = self
                    .at
                    .of(at[0] as usize)
                    .iter()
                    .map(|&place| place as usize);
                let holds = |&place: &usize| {
                    let nodes = &self.members[place];
                    at[1..].iter().any(|a| nodes.binary_search(a).is_ok())
                };
                let places: Vec<usize> = places.filter(holds).collect();
                self.join(&places, Rule::Stressed, at);
            }
            Round {
                sets,
                evidence: stressed.evidence,
                stresses: stressed.vectors,
                merges: std::mem::take(&mut self.joined),
            }
        });
        Ok(rounds.filter(|round| !round.merges.is_empty()).collect())
    }

    /// Parts that are rigid without some nodes, as sets of nodes of members, with what is read off
    /// their ranks.
    fn rigid_parts<T: Send>(
        &self,
        removed: &[u32],
        sha256: &[u8; 32],
        options: &Options,
        read: &Read<'_, T>,
    ) -> Result<Vec<(Sets, T)>, VerdictError> {
        let mut is_removed = vec![false; self.nodes];
        for &v in removed {
            is_removed[v as usize] = true;
        }
        let (mut bodies, mut loose) = (Vec::new(), Vec::new());
        for member in &self.members {
            let nodes = member.iter().filter(|&&v| !is_removed[v as usize]);
            match nodes.copied().collect::<Vec<u32>>()[..] {
                [] | [_] => {}
                [i, j] => loose.push((i, j)),
                ref nodes => bodies.push(Body::known(nodes)),
            }
        }
        crate::graph::sort_once(&mut loose);
        let contraction = Contraction {
            finals: (0..bodies.len() as u32).collect(),
            bodies,
            loose,
            by_rank: Vec::new(),
        };
        let chains = contraction.bodies.iter().flat_map(|body| {
            let pairs = body.nodes.windows(2);
            pairs.map(|pair| (pair[0], pair[1]))
        });
        let linked = contraction.loose.iter().copied().chain(chains).collect();
        let (linked, _) = Graph::from_pairs(self.nodes as u32, linked).expect("nodes of the graph");
        let assembly = Assembly::new(&linked, &contraction);
        let search = Search::new(&assembly, sha256, options);
        let pieces = assembly.split(&assembly.all()).pieces;
        let mut found = Vec::new();
        if self.shared.len() >= 2 * REGION {
            let cores = pieces
                .iter()
                .map(|piece| (piece.clone(), assembly.core(piece)));
            let cores: Vec<_> = cores.collect();
            let regions = bodies_by_rank::regions(&linked, &contraction, &cores, REGION);
            found = search.all_rigid_parts(&regions, read)?;
            if found.is_empty() && self.shared.len() >= DEAR {
                let dense = bodies_by_rank::dense_region(&linked, &contraction, &cores);
                found = search.all_rigid_parts(&dense, read)?;
            }
        }
        if found.is_empty() {
            found = search.all_rigid_parts(&pieces, read)?;
        }
        let sets = |members: &Members| {
            let bodies = members.bodies.iter();
            let bodies = bodies.map(|&body| contraction.bodies[body as usize].nodes.clone());
            let edges = members.edges.iter().map(|&(i, j)| vec![i, j]);
            bodies.chain(edges).collect()
        };
        Ok(found
            .into_iter()
            .map(|(members, value)| (sets(&members), value))
            .collect())
    }

    /// Merges the members of each removed node that hold nodes of a rigid part without it.
    fn join_neighbours(&mut self, removed: &[u32], part: &[Vec<u32>]) -> Vec<Joined> {
        let mut inside = vec![false; self.nodes];
        for &v in part.iter().flatten() {
            inside[v as usize] = true;
        }
        for &v in removed {
            let (mut places, mut at) = (Vec::new(), vec![v]);
            let mut roots = BTreeSet::new();
            for &place in self.at.of(v as usize) {
                let place = place as usize;
                let neighbours = self.members[place].iter();
                let neighbour = neighbours
                    .copied()
                    .find(|&a| inside[a as usize] && !at.contains(&a));
                if let Some(a) = neighbour
                    && roots.insert(self.sets.find(place))
                {
                    places.push(place);
                    at.push(a);
                }
            }
            if places.len() >= 2 {
                self.join(&places, Rule::Removed, at);
            }
        }
        std::mem::take(&mut self.joined)
    }

    /// Closes under the rules of contraction.
    fn close(&mut self) -> Vec<Joined> {
        self.settle();
        let mut pairs: HashMap<(u32, u32), usize> = HashMap::new();
        let (mut sets, mut places) = (Vec::new(), Vec::new());
        for place in 0..self.members.len() {
            match self.members[place][..] {
                [] | [_] => {}
                [i, j] => match pairs.insert((i, j), place) {
                    None => {}
                    Some(other) => self.join(&[other, place], Rule::Shared, vec![i, j]),
                },
                ref nodes => {
                    sets.push(nodes.to_vec());
                    places.push(place);
                }
            }
        }
        let edges = pairs.keys().copied().collect();
        let (graph, _) = Graph::from_pairs(self.nodes as u32, edges).expect("nodes of the graph");
        let contraction = Contraction::with_sets(&graph, &sets);
        for (k, body) in contraction.bodies.iter().enumerate() {
            let place = self.replay(body, k, &pairs, &places);
            if k >= places.len() {
                places.push(place);
            }
        }
        self.join_covered(&contraction, &pairs, &places);
        self.settle();
        std::mem::take(&mut self.joined)
    }

    /// Does the merges of a body; a place that belongs to it.
    fn replay(
        &mut self,
        body: &Body,
        number: usize,
        pairs: &HashMap<(u32, u32), usize>,
        places: &[usize],
    ) -> usize {
        let pair = |v: u32, w: u32| pairs[&(v.min(w), v.max(w))];
        let place_of = |part: &Part| match *part {
            Part::Edge(i, j) => pair(i, j),
            Part::Body(k) => places[k as usize],
        };
        let own = match body.seed {
            Seed::Known => places[number],
            Seed::Edge(i, j) => pair(i, j),
            Seed::Body(k) => places[k as usize],
            Seed::Rank(_) => unreachable!("rules make no body by rank"),
        };
        for &[v, a, b] in &body.add {
            self.join(
                &[own, pair(v, a), pair(v, b)],
                Rule::Triangle,
                vec![a, b, v],
            );
        }
        for merge in &body.merge {
            let rule = match merge {
                Merge::Shared { .. } => Rule::Shared,
                Merge::Triangle { .. } => Rule::Triangle,
                Merge::Biclique { .. } => Rule::Biclique,
                Merge::Tripod { .. } => Rule::Tripod,
                Merge::Link { .. } => Rule::Link,
                Merge::Scaled { .. } | Merge::Cycle { .. } => {
                    unreachable!("a rule of another model")
                }
            };
            let parts = merge.parts().iter().map(place_of);
            let all: Vec<usize> = std::iter::once(own).chain(parts).collect();
            self.join(&all, rule, merge.at().to_vec());
        }
        own
    }

    /// Merges pairs with the final bodies that hold them.
    fn join_covered(
        &mut self,
        contraction: &Contraction,
        pairs: &HashMap<(u32, u32), usize>,
        places: &[usize],
    ) {
        let finals = contraction.finals.iter();
        let held = finals.flat_map(|&k| {
            let nodes = contraction.bodies[k as usize].nodes.iter();
            nodes.map(move |&v| (v, k))
        });
        let bodies_at = Lists::group(self.nodes, held);
        let mut pairs: Vec<_> = pairs.iter().collect();
        pairs.sort_unstable();
        for (&(i, j), &place) in pairs {
            let (one, other) = (bodies_at.of(i as usize), bodies_at.of(j as usize));
            let (short, long) = if one.len() <= other.len() {
                (one, other)
            } else {
                (other, one)
            };
            if let Some(&body) = short.iter().find(|body| long.binary_search(body).is_ok()) {
                self.join(&[places[body as usize], place], Rule::Shared, vec![i, j]);
            }
        }
    }
}
