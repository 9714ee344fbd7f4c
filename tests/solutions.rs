//! The number of solutions, through the program: certificates, and a second solution to
//! look at.

use std::process::{Command, Output};

fn verify(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .output()
        .unwrap()
}

/// The exit code of a script beside the second checker on a file, and what it says.
fn said_of(script: &str, file: &str) -> (Option<i32>, String) {
    let python = std::env::var("VIEWCERT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let script = format!(
        "{}/crates/check/second/{script}",
        env!("CARGO_MANIFEST_DIR")
    );
    let run = Command::new(python).args([&script, file]).output().unwrap();
    let said = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
    (run.status.code(), said.concat())
}

/// Writes graph6 to a file in a folder and returns its path.
fn graph_file(folder: &std::path::Path, graph6: &str) -> String {
    let path = folder.join("graph.g6");
    std::fs::write(&path, format!("{graph6}\n")).unwrap();
    path.to_str().unwrap().to_owned()
}

/// A count that takes a second or so in all is over with the time.
#[test]
fn a_count_can_be_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let graph = graph_file(folder.path(), r"K??hoaGO\_Gg");
    let run = verify(&[&graph, "--solutions=full", "--time-limit", "200ms"]);
    let said = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(3), "{said}");
    assert!(said.contains("number of solutions of 12 cameras"), "{said}");
}

/// A certificate claims that there is one solution only where it shows it.
#[test]
fn certificates_say_what_they_show() {
    use viewcert_check::Verdict::{FiniteSolvable, Solvable};
    let folder = tempfile::tempdir().unwrap();
    let certificate = folder.path().join("certificate.json");
    // One solution, two solutions (published), and K_{2,3}, which is one body.
    for (graph6, arguments, verdict, count) in [
        ("G@TclO", &[][..], Solvable, Some((1, Some(1)))),
        ("G@TclO", &["--solutions=off"], FiniteSolvable, None),
        ("HBQkcP_", &[], FiniteSolvable, Some((2, Some(2)))),
        ("HBQkcP_", &["--solutions=off"], FiniteSolvable, None),
        ("D]o", &[], Solvable, None),
        ("D]o", &["--solutions=off"], Solvable, None),
    ] {
        let graph = graph_file(folder.path(), graph6);
        let to = ["--certificate", certificate.to_str().unwrap()];
        let run = verify(&[&[graph.as_str()], &to[..], arguments].concat());
        assert_eq!(run.status.code(), Some(0), "{graph6}");
        let text = std::fs::read(&certificate).unwrap();
        let verified = viewcert_check::check(&text, None).unwrap();
        assert_eq!(verified.verdict.0, verdict, "{graph6} {arguments:?}");
        let counted = verified
            .solutions
            .map(|count| (count.at_least, count.at_most));
        let count =
            count.map(|(least, most)| (least.into(), most.map(viewcert_check::Number::from)));
        assert_eq!(counted, count, "{graph6} {arguments:?}");
        // Without contraction nothing is counted, and nothing is claimed.
        let whole = verify(&[&[graph.as_str()], &to[..], &["--method", "matrix"]].concat());
        assert_eq!(whole.status.code(), Some(0));
        let verified = viewcert_check::check(&std::fs::read(&certificate).unwrap(), None);
        assert_eq!(verified.unwrap().verdict.0, FiniteSolvable, "{graph6}");
    }
}

/// What is written is checked by a script that shares nothing with the program, and changed it is
/// none any more.
#[test]
fn a_second_solution_to_look_at() {
    let folder = tempfile::tempdir().unwrap();
    let graph = graph_file(folder.path(), "HBQkcP_");
    let witness = folder.path().join("witness.json");
    let path = witness.to_str().unwrap();
    let run = verify(&["witness", &graph, path]);
    assert_eq!(run.status.code(), Some(0));
    assert!(
        String::from_utf8(run.stdout)
            .unwrap()
            .contains("  witness     ")
    );
    let checked = || said_of("witness.py", path);
    let (code, said) = checked();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.starts_with("VERIFIED"), "{said}");
    let text = std::fs::read_to_string(&witness).unwrap();
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(found["first"].as_array().unwrap().len(), 9);
    let rejected = |change: &dyn Fn(&mut serde_json::Value), words: &str| {
        let mut other = found.clone();
        change(&mut other);
        std::fs::write(&witness, other.to_string()).unwrap();
        let (code, said) = checked();
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains(words), "{words}: {said}");
    };
    rejected(
        &|other| other["second"] = other["first"].clone(),
        "are equivalent",
    );
    rejected(&|other| other["second"][0][0][0] = "1".into(), "differ");
    rejected(
        &|other| other["prime"] = "2305843009213693953".into(),
        "is not a prime",
    );
    rejected(
        &|other| other["second"][0][0][0] = "-1".into(),
        "is no residue",
    );
    rejected(
        &|other| other["edges"][0] = serde_json::json!([0, 1]),
        "differ",
    );
    rejected(&|other| other["version"] = 2.into(), "not a witness");

    // One solution only: nothing is written, and why is said.
    let graph = graph_file(folder.path(), "G@TclO");
    let none = folder.path().join("none.json");
    let run = verify(&["witness", &graph, none.to_str().unwrap()]);
    assert_eq!(run.status.code(), Some(0));
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(
        said.contains("no witness: there is one solution only"),
        "{said}"
    );
    assert!(!none.exists());
    let run = verify(&["witness", &graph, &graph]);
    assert_eq!(run.status.code(), Some(2), "the graph itself");
}

/// A second scene in front of its cameras is checked by a script that shares nothing with the program: by
/// fractions, with points that both scenes show at the same places of all images.
#[test]
fn a_second_scene_to_look_at() {
    let folder = tempfile::tempdir().unwrap();
    let graph = graph_file(folder.path(), "HBQkcP_");
    let witness = folder.path().join("scene.json");
    let path = witness.to_str().unwrap();
    let run = verify(&["witness", &graph, path, "--oriented"]);
    assert_eq!(run.status.code(), Some(0));
    let said = String::from_utf8(run.stdout).unwrap();
    let line = "  oriented    1 of 2 real solutions near some cameras, 2 of 2 near others (proved)";
    assert!(said.lines().any(|other| other == line), "{said}");
    let checked = || said_of("second_scene.py", path);
    let (code, said) = checked();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.starts_with("12 pairs see the same images"), "{said}");
    let text = std::fs::read_to_string(&witness).unwrap();
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let rejected = |change: &dyn Fn(&mut serde_json::Value), words: &str| {
        let mut other = found.clone();
        change(&mut other);
        std::fs::write(&witness, other.to_string()).unwrap();
        let (code, said) = checked();
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains(words), "{words}: {said}");
    };
    let entry = |other: &mut serde_json::Value| other["second"][0][0][0] = serde_json::json!(["7"]);
    rejected(&entry, "another fundamental matrix");
    let edge = |other: &mut serde_json::Value| other["edges"][0] = serde_json::json!([0, 1]);
    rejected(&edge, "another fundamental matrix");
    // With two centres behind others no plane but a suitable one will do.
    let plane = |other: &mut serde_json::Value| other["plane"] = serde_json::json!([1, 0, 0, 0]);
    rejected(&plane, "no point is in front of both cameras of some pair");

    let picture = folder.path().join("scene.svg");
    let run = verify(&["witness", &graph, picture.to_str().unwrap(), "--oriented"]);
    assert_eq!(run.status.code(), Some(0));
    let picture = std::fs::read_to_string(picture).unwrap();
    // Nine cameras and a point for each of twelve pairs, twice.
    assert_eq!(picture.matches("<circle").count(), 2 * (9 + 12));
    assert_eq!(picture.matches("<line").count(), 2 * 24);

    // A graph that is one body.
    let graph = graph_file(folder.path(), "D]o");
    let none = folder.path().join("none.json");
    let run = verify(&["witness", &graph, none.to_str().unwrap(), "--oriented"]);
    let said = String::from_utf8(run.stderr).unwrap();
    assert!(
        said.contains("no witness: there is one solution only"),
        "{said}"
    );
    assert!(!none.exists());
}
