//! `viewcert-lab tolerances` and `viewcert-lab published`, through the program.

use crate::common::{root, run};
use std::path::Path;

const SQUARE: &str = "0 1\n1 2\n2 3\n0 3\n";
const COMPLETE: &str = "0 1\n0 2\n0 3\n1 2\n1 3\n2 3\n";

fn graph_file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn a_sweep_has_both_errors() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    let complete = graph_file(folder.path(), "complete.txt", COMPLETE);
    let svg = folder.path().join("sweep.svg");
    let run = run(
        "viewcert-lab",
        &[
            "tolerances",
            "--draws",
            "4",
            "--svg",
            svg.to_str().unwrap(),
            &square,
            &complete,
        ],
    );
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

/// Psi of docs/theory.md, Example 6.2: the published method merges what is not one component, and how many it finds
/// depends on the pair it begins at. A triangle with a tail has two components wherever one begins.
#[test]
fn the_published_method_in_exact_arithmetic() {
    let psi = root().join("examples/psi.txt");
    let found = run("viewcert-lab", &["published", psi.to_str().unwrap()]);
    assert_eq!(found.code, 1, "{}", found.err);
    for words in [
        "15 (exact)",
        "12 with all pairs",
        "12 to 15 without",
        "begun at 15 pairs",
    ] {
        assert!(found.out.contains(words), "{words}: {}", found.out);
    }
    let folder = tempfile::tempdir().unwrap();
    let tail = graph_file(folder.path(), "tail.txt", "0 1\n0 2\n1 2\n2 3\n");
    let found = run("viewcert-lab", &["published", &tail]);
    assert_eq!(found.code, 0, "{}", found.out);
}

#[test]
fn a_dash_is_standard_output_and_an_input_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let square = graph_file(folder.path(), "square.txt", SQUARE);
    for (command, said) in [("compare", "all agree"), ("tolerances", "tolerance,")] {
        let found = run("viewcert-lab", &[command, &square, "--svg", "-"]);
        assert!(
            found.out.starts_with("<svg") && found.out.ends_with("</svg>\n"),
            "{}",
            found.out
        );
        assert!(found.err.contains(said), "{}", found.err);
        let found = run("viewcert-lab", &[command, &square, "--svg", &square]);
        assert_eq!(found.code, 2);
        assert!(found.err.contains("this is the input"), "{}", found.err);
    }
    assert!(!Path::new("-").exists());
}
