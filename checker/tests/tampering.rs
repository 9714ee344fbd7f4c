//! Certificates written by an independent script from the specification, and what becomes of them when they are changed.

use std::fs;
use std::ops::Range;
use std::path::Path;
use viewcert_check::{Graph, check};

fn certificates() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/certificates");
    let mut paths: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    paths
        .iter()
        .map(|path| {
            (
                path.display().to_string(),
                fs::read_to_string(path).unwrap(),
            )
        })
        .collect()
}

fn named(name: &str) -> String {
    let found = certificates()
        .into_iter()
        .find(|(path, _)| path.ends_with(&format!("/{name}.json")));
    found.unwrap().1
}

fn rejection(text: &str) -> String {
    check(text.as_bytes(), None)
        .map(|verified| verified.to_string())
        .unwrap_err()
        .to_string()
}

/// The end of the JSON value that starts at a position (of a valid text).
fn value_end(text: &[u8], start: usize) -> usize {
    let (mut depth, mut at, mut in_string) = (0, start, false);
    loop {
        match text[at] {
            b'"' => in_string = !in_string,
            b'[' | b'{' if !in_string => depth += 1,
            b']' | b'}' if !in_string => depth -= 1,
            _ => {}
        }
        at += 1;
        if depth == 0
            && !in_string
            && (text[start] == b'"'
                || b"[{".contains(&text[start])
                || b",]}\n ".contains(&text[at]))
        {
            return at;
        }
    }
}

/// Every member of every object: its name, where it stands with its name, and where its value stands.
fn members(text: &str) -> Vec<(String, Range<usize>, Range<usize>)> {
    let bytes = text.as_bytes();
    let colons = text.match_indices("\":");
    colons
        .map(|(quote, _)| {
            let start = text[..quote].rfind('"').unwrap();
            let value = quote + 2;
            (
                text[start + 1..quote].to_string(),
                start..value_end(bytes, value),
                value..value_end(bytes, value),
            )
        })
        .collect()
}

/// Every number and every string that is a value, with the name of the member in which it stands.
fn scalars(text: &str) -> Vec<(String, Range<usize>)> {
    let bytes = text.as_bytes();
    let mut found = Vec::new();
    for (name, _, value) in members(text) {
        let inner = members(text)
            .into_iter()
            .any(|(_, whole, _)| value.start < whole.start && whole.end < value.end);
        let mut at = value.start;
        while at < value.end && !inner {
            if bytes[at] == b'"'
                || bytes[at].is_ascii_digit()
                || bytes[at] == b'-'
                || bytes[at] == b'n'
            {
                let end = value_end(bytes, at);
                found.push((name.clone(), at..end));
                at = end;
            }
            at += 1;
        }
    }
    found
}

fn replaced(text: &str, range: &Range<usize>, with: &str) -> String {
    format!("{}{with}{}", &text[..range.start], &text[range.end..])
}

#[test]
fn all_are_verified() {
    assert_eq!(certificates().len(), 17);
    for (path, text) in certificates() {
        let verified =
            check(text.as_bytes(), None).unwrap_or_else(|error| panic!("{path}: {error}"));
        let solvable = [
            "pair",
            "triangle",
            "merges",
            "bipartite",
            "square-calibrated",
        ];
        let wanted = solvable
            .iter()
            .any(|name| path.ends_with(&format!("/{name}.json")));
        assert_eq!(verified.rank.0 == verified.required, wanted, "{path}");
    }
}

/// A changed certificate is rejected, or it proves the very same statement in another way (other pivots or cameras).
#[test]
fn no_changed_scalar_changes_what_is_verified() {
    const OTHER_PROOF: [&str; 11] = [
        "name",
        "program",
        "rows",
        "cols",
        "flows",
        "lambda_rows",
        "lambda_cols",
        "seed",
        "draw",
        "add",
        "at",
    ];
    let mut rejected = 0;
    for (path, text) in certificates() {
        let original = check(text.as_bytes(), None).unwrap().to_string();
        for (name, range) in scalars(&text) {
            let old = &text[range.clone()];
            let digits = old.trim_matches('"');
            let changes = match digits.parse::<i128>() {
                Ok(number) if old.starts_with('"') => {
                    vec![
                        format!("\"{}\"", number + 1),
                        format!("\"{}\"", number - 1),
                        digits.to_string(),
                    ]
                }
                Ok(number) => {
                    vec![
                        (number + 1).to_string(),
                        (number - 1).to_string(),
                        format!("\"{old}\""),
                        "null".into(),
                    ]
                }
                Err(_) if old == "null" => vec!["0".into(), "-100".into(), "\"\"".into()],
                Err(_) => vec![format!("\"{digits}x\""), "\"\"".into(), "0".into()],
            };
            for change in changes {
                let changed = replaced(&text, &range, &change);
                match check(changed.as_bytes(), None) {
                    Err(_) => rejected += 1,
                    Ok(verified) => {
                        assert!(
                            OTHER_PROOF.contains(&name.as_str()),
                            "{path}: {name} {old} -> {change}"
                        );
                        let same = |text: &str| text.split("\nalso").next().unwrap().to_string();
                        assert_eq!(
                            same(&verified.to_string()),
                            same(&original),
                            "{path}: {name} {old} -> {change}"
                        );
                    }
                }
            }
        }
    }
    assert!(rejected > 3000, "{rejected}");
}

#[test]
fn members_are_there_once() {
    for (path, text) in certificates() {
        for (name, whole, value) in members(&text) {
            let member = &text[whole.clone()];
            let twice = rejection(&replaced(&text, &whole, &format!("{member},{member}")));
            assert!(
                twice.starts_with(&format!("the member `{name}` is repeated")),
                "{path}: {twice}"
            );
            let unknown = rejection(&replaced(&text, &whole, &format!("{member},\"extra\":1")));
            assert!(
                unknown.starts_with("the member `extra` does not belong there"),
                "{path}: {unknown}"
            );
            let renamed = rejection(&replaced(
                &text,
                &whole,
                &format!("\"{name}s\":{}", &text[value.clone()]),
            ));
            let kind = "missing field `kind`".to_string();
            let reasons = [format!("unknown field `{name}s`"), kind.clone()];
            assert!(
                reasons.iter().any(|reason| renamed.starts_with(reason)),
                "{path}: {renamed}"
            );
            let removed = match text[whole.end..].strip_prefix(',') {
                Some(rest) => format!("{}{rest}", &text[..whole.start]),
                None => format!(
                    "{}{}",
                    text[..whole.start].trim_end().trim_end_matches(','),
                    &text[whole.end..]
                ),
            };
            let missing = rejection(&removed);
            let reasons = [
                format!("missing field `{name}`"),
                kind,
                A_MEMBER_IS_MISSING.into(),
            ];
            assert!(
                reasons.iter().any(|reason| missing.starts_with(reason)),
                "{path}: {missing}"
            );
            for other in ["7", "\"7\"", "[]", "{}", "[[0,1]]", "[[]]", "[7]", "[{}]"] {
                let changed = replaced(&text, &value, other);
                // Without its kernel an integer minor is a lower bound still.
                let weaker = name == "kernel" && other == "[]";
                if changed != text
                    && !weaker
                    && !["name", "program", "seed", "draw"].contains(&name.as_str())
                {
                    assert!(
                        check(changed.as_bytes(), None).is_err(),
                        "{path}: {name} -> {other}"
                    );
                }
            }
        }
    }
}

const A_MEMBER_IS_MISSING: &str =
    "a member is missing, or a list or a number stands in the place of an object or a string";

/// Every object written as the list of its members' values; derived readers of JSON would take that.
#[test]
fn lists_are_no_objects() {
    for (path, text) in certificates() {
        // A brace after a letter stands in a graph6 line.
        for (at, _) in text
            .match_indices('{')
            .filter(|(at, _)| !text[..*at].ends_with(char::is_alphanumeric))
        {
            let object = at..value_end(text.as_bytes(), at);
            let is_own = |whole: &Range<usize>| {
                let before = text.get(at + 1..whole.start).unwrap_or("{");
                whole.end < object.end
                    && before.matches(['{', '[']).count() == before.matches(['}', ']']).count()
            };
            let values = members(&text)
                .into_iter()
                .filter(|(_, whole, _)| is_own(whole));
            let values: Vec<&str> = values.map(|(_, _, value)| &text[value]).collect();
            let rejected = rejection(&replaced(
                &text,
                &object,
                &format!("[{}]", values.join(",")),
            ));
            let reasons = [
                "invalid type: sequence",
                "invalid type: string",
                "invalid length",
                A_MEMBER_IS_MISSING,
            ];
            assert!(
                reasons.iter().any(|reason| rejected.starts_with(reason)),
                "{path}: {rejected}"
            );
        }
    }
}

/// Spellings that a reader of JSON may take for the same, and which the specification does not allow.
#[test]
fn one_spelling_of_everything() {
    for (name, old, new, wanted) in [
        (
            "pair",
            "\"version\":1",
            "\"version\":1.0",
            "invalid type: floating point `1.0`, expected u64",
        ),
        (
            "pair",
            "\"version\":1",
            "\"version\":1e0",
            "invalid type: floating point `1.0`, expected u64",
        ),
        ("pair", "\"version\":1", "\"version\":01", "invalid number"),
        (
            "pair",
            "[[0,1]]",
            "[[-0,1]]",
            "invalid type: floating point `-0.0`, expected u32",
        ),
        ("pair", "[[0,1]]", "[[0,1,1]]", "trailing characters"),
        (
            "pair",
            "\"projective\"",
            "{\"projective\":null}",
            A_MEMBER_IS_MISSING,
        ),
        (
            "pair",
            "\"graph6\":\"A_\"",
            "\"graph6\":[\"A_\"]",
            "invalid type: sequence, expected a string",
        ),
        (
            "merges",
            "\"with\":[1,2]",
            "\"with\":[[1],2]",
            "data did not match any variant of untagged enum Source",
        ),
        (
            "theta",
            "\"kind\":\"plane-flow\"",
            "\"kind\":2",
            "invalid type: integer `2`, expected variant identifier",
        ),
        (
            "square",
            "\"prime\":\"1000003\"",
            "\"prime\":\"01000003\"",
            "pieces[0].evidence[0] (plane-flow): `01000003` is",
        ),
        (
            "square",
            "\"prime\":\"1000003\"",
            "\"prime\":\"+1000003\"",
            "pieces[0].evidence[0] (plane-flow): `+1000003` is",
        ),
        (
            "square",
            "\"seed\":\"1\"",
            "\"seed\":\"18446744073709551616\"",
            "pieces[0].evidence[0] (plane-flow): `18446744",
        ),
        (
            "square",
            "\"draw\":0",
            "\"draw\":9007199254740992",
            "pieces[0].evidence[0] (plane-flow): `draw` is 2^53 or more",
        ),
        (
            "integer",
            "\"determinant\":\"-",
            "\"determinant\":\"-0",
            "pieces[0].evidence[0] (integer-minor): `determinant` is",
        ),
    ] {
        let text = named(name);
        assert!(text.contains(old), "{name} has no {old}");
        let rejected = rejection(&text.replacen(old, new, 1));
        let rejected_all = rejection(&text.replace(old, new));
        assert!(
            rejected.starts_with(wanted),
            "{name}: {old} -> {new}: {rejected}"
        );
        assert!(
            rejected_all.starts_with(wanted),
            "{name}: {old} -> {new}: {rejected_all}"
        );
    }
    // Evidence inside of a class is read in another way than that of a piece: its kind is a string all the same.
    let text = named("theta");
    let inner = text.rfind("\"kind\":\"plane-flow\"").unwrap();
    let changed = format!("{}\"kind\":2{}", &text[..inner], &text[inner + 19..]);
    assert_eq!(rejection(&changed), A_MEMBER_IS_MISSING);
    let nested = "[".repeat(100_000);
    assert!(rejection(&nested).starts_with("invalid type: sequence"));
    let deep = named("pair").replace("\"A_\"", &nested);
    assert!(check(deep.as_bytes(), None).is_err());
}

/// Members may stand in any order.
#[test]
fn order_of_members_does_not_matter() {
    let text = named("square");
    let (graph, rest) = text.split_once("\"graph\":").unwrap();
    let (value, tail) = rest.split_at(value_end(rest.as_bytes(), 0));
    let moved = format!(
        "{{\"graph\":{value},{}{}",
        &graph[1..],
        &tail.trim_start()[1..]
    );
    assert!(check(moved.as_bytes(), None).is_ok());
}

#[test]
fn truncated_anywhere() {
    for (path, text) in certificates() {
        for end in 0..text.trim_end().len() {
            assert!(
                check(&text.as_bytes()[..end], None).is_err(),
                "{path} up to byte {end}"
            );
        }
        assert!(rejection(&format!("{text}x")).starts_with("trailing characters"));
    }
}

#[test]
fn another_graph() {
    let square = Graph::from_graph6(b"Cl").unwrap();
    assert!(check(named("square").as_bytes(), Some(&square)).is_ok());
    let other = Graph::from_graph6(b"C~").unwrap();
    let rejected = check(named("square").as_bytes(), Some(&other)).unwrap_err();
    assert_eq!(
        rejected.to_string(),
        "graph: the graph given is not the one in `graph6`"
    );
    let without = named("square").replace("\"Cl\"", "null");
    assert!(check(without.as_bytes(), Some(&square)).is_ok());
    let rejected = check(without.as_bytes(), Some(&other)).unwrap_err();
    assert_eq!(
        rejected.to_string(),
        "graph: the graph has another hash than `sha256`"
    );
    assert_eq!(
        rejection(&without),
        "graph: the certificate does not hold the graph, and none is given"
    );
}

/// Single changes with the reason that each must be given.
#[test]
fn reasons() {
    for (name, old, new, wanted) in [
        (
            "square",
            "projective",
            "affine",
            "unknown variant `affine`, expected `projective` or `calibrated` at line 2 column 17",
        ),
        (
            "square",
            "\"version\":1",
            "\"version\":2",
            "version 2 is unknown to this program",
        ),
        (
            "square",
            "\"bound\":28",
            "\"bound\":27",
            "pieces[0].evidence[1] (counting): the bound is 27, but the blocks sum up to 28",
        ),
        (
            "square",
            "1000003",
            "1000001",
            "pieces[0].evidence[0] (plane-flow): 1000001 is not a prime with 5 <= p < 2^62",
        ),
        (
            "square",
            "\"plane-flow\"",
            "\"plain-flow\"",
            "unknown variant `plain-flow`, expected one of `minor`, `integer-minor`, `plane-flow`, `counting`, `draws`, \
             `classes`, `kernel` at line 10 column 33",
        ),
        (
            "pair",
            "\"edges\":[[0,1]]",
            "\"edges\":[]",
            "pieces: the edge [0, 1] is left out",
        ),
        (
            "pair",
            "\"edges\":[[0,1]]",
            "\"edges\":[[1,0]]",
            "rigid: [1, 0] is not an edge (i < j) of the graph",
        ),
        (
            "pair",
            "\"edges\":[[0,1]]",
            "\"edges\":[[0,1],[0,1]]",
            "rigid: the bodies or the edges are not increasing",
        ),
        (
            "pair",
            "\"solvable\"",
            "\"finite-solvable\"",
            "claim.verdict: `finite-solvable` is claimed, but the evidence gives `solvable`",
        ),
        (
            "pair",
            "\"value\":7",
            "\"value\":6",
            "claim.rank: `6` is claimed, but the evidence gives `7`",
        ),
        (
            "path",
            "\"value\":2",
            "\"value\":1",
            "claim.components: `1` is claimed, but the evidence gives `2`",
        ),
        (
            "triangle",
            "[[2,0,1]]",
            "[[2,0,0]]",
            "bodies[0].add[0]: the two nodes of the body are the same",
        ),
        (
            "triangle",
            "[[2,0,1]]",
            "[[2,0,1],[2,0,1]]",
            "bodies[0].add[1]: node 2 is in the body already",
        ),
        (
            "triangle",
            "[[2,0,1]]",
            "[[1,0,2]]",
            "bodies[0].add[0]: node 2 is not in the body",
        ),
        (
            "triangle",
            "\"bodies\":[0]",
            "\"bodies\":[1]",
            "rigid: 1 is not a final body",
        ),
        (
            "merges",
            "\"with\":[1,2]",
            "\"with\":[1,1]",
            "bodies[3].merge[0]: body 1 is not an earlier one, or is used a second time",
        ),
        (
            "merges",
            "\"with\":[1,2]",
            "\"with\":[9,2]",
            "bodies[3].merge[0]: body 9 is not an earlier one, or is used a second time",
        ),
        (
            "merges",
            "\"at\":[2,0,4]",
            "\"at\":[2,1,4]",
            "bodies[3].merge[0]: node 1 is not where the merge needs it",
        ),
        (
            "merges",
            "\"with\":[[1,6],[5,6]]",
            "\"with\":[1,[5,6]]",
            "bodies[3].merge[1]: body 1 is not an earlier one, or is used a second time",
        ),
        (
            "merges",
            "\"with\":[[1,6],[5,6]]",
            "\"with\":[[1,5],[5,6]]",
            "bodies[3].merge[1]: [1, 5] is not an edge (i < j) of the graph",
        ),
        (
            "merges",
            "\"bodies\":[3]",
            "\"bodies\":[0]",
            "rigid: 0 is not a final body",
        ),
        (
            "integer",
            "\"determinant\":\"-",
            "\"determinant\":\"",
            "pieces[0].evidence[0] (integer-minor): `determinant` is not that of the minor",
        ),
        (
            "integer",
            "\"prime\":null",
            "\"prime\":\"2305843009213693951\"",
            "pieces[0].evidence[0] (integer-minor): one of `determinant` and `prime` is null, and one is not",
        ),
        (
            "integer-prime",
            "\"prime\":\"2305843009213693951\"",
            "\"prime\":null",
            "pieces[0].evidence[0] (integer-minor): one of `determinant` and `prime` is null, and one is not",
        ),
        (
            "draws",
            "\"count\":3",
            "\"count\":1",
            "pieces[0].evidence[1] (draws): `count` must be 3",
        ),
        (
            "draws",
            "\"rank\":28",
            "\"rank\":27",
            "pieces[0].evidence[1] (draws): the largest of the ranks [28, 28, 28] is not 27",
        ),
        (
            "draws",
            "\"rank\":28",
            "\"rank\":29",
            "pieces[0].evidence[1] (draws): the largest of the ranks [28, 28, 28] is not 29",
        ),
        (
            "draws",
            "\"error-bound\",\"error_log2\":-153",
            "\"proof\",\"error_log2\":null",
            "claim.verdict: the strength is not `proof`, but `error at most 2^-153 over the draws`",
        ),
        (
            "square",
            "\"proof\",\"error_log2\":null",
            "\"error-bound\",\"error_log2\":-153",
            "claim.verdict: the strength is not `error at most 2^-153 over the draws`, but `proof`",
        ),
    ] {
        let text = named(name);
        assert!(text.contains(old), "{name} has no {old}");
        assert_eq!(
            rejection(&text.replacen(old, new, 1)),
            wanted,
            "{name}: {old} -> {new}"
        );
    }
}

/// Each condition on a hub, on the square: node 0 split into a copy for each of its two edges.
#[test]
fn hubs() {
    let step = "pieces[0].evidence[1] (counting).blocks[0].hubs[0]";
    for (old, new, wanted) in [
        (
            "\"split\":[0,1]",
            "\"split\":[0,2]",
            ": a part is split that does not contain node 0",
        ),
        (
            "\"split\":[0,1]",
            "\"split\":[0]",
            ": the split graph has 1 components, not 2",
        ),
        (
            "\"split\":[0,1]",
            "\"split\":[1,0]",
            ": `split` is not an increasing list of parts",
        ),
        (
            "\"components\":2",
            "\"components\":1",
            ": the split graph has 2 components, not 1",
        ),
        ("\"less\":1", "\"less\":2", ": the hub takes off 1, not 2"),
        (
            "\"groups\":[[0],[1],[2],[3]]",
            "\"groups\":[[0],[1],[2]]",
            ": a part is in no group",
        ),
        (
            "\"groups\":[[0],[1],[2],[3]]",
            "\"groups\":[[0],[1],[2],[3],[0]]",
            ": part 0 stands in two groups",
        ),
        (
            "\"groups\":[[0],[1],[2],[3]]",
            "\"groups\":[[0],[1],[2],[3],[]]",
            ": groups[4] is not an increasing list of parts",
        ),
        // One group of both edges at node 0 has four nodes, two of them copies: s = 8 + 2 + 2 - 8 = 4, 2 - 1 - 3 s = -11.
        (
            "\"groups\":[[0],[1],[2],[3]]",
            "\"groups\":[[0,1],[2],[3]]",
            ": the hub takes off -11, not 1",
        ),
        (
            "\"node\":0",
            "\"node\":1",
            ": a part is split that does not contain node 1",
        ),
    ] {
        let text = named("hub");
        assert!(text.contains(old), "no {old}");
        assert_eq!(
            rejection(&text.replacen(old, new, 1)),
            format!("{step}{wanted}"),
            "{old} -> {new}"
        );
    }
}

/// A class that no motion shown tells apart is a component only if it is rigid by itself.
#[test]
fn classes() {
    let split = "{\"rigid\":{\"bodies\":[],\"edges\":[[0,1],[1,2]]},\"pieces\":[]}";
    let step = "pieces[0].evidence[2] (classes).classes[0]";
    for (name, old, new, wanted) in [
        (
            "pentagon-split",
            split,
            "null",
            ": the class is not proved to have the rank 18 of its core",
        ),
        (
            "pentagon-split",
            "[[0,1],[1,2]]},",
            "[[0,1]]},",
            ".split.pieces: the edge [1, 2] is left out",
        ),
        (
            "pentagon-split",
            "[[0,1],[1,2]]},",
            "[[0,1],[2,3]]},",
            ".split.pieces: the edge [2, 3] is out of place",
        ),
        (
            "theta",
            "\"bound\":28",
            "\"bound\":27",
            ".split.pieces[0].evidence[1] (counting): the bound is 27, but the blocks sum up to 28",
        ),
        (
            "rigid-class",
            "\"seed\":\"0\",\"draw\":1",
            "\"seed\":\"x\",\"draw\":1",
            ".evidence[0] (plane-flow): `x` is not an integer in range",
        ),
    ] {
        let text = named(name);
        assert!(text.replace("\n ", "").contains(old), "{name} has no {old}");
        assert_eq!(
            rejection(&text.replace("\n ", "").replacen(old, new, 1)),
            format!("{step}{wanted}"),
            "{old} -> {new}"
        );
    }
}

/// A trivial motion is a kernel vector, but separates nothing; half a kernel vector is none.
#[test]
fn kernel_vectors_that_prove_nothing() {
    let text = named("square");
    let (head, tail) = text.split_at(text.find("\"vector\":").unwrap() + 9);
    let end = value_end(tail.as_bytes(), 0);
    let with = |vector: String| rejection(&format!("{head}[{vector}]{}", &tail[end..]));
    let step = "pieces[0].evidence[3] (kernel)";
    assert_eq!(
        with(["\"0\""; 48].join(",")),
        format!("{step}: two classes move alike")
    );
    let shifted: Vec<String> = (0..48)
        .map(|k| format!("\"{}\"", u8::from(k == 0)))
        .collect();
    assert!(
        with(shifted.join(","))
            .starts_with(&format!("{step}: not a kernel vector at the core edge"))
    );
    assert_eq!(
        with(["\"0\""; 47].join(",")),
        format!("{step}: `vector` has 47 entries instead of 48")
    );
    assert_eq!(
        with(["\"1000003\""; 48].join(",")),
        format!("{step}: an entry is not a residue modulo 1000003")
    );
}

/// The certificate that the specification checks by hand.
#[test]
fn the_one_checked_by_hand() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/certificate.md");
    let page = fs::read_to_string(page).unwrap();
    let (_, section) = page.split_once("```json\n").unwrap();
    let (text, _) = section.split_once("```").unwrap();
    let verified = check(text.as_bytes(), None).unwrap();
    assert_eq!(
        (verified.rank.0, verified.required, verified.components.0),
        (28, 29, 4)
    );
    assert!(
        check(
            text.replace("[1,2,4,5,7,8,0,3]", "[1,2,4,5,7,8,6,3]")
                .as_bytes(),
            None
        )
        .is_err(),
        "6 is zero there"
    );
}
