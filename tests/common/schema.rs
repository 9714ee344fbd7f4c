//! As much of JSON Schema as certificates/certificate.schema.json uses.

use serde_json::Value;

/// Where and why a value does not have the shape.
pub fn violation(root: &Value, schema: &Value, value: &Value, at: &str) -> Option<String> {
    for (keyword, rule) in schema.as_object().unwrap() {
        if let Some(reason) = broken(root, schema, keyword, rule, value, at) {
            return Some(reason);
        }
    }
    None
}

fn broken(
    root: &Value,
    schema: &Value,
    keyword: &str,
    rule: &Value,
    value: &Value,
    at: &str,
) -> Option<String> {
    let fail = |holds: bool| (!holds).then(|| format!("{at}: {keyword} {rule}"));
    match keyword {
        "$schema" | "$defs" | "title" | "description" => None,
        "$ref" => {
            let path = rule.as_str().unwrap().strip_prefix('#').unwrap();
            violation(root, root.pointer(path).unwrap(), value, at)
        }
        "type" => match rule {
            Value::String(name) => fail(has_type(name, value)),
            names => fail(
                names
                    .as_array()
                    .unwrap()
                    .iter()
                    .any(|n| has_type(n.as_str().unwrap(), value)),
            ),
        },
        "const" => fail(value == rule),
        "enum" => fail(rule.as_array().unwrap().contains(value)),
        "minimum" => fail(value.as_i64() >= rule.as_i64()),
        "maximum" => fail(value.as_i64() <= rule.as_i64()),
        "minItems" => fail(value.as_array()?.len() as u64 >= rule.as_u64().unwrap()),
        "maxItems" => fail(value.as_array()?.len() as u64 <= rule.as_u64().unwrap()),
        "pattern" => fail(match rule.as_str().unwrap() {
            "^[0-9a-f]{64}$" => {
                let text = value.as_str()?;
                text.len() == 64 && text.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'f'))
            }
            "^(0|-?[1-9][0-9]*)$" => {
                let text = value.as_str()?;
                let digits = text.strip_prefix('-').unwrap_or(text);
                text == "0"
                    || (digits.bytes().all(|b| b.is_ascii_digit())
                        && !digits.starts_with('0')
                        && !digits.is_empty())
            }
            other => panic!("pattern {other}"),
        }),
        "required" => {
            let members = value.as_object()?;
            fail(
                rule.as_array()
                    .unwrap()
                    .iter()
                    .all(|name| members.contains_key(name.as_str().unwrap())),
            )
        }
        "properties" => rule.as_object().unwrap().iter().find_map(|(name, schema)| {
            violation(root, schema, value.get(name)?, &format!("{at}/{name}"))
        }),
        "additionalProperties" => {
            let known = schema["properties"].as_object().unwrap();
            fail(
                value
                    .as_object()?
                    .keys()
                    .all(|name| known.contains_key(name)),
            )
        }
        // Used with the strength and its exponent from a $ref.
        "unevaluatedProperties" => {
            let known = schema["properties"].as_object().unwrap();
            let inherited = ["strength", "error_log2"];
            let allowed =
                |name: &String| known.contains_key(name) || inherited.contains(&name.as_str());
            fail(value.as_object()?.keys().all(allowed))
        }
        "items" => value
            .as_array()?
            .iter()
            .enumerate()
            .find_map(|(k, item)| violation(root, rule, item, &format!("{at}/{k}"))),
        "oneOf" => {
            let fits = |schema: &&Value| violation(root, schema, value, at).is_none();
            fail(rule.as_array().unwrap().iter().filter(fits).count() == 1)
        }
        other => panic!("keyword {other}"),
    }
}

fn has_type(name: &str, value: &Value) -> bool {
    match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "null" => value.is_null(),
        "integer" => value.is_i64() || value.is_u64(),
        other => panic!("type {other}"),
    }
}
