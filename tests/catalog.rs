//! `verify catalog`, through the program.

use crate::common::{TABLE_1, geng, verify};
use std::collections::BTreeSet;
use std::fs;
use viewcert_catalog::label::Label;

/// Candidates, finite-solvable ones and unproved verdicts of each line of a table.
fn counts(table: &str) -> Vec<[usize; 3]> {
    let rows = table.lines().skip(1).filter(|line| !line.contains(": "));
    let row = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [candidates, solvable, _, _, _, unproved, ..] = words[5..] else {
            panic!("{line}");
        };
        [candidates, solvable, unproved].map(|word| word.parse().unwrap())
    };
    rows.map(row).collect()
}

#[test]
fn table_1_as_published() {
    let all = verify(&["catalog", "--nodes", "3-10"]);
    assert_eq!(all.code, 0, "{}", all.err);
    let expected = TABLE_1.map(|(.., candidates, solvable)| [candidates, solvable, 0]);
    assert_eq!(counts(&all.out), expected, "{}", all.out);
    let necessary = verify(&["catalog", "--nodes", "3-10", "--necessary"]);
    for (necessary, all) in counts(&necessary.out).iter().zip(&expected) {
        assert!(necessary[0] <= all[0]);
        assert_eq!(necessary[1..], all[1..]);
    }
}

/// The same graphs as nauty's geng, up to labels, beyond the least number of edges too.
#[test]
#[ignore = "needs geng"]
fn the_candidates_of_geng() {
    for (nodes, edges) in [(6, 9), (7, 12), (8, 11), (9, 12), (9, 14)] {
        let listed = geng(nodes, edges);
        let label = |line: &str| {
            let graph = viewcert::graph::graph6::decode(line.as_bytes()).unwrap();
            Label::of(&graph).unwrap()
        };
        let expected: BTreeSet<Label> = listed.lines().map(label).collect();
        let watch = viewcert::watch::Watch::default();
        let found = viewcert_catalog::candidates(nodes, edges, &watch).unwrap();
        assert_eq!(found.len(), expected.len(), "{nodes} nodes, {edges} edges");
        let found: BTreeSet<Label> = found.iter().filter_map(Label::of).collect();
        assert_eq!(found, expected, "{nodes} nodes, {edges} edges");
    }
}

/// Each graph that is listed has a certificate, which both checkers accept and which says the same.
#[test]
fn a_certificate_for_each_entry() {
    let folder = tempfile::tempdir().unwrap();
    let certificates = folder.path().to_str().unwrap();
    let sizes = ["catalog", "--nodes", "8", "--solutions", "--list"];
    let run = verify(&[&sizes[..], &["--certificate", certificates]].concat());
    assert_eq!(run.code, 0, "{}", run.err);
    let rows: Vec<Vec<&str>> = run
        .out
        .lines()
        .skip(1)
        .map(|row| row.split('\t').collect())
        .collect();
    assert_eq!(rows.len(), 161);
    let one = rows.iter().filter(|row| row[8] == "1").count();
    assert_eq!(one, 36);
    let check = verify(&["check", certificates]);
    assert!(
        check
            .out
            .starts_with("161 certificates verified, 0 rejected"),
        "{}",
        check.out
    );
    let solvable = rows.iter().filter(|row| row[1] == "solvable").count();
    assert_eq!(solvable, 36);
    let said = fs::read_dir(certificates).unwrap().filter(|file| {
        let text = fs::read_to_string(file.as_ref().unwrap().path()).unwrap();
        text.contains("\"value\":\"solvable\"")
    });
    assert_eq!(said.count(), 36);
}

#[test]
fn impossible_sizes_are_bad_usage() {
    for (arguments, message) in [
        (&["--nodes", "2"][..], "3 to 12 nodes"),
        (&["--nodes", "0"], "3 to 12 nodes"),
        (&["--nodes", "13"], "3 to 12 nodes"),
        (&["--nodes", "5", "--edges", "11"], "5 to 10 edges"),
        (&["--nodes", "5", "--edges", "4"], "5 to 10 edges"),
        (&["--nodes", "7-5"], "range is empty"),
        (&["--nodes", "6", "--prime", "15"], "prime"),
        (
            &["--nodes", "6", "--certificate", "nowhere"],
            "an existing folder",
        ),
        (&[], "--nodes"),
    ] {
        let run = verify(&[&["catalog"], arguments].concat());
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.err.contains(message), "{arguments:?}: {}", run.err);
    }
}

/// As many as Groebner bases find (docs/catalog.md), under the table, and only if they are asked for.
#[test]
fn numbers_of_solutions_under_the_table() {
    let plain = verify(&["catalog", "--nodes", "8-9"]).out;
    assert!(!plain.contains("solutions"), "{plain}");
    let counted = verify(&["catalog", "--nodes", "8-9", "--solutions"]).out;
    let last = counted.lines().skip(3).collect::<Vec<_>>();
    assert_eq!(
        last,
        [
            "8 nodes, 11 edges, biconnected: solutions: graphs  1: 36",
            "9 nodes, 12 edges, biconnected: solutions: graphs  1: 17, 2: 10",
        ]
    );
    let header = counted.lines().next().unwrap();
    assert!(
        header.contains("contract") && !header.contains("unique"),
        "{header}"
    );
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_an_error() {
    let full = fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_verify"));
    let run = command
        .args(["catalog", "--nodes", "5"])
        .stdout(full)
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    let errors = String::from_utf8(run.stderr).unwrap();
    assert!(errors.contains("No space left"), "{errors}");
}

#[test]
fn a_limit_says_what_was_enumerated() {
    let run = verify(&["catalog", "--nodes", "12", "--time-limit", "1ms"]);
    assert_eq!(run.code, 3);
    assert!(
        run.err
            .contains("the time limit was reached at the enumeration of graphs with "),
        "{}",
        run.err
    );
}
