//! Rounds: a part that is rigid without a node determines its neighbours there together with it, and one
//! with stresses what is at its nodes (conditions (U1) to (U6) of section 12; theory, Theorems 19.3, 19.6
//! and 19.11).

use super::members::{Members, Nodes};
use super::stresses::{Rigid, Stresses};
use crate::core::{Core, Joined};
use crate::document::solutions::Round;
use crate::elimination::SPARSE;
use crate::lower::check_rigid;
use crate::rejection::{Checked, Within, ensure};
use crate::setting::Setting;
use std::collections::{HashMap, HashSet};

/// Verifies a round, and merges what it determines.
pub(super) fn check(round: &Round, members: &mut Members, setting: &Setting) -> Checked<()> {
    check_sets(&round.sets, members, setting)?;
    let joined = round.sets.iter().map(|nodes| Joined {
        nodes,
        is_body: nodes.len() > 2,
        // Displacements belong to another model.
        is_scaled: false,
    });
    let joined: Vec<Joined> = joined.collect();
    let core = Core::new(&joined, |k| format!("sets[{k}]"), setting)?;
    check_rigid(&round.evidence, setting, &core)?;
    let stresses = round.stresses.0.as_ref();
    let stresses = stresses.map(|all| Stresses::new(all, round, (&joined, &core), setting));
    let rigid = Rigid {
        part: round.sets.iter().flatten().copied().collect(),
        stresses: stresses.transpose()?,
    };
    for (k, merge) in round.merges.iter().enumerate() {
        let merged = members.merge(merge, &rigid, setting.meter);
        merged.within(|| format!("merges[{k}]"))?;
    }
    Ok(())
}

/// (U1): sets of nodes of one member each, no two of which share two nodes.
fn check_sets(sets: &[Vec<u32>], members: &Members, setting: &Setting) -> Checked<()> {
    ensure!(sets.len() >= 2, "fewer than two sets");
    let mut inside: HashMap<u32, Vec<&Nodes>> = HashMap::new();
    for nodes in members.all() {
        setting.meter.charge(SPARSE * nodes.len() as u64)?;
        for &node in nodes {
            inside.entry(node).or_default().push(nodes);
        }
    }
    let mut before: HashMap<u32, Vec<usize>> = HashMap::new();
    for (k, nodes) in sets.iter().enumerate() {
        ensure!(
            nodes.len() >= 2 && nodes.is_sorted_by(|a, b| a < b),
            "sets[{k}] is not an increasing list of two nodes or more"
        );
        let near = nodes[..2].iter().map(|node| inside.get(node));
        let near = near.min_by_key(|near| near.map_or(0, Vec::len)).flatten();
        let near = near.into_iter().flatten();
        let work = nodes.len() * (1 + near.clone().count());
        setting.meter.charge(SPARSE * work as u64)?;
        ensure!(
            near.into_iter()
                .any(|member| nodes.iter().all(|node| member.contains(node))),
            "no member that is left has all nodes of sets[{k}]"
        );
        let mut seen = HashSet::new();
        for &node in nodes {
            let others = before.entry(node).or_default();
            setting.meter.charge(SPARSE * others.len() as u64)?;
            ensure!(
                others.iter().all(|&other| seen.insert(other)),
                "sets[{k}] shares two nodes with another set"
            );
            others.push(k);
        }
    }
    Ok(())
}
