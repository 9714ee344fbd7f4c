//! Deciding one piece in the affine model, by counting alone (docs/theory.md, section 13).
//!
//! In: the members of a piece. Out: its rank and components, which pebble games find exactly, and
//! the evidence for both. A piece of full rank has a sequence of pinchings; what falls short has a
//! partition whose bound is the rank, and a motion at drawn points that separates the components.

use crate::contract::Contraction;
use crate::contract::piece::{Assembly, Core, Members};
use crate::decide::claim::Strength;
use crate::decide::error::VerdictError;
use crate::decide::evidence::{Class, ClassKind, Counting, Evidence, ModularDraw, PieceVerdict};
use crate::decide::motion_class;
use crate::decide::options::Options;
use crate::geometry::draw;
use crate::geometry::draw::DrawKey;
use crate::geometry::model::Model;
use crate::geometry::plane_direction::PlaneDirections;
use crate::graph::{Graph, KnownParts, core_sha256};
use crate::sparsity::Plane;
use crate::watch::{Step, Stopped, Task, Watch};
use rayon::prelude::*;

/// How many draws of points are tried before a small prime is given up.
const ATTEMPTS: u64 = 64;

/// The generic rank of R, by counting alone: 2 n - 3 for an affine solvable graph with n >= 2
/// nodes (Theorem 13.2), and what centres in a plane leave of the other models' ranks (Theorem
/// 13.3). No evidence is looked for.
///
/// ```
/// use viewcert::{Graph, decide::plane_rank, watch::Watch};
///
/// // K_{3,3} is a Laman graph, 2 * 6 - 3 = 9; without a pair it is not rigid.
/// let mut pairs: Vec<_> = (0..3).flat_map(|a| (3..6).map(move |b| (a, b))).collect();
/// assert_eq!(plane_rank(&Graph::new(6, pairs.clone())?, &Watch::default()), Ok(9));
/// pairs.pop();
/// assert_eq!(plane_rank(&Graph::new(6, pairs)?, &Watch::default()), Ok(8));
/// # Ok::<(), viewcert::GraphError>(())
/// ```
///
/// # Errors
/// If the work was stopped.
pub fn plane_rank(graph: &Graph, watch: &Watch) -> Result<usize, Stopped> {
    plane_rank_with_parts(graph, &KnownParts::default(), watch)
}

/// The same for a graph with known parts, which are bodies in the plane as well (Theorem 4.14).
///
/// # Errors
/// If the work was stopped.
///
/// # Panics
/// If a part has a node that the graph does not have.
pub fn plane_rank_with_parts(
    graph: &Graph,
    parts: &KnownParts,
    watch: &Watch,
) -> Result<usize, Stopped> {
    let work = watch.task(Step::Contraction, graph.nodes()).begin(0);
    work.done(0)?;
    let contraction = Contraction::with_parts(graph, parts, Model::Affine);
    work.done(0)?;
    let assembly = Assembly::new(graph, &contraction);
    let split = assembly.split(&assembly.all());
    drop(work);
    let rigid = split.rigid.singles();
    let rigid = rigid.iter().map(|part| full(assembly.count_nodes(part)));
    let pieces = split.pieces.par_iter().map(|members| {
        let core = assembly.core(members);
        let task = watch.task(Step::Counting, core.graph.nodes());
        let rank = Plane::new(&core.graph, &task)?.rank();
        Ok(full(core.total_nodes) + rank - full(core.graph.nodes()))
    });
    let pieces: Vec<usize> = pieces.collect::<Result<_, Stopped>>()?;
    Ok(rigid.chain(pieces).sum())
}

/// The rank of R of a rigid graph with so many nodes, two at least.
fn full(nodes: usize) -> usize {
    2 * nodes - 3
}

/// Decides pieces of two members or more, in parallel.
pub(super) fn decide_all(
    assembly: &Assembly,
    pieces: &[Members],
    sha256: &[u8; 32],
    options: &Options,
) -> Result<Vec<PieceVerdict>, VerdictError> {
    let decided = pieces.par_iter().map(|members| {
        let piece = Piece {
            assembly,
            members,
            core: assembly.core(members),
            sha256,
            options,
        };
        piece.decide()
    });
    decided.collect()
}

struct Piece<'a> {
    assembly: &'a Assembly,
    members: &'a Members,
    core: Core,
    sha256: &'a [u8; 32],
    options: &'a Options,
}

impl Piece<'_> {
    fn task(&self, step: Step) -> Task<'_> {
        self.options.watch.task(step, self.core.graph.nodes())
    }

    fn decide(&self) -> Result<PieceVerdict, VerdictError> {
        let found = Plane::new(&self.core.graph, &self.task(Step::Counting))?;
        let components = self.components(&found);
        let (rank, nodes) = (found.rank(), self.core.graph.nodes());
        let deficit = full(nodes) - rank;
        let evidence = if deficit == 0 {
            vec![pinching(found, &self.task(Step::Counting))?]
        } else {
            self.separate(rank, &components)?
        };
        // The rank of the piece from that of its core (Corollary 13.12).
        let rank = 4 * (full(self.core.total_nodes) - deficit);
        Ok(PieceVerdict {
            members: self.members.clone(),
            components,
            evidence,
            lower: rank,
            upper: rank,
            rank_strength: Strength::Proof,
            components_strength: Strength::Proof,
        })
    }

    /// The members of every component. All edges of a chain are in one.
    fn components(&self, found: &Plane) -> Vec<Members> {
        let mut of_member = vec![0; self.members.len()];
        for (&owner, &component) in self.core.owner.iter().zip(found.component_of_edges()) {
            of_member[owner as usize] = component as usize;
        }
        self.members.grouped(|member| of_member[member])
    }

    /// A minor of full size at drawn points, the bound by the components, which it meets, and a
    /// motion at these points that tells the components apart (Theorem 13.13).
    fn separate(&self, rank: usize, components: &[Members]) -> Result<Vec<Evidence>, VerdictError> {
        let counting = Counting::partition(Model::Affine, self.assembly, components);
        let field = self.options.prime.for_core(self.core.graph.nodes());
        let mut key = DrawKey {
            graph_sha256: *self.sha256,
            core_sha256: Some(core_sha256(&self.core.nodes, &self.core.graph)),
            seed: self.options.seed,
            draw: 0,
        };
        for _ in 0..ATTEMPTS {
            let points = draw::points_mod(&field, self.core.graph.nodes(), &key)?;
            key.draw = points.draw;
            let draw = ModularDraw {
                prime: field.modulus(),
                seed: key.seed,
                draw: points.draw,
            };
            let task = self.task(Step::Components);
            let directions = PlaneDirections::new(&field, &self.core.graph, &points.values, &task)?;
            let (vector, transforms) = directions.motion(key.residues(&field));
            let found = motion_class::classes(self.members, &self.core, &transforms);
            key.draw += 1;
            if directions.rank() < rank || found != components {
                continue;
            }
            let pivots = directions.pivots();
            let classes = components.iter().map(|members| self.class(members));
            return Ok(vec![
                Evidence::PlaneMinor { draw, pivots },
                Evidence::Counting(counting),
                Evidence::Classes(classes.collect::<Result<_, _>>()?),
                Evidence::Kernel {
                    draw,
                    vector: vector.iter().map(|&x| field.to_u64(x)).collect(),
                },
            ]);
        }
        Err(VerdictError::Undecided {
            prime: field.modulus(),
            draws: ATTEMPTS,
        })
    }

    /// A component, with a sequence of pinchings for its own core.
    fn class(&self, members: &Members) -> Result<Class, Stopped> {
        let kind = if members.len() == 1 {
            ClassKind::Single
        } else {
            let core = self.assembly.core(members);
            let task = self.options.watch.task(Step::Counting, core.graph.nodes());
            let found = Plane::new(&core.graph, &task)?;
            ClassKind::Rigid(vec![pinching(found, &task)?])
        };
        Ok(Class {
            members: members.clone(),
            kind,
        })
    }
}

/// Why so many edges of a core are independent.
fn pinching(found: Plane, task: &Task) -> Result<Evidence, Stopped> {
    Ok(Evidence::Pinching {
        rank: found.rank(),
        pinching: found.pinching(task)?,
    })
}

#[cfg(test)]
mod tests;
