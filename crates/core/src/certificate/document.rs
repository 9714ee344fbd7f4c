//! The members of the certificate, borrowed from a verdict.

mod here;
mod intrinsics;

use super::EMBED_NODES;
use super::base_lines::{BaseLinesView, ClaimedBaseLines};
use super::objects::{Big, bigs, objects};
use super::solutions::{self, ClaimedSolutions, ForeignSolutions, SolutionsView};
use crate::contract::piece::Members;
use crate::contract::{Body, Merge, Part, Seed};
use crate::decide::evidence::{
    Class, ClassKind, Draws, Evidence, IntegerMinor, ModularDraw, PieceVerdict, Witness,
};
use crate::decide::{Block, Claim, Counting, Hub, SharedBaseLines, Value, Verdict};
use crate::geometry::plane_flow::PlaneFlowRank;
use crate::graph::{Graph, graph6};
use crate::linalg::integer::Integer;
use crate::linalg::textbook::Pivots;
use crate::solutions::Solutions;
use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Serialize, Serializer};

objects! {
    Document<'a> {
        format: &'static str,
        version: u32,
        program: &'static str,
        graph: GraphView<'a>,
        model: &'static str,
        claim: ClaimView,
        bodies: Vec<BodyView<'a>>,
        rigid: MembersView<'a>,
        pieces: Vec<PieceView<'a>>,
        ; optional displacements: &'a [Vec<u32>], vectors: Vec<Vec<[Big<i128>; 3]>>, solutions: SolutionsView<'a>, parts: Vec<&'a [u32]>, base_lines: BaseLinesView<'a>
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
        ; optional solutions: ClaimedSolutions, base_lines: ClaimedBaseLines
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

    MembersView<'a> {
        bodies: &'a [u32],
        edges: &'a [(u32, u32)],
    }

    PieceView<'a> {
        bodies: &'a [u32],
        edges: &'a [(u32, u32)],
        evidence: List<'a, Evidence>,
    }

    SplitView<'a> {
        rigid: MembersView<'a>,
        pieces: Vec<PieceView<'a>>,
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
        solutions: Option<&'a Solutions>,
        base_lines: Option<&'a SharedBaseLines>,
    ) -> Result<Self, ForeignSolutions> {
        let (mut value, rank) = (verdict.value_claim(), verdict.rank_claim());
        value.value = verdict.value_by_rank();
        let components = verdict.components_claim();
        let known = solutions.map(|solutions| solutions::view(verdict, solutions));
        let (claimed, evidence) = known.transpose()?.flatten().unzip();
        if evidence.is_some()
            && solutions
                .is_some_and(|solutions| solutions.at_most.as_ref().is_some_and(|most| *most == 1))
        {
            value.value = Value::Solvable;
        }
        Ok(Self {
            format: "viewcert certificate",
            version: 2,
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
            },
            bodies: verdict
                .contraction
                .bodies
                .iter()
                .filter_map(|body| BodyView::new(body, verdict))
                .collect(),
            rigid: (&verdict.rigid).into(),
            pieces: verdict.pieces.iter().map(PieceView::new).collect(),
            displacements: Some(verdict.displacements.groups()).filter(|groups| !groups.is_empty()),
            vectors: verdict.displacements.vectors().map(|groups| {
                let vectors = |group: &Vec<[i128; 3]>| group.iter().map(|v| v.map(Big)).collect();
                groups.iter().map(vectors).collect()
            }),
            solutions: evidence,
            base_lines: base_lines.map(BaseLinesView::from),
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
    Rank(PieceView<'a>),
}

impl Serialize for SeedView<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Part(part) => part.serialize(serializer),
            Self::Rank(members) => members.serialize(serializer),
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
                Seed::Rank(k) => {
                    let members = &verdict.contraction.by_rank[k as usize];
                    SeedView::Rank(PieceView {
                        bodies: &members.bodies,
                        edges: &members.edges,
                        evidence: List(std::slice::from_ref(&verdict.by_rank[k as usize])),
                    })
                }
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
        let at: &[u32] = match merge {
            Merge::Scaled { at, .. } => at,
            Merge::Shared { at, .. } => at,
            Merge::Triangle { at, .. } => at,
            Merge::Cycle { at, .. } => at,
            Merge::Biclique { at, .. } => at,
        };
        Self {
            with: merge.parts().iter().map(|&part| part.into()).collect(),
            at,
        }
    }
}

impl<'a> From<&'a Members> for MembersView<'a> {
    fn from(members: &'a Members) -> Self {
        Self {
            bodies: &members.bodies,
            edges: &members.edges,
        }
    }
}

impl<'a> PieceView<'a> {
    fn new(piece: &'a PieceVerdict) -> Self {
        Self {
            bodies: &piece.members.bodies,
            edges: &piece.members.edges,
            evidence: List(&piece.evidence),
        }
    }
}

/// A slice whose elements have their own way of being written.
struct List<'a, T>(&'a [T]);

impl<T> Serialize for List<'_, T>
where
    for<'b> View<'b, T>: Serialize,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(Some(self.0.len()))?;
        for item in self.0 {
            list.serialize_element(&View(item))?;
        }
        list.end()
    }
}

struct View<'a, T>(&'a T);

impl Serialize for View<'_, Evidence> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        match self.0 {
            Evidence::Minor { draw, pivots } => {
                map.serialize_entry("kind", "minor")?;
                map.serialize_entry("prime", &Big(draw.prime))?;
                seed_and_draw(&mut map, draw)?;
                rows_and_cols(&mut map, pivots)?;
            }
            Evidence::IntegerMinor(minor) => integer_minor(&mut map, minor)?,
            Evidence::PlaneFlow { draw, rank } => plane_flow(&mut map, draw, rank)?,
            Evidence::PlaneMinor { draw, pivots } => {
                map.serialize_entry("kind", "plane-minor")?;
                map.serialize_entry("prime", &Big(draw.prime))?;
                seed_and_draw(&mut map, draw)?;
                rows_and_cols(&mut map, pivots)?;
            }
            Evidence::Counting(Counting { blocks, bound }) => {
                map.serialize_entry("kind", "counting")?;
                map.serialize_entry("blocks", &List(blocks))?;
                map.serialize_entry("bound", bound)?;
            }
            Evidence::Draws(Draws { seed, count, rank }) => {
                map.serialize_entry("kind", "draws")?;
                map.serialize_entry("seed", &Big(seed))?;
                map.serialize_entry("count", count)?;
                map.serialize_entry("rank", rank)?;
            }
            Evidence::Classes(classes) => {
                map.serialize_entry("kind", "classes")?;
                map.serialize_entry("classes", &List(classes))?;
            }
            Evidence::Kernel { draw, vector } => {
                map.serialize_entry("kind", "kernel")?;
                map.serialize_entry("prime", &Big(draw.prime))?;
                seed_and_draw(&mut map, draw)?;
                map.serialize_entry("vector", &bigs(vector))?;
            }
        }
        map.end()
    }
}

fn seed_and_draw<M: SerializeMap>(map: &mut M, draw: &ModularDraw) -> Result<(), M::Error> {
    map.serialize_entry("seed", &Big(draw.seed))?;
    map.serialize_entry("draw", &draw.draw)
}

fn rows_and_cols<M: SerializeMap>(map: &mut M, pivots: &Pivots) -> Result<(), M::Error> {
    map.serialize_entry("rows", &pivots.rows)?;
    map.serialize_entry("cols", &pivots.cols)
}

fn integer_minor<M: SerializeMap>(map: &mut M, minor: &IntegerMinor) -> Result<(), M::Error> {
    map.serialize_entry("kind", "integer-minor")?;
    map.serialize_entry("numerator", &minor.numerator)?;
    map.serialize_entry("denominator", &minor.denominator)?;
    map.serialize_entry("seed", &Big(minor.seed))?;
    map.serialize_entry("draw", &minor.draw)?;
    rows_and_cols(map, &minor.pivots)?;
    let (determinant, prime) = match &minor.witness {
        Witness::Determinant(determinant) => (Some(Big(determinant)), None),
        Witness::Prime(prime) => (None, Some(Big(prime))),
    };
    map.serialize_entry("determinant", &determinant)?;
    map.serialize_entry("prime", &prime)?;
    let kernel: Vec<Vec<Big<&Integer>>> = minor.kernel.iter().map(|vector| bigs(vector)).collect();
    map.serialize_entry("kernel", &kernel)
}

fn plane_flow<M: SerializeMap>(
    map: &mut M,
    draw: &ModularDraw,
    rank: &PlaneFlowRank,
) -> Result<(), M::Error> {
    map.serialize_entry("kind", "plane-flow")?;
    map.serialize_entry("prime", &Big(draw.prime))?;
    seed_and_draw(map, draw)?;
    rows_and_cols(map, &rank.rigidity)?;
    map.serialize_entry("flows", &rank.flows)?;
    map.serialize_entry("lambda_rows", &rank.lambda.rows)?;
    map.serialize_entry("lambda_cols", &rank.lambda.cols)
}

impl Serialize for View<'_, Class> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let evidence: &[Evidence] = match &self.0.kind {
            ClassKind::Rigid(evidence) => evidence,
            _ => &[],
        };
        let split = match &self.0.kind {
            ClassKind::Loose { rigid, pieces } => Some(SplitView {
                rigid: rigid.into(),
                pieces: pieces.iter().map(PieceView::new).collect(),
            }),
            _ => None,
        };
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("bodies", &self.0.members.bodies)?;
        map.serialize_entry("edges", &self.0.members.edges)?;
        map.serialize_entry("evidence", &List(evidence))?;
        map.serialize_entry("split", &split)?;
        map.end()
    }
}

impl Serialize for View<'_, Block> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let hubs: Vec<&Hub> = self.0.hub.iter().collect();
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("bodies", &self.0.members.bodies)?;
        map.serialize_entry("edges", &self.0.members.edges)?;
        map.serialize_entry(
            "hubs",
            &hubs.iter().map(|hub| View(*hub)).collect::<Vec<_>>(),
        )?;
        map.end()
    }
}

impl Serialize for View<'_, Hub> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let parts: Vec<MembersView> = self.0.parts.iter().map(MembersView::from).collect();
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("node", &self.0.node)?;
        map.serialize_entry("parts", &parts)?;
        map.serialize_entry("split", &self.0.split)?;
        map.serialize_entry("groups", &self.0.groups)?;
        map.serialize_entry("components", &self.0.components)?;
        map.serialize_entry("less", &self.0.less)?;
        map.end()
    }
}
