//! What a certificate is checked for: the graph, and what is named besides it.

use crate::intrinsics;
use crate::plan::IntrinsicsFrom;
use anyhow::{Context, Result, ensure};
use std::borrow::Cow;
use std::path::Path;
use viewcert::Known;
use viewcert::certificate::hex;
use viewcert::graph::{Labels, sha256};
use viewcert_check::{Certificate, Expected, Graph, Question};
use viewcert_formats::{Beside, NamedGraph, ReadOptions, beside, read_meant};

/// Where what is named besides a certificate comes from.
pub(super) struct Named<'a> {
    /// The file of the graph.
    pub(super) graph: Option<&'a Path>,
    /// The file of what is given besides.
    pub(super) given: Option<&'a Path>,
    /// Whether that is in the frame of the directions.
    pub(super) one_frame: bool,
    /// Where the classes of cameras are from.
    pub(super) classes: Option<&'a IntrinsicsFrom>,
    /// How the graph is read.
    pub(super) read: &'a ReadOptions,
}

impl Named<'_> {
    /// The graph for which a certificate is checked, if one is named or something is given beside that of the
    /// certificate; hypotheses that go by their hashes join what is expected.
    ///
    /// # Errors
    /// If there is no such graph; those of the files.
    pub(super) fn resolve(
        &self,
        certificate: &Certificate,
        expected: &mut Expected,
    ) -> Result<Option<Graph>> {
        let (input, graph) = match self.graph {
            Some(path) => {
                let input = named_at(certificate.graph_sha256(), path, self.read)?;
                let pairs = input.graph.edges().iter().copied();
                let graph = Graph::new(input.graph.nodes(), pairs);
                let graph = graph.with_context(|| input.name.clone())?;
                (input, graph)
            }
            None if self.given.is_none() => return Ok(None),
            // Where the certificate holds no graph, it is rejected for that.
            None => match certificate.held_graph() {
                Ok(Some(graph)) => {
                    let nodes = viewcert::Graph::new(u32::try_from(graph.nodes())?, [])?;
                    let labels = Labels::Numbers { first: 0 };
                    (NamedGraph::new("", nodes, labels), graph)
                }
                _ => return Ok(None),
            },
        };
        let graph = self.with_given(certificate, (&input, graph), expected)?;
        if self.classes.is_some() {
            let (_, sensors) = intrinsics::read(self.classes, Cow::Borrowed(&input))?;
            expected.classes = sensors.map(|sensors| hex(&sensors.sha256()));
        }
        Ok(Some(graph))
    }

    /// The graph with what is known beside its pairs, by its file and by rigs.
    fn with_given(
        &self,
        certificate: &Certificate,
        (input, mut graph): (&NamedGraph, Graph),
        expected: &mut Expected,
    ) -> Result<Graph> {
        let is_generic = certificate.question() == Question::Generic;
        if self.given.is_none() && !is_generic {
            return Ok(graph);
        }
        // The check compares what the graph comes with, rigs included, with what the certificate supposes.
        expected.given |= self.graph.is_some() && is_generic;
        if let Some(hash) = input.frames.as_ref().and_then(|frames| frames.sha256()) {
            graph = graph.with_frames(hex(&hash));
        }
        let model = certificate.model().unwrap_or_default().to_string();
        let model = model.parse::<viewcert::Model>()?;
        match beside(self.given, input, model, self.one_frame)? {
            Beside::Cameras(cameras) => {
                let hash = hex(&cameras.centres.sha256());
                ensure!(
                    expected.centres.as_ref().is_none_or(|other| *other == hash),
                    "--centres is not the hash of the cameras that are given, {hash}; leave out one of the two"
                );
                expected.centres = Some(hash);
                Ok(graph)
            }
            Beside::Known(given) => match given.known {
                Known::Parts(parts) => {
                    let graph = graph.with_parts(parts.iter().map(<[u32]>::to_vec));
                    let file = self.given.unwrap_or(Path::new(&input.name));
                    graph.with_context(|| file.display().to_string())
                }
                Known::Displacements(known) => Ok(graph.with_displacements(hex(&known.sha256()))),
                Known::OwnFrame { given, rigs } => {
                    if !rigs.is_empty() {
                        graph = graph.with_displacements(hex(&rigs.sha256()));
                    }
                    Ok(graph.with_own_frame(hex(&given.sha256())))
                }
            },
        }
    }
}

/// The graph in a file that a certificate is about, or else the first one, as it was read.
///
/// # Errors
/// If there is no such graph.
fn named_at(hash: &str, path: &Path, options: &ReadOptions) -> Result<NamedGraph> {
    let is_meant = |input: &NamedGraph| hex(&sha256(&input.graph)) == hash;
    let found = read_meant(path, options, is_meant)?;
    found.with_context(|| format!("{}: the file holds no graph", path.display()))
}
