//! Upper bounds on the rank that hold for all cameras, by counting nodes
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
//! where at most 16 parts meet. Rank is then taken off the block by the best single hub.

mod hub;

use crate::component;
use crate::exact::prime::PrimeField;
use crate::formulation::plane_flow::PlaneFlows;
use crate::model::Model;
use crate::piece::{Assembly, Members};

pub use hub::Hub;

/// A partition of a piece's members and the bound on its rank that counting gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counting {
    /// The blocks, in the order of their first members.
    pub blocks: Vec<Block>,
    /// The bound: the sum of what the blocks contribute.
    pub bound: usize,
}

/// A block of a partition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// What is in the block.
    pub members: Members,
    /// A hub at which it loses rank.
    pub hub: Option<Hub>,
}

impl Counting {
    /// The partition bound of the given blocks.
    fn partition(model: Model, assembly: &Assembly, blocks: &[Members]) -> Self {
        Self {
            bound: blocks
                .iter()
                .map(|block| model.required(assembly.count_nodes(block)))
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

    fn join(parts: Vec<Self>) -> Self {
        let bound = parts.iter().map(|part| part.bound).sum();
        let mut blocks: Vec<Block> = parts.into_iter().flat_map(|part| part.blocks).collect();
        blocks.sort_by(|a, b| a.members.cmp(&b.members));
        Self { blocks, bound }
    }
}

/// The best bound the search finds for a piece with the given components; stops as soon
/// as it meets `target`, a lower bound on the rank. `random` gives uniform residues; the
/// choice steers the search but not the validity of what it finds.
pub fn count(
    model: Model,
    assembly: &Assembly,
    piece: &Members,
    components: &[Members],
    target: usize,
    field: &PrimeField,
    random: &mut dyn FnMut() -> u64,
) -> Counting {
    let partition = Counting::partition(model, assembly, components);
    if partition.bound <= target || model == Model::Calibrated {
        return partition;
    }
    let whole = with_hub(assembly, piece, components, field, random);
    if whole.bound <= target {
        return whole;
    }
    let rigid = parallel_rigid_components(assembly, piece, field, random);
    let by_block = rigid
        .iter()
        .map(|block| {
            let inside: Vec<Members> = components
                .iter()
                .filter(|component| block.contains(component))
                .cloned()
                .collect();
            let split = Counting::partition(model, assembly, &inside);
            if inside.len() < 2 {
                return split;
            }
            let one = with_hub(assembly, block, &inside, field, random);
            if one.bound < split.bound { one } else { split }
        })
        .collect();
    [partition, whole, Counting::join(by_block)]
        .into_iter()
        .min_by_key(|counting| counting.bound)
        .expect("three bounds")
}

/// One block, with the best hub that the search finds.
fn with_hub(
    assembly: &Assembly,
    block: &Members,
    components: &[Members],
    field: &PrimeField,
    random: &mut dyn FnMut() -> u64,
) -> Counting {
    let mut best = hub::search(assembly, block, components, field, random);
    if best.is_none() && components.len() < block.len() {
        best = hub::search(assembly, block, &block.singles(), field, random);
    }
    let required = Model::Projective.required(assembly.count_nodes(block));
    Counting {
        bound: required - best.as_ref().map_or(0, |hub| hub.less),
        blocks: vec![Block {
            members: block.clone(),
            hub: best,
        }],
    }
}

/// The components of the calibrated model: where N alone leaves no freedom.
fn parallel_rigid_components(
    assembly: &Assembly,
    piece: &Members,
    field: &PrimeField,
    random: &mut dyn FnMut() -> u64,
) -> Vec<Members> {
    let core = assembly.core(piece);
    let centres: Vec<[u64; 3]> = (0..core.graph.nodes())
        .map(|_| std::array::from_fn(|_| random()))
        .collect();
    let flows = PlaneFlows::new(field, &core.graph, &centres);
    let (_, transforms) = flows.calibrated_motion(random);
    component::classes(piece, &core, &transforms)
}
