//! Any bytes as a certificate, with and without a graph: no panic. A valid certificate, changed by
//! what the bytes say: rejected, or it verifies the same values about the same graph, for there is
//! one truth about it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use serde_json::Value;
use std::sync::LazyLock;
use viewcert_check::{Certificate, Graph, check};

/// Valid certificates, parsed, each with its graph.
static VALID: LazyLock<Vec<(Value, Graph)>> = LazyLock::new(|| {
    let texts = [
        include_str!("../../crates/check/tests/certificates/bipartite.json"),
        include_str!("../../crates/check/tests/certificates/draws.json"),
        include_str!("../../crates/check/tests/certificates/hub.json"),
        include_str!("../../crates/check/tests/certificates/integer.json"),
        include_str!("../../crates/check/tests/certificates/merges.json"),
        include_str!("../../crates/check/tests/certificates/pentagon-calibrated.json"),
        include_str!("../../crates/check/tests/certificates/pentagon-split.json"),
        include_str!("../../crates/check/tests/certificates/prism.json"),
        include_str!("../../crates/check/tests/certificates/rigid-class.json"),
        include_str!("../../crates/check/tests/certificates/ring.json"),
        include_str!("../../crates/check/tests/certificates/theta.json"),
    ];
    let parse = |text: &str| {
        let value: Value = serde_json::from_str(text).unwrap();
        let graph =
            Graph::from_graph6(value["graph"]["graph6"].as_str().unwrap().as_bytes()).unwrap();
        (value, graph)
    };
    texts.into_iter().map(parse).collect()
});

fuzz_target!(|data: &[u8]| {
    let graph = &VALID[0].1;
    let outcomes = [check(data, None), check(data, Some(graph))];
    let _ = (
        outcomes.map(|outcome| outcome.map(|verified| verified.to_string())),
        Certificate::parse(data).map(|certificate| certificate.graph_sha256().to_owned()),
    );
    let _ = Graph::read(data, || None).map(|graph| graph.with_given(data));

    let mut bytes = data.iter().copied();
    let (valid, graph) = &VALID[usize::from(bytes.next().unwrap_or(0)) % VALID.len()];
    let mut changed = valid.clone();
    // Few changes: lists that are copied into themselves again and again would fill the memory.
    for _ in 0..6 {
        if bytes.len() > 0 {
            change(&mut changed, &mut bytes);
        }
    }
    if let Ok(verified) = check(changed.to_string().as_bytes(), Some(graph)) {
        let expected = check(valid.to_string().as_bytes(), None).unwrap();
        // With another model it is another question, and a proof may take the place of an error
        // bound.
        if verified.model == expected.model {
            assert_eq!(verified.rank.0, expected.rank.0);
            assert_eq!(verified.components.0, expected.components.0);
            assert_eq!(verified.verdict.0, expected.verdict.0);
        }
    }
});

/// Walks down to a value and changes it.
fn change(value: &mut Value, bytes: &mut impl Iterator<Item = u8>) {
    let mut byte = || usize::from(bytes.next().unwrap_or(0));
    let choice = byte();
    match value {
        Value::Array(list) if choice % 4 > 0 && !list.is_empty() => {
            let (at, other) = (byte() % list.len(), byte() % list.len());
            match choice % 32 {
                1 => drop(list.remove(at)),
                2 => list.push(list[at].clone()),
                3 => list.swap(at, other),
                _ => change(&mut list[at], bytes),
            }
        }
        Value::Object(members) if choice % 4 > 0 && !members.is_empty() => {
            let at = byte() % members.len();
            match choice % 64 {
                1 => drop(
                    members
                        .keys()
                        .nth(at)
                        .cloned()
                        .and_then(|name| members.remove(&name)),
                ),
                2 => drop(members.insert("more".into(), Value::Null)),
                _ => change(members.values_mut().nth(at).unwrap(), bytes),
            }
        }
        Value::Number(number) => {
            let number = number.as_i64().unwrap_or(0);
            *value = (number + choice as i64 - 128).into();
        }
        Value::String(text) if text.parse::<i128>().is_ok() => {
            let number: i128 = text.parse().unwrap();
            *text = (number + choice as i128 - 128).to_string();
        }
        Value::String(text) => text.extend(char::from_digit(choice as u32 % 36, 36)),
        _ if choice % 16 == 0 => *value = Value::Null,
        _ => *value = Value::Array(vec![value.clone()]),
    }
}
