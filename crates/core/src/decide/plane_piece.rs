//! Deciding one piece in the affine model, by counting alone (docs/theory.md, section 13).
//!
//! In: the members of a piece. Out: its rank and components, which pebble games find exactly, and
//! the evidence for both: a minor of R at drawn points. What falls short of full rank has a partition
//! whose bound is the rank besides, and a motion at these points that separates the components.

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
use crate::graph::{Graph, KnownParts, UnionFind, core_sha256};
use crate::linalg::prime::PrimeField;
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
fn plane_rank_with_parts(
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

/// The generic rank in a model if all centres lie in one plane: with rank R the generic rank of the
/// plane direction matrix, 4 rank R + 3 (n - k) of J_P and rank R + n - k of N, k the number of
/// connected components (Theorem 13.3).
///
/// # Errors
/// If the work was stopped.
///
/// # Panics
/// If a part has a node that the graph does not have.
pub fn rank_in_plane(
    graph: &Graph,
    model: Model,
    known: &KnownParts,
    watch: &Watch,
) -> Result<usize, Stopped> {
    let plane = plane_rank_with_parts(graph, known, watch)?;
    let mut sets = UnionFind::new(graph.nodes());
    let neighbours = known.iter().flat_map(|part| part.iter().zip(&part[1..]));
    let edges = graph.edges().iter().copied();
    let edges = edges.chain(neighbours.map(|(&i, &j)| (i, j)));
    // n - k: the edges of a spanning forest.
    let joined = edges.filter(|&(i, j)| sets.union(i as usize, j as usize));
    Ok(match model {
        Model::Projective => 4 * plane + 3 * joined.count(),
        Model::Calibrated => plane + joined.count(),
        Model::Affine => 4 * plane,
    })
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
            vec![self.minor(&self.core, rank, |_, _, _| Some(()))?.0]
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

    /// A minor of the rank of a core at drawn points, and what is found at these, if all is.
    fn minor<T>(
        &self,
        core: &Core,
        rank: usize,
        find: impl Fn(&PrimeField, &PlaneDirections, DrawKey) -> Option<T>,
    ) -> Result<(Evidence, ModularDraw, T), VerdictError> {
        let nodes = core.graph.nodes();
        let field = self.options.prime.for_core(nodes);
        let mut key = DrawKey {
            graph_sha256: *self.sha256,
            core_sha256: Some(core_sha256(&core.nodes, &core.graph)),
            seed: self.options.seed,
            draw: 0,
        };
        for _ in 0..ATTEMPTS {
            let points = draw::points_mod(&field, nodes, &key)?;
            key.draw = points.draw;
            let task = self.options.watch.task(Step::Components, nodes);
            let directions = PlaneDirections::new(&field, &core.graph, &points.values, &task)?;
            if directions.rank() == rank
                && let Some(found) = find(&field, &directions, key)
            {
                let draw = ModularDraw {
                    prime: field.modulus(),
                    seed: key.seed,
                    draw: key.draw,
                };
                let pivots = directions.pivots();
                return Ok((Evidence::PlaneMinor { draw, pivots }, draw, found));
            }
            key.draw += 1;
        }
        Err(VerdictError::Undecided {
            prime: field.modulus(),
            draws: ATTEMPTS,
        })
    }

    /// The minor, the bound by the components, which it meets, and a motion at the minor's points
    /// that tells the components apart (Theorem 13.13).
    fn separate(&self, rank: usize, components: &[Members]) -> Result<Vec<Evidence>, VerdictError> {
        let motion = |field: &PrimeField, directions: &PlaneDirections, key: DrawKey| {
            let (vector, transforms) = directions.motion(key.residues(field));
            let found = motion_class::classes(self.members, &self.core, &transforms);
            (found == components).then(|| vector.iter().map(|&x| field.to_u64(x)).collect())
        };
        let (minor, draw, vector) = self.minor(&self.core, rank, motion)?;
        let counting = Counting::partition(Model::Affine, self.assembly, components);
        let classes = components.iter().map(|members| self.class(members));
        let classes = Evidence::Classes(classes.collect::<Result<_, _>>()?);
        let kernel = Evidence::Kernel { draw, vector };
        Ok(vec![minor, Evidence::Counting(counting), classes, kernel])
    }

    /// A component, with a minor of its own core.
    fn class(&self, members: &Members) -> Result<Class, VerdictError> {
        let kind = if members.len() == 1 {
            ClassKind::Single
        } else {
            let core = self.assembly.core(members);
            let rank = full(core.graph.nodes());
            ClassKind::Rigid(vec![self.minor(&core, rank, |_, _, _| Some(()))?.0])
        };
        Ok(Class {
            members: members.clone(),
            kind,
        })
    }
}

#[cfg(test)]
mod tests;
