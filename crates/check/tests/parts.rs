//! Known parts: what is verified, and a change for each condition, with the reason that must be
//! given, as in `conditions.rs`.

use crate::changes::{changed, named, refused, rejection};
use serde_json::{Value, json};
use viewcert_check::{Graph, Verdict, Verified, check};

fn verified(value: &Value) -> Verified {
    check(value.to_string().as_bytes(), None).unwrap_or_else(|failure| panic!("{failure}"))
}

/// Numbers by hand: 11 * 6 - 15 for six cameras; four bodies around a cycle lack one in the
/// projective model and nothing in the calibrated one, 3 * 8 - 4; K_{3,3} with one camera more has
/// 8 * 7 - 12.
#[test]
fn what_is_verified() {
    use Verdict::{NotFiniteSolvable, Solvable};
    for (name, verdict, numbers, parts) in [
        ("parts-rig", Solvable, (51, 51, 1), 4),
        ("parts-ring", NotFiniteSolvable, (72, 73, 4), 4),
        ("parts-ring-calibrated", Solvable, (20, 20, 1), 4),
        ("parts-affine", Solvable, (44, 44, 1), 1),
    ] {
        let verified = verified(&named(name));
        assert_eq!(verified.verdict.0, verdict, "{name}");
        let components = verified.components.0 as i64;
        assert_eq!((verified.rank.0, verified.required, components), numbers);
        assert_eq!(verified.parts, parts, "{name}");
        let text = verified.to_string();
        let said = format!("\nknown parts: {parts}, taken for given\n");
        assert!(text.contains(&said), "{text}");
        assert!(text.contains(" matrices and known parts "), "{text}");
    }
    // Without parts nothing is said of them.
    let text = verified(&named("square")).to_string();
    assert!(!text.contains("parts"), "{text}");
}

#[test]
fn section_3_known_parts() {
    for (parts, reason) in [
        (json!([]), "there are none"),
        (
            json!([[0, 1, 2], [2], [2, 4, 5], [3, 5]]),
            "part 1 has fewer than two nodes",
        ),
        (
            json!([[0, 1, 2], [], [2, 4, 5], [3, 5]]),
            "part 1 has fewer than two nodes",
        ),
        (
            json!([[0, 2, 1], [2, 4], [2, 4, 5], [3, 5]]),
            "the nodes of part 0 are not increasing",
        ),
        (
            json!([[0, 1, 2], [2, 2], [2, 4, 5], [3, 5]]),
            "the nodes of part 1 are not increasing",
        ),
        (
            json!([[0, 1, 2], [2, 4], [2, 4, 6], [3, 5]]),
            "part 2 has a node that the graph does",
        ),
        (
            json!([[0, 1, 2], [2, 4, 5], [2, 4], [3, 5]]),
            "the parts are not increasing",
        ),
        (
            json!([[0, 1, 2], [2, 4], [2, 4], [3, 5]]),
            "the parts are not increasing",
        ),
    ] {
        refused(
            "parts-rig",
            &[("/parts", parts)],
            &format!("parts: {reason}"),
        );
    }
    // Of another type, and where there is nothing to be known.
    for wrong in [json!(null), json!({}), json!([0, 1]), json!([["0", "1"]])] {
        rejection(&changed("parts-rig", &[("/parts", wrong)]), None);
    }
    let mut inside = named("parts-rig");
    inside["graph"]["parts"] = inside["parts"].take();
    rejection(&inside, None);
}

/// The claim is about the graph that is given, with the parts that are given.
#[test]
fn section_3_parts_that_are_given() {
    let value = named("parts-rig");
    let line = value["graph"]["graph6"].as_str().unwrap();
    let graph = || Graph::from_graph6(line.as_bytes()).unwrap();
    let given = |parts: &[&[u32]]| graph().with_parts(parts.iter().map(|part| part.to_vec()));
    let own: [&[u32]; 4] = [&[5, 4, 2], &[2, 1, 0], &[4, 2], &[3, 5]];
    let text = value.to_string();
    assert!(check(text.as_bytes(), Some(&given(&own).unwrap())).is_ok());
    let wrong = "the certificate takes 4 known parts for given, which are not the";
    let reason = rejection(&value, Some(&graph()));
    assert_eq!(reason, format!("parts: {wrong} 0 given here"));
    let reason = rejection(&value, Some(&given(&own[1..]).unwrap()));
    assert_eq!(reason, format!("parts: {wrong} 3 given here"));
    // One of a different node.
    let other: [&[u32]; 4] = [&[5, 4, 2], &[2, 1, 0], &[4, 2], &[3, 4]];
    let reason = rejection(&value, Some(&given(&other).unwrap()));
    assert_eq!(reason, format!("parts: {wrong} 4 given here"));
    // A certificate without parts is not about a graph with parts.
    let pair = named("pair");
    let line = pair["graph"]["graph6"].as_str().unwrap();
    let with_part = Graph::from_graph6(line.as_bytes())
        .unwrap()
        .with_parts([vec![0, 1]]);
    let reason = rejection(&pair, Some(&with_part.unwrap()));
    assert!(
        reason.starts_with("parts: the certificate takes 0 known parts"),
        "{reason}"
    );
}

/// Parts are bodies with the first numbers, and used once.
#[test]
fn section_5_known_parts() {
    let used = "is not an earlier one, or is used a second time";
    let merge = |with: Value, at: Value| json!([{"with": with, "at": at}]);
    for (pointer, new, reason) in [
        (
            "/bodies/1/seed",
            json!(0),
            format!("bodies[1].seed: body 0 {used}"),
        ),
        (
            "/bodies/1/merge",
            merge(json!([0]), json!([2, 4])),
            format!("bodies[1].merge[0]: body 0 {used}"),
        ),
        (
            "/bodies/0/seed",
            json!(4),
            format!("bodies[0].seed: body 4 {used}"),
        ),
        (
            "/bodies/0/seed",
            json!(3),
            "bodies[0].add[0]: node 0 is not in the body".into(),
        ),
        (
            "/bodies/1/merge/0/at",
            json!([2, 5]),
            "bodies[1].merge[0]: node 5 is not where".into(),
        ),
    ] {
        refused("parts-rig", &[(pointer, new)], &reason);
    }
    // No part is left out of the pieces, and none is there that became a body.
    let rigid = |bodies: Value| json!({"bodies": bodies, "edges": []});
    let changes = [
        ("/bodies/2/merge", json!([])),
        ("/rigid", rigid(json!([3, 6]))),
    ];
    refused("parts-rig", &changes, "pieces: body 5 is left out");
    refused(
        "parts-rig",
        &[("/rigid", rigid(json!([0, 6])))],
        "rigid: 0 is not a final body",
    );
    // Two nodes of a part are no edge of the graph.
    refused(
        "parts-rig",
        &[("/bodies/0/seed", json!([0, 2]))],
        "bodies[0].seed: [0, 2] is not an edge",
    );
    // Edges are covered once: two parts with the edge 0-1 have to be merged.
    let twice = json!([[0, 1, 2], [0, 1, 3], [2, 4, 5], [3, 5]]);
    let changes = [("/parts", twice), ("/bodies", json!([]))];
    refused(
        "parts-rig",
        &changes,
        "the edge [0, 1] is covered by two bodies",
    );
}

/// A part of the piece is a chain of its shared nodes in the core, whose nodes and edges count.
#[test]
fn section_6_known_parts() {
    // A fifth node of one part: the rank of the piece grows by 11, that of the core stays.
    let larger = json!([[0, 1, 4], [0, 3, 7], [1, 2, 5], [2, 3, 6, 8]]);
    let mut value = changed("parts-ring", &[("/parts", larger)]);
    let nine = Graph::new(9, []).unwrap();
    let hash: String = nine
        .sha256()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    value["graph"] = json!({"name": "", "nodes": 9, "edges": 0, "graph6": null, "sha256": hash});
    let parts = value["parts"].as_array().unwrap().iter();
    let parts = parts.map(|part| serde_json::from_value(part.clone()).unwrap());
    let given = nine.with_parts(parts.collect::<Vec<_>>()).unwrap();
    // The draws are those of another graph now.
    let reason = rejection(&value, Some(&given));
    assert!(reason.starts_with("pieces[0].evidence"), "{reason}");
    // Two parts with two nodes in common that are neighbours in the core.
    let twice = json!([[0, 1, 4], [0, 1, 7], [0, 2, 5], [1, 2, 6]]);
    refused(
        "parts-ring",
        &[("/parts", twice)],
        "pieces[0]: an edge of the core arises twice",
    );
    // Parts that share a single node are no piece.
    let rigid = json!({"bodies": [0, 1, 2, 3], "edges": []});
    let changes = [("/rigid", rigid), ("/pieces", json!([]))];
    refused(
        "parts-ring",
        &changes,
        "pieces: a piece closes a cycle of pieces at node",
    );
}
