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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
}

impl Merge {
    /// What joins.
    pub fn parts(&self) -> &[Part] {
        match self {
            Self::Scaled { part, .. } | Self::Shared { part, .. } => std::slice::from_ref(part),
            Self::Triangle { parts, .. } => parts,
            Self::Cycle { parts, .. } => parts,
            Self::Biclique { parts, .. } => parts,
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
    /// Sorts its nodes, each of them once.
    pub(super) fn sort(&mut self) {
        self.nodes.sort_unstable();
        self.nodes.dedup();
    }
}
