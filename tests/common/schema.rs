//! The schema of the lines of `--json`.

use super::Run;
use serde_json::{Value, json};

/// The schema of all JSON lines.
pub fn schema() -> jsonschema::Validator {
    let schema = include_str!("../../docs/report.schema.json");
    let schema: Value = serde_json::from_str(schema).unwrap();
    assert!(jsonschema::meta::is_valid(&schema));
    jsonschema::validator_for(&schema).unwrap()
}

/// Holds every line of a run against the schema; there has to be one.
pub fn valid(schema: &jsonschema::Validator, run: &Run) -> Vec<Value> {
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
pub fn mutilations_are_refused(schema: &jsonschema::Validator, line: &Value, required: &[&str]) {
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

/// The schema of one command alone.
fn of_command(definition: &str) -> jsonschema::Validator {
    let all: Value = serde_json::from_str(include_str!("../../docs/report.schema.json")).unwrap();
    let known = all["oneOf"].as_array().unwrap();
    let reference = format!("#/$defs/{definition}");
    assert!(
        known.contains(&json!({ "$ref": reference })),
        "{definition}"
    );
    let one = json!({ "$ref": reference, "$defs": all["$defs"] });
    jsonschema::validator_for(&one).unwrap()
}

/// Holds a run against the schema of its command, and that against changes of its first line.
pub fn keeps_to(definition: &str, run: &Run, required: &[&str]) -> Vec<Value> {
    valid(&schema(), run);
    let own = of_command(definition);
    let lines = valid(&own, run);
    let version = env!("CARGO_PKG_VERSION");
    for line in &lines {
        assert_eq!(
            line["program"],
            json!({ "name": "verify", "version": version })
        );
    }
    mutilations_are_refused(&own, &lines[0], required);
    lines
}
