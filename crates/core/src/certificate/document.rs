//! The members of the certificate, borrowed from a verdict.

mod at_cameras;
mod intrinsics;

use super::EMBED_NODES;
use super::base_lines::{BaseLinesView, ClaimedBaseLines};
use super::objects::{Big, bigs, object, objects, written};
use super::own_frame::{ClaimedOwnFrame, OwnFrameView, vectors};
use super::solutions::{self, ClaimedSolutions, Counted, ForeignSolutions, SolutionsView};
use crate::contract::piece::Members;
use crate::contract::{Body, Merge, Part, Seed};
use crate::decide::evidence::{Class, Draws, Evidence, PieceVerdict, Witness};
use crate::decide::{Block, Claim, Counting, Hub, SharedBaseLines, Value, Verdict};
use crate::graph::{Graph, graph6};
use serde::{Serialize, Serializer};

objects! {
    Document<'a> {
        format: &'static str,
        version: u32,
        question: &'static str,
        program: &'static str,
        graph: GraphView<'a>,
        model: &'static str,
        claim: ClaimView,
        bodies: Vec<BodyView<'a>>,
        rigid: &'a Members,
        pieces: &'a [PieceVerdict],
        ; optional displacements: &'a [Vec<u32>], vectors: Vec<Vec<[Big<i128>; 3]>>, solutions: SolutionsView<'a>, parts: Vec<&'a [u32]>, base_lines: BaseLinesView<'a>, own_frame: OwnFrameView<'a>
    }

    GraphView<'a> {
        name: &'a str,
        nodes: usize,
        edges: usize,
        sha256: String,
        graph6: Option<String>,
    }

    ClaimView {
        verdict: Valued<&'static str>,
        rank: Rank,
        components: Valued<usize>,
        ; optional solutions: ClaimedSolutions, base_lines: ClaimedBaseLines, own_frame: ClaimedOwnFrame
    }

    Valued<T> {
        value: T,
        strength: &'static str,
        error_log2: Option<i64>,
    }

    Rank {
        value: usize,
        required: usize,
        strength: &'static str,
        error_log2: Option<i64>,
    }

    BodyView<'a> {
        seed: SeedView<'a>,
        add: &'a [[u32; 3]],
        merge: Vec<MergeView<'a>>,
    }

    MergeView<'a> {
        with: Vec<PartView>,
        at: &'a [u32],
    }

    SplitView<'a, P> {
        rigid: &'a Members,
        pieces: &'a [P],
    }
}

impl<'a> GraphView<'a> {
    /// The graph, which is part of the text if it has at most [`EMBED_NODES`] nodes, or as `embed` says.
    fn new((graph, name): (&Graph, &'a str), sha256: &[u8; 32], embed: bool) -> Self {
        let embed = embed || graph.nodes() <= EMBED_NODES;
        Self {
            name,
            nodes: graph.nodes(),
            edges: graph.edges().len(),
            sha256: hex(sha256),
            graph6: embed.then(|| graph6::encode(graph)),
        }
    }
}

impl<'a> Document<'a> {
    pub(super) fn new(
        name: &'a str,
        graph: &Graph,
        embed: bool,
        verdict: &'a Verdict,
        counted: Counted<'a>,
        base_lines: Option<&'a SharedBaseLines>,
    ) -> Result<Self, ForeignSolutions> {
        let (mut value, rank) = (verdict.value_claim(), verdict.rank_claim());
        value.value = verdict.value_by_rank();
        let components = verdict.components_claim();
        let (claimed, evidence) = solutions::view(verdict, counted)?.unzip();
        if claimed.as_ref().is_some_and(ClaimedSolutions::is_one) {
            value.value = Value::Solvable;
        }
        Ok(Self {
            format: "viewcert certificate",
            version: 3,
            question: "generic",
            program: concat!("viewcert ", env!("CARGO_PKG_VERSION")),
            graph: GraphView::new((graph, name), &verdict.sha256, embed),
            model: verdict.model.name(),
            claim: ClaimView {
                verdict: Valued::new(value, |value| value.name()),
                rank: Rank {
                    value: rank.value,
                    required: verdict.required,
                    strength: rank.strength.name(),
                    error_log2: rank.strength.error_log2(),
                },
                components: Valued::new(components, <[_]>::len),
                solutions: claimed,
                base_lines: base_lines.map(ClaimedBaseLines::from),
                own_frame: verdict.own_frame.as_ref().map(ClaimedOwnFrame::from),
            },
            bodies: verdict
                .contraction
                .bodies
                .iter()
                .filter_map(|body| BodyView::new(body, verdict))
                .collect(),
            rigid: &verdict.rigid,
            pieces: &verdict.pieces,
            displacements: Some(verdict.displacements.groups()).filter(|groups| !groups.is_empty()),
            vectors: verdict.displacements.vectors().map(vectors),
            solutions: evidence,
            base_lines: base_lines.map(BaseLinesView::from),
            own_frame: verdict.own_frame.as_ref().map(OwnFrameView::from),
            parts: (!verdict.known_parts.is_empty()).then(|| verdict.known_parts.iter().collect()),
        })
    }
}

impl<T> Valued<T> {
    fn new<C>(claim: Claim<C>, written: impl FnOnce(C) -> T) -> Self {
        Self {
            value: written(claim.value),
            strength: claim.strength.name(),
            error_log2: claim.strength.error_log2(),
        }
    }
}

/// Bytes in lower-case hexadecimal digits.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// An edge, or the number of a body.
enum PartView {
    Edge([u32; 2]),
    Body(u32),
}

impl Serialize for PartView {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Edge(edge) => edge.serialize(serializer),
            Self::Body(number) => number.serialize(serializer),
        }
    }
}

/// What a body starts from; members that are rigid by their rank are written as a piece is.
enum SeedView<'a> {
    Part(PartView),
    Rank(&'a Members, &'a [Evidence]),
}

impl Serialize for SeedView<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Part(part) => part.serialize(serializer),
            Self::Rank(Members { bodies, edges }, evidence) => {
                object!(serializer, { bodies: bodies, edges: edges, evidence: evidence })
            }
        }
    }
}

impl<'a> BodyView<'a> {
    /// A body as it is built; `None` for what is known, which is there before the list begins.
    fn new(body: &'a Body, verdict: &'a Verdict) -> Option<Self> {
        Some(Self {
            seed: match body.seed {
                Seed::Edge(i, j) => SeedView::Part(PartView::Edge([i, j])),
                Seed::Body(k) => SeedView::Part(PartView::Body(k)),
                Seed::Known => return None,
                Seed::Rank(k) => SeedView::Rank(
                    &verdict.contraction.by_rank[k as usize],
                    std::slice::from_ref(&verdict.by_rank[k as usize]),
                ),
            },
            add: &body.add,
            merge: body.merge.iter().map(MergeView::new).collect(),
        })
    }
}

impl From<Part> for PartView {
    fn from(part: Part) -> Self {
        match part {
            Part::Edge(i, j) => Self::Edge([i, j]),
            Part::Body(k) => Self::Body(k),
        }
    }
}

impl<'a> MergeView<'a> {
    fn new(merge: &'a Merge) -> Self {
        Self {
            with: merge.parts().iter().map(|&part| part.into()).collect(),
            at: merge.at(),
        }
    }
}

written! {
    Members: |own| { bodies: own.bodies, edges: own.edges }
    PieceVerdict: |own| {
        bodies: own.members.bodies, edges: own.members.edges, evidence: own.evidence,
    }
    Block: |own| { bodies: own.members.bodies, edges: own.members.edges, hubs: own.hub.as_slice() }
    Hub: |own| {
        node: own.node, parts: own.parts, split: own.split, groups: own.groups,
        components: own.components, less: own.less,
    }
    Class: |own| {
        bodies: own.members.bodies, edges: own.members.edges, evidence: own.evidence(),
        split: own.split().map(|(rigid, pieces)| SplitView { rigid, pieces }),
    }
}

impl Serialize for Evidence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Minor { draw, pivots } => object!(serializer, {
                kind: "minor", prime: Big(draw.prime), seed: Big(draw.seed), draw: draw.draw,
                rows: pivots.rows, cols: pivots.cols,
            }),
            Self::IntegerMinor(minor) => {
                let (determinant, prime) = match &minor.witness {
                    Witness::Determinant(determinant) => (Some(Big(determinant)), None),
                    Witness::Prime(prime) => (None, Some(Big(prime))),
                };
                let kernel: Vec<_> = minor.kernel.iter().map(|vector| bigs(vector)).collect();
                object!(serializer, {
                    kind: "integer-minor", numerator: minor.numerator,
                    denominator: minor.denominator, seed: Big(minor.seed), draw: minor.draw,
                    rows: minor.pivots.rows, cols: minor.pivots.cols, determinant: determinant,
                    prime: prime, kernel: kernel,
                })
            }
            Self::PlaneFlow { draw, rank } => object!(serializer, {
                kind: "plane-flow", prime: Big(draw.prime), seed: Big(draw.seed), draw: draw.draw,
                rows: rank.rigidity.rows, cols: rank.rigidity.cols, flows: rank.flows,
                lambda_rows: rank.lambda.rows, lambda_cols: rank.lambda.cols,
            }),
            Self::PlaneMinor { draw, pivots } => object!(serializer, {
                kind: "plane-minor", prime: Big(draw.prime), seed: Big(draw.seed),
                draw: draw.draw, rows: pivots.rows, cols: pivots.cols,
            }),
            Self::OneSolution => object!(serializer, { kind: "one-solution" }),
            Self::Counting(Counting { blocks, bound }) => object!(serializer, {
                kind: "counting", blocks: blocks, bound: bound,
            }),
            Self::Draws(Draws { seed, count, rank }) => object!(serializer, {
                kind: "draws", seed: Big(seed), count: count, rank: rank,
            }),
            Self::Classes(classes) => object!(serializer, { kind: "classes", classes: classes }),
            Self::Kernel { draw, vector } => object!(serializer, {
                kind: "kernel", prime: Big(draw.prime), seed: Big(draw.seed), draw: draw.draw,
                vector: bigs(vector),
            }),
        }
    }
}
