//! Charts: which scales are one and which are unknowns. Conditions (S4) to (S6) of section 12.

use crate::document::solutions as grammar;
use crate::elimination::SPARSE;
use crate::forest::unite;
use crate::limits::Meter;
use crate::rejection::{Checked, ensure};
use std::collections::{BTreeMap, BTreeSet};

/// A core with scales. Nodes are indices in the increasing list of shared nodes.
pub(super) struct Chart {
    /// How many nodes members share.
    pub nodes: usize,
    /// Their names.
    names: Vec<u32>,
    /// The nodes of each member that is no half-edge, in the order of its chain.
    pub chains: Vec<Vec<usize>>,
    /// `[v, a, b]`: v is eliminated.
    pub half_edges: Vec<[usize; 3]>,
    /// For each pair of a chain, or of a half-edge by the number behind those of the chains, and a
    /// node the number of its unknown.
    scales: BTreeMap<(usize, usize), usize>,
    /// How many unknowns there are.
    pub unknowns: usize,
}

impl Chart {
    /// Verifies a chart of members, which are given by their shared nodes.
    pub(super) fn new(text: &grammar::Chart, left: &[Vec<u32>], meter: &Meter) -> Checked<Chart> {
        let size: usize = left.iter().map(Vec::len).sum();
        meter.charge(50 * SPARSE * size as u64)?;
        check_members(text, left)?;
        let nodes: BTreeSet<u32> = left.iter().flatten().copied().collect();
        let nodes: Vec<u32> = nodes.into_iter().collect();
        meter.allow_core(nodes.len())?;
        // All nodes are those of members, as was seen.
        let index = |node: u32| nodes.partition_point(|&other| other < node);
        let chains = text.chains.iter();
        let chains = chains.map(|chain| chain.iter().map(|&node| index(node)).collect());
        let half_edges = text.half_edges.iter().map(|nodes| nodes.map(index));
        let mut chart = Chart {
            nodes: nodes.len(),
            names: Vec::new(),
            chains: chains.collect(),
            half_edges: half_edges.collect(),
            scales: BTreeMap::new(),
            unknowns: text.unknowns.len(),
        };
        chart.check_half_edges()?;
        for (f, &[member, node]) in text.unknowns.iter().enumerate() {
            let scale = (member as usize, index(node));
            ensure!(
                nodes.get(scale.1) == Some(&node) && chart.has_scale(scale),
                "unknown {f} is no scale of a chain, nor of a half-edge at its last node"
            );
            ensure!(
                chart.scales.insert(scale, f).is_none(),
                "unknown {f} is listed twice"
            );
        }
        chart.names = nodes;
        chart.check_tree(left.len())?;
        Ok(chart)
    }

    /// (S5): a node that is eliminated lies in no other half-edge and in no chain (theory, Lemma
    /// 10.4). Its three nodes are different: members are sets, and the centres are not collinear.
    fn check_half_edges(&self) -> Checked<()> {
        let mut times = vec![0; self.nodes];
        let of_chains = self.chains.iter().flatten();
        for &node in of_chains.chain(self.half_edges.iter().flatten()) {
            times[node] += 1;
        }
        for (k, &[v, _, _]) in self.half_edges.iter().enumerate() {
            ensure!(
                times[v] == 1,
                "the first node of half-edge {k} lies elsewhere too"
            );
        }
        Ok(())
    }

    fn has_scale(&self, (member, node): (usize, usize)) -> bool {
        match self.chains.get(member) {
            Some(chain) => chain.contains(&node),
            None => {
                let half_edge = self.half_edges.get(member - self.chains.len());
                half_edge.is_some_and(|&[_, _, b]| b == node)
            }
        }
    }

    /// The unknown of a chain, or of a half-edge by the number behind those of the chains, at a
    /// node, if its scale is not one.
    pub(super) fn scale(&self, member: usize, node: usize) -> Option<usize> {
        self.scales.get(&(member, node)).copied()
    }

    /// (S6): the scales that are one are a spanning tree of members and nodes (theory, section 10).
    fn check_tree(&self, members: usize) -> Checked<()> {
        let mut forest: Vec<usize> = (0..self.nodes + members).collect();
        let chains = self.chains.iter().enumerate();
        let mut ones: Vec<(usize, usize)> = chains
            .flat_map(|(k, chain)| chain.iter().map(move |&node| (k, node)))
            .filter(|&(k, node)| self.scale(k, node).is_none())
            .collect();
        // The members of half-edge h are those behind the chains with numbers 2 h and 2 h + 1.
        for (h, &[v, a, b]) in self.half_edges.iter().enumerate() {
            let first = self.chains.len() + 2 * h;
            ones.extend([(first, v), (first, a), (first + 1, v)]);
            if self.scale(self.chains.len() + h, b).is_none() {
                ones.push((first + 1, b));
            }
        }
        let joins = ones.iter().filter(|&&(member, node)| {
            let member = self.nodes + member;
            unite(&mut forest, node, member)
        });
        let joins = joins.count();
        ensure!(
            joins == ones.len(),
            "the scales that are one close a cycle of members and nodes"
        );
        ensure!(
            joins + 1 == self.nodes + members,
            "the scales that are one do not join all members and nodes"
        );
        Ok(())
    }
}

/// (S4): the chains and half-edges are the members that are left, as sets of nodes.
fn check_members(text: &grammar::Chart, left: &[Vec<u32>]) -> Checked<()> {
    let pairs = text.half_edges.iter();
    let pairs = pairs.flat_map(|&[v, a, b]| [vec![v, a], vec![v, b]]);
    let mut charted: Vec<Vec<u32>> = text.chains.iter().cloned().chain(pairs).collect();
    charted.iter_mut().for_each(|nodes| nodes.sort_unstable());
    charted.sort_unstable();
    let mut left = left.to_vec();
    left.sort_unstable();
    ensure!(
        charted == left,
        "the chains and half-edges are not the members that are left"
    );
    ensure!(
        left.iter().all(|nodes| nodes.len() >= 2),
        "a member has fewer than two shared nodes"
    );
    Ok(())
}
