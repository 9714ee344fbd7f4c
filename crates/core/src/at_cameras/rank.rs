//! The rank of a core at given centres (docs/theory.md, Theorem 16.3).
//!
//! In: a core and its centres. Out: the rank, proved from below modulo one prime and from above modulo
//! many, or with an error bound modulo a few that nobody chooses; and a motion where it falls short.

use super::centres::Centres;
use crate::contract::piece::{Core, Members};
use crate::decide::motion_class;
use crate::decide::{Strength, VerdictError};
use crate::geometry::draw::{self, DrawKey};
use crate::geometry::model::Model;
use crate::geometry::plane_direction::PlaneDirections;
use crate::geometry::plane_flow::{Lambda, PlaneFlows};
use crate::graph::core_sha256;
use crate::linalg::prime::PrimeField;
use crate::watch::{Step, Stopped, Watch};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// What an upper bound may cost before it becomes one with an error: primes times the square of the nodes
/// and edges of the core.
const PROOF_COST: u64 = 1 << 20;
/// The exponent that error bounds reach, with a slack for whoever tries many (Proposition 7.3).
const ERROR_BITS: u64 = 120;

/// The centres of a graph, to which draws are bound.
pub(super) struct Setting<'a> {
    pub(super) centres: &'a Centres,
    pub(super) hashes: [[u8; 32]; 2],
    pub(super) watch: &'a Watch,
}

/// A core with its centres.
pub(super) struct Placed<'a> {
    setting: &'a Setting<'a>,
    core: &'a Core,
    hash: [u8; 32],
}

/// The rank of a core, and how it is known.
pub(super) struct Ranked {
    pub(super) rank: usize,
    /// The primes that were looked at.
    pub(super) primes: u64,
    pub(super) strength: Strength,
    /// Where it falls short: classes of members, and the motion that tells them apart.
    pub(super) classes: Option<(Vec<Members>, Vec<u64>)>,
}

/// The matrices of a core modulo a prime.
enum Matrices<'a> {
    Space(Box<PlaneFlows<'a>>, Option<Box<Lambda>>),
    Plane(Box<PlaneDirections<'a>>),
}

impl<'a> Placed<'a> {
    pub(super) fn new(setting: &'a Setting<'a>, core: &'a Core) -> Self {
        Self {
            hash: core_sha256(&core.nodes, &core.graph),
            setting,
            core,
        }
    }

    fn model(&self) -> Model {
        self.setting.centres.model
    }

    pub(super) fn required(&self) -> usize {
        self.model().required(self.core.graph.nodes())
    }

    /// How many primes an upper bound on the rank takes, and how strong it is.
    fn plan(&self, rank: usize) -> (u64, Strength) {
        let edges = self.core.graph.edges().len() as u64;
        let bits = self.setting.centres.bits(&self.core.nodes);
        let bound = hadamard(self.model(), rank as u64, edges, bits);
        let proof = bound.div_ceil(61);
        let size = edges + self.core.graph.nodes() as u64;
        if proof.saturating_mul(size * size) <= PROOF_COST {
            return (proof, Strength::Proof);
        }
        let each = 53 - u64::from(u64::BITS - (bound / 61).leading_zeros());
        let few = ERROR_BITS.div_ceil(each);
        if proof <= few {
            return (proof, Strength::Proof);
        }
        (few, Strength::ErrorBound(-((few * each) as i64)))
    }

    /// The rank, and if it falls short the classes of the members that move.
    pub(super) fn ranked(&self, members: &Members) -> Result<Ranked, VerdictError> {
        let mut primes = Primes::new(self);
        let (field, points) = primes.next();
        let (rank, matrices) = self.eliminated(&field, &points)?;
        if rank == self.required() {
            return Ok(Ranked {
                rank,
                primes: 1,
                strength: Strength::Proof,
                classes: None,
            });
        }
        let classes = self.classes(&field, &matrices, members);
        let classes = classes.filter(|(found, _)| found.len() > 1);
        let undecided = || VerdictError::Undecided {
            prime: field.modulus(),
            draws: 1,
        };
        let classes = classes.ok_or_else(undecided)?;
        drop(matrices);
        let (count, strength) = self.plan(rank);
        let work = self
            .setting
            .watch
            .task(Step::Draws, self.core.graph.nodes());
        let work = work.begin(count);
        let more: Vec<_> = (1..count).map(|_| primes.next()).collect();
        let ranks = more.par_iter().map(|(field, points)| {
            work.done(1)?;
            Ok(self.eliminated(field, points)?.0)
        });
        let ranks = ranks.collect::<Result<Vec<usize>, Stopped>>()?;
        if ranks.into_iter().any(|other| other > rank) {
            return Err(undecided());
        }
        Ok(Ranked {
            rank,
            primes: count,
            strength,
            classes: Some(classes),
        })
    }

    /// Whether the rank is full, as the first prime shows.
    pub(super) fn is_full(&self) -> Result<bool, Stopped> {
        let (field, points) = Primes::new(self).next();
        Ok(self.eliminated(&field, &points)?.0 == self.required())
    }

    fn eliminated<'p>(
        &'p self,
        field: &'p PrimeField,
        points: &'p Points,
    ) -> Result<(usize, Matrices<'p>), Stopped> {
        let core = self.core;
        let task = self.setting.watch.task(Step::Flows, core.graph.nodes());
        if self.model().in_plane() {
            let directions = PlaneDirections::new(field, &core.graph, &points.plane, &task)?;
            return Ok((4 * directions.rank(), Matrices::Plane(Box::new(directions))));
        }
        let flows = PlaneFlows::new(field, &core.graph, &points.space, &task)?;
        let rigidity = flows.rigidity_rank();
        if self.model().in_space() {
            return Ok((rigidity, Matrices::Space(Box::new(flows), None)));
        }
        let rank = |lambda: &Lambda| 4 * rigidity + lambda.rank() - core.graph.edges().len();
        let mut lambda = flows.lambda(self.key().flow_weights(field), &task)?;
        if rank(&lambda) < self.required() {
            // The rows of some flows do not prove that there are no more.
            lambda = flows.lambda_of_all_flows(&task)?;
        }
        Ok((
            rank(&lambda),
            Matrices::Space(Box::new(flows), Some(Box::new(lambda))),
        ))
    }

    /// The key of what needs no name in a certificate.
    fn key(&self) -> DrawKey {
        DrawKey {
            graph_sha256: self.setting.hashes[1],
            core_sha256: Some(self.hash),
            seed: 0,
            draw: 0,
        }
    }

    fn classes(
        &self,
        field: &PrimeField,
        matrices: &Matrices,
        members: &Members,
    ) -> Option<(Vec<Members>, Vec<u64>)> {
        let mut random = self.key().residues(field);
        let (classes, entries) = match matrices {
            Matrices::Space(flows, Some(lambda)) => {
                let motion = flows.motion(lambda, &mut random)?;
                let found = motion_class::classes(members, self.core, &motion.transforms);
                (found, motion.by_node())
            }
            Matrices::Space(flows, None) => {
                let (y, transforms) = flows.calibrated_motion(&mut random);
                (motion_class::classes(members, self.core, &transforms), y)
            }
            Matrices::Plane(directions) => {
                let (y, transforms) = directions.motion(&mut random);
                (motion_class::classes(members, self.core, &transforms), y)
            }
        };
        let entries = entries.into_iter().map(|x| field.to_u64(x)).collect();
        Some((classes, entries))
    }
}

/// The B of Theorem 16.3 (b).
fn hadamard(model: Model, rank: u64, edges: u64, bits: u64) -> u64 {
    match model {
        Model::Projective => (rank + edges + 1) * (3 * bits + 3),
        Model::Calibrated => (rank + 1) * (2 * bits + 2),
        Model::Affine => (rank / 4 + 1) * (2 * bits + 2),
    }
}

/// The centres of a core modulo a prime.
struct Points {
    space: Vec<[u64; 3]>,
    plane: Vec<[u64; 2]>,
}

/// The primes of a core that are not void, each once, in the order in which they are drawn.
struct Primes<'a> {
    placed: &'a Placed<'a>,
    draw: Box<dyn FnMut() -> PrimeField>,
    seen: BTreeSet<u64>,
}

impl<'a> Primes<'a> {
    fn new(placed: &'a Placed<'a>) -> Self {
        let [graph, centres] = &placed.setting.hashes;
        Self {
            placed,
            draw: Box::new(draw::primes_here([graph, centres, &placed.hash])),
            seen: BTreeSet::new(),
        }
    }

    fn next(&mut self) -> (PrimeField, Points) {
        loop {
            let field = (self.draw)();
            let core = self.placed.core;
            let points = self.placed.setting.centres.points(&field, &core.nodes);
            let apart = |points: &Vec<[u64; 3]>| {
                let mut edges = core.graph.edges().iter();
                edges.all(|&(i, j)| points[i as usize] != points[j as usize])
            };
            let Some(space) = points.filter(apart) else {
                continue;
            };
            if self.seen.insert(field.modulus()) {
                let plane = space.iter().map(|&[x, y, _]| [x, y]).collect();
                return (field, Points { space, plane });
            }
        }
    }
}
