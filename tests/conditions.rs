//! `verify conditions`, through the binary, against the published counts of Trager,
//! Osserman and Ponce (ECCV 2018).

use serde_json::Value;
use std::io::Write;
use std::process::{Command, Output, Stdio};

fn conditions(graphs: &[u8], arguments: &[&str]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_verify"))
        .arg("conditions")
        .args(arguments)
        .arg("-")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let graphs = graphs.to_vec();
    let feed = std::thread::spawn(move || input.write_all(&graphs));
    let output = child.wait_with_output().unwrap();
    feed.join().unwrap().unwrap();
    output
}

fn lines(output: &Output) -> Vec<Value> {
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn answer<'a>(line: &'a Value, name: &str) -> &'a Value {
    let mut all = line["conditions"].as_array().unwrap().iter();
    all.find(|condition| condition["name"] == name).unwrap()
}

/// The candidates with `nodes` nodes, from nauty's generator; `None` without it.
fn candidates(nodes: usize) -> Option<Vec<u8>> {
    let edges = (11 * nodes - 15).div_ceil(7);
    let range = format!("{edges}:{edges}");
    let found = ["nauty-geng", "geng"].iter().find_map(|program| {
        Command::new(program)
            .args(["-Cq", &nodes.to_string(), &range])
            .output()
            .ok()
    });
    if found.is_none() {
        eprintln!("SKIPPED: neither nauty-geng nor geng is installed");
    }
    Some(found?.stdout)
}

/// With the smallest possible number of edges: how many graphs pass all necessary
/// conditions of the publication (bearing rigidity came later), and how many of these its
/// moves show to be solvable.
#[test]
fn published_counts() {
    let passing = [1, 1, 1, 4, 3, 36, 28];
    let by_moves = [1, 1, 1, 4, 3, 31, 5];
    for nodes in 3..=9 {
        let Some(graphs) = candidates(nodes) else {
            return;
        };
        let output = conditions(&graphs, &["--json"]);
        let mut counts = (0, 0);
        for line in lines(&output) {
            let passes = line["conditions"]
                .as_array()
                .unwrap()
                .iter()
                .filter(|c| c["kind"] == "necessary" && c["name"] != "bearing rigid")
                .all(|c| c["answer"] != "no");
            let complete = answer(&line, "moves")["answer"] == "yes";
            // What grows from a triangle is completed by moves, and what is solvable
            // passes.
            assert!(passes || !complete);
            assert!(complete || answer(&line, "grows from a triangle")["answer"] == "no");
            // The condition by edges implies the others.
            if answer(&line, "d-condition by edges")["answer"] == "yes" {
                assert!(passes);
            }
            counts.0 += usize::from(passes);
            counts.1 += usize::from(complete);
        }
        assert_eq!(
            counts,
            (passing[nodes - 3], by_moves[nodes - 3]),
            "{nodes} nodes"
        );
    }
}

#[test]
fn witnesses_by_hand() {
    // The 4-cycle.
    let output = conditions(b"a b\nb c\nc d\nd a\n", &["--json"]);
    assert_eq!(output.status.code(), Some(1));
    let line = &lines(&output)[0];
    let necessary = |name: &str| answer(line, name);
    assert_eq!(necessary("minimum degree 2")["answer"], "yes");
    assert_eq!(necessary("no adjacent nodes of degree 2")["answer"], "no");
    assert_eq!(
        necessary("no adjacent nodes of degree 2")["witness"][0],
        "a and b have degree 2"
    );
    assert_eq!(necessary("biconnected")["answer"], "yes");
    assert_eq!(necessary("7m >= 11n - 15")["answer"], "no");
    assert_eq!(necessary("7m >= 11n - 15")["witness"][0], "28 and 29");
    assert_eq!(
        necessary("d-condition by edges")["witness"][0],
        "rank at most 28 of 29, by the blocks:"
    );
    assert_eq!(line["result"], "not solvable: a necessary condition fails");
}

#[test]
fn a_move_list_is_printed() {
    let output = conditions(b"1 2\n1 3\n2 3\n2 4\n3 4\n", &[]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("solid 1 - 4, triangles with 2 - 3"), "{text}");
    assert!(text.contains("4 joins, seen from 2 and 3"), "{text}");
    assert!(
        text.contains("solvable: a sufficient condition holds"),
        "{text}"
    );
}

#[test]
fn what_does_not_apply_says_why() {
    let output = conditions(b"1 2\n", &["--json"]);
    assert_eq!(output.status.code(), Some(0));
    let line = &lines(&output)[0];
    for name in ["minimum degree 2", "grows from a triangle"] {
        assert_eq!(answer(line, name)["answer"], "not applicable");
        assert!(answer(line, name)["witness"][0].is_string());
    }
    let output = conditions(b"alone\n", &[]);
    assert_eq!(output.status.code(), Some(2));
}

/// The 4-cycle in graph6 is no edge list.
#[test]
fn the_format_can_be_said() {
    let output = conditions(b"Cl\n", &["--json", "--format", "graph6"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(lines(&output)[0]["edges"], 4);
    let output = conditions(b"Cl\n", &["--format", "edge-list"]);
    assert_eq!(output.status.code(), Some(2));
}
