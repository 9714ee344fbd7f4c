//! Known displacements: a hypothesis of the claim (section 3 of the specification; theory, Theorem
//! 13.16).

use crate::document::Model;
use crate::graph::{Graph, hex};
use crate::json::Big;
use crate::rejection::{Checked, ensure};
use sha2::{Digest, Sha256};
use std::fmt;

/// The displacements that a certificate supposes to be known.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Displacements {
    /// How many groups of cameras there are, within which they are known.
    pub groups: usize,
    /// How many cameras are in groups.
    pub nodes: usize,
    /// Whether their vectors are given: then the claim is about these.
    pub given: bool,
    /// The SHA-256 of their canonical form, in lower-case hexadecimal digits.
    pub sha256: String,
}

impl fmt::Display for Displacements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Displacements {
            groups,
            nodes,
            given,
            sha256,
        } = self;
        let given = if *given { " with given vectors" } else { "" };
        let plural = if *groups == 1 { "" } else { "s" };
        write!(
            f,
            "{nodes} nodes in {groups} group{plural}{given}, SHA-256 {sha256}"
        )
    }
}

/// Verifies the groups of a graph with so many nodes, and with known parts, if there are any.
pub(crate) fn check_groups(
    groups: &[Vec<u32>],
    model: Model,
    nodes: usize,
    parts: &[Vec<u32>],
    vectors: Option<&[Vec<[Big<i128>; 3]>]>,
) -> Checked<Displacements> {
    ensure!(model.in_space(), "known displacements in the {model} model");
    ensure!(parts.is_empty(), "there are known parts as well");
    check_form(groups, nodes)?;
    Ok(Displacements {
        groups: groups.len(),
        nodes: groups.iter().map(Vec::len).sum(),
        given: vectors.is_some(),
        sha256: hex(&digest(groups, vectors)),
    })
}

/// Verifies that groups are well formed, in a graph with so many nodes.
pub(crate) fn check_form(groups: &[Vec<u32>], nodes: usize) -> Checked<()> {
    ensure!(!groups.is_empty(), "there is no group");
    let mut seen = vec![false; nodes];
    for (k, group) in groups.iter().enumerate() {
        ensure!(group.len() >= 2, "group {k} has fewer than two nodes");
        ensure!(
            group.is_sorted_by(|a, b| a < b),
            "group {k} is not increasing"
        );
        for &node in group {
            let known = (node as usize) < nodes;
            ensure!(known, "the graph has no node {node}");
            let before = std::mem::replace(&mut seen[node as usize], true);
            ensure!(!before, "node {node} is in two groups");
        }
    }
    ensure!(
        groups.is_sorted_by(|a, b| a[0] < b[0]),
        "the groups are not in the order of their first nodes"
    );
    Ok(())
}

/// Sees that a certificate supposes just those that are known of the given graph.
pub(crate) fn check_given(stated: Option<&Displacements>, given: &Graph) -> Checked<()> {
    let (stated_hash, known) = (stated.map(|stated| &stated.sha256), &given.displacements);
    ensure!(
        stated_hash == known.as_ref(),
        "{}",
        match (stated, known) {
            (None, _) => "no displacements are supposed to be known".into(),
            (Some(stated), None) => format!("supposed to be known, and none are given: {stated}"),
            (Some(stated), Some(_)) => format!("others are supposed to be known: {stated}"),
        }
    );
    Ok(())
}

/// The hash of groups, and of their vectors if these are given.
pub(crate) fn digest(groups: &[Vec<u32>], vectors: Option<&[Vec<[Big<i128>; 3]>]>) -> [u8; 32] {
    let mut hash = Sha256::new();
    let version = 1 + usize::from(vectors.is_some());
    hash.update(format!("viewcert displacements {version}\n"));
    hash.update((groups.len() as u64).to_le_bytes());
    for group in groups {
        hash.update((group.len() as u64).to_le_bytes());
        group
            .iter()
            .for_each(|node| hash.update(node.to_le_bytes()));
    }
    for Big(coordinate) in vectors.into_iter().flatten().flatten().flatten() {
        hash.update(format!("{coordinate}\n"));
    }
    hash.finalize().into()
}
