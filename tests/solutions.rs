//! The number of solutions, through the program: certificates, and a second solution to
//! look at.

use crate::common::python;
use std::process::{Command, Output};

fn verify(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .output()
        .unwrap()
}

/// The exit code of a script beside the second checker on a file, and what it says.
fn said_of(script: &str, file: &str) -> (Option<i32>, String) {
    let script = format!(
        "{}/crates/check/second/{script}",
        env!("CARGO_MANIFEST_DIR")
    );
    let run = python().args([&script, file]).output().unwrap();
    let said = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
    (run.status.code(), said.concat())
}

/// The 9 cameras and 12 pairs with two solutions, in other graphs: a component with several solutions, or with an
/// unknown number, never looks like a unique one.
#[test]
fn components_say_that_they_are_not_unique() {
    let two = "1 3\n1 4\n2 5\n3 5\n2 6\n4 6\n0 7\n4 7\n5 7\n0 8\n3 8\n6 8\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("graph.txt").to_str().unwrap().to_owned();
    let said = |graph: &str, options: &[&str]| {
        std::fs::write(&path, graph).unwrap();
        String::from_utf8(verify(&[&[&*path], options].concat()).stdout).unwrap()
    };
    assert!(said(two, &[]).contains("exactly 2 solutions over the complex numbers if the centres"));
    let hanging = format!("{two}8 9\n");
    let text = said(&hanging, &[]);
    assert!(
        text.contains("9 cameras / 12 pairs (exactly 2 solutions), 2 cameras / 1 pair\n"),
        "{text}"
    );
    let text = said(&hanging, &["--solutions=off"]);
    assert!(
        text.contains("9 cameras / 12 pairs (finitely many solutions), 2 cameras / 1 pair\n"),
        "{text}"
    );
    let line: serde_json::Value =
        serde_json::from_str(&said(&hanging, &["--solutions=off", "--json"])).unwrap();
    let [one, other] = [0, 1].map(|k| &line["components"][k]["solutions"]);
    assert_eq!(
        (&one["at_least"], &one["at_most"]),
        (&1.into(), &serde_json::Value::Null)
    );
    assert!(other.is_null());
    // Parts that are bodies, and models in which finite means unique.
    for (graph, model) in [
        ("a b\nb c\na c\nc d\n", "projective"),
        (&*hanging, "calibrated"),
    ] {
        assert!(!said(graph, &["--model", model, "--solutions=off"]).contains("solutions)"));
    }
}

/// A component that a full count would settle has the hint that it has alone, and so has what a quick count left
/// behind it.
#[test]
fn components_have_the_hint_that_they_have_alone() {
    let graph =
        viewcert::graph::graph6::decode(b"U??_?CA?W?O_cAKHS?AO???O?GS?OOC?b??@IK??").unwrap();
    let pairs = |name: &str| -> String {
        let pairs = graph.edges().iter();
        pairs
            .map(|(i, j)| format!("{name}{i} {name}{j}\n"))
            .collect()
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("graph.txt").to_str().unwrap().to_owned();
    let two = pairs("a") + &pairs("b");
    for (graph, options, hinted) in [
        (pairs("a"), &[][..], true),
        (pairs("a") + "a0 x\n", &[], true),
        (two.clone(), &[], true),
        (two.clone(), &["--model", "calibrated"], false),
    ] {
        std::fs::write(&path, graph).unwrap();
        let text = String::from_utf8(verify(&[&[&*path], options].concat()).stdout).unwrap();
        assert_eq!(
            text.contains("  hint        --solutions=full may tell"),
            hinted,
            "{text}"
        );
    }
    std::fs::write(&path, two).unwrap();
    let line: serde_json::Value =
        serde_json::from_slice(&verify(&[&path, "--json"]).stdout).unwrap();
    for component in line["components"].as_array().unwrap() {
        assert_eq!(component["solutions"]["full_may_tell_more"], true, "{line}");
    }
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
#[ignore = "needs python3"]
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
