use std::collections::BTreeSet;
use std::fmt::Write;

use proptest::prelude::*;

use super::*;
use crate::read_as::Parsed;

fn found(document: Document, text: &str) -> Result<Parsed, String> {
    read(document, text.as_bytes(), true).map_err(|fault| fault.in_file("in").to_string())
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
fn dot_joins_what_graphviz_joins() {
    for (text, expected) in [
        ("graph{a--b--c}", &["a b", "b c"][..]),
        ("GRAPH x {a;b a--b}", &["a b"]),
        ("graph{{a b}--c}", &["a c", "b c"]),
        ("graph{{a b}--{c d}}", &["a c", "a d", "b c", "b d"]),
        ("graph{a--{b--c}}", &["a b", "a c", "b c"]),
        ("graph{{a {b}}--c}", &["a c", "b c"]),
        // A subgraph of the same name is the same, with the nodes of before.
        ("graph{subgraph s{a} subgraph s{b}--c}", &["a c", "b c"]),
        // Within another graph it is another one.
        ("graph{{subgraph s{a}} subgraph s{b}--c}", &["b c"]),
        (
            "graph{a--b--{c d}--e}",
            &["a b", "b c", "b d", "c e", "d e"],
        ),
        ("digraph{a->b;b->a}", &["a b"]),
        ("graph{a:p--b:q:n}", &["a b"]),
        ("graph{a--b[x=1,y=\"]\";z=<<b>>>][w]--c}", &[]),
    ] {
        if expected.is_empty() {
            assert!(found(Document::Dot, text).is_err(), "{text}");
        } else {
            assert_eq!(pairs(Document::Dot, text), expected, "{text}");
        }
    }
    let text = "graph{a--b[x=1,y=\"]\" z=<<b>>;][w]c--\"subgraph\"}";
    assert_eq!(pairs(Document::Dot, text), ["a b", "c subgraph"]);
    // Numbers are words, quoted or not; escapes are those of Graphviz.
    let text = r#"graph { 1 -- "1.0" -- -.5 -- "\"\\n" -- "a\
b" }"#;
    let expected = ["\"\\\\n -.5", "\"\\\\n ab", "-.5 1.0", "1 1.0"];
    assert_eq!(pairs(Document::Dot, text), expected);
}

#[test]
fn dot_has_limits() {
    let deep = format!("graph {}{}", "{".repeat(50_000), "}".repeat(50_000));
    assert!(refusal(Document::Dot, &deep).contains("more than 100 deep"));
    let fine = format!("graph {{{}a--b{}}}", "{".repeat(100), "}".repeat(100));
    assert_eq!(pairs(Document::Dot, &fine), ["a b"]);
    // A hundred thousand names are not to become 10^10 pairs.
    let names = |letter: char| {
        (0..100_000).fold(String::new(), |mut text, k| {
            write!(text, "{letter}{k} ").unwrap();
            text
        })
    };
    let wide = format!("graph {{ {{{}}} -- {{{}}} }}", names('a'), names('b'));
    let error = read(Document::Dot, wide.as_bytes(), true).unwrap_err();
    assert!(matches!(error.problem, Problem::TooManyJoined { .. }) && error.problem.is_size());
    // Nor is a set to be looked at without end.
    let again = format!(
        "graph {{ subgraph s {{{}}} {} }}",
        names('a'),
        "subgraph s{}--{} ".repeat(2000)
    );
    assert!(refusal(Document::Dot, &again).contains("joined subgraphs"));
}

#[test]
fn dot_is_refused_with_the_line() {
    for (text, phrase) in [
        (
            "graph {\n a -- a\n\n}",
            "in:2: camera a is paired with itself",
        ),
        (
            "graph {\n\n -- b }",
            "in:3: DOT: `--` stands here, and not a node, an edge or `}`",
        ),
        ("graph {\n a -- \"b }", "in:2: DOT: a quote is not closed"),
        ("graph {\n a /* }", "in:2: DOT: a comment is not closed"),
        ("graph {\n a [x=<b }", "in:2: DOT: a `<` is not closed"),
        (
            "graph { a [x=1 }",
            "in:1: DOT: `}` stands here, and not an attribute or `]`",
        ),
        (
            "graph { a -- node }",
            "the keyword `node` does not belong here",
        ),
        (
            "graph { edge -- b }",
            "`--` stands here, and not attributes behind the keyword",
        ),
        (
            "graph { a -- b\n",
            "the text ends, and a node, an edge or `}` is missing",
        ),
        ("graph { \"a\" + b }", "a `+` joins texts in quotes"),
        ("graph { \"\" -- b }", "a camera has an empty name"),
        (
            "graph { \"a\nb\" -- b }",
            "the name \"a\\nb\" has a control character",
        ),
        ("graph { a.b -- c }", "in:1: DOT: two words stand here"),
        ("graph { a-1 -- c }", "in:1: DOT: two words stand here"),
        ("graph { a ! b }", "`!` does not belong here"),
        ("graph { }", "the graph is empty"),
        (
            "{ a -- b }",
            "`{` stands here, and not `graph` or `digraph`",
        ),
    ] {
        let error = refusal(Document::Dot, text);
        assert!(error.contains(phrase), "{text}: {error}");
    }
}

#[test]
fn formats_are_recognised_by_their_content() {
    let of = |text: &str| Document::of(text.as_bytes(), true);
    for (text, expected) in [
        (
            "\n// c\n/* d */ Strict DiGraph \"g\" {",
            Some(Document::Dot),
        ),
        ("graph{", Some(Document::Dot)),
        // GML, and names that begin alike.
        ("graph [\n directed 0\n]", Some(Document::Gml)),
        ("graph a\na b\n", None),
        ("graphs {", None),
        ("# c\n\n VERTEX_SE2 0", Some(Document::G2o)),
        ("vertex_1.jpg vertex_2.jpg", None),
        (
            "<?xml version='1.0'?>\n<!-- graphml -->\n<graphml >",
            Some(Document::GraphMl),
        ),
        ("<g:graphml xmlns:g='x'>", Some(Document::GraphMl)),
        ("<html><body>the graphml format</body></html>", None),
        ("<gexf>", Some(Document::Gexf)),
        ("{\n \"nodes\"", Some(Document::NodeLink)),
        ("[[0, 1]]", None),
        ("{0, 1}", None),
        ("0 1 2 3\n1 2\n2\n", Some(Document::Stars)),
        ("0 1\n1 2 3 4\n", Some(Document::Stars)),
        // Even lines are edge lists or doubtful; what goes down is no list of nodes.
        ("0 1\n1 2\n", None),
        ("0 1 2\n1 2 3\n", None),
        ("0 3 1 2\n1\n2 3\n", Some(Document::Stars)),
        // Some pairs may have weights.
        ("0 2 5\n1 2\n", None),
        ("0 2 2\n1 2\n", None),
        ("1 2\n0 1 2\n", None),
        ("0 1\n0 2 3\n", None),
        // METIS: 3 nodes, 2 edges.
        ("2 3\n3 4 5\n6\n", None),
        // Matches of features.
        ("0 1\n1\n2 3\n", None),
        ("0 a b\n1 2\n", None),
    ] {
        assert_eq!(of(text), expected, "{text}");
    }
}

#[test]
fn stars_are_pairs_with_the_first() {
    let text = "0 1 2 3 # c\n1 2\n3\n";
    let parsed = read(Document::Stars, text.as_bytes(), false).unwrap();
    let (pairs, nodes) = listed(&parsed);
    assert_eq!(pairs.len(), 4);
    assert_eq!(nodes, ["0", "1", "2", "3"]);
    let text = "b a \"c d\"\nc b\n";
    assert_eq!(self::pairs(Document::Stars, text), ["a b", "b c", "b c d"]);
    // What the first lines promise must hold to the end, if nobody asked.
    let unlike = |text: &str| read(Document::Stars, text.as_bytes(), false).unwrap_err();
    let fault = unlike("0 1 2\n1 2\n2 x\n");
    assert_eq!(fault.place, Place::Input);
    assert!(matches!(
        unlike("0 1 2\n1 2 3\n").problem,
        Problem::Doubtful { .. }
    ));
    assert!(refusal(Document::Stars, "0 1 0\n").contains("in:1: camera 0 is paired with itself"));
}

#[test]
fn ids_in_json_are_those_of_the_nodes() {
    let text = |nodes: &str, edges: &str| format!("{{\"nodes\": [{nodes}], \"edges\": [{edges}]}}");
    let graph = |nodes: &[&str], edges: &[[&str; 2]]| {
        let nodes: Vec<String> = nodes.iter().map(|id| format!("{{\"id\": {id}}}")).collect();
        let edges: Vec<String> = edges
            .iter()
            .map(|[a, b]| format!("{{\"x\": [1, {{}}], \"source\": {a}, \"target\": {b}}}"))
            .collect();
        found(
            Document::NodeLink,
            &text(&nodes.join(","), &edges.join(",")),
        )
    };
    let labels = |parsed: Result<Parsed, String>| listed(&parsed.unwrap()).0;
    let pair = |a: &str, b: &str| BTreeSet::from([[a.to_owned(), b.to_owned()]]);
    // Ids and not positions, if they can be both.
    assert_eq!(
        labels(graph(&["2", "0", "1"], &[["0", "1"]])),
        pair("0", "1")
    );
    // Positions, if ids are strings: even strings of digits.
    assert_eq!(
        labels(graph(&["\"1\"", "\"0\""], &[["0", "1"]])),
        pair("0", "1")
    );
    assert_eq!(
        labels(graph(&["\"b\"", "\"c\"", "\"a\""], &[["2", "0"]])),
        pair("a", "b")
    );
    assert_eq!(
        labels(graph(
            &["-3", "18446744073709551615"],
            &[["-3", "18446744073709551615"]]
        )),
        pair("-3", "18446744073709551615")
    );
    assert_eq!(
        labels(graph(&["\"\\u00e9\"", "1"], &[["1", "\"é\""]])),
        pair("1", "é")
    );
    for (nodes, edge, phrase) in [
        (
            &["\"a\"", "\"b\""][..],
            ["0", "2"],
            "in: edge 1 of the list: node-link JSON: 2 is the id of no node",
        ),
        (&["\"a\"", "\"b\""], ["0", "-1"], "-1 is the id of no node"),
        (
            &["\"a\"", "\"b\""],
            ["0", "\"b\""],
            "0 is the id of no node",
        ),
        (&["0", "1"], ["0", "\"1\""], "\"1\" is the id of no node"),
        (
            &["0", "true"],
            ["0", "1"],
            "expected an id, which is a string or an integer",
        ),
        (&["0", "99999999999999999999"], ["0", "1"], "expected an id"),
        (&["0", "[1, 2]"], ["0", "1"], "expected an id"),
        (
            &["0", "\"\""],
            ["0", "1"],
            "in: node 2 of the list: a camera has an empty name",
        ),
        (&["0", "1, \"id\": 2"], ["0", "1"], "`id` is there twice"),
    ] {
        let error = graph(nodes, &[edge]).unwrap_err();
        assert!(error.contains(phrase), "{error}");
    }
    for (text, phrase) in [
        (
            "{\"nodes\": [], \"nodes\": [], \"links\": []}",
            "`nodes` is there twice",
        ),
        (
            "{\"nodes\": {}, \"links\": []}",
            "expected a list of objects",
        ),
        (
            "{\"nodes\": [1], \"links\": []}",
            "expected an object with id",
        ),
        (
            "{\"nodes\": [], \"links\": [[0, 1]]}",
            "expected an object with source and target",
        ),
        ("{\"nodes\": [], \"links\": []} {}", "trailing characters"),
        ("{\"nodes\": [], \"links\": []}", "the graph is empty"),
        ("{\"nodes\": []}", "there is no list `edges` or `links`"),
        ("{\"graph\": {\"nodes\": {}}}", "a JSON graph"),
        ("{\"elements\": {}}", "Cytoscape"),
        ("[]", "expected an object with lists"),
        ("", "in:1: node-link JSON: EOF"),
    ] {
        let error = refusal(Document::NodeLink, text);
        assert!(error.contains(phrase), "{text}: {error}");
    }
    let parsed = found(
        Document::NodeLink,
        "{\"nodes\":[{\"id\":1},{\"id\":1,\"a\":0}],\"links\":[]}",
    );
    let notes = parsed.unwrap().notes;
    assert_eq!(
        notes,
        [
            "attributes are ignored: a",
            "1 node is listed again, and merged"
        ]
    );
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
        let fault = read(Document::Dot, bytes, true).unwrap_err();
        assert!(fault.in_file("in").to_string().starts_with(phrase));
    }
}

const ALL: [Document; 7] = [
    Document::Dot,
    Document::G2o,
    Document::Gexf,
    Document::Gml,
    Document::GraphMl,
    Document::NodeLink,
    Document::Stars,
];

/// A graph as a text of a format. Integer labels only for those that have no others.
fn written(document: Document, labels: &[String], pairs: &[(usize, usize)]) -> String {
    let quoted = |text: &str| format!("{text:?}");
    let json = |text: &str| serde_json::to_string(text).unwrap();
    let xml = |text: &str| {
        let escaped = text.replace('&', "&amp;").replace('<', "&lt;");
        format!(
            "\"{}\"",
            escaped.replace('"', "&quot;").replace('\'', "&apos;")
        )
    };
    let mut text = String::new();
    match document {
        Document::Dot => {
            text += "graph {\n";
            for label in labels {
                writeln!(text, "  {}", quoted(label)).unwrap();
            }
            for &(a, b) in pairs {
                writeln!(text, "  {} -- {};", quoted(&labels[a]), quoted(&labels[b])).unwrap();
            }
            text += "}\n";
        }
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
        // Nodes have numbers as ids, and their names are attributes.
        Document::Gexf => {
            text += "<gexf><graph defaultedgetype=\"undirected\"><nodes>\n";
            for (label, id) in labels.iter().zip(7..) {
                writeln!(text, "<node id=\"{id}\" label={}/>", xml(label)).unwrap();
            }
            text += "</nodes><edges>\n";
            for &(a, b) in pairs {
                let (a, b) = (a + 7, b + 7);
                writeln!(text, "<edge source=\"{a}\" target=\"{b}\"/>").unwrap();
            }
            text += "</edges></graph></gexf>\n";
        }
        Document::Gml => {
            text += "Creator \"nobody\"\ngraph [\n";
            for (label, id) in labels.iter().zip(7..) {
                let label = xml(label).replace('\u{e9}', "&#233;");
                writeln!(text, "node [\n id {id}\n label {label}\n]").unwrap();
            }
            for &(a, b) in pairs {
                let (a, b) = (a + 7, b + 7);
                writeln!(text, "edge [\n source {a}\n target {b}\n]").unwrap();
            }
            text += "]\n";
        }
        Document::NodeLink => {
            let nodes: Vec<String> = labels
                .iter()
                .map(|label| format!("{{\"id\": {}}}", json(label)))
                .collect();
            let edges: Vec<String> = pairs
                .iter()
                .map(|&(a, b)| {
                    let (a, b) = (json(&labels[a]), json(&labels[b]));
                    format!("{{\"source\": {a}, \"target\": {b}}}")
                })
                .collect();
            write!(
                text,
                "{{\"nodes\": [{}],\n\"links\": [{}]}}",
                nodes.join(", "),
                edges.join(",\n")
            )
            .unwrap();
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
        Document::RawMatches => {
            for &(a, b) in pairs {
                writeln!(text, "v{} v{}\n0 1\n7 8\n", labels[a], labels[b]).unwrap();
            }
        }
        Document::TextMatrix => {
            let pair = |a, b| pairs.contains(&(a, b)) || pairs.contains(&(b, a));
            for a in 0..labels.len() {
                let row = (0..labels.len()).map(|b| u8::from(pair(a, b)).to_string());
                writeln!(text, "{}", row.collect::<Vec<_>>().join(" ")).unwrap();
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
    }
    text
}

/// Labels of nodes, and pairs of their positions, the smaller one first.
fn graph(names: bool) -> impl Strategy<Value = (Vec<String>, Vec<(usize, usize)>)> {
    let label = if names {
        // Nothing that a quoted text of Rust writes in another way than DOT reads it.
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
        let named = [Document::Dot, Document::Gexf, Document::Gml, Document::GraphMl, Document::NodeLink];
        agree(&named, &labels, &pairs);
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
        for document in ALL.into_iter().chain([Document::RawMatches, Document::TextMatrix]) {
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
            for asked in [true, false] {
                if let Ok(Parsed { graph, labels, .. }) = read(document, &bytes[..], asked) {
                    prop_assert!(graph.edges().is_sorted_by(|a, b| a < b));
                    for node in 0..graph.nodes() as u32 {
                        let label = labels.label(node);
                        prop_assert!(!label.is_empty() && !label.contains(char::is_control));
                    }
                }
            }
        }
    }
}

#[test]
fn gml_of_networkx_igraph_and_gephi() {
    let networkx = "graph [\n  directed 1\n  multigraph 1\n  node [\n    id 0\n    label \"a&amp;b &#233;.jpg\"\n  ]\n  \
                    node [\n    id 1\n    label \"7\"\n  ]\n  edge [\n    source 0\n    target 1\n    key 0\n    weight 2.5\n  ]\n]\n";
    let parsed = found(Document::Gml, networkx).unwrap();
    assert_eq!(pairs(Document::Gml, networkx), ["7 a&b é.jpg"]);
    assert_eq!(
        parsed.notes,
        [
            "nodes are called by their `label`, and not by their ids",
            "the graph is directed, and directions are ignored",
            "attributes are ignored: key, weight",
        ]
    );
    let igraph = "Creator \"igraph version 0.10\"\nVersion 1\ngraph\n[\n  directed 0\n  node\n  [\n    id 0\n    name \"x\"\n  ]\n  \
                  node\n  [\n    id 1\n    name \"y\"\n  ]\n  edge\n  [\n    source 1\n    target 0\n  ]\n]\n";
    assert_eq!(pairs(Document::Gml, igraph), ["x y"]);
    let gephi = "Creator Gephi\ngraph\n[\n  node\n  [\n    id 3\n    label \"\"\n    graphics\n    [\n      x -1.5E+2\n      fill \"#c0\"\n    ]\n  ]\n  \
                 node\n  [\n    id 4\n    label \"\"\n  ]\n  edge [ source 3 target 4 ]\n]\n";
    assert_eq!(pairs(Document::Gml, gephi), ["3 4"]);
    let notes = found(Document::Gml, gephi).unwrap().notes;
    assert!(
        notes[0]
            .starts_with("nodes are called by their ids, and not by their `label`: some are empty"),
        "{notes:?}"
    );
    for text in [networkx, igraph, gephi] {
        assert_eq!(Document::of(text.as_bytes(), true), Some(Document::Gml));
    }
    for text in [
        "graph {a--b}",
        "graph a\nb c\n",
        "creator x\ny z\n",
        "graph",
    ] {
        assert_ne!(Document::of(text.as_bytes(), true), Some(Document::Gml));
    }
}

#[test]
fn gml_is_refused_with_its_line() {
    for (text, phrase) in [
        (
            "graph [\n node [ label \"a\" ]\n]",
            "in:2: GML: this node has no `id`",
        ),
        (
            "graph [\n edge [ source 1 ]\n]",
            "in:2: GML: this edge has no `target`",
        ),
        (
            "graph [ edge [ source 1 target 1 ] ]",
            "in:1: camera 1 is paired with itself",
        ),
        ("graph [ node [ id 1 id 2 ] ]", "`id` is there twice"),
        ("graph [ node [ id 1 ]", "the file is truncated"),
        ("graph [ node [ id \"1 ] ]", "a quote (\") is not closed"),
        ("graph [ node [ id ] ]", "`id` has no value"),
        ("graph [ 1 2 ]", "here should be a key"),
        ("graph [ ] graph [ ]", "a second graph"),
        ("graph [ ]", "the graph is empty"),
        ("version 1", "there is no graph"),
        ("graph [ node ( ]", "`(` belongs to no key"),
    ] {
        let error = refusal(Document::Gml, text);
        assert!(error.contains(phrase), "{text}: {error}");
    }
    let deep = format!("graph [ x {} {} ]", "[ y ".repeat(1000), "]".repeat(1000));
    assert!(refusal(Document::Gml, &deep).contains("more than 100 deep"));
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
    let gexf = "<?xml version=\"1.0\"?><gexf version=\"1.2\"><meta><creator>Gephi</creator></meta>\
                <graph defaultedgetype=\"undirected\" mode=\"static\"><attributes class=\"node\"/>\
                <nodes count=\"3\"><node id=\"0\" label=\"a b\"><attvalues/></node><node id=\"1\" label=\"c\"/>\
                <node id=\"2\" label=\"d\"/></nodes><edges><edge id=\"0\" source=\"0\" target=\"1\" weight=\"2\"/>\
                <edge id=\"1\" source=\"2\" target=\"1\" type=\"directed\"/></edges></graph></gexf>";
    assert_eq!(Document::of(gexf.as_bytes(), true), Some(Document::Gexf));
    assert_eq!(pairs(Document::Gexf, gexf), ["a b c", "c d"]);
    assert_eq!(
        found(Document::Gexf, gexf).unwrap().notes,
        [
            "nodes are called by their `label`, and not by their ids",
            "the graph is directed, and directions are ignored",
            "attributes are ignored: attvalues, weight",
        ]
    );
    let nested = gexf.replace("<attvalues/>", "<nodes><node id=\"9\"/></nodes>");
    assert!(refusal(Document::Gexf, &nested).contains("graphs within nodes are not read"));
    assert!(
        refusal(Document::Gexf, &graphml("name", "a", "b")).contains("the root is not one `gexf`")
    );
}
