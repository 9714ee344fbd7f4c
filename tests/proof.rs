//! `verify --proof`: what is written, and what is refused, through the binary.

use std::process::{Command, Output, Stdio};

const HUB: &str = "0 2\n0 3\n0 5\n1 4\n1 5\n1 6\n1 7\n1 8\n2 4\n2 6\n3 7\n3 8\n";

fn verify(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_verify"));
    let run = command.args(arguments).stdin(Stdio::null()).output();
    run.unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// The proof of docs/proof.md, but for the lower bound, which the 4-cycle reaches: 4 * 7 = 28.
#[test]
fn a_refutation_is_written_with_its_bounds() {
    let folder = tempfile::tempdir().unwrap();
    let [graph, proof] = ["graph.txt", "proof"].map(|name| folder.path().join(name));
    std::fs::write(&graph, "0 1\n1 2\n2 3\n0 3\n").unwrap();
    let run = verify(&[graph.to_str().unwrap(), "--proof", proof.to_str().unwrap()]);
    assert_eq!(run.status.code(), Some(1));
    assert!(text(&run.stdout).contains("(rank 28 at least, 28 at most; 4 components)"));
    let written = std::fs::read_to_string(proof).unwrap();
    assert!(written.starts_with("viewcert proof 1\ngraph 4 4\nclaim 28 28\n"));
}

/// The same in JSON, which the schema describes.
#[test]
fn json_says_what_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let [graph, proof] = ["graph.txt", "proof"].map(|name| folder.path().join(name));
    std::fs::write(&graph, "0 1\n1 2\n2 3\n0 3\n").unwrap();
    let [graph, file] = [&graph, &proof].map(|path| path.to_str().unwrap());
    let run = verify(&[graph, "--proof", file, "--json"]);
    let line: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let schema = serde_json::from_str(include_str!("../docs/report.schema.json")).unwrap();
    assert!(jsonschema::validator_for(&schema).unwrap().is_valid(&line));
    let shown = serde_json::json!({
        "file": file, "rank_at_least": 28, "rank_at_most": 28, "components": 4, "solvable": false
    });
    assert_eq!(line["proof"], shown);
    assert!(std::path::Path::new(file).exists());
}

/// Bad usage, a message that says what is missing, and no file.
#[test]
fn what_has_no_proof_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let [graph, proof] = ["graph.txt", "proof"].map(|name| folder.path().join(name));
    std::fs::write(&graph, HUB).unwrap();
    let [graph, file] = [&graph, &proof].map(|path| path.to_str().unwrap());
    for (more, why) in [
        (&[graph][..], "2 graphs"),
        (&["--given", graph], "rest on pairs alone"),
    ] {
        let run = verify(&[&[graph, "--proof", file], more].concat());
        assert_eq!(run.status.code(), Some(2), "{}", text(&run.stderr));
        assert!(text(&run.stderr).contains(why), "{}", text(&run.stderr));
        assert!(!proof.exists());
    }
    let run = verify(&[graph, "--proof", graph]);
    assert_eq!(run.status.code(), Some(2));
}

/// The 4-cycle is rigid in space, and in a plane it is not; a proof says of which it speaks.
#[test]
fn other_models_have_proofs() {
    let folder = tempfile::tempdir().unwrap();
    let [graph, proof] = ["graph.txt", "proof"].map(|name| folder.path().join(name));
    std::fs::write(&graph, "0 1\n1 2\n2 3\n0 3\n").unwrap();
    let [graph, file] = [&graph, &proof].map(|path| path.to_str().unwrap());
    // The report says one rank; the affine proof states that of R, of which it is four times.
    for (model, code, rank, shown) in [
        ("calibrated", 0, 8, "(rank 8 at least, 8 at most; solvable)"),
        (
            "affine",
            1,
            4,
            "(rank 16 at least, 16 at most; 4 components)",
        ),
    ] {
        let run = verify(&[graph, "--model", model, "--proof", file]);
        assert_eq!(run.status.code(), Some(code), "{}", text(&run.stderr));
        assert!(text(&run.stdout).contains(shown), "{}", text(&run.stdout));
        let written = std::fs::read_to_string(&proof).unwrap();
        assert!(written.starts_with(&format!(
            "viewcert proof 1\ngraph 4 4\nmodel {model}\nclaim {rank} {rank}\n"
        )));
    }
}

/// What takes a hub to refute has a proof with its copies and cells.
#[test]
fn a_hub_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let [graph, proof] = ["graph.txt", "proof"].map(|name| folder.path().join(name));
    std::fs::write(&graph, HUB).unwrap();
    let [graph, file] = [&graph, &proof].map(|path| path.to_str().unwrap());
    let run = verify(&[graph, "--proof", file]);
    assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
    let written = std::fs::read_to_string(&proof).unwrap();
    assert!(written.contains("\nclaim 83 83\n"), "{written}");
    // for the whole, and for the step that tells the components apart
    assert_eq!(written.matches("\nhub 5 12\n").count(), 2);
}
