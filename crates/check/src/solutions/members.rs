//! Members, and their merges: conditions (S1) to (S3), (U4) and (U6) of section 12.

use super::stresses::Rigid;
use crate::document::solutions::Merge;
use crate::elimination::SPARSE;
use crate::limits::Meter;
use crate::rejection::{Checked, Failure, ensure};
use std::collections::{BTreeMap, BTreeSet, HashSet};

pub(super) type Nodes = BTreeSet<u32>;

/// Members by their numbers, each with its shared nodes; `None` for those that were used up.
pub(super) struct Members(Vec<Option<Nodes>>);

impl Members {
    /// Of the nodes of members those count that lie in two members at least.
    pub(super) fn new(members: Vec<Vec<u32>>) -> Members {
        let members = shared(members.into_iter());
        Members(members.into_iter().map(Some).collect())
    }

    /// The members that are left, each with those of its nodes that lie in two of them at least, in
    /// increasing order.
    pub(super) fn left(&self) -> Vec<Vec<u32>> {
        let left = self.0.iter().flatten();
        let left = shared(left.map(|nodes| nodes.iter().copied().collect()));
        left.into_iter()
            .map(|nodes| nodes.into_iter().collect())
            .collect()
    }

    /// Makes one member of several; `rigid` is the part of the round.
    pub(super) fn merge(&mut self, merge: &Merge, rigid: &Rigid, meter: &Meter) -> Checked<()> {
        ensure!(
            merge.with.len() >= 2 && merge.with.is_sorted_by(|a, b| a < b),
            "`with` is not an increasing list of two members or more"
        );
        let taken = merge.with.iter().map(|&number| self.take(number));
        let taken = taken.collect::<Checked<Vec<Nodes>>>()?;
        let size: usize = taken.iter().map(Nodes::len).sum();
        meter.charge(SPARSE * (size + merge.with.len() * merge.at.len()) as u64)?;
        match merge.rule.as_str() {
            "removed" | "stressed" => check_node(merge, &taken, rigid)?,
            _ => check_rule(merge, &taken)?,
        }
        self.0.push(Some(taken.into_iter().flatten().collect()));
        Ok(())
    }

    /// The members that are left.
    pub(super) fn all(&self) -> impl Iterator<Item = &Nodes> {
        self.0.iter().flatten()
    }

    fn take(&mut self, number: usize) -> Checked<Nodes> {
        let member = self.0.get_mut(number).and_then(Option::take);
        member.ok_or_else(|| Failure::rejected(format!("{number} is no member that is left")))
    }
}

/// Of the nodes of each member those that lie in two members at least.
fn shared(members: impl Iterator<Item = Vec<u32>>) -> Vec<Nodes> {
    let members: Vec<Nodes> = members.map(|nodes| nodes.into_iter().collect()).collect();
    let mut times: BTreeMap<u32, usize> = BTreeMap::new();
    for &node in members.iter().flatten() {
        *times.entry(node).or_default() += 1;
    }
    let shared = |nodes: Nodes| nodes.into_iter().filter(|node| times[node] > 1).collect();
    members.into_iter().map(shared).collect()
}

/// (S2): two nodes that members share (theory, Theorem 4.1, rule 2), three corners (rule 3), the
/// biclique K_{2,3} (Theorem 10.3), a tripod (Theorem 19.7), or a link (Theorem 19.8).
fn check_rule(merge: &Merge, taken: &[Nodes]) -> Checked<()> {
    let pairs: Vec<[u32; 2]> = match (merge.rule.as_str(), merge.at.as_slice()) {
        ("shared", &[a, b]) => vec![[a, b]],
        ("triangle", &[a, b, c]) => vec![[a, b], [a, c], [b, c]],
        ("biclique", &[a, b, ref others @ ..]) if others.len() == 3 => {
            others.iter().flat_map(|&v| [[a, v], [b, v]]).collect()
        }
        ("tripod", &[a, b, c, d, e, f]) => {
            let is_body = |nodes: &&Nodes| has(nodes, &[a, b, c]) && !has_any(nodes, &[d, e, f]);
            ensure!(
                taken.iter().any(|nodes| is_body(&nodes)),
                "no member of `with` has the first three nodes of `at` and none of the others"
            );
            vec![[a, b], [a, c], [d, a], [d, e], [e, b], [d, f], [f, c]]
        }
        ("link", &[a, b, c, d, e, f, g]) => {
            check_link([a, b, c, d, e, f, g], taken)?;
            vec![[a, b], [d, e], [a, d], [b, e], [c, g], [g, f]]
        }
        (rule, at) => {
            let reason = format!("`{rule}` is no rule for {} nodes", at.len());
            return Err(Failure::rejected(reason));
        }
    };
    let different: HashSet<&u32> = merge.at.iter().collect();
    ensure!(
        different.len() == merge.at.len() || merge.rule == "link",
        "the nodes of `at` are not different"
    );
    check_pairs(merge, &pairs, taken)
}

fn has(nodes: &Nodes, all: &[u32]) -> bool {
    all.iter().all(|node| nodes.contains(node))
}

fn has_any(nodes: &Nodes, some: &[u32]) -> bool {
    some.iter().any(|node| nodes.contains(node))
}

/// (S2), a link: which of its nodes may be equal, and the two members that it joins.
fn check_link([a, b, c, d, e, f, g]: [u32; 7], taken: &[Nodes]) -> Checked<()> {
    let different: HashSet<u32> = [a, b, d, e, g].into();
    ensure!(
        different.len() == 5,
        "two pairs of the link have a node in common"
    );
    ensure!(
        ![d, e, g].contains(&c) && ![a, b, c, g].contains(&f),
        "an end of the path of the link is where none can be"
    );
    ensure!(
        (c, f) != (a, d) && (c, f) != (b, e),
        "the plane of {c}, {g} and {f} holds a pair of the link"
    );
    let ends = |all: [u32; 3]| taken.iter().filter(move |nodes| has(nodes, &all));
    let are_apart = |first: &Nodes, second: &Nodes| {
        first.is_disjoint(second) && !first.contains(&g) && !second.contains(&g)
    };
    ensure!(
        ends([a, b, c]).any(|first| ends([d, e, f]).any(|second| are_apart(first, second))),
        "the link does not join two members without a node in common, nor with {g}"
    );
    Ok(())
}

/// (U4): a node outside of the part of the round, and nodes of it (theory, Theorems 19.3 and 19.6).
/// (U6): a node inside, and one of each set that contains it (Theorem 19.11).
fn check_node(merge: &Merge, taken: &[Nodes], rigid: &Rigid) -> Checked<()> {
    let (v, ends) = merge.at.split_first().unwrap_or((&0, &[]));
    let different: HashSet<&u32> = merge.at.iter().collect();
    ensure!(
        ends.len() >= 2 && different.len() == merge.at.len(),
        "`at` has less than three nodes, or one twice"
    );
    if merge.rule == "removed" {
        ensure!(
            !rigid.part.contains(v),
            "node {v} is in the part, which is to be rigid without it"
        );
        let is_inside = has(&rigid.part, ends);
        ensure!(is_inside, "a neighbour of {v} is not in the part");
    } else {
        let none = || Failure::rejected("`stressed` in a round without `stresses`");
        let stresses = rigid.stresses.as_ref().ok_or_else(none)?;
        stresses.check_node(*v, ends)?;
    }
    let pairs: Vec<[u32; 2]> = ends.iter().map(|&end| [*v, end]).collect();
    check_pairs(merge, &pairs, taken)
}

/// (S3): each pair lies in a member, and each member holds a pair.
fn check_pairs(merge: &Merge, pairs: &[[u32; 2]], taken: &[Nodes]) -> Checked<()> {
    for pair in pairs {
        ensure!(
            taken.iter().any(|nodes| has(nodes, pair)),
            "no member of `with` holds {} and {}",
            pair[0],
            pair[1]
        );
    }
    for (nodes, number) in taken.iter().zip(&merge.with) {
        ensure!(
            pairs.iter().any(|pair| has(nodes, pair)),
            "member {number} holds no pair of the rule"
        );
    }
    Ok(())
}
