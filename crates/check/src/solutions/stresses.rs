//! Stresses of a rigid core: what they say at its nodes (conditions (U5) and (U6) of section 12; theory,
//! Theorem 19.11 and Lemma 19.12).

use super::dense::ENTRY;
use crate::algebra::{Field, Ring};
use crate::cameras::{self, Stream};
use crate::core::{Core, Joined, core_nodes};
use crate::document::Evidence;
use crate::document::solutions::Round;
use crate::elimination::{Echelon, SPARSE};
use crate::json::Big;
use crate::limits::Meter;
use crate::matrices::{Bearing, bearings};
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::Setting;
use std::collections::{BTreeMap, BTreeSet};

/// What rules of a round refer to.
pub(super) struct Rigid<'a> {
    /// The nodes of its sets.
    pub(super) part: BTreeSet<u32>,
    pub(super) stresses: Option<Stresses<'a>>,
}

/// A 3 x 4 matrix, row by row.
type Block = [u64; 12];

/// For each set that contains a node the sum of each stress over the set's edges there.
type Star = BTreeMap<usize, Vec<Block>>;

/// What the stresses of a round are at its core nodes.
pub(super) struct Stresses<'a> {
    field: Field,
    meter: &'a Meter,
    sets: Vec<BTreeSet<u32>>,
    stars: BTreeMap<u32, Star>,
}

impl<'a> Stresses<'a> {
    /// (U5): stresses at the centres at which the round's evidence shows the rank of the core.
    pub(super) fn new(
        vectors: &[Vec<Big<u64>>],
        round: &Round,
        (joined, core): (&[Joined], &Core),
        setting: &Setting<'a>,
    ) -> Checked<Self> {
        let [Evidence::PlaneFlow(at)] = &round.evidence[..] else {
            let reason = "stresses are not at the centres of one `plane-flow` that shows the rank";
            return Err(Failure::rejected(reason));
        };
        let field = Field::new(at.prime)?;
        let mut stream = Stream::new("draw", core.hashes(setting), at.seed, at.draw);
        let centres = cameras::centres(&mut stream, &field, &core.places)?;
        let directions = bearings(&field, core, &centres);
        let nodes = core_nodes(joined);
        let mut stars: BTreeMap<u32, Star> = BTreeMap::new();
        for (s, vector) in vectors.iter().enumerate() {
            let checked = add(vector, &field, core, &centres, &directions, setting.meter);
            let blocks = checked.within(|| format!("stresses[{s}]"))?;
            for ((&(i, j), &set), block) in core.edges.iter().zip(&core.member).zip(blocks) {
                for (v, block) in [(i, block), (j, block.map(|entry| field.neg(entry)))] {
                    let star = stars.entry(nodes[v]).or_default();
                    let sums = star.entry(set).or_default();
                    sums.resize(s + 1, [0; 12]);
                    sums[s] = sum(&field, &sums[s], &block);
                }
            }
        }
        Ok(Self {
            field,
            meter: setting.meter,
            sets: joined
                .iter()
                .map(|set| set.nodes.iter().copied().collect())
                .collect(),
            stars,
        })
    }

    /// (U6): the sets at a node, each with one of some other nodes, are determined together.
    pub(super) fn check_node(&self, v: u32, ends: &[u32]) -> Checked<()> {
        let star = self.stars.get(&v);
        ensure!(star.is_some(), "no stress is at node {v} of the core");
        let star = star.into_iter().flatten();
        let stars: Vec<(&BTreeSet<u32>, &Vec<Block>)> =
            star.map(|(&set, sums)| (&self.sets[set], sums)).collect();
        for (nodes, _) in &stars {
            ensure!(
                ends.iter().any(|end| nodes.contains(end)),
                "a set with {v} has none of the nodes behind it in `at`"
            );
        }
        for end in ends {
            ensure!(
                stars.iter().any(|(nodes, _)| nodes.contains(end)),
                "{v} and {end} are in no set of the round"
            );
        }
        let (count, width) = (stars[0].1.len(), 4 * stars.len());
        let rows = (0..count).flat_map(|s| (0..3).map(move |r| (s, r)));
        let rows = rows.map(|(s, r)| {
            let entries = stars
                .iter()
                .flat_map(move |(_, sums)| &sums[s][4 * r..4 * r + 4]);
            entries
                .copied()
                .enumerate()
                .filter(|&(_, entry)| entry != 0)
        });
        let rank = Echelon::of(&self.field, width, self.meter, rows)?.rank();
        ensure!(
            rank == width - 4,
            "the stresses have rank {rank} at node {v}, not {}",
            width - 4
        );
        Ok(())
    }
}

fn sum(field: &Field, x: &Block, y: &Block) -> Block {
    std::array::from_fn(|k| field.add(x[k], y[k]))
}

/// The matrices W_e of a stress, which it is if they satisfy one condition on each edge, and add up to
/// zero at each node.
fn add(
    vector: &[Big<u64>],
    field: &Field,
    core: &Core,
    centres: &[[u64; 3]],
    directions: &[Bearing],
    meter: &Meter,
) -> Checked<Vec<Block>> {
    meter.charge((SPARSE + 5 * ENTRY) * vector.len() as u64)?;
    ensure!(
        vector.len() == 8 * core.edges.len(),
        "not eight numbers for each edge of the core"
    );
    ensure!(
        vector.iter().all(|Big(entry)| *entry < field.p),
        "a number is no residue"
    );
    let mut blocks = Vec::with_capacity(core.edges.len());
    let mut at_nodes = vec![[0; 12]; core.nodes];
    for (e, &(i, j)) in core.edges.iter().enumerate() {
        let block: Block = std::array::from_fn(|at| {
            let (r, k) = (at / 4, at % 4);
            let term = |s: usize| {
                let Big(weight) = vector[8 * e + 2 * k + s];
                field.mul(field.element(weight), directions[2 * e + s][r].1)
            };
            field.add(term(0), term(1))
        });
        let trace = [0, 5, 10].map(|at| block[at]);
        let moved = [0, 1, 2].map(|r| field.mul(block[4 * r + 3], centres[j][r]));
        let total = |terms: [u64; 3]| terms.into_iter().fold(0, |sum, x| field.add(sum, x));
        ensure!(
            total(trace) == total(moved),
            "it is not orthogonal to the cameras of edge {e} of the core"
        );
        at_nodes[i] = sum(field, &at_nodes[i], &block);
        at_nodes[j] = sum(field, &at_nodes[j], &block.map(|entry| field.neg(entry)));
        blocks.push(block);
    }
    ensure!(
        at_nodes.iter().flatten().all(|&entry| entry == 0),
        "it does not add up to zero at a node"
    );
    Ok(blocks)
}
