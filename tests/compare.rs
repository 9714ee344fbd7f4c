//! `verify compare`, through the binary; and all formulations on all candidates of the
//! paper's Table 1.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use viewcert::exact::prime::PrimeField;
use viewcert::formulation::compare;
use viewcert::graph::graph6;

fn verify(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .output()
        .unwrap()
}

fn graph_file(folder: &Path, name: &str, pairs: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, pairs).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The 4-cycle has rank 28 of 29: one dimension of motions beyond the trivial.
const SQUARE: &str = "0 1\n1 2\n2 3\n0 3\n";

#[test]
fn a_table_and_json_in_both_fields() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    for field in [
        &["--prime", "4611686018427387847"][..],
        &["--rational"],
        &[],
    ] {
        let done = verify(&[&["compare", &square], field].concat());
        let text = String::from_utf8(done.stdout).unwrap();
        assert_eq!(done.status.code(), Some(0), "{text}");
        assert!(
            text.contains("all agree: at these cameras 1 dimensions"),
            "{text}"
        );
        // 10m + n + 15 = 59 rows, 12n = 48 columns.
        assert!(text.contains("59 x 48"), "{text}");

        let done = verify(&[&["compare", "--json", &square], field].concat());
        let json: Value = serde_json::from_slice(&done.stdout).unwrap();
        assert_eq!(json["agree"], true);
        assert_eq!(json["excess"], 1);
        assert_eq!(json["kernel_is_f"], 4);
        assert_eq!(json["implicit_identity"], 4);
        let ranks: Vec<u64> = json["formulations"]
            .as_array()
            .unwrap()
            .iter()
            .map(|line| line["rank"].as_u64().unwrap())
            .collect();
        // One less than 16m, 16m, 11n - 15, 11n - 15, 12n and 11n - 15 + m.
        assert_eq!(ranks, [63, 63, 28, 28, 47, 32]);
    }
}

#[test]
fn a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let svg = folder.path().join("sizes.svg");
    let done = verify(&["compare", &square, "--svg", svg.to_str().unwrap()]);
    assert_eq!(done.status.code(), Some(0));
    let svg = std::fs::read_to_string(svg).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains(">edge-based, full</text>"));
}

#[test]
fn bad_input_is_said_and_the_rest_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let done = verify(&["compare", "/nonexistent", &square]);
    assert_eq!(done.status.code(), Some(2));
    assert!(
        String::from_utf8(done.stdout)
            .unwrap()
            .contains("all agree")
    );
    assert!(
        String::from_utf8(done.stderr)
            .unwrap()
            .starts_with("verify: ")
    );
    let done = verify(&["compare", "--prime", "91", &square]);
    assert_eq!(done.status.code(), Some(2));
    // 400 cameras in a row: too large for fraction-free elimination.
    let path: String = (0..400).map(|k| format!("{k} {}\n", k + 1)).collect();
    let path = graph_file(folder.path(), "path.txt", &path);
    let done = verify(&["compare", "--rational", &path]);
    assert_eq!(done.status.code(), Some(2));
    assert!(
        String::from_utf8(done.stderr)
            .unwrap()
            .contains("too large")
    );
}

/// The candidates with `nodes` nodes, from nauty's generator; `None` without it.
fn candidates(nodes: usize) -> Option<Vec<viewcert::graph::Graph>> {
    let edges = (11 * nodes - 15).div_ceil(7);
    let range = format!("{edges}:{edges}");
    let found = ["nauty-geng", "geng"].iter().find_map(|program| {
        Command::new(program)
            .args(["-Cq", &nodes.to_string(), &range])
            .output()
            .ok()
    });
    let Some(found) = found else {
        eprintln!("SKIPPED: neither nauty-geng nor geng is installed");
        return None;
    };
    let lines = found.stdout.split(|&b| b == b'\n');
    Some(
        lines
            .filter(|line| !line.is_empty())
            .map(|line| graph6::decode(line).unwrap())
            .collect(),
    )
}

/// All formulations agree on every candidate of Table 1 up to 9 nodes modulo a prime, and
/// as many as published have full rank.
#[test]
fn table_1_modulo_a_prime() {
    let field = PrimeField::mersenne61();
    let table = [
        (3, 1, 1),
        (4, 1, 1),
        (5, 2, 1),
        (6, 9, 4),
        (7, 20, 3),
        (8, 161, 36),
        (9, 433, 27),
    ];
    for (nodes, count, solvable) in table {
        let Some(graphs) = candidates(nodes) else {
            return;
        };
        assert_eq!(graphs.len(), count);
        let mut full = 0;
        for graph in &graphs {
            let found = compare::modular(&field, graph, 1).unwrap();
            assert!(found.agrees(graph), "{}: {found:?}", graph6::encode(graph));
            full += usize::from(found.excess() == Some(0));
        }
        assert_eq!(full, solvable, "{nodes} nodes");
    }
}

/// The same over the rationals, up to 6 nodes: fraction-free elimination of the large
/// matrices of the edge-based formulations grows fast.
#[test]
fn table_1_over_the_rationals() {
    for (nodes, solvable) in [(3, 1), (4, 1), (5, 1), (6, 4)] {
        let Some(graphs) = candidates(nodes) else {
            return;
        };
        let mut full = 0;
        for graph in &graphs {
            let found = compare::rational(graph, (9, 4), 1).unwrap();
            assert!(found.agrees(graph), "{}: {found:?}", graph6::encode(graph));
            assert!(found.lines.iter().all(|line| line.rank.is_some()));
            full += usize::from(found.excess() == Some(0));
        }
        assert_eq!(full, solvable, "{nodes} nodes");
    }
}
