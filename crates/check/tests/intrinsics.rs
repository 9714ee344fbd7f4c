//! Certificates of intrinsics: what is verified, and each condition of section 15 broken once.

use crate::changes::{self, answer, rejected as refused};
use serde_json::{Value, json};
use viewcert_check::{Answer, Certificate, Expected, Failure, Limits, VerifiedIntrinsics};

fn named(name: &str) -> Value {
    changes::named(&format!("../intrinsics/{name}"))
}

fn check(document: &Value) -> Result<VerifiedIntrinsics, Failure> {
    match answer(document, None)? {
        Answer::Intrinsics(verified) => Ok(*verified),
        other => panic!("{other}"),
    }
}

/// In what a certificate differs from one for classes with a hash.
fn differences(document: &Value, classes: &str) -> String {
    let expected = Expected {
        classes: Some(classes.into()),
        ..Expected::default()
    };
    let answer = answer(document, None).unwrap();
    expected.differences(&answer).join("; ")
}

/// A certificate with another value at the place of a JSON pointer.
fn changed(name: &str, pointer: &str, value: Value) -> Value {
    changes::changed(&format!("../intrinsics/{name}"), &[(pointer, value)])
}

/// Ranks, components and nodes are those of the differential of K [R | -R c], by
/// `intrinsics_by_force.py` beside this file.
#[test]
fn what_is_verified() {
    let pairs = vec![vec![0, 1], vec![0, 4], vec![1, 2], vec![2, 3], vec![3, 4]];
    for (name, numbers, components, free) in [
        ("pair", [7, 7, 10], vec![], vec![1]),
        ("pentagon", [22, 22, 23], pairs, vec![]),
        ("pendant", [23, 23, 27], vec![vec![0, 1, 2]], vec![3]),
        ("core", [88, 88, 90], vec![(0..9).collect()], vec![9]),
        (
            "mixed",
            [36, 36, 37],
            vec![vec![0, 1, 2, 3], vec![3, 4]],
            vec![],
        ),
        ("twins", [7, 7, 8], vec![], vec![0, 1]),
        (
            "phones",
            [49, 49, 68],
            vec![vec![0, 1, 2], vec![2, 3], vec![3, 4], vec![4, 5]],
            vec![7, 8, 9],
        ),
    ] {
        let verified = check(&named(name)).unwrap();
        let [least, most] = verified.rank;
        assert_eq!([least, most, verified.required], numbers, "{name}");
        assert_eq!(verified.verdict, "not-metric");
        assert_eq!(verified.components, Some(components), "{name}");
        assert_eq!(verified.not_determined, Some(free), "{name}");
    }
    let text = check(&named("pair")).unwrap().to_string();
    assert!(text.contains("intrinsics determined of 1 of 2"), "{text}");
    assert!(text.contains("(1 known, 1 unknown)"), "{text}");
}

/// The example of the page: two known cameras and their edge.
#[test]
fn by_hand() {
    let mut document = named("pair");
    document["classes"] = json!(["known", "known"]);
    document["rows"] = json!([]);
    document["cols"] = json!([]);
    document["motion"] = json!(vec!["0"; 7]);
    document["claim"] = json!({
        "verdict": "metric", "at_least": 5, "at_most": 5, "required": 5,
        "components": [[0, 1]], "not_determined": [],
    });
    let verified = check(&document).unwrap();
    assert_eq!(verified.verdict, "metric");
}

/// The example of the page: two cameras and their edge, of one sensor.
#[test]
fn by_hand_of_one_sensor() {
    let mut document = named("twins");
    document["classes"] = json!(["focal", "focal"]);
    document["rows"] = json!([]);
    document["cols"] = json!([]);
    document["motion"] = json!(vec!["0"; 7]);
    document["claim"] = json!({
        "verdict": "metric", "at_least": 6, "at_most": 6, "required": 6,
        "components": [[0, 1]], "not_determined": [],
    });
    let verified = check(&document).unwrap();
    assert_eq!((verified.verdict, verified.shared), ("metric", [1, 2]));
    assert!(verified.to_string().contains("(2 focal; 1 shared by 2)"));
    // Of two sensors they are metric as well, with one unknown more.
    document.as_object_mut().unwrap().remove("shared");
    refused("the rank is 7 to 7 of 7", &document);
}

/// What is shared: the certificate has sensors of two classes, one with a node in no edge.
#[test]
fn shared() {
    assert_eq!(
        named("phones")["shared"],
        json!([[0, 1, 2, 6], [3, 4], [8, 9]])
    );
    for (pointer, value, words) in [
        ("", json!([]), "`shared` is empty"),
        ("", Value::Null, "expected a list"),
        ("/0", json!(3), "expected"),
        ("/1/0", json!("3"), "expected"),
        ("/2/1", json!(10), "no increasing list of nodes"),
        ("/0/0", json!(-1), "out of range"),
        ("/1", json!([3]), "one node or none"),
        ("/0", json!([]), "one node or none"),
        ("/1", json!([4, 3]), "no increasing list of nodes"),
        ("/1", json!([3, 3]), "no increasing list of nodes"),
        (
            "",
            json!([[3, 4], [0, 1, 2, 6], [8, 9]]),
            "lists of `shared` are not increasing",
        ),
        ("/2", json!([4, 8]), "node 4 is in two lists of `shared`"),
        ("/1", json!([3, 5]), "nodes of two classes"),
    ] {
        let document = changed("phones", &format!("/shared{pointer}"), value);
        refused(words, &document);
    }
    refused(
        "known intrinsics are in a list of `shared`",
        &changed("phones", "/classes", json!(vec!["known"; 10])),
    );
    // Who shares is a hypothesis, and part of the hash.
    let own = check(&named("phones")).unwrap().classes_sha256;
    assert_eq!(differences(&named("phones"), &own), "");
    let alone = changed("phones", "/shared", json!([[0, 1, 2, 6], [3, 4]]));
    check(&alone).unwrap_err();
    check(&changed("phones", "/shared/0", json!([0, 1, 2]))).unwrap_err();
    let mut apart = named("twins");
    apart.as_object_mut().unwrap().remove("shared");
    check(&apart).unwrap_err();
}

/// Without a motion that tells something bounds leave a gap; with fewer pivots too. Then no more may be
/// claimed.
#[test]
fn less_evidence() {
    let length = named("mixed")["motion"].as_array().unwrap().len();
    let mut document = changed("mixed", "/motion", json!(vec!["0"; length]));
    refused("the verdict is open", &document);
    document["claim"] = json!({
        "verdict": "open", "at_least": 36, "at_most": 37, "required": 37,
        "components": null, "not_determined": null,
    });
    let verified = check(&document).unwrap();
    assert!(verified.components.is_none() && verified.to_string().contains("nothing"));
    for (name, words) in [
        ("components", "the metric components are others"),
        ("not_determined", "intrinsics are not determined are others"),
    ] {
        let mut more = document.clone();
        more["claim"][name] = json!([]);
        refused(words, &more);
    }
    let mut document = named("mixed");
    document["rows"].as_array_mut().unwrap().pop();
    document["cols"].as_array_mut().unwrap().pop();
    refused("the rank is 35 to 36 of 37", &document);
}

#[test]
fn the_document() {
    refused(
        "version 1 is not read any more; write the certificate anew",
        &changed("pair", "/version", json!(1)),
    );
    refused(
        "`format` is not",
        &changed(
            "pair",
            "/format",
            json!("viewcert certificate of intrinsics"),
        ),
    );
    refused(
        "does not belong there",
        &changed("pair", "/question", json!("generic")),
    );
    refused(
        "has another hash",
        &changed("pair", "/graph/sha256", json!("0".repeat(64))),
    );
    let mut more = named("pair");
    more["model"] = json!("projective");
    refused("`model` does not belong there", &more);
}

#[test]
fn classes() {
    refused(
        "1 classes for 2 nodes",
        &changed("pair", "/classes", json!(["known"])),
    );
    refused(
        "\"zoom\" is no class",
        &changed("pair", "/classes/1", json!("zoom")),
    );
    let hash = "bba58959e4a4a6ee8ab3e16ed4ab73a4bfec8bd0a1fbb2e8ae6f1a2e0ee5f1a5";
    let own = check(&named("pair")).unwrap().classes_sha256;
    let other = format!("classes of cameras are supposed with the SHA-256 {own}");
    assert_eq!(differences(&named("pair"), hash), other);
    assert_eq!(differences(&named("pair"), &own), "");
    // Other classes are another draw.
    assert!(check(&changed("mixed", "/classes/0", json!("known"))).is_err());
}

#[test]
fn a_graph_without_edges() {
    let graph = json!({"name": "", "nodes": 2, "edges": 0, "graph6": "A?", "sha256": EDGELESS});
    refused("the graph has no edge", &changed("pair", "/graph", graph));
}

/// The hash of two nodes without an edge.
const EDGELESS: &str = "fde8a7127cd10792b491c6e35516309602caf1bbc94418372b6549a2d2337e87";

#[test]
fn members() {
    // A cycle of four is no body, whether or not its edges are metric.
    let merge = json!([{"with": [[1, 2], [2, 3], [3, 4]], "at": [1, 2, 3, 4]}]);
    let body = json!({"seed": [0, 1], "add": [], "merge": merge});
    assert!(check(&changed("pentagon", "/bodies", json!([body]))).is_err());
    let mut twice = named("pendant");
    let second = json!({"seed": [0, 2], "add": [], "merge": []});
    twice["bodies"].as_array_mut().unwrap().push(second);
    refused("is covered by two bodies", &twice);
}

#[test]
fn pivots() {
    refused(
        "is not a prime",
        &changed("mixed", "/prime", json!("2305843009213693953")),
    );
    assert!(check(&changed("mixed", "/draw", json!(7))).is_err());
    let rows = named("mixed")["rows"].clone();
    refused(
        "different indices",
        &changed("mixed", "/rows/0", rows[1].clone()),
    );
    refused(
        "different indices",
        &changed("mixed", "/cols/0", json!(1_000_000)),
    );
    let mut document = named("mixed");
    document["rows"].as_array_mut().unwrap().pop();
    refused("pivot columns", &document);
    let mut document = named("pentagon");
    document["cols"].as_array_mut().unwrap().rotate_left(1);
    refused("vanishes", &document);
}

#[test]
fn the_motion() {
    let mut document = named("mixed");
    document["motion"].as_array_mut().unwrap().pop();
    refused("is no vector of", &document);
    refused(
        "is no vector of",
        &changed("mixed", "/motion/0", json!("2305843009213693951")),
    );
    refused(
        "is no kernel vector",
        &changed("mixed", "/motion/0", json!("5")),
    );
}

#[test]
fn the_claim() {
    for (pointer, value, words) in [
        ("verdict", json!("metric"), "the verdict is not-metric"),
        ("at_least", json!(35), "the rank is 36 to 36 of 37"),
        ("at_most", json!(37), "the rank is 36 to 36 of 37"),
        ("required", json!(36), "the rank is 36 to 36 of 37"),
        (
            "components",
            json!([[0, 1, 2, 3]]),
            "the metric components are others",
        ),
        ("components", Value::Null, "components are others"),
        (
            "not_determined",
            json!([4]),
            "intrinsics are not determined are others",
        ),
    ] {
        refused(
            words,
            &changed("mixed", &format!("/claim/{pointer}"), value),
        );
    }
}

/// What is too large for the limits is not rejected.
#[test]
fn limits() {
    let certificate = Certificate::parse(named("mixed").to_string().as_bytes()).unwrap();
    let limits = Limits {
        core: 1,
        ..Limits::default()
    };
    let failure = certificate.check(None, None, &limits).unwrap_err();
    assert!(matches!(failure, Failure::TooLarge(_)), "{failure}");
}
