//! `counting` (section 7 of the specification): upper bounds on the rank by the numbers of nodes of
//! blocks, and hubs.

use crate::document::{Block, Counting, Hub, Model};
use crate::forest::{root, unite};
use crate::rejection::{Checked, Within, ensure};
use crate::structure::{Part, Structure};

/// Verifies `counting`; returns the bound on the rank of the piece (theory, Theorems 5.1, 5.5
/// and, with displacements, 13.6 and 13.22).
pub(crate) fn check_counting(
    evidence: &Counting,
    structure: &Structure,
    piece: &Part,
) -> Checked<i64> {
    let blocks = &evidence.blocks;
    let list = blocks.iter().map(|block| (&block.bodies, &block.edges));
    let (parts, _) = structure
        .partition(piece, list)
        .within(|| "blocks".into())?;
    let mut sum = structure.group_rank(piece);
    for (k, (part, block)) in parts.iter().zip(blocks).enumerate() {
        let bound = check_block(block, part, structure);
        sum += bound.within(|| format!("blocks[{k}]"))?;
    }
    ensure!(
        sum == evidence.bound,
        "the bound is {}, but the blocks sum up to {sum}",
        evidence.bound
    );
    Ok(sum)
}

/// Verifies a block of these members; returns what it contributes.
fn check_block(block: &Block, part: &Part, structure: &Structure) -> Checked<i64> {
    let model = structure.setting.model;
    let mut bound = structure.block_rank(part);
    ensure!(block.hubs.len() <= 1, "more than one hub");
    ensure!(
        block.hubs.is_empty() || !model.is_linear(),
        "a hub in the {model} model"
    );
    for hub in &block.hubs {
        bound -= check_hub(hub, structure, part).within(|| "hubs[0]".into())?;
    }
    Ok(bound)
}

/// Verifies a hub; returns what it takes off (theory, Theorem 5.2).
fn check_hub(hub: &Hub, structure: &Structure, block: &Part) -> Checked<i64> {
    ensure!(
        structure.nodes(block).binary_search(&hub.node).is_ok(),
        "node {} is not in the block",
        hub.node
    );
    let list = hub.parts.iter().map(|part| (&part.bodies, &part.edges));
    let (parts, owner) = structure.partition(block, list).within(|| "parts".into())?;
    let split = SplitGraph::new(hub, structure, block, parts, &owner)?;
    ensure!(
        components(structure, block, hub.node, |_| 0) == 1,
        "the block is not connected"
    );
    let kappa = split.components(structure, block, &owner);
    ensure!(
        kappa == hub.components,
        "the split graph has {kappa} components, not {}",
        hub.components
    );
    let s =
        split.check_groups(structure)? - Model::Calibrated.required(structure.nodes(block).len());
    let less = hub.split.len() as i64 - (kappa as i64 - 1) - 3 * s;
    ensure!(
        less == hub.less && less >= 1,
        "the hub takes off {less}, not {}",
        hub.less
    );
    Ok(less)
}

/// A block in which some parts have their own copies of a node.
struct SplitGraph<'h> {
    hub: &'h Hub,
    parts: Vec<Part>,
    /// Which parts contain the node, and which have their own copy.
    contains: Vec<bool>,
    is_split: Vec<bool>,
}

impl<'h> SplitGraph<'h> {
    /// Sees that the parts that are split are parts that contain the node.
    fn new(
        hub: &'h Hub,
        structure: &Structure,
        block: &Part,
        parts: Vec<Part>,
        owner: &[usize],
    ) -> Checked<SplitGraph<'h>> {
        ensure!(
            is_increasing(&hub.split, parts.len()),
            "`split` is not an increasing list of parts"
        );
        let mut contains = vec![false; parts.len()];
        for (&member, &part) in block.iter().zip(owner) {
            contains[part] |= structure.nodes_of(member).binary_search(&hub.node).is_ok();
        }
        ensure!(
            hub.split.iter().all(|&part| contains[part]),
            "a part is split that does not contain node {}",
            hub.node
        );
        let mut is_split = vec![false; parts.len()];
        hub.split.iter().for_each(|&part| is_split[part] = true);
        Ok(SplitGraph {
            hub,
            parts,
            contains,
            is_split,
        })
    }

    /// Whether a part contains the remaining node.
    fn remains(&self, part: usize) -> bool {
        self.contains[part] && !self.is_split[part]
    }

    /// The number of connected components; the remaining node is one if no part contains it.
    fn components(&self, structure: &Structure, block: &Part, owner: &[usize]) -> usize {
        // Copy 0 is the remaining node, copy k + 1 that of part k.
        let copy = |position: usize| match owner[position] {
            part if self.is_split[part] => part + 1,
            _ => 0,
        };
        let alone = !(0..self.parts.len()).any(|part| self.remains(part));
        components(structure, block, self.hub.node, copy) + usize::from(alone)
    }

    /// Sees that the groups are a partition of the parts; returns the sum of 3 n_g - 4 over them.
    fn check_groups(&self, structure: &Structure) -> Checked<i64> {
        let (mut grouped, mut sum) = (vec![false; self.parts.len()], 0);
        for (k, group) in self.hub.groups.iter().enumerate() {
            ensure!(
                !group.is_empty() && is_increasing(group, self.parts.len()),
                "groups[{k}] is not an increasing list of parts"
            );
            for &part in group {
                let before = std::mem::replace(&mut grouped[part], true);
                ensure!(!before, "part {part} stands in two groups");
            }
            sum += Model::Calibrated.required(self.group_nodes(structure, group));
        }
        ensure!(
            grouped.iter().all(|&grouped| grouped),
            "a part is in no group"
        );
        Ok(sum)
    }

    /// The number of nodes of a group in the split graph.
    fn group_nodes(&self, structure: &Structure, group: &[usize]) -> usize {
        let union: Part = group
            .iter()
            .flat_map(|&part| &self.parts[part])
            .copied()
            .collect();
        let once = usize::from(group.iter().any(|&part| self.contains[part]));
        let remaining = usize::from(group.iter().any(|&part| self.remains(part)));
        let copies = group.iter().filter(|&&part| self.is_split[part]).count();
        structure.nodes(&union).len() - once + remaining + copies
    }
}

fn is_increasing(list: &[usize], limit: usize) -> bool {
    list.is_sorted_by(|a, b| a < b) && list.iter().all(|&part| part < limit)
}

/// The number of connected components that the members of a block form if each uses its own copy of
/// a node.
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
    let is_root = |&position: &usize| root(&mut forest, position) == position;
    (0..block.len()).filter(is_root).count()
}
