//! Bodies, and the record of how they came to be.

/// What a body starts from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seed {
    /// The two nodes of an edge.
    Edge(u32, u32),
    /// An earlier body, which is continued.
    Body(u32),
    /// What is known, and there from the start: the first bodies are the known parts, or the groups
    /// of known displacements, in their order.
    Known,
    /// Members that are rigid together by their rank: an entry of [`Contraction::by_rank`](crate::contract::Contraction::by_rank).
    Rank(u32),
}

/// Something that joins a body: an edge, or an earlier body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// An edge `(i, j)`, `i < j`.
    Edge(u32, u32),
    /// An earlier body, by its number.
    Body(u32),
}

impl Part {
    pub(super) fn edge(a: u32, b: u32) -> Self {
        Self::Edge(a.min(b), a.max(b))
    }
}

/// One application of a merge rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Merge {
    /// The part shares one node with the body, and both hold known displacements.
    Scaled {
        /// What joins.
        part: Part,
        /// The common node.
        at: [u32; 1],
    },
    /// The part shares the two nodes with the body.
    Shared {
        /// What joins.
        part: Part,
        /// The two common nodes.
        at: [u32; 2],
    },
    /// Body and parts pairwise share a node: `at[0]` is in the body and the first
    /// part, `at[1]` in the body and the second, `at[2]` in both parts.
    Triangle {
        /// What joins.
        parts: [Part; 2],
        /// The three common nodes, all different.
        at: [u32; 3],
    },
    /// Body and parts stand around a cycle, which only the calibrated model allows: `at[0]` is in
    /// the body and the first part, `at[1]` in the first and the second, `at[2]` in the second
    /// and the third, `at[3]` in the third and the body.
    Cycle {
        /// What joins.
        parts: [Part; 3],
        /// The four common nodes, all different.
        at: [u32; 4],
    },
    /// Body and parts stand around a K_{2,3}, in the projective model: with `at` = a, b, v_1, v_2,
    /// v_3 the body has a and v_1, the first part v_1 and b, the second a and v_2, the third v_2
    /// and b, the fourth a and v_3, the fifth v_3 and b.
    Biclique {
        /// What joins.
        parts: [Part; 5],
        /// The two nodes of the one side and the three of the other, all different.
        at: [u32; 5],
    },
    /// Three ways from a node to the body, in the projective model: with `at` = a, b, c, d, e, f the
    /// body has a, b and c, the first part a and d, the second d and e, the third e and b, the
    /// fourth f and c, the fifth d and f. The fifth may be the second.
    Tripod {
        /// What joins.
        parts: [Part; 5],
        /// Three nodes of the body and three others, all different.
        at: [u32; 6],
    },
    /// Two bodies and three ways between them, in the projective model: with `at` = a, b, c, d, e, f,
    /// g this body has a, b and c, the first part d, e and f, the second a and d, the third b and e,
    /// the fourth c and g, the fifth g and f.
    Link {
        /// What joins, a body first.
        parts: [Part; 5],
        /// The nodes; c may be a or b, and f may be d or e.
        at: [u32; 7],
    },
}

impl Merge {
    /// What joins.
    pub fn parts(&self) -> &[Part] {
        match self {
            Self::Scaled { part, .. } | Self::Shared { part, .. } => std::slice::from_ref(part),
            Self::Triangle { parts, .. } => parts,
            Self::Cycle { parts, .. } => parts,
            Self::Tripod { parts, .. } if parts[4] == parts[1] => &parts[..4],
            Self::Biclique { parts, .. }
            | Self::Tripod { parts, .. }
            | Self::Link { parts, .. } => parts,
        }
    }

    /// The nodes in which they hang together.
    pub fn at(&self) -> &[u32] {
        match self {
            Self::Scaled { at, .. } => at,
            Self::Shared { at, .. } => at,
            Self::Triangle { at, .. } => at,
            Self::Cycle { at, .. } => at,
            Self::Biclique { at, .. } => at,
            Self::Tripod { at, .. } => at,
            Self::Link { at, .. } => at,
        }
    }
}

/// A body and how it came to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Body {
    /// What it starts from.
    pub seed: Seed,
    /// `[v, a, b]`: node v joins, seen from the nodes a and b of the body.
    pub add: Vec<[u32; 3]>,
    /// Merges, after all of `add`, in order.
    pub merge: Vec<Merge>,
    /// Its nodes in increasing order; empty once the body has been consumed by a
    /// later one.
    pub nodes: Vec<u32>,
    /// How many edges of the graph it covers; 0 once consumed.
    pub edges: usize,
    /// Whether it holds a known displacement, so that its scale is known.
    pub scaled: bool,
}

impl Body {
    /// Nodes that cover so many edges, of unknown scale, without what joined the seed.
    pub(super) fn new(seed: Seed, nodes: Vec<u32>, edges: usize) -> Self {
        let (add, merge, scaled) = (Vec::new(), Vec::new(), false);
        Self {
            seed,
            add,
            merge,
            nodes,
            edges,
            scaled,
        }
    }

    /// A set of nodes that is known, before anything has joined it.
    pub(crate) fn known(nodes: &[u32]) -> Self {
        Self::new(Seed::Known, nodes.to_vec(), 0)
    }

    /// Sorts its nodes, each of them once.
    pub(super) fn sort(&mut self) {
        crate::graph::sort_once(&mut self.nodes);
    }
}
