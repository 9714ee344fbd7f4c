//! `verify experiment solutions`, through the program.

use std::process::{Command, Output};

fn verify(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .output()
        .unwrap()
}

/// The published numbers: ten of the 27 graphs with nine nodes have two solutions.
#[test]
fn up_to_nine_nodes() {
    let run = verify(&["experiment", "solutions", "--nodes", "8-9"]);
    assert_eq!(run.status.code(), Some(0));
    let table = String::from_utf8(run.stdout).unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .skip(1)
        .map(|line| line.split_whitespace().collect())
        .collect();
    let [eight, nine] = &rows[..] else {
        panic!("{table}")
    };
    assert_eq!(eight[..5], ["8", "36", "1:", "36", "0"]);
    assert_eq!(nine[..7], ["9", "27", "1:", "17,", "2:", "10", "0"]);
}

#[test]
fn bad_sizes_are_bad_usage() {
    for bad in ["2", "9-8", "x", "3-", ""] {
        let run = verify(&["experiment", "solutions", "--nodes", bad]);
        assert_eq!(run.status.code(), Some(2), "{bad}");
        let said = String::from_utf8(run.stderr).unwrap();
        assert!(said.contains("from 3 up"), "{said}");
    }
    let run = verify(&["experiment", "solutions", "--nodes", "99"]);
    assert_eq!(run.status.code(), Some(2));
}
