//! Bodies by rank: parts of a large core that are rigid by themselves (docs/theory.md, Proposition
//! 4.15).
//!
//! In: a contraction that leaves large cores, as it does of grids and of paths with loop closures.
//! Out: the contraction with more bodies, and for each of them the lower bound that shows it.
//! The graph is cut into regions of so many core nodes, and in each what has full rank is looked
//! for; the rules go on from there, and so do regions of what is left. A region costs no more than
//! its own core does, so graphs with small separators take time linear in their size, and a graph
//! without (a random one) little besides the elimination of its core.

use crate::contract::Contraction;
use crate::contract::piece::{Assembly, Core, Members};
use crate::decide::drawn::{Centres, Ranks};
use crate::decide::error::VerdictError;
use crate::decide::evidence::Evidence;
use crate::decide::options::Options;
use crate::decide::question::{Arithmetic, CountSolutions};
use crate::decide::walk::Piece;
use crate::graph::{Adjacency, Graph};
use crate::watch::Stopped;
use rayon::prelude::*;
use std::collections::VecDeque;

/// Smaller cores are decided as they are, in some milliseconds.
const LARGE_CORE: usize = 256;

/// Core nodes of a region at first: the cost of all regions grows with the square of it, what they
/// leave of a grid falls with its root.
const REGION: usize = 96;

/// Core nodes of the largest regions: what has no rigid part of this size is left as it is.
const LARGEST_REGION: usize = 384;

/// Goes on from a contraction with bodies by rank. Returns it with a lower bound for each of them.
/// Only the projective model has cores that are worth it, so nothing is known of scales here; and as these bodies need not be unique,
/// none is looked for where solutions are to be counted whatever it takes.
///
/// # Errors
/// If the work was stopped.
pub(super) fn extend(
    graph: &Graph,
    mut contraction: Contraction,
    sha256: &[u8; 32],
    options: &Options,
) -> Result<(Contraction, Vec<Evidence>), VerdictError> {
    let mut evidence = Vec::new();
    let asked = &options.question;
    let is_wanted = !asked.model.is_linear()
        && !asked.whole_graph
        && asked.arithmetic == Arithmetic::Prime
        && asked.solutions != CountSolutions::Full;
    let mut size = REGION;
    // After the largest regions one dense region is tried.
    while is_wanted && size <= 2 * LARGEST_REGION && may_be_large(&contraction) {
        let assembly = Assembly::new(graph, &contraction);
        let large = large_pieces(&assembly);
        if large.iter().all(|(_, core)| core.nodes.len() < 2 * size) {
            break;
        }
        let search = Search::new(&assembly, sha256, options);
        let regions = match size {
            0..=LARGEST_REGION => regions(graph, &contraction, &large, size),
            _ => dense_region(graph, &contraction, &large),
        };
        let found = search.all_rigid_parts(&regions, &|ranks| Ok(Some(ranks.evidence())))?;
        let (unions, bounds): (Vec<_>, Vec<_>) = found.into_iter().unzip();
        if unions.is_empty() {
            size *= 2;
            continue;
        }
        evidence.extend(bounds);
        contraction = contraction.with_unions(graph, unions);
    }
    Ok((contraction, evidence))
}

/// Whether there may be a large core: its nodes are ends of loose edges, or shared by two bodies, of
/// which any two share one node at most.
fn may_be_large(contraction: &Contraction) -> bool {
    let (bodies, edges) = (contraction.finals.len(), contraction.loose.len());
    2 * edges + bodies.saturating_mul(bodies) / 2 >= LARGE_CORE
}

/// The pieces with large cores.
fn large_pieces(assembly: &Assembly) -> Vec<(Members, Core)> {
    let pieces = assembly.split(&assembly.all()).pieces.into_iter();
    // A core has no more nodes than its piece.
    let pieces = pieces.filter(|members| assembly.count_nodes(members) >= LARGE_CORE);
    let cores = pieces.map(|members| {
        let core = assembly.core(&members);
        (members, core)
    });
    cores
        .filter(|(_, core)| core.nodes.len() >= LARGE_CORE)
        .collect()
}

/// Members of pieces by regions of so many core nodes: an edge is in the region that has both its
/// ends, a body in all that have two of its core nodes. O(n + m) and sorting.
pub(super) fn regions(
    graph: &Graph,
    contraction: &Contraction,
    pieces: &[(Members, Core)],
    size: usize,
) -> Vec<Members> {
    let mut in_core = vec![false; graph.nodes()];
    for &v in pieces.iter().flat_map(|(_, core)| &core.nodes) {
        in_core[v as usize] = true;
    }
    let (region_of, count) = partition(graph, &in_core, size);
    let region_of = region_of.into_iter().zip(in_core);
    let region_of: Vec<_> = region_of.map(|(k, is)| is.then_some(k)).collect();
    members_of(contraction, pieces, &region_of, count)
}

/// One region that is dense, if there is one, of the largest piece.
pub(super) fn dense_region(
    graph: &Graph,
    contraction: &Contraction,
    pieces: &[(Members, Core)],
) -> Vec<Members> {
    let largest = pieces.iter().max_by_key(|(_, core)| core.nodes.len());
    let Some(inside) = largest.and_then(|(_, core)| dense::grow(graph, &core.nodes)) else {
        return Vec::new();
    };
    let region_of: Vec<Option<u32>> = inside.iter().map(|&is| is.then_some(0)).collect();
    members_of(contraction, pieces, &region_of, 1)
}

/// Members of pieces by the regions that nodes are in, if they are in any: edges of loose members end in core nodes.
fn members_of(
    contraction: &Contraction,
    pieces: &[(Members, Core)],
    region_of: &[Option<u32>],
    count: usize,
) -> Vec<Members> {
    let mut regions = vec![Members::default(); count];
    for (members, _) in pieces {
        for &(i, j) in &members.edges {
            if let Some(region) = region_of[i as usize]
                && region_of[j as usize] == Some(region)
            {
                regions[region as usize].edges.push((i, j));
            }
        }
        for &body in &members.bodies {
            let nodes = contraction.bodies[body as usize].nodes.iter();
            let mut met: Vec<u32> = nodes.filter_map(|&v| region_of[v as usize]).collect();
            met.sort_unstable();
            for same in met.chunk_by(|a, b| a == b).filter(|same| same.len() >= 2) {
                regions[same[0] as usize].bodies.push(body);
            }
        }
    }
    for region in &mut regions {
        region.edges.sort_unstable();
        region.bodies.sort_unstable();
    }
    regions.retain(|region| region.len() >= 2);
    regions
}

/// A number below the number of regions for every node: regions are found breadth first, each
/// beside the one before, until it has so many core nodes.
fn partition(graph: &Graph, in_core: &[bool], size: usize) -> (Vec<u32>, usize) {
    const NONE: u32 = u32::MAX;
    let neighbours = Adjacency::new(graph);
    let mut region_of = vec![NONE; graph.nodes()];
    let mut regions = 0;
    // Where a region ended the next one begins.
    let mut edge: VecDeque<u32> = VecDeque::new();
    for first in 0..graph.nodes() as u32 {
        edge.push_back(first);
        while let Some(start) = edge.pop_front() {
            if region_of[start as usize] != NONE {
                continue;
            }
            let mut queue = VecDeque::from([start]);
            let mut held = 0;
            while let Some(v) = queue.pop_front() {
                if region_of[v as usize] != NONE {
                    continue;
                }
                if held == size {
                    queue.push_front(v);
                    break;
                }
                region_of[v as usize] = regions;
                held += usize::from(in_core[v as usize]);
                queue.extend(neighbours.neighbours(v));
            }
            edge.extend(queue);
            regions += 1;
        }
    }
    (region_of, regions as usize)
}

/// What is wanted of a part that is rigid.
pub(super) type Read<'r, T> = dyn Fn(&Ranks<'_>) -> Result<Option<T>, Stopped> + Sync + 'r;

/// Looks for rigid parts among members.
pub(super) struct Search<'a> {
    assembly: &'a Assembly,
    sha256: &'a [u8; 32],
    options: &'a Options,
}

impl<'a> Search<'a> {
    pub(super) fn new(assembly: &'a Assembly, sha256: &'a [u8; 32], options: &'a Options) -> Self {
        Self {
            assembly,
            sha256,
            options,
        }
    }

    /// Rigid parts of each of some lists of members, side by side, with what is read off their ranks,
    /// if anything is.
    pub(super) fn all_rigid_parts<T: Send>(
        &self,
        among: &[Members],
        read: &Read<'_, T>,
    ) -> Result<Vec<(Members, T)>, VerdictError> {
        let found = among
            .par_iter()
            .map(|members| self.rigid_parts(members, read));
        let found: Vec<_> = found.collect::<Result<_, VerdictError>>()?;
        Ok(found.into_iter().flatten().collect())
    }

    /// Parts of two members or more that have full rank by themselves, each with what is read off its
    /// ranks. No member is in two of them.
    fn rigid_parts<T>(
        &self,
        members: &Members,
        read: &Read<'_, T>,
    ) -> Result<Vec<(Members, T)>, VerdictError> {
        let mut found = Vec::new();
        let mut left = self.assembly.split(members).pieces;
        while let Some(members) = left.pop() {
            let core = self.assembly.core(&members);
            let piece = Piece::new(self.assembly, &members, &core, self.sha256, self.options);
            let field = self.options.prime.for_core(piece.nodes());
            // A prime too small for so many centres proves nothing here.
            let Ok(at) = Centres::draw(&field, &core, piece.key(0)) else {
                continue;
            };
            let ranks = piece.ranks(&at)?;
            if ranks.rank == piece.required() {
                found.extend(read(&ranks)?.map(|value| (members, value)));
            } else if let Some((classes, _)) = ranks.separate(&members) {
                for class in classes {
                    left.extend(self.assembly.split(&class).pieces);
                }
            }
        }
        Ok(found)
    }
}

mod dense;
#[cfg(test)]
mod tests;
