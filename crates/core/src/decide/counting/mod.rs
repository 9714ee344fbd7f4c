//! Upper bounds on the rank, by counting nodes and cycles
//! (docs/theory.md, section 5).
//!
//! *Partition*: the rank is at most the sum of `required(n_B)` over the blocks of any
//! partition of the edges. *Hub*: a block of projective cameras loses more where the
//! plane flows into a node are too few for the parts that meet there.
//!
//! What the search covers: the partition into the given components; a hub at any node
//! of a block with the components as parts and, failing that, with the members (bodies
//! and loose edges) as parts, where the block is the whole piece or one of its
//! parallel-rigid components. At a node where t parts meet, the sets that can be
//! split off with gain are those of at most (t - 1) / 3 parts, together with all the parts
//! whose flow these determine. At most 20,000 such sets are looked at for a node: all of them
//! where at most 16 parts meet. Rank is then taken off the block by the best single hub. Where that
//! does not meet the lower bound and there are at most 64 components, all this is tried again on
//! the parts whose ranks add up to that of the piece, and then with each one of the components left
//! out as a block of its own: what is rigid without it may be a smaller block that has a hub.

mod hub;
mod search;

#[cfg(test)]
pub(crate) use hub::GAMMA;
pub(crate) use search::Search;

use crate::contract::piece::{Assembly, Members};
use crate::decide::evidence::{Block, Counting};
use crate::decide::motion_class;
use crate::decide::stresses::Stresses;
use crate::geometry::model::{Model, full_rank};
use crate::geometry::plane_flow::PlaneFlows;
use crate::watch::Stopped;

/// Up to so many components each is left out in turn.
const MAX_LEFT_OUT: usize = 64;

impl Counting {
    /// The partition bound of the given blocks (Theorem 5.1; calibrated: Corollary 5.8, with
    /// displacements Theorem 13.6; affine: Corollary 13.8).
    pub(super) fn partition(model: Model, assembly: &Assembly, blocks: &[Members]) -> Self {
        Self {
            bound: blocks
                .iter()
                .map(|block| assembly.required(model, block))
                .sum(),
            blocks: blocks
                .iter()
                .map(|members| Block {
                    members: members.clone(),
                    hub: None,
                })
                .collect(),
        }
    }

    /// Bounds of parts without a member in common, as one of all their members.
    pub(super) fn join(parts: Vec<Self>) -> Self {
        let bound = parts.iter().map(|part| part.bound).sum();
        let mut blocks: Vec<Block> = parts.into_iter().flat_map(|part| part.blocks).collect();
        blocks.sort_by(|a, b| a.members.cmp(&b.members));
        Self { blocks, bound }
    }
}

/// The best bound the search finds for a piece with the given components; stops as soon
/// as it meets `target`, a lower bound on the rank.
///
/// # Errors
/// If the search was stopped.
pub(crate) fn count(
    model: Model,
    assembly: &Assembly,
    piece: &Members,
    components: &[Members],
    target: usize,
    by: &mut Search,
) -> Result<Counting, Stopped> {
    let partition = Counting::partition(model, assembly, components);
    if partition.bound <= target || model.in_space() {
        return Ok(partition);
    }
    let whole = with_hub(assembly, piece, components, by)?;
    if whole.bound <= target {
        return Ok(whole);
    }
    let mut best = by_rigid_blocks(assembly, piece, components, by)?;
    for bound in [partition, whole] {
        if bound.bound < best.bound {
            best = bound;
        }
    }
    if best.bound <= target || components.len() > MAX_LEFT_OUT {
        return Ok(best);
    }
    let dependent = by_dependent_parts(assembly, piece, components, by)?;
    if dependent.bound < best.bound {
        best = dependent;
    }
    for (k, left_out) in components.iter().enumerate() {
        if best.bound <= target {
            break;
        }
        let mut rest = Members::default();
        let others: Vec<Members> = [&components[..k], &components[k + 1..]].concat();
        others.iter().for_each(|component| rest.extend(component));
        let joined = Counting::join(vec![
            by_rigid_blocks(assembly, &rest, &others, by)?,
            Counting::partition(model, assembly, std::slice::from_ref(left_out)),
        ]);
        if joined.bound < best.bound {
            best = joined;
        }
    }
    Ok(best)
}

/// The parts of the piece whose ranks add up to that of the piece, each bounded by itself: what
/// depends on nothing else does not hide a smaller block that has a hub.
fn by_dependent_parts(
    assembly: &Assembly,
    piece: &Members,
    components: &[Members],
    by: &mut Search,
) -> Result<Counting, Stopped> {
    let core = assembly.core(piece);
    let part_of = Stresses::new(by.field, &core, piece.len(), by.random, &by.task)?.parts();
    let bounds = piece
        .grouped(|member| part_of[member])
        .into_iter()
        .map(|part| {
            by.task.check()?;
            let mut inside = within(components, &part);
            if inside.iter().map(Members::len).sum::<usize>() < part.len() {
                inside = part.singles();
            }
            match inside.len() {
                1 => Ok(Counting::partition(Model::default(), assembly, &inside)),
                _ => by_rigid_blocks(assembly, &part, &inside, by),
            }
        });
    Ok(Counting::join(bounds.collect::<Result<_, _>>()?))
}

/// The parallel-rigid components of a part as blocks, each with a hub or else divided into
/// the given components, whichever is better (Theorem 5.5).
fn by_rigid_blocks(
    assembly: &Assembly,
    part: &Members,
    components: &[Members],
    by: &mut Search,
) -> Result<Counting, Stopped> {
    let rigid = parallel_rigid_components(assembly, part, by)?;
    let blocks = rigid.iter().map(|block| {
        by.task.check()?;
        let inside = within(components, block);
        let split = Counting::partition(Model::default(), assembly, &inside);
        if inside.len() < 2 {
            return Ok(split);
        }
        let one = with_hub(assembly, block, &inside, by)?;
        Ok(if one.bound < split.bound { one } else { split })
    });
    Ok(Counting::join(blocks.collect::<Result<_, _>>()?))
}

/// Those components that lie in a part.
fn within(components: &[Members], part: &Members) -> Vec<Members> {
    let inside = components.iter();
    let inside = inside.filter(|component| part.contains(component));
    inside.cloned().collect()
}

/// One block, with the best hub that the search finds (Theorem 5.2).
fn with_hub(
    assembly: &Assembly,
    block: &Members,
    components: &[Members],
    by: &mut Search,
) -> Result<Counting, Stopped> {
    let mut hub = hub::search(assembly, block, components, by)?;
    if hub.is_none() && components.len() < block.len() {
        hub = hub::search(assembly, block, &block.singles(), by)?;
    }
    let required = full_rank(assembly.count_nodes(block));
    Ok(Counting {
        bound: required - hub.as_ref().map_or(0, |hub| hub.less),
        blocks: vec![Block {
            members: block.clone(),
            hub,
        }],
    })
}

/// The components of the calibrated model, where N alone leaves no freedom (Theorem 6.8).
fn parallel_rigid_components(
    assembly: &Assembly,
    piece: &Members,
    by: &mut Search,
) -> Result<Vec<Members>, Stopped> {
    let core = assembly.core(piece);
    let centres = by.centres(core.graph.nodes());
    let flows = PlaneFlows::new(by.field, &core.graph, &centres, &by.task.untold())?;
    let (_, transforms) = flows.calibrated_motion(&mut by.random);
    Ok(motion_class::classes(piece, &core, &transforms))
}
