//! The certificate of what is determined at given cameras: docs/certificate.md, section 14.

use super::{
    Big, BodyView, ClaimView, GraphView, MergeView, PartView, Rank, SeedView, SplitView, Valued,
    bigs, object, objects, written,
};
use crate::at_cameras::{Centres, Class, Here, Piece};
use crate::certificate::lines;
use crate::contract::piece::Members;
use crate::contract::{Body, Seed};
use crate::graph::{Graph, sha256};
use crate::linalg::integer::Integer;
use serde::Serialize;
use std::io::{self, Write};

objects! {
    HereDocument<'a> {
        format: &'static str,
        version: u32,
        question: &'static str,
        program: &'static str,
        graph: GraphView<'a>,
        model: &'static str,
        cameras: Option<Vec<Vec<Big<&'a Integer>>>>,
        centres: Vec<Vec<Big<&'a Integer>>>,
        claim: ClaimView,
        bodies: Vec<BodyView<'a>>,
        rigid: &'a Members,
        pieces: &'a [Piece],
    }
}

written! {
    Piece: |own| {
        bodies: own.members.bodies, edges: own.members.edges, rank: own.rank, primes: own.primes,
        kernel: bigs(&own.kernel), classes: own.classes,
    }
    Class: |own| {
        bodies: own.members.bodies, edges: own.members.edges,
        split: own.split.as_ref().map(|(rigid, pieces)| SplitView { rigid, pieces }),
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
            format: "viewcert certificate",
            version: 3,
            question: "at-cameras",
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
                own_frame: None,
            },
            bodies: self
                .contraction
                .bodies
                .iter()
                .map(BodyView::of_rules)
                .collect(),
            rigid: &self.rigid,
            pieces: &self.pieces,
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
