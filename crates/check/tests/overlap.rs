//! `overlap` (section 7 of the specification): each of its conditions broken, with the reason.

use crate::changes::{at, changed, named, refused, rejection};
use serde_json::{Value, json};
use viewcert_check::check;

/// Blocks of one edge each.
fn singles(edges: &[[u32; 2]]) -> Vec<Value> {
    let block = |edge| json!({"bodies": [], "edges": [edge], "hubs": []});
    edges.iter().map(block).collect()
}

/// The body 0, 1, 8 (rank 18) and the edges 03, 12, 23 on a cycle, the path 0-4-5-2 on the first
/// side, 1-6-7-3 on the second, which has 45 besides.
const NAME: &str = "overlap";

#[test]
fn it_is_for_the_projective_model() {
    let overlap = at(&mut named(NAME), "E/1").clone();
    for name in ["pentagon-calibrated", "affine-square"] {
        let mut value = named(name);
        let evidence = at(&mut value, "E").as_array_mut().unwrap();
        let place = evidence.len();
        evidence.push(overlap.clone());
        let model = value["model"].as_str().unwrap();
        let wanted =
            format!("pieces[0].evidence[{place}] (overlap): not evidence in the {model} model");
        assert_eq!(rejection(&value, None), wanted, "{name}");
    }
}

#[test]
fn blocks_of_each_side_are_verified() {
    refused(
        NAME,
        &[("E/1/first/1/edges", json!([]))],
        "E/[1] (overlap).first[1]: neither bodies nor edges",
    );
    refused(
        NAME,
        &[("E/1/second/3/edges", json!([[1, 2], [1, 6]]))],
        "E/[1] (overlap).second: the edge [1, 2] is there twice",
    );
    refused(
        NAME,
        &[("E/1/first/0/hubs/0/less", json!(2))],
        "E/[1] (overlap).first[0].hubs[0]: the hub takes off 1, not 2",
    );
    refused(
        NAME,
        &[("E/1/first/0/hubs/0", json!("repeat"))],
        "E/[1] (overlap).first[0]: more than one hub",
    );
    refused(
        NAME,
        &[("E/1/second/0/bodies", json!([1]))],
        "E/[1] (overlap).second[0]: 1 is not a final body",
    );
}

#[test]
fn both_sides_cover_the_piece() {
    refused(
        NAME,
        &[("E/1/second/7", json!("remove"))],
        "E/[1] (overlap): the edge [6, 7] is left out",
    );
    // The edge 01 is in the graph, and covered by the body.
    refused(
        NAME,
        &[("E/1/second/3/edges", json!([[0, 1], [1, 6]]))],
        "E/[1] (overlap): the edge [0, 1] is out of place",
    );
    refused(
        NAME,
        &[("E/1/second", json!(singles(&[[1, 6], [3, 7], [6, 7]])))],
        "E/[1] (overlap): nothing is in both `first` and `second`",
    );
}

/// The cycle with the body has 5 nodes, and its hub takes off 1: 39, and three edges make 60. The other
/// side is a body and seven edges: 18 + 7 * 7 = 67. Both have the cycle with the body, of which 39 is
/// the rank, and the edge 45.
#[test]
fn the_bound_is_what_follows() {
    for bound in [80, 82] {
        let reason = format!("E/[1] (overlap): the bound is {bound}, but 60 + 67 - 46 is 81");
        refused(NAME, &[("E/1/bound", json!(bound))], &reason);
    }
    refused(
        NAME,
        &[("E/1/first/0/hubs", json!([]))],
        "E/[1] (overlap): the bound is 81, but 61 + 67 - 46 is 82",
    );
}

#[test]
fn what_is_in_both_falls_into_pieces() {
    let rigid = "E/1/shared/rigid/edges";
    refused(
        NAME,
        &[(rigid, json!([]))],
        "E/[1] (overlap).shared.pieces: the edge [4, 5] is left out",
    );
    refused(
        NAME,
        &[(rigid, json!([[1, 6], [4, 5]]))],
        "E/[1] (overlap).shared.pieces: the edge [1, 6] is out of place",
    );
    let all = json!({
        "rigid": {"bodies": [0], "edges": [[0, 3], [1, 2], [2, 3], [4, 5]]}, "pieces": [],
    });
    refused(
        NAME,
        &[("E/1/shared", all)],
        "E/[1] (overlap).shared.pieces: a piece closes a cycle of pieces",
    );
    let mut value = changed(NAME, &[(rigid, json!([]))]);
    let piece = at(&mut value, "E/1/shared/pieces/0").clone();
    let alone = json!({"bodies": [], "edges": [[4, 5]], "evidence": piece["evidence"]});
    *at(&mut value, "E/1/shared/pieces") = json!([piece, alone]);
    assert_eq!(
        rejection(&value, None),
        "pieces[0].evidence[1] (overlap).shared: \
         pieces[1] has fewer than two bodies and edges"
    );
}

#[test]
fn its_rank_is_bounded_from_below_and_by_nothing_else() {
    let evidence = "E/1/shared/pieces/0/evidence";
    refused(
        NAME,
        &[(evidence, json!([]))],
        "E/[1] (overlap).shared.pieces[0]: no lower bound on the rank",
    );
    let counting = json!({"kind": "counting", "blocks": [], "bound": 1});
    refused(
        NAME,
        &[(evidence, json!([counting]))],
        "E/[1] (overlap).shared.pieces[0].evidence[0] (counting): not a lower bound",
    );
    let inner = at(&mut named(NAME), "E/1").clone();
    refused(
        NAME,
        &[(evidence, json!([inner]))],
        "E/[1] (overlap).shared.pieces[0].evidence[0] (overlap): not a lower bound",
    );
    refused(
        NAME,
        &[("E/1/shared/pieces/0/evidence/0/prime", json!("1000001"))],
        "E/[1] (overlap).shared.pieces[0].evidence[0] (plane-flow): 1000001 is not a prime",
    );
}

/// A pivot less of N makes the lower bound smaller by four; the best one of several counts. With a
/// bound of 85, above the 84 that is required, nothing is refuted.
#[test]
fn weaker_evidence_is_what_it_is() {
    let flow = "E/1/shared/pieces/0/evidence/0";
    let (row, col) = (format!("{flow}/rows/7"), format!("{flow}/cols/7"));
    let weaker = [(&row[..], json!("remove")), (&col[..], json!("remove"))];
    refused(
        NAME,
        &weaker,
        "E/[1] (overlap): the bound is 81, but 60 + 67 - 42 is 85",
    );
    let above = [&weaker[..], &[("E/1/bound", json!(85))]].concat();
    refused(
        NAME,
        &above,
        "claim.verdict: the evidence decides neither way",
    );
    let mut value = changed(NAME, &weaker);
    let best = at(&mut named(NAME), flow).clone();
    let list = at(&mut value, "E/1/shared/pieces/0/evidence");
    list.as_array_mut().unwrap().push(best);
    assert!(check(value.to_string().as_bytes(), None).is_ok());
}

/// Without it there is no upper bound below what is required, and no proof that the classes are
/// separated rests on the lower bound alone.
#[test]
fn the_claim_rests_on_it() {
    refused(
        NAME,
        &[("E/1", json!("remove"))],
        "claim.verdict: the evidence decides neither way",
    );
    let verified = check(named("overlap-hubs").to_string().as_bytes(), None).unwrap();
    assert_eq!((verified.rank.0, verified.required), (138, 139));
    assert_eq!(verified.components.0, 20);
}

/// A side may be the whole piece: nothing is gained, and nothing is wrong.
#[test]
fn one_side_may_be_all() {
    let edges = at(&mut named(NAME), "P/edges").clone();
    let edges: Vec<[u32; 2]> = serde_json::from_value(edges).unwrap();
    let body = json!({"bodies": [0], "edges": [], "hubs": []});
    let first = [&[body], &singles(&edges)[..]].concat();
    let value = changed(
        NAME,
        &[
            ("E/1/first", json!(first)),
            ("E/1/second", json!(singles(&[[4, 5]]))),
            ("E/1/shared/pieces", json!([])),
        ],
    );
    assert!(check(value.to_string().as_bytes(), None).is_ok());
}
