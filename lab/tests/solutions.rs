//! `viewcert-lab solutions` and `thin`: numbers of solutions of many graphs.

use crate::common::Run;

fn workshop(arguments: &[&str]) -> Run {
    crate::common::run("viewcert-lab", arguments)
}

/// What a command prints, as words of each line.
fn experiment(arguments: &[&str]) -> Vec<Vec<String>> {
    let run = workshop(arguments);
    assert_eq!(run.code, 0, "{}", run.err);
    let table = run.out;
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect();
    table.lines().map(words).collect()
}

/// The published numbers: ten of the 27 graphs with nine nodes have two solutions. Four graphs with
/// eight nodes are one body; 7 * 12 = 11 * 9 - 15, so that nine nodes leave no excess.
#[test]
fn up_to_nine_nodes() {
    let lines = experiment(&["solutions", "--nodes", "8-9"]);
    assert_eq!(lines[1][..5], ["8", "36", "1:", "36", "0"]);
    assert_eq!(lines[2][..7], ["9", "27", "1:", "17,", "2:", "10", "0"]);
    assert_eq!(lines[3], ["nodes", "excess", "solutions:", "graphs"]);
    assert_eq!(lines[4], ["8", "one", "body", "1:", "15"]);
    let nine = lines[5..].iter().find(|line| line[0] == "9").unwrap();
    assert_eq!(nine[1..], ["0", "1:", "17,", "2:", "10"]);
    let last = lines.last().unwrap();
    assert_eq!(last[..5], ["9", "nodes,", "2", "solutions:", "first"]);
}

/// As many Laman graphs as are published (OEIS A227117).
#[test]
fn laman_graphs() {
    let lines = experiment(&["solutions", "--laman", "--nodes", "5-6"]);
    assert_eq!(lines[1][..5], ["5", "3", "1:", "3", "0"]);
    assert_eq!(lines[2][..5], ["6", "13", "1:", "13", "0"]);
    let run = workshop(&["solutions", "--laman", "--nodes", "11"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("ask for 2 to 10 nodes"), "{}", run.err);
}

#[test]
fn bad_sizes_are_bad_usage() {
    for bad in ["2", "9-8", "x", "3-", ""] {
        let run = workshop(&["solutions", "--nodes", bad]);
        assert_eq!(run.code, 2, "{bad}");
        assert!(run.err.contains("from 3 up"), "{}", run.err);
    }
    let run = workshop(&["solutions", "--nodes", "99"]);
    assert_eq!(run.code, 2);
}

/// Pieces of a complete graph, the same ones twice; without any one pair they are not finite
/// solvable any more, and there are not too few pairs.
#[test]
fn thinned_pieces() {
    let folder = tempfile::tempdir().unwrap();
    let graph = folder.path().join("complete.txt");
    let pairs = (0..12).flat_map(|v| (0..v).map(move |u| format!("{u} {v}\n")));
    std::fs::write(&graph, pairs.collect::<String>()).unwrap();
    let rows = |name: &str| {
        let csv = folder.path().join(name);
        let [graph, csv] = [&graph, &csv].map(|path| path.to_str().unwrap());
        let sizes = ["--nodes", "7-9", "--pieces", "3", "--csv", csv];
        let lines = experiment(&[&["thin", graph], &sizes[..]].concat());
        assert_eq!(lines.len(), 5);
        assert_eq!(lines[4][..3], ["3", "pieces;", "solutions:"]);
        let table = std::fs::read_to_string(csv).unwrap();
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        table.lines().skip(1).map(cells).collect::<Vec<_>>()
    };
    let [one, two] = ["one.csv", "two.csv"].map(rows);
    for (one, two) in one.iter().zip(&two) {
        // All but the seconds.
        assert_eq!((&one[..7], &one[8]), (&two[..7], &two[8]));
        let nodes: usize = one[2].parse().unwrap();
        assert_eq!(one[3].parse(), Ok(nodes * (nodes - 1) / 2));
        let thin = viewcert::graph::graph6::decode(one[8].as_bytes()).unwrap();
        assert_eq!(
            (thin.nodes(), one[4].parse()),
            (nodes, Ok(thin.edges().len()))
        );
        assert!((7..=9).contains(&nodes) && 7 * thin.edges().len() >= 11 * nodes - 15);
    }
    assert_eq!((one.len(), two.len()), (3, 3));
}

/// A second scene in front of its cameras is checked by a script that shares nothing with the program: by
/// fractions, with points that both scenes show at the same places of all images.
#[test]
#[ignore = "needs python3"]
fn a_second_scene_to_look_at() {
    let folder = tempfile::tempdir().unwrap();
    let graphs = folder.path().join("graphs.g6");
    // The second graph is one body.
    std::fs::write(&graphs, "HBQkcP_\nD]o\n").unwrap();
    let run = workshop(&["scenes", graphs.to_str().unwrap()]);
    assert_eq!(run.code, 0, "{}", run.err);
    let lines = run.json();
    let [found, none] = &lines[..] else {
        panic!("{}", run.out)
    };
    assert_eq!(found["numbers"], serde_json::json!([[2, 1], [2, 2]]));
    assert_eq!(none["numbers"], serde_json::json!([]));
    assert!(none["scene"].is_null() && none["picture"].is_null());
    // Nine cameras and a point for each of twelve pairs, twice.
    let picture = found["picture"].as_str().unwrap();
    assert_eq!(picture.matches("<circle").count(), 2 * (9 + 12));
    assert_eq!(picture.matches("<line").count(), 2 * 24);

    let line = folder.path().join("line.json");
    let script = crate::common::root().join("lab/tests/second_scene.py");
    let checked = |found: &serde_json::Value| {
        std::fs::write(&line, found.to_string()).unwrap();
        let mut python = crate::common::python();
        let run = python.arg(&script).arg(&line).output().unwrap();
        let said = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
        (run.status.code(), said.concat())
    };
    let (code, said) = checked(found);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.starts_with("12 pairs see the same images"), "{said}");
    let rejected = |place: &str, value: serde_json::Value, words: &str| {
        let mut other = found.clone();
        *other.pointer_mut(place).unwrap() = value;
        let (code, said) = checked(&other);
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains(words), "{words}: {said}");
    };
    let entry = "/scene/second/0/0/0";
    rejected(
        entry,
        serde_json::json!(["7"]),
        "another fundamental matrix",
    );
    rejected(
        "/edges/0",
        serde_json::json!([0, 1]),
        "another fundamental matrix",
    );
    // With two centres behind others no plane but a suitable one will do.
    let plane = serde_json::json!([1, 0, 0, 0]);
    let words = "no point is in front of both cameras of some pair";
    rejected("/scene/plane", plane, words);
}
