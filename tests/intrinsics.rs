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

/// Two triangles with one camera, and a pair that hangs on; `t` and `u` are images of one phone.
const MIXED: &str = "a b\na c\nb c\nc t\nc u\nt u\nu e\n";
const CLASSES: &str = "focal+point a\nfocal+point b\nshared unknown t u\ndefault unknown\n";

#[test]
fn a_prior_does_what_it_is_said_to_do() {
    let run = with(MIXED, CLASSES, &["advise", "--json"]);
    let found = intrinsics(&run);
    let priors = &found["priors"];
    assert_eq!(priors["if_all_known"], "not-metric");
    let each = priors["each"].as_array().unwrap();
    assert_eq!(priors["sensors"], each.len());
    // What the decision says once they are known, by another way.
    for prior in each {
        let labels = prior["labels"].as_array().unwrap();
        let labels: Vec<&str> = labels.iter().map(|label| label.as_str().unwrap()).collect();
        let of = labels.join(" ");
        let lines = CLASSES.lines().filter(|line| !line.ends_with(&of));
        let then = format!("known {of}\n{}\n", lines.collect::<Vec<_>>().join("\n"));
        let then = intrinsics(&with(MIXED, &then, &["--json"]));
        for name in [
            "verdict",
            "proved",
            "rank",
            "rank_at_most",
            "rank_required",
            "determined",
        ] {
            assert_eq!(prior[name], then[name], "{name}: {labels:?}");
        }
        let largest = &then["components"][0]["nodes"];
        assert_eq!(
            prior["largest"].as_u64().unwrap(),
            largest.as_u64().unwrap_or(0)
        );
        let own = labels.len() as u64;
        let before = found["determined"].as_u64().unwrap();
        let after = then["determined"].as_u64().unwrap();
        assert_eq!(
            prior["others"].as_u64().unwrap(),
            after - before - own,
            "{labels:?}"
        );
    }
    // By Theorem 17.12: c and each of a and b (5 and 2 and 2 conditions) make one triangle metric, c and
    // the phone (5 and 5) the other one.
    let labels = serde_json::json!(["c"]);
    let of_c = each.iter().find(|prior| prior["labels"] == labels).unwrap();
    assert_eq!((&of_c["others"], &of_c["largest"]), (&4.into(), &3.into()));
    // No more than are asked for.
    let run = with(MIXED, CLASSES, &["advise", "--json", "--suggest=1"]);
    assert_eq!(
        intrinsics(&run)["priors"]["each"].as_array().unwrap().len(),
        1
    );
}

#[test]
fn advice_on_priors_is_in_words() {
    let run = with(TRIANGLE, "known a\n", &["advise"]);
    assert_eq!(run.code, 1);
    for words in [
        "suggested   to calibrate one more (the best of 2 sensors that are not determined; 1 other is as good as the first):",
        "    all five intrinsics of b: metric, all cameras and intrinsics (proved)",
    ] {
        assert!(run.out.contains(words), "{words}: {}", run.out);
    }
    let said = |graph: &str, classes: &str, words: &str| {
        let run = with(graph, classes, &["advise"]);
        assert!(run.out.contains(words), "{words}: {}", run.out);
    };
    said(
        TRIANGLE,
        "default known\n",
        "nothing to calibrate: the graph is metric",
    );
    // A path of known cameras: their scales are not determined, and no prior changes that.
    let path = "a b\nb c\n";
    said(
        path,
        "default known\n",
        "nothing to calibrate: all intrinsics are determined",
    );
    said(
        path,
        "default known\n",
        "with all intrinsics known it is not metric either (proved)",
    );
    // Of three, two have to be known.
    said(
        TRIANGLE,
        "default unknown\n",
        "none alone determines anything else: it takes several",
    );
    for option in ["--weak", "--explain=a"] {
        let run = with(TRIANGLE, "known a\n", &["advise", option]);
        assert_eq!(run.code, 2, "{option}");
        let name = option.split('=').next().unwrap();
        assert!(
            run.err
                .contains(&format!("--intrinsics: {name} weighs pairs")),
            "{}",
            run.err
        );
    }
}
