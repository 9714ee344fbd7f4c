//! Upper bounds on the rank by counting nodes of blocks, and hubs (section 7 of the specification).

use crate::json::{Members, Value};
use crate::pieces::{Forest, Part, Structure};
use crate::rank::Model;
use crate::rejection::{Checked, Rejection, Within, ensure};

/// Verifies `counting`; returns the bound on the rank of the piece.
pub(crate) fn counting(members: &mut Members, model: Model, structure: &Structure, piece: &Part) -> Checked<i64> {
    let (blocks, _) = structure.read_partition(piece, "blocks", members, |members, block| {
        let hubs = members.read("hubs", Value::list)?;
        ensure!(hubs.len() <= 1, "more than one hub");
        ensure!(hubs.is_empty() || model == Model::Projective, "hubs are not evidence in the calibrated model");
        let less = hubs.first().map(|value| hub(value, structure, block).within(|| "hubs[0]".into()));
        Ok(model.required(structure.size(block)) - less.transpose()?.unwrap_or(0))
    })?;
    let sum: i64 = blocks.iter().map(|(_, bound)| bound).sum();
    let bound = members.read("bound", Value::int)?;
    ensure!(sum == bound, "the bound is {bound}, but the blocks sum up to {sum}");
    Ok(bound)
}

/// Verifies one hub of a block; returns what it takes off.
fn hub(value: &Value, structure: &Structure, block: &Part) -> Checked<i64> {
    let mut members = value.members()?;
    let node = members.read("node", Value::count)?;
    let node = u32::try_from(node).map_err(|_| Rejection::new(format!("{node} is not a node")))?;
    let (parts, owner) = structure.read_partition(block, "parts", &mut members, |_, _| Ok(()))?;
    let parts: Vec<Part> = parts.into_iter().map(|(part, ())| part).collect();
    let split = members.read("split", |list| list.increasing(parts.len()))?;
    let groups = members.read("groups", |list| {
        list.list()?.iter().map(|group| group.increasing(parts.len())).collect::<Checked<Vec<_>>>()
    })?;
    let claimed_components = members.read("components", Value::count)?;
    let claimed_less = members.read("less", Value::int)?;
    members.end()?;

    let contains: Vec<bool> = parts.iter().map(|part| structure.contains(part, node)).collect();
    let mut is_split = vec![false; parts.len()];
    for &part in &split {
        ensure!(contains[part], "part {part} is split, but does not contain node {node}");
        is_split[part] = true;
    }
    ensure!(components(structure, block, node, |_| 0, 0) == 1, "the block is not connected");
    // Copy 0 is the remaining node, copy k + 1 that of part k.
    let copy = |member: usize| {
        if is_split[owner[member]] { owner[member] + 1 } else { 0 }
    };
    let remains = |part: usize| contains[part] && !is_split[part];
    let alone = usize::from(!(0..parts.len()).any(remains));
    let kappa = components(structure, block, node, copy, parts.len()) + alone;
    ensure!(kappa as u64 == claimed_components, "the split graph has {kappa} components, not {claimed_components}");

    let mut counted = vec![false; parts.len()];
    let mut excess = -Model::Calibrated.required(structure.size(block));
    for group in &groups {
        ensure!(!group.is_empty(), "a group without parts");
        let mut union = Part::default();
        for &part in group {
            ensure!(!std::mem::replace(&mut counted[part], true), "part {part} stands in two groups");
            union.bodies.extend(&parts[part].bodies);
            union.edges.extend(&parts[part].edges);
        }
        union.bodies.sort_unstable();
        let copies =
            group.iter().filter(|&&part| is_split[part]).count() + usize::from(group.iter().any(|&part| remains(part)));
        let once = usize::from(group.iter().any(|&part| contains[part]));
        excess += Model::Calibrated.required(structure.size(&union) - once + copies);
    }
    ensure!(counted.iter().all(|&counted| counted), "a part is in no group");
    let less = split.len() as i64 - (kappa as i64 - 1) - 3 * excess;
    ensure!(less == claimed_less, "the hub takes off {less}, not {claimed_less}");
    ensure!(less >= 1, "the hub takes off nothing");
    Ok(less)
}

/// The number of connected components that the members of a block form if each uses its own copy of a node.
fn components(structure: &Structure, block: &Part, node: u32, copy: impl Fn(usize) -> usize, copies: usize) -> usize {
    let ends: Vec<Vec<u32>> = structure.member_ends(block).collect();
    let mut known: Vec<u32> = ends.iter().flatten().copied().collect();
    known.sort_unstable();
    known.dedup();
    let members = block.len();
    let mut forest = Forest::new(members + known.len() + copies + 1);
    for (member, ends) in ends.iter().enumerate() {
        for end in ends {
            let at = if *end == node { known.len() + copy(member) } else { known.partition_point(|other| other < end) };
            forest.unite(member, members + at);
        }
    }
    // Roots are smallest indices, so that every component has its root among the members.
    (0..members).filter(|&member| forest.find(member) == member).count()
}
