//! The schema of the lines of `--json`.

use super::Run;
use serde_json::{Value, json};

/// The schema of all JSON lines.
pub(crate) fn schema() -> jsonschema::Validator {
    let schema = include_str!("../../docs/report.schema.json");
    let schema: Value = serde_json::from_str(schema).unwrap();
    assert!(jsonschema::meta::is_valid(&schema));
    jsonschema::validator_for(&schema).unwrap()
}

/// Holds every line of a run against the schema; there has to be one.
pub(crate) fn valid(schema: &jsonschema::Validator, run: &Run) -> Vec<Value> {
    assert!(run.code <= 1, "{}", run.err);
    let lines = run.json();
    assert!(!lines.is_empty());
    for line in &lines {
        let found: Vec<String> = schema.iter_errors(line).map(|e| e.to_string()).collect();
        assert!(found.is_empty(), "{found:?}: {line}");
    }
    lines
}

/// Places of all objects and leaves in a value, as JSON pointers.
fn places(value: &Value, at: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(members) => {
            found.push(at.to_owned());
            for (name, member) in members {
                places(member, &format!("{at}/{name}"), found);
            }
        }
        Value::Array(items) => {
            for (k, item) in items.iter().enumerate() {
                places(item, &format!("{at}/{k}"), found);
            }
        }
        _ => found.push(at.to_owned()),
    }
}

/// A member more in any object, another type in any leaf, and the lack of a member are refused.
pub(crate) fn mutilations_are_refused(
    schema: &jsonschema::Validator,
    line: &Value,
    required: &[&str],
) {
    let mut found = Vec::new();
    places(line, "", &mut found);
    assert!(found.len() > 4);
    for place in found {
        let mut other = line.clone();
        match other.pointer_mut(&place).unwrap() {
            Value::Object(members) => {
                members.insert("surplus".into(), Value::Null);
            }
            leaf => *leaf = json!({"another": "type"}),
        }
        assert!(!schema.is_valid(&other), "{place}: {other}");
    }
    for name in required {
        let mut other = line.clone();
        assert!(other.as_object_mut().unwrap().remove(*name).is_some());
        assert!(!schema.is_valid(&other), "without {name}");
    }
}

/// Holds a run of records of a kind against the schema, and that against changes of its first line.
pub(crate) fn keeps_to(kind: &str, run: &Run, required: &[&str]) -> Vec<Value> {
    let schema = schema();
    let lines = valid(&schema, run);
    let version = env!("CARGO_PKG_VERSION");
    for line in run.out.lines() {
        let head = format!(
            r#"{{"kind":"{kind}","format":1,"program":{{"name":"verify","version":"{version}"}},"#
        );
        assert!(line.starts_with(&head), "{line}");
    }
    mutilations_are_refused(&schema, &lines[0], required);
    lines
}
