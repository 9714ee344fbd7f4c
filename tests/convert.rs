//! `verify convert`: what it writes is what both checkers read, and the graph that was read.

use crate::common::{Run, first_checker, second_checker, verify, verify_with};
use std::path::Path;
use viewcert::graph::sha256;
use viewcert_check::Graph;
use viewcert_formats::{ReadOptions, read_graphs};

fn refused(run: &Run, why: &str) {
    assert_eq!((run.code, &*run.out), (2, ""), "{}", run.err);
    assert!(run.err.contains(why), "{}", run.err);
}

/// Every sample of other programs that is read is converted, by the names that it has.
#[test]
fn samples_of_other_programs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/foreign");
    let mut converted = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let mut graphs = read_graphs(&path, &ReadOptions::default());
        let Some(Ok(input)) = graphs.next() else {
            continue;
        };
        if graphs.next().is_some() {
            continue;
        }
        let name = path.to_str().unwrap();
        for to in ["pairs", "graph6"] {
            let run = verify(&["convert", "--to", to, name]);
            assert_eq!(run.code, 0, "{name}: {}", run.err);
            let read = Graph::read(run.out.as_bytes(), || None).unwrap();
            assert_eq!(read.sha256(), sha256(&input.graph), "{name}");
            // Whatever was merged, guessed or ignored is said.
            for note in &input.notes {
                assert!(run.err.contains(note), "{name}: {note}");
            }
        }
        converted += 1;
    }
    assert!(converted >= 40, "{converted}");
}

#[test]
fn names_are_comments_and_nodes_without_pairs_lines() {
    let run = verify_with(
        b"c a\n\"b \xc3\xa9\" a\n\"d\"\n",
        &["convert", "--format", "edges", "-"],
    );
    assert_eq!(
        run.out,
        "# viewcert pairs\n# 0 a\n# 1 b \u{e9}\n# 2 c\n# 3 d\n0 1\n0 2\n3\n"
    );
    // Numbers are names unless they are those of the nodes.
    assert_eq!(
        verify_with(b"5 7\n7 9\n", &["convert", "-"]).out,
        "# viewcert pairs\n# 0 5\n# 1 7\n# 2 9\n0 1\n1 2\n"
    );
    assert_eq!(
        verify_with(b"1 2\n0 1\n", &["convert", "-"]).out,
        "# viewcert pairs\n0 1\n1 2\n"
    );
    assert_eq!(
        verify_with(b"1 2\n0 1\n", &["convert", "-", "--to", "graph6"]).out,
        "Bg\n"
    );
}

/// The whole way: a graph with names is certified, and whoever has no program but a checker sees
/// that the certificate is about this graph.
#[test]
#[ignore = "needs python3"]
fn from_a_graph_with_names_to_both_checkers() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (certificate, pairs, line) = (at("house.json"), at("house.pairs"), at("house.g6"));
    let house = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/house.txt");
    let house = house.to_str().unwrap();
    assert_eq!(verify(&[house, "--certificate", &certificate]).code, 1);
    for (to, file) in [("pairs", &pairs), ("graph6", &line)] {
        let run = verify(&["convert", house, "--to", to, "--output", file]);
        assert_eq!((run.code, &*run.out), (0, ""), "{}", run.err);
    }
    for checker in [first_checker, second_checker] {
        assert_eq!(checker(&[&certificate, &pairs]).code, 0);
        assert_eq!(checker(&[&certificate, &line]).code, 0);
        assert_eq!(checker(&[&certificate, house]).code, 2);
    }
    // What was converted is a graph for the program as well.
    assert_eq!(verify(&["check", &certificate, &pairs]).code, 0);
    assert_eq!(verify(&["check", &certificate, house]).code, 0);
}

/// What is written is read again as the same graph, also where nothing else says that these are pairs: single
/// nodes, lines that look like a table or like counts.
#[test]
fn what_is_written_is_read() {
    for graph in ["@", "D??", "C`", "DQ?", "E?~o", "Bw", "FCOf?"] {
        let written = verify_with(graph.as_bytes(), &["convert", "-"]).out;
        let again = verify_with(written.as_bytes(), &["convert", "-", "--to", "graph6"]);
        assert_eq!(
            (again.code, &*again.out),
            (0, &*format!("{graph}\n")),
            "{written}{}",
            again.err
        );
    }
}

#[test]
fn what_cannot_be_converted() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (two, graph, out) = (at("two.g6"), at("graph.txt"), at("out.txt"));
    std::fs::write(&two, "Bw\nC~\n").unwrap();
    std::fs::write(&graph, "a b\nb c\n").unwrap();
    refused(
        &verify(&["convert", &two]),
        "--to graph6 writes a line for each",
    );
    assert_eq!(verify(&["convert", &two, "--to", "graph6"]).out, "Bw\nC~\n");
    refused(
        &verify(&["convert", &graph, "-o", &graph]),
        "this is the input",
    );
    refused(&verify(&["convert", &at("none.txt")]), "none.txt");
    refused(
        &verify_with(b"Bw\nxx\n", &["convert", "-", "--to", "graph6"]),
        "",
    );
    assert!(!Path::new(&out).exists());
    let parts = at("parts.txt");
    std::fs::write(&parts, "part c a\n").unwrap();
    assert_eq!(
        verify(&["convert", &graph, "--given", &parts]).out,
        "part 0 2\n"
    );
    let graph6 = ["convert", &graph, "--given", &parts, "--to", "graph6"];
    refused(&verify(&graph6), "graph6 holds nothing that is given");
    std::fs::write(&parts, "part c\n").unwrap();
    refused(
        &verify(&["convert", &graph, "--given", &parts]),
        "no part has two cameras",
    );
    // A long path is no short graph6 line.
    let path: String = (0..200_000).map(|k| format!("{k} {}\n", k + 1)).collect();
    let run = verify_with(path.as_bytes(), &["convert", "-", "--to", "graph6"]);
    assert_eq!((run.code, &*run.out), (3, ""), "{}", run.err);
    let written = verify_with(path.as_bytes(), &["convert", "-"]).out;
    assert_eq!(written, format!("# viewcert pairs\n{path}"));
}

/// Nodes without pairs are written and read.
#[test]
fn nodes_without_pairs_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x");
    let path = path.to_str().unwrap();
    for line in ["D??", "D?_", "C?", "E???", "DFw"] {
        let converted = verify_with(
            format!("{line}\n").as_bytes(),
            &["convert", "-", "-o", path],
        );
        assert_eq!(converted.code, 0, "{}", converted.err);
        let hash = |run: &Run| run.json()[0]["graph"]["sha256"].clone();
        let read = verify(&[path, "--json"]);
        assert_eq!(
            hash(&read),
            hash(&verify_with(line.as_bytes(), &["-", "--json"])),
            "{line}"
        );
        assert_eq!(
            verify(&["convert", "--to", "graph6", path]).out,
            format!("{line}\n")
        );
    }
}
