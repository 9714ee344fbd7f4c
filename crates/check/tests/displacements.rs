//! Certificates with known displacements: a change for each condition, with the reason that must be
//! given, as in `conditions.rs`. Their claims come from trying everything (`displaced.py`).

use crate::changes::{changed, named, refused, rejection};
use serde_json::{Value, json};
use std::path::Path;
use viewcert_check::{Verdict, Verified, check};

fn verified(value: &Value) -> Verified {
    check(value.to_string().as_bytes(), None).unwrap_or_else(|failure| panic!("{failure}"))
}

/// Three for each vector, two for each pair, as far as they do not depend on each other.
#[test]
fn what_is_verified() {
    use Verdict::{NotFiniteSolvable, Solvable};
    for (name, verdict, numbers) in [
        ("displaced-rigs", Solvable, (9, 9, 1)),
        ("displaced-path", NotFiniteSolvable, (8, 9, 3)),
        ("displaced-merge", Solvable, (9, 9, 1)),
        ("displaced-pieces", Solvable, (9, 9, 1)),
        ("displaced-pentagon", Solvable, (12, 12, 1)),
        ("displaced-flex", NotFiniteSolvable, (11, 12, 5)),
        ("displaced-split", NotFiniteSolvable, (17, 18, 5)),
        ("displaced-class", NotFiniteSolvable, (20, 21, 5)),
        ("../displacements/parallel", Solvable, (9, 9, 1)),
        ("displaced-equal", NotFiniteSolvable, (8, 9, 4)),
        ("displaced-sum", NotFiniteSolvable, (14, 15, 6)),
        ("displaced-level", NotFiniteSolvable, (11, 12, 5)),
        ("../displacements/row", Solvable, (21, 21, 1)),
        ("../displacements/apart", Solvable, (12, 12, 1)),
        ("../displacements/line", Solvable, (6, 6, 1)),
        ("../displacements/square", Solvable, (9, 9, 1)),
    ] {
        let verified = verified(&named(name));
        assert_eq!(verified.verdict.0, verdict, "{name}");
        let Verified { required, .. } = verified;
        let found = (verified.rank.0, required, verified.components.0);
        assert_eq!(found, numbers, "{name}");
    }
}

/// The hash is that of the page, by Python's hashlib.
#[test]
fn what_is_supposed_is_said() {
    let verified = verified(&named("displaced-rigs"));
    let known = verified.displacements.as_ref().expect("two rigs");
    assert_eq!((known.groups, known.nodes), (2, 4));
    let hash = "2eaec72a74890accb2edf31caf4b2e9e8351715092f824e37a10c1317e13c424";
    assert_eq!(known.sha256, hash);
    let text = verified.to_string();
    let line =
        format!("displacements: supposed to be known, 4 nodes in 2 groups, SHA-256 {hash}\n");
    assert!(text.contains(&line), "{text}");
    let answer = "solvable: generic essential matrices and displacements determine uniquely the";
    assert!(text.contains(answer), "{text}");
}

#[test]
fn section_3_groups() {
    let mut both = named("displaced-path");
    both["parts"] = json!([[0, 1]]);
    let wanted = "displacements: there are known parts as well";
    assert_eq!(rejection(&both, None), wanted);
    let refused = |groups: Value, wanted: &str| {
        let wanted = format!("displacements: {wanted}");
        refused("displaced-path", &[("/displacements", groups)], &wanted);
    };
    refused(json!([]), "there is no group");
    refused(json!([[0], [2, 3]]), "group 0 has fewer than two nodes");
    refused(json!([[1, 0], [2, 3]]), "group 0 is not increasing");
    refused(json!([[0, 1], [2, 2]]), "group 1 is not increasing");
    refused(json!([[0, 1], [2, 4]]), "the graph has no node 4");
    refused(json!([[0, 1], [1, 3]]), "node 1 is in two groups");
    refused(
        json!([[2, 3], [0, 1]]),
        "the groups are not in the order of their first nodes",
    );
    for model in ["projective", "affine"] {
        let reason = rejection(
            &changed("displaced-path", &[("/model", json!(model))]),
            None,
        );
        let wanted = format!("displacements: known displacements in the {model} model");
        assert_eq!(reason, wanted);
    }
    let text = rejection(
        &changed("displaced-path", &[("/displacements", json!({}))]),
        None,
    );
    assert!(text.contains("invalid type"), "{text}");
}

#[test]
fn without_them_it_is_another_claim() {
    for name in ["displaced-path", "displaced-rigs", "displaced-merge"] {
        let mut value = named(name);
        value.as_object_mut().unwrap().remove("displacements");
        rejection(&value, None);
    }
}

#[test]
fn section_3_vectors() {
    let refused = |vectors: Value, wanted: &str| {
        let wanted = format!("vectors{wanted}");
        refused(
            "../displacements/parallel",
            &[("/vectors", vectors)],
            &wanted,
        );
    };
    let (x, zero) = (json!(["1", "0", "0"]), json!(["0", "0", "0"]));
    refused(json!([[x]]), ": there is not one list for each group");
    let count = ".group 1: there is not one vector for each node behind the first";
    refused(json!([[x], [x, x]]), count);
    refused(json!([[x], []]), count);
    refused(json!([[x], [zero]]), ".group 1: two nodes are at one place");
    let long = json!([format!("1{}", "0".repeat(30)), "0", "0"]);
    let wanted = ".group 1: a coordinate has more than 30 digits";
    refused(json!([[x], [long]]), wanted);
    let twice = json!(["0", "-2", "4"]);
    let wanted = ": all coordinates have the common divisor 2, not 1";
    refused(json!([[twice], [twice]]), wanted);
    // Two nodes of one group at one place.
    let wanted = "vectors.group 0: two nodes are at one place";
    crate::changes::refused(
        "../displacements/line",
        &[("/vectors", json!([[x, x]]))],
        wanted,
    );
    for wrong in [
        json!([[["1", "0"]], [x]]),
        json!([[["1", "0", "0", "0"]], [x]]),
        json!([[["1", "-0", "0"]], [x]]),
        json!([[[1, 0, 0]], [x]]),
    ] {
        rejection(
            &changed("../displacements/parallel", &[("/vectors", wrong)]),
            None,
        );
    }
    let mut without = named("../displacements/parallel");
    without.as_object_mut().unwrap().remove("displacements");
    assert_eq!(
        rejection(&without, None),
        "vectors: there are no displacements"
    );
}

#[test]
fn vectors_are_said() {
    let verified = verified(&named("../displacements/parallel"));
    let known = verified.displacements.as_ref().expect("two rigs");
    assert!(known.given);
    let wanted =
        "displacements: supposed to be known, 4 nodes in 2 groups with given vectors, SHA-256 ";
    assert!(verified.to_string().contains(wanted), "{verified}");
}

/// With other vectors another thing is true: no certificate fits.
#[test]
fn vectors_are_bound() {
    let (x, y) = (json!(["1", "0", "0"]), json!(["0", "1", "0"]));
    for (name, vectors) in [
        ("../displacements/parallel", json!([[x], [x]])),
        ("displaced-equal", json!([[x], [y]])),
        ("displaced-sum", json!([[x], [x], [y]])),
        ("displaced-level", json!([[x], [y]])),
    ] {
        rejection(&changed(name, &[("/vectors", vectors)]), None);
        let mut without = named(name);
        without.as_object_mut().unwrap().remove("vectors");
        // In general position it is as good as with these.
        if name != "../displacements/parallel" {
            rejection(&without, None);
        }
    }
}

#[test]
fn section_5_nodes_are_independent() {
    let show = "the given vectors do not show that the nodes";
    let add = json!([{"seed": [0, 1], "add": [[2, 0, 1]], "merge": []}]);
    let wanted = format!("bodies[0].add[0]: {show} [2, 0, 1] are independent");
    refused("../displacements/line", &[("/bodies", add)], &wanted);
    let merge = json!([{"with": [[0, 2], [1, 2]], "at": [0, 1, 2]}]);
    let three = json!([{"seed": [0, 1], "add": [], "merge": merge}]);
    let wanted = format!("bodies[0].merge[0]: {show} [0, 1, 2] are independent");
    refused("../displacements/line", &[("/bodies", three)], &wanted);
    let merge = json!([{"with": [[1, 2], [1, 3], [0, 3]], "at": [2, 1, 3, 0]}]);
    let four = json!([{"seed": [0, 2], "add": [], "merge": merge}]);
    let wanted = format!("bodies[0].merge[0]: {show} [2, 1, 3, 0] are independent");
    refused("../displacements/square", &[("/bodies", four)], &wanted);
}

#[test]
fn section_6_chains() {
    let piece = json!([{"bodies": [0, 1], "edges": [], "evidence": []}]);
    refused(
        "../displacements/apart",
        &[
            ("/bodies/0/merge", json!([])),
            ("/rigid/bodies", json!([])),
            ("/pieces", piece),
        ],
        "pieces[0].body 1: the given vectors do not show that the nodes [0, 1, 2] are independent",
    );
    // Six nodes, nine core edges and four of them known: rows 0 to 21.
    refused(
        "../displacements/row",
        &[
            ("E/0/rows/17", json!("remove")),
            ("E/0/cols/17", json!("remove")),
        ],
        "pieces[0]: rank 20 is proved, but one component needs 21",
    );
}

#[test]
fn section_7_blocks_that_agree() {
    for bound in [7, 9] {
        refused(
            "displaced-equal",
            &[("E/1/bound", json!(bound))],
            &format!("E/[1] (counting): the bound is {bound}, but the blocks sum up to 8"),
        );
    }
    // With one rig 3 * 2 - 3, and nothing for the other.
    refused(
        "displaced-equal",
        &[
            ("E/1/blocks/0", json!("remove")),
            ("E/1/blocks/1/bodies", json!([0])),
        ],
        "E/[1] (counting): the bound is 8, but the blocks sum up to 9",
    );
    // Three pairs by themselves.
    let edge = |edge: [u32; 2]| json!({"bodies": [], "edges": [edge], "hubs": []});
    let ones = json!({"bodies": [0, 1, 2], "edges": [], "hubs": []});
    refused(
        "displaced-sum",
        &[(
            "E/1/blocks",
            json!([ones, edge([0, 2]), edge([1, 5]), edge([3, 4])]),
        )],
        "E/[1] (counting): the bound is 14, but the blocks sum up to 21",
    );
    let vectors = json!([[["1", "1", "1"]], [["0", "1", "0"]], [["0", "0", "1"]]]);
    refused(
        "displaced-sum",
        &[("/vectors", vectors)],
        "E/[1] (counting): the bound is 14, but the blocks sum up to 15",
    );
}

#[test]
fn section_5_bodies() {
    let merge = "/bodies/0/merge/0";
    for node in [0, 3] {
        refused(
            "displaced-merge",
            &[(&format!("{merge}/at"), json!([node]))],
            &format!("bodies[0].merge[0]: node {node} is not where the merge needs it"),
        );
    }
    let only = "bodies[0].merge[0]: only bodies with known displacements merge at one node";
    refused(
        "displaced-merge",
        &[(&format!("{merge}/with"), json!([[0, 2]]))],
        only,
    );
    refused(
        "displaced-merge",
        &[
            ("/bodies/0/seed", json!([0, 2])),
            ("/bodies/0/add", json!([])),
        ],
        only,
    );
    // A group is used once, and the body behind two groups has the number 2.
    refused(
        "displaced-merge",
        &[(merge, json!("repeat"))],
        "bodies[0].merge[1]: body 1 is not an earlier one, or is used a second time",
    );
    refused(
        "displaced-merge",
        &[("/rigid/bodies", json!([0]))],
        "rigid: 0 is not a final body",
    );
}

#[test]
fn section_7_lower_bounds() {
    // m' = 4 and two scaled bodies: rows 0 to 9, rank 3 * 4 - 3.
    refused(
        "displaced-rigs",
        &[("E/0/rows/8", json!(10))],
        "E/[0] (plane-flow).N: ",
    );
    refused(
        "displaced-rigs",
        &[
            ("E/0/rows/8", json!("remove")),
            ("E/0/cols/8", json!("remove")),
        ],
        "pieces[0]: rank 8 is proved, but one component needs 9",
    );
    let first = "E/2/classes/0/evidence/0";
    refused(
        "displaced-class",
        &[
            (&format!("{first}/rows/11"), json!("remove")),
            (&format!("{first}/cols/11"), json!("remove")),
        ],
        "E/[2] (classes).classes[0]: not proved to have the rank 12 of its core",
    );
}

#[test]
fn section_7_blocks_and_classes() {
    refused(
        "displaced-flex",
        &[("E/1/bound", json!(10))],
        "E/[1] (counting): the bound is 10, but the blocks sum up to 11",
    );
    // 3 * 3 - 3 in the place of (3 * 2 - 3) + (3 * 2 - 4).
    refused(
        "displaced-flex",
        &[
            ("E/1/blocks/0/edges", json!([[0, 4]])),
            ("E/1/blocks/1", json!("remove")),
        ],
        "E/[1] (counting): the bound is 11, but the blocks sum up to 12",
    );
    // Two loose edges hold no displacement.
    let (first, second) = (json!([0, 4]), json!([1, 2]));
    let split = json!({"rigid": {"bodies": [], "edges": [first, second]}, "pieces": []});
    refused(
        "displaced-split",
        &[
            ("E/2/classes/1/edges", json!([[0, 4], [1, 2]])),
            ("E/2/classes/1/split", split),
            ("E/2/classes/2", json!("remove")),
        ],
        "E/[2] (classes).classes[1]: a split class in the calibrated model",
    );
}

/// A motion that multiplies everything is none of cameras with a known length.
#[test]
fn section_7_motions() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/displacements/longer.json");
    let text = std::fs::read_to_string(path).unwrap();
    let reason = rejection(&serde_json::from_str(&text).unwrap(), None);
    let wanted = "pieces[0].evidence[3] (kernel): the known length of the core edge 0 changes";
    assert_eq!(reason, wanted);
}

#[test]
fn section_8_claims() {
    for (name, place, value, wanted) in [
        (
            "displaced-pieces",
            "/claim/verdict/value",
            json!("not-finite-solvable"),
            "claim.verdict: `not-finite-solvable` is claimed, but the evidence gives `solvable`",
        ),
        (
            "displaced-pieces",
            "/claim/components/value",
            json!(2),
            "claim.components: `2` is claimed, but the evidence gives `1`",
        ),
        (
            "displaced-split",
            "/claim/components/value",
            json!(6),
            "claim.components: `6` is claimed, but the evidence gives `5`",
        ),
        (
            "displaced-path",
            "/claim/components/value",
            json!(2),
            "claim.components: `2` is claimed, but the evidence gives `3`",
        ),
        (
            "displaced-path",
            "/claim/verdict/value",
            json!("solvable"),
            "claim.verdict: `solvable` is claimed, but the evidence gives `not-finite-solvable`",
        ),
        (
            "displaced-path",
            "/claim/rank/required",
            json!(8),
            "claim: rank.required is 9, not 8",
        ),
        (
            "displaced-flex",
            "/claim/rank/value",
            json!(12),
            "claim.rank: `12` is claimed, but the evidence gives `11`",
        ),
    ] {
        refused(name, &[(place, value)], wanted);
    }
}
