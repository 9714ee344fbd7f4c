//! The camera models through the real binary: affine, in a plane, focal, and all side by side.

use crate::common::{cycle, data, verify, verify_with};
use serde_json::{Value, json};
use std::path::Path;
use viewcert::graph::{Adjacency, Graph, biconnected_components};
use viewcert_formats::{ReadOptions, read_graphs};

/// The first line says that these are pairs, however few or bipartite they are.
fn edge_list(pairs: impl IntoIterator<Item = (u32, u32)>) -> String {
    let line = |(i, j)| format!("{i} {j}\n");
    let head = "# viewcert pairs\n".to_owned();
    std::iter::once(head)
        .chain(pairs.into_iter().map(line))
        .collect()
}

fn complete(nodes: u32) -> impl Iterator<Item = (u32, u32)> {
    (0..nodes).flat_map(|j| (0..j).map(move |i| (i, j)))
}

fn bipartite(a: u32, b: u32) -> impl Iterator<Item = (u32, u32)> {
    (0..a).flat_map(move |i| (a..a + b).map(move |j| (i, j)))
}

/// Verdict, rank, required rank and number of components in the affine model.
fn affine(pairs: &str) -> (i32, String, [u64; 3]) {
    let run = verify_with(pairs.as_bytes(), &["-", "--json", "--model", "affine"]);
    let line = &run.json()[0];
    assert_eq!(line["model"], "affine");
    for strength in ["strength", "rank_strength", "components_strength"] {
        assert_eq!(line[strength], "proof");
    }
    let number = |name: &str| line[name].as_u64().unwrap();
    let components = line["components"].as_array().unwrap().len() as u64;
    (
        run.code,
        line["verdict"].as_str().unwrap().to_owned(),
        [number("rank"), number("rank_required"), components],
    )
}

/// Four times the rank in the plane, by hand: 8 n - 12 for Laman graphs; 4 for each edge where
/// nothing is rigid.
#[test]
fn affine_answers_by_hand() {
    let solvable = |code, verdict: &str| (code, verdict) == (0, "solvable");
    for (pairs, nodes) in [
        (edge_list([(0, 1)]), 2),
        (cycle(3), 3),
        (edge_list(complete(5)), 5),
        (edge_list(bipartite(3, 3)), 6),
        (edge_list(bipartite(4, 5)), 9),
    ] {
        let (code, verdict, ranks) = affine(&pairs);
        assert!(solvable(code, &verdict), "{pairs}");
        let full = 8 * nodes - 12;
        assert_eq!(ranks, [full, full, 1], "{pairs}");
    }
    // Cycles of four and five flex; K_4 with a pendant edge; K_{2,3} has six edges of seven.
    let pendant = edge_list(complete(4).chain([(3, 4)]));
    for (pairs, ranks) in [
        (cycle(4), [16, 20, 4]),
        (cycle(5), [20, 28, 5]),
        (pendant, [24, 28, 2]),
        (edge_list(bipartite(2, 3)), [24, 28, 6]),
    ] {
        let (code, verdict, found) = affine(&pairs);
        assert_eq!((code, verdict.as_str()), (1, "not-finite-solvable"));
        assert_eq!(found, ranks, "{pairs}");
    }
}

/// The kinds of evidence that docs/certificate.md names for the affine model.
#[test]
fn affine_certificates_hold_their_evidence() {
    let folder = tempfile::tempdir().unwrap();
    let kinds = |pairs: &str| -> Vec<String> {
        let path = folder.path().join("certificate.json");
        let path = path.to_str().unwrap();
        verify_with(
            pairs.as_bytes(),
            &["-", "--model", "affine", "--certificate", path],
        );
        let text = std::fs::read_to_string(path).unwrap();
        let value: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["model"], "affine");
        let pieces = value["pieces"].as_array().unwrap();
        let evidence = pieces
            .iter()
            .flat_map(|piece| piece["evidence"].as_array().unwrap());
        evidence
            .map(|evidence| evidence["kind"].as_str().unwrap().to_owned())
            .collect()
    };
    assert_eq!(kinds(&edge_list(bipartite(3, 3))), ["plane-minor"]);
    let flexible = ["plane-minor", "counting", "classes", "kernel"];
    assert_eq!(kinds(&cycle(4)), flexible);
}

/// What the verdict rests on is said as it is: nothing was counted where a camera has no pair.
#[test]
fn reasons_in_words() {
    let run = |pairs: &str| {
        let arguments = ["-", "--format", "edges", "--model", "affine"];
        verify_with(pairs.as_bytes(), &arguments).out
    };
    let out = run(&edge_list(bipartite(3, 3)));
    assert!(
        out.contains("full rank at drawn cameras modulo 2305843009213693951"),
        "{out}"
    );
    let out = run("0 1\n1 2\n0 2\n3\n");
    assert!(
        out.contains("because     some cameras have no pairs"),
        "{out}"
    );
    let out = run(&cycle(4));
    assert!(out.contains("counting allows rank 16 at most"), "{out}");
}

#[test]
fn what_the_affine_model_does_not_go_with() {
    for (more, words) in [
        (
            &["--rational"][..],
            "rational cameras: the affine model is decided by counting",
        ),
        (&["--method", "ranks"], "decided by counting alone"),
        (&["--planar"], "no centres"),
    ] {
        let arguments = [&["-", "--model", "affine"], more].concat();
        let run = verify_with(cycle(3).as_bytes(), &arguments);
        assert_eq!(run.code, 2);
        assert!(run.err.contains(words), "{}", run.err);
    }
    for options in [
        &["--planar"][..],
        &["--model", "affine"],
        &["--model", "focal"],
    ] {
        let run = verify(&[&["x", "--tracks"], options].concat());
        assert_eq!(run.code, 2, "{}", run.err);
    }
}

/// K_{2,3} has 5 nodes and 6 edges, one too few for the plane: 4 * 6 + 3 * 4 = 36 of 40, and
/// with known intrinsics 6 + 4 = 10 of 11. In space it is finite solvable, 7 * 6 >= 40.
#[test]
fn centres_in_a_plane() {
    let graph = edge_list(bipartite(2, 3));
    for (model, rank, required) in [("projective", 36, 40), ("calibrated", 10, 11)] {
        let plain = ["-", "--json", "--model", model];
        let run = verify_with(graph.as_bytes(), &plain);
        assert_eq!(run.code, 0);
        let line = &run.json()[0];
        assert_eq!(
            line["conditions"][0],
            "holds for centres in general position; if all lie in one plane: not"
        );
        assert_eq!(line["planar"]["verdict"], "not-finite-solvable");
        assert_eq!(line["planar"]["rank"], rank);
        assert_eq!(line["planar"]["rank_required"], required);
        let run = verify_with(graph.as_bytes(), &[&plain[..], &["--planar"]].concat());
        assert_eq!((run.code, &run.json()[0]["planar"]), (1, &line["planar"]));
        let run = verify_with(graph.as_bytes(), &["-", "--model", model, "--planar"]);
        let words = format!("infinitely many sets of cameras (proved), rank {rank} of {required}");
        assert!(run.out.contains(&words), "{}", run.out);
    }
    // A Laman graph is determined in the plane as well, and the plain verdict says no more.
    let graph = edge_list(bipartite(3, 3));
    for (model, verdict) in [("projective", "solvable"), ("calibrated", "solvable")] {
        let plain = ["-", "--json", "--model", model];
        let line = &verify_with(graph.as_bytes(), &plain).json()[0];
        assert!(line.get("planar").is_none() && line.get("conditions").is_none());
        let run = verify_with(graph.as_bytes(), &[&plain[..], &["--planar"]].concat());
        assert_eq!(run.code, 0);
        assert_eq!(run.json()[0]["planar"]["verdict"], verdict);
    }
    // A plane does not keep two optical axes from meeting, so the promise says it there too.
    let run = verify_with(graph.as_bytes(), &["-", "--model", "focal", "--planar"]);
    let words = "  in a plane  solvable: the cameras are unique if no pair has its optical axes in one plane (proved)";
    assert!(run.code == 0 && run.out.contains(words), "{}", run.out);
    // Two parts are not joined by a plane either: 4 * 2 + 3 * 2 = 14 of 29.
    let run = verify_with(
        edge_list([(0, 1), (2, 3)]).as_bytes(),
        &["-", "--json", "--planar"],
    );
    assert_eq!(
        (run.code, &run.json()[0]["planar"]["rank"]),
        (1, &14.into())
    );
}

#[test]
fn unknown_focal_lengths_are_decided_as_calibrated() {
    for pairs in [cycle(4), cycle(5)] {
        let line = |model| {
            let run = verify_with(pairs.as_bytes(), &["-", "--json", "--model", model]);
            (run.code, run.json().remove(0))
        };
        let (focal, calibrated) = (line("focal"), line("calibrated"));
        assert_eq!(focal.0, calibrated.0);
        for member in ["model", "verdict", "rank", "components"] {
            assert_eq!(focal.1[member], calibrated.1[member]);
        }
        let condition = focal.1["conditions"][0].as_str().unwrap();
        for words in [
            "square",
            "principal points",
            "optical axes do not lie in one plane",
        ] {
            assert!(condition.contains(words), "{condition}");
        }
    }
}

/// The 4-cycle: four edges in the affine and in the projective model, one body with known
/// intrinsics.
#[test]
fn all_models_side_by_side() {
    let run = verify_with(cycle(4).as_bytes(), &["models", "-"]);
    assert_eq!(run.code, 1);
    for line in [
        "  affine      not-finite-solvable, rank 16 of 20, 4 components (proved)",
        "  projective  not-finite-solvable, rank 28 of 29, 4 components (proved)",
        "  calibrated  solvable if the centres do not all lie in one plane, rank 8 of 8, 1 component (proved)",
        "calibrated component 1 (4 cameras) joins the projective components 1, 2, 3, 4 at 0, 1, 2, 3",
    ] {
        assert!(run.out.contains(line), "{line}\n{}", run.out);
    }
    let run = verify_with(cycle(4).as_bytes(), &["models", "-", "--json"]);
    let line = &run.json()[0];
    let names: Vec<_> = line["models"].as_array().unwrap().iter().collect();
    let names: Vec<_> = names.iter().map(|model| &model["model"]).collect();
    assert_eq!(names, ["affine", "projective", "calibrated"]);
    let solutions = |k: usize| &line["models"][k]["solutions"]["exactly"];
    assert_eq!([solutions(1), solutions(2)], [&json!(null), &json!(1)]);
    let changes = line["changes"].as_array().unwrap();
    assert_eq!(changes.len(), 1);
    assert_eq!(changes[0]["from"], "projective");
    assert_eq!(changes[0]["joins"], json!([1, 2, 3, 4]));
    assert_eq!(changes[0]["at"], json!(["0", "1", "2", "3"]));
    assert_eq!(verify_with(cycle(3).as_bytes(), &["models", "-"]).code, 0);
    // The condition that a single verdict states, in the promise itself: 10 of 11 in a plane.
    let graph = edge_list(bipartite(2, 3));
    let condition = "if the centres do not all lie in one plane";
    let run = verify_with(graph.as_bytes(), &["models", "-"]);
    let line = format!("  calibrated  solvable {condition}, rank 11 of 11, 1 component (proved)");
    assert!(run.out.contains(&line), "{}", run.out);
    let run = verify_with(graph.as_bytes(), &["models", "-", "--json"]);
    let conditions = [0, 1, 2].map(|k| run.json()[0]["models"][k]["condition"].clone());
    assert_eq!(
        conditions,
        [json!(null), json!(condition), json!(condition)]
    );
}

/// The induced subgraph on the largest biconnected component.
fn largest_block(graph: &Graph) -> Graph {
    let mut largest: Vec<u32> = Vec::new();
    biconnected_components(Adjacency::new(graph).lists(), |component| {
        if component.len() > largest.len() {
            largest = component.to_vec();
        }
    });
    largest.sort_unstable();
    let number = |v: u32| largest.binary_search(&v).ok().map(|k| k as u32);
    let pairs = graph.edges().iter();
    let pairs = pairs.filter_map(|&(i, j)| number(i).zip(number(j)));
    Graph::new(largest.len() as u32, pairs).unwrap()
}

/// Union Square: what the design measured with separate scripts, 9, 4 and 1 components.
#[test]
#[ignore = "needs data"]
fn union_square_in_all_models() {
    let data = data();
    let path = data.join("table3/Union_Square.mat");
    let input = read_graphs(Path::new(&path), &ReadOptions::default()).next();
    let block = largest_block(&input.unwrap().unwrap().graph);
    let pairs = edge_list(block.edges().iter().copied());
    let run = verify_with(pairs.as_bytes(), &["models", "-", "--json"]);
    let counts: Vec<usize> = run.json()[0]["models"]
        .as_array()
        .unwrap()
        .iter()
        .map(|model| model["components"].as_array().unwrap().len())
        .collect();
    assert_eq!(counts, [9, 4, 1]);
}

/// The components of each model are those of its own report, with how many solutions each has by itself: the graph
/// of the atlas with two, and a pair apart from it.
#[test]
fn components_of_models_are_those_of_reports() {
    let pairs = verify_with(b"HBQkcP_\n", &["convert", "-"]).out + "100 101\n";
    let line = verify_with(pairs.as_bytes(), &["models", "-", "--json", "--seed", "3"])
        .json()
        .remove(0);
    assert_eq!(line["seed"], 3);
    for of_model in line["models"].as_array().unwrap() {
        let model = of_model["model"].as_str().unwrap();
        let run = verify_with(
            pairs.as_bytes(),
            &["-", "--json", "--seed", "3", "--model", model],
        );
        let report = run.json().remove(0);
        for member in ["components", "verdict", "rank", "prime"] {
            assert_eq!(of_model[member], report[member], "{model}");
        }
    }
    assert_eq!(
        line["models"][1]["components"][0]["solutions"]["exactly"],
        2
    );
}
