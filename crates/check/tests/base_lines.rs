//! Certificates for unknown base lines: a change for each condition of section 13, with the reason that
//! must be given, as in `conditions.rs`. They are of the prover, chosen from its random graphs; their ranks
//! are held against brute force by the second checker's tests.

use crate::changes::{at, changed, named, refused, rejection};
use serde_json::{Value, json};
use viewcert_check::{BaseLines, Certificate, Graph, Limits, check};

fn file(name: &str) -> String {
    format!("../base_lines/{name}")
}

fn verified(name: &str) -> BaseLines {
    let text = named(&file(name)).to_string();
    let verified = check(text.as_bytes(), None).unwrap_or_else(|failure| panic!("{failure}"));
    verified.base_lines.unwrap()
}

fn refuse(name: &str, member: &str, value: Value, wanted: &str) {
    let (pointer, wanted) = (
        format!("/base_lines{member}"),
        format!("base_lines{wanted}"),
    );
    refused(&file(name), &[(&pointer, value)], &wanted);
}

#[test]
fn what_is_verified() {
    let (solvable, not) = ("solvable", "not-finite-solvable");
    for (name, value) in [
        ("turning", solvable),
        ("axis", solvable),
        ("group", solvable),
        ("part", solvable),
        ("scaled", solvable),
        ("apart", not),
        ("held", not),
        ("open", "open"),
    ] {
        let found = verified(name);
        assert_eq!(found.value(), value, "{name}");
        assert!(found.about_one_axis || name != "axis");
        let text = named(&file(name)).to_string();
        let lines = check(text.as_bytes(), None).unwrap().to_string();
        let line = format!(", SHA-256 {}", found.sha256);
        assert!(
            lines.contains("\nbase lines: ") && lines.ends_with(&line),
            "{lines}"
        );
    }
}

#[test]
fn both_have_the_member() {
    let wanted = "base_lines: claim and document have `base_lines`, or neither has";
    let mut value = named(&file("turning"));
    value.as_object_mut().unwrap().remove("base_lines");
    assert_eq!(rejection(&value, None), wanted);
    let mut value = named(&file("turning"));
    at(&mut value, "/claim")
        .as_object_mut()
        .unwrap()
        .remove("base_lines");
    assert_eq!(rejection(&value, None), wanted);
}

/// It is said of calibrated cameras alone, and not beside given vectors.
#[test]
fn other_models() {
    let added = named(&file("turning"));
    for (name, wanted) in [
        ("square", "base_lines: base lines in the projective model"),
        (
            "affine-square",
            "base_lines: base lines in the affine model",
        ),
        (
            "../displacements/parallel",
            "base_lines: base lines beside given vectors",
        ),
    ] {
        let mut value = named(name);
        value["base_lines"] = added["base_lines"].clone();
        value["claim"]["base_lines"] = added["claim"]["base_lines"].clone();
        assert_eq!(rejection(&value, None), wanted);
    }
}

#[test]
fn frames_are_those_that_are_given() {
    let value = named(&file("turning"));
    let text = value["graph"]["graph6"].as_str().unwrap();
    let graph = Graph::read(text.as_bytes(), || None).unwrap();
    let wanted = "base_lines: the frames are not those that are given: SHA-256 ";
    assert!(rejection(&value, Some(&graph)).starts_with(wanted));
    let others = graph.clone().with_frames("0".repeat(64));
    assert!(rejection(&value, Some(&others)).starts_with(wanted));
    let graph = graph.with_frames(verified("turning").sha256);
    assert!(check(value.to_string().as_bytes(), Some(&graph)).is_ok());
    // What rests on none may be checked with any.
    let mut value = value;
    value.as_object_mut().unwrap().remove("base_lines");
    at(&mut value, "/claim")
        .as_object_mut()
        .unwrap()
        .remove("base_lines");
    assert!(check(value.to_string().as_bytes(), Some(&graph)).is_ok());
}

#[test]
fn b1_and_b2_frames() {
    let frames = named(&file("turning"))["base_lines"]["frames"].clone();
    let (a, b) = (frames[0][0][0].clone(), frames[0][1][0].clone());
    refuse(
        "turning",
        "/frames",
        json!([]),
        ".frames: there is no frame",
    );
    refuse(
        "turning",
        "/frames/0/1",
        json!("remove"),
        ".frames: frame 0 has fewer than two images",
    );
    let images = json!([[b, 0], [a, 1]]);
    refuse(
        "turning",
        "/frames/0",
        images,
        ".frames: the images of frame 0 are not increasing",
    );
    refuse(
        "turning",
        "/frames/0/1/0",
        json!(10_000),
        ".frames: the graph has no node 10000",
    );
    let twice = format!(".frames: node {a} is an image twice");
    refuse("turning", "/frames/1/0/0", a, &twice);
    refuse(
        "turning",
        "/frames/0/1/1",
        json!(0),
        ".frames: sensor 0 is in frame 0 twice",
    );
    refuse(
        "turning",
        "/frames/0/0/1",
        json!(1),
        ".frames: sensor 1 occurs before sensor 0",
    );
    let turned: Vec<Value> = frames.as_array().unwrap().iter().rev().cloned().collect();
    let wanted = ".frames: the frames are not in the order of their first nodes";
    refuse("turning", "/frames", json!(turned), wanted);
    refuse(
        "turning",
        "/known",
        json!([0, 0]),
        ".frames: `known` is not increasing",
    );
    refuse(
        "turning",
        "/known",
        json!([7]),
        ".frames: the sensor 7 does not occur",
    );
    refuse(
        "turning",
        "/known",
        json!([0, 1]),
        ".frames: there is no unknown place",
    );
}

#[test]
fn b3_and_b5_lower_bounds() {
    for (name, kind) in [("turning", "lower"), ("axis", "one_axis")] {
        let refuse = |member: &str, value: Value, wanted: &str| {
            refuse(
                name,
                &format!("/{kind}{member}"),
                value,
                &format!(".{kind}: {wanted}"),
            );
        };
        refuse("/prime", json!("15"), "15 is not a prime");
        let count = named(&file(name))["base_lines"][kind]["rows"]
            .as_array()
            .unwrap()
            .len();
        let wanted = format!("{} pivot rows, but {count} pivot columns", count - 1);
        refuse("/rows/0", json!("remove"), &wanted);
        refuse(
            "/rows/0",
            json!(100_000),
            "the pivots are not different indices below",
        );
        refuse(
            "/cols/0",
            json!(100_000),
            "the pivots are not different indices below",
        );
        // Each column that the first pivot row does not have makes a pivot that vanishes.
        let swapped = (1..count).map(|k| {
            let mut value = named(&file(name));
            let cols = at(&mut value, &format!("/base_lines/{kind}/cols"));
            cols.as_array_mut().unwrap().swap(0, k);
            check(value.to_string().as_bytes(), None)
        });
        let wanted = format!("base_lines.{kind}: pivot 0 vanishes");
        let failed = swapped.filter_map(Result::err);
        let failed: Vec<String> = failed.map(|failure| failure.to_string()).collect();
        assert!(failed.contains(&wanted), "{failed:?}");
    }
    // A pivot less proves less than is claimed.
    let less = |kind: &str| {
        let mut value = named(&file("axis"));
        for list in ["rows", "cols"] {
            let list = at(&mut value, &format!("/base_lines/{kind}/{list}"));
            list.as_array_mut().unwrap().pop();
        }
        rejection(&value, None)
    };
    assert!(less("lower").starts_with("base_lines.claim: `at_least` is "));
    assert!(less("one_axis").starts_with("base_lines.one_axis: the rank is "));
}

/// Modulo 5 there are rotations without a length, and centres that agree.
#[test]
fn b3_void_draws() {
    let mut found = [false; 2];
    for seed in 0..300 {
        let changes = [
            ("/base_lines/lower/prime", json!("5")),
            ("/base_lines/lower/seed", json!(format!("{}", 1000 + seed))),
        ];
        let text = changed(&file("turning"), &changes).to_string();
        let Err(failure) = check(text.as_bytes(), None) else {
            continue;
        };
        let reason = failure.to_string();
        let words = [
            "a rotation has no length",
            "the ends of a pair have the same centre",
        ];
        for (found, words) in found.iter_mut().zip(words) {
            *found |= reason == format!("base_lines.lower: the draw is void: {words}");
        }
    }
    assert_eq!(found, [true; 2]);
}

#[test]
fn b4_upper_bounds() {
    let upper = &named(&file("held"))["base_lines"]["upper"];
    let (held, bound) = (&upper["held"][0], upper["bound"].as_i64().unwrap());
    let wanted = ".upper: `held` is not increasing";
    refuse("held", "/upper/held", json!([held, held]), wanted);
    let wanted = ".upper: a sensor of `held` has no unknown place";
    refuse("held", "/upper/held", json!([99]), wanted);
    refuse("held", "/upper/held", json!([0]), wanted);
    refuse("held", "/upper/held", json!([]), ".upper: the bound is ");
    refuse(
        "held",
        "/upper/bound",
        json!(bound - 1),
        ".upper: the bound is ",
    );
    refuse(
        "held",
        "/upper/blocks/0",
        json!("remove"),
        ".upper.blocks: ",
    );
    refuse(
        "held",
        "/upper/blocks/0",
        json!("repeat"),
        ".upper.blocks: ",
    );
    refuse("held", "/upper", Value::Null, ".claim: `at_most` is ");
}

#[test]
fn limits() {
    let text = named(&file("turning")).to_string();
    let certificate = Certificate::parse(text.as_bytes()).unwrap();
    // No free node is shared, and there are three frames and a place.
    for (core, fits) in [(3, false), (4, true)] {
        let limits = Limits {
            core,
            ..Limits::default()
        };
        assert_eq!(certificate.check(None, None, &limits).is_ok(), fits);
    }
}

#[test]
fn the_claim() {
    for (member, value, wanted) in [
        (
            "value",
            json!("open"),
            "`open` is claimed, but the evidence gives `solvable`",
        ),
        ("at_least", json!(1), "`at_least` is "),
        ("at_most", json!(1000), "`at_most` is "),
        ("required", json!(7), "`required` is "),
        (
            "about_one_axis",
            json!(true),
            "`about_one_axis` is there with `one_axis`",
        ),
        (
            "strength",
            json!("error-bound"),
            "the strength is not a proof",
        ),
        ("error_log2", json!(-120), "the strength is not a proof"),
    ] {
        let pointer = format!("/claim/base_lines/{member}");
        let wanted = format!("base_lines.claim: {wanted}");
        refused(&file("turning"), &[(&pointer, value)], &wanted);
    }
    let wrong = changed(
        &file("turning"),
        &[("/claim/base_lines/about_one_axis", json!(0))],
    );
    assert!(rejection(&wrong, None).contains("invalid type"));
}
