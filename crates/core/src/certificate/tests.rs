//! The writer against a document written by hand after docs/certificate.md.

use super::*;
use crate::decide::{Options, decide};
use crate::graph::graph6;

/// A triangle 0, 1, 2 and node 3 seen from node 2. Growth takes nodes by falling degree: node 2
/// first, with its first neighbour 0; node 1 is reached from 2, then from 0, and joins. The body
/// and the loose edge are pieces by themselves: 18 + 7 = 25 of 11 * 4 - 15 = 29. The digest is by
/// Python's hashlib; in graph6 the bits are 111001, that is 57, and 57 + 63 is x.
const EXPECTED: &str = concat!(
    r#"{"format":"viewcert certificate","version":3,"question":"generic","program":"viewcert "#,
    env!("CARGO_PKG_VERSION"),
    r#"","graph":{"name":"a \"triangle\"","nodes":4,"edges":4,"sha256":""#,
    "d16f62c51a7f7a70f8bc7aaa9931dd7d7608c19a0df6187f90c46f1bb043ea26",
    r#"","graph6":"Cx"},"model":"projective","#,
    r#""claim":{"verdict":{"value":"not-finite-solvable","strength":"proof","error_log2":null},"#,
    r#""rank":{"value":25,"required":29,"strength":"proof","error_log2":null},"#,
    r#""components":{"value":2,"strength":"proof","error_log2":null}},"#,
    r#""bodies":[{"seed":[0,2],"add":[[1,2,0]],"merge":[]}],"#,
    r#""rigid":{"bodies":[0],"edges":[[2,3]]},"pieces":[]}"#,
    "\n",
);

fn triangle_with_pendant() -> Graph {
    Graph::new(4, [(0, 1), (0, 2), (1, 2), (2, 3)]).unwrap()
}

#[test]
fn a_triangle_with_a_pendant_edge() {
    let graph = triangle_with_pendant();
    let verdict = decide(&graph, &Options::default()).unwrap();
    let certificate = verdict.certificate(&graph).named("a \"triangle\"");
    assert_eq!(certificate.compact().to_string(), EXPECTED);

    // Lines are broken down to the third level, and nothing else is different.
    let lines = certificate.to_string();
    let joined: String = lines.lines().map(str::trim_start).collect();
    assert_eq!(joined + "\n", EXPECTED);
    for line in [
        "{",
        " \"version\":3,",
        " \"claim\":{",
        "  \"verdict\":{",
        "   \"value\":25,",
        "}",
    ] {
        assert!(lines.lines().any(|found| found == line), "{line}");
    }
    let mut bytes = Vec::new();
    certificate.write_to(&mut bytes).unwrap();
    assert_eq!(bytes, lines.as_bytes());
}

/// Text of more than one byte a character, and what JSON escapes, passes through the formatter.
#[test]
fn names_are_text() {
    let graph = triangle_with_pendant();
    let verdict = decide(&graph, &Options::default()).unwrap();
    let name = "Küche \\ \t 台所";
    let text = verdict.certificate(&graph).named(name).to_string();
    let document: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(document["graph"]["name"], name);
}

#[test]
fn large_graphs_are_embedded_on_request() {
    let nodes = EMBED_NODES as u32;
    for (more, asked, embedded) in [(0, false, true), (1, false, false), (1, true, true)] {
        let last = nodes + more - 1;
        let graph = Graph::from_edges((0..last).map(|v| (v, v + 1))).unwrap();
        let verdict = decide(&graph, &Options::default()).unwrap();
        let text = verdict.certificate(&graph).embed_graph(asked).to_string();
        let document: serde_json::Value = serde_json::from_str(&text).unwrap();
        let expected = embedded.then(|| graph6::encode(&graph));
        assert_eq!(document["graph"]["graph6"].as_str(), expected.as_deref());
    }
}

/// A writer with no room left.
struct Full;

impl Write for Full {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::ErrorKind::StorageFull.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn errors_of_the_writer_come_back() {
    let graph = triangle_with_pendant();
    let verdict = decide(&graph, &Options::default()).unwrap();
    let error = verdict.certificate(&graph).write_to(Full).unwrap_err();
    assert_eq!(error.kind(), io::ErrorKind::StorageFull);
}
