//! The certificate of what is determined at given cameras: docs/certificate.md, section 14.

use super::{
    Big, BodyView, ClaimView, GraphView, MembersView, MergeView, PartView, Rank, SeedView, Valued,
    bigs, objects,
};
use crate::certificate::lines;
use crate::contract::piece::Members;
use crate::contract::{Body, Seed};
use crate::graph::{Graph, sha256};
use crate::here::{Centres, Class, Here, Piece};
use crate::linalg::integer::Integer;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::io::{self, Write};

objects! {
    HereDocument<'a> {
        format: &'static str,
        version: u32,
        program: &'static str,
        graph: GraphView<'a>,
        model: &'static str,
        cameras: Option<Vec<Vec<Big<&'a Integer>>>>,
        centres: Vec<Vec<Big<&'a Integer>>>,
        claim: ClaimView,
        bodies: Vec<BodyView<'a>>,
        rigid: MembersView<'a>,
        pieces: Vec<HerePiece<'a>>,
    }

    HerePiece<'a> {
        bodies: &'a [u32],
        edges: &'a [(u32, u32)],
        rank: usize,
        primes: u64,
        kernel: Vec<Big<&'a u64>>,
        classes: Vec<HereClass<'a>>,
    }

    HereClass<'a> {
        bodies: &'a [u32],
        edges: &'a [(u32, u32)],
        split: Option<HereSplit<'a>>,
    }
}

/// Members by themselves and pieces; written by hand, as pieces hold it again.
struct HereSplit<'a>(&'a Members, &'a [Piece]);

impl Serialize for HereSplit<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("rigid", &MembersView::from(self.0))?;
        let pieces: Vec<HerePiece> = self.1.iter().map(HerePiece::new).collect();
        map.serialize_entry("pieces", &pieces)?;
        map.end()
    }
}

impl Here {
    /// Writes the certificate: of `graph` at `centres`, which have to be those that were decided. The
    /// graph is part of it if it has at most [`EMBED_NODES`](crate::certificate::EMBED_NODES) nodes, or as `embed` says.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_certificate(
        &self,
        (graph, name): (&Graph, &str),
        centres: &Centres,
        embed: bool,
        mut out: impl Write,
    ) -> io::Result<()> {
        let determined = |is: bool| if is { "determined" } else { "not-determined" };
        let document = HereDocument {
            format: "viewcert certificate at cameras",
            version: 1,
            program: concat!("viewcert ", env!("CARGO_PKG_VERSION")),
            graph: GraphView::new((graph, name), &sha256(graph), embed),
            model: self.model.name(),
            cameras: centres
                .cameras()
                .map(|all| all.iter().map(|camera| bigs(camera)).collect()),
            centres: centres.places().iter().map(|place| bigs(place)).collect(),
            claim: ClaimView {
                verdict: Valued::new(self.verdict(), determined),
                rank: Rank {
                    value: self.rank.value,
                    required: self.required,
                    strength: self.rank.strength.name(),
                    error_log2: self.rank.strength.error_log2(),
                },
                components: Valued::new(self.components.clone(), |all| all.len()),
                solutions: None,
                base_lines: None,
            },
            bodies: self
                .contraction
                .bodies
                .iter()
                .map(BodyView::of_rules)
                .collect(),
            rigid: (&self.rigid).into(),
            pieces: self.pieces.iter().map(HerePiece::new).collect(),
        };
        let mut serializer =
            serde_json::Serializer::with_formatter(&mut out, lines::Outer::default());
        document.serialize(&mut serializer)?;
        out.write_all(b"\n")
    }
}

impl<'a> BodyView<'a> {
    /// A body that comes from edges by merges.
    fn of_rules(body: &'a Body) -> Self {
        Self {
            seed: SeedView::Part(match body.seed {
                Seed::Edge(i, j) => PartView::Edge([i, j]),
                Seed::Body(k) => PartView::Body(k),
                Seed::Known | Seed::Rank(_) => {
                    unreachable!("bodies at given cameras come from edges")
                }
            }),
            add: &body.add,
            merge: body.merge.iter().map(MergeView::new).collect(),
        }
    }
}

impl<'a> HerePiece<'a> {
    fn new(piece: &'a Piece) -> Self {
        Self {
            bodies: &piece.members.bodies,
            edges: &piece.members.edges,
            rank: piece.rank,
            primes: piece.primes,
            kernel: bigs(&piece.kernel),
            classes: piece.classes.iter().map(HereClass::new).collect(),
        }
    }
}

impl<'a> HereClass<'a> {
    fn new(class: &'a Class) -> Self {
        Self {
            bodies: &class.members.bodies,
            edges: &class.members.edges,
            split: class
                .split
                .as_ref()
                .map(|(rigid, pieces)| HereSplit(rigid, pieces)),
        }
    }
}
