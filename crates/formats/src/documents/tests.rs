use std::collections::BTreeSet;
use std::fmt::Write;

use proptest::prelude::*;

use super::*;
use crate::read_as::Parsed;

fn found(document: Document, text: &str) -> Result<Parsed, String> {
    read(document, text.as_bytes()).map_err(|fault| fault.in_file("in").to_string())
}

/// The labels of a graph's pairs, and of its nodes.
fn listed(Parsed { graph, labels, .. }: &Parsed) -> (BTreeSet<[String; 2]>, Vec<String>) {
    let label = |node: u32| labels.label(node).into_owned();
    let pair = |&(a, b): &(u32, u32)| {
        let mut pair = [label(a), label(b)];
        pair.sort();
        pair
    };
    let nodes = (0..graph.nodes() as u32).map(label).collect();
    (graph.edges().iter().map(pair).collect(), nodes)
}

fn pairs(document: Document, text: &str) -> Vec<String> {
    let parsed = found(document, text).unwrap_or_else(|error| panic!("{error}"));
    let (pairs, _) = listed(&parsed);
    pairs.iter().map(|pair| pair.join(" ")).collect()
}

fn refusal(document: Document, text: &str) -> String {
    found(document, text).expect_err(text)
}

#[test]
fn formats_are_recognised_by_their_content() {
    let of = |text: &str| Document::of(text.as_bytes(), true);
    for (text, expected) in [
        ("graph {", None),
        ("graph [\n directed 0\n]", None),
        ("# c\n\n VERTEX_SE2 0", Some(Document::G2o)),
        ("VERTEX_1.jpg VERTEX_2.jpg", None),
        (
            "<?xml version='1.0'?>\n<!-- graphml -->\n<graphml >",
            Some(Document::GraphMl),
        ),
        ("<g:graphml xmlns:g='x'>", Some(Document::GraphMl)),
        ("<html><body>the graphml format</body></html>", None),
        ("<gexf>", None),
        ("{\n \"nodes\"", None),
        // Neighbours look like sets, and have to be asked for.
        ("0 1 2 3\n1 2\n2\n", None),
        ("a.jpg b.jpg\n0 1\n", Some(Document::RawMatches)),
        ("a b\n0 1\n\nb c\n3 4\n", Some(Document::RawMatches)),
        ("a b\n0 1\nb c\n3 4\n", None),
    ] {
        assert_eq!(of(text), expected, "{text}");
    }
}

#[test]
fn stars_are_pairs_with_the_first() {
    let text = "0 1 2 3 # c\n1 2\n3\n";
    let parsed = read(Document::Stars, text.as_bytes()).unwrap();
    let (pairs, nodes) = listed(&parsed);
    assert_eq!(pairs.len(), 4);
    assert_eq!(nodes, ["0", "1", "2", "3"]);
    let text = "b a \"c d\"\nc b\n";
    assert_eq!(self::pairs(Document::Stars, text), ["a b", "b c", "b c d"]);
    assert!(refusal(Document::Stars, "0 1 0\n").contains("in:1: camera 0 is paired with itself"));
}

#[test]
fn what_is_no_text_is_refused_with_the_line() {
    for (bytes, phrase) in [
        (
            &b"graph {\n a -- b\0 }"[..],
            "in:2: this is no text: it has a NUL byte",
        ),
        (b"graph {\n a -- \xff }", "in:2: this is no UTF-8 text"),
        (
            b"graph {\r\n a\r -- b }",
            "in:2: there is a carriage return",
        ),
        (b"graph {\n\n a\x0c -- b }", "in:3: this is no plain text"),
    ] {
        let fault = read(Document::GraphMl, bytes).unwrap_err();
        assert!(fault.in_file("in").to_string().starts_with(phrase));
    }
}

const ALL: [Document; 4] = [
    Document::G2o,
    Document::GraphMl,
    Document::Stars,
    Document::ViewSelection,
];

/// A graph as a text of a format. Integer labels only for those that have no others.
fn written(document: Document, labels: &[String], pairs: &[(usize, usize)]) -> String {
    let xml = |text: &str| {
        let escaped = text.replace('&', "&amp;").replace('<', "&lt;");
        format!(
            "\"{}\"",
            escaped.replace('"', "&quot;").replace('\'', "&apos;")
        )
    };
    let mut text = String::new();
    match document {
        Document::GraphMl => {
            text += "<graphml><graph edgedefault=\"undirected\">\n";
            for label in labels {
                writeln!(text, "<node id={}/>", xml(label)).unwrap();
            }
            for &(a, b) in pairs {
                let (a, b) = (xml(&labels[a]), xml(&labels[b]));
                writeln!(text, "<edge source={a} target={b}></edge>").unwrap();
            }
            text += "</graph></graphml>\n";
        }
        Document::G2o => {
            for label in labels {
                writeln!(text, "VERTEX_SE2 {label} 0 0 0").unwrap();
            }
            for &(a, b) in pairs {
                writeln!(
                    text,
                    "EDGE_SE2 {} {} 0 0 0 1 0 0 1 0 1",
                    labels[a], labels[b]
                )
                .unwrap();
            }
        }
        Document::ViewSelection => {
            writeln!(text, "{}", labels.len()).unwrap();
            for (label, node) in labels.iter().zip(0..) {
                let all: Vec<_> = pairs.iter().filter(|&&(a, _)| a == node).collect();
                write!(text, "{label}\n{}", all.len()).unwrap();
                for (_, b) in all {
                    write!(text, " {} 0.5", labels[*b]).unwrap();
                }
                text += "\n";
            }
        }
        Document::RawMatches => {
            for &(a, b) in pairs {
                writeln!(text, "v{} v{}\n0 1\n7 8\n", labels[a], labels[b]).unwrap();
            }
        }
        Document::Stars => {
            for (label, node) in labels.iter().zip(0..) {
                write!(text, "{label}").unwrap();
                for &(_, b) in pairs.iter().filter(|&&(a, _)| a == node) {
                    write!(text, " {}", labels[b]).unwrap();
                }
                text += "\n";
            }
        }
        other => unreachable!("no graph is written as {other:?}"),
    }
    text
}

/// Labels of nodes, and pairs of their positions, the smaller one first.
fn graph(names: bool) -> impl Strategy<Value = (Vec<String>, Vec<(usize, usize)>)> {
    let label = if names {
        "[a-zé0-9 &<>'.,;:#=(){}\\[\\]/-]{1,8}".boxed()
    } else {
        (0..40u64)
            .prop_map(|value| (value * value).to_string())
            .boxed()
    };
    let labels = prop::collection::btree_set(label, 2..12);
    (
        labels,
        prop::collection::vec((0..12usize, 0..12usize), 0..30),
    )
        .prop_map(|(labels, ends)| {
            let labels: Vec<String> = labels.into_iter().collect();
            let pairs = ends
                .into_iter()
                .map(|(a, b)| (a % labels.len(), b % labels.len()))
                .filter(|(a, b)| a != b)
                .map(|(a, b)| (a.min(b), a.max(b)))
                .collect();
            (labels, pairs)
        })
}

fn agree(documents: &[Document], labels: &[String], pairs: &[(usize, usize)]) {
    let mut expected = BTreeSet::new();
    for &(a, b) in pairs {
        let mut pair = [labels[a].clone(), labels[b].clone()];
        pair.sort();
        expected.insert(pair);
    }
    for &document in documents {
        let text = written(document, labels, pairs);
        let parsed = found(document, &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let (pairs_read, nodes) = listed(&parsed);
        assert_eq!(pairs_read, expected, "{text}");
        let as_set = |labels: &[String]| labels.iter().cloned().collect::<BTreeSet<_>>();
        assert_eq!(
            (as_set(&nodes), nodes.len()),
            (as_set(labels), labels.len()),
            "{text}"
        );
        let merged = pairs.len() - expected.len();
        let note = crate::merged(merged);
        assert_eq!(
            parsed.notes.iter().any(|n| n.contains("merged")),
            note.is_some()
        );
        assert!(note.is_none_or(|note| parsed.notes.contains(&note)));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn what_is_written_is_read((labels, pairs) in graph(true)) {
        agree(&[Document::GraphMl], &labels, &pairs);
    }

    #[test]
    fn integers_are_written_and_read((labels, pairs) in graph(false)) {
        agree(&ALL, &labels, &pairs);
    }

    /// Changed, cut, and spliced texts are read or refused, and what is read is a graph.
    #[test]
    fn damage_is_no_panic(
        (labels, pairs) in graph(false),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0..4u8), 1..6),
    ) {
        const PIECES: [&[u8]; 34] = [
            b"node [ ", b"graph [ ", b"<nodes>", b"label \"&#x0;\" ",
            b"{", b"}", b"[", b"]", b"\"", b"\\", b"<", b">", b"/", b"--", b"->", b";", b":", b",",
            b"=", b"\n", b" ", b"\0", b"\xff", b"\xc3", b"subgraph ", b"<graph>", b"</graph>",
            b"<node ", b"/*", b"&#0;", b"\"id\": ", b"EDGE_SE2 ", b"-1", b"1e400",
        ];
        for document in ALL.into_iter().chain([Document::RawMatches]) {
            let mut bytes = written(document, &labels, &pairs).into_bytes();
            for (at, piece, kind) in &changes {
                let at = at.index(bytes.len() + 1);
                let piece = PIECES[piece.index(PIECES.len())];
                match kind {
                    0 => drop(bytes.splice(at..at, piece.iter().copied())),
                    1 => bytes.truncate(at),
                    2 => drop(bytes.splice(at..bytes.len().min(at + piece.len()), piece.iter().copied())),
                    _ => {
                        let copied = bytes[at..].to_vec();
                        bytes.extend(copied);
                    }
                }
            }
            if let Ok(Parsed { graph, labels, .. }) = read(document, &bytes[..]) {
                prop_assert!(graph.edges().is_sorted_by(|a, b| a < b));
                for node in 0..graph.nodes() as u32 {
                    let label = labels.label(node);
                    prop_assert!(!label.is_empty() && !label.contains(char::is_control));
                }
            }
        }
    }
}

#[test]
fn names_of_nodes_in_xml() {
    let graphml = |key: &str, first: &str, second: &str| {
        format!(
            "<graphml><key id=\"d0\" for=\"node\" attr.name=\"{key}\" attr.type=\"string\"/>\
             <graph edgedefault=\"undirected\"><node id=\"n0\"><data key=\"d0\">{first}</data></node>\
             <node id=\"n1\"><data key=\"d0\">{second}</data></node>\
             <edge source=\"n0\" target=\"n1\"/></graph></graphml>"
        )
    };
    for key in ["label", "name"] {
        let text = graphml(key, "left &amp; right&#x2e;jpg", "<![CDATA[b<c]]>");
        assert_eq!(pairs(Document::GraphMl, &text), ["b<c left & right.jpg"]);
        let notes = found(Document::GraphMl, &text).unwrap().notes;
        assert_eq!(
            notes,
            [format!(
                "nodes are called by their `{key}`, and not by their ids"
            )]
        );
        let text = graphml(key, "same", "same");
        assert_eq!(pairs(Document::GraphMl, &text), ["n0 n1"]);
        let notes = found(Document::GraphMl, &text).unwrap().notes;
        let why = format!(
            "nodes are called by their ids, and not by their `{key}`: several are called same"
        );
        assert_eq!(notes, [why]);
        // Names that are the ids are not worth a word.
        assert_eq!(
            found(Document::GraphMl, &graphml(key, "n0", "n1"))
                .unwrap()
                .notes,
            [""; 0]
        );
    }
    assert_eq!(
        pairs(Document::GraphMl, &graphml("colour", "red", "blue")),
        ["n0 n1"]
    );
    assert!(
        refusal(Document::GraphMl, &graphml("name", "&x;", "b"))
            .contains("the entity `x` is not known")
    );
}
