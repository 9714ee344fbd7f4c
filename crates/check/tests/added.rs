//! `added` (section 7 of the specification): each of its conditions broken, with the reason.

use crate::changes::{at, changed, named, refused, rejection};
use serde_json::{Value, json};
use viewcert_check::check;

/// The first graph of Example 5.14, with an overlap to which the diagonals 2-5 and 6-13 of the cycle
/// 2-6-5-13 are added.
const NAME: &str = "added";

/// A body 0, 1, 8, to which a bound by counting is added for the piece with two pairs more: members
/// one by one, so that each of these pairs makes the bound larger by 7.
fn counting() -> Value {
    let mut value = named("overlap");
    let piece = at(&mut value, "P").clone();
    let block = |bodies: Value, edges: Value| json!({"bodies": bodies, "edges": edges, "hubs": []});
    let mut edges = piece["edges"].as_array().unwrap().clone();
    let added = [json!([0, 2]), json!([4, 8])];
    edges.extend(added.clone());
    let mut blocks = vec![block(json!([0]), json!([]))];
    blocks.extend(edges.iter().map(|edge| block(json!([]), json!([edge]))));
    let bound = 18 + 7 * edges.len();
    let counting = json!({"kind": "counting", "blocks": blocks, "bound": bound, "added": added});
    let evidence = at(&mut value, "E").as_array_mut().unwrap();
    evidence.push(counting);
    value
}

/// What is said about the bound by counting once something is changed.
fn refused_counting(change: impl Fn(&mut Value), wanted: &str) {
    let mut value = counting();
    change(at(&mut value, "E/4"));
    let wanted = format!("pieces[0].evidence[4] (counting){wanted}");
    assert_eq!(rejection(&value, None), wanted);
}

#[test]
fn it_is_for_the_projective_model() {
    let evidence = at(&mut counting(), "E/4").clone();
    for name in ["pentagon-calibrated", "affine-square"] {
        let mut value = named(name);
        let list = at(&mut value, "E").as_array_mut().unwrap();
        let place = list.len();
        list.push(evidence.clone());
        let model = value["model"].as_str().unwrap();
        let wanted = format!(
            "pieces[0].evidence[{place}] (counting).added: not evidence in the {model} model"
        );
        assert_eq!(rejection(&value, None), wanted, "{name}");
    }
}

#[test]
fn added_pairs_are_pairs_of_nodes_of_the_piece() {
    assert!(check(counting().to_string().as_bytes(), None).is_ok());
    let to = |pairs: Value| move |counting: &mut Value| counting["added"] = pairs.clone();
    for pairs in [
        json!([]),
        json!([[4, 8], [0, 2]]),
        json!([[0, 2], [0, 2], [4, 8]]),
    ] {
        refused_counting(to(pairs), ".added: not an increasing list of pairs");
    }
    for (pairs, wrong) in [
        (json!([[2, 0], [4, 8]]), "2, 0"),
        (json!([[0, 2], [4, 9]]), "4, 9"),
        (json!([[0, 2], [4, 4]]), "4, 4"),
    ] {
        let wanted = format!(".added: [{wrong}] is not a pair (i < j) of nodes of the piece");
        refused_counting(to(pairs), &wanted);
    }
    // An edge of the graph, an edge that the body covers, and two nodes of the body.
    for (pairs, wrong) in [
        (json!([[0, 2], [2, 3]]), "2 and 3"),
        (json!([[0, 1], [0, 2]]), "0 and 1"),
        (json!([[0, 2], [0, 8]]), "0 and 8"),
    ] {
        let wanted = format!(".added: {wrong} are nodes of one member");
        refused_counting(to(pairs), &wanted);
    }
}

#[test]
fn added_pairs_are_members() {
    // Without them their blocks have no edge to hold.
    refused_counting(
        |counting| {
            counting.as_object_mut().unwrap().remove("added");
        },
        ".blocks: [0, 2] is not an edge (i < j) of the graph",
    );
    refused_counting(
        |counting| counting["added"] = json!([[0, 2]]),
        ".blocks: [4, 8] is not an edge (i < j) of the graph",
    );
    refused_counting(
        |counting| {
            counting["blocks"].as_array_mut().unwrap().pop();
        },
        ".blocks: the edge [4, 8] is left out",
    );
    // No other evidence may have any: here the classes of the same piece.
    let mut value = counting();
    at(&mut value, "E/2")["added"] = json!([[0, 2]]);
    let reason = rejection(&value, None);
    let wanted = "the member `added` does not belong there";
    assert!(reason.contains(wanted), "{reason}");
}

#[test]
fn the_bound_is_for_the_piece_with_them() {
    refused_counting(
        |counting| counting["bound"] = json!(81),
        ": the bound is 81, but the blocks sum up to 95",
    );
    for bound in [159, 161] {
        let value = changed(NAME, &[("E/1/bound", json!(bound))]);
        let wanted = format!("pieces[0].evidence[1] (overlap): the bound is {bound}, but ");
        let reason = rejection(&value, None);
        assert!(reason.starts_with(&wanted), "{reason}");
        assert!(reason.ends_with(" is 160"), "{reason}");
    }
}

#[test]
fn the_claim_rests_on_it() {
    let value = named(NAME);
    assert!(check(value.to_string().as_bytes(), None).is_ok());
    refused(
        NAME,
        &[("E/1", json!("remove"))],
        "claim.verdict: the evidence decides neither way",
    );
    // One diagonal alone is not what the blocks are about.
    let reason = rejection(&changed(NAME, &[("E/1/added/1", json!("remove"))]), None);
    assert!(
        reason.contains("[6, 13] is not an edge (i < j) of the graph"),
        "{reason}"
    );
}

/// What is in both parts has a core of its own, with the pairs that are added to it; its draws are
/// bound to that.
#[test]
fn draws_are_bound_to_the_core_with_them() {
    let mut value = named(NAME);
    let piece = at(&mut value, "E/1/shared/pieces/0");
    // The diagonal is a member of it, without which its core has an edge less and so another hash.
    let edges = piece["edges"].as_array_mut().unwrap();
    assert!(edges.contains(&json!([2, 5])));
    edges.retain(|edge| *edge != json!([2, 5]));
    *at(&mut value, "E/1/shared/rigid/edges") = json!([[2, 5]]);
    let reason = rejection(&value, None);
    assert!(reason.contains("(overlap).shared"), "{reason}");
    let seed = json!("2");
    let value = changed(NAME, &[("E/1/shared/pieces/0/evidence/0/seed", seed)]);
    let reason = check(value.to_string().as_bytes(), None);
    assert!(
        reason.is_ok(),
        "pivots of generic cameras at other ones: {reason:?}"
    );
}
