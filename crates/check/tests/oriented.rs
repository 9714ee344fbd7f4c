//! Oriented solutions (section 12, (S27) to (S33)): a certificate with places of three kinds, and for each
//! condition one that breaks it, with the reason that must be given.

use num_bigint::BigInt;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use viewcert_check::{Failure, check};

fn document() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/solutions/oriented.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// The place with an oriented solution, the one with five nodes that prevent a plane, and the one
/// without real roots.
fn place(kind: &str) -> usize {
    let document = document();
    let places = document["solutions"]["oriented"]["places"].as_array();
    let is_kind = |place: &Value| {
        let roots = place["roots"].as_array().unwrap();
        match kind {
            "complex" => roots.is_empty(),
            _ => roots.iter().any(|root| !root[kind].is_null()),
        }
    };
    places.unwrap().iter().position(is_kind).unwrap()
}

fn reason(document: &Value) -> String {
    match check(document.to_string().as_bytes(), None) {
        Err(Failure::Rejected(rejection)) => rejection.to_string(),
        other => panic!("not rejected: {other:?}"),
    }
}

fn refused(document: &Value, wanted: &str) {
    let reason = reason(document);
    assert!(reason.contains(wanted), "{wanted}: {reason}");
}

/// With one value changed, below `solutions.oriented`.
fn broken(pointer: &str, new: Value, wanted: &str) {
    let mut document = document();
    let at = format!("/solutions/oriented{pointer}");
    let found = document
        .pointer_mut(&at)
        .unwrap_or_else(|| panic!("no {at}"));
    assert_ne!(*found, new, "{at} is not changed");
    *found = new;
    refused(&document, wanted);
}

/// In the place with an oriented solution.
fn broken_place(pointer: &str, new: Value, wanted: &str) {
    broken(&format!("/places/{}{pointer}", place("plane")), new, wanted);
}

fn value_at(pointer: &str) -> Value {
    document()
        .pointer(&format!("/solutions/oriented{pointer}"))
        .unwrap()
        .clone()
}

fn value_of_place(pointer: &str) -> Value {
    value_at(&format!("/places/{}{pointer}", place("plane")))
}

#[test]
fn what_is_shown() {
    let verified = check(document().to_string().as_bytes(), None).unwrap();
    let count = verified.solutions.clone().unwrap();
    assert_eq!(count.oriented, Some(vec![[1, 1], [3, 1], [3, 2]]));
    let words = "exactly 3, real ones that are oriented, near some cameras: 1 of 1, 1 of 3, 2 of 3";
    assert!(verified.to_string().contains(words), "{verified}");
}

#[test]
fn the_claim() {
    let wanted = "claim.solutions: `exactly 3";
    let mut changed = document();
    changed["claim"]["solutions"]["oriented"] = json!([[1, 1], [3, 2]]);
    refused(&changed, wanted);
    changed["claim"]["solutions"]
        .as_object_mut()
        .unwrap()
        .remove("oriented");
    refused(&changed, wanted);
    let mut changed = document();
    changed["solutions"]
        .as_object_mut()
        .unwrap()
        .remove("oriented");
    refused(&changed, wanted);
    changed["claim"]["solutions"]
        .as_object_mut()
        .unwrap()
        .remove("oriented");
    assert!(check(changed.to_string().as_bytes(), None).is_ok());
}

#[test]
fn not_with_known_parts_and_open_numbers() {
    let mut changed = document();
    changed["parts"] = json!([[0, 5, 6]]);
    changed["bodies"] = json!([]);
    refused(&changed, "oriented solutions, and known parts");
    let mut changed = document();
    changed["solutions"]["lower"] = Value::Null;
    refused(
        &changed,
        "oriented solutions, of which the number is not shown",
    );
}

#[test]
fn s27_lists() {
    let lists = value_at("/members");
    let with = |more: Value| {
        let mut lists = lists.as_array().unwrap().clone();
        lists.insert(0, more);
        Value::from(lists)
    };
    let fewer = "of nodes has fewer than two or is not increasing";
    broken("/members", with(json!([0])), fewer);
    broken("/members", with(json!([5, 0])), fewer);
    broken(
        "/members",
        with(json!([0, 1, 2])),
        "do not have all its nodes, or do not hang together",
    );
    broken(
        "/members",
        with(json!([0, 99])),
        "do not have all its nodes, or do not hang together",
    );
    broken(
        "/members",
        with(lists[0].clone()),
        "the lists are not tight",
    );
    let rest = lists.as_array().unwrap()[1..].to_vec();
    broken(
        "/members",
        rest.into(),
        "a member of the piece lies in no list",
    );
    broken("/places", json!([]), "there is no place");
    let twice = [value_at("/places/0"), value_at("/places/0")];
    broken(
        "/places",
        twice.to_vec().into(),
        "two places have the same numbers",
    );
}

#[test]
fn s28_centres() {
    let [i, j] = [0, 1].map(|k| value_at(&format!("/members/1/{k}")));
    let first = value_of_place(&format!("/centres/{i}"));
    broken_place(
        &format!("/centres/{j}"),
        first,
        "two centres of a list are the same",
    );
    let number = |v: u32, k: usize| -> i64 {
        let text = value_of_place(&format!("/centres/{v}/{k}"));
        text.as_str().unwrap().parse().unwrap()
    };
    // The third node of the triangle 0, 5, 6 on the line of the others.
    let on_line = [0, 1, 2].map(|k| (2 * number(5, k) - number(0, k)).to_string());
    broken_place(
        "/centres/6",
        json!(on_line),
        "three centres of a list are on a line",
    );
    broken_place(
        "/centres",
        json!([["1", "2", "3"]]),
        "not as many centres and cameras as nodes",
    );
}

#[test]
fn s29_residues() {
    let text = |pointer: &str| value_of_place(pointer).as_str().unwrap().to_owned();
    let p = text("/prime");
    broken_place("/prime", json!("2305843009213693949"), "is not a prime");
    broken_place(
        "/residues",
        json!([text("/residues/0")]),
        "not as many residues as roots",
    );
    broken_place(
        "/residues/1",
        text("/residues/0").into(),
        "two residues are the same",
    );
    broken_place("/residues/1", p.clone().into(), "is no residue");
    broken_place(
        "/residues/1",
        json!("5"),
        "the eliminant does not vanish at 5",
    );
    let zero = "the last coefficient of the eliminant is zero modulo p";
    broken_place("/eliminant/2", p.into(), zero);
    broken_place(
        "/eliminant/2",
        json!("0"),
        "the last coefficient of a polynomial is zero",
    );
    let shorter = [text("/eliminant/0"), text("/eliminant/1")];
    broken_place(
        "/eliminant",
        json!(shorter),
        "the degree of the eliminant is not 2",
    );
    broken_place(
        "/cameras/0/0",
        json!(["1", "2", "3"]),
        "the degree of a polynomial is too high",
    );
    let row = value_of_place("/cameras/0").as_array().unwrap()[..4].to_vec();
    broken_place(
        "/cameras/0",
        [&row[..], &row, &row].concat().into(),
        "a camera has rank below 3 modulo p",
    );
    let [i, j] = [0, 1].map(|k| value_at(&format!("/members/1/{k}")));
    let other = value_of_place(&format!("/cameras/{j}"));
    broken_place(
        &format!("/cameras/{i}"),
        other,
        "two cameras of a pair have the same centre modulo p",
    );
}

fn with_cameras(camera: impl Fn(usize) -> [[i64; 4]; 3]) -> Value {
    let constant = |x: i64| {
        if x == 0 {
            json!([])
        } else {
            json!([x.to_string()])
        }
    };
    let cameras = (0..10).map(|v| {
        camera(v)
            .concat()
            .into_iter()
            .map(constant)
            .collect::<Value>()
    });
    cameras.collect()
}

/// All centres in a plane.
#[test]
fn s29_rank() {
    let cameras = with_cameras(|v| {
        let v = v as i64;
        [[1, 0, 0, v], [0, 1, 0, v * v], [0, 0, 1, 0]]
    });
    broken_place("/cameras", cameras, "J_P of a solution has the rank");
}

/// Nothing changes modulo p.
#[test]
fn s30_other_matrices() {
    let number = |value: &Value| -> BigInt { value.as_str().unwrap().parse().unwrap() };
    let mut entry = value_of_place("/cameras/0/0");
    let moved = number(&entry[0]) + number(&value_of_place("/prime"));
    entry[0] = moved.to_string().into();
    broken_place("/cameras/0/0", entry, "has another fundamental matrix");
}

/// The given cameras are no other solution.
#[test]
fn s31_different() {
    let centre = |v: usize, k: usize| -> i64 {
        let text = value_of_place(&format!("/centres/{v}/{k}"));
        text.as_str().unwrap().parse().unwrap()
    };
    let cameras = with_cameras(|v| {
        [
            [1, 0, 0, -centre(v, 0)],
            [0, 1, 0, -centre(v, 1)],
            [0, 0, 1, -centre(v, 2)],
        ]
    });
    broken_place(
        "/cameras",
        cameras,
        "two solutions are not shown to be different",
    );
}

/// Arbitrary cameras, but for a pair of which one has columns along the base line where the other has not.
#[test]
fn s31_factors() {
    let centre = |v: usize, k: usize| -> i64 {
        let text = value_of_place(&format!("/centres/{v}/{k}"));
        text.as_str().unwrap().parse().unwrap()
    };
    let [i, j] = [0, 1].map(|k| value_at(&format!("/members/1/{k}")).as_u64().unwrap() as usize);
    let d = [0, 1, 2].map(|k| centre(i, k) - centre(j, k));
    let mut state = 1u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 40) as i64 + 1
    };
    let mut all: Vec<[[i64; 4]; 3]> = Vec::new();
    for v in 0..10 {
        let mut rows = [[0; 4]; 3];
        for (row, d) in rows.iter_mut().zip(d) {
            *row = std::array::from_fn(|c| match c {
                2 | 3 if v == i => d * (c as i64 - 1),
                0 | 1 if v == j => d * (c as i64 + 1),
                _ => random(),
            });
        }
        all.push(rows);
    }
    let cameras = with_cameras(|v| all[v]);
    broken_place("/cameras", cameras, "a pair has no factor modulo p");
}

#[test]
fn s32_intervals() {
    let between = value_of_place("/roots/0/between");
    let [a, b, d] = [0, 1, 2].map(|k| between[k].clone());
    broken_place("/roots/0/between", json!([b, a, d]), "this is no interval");
    broken_place(
        "/roots/0/between",
        json!([a, b, "0"]),
        "this is no interval",
    );
    let far = json!(["-2000000", "-1000000", "1"]);
    broken_place(
        "/roots/0/between",
        far,
        "the eliminant has no other sign at the other end",
    );
    let roots = value_of_place("/roots");
    let turned = json!([roots[1], roots[0]]);
    broken_place("/roots", turned, "the intervals are not increasing");
    let one = "the intervals are not as many as the real roots";
    broken_place("/roots", json!([roots[0]]), one);
    let complex = format!("/places/{}", place("complex"));
    assert_eq!(value_at(&format!("{complex}/roots")), json!([]));
}

/// Which root of a place has a plane, or five nodes; and the other one has neither.
fn root(kind: &str) -> usize {
    let roots = value_at(&format!("/places/{}/roots", place(kind)));
    usize::from(roots[0][kind].is_null())
}

#[test]
fn s33_kinds() {
    let (plane, five) = (place("plane"), place("five"));
    let (with_plane, with_five) = (root("plane"), root("five"));
    let against = |kind| format!("/places/{}/roots/{}", place(kind), 1 - root(kind));
    let at = |name| format!("/places/{plane}/roots/{with_plane}/{name}");
    let neither = "not just one of plane and five nodes";
    broken(&at("plane"), Value::Null, neither);
    broken(&at("five"), json!([0, 1, 2, 3, 4]), neither);
    broken(
        &format!("{}/five", against("plane")),
        json!([0, 1, 2, 3, 4]),
        "the signs contradict each other, and more is shown",
    );
    broken(
        &format!("{}/plane", against("five")),
        json!(["0", "0", "0", "1"]),
        "the signs contradict each other, and more is shown",
    );
    let at_five = format!("/places/{five}/roots/{with_five}/five");
    for wrong in [[1, 0, 2, 3, 4], [0, 1, 2, 3, 10]] {
        broken(&at_five, json!(wrong), "these are not five nodes");
    }
    // Of all choices of five nodes most do not prevent a plane, and of all planes most separate.
    let different = "the signs are not all the same";
    let rejected = |pointer: &str, new: Value| {
        let mut document = document();
        *document
            .pointer_mut(&format!("/solutions/oriented{pointer}"))
            .unwrap() = new;
        check(document.to_string().as_bytes(), None).map_err(|failure| failure.to_string())
    };
    let fives = (5..10).map(|v| json!([0, 1, 2, 3, v]));
    let fives: Vec<_> = fives.map(|five| rejected(&at_five, five)).collect();
    assert!(
        fives
            .iter()
            .any(|found| found.as_ref().is_err_and(|why| why.contains(different)))
    );
    let planes = ["1", "-1", "-40"].map(|x| json!(["1", x, "7", "-1"]));
    let planes = planes.map(|new| rejected(&at("plane"), new));
    assert!(
        planes
            .iter()
            .any(|found| found.as_ref().is_err_and(|why| why.contains(different)))
    );
}

/// Intervals with one root each, in which factors have no sign.
#[test]
fn s33_wide_intervals() {
    let between = value_of_place("/roots");
    let number = |root: usize, k: usize| -> i128 {
        between[root]["between"][k]
            .as_str()
            .unwrap()
            .parse()
            .unwrap()
    };
    let middle = number(0, 1) * number(1, 2) + number(1, 0) * number(0, 2);
    let below = 2 * number(0, 2) * number(1, 2);
    let far = 1_000_000 * below;
    let text = |ends: [i128; 3]| json!(ends.map(|x| x.to_string()));
    let mut roots = between.clone();
    roots[0]["between"] = text([-far, middle, below]);
    roots[1]["between"] = text([middle, far, below]);
    broken_place(
        "/roots",
        roots,
        "a sign is not the same in the whole interval",
    );
}

#[test]
fn several_solutions() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/solutions/linear.json");
    let mut one: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    one["solutions"]["upper"]["points"] = Value::Null;
    one["solutions"]["oriented"] = value_at("");
    refused(&one, "oriented: there is one solution only");
}

#[test]
fn not_in_parts_and_factors() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/solutions/product.json");
    let mut product: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    product["solutions"]["product"][0]["solutions"]["oriented"] = value_at("");
    refused(&product, "oriented solutions, and not of the whole graph");
}
