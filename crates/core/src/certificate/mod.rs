//! The certificate as written: docs/certificate.md, version 2.

mod document;
mod lines;

pub use document::hex;

use crate::decide::Verdict;
use crate::graph::{Graph, graph6};
use std::io::{self, Write};

/// Up to this many nodes the graph is embedded unless asked otherwise.
pub const EMBED_NODES: usize = 100;

/// How the JSON text is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// On several lines, for a file of its own.
    Lines,
    /// On one line, for JSON lines.
    Compact,
}

/// Writes the certificate of a verdict. `graph` is embedded as graph6 if it has at most
/// [`EMBED_NODES`] nodes, or if `embed` asks for it. The bytes depend on nothing but the
/// arguments.
///
/// # Errors
/// Those of the writer.
pub fn write(
    out: &mut impl Write,
    name: &str,
    graph: &Graph,
    verdict: &Verdict,
    embed: bool,
    layout: Layout,
) -> io::Result<()> {
    let embedded = (embed || graph.nodes() <= EMBED_NODES).then(|| graph6::encode(graph));
    let document = document::Document::new(name, graph, embedded, verdict);
    match layout {
        Layout::Compact => serde_json::to_writer(&mut *out, &document)?,
        Layout::Lines => {
            let mut serializer =
                serde_json::Serializer::with_formatter(&mut *out, lines::Outer::default());
            serde::Serialize::serialize(&document, &mut serializer)?;
        }
    }
    out.write_all(b"\n")
}
