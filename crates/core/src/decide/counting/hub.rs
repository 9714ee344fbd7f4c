//! The hub bound (Theorem 5.2 of docs/theory.md): parts that meet at a node, and too few plane
//! flows between them.

use super::search::Search;
use crate::contract::piece::{Assembly, Core, Members};
use crate::decide::evidence::Hub;
use crate::decide::motion_class;
use crate::geometry::plane_flow::PlaneFlows;
use crate::graph::Graph;
use crate::graph::UnionFind;
use crate::linalg::Ring;
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;
use crate::watch::{Stopped, Task};

/// How many sets of parts the search looks at for one node.
const FLATS: usize = 20_000;

/// The hub that takes off most from the rank of a block whose edges the parts
/// partition, or `None` if the search finds no hub.
pub(super) fn search(
    assembly: &Assembly,
    block: &Members,
    parts: &[Members],
    by: &mut Search,
) -> Result<Option<Hub>, Stopped> {
    let core = assembly.core(block);
    let mut connected = UnionFind::new(core.graph.nodes());
    let joins = |&&(i, j): &&(u32, u32)| connected.union(i as usize, j as usize);
    if core.graph.edges().iter().filter(joins).count() + 1 < core.graph.nodes() {
        return Ok(None);
    }
    let mut part_of_member = vec![0; block.len()];
    for (k, part) in parts.iter().enumerate() {
        for member in block.positions(part) {
            part_of_member[member] = k;
        }
    }
    let part_of_edge: Vec<usize> = core
        .owner
        .iter()
        .map(|&member| part_of_member[member as usize])
        .collect();
    let centres = by.centres(core.graph.nodes());
    let quiet = by.task.untold();
    let flows = PlaneFlows::new(by.field, &core.graph, &centres, &quiet)?;
    let flows = flows.flows(&quiet)?;

    let work = by.task.begin(core.graph.nodes() as u64);
    let mut best: Option<Hub> = None;
    for v in 0..core.graph.nodes() as u32 {
        let inflow = Inflow::new(by.field, &core.graph, &flows, &part_of_edge, v);
        for (set, _) in inflow.promising(by.field, &quiet)? {
            let split: Vec<u32> = set.iter().map(|&k| inflow.parts[k] as u32).collect();
            let candidate = Candidate {
                assembly,
                block,
                core: &core,
                parts,
                part_of_edge: &part_of_edge,
                node: v,
                split: &split,
            };
            let hub = candidate.evaluate(by)?;
            if let Some(hub) = hub
                && best.as_ref().is_none_or(|b| hub.less > b.less)
            {
                best = Some(hub);
            }
        }
        work.done(1)?;
    }
    Ok(best)
}

/// The net plane flow that each part carries into a node, as a linear function of the
/// flows: three vectors (the coordinates of the flow) a part, with one entry for each
/// flow of a basis.
struct Inflow {
    /// The parts at the node, increasing.
    parts: Vec<usize>,
    functions: Vec<[Vec<u64>; 3]>,
}

impl Inflow {
    /// `flows[f][e]` is omega_e of the f-th flow.
    fn new(
        field: &PrimeField,
        graph: &Graph,
        flows: &[Vec<[u64; 3]>],
        part_of_edge: &[usize],
        v: u32,
    ) -> Self {
        let mut at_node: Vec<(usize, usize, bool)> = Vec::new();
        for (e, &(i, j)) in graph.edges().iter().enumerate() {
            if i == v || j == v {
                at_node.push((part_of_edge[e], e, i == v));
            }
        }
        at_node.sort_unstable();
        let mut parts: Vec<usize> = at_node.iter().map(|&(part, ..)| part).collect();
        parts.dedup();
        let functions = parts
            .iter()
            .map(|&part| {
                std::array::from_fn(|k| {
                    let mut function = vec![0; flows.len()];
                    for &(_, e, outgoing) in at_node.iter().filter(|&&(p, ..)| p == part) {
                        for (value, flow) in function.iter_mut().zip(flows) {
                            *value = if outgoing {
                                field.add(value, &flow[e][k])
                            } else {
                                field.sub(value, &flow[e][k])
                            };
                        }
                    }
                    function
                })
            })
            .collect();
        Self { parts, functions }
    }

    /// Sets of parts (by position) closed under dependence with more than three parts
    /// for every dimension of their flows, and the excess; best first.
    fn promising(
        &self,
        field: &PrimeField,
        task: &Task,
    ) -> Result<Vec<(Vec<usize>, usize)>, Stopped> {
        let mut found = Vec::new();
        let mut budget = FLATS;
        self.extend(field, &Span::default(), 0, &mut budget, &mut found, task)?;
        found.sort_by(|(a, x), (b, y)| y.cmp(x).then(a.cmp(b)));
        found.dedup();
        Ok(found)
    }

    fn extend(
        &self,
        field: &PrimeField,
        span: &Span,
        from: usize,
        budget: &mut usize,
        found: &mut Vec<(Vec<usize>, usize)>,
        task: &Task,
    ) -> Result<(), Stopped> {
        if *budget == 0 {
            return Ok(());
        }
        *budget -= 1;
        task.check()?;
        let closed: Vec<usize> = (0..self.parts.len())
            .filter(|&k| self.functions[k].iter().all(|f| span.contains(field, f)))
            .collect();
        if closed.len() > 3 * span.dimension() {
            let excess = closed.len() - 3 * span.dimension();
            found.push((closed.clone(), excess));
        }
        for k in from..self.parts.len() {
            if closed.contains(&k) {
                continue;
            }
            let mut larger = span.clone();
            for function in &self.functions[k] {
                larger.insert(field, function.clone());
            }
            if 3 * larger.dimension() < self.parts.len() {
                self.extend(field, &larger, k + 1, budget, found, task)?;
            }
        }
        Ok(())
    }
}

/// A set of parts to be split off at a node.
struct Candidate<'a> {
    assembly: &'a Assembly,
    block: &'a Members,
    core: &'a Core,
    parts: &'a [Members],
    part_of_edge: &'a [usize],
    /// The node, as a node of the core.
    node: u32,
    split: &'a [u32],
}

impl Candidate<'_> {
    /// What the split takes off by Theorem 5.2; `None` if nothing.
    fn evaluate(&self, by: &mut Search) -> Result<Option<Hub>, Stopped> {
        let v = self.node;
        // The split core: copies of v come after all nodes, v itself is what remains.
        let n = self.core.graph.nodes() as u32;
        let mut copies = n;
        let mut copy_of_part = vec![v; self.parts.len()];
        for &part in self.split {
            copy_of_part[part as usize] = copies;
            copies += 1;
        }
        let mut edges: Vec<((u32, u32), usize)> = Vec::new();
        let mut remains = false;
        for (&(i, j), &part) in self.core.graph.edges().iter().zip(self.part_of_edge) {
            remains |= (i == v || j == v) && copy_of_part[part] == v;
            let place = |w| if w == v { copy_of_part[part] } else { w };
            let (i, j) = (place(i), place(j));
            edges.push(((i.min(j), i.max(j)), part));
        }
        edges.sort_unstable();
        let mut connected = UnionFind::new(copies as usize);
        let mut components = copies as usize;
        for &((i, j), _) in &edges {
            components -= usize::from(connected.union(i as usize, j as usize));
        }

        // The isolated remainder of v carries no edge: its columns stay free and no
        // transformation sees them.
        let pairs = edges.iter().map(|&(pair, _)| pair).collect();
        let (graph, _) = Graph::from_pairs(copies, pairs).expect("as in the core");
        let centres = by.centres(copies as usize);
        let flows = PlaneFlows::new(by.field, &graph, &centres, &by.task.untold())?;
        let (_, transforms) = flows.calibrated_motion(&mut by.random);
        let mut sets = UnionFind::new(self.parts.len());
        motion_class::unite(
            &mut sets,
            transforms.iter().zip(edges.iter().map(|&(_, part)| part)),
        );
        let mut groups: Vec<Vec<u32>> = vec![Vec::new(); self.parts.len()];
        for part in 0..self.parts.len() {
            groups[sets.find(part)].push(part as u32);
        }
        groups.retain(|group| !group.is_empty());

        let node = self.core.nodes[v as usize];
        let total: usize = groups
            .iter()
            .map(|group| 3 * self.group_nodes(group, node, remains) - 4)
            .sum();
        let whole = 3 * self.assembly.count_nodes(self.block) - 4;
        let less = total
            .checked_sub(whole)
            .and_then(|s| self.split.len().checked_sub(components - 1 + 3 * s))
            .filter(|&less| less > 0);
        Ok(less.map(|less| Hub {
            node,
            parts: self.parts.to_vec(),
            split: self.split.to_vec(),
            groups,
            components,
            less,
        }))
    }

    /// Nodes of a group in the split graph: different copies are different nodes.
    fn group_nodes(&self, group: &[u32], node: u32, remains: bool) -> usize {
        let mut all = Members::default();
        let mut copies = 0;
        let mut plain = false;
        for &part in group {
            let part_members = &self.parts[part as usize];
            all.extend(part_members);
            if self.split.contains(&part) {
                copies += 1;
            } else {
                plain |= remains && self.assembly.contains_node(part_members, node);
            }
        }
        let here = copies + usize::from(plain);
        self.assembly.count_nodes(&all) - usize::from(here > 0) + here
    }
}

/// The graph of Example 5.6 of docs/theory.md.
#[cfg(test)]
pub(crate) const GAMMA: [(u32, u32); 12] = [
    (0, 2),
    (0, 3),
    (0, 5),
    (1, 4),
    (1, 5),
    (1, 6),
    (1, 7),
    (1, 8),
    (2, 4),
    (2, 6),
    (3, 7),
    (3, 8),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Contraction;
    use crate::geometry::model::full_rank;
    use crate::watch::unwatched;
    use rand::{Rng, SeedableRng};

    /// The best hub of a graph as one block, its edges as parts, and the rank that is left.
    fn best(nodes: u32, pairs: &[(u32, u32)]) -> Option<(Hub, usize)> {
        let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
        let assembly = Assembly::new(&graph, &Contraction::none(&graph));
        let block = assembly.all();
        let field = PrimeField::mersenne61();
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        let mut random = || field.from_u64(random.next_u64());
        let hub = unwatched(|task| {
            let mut by = Search {
                field: &field,
                random: &mut random,
                task: *task,
            };
            search(&assembly, &block, &block.singles(), &mut by)
        });
        let required = full_rank(nodes as usize);
        hub.map(|hub| (hub.clone(), required - hub.less))
    }

    /// Example 5.6 of docs/theory.md: at node 1 five edges meet, which leave a tree of twelve
    /// edges and node 1 by itself.
    #[test]
    fn gamma_has_a_hub() {
        let (hub, bound) = best(9, &GAMMA).expect("a hub");
        assert_eq!((hub.node, hub.components, hub.less), (1, 2, 1));
        let split: Vec<_> = hub
            .split
            .iter()
            .map(|&k| hub.parts[k as usize].edges[0])
            .collect();
        assert_eq!(split, [(1, 4), (1, 5), (1, 6), (1, 7), (1, 8)]);
        assert_eq!(hub.groups.len(), 12);
        assert_eq!(bound, 83);
    }

    /// Remark 5.4: each node of the 4-cycle gives the deduction 1, |F| = 2, kappa = 2, s = 0.
    #[test]
    fn a_cycle_of_four_has_four_hubs() {
        let (hub, bound) = best(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]).expect("a hub");
        assert_eq!((hub.node, hub.components, hub.less), (0, 2, 1));
        assert_eq!((hub.split.len(), hub.groups.len()), (2, 4));
        assert_eq!(bound, 28);
    }

    /// A bound below the rank would be false: 18 for the triangle, 40 for a strip of triangles.
    /// And hubs are for connected blocks.
    #[test]
    fn there_is_none_where_nothing_is_lost() {
        assert_eq!(best(3, &[(0, 1), (0, 2), (1, 2)]), None);
        let strip = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (2, 4), (3, 4)];
        assert_eq!(best(5, &strip), None);
        let cycles = [
            (0, 1),
            (1, 2),
            (2, 3),
            (0, 3),
            (4, 5),
            (5, 6),
            (6, 7),
            (4, 7),
        ];
        assert_eq!(best(8, &cycles), None);
    }
}
