//! Cores (section 6 of the specification): the graph that stands for members which share nodes.

use crate::elimination::SPARSE;
use crate::rejection::{Checked, Within, ensure};
use crate::setting::Setting;
use crate::vectors::Vector;
use sha2::{Digest, Sha256};

/// The graph on which a part is computed; `member` is for each edge the position of its member in
/// the part.
pub(crate) struct Core {
    pub nodes: usize,
    pub edges: Vec<(usize, usize)>,
    pub member: Vec<usize>,
    /// For each scaled body among the members the first edge of its chain; with vectors all edges
    /// of its chain, a path.
    pub scales: Vec<(usize, usize)>,
    /// For each node the first one of its group in the core and the vector from there, if vectors
    /// are given and this is another one.
    pub places: Vec<Option<(usize, Vector)>>,
    /// For each core edge whether it belongs to a scaled body.
    pub is_scaled: Vec<bool>,
    /// The hash of its canonical form, to which draws are bound.
    pub sha256: [u8; 32],
}

/// A member, as its core needs it.
pub(crate) struct Joined<'a> {
    /// Its nodes, in increasing order.
    pub nodes: &'a [u32],
    pub is_body: bool,
    /// Whether it holds a known displacement.
    pub is_scaled: bool,
}

impl Core {
    /// The core of members (section 6; theory, Theorems 4.4, 4.11, 13.11 and 13.18). The name of a
    /// member is for people.
    pub(crate) fn new(
        members: &[Joined],
        name: impl Fn(usize) -> String,
        setting: &Setting,
    ) -> Checked<Core> {
        let nodes = core_nodes(members);
        setting.meter.allow_core(nodes.len())?;
        let (mut edges, mut scales) = (Vec::new(), Vec::new());
        for (position, member) in members.iter().enumerate() {
            let inside = member.nodes.iter();
            let chain: Vec<usize> = inside.flat_map(|node| nodes.binary_search(node)).collect();
            ensure!(
                chain.len() >= 2,
                "{} has fewer than two nodes in the core",
                name(position)
            );
            let mut distances = &[1, 2][..];
            if !member.is_scaled {
                check_chain(&chain, &nodes, setting).within(|| name(position))?;
            } else if setting.vectors.is_some() {
                scales.extend(chain.windows(2).map(|pair| (pair[0], pair[1])));
                distances = &[1];
            } else {
                scales.push((chain[0], chain[1]));
            }
            for &distance in distances {
                let pairs = chain.iter().zip(&chain[distance..]);
                edges.extend(pairs.map(|(&i, &j)| ((i, j), position)));
            }
        }
        edges.sort_unstable();
        ensure!(
            edges.windows(2).all(|pair| pair[0].0 != pair[1].0),
            "an edge of the core arises twice"
        );
        let (edges, member): (Vec<_>, Vec<usize>) = edges.into_iter().unzip();
        Ok(Core {
            sha256: core_sha256(&nodes, &edges),
            places: match setting.vectors {
                Some(vectors) => vectors.places(&nodes),
                None => vec![None; nodes.len()],
            },
            nodes: nodes.len(),
            edges,
            is_scaled: member
                .iter()
                .map(|&position| members[position].is_scaled)
                .collect(),
            member,
            scales,
        })
    }

    /// The hashes to which draws for the core are bound (section 4).
    pub(crate) fn hashes<'h>(&'h self, setting: &'h Setting) -> [&'h [u8; 32]; 2] {
        [&setting.sha256, &self.sha256]
    }

    /// The rank at which it is solvable up to finitely many solutions: one more if it holds a known
    /// displacement (section 6; theory, Theorem 13.18).
    pub(crate) fn required(&self, setting: &Setting) -> i64 {
        setting.model.required(self.nodes) + i64::from(!self.scales.is_empty())
    }

    /// Counts what evidence costs in any case: cameras are drawn for all nodes, and something is
    /// computed for all edges.
    pub(crate) fn charge_draw(&self, setting: &Setting) -> Checked<()> {
        let size = self.nodes + self.edges.len();
        setting.meter.charge(50 * SPARSE * size as u64)
    }
}

/// Sees that the triangles of a chain are rigid (theory, Theorem 13.21).
fn check_chain(chain: &[usize], nodes: &[u32], setting: &Setting) -> Checked<()> {
    let mut triangles = chain.windows(3);
    triangles.try_for_each(|at| setting.check_independent(&[at[0], at[1], at[2]].map(|k| nodes[k])))
}

/// The ends of the edges among members, and the nodes that lie in two or more of the bodies.
pub(crate) fn core_nodes(members: &[Joined]) -> Vec<u32> {
    // Nodes that come twice, if the ends of edges do in any case.
    let edges = members.iter().filter(|member| !member.is_body);
    let all = members.iter().chain(edges).map(|member| member.nodes);
    let all = sorted(all.flatten().copied());
    let twice = all.windows(2).filter(|pair| pair[0] == pair[1]);
    let mut nodes: Vec<u32> = twice.map(|pair| pair[0]).collect();
    nodes.dedup();
    nodes
}

/// SHA-256 of the canonical form of a core (section 4), whose nodes are given by their numbers in
/// the graph.
pub(crate) fn core_sha256(nodes: &[u32], edges: &[(usize, usize)]) -> [u8; 32] {
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

pub(crate) fn sorted(nodes: impl IntoIterator<Item = u32>) -> Vec<u32> {
    let mut nodes: Vec<u32> = nodes.into_iter().collect();
    nodes.sort_unstable();
    nodes
}
