//! Contraction to rigid bodies (docs/theory.md, section 4).
//!
//! A *body* is a set of nodes whose relative cameras are determined. Bodies are
//! grown from triangles until a node seen twice remains nowhere, then merged by the
//! two rules that are left: bodies that share two nodes, and three bodies that
//! pairwise share a node. In the calibrated model four bodies around a cycle are one as well
//! (rule 5 of Theorem 4.9), in the projective one six bodies around a K_{2,3} (Theorem 10.3), or around
//! a tripod or a link (Theorems 19.7 and 19.8). Known
//! parts are bodies from the start (Theorem 4.14). Every step is recorded, and the record is the
//! proof. Bodies by rank (Proposition 4.15) are found by whoever decides, and go on here.

pub(crate) mod piece;

mod bicliques;
mod body;
mod cycles;
mod general;
mod given;
mod grow;
mod merge;
mod position;
mod rest;
mod scaled;
mod seeds;
mod sweep;
#[cfg(test)]
mod tests;

pub use body::{Body, Merge, Part, Seed};
pub use piece::Members;
pub(crate) use position::Position;

use crate::geometry::model::Model;
use crate::geometry::placed::Placed;
use crate::graph::{Adjacency, Displacements, Graph, KnownParts, Lists};
use general::General;
use given::Given;
use merge::Owners;
use position::Generic;
use rest::Rest;
use std::sync::Arc;
use sweep::Swept;

/// A viewing graph contracted to bodies and loose edges.
#[derive(Clone, Debug)]
pub struct Contraction {
    /// All bodies in the order of their making, the consumed ones included; the known parts come
    /// first. A body refers to earlier ones only, and to each at most once in all.
    pub bodies: Vec<Body>,
    /// Numbers of the bodies that are left, in increasing order. No two of them
    /// share two nodes.
    pub finals: Vec<u32>,
    /// The edges that no body covers, in increasing order.
    pub loose: Vec<(u32, u32)>,
    /// Earlier bodies and edges that are rigid together by their rank (Proposition 4.15), one entry
    /// for each body that starts from such. They are rigid, and need not be unique.
    pub by_rank: Vec<Members>,
}

impl Contraction {
    /// Contracts a graph, by the rules of a model. Close to O(m) on real graphs;
    /// O(m * arboricity) for the search of cycles of edges at worst.
    pub fn new(graph: &Graph, model: Model) -> Self {
        Self::with_parts(graph, &KnownParts::default(), model)
    }

    /// Contracts a graph whose known parts are bodies from the start (Theorem 4.14). Nodes in many
    /// parts cost the product of these and their neighbours at worst.
    ///
    /// # Panics
    /// If a part has a node that the graph does not have.
    pub fn with_parts(graph: &Graph, parts: &KnownParts, model: Model) -> Self {
        let given = Given::new(graph, parts.iter(), false);
        match model {
            // Four bodies around a cycle move against each other in the plane.
            Model::Projective | Model::Affine => Self::by_triangles(given, model),
            Model::Calibrated => Self::by_cycles(given, &General(None)),
        }
    }

    /// Contracts a graph of the projective model with uniquely determined sets of nodes, which are the
    /// first bodies.
    pub(crate) fn with_sets(graph: &Graph, sets: &[Vec<u32>]) -> Self {
        let sets = sets.iter().map(Vec::as_slice);
        Self::by_triangles(Given::new(graph, sets, false), Model::Projective)
    }

    /// Contracts a graph of the calibrated model with known displacements, whose groups are bodies
    /// from the start (Theorem 13.16). The cost is that of [`new`](Self::new), once more for each
    /// round in which scaled bodies that share a node make further merges possible. If vectors are
    /// given, what merges at three nodes or four is in general position all the same (Theorem 13.21): where
    /// `placed` says where nodes are, which need not be known to the rules (Theorem 13.29).
    pub fn with_displacements(
        graph: &Graph,
        known: &Displacements,
        placed: &Displacements,
    ) -> Self {
        let groups = known.groups().iter().map(Vec::as_slice);
        let general = General(Placed::new(graph.nodes(), placed).map(Arc::new));
        Self::by_cycles(Given::new(graph, groups, true), &general)
    }

    /// Closed under cycles of two and three (Theorem 4.1; affine: 13.9), in the projective model also
    /// under K_{2,3}, tripods and links (Theorems 10.3, 19.7 and 19.8), as far as their steps reach.
    fn by_triangles(given: Given, model: Model) -> Self {
        let Given { mut bodies, rest } = given;
        let graph = &*rest;
        // The edges that no body owns yet.
        let mut remaining = Adjacency::new(graph);
        if !bodies.is_empty() {
            given::grow(&mut bodies, &mut remaining);
        }
        bodies.extend(grow::grow(&mut remaining, &Generic));
        Self::closed_by_triangles(graph, model, bodies, &remaining)
    }

    /// Goes on with more bodies in the projective model: for each of `unions`, members of this
    /// contraction that are rigid together. They are not consumed; the rules that follow do that.
    /// O(n) and what the rules take.
    pub(crate) fn with_unions(self, graph: &Graph, unions: Vec<Members>) -> Self {
        let Self {
            mut bodies,
            mut by_rank,
            loose,
            ..
        } = self;
        let first = by_rank.len() as u32;
        let new: Vec<Body> = (first..)
            .zip(&unions)
            .map(|(k, union)| {
                let held = union.bodies.iter();
                let held = held.flat_map(|&body| &bodies[body as usize].nodes).copied();
                let ends = union.edges.iter().flat_map(|&(i, j)| [i, j]);
                let mut nodes: Vec<u32> = held.chain(ends).collect();
                crate::graph::sort_once(&mut nodes);
                // Only known displacements are of known scale, in another model.
                Body::new(Seed::Rank(k), nodes, 0)
            })
            .collect();
        bodies.extend(new);
        by_rank.extend(unions);
        let smaller = loose.iter().map(|&(i, j)| (j, i));
        let neighbours = smaller.chain(loose.iter().copied());
        let remaining = Adjacency::of_lists(Lists::group(graph.nodes(), neighbours));
        Self {
            by_rank,
            ..Self::closed_by_triangles(graph, Model::Projective, bodies, &remaining)
        }
    }

    /// Whether all final bodies come from the rules and what is known, so that they are not only
    /// rigid but unique. O(size of the record).
    pub fn are_unique_finals(&self) -> bool {
        if self.by_rank.is_empty() {
            return true;
        }
        let mut unique: Vec<bool> = Vec::with_capacity(self.bodies.len());
        for body in &self.bodies {
            let of_seed = match body.seed {
                Seed::Edge(..) | Seed::Known => true,
                Seed::Body(k) => unique[k as usize],
                Seed::Rank(_) => false,
            };
            let is_unique = |part: &Part| match part {
                Part::Edge(..) => true,
                Part::Body(k) => unique[*k as usize],
            };
            let all = of_seed && body.merge.iter().flat_map(Merge::parts).all(is_unique);
            unique.push(all);
        }
        self.finals.iter().all(|&k| unique[k as usize])
    }

    /// Contracts a graph at given centres, by the rules 1 to 4 of Theorem 4.1 as far as they hold there
    /// (Theorem 16.2), in every model.
    pub(crate) fn at(graph: &Graph, at: &impl Position) -> Self {
        let mut remaining = Adjacency::new(graph);
        let mut bodies = grow::grow(&mut remaining, at);
        let all = 0..bodies.len() as u32;
        let owners = merge::close(&mut bodies, all, &remaining, graph.nodes(), at);
        let (owned, loose) = by_owner(&owners, &remaining);
        for body in owned {
            bodies[body as usize].edges += 1;
        }
        Self::of_closed(bodies, loose)
    }

    /// Closes bodies under the rules that need no cycle of four.
    fn closed_by_triangles(
        graph: &Graph,
        model: Model,
        mut bodies: Vec<Body>,
        remaining: &Adjacency,
    ) -> Self {
        let steps = [(); 2].map(|()| bicliques::Steps::new(graph));
        let mut closed = 0;
        loop {
            let new = closed..bodies.len() as u32;
            let owners = merge::close(&mut bodies, new, remaining, graph.nodes(), &Generic);
            closed = bodies.len() as u32;
            let (owned, loose) = by_owner(&owners, remaining);
            // In a plane all planes through two centres are one.
            let bicliques = !model.is_linear();
            if bicliques && bicliques::merge(&mut bodies, &loose, graph.nodes(), &steps) {
                continue;
            }
            for body in owned {
                bodies[body as usize].edges += 1;
            }
            return Self::of_closed(bodies, loose);
        }
    }

    /// Closed under cycles of two, three and four (Theorem 4.9). The bodies to begin with cover none
    /// of the edges, and if they are scaled, the rule of such bodies applies too.
    fn by_cycles(given: Given, general: &General) -> Self {
        let Given { bodies, rest } = given;
        let graph = &*rest;
        let Swept { mut bodies, left } = sweep::grow(graph, bodies, general);
        let rest = Rest::new(graph.nodes(), left, &bodies);
        let mut remaining = rest.adjacency();
        // A pendant edge at a node that no body holds lies on no cycle.
        let pendant = remaining.prune_leaves(|v| rest.is_held(v));
        let before = bodies.len() as u32;
        let may_close = |cycle: [u32; 4]| general.holds(&cycle.map(|v| rest.node(v)));
        let grown = seeds::grow(&mut remaining, may_close).into_iter();
        bodies.extend(grown.map(|body| rest.body(body, before)));
        let edges = remaining.edges().map(|edge| rest.edge(edge)).collect();
        let mut loose = cycles::close(&mut bodies, edges, graph.nodes(), general);
        while scaled::join(&mut bodies, graph.nodes()) {
            bodies.iter_mut().for_each(Body::sort);
            loose = cycles::close(&mut bodies, loose, graph.nodes(), general);
        }
        loose.extend(pendant.into_iter().map(|edge| rest.edge(edge)));
        Self::of_closed(bodies, loose)
    }

    fn of_closed(mut bodies: Vec<Body>, mut loose: Vec<(u32, u32)>) -> Self {
        bodies.iter_mut().for_each(Body::sort);
        let finals = (0..)
            .zip(&bodies)
            .filter(|(_, body)| !body.nodes.is_empty())
            .map(|(k, _)| k)
            .collect();
        loose.sort_unstable();
        Self {
            bodies,
            finals,
            loose,
            by_rank: Vec::new(),
        }
    }

    /// No bodies at all: every edge is loose, and the computation runs on the whole
    /// graph.
    pub fn none(graph: &Graph) -> Self {
        Self {
            bodies: Vec::new(),
            finals: Vec::new(),
            loose: graph.edges().to_vec(),
            by_rank: Vec::new(),
        }
    }
}

/// For each edge that remains and lies in a body this body; and the edges that lie in none.
fn by_owner(owners: &Owners, remaining: &Adjacency) -> (Vec<u32>, Vec<(u32, u32)>) {
    let (mut owned, mut loose) = (Vec::new(), Vec::new());
    for (v, w) in remaining.edges() {
        match owners.common_body(v, w) {
            Some(body) => owned.push(body),
            None => loose.push((v, w)),
        }
    }
    (owned, loose)
}
