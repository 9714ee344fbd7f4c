//! Members, and their merges: conditions (S1) to (S3) of section 12.

use super::check_part;
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

    /// Makes one member of several.
    pub(super) fn merge(&mut self, merge: &Merge, meter: &Meter) -> Checked<()> {
        ensure!(
            merge.with.len() >= 2 && merge.with.is_sorted_by(|a, b| a < b),
            "`with` is not an increasing list of two members or more"
        );
        let taken = merge.with.iter().map(|&number| self.take(number));
        let taken = taken.collect::<Checked<Vec<Nodes>>>()?;
        let size: usize = taken.iter().map(Nodes::len).sum();
        meter.charge(SPARSE * (size + merge.with.len() * merge.at.len()) as u64)?;
        if merge.rule == "part" {
            check_parted(merge, &taken, meter)?;
        } else {
            check_rule(merge, &taken)?;
        }
        self.0.push(Some(taken.into_iter().flatten().collect()));
        Ok(())
    }

    /// The nodes of a member that is left.
    pub(super) fn get(&self, number: usize) -> Option<&Nodes> {
        self.0.get(number)?.as_ref()
    }

    /// The numbers of the members that are left.
    pub(super) fn numbers(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.0.len()).filter(|&number| self.0[number].is_some())
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

/// (S2): two nodes that members share (theory, Theorem 4.1, rule 2), three corners (rule 3), or the
/// biclique K_{2,3} (Theorem 10.3).
fn check_rule(merge: &Merge, taken: &[Nodes]) -> Checked<()> {
    let pairs: Vec<[u32; 2]> = match (merge.rule.as_str(), merge.at.as_slice()) {
        ("shared", &[a, b]) => vec![[a, b]],
        ("triangle", &[a, b, c]) => vec![[a, b], [a, c], [b, c]],
        ("biclique", &[a, b, ref others @ ..]) if others.len() == 3 => {
            others.iter().flat_map(|&v| [[a, v], [b, v]]).collect()
        }
        (rule, at) => {
            let reason = format!("`{rule}` is no rule for {} nodes", at.len());
            return Err(Failure::rejected(reason));
        }
    };
    let different: HashSet<&u32> = merge.at.iter().collect();
    ensure!(
        different.len() == merge.at.len(),
        "the nodes of `at` are not different"
    );
    ensure!(
        merge.solutions.is_none(),
        "evidence for a rule that needs none"
    );
    let holds = |nodes: &Nodes, pair: &[u32; 2]| pair.iter().all(|node| nodes.contains(node));
    for pair in &pairs {
        ensure!(
            taken.iter().any(|nodes| holds(nodes, pair)),
            "no member of `with` holds {} and {}",
            pair[0],
            pair[1]
        );
    }
    for (nodes, number) in taken.iter().zip(&merge.with) {
        ensure!(
            pairs.iter().any(|pair| holds(nodes, pair)),
            "member {number} holds no pair of the rule"
        );
    }
    Ok(())
}

/// (S3): a part with one solution, and members that share two nodes with it (theory, Proposition
/// 10.11).
fn check_parted(merge: &Merge, taken: &[Nodes], meter: &Meter) -> Checked<()> {
    ensure!(
        merge.at.is_sorted_by(|a, b| a < b),
        "`at` is not an increasing list of nodes"
    );
    let inside = |nodes: &Nodes| -> Vec<u32> {
        let inside = merge.at.iter().filter(|node| nodes.contains(node));
        inside.copied().collect()
    };
    let cut: Vec<Vec<u32>> = taken.iter().map(inside).collect();
    let few = cut
        .iter()
        .zip(&merge.with)
        .find(|(nodes, _)| nodes.len() < 2);
    ensure!(
        few.is_none(),
        "member {} has fewer than two nodes in `at`",
        few.map_or(0, |(_, &number)| number)
    );
    let missing = || Failure::rejected("a part without evidence that it has one solution");
    let evidence = merge.solutions.as_ref().ok_or_else(missing)?;
    check_part(evidence, cut, meter)
}
