//! `points` (section 7 of the specification): each of its conditions broken, with the reason.

use crate::changes::{at, changed, named, refused, rejection};
use serde_json::{Value, json};
use viewcert_check::{Strength, Verdict, check};

/// Example 5.18 of the theory: the triangle 1 3 4 is a body, and a chain of the core; seven and eight
/// see two flows each.
const NAME: &str = "points";

fn points(member: &str) -> String {
    format!("E/1/blocks/0/points{member}")
}

fn refuses(member: &str, new: Value, wanted: &str) {
    let step = "E/[1] (counting).blocks[0].points";
    refused(NAME, &[(&points(member), new)], &format!("{step}{wanted}"));
}

#[test]
fn they_are_for_the_projective_model() {
    let own = at(&mut named(NAME), &points("")).clone();
    for name in ["pentagon-calibrated", "affine-square"] {
        let mut value = named(name);
        let model = value["model"].as_str().unwrap().to_owned();
        at(&mut value, "E/1/blocks/0")["points"] = own.clone();
        let wanted = format!(
            "pieces[0].evidence[1] (counting).blocks[0].points: points in the {model} model"
        );
        assert_eq!(rejection(&value, None), wanted, "{name}");
    }
}

#[test]
fn a_block_has_a_hub_or_points() {
    let hub = named("hub")["pieces"][0]["evidence"][1]["blocks"][0]["hubs"].clone();
    let mut value = named("hub");
    at(&mut value, "E/1/blocks/0")["points"] =
        json!({"base": [], "at": [], "cycles": 0, "less": 1});
    let wanted = "pieces[0].evidence[1] (counting).blocks[0]: a hub and points";
    assert_eq!(rejection(&value, None), wanted);
    // A hub alone, and a member that is unknown.
    refused(
        NAME,
        &[("E/1/blocks/0/hubs", hub)],
        "E/[1] (counting).blocks[0].hubs[0].parts",
    );
    let mut value = named(NAME);
    at(&mut value, &points(""))["flows"] = json!(1);
    assert!(rejection(&value, None).contains("the member `flows` does not belong there"));
}

#[test]
fn what_a_block_loses_its_core_loses() {
    // Without what is at the triangle the body has one node of the core of the block.
    let edges = at(&mut named(NAME), "P/edges").clone();
    let at_triangle = |edge: &&Value| {
        [1, 3, 4]
            .iter()
            .any(|v| edge.as_array().unwrap().contains(&json!(v)))
    };
    let all = edges.as_array().unwrap();
    let (near, far): (Vec<&Value>, Vec<&Value>) = all.iter().partition(at_triangle);
    let mut value = named(NAME);
    let own = at(&mut value, &points("")).clone();
    *at(&mut value, "E/1/blocks") = json!([
        {"bodies": [0], "edges": far, "hubs": [], "points": own},
        {"bodies": [], "edges": near, "hubs": []}
    ]);
    let wanted = "pieces[0].evidence[1] (counting).blocks[0].points: body 0 has fewer than two nodes in the core";
    assert_eq!(rejection(&value, None), wanted);
}

#[test]
fn sets_are_divided() {
    let triangle = || json!([[1, 3], [1, 4], [3, 4]]);
    refuses(
        "/base",
        json!([triangle(), []]),
        ".base: list 1 is not an increasing list of edges",
    );
    refuses(
        "/base",
        json!([[[1, 4], [1, 3], [3, 4]]]),
        ".base: list 0 is not an increasing list of edges",
    );
    refuses(
        "/base",
        json!([[[1, 3], [1, 3], [1, 4], [3, 4]]]),
        ".base: list 0 is not an increasing list of edges",
    );
    refuses(
        "/base",
        json!([[[1, 3], [1, 4], [1, 5]]]),
        ".base: (1, 5) is not an edge (i < j) of the core",
    );
    refuses(
        "/base",
        json!([[[1, 3], [1, 4], [4, 3]]]),
        ".base: (4, 3) is not an edge (i < j) of the core",
    );
    refuses(
        "/base",
        json!([triangle(), [[3, 4]]]),
        ".base: an edge is in two lists",
    );
    // Two edges of three nodes have a rank of four, not of five.
    refuses(
        "/base",
        json!([[[1, 3], [1, 4]]]),
        ".base: -1 flows are counted",
    );
    refuses(
        "/at/1/edges/0/0",
        json!([0, 1]),
        ".at[1]: (0, 1) is not an edge (i < j) of the core",
    );
}

#[test]
fn points_are_different_nodes_of_the_core() {
    refuses(
        "/at/0/node",
        json!(17),
        ".at[0]: node 17 is not in the core",
    );
    refuses("/at/0/node", json!(8), ".at[1]: node 8 is there twice");
    let one = at(&mut named(NAME), &points("/at/0")).clone();
    let five: Vec<Value> = [1, 2, 3, 4, 5]
        .into_iter()
        .map(|node| json!({"node": node, "edges": one["edges"]}))
        .collect();
    refuses(
        "/at",
        json!(five),
        ": 5 points, but at most four are independent",
    );
}

#[test]
fn each_sees_the_flows_of_the_base() {
    // The triangle is a list of its own for one of them, and in the only list of the other.
    let lists = at(&mut named(NAME), &points("/at/0/edges")).clone();
    let without: Vec<Value> = lists
        .as_array()
        .unwrap()
        .iter()
        .filter(|list| **list != json!([[1, 3], [1, 4], [3, 4]]))
        .cloned()
        .collect();
    assert_eq!(without.len(), 1);
    refuses(
        "/at/0/edges",
        json!(without),
        ".at[0]: the edge (1, 3) of `base` is not in the set",
    );
}

/// 25 edges and 17 nodes: 7 * 25 - 172 = 3. The triangle has one flow, which counts twice besides the
/// points, and these see two each. What circulates are the triangle and the cycle 2 6 5 12.
#[test]
fn what_they_take_off_is_what_follows() {
    let verified = check(named(NAME).to_string().as_bytes(), None).unwrap();
    assert_eq!(
        verified.verdict,
        (Verdict::NotFiniteSolvable, Strength::Proof)
    );
    for cycles in [1, 3] {
        let wanted = format!(": there are 2 independent cycles, not {cycles}");
        refuses("/cycles", json!(cycles), &wanted);
    }
    for less in [0, 2] {
        refuses(
            "/less",
            json!(less),
            &format!(": the points take off 1, not {less}"),
        );
    }
    // Without the base nothing is left: 2 + 2 - 2 - 3.
    refuses("/base", json!([]), ": the points take off -1, not 1");
    // What node 9 leaves of its set is on more cycles.
    refuses("/at/0/node", json!(9), ": there are ");
    let bound = changed(
        NAME,
        &[(&points("/at"), json!([])), (&points("/cycles"), json!(1))],
    );
    let wanted = "pieces[0].evidence[1] (counting).blocks[0].points: the points take off 0, not 1";
    assert_eq!(rejection(&bound, None), wanted);
    let none = changed(
        NAME,
        &[
            (&points("/at"), json!([])),
            (&points("/cycles"), json!(1)),
            (&points("/less"), json!(0)),
        ],
    );
    let wanted = "pieces[0].evidence[1] (counting).blocks[0].points: the points take off 0, not 0";
    assert_eq!(rejection(&none, None), wanted);
    refused(
        NAME,
        &[("E/1/bound", json!(170))],
        "E/[1] (counting): the bound is 170, but the blocks sum up to 171",
    );
}

/// The second side of a graph of Example 5.10 is the graph of Example 5.6. There all edges have one
/// flow, and are a tree without node 3: one point takes off what the hub does, and no base is needed.
#[test]
fn in_an_overlap_by_the_numbers_of_the_core() {
    let mut value = named("overlap-hubs");
    let block = at(&mut value, "E/1/second/0");
    assert_eq!(block["hubs"][0]["less"], 1);
    block["hubs"] = json!([]);
    let nodes = [1, 2, 3, 4, 8, 9, 10, 11, 13];
    let number = |node: &Value| nodes.iter().position(|other| node == other);
    let edges = block["edges"].as_array().unwrap();
    let edges: Vec<[usize; 2]> = edges
        .iter()
        .map(|edge| [0, 1].map(|end| number(&edge[end]).unwrap()))
        .collect();
    let points = |node: usize| json!({"base": [], "at": [{"node": node, "edges": [edges]}], "cycles": 0, "less": 1});
    let mut with = |points: Value| {
        at(&mut value, "E/1/second/0")["points"] = points;
        value.clone()
    };
    let verified = check(with(points(2)).to_string().as_bytes(), None).unwrap();
    assert_eq!(verified.rank, (138, Strength::Proof));
    // Node 3 of the graph is not the fourth of the core, which has number 3.
    let wanted = "pieces[0].evidence[1] (overlap).second[0].points: there are ";
    assert!(rejection(&with(points(3)), None).starts_with(wanted));
}
