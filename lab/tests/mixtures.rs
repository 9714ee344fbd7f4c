//! `viewcert-lab intrinsics`: for which classes and sensors small graphs are metric.

use crate::common::{Run, python, root, second_checker};
use std::collections::BTreeMap;

const PUBLISHED: &str = include_str!("../intrinsics-census.tsv");

fn workshop(input: &str, arguments: &[&str]) -> Run {
    let arguments = [&["intrinsics", "-"][..], arguments].concat();
    crate::common::run_with("viewcert-lab", input.as_bytes(), &arguments)
}

/// The rows of the published table: graph, question, numbers, least assignments.
fn rows(table: &str) -> Vec<Vec<&str>> {
    let mut lines = table.lines();
    let head = "graph6\tquestion\tcases\tmetric\topen\tleast";
    assert_eq!(lines.next(), Some(head));
    lines.map(|line| line.split('\t').collect()).collect()
}

fn nodes(graph6: &str) -> u8 {
    graph6.as_bytes()[0] - 63
}

/// The graphs of the published table with so many nodes at most.
fn graphs(most: u8) -> String {
    let mut lines: Vec<&str> = rows(PUBLISHED).into_iter().map(|row| row[0]).collect();
    lines.dedup();
    lines.retain(|line| nodes(line) <= most);
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// What the script beside this file prints.
fn script(arguments: &[&str]) -> String {
    let script = root().join("lab/tests/mixtures.py");
    let made = python().arg(script).args(arguments).output().unwrap();
    assert!(made.status.success());
    String::from_utf8(made.stdout).unwrap()
}

#[test]
#[ignore = "needs python3"]
fn assignments_are_as_many_as_burnside_counts() {
    let mut published: BTreeMap<u8, [usize; 2]> = BTreeMap::new();
    for row in rows(PUBLISHED) {
        let sums = published.entry(nodes(row[0])).or_default();
        match row[1] {
            "known, focal, unknown" => sums[0] += row[2].parse::<usize>().unwrap(),
            "sensors, unknown" => sums[1] += row[2].parse::<usize>().unwrap(),
            _ => {}
        }
    }
    let published = published.into_iter();
    let published =
        published.map(|(nodes, [classes, sensors])| format!("{nodes} {classes} {sensors}"));
    let expected = script(&["burnside", "6"]);
    assert_eq!(
        published.collect::<Vec<_>>(),
        expected.lines().collect::<Vec<_>>()
    );
}

#[test]
#[ignore = "needs python3"]
fn counts_are_those_of_brute_force() {
    let expected = script(&["4"]);
    let run = workshop(&graphs(4), &[]);
    let sorted = |text: &str| {
        let lines = text.lines().filter(|line| line.contains(" | 0 |"));
        let mut lines: Vec<String> = lines.map(str::to_owned).collect();
        lines.sort();
        lines
    };
    assert_eq!(sorted(&run.out), sorted(&expected));
    assert_eq!(sorted(&run.out).len(), 12);
}

#[test]
fn published_rows_are_made_again() {
    let made = workshop(&graphs(5), &["--graphs"]);
    assert_eq!(made.code, 0, "{}", made.err);
    let mut published = rows(PUBLISHED);
    published.retain(|row| nodes(row[0]) <= 5);
    assert_eq!(rows(&made.out), published);
    // Connected graphs with 2 to 6 nodes, A001349.
    let mut counts: BTreeMap<u8, usize> = BTreeMap::new();
    for row in rows(PUBLISHED) {
        *counts.entry(nodes(row[0])).or_default() += 1;
    }
    let counts: Vec<usize> = counts.into_values().map(|rows| rows / 4).collect();
    assert_eq!(counts, [1, 2, 6, 21, 112]);
    assert!(
        rows(PUBLISHED).iter().all(|row| row[4] == "0"),
        "all are proved"
    );
}

#[test]
fn least_assignments_say_which_are_metric() {
    // Both ways: what is metric follows from the least ones: an assignment that knows no less at each node is metric.
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("list.tsv");
    let run = workshop("Cl\n", &["--graphs", "--list", list.to_str().unwrap()]);
    assert_eq!(run.code, 0, "{}", run.err);
    let least = rows(&run.out)[0][5].to_owned();
    let list = std::fs::read_to_string(list).unwrap();
    let order = |letter: char| "kfu".find(letter).unwrap();
    let mut seen = [0; 2];
    for line in list
        .lines()
        .filter(|line| line.contains("known, focal, unknown"))
    {
        let cells: Vec<&str> = line.split('\t').collect();
        let is_metric = cells[3] == cells[5];
        assert_eq!(cells[3], cells[4], "proved");
        // A cycle: its symmetries are the turns and the reflection.
        let word: Vec<char> = cells[2].chars().collect();
        let follows = least.split(' ').any(|least| {
            let least: Vec<char> = least.chars().collect();
            (0..word.len()).any(|turn| {
                [1, word.len() - 1].into_iter().any(|step| {
                    let at = |k: usize| word[(turn + step * k) % word.len()];
                    (0..word.len()).all(|k| order(at(k)) <= order(least[k]))
                })
            })
        });
        assert_eq!(follows, is_metric, "{line} {least}");
        seen[usize::from(is_metric)] += 1;
    }
    // Necklaces of 4 beads in 3 colours that may be turned over.
    assert_eq!(seen[0] + seen[1], 21);
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?}");
}

#[test]
#[ignore = "needs python3"]
fn every_assignment_has_its_certificate() {
    let folder = tempfile::tempdir().unwrap();
    let [list, lines] = ["list.tsv", "all.jsonl"].map(|name| folder.path().join(name));
    let [list, lines] = [&list, &lines].map(|path| path.to_str().unwrap());
    let run = workshop(&graphs(4), &["--list", list, "--certificates", lines]);
    assert_eq!(run.code, 0, "{}", run.err);
    let rows = std::fs::read_to_string(list).unwrap();
    let certificates = std::fs::read_to_string(lines).unwrap();
    let claims = certificates.lines().map(|line| {
        let certificate: serde_json::Value = serde_json::from_str(line).unwrap();
        let claim = &certificate["claim"];
        ["at_least", "at_most", "required"].map(|name| claim[name].to_string())
    });
    let decided = rows.lines().skip(1).map(|row| {
        let cells: Vec<&str> = row.split('\t').collect();
        [cells[3], cells[4], cells[5]].map(str::to_owned)
    });
    assert!(claims.eq(decided));
    let count = rows.lines().count() - 1;
    // Both checkers accept all of them.
    let checked = crate::common::run("verify", &["check", lines]);
    assert_eq!(checked.code, 0, "{}", checked.out);
    let all = format!("{count} certificates verified, 0 rejected");
    assert!(checked.out.contains(&all), "{}", checked.out);
    let second = second_checker(&["--list", lines]);
    assert_eq!(second.code, 0, "{}", second.out);
    let all = format!("{count} verified, 0 rejected, 0 too large");
    assert!(second.out.contains(&all), "{}", second.out);
}

#[test]
fn what_is_too_large_is_refused() {
    let run = workshop("K~~~~~~~~~~~\n", &[]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("12 nodes"), "{}", run.err);
    assert_eq!(workshop("!\n", &[]).code, 2);
}
