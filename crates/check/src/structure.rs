//! Members - final bodies and loose edges -, the pieces and other sets of them, and the cores of
//! these (section 6 of the specification).

use crate::bodies::{Built, Known, build_all};
use crate::core::{Core, Joined, sorted};
use crate::document::{Body, Pair};
use crate::elimination::SPARSE;
use crate::forest::{root, unite};
use crate::graph::Graph;
use crate::rejection::{Checked, Failure, ensure};
use crate::setting::Setting;
use crate::vectors::Vectors;
use std::collections::HashMap;

/// A set of members, in increasing order. The number of a final body is its position in the list of
/// known parts and bodies; that of a loose edge is the length of this list plus the edge's number.
pub(crate) type Part = Vec<usize>;

const NONE: u32 = u32::MAX;
const SEVERAL: u32 = u32::MAX - 1;

/// The final bodies in which each node lies, in increasing order.
struct BodiesOfNodes {
    /// The only one of each node, `NONE` or `SEVERAL`.
    only: Vec<u32>,
    /// All of each node that lies in several.
    several: HashMap<u32, Vec<u32>>,
}

impl BodiesOfNodes {
    fn list(&self, node: u32) -> &[u32] {
        match &self.only[node as usize] {
            &NONE => &[],
            &SEVERAL => &self.several[&node],
            only => std::slice::from_ref(only),
        }
    }
}

/// The members of the graph.
pub(crate) struct Structure<'a> {
    graph: &'a Graph,
    pub setting: &'a Setting<'a>,
    /// The nodes of final bodies, in increasing order; `None` for bodies that are consumed.
    bodies: Vec<Option<Vec<u32>>>,
    /// Whether each body holds a known displacement; so not one that is consumed.
    scaled: Vec<bool>,
    /// Whether each body comes from the rules and what is known; so not one that is consumed.
    unique: Vec<bool>,
    pub everything: Part,
}

impl<'a> Structure<'a> {
    /// Rebuilds all bodies, the known parts before those of the list, and finds which edges each of
    /// them covers (sections 5 and 6); rejects an edge covered twice.
    pub(crate) fn new(
        graph: &'a Graph,
        setting: &'a Setting<'a>,
        (known, list): (Known, &[Body]),
    ) -> Checked<Structure<'a>> {
        let bodies = build_all(graph, setting, known, list)?;
        let scaled = |body: &Option<Built>| body.as_ref().is_some_and(|body| body.scaled);
        let unique = |body: &Option<Built>| body.as_ref().is_some_and(|body| body.unique);
        let mut structure = Structure {
            graph,
            setting,
            scaled: bodies.iter().map(scaled).collect(),
            unique: bodies.iter().map(unique).collect(),
            bodies: bodies
                .into_iter()
                .map(|body| body.map(|body| body.nodes.list()))
                .collect(),
            everything: Part::new(),
        };
        let bodies = (0..structure.bodies.len()).filter(|&k| structure.bodies[k].is_some());
        let mut everything: Part = bodies.collect();
        everything.extend(structure.loose_edges()?);
        structure.everything = everything;
        Ok(structure)
    }

    /// The members that are edges: those that no body covers. No edge is covered by two.
    fn loose_edges(&self) -> Checked<Vec<usize>> {
        let (bodies_of, meter) = (self.bodies_of_nodes(), self.setting.meter);
        let (mut loose, mut steps) = (Vec::new(), 0);
        for (number, &[i, j]) in self.graph.pairs.iter().enumerate() {
            let (a, b) = (bodies_of.list(i), bodies_of.list(j));
            // The shorter list is walked, the longer one searched: nodes in many bodies stay cheap.
            let (short, long) = if a.len() <= b.len() { (a, b) } else { (b, a) };
            steps += short.len() as u64;
            if steps > 1 << 16 {
                meter.charge(SPARSE * std::mem::take(&mut steps))?;
            }
            let covering = short.iter().filter(|body| long.binary_search(body).is_ok());
            let covering = covering.count();
            let fine = covering <= 1;
            ensure!(fine, "the edge [{i}, {j}] is covered by two bodies");
            loose.extend((covering == 0).then_some(self.bodies.len() + number));
        }
        Ok(loose)
    }

    fn bodies_of_nodes(&self) -> BodiesOfNodes {
        let mut only = vec![NONE; self.graph.nodes()];
        let mut several: HashMap<u32, Vec<u32>> = HashMap::new();
        for (nodes, k) in self.bodies.iter().zip(0..) {
            for &node in nodes.iter().flatten() {
                match std::mem::replace(&mut only[node as usize], SEVERAL) {
                    NONE => only[node as usize] = k,
                    first => several.entry(node).or_insert_with(|| vec![first]).push(k),
                }
            }
        }
        BodiesOfNodes { only, several }
    }

    /// The part with these final bodies and edges. Whether the edges are loose is for `owners` to
    /// see.
    pub(crate) fn part(&self, bodies: &[u32], edges: &[Pair]) -> Checked<Part> {
        let mut part: Part = bodies.iter().map(|&body| body as usize).collect();
        let is_final = |&&body: &&usize| self.bodies.get(body).is_some_and(Option::is_some);
        let wrong = part.iter().find(|body| !is_final(body));
        ensure!(
            wrong.is_none(),
            "{} is not a final body",
            wrong.unwrap_or(&0)
        );
        ensure!(
            part.is_sorted_by(|a, b| a < b) && edges.is_sorted_by(|a, b| a < b),
            "the bodies or the edges are not increasing"
        );
        for &pair in edges {
            part.push(self.edge(pair)?);
        }
        part.sort_unstable();
        ensure!(!part.is_empty(), "neither bodies nor edges");
        // The same bodies may be listed in many places. What is done with a list of members each
        // time sorts their nodes.
        let nodes = part.iter().map(|&member| self.nodes_of(member).len());
        self.setting
            .meter
            .charge(SPARSE * nodes.sum::<usize>() as u64)?;
        Ok(part)
    }

    /// The parts of a list, which must be a partition of a whole, and the number of its part for
    /// each member of the whole.
    pub(crate) fn partition<'p>(
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

    /// For each member of a whole the number of its part; rejects parts that are no partition.
    pub(crate) fn owners(&self, whole: &Part, parts: &[Part]) -> Checked<Vec<usize>> {
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

    /// The number of a member that is an edge.
    fn edge(&self, pair: Pair) -> Checked<usize> {
        Ok(self.bodies.len() + self.graph.edge(pair)?)
    }

    /// The nodes of a member that is an edge, given how many of these come before it.
    fn pair(&self, number: usize) -> &Pair {
        &self.graph.pairs[number]
    }

    fn name(&self, member: usize) -> String {
        match member.checked_sub(self.bodies.len()) {
            None => format!("body {member}"),
            Some(edge) => format!("the edge {:?}", self.pair(edge)),
        }
    }

    pub(crate) fn nodes_of(&self, member: usize) -> &[u32] {
        let edge = || &self.pair(member - self.bodies.len())[..];
        self.bodies
            .get(member)
            .map_or_else(edge, |body| body.as_deref().unwrap_or_default())
    }

    /// Whether a member is a body.
    pub(crate) fn is_body(&self, member: usize) -> bool {
        member < self.bodies.len()
    }

    /// Whether a part holds a known displacement.
    pub(crate) fn is_scaled(&self, part: &[usize]) -> bool {
        let scaled = |&member: &usize| self.scaled.get(member).is_some_and(|&scaled| scaled);
        part.iter().any(scaled)
    }

    /// The nodes of several members, in increasing order.
    pub(crate) fn nodes(&self, part: &[usize]) -> Vec<u32> {
        let lists = part.iter().map(|&member| self.nodes_of(member));
        let mut nodes = sorted(lists.collect::<Vec<_>>().concat());
        nodes.dedup();
        nodes
    }

    /// Rejects a cycle of pieces (theory, Lemma 4.7).
    pub(crate) fn check_acyclic(&self, pieces: &[Part]) -> Checked<()> {
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

    /// How many fewer parts there are if scaled ones that share a node are counted as one (theory,
    /// Theorem 13.17).
    pub(crate) fn count_joined(&self, parts: &[Part]) -> usize {
        let scaled: Vec<&Part> = parts.iter().filter(|part| self.is_scaled(part)).collect();
        let mut forest: Vec<usize> = (0..self.graph.nodes() + scaled.len()).collect();
        for (k, part) in scaled.iter().enumerate() {
            for node in self.nodes(part) {
                unite(&mut forest, node as usize, self.graph.nodes() + k);
            }
        }
        // Nodes come first, so that the root of a part is a node of it or of one that it hangs on.
        let mut roots: Vec<usize> = (0..scaled.len())
            .map(|k| root(&mut forest, self.graph.nodes() + k))
            .collect();
        roots.sort_unstable();
        roots.dedup();
        scaled.len() - roots.len()
    }

    /// Whether a member is not only rigid but unique: an edge, or a body that comes from the rules
    /// and what is known.
    pub(crate) fn is_unique(&self, member: usize) -> bool {
        self.unique.get(member).is_none_or(|&unique| unique)
    }

    /// The rank of a part that is solvable up to finitely many solutions: one more if it holds a
    /// known displacement (section 6; theory, Theorem 13.16).
    pub(crate) fn required(&self, part: &[usize]) -> i64 {
        let nodes = self.nodes(part).len();
        self.setting.model.required(nodes) + i64::from(self.is_scaled(part))
    }

    /// What a block contributes to an upper bound (section 7): as many as it requires; with given
    /// vectors by its vertices, and as if it were not scaled if they agree (theory, Theorem 13.22).
    pub(crate) fn block_rank(&self, part: &[usize]) -> i64 {
        let Some(vectors) = self.setting.vectors else {
            return self.required(part);
        };
        let vertices = self.vertices(vectors, part);
        let nodes = part.iter().map(|&member| self.nodes_of(member));
        let is_scaled = self.is_scaled(part) || !vectors.agree(nodes);
        3 * vertices - 4 + i64::from(is_scaled)
    }

    /// With given vectors: the rank of what is known within groups between the nodes of a piece,
    /// which is paid for before that of the blocks; nothing without.
    pub(crate) fn group_rank(&self, piece: &[usize]) -> i64 {
        let beyond = |vectors| {
            let nodes = self.nodes(piece).len() as i64;
            3 * (nodes - self.vertices(vectors, piece))
        };
        self.setting.vectors.map_or(0, beyond)
    }

    /// The number of vertices of several members.
    fn vertices(&self, vectors: &Vectors, part: &[usize]) -> i64 {
        let nodes = part.iter().flat_map(|&member| self.nodes_of(member));
        let mut vertices = sorted(nodes.map(|&node| vectors.vertex(node)));
        vertices.dedup();
        vertices.len() as i64
    }

    /// The core of a part.
    pub(crate) fn core(&self, part: &Part) -> Checked<Core> {
        let members = part.iter().map(|&member| Joined {
            nodes: self.nodes_of(member),
            is_body: self.is_body(member),
            is_scaled: self.is_scaled(&[member]),
        });
        let name = |position: usize| self.name(part[position]);
        Core::new(&members.collect::<Vec<_>>(), name, self.setting)
    }
}
