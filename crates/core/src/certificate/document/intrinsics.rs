//! The certificate of what is determined of cameras that have classes: docs/certificate.md, section 15.

use super::{Big, BodyView, GraphView, MergeView, SeedView, bigs, objects};
use crate::certificate::lines;
use crate::decide::Verdict;
use crate::graph::Graph;
use crate::intrinsics::Certified;
use serde::Serialize;
use std::io::{self, Write};

objects! {
    IntrinsicsDocument<'a> {
        format: &'static str,
        version: u32,
        question: &'static str,
        program: &'static str,
        graph: GraphView<'a>,
        classes: Vec<&'static str>,
        claim: IntrinsicsClaim<'a>,
        bodies: Vec<BodyView<'a>>,
        prime: Big<u64>,
        seed: Big<u64>,
        draw: u64,
        rows: &'a [usize],
        cols: &'a [usize],
        motion: Vec<Big<&'a u64>>,
        ; optional shared: &'a [Vec<u32>]
    }

    IntrinsicsClaim<'a> {
        verdict: &'static str,
        at_least: usize,
        at_most: usize,
        required: usize,
        components: Option<Vec<&'a [u32]>>,
        not_determined: Option<Vec<u32>>,
    }
}

impl Certified {
    /// Writes the certificate, of the graph and the verdict that were asked about. The graph is part of it
    /// if it has at most [`EMBED_NODES`](crate::certificate::EMBED_NODES) nodes, or as `embed` says.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_certificate(
        &self,
        named: (&Graph, &str),
        verdict: &Verdict,
        embed: bool,
        mut out: impl Write,
    ) -> io::Result<()> {
        let formatter = lines::Outer::default();
        let mut serializer = serde_json::Serializer::with_formatter(&mut out, formatter);
        self.document(named, verdict, embed)
            .serialize(&mut serializer)?;
        out.write_all(b"\n")
    }

    /// The same with the graph, on one line, as files with a certificate a line take it.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_line(
        &self,
        named: (&Graph, &str),
        verdict: &Verdict,
        mut out: impl Write,
    ) -> io::Result<()> {
        serde_json::to_writer(&mut out, &self.document(named, verdict, true))?;
        out.write_all(b"\n")
    }

    fn document<'a>(
        &'a self,
        (graph, name): (&'a Graph, &'a str),
        verdict: &'a Verdict,
        embed: bool,
    ) -> IntrinsicsDocument<'a> {
        let of_rules = verdict.contraction.bodies.iter();
        let of_rules = of_rules.filter_map(|body| BodyView::new(body, verdict));
        let by_rank = self.by_rank.iter().map(|body| BodyView {
            seed: SeedView::Rank(&body.members, &body.evidence),
            add: &[],
            merge: body.merge.iter().map(MergeView::new).collect(),
        });
        IntrinsicsDocument {
            format: "viewcert certificate",
            version: 3,
            question: "intrinsics",
            program: concat!("viewcert ", env!("CARGO_PKG_VERSION")),
            graph: GraphView::new((graph, name), &verdict.sha256, embed),
            classes: self.classes.iter().map(|class| class.word()).collect(),
            shared: (!self.shared.is_empty()).then_some(&*self.shared),
            claim: self.claim(),
            bodies: of_rules.chain(by_rank).collect(),
            prime: Big(self.draw.prime),
            seed: Big(self.draw.seed),
            draw: self.draw.draw,
            rows: &self.pivots.rows,
            cols: &self.pivots.cols,
            motion: bigs(&self.motion),
        }
    }

    fn claim(&self) -> IntrinsicsClaim<'_> {
        let found = &self.metric;
        let components = found.components.iter();
        let mut components: Vec<&[u32]> = components.map(|part| &*part.nodes).collect();
        components.sort_unstable();
        let nodes = (0..).zip(&found.determined);
        let not_determined = nodes.filter(|&(_, &is)| !is).map(|(node, _)| node);
        IntrinsicsClaim {
            verdict: found.verdict(),
            at_least: found.rank,
            at_most: found.at_most,
            required: found.required,
            components: found.is_proved().then_some(components),
            not_determined: found.is_proved().then(|| not_determined.collect()),
        }
    }
}
