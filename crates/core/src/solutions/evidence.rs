//! What bounds for the number of solutions rest on: the data of docs/certificate.md, section 12, as
//! they are found.

/// What is known of the number of solutions of a finite solvable graph, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Solutions {
    /// There are as many at least; one always is.
    pub at_least: usize,
    /// There are no more than that, if such a bound was found.
    pub at_most: Option<usize>,
    /// What the upper bound rests on, if there is one and more than one member.
    pub upper: Option<Upper>,
    /// What the lower bound rests on, if it is above one.
    pub lower: Option<Lower>,
    /// What the core has more of equations than of unknowns; `None` if there is one member.
    pub excess: Option<i64>,
}

impl Solutions {
    /// The number of solutions, if it is known.
    pub fn exactly(&self) -> Option<usize> {
        self.at_most.filter(|&most| most == self.at_least)
    }
}

/// Where the evidence holds: the scales that are unknown, the prime, and the centres.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Members, half-edges and unknowns.
    pub chart: Chart,
    /// The modulus.
    pub prime: u64,
    /// The shared nodes, as nodes of the graph, and their centres as least residues.
    pub centres: Vec<(u32, [u64; 3])>,
}

/// Evidence for an upper bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Upper {
    /// Where the unknowns are shown to be one.
    pub place: Place,
    /// How unknowns are shown to be one.
    pub ones: Vec<Linear>,
    /// The points for the unknowns that are left, and where; nothing if none are.
    pub points: Option<(Place, AtMost)>,
}

/// Evidence for a lower bound: simple points of a tight core.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lower {
    /// Where.
    pub place: Place,
    /// The values of all unknowns at each point, as least residues; u = 1 counts even if it
    /// is not among them.
    pub points: Vec<Vec<u64>>,
}

/// Why members are one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Two members share two nodes (Theorem 4.1, rule 2).
    Shared,
    /// Three members pairwise share a node (Theorem 4.1, rule 3).
    Triangle,
    /// Two nodes are joined to each of three others by members (Theorem 10.3).
    Biclique,
    /// Three ways from a node to a member (Theorem 19.7).
    Tripod,
    /// Three ways between two members (Theorem 19.8).
    Link,
    /// A node hangs on a part that is rigid without it (Theorem 19.6).
    Removed,
    /// Stresses at a node of a rigid part (Theorem 19.11).
    Stressed,
}

impl Rule {
    /// Its name in certificates.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Shared => "shared",
            Self::Triangle => "triangle",
            Self::Biclique => "biclique",
            Self::Tripod => "tripod",
            Self::Link => "link",
            Self::Removed => "removed",
            Self::Stressed => "stressed",
        }
    }
}

/// Members, half-edges and the scales that are unknown; all others are one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chart {
    /// The shared nodes of every member, as nodes of the graph, in the order of its chain.
    pub members: Vec<Vec<u32>>,
    /// `[v, a, b]`: the node v lies in just the members {v, a} and {v, b}, and is eliminated.
    pub half_edges: Vec<[u32; 3]>,
    /// The unknowns.
    pub unknowns: Vec<Scale>,
}

/// The scale u of a member at a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    /// The node, as a node of the graph.
    pub node: u32,
    /// The member, by its place in [`Chart::members`], and for a half-edge its second one.
    pub member: usize,
}

/// One application of Theorem 10.6.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Linear {
    /// The freed rows, by number; rows whose unknowns have no value and that are not freed
    /// are dropped.
    pub freed: Vec<usize>,
    /// The unknowns that are settled.
    pub settled: Vec<usize>,
}

/// A minor of N(u), with rows freed, that vanishes at all solutions. It is multiplied by all monomials
/// with which it stays within the degree bounds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Minor {
    /// How many rows are freed.
    pub freed: usize,
    /// Its rows: 3 n' - 4 + `freed` + 1 of them.
    pub rows: Vec<Part>,
    /// Its columns, as many.
    pub columns: Vec<usize>,
}

/// A row of a minor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A row of N(u).
    Whole(usize),
    /// Its first side alone, without scale: the row is freed.
    Plus(usize),
    /// Its second side alone, without scale and sign: the row is freed.
    Minus(usize),
}

/// The points of Theorem 10.8, with the other unknowns settled at each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AtMost {
    /// The unknowns that are not settled by linear algebra.
    pub unknowns: Vec<usize>,
    /// The largest exponent of each, shifts included.
    pub bounds: Vec<usize>,
    /// Exponents within the bounds at which all coefficients are zero by Theorem 10.7.
    pub absent: Vec<Vec<usize>>,
    /// Minors that vanish at all solutions.
    pub minors: Vec<Minor>,
    /// The values of all unknowns at each point, as least residues.
    pub points: Vec<Vec<u64>>,
    /// How the other unknowns are settled at each point.
    pub settled: Vec<Vec<Linear>>,
}
