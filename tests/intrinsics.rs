//! Classes of cameras through the real binary.

use crate::common::{Run, samples, verify, verify_with};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// `verify` on a graph with classes, in a folder of their own.
fn with(graph: &str, classes: &str, more: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let (graph, classes) = (path("graph.txt", graph), path("classes.txt", classes));
    // A command comes first.
    let (command, more) = more.split_at(usize::from(more.first() == Some(&"advise")));
    let words = [&graph, "--intrinsics", &classes];
    verify(&[command, &words[..], more].concat())
}

fn intrinsics(run: &Run) -> Value {
    let line: Value = serde_json::from_str(run.out.trim()).unwrap();
    let schema = include_str!("../docs/report.schema.json");
    let schema = jsonschema::validator_for(&serde_json::from_str(schema).unwrap()).unwrap();
    let found: Vec<String> = schema.iter_errors(&line).map(|e| e.to_string()).collect();
    assert!(found.is_empty(), "{found:?}: {line}");
    line["intrinsics"].clone()
}

const TRIANGLE: &str = "a b\na c\nb c\n";

#[test]
fn two_known_cameras_make_a_triangle_metric() {
    let run = with(TRIANGLE, "known a b\n", &["--components"]);
    assert_eq!(run.code, 0, "{}", run.err);
    for line in [
        "2 known, 1 unknown: metric: all cameras and intrinsics",
        "metric rank 16 of 16 (proved)",
        "determined  the intrinsics of 3 of 3",
        "metric component 1: a b c",
        "classes     SHA-256 ",
        "1 camera of no class: taken for unknown",
    ] {
        assert!(run.out.contains(line), "{line}: {}", run.out);
    }
    // One known camera leaves 3 of the 8 numbers between a projective and a metric scene.
    let run = with(TRIANGLE, "known a\n", &["--json"]);
    assert_eq!(run.code, 1);
    let found = intrinsics(&run);
    assert_eq!(
        (&found["rank"], &found["rank_required"]),
        (&18.into(), &21.into())
    );
    assert_eq!(found["verdict"], "not-metric");
    assert_eq!(found["not_determined"], serde_json::json!(["b", "c"]));
}

#[test]
fn a_metric_answer_is_the_exit_code() {
    // Finite solvable, and not metric; not finite solvable, and metric.
    let run = with(TRIANGLE, "default focal+point\n", &[]);
    assert_eq!(run.code, 1);
    assert!(run.out.contains("verdict     solvable"), "{}", run.out);
    let cycle = "a b\nb c\nc d\nd a\n";
    let run = with(cycle, "default known\n", &[]);
    assert_eq!(run.code, 0, "{}", run.out);
    assert!(
        run.out.contains("verdict     not-finite-solvable"),
        "{}",
        run.out
    );
    // The same as the calibrated model, also where cameras hang on one pair.
    let run = with("a b\nb c\nc d\nd a\nd e\n", "default known\n", &["--json"]);
    assert_eq!(run.code, 1);
    let found = intrinsics(&run);
    assert_eq!(found["determined"], 5);
    assert_eq!(found["components"][0]["nodes"], 4);
    assert_eq!(found["components"][1]["edges"], 1);
}

#[test]
fn what_does_not_go_with_classes_is_refused() {
    for (more, why) in [
        (&["--model", "calibrated"][..], "--model says it of all"),
        (&["--model", "affine"], "--model says it of all"),
        (&["--given", "parts.txt"], "leave out --given"),
        (&["--planar"], "in a plane"),
        (&["--method", "matrix"], "leave out --method matrix"),
        (
            &["--proof", "p.txt"],
            "explicit proofs do not state classes",
        ),
        (&["--table"], "a table has no columns"),
    ] {
        let run = with(TRIANGLE, "default known\n", more);
        assert_eq!(run.code, 2, "{more:?}");
        assert!(run.err.contains(why), "{more:?}: {}", run.err);
    }
    let run = with(TRIANGLE, "known a\nfocal x\n", &[]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("classes.txt:2: "), "{}", run.err);
    let run = verify_with(TRIANGLE.as_bytes(), &["-", "--intrinsics", "-"]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("standard input is the graph already"),
        "{}",
        run.err
    );
}

#[test]
fn images_of_one_sensor_calibrate_it() {
    // Three images with all five unknown; each with its own says nothing about a projective triangle.
    let run = with(TRIANGLE, "shared unknown a b c\n", &["--components"]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    for line in [
        "  intrinsics  3 unknown: metric: all cameras and intrinsics",
        "  shared      1 sensor: 3 unknown (determined)",
        "  metric rank 16 of 16 (proved)",
        "  sensor 1: a b c",
        "images of one sensor have the same intrinsics",
    ] {
        assert!(run.out.contains(line), "{line}: {}", run.out);
    }
    assert_eq!(with(TRIANGLE, "default unknown\n", &[]).code, 1);
    // Two images put 5 of 8 conditions: 18 + 10 - 7 less the 3 that are left.
    let run = with(TRIANGLE, "shared unknown a b\n", &["--json"]);
    assert_eq!(run.code, 1);
    let found = intrinsics(&run);
    assert_eq!(
        (&found["rank"], &found["conditions"]),
        (&18.into(), &5.into())
    );
    assert_eq!(
        found["shared"],
        serde_json::json!([{"class": "unknown", "cameras": 2, "determined": false}])
    );
    let run = with(TRIANGLE, "shared unknown a b\n", &[]);
    assert!(
        run.out
            .contains("known and shared intrinsics put 5 conditions on the 8 numbers"),
        "{}",
        run.out
    );
    // A path of four: K is determined by three pairs, the scales are not.
    let run = with("a b\nb c\nc d\n", "default shared unknown\n", &["--json"]);
    assert_eq!(run.code, 1);
    let found = intrinsics(&run);
    assert_eq!(found["determined"], 4);
    assert_eq!(found["shared"][0]["determined"], true);
    assert_eq!(found["components"].as_array().unwrap().len(), 3);
}

#[test]
#[ignore = "needs samples"]
fn databases_know_which_camera_took_an_image() {
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("banana.db");
    fs::copy(samples().join("photos_banana.db"), &copy).unwrap();
    let run = verify(&[copy.to_str().unwrap(), "--json", "--intrinsics", "free"]);
    let found = intrinsics(&run);
    // 16 images with one camera_id.
    assert_eq!(found["shared"][0]["cameras"], 16);
    assert_eq!(found["shared"][0]["determined"], true);
    assert_eq!(found["rank_required"], 6 * 16 + 1 - 7);
    assert!(
        run.out
            .contains("images with one camera_id have the same intrinsics (1 shared sensor)"),
        "{}",
        run.out
    );
    let run = verify(&[copy.to_str().unwrap(), "--json", "--intrinsics"]);
    assert!(intrinsics(&run).get("shared").is_none());
}

#[test]
#[ignore = "needs samples"]
fn databases_know_their_focal_lengths() {
    let database = samples().join("photos_lund.db");
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("lund.db");
    fs::copy(&database, &copy).unwrap();
    let name = |path: &Path| path.to_str().unwrap().to_owned();
    let with =
        |more: &[&str]| verify(&[&[name(&copy).as_str(), "--json", "--intrinsics"], more].concat());
    let known = intrinsics(&with(&[]));
    assert_eq!(known["classes"][0]["cameras"], 29);
    let free = intrinsics(&with(&["free"]));
    assert_eq!(free["classes"][1]["cameras"], 29);
    assert_eq!(
        (&known["verdict"], &free["verdict"]),
        (&"metric".into(), &"metric".into())
    );
    assert_eq!(free["rank_required"], 29 * 7 - 7);
    // A graph of other names, and an input that is no database.
    let text = folder.path().join("pairs.txt");
    fs::write(&text, "a b\nb c\n").unwrap();
    let run = verify(&[&name(&text), "--intrinsics", &name(&copy)]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("has no image `a`"), "{}", run.err);
    let run = verify(&[&name(&text), "--intrinsics"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("no COLMAP database"), "{}", run.err);
}
