//! Certificates for the number of solutions (section 12): for each condition one that breaks it and,
//! as far as that can be, nothing else; with the reason that must be given.

use crate::changes::{named, rejection};
use serde_json::{Value, json};
use std::path::Path;
use viewcert_check::{Certificate, Count, Failure, Graph, Limits, Verdict, check};

/// 2^61 - 1, the modulus of these certificates.
const P: u64 = (1 << 61) - 1;

fn text_of(name: &str) -> Value {
    named(&format!("../solutions/{name}"))
}

/// Where things stand that are changed most: upper and lower bound, and the merges of the first round.
fn expand(pointer: &str) -> String {
    for (short, long) in [
        ("U", "/solutions/upper"),
        ("L", "/solutions/lower"),
        ("M", "/solutions/rounds/0/merges"),
    ] {
        if let Some(rest) = pointer.strip_prefix(short) {
            return format!("{long}{rest}");
        }
    }
    pointer.to_owned()
}

fn at<'v>(value: &'v mut Value, pointer: &str) -> &'v mut Value {
    let pointer = expand(pointer);
    let found = value.pointer_mut(&pointer);
    found.unwrap_or_else(|| panic!("no {pointer}"))
}

fn changed(name: &str, changes: &[(&str, Value)]) -> Value {
    let mut value = text_of(name);
    for (pointer, new) in changes {
        let place = at(&mut value, pointer);
        assert_ne!(place, new, "{name}: {pointer} is not changed");
        *place = new.clone();
    }
    value
}

fn reason(value: &Value) -> String {
    rejection(value, None)
}

fn refused(name: &str, changes: &[(&str, Value)], wanted: &str) {
    let reason = reason(&changed(name, changes));
    let wanted = wanted
        .replace("U.", "solutions.upper.")
        .replace("L.", "solutions.lower.")
        .replace("M[", "solutions.rounds[0].merges[");
    assert!(reason.starts_with(&wanted), "{name} {changes:?}: {reason}");
}

fn value_at(name: &str, pointer: &str) -> Value {
    at(&mut text_of(name), pointer).clone()
}

/// Residues from text and back.
fn residue(value: &Value) -> u64 {
    value.as_str().unwrap().parse().unwrap()
}

/// 2 a - b modulo 2^61 - 1.
fn reflected(a: &Value, b: &Value) -> Value {
    let (a, b) = (u128::from(residue(a)), u128::from(residue(b)));
    json!(((2 * a + u128::from(P) - b) % u128::from(P)).to_string())
}

/// The triangle in `two` as a body by rank: it is rigid all the same, but nothing says unique.
#[test]
fn members_are_unique() {
    let rows = [
        0, 4, 1, 10, 3, 11, 7, 8, 12, 9, 13, 14, 20, 15, 21, 16, 22, 23,
    ];
    let cols = [0, 3, 1, 2, 4, 5, 6, 7, 8, 9, 10, 12, 13, 15, 16, 18, 19, 21];
    let minor = json!({"kind": "minor", "prime": P.to_string(), "seed": "1", "draw": 0, "rows": &rows[..], "cols": &cols[..]});
    let edges = [[0, 5], [0, 9], [5, 9]];
    let seed = json!({"bodies": [], "edges": edges, "evidence": [minor]});
    let body = json!({"seed": seed, "add": [], "merge": []});
    let reason = reason(&changed("two", &[("/bodies/0", body)]));
    let wanted = "solutions: solutions are counted between members that are unique";
    assert!(reason.starts_with(wanted), "{reason}");
}

/// Which solutions are oriented was evidence once.
#[test]
fn what_the_laboratory_has_is_refused_by_name() {
    let wanted = "evidence `oriented` belongs to the laboratory: this checker does not verify it";
    for place in ["/solutions/oriented", "/claim/solutions/oriented"] {
        let (object, _) = place.rsplit_once('/').unwrap();
        let mut text = text_of("two");
        text.pointer_mut(object).unwrap()["oriented"] = json!([]);
        let error = check(text.to_string().as_bytes(), None).unwrap_err();
        assert!(error.to_string().contains(wanted), "{place}: {error}");
    }
    let evidence = json!({"kind": "overlap", "first": [], "second": [], "bound": 1});
    let block = json!({"bodies": [], "edges": [], "hubs": [], "points": {}});
    for (kind, evidence) in [
        ("overlap", evidence),
        (
            "added",
            json!({"kind": "counting", "blocks": [], "added": []}),
        ),
        ("points", json!({"kind": "counting", "blocks": [block]})),
    ] {
        let text = changed("two", &[("/pieces/0/evidence/0", evidence)]).to_string();
        let error = check(text.as_bytes(), None).unwrap_err().to_string();
        let wanted = wanted.replace("oriented", kind);
        assert!(error.contains(&wanted), "{error}");
    }
}

#[test]
fn all_are_verified() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/solutions");
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), 7);
    for (name, solutions) in [
        ("linear", 1),
        ("point", 1),
        ("two", 2),
        ("absent", 2),
        ("link", 1),
        ("rounds", 1),
        ("stresses", 1),
    ] {
        let text = text_of(name).to_string();
        let verified =
            check(text.as_bytes(), None).unwrap_or_else(|error| panic!("{name}: {error}"));
        let exactly = Count {
            at_least: solutions,
            at_most: Some(solutions),
        };
        assert_eq!(verified.solutions, Some(exactly), "{name}");
        let solvable = verified.verdict.0 == Verdict::Solvable;
        assert_eq!(solvable, solutions == 1, "{name}");
        let said = format!("\nsolutions: exactly {solutions} (proof)");
        assert!(verified.to_string().contains(&said), "{name}: {verified}");
    }
}

/// What is known of one side alone is enough.
#[test]
fn bounds_of_one_side() {
    for (member, at_least, at_most, said) in [
        ("U", json!(2), json!(null), "at least 2"),
        ("L", json!(1), json!(2), "1 to 2"),
    ] {
        let changes = [
            (member, json!(null)),
            ("/claim/solutions/at_least", at_least),
            ("/claim/solutions/at_most", at_most),
        ];
        let changes = changes
            .into_iter()
            .filter(|(pointer, new)| value_at("two", pointer) != *new);
        let changes: Vec<_> = changes.collect();
        let value = changed("two", &changes);
        let verified = check(value.to_string().as_bytes(), None).unwrap();
        assert_eq!(verified.verdict.0, Verdict::FiniteSolvable);
        assert_eq!(verified.solutions.unwrap().to_string(), said);
    }
}

#[test]
fn section_8_the_claim() {
    for (member, new, wanted) in [
        ("at_least", json!(1), "`1 to 2` is claimed"),
        ("at_least", json!(3), "`3 to 2` is claimed"),
        ("at_most", json!(1), "`2 to 1` is claimed"),
        ("at_most", json!(3), "`2 to 3` is claimed"),
        ("at_most", json!(null), "`at least 2` is claimed"),
    ] {
        let member = format!("/claim/solutions/{member}");
        let wanted = format!("claim.solutions: {wanted}, but the evidence gives `exactly 2`");
        refused("two", &[(&member, new)], &wanted);
    }
    refused(
        "two",
        &[
            ("/claim/solutions/strength", json!("error-bound")),
            ("/claim/solutions/error_log2", json!(-120)),
        ],
        "claim.solutions: the strength is not `error at most 2^-120 over the draws`, but `proof`",
    );
    refused(
        "two",
        &[("/claim/verdict/value", json!("solvable"))],
        "claim.verdict: `solvable` is claimed, but the evidence gives `finite-solvable`",
    );
    refused(
        "point",
        &[("/claim/verdict/value", json!("finite-solvable"))],
        "claim.verdict: `finite-solvable` is claimed, but the evidence gives `solvable`",
    );
    refused(
        "two",
        &[("L", json!(null))],
        "claim.solutions: `exactly 2` is claimed, but the evidence gives `1 to 2`",
    );
}

#[test]
fn claim_and_document_have_solutions_or_neither_has() {
    let wanted = "claim.solutions: claim and document have `solutions`, or neither has";
    for (member, name) in [("", "two"), ("/claim", "two")] {
        let mut value = text_of(name);
        let object = value.pointer_mut(member).unwrap().as_object_mut().unwrap();
        object.remove("solutions").unwrap();
        assert_eq!(reason(&value), wanted);
    }
    for member in ["/solutions", "/claim/solutions"] {
        let reason = reason(&changed("two", &[(member, json!(null))]));
        assert!(reason.starts_with("invalid type: null"), "{reason}");
    }
    // Without both it is a certificate as before.
    let mut value = text_of("two");
    value.as_object_mut().unwrap().remove("solutions").unwrap();
    let claim = value["claim"].as_object_mut().unwrap();
    claim.remove("solutions").unwrap();
    let verified = check(value.to_string().as_bytes(), None).unwrap();
    assert_eq!(verified.solutions, None);
}

/// Not finite solvable, one body, other nodes, and the calibrated model.
#[test]
fn only_for_one_piece_that_is_finite_solvable() {
    for name in ["square", "triangle", "path", "square-calibrated"] {
        let mut value = named(name);
        value["solutions"] = json!({"upper": null, "lower": null});
        value["claim"]["solutions"] = value_at("point", "/claim/solutions");
        let wanted = "solutions: the graph is not one piece that is finite solvable, in the \
                      projective model";
        assert_eq!(reason(&value), wanted, "{name}");
    }
}

#[test]
fn evidence_of_the_right_kind() {
    refused(
        "link",
        &[("L", value_at("two", "L"))],
        "solutions: one member is left, and nothing else is to be shown",
    );
    refused(
        "point",
        &[("U", json!(null))],
        "solutions: neither an upper nor a lower bound",
    );
}

/// Members 0 and 1 of `link` are bodies; 23 is what the link makes of six members, and 24 the tripod.
#[test]
fn s1_what_is_merged() {
    let wanted = "M[2]: `with` is not an increasing list of two members or more";
    for with in [json!([24, 12]), json!([24]), json!([24, 24])] {
        refused("link", &[("M/2/with", with)], wanted);
    }
    for (with, number) in [(json!([0, 24]), 0), (json!([12, 25]), 25)] {
        let wanted = format!("M[2]: {number} is no member that is left");
        refused("link", &[("M/2/with", with)], &wanted);
    }
}

#[test]
fn s2_rules() {
    for (member, new, wanted) in [
        ("at", json!([3, 6, 8]), "`shared` is no rule for 3 nodes"),
        ("rule", json!("cycle"), "`cycle` is no rule for 2 nodes"),
        ("rule", json!("part"), "`part` is no rule for 2 nodes"),
        ("at", json!([3, 3]), "the nodes of `at` are not different"),
        ("at", json!([3, 10]), "member 12 holds no pair of the rule"),
        ("at", json!([3, 12]), "no member of `with` holds 3 and 12"),
        (
            "with",
            json!([12, 13, 24]),
            "member 13 holds no pair of the rule",
        ),
    ] {
        let place = format!("M/2/{member}");
        refused("link", &[(&place, new)], &format!("M[2]: {wanted}"));
    }
}

#[test]
fn s4_the_members_that_are_left() {
    let wanted = "chart: the chains and half-edges are not the members that are left";
    refused(
        "two",
        &[("U/chart/chains/1", json!([1, 7]))],
        &format!("U.{wanted}"),
    );
    refused(
        "two",
        &[("U/chart/chains/0", json!([0, 5]))],
        &format!("U.{wanted}"),
    );
    refused(
        "two",
        &[("L/chart/half_edges/0", json!([2, 6, 9]))],
        &format!("L.{wanted}"),
    );
}

#[test]
fn s5_half_edges() {
    let chains = [
        [0, 5, 9].as_slice(),
        &[1, 6],
        &[0, 7],
        &[1, 7],
        &[1, 8],
        &[5, 8],
        &[2, 8],
        &[3, 9],
    ];
    refused(
        "two",
        &[
            ("U/chart/chains", json!(chains)),
            ("U/chart/half_edges", json!([[6, 2, 3], [4, 7, 9]])),
        ],
        "U.chart: the first node of half-edge 0 lies elsewhere too",
    );
}

#[test]
fn s6_unknowns() {
    for new in [json!([5, 7]), json!([6, 6]), json!([9, 9]), json!([5, 77])] {
        refused(
            "two",
            &[("U/chart/unknowns/0", new)],
            "U.chart: unknown 0 is no scale of a chain, nor of a half-edge at its last node",
        );
    }
    refused(
        "two",
        &[("U/chart/unknowns/1", json!([5, 8]))],
        "U.chart: unknown 1 is listed twice",
    );
    refused(
        "two",
        &[("U/chart/unknowns", json!([[5, 8], [6, 8], [7, 9]]))],
        "U.chart: the scales that are one close a cycle of members and nodes",
    );
    let unknowns = json!([[5, 8], [6, 8], [7, 9], [8, 9], [0, 0]]);
    refused(
        "two",
        &[("U/chart/unknowns", unknowns)],
        "U.chart: the scales that are one do not join all members and nodes",
    );
}

#[test]
fn s7_centres() {
    refused(
        "two",
        &[("U/centres/prime", json!("2305843009213693953"))],
        "U.centres: 2305843009213693953 is not a prime with 5 <= p < 2^62",
    );
    let mut values = value_at("two", "U/centres/values");
    values.as_array_mut().unwrap().pop();
    refused(
        "two",
        &[("U/centres/values", values)],
        "U.centres: 9 centres for 10 shared nodes",
    );
    refused(
        "two",
        &[("U/centres/values/0", json!(["1", "2"]))],
        "U.centres: a centre has not three coordinates",
    );
    refused(
        "two",
        &[("U/points/centres/values/0/1", json!(P.to_string()))],
        "U.points.centres: a residue is not below the prime",
    );
}

#[test]
fn s8_degenerate_centres() {
    for node in ["5", "9"] {
        refused(
            "two",
            &[(
                &format!("L/centres/values/{node}/0"),
                value_at("two", "L/centres/values/0/0"),
            )],
            "L.centres: two nodes of chain 0 have the same first coordinate",
        );
    }
    // Node 2 half way between its neighbours 6 and 8.
    let [six, eight] = [6, 8].map(|node| value_at("two", &format!("L/centres/values/{node}")));
    let between: Vec<Value> = (0..3).map(|k| reflected(&six[k], &eight[k])).collect();
    refused(
        "two",
        &[("L/centres/values/2", json!(between))],
        "L.centres: the centres of half-edge 0 are collinear",
    );
}

#[test]
fn s9_to_s11_linear() {
    let wanted = "U.points.points[0].steps[0] (linear): `freed` is not an increasing list of one to four rows";
    for freed in [
        json!([]),
        json!([11, 12, 13, 14, 15]),
        json!([13, 12]),
        json!([16]),
    ] {
        refused(
            "point",
            &[("U/points/points/0/steps/0/freed", freed)],
            wanted,
        );
    }
    refused(
        "point",
        &[("U/points/points/0/steps/0/freed", json!([0, 12, 13, 14]))],
        "U.points.points[0].steps[0] (linear): row 0 has 0 unknowns that are not known, and not one",
    );
    refused(
        "point",
        &[("U/points/points/0/steps/0/freed", json!([12]))],
        "U.points.points[0].steps[0] (linear): the left kernel has dimension 0, where 13 less 14 is asked for",
    );
    refused(
        "point",
        &[("U/points/points/0/steps/0/settled", json!([]))],
        "U.points.points[0].steps[0] (linear): no unknown is settled",
    );
    refused(
        "point",
        &[("U/points/points/0/steps/0/settled", json!([1, 2, 3, 1]))],
        "U.points.points[0].steps[0] (linear): unknown 1 is known already",
    );
    for unknown in [0, 4] {
        refused(
            "point",
            &[("U/points/points/0/steps/0/settled", json!([unknown]))],
            &format!(
                "U.points.points[0].steps[0] (linear): unknown {unknown} does not follow from the left kernel"
            ),
        );
    }
    refused(
        "point",
        &[("U/points/points/0/steps/0/settled", json!([1, 2]))],
        "U.points.points[0]: unknown 3 is not known",
    );
    refused(
        "two",
        &[("U/points", json!(null))],
        "solutions.upper: unknown 0 is not known",
    );
}

#[test]
fn s12_unknowns_and_exponents() {
    for unknowns in [json!([0, 0]), json!([4])] {
        let last = unknowns.as_array().unwrap().last().unwrap().to_string();
        refused(
            "point",
            &[("U/points/unknowns", unknowns)],
            &format!("U.points: unknown {last} is listed twice, or known, or none"),
        );
    }
    let mut known = value_at("point", "U/points");
    known["centres"] = value_at("linear", "U/centres");
    refused(
        "linear",
        &[("U/points", known)],
        "U.points: unknown 0 is listed twice, or known, or none",
    );
    for name in ["point", "two"] {
        let nothing = ["U/points/unknowns", "U/points/bounds"].map(|at| (at, json!([])));
        refused(name, &nothing, "U.points: no unknown is listed");
        refused(
            name,
            &[("U/points/bounds", json!([0]))],
            "U.points: bounds[0] is not positive",
        );
    }
    refused(
        "point",
        &[("U/points/bounds", json!([2, 2]))],
        "U.points: 2 bounds for 1 unknowns",
    );
    refused(
        "point",
        &[("U/points/bounds", json!([4096]))],
        "U.points: there are more than 4096 exponents",
    );
    refused(
        "absent",
        &[("U/points/absent", json!([[3, 3], [0, 0]]))],
        "U.points: `absent` is not increasing",
    );
    for wrong in [json!([3, 4]), json!([3])] {
        refused(
            "absent",
            &[("U/points/absent/1", wrong)],
            "U.points: the exponent [3",
        );
    }
}

#[test]
fn s13_minors() {
    let minor = "U/points/minors/0";
    let place = "U.points.minors[0]: ";
    let columns: Vec<usize> = (0..18).collect();
    let (mut twice, mut wide) = (columns.clone(), columns.clone());
    (twice[1], wide[17]) = (0, 18);
    for (member, new, limit) in [
        ("cols", json!(twice), 18),
        ("cols", json!(wide), 18),
        ("rows", json!([1, 0, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]), 16),
        ("plus", json!([12, 13, 16]), 16),
        ("minus", json!([12, 12, 14]), 16),
    ] {
        refused(
            "point",
            &[(&format!("{minor}/{member}"), new)],
            &format!("{place}`{member}` is not an increasing list below {limit}"),
        );
    }
    refused(
        "point",
        &[(&format!("{minor}/cols"), json!(columns[..17]))],
        &format!("{place}18 rows and 17 columns"),
    );
    refused(
        "point",
        &[
            (&format!("{minor}/cols"), json!(columns[..17])),
            (
                &format!("{minor}/rows"),
                json!([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]),
            ),
        ],
        &format!("{place}a minor of size 17 need not vanish, one of size 18 does"),
    );
    refused(
        "point",
        &[(
            &format!("{minor}/rows"),
            json!([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12]),
        )],
        &format!("{place}row 12 is freed and not freed"),
    );
    refused(
        "point",
        &[(
            &format!("{minor}/rows"),
            json!([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 15]),
        )],
        &format!("{place}row 15 has an unknown that is neither known nor listed"),
    );
    refused(
        "point",
        &[("U/points/bounds", json!([1]))],
        &format!("{place}the degree 2 in unknown 0 is above its bound 1"),
    );
}

#[test]
fn s14_a_list_that_hides_a_monomial() {
    refused(
        "absent",
        &[("U/points/absent", json!([[0, 0], [0, 1], [3, 3]]))],
        "U.points.minors[0]: the exponent [0, 1] is said to be absent, but there may be a \
         coefficient",
    );
    refused(
        "point",
        &[("U/points/absent", json!([[2]]))],
        "U.points.minors[1]: the exponent [2] is said to be absent, but there may be a \
         coefficient",
    );
}

#[test]
fn s15_to_s18_points() {
    let point = "U/points/points/0";
    refused(
        "two",
        &[(&format!("{point}/values"), json!(["1", "1"]))],
        "U.points.points[0]: 2 values for 1 unknowns",
    );
    let disguised = residue(&value_at("two", &format!("{point}/values/0"))) + P;
    refused(
        "two",
        &[(&format!("{point}/values/0"), json!(disguised.to_string()))],
        "U.points.points[0]: a residue is not below the prime",
    );
    refused(
        "two",
        &[(&format!("{point}/values/0"), json!("2"))],
        "U.points.points[0]: a minor does not vanish at the point",
    );
    refused(
        "two",
        &[("U/points/points/0", value_at("two", "U/points/points/1"))],
        "U.points.points[1]: the point is there twice",
    );
    refused(
        "two",
        &[
            ("U/points/minors", json!([])),
            ("U/points/bounds", json!([1])),
        ],
        "U.points: the points are not independent on the inner exponents",
    );
    let mut points = value_at("two", "U/points/points");
    let mut third = points[1].clone();
    third["values"] = json!(["12345"]);
    points.as_array_mut().unwrap().push(third);
    refused(
        "two",
        &[
            ("U/points/minors", json!([])),
            ("U/points/bounds", json!([1])),
            ("U/points/points", points),
        ],
        "U.points.points[2]: there are more points than exponents",
    );
    let mut points = value_at("two", "U/points/points");
    points.as_array_mut().unwrap().pop();
    refused(
        "two",
        &[("U/points/points", points)],
        "U.points: 1 points, where 4 exponents less a rank of 2 are asked for",
    );
    refused(
        "absent",
        &[("U/points/absent", json!([[0, 0]]))],
        "U.points: 2 points, where 15 exponents less a rank of 12 are asked for",
    );
    refused(
        "two",
        &[(&format!("{point}/steps"), json!([]))],
        "U.points.points[0]: unknown 1 is not known",
    );
}

/// Three nodes of a chain whose first two coordinates are on a line: the row of the first and the
/// last is normal to their plane.
#[test]
fn s19_rows_of_a_chain_that_are_dependent() {
    let [first, middle, last] = [0, 5, 9].map(|node| format!("L/centres/values/{node}"));
    let changes: Vec<(String, Value)> = (0..2)
        .map(|k| {
            let [a, b] = [&middle, &first].map(|place| value_at("two", &format!("{place}/{k}")));
            (format!("{last}/{k}"), reflected(&a, &b))
        })
        .collect();
    let changes: Vec<(&str, Value)> = changes
        .iter()
        .map(|(place, new)| (place.as_str(), new.clone()))
        .collect();
    let wanted = "solutions.lower: the rows of chain 0 are dependent";
    refused("two", &changes, wanted);
}

/// Centres and points modulo 5 with one fault each. They were found by a search with another
/// implementation of (10.1) to (10.3).
#[test]
fn s20_to_s22_points_with_a_fault() {
    let centres = |digits: &str| {
        let centre = |three: &str| three.chars().map(String::from).collect::<Vec<_>>();
        let values: Vec<_> = digits.split(' ').map(centre).collect();
        json!({"prime": "5", "values": values})
    };
    let first = centres("002 213 421 040 414 314 403 120 143 413");
    let second = centres("300 243 021 443 221 412 112 020 304 213");
    for (centres, point, wanted) in [
        (&first, ["1", "1", "1", "1"], "the point is not simple"),
        (
            &first,
            ["1", "1", "1", "2"],
            "two cameras of the point have the same centre",
        ),
        (
            &second,
            ["1", "2", "1", "1"],
            "a camera of the point has rank below 3",
        ),
    ] {
        refused(
            "two",
            &[("L/centres", centres.clone()), ("L/points", json!([point]))],
            &format!("L.points[0]: {wanted}"),
        );
    }
    refused(
        "two",
        &[("L/points/0/0", json!("2"))],
        "L.points[0]: N(u) has rank 18, not 17",
    );
}

#[test]
fn s23_the_points_of_a_tight_core() {
    let chart = value_at("point", "U/chart");
    let centres = value_at("point", "U/centres");
    refused(
        "point",
        &[(
            "L",
            json!({"chart": chart, "centres": centres, "points": [["1", "1", "1", "1"]]}),
        )],
        "solutions.lower: the core is not tight, but has an excess of 4",
    );
    refused(
        "two",
        &[("L/points", json!([]))],
        "solutions.lower: there is no point",
    );
    refused(
        "two",
        &[("L/points/1", value_at("two", "L/points/0"))],
        "solutions.lower: points[1] is there twice",
    );
    refused(
        "two",
        &[("L/points/1/0", json!((P + 1).to_string()))],
        "L.points[1]: a residue is not below the prime",
    );
    refused(
        "two",
        &[("L/points/1", json!(["1", "1", "1"]))],
        "L.points[1]: 3 values for 4 unknowns",
    );
    refused(
        "two",
        &[("L/points/1/2", json!("0"))],
        "L.points[1]: a scale is zero",
    );
    // The identity counts in any case.
    let mut points = value_at("two", "L/points");
    points.as_array_mut().unwrap().pop();
    let value = changed("two", &[("L/points", points)]);
    let verified = check(value.to_string().as_bytes(), None).unwrap();
    assert!(verified.solutions.unwrap().at_least == 2);
}

#[test]
fn limits() {
    let with = |limits: Limits| {
        let certificate = Certificate::parse(text_of("two").to_string().as_bytes()).unwrap();
        let checked = certificate.check(None, None, &limits);
        checked.map_or_else(
            |failure| failure.to_string(),
            |verified| verified.to_string(),
        )
    };
    // The core of the piece has as many nodes as the chart has, and so it comes first.
    let rows = with(Limits {
        core: 12,
        ..Limits::default()
    });
    let wanted =
        "too large for the limits: solutions.upper.centres: 18 nodes of a core, of which 12";
    assert!(rows.starts_with(wanted), "{rows}");
    let mut least = 0;
    for operations in [1 << 16, 1 << 17, 1 << 18, 1 << 19] {
        let reason = with(Limits {
            operations,
            ..Limits::default()
        });
        least += usize::from(reason.starts_with("too large for the limits: solutions."));
    }
    assert!(least > 0);
}

/// Whatever is changed in the evidence, the certificate is rejected or proves the same.
#[test]
fn no_changed_scalar_changes_what_is_verified() {
    let (mut rejected, mut tried) = (0, 0);
    for name in ["link", "point", "two", "absent"] {
        let original = text_of(name);
        let said = check(original.to_string().as_bytes(), None)
            .unwrap()
            .to_string();
        let mut places = Vec::new();
        scalars(&original["solutions"], "/solutions".into(), &mut places);
        for place in places {
            for by in [1, -1] {
                let mut value = original.clone();
                let scalar = value.pointer_mut(&place).unwrap();
                *scalar = match &*scalar {
                    Value::Number(number) => json!(number.as_i64().unwrap() + by),
                    Value::String(text) => match text.parse::<i64>() {
                        Ok(number) => json!((number + by).to_string()),
                        Err(_) => json!(format!("{text}x")),
                    },
                    _ => json!(by),
                };
                tried += 1;
                match check(value.to_string().as_bytes(), None) {
                    Ok(verified) => assert_eq!(verified.to_string(), said, "{name}: {place}"),
                    Err(Failure::Rejected(_)) => rejected += 1,
                    Err(other) => panic!("{name}: {place}: {other}"),
                }
            }
        }
    }
    assert!(rejected > 500 && tried > rejected, "{rejected} of {tried}");
}

/// Where numbers, strings and nulls stand.
fn scalars(value: &Value, place: String, places: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            for (k, entry) in list.iter().enumerate() {
                scalars(entry, format!("{place}/{k}"), places);
            }
        }
        Value::Object(members) => {
            for (name, entry) in members {
                scalars(entry, format!("{place}/{name}"), places);
            }
        }
        _ => places.push(place),
    }
}

/// Changes the merges of `link` from one on.
fn linked(from: usize, merges: &[(&str, &[usize], &[u32])]) -> Value {
    let mut value = text_of("link");
    let list = at(&mut value, "M").as_array_mut().unwrap();
    list.truncate(from);
    for (rule, with, at) in merges {
        list.push(json!({"rule": rule, "with": with, "at": at}));
    }
    value
}

/// Two K_4 of 0 to 3 and of 4 to 7, which a link joins; then a tripod. Members 0 and 1 are the bodies, and
/// edges follow: 04, 05, 08, 09, 14, 15, 18, 1-10, 28, 2-11, 36, 37, 38, 39, 3-11, 48, 58, 68, 78, 9-10, 9-11.
#[test]
fn s2_tripods_and_links() {
    let link = [0, 1, 2, 7, 10, 19];
    for (with, at) in [
        ([0, 1, 2, 7, 4, 18], [0, 1, 0, 4, 5, 5, 8]),
        ([0, 1, 2, 7, 4, 19], [0, 1, 0, 4, 5, 6, 8]),
        ([0, 1, 2, 7, 10, 17], [0, 1, 2, 4, 5, 4, 8]),
    ] {
        let mut with = with;
        with.sort_unstable();
        let reason = reason(&linked(0, &[("link", &with, &at)]));
        let wanted = "solutions: `one-solution` where the merges leave several members";
        assert_eq!(reason, wanted, "{at:?}");
    }
    let at = [0, 1, 2, 4, 5, 6, 8];
    let common = "two pairs of the link have a node in common";
    let apart = "the link does not join two members without a node in common, nor with 8";
    let end = "an end of the path of the link is where none can be";
    let first = |rule, with: &[usize], at: &[u32], wanted: &str| {
        let reason = reason(&linked(0, &[(rule, with, at)]));
        assert_eq!(reason, format!("solutions.rounds[0].merges[0]: {wanted}"));
    };
    first(
        "link",
        &[0, 1, 2, 3, 10, 19],
        &[0, 0, 2, 4, 5, 6, 8],
        common,
    );
    first(
        "link",
        &[0, 1, 2, 6, 10, 19],
        &[0, 1, 2, 4, 4, 6, 8],
        common,
    );
    for (place, node) in [(2, 4), (2, 5), (2, 8), (5, 0), (5, 1), (5, 2), (5, 8)] {
        let mut moved = at;
        moved[place] = node;
        first("link", &link, &moved, end);
    }
    let plane = "the plane of 0, 8 and 4 holds a pair of the link";
    first("link", &[0, 1, 2, 4, 7, 17], &[0, 1, 0, 4, 5, 4, 8], plane);
    let plane = "the plane of 1, 8 and 5 holds a pair of the link";
    first("link", &[0, 1, 2, 7, 8, 18], &[0, 1, 1, 4, 5, 5, 8], plane);
    first("link", &link[1..], &at, apart);
    first(
        "link",
        &link[..1],
        &at,
        "`with` is not an increasing list of two members or more",
    );
    first("link", &link[..5], &at, "no member of `with` holds 8 and 6");
    first("link", &link, &at[..6], "`link` is no rule for 6 nodes");
    // A member of the link has a node of the other one, or 8.
    for (triangle, others) in [
        (
            ("triangle", &[1, 12, 13][..], &[3, 6, 7][..]),
            [0, 2, 7, 10, 19, 23],
        ),
        (
            ("triangle", &[1, 19, 20][..], &[6, 7, 8][..]),
            [0, 2, 7, 10, 23, 23],
        ),
        (
            ("triangle", &[0, 10, 14][..], &[2, 3, 8][..]),
            [1, 2, 7, 19, 23, 23],
        ),
    ] {
        let mut others = others.to_vec();
        others.dedup();
        let reason = reason(&linked(0, &[triangle, ("link", &others, &at)]));
        assert_eq!(reason, format!("solutions.rounds[0].merges[1]: {apart}"));
    }
    let second = |with: &[usize], at: &[u32], wanted: &str| {
        let reason = reason(&linked(1, &[("tripod", with, at)]));
        assert_eq!(reason, format!("solutions.rounds[0].merges[1]: {wanted}"));
    };
    // 5 hangs on the body as 4 in K_4 with 04, 45 and 51 does: with a node of the body it is false.
    let body = "no member of `with` has the first three nodes of `at` and none of the others";
    second(&[5, 11, 15, 22, 23], &[0, 1, 2, 9, 3, 11], body);
    second(&[5, 9, 16, 21, 22], &[0, 1, 3, 9, 10, 11], body);
    let different = "the nodes of `at` are not different";
    second(&[5, 9, 16, 21, 22, 23], &[0, 1, 1, 9, 10, 11], different);
    second(
        &[5, 9, 16, 21, 23],
        &[0, 1, 3, 9, 10, 11],
        "no member of `with` holds 9 and 11",
    );
}

/// A change of one round of `rounds`.
fn round_refused(round: usize, member: &str, new: Value, wanted: &str) {
    let pointer = format!("/solutions/rounds/{round}/{member}");
    let wanted = wanted.replace("R[", "solutions.rounds[");
    refused("rounds", &[(&pointer, new)], &wanted);
}

/// Three rounds take 12, 7 and 10 away. Members 0 to 18 are the edges, and the rest is merged behind the rounds.
#[test]
fn u1_to_u4_rounds() {
    let sets = |round| value_at("rounds", &format!("/solutions/rounds/{round}/sets"));
    let with = |round, added: Value| {
        let mut all = sets(round);
        all.as_array_mut().unwrap().push(added);
        all
    };
    round_refused(0, "sets", json!([[0, 7]]), "R[0]: fewer than two sets");
    let increasing = "R[0]: sets[0] is not an increasing list of two nodes or more";
    for set in [json!([7, 0]), json!([7]), json!([7, 7])] {
        round_refused(0, "sets/0", set, increasing);
    }
    let none =
        |round, set| format!("R[{round}]: no member that is left has all nodes of sets[{set}]");
    round_refused(0, "sets/0", json!([0, 8]), &none(0, 0));
    round_refused(0, "sets/0", json!([0, 7, 9]), &none(0, 0));
    // 9 and 1 are in one member from the first round on, and 1, 4 and 7 in none.
    round_refused(0, "sets/16", json!([1, 4]), &none(0, 16));
    round_refused(1, "sets/13", json!([1, 4, 7]), &none(1, 13));
    round_refused(
        0,
        "sets",
        with(0, json!([0, 7])),
        "R[0]: sets[17] shares two nodes with another set",
    );
    round_refused(
        1,
        "sets",
        with(1, json!([1, 9])),
        "R[1]: sets[14] shares two nodes with another set",
    );
    let lonely = json!([[0, 9], [0, 10], [1, 4, 9, 12]]);
    round_refused(
        1,
        "sets",
        lonely,
        "R[1]: sets[2] has fewer than two nodes in the core",
    );
    // Evidence is bound to the core, which has to be rigid.
    round_refused(
        0,
        "evidence",
        json!([]),
        "R[0]: not proved to have the rank",
    );
    let other = value_at("rounds", "/solutions/rounds/1/evidence");
    round_refused(0, "evidence", other, "R[0].evidence[0] (plane-flow)");
    let one = json!([{"kind": "one-solution"}]);
    round_refused(
        1,
        "evidence",
        one,
        "R[1].evidence[0] (one-solution): not a lower bound",
    );
    let mut fewer = sets(0);
    fewer.as_array_mut().unwrap().pop();
    round_refused(0, "sets", fewer, "R[0].evidence[0] (plane-flow)");
    // What is merged.
    let few = "R[0].merges[0]: `at` has less than three nodes, or one twice";
    for at in [json!([12, 1]), json!([]), json!([12, 1, 1])] {
        round_refused(0, "merges/0/at", at, few);
    }
    let inside = "R[0].merges[0]: node 1 is in the part, which is to be rigid without it";
    round_refused(0, "merges/0/at", json!([1, 4, 9]), inside);
    let outside = "R[0].merges[0]: a neighbour of 12 is not in the part";
    round_refused(0, "merges/0/at", json!([12, 1, 12345]), outside);
    let pair = "R[0].merges[0]: no member of `with` holds 12 and 9";
    round_refused(0, "merges/0/at", json!([12, 1, 9]), pair);
    let other = "R[0].merges[0]: member 0 holds no pair of the rule";
    round_refused(0, "merges/0/with", json!([0, 7, 15]), other);
    // Rounds in another order, none of them, and one that is missing.
    let rounds = value_at("rounds", "/solutions/rounds");
    let order = |places: &[usize]| -> Value { places.iter().map(|&k| rounds[k].clone()).collect() };
    for (places, wanted) in [
        (&[1, 0, 2][..], none(0, 13)),
        (&[0, 2, 1], none(1, 11)),
        (&[], "solutions: `rounds` without a round".into()),
    ] {
        let wanted = wanted.replace("R[", "solutions.rounds[");
        refused("rounds", &[("/solutions/rounds", order(places))], &wanted);
    }
}

/// Stresses, at the point where the rank is shown, and what they show at the nodes 4 and 8.
#[test]
fn u5_and_u6_stresses() {
    let rounds = "/solutions/rounds/0";
    let wrong = |changes: &[(&str, Value)], wanted: &str| {
        let changes: Vec<_> = changes
            .iter()
            .map(|(member, new)| (format!("{rounds}/{member}"), new.clone()))
            .collect();
        let changes: Vec<_> = changes
            .iter()
            .map(|(pointer, new)| (&pointer[..], new.clone()))
            .collect();
        let wanted = format!("solutions.rounds[0]{wanted}");
        refused("stresses", &changes, &wanted);
    };
    // The rank at another draw, and modulo another prime: the pivots are as good there, and so is the
    // evidence, but the stresses are none.
    let elsewhere = [
        ("evidence/0/draw", json!(1)),
        ("evidence/0/prime", json!("10009")),
    ];
    let camera = ".stresses[0]: it is not orthogonal to the cameras of edge 0";
    for change in elsewhere {
        wrong(std::slice::from_ref(&change), camera);
        let (member, new) = change;
        let mut value = changed("stresses", &[(&format!("{rounds}/{member}"), new)]);
        at(&mut value, rounds)["stresses"] = json!([]);
        let wanted = "solutions.rounds[0].merges[0]: no stress is at node 4 of the core";
        assert!(reason(&value).starts_with(wanted), "{}", reason(&value));
    }
    let evidence = value_at("stresses", &format!("{rounds}/evidence/0"));
    let twice = json!([evidence, evidence]);
    let one = ": stresses are not at the centres of one `plane-flow`";
    wrong(&[("evidence", twice)], one);
    // What a stress is.
    let stresses = value_at("stresses", &format!("{rounds}/stresses"));
    let first = |change: &dyn Fn(&mut Vec<Value>)| {
        let mut entries = stresses[0].as_array().unwrap().clone();
        change(&mut entries);
        [("stresses/0", json!(entries))]
    };
    let shorter = first(&|entries| drop(entries.pop()));
    wrong(&shorter, ".stresses[0]: not eight numbers for each edge");
    let larger = first(&|entries| entries[7] = json!("10007"));
    wrong(&larger, ".stresses[0]: a number is no residue");
    wrong(&first(&|entries| entries[0] = json!("1")), camera);
    let without = first(&|entries| entries[..8].fill(json!("0")));
    let sum = ".stresses[0]: it does not add up to zero at a node";
    wrong(&without, sum);
    // What is merged.
    let pairs = ["merges/0/at", "merges/0/with"];
    let few = ".merges[0]: `at` has less than three nodes, or one twice";
    for at in [json!([4, 7]), json!([4, 7, 8, 8])] {
        wrong(&[(pairs[0], at)], few);
    }
    let missing = ".merges[0]: a set with 4 has none of the nodes behind it";
    wrong(&[(pairs[0], json!([4, 7, 8]))], missing);
    let outside = ".merges[0]: 4 and 0 are in no set of the round";
    wrong(&[(pairs[0], json!([4, 7, 8, 9, 0]))], outside);
    let none = ".merges[0]: no stress is at node 10 of the core";
    wrong(&[(pairs[0], json!([10, 7, 8]))], none);
    let pair = ".merges[0]: no member of `with` holds 4 and 9";
    wrong(&[(pairs[1], json!([9, 10]))], pair);
    let more = ".merges[0]: member 0 holds no pair of the rule";
    wrong(&[(pairs[1], json!([0, 9, 10, 11]))], more);
    // Three rows a stress: two of them, and one three times, are not enough.
    for (stresses, rank) in [
        (json!([stresses[0], stresses[1]]), 6),
        (json!([stresses[2], stresses[2], stresses[2]]), 3),
    ] {
        let rank = format!(".merges[0]: the stresses have rank {rank} at node 4, not 8");
        wrong(&[("stresses", stresses)], &rank);
    }
    let other = json!({"rule": "stressed", "with": [7, 12], "at": [2, 1, 6]});
    let rank = ".merges[0]: the stresses have rank";
    wrong(&[("merges/0", other.clone())], rank);
    // Without stresses, and in no round.
    let mut value = text_of("stresses");
    at(&mut value, rounds)
        .as_object_mut()
        .unwrap()
        .remove("stresses");
    let wanted = "solutions.rounds[0].merges[0]: `stressed` in a round without `stresses`";
    assert!(reason(&value).starts_with(wanted), "{}", reason(&value));
    refused(
        "rounds",
        &[("M/0", other)],
        "M[0]: `stressed` in a round without `stresses`",
    );
}

#[test]
fn one_solution_is_finitely_many() {
    let mut value = text_of("rounds");
    let last = at(&mut value, "/solutions/rounds/2/merges");
    last.as_array_mut().unwrap().pop();
    assert_eq!(
        reason(&value),
        "solutions: `one-solution` where the merges leave several members"
    );
    for member in ["", "/claim"] {
        let object = value.pointer_mut(member).unwrap().as_object_mut().unwrap();
        object.remove("solutions").unwrap();
    }
    assert_eq!(
        reason(&value),
        "`one-solution` in a piece, and no `solutions`"
    );
    // In another model, and in one of two pieces.
    let wanted = "pieces[0].evidence[0] (one-solution): not a piece that is the whole graph";
    let graph = Graph::new(5, [(0, 1), (0, 3), (1, 2), (2, 3), (3, 4)]).unwrap();
    let mut value = named("square");
    value["pieces"][0]["evidence"] = json!([{"kind": "one-solution"}]);
    value["model"] = json!("calibrated");
    let of_model = reason(&value);
    assert!(of_model.starts_with(wanted), "{of_model}");
    let sha256: Vec<String> = graph.sha256().iter().map(|x| format!("{x:02x}")).collect();
    value["model"] = json!("projective");
    value["graph"] =
        json!({"name": "", "nodes": 5, "edges": 5, "sha256": sha256.concat(), "graph6": null});
    value["rigid"]["edges"] = json!([[3, 4]]);
    let of_piece = check(value.to_string().as_bytes(), Some(&graph)).unwrap_err();
    assert!(of_piece.to_string().starts_with(wanted), "{of_piece}");
    let more = json!({"kind": "one-solution", "rank": 128});
    let wanted = "unknown field";
    let mut value = text_of("rounds");
    *at(&mut value, "/pieces/0/evidence/0") = more;
    let error = check(value.to_string().as_bytes(), None)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains(wanted) || error.contains("`rank`"),
        "{error}"
    );
}
