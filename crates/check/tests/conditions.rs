//! A certificate for each condition of the specification that breaks it and, as far as that can be,
//! nothing else; with the reason that must be given. `conditions.py` sees to it that there is one
//! for each condition.

use crate::changes::{at, at as at_pointer, changed, named, refused, rejection};
use serde_json::{Value, json};
use viewcert_check::{Certificate, Failure, Graph, Limits, check};

#[test]
fn section_3_the_graph() {
    refused(
        "square",
        &[("/graph/nodes", json!(5))],
        "graph: the graph has 4 nodes and 4 edges, not 5 and 4",
    );
    refused(
        "square",
        &[("/graph/edges", json!(3))],
        "graph: the graph has 4 nodes and 4 edges, not 4 and 3",
    );
    let other = "0ac8d97b8710d2c0fe901270dcfd1aa77fc5e73a9d406ddf480210a460626727";
    refused(
        "square",
        &[("/graph/sha256", json!(other))],
        "graph: the graph has another hash than `sha256`",
    );
    let upper = "9AC8D97B8710D2C0FE901270DCFD1AA77FC5E73A9D406DDF480210A460626727";
    refused(
        "square",
        &[("/graph/sha256", json!(upper))],
        "graph: the graph has another hash than `sha256`",
    );
    refused(
        "square",
        &[("/graph/graph6", json!("C~"))],
        "graph: the graph has another hash than `sha256`",
    );
    refused(
        "square",
        &[("/graph/graph6", json!(">>graph6<<Cl"))],
        "graph: graph6: a byte that is not from 63",
    );
    refused(
        "square",
        &[("/graph/graph6", json!(null))],
        "graph: the certificate does not hold the graph",
    );
    let square = Graph::from_graph6(b"Cl").unwrap();
    let other = Graph::from_graph6(b"C~").unwrap();
    let without = changed("square", &[("/graph/graph6", json!(null))]);
    assert!(check(without.to_string().as_bytes(), Some(&square)).is_ok());
    assert_eq!(
        rejection(&named("square"), Some(&other)),
        "graph: the graph given is not the one in `graph6`"
    );
    assert_eq!(
        rejection(&without, Some(&other)),
        "graph: the graph has another hash than `sha256`"
    );
}

/// A certificate without evidence, about a graph that it does not hold.
fn about(graph: &Graph, edges: usize) -> Value {
    let sha256: String = graph
        .sha256()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    changed(
        "pair",
        &[
            (
                "/graph",
                json!({"name": "", "nodes": graph.nodes(), "edges": edges, "sha256": sha256, "graph6": null}),
            ),
            ("/rigid/edges", json!([])),
        ],
    )
}

fn claim(value: &mut Value, verdict: &str, [rank, required, components]: [usize; 3]) {
    value["claim"]["verdict"]["value"] = json!(verdict);
    value["claim"]["rank"]["value"] = json!(rank);
    value["claim"]["rank"]["required"] = json!(required);
    value["claim"]["components"]["value"] = json!(components);
}

#[test]
fn section_8_graphs_without_edges() {
    let none = Graph::new(0, []).unwrap();
    assert_eq!(
        rejection(&about(&none, 0), Some(&none)),
        "graph: the graph has no nodes"
    );
    let one = Graph::new(1, []).unwrap();
    let mut value = about(&one, 0);
    claim(&mut value, "solvable", [0, 0, 0]);
    let verified = check(value.to_string().as_bytes(), Some(&one)).unwrap();
    assert!(
        verified
            .to_string()
            .contains("rank: 0 of 0 required (proof)"),
        "{verified}"
    );
    claim(&mut value, "finite-solvable", [0, 0, 0]);
    assert!(
        rejection(&value, Some(&one)).starts_with("claim.verdict: `finite-solvable` is claimed")
    );
    let three = Graph::new(3, []).unwrap();
    let mut value = about(&three, 0);
    claim(&mut value, "not-finite-solvable", [0, 18, 0]);
    assert!(check(value.to_string().as_bytes(), Some(&three)).is_ok());
    claim(&mut value, "solvable", [0, 18, 0]);
    assert!(rejection(&value, Some(&three)).starts_with("claim.verdict: `solvable` is claimed"));
}

#[test]
fn section_4_draws() {
    refused(
        "square",
        &[("E/0/prime", json!("1000001"))],
        "E/[0] (plane-flow): 1000001 is not a prime",
    );
    refused(
        "square",
        &[("E/0/prime", json!("3"))],
        "E/[0] (plane-flow): 3 is not a prime with 5 <= p",
    );
    let above = "4611686018427388039";
    refused(
        "square",
        &[("E/0/prime", json!(above))],
        "E/[0] (plane-flow): 4611686018427388039 is not a prime",
    );
    refused(
        "square",
        &[("E/3/prime", json!("1000001"))],
        "E/[3] (kernel).prime: 1000001 is not a prime",
    );
    let small = |seed: &str| [("E/0/prime", json!("5")), ("E/0/seed", json!(seed))];
    refused(
        "square",
        &small(SAME_CENTRE),
        "E/[0] (plane-flow): the draw is void: two nodes have the same centre",
    );
    let out_of_range = "E/[0] (integer-minor): `numerator` or `denominator` is out of range";
    for (member, value) in [
        ("numerator", 0),
        ("numerator", 101),
        ("denominator", 0),
        ("denominator", 13),
    ] {
        refused(
            "integer",
            &[(&format!("E/0/{member}"), json!(value))],
            out_of_range,
        );
    }
    let flat = [
        ("E/0/numerator", json!(1)),
        ("E/0/denominator", json!(1)),
        ("E/0/seed", json!(FLAT_CAMERA)),
    ];
    refused(
        "integer",
        &flat,
        "E/[0] (integer-minor): the draw is void: a camera has rank below 3",
    );
    // General cameras modulo 5, one of which has rank below 3.
    let minor =
        json!({"kind": "minor", "prime": "5", "seed": "3", "draw": 0, "rows": [], "cols": []});
    let flat = "E/[0] (minor): the draw is void: a camera has rank below 3";
    refused("square", &[("E/0", minor)], flat);
}

const SAME_CENTRE: &str = "14";
const FLAT_CAMERA: &str = "1";

#[test]
fn section_5_bodies() {
    for (name, pointer, new, wanted) in [
        (
            "triangle",
            "/bodies/0/add/0",
            json!([2, 0, 0]),
            "bodies[0].add[0]: the two nodes of the body are the same",
        ),
        (
            "triangle",
            "/bodies/0/add/0",
            json!([1, 0, 2]),
            "bodies[0].add[0]: node 2 is not in the body",
        ),
        (
            "merges",
            "/bodies/0/add",
            json!([[2, 0, 1], [3, 0, 2]]),
            "bodies[0].add[1]: 3 and 0 are not joined by an edge",
        ),
        (
            "triangle",
            "/bodies/0/add",
            json!([[2, 0, 1], [2, 0, 1]]),
            "bodies[0].add[1]: node 2 is in the body already",
        ),
        (
            "merges",
            "/bodies/3/seed",
            json!([0, 6]),
            "bodies[3].seed: [0, 6] is not an edge (i < j) of the graph",
        ),
        (
            "merges",
            "/bodies/3/seed",
            json!([1, 0]),
            "bodies[3].seed: [1, 0] is not an edge (i < j) of the graph",
        ),
        (
            "merges",
            "/bodies/3/seed",
            json!(3),
            "bodies[3].seed: body 3 is not an earlier one, or is used a second time",
        ),
        (
            "merges",
            "/bodies/3/merge/0/with",
            json!([1, 1]),
            "bodies[3].merge[0]: body 1 is not an earlier one",
        ),
        (
            "merges",
            "/bodies/3/merge/0/with",
            json!([0, 2]),
            "bodies[3].merge[0]: body 0 is not an earlier one",
        ),
        (
            "merges",
            "/bodies/3/merge/1/with",
            json!([[1, 5], [5, 6]]),
            "bodies[3].merge[1]: [1, 5] is not an edge",
        ),
        (
            "merges",
            "/bodies/3/merge/0/at",
            json!([2, 0]),
            "bodies[3].merge[0]: `with` and `at` have one and one or two, two and three, three and four, four and six, or five and five",
        ),
        (
            "merges",
            "/bodies/3/merge/0/with",
            json!([1]),
            "bodies[3].merge[0]: `with` and `at` have one and one or two, two and three, three and four, four and six, or five and five",
        ),
        (
            "merges",
            "/bodies/3/merge/0/at",
            json!([2, 0, 2]),
            "bodies[3].merge[0]: the nodes of `at` are not different",
        ),
        (
            "merges",
            "/bodies/3/merge/0/at",
            json!([1, 0, 4]),
            "bodies[3].merge[0]: node 1 is not where the merge",
        ),
        (
            "merges",
            "/bodies/3/merge/0/at",
            json!([2, 1, 4]),
            "bodies[3].merge[0]: node 1 is not where the merge",
        ),
        (
            "merges",
            "/bodies/3/merge/0/at",
            json!([2, 0, 3]),
            "bodies[3].merge[0]: node 3 is not where the merge",
        ),
        (
            "merges",
            "/bodies/3/merge/0/at",
            json!([3, 0, 4]),
            "bodies[3].merge[0]: node 3 is not where the merge",
        ),
    ] {
        refused(name, &[(pointer, new)], wanted);
    }
    // Two bodies that share one node, and two that share two.
    let two = |at: [u32; 2]| {
        let bodies = json!([
            {"seed": [0, 1], "add": [[2, 0, 1]], "merge": []},
            {"seed": [2, 3], "add": [[4, 2, 3]], "merge": [{"with": [0], "at": at}]}
        ]);
        rejection(&changed("merges", &[("/bodies", bodies)]), None)
    };
    assert_eq!(
        two([2, 2]),
        "bodies[1].merge[0]: the nodes of `at` are not different"
    );
    assert_eq!(
        two([2, 0]),
        "bodies[1].merge[0]: node 0 is not where the merge needs it"
    );
}

/// `bipartite` with K_{3,3} as a body by rank: its evidence is about the same core.
fn by_rank(body: Value) -> Value {
    let mut value = named("bipartite");
    let piece = value["pieces"].as_array_mut().unwrap().remove(0);
    let mut bodies = vec![json!({"seed": piece, "add": [], "merge": []})];
    bodies.extend(Some(body).filter(|body| !body.is_null()));
    value["rigid"]["bodies"] = json!([bodies.len() - 1]);
    value["bodies"] = json!(bodies);
    value
}

#[test]
fn section_5_bodies_by_rank() {
    // Rigid, and not shown to be unique: nor is what starts from it, or merges with it.
    for body in [
        json!(null),
        json!({"seed": 0, "add": [], "merge": []}),
        json!({"seed": [0, 3], "add": [], "merge": [{"with": [0], "at": [0, 3]}]}),
    ] {
        let mut value = by_rank(body);
        let verified = check(value.to_string().as_bytes(), None).unwrap();
        assert_eq!(verified.verdict.0, viewcert_check::Verdict::FiniteSolvable);
        assert_eq!((verified.rank.0, verified.components.0), (51, 1));
        value["claim"]["verdict"]["value"] = json!("solvable");
        let reason = rejection(&value, None);
        assert!(
            reason.starts_with("claim.verdict: `solvable` is claimed"),
            "{reason}"
        );
    }
    let edges = by_rank(json!(null))["bodies"][0]["seed"]["edges"].clone();
    let reversed: Vec<&Value> = edges.as_array().unwrap().iter().rev().collect();
    for (pointer, new, wanted) in [
        (
            "/model",
            json!("calibrated"),
            "bodies by rank are of the projective model only",
        ),
        (
            "S/edges",
            json!(reversed),
            "the bodies or the edges are not increasing",
        ),
        (
            "S/edges",
            json!([[0, 3]]),
            "fewer than two bodies and edges",
        ),
        (
            "S/edges/0",
            json!([0, 1]),
            "[0, 1] is not an edge (i < j) of the graph",
        ),
        (
            "S/bodies",
            json!([0]),
            "body 0 is not an earlier one, or is consumed",
        ),
        (
            "S/evidence",
            json!([]),
            "not proved to have the rank 51 of its core",
        ),
        (
            "S/evidence",
            json!([{"kind": "counting", "blocks": [], "bound": 51}]),
            "evidence[0] (counting): not a lower bound",
        ),
    ] {
        let mut value = by_rank(json!(null));
        *at(&mut value, &pointer.replace('S', "/bodies/0/seed")) = new;
        let reason = rejection(&value, None);
        let place = if wanted.starts_with("evidence") {
            "bodies[0].seed."
        } else {
            "bodies[0].seed: "
        };
        assert!(reason.starts_with(&format!("{place}{wanted}")), "{reason}");
    }
    // It needs all the pivots.
    let mut value = by_rank(json!(null));
    let seed = &mut value["bodies"][0]["seed"];
    seed["evidence"].as_array_mut().unwrap().truncate(1);
    let flow = &mut seed["evidence"][0];
    assert_eq!(flow["kind"], "plane-flow");
    for list in ["lambda_rows", "lambda_cols"] {
        flow[list].as_array_mut().unwrap().pop();
    }
    let reason = rejection(&value, None);
    assert!(
        reason.starts_with("bodies[0].seed: not proved to have the rank 51"),
        "{reason}"
    );

    // Bodies that a body by rank names are there still, and cover their edges.
    let again = json!({"bodies": [0], "edges": [[0, 3]], "evidence": []});
    let value = by_rank(json!({"seed": again, "add": [], "merge": []}));
    let wanted = "bodies[1].seed: an edge of the core arises twice";
    assert_eq!(rejection(&value, None), wanted);
    let mut value = by_rank(json!({"seed": [0, 3], "add": [], "merge": []}));
    value["rigid"]["bodies"] = json!([0, 1]);
    assert_eq!(
        rejection(&value, None),
        "the edge [0, 3] is covered by two bodies"
    );
    let consumed = json!({"bodies": [0], "edges": [[0, 1]], "evidence": []});
    let mut value = named("merges");
    let bodies = value["bodies"].as_array_mut().unwrap();
    bodies.push(json!({"seed": consumed, "add": [], "merge": []}));
    let wanted = "bodies[4].seed: body 0 is not an earlier one, or is consumed";
    assert_eq!(rejection(&value, None), wanted);
}

/// With a pair as a known part, which the body by rank names and does not consume: the core is the
/// same. A part is unique, and what holds the body by rank is not.
#[test]
fn section_5_bodies_by_rank_of_known_parts() {
    let mut value = by_rank(json!({"seed": 1, "add": [], "merge": [{"with": [0], "at": [0, 3]}]}));
    value["parts"] = json!([[0, 3]]);
    value["rigid"]["bodies"] = json!([2]);
    let seed = &mut value["bodies"][0]["seed"];
    let pair = seed["edges"].as_array_mut().unwrap().remove(0);
    assert_eq!(pair, json!([0, 3]));
    seed["bodies"] = json!([0]);
    let verified = check(value.to_string().as_bytes(), None).unwrap();
    assert_eq!(verified.verdict.0, viewcert_check::Verdict::FiniteSolvable);
    assert_eq!((verified.rank.0, verified.components.0), (51, 1));
    assert_eq!(verified.parts, 1);

    let mut unmerged = value.clone();
    unmerged["bodies"].as_array_mut().unwrap().pop();
    unmerged["rigid"]["bodies"] = json!([0, 1]);
    let wanted = "the edge [0, 3] is covered by two bodies";
    assert_eq!(rejection(&unmerged, None), wanted);
    let mut own = value.clone();
    own["bodies"][0]["seed"]["bodies"] = json!([1]);
    let wanted = "bodies[0].seed: body 1 is not an earlier one, or is consumed";
    assert_eq!(rejection(&own, None), wanted);
    value["claim"]["verdict"]["value"] = json!("solvable");
    let reason = rejection(&value, None);
    let wanted = "claim.verdict: `solvable` is claimed";
    assert!(reason.starts_with(wanted), "{reason}");
}

/// Cycles of four, in `ring` of triangles {0, 1, 4}, {1, 2, 5}, {2, 3, 6} and {0, 3, 7}, in `cycle`
/// of edges, and in `clusters` of two triangles and two edges between them.
#[test]
fn section_5_cycles_of_four() {
    let step = "bodies[4].merge[0]: ";
    let merge =
        |with: Value, at: Value| vec![("/bodies/4/merge/0", json!({"with": with, "at": at}))];
    for name in ["cycle", "clusters", "ring"] {
        let reason = rejection(&changed(name, &[("/model", json!("projective"))]), None);
        let wanted = "merge[0]: a cycle of four is a body in the calibrated model only";
        assert!(reason.ends_with(wanted), "{name}: {reason}");
    }
    // Each node is in one of the two bodies that it has to join, and not in the other.
    for (at, wrong) in [
        ([5, 2, 3, 0], 5),
        ([4, 2, 3, 0], 4),
        ([1, 5, 3, 0], 5),
        ([1, 6, 3, 0], 6),
        ([1, 2, 6, 0], 6),
        ([1, 2, 7, 0], 7),
        ([1, 2, 3, 7], 7),
        ([1, 2, 3, 4], 4),
        // The order of the other merge with three nodes.
        ([1, 0, 2, 3], 0),
    ] {
        refused(
            "ring",
            &merge(json!([1, 2, 3]), json!(at)),
            &format!("{step}node {wrong} is not where the merge needs it"),
        );
    }
    for at in [json!([1, 2, 3]), json!([1, 2, 3, 0, 4])] {
        refused(
            "ring",
            &merge(json!([1, 2, 3]), at),
            &format!(
                "{step}`with` and `at` have one and one or two, two and three, three and four, four and six, or five and five"
            ),
        );
    }
    // Later, unknown, consumed by the seed, and used a second time.
    for body in [4, 9, 0, 1] {
        refused(
            "ring",
            &merge(json!([1, 2, body]), json!([1, 2, 3, 0])),
            &format!("{step}body {body} is not an earlier one, or is used a second time"),
        );
    }
    refused(
        "clusters",
        &[("/bodies/2/merge/0/with/0", json!([0, 5]))],
        "bodies[2].merge[0]: [0, 5] is not an edge (i < j) of the graph",
    );
    refused(
        "clusters",
        &[("/bodies/2/merge/0/with/0", json!([3, 0]))],
        "bodies[2].merge[0]: [3, 0] is not an edge (i < j) of the graph",
    );
    // The same cycle another way around, and from another of its bodies.
    for (seed, with, at) in [(0, [3, 2, 1], [0, 3, 2, 1]), (2, [3, 0, 1], [3, 0, 1, 2])] {
        let mut changes = merge(json!(with), json!(at));
        changes.push(("/bodies/4/seed", json!(seed)));
        changes.retain(|(pointer, new)| named("ring").pointer(pointer) != Some(new));
        let text = changed("ring", &changes).to_string();
        assert!(check(text.as_bytes(), None).is_ok(), "{with:?}");
    }
}

/// A K_4 of 0 to 3, on which 4, 5 and 6 hang; 4 and 5 are in a triangle with 7.
#[test]
fn section_5_tripods() {
    let step = "bodies[1].merge[0]: ";
    let (with, at) = (
        json!([[0, 4], 0, [1, 5], [2, 6], [4, 6]]),
        [0, 1, 2, 4, 5, 6],
    );
    let tripod = |with: Value, at: &[u32]| {
        let merge = json!({"with": with, "at": at});
        changed("tripod", &[("/bodies/1/merge/0", merge)])
    };
    // The triangle holds both pairs of 4.
    let mut four = tripod(json!([[0, 4], 0, [1, 5], [3, 7]]), &[0, 1, 3, 4, 5, 7]);
    let last = json!({"seed": 1, "add": [[6, 2, 4]], "merge": []});
    four["bodies"].as_array_mut().unwrap().push(last);
    four["rigid"]["bodies"] = json!([2]);
    assert!(check(four.to_string().as_bytes(), None).is_ok());
    // All nodes in the place of others.
    for (k, v) in (0..6).flat_map(|k| (0..8).map(move |v| (k, v))) {
        let mut moved = at;
        moved[k] = v;
        if moved != at {
            let reason = rejection(&tripod(with.clone(), &moved), None);
            assert!(reason.starts_with(step), "{moved:?}: {reason}");
        }
    }
    // With a node of the body it is false (theory, Theorem 19.7).
    let inside = tripod(
        json!([[0, 4], [3, 4], [1, 3], [2, 6], [4, 6]]),
        &[0, 1, 2, 4, 3, 6],
    );
    assert_eq!(
        rejection(&inside, None),
        format!("{step}one of the last three nodes of a tripod is in the body")
    );
    let few = rejection(
        &tripod(json!([[0, 4], 0, [1, 5], [2, 6]]), &[0, 1, 2, 4, 5]),
        None,
    );
    assert!(few.starts_with(&format!("{step}`with` and `at`")), "{few}");
    refused(
        "tripod",
        &[("/model", json!("calibrated"))],
        &format!("{step}so many bodies are merged in the projective model only"),
    );
}

/// A K_4 of 0 to 3 and one of 4 to 7, with the pairs 04 and 15 and the path 2, 8, 6 between them.
#[test]
fn section_5_links() {
    let step = "bodies[1].merge[0]: ";
    let link = |with: Value, at: [u32; 7], more: &[(&str, Value)]| {
        let merge = json!({"with": with, "at": at});
        let mut value = named("link");
        *at_pointer(&mut value, "/bodies/1/merge/0") = merge;
        for (pointer, added) in more {
            let list = at_pointer(&mut value, pointer).as_array_mut().unwrap();
            list.push(added.clone());
        }
        value
    };
    let with = || json!([0, [0, 4], [1, 5], [2, 8], [6, 8]]);
    let at = [0, 1, 2, 4, 5, 6, 8];
    // The path begins where one pair does, and ends where the other one does.
    for (with, at) in [
        (
            json!([0, [0, 4], [1, 5], [0, 8], [5, 8]]),
            [0, 1, 0, 4, 5, 5, 8],
        ),
        (
            json!([0, [0, 4], [1, 5], [0, 8], [6, 8]]),
            [0, 1, 0, 4, 5, 6, 8],
        ),
        (
            json!([0, [0, 4], [1, 5], [2, 8], [4, 8]]),
            [0, 1, 2, 4, 5, 4, 8],
        ),
    ] {
        let value = link(with, at, &[]);
        assert!(check(value.to_string().as_bytes(), None).is_ok(), "{at:?}");
    }
    for (with, at, more, wanted) in [
        (
            json!([0, [0, 4], [1, 5], [0, 8], [4, 8]]),
            [0, 1, 0, 4, 5, 4, 8],
            &[][..],
            "the plane of 0, 8 and 4 holds a pair of the link",
        ),
        (
            json!([0, [0, 4], [1, 5], [1, 8], [5, 8]]),
            [0, 1, 1, 4, 5, 5, 8],
            &[],
            "the plane of 1, 8 and 5 holds a pair of the link",
        ),
        (
            json!([0, [0, 4], [0, 5], [2, 8], [6, 8]]),
            [0, 0, 2, 4, 5, 6, 8],
            &[],
            "two pairs of a link have a node in common",
        ),
        (
            json!([0, [0, 4], [1, 4], [2, 8], [6, 8]]),
            [0, 1, 2, 4, 4, 6, 8],
            &[],
            "two pairs of a link have a node in common",
        ),
        (
            with(),
            at,
            &[("/bodies/0/add", json!([3, 6, 7]))],
            "a link's bodies share a node",
        ),
        (
            with(),
            at,
            &[("/bodies/0/add", json!([8, 6, 7]))],
            "node 8 is in one of the two bodies that a link joins",
        ),
        (
            with(),
            at,
            &[("/bodies/1/add", json!([8, 2, 3]))],
            "node 8 is in one of the two bodies that a link joins",
        ),
        (
            json!([0, [1, 5], [0, 4], [2, 8], [6, 8]]),
            at,
            &[],
            "node 0 is not where the merge needs it",
        ),
    ] {
        let reason = rejection(&link(with, at, more), None);
        assert_eq!(reason, format!("{step}{wanted}"));
    }
    for (k, v) in (0..7).flat_map(|k| (0..9).map(move |v| (k, v))) {
        let mut moved = at;
        moved[k] = v;
        if moved != at {
            let reason = rejection(&link(with(), moved, &[]), None);
            assert!(reason.starts_with(step), "{moved:?}: {reason}");
        }
    }
}

/// A K_{2,3} with the sides 0, 1 and 2, 3, 4; the bodies {0, 2, 5} and {1, 3, 6} are in the place
/// of the edges 0-2 and 1-3.
#[test]
fn section_5_bicliques() {
    let step = "bodies[2].merge[0]: ";
    let merge =
        |with: &[Value], at: &[u32]| vec![("/bodies/2/merge/0", json!({"with": with, "at": at}))];
    let with = [
        json!([1, 2]),
        json!([0, 3]),
        json!(1),
        json!([0, 4]),
        json!([1, 4]),
    ];
    let at = [0, 1, 2, 3, 4];
    let misplaced = |changes: &[(&str, Value)]| {
        let reason = rejection(&changed("biclique", changes), None);
        let words = [
            "is not where the merge needs it",
            "are not different",
            "used a second time",
        ];
        assert!(
            reason.starts_with(step) && words.iter().any(|words| reason.ends_with(words)),
            "{changes:?}: {reason}"
        );
    };
    // Each of the six in the place of another one, and each node in that of another.
    for (k, l) in (0..5).flat_map(|k| (0..5).map(move |l| (k, l))) {
        if k != l {
            let mut other = with.clone();
            other[k] = with[l].clone();
            misplaced(&merge(&other, &at));
        }
    }
    for (k, v) in (0..5).flat_map(|k| (0..7).map(move |v| (k, v))) {
        if at[k] != v {
            let mut other = at;
            other[k] = v;
            misplaced(&merge(&with, &other));
        }
    }
    let lengths = "`with` and `at` have one and one or two, two and three, three and four, four and six, or five and five";
    let six = [&with[..], &[json!([0, 5])]].concat();
    for (with, at) in [
        (&with[..4], &at[..]),
        (&with[..], &at[..4]),
        (&six[..], &at[..]),
        (&six[..], &[0, 1, 2, 3, 4, 5][..]),
    ] {
        refused("biclique", &merge(with, at), &format!("{step}{lengths}"));
    }
    refused(
        "biclique",
        &[("/model", json!("calibrated"))],
        &format!("{step}so many bodies are merged in the projective model only"),
    );
    refused(
        "biclique",
        &[("/bodies/2/merge/0/with/4", json!([0, 1]))],
        &format!("{step}[0, 1] is not an edge (i < j) of the graph"),
    );
    refused(
        "biclique",
        &[("/bodies/2/merge/0/with/2", json!(0))],
        &format!("{step}body 0 is not an earlier one, or is used a second time"),
    );
    // What four bodies and an edge leave of it: all but one of the six.
    refused(
        "biclique",
        &[("/bodies/2/seed", json!([0, 3]))],
        &format!("{step}node 2 is not where the merge needs it"),
    );
    // The same six by other names: b for a, another order of the three, another one first.
    for (seed, with, at) in [
        (
            json!(0),
            json!([[1, 2], [0, 4], [1, 4], [0, 3], 1]),
            [0, 1, 2, 4, 3],
        ),
        (
            json!(1),
            json!([[0, 3], [1, 2], 0, [1, 4], [0, 4]]),
            [1, 0, 3, 2, 4],
        ),
        (
            json!([0, 4]),
            json!([[1, 4], 0, [1, 2], [0, 3], 1]),
            [0, 1, 4, 2, 3],
        ),
    ] {
        let mut value = named("biclique");
        value["bodies"][2]["seed"] = seed;
        value["bodies"][2]["merge"][0] = json!({"with": with, "at": at});
        assert!(check(value.to_string().as_bytes(), None).is_ok(), "{at:?}");
    }
}

/// Four bodies that each hold five nodes, all joined: only that the four nodes are different can be
/// wrong with a cycle.
#[test]
fn section_5_nodes_of_a_cycle_are_different() {
    let graph = Graph::from_graph6(b"D~{").unwrap();
    let body = |merge: Value| json!({"seed": [0, 1], "add": [[2, 0, 1], [3, 0, 1], [4, 0, 1]], "merge": merge});
    let with = |at: [u32; 4]| {
        let mut value = about(&graph, 10);
        value["model"] = json!("calibrated");
        let last = body(json!([{"with": [0, 1, 2], "at": at}]));
        value["bodies"] = json!([body(json!([])), body(json!([])), body(json!([])), last]);
        value["rigid"]["bodies"] = json!([3]);
        claim(&mut value, "solvable", [11, 11, 1]);
        value
    };
    let text = with([0, 1, 2, 3]).to_string();
    assert!(check(text.as_bytes(), Some(&graph)).is_ok());
    for (p, q) in [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)] {
        let mut at = [0, 1, 2, 3];
        at[q] = at[p];
        assert_eq!(
            rejection(&with(at), Some(&graph)),
            "bodies[3].merge[0]: the nodes of `at` are not different"
        );
    }
}

#[test]
fn section_6_pieces() {
    let all = json!([[0, 1], [0, 2], [1, 2]]);
    for (name, changes, wanted) in [
        (
            "triangle",
            vec![(
                "/bodies",
                json!([{"seed": [0, 1], "add": [], "merge": []}, {"seed": [0, 1], "add": [], "merge": []}]),
            )],
            "the edge [0, 1] is covered by two bodies",
        ),
        (
            "triangle",
            vec![
                ("/bodies", json!([])),
                ("/rigid/bodies", json!([])),
                ("/rigid/edges", all),
            ],
            "pieces: a piece closes a cycle of pieces at node 2",
        ),
        (
            "triangle",
            vec![("/rigid/bodies", json!([1]))],
            "rigid: 1 is not a final body",
        ),
        (
            "merges",
            vec![("/rigid/bodies", json!([0]))],
            "rigid: 0 is not a final body",
        ),
        (
            "triangle",
            vec![("/rigid/edges", json!([[0, 1]]))],
            "pieces: the edge [0, 1] is out of place",
        ),
        (
            "pair",
            vec![("/rigid/edges", json!([]))],
            "pieces: the edge [0, 1] is left out",
        ),
        (
            "pair",
            vec![("/rigid/edges", json!([[0, 1], [0, 1]]))],
            "rigid: the bodies or the edges are not increasing",
        ),
        (
            "pair",
            vec![("/rigid/edges", json!([[1, 0]]))],
            "rigid: [1, 0] is not an edge (i < j) of the graph",
        ),
        (
            "prism",
            vec![("P/bodies", json!([1, 0]))],
            "pieces[0]: the bodies or the edges are not increasing",
        ),
        (
            "square",
            vec![("/rigid/edges", json!([[0, 1]]))],
            "pieces: the edge [0, 1] is there twice",
        ),
        (
            "square",
            vec![("P/edges", json!([[0, 1], [0, 3], [1, 2]]))],
            "pieces: the edge [2, 3] is left out",
        ),
        (
            "path",
            vec![
                ("/rigid/edges", json!([[1, 2]])),
                (
                    "/pieces",
                    json!([{"bodies": [], "edges": [[0, 2]], "evidence": []}]),
                ),
            ],
            "pieces[0] has fewer than two bodies and edges",
        ),
        (
            "path",
            vec![(
                "/pieces",
                json!([{"bodies": [], "edges": [], "evidence": []}]),
            )],
            "pieces[0]: neither bodies nor edges",
        ),
    ] {
        let changes = match name {
            // The two edges of the path, whatever their names are.
            "path" => changes
                .into_iter()
                .map(|(pointer, value)| (pointer, of_path(value)))
                .collect(),
            _ => changes,
        };
        refused(name, &changes, wanted);
    }
}

/// The middle of the path is node 0, 1 or 2: its edges in the place of 0-2 and 1-2.
fn of_path(value: Value) -> Value {
    let edges = named("path")["rigid"]["edges"].clone();
    let text = value.to_string().replace("[0,2]", &edges[0].to_string());
    serde_json::from_str(&text.replace("[1,2]", &edges[1].to_string())).unwrap()
}

#[test]
fn section_6_cores() {
    // A triangle with an edge at it: the two share one node.
    let graph = Graph::new(4, [(0, 1), (0, 2), (1, 2), (2, 3)]).unwrap();
    let mut value = about(&graph, 4);
    value["bodies"] = json!([{"seed": [0, 1], "add": [[2, 0, 1]], "merge": []}]);
    value["pieces"] = json!([{"bodies": [0], "edges": [[2, 3]], "evidence": []}]);
    let wanted = "pieces[0]: body 0 has fewer than two nodes in the core";
    assert_eq!(rejection(&value, Some(&graph)), wanted);
    // Two bodies on the same two nodes, 0 and 3, which are not joined.
    let body = |x, y| [(0, x), (0, y), (x, y), (x, 3), (y, 3)];
    let graph = Graph::new(6, [body(1, 2), body(4, 5)].concat()).unwrap();
    let mut value = about(&graph, 10);
    value["bodies"] = json!([
        {"seed": [0, 1], "add": [[2, 0, 1], [3, 1, 2]], "merge": []},
        {"seed": [0, 4], "add": [[5, 0, 4], [3, 4, 5]], "merge": []}
    ]);
    value["pieces"] = json!([{"bodies": [0, 1], "edges": [], "evidence": []}]);
    let wanted = "pieces[0]: an edge of the core arises twice";
    assert_eq!(rejection(&value, Some(&graph)), wanted);
}

#[test]
fn section_7_evidence_of_a_piece() {
    for (name, changes, wanted) in [
        (
            "square",
            vec![("E/0", json!("remove"))],
            "pieces[0]: no lower bound on the rank",
        ),
        (
            "draws",
            vec![("E/1", json!("repeat"))],
            "E/[6] (draws): a second `draws` in the piece",
        ),
        (
            "square",
            vec![("E/2", json!("repeat"))],
            "E/[4] (classes): a second `classes` in the piece",
        ),
        (
            "square",
            vec![("E/3", json!("remove")), ("E/2", json!("remove"))],
            "pieces[0]: rank 28 is proved, but one component needs 29",
        ),
        (
            "square",
            vec![("E/2", json!("remove"))],
            "E/[2] (kernel): a kernel in a piece without `classes`",
        ),
        (
            "square-calibrated",
            vec![("E/0", minor())],
            "E/[0] (minor): not evidence in the calibrated model",
        ),
        (
            "square-calibrated",
            vec![(
                "P/evidence",
                json!([{"kind": "draws", "seed": "1", "count": 3, "rank": 8}]),
            )],
            "E/[0] (draws): not evidence in the calibrated model",
        ),
        (
            "rigid-class",
            vec![(
                "E/2/classes/0/evidence",
                json!([{"kind": "counting", "blocks": [], "bound": 1}]),
            )],
            "E/[2] (classes).classes[0].evidence[0] (counting): not a lower bound",
        ),
    ] {
        refused(name, &changes, wanted);
    }
}

fn minor() -> Value {
    json!({"kind": "minor", "prime": "101", "seed": "1", "draw": 0, "rows": [], "cols": []})
}

#[test]
fn section_7_pivots() {
    for (name, changes, wanted) in [
        (
            "square",
            vec![("E/0/rows/7", json!("remove"))],
            "E/[0] (plane-flow).N: 7 pivot rows, but 8 pivot columns",
        ),
        (
            "square",
            vec![("E/0/rows/7", json!(0))],
            "E/[0] (plane-flow).N: the pivots are not different indices below 8",
        ),
        (
            "square",
            vec![("E/0/rows/7", json!(8))],
            "E/[0] (plane-flow).N: the pivots are not different indices below 8",
        ),
        (
            "square",
            vec![("E/0/cols/7", json!(0))],
            "E/[0] (plane-flow).N: the pivots are not different indices below 12",
        ),
        (
            "square",
            vec![("E/0/cols/7", json!(12))],
            "E/[0] (plane-flow).N: the pivots are not different indices below 12",
        ),
        (
            "square",
            vec![("E/0/cols/0", json!(11))],
            "E/[0] (plane-flow).N: pivot 0 vanishes",
        ),
        (
            "bipartite",
            vec![("E/1/cols/0", json!(70))],
            "E/[1] (minor): pivot 0 vanishes",
        ),
        (
            "bipartite",
            vec![("E/1/rows/0", json!(90))],
            "E/[1] (minor): the pivots are not different indices below 90",
        ),
        (
            "bipartite",
            vec![("E/1/cols/0", json!(72))],
            "E/[1] (minor): the pivots are not different indices below 72",
        ),
        (
            "bipartite",
            vec![("E/0/lambda_rows/3", json!(16))],
            "E/[0] (plane-flow).Lambda: the pivots are not different indices below 16",
        ),
        (
            "bipartite",
            vec![("E/0/lambda_cols/3", json!(9))],
            "E/[0] (plane-flow).Lambda: the pivots are not different indices below 9",
        ),
        (
            "bipartite",
            vec![("E/0/lambda_cols/3", json!("remove"))],
            "E/[0] (plane-flow).Lambda: 4 pivot rows, but 3 pivot columns",
        ),
        (
            "integer",
            vec![("E/0/cols/0", json!(40))],
            "E/[0] (integer-minor): pivot 0 vanishes",
        ),
        (
            "integer-prime",
            vec![("E/0/cols/0", json!(40))],
            "E/[0] (integer-minor): pivot 0 vanishes",
        ),
    ] {
        refused(name, &changes, wanted);
    }
}

#[test]
fn section_7_flows() {
    refused(
        "square",
        &[("E/0/flows", json!(1))],
        "E/[0] (plane-flow): 1 flows, but only 0 rows are not pivots",
    );
    let fewer = [
        ("E/0/rows/7", json!("remove")),
        ("E/0/cols/7", json!("remove")),
        ("E/0/flows", json!(1)),
    ];
    refused(
        "square-calibrated",
        &fewer,
        "E/[0] (plane-flow): flows in the calibrated model",
    );
    // A flow that vanishes at the pivots only, also if Lambda has no pivots.
    let fewer = [
        ("E/0/rows/13", json!("remove")),
        ("E/0/cols/13", json!("remove")),
        ("E/0/flows", json!(5)),
        ("E/0/lambda_rows", json!([])),
        ("E/0/lambda_cols", json!([])),
    ];
    refused(
        "bipartite",
        &fewer,
        "E/[0] (plane-flow).flow 0: it does not vanish in all columns of N",
    );
    // Rows 0 and 4 of Lambda, the same column twice in effect: the second pivot vanishes.
    let dependent = [
        ("E/0/lambda_rows", json!([0, 1, 2, 3, 4])),
        ("E/0/lambda_cols", json!([0, 1, 3, 4, 5])),
    ];
    let reason = rejection(&changed("bipartite", &dependent), None);
    assert!(
        reason.contains("Lambda: pivot 4 vanishes") || reason.contains("impossible"),
        "{reason}"
    );
}

#[test]
fn section_7_integers() {
    let step = "E/[0] (integer-minor)";
    let mut value = named("integer");
    let vector = value["pieces"][0]["evidence"][0]["kernel"][0].clone();
    assert!(vector.is_array());
    let determinant = at(&mut value, "E/0/determinant")
        .as_str()
        .unwrap()
        .to_owned();
    let negated = determinant.replace('-', "");
    for (name, changes, wanted) in [
        (
            "integer",
            vec![("E/0/determinant", json!(negated))],
            "`determinant` is not that of the minor",
        ),
        (
            "integer",
            vec![("E/0/determinant", json!("0"))],
            "`determinant` is zero",
        ),
        (
            "integer",
            vec![("E/0/prime", json!("2305843009213693951"))],
            "one of `determinant` and `prime` is null",
        ),
        (
            "integer-prime",
            vec![("E/0/prime", json!(null))],
            "one of `determinant` and `prime` is null",
        ),
        (
            "integer-prime",
            vec![("E/0/prime", json!("9"))],
            "9 is not a prime",
        ),
    ] {
        refused(name, &changes, &format!("{step}: {wanted}"));
    }
    let kernel = format!("{step}.kernel");
    refused(
        "integer",
        &[("E/0/kernel/0", json!("repeat"))],
        &format!("{kernel}: the vectors depend on each other"),
    );
    refused(
        "integer",
        &[("E/0/kernel/0/0", json!("remove"))],
        &format!("{kernel}: vector 0 has 47 entries instead of 48"),
    );
    refused(
        "integer",
        &[("E/0/kernel/0/0", json!("1"))],
        &format!("{kernel}: vector 0 is not in the kernel"),
    );
}

#[test]
fn section_7_counting() {
    refused(
        "square",
        &[("E/1/bound", json!(27))],
        "E/[1] (counting): the bound is 27, but the blocks sum up to 28",
    );
    refused(
        "square",
        &[("E/1/blocks/0", json!("remove"))],
        "E/[1] (counting).blocks: the edge [0, 1] is left out",
    );
    refused(
        "square",
        &[("E/1/blocks/0", json!("repeat"))],
        "E/[1] (counting).blocks: the edge [0, 1] is there twice",
    );
    refused(
        "square",
        &[("E/1/blocks/0/edges", json!([]))],
        "E/[1] (counting).blocks: neither bodies nor edges",
    );
    refused(
        "prism",
        &[("E/1/blocks/0/bodies", json!([0, 0]))],
        "E/[1] (counting).blocks: the bodies or the edges are not increasing",
    );
    let hub = named("hub")["pieces"][0]["evidence"][1]["blocks"][0]["hubs"].clone();
    refused(
        "pentagon-calibrated",
        &[("E/1/blocks/0/hubs", hub)],
        "E/[1] (counting).blocks[0]: a hub in the calibrated model",
    );
    refused(
        "hub",
        &[("E/1/blocks/0/hubs/0", json!("repeat"))],
        "E/[1] (counting).blocks[0]: more than one hub",
    );
    let h = |member: &str| format!("E/1/blocks/0/hubs/0/{member}");
    for (member, new, wanted) in [
        ("node", json!(4), "node 4 is not in the block"),
        (
            "node",
            json!(1),
            "a part is split that does not contain node 1",
        ),
        (
            "split",
            json!([0, 2]),
            "a part is split that does not contain node 0",
        ),
        (
            "split",
            json!([0]),
            "the split graph has 1 components, not 2",
        ),
        (
            "split",
            json!([1, 0]),
            "`split` is not an increasing list of parts",
        ),
        (
            "split",
            json!([0, 4]),
            "`split` is not an increasing list of parts",
        ),
        (
            "components",
            json!(1),
            "the split graph has 2 components, not 1",
        ),
        ("less", json!(2), "the hub takes off 1, not 2"),
        ("groups", json!([[0], [1], [2]]), "a part is in no group"),
        (
            "groups",
            json!([[0], [1], [2], [3], [0]]),
            "part 0 stands in two groups",
        ),
        (
            "groups",
            json!([[0], [1], [2], [3], []]),
            "groups[4] is not an increasing list of parts",
        ),
        (
            "groups",
            json!([[0], [1], [2], [4]]),
            "groups[3] is not an increasing list of parts",
        ),
        (
            "groups",
            json!([[0], [1], [3, 2]]),
            "groups[2] is not an increasing list of parts",
        ),
        // One group of both edges at node 0 has four nodes, two of them copies: s = 8 + 2 + 2 - 8
        // = 4, and 2 - 1 - 3 s = -11.
        (
            "groups",
            json!([[0, 1], [2], [3]]),
            "the hub takes off -11, not 1",
        ),
    ] {
        let step = "E/[1] (counting).blocks[0].hubs[0]: ";
        refused("hub", &[(&h(member), new)], &format!("{step}{wanted}"));
    }
    refused(
        "hub",
        &[(&h("parts/3"), json!("remove"))],
        "E/[1] (counting).blocks[0].hubs[0].parts: the edge [2, 3] is left out",
    );
}

/// A hub that takes off nothing, and a block of two edges that do not meet.
#[test]
fn section_7_hubs() {
    let edge = |i: u32, j: u32| json!({"bodies": [], "edges": [[i, j]]});
    let hub = |parts: Value, split: Value, groups: Value, components: u32, less: i64| json!([{"node": 0, "parts": parts, "split": split, "groups": groups, "components": components, "less": less}]);
    let none = hub(
        json!([edge(0, 1), edge(0, 3), edge(1, 2), edge(2, 3)]),
        json!([]),
        json!([[0], [1], [2], [3]]),
        1,
        0,
    );
    let step = "E/[1] (counting).blocks[0].hubs[0]: ";
    refused(
        "hub",
        &[("E/1/blocks/0/hubs", none)],
        &format!("{step}the hub takes off 0, not 0"),
    );
    let apart = json!([
        {"bodies": [], "edges": [[0, 1], [2, 3]], "hubs": hub(json!([edge(0, 1), edge(2, 3)]), json!([0]), json!([[0], [1]]), 3, 1)},
        {"bodies": [], "edges": [[0, 3], [1, 2]], "hubs": []}
    ]);
    refused(
        "hub",
        &[("E/1/blocks", apart)],
        &format!("{step}the block is not connected"),
    );
}

#[test]
fn section_7_classes() {
    let step = "E/[2] (classes)";
    let split = json!({"rigid": {"bodies": [], "edges": [[0, 1], [0, 3]]}, "pieces": []});
    let joined = |split: Value| {
        vec![
            ("E/2/classes/1", json!("remove")),
            ("E/2/classes/0/edges", json!([[0, 1], [0, 3]])),
            ("E/2/classes/0/split", split),
        ]
    };
    refused(
        "square",
        &joined(split.clone()),
        "E/[3] (kernel): class 0 does not move as one",
    );
    let unsplit = vec![
        ("E/2/classes/1", json!("remove")),
        ("E/2/classes/0/edges", json!([[0, 1], [0, 3]])),
    ];
    refused(
        "square",
        &unsplit,
        &format!("{step}.classes[0]: not proved to have the rank 18"),
    );
    let single = json!({"rigid": {"bodies": [], "edges": [[0, 1]]}, "pieces": []});
    refused(
        "square",
        &[("E/2/classes/0/split", single)],
        &format!("{step}.classes[0]: a class that is single is not split"),
    );
    refused(
        "square",
        &[("E/2/classes/0/evidence", json!([minor()]))],
        &format!("{step}.classes[0]: evidence for a class that is single"),
    );
    let mut with_evidence = joined(split);
    with_evidence.push(("E/2/classes/0/evidence", json!([minor()])));
    refused(
        "square",
        &with_evidence,
        &format!("{step}.classes[0]: evidence for a class that is split"),
    );
    let all = json!([{"bodies": [], "edges": [[0, 1], [0, 3], [1, 2], [2, 3]], "evidence": [], "split": null}]);
    refused(
        "square",
        &[("E/2/classes", all)],
        &format!("{step}: fewer than two classes"),
    );
    refused(
        "square",
        &[("E/2/classes/3", json!("remove"))],
        &format!("{step}.classes: the edge [2, 3] is left out"),
    );
    let mut calibrated = named("pentagon-calibrated");
    let first = at(&mut calibrated, "E/2/classes/0/edges/0").clone();
    let second = at(&mut calibrated, "E/2/classes/1/edges/0").clone();
    let both = json!([first, second]);
    let changes = [
        ("E/2/classes/1", json!("remove")),
        ("E/2/classes/0/edges", both.clone()),
        (
            "E/2/classes/0/split",
            json!({"rigid": {"bodies": [], "edges": both}, "pieces": []}),
        ),
    ];
    refused(
        "pentagon-calibrated",
        &changes,
        &format!("{step}.classes[0]: a split class in the calibrated model"),
    );
    // Inside of a class the conditions are those of section 6.
    let inner = "E/2/classes/0/split/pieces/0";
    refused(
        "theta",
        &[(&format!("{inner}/evidence/1/bound"), json!(27))],
        &format!("{step}.classes[0].split.pieces[0].evidence[1] (counting): the bound is 27"),
    );
    refused(
        "theta",
        &[(&format!("{inner}/edges/3"), json!("remove"))],
        &format!("{step}.classes[0].split.pieces: the edge [2, 3] is left out"),
    );
    refused(
        "theta",
        &[(&format!("{inner}/edges/3"), json!([4, 5]))],
        &format!("{step}.classes[0].split.pieces: the edge [4, 5] is out of place"),
    );
    refused(
        "rigid-class",
        &[("E/2/classes/0/evidence/0/prime", json!("9"))],
        &format!("{step}.classes[0].evidence[0] (plane-flow)"),
    );
    // One pivot less: the class may be flexible.
    let fewer = [
        ("E/2/classes/0/evidence/0/lambda_rows/3", json!("remove")),
        ("E/2/classes/0/evidence/0/lambda_cols/3", json!("remove")),
    ];
    refused(
        "rigid-class",
        &fewer,
        &format!("{step}.classes[0]: not proved to have the rank 51"),
    );
}

#[test]
fn section_7_kernels() {
    let step = "E/[3] (kernel)";
    let vector = |entry: &str, size: usize| json!(vec![entry; size]);
    let changes = |value: Value| [("E/3/vector", value)];
    refused(
        "square",
        &changes(vector("0", 48)),
        &format!("{step}: two classes move alike"),
    );
    refused(
        "square",
        &changes(vector("0", 47)),
        &format!("{step}: `vector` has 47 entries instead of 48"),
    );
    refused(
        "square",
        &changes(vector("1000003", 48)),
        &format!("{step}: an entry is not a residue modulo 1000003"),
    );
    let mut unit = vec!["0"; 48];
    unit[0] = "1";
    refused(
        "square",
        &changes(json!(unit)),
        &format!("{step}: not a kernel vector at the core edge 0"),
    );
    // At other cameras the vector is none.
    refused(
        "square",
        &[("E/3/seed", json!("2"))],
        &format!("{step}: not a kernel vector at the core edge"),
    );
    refused(
        "draws",
        &[("E/3/prime", json!("1000003"))],
        "E/[3] (kernel): an entry is not a residue",
    );
    refused(
        "pentagon-calibrated",
        &changes(vector("0", 15)),
        &format!("{step}: two classes move alike"),
    );
    refused(
        "pentagon-calibrated",
        &changes(vector("0", 60)),
        &format!("{step}: `vector` has 60 entries instead of 15"),
    );
}

/// What separates classes: a motion at the very cameras at which the rank is that of counting.
#[test]
fn section_7_separation() {
    let not_separated = "claim.components: classes of a piece are not separated";
    refused("square", &[("E/3", json!("remove"))], not_separated);
    // The rank is proved at other cameras than those of the motion.
    let mut value = named("integer");
    let evidence = value["pieces"][0]["evidence"].as_array_mut().unwrap();
    let flow = evidence
        .iter()
        .position(|one| one["kind"] == "plane-flow")
        .unwrap();
    let seed = evidence[flow]["seed"].clone();
    let kernel = evidence.iter().find(|one| one["kind"] == "kernel").unwrap();
    assert_eq!(kernel["seed"], seed);
    evidence.remove(flow);
    assert_eq!(rejection(&value, None), not_separated);
    // One of the draws has no motion.
    refused("draws", &[("E/3", json!("remove"))], not_separated);
    refused("draws", &[("E/5", json!("remove"))], not_separated);
}

#[test]
fn section_9_draws() {
    let step = "E/[1] (draws)";
    refused(
        "draws",
        &[("E/1/count", json!(1))],
        &format!("{step}: `count` must be 3"),
    );
    refused(
        "draws",
        &[("E/1/count", json!(4))],
        &format!("{step}: `count` must be 3"),
    );
    for rank in [27, 29] {
        let wanted = format!("{step}: the largest of the ranks [28, 28, 28] is not {rank}");
        refused("draws", &[("E/1/rank", json!(rank))], &wanted);
    }
}

#[test]
fn section_8_claims() {
    let proof = |pointer: &str| {
        vec![
            (format!("{pointer}/strength"), json!("proof")),
            (format!("{pointer}/error_log2"), json!(null)),
        ]
    };
    let bound = |pointer: &str, error: i64| {
        vec![
            (format!("{pointer}/strength"), json!("error-bound")),
            (format!("{pointer}/error_log2"), json!(error)),
        ]
    };
    for member in ["verdict", "rank", "components"] {
        let pointer = format!("/claim/{member}");
        for (name, changes, wanted) in [
            (
                "draws",
                proof(&pointer),
                "the strength is not `proof`, but `error at most 2^-153 over the draws`",
            ),
            (
                "square",
                bound(&pointer, -153),
                "the strength is not `error at most 2^-153 over the draws`, but `proof`",
            ),
            (
                "draws",
                vec![(format!("{pointer}/error_log2"), json!(-152))],
                "the strength is not `error at most 2^-152",
            ),
            (
                "draws",
                vec![(format!("{pointer}/error_log2"), json!(-154))],
                "the strength is not `error at most 2^-154",
            ),
            (
                "draws",
                vec![(format!("{pointer}/error_log2"), json!(null))],
                "`error-bound` is no strength with this `error_log2`",
            ),
            (
                "square",
                vec![(format!("{pointer}/error_log2"), json!(-153))],
                "`proof` is no strength with this `error_log2`",
            ),
            (
                "square",
                vec![(format!("{pointer}/strength"), json!("guess"))],
                "`guess` is no strength with this `error_log2`",
            ),
        ] {
            let changes: Vec<_> = changes
                .iter()
                .map(|(pointer, value)| (&**pointer, value.clone()))
                .collect();
            refused(name, &changes, &format!("claim.{member}: {wanted}"));
        }
    }
    for (name, pointer, new, wanted) in [
        (
            "pair",
            "/claim/verdict/value",
            json!("finite-solvable"),
            "verdict: `finite-solvable` is claimed, but the evidence gives `solvable`",
        ),
        (
            "bipartite",
            "/claim/verdict/value",
            json!("solvable"),
            "verdict: `solvable` is claimed, but the evidence gives `finite-solvable`",
        ),
        (
            "square",
            "/claim/verdict/value",
            json!("finite-solvable"),
            "verdict: `finite-solvable` is claimed",
        ),
        (
            "square-calibrated",
            "/claim/verdict/value",
            json!("finite-solvable"),
            "verdict: `finite-solvable` is claimed",
        ),
        (
            "square",
            "/claim/verdict/value",
            json!("maybe\nVERIFIED"),
            "verdict: `maybe\\nVERIFIED` is claimed",
        ),
        (
            "pair",
            "/claim/rank/value",
            json!(6),
            "rank: `6` is claimed, but the evidence gives `7`",
        ),
        (
            "square",
            "/claim/rank/required",
            json!(28),
            "rank.required is 29, not 28",
        ),
        (
            "path",
            "/claim/components/value",
            json!(1),
            "components: `1` is claimed, but the evidence gives `2`",
        ),
    ] {
        refused(
            name,
            &[(pointer, new)],
            &format!("claim.{wanted}").replace("claim.rank.required", "claim: rank.required"),
        );
    }
    // No upper bound: the piece may have the required rank.
    refused(
        "square",
        &[("E/1", json!("remove"))],
        "claim.verdict: the evidence decides neither way",
    );
    // An upper bound that decides the verdict and not the rank: two edges in one block.
    let blocks = json!([
        {"bodies": [], "edges": [[0, 1], [1, 2]], "hubs": []}, {"bodies": [], "edges": [[0, 4]], "hubs": []},
        {"bodies": [], "edges": [[2, 3]], "hubs": []}, {"bodies": [], "edges": [[3, 4]], "hubs": []}
    ]);
    let mut value = named("pentagon");
    let evidence = value["pieces"][0]["evidence"].as_array_mut().unwrap();
    let counting = evidence
        .iter_mut()
        .find(|one| one["kind"] == "counting")
        .unwrap();
    counting["blocks"] = blocks;
    counting["bound"] = json!(18 + 3 * 7);
    assert_eq!(
        rejection(&value, None),
        "claim.rank: a piece has a rank from 35 to 39"
    );
}

/// Every limit stops what needs more, with an answer that is no rejection; with just enough it does
/// not.
#[test]
fn section_11_limits() {
    let run = |name: &str, limits: &Limits| {
        let text = named(name).to_string();
        Certificate::parse(text.as_bytes())
            .unwrap()
            .check(None, None, limits)
    };
    let all = Limits::default;
    for (name, enough, limits, option) in [
        ("square", true, Limits { core: 4, ..all() }, "--max-core"),
        ("square", false, Limits { core: 3, ..all() }, "--max-core"),
        (
            "bipartite",
            true,
            Limits { flows: 4, ..all() },
            "--max-flows",
        ),
        (
            "bipartite",
            false,
            Limits { flows: 3, ..all() },
            "--max-flows",
        ),
        (
            "integer",
            false,
            Limits { bits: 100, ..all() },
            "--max-bits",
        ),
        (
            "integer-prime",
            false,
            Limits { bits: 40, ..all() },
            "--max-bits",
        ),
        (
            "integer-prime",
            true,
            Limits { bits: 60, ..all() },
            "--max-bits",
        ),
        (
            "merges",
            false,
            Limits {
                operations: 10,
                ..all()
            },
            "--max-operations",
        ),
    ] {
        match run(name, &limits) {
            Ok(_) => assert!(enough, "{name}: {option} does not limit"),
            Err(Failure::TooLarge(limit)) => {
                assert!(!enough, "{name}: {limit}");
                assert_eq!(limit.option, option, "{name}: {limit}");
                assert!(limit.to_string().starts_with("too large for the limits: "));
            }
            Err(Failure::Rejected(rejection)) => panic!("{name}: {rejection}"),
        }
    }
    // Every kind of evidence is counted: whatever the limit, the answer is the right one or none.
    for name in [
        "integer",
        "integer-prime",
        "draws",
        "rigid-class",
        "theta",
        "prism",
        "pentagon-calibrated",
    ] {
        let mut steps = 0;
        for operations in (0..40).map(|k| 1 << k) {
            match run(
                name,
                &Limits {
                    operations,
                    ..all()
                },
            ) {
                Ok(_) => steps += 1,
                Err(Failure::TooLarge(limit)) => {
                    assert_eq!((steps, limit.option), (0, "--max-operations"), "{name}");
                }
                Err(Failure::Rejected(rejection)) => panic!("{name}: {rejection}"),
            }
        }
        assert!((5..30).contains(&steps), "{name}: {steps}");
    }
}
