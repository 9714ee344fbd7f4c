//! Rigid bodies, rebuilt step by step (section 5 of the specification), the pieces between them, and their cores (section 6).

use crate::document::{Body, Merge, Pair, Source};
use crate::graph::Graph;
use crate::rejection::{Checked, Failure, Within, ensure};
use sha2::{Digest, Sha256};
use std::collections::HashSet;

type Nodes = HashSet<u32>;

fn build(body: &Body, graph: &Graph, earlier: &mut [Option<Nodes>]) -> Checked<Nodes> {
    let mut nodes = take(body.seed, graph, earlier).within(|| "seed".into())?;
    for (k, &[v, a, b]) in body.add.iter().enumerate() {
        add(&mut nodes, graph, v, [a, b]).within(|| format!("add[{k}]"))?;
    }
    for (k, step) in body.merge.iter().enumerate() {
        merge(&mut nodes, graph, earlier, step).within(|| format!("merge[{k}]"))?;
    }
    Ok(nodes)
}

/// An earlier body, which is consumed by this, or an edge.
fn take(source: Source, graph: &Graph, earlier: &mut [Option<Nodes>]) -> Checked<Nodes> {
    match source {
        Source::Edge(pair) => graph.edge(pair).map(|_| Nodes::from(pair)),
        Source::Body(k) => {
            let body = earlier.get_mut(k as usize).and_then(Option::take);
            body.ok_or_else(|| {
                Failure::rejected(format!(
                    "body {k} is not an earlier one, or is used a second time"
                ))
            })
        }
    }
}

fn add(nodes: &mut Nodes, graph: &Graph, v: u32, [a, b]: [u32; 2]) -> Checked<()> {
    ensure!(a != b, "the two nodes of the body are the same");
    for node in [a, b] {
        ensure!(nodes.contains(&node), "node {node} is not in the body");
        let joined = graph.edge([v.min(node), v.max(node)]).is_ok();
        ensure!(joined, "{v} and {node} are not joined by an edge");
    }
    ensure!(nodes.insert(v), "node {v} is in the body already");
    Ok(())
}

fn merge(
    nodes: &mut Nodes,
    graph: &Graph,
    earlier: &mut [Option<Nodes>],
    step: &Merge,
) -> Checked<()> {
    let parts = step
        .with
        .iter()
        .map(|&source| take(source, graph, earlier))
        .collect::<Checked<Vec<Nodes>>>()?;
    let shared = match (parts.as_slice(), step.at.as_slice()) {
        ([x], &[a, b]) => vec![(&*nodes, a), (x, a), (&*nodes, b), (x, b)],
        ([x, y], &[a, b, c]) => vec![(&*nodes, a), (x, a), (&*nodes, b), (y, b), (x, c), (y, c)],
        _ => {
            return Err(Failure::rejected(
                "`with` and `at` have one and two, or two and three entries",
            ));
        }
    };
    ensure!(
        step.at.iter().collect::<HashSet<_>>().len() == step.at.len(),
        "the nodes of `at` are not different"
    );
    for (part, node) in shared {
        ensure!(
            part.contains(&node),
            "node {node} is not where the merge needs it"
        );
    }
    for mut part in parts {
        // The smaller set goes into the larger one, so that all unions together take n log n steps.
        if part.len() > nodes.len() {
            std::mem::swap(nodes, &mut part);
        }
        nodes.extend(part);
    }
    Ok(())
}

/// A set of members, in increasing order. The number of a final body is its position in the list of bodies; that of a loose
/// edge is the length of this list plus the edge's number.
pub(crate) type Part = Vec<usize>;

/// The members of the graph.
pub(crate) struct Structure<'a> {
    graph: &'a Graph,
    /// The nodes of final bodies, in increasing order; `None` for bodies that are consumed.
    bodies: Vec<Option<Vec<u32>>>,
    pub everything: Part,
}

/// The graph on which a part is computed; `member` is for each edge the position of its member in the part.
pub(crate) struct Core {
    pub nodes: usize,
    pub edges: Vec<(usize, usize)>,
    pub member: Vec<usize>,
    /// The hash of its canonical form, to which draws are bound.
    pub sha256: [u8; 32],
}

impl<'a> Structure<'a> {
    /// Rebuilds all bodies and finds which edges each of them covers; rejects an edge covered twice.
    pub fn new(graph: &'a Graph, list: &[Body]) -> Checked<Structure<'a>> {
        let mut bodies = Vec::new();
        for (k, body) in list.iter().enumerate() {
            let nodes = build(body, graph, &mut bodies).within(|| format!("bodies[{k}]"))?;
            bodies.push(Some(nodes));
        }
        let bodies: Vec<_> = bodies.into_iter().map(|nodes| nodes.map(sorted)).collect();
        // The bodies of all nodes: those of node i from end[i] to end[i + 1], which is where its next one goes until all are there.
        let mut end = vec![0; graph.nodes() + 2];
        bodies
            .iter()
            .flatten()
            .flatten()
            .for_each(|&node| end[node as usize + 2] += 1);
        (2..end.len()).for_each(|i| end[i] += end[i - 1]);
        let mut all = vec![0; end[graph.nodes() + 1]];
        for (k, nodes) in bodies.iter().enumerate() {
            nodes.iter().flatten().for_each(|&node| {
                all[end[node as usize + 1]] = k;
                end[node as usize + 1] += 1;
            });
        }
        let bodies_of = |node: u32| &all[end[node as usize]..end[node as usize + 1]];
        let mut everything: Part = (0..bodies.len()).filter(|&k| bodies[k].is_some()).collect();
        for (number, &[i, j]) in graph.pairs.iter().enumerate() {
            let (a, b) = (bodies_of(i), bodies_of(j));
            // The shorter list is walked, the longer one searched: hubs in many bodies stay cheap.
            let (short, long) = if a.len() <= b.len() { (a, b) } else { (b, a) };
            let covering = short
                .iter()
                .filter(|body| long.binary_search(body).is_ok())
                .count();
            ensure!(
                covering <= 1,
                "the edge [{i}, {j}] is covered by two bodies"
            );
            everything.extend((covering == 0).then_some(bodies.len() + number));
        }
        Ok(Structure {
            graph,
            bodies,
            everything,
        })
    }

    /// The part with these final bodies and edges. Whether the edges are loose is for `partition` to see.
    pub fn part(&self, bodies: &[u32], edges: &[Pair]) -> Checked<Part> {
        let mut part: Part = bodies.iter().map(|&body| body as usize).collect();
        let wrong = part
            .iter()
            .find(|&&body| self.bodies.get(body).is_none_or(|nodes| nodes.is_none()));
        ensure!(
            wrong.is_none(),
            "{} is not a final body",
            wrong.unwrap_or(&0)
        );
        for &pair in edges {
            part.push(self.bodies.len() + self.graph.edge(pair)?);
        }
        ensure!(
            part.is_sorted_by(|a, b| a < b),
            "the bodies or the edges are not increasing"
        );
        ensure!(!part.is_empty(), "neither bodies nor edges");
        Ok(part)
    }

    /// The parts of a list, which must be a partition of a whole, and the number of its part for each member of the whole.
    pub fn partition<'p>(
        &self,
        whole: &Part,
        list: impl Iterator<Item = (&'p Vec<u32>, &'p Vec<Pair>)>,
    ) -> Checked<(Vec<Part>, Vec<usize>)> {
        let parts = list
            .map(|(bodies, edges)| self.part(bodies, edges))
            .collect::<Checked<Vec<Part>>>()?;
        let owner = self.owners(whole, &parts)?;
        Ok((parts, owner))
    }

    pub fn owners(&self, whole: &Part, parts: &[Part]) -> Checked<Vec<usize>> {
        let mut owner = vec![usize::MAX; whole.len()];
        for (k, &member) in parts
            .iter()
            .enumerate()
            .flat_map(|(k, part)| part.iter().map(move |member| (k, member)))
        {
            let elsewhere = |_| Failure::rejected(format!("{} is out of place", self.name(member)));
            let owner = &mut owner[whole.binary_search(&member).map_err(elsewhere)?];
            ensure!(*owner == usize::MAX, "{} is there twice", self.name(member));
            *owner = k;
        }
        let missing = owner
            .iter()
            .position(|&part| part == usize::MAX)
            .map(|position| self.name(whole[position]));
        ensure!(
            missing.is_none(),
            "{} is left out",
            missing.unwrap_or_default()
        );
        Ok(owner)
    }

    fn name(&self, member: usize) -> String {
        let edge = member
            .checked_sub(self.bodies.len())
            .map(|edge| self.graph.pairs[edge]);
        edge.map_or(format!("body {member}"), |edge| {
            format!("the edge {edge:?}")
        })
    }

    pub fn nodes_of(&self, member: usize) -> &[u32] {
        let edge = || &self.graph.pairs[member - self.bodies.len()][..];
        self.bodies
            .get(member)
            .map_or_else(edge, |body| body.as_deref().unwrap_or_default())
    }

    /// The nodes of several members, in increasing order.
    pub fn nodes(&self, part: &[usize]) -> Vec<u32> {
        let mut nodes = sorted(
            part.iter()
                .flat_map(|&member| self.nodes_of(member))
                .copied(),
        );
        nodes.dedup();
        nodes
    }

    /// Rejects a cycle of pieces.
    pub fn check_acyclic(&self, pieces: &[Part]) -> Checked<()> {
        let nodes = self.nodes(&pieces.concat());
        let mut forest: Vec<usize> = (0..nodes.len() + pieces.len()).collect();
        for (k, piece) in pieces.iter().enumerate() {
            for node in self.nodes(piece) {
                let new = unite(
                    &mut forest,
                    nodes.partition_point(|&other| other < node),
                    nodes.len() + k,
                );
                ensure!(new, "a piece closes a cycle of pieces at node {node}");
            }
        }
        Ok(())
    }

    pub fn core(&self, part: &Part) -> Checked<Core> {
        // Nodes that come twice; ends of loose edges are in the core in any case.
        let times = |member| if member < self.bodies.len() { 1 } else { 2 };
        let all = part
            .iter()
            .flat_map(|&member| std::iter::repeat_n(self.nodes_of(member), times(member)));
        let all = sorted(all.flatten().copied());
        let mut nodes: Vec<u32> = all
            .windows(2)
            .filter(|pair| pair[0] == pair[1])
            .map(|pair| pair[0])
            .collect();
        nodes.dedup();
        let mut edges = Vec::new();
        for (position, &member) in part.iter().enumerate() {
            let chain: Vec<usize> = self
                .nodes_of(member)
                .iter()
                .flat_map(|node| nodes.binary_search(node))
                .collect();
            ensure!(
                chain.len() >= 2,
                "{} has fewer than two nodes in the core",
                self.name(member)
            );
            for distance in [1, 2] {
                edges.extend(
                    chain
                        .iter()
                        .zip(&chain[distance..])
                        .map(|(&i, &j)| ((i, j), position)),
                );
            }
        }
        edges.sort_unstable();
        ensure!(
            edges.windows(2).all(|pair| pair[0].0 != pair[1].0),
            "an edge of the core arises twice"
        );
        let (edges, member): (Vec<_>, _) = edges.into_iter().unzip();
        let sha256 = core_sha256(&nodes, &edges);
        Ok(Core {
            nodes: nodes.len(),
            edges,
            member,
            sha256,
        })
    }
}

/// SHA-256 of the canonical form of a core (section 4), whose nodes are given by their numbers in the graph.
fn core_sha256(nodes: &[u32], edges: &[(usize, usize)]) -> [u8; 32] {
    let mut hash = Sha256::new();
    hash.update(b"viewcert core 2\n");
    hash.update((nodes.len() as u64).to_le_bytes());
    hash.update((edges.len() as u64).to_le_bytes());
    nodes
        .iter()
        .for_each(|node| hash.update(node.to_le_bytes()));
    // A core has fewer nodes than the graph, so that its numbers have 32 bits too.
    for &(i, j) in edges {
        hash.update((i as u32).to_le_bytes());
        hash.update((j as u32).to_le_bytes());
    }
    hash.finalize().into()
}

fn sorted(nodes: impl IntoIterator<Item = u32>) -> Vec<u32> {
    let mut nodes: Vec<u32> = nodes.into_iter().collect();
    nodes.sort_unstable();
    nodes
}

/// The smallest index connected to this one in a forest of parents (union-find with path halving).
pub(crate) fn root(forest: &mut [usize], mut at: usize) -> usize {
    while forest[at] != at {
        forest[at] = forest[forest[at]];
        at = forest[at];
    }
    at
}

/// Connects two indices; returns whether they were not connected before.
pub(crate) fn unite(forest: &mut [usize], a: usize, b: usize) -> bool {
    let (a, b) = (root(forest, a), root(forest, b));
    forest[a.max(b)] = a.min(b);
    a != b
}
