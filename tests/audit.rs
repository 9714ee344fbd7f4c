//! `verify audit`, through the binary.

mod common;

use common::{Run, data, verify};
use serde_json::Value;
use std::path::Path;

fn graph_file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn lines(run: &Run) -> Vec<Value> {
    let parse = |line: &str| serde_json::from_str(line).unwrap();
    run.out.lines().map(parse).collect()
}

const SQUARE: &str = "0 1\n1 2\n2 3\n0 3\n";
const COMPLETE: &str = "0 1\n0 2\n0 3\n1 2\n1 3\n2 3\n";

#[test]
fn both_sides_agree_on_small_graphs_by_every_method() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let complete = graph_file(folder.path(), "complete.txt", COMPLETE);
    for method in ["dense", "gram", "sparse"] {
        let run = verify(&[
            "audit", "--json", "--method", method, "--draws", "5", &square, &complete,
        ]);
        assert_eq!(run.code, 0, "{}{}", run.out, run.err);
        let found = lines(&run);
        for (line, verdict, components) in [
            (&found[0], "not-finite-solvable", 4),
            (&found[1], "finite-solvable", 1),
        ] {
            assert_eq!(line["float"]["verdict"], verdict);
            assert_eq!(line["float"]["method"], method);
            assert_eq!(line["float"]["components"], components);
            assert_eq!(line["exact"]["components"], components);
            assert_eq!(line["agree"], true);
            assert_eq!((&line["draws"], &line["misjudged"]), (&5.into(), &0.into()));
        }
        if method != "gram" {
            assert!(found[0]["float"]["margin_decades"].as_f64().unwrap() < -5.0);
        }
        assert!(found[1]["float"]["margin_decades"].as_f64().unwrap() > 0.0);
    }
}

/// A tolerance above everything calls K4 unsolvable, at every draw.
#[test]
fn a_tolerance_that_lies_is_found_out() {
    let folder = tempfile::tempdir().unwrap();
    let complete = graph_file(folder.path(), "complete.txt", COMPLETE);
    let certificate = folder.path().join("c.json");
    let run = verify(&[
        "audit",
        "--tolerance",
        "1e9",
        "--draws",
        "3",
        "--certificate",
        certificate.to_str().unwrap(),
        &complete,
    ]);
    assert_eq!(run.code, 1, "{}", run.out);
    assert!(run.out.contains("DISAGREE"), "{}", run.out);
    assert!(
        run.out.contains("3 of 3 misjudged (100.00 %)"),
        "{}",
        run.out
    );
    assert!(certificate.is_file());
}

#[test]
fn a_sweep_has_both_errors() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let complete = graph_file(folder.path(), "complete.txt", COMPLETE);
    let svg = folder.path().join("sweep.svg");
    let run = verify(&[
        "audit",
        "--sweep-tolerance",
        "--draws",
        "4",
        "--svg",
        svg.to_str().unwrap(),
        &square,
        &complete,
    ]);
    assert_eq!(run.code, 0, "{}", run.err);
    let rows: Vec<Vec<&str>> = run
        .out
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(rows[0][0], "tolerance");
    // The default tolerance first, then 161 of the sweep.
    assert_eq!(rows.len(), 163);
    assert_eq!(
        rows[1],
        ["1e-10", "4", "0", "0.000000", "4", "0", "0.000000"]
    );
    let last = rows.last().unwrap();
    assert_eq!(last[1..], ["4", "0", "0.000000", "4", "4", "1.000000"]);
    assert!(
        std::fs::read_to_string(svg)
            .unwrap()
            .contains("finite solvable (4)")
    );
}

#[test]
fn too_large_for_the_dense_method() {
    let folder = tempfile::tempdir().unwrap();
    let path: String = (0..2000).map(|k| format!("{k} {}\n", k + 1)).collect();
    let path = graph_file(folder.path(), "path.txt", &path);
    let run = verify(&["audit", "--method", "dense", &path]);
    assert_eq!(run.code, 3);
    assert!(run.err.contains("22016 x 24012"), "{}", run.err);
    assert!(run.err.contains("--method sparse"), "{}", run.err);
}

#[test]
fn bad_options() {
    for arguments in [
        &["audit"][..],
        &["audit", "--tolerance", "nan", "x"],
        &["audit", "--tolerance=-1", "x"],
        &["audit", "--draws", "0", "x"],
        &["audit", "--graphs", "x", "y"],
        &["audit", "--claims", "/nonexistent.csv"],
        &["audit", "/nonexistent"],
    ] {
        assert_eq!(verify(arguments).code, 2, "{arguments:?}");
    }
}

#[test]
fn claims_confirmed_refuted_open_and_bad() {
    let folder = tempfile::tempdir().unwrap();
    graph_file(folder.path(), "square.txt", SQUARE);
    let graphs = folder.path().to_str().unwrap();
    let certificates = folder.path().join("certificates");
    std::fs::create_dir(&certificates).unwrap();
    let audit = |table: &str| {
        let table = graph_file(folder.path(), "claims.csv", table);
        verify(&[
            "audit",
            "--claims",
            &table,
            "--graphs",
            graphs,
            "--certificate",
            certificates.to_str().unwrap(),
            "--json",
        ])
    };
    // C~ is K4 in graph6; the square is Cl.
    let run =
        audit("graph,verdict,components,rank\nC~,solvable,1,29\nCl,not-finite-solvable,4,28\n");
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    assert!(lines(&run).iter().all(|line| line["ruling"] == "confirmed"));

    let run = audit("name,verdict,components\nsquare,,1\nsquare,solvable,\n");
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    for line in lines(&run) {
        assert_eq!(line["ruling"], "refuted");
        let certificate = line["certificate"].as_str().unwrap();
        assert!(Path::new(certificate).is_file());
    }

    let run = audit("name,verdict,components,nodes\nsquare,,4,5\n");
    assert_eq!(run.code, 0);
    assert_eq!(lines(&run)[0]["ruling"], "not decidable");

    // Unknown graph, no claim, contradictory claims, not a number: each is said, and the
    // good row is still decided.
    let run = audit(
        "name,verdict,components\nsquare,,4\nnobody,,1\nsquare,,\nsquare,solvable,3\nsquare,,x\n",
    );
    assert_eq!(run.code, 2);
    assert_eq!(lines(&run).len(), 1);
    for (row, word) in [
        (2, "unknown graph nobody"),
        (3, "nothing is claimed"),
        (4, "contradict"),
        (5, "not a number"),
    ] {
        let start = format!("verify: row {row}: ");
        let said = run.err.lines().find(|line| line.starts_with(&start));
        assert!(said.is_some_and(|line| line.contains(word)), "{}", run.err);
    }
}

/// The paper's Table 3: both methods' numbers of components, and the sizes.
#[test]
fn table_3_is_confirmed() {
    let Some(data) = data() else { return };
    let table = data.join("table3.csv");
    let graphs = data.join("table3");
    let run = verify(&[
        "audit",
        "--claims",
        table.to_str().unwrap(),
        "--graphs",
        graphs.to_str().unwrap(),
    ]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    assert!(
        run.out
            .ends_with("29 confirmed, 0 refuted, 0 not decidable, 0 bad rows\n"),
        "{}",
        run.out
    );
}

/// A MATLAB 5 file with two symmetric adjacency matrices of doubles, by the format's
/// description: a header of 128 bytes, then a matrix element (type 14) each, of array flags
/// (class 6, double), dimensions, name and values.
fn two_matrices(folder: &Path) -> String {
    fn element(kind: u32, data: &[u8]) -> Vec<u8> {
        let mut bytes = [kind.to_le_bytes(), (data.len() as u32).to_le_bytes()].concat();
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        bytes
    }
    let matrix = |name: &str, pairs: &[(usize, usize)]| {
        let mut values = [0.0f64; 16];
        for &(i, j) in pairs {
            (values[4 * i + j], values[4 * j + i]) = (1.0, 1.0);
        }
        let parts = [
            element(6, &[6u32, 0].map(u32::to_le_bytes).concat()),
            element(5, &[4u32, 4].map(u32::to_le_bytes).concat()),
            element(1, name.as_bytes()),
            element(9, &values.map(f64::to_le_bytes).concat()),
        ];
        element(14, &parts.concat())
    };
    let mut file = b"MATLAB 5.0 MAT-file".to_vec();
    file.resize(124, b' ');
    file.extend([0, 1, b'I', b'M']);
    file.extend(matrix("square", &[(0, 1), (1, 2), (2, 3), (0, 3)]));
    let all = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    file.extend(matrix("complete", &all));
    let path = folder.join("two.mat");
    std::fs::write(&path, file).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The variable and the format are taken as by the verifier itself, by every command that
/// reads graphs.
#[test]
fn the_variable_and_the_format_can_be_said() {
    let folder = tempfile::tempdir().unwrap();
    let two = two_matrices(folder.path());
    for command in ["audit", "compare", "conditions"] {
        // Which of the two is meant has to be said.
        let run = verify(&[command, &two]);
        assert_eq!(run.code, 2, "{}", run.out);
        for (variable, pairs) in [("square", 4), ("complete", 6)] {
            let run = verify(&[
                command,
                "--json",
                "--variable",
                variable,
                "--format",
                "matlab",
                &two,
            ]);
            let json = &run.json()[0];
            let graph = if command == "compare" {
                &json["graph"]
            } else {
                json
            };
            assert_eq!(graph["edges"], pairs, "{command}: {}{}", run.out, run.err);
        }
        assert_eq!(verify(&[command, "--variable", "none", &two]).code, 2);
        let run = verify(&[command, "--format", "graph6", &two]);
        assert_eq!(run.code, 2, "{command}: {}", run.out);
        assert_eq!(verify(&[command, "--format", "picture", &two]).code, 2);
    }
    // The sweep reads graphs, too: two draws of the square, which is not solvable.
    let sweep = [
        "audit",
        "--sweep-tolerance",
        "--draws",
        "2",
        "--variable",
        "square",
        &two,
    ];
    let run = verify(&sweep);
    assert_eq!(run.code, 0, "{}", run.err);
    assert_eq!(
        run.out.lines().nth(1),
        Some("1e-10,2,0,0.000000,0,0,0.000000")
    );
    // Claims say themselves what their graphs are.
    let run = verify(&["audit", "--claims", "x.csv", "--format", "graph6"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("cannot be used with"), "{}", run.err);
}
