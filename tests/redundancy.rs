//! What a graph can notice, through the real binary: what the rest checks of each pair, what may be
//! lost, what is determined though never matched.

use crate::common::schema::keeps_to;
use crate::common::{verify, verify_with};
use serde_json::{Value, json};

/// A complete graph on six images, and on it an image with two pairs, one with one, and a triangle
/// that shares an image.
const GRAPH: &[u8] = b"a b\na c\na d\na e\na f\nb c\nb d\nb e\nb f\nc d\nc e\nc f\nd e\nd f\ne f\n\
    a two\nb two\na one\nc p\nc q\np q\n";

fn report(graph: &[u8], options: &[&str]) -> Value {
    let run = verify_with(graph, &[&["advise", "-", "--json"], options].concat());
    keeps_to("report", &run, &["program", "graph", "verdict"]).remove(0)
}

fn text(graph: &[u8], options: &[&str]) -> String {
    verify_with(graph, &[&["advise", "-"], options].concat()).out
}

/// Without its other pair the image `two` would have one: 7 of the 11 that a camera takes, so 4 of the
/// 7 equations of each of the two are needed, and 3 tell nothing new. In the calibrated model 1 of 2;
/// in the affine one both pairs are needed, and so are those of the triangle.
#[test]
fn surplus_by_hand() {
    let expected = [
        ("projective", 7, 15, vec![(0, 1), (3, 5)], [1, 5]),
        ("calibrated", 2, 15, vec![(0, 1), (1, 5)], [1, 5]),
        ("affine", 4, 15, vec![(0, 6)], [6, 0]),
    ];
    for (model, full, checked, of, [alone, _]) in expected {
        let line = report(GRAPH, &["--surplus", "--model", model]);
        let surplus = &line["surplus"];
        assert_eq!(surplus["full"], full, "{model}");
        assert_eq!(surplus["checked"], checked, "{model}");
        let items = surplus["items"].as_array().unwrap();
        for (value, count) in &of {
            let with = items.iter().filter(|item| item["surplus"] == *value);
            assert_eq!(with.count(), *count, "{model} {value}");
        }
        assert_eq!(
            items.len(),
            of.iter().map(|(_, count)| count).sum::<usize>()
        );
        assert!(items.iter().all(|item| item["strength"] == "proof"));
        assert_eq!(surplus["groups"]["alone"], alone, "{model}");
        assert_eq!(surplus["groups"]["strength"], "proof");
    }
    let line = report(GRAPH, &["--surplus"]);
    // The triangle by itself; the others with the pairs of `two`.
    let larger = json!([{ "pairs": 17, "images": 7 }, { "pairs": 3, "images": 3 }]);
    assert_eq!(line["surplus"]["groups"]["larger"], larger);
    let said = text(GRAPH, &["--surplus"]);
    for line in [
        "  surplus     15 pairs checked by the rest in all 7 equations if every other pair is right (proved)\n",
        "    5 pairs checked in 3 of 7\n",
        "    by the rest each has finitely many values, if not one: a small error shows\n",
        "    1 pair that nothing checks: an error there cannot be seen by anyone\n      a one\n",
        "    2 groups of pairs that check each other and nothing else; the largest has 17 pairs of 7 images\n",
    ] {
        assert!(said.contains(line), "{line}{said}");
    }
}

#[test]
fn what_may_be_lost() {
    let all: Vec<u32> = (0..7).collect();
    let complete: String = all
        .iter()
        .flat_map(|i| {
            all[*i as usize + 1..]
                .iter()
                .map(move |j| format!("{i} {j}\n"))
        })
        .collect();
    for weak in ["--weak", "--weak=images"] {
        let line = report(complete.as_bytes(), &[weak]);
        assert_eq!(line["weak"]["items"], json!([]));
        assert_eq!(line["weak"]["kept"], "finite-solvable");
    }
    // One pair of the image with two, and of the triangle.
    let first = |graph: &[u8], weak: &str, component: u32| {
        let line = report(graph, &[weak]);
        let items = line["weak"]["items"].as_array().unwrap().clone();
        let mut items = items.into_iter();
        let item = items.find(|item| item["component"] == component).unwrap();
        item["images"].clone()
    };
    assert_eq!(first(GRAPH, "--weak", 1), json!(["a", "two"]));
    assert_eq!(first(GRAPH, "--weak", 2), json!(["c", "p"]));
    assert_eq!(first(GRAPH, "--weak=images", 1), json!(["a"]));
    // Four images that are not all pairs: one is enough.
    let four = b"0 1\n0 2\n0 3\n1 2\n1 3\n";
    assert_eq!(first(four, "--weak=images", 1), json!(["0"]));
}

/// Both diagonals of the 4-cycle that psi holds, and no component has them.
#[test]
fn implied_pairs_beyond_components() {
    let run = verify(&["advise", "examples/psi.txt", "--implied", "--json"]);
    let line = keeps_to("report", &run, &["program", "graph", "verdict"]).remove(0);
    let expected = json!({
        "count": 2,
        "beyond_components": 2,
        "sets": [{ "images": 4, "implied": 2 }],
        "pairs": [["0", "2"], ["9", "10"]],
        "all_listed": true,
        "unique": false,
        "strength": "proof",
        "complete": "proof",
    });
    assert_eq!(line["implied"], expected);
    // The image with two pairs has four more in its component.
    let line = report(GRAPH, &["--implied=2"]);
    assert_eq!(line["implied"]["count"], 4);
    assert_eq!(line["implied"]["beyond_components"], 0);
    assert_eq!(
        line["implied"]["pairs"],
        json!([["c", "two"], ["d", "two"]])
    );
    assert_eq!(line["implied"]["all_listed"], false);
    let said = text(GRAPH, &["--implied"]);
    let expected =
        "  implied     4 pairs determined though not in the graph (proved, and no others)\n";
    assert!(said.contains(expected), "{said}");
}

/// Two solutions, as 9 cameras with 12 pairs have them: a pair that is implied has two values, and to add it leaves one.
const TWO: &str = "1 3\n1 4\n2 5\n3 5\n2 6\n4 6\n0 7\n4 7\n5 7\n0 8\n3 8\n6 8\n";

#[test]
fn implied_pairs_have_finitely_many_values() {
    let solutions = |graph: &str| {
        let run = verify_with(graph.as_bytes(), &["-", "--json", "--solutions=full"]);
        run.json()[0]["solutions"]["exactly"].clone()
    };
    assert_eq!(solutions(TWO), 2);
    let line = report(TWO.as_bytes(), &["--implied"]);
    assert_eq!(line["implied"]["count"], 24);
    assert_eq!(line["implied"]["unique"], false);
    let pairs = line["implied"]["pairs"].as_array().unwrap();
    assert!(pairs.contains(&json!(["0", "1"])), "{line}");
    assert_eq!(solutions(&format!("{TWO}0 1\n")), 1);
    let said = text(TWO.as_bytes(), &["--implied"]);
    let expected = "implied     24 pairs determined up to finitely many values though not in the graph (proved,";
    assert!(said.contains(expected), "{said}");
    // Unique graphs and components, and models in which finite means unique.
    let unique: [(&[u8], &[&str]); 3] = [
        (GRAPH, &["--implied"]),
        (b"0 1\n0 2\n1 2\n1 3\n2 3\n", &["--implied"]),
        (TWO.as_bytes(), &["--implied", "--model", "calibrated"]),
    ];
    for (graph, options) in unique {
        assert_eq!(report(graph, options)["implied"]["unique"], true);
        assert!(text(graph, options).contains("determined though not in the graph"));
    }
}

/// Each pair of `TWO` inside a K_4 of its own, and one implied pair: unique. Whichever pair is lost it stays finite
/// solvable, but without the implied one there are two solutions.
#[test]
fn what_is_kept_is_finite_solvability() {
    let mut graph = "# viewcert pairs\n".to_owned();
    for pair in TWO.lines() {
        let (a, b) = pair.split_once(' ').unwrap();
        let nodes = [
            a.to_owned(),
            b.to_owned(),
            format!("u{a}{b}"),
            format!("v{a}{b}"),
        ];
        for (k, one) in nodes.iter().enumerate() {
            for other in &nodes[..k] {
                graph += &format!("{one} {other}\n");
            }
        }
    }
    let decided = |graph: &str| {
        verify_with(graph.as_bytes(), &["-", "--json"])
            .json()
            .remove(0)
    };
    assert_eq!(decided(&graph)["solutions"]["exactly"], 2);
    graph += "0 1\n";
    assert_eq!(decided(&graph)["verdict"], "solvable");
    let options = ["--weak", "--surplus"];
    let line = report(graph.as_bytes(), &options);
    assert_eq!(line["weak"]["items"], json!([]));
    assert_eq!(line["weak"]["kept"], "finite-solvable");
    let said = text(graph.as_bytes(), &options);
    for words in [
        "weak        none found\n    without any other one it stays finite solvable, if not unique\n",
        "surplus     73 pairs checked by the rest in all 7 equations if every other pair is right (proved)\n    by the rest each has finitely many values",
    ] {
        assert!(said.contains(words), "{words}{said}");
    }
    let run = verify_with(
        graph.as_bytes(),
        &["advise", "-", "--weak", "--model", "affine"],
    );
    assert!(!run.out.contains("if not unique"), "{}", run.out);
    let line = report(graph.as_bytes(), &["--weak", "--model", "calibrated"]);
    assert_eq!(line["weak"]["kept"], "solvable");
}

/// A pair of a cycle of four calibrated cameras adds rank 2 of the 5 of an essential matrix (an independent rank, with
/// rotations, centres and focal lengths unknown): both are those of its direction, and a loop shows its rotation.
#[test]
fn calibrated_surplus_is_about_directions() {
    for model in ["calibrated", "focal"] {
        let cycle = b"0 1\n1 2\n2 3\n3 0\n";
        let line = report(cycle, &["--surplus", "--model", model]);
        let surplus = &line["surplus"];
        assert_eq!(surplus["equations_of"], "direction");
        assert_eq!(
            (&surplus["full"], &surplus["checked"]),
            (&json!(2), &json!(0))
        );
        let said = text(cycle, &["--surplus", "--model", model]);
        let words = "0 pairs checked by the rest in all 2 equations of its direction if every other pair is right (proved)\n    4 pairs whose direction nothing \
                     checks: an error in it cannot be seen by anyone; loops of pairs check rotations\n";
        assert!(said.contains(words), "{said}");
        let said = text(
            b"0 1\n1 2\n2 3\n3 0\n0 2\n1 3\n",
            &["--surplus", "--model", model],
        );
        assert!(
            said.contains("    none whose direction nothing checks\n"),
            "{said}"
        );
    }
    let line = report(TWO.as_bytes(), &["--surplus"]);
    assert_eq!(line["surplus"]["equations_of"], "fundamental matrix");
    let line = report(TWO.as_bytes(), &["--surplus", "--model", "affine"]);
    assert_eq!(line["surplus"]["equations_of"], "affine fundamental matrix");
}

/// Observations are pairs with two equations; what is implied is said of cameras alone.
#[test]
fn observations_by_hand() {
    // Three cameras that see four points each, the last point seen by two of them.
    let mut lines = String::new();
    for camera in 0..3 {
        for point in 0..4 {
            lines += &format!("{camera} {point} 0.5 0.5\n");
        }
    }
    lines += "0 4 0.5 0.5\n1 4 0.5 0.5\n";
    let problem = format!("3 5 14\n{lines}{}", "0.5\n".repeat(3 * 9 + 5 * 3));
    let asked = ["--tracks", "--min-views", "2", "--surplus", "--implied"];
    let line = report(problem.as_bytes(), &asked);
    assert_eq!(line["surplus"]["of"], "observations");
    // 4 equations for the 3 of the point: one of them is checked.
    let items = line["surplus"]["items"].as_array().unwrap();
    assert_eq!(items.len(), 2);
    assert!(items.iter().all(|item| item["surplus"] == 1));
    assert_eq!(line["surplus"]["checked"], 12);
    assert_eq!(line["implied"]["count"], 3);
    let said = verify_with(problem.as_bytes(), &[&["advise", "-"], &asked[..]].concat()).out;
    assert!(said.contains("3 pairs of cameras determined"), "{said}");
}

#[test]
fn known_parts_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let given = folder.path().join("given.txt");
    std::fs::write(&given, "part a b c\n").unwrap();
    let page = folder.path().join("page.html");
    let [given, page] = [given, page].map(|path| path.to_str().unwrap().to_owned());
    let run = verify_with(GRAPH, &["draw", "-", &page, "--surplus", "--given", &given]);
    assert_eq!(run.code, 2, "{}", run.out);
    assert!(
        run.err
            .contains("--surplus weighs the pairs of a graph alone"),
        "{}",
        run.err
    );
}
