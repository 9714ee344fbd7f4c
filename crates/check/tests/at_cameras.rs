//! Certificates at given cameras: what is verified, and each condition of section 14 broken once.

use crate::changes::{self, answer, rejected as refused};
use serde_json::{Value, json};
use viewcert_check::{Answer, Certificate, Failure, Limits, Strength, VerifiedHere};

fn named(name: &str) -> Value {
    changes::named(&format!("../at_cameras/{name}"))
}

fn check(document: &Value) -> Result<VerifiedHere, Failure> {
    match answer(document, None)? {
        Answer::AtCameras(verified) => Ok(*verified),
        other => panic!("{other}"),
    }
}

/// A certificate with another value at the place of a JSON pointer.
fn changed(name: &str, pointer: &str, value: Value) -> Value {
    changes::changed(&format!("../at_cameras/{name}"), &[(pointer, value)])
}

#[test]
fn what_is_verified() {
    for (name, rank, components) in [
        ("line", 25, 3),
        ("line-calibrated", 7, 3),
        ("line-affine", 16, 3),
        ("matrices", 25, 3),
        ("far", 29, 1),
        ("psi", 105, 15),
        ("digits", 28, 4),
        ("square", 8, 1),
    ] {
        let verified = check(&named(name)).unwrap();
        assert_eq!(verified.rank, (rank, Strength::Proof), "{name}");
        assert_eq!(verified.components, (components, Strength::Proof), "{name}");
        assert_eq!(verified.verdict == "determined", rank == verified.required);
    }
    let merge = json!([{"with": [[0, 3], [2, 3]], "at": [0, 2, 3]}]);
    let body = json!({"seed": [0, 2], "add": [], "merge": merge});
    check(&changed("line", "/bodies/0", body)).unwrap();
}

#[test]
fn the_document() {
    refused(
        "version 4 is unknown",
        &changed("line", "/version", json!(4)),
    );
    refused(
        "version 1 is not read any more; write the certificate anew",
        &changed("line", "/version", json!(1)),
    );
    refused(
        "`format` is not",
        &changed("line", "/format", json!("viewcert certificate at cameras")),
    );
    refused(
        "`cameras` does not belong there",
        &changed("line", "/question", json!("intrinsics")),
    );
    refused(
        "is not a model",
        &changed("line", "/model", json!("conformal")),
    );
    refused(
        "has another hash",
        &changed("line", "/graph/sha256", json!("0".repeat(64))),
    );
}

#[test]
fn centres() {
    let zero = json!(["0", "0", "0", "0"]);
    refused("3 centres for 4 nodes", &{
        let mut document = named("line");
        document["centres"].as_array_mut().unwrap().pop();
        document
    });
    refused(
        "the centre of node 0 is zero",
        &changed("line", "/centres/0", zero),
    );
    refused(
        "is none of the model",
        &changed("line-calibrated", "/centres/0/3", json!("0")).with("/centres/0/0", "1"),
    );
    refused(
        "is none of the model",
        &changed("line-affine", "/centres/0/3", json!("1")),
    );
    let same = named("line")["centres"][0].clone();
    refused("are not apart", &changed("line", "/centres/1", same));
    refused(
        "0 cameras for 4 nodes",
        &changed("matrices", "/cameras", json!([])),
    );
    refused(
        "11 entries instead of twelve",
        &changed("matrices", "/cameras/0", json!(vec!["1"; 11])),
    );
    refused(
        "the rank is not 3",
        &changed("matrices", "/cameras/0", json!(vec!["1"; 12])),
    );
    refused(
        "the matrix times the centre is not zero",
        &changed("matrices", "/cameras/0/3", json!("5")),
    );
}

/// What is zero modulo the prime that is looked at, and not zero, is told apart exactly.
#[test]
fn numbers_that_a_prime_does_not_tell() {
    let prime = ((1_u64 << 61) - 1).to_string();
    let product = (((1_u128 << 61) - 1) * ((1 << 31) - 1)).to_string();
    for far in [&prime, &product] {
        // The chart is that of t = 0, so that nothing else changes but the place.
        check(&changed("line", "/centres/3/3", json!(far))).unwrap();
        // Multiples of one vector are at one place, and others are not.
        let one = json!(["1", "0", "0", "1"]);
        let place = json!([far, "0", "0", far]);
        let same = changed("line", "/centres/0", one.clone());
        refused("are not apart", &same.with_value("/centres/1", place));
    }
    let singular = json!([
        prime, "0", "0", "1", "0", prime, "0", "1", "0", "0", "0", "0"
    ]);
    refused(
        "the rank is not 3",
        &changed("matrices", "/cameras/0", singular),
    );
    let regular = json!([
        prime, "0", "0", "1", "0", prime, "0", "1", "0", "0", prime, "1"
    ]);
    refused(
        "the matrix times the centre is not zero",
        &changed("matrices", "/cameras/0", regular.clone()),
    );
    let mut far = changed("matrices", "/cameras/0", regular);
    far["centres"][0] = json!(["-1", "-1", "-1", prime]);
    assert!(!check(&far).unwrap_err().to_string().contains("cameras[0]"));
}

/// Two bodies that share the nodes 0 and 3 are one (rule 2): listed as two, both have the pair in their
/// frames.
#[test]
fn bodies_that_share_two_nodes() {
    refused("an edge of the core arises twice", &named("diamonds"));
}

/// A second change.
trait With: Sized {
    fn with_value(self, pointer: &str, value: Value) -> Self;

    fn with(self, pointer: &str, text: &str) -> Self {
        self.with_value(pointer, text.into())
    }
}

impl With for Value {
    fn with_value(mut self, pointer: &str, value: Value) -> Self {
        *self.pointer_mut(pointer).unwrap() = value;
        self
    }
}

#[test]
fn bodies() {
    let body =
        |seed: Value, add: Value, merge: Value| json!({"seed": seed, "add": add, "merge": merge});
    let at = |body| changed("line", "/bodies/0", body);
    refused(
        "are not independent",
        &at(body(json!([0, 1]), json!([[2, 0, 1]]), json!([]))),
    );
    let merge = json!([{"with": [[0, 1], [1, 2]], "at": [0, 2, 1]}]);
    refused(
        "are not independent",
        &at(body(json!([0, 2]), json!([]), merge)),
    );
    let merge = json!([{"with": [[0, 1], [1, 2], [2, 3]], "at": [0, 1, 2, 3]}]);
    refused(
        "a merge with 3 others",
        &at(body(json!([0, 3]), json!([]), merge)),
    );
    let seed = json!({"bodies": [], "edges": [[0, 1], [0, 2]], "evidence": []});
    refused("a body by rank", &at(body(seed, json!([]), json!([]))));
    refused(
        "there is no node 9",
        &at(body(json!([0, 2]), json!([[9, 0, 2]]), json!([]))),
    );
    let merge = json!([{"with": [[0, 3], [2, 3]], "at": [0, 2, 9]}]);
    refused(
        "there is no node 9",
        &at(body(json!([0, 2]), json!([]), merge)),
    );
}

#[test]
fn ranks() {
    refused(
        "the rank modulo the first prime is 14",
        &changed("line", "/pieces/0/rank", json!(15)),
    );
    refused(
        "a rigid piece has one prime",
        &changed("square", "/pieces/0/primes", json!(2)),
    );
    refused("no primes", &changed("line", "/pieces/0/primes", json!(0)));
    let proof = named("digits")["pieces"][0]["primes"].as_u64().unwrap();
    for primes in [proof + 1, (1 << 53) - 1] {
        let more = changed("digits", "/pieces/0/primes", json!(primes));
        refused(&format!("{primes} primes, and {proof} are a proof"), &more);
    }
    refused(
        "is too large",
        &changed("digits", "/pieces/0/primes", json!(1)),
    );
    refused("fewer than two bodies and edges", &{
        let mut document = named("line");
        document["pieces"][0]["bodies"] = json!([]);
        document["pieces"][0]["edges"] = json!([[0, 1]]);
        document
    });
}

/// Fewer primes than a proof takes are an error bound, which the claim has to state.
#[test]
fn an_error_bound() {
    let mut document = changed("digits", "/pieces/0/primes", json!(3));
    let failure = check(&document).unwrap_err().to_string();
    let error = failure
        .split("2^")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap();
    let error: i64 = error.parse().unwrap();
    assert!((-150..=-100).contains(&error), "{failure}");
    for name in ["verdict", "rank", "components"] {
        document["claim"][name]["strength"] = json!("error-bound");
        document["claim"][name]["error_log2"] = json!(error);
    }
    let verified = check(&document).unwrap();
    assert_eq!(verified.rank.1, Strength::ErrorBound(error));
}

#[test]
fn classes() {
    let line = named("line")["pieces"][0].clone();
    let with = |key: &str, value: Value| changed("line", &format!("/pieces/0/{key}"), value);
    let shifted = |kernel: &Value| -> Value {
        let entries = kernel.as_array().unwrap().iter().enumerate();
        entries
            .map(|(k, _)| json!((k * k % 97).to_string()))
            .collect()
    };
    refused("is no vector of residues", &with("kernel", json!(["0"])));
    refused(
        "not a kernel vector",
        &with("kernel", shifted(&line["kernel"])),
    );
    refused(
        "fewer than two classes",
        &with("classes", json!([line["classes"][0]])),
    );
    refused(
        "is left out",
        &with("classes", json!([line["classes"][0], line["classes"][1]])),
    );
    let zero: Value = line["kernel"]
        .as_array()
        .unwrap()
        .iter()
        .map(|_| json!("0"))
        .collect();
    refused("two classes move alike", &with("kernel", zero));
    let split = json!({"rigid": {"bodies": [], "edges": []}, "pieces": []});
    refused(
        "a single member is not split",
        &changed("line", "/pieces/0/classes/0/split", split),
    );
    let psi = named("psi");
    let classes = psi["pieces"][0]["classes"].as_array().unwrap();
    let split = classes
        .iter()
        .position(|class| !class["split"].is_null())
        .unwrap();
    let pointer = format!("/pieces/0/classes/{split}/split");
    refused(
        "the class is not rigid",
        &changed("psi", &pointer, Value::Null),
    );
}

#[test]
fn the_claim() {
    refused(
        "the evidence gives `not-determined`",
        &changed("line", "/claim/verdict/value", json!("determined")),
    );
    refused(
        "the evidence gives `25`",
        &changed("line", "/claim/rank/value", json!(26)),
    );
    refused(
        "rank.required is 29, not 30",
        &changed("line", "/claim/rank/required", json!(30)),
    );
    refused(
        "the evidence gives `3`",
        &changed("line", "/claim/components/value", json!(4)),
    );
    refused(
        "`error-bound` is no strength with this `error_log2`",
        &changed("line", "/claim/components/strength", json!("error-bound")),
    );
}

/// What is too large for the limits is not rejected.
#[test]
fn limits() {
    let certificate = Certificate::parse(named("psi").to_string().as_bytes()).unwrap();
    let limits = Limits {
        core: 3,
        ..Limits::default()
    };
    let failure = certificate.check(None, None, &limits).unwrap_err();
    assert!(matches!(failure, Failure::TooLarge(_)), "{failure}");
    // What numbers cost goes by the square of their length, the chart by that of the nodes, primes by their number.
    let cost = |document: &Value| {
        let certificate = Certificate::parse(document.to_string().as_bytes()).unwrap();
        let failure = |operations: u64| {
            let limits = Limits {
                operations,
                ..Limits::default()
            };
            certificate.check(None, None, &limits).err()
        };
        let is_enough =
            |&operations: &u64| !matches!(failure(operations), Some(Failure::TooLarge(_)));
        (10..40).map(|bits| 1 << bits).find(is_enough).unwrap()
    };
    let digits = |n: usize| {
        let long = json!(format!("1{}", "0".repeat(n)));
        changed("matrices", "/cameras/0/0", long)
    };
    assert!(cost(&digits(80_000)) >= 8 * cost(&digits(20_000)));
    assert!(cost(&digits(20_000)) > cost(&named("matrices")));
    assert!(cost(&named("digits")) > 3 * cost(&changed("digits", "/pieces/0/primes", json!(1))));
}
