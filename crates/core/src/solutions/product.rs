//! What hangs together in a few nodes only falls into factors (docs/theory.md, Theorems 10.15 and
//! 10.16, Corollary 10.17).
//!
//! In: members, as lists of nodes. Out: sets of them in an order in which each has in common with
//! those before it nodes of one member that is in both, or two nodes. In the latter case the factors
//! that hold the two have to be finite solvable by themselves, which is asked of the caller.

use crate::geometry::model::full_rank;
use crate::graph::{Lists, UnionFind, biconnected_components};
use crate::watch::Work;
use std::collections::{BTreeMap, BTreeSet};

/// Some of the members, and the joint pairs that it holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Factor {
    /// The places of its members, increasing.
    pub(super) members: Vec<usize>,
    /// Increasing.
    pub(super) pairs: Vec<[u32; 2]>,
}

/// The factors of members; one of them if there are no joints. O(members * places), places being the
/// nodes of all members; and O(nodes * places) where so many equations are left over that two nodes
/// may be a joint, unless that is more than `of_pairs`.
pub(super) fn factors(
    members: &[Vec<u32>],
    is_rigid: impl Fn(&[&[u32]]) -> bool,
    of_pairs: usize,
    work: &Work<'_>,
) -> Vec<Factor> {
    let (lists, names) = numbered(members);
    let parted = Parted {
        lists: &lists,
        nodes: names.len(),
        of_pairs,
        work,
    };
    let blocks = parted.by_members();
    let rigid = |block: &[usize]| {
        let block: Vec<&[u32]> = block.iter().map(|&k| &members[k][..]).collect();
        is_rigid(&block)
    };
    let (mut peeled, mut pairs) = (Vec::new(), BTreeSet::new());
    for block in &blocks {
        let found = parted.by_pairs(block, &rigid);
        peeled.extend(found.0);
        pairs.extend(found.1);
    }
    let with_pairs = parted.ordered(&peeled, &pairs);
    let found = with_pairs.or_else(|| parted.ordered(&blocks, &BTreeSet::new()));
    let found = found.unwrap_or_default();
    let named = |[a, b]: [u32; 2]| [names[a as usize], names[b as usize]];
    found
        .into_iter()
        .map(|factor| Factor {
            pairs: factor.pairs.into_iter().map(named).collect(),
            ..factor
        })
        .collect()
}

/// Equations less unknowns of what members form: the sum of 11 k - 15 over them, less 11 n - 15.
pub(super) fn excess<'m>(members: impl Iterator<Item = &'m [u32]>) -> i64 {
    let required = |nodes: usize| full_rank(nodes) as i64;
    let (mut equations, mut nodes) = (0, BTreeSet::new());
    for member in members {
        equations += required(member.len());
        nodes.extend(member.iter().copied());
    }
    equations - required(nodes.len())
}

/// What two parts with two common nodes have more of equations than each by itself.
const OF_A_PAIR: i64 = 7;

/// The same lists with nodes from 0 on, and the names of these.
fn numbered(members: &[Vec<u32>]) -> (Vec<Vec<u32>>, Vec<u32>) {
    let mut names: Vec<u32> = members.concat();
    names.sort_unstable();
    names.dedup();
    let number: BTreeMap<u32, u32> = names.iter().copied().zip(0..).collect();
    let renamed = |member: &Vec<u32>| member.iter().map(|node| number[node]).collect();
    (members.iter().map(renamed).collect(), names)
}

struct Parted<'a> {
    lists: &'a [Vec<u32>],
    nodes: usize,
    /// How much is looked through for pairs, at most.
    of_pairs: usize,
    work: &'a Work<'a>,
}

impl Parted<'_> {
    /// Splits at members. A member that does not separate a set of members separates no part that is
    /// split off from it, and one at which a set was split none of the parts; so each is looked at
    /// once.
    fn by_members(&self) -> Vec<Vec<usize>> {
        let mut blocks = vec![(0..self.lists.len()).collect::<Vec<usize>>()];
        let mut home = vec![0; self.lists.len()];
        for k in 0..self.lists.len() {
            if self.work.is_stopped() {
                break;
            }
            let block = &blocks[home[k]];
            let sides = self.sides(block, &self.lists[k], &[]);
            let [_, others @ ..] = &sides[..] else {
                continue;
            };
            // A member within it would be lost; there is none if rule 2 does not apply.
            if sides.iter().map(Vec::len).sum::<usize>() + 1 < block.len() {
                continue;
            }
            for side in others {
                side.iter().for_each(|&member| home[member] = blocks.len());
                blocks.push(side.clone());
            }
            let first = home[k];
            blocks[first] = sides[0].clone();
            // The member itself is in all of them, and is done with.
            let with_member = (blocks.len() - others.len()..blocks.len()).chain([first]);
            for block in with_member.collect::<Vec<_>>() {
                blocks[block].push(k);
                blocks[block].sort_unstable();
            }
        }
        blocks
    }

    /// What members fall into without some nodes; those all of whose nodes are among these are left
    /// out. `ties` are pairs of nodes that hang together as well.
    fn sides(&self, block: &[usize], without: &[u32], ties: &[[u32; 2]]) -> Vec<Vec<usize>> {
        let mut is_out = vec![false; self.nodes];
        without.iter().for_each(|&v| is_out[v as usize] = true);
        let outside = |k: usize| {
            let nodes = self.lists[k].iter().map(|&v| v as usize);
            nodes.filter(|&v| !is_out[v])
        };
        let mut class = UnionFind::new(self.nodes);
        for &k in block {
            let mut nodes = outside(k);
            if let Some(first) = nodes.next() {
                nodes.for_each(|node| {
                    class.union(first, node);
                });
            }
        }
        for pair in ties {
            if !pair.iter().any(|&v| is_out[v as usize]) {
                class.union(pair[0] as usize, pair[1] as usize);
            }
        }
        let mut sides: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for &k in block {
            if let Some(node) = outside(k).next() {
                sides.entry(class.find(node)).or_default().push(k);
            }
        }
        sides.into_values().collect()
    }

    /// Splits at pairs of nodes that no member holds, as long as what is split off is rigid and
    /// enough equations are left for the rest. Also these pairs.
    fn by_pairs(
        &self,
        block: &[usize],
        is_rigid: &impl Fn(&[usize]) -> bool,
    ) -> (Vec<Vec<usize>>, Vec<[u32; 2]>) {
        let (mut rest, mut peeled, mut ties) = (block.to_vec(), Vec::new(), Vec::new());
        let places: usize = block.iter().map(|&k| self.lists[k].len()).sum();
        let is_large = places.saturating_mul(self.nodes) > self.of_pairs;
        if self.excess(&rest) < OF_A_PAIR || is_large {
            return (vec![rest], ties);
        }
        for pair in self.separating(block) {
            if self.excess(&rest) < OF_A_PAIR || self.work.is_stopped() {
                break;
            }
            let mut sides = self.sides(&rest, &pair, &ties);
            sides.sort_by_key(Vec::len);
            sides.pop();
            for side in sides {
                let other = without(&rest, &side);
                let both = [&side, &other].iter().all(|part| {
                    let holds = |v: &u32| part.iter().any(|&k| self.lists[k].contains(v));
                    pair.iter().all(holds) && self.excess(part) >= 0
                });
                if both && is_rigid(&side) {
                    rest = other;
                    ties.push(pair);
                    peeled.push(side);
                }
            }
        }
        if !peeled.is_empty() && !is_rigid(&rest) {
            return (vec![block.to_vec()], Vec::new());
        }
        peeled.push(rest);
        (peeled, ties)
    }

    /// The pairs of nodes without which a block falls apart and that no member holds, those first
    /// that split off little.
    fn separating(&self, block: &[usize]) -> Vec<[u32; 2]> {
        let mut found = Vec::new();
        let nodes: BTreeSet<u32> = block
            .iter()
            .flat_map(|&k| &self.lists[k])
            .copied()
            .collect();
        for &a in &nodes {
            if self.work.is_stopped() {
                break;
            }
            let beside: BTreeSet<u32> = block
                .iter()
                .filter(|&&k| self.lists[k].contains(&a))
                .flat_map(|&k| &self.lists[k])
                .copied()
                .collect();
            for b in self.articulations(block, a) {
                if b > a && !beside.contains(&b) {
                    let sides = self.sides(block, &[a, b], &[]);
                    let least = sides.iter().map(Vec::len).min().unwrap_or_default();
                    found.push((least, [a, b]));
                }
            }
        }
        found.sort_unstable();
        found.into_iter().map(|(_, pair)| pair).collect()
    }

    /// The nodes without which, and without `a`, a block falls apart: articulations of the bipartite
    /// graph of nodes and members without `a`.
    fn articulations(&self, block: &[usize], a: u32) -> Vec<u32> {
        let places = block.iter().zip(self.nodes as u32..);
        let both = places.flat_map(|(&k, member)| {
            let nodes = self.lists[k].iter().filter(move |&&v| v != a);
            nodes.flat_map(move |&v| [(v, member), (member, v)])
        });
        let neighbours = Lists::group(self.nodes + block.len(), both);
        let mut times = vec![0; self.nodes];
        biconnected_components(&neighbours, |component| {
            for &v in component {
                if let Some(times) = times.get_mut(v as usize) {
                    *times += 1;
                }
            }
        });
        (0..)
            .zip(times)
            .filter(|&(_, times)| times > 1)
            .map(|(v, _)| v)
            .collect()
    }

    fn excess(&self, block: &[usize]) -> i64 {
        excess(block.iter().map(|&k| &self.lists[k][..]))
    }

    /// The blocks in an order as it is asked for, with their pairs; `None` if there is none.
    fn ordered(&self, blocks: &[Vec<usize>], pairs: &BTreeSet<[u32; 2]>) -> Option<Vec<Factor>> {
        let nodes: Vec<BTreeSet<u32>> = blocks
            .iter()
            .map(|block| {
                block
                    .iter()
                    .flat_map(|&k| &self.lists[k])
                    .copied()
                    .collect()
            })
            .collect();
        let joints = self.joints(blocks, &nodes, pairs);
        let mut of_block = vec![Vec::new(); blocks.len()];
        for (joint, members) in joints.iter().enumerate() {
            members
                .iter()
                .for_each(|&block| of_block[block].push(joint));
        }
        let (mut order, mut met) = (vec![0], vec![false; blocks.len()]);
        met[0] = true;
        let mut next = 0;
        while let Some(&block) = order.get(next) {
            next += 1;
            for &other in of_block[block].iter().flat_map(|&joint| &joints[joint]) {
                if !std::mem::replace(&mut met[other], true) {
                    order.push(other);
                }
            }
        }
        let order: Vec<(Vec<usize>, &BTreeSet<u32>)> = order
            .into_iter()
            .map(|block| (blocks[block].clone(), &nodes[block]))
            .collect();
        (order.len() == blocks.len()).then(|| self.paired(order))?
    }

    /// What blocks hang together in, as lists of these: members that are in several, and pairs.
    fn joints(
        &self,
        blocks: &[Vec<usize>],
        nodes: &[BTreeSet<u32>],
        pairs: &BTreeSet<[u32; 2]>,
    ) -> Vec<Vec<usize>> {
        let mut of_member = vec![Vec::new(); self.lists.len()];
        for (block, members) in blocks.iter().enumerate() {
            members.iter().for_each(|&k| of_member[k].push(block));
        }
        let members = of_member.into_iter().filter(|blocks| blocks.len() > 1);
        let of_pair = |pair: &[u32; 2]| {
            let holds = |&block: &usize| pair.iter().all(|v| nodes[block].contains(v));
            (0..blocks.len()).filter(holds).collect()
        };
        members.chain(pairs.iter().map(of_pair)).collect()
    }

    /// Finds the joint pairs of blocks in an order, by (S25) of docs/certificate.md; `None` if one of
    /// them has something else in common with those before it.
    fn paired(&self, order: Vec<(Vec<usize>, &BTreeSet<u32>)>) -> Option<Vec<Factor>> {
        let mut pairs = BTreeSet::new();
        let mut seen = BTreeSet::new();
        let mut used = BTreeSet::new();
        for (place, (members, nodes)) in order.iter().enumerate() {
            let common: Vec<u32> = nodes.intersection(&seen).copied().collect();
            let mut joints = members.iter().filter(|&k| used.contains(k));
            let in_member = joints.any(|&k| common.iter().all(|v| self.lists[k].contains(v)));
            if place > 0 && !in_member {
                pairs.insert(<[u32; 2]>::try_from(common).ok()?);
            }
            seen.extend(nodes.iter().copied());
            used.extend(members.iter().copied());
        }
        let factor = |(members, nodes): (Vec<usize>, &BTreeSet<u32>)| {
            let holds = |pair: &&[u32; 2]| pair.iter().all(|v| nodes.contains(v));
            let pairs = pairs.iter().filter(holds).copied().collect();
            Factor { members, pairs }
        };
        Some(order.into_iter().map(factor).collect())
    }
}

/// The members of a block that are not in a part of it.
fn without(block: &[usize], part: &[usize]) -> Vec<usize> {
    let part: BTreeSet<usize> = part.iter().copied().collect();
    block
        .iter()
        .copied()
        .filter(|k| !part.contains(k))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::{Step, Watch};

    fn found(members: &[&[u32]]) -> Vec<(Vec<usize>, Vec<[u32; 2]>)> {
        let members: Vec<Vec<u32>> = members.iter().map(|member| member.to_vec()).collect();
        let watch = Watch::default();
        let work = watch.task(Step::Solutions, 1).begin(0);
        let factors = factors(&members, |_| true, usize::MAX, &work).into_iter();
        factors
            .map(|factor| (factor.members, factor.pairs))
            .collect()
    }

    /// Three triangles in a row at two edges, then at a body.
    #[test]
    fn members_that_separate() {
        let row: [&[u32]; 7] = [
            &[0, 1],
            &[0, 2],
            &[1, 2],
            &[1, 3],
            &[2, 3],
            &[2, 4],
            &[3, 4],
        ];
        let expected = [vec![0, 1, 2], vec![2, 3, 4], vec![4, 5, 6]];
        assert_eq!(found(&row), expected.map(|members| (members, vec![])));
        let body: [&[u32]; 5] = [&[0, 1, 2, 3, 4], &[0, 5], &[1, 5], &[3, 6], &[4, 6]];
        let expected = [vec![0, 1, 2], vec![0, 3, 4]];
        assert_eq!(found(&body), expected.map(|members| (members, vec![])));
    }

    /// Two K_4 without an edge, glued at its ends. Each has six equations to spare.
    #[test]
    fn two_nodes_that_separate() {
        let row: [&[u32]; 10] = [
            &[0, 2],
            &[0, 3],
            &[1, 2],
            &[1, 3],
            &[2, 3],
            &[0, 4],
            &[0, 5],
            &[1, 4],
            &[1, 5],
            &[4, 5],
        ];
        let pairs = vec![[0, 1]];
        let expected = [
            (vec![0, 1, 2, 3, 4], pairs.clone()),
            (vec![5, 6, 7, 8, 9], pairs),
        ];
        let mut factors = found(&row);
        factors.sort();
        assert_eq!(factors, expected);
        // A cycle of six has not enough of them.
        let cycle: [&[u32]; 6] = [&[0, 1], &[1, 2], &[2, 3], &[3, 4], &[4, 5], &[0, 5]];
        assert_eq!(found(&cycle).len(), 1);
    }
}
