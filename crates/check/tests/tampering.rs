//! Certificates written by an independent script from the specification, and what becomes of them
//! when they are changed.

use std::fs;
use std::ops::Range;
use std::path::Path;
use viewcert_check::check;

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

/// `bipartite` with its piece as a body by rank.
fn by_rank() -> (String, String) {
    let mut value: serde_json::Value = serde_json::from_str(&named("bipartite")).unwrap();
    let piece = value["pieces"].as_array_mut().unwrap().remove(0);
    value["bodies"] = serde_json::json!([{"seed": piece, "add": [], "merge": []}]);
    value["rigid"]["bodies"] = serde_json::json!([0]);
    ("by rank".into(), value.to_string())
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

/// Every member of every object: its name, where it stands with its name, and where its value
/// stands.
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
    assert_eq!(certificates().len(), 44);
    for (path, text) in certificates() {
        let verified =
            check(text.as_bytes(), None).unwrap_or_else(|error| panic!("{path}: {error}"));
        let solvable = [
            "pair",
            "triangle",
            "merges",
            "bipartite",
            "square-calibrated",
            "cycle",
            "clusters",
            "ring",
            "biclique",
            "heawood",
            "tripod",
            "link",
            "affine-bipartite",
            "affine-bars",
            "parts-rig",
            "parts-ring-calibrated",
            "parts-affine",
            "displaced-rigs",
            "displaced-merge",
            "displaced-pieces",
            "displaced-pentagon",
        ];
        let wanted = solvable
            .iter()
            .any(|name| path.ends_with(&format!("/{name}.json")));
        assert_eq!(verified.rank.0 == verified.required, wanted, "{path}");
    }
}

/// A changed certificate is rejected, or it proves the very same statement in another way (other
/// pivots or cameras).
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
    for (path, text) in certificates().into_iter().chain([by_rank()]) {
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
    for (path, text) in certificates().into_iter().chain([by_rank()]) {
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
            let unknown = format!("the member `{name}s` does not belong there");
            assert!(renamed.starts_with(&unknown), "{path}: {renamed}");
            let removed = match text[whole.end..].strip_prefix(',') {
                Some(rest) => format!("{}{rest}", &text[..whole.start]),
                None => format!(
                    "{}{}",
                    text[..whole.start].trim_end().trim_end_matches(','),
                    &text[whole.end..]
                ),
            };
            let missing = rejection(&removed);
            let wanted = format!("the member `{name}` is missing");
            // What is known or added may be missing, and what rests on it is wrong then.
            let may_be_missing = member.starts_with("\"parts\":[[")
                || ["displacements", "vectors"].contains(&name.as_str());
            assert!(
                missing.starts_with(&wanted) || may_be_missing,
                "{path}: {missing}"
            );
            for other in ["7", "\"7\"", "[]", "{}", "[[0,1]]", "[[]]", "[7]", "[{}]"] {
                let changed = replaced(&text, &value, other);
                // Without its kernel an integer minor is a lower bound still.
                let weaker = name == "kernel" && other == "[]";
                // Modulo 7 the minor of a class in the plane is no zero either.
                let another = name == "prime" && path.ends_with("/affine-hinges.json");
                if changed != text
                    && !weaker
                    && !another
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

/// Every object written as the list of its members' values; derived readers of JSON would take
/// that.
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
            let wanted = "invalid type: sequence, expected an object";
            assert!(rejected.starts_with(wanted), "{path}: {rejected}");
        }
    }
}

/// Spellings that a reader of JSON may take for the same, and which the specification does not
/// allow.
#[test]
fn one_spelling_of_everything() {
    for (name, old, new, wanted) in [
        (
            "pair",
            "\"version\":3",
            "\"version\":3.0",
            "invalid type: floating point `3.0`, expected an integer below 2^53",
        ),
        (
            "pair",
            "\"version\":3",
            "\"version\":3e0",
            "invalid type: floating point `3.0`, expected an integer below 2^53",
        ),
        ("pair", "\"version\":3", "\"version\":03", "invalid number"),
        (
            "pair",
            "\"version\":3",
            "\"version\":\"3\"",
            "invalid type: string \"3\", expected an integer below 2^53",
        ),
        (
            "pair",
            "\"version\":3,\"question\":\"generic\"",
            "\"version\":2",
            "version 2 is not read any more; write the certificate anew: `verify GRAPH --certificate FILE`",
        ),
        (
            "pair",
            "\"version\":3",
            "\"version\":4",
            "version 4 is unknown to this program, which checks version 3",
        ),
        (
            "pair",
            "\"generic\"",
            "\"any\"",
            "`any` is not a question: `generic`, `at-cameras`, `intrinsics` or `contradictions`",
        ),
        (
            "pair",
            "\"generic\"",
            "\"contradictions\"",
            "the member `graph` does not belong there",
        ),
        (
            "pair",
            "\"format\":\"viewcert certificate\"",
            "\"format\":\"viewcert\"",
            "`format` is not \"viewcert certificate\"",
        ),
        (
            "pair",
            "[[0,1]]",
            "[[-0,1]]",
            "invalid type: floating point `-0.0`, expected an integer below 2^53",
        ),
        ("pair", "[[0,1]]", "[[-1,1]]", "-1 is out of range"),
        (
            "pair",
            "[[0,1]]",
            "[[0,4294967296]]",
            "4294967296 is out of range",
        ),
        (
            "pair",
            "[[0,1]]",
            "[[0,9007199254740992]]",
            "invalid value: integer `9007199254740992`, expected an integer below 2^53",
        ),
        (
            "pair",
            "\"edges\":1",
            "\"edges\":-9007199254740992",
            "invalid value: integer `-9007199254740992`, expected an integer below 2^53",
        ),
        (
            "pair",
            "[[0,1]]",
            "[[0,1,1]]",
            "invalid length 3, expected a list of 2 entries",
        ),
        (
            "pair",
            "[[0,1]]",
            "[[0]]",
            "invalid length 1, expected a list of 2 entries",
        ),
        (
            "triangle",
            "[[2,0,1]]",
            "[[2,0,1,1]]",
            "invalid length 4, expected a list of 3 entries",
        ),
        (
            "pair",
            "\"projective\"",
            "{\"projective\":null}",
            "invalid type: map, expected a string",
        ),
        (
            "pair",
            "\"graph6\":\"A_\"",
            "\"graph6\":[\"A_\"]",
            "invalid type: sequence, expected a string",
        ),
        (
            "pair",
            "\"A_\"",
            "\"A\\ud800\\n\"",
            "unexpected end of hex escape",
        ),
        (
            "pair",
            "\"A_\"",
            "\"A\\udc00_\"",
            "lone leading surrogate in hex escape",
        ),
        (
            "merges",
            "\"with\":[1,2]",
            "\"with\":[[1],2]",
            "invalid length 1, expected a list of 2 entries",
        ),
        (
            "merges",
            "\"with\":[1,2]",
            "\"with\":[\"1\",2]",
            "invalid type: string \"1\", expected the number of a body or a pair of nodes",
        ),
        (
            "merges",
            "\"with\":[1,2]",
            "\"with\":[-1,2]",
            "invalid type: integer `-1`, expected the number of a body or a pair of nodes",
        ),
        (
            "merges",
            "\"with\":[1,2]",
            "\"with\":[4294967296,2]",
            "4294967296 is out of range",
        ),
        (
            "merges",
            "\"with\":[1,2]",
            "\"with\":{}",
            "invalid type: map, expected a list",
        ),
        (
            "theta",
            "\"kind\":\"plane-flow\"",
            "\"kind\":2",
            "invalid type: integer `2`, expected a string",
        ),
        (
            "theta",
            "\"kind\":\"plane-flow\"",
            "\"kind\":null",
            "invalid type: null, expected a string",
        ),
        (
            "theta",
            "\"kind\":\"plane-flow\"",
            "\"kind\":\"plane-flow\",\"count\":3",
            "the member `count` does not belong there",
        ),
        (
            "square",
            "\"prime\":\"1000003\"",
            "\"prime\":null",
            "`prime` is null",
        ),
        (
            "square",
            "\"prime\":\"1000003\"",
            "\"prime\":1000003",
            "invalid type: integer `1000003`, expected a string that holds a decimal integer",
        ),
        (
            "square",
            "\"prime\":\"1000003\"",
            "\"prime\":\"01000003\"",
            "`01000003` is not an integer in range",
        ),
        (
            "square",
            "\"prime\":\"1000003\"",
            "\"prime\":\"+1000003\"",
            "`+1000003` is not an integer in range",
        ),
        (
            "square",
            "\"prime\":\"1000003\"",
            "\"prime\":\"\"",
            "`` is not an integer in range",
        ),
        (
            "square",
            "\"prime\":\"1000003\"",
            "\"prime\":\"-1000003\"",
            "`-1000003` is not an integer in range",
        ),
        (
            "square",
            "\"seed\":\"1\"",
            "\"seed\":\"-0\"",
            "`-0` is not an integer in range",
        ),
        (
            "square",
            "\"seed\":\"1\"",
            "\"seed\":\"18446744073709551616\"",
            "`18446744073709551616` is not an integer in range",
        ),
        (
            "square",
            "\"draw\":0",
            "\"draw\":9007199254740992",
            "invalid value: integer `9007199254740992`, expected an integer below 2^53",
        ),
        ("square", "\"draw\":0", "\"draw\":-1", "-1 is out of range"),
        ("integer", "\"determinant\":\"", "\"determinant\":\"0", "`0"),
        (
            "integer",
            "\"determinant\":\"",
            "\"determinant\":\"--",
            "`--",
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
    // The names of members are compared after their escapes are read.
    let text = named("pair").replace("\"model\"", "\"m\\u006fdel\"");
    assert!(check(text.as_bytes(), None).is_ok());
    let twice = text.replacen('{', "{\"model\":\"projective\",", 1);
    assert!(rejection(&twice).starts_with("the member `model` is repeated"));
    for blank in ["\u{feff}", "\u{a0}", "\u{c}", "\0", "//\n"] {
        let text = named("pair");
        assert!(rejection(&format!("{blank}{text}")).contains("line 1 column"));
        assert!(rejection(&format!("{text}{blank}")).starts_with("trailing characters"));
    }
    let nested = "[".repeat(100_000);
    assert!(rejection(&nested).starts_with("invalid type: sequence"));
    let deep = named("pair").replace("\"A_\"", &nested);
    assert!(check(deep.as_bytes(), None).is_err());
    // 127 lists and objects inside of each other are read, and not one more: each class that is
    // split adds seven to the four around its piece.
    let pieces = |levels: usize, inner: &str| {
        let open = "{\"bodies\":[],\"edges\":[],\"evidence\":[{\"kind\":\"classes\",\"classes\":[{\"bodies\":[],\
                    \"edges\":[],\"evidence\":[],\"split\":{\"rigid\":{\"bodies\":[],\"edges\":[]},\"pieces\":[";
        let piece = format!("{{\"bodies\":[],\"edges\":{inner},\"evidence\":[]}}");
        format!("{}{piece}{}", open.repeat(levels), "]}}]}]}".repeat(levels))
    };
    let with = |inner: &str| {
        let text = named("pair").replace(
            "\"pieces\":[]",
            &format!("\"pieces\":[{}]", pieces(17, inner)),
        );
        rejection(&text)
    };
    // 1 + 1 + 7 * 17 = 121 for the list of pieces, 122 the piece, 123 its edges, 124 an edge.
    assert!(
        with("[[0,1]]").starts_with("pieces[0]"),
        "{}",
        with("[[0,1]]")
    );
    assert!(
        !with("[[[[[0]]]]]").contains("recursion"),
        "127: {}",
        with("[[[[[0]]]]]")
    );
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

/// The certificate that the specification checks by hand.
#[test]
fn the_one_checked_by_hand() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/certificate.md");
    let page = fs::read_to_string(page).unwrap();
    let (_, section) = page.split_once("```json\n").unwrap();
    let (text, _) = section.split_once("```").unwrap();
    let verified = check(text.as_bytes(), None).unwrap();
    assert_eq!(
        (verified.rank.0, verified.required, verified.components.0),
        (28, 29, 4)
    );
    let pivots =
        |first: &str| text.replace("[1,2,4,5,7,8,0,3]", &format!("[{first},2,4,5,7,8,0,3]"));
    assert_eq!(pivots("1"), text);
    let reason = rejection(&pivots("6"));
    assert_eq!(
        reason,
        "pieces[0].evidence[0] (plane-flow).N: pivot 0 vanishes"
    );
}
