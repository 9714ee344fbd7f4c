//! Upper bounds on the rank by counting nodes of blocks, and hubs (section 7 of the specification).

use crate::document::{Counting, Hub, Model};
use crate::evidence::Setting;
use crate::pieces::{Part, Structure, root, unite};
use crate::rejection::{Checked, Within, ensure};

/// Verifies `counting`; returns the bound on the rank of the piece.
pub(crate) fn check_counting(evidence: &Counting, setting: &Setting, piece: &Part) -> Checked<i64> {
    let (structure, list) = (
        setting.structure,
        evidence
            .blocks
            .iter()
            .map(|block| (&block.bodies, &block.edges)),
    );
    let (parts, _) = structure
        .partition(piece, list)
        .within(|| "blocks".into())?;
    let mut sum = 0;
    for (k, (part, block)) in parts.iter().zip(&evidence.blocks).enumerate() {
        sum += setting.model.required(structure.nodes(part).len());
        let fine =
            block.hubs.is_empty() || block.hubs.len() == 1 && setting.model == Model::Projective;
        ensure!(
            fine,
            "more than one hub in a block, or any in the calibrated model"
        );
        for hub in &block.hubs {
            sum -= hub_takes_off(hub, structure, part).within(|| format!("blocks[{k}].hubs[0]"))?;
        }
    }
    ensure!(
        sum == evidence.bound,
        "the bound is {}, but the blocks sum up to {sum}",
        evidence.bound
    );
    Ok(sum)
}

fn hub_takes_off(hub: &Hub, structure: &Structure, block: &Part) -> Checked<i64> {
    let list = hub.parts.iter().map(|part| (&part.bodies, &part.edges));
    let (parts, owner) = structure.partition(block, list).within(|| "parts".into())?;
    let increasing = |list: &[usize]| {
        list.is_sorted_by(|a, b| a < b) && list.iter().all(|&part| part < parts.len())
    };
    ensure!(
        increasing(&hub.split),
        "`split` is not an increasing list of parts"
    );
    let contains: Vec<bool> = parts
        .iter()
        .map(|part| structure.nodes(part).contains(&hub.node))
        .collect();
    let is_split: Vec<bool> = (0..parts.len())
        .map(|part| hub.split.contains(&part))
        .collect();
    let split = hub.split.iter().all(|&part| contains[part]);
    ensure!(
        split,
        "a part is split that does not contain node {}",
        hub.node
    );
    let remains = |part: usize| contains[part] && !is_split[part];

    ensure!(
        components(structure, block, hub.node, |_| 0) == 1,
        "the block is not connected"
    );
    // Copy 0 is the remaining node, copy k + 1 that of part k.
    let copy = |position: usize| {
        if is_split[owner[position]] {
            owner[position] + 1
        } else {
            0
        }
    };
    let alone = usize::from(!(0..parts.len()).any(remains));
    let kappa = components(structure, block, hub.node, copy) + alone;
    ensure!(
        kappa == hub.components,
        "the split graph has {kappa} components, not {}",
        hub.components
    );

    let mut grouped = vec![false; parts.len()];
    let mut s = -Model::Calibrated.required(structure.nodes(block).len());
    for (k, group) in hub.groups.iter().enumerate() {
        ensure!(
            !group.is_empty() && increasing(group),
            "groups[{k}] is not an increasing list of parts"
        );
        for &part in group {
            ensure!(
                !std::mem::replace(&mut grouped[part], true),
                "part {part} stands in two groups"
            );
        }
        let union: Part = group
            .iter()
            .flat_map(|&part| &parts[part])
            .copied()
            .collect();
        let once = usize::from(group.iter().any(|&part| contains[part]));
        let remaining = usize::from(group.iter().any(|&part| remains(part)));
        let copies = remaining + group.iter().filter(|&&part| is_split[part]).count();
        s += Model::Calibrated.required(structure.nodes(&union).len() - once + copies);
    }
    ensure!(
        grouped.iter().all(|&grouped| grouped),
        "a part is in no group"
    );
    let less = hub.split.len() as i64 - (kappa as i64 - 1) - 3 * s;
    ensure!(
        less == hub.less && less >= 1,
        "the hub takes off {less}, not {}",
        hub.less
    );
    Ok(less)
}

/// The number of connected components that the members of a block form if each uses its own copy of a node.
fn components(
    structure: &Structure,
    block: &Part,
    split: u32,
    copy: impl Fn(usize) -> usize,
) -> usize {
    let nodes = structure.nodes(block);
    // Members, nodes, and copies, of which there are no more than members and one.
    let mut forest: Vec<usize> = (0..2 * block.len() + nodes.len() + 1).collect();
    for (position, &member) in block.iter().enumerate() {
        for &node in structure.nodes_of(member) {
            let own = nodes.partition_point(|&other| other < node);
            let at = if node == split {
                nodes.len() + copy(position)
            } else {
                own
            };
            unite(&mut forest, position, block.len() + at);
        }
    }
    // Roots are smallest indices, so that every component has its root among the members.
    (0..block.len())
        .filter(|&position| root(&mut forest, position) == position)
        .count()
}
