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
    for lost in ["1", "images:1"] {
        let line = report(complete.as_bytes(), &["--redundant", lost]);
        let of = if lost.starts_with('i') {
            "images"
        } else {
            "pairs"
        };
        let expected = json!({ "of": of, "lost": 1, "stay": 1, "broken": [] });
        assert_eq!(line["redundant"], expected);
    }
    let said = text(complete.as_bytes(), &["--redundant", "1"]);
    let expected = "  redundant   1 component: whole whichever pair is lost (proved)\n";
    assert!(said.contains(expected), "{said}");
    // One pair of the image with two, and of the triangle.
    let line = report(GRAPH, &["--redundant", "1"]);
    let broken = &line["redundant"]["broken"];
    assert_eq!(broken[0]["without"], json!([["a", "two"]]));
    assert_eq!(broken[1]["without"], json!([["c", "p"]]));
    assert_eq!(line["redundant"]["stay"], 0);
    let said = text(GRAPH, &["--redundant", "images:1"]);
    assert!(
        said.contains("component 1 falls apart without a\n"),
        "{said}"
    );
    // Four images that are not all pairs: one is enough.
    let line = report(b"0 1\n0 2\n0 3\n1 2\n1 3\n", &["--redundant", "images:1"]);
    assert_eq!(line["redundant"]["broken"][0]["without"], json!([["0"]]));
    let run = verify_with(GRAPH, &["advise", "-", "--redundant", "2"]);
    assert_eq!(run.code, 2);
    assert!(
        run.err
            .contains("1 pair, or images:1; of two, leave out each pair in turn"),
        "{}",
        run.err
    );
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
    let asked = [
        "--tracks",
        "--min-views",
        "2",
        "--surplus",
        "--implied",
        "--redundant",
        "1",
    ];
    let line = report(problem.as_bytes(), &asked);
    assert_eq!(line["surplus"]["of"], "observations");
    // 4 equations for the 3 of the point: one of them is checked.
    let items = line["surplus"]["items"].as_array().unwrap();
    assert_eq!(items.len(), 2);
    assert!(items.iter().all(|item| item["surplus"] == 1));
    assert_eq!(line["surplus"]["checked"], 12);
    assert_eq!(line["implied"]["count"], 3);
    assert_eq!(line["redundant"]["of"], "observations");
    assert_eq!(line["redundant"]["broken"].as_array().unwrap().len(), 1);
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
