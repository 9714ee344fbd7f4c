//! Independent checker of viewcert certificates.
//!
//! A certificate binds a claim about a viewing graph - solvable or not, the rank, the number of components - to the graph by
//! a hash, and carries evidence. [`check`] verifies the evidence and recomputes the claim from it. The format and the
//! conditions are those of `docs/certificate.md`; this crate implements that page and shares no code with the program that
//! writes certificates. What it cannot verify in full it rejects.
//!
//! In the order of reading: [`check`] below; `json` reads the text; `graph` reads graphs and hashes them; `bodies`
//! rebuilds rigid bodies and `pieces` what is left between them; `evidence` verifies a piece with the help of `rank` (lower
//! bounds) and `counting` (upper bounds); `claim` compares. `cameras`, `chacha`, `modular`, `matrix` and `formulation`
//! compute.

mod bodies;
mod cameras;
mod chacha;
mod claim;
mod counting;
mod evidence;
mod formulation;
mod graph;
mod json;
mod matrix;
mod modular;
mod pieces;
mod rank;
mod rejection;

pub use claim::{Verdict, Verified};
pub use evidence::Strength;
pub use graph::{Graph, GraphError};
pub use rank::Model;
pub use rejection::Rejection;

use claim::Identity;
use json::Value;
use rejection::{Checked, Within, ensure};
use std::borrow::Cow;

/// A certificate that has been parsed, but not verified.
#[derive(Debug)]
pub struct Certificate<'a>(Value<'a>);

/// Verifies a certificate, for the given graph or, without one, for the graph that it holds.
///
/// Takes time linear in the certificate and the graph, plus the elimination of the matrices of the pieces' cores.
///
/// # Errors
/// The first thing that cannot be verified.
///
/// ```
/// let certificate = br#"{"format": "viewcert certificate", "version": 1, "program": "by hand",
///     "graph": {"name": "a pair", "nodes": 2, "edges": 1, "graph6": "A_",
///         "sha256": "1a2922f94e61dd3386d10331aca4a4e92403b8e12be0532bcbc2ddaf95da33eb"},
///     "model": "projective",
///     "claim": {"verdict": {"value": "solvable", "strength": "proof", "error_log2": null},
///         "rank": {"value": 7, "required": 7, "strength": "proof", "error_log2": null},
///         "components": {"value": 1, "strength": "proof", "error_log2": null}},
///     "bodies": [], "rigid": {"bodies": [], "edges": [[0, 1]]}, "pieces": []}"#;
/// let verified = viewcert_check::check(certificate, None).unwrap();
/// assert_eq!(verified.verdict().0, viewcert_check::Verdict::Solvable);
/// ```
pub fn check(certificate: &[u8], graph: Option<&Graph>) -> Result<Verified, Rejection> {
    Certificate::parse(certificate)?.check(graph)
}

impl<'a> Certificate<'a> {
    /// Reads the JSON text.
    ///
    /// # Errors
    /// What is wrong with it, with the position.
    pub fn parse(text: &'a [u8]) -> Result<Certificate<'a>, Rejection> {
        json::parse(text).map(Certificate)
    }

    /// The hash of the graph that the certificate names, to find that graph in a file of many.
    pub fn graph_sha256(&self) -> Option<[u8; 32]> {
        let graph = self.0.members().ok()?.take("graph").ok()?;
        let text = graph.members().ok()?.take("sha256").ok()?.text().ok()?;
        let mut hash = [0; 32];
        for (byte, digits) in hash.iter_mut().zip(text.as_bytes().chunks(2)) {
            *byte = u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()?;
        }
        (hex(&hash) == text).then_some(hash)
    }

    /// See [`check`].
    ///
    /// # Errors
    /// The first thing that cannot be verified.
    pub fn check(&self, graph: Option<&Graph>) -> Result<Verified, Rejection> {
        let mut members = self.0.members()?;
        let format = members.read("format", Value::text)?;
        ensure!(format == "viewcert certificate", "`format` is not \"viewcert certificate\"");
        let version = members.read("version", Value::int)?;
        ensure!(version == 1, "version {version} is unknown to this program");
        members.read("program", Value::text)?;
        let (graph, sha256) = members.read("graph", |value| identify(value, graph))?;
        let model = members.read("model", |value| match value.text()? {
            "projective" => Ok(Model::Projective),
            "calibrated" => Ok(Model::Calibrated),
            other => Err(Rejection::new(format!("unknown model `{other}`"))),
        })?;
        let claim = members.take("claim")?;
        let bodies = bodies::rebuild(members.take("bodies")?, &graph)?;
        let structure = pieces::Structure::new(&graph, bodies).within(|| "bodies".into())?;
        let setting = rank::Setting { model, graph: &sha256 };
        let pieces = evidence::read_pieces(&mut members, setting, &structure, &structure.everything)?;
        members.end()?;
        let identity = Identity { nodes: graph.nodes(), edges: graph.edges(), sha256: hex(&sha256) };
        claim::verify(claim, identity, model, &pieces).within(|| "claim".into())
    }
}

fn hex(bytes: &[u8; 32]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The graph that the certificate is about, and its hash.
fn identify<'g>(value: &Value, given: Option<&'g Graph>) -> Checked<(Cow<'g, Graph>, [u8; 32])> {
    let mut members = value.members()?;
    members.read("name", Value::text)?;
    let nodes = members.read("nodes", Value::count)?;
    let edges = members.read("edges", Value::count)?;
    let sha256 = members.read("sha256", Value::text)?;
    let embedded = members.read("graph6", |value| {
        if value.is_null() {
            return Ok(None);
        }
        let graph = Graph::from_graph6(value.text()?.as_bytes());
        graph.map(Some).map_err(|error| Rejection::new(error.to_string()))
    })?;
    members.end()?;
    if let (Some(embedded), Some(_)) = (&embedded, given) {
        ensure!(hex(&embedded.sha256()) == sha256, "`graph6` is not the graph with this `sha256`");
    }
    let graph = match (given, embedded) {
        (Some(graph), _) => Cow::Borrowed(graph),
        (None, Some(graph)) => Cow::Owned(graph),
        (None, None) => {
            return Err(Rejection::new("the certificate does not hold the graph, and none is given"));
        }
    };
    let hash = graph.sha256();
    ensure!(hex(&hash) == sha256, "the graph has another hash than `sha256`");
    ensure!(graph.nodes() as u64 == nodes, "the graph has {} nodes, not {nodes}", graph.nodes());
    ensure!(graph.edges() as u64 == edges, "the graph has {} edges, not {edges}", graph.edges());
    ensure!(edges >= 1, "the graph has no edges");
    Ok((graph, hash))
}
