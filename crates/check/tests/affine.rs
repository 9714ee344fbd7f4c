//! Certificates of the affine model: a change for each condition, with the reason that must be
//! given, as in `conditions.rs`.

use crate::changes::{changed, named, refused, rejection};
use serde_json::{Value, json};
use viewcert_check::{Graph, Model, Verdict, Verified, check};

fn verified(value: &Value) -> Verified {
    check(value.to_string().as_bytes(), None).unwrap_or_else(|failure| panic!("{failure}"))
}

/// A certificate of the projective model as one of the affine model, with another claim.
fn as_affine(name: &str, changes: &[(&str, Value)], verdict: &str, rank: [i64; 2]) -> Value {
    let mut value = changed(name, changes);
    value["model"] = json!("affine");
    value["claim"]["verdict"]["value"] = json!(verdict);
    value["claim"]["rank"]["value"] = json!(rank[0]);
    value["claim"]["rank"]["required"] = json!(rank[1]);
    value
}

/// Numbers by hand: K_{3,3} has 9 = 2 * 6 - 3 rows of R, the 4-cycle 4 of 5, and so on.
#[test]
fn what_is_verified() {
    use Verdict::{NotFiniteSolvable, Solvable};
    for (name, verdict, numbers) in [
        ("affine-bipartite", Solvable, (36, 36, 1)),
        ("affine-bars", Solvable, (52, 52, 1)),
        ("affine-square", NotFiniteSolvable, (16, 20, 4)),
        ("affine-triangle", NotFiniteSolvable, (24, 28, 4)),
        ("affine-hinges", NotFiniteSolvable, (48, 52, 4)),
    ] {
        let verified = verified(&named(name));
        assert_eq!(verified.model, Model::Affine);
        assert_eq!(verified.verdict.0, verdict, "{name}");
        let found = (
            verified.rank.0,
            verified.required,
            verified.components.0 as i64,
        );
        assert_eq!(found, numbers, "{name}");
    }
    let text = verified(&named("affine-bipartite")).to_string();
    let wanted = "solvable: generic fundamental matrices determine uniquely the affine cameras";
    assert!(text.contains(wanted), "{text}");
}

/// Edges, triangles, and bodies that share nodes, two or three at a time, are bodies in the plane.
#[test]
fn section_5_bodies() {
    let pair = as_affine("pair", &[], "solvable", [4, 4]);
    assert_eq!(verified(&pair).verdict.0, Verdict::Solvable);
    // Two merges of three bodies; seven nodes.
    let merges = as_affine("merges", &[], "solvable", [44, 44]);
    assert_eq!(verified(&merges).verdict.0, Verdict::Solvable);
    // The complete graph on four nodes: two triangles that share two nodes.
    let complete = Graph::from_graph6(b"C~").unwrap().sha256();
    let complete: String = complete.iter().map(|byte| format!("{byte:02x}")).collect();
    let bodies = json!([{"seed": [0, 1], "add": [[2, 0, 1]], "merge": []},
        {"seed": [1, 2], "add": [[3, 1, 2]], "merge": []},
        {"seed": 0, "add": [], "merge": [{"with": [1], "at": [1, 2]}]}]);
    let graph = json!({"name": "", "nodes": 4, "edges": 6, "graph6": "C~", "sha256": complete});
    let rigid = json!({"bodies": [2], "edges": []});
    let changes = [("/graph", graph), ("/bodies", bodies), ("/rigid", rigid)];
    let shared = as_affine("pair", &changes, "solvable", [20, 20]);
    assert_eq!(verified(&shared).verdict.0, Verdict::Solvable);
    let around = json!([{"seed": [0, 1], "add": [],
        "merge": [{"with": [[1, 2], [2, 3], [0, 3]], "at": [1, 2, 3, 0]}]}]);
    refused(
        "affine-square",
        &[("/bodies", around)],
        "bodies[0].merge[0]: a cycle of four is a body in the calibrated model only",
    );
}

#[test]
fn section_7_evidence_of_a_model() {
    let kinds = [
        json!({"kind": "minor", "prime": "101", "seed": "1", "draw": 0, "rows": [], "cols": []}),
        json!({"kind": "integer-minor", "numerator": 1, "denominator": 1, "seed": "1", "draw": 0,
            "rows": [], "cols": [], "determinant": null, "prime": "101", "kernel": []}),
        json!({"kind": "plane-flow", "prime": "101", "seed": "1", "draw": 0, "rows": [], "cols": [],
            "flows": 0, "lambda_rows": [], "lambda_cols": []}),
        json!({"kind": "draws", "seed": "1", "count": 3, "rank": 4}),
    ];
    for kind in kinds {
        let name = kind["kind"].as_str().unwrap().to_owned();
        let wanted = format!("E/[0] ({name}): not evidence in the affine model");
        refused("affine-bipartite", &[("E/0", kind)], &wanted);
    }
    let minor = json!({"kind": "plane-minor", "prime": "101", "seed": "1", "draw": 0,
        "rows": [], "cols": []});
    for model in ["projective", "calibrated"] {
        let name = ["square", "pentagon-calibrated"][usize::from(model == "calibrated")];
        let wanted = format!("E/[0] (plane-minor): not evidence in the {model} model");
        refused(name, &[("E/0", minor.clone())], &wanted);
    }
    let mut missing = minor.clone();
    missing.as_object_mut().unwrap().remove("cols");
    let reason = rejection(&changed("affine-bipartite", &[("E/0", missing)]), None);
    let wanted = "the member `cols` is missing";
    assert!(reason.starts_with(wanted), "{reason}");
    let mut more = minor;
    more["rank"] = json!(0);
    let reason = rejection(&changed("affine-bipartite", &[("E/0", more)]), None);
    let wanted = "the member `rank` does not belong there";
    assert!(reason.starts_with(wanted), "{reason}");
}

#[test]
fn section_7_plane_minors() {
    let step = "E/[0] (plane-minor)";
    for (pointer, wrong, reason) in [
        ("E/0/cols/3", json!(3), "pivot 3 vanishes"),
        (
            "E/0/cols/3",
            json!(2),
            "the pivots are not different indices below 8",
        ),
        (
            "E/0/cols/3",
            json!(8),
            "the pivots are not different indices below 8",
        ),
        (
            "E/0/rows/3",
            json!(2),
            "the pivots are not different indices below 4",
        ),
        (
            "E/0/rows/3",
            json!(4),
            "the pivots are not different indices below 4",
        ),
        (
            "E/0/cols",
            json!([0, 1, 2]),
            "4 pivot rows, but 3 pivot columns",
        ),
        (
            "E/0/prime",
            json!("1000005"),
            "1000005 is not a prime with 5 <= p < 2^62",
        ),
    ] {
        refused(
            "affine-square",
            &[(pointer, wrong)],
            &format!("{step}: {reason}"),
        );
    }
    // Without its last pivot it proves a rank less.
    let fewer = [
        ("E/0/rows", json!([0, 1, 2, 3, 4, 5, 6, 7])),
        ("E/0/cols", json!([0, 1, 6, 2, 3, 7, 4, 5])),
    ];
    refused(
        "affine-bipartite",
        &fewer,
        "pieces[0]: rank 32 is proved, but one component needs 36",
    );
    let none = [("E/0/rows", json!([])), ("E/0/cols", json!([]))];
    refused(
        "affine-bipartite",
        &none,
        "pieces[0]: rank 0 is proved, but one component needs 36",
    );
    // Four points modulo 5 soon meet.
    let void = (0..100).any(|seed| {
        let draw = [
            ("E/0/prime", json!("5")),
            ("E/0/seed", json!(seed.to_string())),
        ];
        let reason = rejection(&changed("affine-square", &draw), None);
        reason.contains("(plane-minor): the draw is void: two nodes have the same centre")
    });
    assert!(void);
}

#[test]
fn section_7_counting_and_classes() {
    refused(
        "affine-square",
        &[("E/1/bound", json!(4))],
        "E/[1] (counting): the bound is 4, but the blocks sum up to 16",
    );
    let hub = json!([{"node": 0, "parts": [], "split": [], "groups": [], "components": 1,
        "less": 1}]);
    refused(
        "affine-square",
        &[("E/1/blocks/0/hubs", hub)],
        "E/[1] (counting).blocks[0]: a hub in the affine model",
    );
    let split = json!({"rigid": {"bodies": [], "edges": []}, "pieces": []});
    refused(
        "affine-hinges",
        &[("E/2/classes/0/split", split)],
        "E/[2] (classes).classes[0]: a split class in the affine model",
    );
    // The class of K_{3,3} alone is rigid only with all of its edges.
    let changes = [
        ("E/2/classes/0/evidence/0/rows/8", json!("remove")),
        ("E/2/classes/0/evidence/0/cols/8", json!("remove")),
    ];
    refused(
        "affine-hinges",
        &changes,
        "E/[2] (classes).classes[0]: not proved to have the rank 36 of its core",
    );
}

#[test]
fn section_7_motions_of_plane_points() {
    let step = "E/[3] (kernel)";
    let still = |entries: usize| json!(vec!["0"; entries]);
    let mut unit = vec!["0"; 8];
    unit[0] = "1";
    for (wrong, reason) in [
        (still(8), "two classes move alike"),
        (still(7), "`vector` has 7 entries instead of 8"),
        (still(12), "`vector` has 12 entries instead of 8"),
        (
            json!(vec!["1000003"; 8]),
            "an entry is not a residue modulo 1000003",
        ),
        (json!(unit), "not a kernel vector at the core edge 0"),
    ] {
        refused(
            "affine-square",
            &[("E/3/vector", wrong)],
            &format!("{step}: {reason}"),
        );
    }
    refused(
        "affine-square",
        &[("E/3/seed", json!("2"))],
        &format!("{step}: not a kernel vector at the core edge"),
    );
    refused(
        "affine-square",
        &[("E/3/prime", json!("1000005"))],
        &format!("{step}.prime: 1000005 is not a prime"),
    );
}

/// A class that is rigid moves as one, but at special points: here a triangle with its corners on a
/// line, of which the third one moves along.
#[test]
fn section_7_a_class_that_does_not_move_as_one() {
    let moves = |seed: usize, x: usize, y: usize| {
        let mut vector = vec!["0".to_owned(); 10];
        (vector[4], vector[5]) = (x.to_string(), y.to_string());
        let kernel = json!({"kind": "kernel", "prime": "5", "seed": seed.to_string(), "draw": 0,
            "vector": vector});
        let reason = rejection(&changed("affine-triangle", &[("E/3", kernel)]), None);
        reason.ends_with("(kernel): class 0 does not move as one")
    };
    let mut all = (0..1250).map(|k| (k / 25, k / 5 % 5, k % 5));
    assert!(all.any(|(seed, x, y)| moves(seed, x, y)));
}

#[test]
fn section_7_separation() {
    let not_separated = "claim.components: classes of a piece are not separated";
    refused("affine-square", &[("E/3", json!("remove"))], not_separated);
    // The same rank at other points: proved, but not at the points of the motion.
    refused("affine-square", &[("E/0/seed", json!("2"))], not_separated);
    let mut elsewhere = named("affine-square")["pieces"][0]["evidence"][0].clone();
    elsewhere["seed"] = json!("2");
    // A minor there that is too small does not help.
    let mut value = named("affine-square");
    for list in ["rows", "cols"] {
        let list = value["pieces"][0]["evidence"][0][list].as_array_mut();
        list.unwrap().pop();
    }
    let evidence = value["pieces"][0]["evidence"].as_array_mut().unwrap();
    evidence.push(elsewhere.clone());
    assert_eq!(rejection(&value, None), not_separated);
    // With the whole minor both are there, and one of them is enough.
    let mut value = named("affine-square");
    let minor = value["pieces"][0]["evidence"][0].clone();
    let evidence = value["pieces"][0]["evidence"].as_array_mut().unwrap();
    evidence[0] = elsewhere;
    evidence.push(minor);
    assert_eq!(verified(&value).components.0, 4);
}

#[test]
fn section_8_claims() {
    for (pointer, wrong, reason) in [
        (
            "/claim/rank/value",
            json!(9),
            "claim.rank: `9` is claimed, but the evidence gives `36`",
        ),
        (
            "/claim/rank/required",
            json!(9),
            "claim: rank.required is 36, not 9",
        ),
        (
            "/claim/verdict/value",
            json!("finite-solvable"),
            "claim.verdict: `finite-solvable` is claimed, but the evidence gives `solvable`",
        ),
        (
            "/claim/verdict/value",
            json!("not-finite-solvable"),
            "claim.verdict: `not-finite-solvable` is claimed, but the evidence gives `solvable`",
        ),
        (
            "/claim/components/value",
            json!(2),
            "claim.components: `2` is claimed, but the evidence gives `1`",
        ),
        (
            "/model",
            json!("calibrated"),
            "pieces[0].evidence[0] (plane-minor): not evidence in the calibrated model",
        ),
    ] {
        refused("affine-bipartite", &[(pointer, wrong)], reason);
    }
    let changes = [("/model", json!("plane"))];
    let reason = rejection(&changed("affine-bipartite", &changes), None);
    let wanted = "`plane` is not a model: `projective`, `calibrated` or `affine`";
    assert!(reason.starts_with(wanted), "{reason}");
}
